//! How much vapour clouds need to grow.

use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};

use super::setup::{MENDED, begun, vapour_and_active};

pub const THRESHOLD: Experiment = Experiment {
    id: "threshold",
    title: "How much vapour clouds need",
    source: "§2.1, §2.3",
    says: "Probabilities are to be chosen. Growth over a lattice is percolation: below some share of vapour clouds stay where they \
           begin, above it they fill it.",
    claims: &[&BELOW, &ABOVE, &SHARP],
    run,
    mutant: Mutant {
        changes: "probability of activation",
        to: 0.0,
        why: "nothing grows from nothing",
        turns_red: &["dobashi/threshold/above"],
    },
};

static BELOW: Claim = Claim {
    id: "dobashi/threshold/below",
    source: "Eq. (1), percolation",
    says: "with little vapour clouds stay small",
    expect: Expect::AtMost(0.1),
    statistic: Statistic::Each,
    reason: "share of the vapour that turns into cloud, probability 0.06: of eleven neighbours fewer than one has vapour, so a \
             branching process dies out",
    known: &[],
};
static ABOVE: Claim = Claim {
    id: "dobashi/threshold/above",
    source: "Eq. (1), percolation",
    says: "with much vapour clouds fill it",
    expect: Expect::AtLeast(0.9),
    statistic: Statistic::Each,
    reason: "share of the vapour that turns into cloud, probability 0.5: five of eleven neighbours have vapour",
    known: &[],
};
static SHARP: Claim = Claim {
    id: "dobashi/threshold/sharp",
    source: "Eq. (1), percolation",
    says: "between the two lies a threshold",
    expect: Expect::Between(0.0, 0.15),
    statistic: Statistic::Each,
    reason: "how much the probability of vapour must rise for the share that turns into cloud to go from a fifth to four fifths: \
             less than a third of the range looked at",
    known: &[],
};

const SEEDS: u64 = 4;

fn run(lab: &mut Lab) -> Result<()> {
    let active = lab.assume("probability of activation", 0.0002, "not given; few, so that growth decides");
    let counts = lab.pick([64, 64, 64], [16, 16, 16]);
    let seeds = lab.seeds(SEEDS);
    let chances: Vec<f64> = (3..=25).map(|k| 0.02 * f64::from(k)).collect();
    let mut table = Table::new(["p_hum", "seed", "share_of_vapour", "steps"]);
    let rows = lab.each(&seeds, |seed| -> Result<Vec<(f64, u64)>> {
        chances.iter().map(|vapour| share(counts, *seed, [*vapour, active])).collect()
    });
    let mut series = Vec::new();
    let mut halves = Table::new(["seed", "p_hum_of_half"]);
    for (seed, row) in seeds.iter().zip(rows) {
        let row = row?;
        for (vapour, (share, steps)) in chances.iter().zip(&row) {
            table.row([(*vapour).into(), (*seed).into(), (*share).into(), (*steps).into()]);
        }
        let points: Vec<(f64, f64)> = chances.iter().zip(&row).map(|(p, (share, _))| (*p, *share)).collect();
        lab.found_with(&BELOW, *seed, points[0].1);
        lab.found_with(&ABOVE, *seed, points[points.len() - 1].1);
        let both = reaches(&points, 0.8).zip(reaches(&points, 0.2));
        lab.found_with(&SHARP, *seed, both.map(|(high, low)| high - low));
        halves.row([(*seed).into(), snowglobe::lab::maybe(reaches(&points, 0.5))]);
        series.push(Series::new(format!("seed {seed}"), Draw::Joined, points));
    }
    lab.keep("shares", "How much of the vapour turns into cloud", table)?;
    lab.keep("threshold", "Where half of it does", halves)?;
    lab.keep(
        "percolation",
        "Growth has a threshold in the probability of vapour",
        Plot {
            title: "How much vapour do clouds need?".to_owned(),
            x: Axis::within("probability of vapour", 0.0, 0.5),
            y: Axis::within("share of it that turns into cloud", 0.0, 1.0),
            series,
            bands: Vec::new(),
        },
    )
}

/// The share of vapour that turns into cloud until nothing changes, and the steps that takes.
fn share(counts: [usize; 3], seed: u64, chances: [f64; 2]) -> Result<(f64, u64)> {
    let mut clouds = begun(counts, MENDED, seed, chances)?;
    let (vapour, active) = vapour_and_active(&clouds);
    let all = vapour.iter().zip(&active).filter(|(hum, act)| **hum == 1 || **act == 1).count() as f64;
    let mut before = -1.0;
    while clouds.cover() > before || clouds.steps() < 3 {
        before = clouds.cover();
        clouds.step();
    }
    Ok((clouds.cover() * vapour.len() as f64 / all.max(1.0), clouds.steps()))
}

/// Where a rising line first reaches a height.
fn reaches(points: &[(f64, f64)], height: f64) -> Option<f64> {
    let pair = points.windows(2).find(|pair| pair[0].1 < height && pair[1].1 >= height)?;
    let share = (height - pair[0].1) / (pair[1].1 - pair[0].1);
    Some(pair[0].0 + share * (pair[1].0 - pair[0].0))
}
