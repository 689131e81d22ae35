//! Figure 3 (Fig. 5 in the text): what the threshold does to the growth.

use snowglobe::frost::{Frost, Inflow, Painter, Parameters, measure, titled};
use snowglobe::image::Picture;
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic,
    Table, average, maybe, smallest_rise, standard_error,
};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;

use super::setup::{Readings, Reconstruction, START, Setup};

pub const FIGURE_3: Experiment = Experiment {
    id: "figure-3",
    title: "Figure 3: growth at thresholds 0, 0.4 and 0.8",
    source: "Fig. 3, §4",
    says: "With beta 0.35 and gamma 0.005, frames 20, 40 and 80: at r_th 0 the crystal grows evenly as Reiter's does; \
           the larger the threshold, the less even and the more complex the growth.",
    claims: &[&SIX_FOLD, &GROWS, &UNEVEN, &RAGGED, &DIMENSION],
    run,
    mutant: Mutant {
        changes: "r_th of the first column",
        to: 0.4,
        why: "a crystal with randomness in it is not six-fold",
        turns_red: &["amano/figure-3/six-fold"],
    },
};

static SIX_FOLD: Claim = Claim {
    id: "amano/figure-3/six-fold",
    source: "Fig. 3, first column; §4",
    says: "at threshold 0 growth is even in all directions",
    expect: Expect::AtMost(0.0),
    statistic: Statistic::Each,
    reason: "the model has the six turns and mirrors of the lattice exactly, so the ice must have them to the cell, in \
             each of the three frames",
    known: &[],
};
static GROWS: Claim = Claim {
    id: "amano/figure-3/grows",
    source: "Fig. 3, first column",
    says: "at threshold 0 ice has spread beyond the start's neighbours by frame 20, and on to frame 80",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "ice in frames 0, 20, 40 and 80, less the seven cells of start and neighbours in frame 20: each must exceed \
             the one before",
    known: &[
        Known {
            reading: "inflow=as-printed",
            evidence: "gamma alone takes (1 - 0.35)/0.005 = 130 steps, fourteen frames of nine, for each further layer \
                       of cells: none beyond the start's neighbours by frame 20",
        },
        FULL,
        SLOW_1,
        SLOW_2,
        SLOW_3,
    ],
};
static UNEVEN: Claim = Claim {
    id: "amano/figure-3/uneven",
    source: "§4",
    says: "the larger the threshold, the less even the growth",
    expect: Expect::Rises,
    statistic: Statistic::Mean,
    reason: "asymmetry of the ice in frame 80 (share of the union of its twelve images that is not common to all), \
             from threshold to threshold; the smallest rise is above 0 in the mean over seeds",
    known: NOT_THE_FIGURE,
};
static RAGGED: Claim = Claim {
    id: "amano/figure-3/complex-boundary",
    source: "§3.2",
    says: "a larger threshold makes more complex growth",
    expect: Expect::Rises,
    statistic: Statistic::Mean,
    reason: "boundary length over the root of the area, when 30 % of the cells are ice: at equal size, since any \
             dendrite's boundary grows as it does",
    known: COMPACT,
};
static DIMENSION: Claim = Claim {
    id: "amano/figure-3/complex-dimension",
    source: "§3.2",
    says: "a larger threshold makes more complex growth",
    expect: Expect::Rises,
    statistic: Statistic::Mean,
    reason: "box dimension of the boundary at equal size, as above: a second measure of complexity",
    known: NO_DIMENSION,
};

const FULL: Known = Known {
    reading: "inflow=only-ice-hidden;reconstruction=hexagon-1387",
    evidence: "nine steps in a frame have filled the sketch, but for a cell at most, by frame 20",
};
const MASS: &str =
    "with one step in a frame ice has only just reached the start's neighbours by frame 20 (measures.csv)";
const SLOW_1: Known = Known { reading: "inflow=reiter-gated;reconstruction=disc-5239", evidence: MASS };
const SLOW_2: Known = Known { reading: "inflow=passive-is-vapour;reconstruction=disc-5239", evidence: MASS };
const SLOW_3: Known = Known { reading: "inflow=passive-diffuses;reconstruction=disc-5239", evidence: MASS };

const STARVED: &str = "the larger the threshold, the less ice there is: asymmetry does not rise from 0.4 to 0.8, and 30 % of the \
                       cells is not reached (measures.csv)";
const AS_PRINTED: Known = Known { reading: "inflow=as-printed", evidence: STARVED };
const DIFFUSES: Known = Known { reading: "inflow=passive-diffuses", evidence: STARVED };
const VAPOUR: Known = Known {
    reading: "inflow=passive-is-vapour",
    evidence: "passive neighbours lose their vapour: at 0.8 hardly a cell freezes",
};

