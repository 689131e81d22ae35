//! Every reading of the page, executed: one script for all, and what each does to the sky.

use snowglobe::automaton_cloud::{Activation, Brackets, Field, Lock, Packed, Rules};
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic, Table, maybe,
};
use snowglobe::reading::Reading;

use super::setup::{begun, broken, uniform};

pub const READINGS: Experiment = Experiment {
    id: "readings",
    title: "The page, read in every way",
    source: "§2.1, §2.2, Eq. (1), (4), (5)",
    says: "Two misprints and an open word make eight automata of one page. Each is put through the same script: it grows, is told to \
           vanish once, and goes on with a little of everything.",
    claims: &[&WORKS, &CLIMBS, &VANISHES, &UNCHANGED],
    run,
    mutant: Mutant {
        changes: "probability of vapour at the start",
        to: 0.0,
        why: "without vapour there is nothing to grow or to vanish",
        turns_red: &["dobashi/readings/works"],
    },
};

static WORKS: Claim = Claim {
    id: "dobashi/readings/works",
    source: "§2.1",
    says: "the rules grow clouds, and clouds are vapour that has changed its phase",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "cells with cloud that had vapour, less those that had none, over the cells that were active to begin with: an automaton \
             that grows clouds of vapour at least doubles them",
    known: &[
        Known {
            reading: "activation=as-printed",
            evidence: "a cell must be active to be activated: nothing grows, or all of it dry",
        },
        Known {
            reading: "activation=negated;brackets=as-printed",
            evidence: "far cells activate what has no vapour, so that more of the cloud is dry than is not",
        },
    ],
};
static CLIMBS: Claim = Claim {
    id: "dobashi/readings/climbs",
    source: "Eq. (1)",
    says: "clouds climb twice as fast as they sink, for the stencil has a cell two beneath and none two above",
    expect: Expect::Near { value: 2.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "cells that the top of a cloud from one cell has risen over those that its base has sunk, vapour everywhere: 2 and 1 a step",
    known: &[Known {
        reading: "activation=as-printed",
        evidence: "one active cell activates none (brackets mended), or only far ones, of which none is beneath",
    }],
};
static VANISHES: Claim = Claim {
    id: "dobashi/readings/vanishes",
    source: "§2.2",
    says: "ext spreads through cloud and makes it vanish",
    expect: Expect::AtMost(0.5),
    statistic: Statistic::Each,
    reason: "share of the cloud that is left so many steps after one in a thousand of its cells was told to vanish, nothing else \
             being injected: what hangs together vanishes",
    known: &[Known {
        reading: "activation=as-printed;brackets=mended",
        evidence: "nothing has grown: lone cells, from which ext spreads nowhere",
    }],
};
static UNCHANGED: Claim = Claim {
    id: "dobashi/readings/unchanged",
    source: "§2.2",
    says: "for T_ext steps after cloud has come there is no change of state",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "how often any of the four variables of a cell changed, but for what is injected, within T_ext steps of its cloud's coming: \
             none, if state means all four",
    known: &[Known {
        reading: "lock=cld",
        evidence: "act ends, ext passes through: only the cloud itself stays",
    }],
};

const SEEDS: u64 = 3;

/// What the script showed of one automaton.
struct Shown {
    works: f64,
    climbs: Option<f64>,
    left: Option<f64>,
    changes: u64,
    peak: f64,
    last: f64,
    cover: Vec<(f64, f64)>,
}

/// The script's parameters.
struct Script {
    counts: [usize; 3],
    vapour: f64,
    active: f64,
    grow: u64,
    vanish: u64,
    go_on: u64,
}

fn run(lab: &mut Lab) -> Result<()> {
    let script = Script {
        vapour: lab.assume(
            "probability of vapour at the start",
            0.4,
            "not given; well above the threshold of growth",
        ),
        active: lab.assume("probability of activation at the start", 0.001, "not given; a few clouds"),
        counts: lab.pick([64, 64, 32], [24, 24, 16]),
        grow: lab.pick(40, 12),
        vanish: lab.pick(60, 20),
        go_on: lab.pick(60, 12),
    };
    let lifetime = lab.assume("T_ext", 8.0, "not given; so that its two readings differ") as u8;
    let seeds = lab.seeds(SEEDS);
    let mut table = Table::new([
        "activation",
        "brackets",
        "lock",
        "seed",
        "works",
        "climbs",
        "left",
        "changes_within_t_ext",
        "peak_cover",
        "last_cover",
    ]);
    let mut series = Vec::new();
    for activation in lab.readings::<Activation>() {
        for brackets in lab.readings::<Brackets>() {
            for lock in lab.readings::<Lock>() {
                let rules = Rules { activation, brackets, lock, lifetime };
                let shown = lab.each(&seeds, |seed| script.play(rules, *seed));
                lab.reading(activation);
                lab.reading(brackets);
                lab.reading(lock);
                for (seed, shown) in seeds.iter().zip(shown) {
                    let shown = shown?;
                    lab.found_with(&WORKS, *seed, shown.works);
                    lab.found_with(&CLIMBS, *seed, shown.climbs);
                    lab.found_with(&VANISHES, *seed, shown.left);
                    lab.found_with(&UNCHANGED, *seed, shown.changes as f64);
                    table.row([
                        activation.name().into(),
                        brackets.name().into(),
                        lock.name().into(),
                        (*seed).into(),
                        shown.works.into(),
                        maybe(shown.climbs),
                        maybe(shown.left),
                        shown.changes.into(),
                        shown.peak.into(),
                        shown.last.into(),
                    ]);
                    if *seed == seeds[0] {
                        let name = format!(
                            "act {}, brackets {}, lock {}",
                            activation.name(),
                            brackets.name(),
                            lock.name()
                        );
                        series.push(Series::new(name, Draw::Line, shown.cover));
                    }
                }
            }
        }
    }
    lab.keep("automata", "Eight automata of one page, through the same script", table)?;
    lab.keep(
        "cover",
        "The script: growth, one order to vanish, and a little of everything; first seed",
        Plot {
            title: "Eight automata of one page".to_owned(),
            x: Axis::of("step"),
            y: Axis::within("cells with cloud (%)", 0.0, 100.0),
            series,
            bands: Vec::new(),
        },
    )
}

impl Script {
    fn play(&self, rules: Rules, seed: u64) -> Result<Shown> {
        let mut clouds = begun(self.counts, rules, seed, [self.vapour, self.active])?;
        let (vapour, active) = (clouds.field(Field::Hum), clouds.field(Field::Act));
        let mut watch = Watch::new(&clouds, rules.lifetime);
        let mut cover = vec![(0.0, 0.0)];
        let mut step = |clouds: &mut Packed, watch: &mut Watch| {
            clouds.step();
            watch.look(clouds);
            cover.push((cover.len() as f64, 100.0 * clouds.cover()));
        };
        (0..self.grow).for_each(|_| step(&mut clouds, &mut watch));
        let grown = clouds.cld();
        let count = |keep: &dyn Fn(usize) -> bool| (0..grown.len()).filter(|cell| keep(*cell)).count() as f64;
        let wet = count(&|cell| grown[cell] == 1 && (vapour[cell] == 1 || active[cell] == 1));
        let dry = count(&|cell| grown[cell] == 1 && vapour[cell] == 0 && active[cell] == 0);
        let begun = count(&|cell| active[cell] == 1);

        let before = clouds.cover();
        clouds.inject(&uniform(seed, [0.0, 0.0, 0.001]));
        watch.accept(&clouds);
        (0..self.vanish).for_each(|_| step(&mut clouds, &mut watch));
        let left = (before > 0.0).then(|| clouds.cover() / before);
        let later = uniform(seed, [0.02, 0.001, 0.005]);
        for _ in 0..self.go_on {
            clouds.inject(&later);
            watch.accept(&clouds);
            step(&mut clouds, &mut watch);
        }
        Ok(Shown {
            works: (wet - dry) / begun.max(1.0),
            climbs: climbs(rules)?,
            left,
            changes: watch.changes,
            peak: cover.iter().map(|(_, share)| share / 100.0).fold(0.0, f64::max),
            last: clouds.cover(),
            cover,
        })
    }
}

/// How far a cloud from one cell, in vapour everywhere, rises for each cell that it sinks.
fn climbs(rules: Rules) -> Result<Option<f64>> {
    const SIDE: usize = 25;
    let mut clouds = Packed::new([SIDE; 3], rules).map_err(broken)?;
    let cells = SIDE * SIDE * SIDE;
    let mut one = vec![0; cells];
    one[cells / 2] = 1;
    clouds.set(Field::Hum, &vec![1; cells]).map_err(broken)?;
    clouds.set(Field::Act, &one).map_err(broken)?;
    (0..6).for_each(|_| clouds.step());
    let cld = clouds.cld();
    let planes = || (0..SIDE).filter(|k| cld[k * SIDE * SIDE..(k + 1) * SIDE * SIDE].contains(&1));
    let (base, top) = (planes().next(), planes().next_back());
    Ok(base.zip(top).and_then(|(base, top)| {
        let (sunk, risen) = (SIDE / 2 - base.min(SIDE / 2), top.max(SIDE / 2) - SIDE / 2);
        (sunk > 0).then(|| risen as f64 / sunk as f64)
    }))
}

/// Counts changes of any variable of cells whose cloud came no more than T_ext steps ago.
struct Watch {
    lifetime: u64,
    came: Vec<Option<u64>>,
    before: [Vec<u8>; 4],
    changes: u64,
}

impl Watch {
    fn new(clouds: &Packed, lifetime: u8) -> Self {
        let before = all(clouds);
        Self { lifetime: u64::from(lifetime), came: vec![None; before[0].len()], before, changes: 0 }
    }

    /// After a step.
    fn look(&mut self, clouds: &Packed) {
        let (now, step) = (all(clouds), clouds.steps());
        for (cell, came) in self.came.iter_mut().enumerate() {
            // What came at step s does not change in s + 1 to s + T_ext.
            let young = came.is_some_and(|came| step <= came + self.lifetime);
            if young {
                self.changes +=
                    (0..4).filter(|which| now[*which][cell] != self.before[*which][cell]).count() as u64;
            }
            if now[0][cell] == 1 && self.before[0][cell] == 0 {
                *came = Some(step);
            }
        }
        self.before = now;
    }

    /// After an injection, which is no change of the rules.
    fn accept(&mut self, clouds: &Packed) {
        self.before = all(clouds);
    }
}

fn all(clouds: &Packed) -> [Vec<u8>; 4] {
    [clouds.cld(), clouds.field(Field::Hum), clouds.field(Field::Act), clouds.field(Field::Ext)]
}
