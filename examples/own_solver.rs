//! A solver of one's own on the frost of the papers, beside two of the field: `cargo run --release --example own_solver`.
//!
//! Anything that asks an `Oracle` takes part, an argmin solver through `oracle.run`.

use argmin::core::IterState;
use argmin::solver::neldermead::NelderMead;
use snowglobe::frost::TSim;
use snowglobe::optimize::contest::{Contest, Entrant, Family, field, summary};
use snowglobe::problems::frost;

fn main() {
    let mine =
        Entrant::new("small-simplex", Family::Direct, "argmin's Nelder-Mead, simplex of 0.02", |oracle| {
            let solver = NelderMead::new(oracle.unit().simplex(0.02));
            oracle.run(oracle.unit(), solver, |state: IterState<Vec<f64>, (), (), (), (), f64>| {
                state.max_iters(200)
            })
        });
    let walk = Entrant::new("walk", Family::Direct, "a hundredth more at a time", |oracle| {
        (0..80).map(|k| oracle.evaluate(&[0.1 + 0.01 * f64::from(k)])).collect::<Result<Vec<f64>, _>>()?;
        Ok("the other side is reached".to_owned())
    });
    let rivals = field().into_iter().filter(|entrant| ["paper", "secant"].contains(&entrant.name.as_str()));
    let problems = frost::boxed(frost::suite(TSim::Whole, 1).into_iter().skip(2).take(4).collect());
    let contest =
        Contest::new(problems, [mine, walk].into_iter().chain(rivals).collect()).seeds(2).budget(80);
    print!("{}", summary(&contest.run()));
}
