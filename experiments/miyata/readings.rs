//! Every reading of Eq. (1): which makes a greater D the rougher?

use snowglobe::contour_cloud::{Amplitude, EdgeLength};
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Panels, Plot, Result, Series, Statistic, Table,
    smallest_rise,
};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;

use super::dimension::{heights, square};
use super::estimators::ESTIMATORS;
use super::figure_13::REVERSED;

pub const READINGS: Experiment = Experiment {
    id: "readings",
    title: "Every reading of Eq. (1)",
    source: "Eq. (1), §4",
    says: "A greater D makes the shape of the layer change more abruptly. Surfaces of five D are made under every reading of \
           Eq. (1), and their D is measured.",
    claims: &[&DETAIL, &SPECTRAL],
    run,
    mutant: Mutant {
        changes: "gain",
        to: 0.0,
        why: "without displacement every surface is flat, whatever D was asked for",
        turns_red: &["miyata/readings/detail", "miyata/readings/spectral"],
    },
};

const fn order(id: &'static str, says: &'static str, reason: &'static str) -> Claim {
    Claim {
        id,
        source: "§4",
        says,
        expect: Expect::Rises,
        statistic: Statistic::Share(1.0),
        reason,
        known: REVERSED,
    }
}

static DETAIL: Claim = order(
    "miyata/readings/detail",
    "the greater D, the rougher: displacements fall more slowly",
    "least rise of the D measured by the detail estimator from one to the next of five D, 2.1 to 2.9, every one of 12 seeds; it \
     undoes Eq. (1), and so judges the formula",
);
static SPECTRAL: Claim = order(
    "miyata/readings/spectral",
    "the greater D, the rougher: the spectrum falls more slowly",
    "least rise of the spectral D from one to the next of five D, 2.1 to 2.9, every one of 12 seeds; it judges the surface",
);

const ASKED: [f64; 5] = [2.1, 2.3, 2.5, 2.7, 2.9];
const SEEDS: u64 = 12;

fn run(lab: &mut Lab) -> Result<()> {
    let gain = lab.assume("gain", 1.0, "as printed; D does not depend on it");
    lab.assume_that("surface", "a level square in two patches", "contours of our own would add their relief");
    let power = lab.pick(7, 6);
    let side = (1_usize << power) + 1;
    let seeds = lab.seeds(lab.pick(SEEDS, 2));
    let mut table = Table::new(["amplitude", "edge_length", "estimator", "d", "mean_measured"]);
    let mut panels = [Vec::new(), Vec::new()];
    for amplitude in lab.readings::<Amplitude>() {
        for edge_length in lab.readings::<EdgeLength>() {
            let measured = lab.each(&seeds, |seed| -> Result<[Vec<f64>; 2]> {
                let mut by_estimator = [Vec::new(), Vec::new()];
                for d in ASKED {
                    let heights = heights(&square(d, (amplitude, edge_length), gain, Seed(*seed))?, power)?;
                    for (row, estimator) in by_estimator.iter_mut().zip(&ESTIMATORS) {
                        // A surface of which nothing can be told is smooth.
                        row.push((estimator.measure)(&heights, side).unwrap_or(2.0));
                    }
                }
                Ok(by_estimator)
            });
            let measured = measured.into_iter().collect::<Result<Vec<_>>>()?;
            lab.reading(amplitude);
            lab.reading(edge_length);
            for (k, claim) in [&DETAIL, &SPECTRAL].into_iter().enumerate() {
                for (seed, rows) in seeds.iter().zip(&measured) {
                    lab.found_with(claim, *seed, smallest_rise(&rows[k]));
                }
                let mean =
                    |d: usize| measured.iter().map(|rows| rows[k][d]).sum::<f64>() / measured.len() as f64;
                let points: Vec<(f64, f64)> =
                    ASKED.iter().enumerate().map(|(d, asked)| (*asked, mean(d))).collect();
                for (asked, mean) in &points {
                    table.row([
                        amplitude.name().into(),
                        edge_length.name().into(),
                        ESTIMATORS[k].name.into(),
                        (*asked).into(),
                        (*mean).into(),
                    ]);
                }
                let name = format!("{}, {} edge", amplitude.name(), edge_length.name());
                panels[k].push(Series::new(name, Draw::Joined, points));
            }
        }
    }
    lab.keep("order", "D measured under every reading, means over the seeds", table)?;
    let plots = panels.into_iter().zip(&ESTIMATORS).map(|(mut series, estimator)| {
        series.insert(0, Series::new("as asked", Draw::Ghost, ASKED.map(|d| (d, d)).to_vec()));
        Plot {
            title: format!("{} estimator", estimator.name),
            x: Axis::within("D asked", 2.0, 3.0),
            y: Axis::within("D measured", 0.0, 3.0),
            series,
            bands: Vec::new(),
        }
    });
    lab.keep(
        "dimensions",
        "D measured against D asked under every reading of Eq. (1): where the line falls, a greater D is smoother",
        Panels {
            title: "What each reading of Eq. (1) makes of D".to_owned(),
            columns: 2,
            plots: plots.collect(),
        },
    )
}
