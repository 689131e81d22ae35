//! Growth without extinction (§2.1), under every reading of Eq. (1).

use snowglobe::automaton_cloud::{Activation, Brackets, Rules};
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};
use snowglobe::reading::Reading;

use super::setup::{MENDED, begun, distances, vapour_and_active};

pub const GROWTH: Experiment = Experiment {
    id: "growth",
    title: "Growth without extinction",
    source: "§2.1, Eq. (1) to (3)",
    says: "Applied again and again to a state to begin with, the rules let clouds grow.",
    claims: &[&GROWS, &BREADTH_FIRST, &DRY],
    run,
    mutant: Mutant {
        changes: "probability of vapour",
        to: 0.0,
        why: "without vapour nothing can become cloud",
        turns_red: &["dobashi/growth/grows"],
    },
};

static GROWS: Claim = Claim {
    id: "dobashi/growth/grows",
    source: "§2.1",
    says: "the rules, applied one after another, let clouds grow",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "cover after all steps over that of the cells that were active to begin with: twice is growth by any measure",
    known: &[Known {
        reading: "activation=as-printed;brackets=mended",
        evidence: "a cell must be active to be activated: what is active can only die out",
    }],
};
static BREADTH_FIRST: Claim = Claim {
    id: "dobashi/growth/breadth-first",
    source: "Eq. (1) to (3)",
    says: "cloud comes to a cell as many steps after the start as vapour leads to it from an active one, and one",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "cells, over all steps, whose cloud is not that of a breadth-first search through vapour over the eleven cells of the \
             stencil: a theorem of the mended rules, so none",
    known: &[
        Known {
            reading: "activation=as-printed",
            evidence: "as printed a cell must be active to be activated",
        },
        Known {
            reading: "activation=negated;brackets=as-printed",
            evidence: "as printed far cells activate what has no vapour",
        },
    ],
};
static DRY: Claim = Claim {
    id: "dobashi/growth/dry",
    source: "§2.1",
    says: "cloud is vapour that has changed its phase",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "share of the cloud that is where no vapour was, but for cells that were active to begin with: by the meaning of hum, \
             none",
    known: &[Known {
        reading: "brackets=as-printed",
        evidence: "the far terms stand outside of the bracket and need no vapour",
    }],
};

const SEEDS: u64 = 4;

fn run(lab: &mut Lab) -> Result<()> {
    let vapour = lab.assume("probability of vapour", 0.5, "not given; enough that clouds connect");
    let active = lab.assume("probability of activation", 0.0005, "not given; a few seeds");
    let steps = lab.assume("steps", 40.0, "not given; until nothing changes any more") as usize;
    let counts = lab.pick([64, 64, 32], [16, 16, 8]);
    let seeds = lab.seeds(SEEDS);
    let mut table =
        Table::new(["activation", "brackets", "seed", "growth", "cells_not_breadth_first", "share_dry"]);
    let mut series = Vec::new();
    for activation in lab.readings::<Activation>() {
        for brackets in lab.readings::<Brackets>() {
            let rules = Rules { activation, brackets, ..MENDED };
            let grown = lab.each(&seeds, |seed| grow(counts, rules, *seed, [vapour, active], steps));
            lab.reading(activation);
            lab.reading(brackets);
            for (seed, grown) in seeds.iter().zip(grown) {
                let grown = grown?;
                lab.found_with(&GROWS, *seed, grown.growth);
                lab.found_with(&BREADTH_FIRST, *seed, grown.other as f64);
                lab.found_with(&DRY, *seed, grown.dry);
                table.row([
                    activation.name().into(),
                    brackets.name().into(),
                    (*seed).into(),
                    grown.growth.into(),
                    grown.other.into(),
                    grown.dry.into(),
                ]);
                if *seed == seeds[0] {
                    let name = format!("act {}, brackets {}", activation.name(), brackets.name());
                    series.push(Series::new(name, Draw::Joined, grown.cover));
                }
            }
        }
    }
    lab.keep("growth", "What each reading of Eq. (1) grows", table)?;
    lab.keep(
        "cover",
        "Cover under every reading of Eq. (1), first seed",
        Plot {
            title: "Which reading grows clouds?".to_owned(),
            x: Axis::of("step"),
            y: Axis::within("cells with cloud (%)", 0.0, 100.0),
            series,
            bands: Vec::new(),
        },
    )
}

struct Grown {
    growth: f64,
    other: u64,
    dry: f64,
    cover: Vec<(f64, f64)>,
}

fn grow(counts: [usize; 3], rules: Rules, seed: u64, chances: [f64; 2], steps: usize) -> Result<Grown> {
    let mut clouds = begun(counts, rules, seed, chances)?;
    let (vapour, active) = vapour_and_active(&clouds);
    let distances = distances(counts, &active, |cell| vapour[cell] == 1);
    let (mut other, mut cover) = (0_u64, vec![(0.0, 0.0)]);
    for t in 1..=steps {
        clouds.step();
        let cld = clouds.cld();
        let known = |distance: &Option<u32>| u8::from(distance.is_some_and(|d| (d as usize) < t));
        other += cld.iter().zip(&distances).filter(|(cld, distance)| **cld != known(distance)).count() as u64;
        cover.push((t as f64, 100.0 * clouds.cover()));
    }
    let cld = clouds.cld();
    let count = |keep: &dyn Fn(usize) -> bool| (0..cld.len()).filter(|cell| keep(*cell)).count() as f64;
    let cloud = count(&|cell| cld[cell] == 1);
    let dry = count(&|cell| cld[cell] == 1 && vapour[cell] == 0 && active[cell] == 0);
    let begun = count(&|cell| active[cell] == 1);
    Ok(Grown { growth: cloud / begun.max(1.0), other, dry: dry / cloud.max(1.0), cover })
}