/// Readings whose growth is not that of the figure.
const NOT_THE_FIGURE: &[Known] = &[FULL, SLOW_1, AS_PRINTED, VAPOUR, DIFFUSES];
/// The same for complexity, of which one more reading has none.
const COMPACT: &[Known] = &[
    Known {
        reading: "inflow=only-ice-hidden;reconstruction=disc-5239",
        evidence: "it grows compact hexagons, whose boundary shrinks a little with the threshold (measures.csv)",
    },
    SLOW_1,
    AS_PRINTED,
    VAPOUR,
    DIFFUSES,
];
/// And for dimension.
const NO_DIMENSION: &[Known] = &[
    COMPACT[0],
    Known {
        reading: "inflow=only-ice-hidden;reconstruction=hexagon-1387",
        evidence: "a compact shape of a third of 1387 cells is too small for three sizes of box",
    },
    SLOW_1,
    AS_PRINTED,
    VAPOUR,
    DIFFUSES,
];

const FRAMES: [u64; 3] = [20, 40, 80];
const THRESHOLDS: [f64; 3] = [0.0, 0.4, 0.8];
const SHARE: f64 = 0.3;
const SEEDS: u64 = 20;

/// What one run shows.
#[derive(Clone, Default)]
struct Growth {
    ice: [f64; 3],
    asymmetry: [f64; 3],
    raggedness: Option<f64>,
    dimension: Option<f64>,
}

fn run(lab: &mut Lab) -> Result<()> {
    let beta = lab.printed("beta", 0.35, "§4");
    let gamma = lab.printed("gamma", 0.005, "§4");
    let first = lab.printed("r_th of the first column", THRESHOLDS[0], "§4");
    let thresholds = [first, THRESHOLDS[1], THRESHOLDS[2]];
    let mut table = Table::new([
        "reconstruction",
        "inflow",
        "threshold",
        "ice_20",
        "ice_40",
        "ice_80",
        "asymmetry_20",
        "asymmetry_40",
        "asymmetry_80",
        "boundary_over_root_area",
        "box_dimension",
        "seeds",
    ]);
    let mut shown: Vec<[Vec<f64>; 3]> = Vec::new();
    for reconstruction in lab.readings::<Reconstruction>() {
        for inflow in lab.readings::<Inflow>() {
            let readings = Readings { inflow, ..Readings::DEFAULT };
            let setup = Setup::new(lab, reconstruction, gamma, 0.0, readings);
            let seeds = lab.seeds(SEEDS);
            let runs: Vec<(u64, Parameters)> = seeds
                .iter()
                .flat_map(|seed| thresholds.map(|t| (*seed, Parameters { threshold: t, ..setup.at(beta) })))
                .collect();
            let grown = lab.each(&runs, |(seed, parameters)| grow(&setup, *parameters, *seed));
            let grown = grown.into_iter().collect::<Result<Vec<_>>>()?;
            readings.tell(lab, reconstruction);
            judge(lab, &seeds, &grown);
            for (k, threshold) in thresholds.iter().enumerate() {
                let of: Vec<&Growth> = grown.iter().skip(k).step_by(3).collect();
                let mean = |pick: &dyn Fn(&Growth) -> Option<f64>| {
                    of.iter().map(|g| pick(g)).collect::<Option<Vec<f64>>>().map(|values| average(&values))
                };
                table.row([
                    reconstruction.name().into(),
                    inflow.name().into(),
                    threshold.into(),
                    maybe(mean(&|g| Some(g.ice[0]))),
                    maybe(mean(&|g| Some(g.ice[1]))),
                    maybe(mean(&|g| Some(g.ice[2]))),
                    maybe(mean(&|g| Some(g.asymmetry[0]))),
                    maybe(mean(&|g| Some(g.asymmetry[1]))),
                    maybe(mean(&|g| Some(g.asymmetry[2]))),
                    maybe(mean(&|g| g.raggedness)),
                    maybe(mean(&|g| g.dimension)),
                    of.len().into(),
                ]);
                if readings == Readings::DEFAULT && reconstruction == Reconstruction::DEFAULT {
                    shown.push([0, 1, 2].map(|f| of.iter().map(|g| g.asymmetry[f]).collect()));
                }
            }
            if readings == Readings::DEFAULT && reconstruction == Reconstruction::DEFAULT {
                pictures(lab, &setup, beta)?;
            }
        }
    }
    lab.keep("measures", "Size, asymmetry and complexity under every reading, mean over the seeds", table)?;
    lab.keep(
        "asymmetry",
        "Asymmetry of the ice, mean over seeds with bars of two standard errors",
        plot(&shown),
    )
}

