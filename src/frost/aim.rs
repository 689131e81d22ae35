//! Section 3.4: the initial value that makes the film end in the frame that the user asked for.

use std::cell::RefCell;

use argmin::core::{CostFunction, Error, Executor, IterState, Operator, State, TerminationReason};

use super::{EndFrame, EndFrameObjective};
use crate::optimize::{Bisection, Derivative, FixedStepDescent, Iterate, Iterates};

/// How the initial value is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// The first initial value.
    pub start: f64,
    /// eta of Eq. (3).
    pub eta: f64,
    /// Frames by which the end may miss the target.
    pub tolerance: f64,
    /// How the derivative of Eq. (3) is taken.
    pub derivative: Derivative,
    /// The difference in beta by which it is taken.
    pub h: f64,
    /// Iterations after which a search is given up.
    pub iterations: u64,
}

/// The rule that led to an iterate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Steepest descent, Eq. (3).
    Descent,
    /// Bisection of T_sim - T, which is not in the paper.
    Bisection,
}

impl Rule {
    /// `descent` or `bisection`.
    pub fn name(self) -> &'static str {
        match self {
            Rule::Descent => "descent",
            Rule::Bisection => "bisection",
        }
    }
}

/// One iterate and where its film ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aimed {
    /// The rule that led to it.
    pub rule: Rule,
    /// Its number under that rule; 0 is where the rule began.
    pub step: u64,
    /// The initial value.
    pub beta: f64,
    /// Its end frame, if it has one.
    pub end: Option<EndFrame>,
}

/// A search and how it ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// The iterates, in order.
    pub iterates: Vec<Aimed>,
    /// Whether the last one ends within the tolerance.
    pub reached: bool,
    /// Films that were grown, derivatives and brackets included.
    pub evaluations: u64,
    /// Why it stopped.
    pub why: String,
}

impl Search {
    /// The last iterate.
    pub fn last(&self) -> Option<&Aimed> {
        self.iterates.last()
    }
}

/// Initial values lie between no vapour and ice everywhere.
const DOMAIN: (f64, f64) = (0.0, 1.0);
/// The ends of the bracket of a bisection.
const BRACKET: (f64, f64) = (0.01, 0.99);

impl EndFrameObjective<'_> {
    /// Steepest descent from the first value by Eq. (3), until the end is within the tolerance (§3.4, §4).
    ///
    /// # Errors
    ///
    /// Those of the simulation.
    pub fn descend(&self, aim: &Aim) -> Result<Search, Error> {
        let logged = Logged::of(self);
        let solver = FixedStepDescent::new(aim.eta, aim.derivative, aim.h, DOMAIN);
        let path = Iterates::default();
        let run = Executor::new(&logged, solver)
            .configure(|state: IterState<f64, f64, (), (), (), f64>| {
                state.param(aim.start).max_iters(aim.iterations).target_cost(aim.tolerance * aim.tolerance)
            })
            .add_observer(path.clone(), argmin::core::observers::ObserverMode::Always)
            .timer(false)
            .run()?;
        let why = reason(run.state.get_termination_reason());
        Ok(logged.search(Rule::Descent, &path.list(), aim, why))
    }

    /// Bisection of `T_sim - T` between almost no vapour and almost ice everywhere; slower, and not in the paper, but
    /// sure to find an end frame within the tolerance where T_sim has no larger jump.
    ///
    /// # Errors
    ///
    /// Those of the simulation.
    pub fn bisect(&self, aim: &Aim) -> Result<Search, Error> {
        let logged = Logged::of(self);
        let path = Iterates::default();
        let run = Executor::new(&logged, Bisection::new(BRACKET.0, BRACKET.1))
            .configure(|state: IterState<f64, (), (), (), (), f64>| {
                state.max_iters(60).target_cost(aim.tolerance * aim.tolerance)
            })
            .add_observer(path.clone(), argmin::core::observers::ObserverMode::Always)
            .timer(false)
            .run()?;
        let why = reason(run.state.get_termination_reason());
        Ok(logged.search(Rule::Bisection, &path.list(), aim, why))
    }

    /// The paper's descent; where it does not reach the tolerance, bisection after it.
    ///
    /// # Errors
    ///
    /// Those of the simulation.
    pub fn aim(&self, aim: &Aim) -> Result<Search, Error> {
        let mut search = self.descend(aim)?;
        if !search.reached {
            let second = self.bisect(aim)?;
            search.iterates.extend(second.iterates);
            search.reached = second.reached;
            search.evaluations += second.evaluations;
            search.why = format!("descent: {}; bisection: {}", search.why, second.why);
        }
        Ok(search)
    }
}

fn reason(reason: Option<&TerminationReason>) -> String {
    match reason {
        Some(TerminationReason::TargetCostReached) => "the end frame is within the tolerance".to_owned(),
        Some(TerminationReason::MaxItersReached) => "the iterations are used up".to_owned(),
        Some(other) => other.text().to_owned(),
        None => "stopped".to_owned(),
    }
}

