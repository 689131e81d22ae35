//! The contest of optimisers, as others use it: the field on problems with known answers, and a solver of one's own.

#[path = "../examples/own_solver.rs"]
#[allow(dead_code)] // its main prints what is looked at here
mod own_solver;

use snowglobe::optimize::contest::{Contest, Status, field};
use snowglobe::problems::control;

/// Every solver has a row for every target, and one that walks through the whole box meets the easiest everywhere.
#[test]
fn the_example_compares_its_solvers_with_the_field() {
    let text = own_solver::compare();
    assert_eq!(text, own_solver::compare(), "the same seed, the same comparison");
    for solver in ["small-simplex", "walk", "paper", "secant"] {
        assert_eq!(text.lines().filter(|line| line.starts_with(&format!("{solver} "))).count(), 5, "{text}");
    }
    let walk = text.lines().find(|line| line.starts_with("walk ")).unwrap();
    assert!(walk.contains("8/8"), "{walk}");
}

/// Every solver of the field comes to an end on every control problem, twice in the same way.
#[test]
fn the_field_ends_and_repeats_itself() {
    let contest = || Contest::new(control::boxed(control::suite()), field()).seeds(2).budget(60);
    let trials = contest().run();
    assert_eq!(trials.len(), contest().pairings().len());
    assert!(trials.iter().all(|trial| trial.log.len() <= 60 && trial.status != Status::Silent));
    assert_eq!(trials, contest().run());
    let mut names: Vec<String> = field().into_iter().map(|entrant| entrant.name).collect();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), field().len());
}

/// In one dimension, on the cubic, all come within a hundredth but those that cannot be expected to: the paper's rule,
/// whose step is for frames; chance; and argmin's non-linear CG, whose directions stop descending.
#[test]
fn the_field_solves_what_it_should() {
    let cubic = control::suite().into_iter().filter(|control| control.name == "cubic").collect();
    let trials = Contest::new(control::boxed(cubic), field()).seeds(3).budget(200).run();
    let excused = ["paper", "random-search", "simulated-annealing", "nonlinear-cg"];
    let failed: Vec<String> = trials
        .iter()
        .filter(|trial| !excused.contains(&trial.solver.as_str()) && trial.best().unwrap().cost > 1e-2)
        .map(|trial| format!("{} seed {}: {}", trial.solver, trial.seed, trial.reason))
        .collect();
    assert!(failed.is_empty(), "{failed:?}");
}
