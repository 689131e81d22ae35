//! Optimisers compared on objectives that are simulations: what Amano, Sato & Itoh leave as future work.
//!
//! An experiment is a suite of problems on which every solver of the field is tried. `narrow.rs` says what is tried,
//! `tables.rs` and `plots.rs` keep what came of it.

mod automaton;
mod claims;
mod clouds;
mod control;
mod frost;
mod narrow;
mod plots;
mod sectors;
mod tables;
mod tree;

use snowglobe::lab::Paper;

/// The comparison, as a paper of its own.
pub const PAPER: Paper = Paper {
    id: "optimizers",
    title: "",
    english: "which optimiser finds the initial value?",
    about: "Amano, Sato & Itoh close by saying that steepest descent fails where the end frame is a rough function of \
            the initial value, and that other non-linear methods should be tried. Here they are: from the same starts, \
            with the same budget, counted in films.",
    authors: "Optimisers compared",
    sources: env!("SNOWGLOBE_OPTIMIZERS"),
    readings: &[],
    experiments: &[
        frost::WHOLE,
        frost::INTERPOLATED,
        sectors::SECTORS,
        tree::TREE,
        clouds::CLOUDS,
        automaton::AUTOMATON,
        control::CONTROL,
    ],
};

/// What `snowglobe optimizers` accepts: suites with their problems, and solvers.
#[allow(dead_code)] // only `snowglobe` has that command
pub fn accepted() -> (Vec<(&'static str, Vec<String>)>, Vec<String>) {
    let names = |suite: snowglobe::problems::Suite| suite.iter().map(|problem| problem.name()).collect();
    let suites = vec![
        (frost::WHOLE.id, names(frost::problems(frost::WHOLE.id, 1))),
        (frost::INTERPOLATED.id, names(frost::problems(frost::INTERPOLATED.id, 1))),
        (sectors::SECTORS.id, names(sectors::problems())),
        (tree::TREE.id, names(tree::problems())),
        (clouds::CLOUDS.id, names(clouds::problems())),
        (automaton::AUTOMATON.id, names(automaton::problems())),
        (control::CONTROL.id, names(control::problems())),
    ];
    let solvers = snowglobe::optimize::contest::field().into_iter().map(|entrant| entrant.name).collect();
    (suites, solvers)
}