/// An objective that remembers the end frame of every film it has grown.
struct Logged<'o> {
    objective: &'o EndFrameObjective<'o>,
    films: RefCell<Vec<(f64, Option<EndFrame>)>>,
}

impl<'o> Logged<'o> {
    fn of(objective: &'o EndFrameObjective<'o>) -> Self {
        Self { objective, films: RefCell::default() }
    }

    fn residual(&self, beta: f64) -> Result<f64, Error> {
        let end = self.objective.end_frame(beta)?;
        self.films.borrow_mut().push((beta, end));
        Ok(self.objective.number(end) - self.objective.target)
    }

    fn search(&self, rule: Rule, path: &[Iterate], aim: &Aim, why: String) -> Search {
        let films = self.films.borrow();
        let end = |beta: f64| films.iter().find(|(x, _)| *x == beta).and_then(|(_, end)| *end);
        let iterates: Vec<Aimed> =
            path.iter().map(|i| Aimed { rule, step: i.step, beta: i.x, end: end(i.x) }).collect();
        // What the user sees is the whole frame, whichever number the search used.
        let misses = |end: EndFrame| (end.frame as f64 - self.objective.target).abs();
        let reached =
            iterates.last().and_then(|last| last.end).is_some_and(|end| misses(end) <= aim.tolerance);
        Search { iterates, reached, evaluations: films.len() as u64, why }
    }
}

impl CostFunction for &Logged<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, beta: &f64) -> Result<f64, Error> {
        let residual = self.residual(*beta)?;
        Ok(residual * residual)
    }
}

impl Operator for &Logged<'_> {
    type Param = f64;
    type Output = f64;

    fn apply(&self, beta: &f64) -> Result<f64, Error> {
        self.residual(*beta)
    }
}

#[cfg(test)]
mod tests {
    use argmin::core::Gradient;
    use argmin::solver::goldensectionsearch::GoldenSectionSearch;

    use super::*;
    use crate::frost::{Edge, EndOf, EndRule, Inflow, Parameters, Redraw, RingTouchingIce, TSim};
    use crate::hexgrid::{Axial, Region};
    use crate::rng::Seed;

    fn objective(region: &Region, target: f64) -> EndFrameObjective<'_> {
        EndFrameObjective {
            region,
            starts: &[Axial::ORIGIN],
            parameters: Parameters {
                alpha: 1.0,
                beta: 0.0,
                gamma: 0.005,
                threshold: 0.0,
                steps_per_frame: 4,
                inflow: Inflow::ReiterGated,
                redraw: Redraw::Frame,
                edge: Edge::Reflecting,
                ring_touching_ice: RingTouchingIce::Zero,
            },
            seed: Seed(1),
            rule: EndRule { share: 0.9, of: EndOf::AllCells },
            target,
            t_sim: TSim::Interpolated,
            h: 0.01,
            frame_limit: 2000,
        }
    }

    fn search(target: f64, eta: f64) -> Search {
        let region = Region::hexagon(12);
        let aim =
            Aim { start: 0.25, eta, tolerance: 4.0, derivative: Derivative::Secant, h: 0.01, iterations: 20 };
        objective(&region, target).aim(&aim).unwrap()
    }

    /// The objective is argmin's: its own solvers take it as it is.
    #[test]
    fn argmins_own_solvers_take_the_objective() {
        let region = Region::hexagon(12);
        let solver = GoldenSectionSearch::new(0.05, 0.9).unwrap().with_tolerance(1e-3).unwrap();
        let run = Executor::new(objective(&region, 80.0), solver)
            .configure(|state| state.param(0.25).max_iters(60).target_cost(16.0))
            .timer(false)
            .run()
            .unwrap();
        assert!(run.state.get_best_cost() <= 16.0, "{}", run.state.get_best_cost());
        let slope = objective(&region, 80.0).gradient(&0.25).unwrap();
        assert!(slope < 0.0, "too late a film wants more vapour: {slope}");
    }

    #[test]
    fn a_film_ends_in_the_frame_that_was_asked_for() {
        for target in [40.0, 80.0, 130.0] {
            let search = search(target, 1e-6);
            let end = search.last().unwrap().end.unwrap();
            assert!(search.reached && (end.frame as f64 - target).abs() <= 4.0, "{target}: {search:?}");
            assert!(search.evaluations as usize >= search.iterates.len());
        }
    }

    #[test]
    fn where_descent_leaves_the_domain_bisection_takes_over() {
        let search = search(40.0, 1.0);
        assert!(search.reached && search.iterates.iter().any(|i| i.rule == Rule::Bisection));
        assert!(search.why.contains("leaves 0..1"), "{}", search.why);
    }

    #[test]
    fn a_target_that_cannot_be_met_is_said_to_be_none() {
        let search = search(100_000.0, 1e-6);
        assert!(!search.reached);
    }
}
