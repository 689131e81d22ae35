//! The secant method on a residual.

use argmin::core::{Error, IterState, KV, Operator, Problem, Solver, State as _, TerminationReason};

type Search = IterState<f64, (), (), (), (), f64>;

/// x ← x − r(x) (x − x') / (r(x) − r(x')): the root of the line through the last two points; the cost is the residual's
/// square.
///
/// The first point is the state's parameter. It stops where the line is level or has no root that is a number, and where
/// the root leaves the domain.
#[derive(Clone, Debug)]
pub struct Secant {
    second: f64,
    domain: (f64, f64),
    before: (f64, f64),
    last: (f64, f64),
}

impl Secant {
    /// The second point, and the domain of x (both ends in).
    pub fn new(second: f64, domain: (f64, f64)) -> Self {
        Self { second, domain, before: (0.0, 0.0), last: (0.0, 0.0) }
    }
}

impl<O> Solver<O, Search> for Secant
where
    O: Operator<Param = f64, Output = f64>,
{
    fn name(&self) -> &str {
        "secant"
    }

    fn init(&mut self, problem: &mut Problem<O>, mut state: Search) -> Result<(Search, Option<KV>), Error> {
        let first = state.take_param().ok_or_else(|| Error::msg("no initial parameter was given"))?;
        self.before = (first, problem.apply(&first)?);
        self.last = (self.second, problem.apply(&self.second)?);
        let nearer = if self.before.1.abs() < self.last.1.abs() { self.before } else { self.last };
        Ok((state.param(nearer.0).cost(nearer.1 * nearer.1), None))
    }

    fn next_iter(&mut self, problem: &mut Problem<O>, state: Search) -> Result<(Search, Option<KV>), Error> {
        let ((x0, r0), (x1, r1)) = (self.before, self.last);
        let stop = |why: String, state: Search| {
            Ok((state.param(x1).cost(r1 * r1).terminate_with(TerminationReason::SolverExit(why)), None))
        };
        if r0 == r1 {
            return stop("the last two residuals are equal".to_owned(), state);
        }
        let next = x1 - r1 * (x1 - x0) / (r1 - r0);
        if !next.is_finite() {
            return stop("there is no next point".to_owned(), state);
        }
        if next == x1 {
            return stop("the point does not move any more".to_owned(), state);
        }
        if next < self.domain.0 || next > self.domain.1 {
            let why = format!("the step from {x1} to {next} leaves {}..{}", self.domain.0, self.domain.1);
            return stop(why, state);
        }
        let residual = problem.apply(&next)?;
        (self.before, self.last) = (self.last, (next, residual));
        Ok((state.param(next).cost(residual * residual), None))
    }
}

#[cfg(test)]
mod tests {
    use argmin::core::Executor;

    use super::*;

    struct Residual(fn(f64) -> f64);

    impl Operator for Residual {
        type Param = f64;
        type Output = f64;

        fn apply(&self, x: &f64) -> Result<f64, Error> {
            Ok(self.0(*x))
        }
    }

    fn search(residual: fn(f64) -> f64, first: f64, second: f64, iterations: u64) -> Search {
        let solver = Secant::new(second, (-10.0, 10.0));
        let run = Executor::new(Residual(residual), solver)
            .configure(|state| state.param(first).max_iters(iterations))
            .timer(false)
            .run();
        run.unwrap().state
    }

    /// By hand: the line through (1, -1) and (2, 2) has its root at 4/3; then through (2, 2) and (4/3, -2/9) at 1.4.
    #[test]
    fn steps_are_those_by_hand() {
        let root = |x: f64| x * x - 2.0;
        assert!((search(root, 1.0, 2.0, 1).param.unwrap() - 4.0 / 3.0).abs() < 1e-15);
        assert!((search(root, 1.0, 2.0, 2).param.unwrap() - 1.4).abs() < 1e-15);
        assert!(
            (search(root, 1.0, 2.0, 20).get_best_param().unwrap() - std::f64::consts::SQRT_2).abs() < 1e-15
        );
    }

    #[test]
    fn it_stops_where_it_cannot_go_on() {
        let reason = |state: Search| state.get_termination_reason().unwrap().text().to_owned();
        assert!(reason(search(|_| 1.0, 0.0, 1.0, 9)).contains("equal"));
        assert!(reason(search(|x| x + 100.0, 0.0, 1.0, 9)).contains("leaves -10..10"));
        assert!(reason(search(|x| 1.0 / (1.0 - x), 0.0, 1.0, 9)).contains("no next point"));
    }
}
