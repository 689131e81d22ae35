//! What a solver sees of a problem: it may ask for the cost of an x, and every answer is counted.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

use argmin::core::{Error, Executor, Solver, State};

use super::problem::{Measure, Problem};
use super::view::View;
use crate::rng::{Seed, Stream};

/// One answer: an evaluation that was paid for.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// Where.
    pub x: Vec<f64>,
    /// What the solver was told; outside of the box it includes the penalty.
    pub cost: f64,
    /// Whether x lies in the box.
    pub inside: bool,
}

/// Why no more is answered.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stop {
    /// The last target is met.
    Reached,
    /// As many evaluations were made as are allowed.
    Budget,
    /// x is not a finite number.
    NoNumber,
    /// It asks again and again for what it was told.
    Stalled,
    /// The model broke.
    Broken(String),
}

impl std::fmt::Display for Stop {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Reached => f.write_str("the last target is met"),
            Self::Budget => f.write_str("the budget is used up"),
            Self::NoNumber => f.write_str("x is not finite"),
            Self::Stalled => f.write_str("asks for what it knows"),
            Self::Broken(why) => f.write_str(why),
        }
    }
}

/// Questions per evaluation of the budget before a solver that learns nothing new is sent away.
const PATIENCE: u64 = 20;

/// A problem's public face, for one solver with one seed.
///
/// * The first answer for an x is an evaluation; asking again is free, since a film is not grown twice.
/// * Outside of the box the answer is that of the nearest x inside plus the squared distance in units of the box's
///   width and the problem's scale (the penalty of BBOB: Hansen et al., INRIA RR-6829, 2009, p. 3).
/// * When the budget is used up or the last target met, every further answer is an error, which a solver passes on.
pub struct Oracle<'p> {
    problem: &'p dyn Problem,
    seed: Seed,
    domain: Vec<(f64, f64)>,
    start: Vec<f64>,
    scale: f64,
    difference: f64,
    enough: f64,
    budget: u64,
    asked: Cell<u64>,
    known: RefCell<BTreeMap<Vec<u64>, Measure>>,
    log: RefCell<Vec<Evaluation>>,
    stop: RefCell<Option<Stop>>,
}

impl<'p> Oracle<'p> {
    pub(super) fn new(problem: &'p dyn Problem, seed: Seed, budget: u64) -> Self {
        let enough = problem.targets().last().map_or(f64::NEG_INFINITY, |target| target.cost);
        Self {
            domain: problem.domain(),
            start: problem.start(seed),
            scale: problem.scale(),
            difference: problem.difference(),
            enough,
            problem,
            seed,
            budget,
            asked: Cell::new(0),
            known: RefCell::default(),
            log: RefCell::default(),
            stop: RefCell::default(),
        }
    }

    /// Number of dimensions.
    pub fn dimension(&self) -> usize {
        self.domain.len()
    }

    /// The box, a pair of faces for each dimension.
    pub fn domain(&self) -> &[(f64, f64)] {
        &self.domain
    }

    /// Where every solver starts.
    pub fn start(&self) -> &[f64] {
        &self.start
    }

    /// The cost of a bad x.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The difference, as a part of the box's width, over which a derivative tells something.
    pub fn difference(&self) -> f64 {
        self.difference
    }

    /// Evaluations that are left.
    pub fn budget_left(&self) -> u64 {
        self.budget - self.log.borrow().len() as u64
    }

    /// Iterations after which argmin gives a solver up that never asks anything.
    pub fn patience(&self) -> u64 {
        self.budget.saturating_mul(PATIENCE)
    }

    /// Random numbers for a solver: the same for all solvers that use the same name.
    pub fn stream(&self, name: &str) -> Stream {
        self.seed.stream(name)
    }

    /// The cost of x, which must have as many coordinates as there are dimensions.
    ///
    /// # Errors
    ///
    /// Nothing more is answered; pass the error on.
    pub fn evaluate(&self, x: &[f64]) -> Result<f64, Error> {
        Ok(self.ask(x)?.cost)
    }

    /// The residual at x, the signed number whose square is the cost.
    ///
    /// # Errors
    ///
    /// As [`evaluate`](Self::evaluate), and where the problem has no residual.
    pub fn residual(&self, x: &[f64]) -> Result<f64, Error> {
        self.ask(x)?.residual.ok_or_else(|| Error::msg("this problem has no residual"))
    }

    /// The problem in units of its box and its scale, as the general solvers want it.
    pub fn unit(&self) -> View<'_> {
        View::unit(self)
    }

    /// The problem as it is.
    pub fn native(&self) -> View<'_> {
        View::native(self)
    }

    /// Runs an argmin solver on a view of this problem; says why it stopped.
    ///
    /// # Errors
    ///
    /// What the solver answers, an answer withheld among it.
    pub fn run<O, S, I>(&self, view: O, solver: S, configure: impl FnOnce(I) -> I) -> Result<String, Error>
    where
        S: Solver<O, I>,
        I: State<Float = f64>,
    {
        let run = Executor::new(view, solver).configure(configure).timer(false).run()?;
        Ok(run.state.get_termination_reason().map_or_else(|| "stopped".to_owned(), |r| r.text().to_owned()))
    }

    fn ask(&self, x: &[f64]) -> Result<Measure, Error> {
        if let Some(stop) = &*self.stop.borrow() {
            return Err(Error::msg(stop.to_string()));
        }
        let asked = self.asked.get() + 1;
        self.asked.set(asked);
        if x.len() != self.dimension() || !x.iter().all(|x| x.is_finite()) {
            return self.refuse(Stop::NoNumber);
        }
        let key: Vec<u64> = x.iter().map(|x| x.to_bits()).collect();
        if let Some(known) = self.known.borrow().get(&key) {
            return match asked > self.patience() {
                true => self.refuse(Stop::Stalled),
                false => Ok(*known),
            };
        }
        if self.budget_left() == 0 {
            return self.refuse(Stop::Budget);
        }
        let (nearest, penalty) = self.nearest(x);
        let measure = match self.problem.measure(&nearest, self.seed) {
            Ok(measure) => Measure { cost: measure.cost + penalty, ..measure },
            Err(broken) => return self.refuse(Stop::Broken(broken.to_string())),
        };
        self.known.borrow_mut().insert(key, measure);
        let inside = penalty == 0.0;
        self.log.borrow_mut().push(Evaluation { x: x.to_vec(), cost: measure.cost, inside });
        match measure.cost <= self.enough {
            true => self.refuse(Stop::Reached),
            false => Ok(measure),
        }
    }

    /// The nearest x inside, and what its distance costs.
    fn nearest(&self, x: &[f64]) -> (Vec<f64>, f64) {
        let nearest: Vec<f64> =
            x.iter().zip(&self.domain).map(|(x, (low, high))| x.clamp(*low, *high)).collect();
        let parts = x.iter().zip(&nearest).zip(&self.domain);
        let squared = parts.map(|((x, near), (low, high))| {
            let part = (x - near) / (high - low);
            part * part
        });
        (nearest.clone(), self.scale * squared.sum::<f64>())
    }

    fn refuse<T>(&self, stop: Stop) -> Result<T, Error> {
        let error = Error::msg(stop.to_string());
        *self.stop.borrow_mut() = Some(stop);
        Err(error)
    }

    /// What was evaluated, and why nothing more was answered, if that is how it ended.
    pub(super) fn into_log(self) -> (Vec<Evaluation>, Option<Stop>) {
        (self.log.into_inner(), self.stop.into_inner())
    }
}
