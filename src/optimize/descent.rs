//! Steepest descent with a fixed step length, on one parameter.

use argmin::core::{
    CostFunction, Error, IterState, KV, Problem, Solver, State as _, TerminationReason, TerminationStatus,
};

use crate::reading::Reading;

/// How the derivative f′(x) of a simulation's objective is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivative {
    /// The slope of f between the last two iterates; the first is a forward difference.
    Secant,
    /// (f(x + h) − f(x)) / h.
    Forward,
    /// (f(x + h) − f(x − h)) / 2h.
    Central,
}

impl Reading for Derivative {
    const QUANTITY: &'static str = "derivative";
    const ALL: &'static [Self] = &[Self::Secant, Self::Forward, Self::Central];

    fn name(self) -> &'static str {
        match self {
            Self::Secant => "secant",
            Self::Forward => "forward",
            Self::Central => "central",
        }
    }
}

type Search = IterState<f64, f64, (), (), (), f64>;

/// x ← x − η f′(x): steepest descent without a line search.
///
/// It stops where the derivative is zero or not finite and where the iterate leaves the domain; set a target cost and
/// a number of iterations on argmin's `Executor`.
#[derive(Clone, Debug)]
pub struct FixedStepDescent {
    eta: f64,
    derivative: Derivative,
    h: f64,
    domain: (f64, f64),
    previous: Option<(f64, f64)>,
}

impl FixedStepDescent {
    /// Step length `eta`, the rule for the derivative with its difference `h`, and the domain of x (both ends out).
    pub fn new(eta: f64, derivative: Derivative, h: f64, domain: (f64, f64)) -> Self {
        Self { eta, derivative, h, domain, previous: None }
    }

    fn slope<O>(&self, problem: &mut Problem<O>, x: f64, f: f64) -> Result<f64, Error>
    where
        O: CostFunction<Param = f64, Output = f64>,
    {
        Ok(match (self.derivative, self.previous) {
            (Derivative::Secant, Some((before, f_before))) => (f - f_before) / (x - before),
            (Derivative::Secant, None) | (Derivative::Forward, _) => {
                (problem.cost(&(x + self.h))? - f) / self.h
            }
            (Derivative::Central, _) => {
                (problem.cost(&(x + self.h))? - problem.cost(&(x - self.h))?) / (2.0 * self.h)
            }
        })
    }
}

impl<O> Solver<O, Search> for FixedStepDescent
where
    O: CostFunction<Param = f64, Output = f64>,
{
    fn name(&self) -> &str {
        "steepest descent, fixed step"
    }

    fn init(&mut self, problem: &mut Problem<O>, mut state: Search) -> Result<(Search, Option<KV>), Error> {
        self.previous = None;
        let start = state.take_param().ok_or_else(|| Error::msg("no initial parameter was given"))?;
        let cost = problem.cost(&start)?;
        Ok((state.param(start).cost(cost), None))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<O>,
        mut state: Search,
    ) -> Result<(Search, Option<KV>), Error> {
        let x = state.take_param().ok_or_else(|| Error::msg("the iterate was taken away"))?;
        let f = state.cost;
        let slope = self.slope(problem, x, f)?;
        let next = x - self.eta * slope;
        let stays = |why: String, state: Search| {
            Ok((
                state.param(x).cost(f).gradient(slope).terminate_with(TerminationReason::SolverExit(why)),
                None,
            ))
        };
        if slope == 0.0 {
            return stays(format!("the derivative at {x} is 0: the objective is flat there"), state);
        }
        if !slope.is_finite() {
            return stays(format!("there is no derivative at {x}"), state);
        }
        if !(next > self.domain.0 && next < self.domain.1) {
            return stays(
                format!("the step from {x} to {next} leaves {}..{}", self.domain.0, self.domain.1),
                state,
            );
        }
        self.previous = Some((x, f));
        let cost = problem.cost(&next)?;
        Ok((state.param(next).cost(cost).gradient(slope), None))
    }

    fn terminate(&mut self, state: &Search) -> TerminationStatus {
        // The cost of an iterate that is good enough ends the search even where an earlier one was better.
        if state.cost <= state.target_cost {
            return TerminationStatus::Terminated(TerminationReason::TargetCostReached);
        }
        TerminationStatus::NotTerminated
    }
}

#[cfg(test)]
mod tests {
    use argmin::core::Executor;

    use super::*;

    /// (x − 3)² + 1
    struct Parabola;

    impl CostFunction for Parabola {
        type Param = f64;
        type Output = f64;

        fn cost(&self, x: &f64) -> Result<f64, Error> {
            Ok((x - 3.0) * (x - 3.0) + 1.0)
        }
    }

    /// A staircase, flat around the start.
    struct Stair;

    impl CostFunction for Stair {
        type Param = f64;
        type Output = f64;

        fn cost(&self, x: &f64) -> Result<f64, Error> {
            Ok(x.floor() + 5.0)
        }
    }

    fn descend<O>(problem: O, derivative: Derivative, eta: f64, iterations: u64) -> Search
    where
        O: CostFunction<Param = f64, Output = f64>,
    {
        let solver = FixedStepDescent::new(eta, derivative, 1e-3, (0.0, 10.0));
        let run = Executor::new(problem, solver)
            .configure(|s| s.param(1.0).max_iters(iterations))
            .timer(false)
            .run();
        run.unwrap().state
    }

    /// By hand: the slope of the parabola at 1 is −4, its forward difference −4 + h, so x₁ = 1 + 0.1 · 4.
    #[test]
    fn one_step_is_the_one_by_hand() {
        let central = descend(Parabola, Derivative::Central, 0.1, 1).param.unwrap();
        assert!((central - 1.4).abs() < 1e-12, "{central}");
        let forward = descend(Parabola, Derivative::Forward, 0.1, 1).param.unwrap();
        assert!((forward - (1.4 - 1e-4)).abs() < 1e-12, "{forward}");
        // The second secant is the slope between 1 and x1, (x1 - 3) + (1 - 3).
        let x1 = descend(Parabola, Derivative::Secant, 0.1, 1).param.unwrap();
        let x2 = descend(Parabola, Derivative::Secant, 0.1, 2).param.unwrap();
        assert!((x2 - (x1 - 0.1 * (x1 - 5.0))).abs() < 1e-12, "{x2}");
    }

    #[test]
    fn every_rule_finds_the_bottom_of_a_parabola() {
        for derivative in Derivative::ALL {
            let state = descend(Parabola, *derivative, 0.1, 60);
            assert!((state.get_best_param().unwrap() - 3.0).abs() < 2e-3);
        }
    }

    #[test]
    fn it_stops_where_it_cannot_go_on() {
        let reason = |state: Search| state.get_termination_reason().unwrap().text().to_owned();
        assert!(reason(descend(Parabola, Derivative::Central, 100.0, 9)).contains("leaves 0..10"));
        let flat = FixedStepDescent::new(0.1, Derivative::Forward, 1e-3, (0.0, 10.0));
        let run =
            Executor::new(Stair, flat).configure(|s| s.param(1.5).max_iters(9)).timer(false).run().unwrap();
        assert!(reason(run.state).contains("flat"));
    }
}
