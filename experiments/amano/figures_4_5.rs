//! Figures 4 and 5: the growth at the first and at the last step of each descent, side by side.

use snowglobe::frost::{Frost, GROUND, Painter, titled};
use snowglobe::image::Picture;
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, average,
};
use snowglobe::rng::Seed;

use super::setup::{Reconstruction, START, Setup};
use super::{table_1, table_2};

pub const FIGURE_4: Experiment = Experiment {
    id: "figure-4",
    title: "Figure 4: growth at steps 0 and 3 of Table 1",
    source: "Fig. 4, §4",
    says: "At r_th 0, the film of the initial value found in step 3 ends by the target frame 130; that of step 0 is \
           still growing.",
    claims: &[&FOUR.ended, &FOUR.growing, &FOUR.ahead],
    run: |lab| run(lab, &FOUR),
    mutant: Mutant {
        changes: "beta of step 3",
        to: 0.25,
        why: "without the optimisation nothing is gained",
        turns_red: &["amano/figure-4/ended", "amano/figure-4/ahead"],
    },
};

pub const FIGURE_5: Experiment = Experiment {
    id: "figure-5",
    title: "Figure 5: growth at steps 0 and 3 of Table 2",
    source: "Fig. 5, §4",
    says: "The same at r_th 0.8, where growth is random.",
    claims: &[&FIVE.ended, &FIVE.growing, &FIVE.ahead],
    run: |lab| run(lab, &FIVE),
    mutant: Mutant {
        changes: "beta of step 3",
        to: 0.25,
        why: "without the optimisation nothing is gained",
        turns_red: &["amano/figure-5/ended", "amano/figure-5/ahead"],
    },
};

/// One of the two figures.
struct Figure {
    threshold: f64,
    printed: [(f64, f64); 4],
    table: &'static str,
    seeds: u64,
    ended: Claim,
    growing: Claim,
    ahead: Claim,
}

static FOUR: Figure = Figure {
    threshold: 0.0,
    printed: table_1::PRINTED,
    table: "Table 1",
    seeds: 1,
    ended: ended("amano/figure-4/ended", "Fig. 4, step 3"),
    growing: growing("amano/figure-4/growing", "Fig. 4, step 0"),
    ahead: ahead("amano/figure-4/ahead", "Fig. 4"),
};

static FIVE: Figure = Figure {
    threshold: 0.8,
    printed: table_2::PRINTED,
    table: "Table 2",
    seeds: 20,
    ended: ended("amano/figure-5/ended", "Fig. 5, step 3"),
    growing: growing("amano/figure-5/growing", "Fig. 5, step 0"),
    ahead: ahead("amano/figure-5/ahead", "Fig. 5"),
};

const fn ended(id: &'static str, source: &'static str) -> Claim {
    Claim {
        id,
        source,
        says: "with the optimised initial value, 90 % is ice by frame 134",
        expect: Expect::AtLeast(0.9),
        statistic: Statistic::Mean,
        reason: "the share of ice in the last frame within the tolerance of 4 around the target",
        known: &[],
    }
}

const fn growing(id: &'static str, source: &'static str) -> Claim {
    Claim {
        id,
        source,
        says: "with the first initial value, less than 90 % is ice in frame 134",
        expect: Expect::AtMost(0.899_999),
        statistic: Statistic::Mean,
        reason: "the same share at step 0; its film is printed to end some 30 frames after the target",
        known: &[],
    }
}

const fn ahead(id: &'static str, source: &'static str) -> Claim {
    Claim {
        id,
        source,
        says: "the optimised film is ahead of the first one in frame 80",
        expect: Expect::Rises,
        statistic: Statistic::Mean,
        reason: "the share of ice at step 0 and at step 3; the sign of the effect, seed by seed",
        known: &[],
    }
}

/// Frames that are drawn; the figures do not say which they show.
const SHOWN: [u64; 4] = [30, 60, 90, 130];
const MIDDLE: usize = 80;

