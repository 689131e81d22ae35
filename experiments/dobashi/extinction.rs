//! Extinction (§2.2): cloud that has grown is set to vanish once.

use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};

use super::setup::{MENDED, begun, distances, uniform};
use snowglobe::automaton_cloud::Field;

pub const EXTINCTION: Experiment = Experiment {
    id: "extinction",
    title: "Extinction",
    source: "§2.2, Eq. (4) and (5)",
    says: "ext spreads through cells with cloud and takes it away.",
    claims: &[&GREW, &VANISHES, &SURVIVORS],
    run,
    mutant: Mutant {
        changes: "probability of extinction",
        to: 0.0,
        why: "nothing vanishes of itself",
        turns_red: &["dobashi/extinction/vanishes"],
    },
};

static GREW: Claim = Claim {
    id: "dobashi/extinction/grew",
    source: "§2.1",
    says: "there is cloud before",
    expect: Expect::AtLeast(0.2),
    statistic: Statistic::Each,
    reason: "cover before extinction; of half the cells with vapour, most of which connect",
    known: &[],
};
static VANISHES: Claim = Claim {
    id: "dobashi/extinction/vanishes",
    source: "§2.2",
    says: "cloud vanishes after it",
    expect: Expect::AtMost(0.05),
    statistic: Statistic::Each,
    reason: "cover after over cover before, ext set once in one of a thousand cells: what is left is in pockets of their own",
    known: &[],
};
static SURVIVORS: Claim = Claim {
    id: "dobashi/extinction/survivors",
    source: "Eq. (4) and (5)",
    says: "ext spreads over cells that have cloud, and over no others",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "cells whose cloud after all steps is not what a search from the cells set, through cloud, leaves: a theorem of the \
             mended rules once growth is over, so none",
    known: &[],
};

const SEEDS: u64 = 4;

fn run(lab: &mut Lab) -> Result<()> {
    let vapour = lab.assume("probability of vapour", 0.5, "as for growth");
    let active = lab.assume("probability of activation", 0.0005, "as for growth");
    let vanishing = lab.assume("probability of extinction", 0.001, "not given; a few places");
    let steps =
        lab.assume("steps", 60.0, "growth, and then extinction, until nothing changes any more") as usize;
    let counts = lab.pick([64, 64, 32], [16, 16, 8]);
    let seeds = lab.seeds(SEEDS);
    let mut table = Table::new(["seed", "cover_before", "cover_after", "cells_not_as_searched"]);
    let runs = lab.each(&seeds, |seed| -> Result<(Vec<(f64, f64)>, u64)> {
        let mut clouds = begun(counts, MENDED, *seed, [vapour, active])?;
        let mut cover = vec![(0.0, 0.0)];
        for t in 1..=steps {
            clouds.step();
            cover.push((t as f64, 100.0 * clouds.cover()));
        }
        clouds.inject(&uniform(*seed, [0.0, 0.0, vanishing]));
        let (before, set) = (clouds.cld(), clouds.field(Field::Ext));
        for t in steps + 1..=2 * steps {
            clouds.step();
            cover.push((t as f64, 100.0 * clouds.cover()));
        }
        let reached = distances(counts, &set, |cell| before[cell] == 1);
        let left = clouds.cld();
        let known = |cell: usize| u8::from(before[cell] == 1 && reached[cell].is_none());
        let other = (0..left.len()).filter(|cell| left[*cell] != known(*cell)).count();
        Ok((cover, other as u64))
    });
    let mut series = Vec::new();
    for (seed, run) in seeds.iter().zip(runs) {
        let (cover, other) = run?;
        let (before, after) = (cover[steps].1 / 100.0, cover[2 * steps].1 / 100.0);
        lab.found_with(&GREW, *seed, before);
        lab.found_with(&VANISHES, *seed, after / before);
        lab.found_with(&SURVIVORS, *seed, other as f64);
        table.row([(*seed).into(), before.into(), after.into(), other.into()]);
        series.push(Series::new(format!("seed {seed}"), Draw::Line, cover));
    }
    lab.keep("extinction", "Cover before extinction and after it", table)?;
    lab.keep(
        "cover",
        "Clouds grow, and vanish where ext is set once, at half time",
        Plot {
            title: "Growth and extinction".to_owned(),
            x: Axis::of("step"),
            y: Axis::of("cells with cloud (%)"),
            series,
            bands: Vec::new(),
        },
    )
}
