//! Control by representative points (§2.3).

use snowglobe::automaton_cloud::{Chance, Injection, Interpolation, Packed, Point, PointError, Points};
use snowglobe::lab::{
    Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};
use snowglobe::rng::Seed;

use super::setup::{MENDED, broken};

pub const CONTROL: Experiment = Experiment {
    id: "control",
    title: "Control by points",
    source: "§2.3",
    says: "Where vapour is given a greater probability there is more cloud; a few points are enough to say where; by moving them \
           the clouds are moved.",
    claims: &[&WET, &DRAGGED],
    run,
    mutant: Mutant {
        changes: "probability of vapour at a wet point",
        to: 0.0005,
        why: "a point as dry as the others draws no cloud",
        turns_red: &["dobashi/control/wet"],
    },
};

static WET: Claim = Claim {
    id: "dobashi/control/wet",
    source: "§2.3",
    says: "more clouds come where the probability of vapour is set higher",
    expect: Expect::AtLeast(4.0),
    statistic: Statistic::Each,
    reason: "cover of the third around the wet point over that of the third around the dry one, whichever way probabilities are \
             interpolated; a fourfold cover is seen at a glance",
    known: &[],
};
static DRAGGED: Claim = Claim {
    id: "dobashi/control/dragged",
    source: "§2.3",
    says: "points that move in time move the clouds",
    expect: Expect::Between(0.99, 1.0),
    statistic: Statistic::Each,
    reason: "correlation of the place of the wet point with the centre of all cloud, after a quarter of the way",
    known: &[],
};

const SEEDS: u64 = 4;
const COUNTS: [usize; 3] = [96, 64, 32];
const KNOTS: usize = 4;
const WAYS: [(&str, Interpolation); 2] = [
    ("inverse distance", Interpolation::InverseDistance),
    ("Gaussian of 16 cells", Interpolation::Gaussian(16.0)),
];

fn run(lab: &mut Lab) -> Result<()> {
    let vapour = lab.assume("probability of vapour at a wet point", 0.03, "not given; in each step");
    let dry = lab.assume("probability of vapour at a dry point", 0.0005, "not given; in each step");
    let active = lab.assume("probability of activation", 0.001, "not given; in each step");
    let vanishing =
        lab.assume("probability of extinction", 0.02, "not given; in each step, so that clouds do not stay");
    let steps = lab.pick(240, 40);
    lab.assume_that(
        "points that stay",
        "a dry one every 16 cells, a Gaussian of 8",
        "few points, and between them none but the nearest counts",
    );
    let seeds = lab.seeds(SEEDS);
    let point = |x: f64, vapour: f64| Point { place: [x, 31.5, 15.5], chances: [vapour, active, vanishing] };
    let mut table = Table::new(["interpolation", "knots_every", "seed", "cover_wet", "cover_dry", "ratio"]);
    let mut ratios = vec![f64::INFINITY; seeds.len()];
    for (name, way) in WAYS {
        for knots in [1, KNOTS, 2 * KNOTS] {
            let points = Points::still(vec![point(16.0, vapour), point(80.0, dry)], way, knots);
            let covers = lab.each(&seeds, |seed| film(*seed, points.clone(), steps));
            for ((seed, covers), ratio) in seeds.iter().zip(covers).zip(&mut ratios) {
                let covers = covers?;
                let half = &covers[covers.len() / 2..];
                let mean = |from: usize, to: usize| {
                    half.iter().map(|column| column[from..to].iter().sum::<f64>()).sum::<f64>()
                        / half.len() as f64
                };
                let (wet, dry) = (mean(0, 32), mean(64, 96));
                *ratio = ratio.min(wet / dry.max(1.0));
                let cells = (32 * COUNTS[1] * COUNTS[2]) as f64;
                table.row([
                    name.into(),
                    knots.into(),
                    (*seed).into(),
                    (wet / cells).into(),
                    (dry / cells).into(),
                    (wet / dry.max(1.0)).into(),
                ]);
            }
        }
    }
    for (seed, ratio) in seeds.iter().zip(ratios) {
        lab.found_with(&WET, *seed, ratio);
    }
    lab.keep(
        "wet-and-dry",
        "Cover around a wet point and around a dry one, by the way of interpolation",
        table,
    )?;

    // One wet point on its way from left to right, past dry ones that stay.
    let row = |step: f64, x: f64| {
        let stay = (0..7).map(move |k| (step, point(16.0 * f64::from(k), dry)));
        std::iter::once((step, point(x, vapour))).chain(stay)
    };
    let rows: Vec<(f64, Point)> = row(0.0, 16.0).chain(row(steps as f64, 80.0)).collect();
    let points = Points::moving(&rows, Interpolation::Gaussian(8.0), KNOTS)
        .map_err(|cause: PointError| Error::broken(cause.to_string()))?;
    let films = lab.each(&seeds, |seed| film(*seed, points.clone(), steps));
    let mut series = Vec::new();
    let wet = |t: usize| 16.0 + 64.0 * t as f64 / steps as f64;
    series.push(Series::new("wet point", Draw::Ghost, vec![(0.0, wet(0)), (steps as f64, wet(steps))]));
    for (seed, film) in seeds.iter().zip(films) {
        let centres: Vec<(f64, f64)> = film?
            .iter()
            .enumerate()
            .filter_map(|(t, column)| {
                let all: f64 = column.iter().sum();
                let moment: f64 = column.iter().enumerate().map(|(x, cloud)| x as f64 * cloud).sum();
                (all > 0.0).then(|| (t as f64, moment / all))
            })
            .collect();
        let later: Vec<(f64, f64)> = centres
            .iter()
            .filter(|(t, _)| *t >= 0.25 * steps as f64)
            .map(|(t, centre)| (wet(*t as usize), *centre))
            .collect();
        lab.found_with(&DRAGGED, *seed, correlation(&later));
        series.push(Series::new(format!("cloud, seed {seed}"), Draw::Line, centres));
    }
    lab.keep(
        "dragged",
        "The centre of all cloud, where the wet point moves from left to right",
        Plot {
            title: "A point moves, and its cloud with it".to_owned(),
            x: Axis::of("step"),
            y: Axis::within("x (cells)", 0.0, 96.0),
            series,
            bands: Vec::new(),
        },
    )
}

/// Cells with cloud at each x, at every step.
fn film(seed: u64, points: Points, steps: usize) -> Result<Vec<Vec<f64>>> {
    let injection = Injection { seed: Seed(seed), chance: Chance::Points(points) };
    let mut clouds = Packed::new(COUNTS, MENDED).map_err(broken)?;
    clouds.inject(&injection);
    let mut all = Vec::new();
    for _ in 0..steps {
        clouds.step();
        clouds.inject(&injection);
        let mut column = vec![0.0; COUNTS[0]];
        for (cell, cld) in clouds.cld().iter().enumerate() {
            column[cell % COUNTS[0]] += f64::from(*cld);
        }
        all.push(column);
    }
    Ok(all)
}

/// Pearson's correlation; none of fewer than two points, or where one of both does not vary.
fn correlation(points: &[(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for point in points {
        let (dx, dy) = (point.0 - x, point.1 - y);
        (xx, yy, xy) = (xx + dx * dx, yy + dy * dy, xy + dx * dy);
    }
    (xx > 0.0 && yy > 0.0).then(|| xy / libm::sqrt(xx * yy))
}
