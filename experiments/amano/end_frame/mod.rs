//! Section 5: how the end frame depends on the initial value, and what each way to define it leaves undone.

mod claims;
mod descents;
mod landscape;
mod pictures;

use snowglobe::frost::{EndOf, EndRule};
use snowglobe::lab::{Experiment, Lab, Mutant, Result};

use super::setup::{Readings, Reconstruction, Setup};
use claims::*;

pub const END_FRAME: Experiment = Experiment {
    id: "end-frame",
    title: "What the end frame is, and how it depends on the initial value",
    source: "§3.4 and §5",
    says: "The film ends when 90 % of the points are ice. The authors found the end frame about proportional to the \
           initial value over large changes of it and not over small ones, the more so with 100 % of the points, where \
           descent sometimes failed; and that with 90 % the film can end before the intended shape is there.",
    claims: &[
        &EVEN_SLOPE,
        &RANDOM_SLOPE,
        &SMALL_CHANGES,
        &ALL_IS_ROUGHER,
        &ALL_FAILS_MORE,
        &UNFINISHED[0],
        &UNFINISHED[1],
        &UNFINISHED[2],
    ],
    run,
    mutant: Mutant {
        changes: "share",
        to: 1.0,
        why: "with all points instead of nine tenths nothing is left undone, and there is nothing to be rougher than",
        turns_red: &["amano/end-frame/all-is-rougher", "amano/end-frame/unfinished-0.8"],
    },
};

/// Thresholds of the pictures, each with the seeds of its landscape: at 0 chance does not enter.
const THRESHOLDS: [(f64, u64); 3] = [(0.0, 1), (0.4, 3), (0.8, 5)];
/// Frames after which a film is endless: the last cells of 100 % take long.
const ENDLESS: u64 = 600;

/// A way to say when the film ends.
#[derive(Clone, Copy)]
struct Definition {
    name: &'static str,
    rule: EndRule,
}

fn definitions(share: f64) -> [Definition; 3] {
    let rule = |share, of| EndRule { share, of };
    [
        Definition { name: "90 % of the cells", rule: rule(share, EndOf::AllCells) },
        Definition { name: "100 % of the cells", rule: rule(1.0, EndOf::AllCells) },
        Definition { name: "90 % of the border", rule: rule(share, EndOf::Border) },
    ]
}

fn run(lab: &mut Lab) -> Result<()> {
    let share = lab.printed("share", 0.9, "§3.4");
    lab.assume_that(
        "end frames compared",
        "90 % and 100 % of the cells; 90 % of the border",
        "the first two are the paper's (§3.4, §5); §3.4 asks that ice reach the sketch's edge, so the border stands beside",
    );
    lab.assume_that(
        "gamma at 0.4",
        "gamma / (1 - r_th)",
        "the rule of the tables' reconstruction, at a threshold that no table has",
    );
    let setups: Vec<(Setup, f64, u64)> = THRESHOLDS
        .iter()
        .map(|(threshold, seeds)| {
            let setup = Setup::of_tables(lab, Reconstruction::DEFAULT, *threshold, Readings::DEFAULT);
            (setup, *threshold, *seeds)
        })
        .collect();
    let definitions = definitions(share);
    landscape::survey(lab, &setups, &definitions)?;
    descents::compare(lab, &setups, &definitions)?;
    pictures::unfinished(lab, &setups, &definitions)
}