fn run(lab: &mut Lab, figure: &'static Figure) -> Result<()> {
    let threshold = lab.printed("r_th", figure.threshold, figure.table);
    let first = lab.printed("beta of step 0", figure.printed[0].0, figure.table);
    let last = lab.printed("beta of step 3", figure.printed[3].0, figure.table);
    let end = lab.printed("target", 130.0, "§4") + lab.printed("tolerance", 4.0, "§4");
    for reconstruction in lab.readings::<Reconstruction>() {
        let readings = reconstruction.readings();
        let setup = Setup::of_tables(lab, reconstruction, threshold, readings);
        readings.tell(lab, reconstruction);
        let seeds = lab.seeds(figure.seeds);
        let runs: Vec<(u64, f64)> = seeds.iter().flat_map(|seed| [(*seed, first), (*seed, last)]).collect();
        let shares = lab.each(&runs, |(seed, beta)| shares(&setup, *beta, *seed, end as u64));
        let shares = shares.into_iter().collect::<Result<Vec<_>>>()?;
        for (seed, pair) in seeds.iter().zip(shares.chunks(2)) {
            let (slow, fast) = (&pair[0], &pair[1]);
            lab.found_with(&figure.growing, *seed, slow[end as usize]);
            lab.found_with(&figure.ended, *seed, fast[end as usize]);
            lab.found_with(&figure.ahead, *seed, fast[MIDDLE] - slow[MIDDLE]);
        }
        if reconstruction == Reconstruction::DEFAULT {
            pictures(lab, &setup, [first, last])?;
            lab.keep(
                "share",
                "Share of ice against the frame, mean over the seeds",
                plot(&shares, [first, last]),
            )?;
        }
    }
    Ok(())
}

/// The share of ice in frames 0 to `last`.
fn shares(setup: &Setup, beta: f64, seed: u64, last: u64) -> Result<Vec<f64>> {
    let counts = snowglobe::frost::growth(&setup.region, &START, setup.at(beta), Seed(seed), last)?;
    Ok(counts.iter().map(|ice| *ice as f64 / setup.region.len() as f64).collect())
}

fn pictures(lab: &mut Lab, setup: &Setup, betas: [f64; 2]) -> Result<()> {
    let last = lab.pick(SHOWN[3], SHOWN[0]);
    let mut stills: Vec<Picture> = Vec::new();
    let mut films: Vec<Vec<Picture>> = Vec::new();
    for (step, beta) in [(0, betas[0]), (3, betas[1])] {
        let painter = Painter::new(&setup.region, 300, SHOWN[3], beta)?;
        let mut frost = Frost::new(&setup.region, &START, setup.at(beta), lab.seed())?;
        let mut film = Vec::new();
        for frame in 0..=last {
            if frame > 0 {
                frost.frame();
            }
            let share = 100.0 * frost.ice() as f64 / setup.region.len() as f64;
            let title = format!("step {step}, frame {frame}, {share:.0} % ice");
            film.push(titled(&painter.draw_ice(&frost), &title)?);
            if SHOWN.contains(&frame) {
                stills.push(titled(&painter.draw(&frost), &title)?);
            }
        }
        films.push(film);
    }
    let columns = stills.len() / 2;
    let stills: Vec<&Picture> = stills.iter().collect();
    lab.keep(
        "panel",
        "The growth from the first initial value (above) and from the optimised one (below), in frames 30, 60, 90 and \
         130 (the figure does not say which frames it shows)",
        Picture::grid(&stills, columns, 8, GROUND)?,
    )?;
    let frames = films[0]
        .iter()
        .zip(&films[1])
        .map(|(slow, fast)| Picture::side_by_side(&[slow, fast], 8, GROUND))
        .collect::<std::result::Result<Vec<_>, _>>()?;
    lab.keep(
        "growth",
        "Both films side by side to frame 130, 24 frames a second",
        Artifact::Animation { frames, frames_per_second: 24 },
    )
}

fn plot(shares: &[Vec<f64>], betas: [f64; 2]) -> Plot {
    let series = (0..2).map(|which| {
        let of: Vec<&Vec<f64>> = shares.iter().skip(which).step_by(2).collect();
        let mean = |frame: usize| average(&of.iter().map(|run| run[frame]).collect::<Vec<_>>());
        let points = (0..of[0].len()).map(|frame| (frame as f64, mean(frame)));
        Series::new(format!("step {}: β = {}", 3 * which, betas[which]), Draw::Line, points)
    });
    Plot {
        title: "Share of the cells that are ice".to_owned(),
        x: Axis::within("frame", 0.0, 135.0),
        y: Axis::within("share of cells", 0.0, 1.0),
        series: series.collect(),
        bands: vec![("90 % or more".to_owned(), 0.9, 1.0)],
    }
}
