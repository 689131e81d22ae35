//! What the step and the grid do to the result.

use snowglobe::lab::{Claim, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};
use snowglobe::reading::Reading;
use snowglobe::tree::{ReadingSet, Setting, Sway, Tree};

use super::setup::{Setup, blow, broken};

pub const CONVERGENCE: Experiment = Experiment {
    id: "convergence",
    title: "Shorter steps, finer grids",
    source: "§3.5, §4.2",
    says: "The results are those of the equations, not of the step or the grid.",
    claims: &[&STEP, &GRID, &MOVES],
    run,
    mutant: Mutant {
        changes: "wind coefficient",
        to: 0.0,
        why: "without a force nothing moves that could converge",
        turns_red: &["sakai/convergence/tip"],
    },
};

static STEP: Claim = Claim {
    id: "sakai/convergence/step",
    source: "§3.5, Eq. (9), (10)",
    says: "half the step gives the same",
    expect: Expect::AtMost(0.005),
    statistic: Statistic::Each,
    reason: "relative change of the tip after 3 s at 5 m/s when the step of 2 ms is halved: 0.5 % cannot be seen",
    known: KNOWN,
};
static GRID: Claim = Claim {
    id: "sakai/convergence/grid",
    source: "§4.2",
    says: "a finer grid gives the same",
    expect: Expect::AtMost(0.01),
    statistic: Statistic::Each,
    reason: "the greater relative change of the tip after 3 s at 5 m/s from 33 nodes along a side to 17 and to 65",
    known: KNOWN,
};
static MOVES: Claim = Claim {
    id: "sakai/convergence/tip",
    source: "Fig. 5 (d)",
    says: "the tree moves",
    expect: Expect::Between(0.1, 6.67),
    statistic: Statistic::Each,
    reason: "displacement of the tip after 3 s at 5 m/s, m: what stands still would converge too",
    known: KNOWN,
};

const KNOWN: &[snowglobe::lab::Known] = &[snowglobe::lab::Known {
    reading: "set=literal",
    evidence: "the tree has fallen, and another way in each step and grid (tips.csv)",
}];

fn run(lab: &mut Lab) -> Result<()> {
    let setup = Setup::new(lab);
    let seconds = lab.pick(3.0, 0.1);
    let mut table = Table::new(["set", "step_s", "nodes", "tip_x", "tip_y"]);
    for set in lab.readings::<ReadingSet>() {
        let (dt, cells) = (setup.air.dt, setup.air.cells[0]);
        let runs = [(dt, cells), (0.5 * dt, cells), (0.25 * dt, cells), (dt, cells / 2), (dt, 2 * cells)];
        let tips = lab.each(&runs, |(dt, cells)| {
            let setting = Setting { dt: *dt, cells: [*cells; 2], wind: 5.0, ..setup.air };
            let tree = Tree::new(setup.skeleton()?, setup.given(set), set.readings()).map_err(broken)?;
            let mut sway = Sway::new(tree, setting).map_err(broken)?;
            blow(&mut sway, libm::round(seconds / dt) as u64)?;
            Ok(sway.tree().bend().tip)
        });
        let tips = tips.into_iter().collect::<Result<Vec<_>>>()?;
        let change = |k: usize| (tips[k] - tips[0]).norm() / tips[0].norm();
        lab.reading(set);
        lab.found(&STEP, Some(change(1)).filter(|x| x.is_finite()));
        lab.found(&GRID, Some(change(3).max(change(4))).filter(|x| x.is_finite()));
        lab.found(&MOVES, tips[0].norm());
        for ((dt, cells), tip) in runs.iter().zip(&tips) {
            table.row([set.name().into(), (*dt).into(), (cells + 1).into(), tip.x.into(), tip.y.into()]);
        }
    }
    lab.keep("tips", "The tip after 3 s at 5 m/s, by step and grid", table)
}