fn grow(setup: &Setup, parameters: Parameters, seed: u64) -> Result<Growth> {
    let mut frost = Frost::new(&setup.region, &START, parameters, Seed(seed))?;
    let wanted = (SHARE * setup.region.len() as f64) as usize;
    let mut growth = Growth::default();
    let mut measured = false;
    // Twice the last frame is enough for a reading that grows at all.
    for frame in 1..=2 * FRAMES[2] {
        frost.frame();
        if let Some(k) = FRAMES.iter().position(|f| *f == frame) {
            growth.ice[k] = frost.ice() as f64;
            growth.asymmetry[k] = measure::asymmetry(&frost.ice_cells(), START[0]);
        }
        if !measured && frost.ice() >= wanted {
            measured = true;
            growth.raggedness = Some(measure::raggedness(&frost.ice_cells()));
            growth.dimension = measure::box_dimension(&frost.ice_cells());
        }
        if measured && frame >= FRAMES[2] {
            break;
        }
    }
    Ok(growth)
}

/// Findings from three runs (one for each threshold) of every seed.
fn judge(lab: &mut Lab, seeds: &[u64], grown: &[Growth]) {
    let even = &grown[0];
    lab.found(&SIX_FOLD, even.asymmetry.iter().copied().fold(0.0, f64::max));
    lab.found(&GROWS, smallest_rise(&[0.0, even.ice[0] - 7.0, even.ice[1], even.ice[2]]));
    for (seed, of_seed) in seeds.iter().zip(grown.chunks(3)) {
        let rise = |pick: &dyn Fn(&Growth) -> Option<f64>| {
            of_seed.iter().map(pick).collect::<Option<Vec<f64>>>().and_then(|series| smallest_rise(&series))
        };
        lab.found_with(&UNEVEN, *seed, rise(&|g| Some(g.asymmetry[2])));
        lab.found_with(&RAGGED, *seed, rise(&|g| g.raggedness));
        lab.found_with(&DIMENSION, *seed, rise(&|g| g.dimension));
    }
}

fn pictures(lab: &mut Lab, setup: &Setup, beta: f64) -> Result<()> {
    let painter = Painter::new(&setup.region, 360, FRAMES[2], beta)?;
    let last = lab.pick(FRAMES[2], FRAMES[0]);
    let mut panel = Vec::new();
    for threshold in THRESHOLDS {
        let parameters = Parameters { threshold, ..setup.at(beta) };
        let mut frost = Frost::new(&setup.region, &START, parameters, lab.seed())?;
        let mut frames = vec![titled(&painter.draw_ice(&frost), &format!("r_th {threshold}, frame 0"))?];
        for frame in 1..=last {
            frost.frame();
            let title = format!("r_th {threshold}, frame {frame}");
            if FRAMES.contains(&frame) {
                panel.push(titled(&painter.draw(&frost), &title)?);
            }
            frames.push(titled(&painter.draw_ice(&frost), &title)?);
        }
        lab.keep(
            &format!("growth-{threshold}"),
            &format!("Growth at threshold {threshold}, 24 frames a second"),
            Artifact::Animation { frames, frames_per_second: 24 },
        )?;
    }
    let columns = panel.len() / THRESHOLDS.len();
    let panel: Vec<&Picture> = panel.iter().collect();
    lab.keep(
        "panel",
        "Fig. 3 re-run: thresholds 0, 0.4 and 0.8 from top to bottom, frames 20, 40 and 80 from left to right; ice is the \
         lighter the later it froze, over the vapour that is left",
        Picture::grid(&panel, columns, 8, snowglobe::frost::GROUND)?,
    )
}

fn plot(shown: &[[Vec<f64>; 3]]) -> Plot {
    let series = shown.iter().zip(THRESHOLDS).map(|(frames, threshold)| {
        let points = FRAMES.iter().zip(frames).map(|(frame, values)| (*frame as f64, average(values)));
        let mut series = Series::new(format!("r_th {threshold}"), Draw::Joined, points);
        series.errors = frames.iter().map(|values| 2.0 * standard_error(values)).collect();
        series
    });
    Plot {
        title: "How uneven the ice is".to_owned(),
        x: Axis::within("frame", 0.0, 100.0),
        y: Axis::within("asymmetry (0 even, 1 nothing in common)", -0.02, 1.02),
        series: series.collect(),
        bands: Vec::new(),
    }
}
