//! Two solvers of one's own on the papers' frost, beside two of the field: `cargo run --release --example own_solver`.
//!
//! Anything that asks an `Oracle` takes part; an argmin solver does through `oracle.run`. A problem of one's own is a
//! type with `snowglobe::optimize::contest::Problem`.

use argmin::core::IterState;
use argmin::solver::neldermead::NelderMead;
use snowglobe::frost::TSim;
use snowglobe::optimize::contest::{Contest, Entrant, Family, field, summary};
use snowglobe::problems::frost;

type State = IterState<Vec<f64>, (), (), (), (), f64>;

/// Each solver's successes and expected runtime at each target, as a text.
pub fn compare() -> String {
    let simplex = Entrant::new("small-simplex", Family::Direct, "Nelder-Mead, simplex of 0.02", |oracle| {
        let solver = NelderMead::new(oracle.unit().simplex(0.02));
        oracle.run(oracle.unit(), solver, |state: State| state.max_iters(200))
    });
    let walk = Entrant::new("walk", Family::Direct, "a hundredth more at a time", |oracle| {
        for k in 0..75 {
            oracle.evaluate(&[0.15 + 0.01 * f64::from(k)])?; // an error when the budget is used up: pass it on
        }
        Ok("the other side is reached".to_owned())
    });
    let rivals = field().into_iter().filter(|entrant| ["paper", "secant"].contains(&entrant.name.as_str()));
    let problems = frost::boxed(frost::suite(TSim::Whole, 1).into_iter().skip(2).take(4).collect());
    let contest = Contest::new(problems, [simplex, walk].into_iter().chain(rivals).collect());
    summary(&contest.seeds(2).budget(80).run())
}

fn main() {
    print!("{}", compare());
}
