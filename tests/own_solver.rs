//! The documented way to bring a solver of one's own, run as it stands.

#[path = "../examples/own_solver.rs"]
#[allow(dead_code)] // its main prints what is looked at here
mod own_solver;

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
