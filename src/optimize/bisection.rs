//! Bisection of a residual.

use argmin::core::{Error, IterState, KV, Operator, Problem, Solver, State as _, TerminationReason};

type Search = IterState<f64, (), (), (), (), f64>;

/// Halves a bracket between whose ends the residual changes sign; the cost is the residual's square.
///
/// The residual may be infinite: a simulation that never ends is later than any target.
#[derive(Clone, Debug)]
pub struct Bisection {
    low: f64,
    high: f64,
    sign_of_low: f64,
}

impl Bisection {
    /// A bracket; whether it is one is found when the search begins, at the price of two evaluations.
    pub fn new(low: f64, high: f64) -> Self {
        Self { low, high, sign_of_low: 0.0 }
    }
}

impl<O> Solver<O, Search> for Bisection
where
    O: Operator<Param = f64, Output = f64>,
{
    fn name(&self) -> &str {
        "bisection"
    }

    fn init(&mut self, problem: &mut Problem<O>, state: Search) -> Result<(Search, Option<KV>), Error> {
        let (low, high) = (problem.apply(&self.low)?, problem.apply(&self.high)?);
        self.sign_of_low = sign(low);
        let (nearer, residual) = if low.abs() < high.abs() { (self.low, low) } else { (self.high, high) };
        let state = state.param(nearer).cost(residual * residual);
        if sign(low) * sign(high) > 0.0 {
            let why =
                format!("the residual has one sign at {} ({low}) and at {} ({high})", self.low, self.high);
            return Ok((state.terminate_with(TerminationReason::SolverExit(why)), None));
        }
        Ok((state, None))
    }

    fn next_iter(&mut self, problem: &mut Problem<O>, state: Search) -> Result<(Search, Option<KV>), Error> {
        let middle = self.low + 0.5 * (self.high - self.low);
        if middle <= self.low || middle >= self.high {
            let why = "the bracket cannot be halved further".to_owned();
            return Ok((state.terminate_with(TerminationReason::SolverExit(why)), None));
        }
        let residual = problem.apply(&middle)?;
        if sign(residual) == self.sign_of_low {
            self.low = middle;
        } else {
            self.high = middle;
        }
        Ok((state.param(middle).cost(residual * residual), None))
    }
}

fn sign(residual: f64) -> f64 {
    if residual > 0.0 {
        1.0
    } else if residual < 0.0 {
        -1.0
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use argmin::core::Executor;

    use super::*;

    /// x² − 2, infinite below 0.5.
    struct Root;

    impl Operator for Root {
        type Param = f64;
        type Output = f64;

        fn apply(&self, x: &f64) -> Result<f64, Error> {
            Ok(if *x < 0.5 { f64::NEG_INFINITY } else { x * x - 2.0 })
        }
    }

    #[test]
    fn the_root_of_two_is_found_to_the_last_bit_but_one() {
        let run =
            Executor::new(Root, Bisection::new(0.0, 2.0)).configure(|s| s.max_iters(60)).timer(false).run();
        let found = *run.unwrap().state.get_best_param().unwrap();
        assert!((found - std::f64::consts::SQRT_2).abs() < 4e-16);
    }

    #[test]
    fn a_bracket_without_a_root_is_said_to_be_none() {
        let run =
            Executor::new(Root, Bisection::new(2.0, 3.0)).configure(|s| s.max_iters(60)).timer(false).run();
        let state = run.unwrap().state;
        assert!(state.get_termination_reason().unwrap().text().contains("one sign"));
    }
}
