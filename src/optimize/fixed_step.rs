//! A line search that does not search.

use argmin::core::{
    CostFunction, Error, IterState, KV, Problem, Solver, TerminationReason, TerminationStatus,
};
use argmin::solver::linesearch::LineSearch;

type Point = Vec<f64>;
type Search = IterState<Point, Point, (), (), (), f64>;

/// The error with which a descent ends where it cannot go on.
pub(super) const FLAT: &str = "the gradient is 0: the objective is flat there";

/// One step of constant length along the direction: argmin's `SteepestDescent` with it is x ← x − η ∇f(x), Eq. (3) of
/// Amano, Sato & Itoh in any number of dimensions.
#[derive(Clone, Debug)]
pub struct FixedStep {
    eta: f64,
    direction: Option<Point>,
    taken: bool,
}

impl FixedStep {
    /// The length of the step, in units of the direction's.
    pub fn new(eta: f64) -> Self {
        Self { eta, direction: None, taken: false }
    }
}

impl LineSearch<Point, f64> for FixedStep {
    fn search_direction(&mut self, direction: Point) {
        self.direction = Some(direction);
    }

    /// The length is fixed: what a solver would begin with is not asked for.
    fn initial_step_length(&mut self, _step_length: f64) -> Result<(), Error> {
        Ok(())
    }
}

impl<O> Solver<O, Search> for FixedStep
where
    O: CostFunction<Param = Point, Output = f64>,
{
    fn name(&self) -> &str {
        "fixed step"
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<O>,
        mut state: Search,
    ) -> Result<(Search, Option<KV>), Error> {
        let x = state.take_param().ok_or_else(|| Error::msg("no initial parameter was given"))?;
        let direction = self.direction.as_ref().ok_or_else(|| Error::msg("no direction was given"))?;
        let next: Point = x.iter().zip(direction).map(|(x, d)| x + self.eta * d).collect();
        if next == x {
            return Err(Error::msg(FLAT));
        }
        let cost = problem.cost(&next)?;
        self.taken = true;
        Ok((state.param(next).cost(cost), None))
    }

    fn terminate(&mut self, _state: &Search) -> TerminationStatus {
        match self.taken {
            true => TerminationStatus::Terminated(TerminationReason::SolverConverged),
            false => TerminationStatus::NotTerminated,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use argmin::core::{Executor, Gradient};
    use argmin::solver::gradientdescent::SteepestDescent;

    use super::*;

    /// x² + 3 y², counting what is asked.
    #[derive(Default)]
    struct Bowl {
        costs: Cell<u32>,
        gradients: Cell<u32>,
    }

    impl CostFunction for &Bowl {
        type Param = Point;
        type Output = f64;

        fn cost(&self, x: &Point) -> Result<f64, Error> {
            self.costs.set(self.costs.get() + 1);
            Ok(x[0] * x[0] + 3.0 * x[1] * x[1])
        }
    }

    impl Gradient for &Bowl {
        type Param = Point;
        type Gradient = Point;

        fn gradient(&self, x: &Point) -> Result<Point, Error> {
            self.gradients.set(self.gradients.get() + 1);
            Ok(vec![2.0 * x[0], 6.0 * x[1]])
        }
    }

    fn descend(bowl: &Bowl, from: Point, iterations: u64) -> Result<Search, Error> {
        let run = Executor::new(bowl, SteepestDescent::new(FixedStep::new(0.1)))
            .configure(|state: Search| state.param(from).max_iters(iterations))
            .timer(false)
            .run()?;
        Ok(run.state)
    }

    /// By hand: (1, 1) − 0.1 (2, 6) = (0.8, 0.4), and (0.8, 0.4) − 0.1 (1.6, 2.4) = (0.64, 0.16).
    #[test]
    fn steps_are_those_by_hand_and_cost_one_gradient_each() {
        let bowl = Bowl::default();
        let x = descend(&bowl, vec![1.0, 1.0], 2).unwrap().param.unwrap();
        assert!((x[0] - 0.64).abs() < 1e-15 && (x[1] - 0.16).abs() < 1e-15, "{x:?}");
        assert_eq!(bowl.gradients.get(), 2);
    }

    #[test]
    fn where_it_is_flat_it_says_so() {
        let error = descend(&Bowl::default(), vec![0.0, 0.0], 2).unwrap_err();
        assert!(error.to_string().contains("flat"));
    }
}
