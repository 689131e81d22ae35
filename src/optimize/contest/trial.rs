//! One solver on one problem with one seed.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Once;

use super::entrant::Entrant;
use super::oracle::{Evaluation, Oracle, Stop};
use super::problem::{Problem, Target};
use crate::rng::Seed;

/// How a trial ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// The target is met.
    Reached,
    /// As many evaluations were made as are allowed.
    Budget,
    /// The solver was content.
    Stopped,
    /// It asked again and again for what it knew.
    Stalled,
    /// It ended outside of the box, or at no number.
    LeftDomain,
    /// It or the model reported an error, or it panicked.
    Error,
    /// It never evaluated anything.
    Silent,
    /// It has no form for so many dimensions: it was not asked, and does not count.
    Inapplicable,
}

impl Status {
    /// In kebab-case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reached => "reached",
            Self::Budget => "budget",
            Self::Stopped => "stopped",
            Self::Stalled => "stalled",
            Self::LeftDomain => "left-domain",
            Self::Error => "error",
            Self::Silent => "silent",
            Self::Inapplicable => "inapplicable",
        }
    }
}

/// What a solver did with a problem and a seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The problem's name.
    pub problem: String,
    /// The solver's name.
    pub solver: String,
    /// The seed.
    pub seed: u64,
    /// Number of dimensions.
    pub dimension: usize,
    /// The problem's targets, easiest first.
    pub targets: Vec<Target>,
    /// The cost of the start, whether or not the solver asked for it: what a data profile measures from.
    pub start_cost: Option<f64>,
    /// Every evaluation, in order.
    pub log: Vec<Evaluation>,
    /// How it ended; for a single target ask [`runtime`](Self::runtime).
    pub status: Status,
    /// Why, in a few words.
    pub reason: String,
}

/// Evaluations to a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival<'t> {
    /// Evaluations to the target, or all that were made without meeting it.
    pub evaluations: u64,
    /// How it ended as far as this target is concerned.
    pub status: Status,
    /// Why the target was not met; empty if it was.
    pub reason: &'t str,
}

impl Trial {
    /// Lets a solver try, with at most so many evaluations.
    ///
    /// Whatever it does, there is a trial: an error, a panic and silence are ways to end.
    pub fn run(problem: &dyn Problem, entrant: &Entrant, seed: Seed, budget: u64) -> Self {
        let oracle = Oracle::new(problem, seed, budget);
        let dimension = oracle.dimension();
        let answer = match entrant.applies(dimension) {
            true => shielded(|| entrant.solve(&oracle)),
            false => Ok(Ok(format!("has no form for {dimension} dimensions"))),
        };
        let (log, stop) = oracle.into_log();
        let outside = log.last().is_some_and(|last| !last.inside);
        let (status, reason) = match (stop, answer) {
            (Some(Stop::Reached), _) => (Status::Reached, String::new()),
            (Some(stop @ Stop::Budget), _) => (Status::Budget, stop.to_string()),
            (Some(stop @ Stop::NoNumber), _) => (Status::LeftDomain, stop.to_string()),
            (Some(stop @ Stop::Stalled), _) => (Status::Stalled, stop.to_string()),
            (Some(Stop::Broken(why)), _) => (Status::Error, why),
            (None, Err(_)) => (Status::Error, "panicked".to_owned()),
            (None, Ok(Err(error))) if outside => (Status::LeftDomain, error.to_string()),
            (None, Ok(Ok(why))) if outside => (Status::LeftDomain, why),
            (None, Ok(Err(error))) => (Status::Error, error.to_string()),
            (None, Ok(Ok(why))) if !entrant.applies(dimension) => (Status::Inapplicable, why),
            (None, Ok(Ok(why))) if log.is_empty() => (Status::Silent, why),
            (None, Ok(Ok(why))) => (Status::Stopped, why),
        };
        Self {
            problem: problem.name(),
            solver: entrant.name.clone(),
            seed: seed.0,
            dimension,
            targets: problem.targets(),
            start_cost: problem.measure(&problem.start(seed), seed).ok().map(|measure| measure.cost),
            log,
            status,
            reason: one_line(&reason),
        }
    }

    /// Whether the solver could be asked at all.
    pub fn counts(&self) -> bool {
        self.status != Status::Inapplicable
    }

    /// Evaluations to a target. An x outside of the box that meets it costs more than the nearest x inside, which so
    /// does, too.
    pub fn runtime(&self, target: Target) -> Arrival<'_> {
        match self.log.iter().position(|evaluation| evaluation.cost <= target.cost) {
            Some(before) => Arrival { evaluations: before as u64 + 1, status: Status::Reached, reason: "" },
            None => Arrival { evaluations: self.log.len() as u64, status: self.status, reason: &self.reason },
        }
    }

    /// Evaluations to a target that was met.
    pub fn arrival(&self, target: Target) -> Option<u64> {
        let arrival = self.runtime(target);
        (arrival.status == Status::Reached).then_some(arrival.evaluations)
    }

    /// The best evaluation, the first of equals; none if nothing has a cost that is a number.
    pub fn best(&self) -> Option<&Evaluation> {
        let with_cost = self.log.iter().filter(|evaluation| !evaluation.cost.is_nan());
        with_cost.fold(None, |best: Option<&Evaluation>, next| match best {
            Some(best) if best.cost <= next.cost => Some(best),
            _ => Some(next),
        })
    }

    /// The least cost after each evaluation.
    pub fn best_so_far(&self) -> Vec<f64> {
        let mut best = f64::INFINITY;
        let after = |evaluation: &Evaluation| {
            best = best.min(evaluation.cost);
            best
        };
        self.log.iter().map(after).collect()
    }
}

thread_local! {
    static SHIELDED: Cell<bool> = const { Cell::new(false) };
}

/// Catches a panic, and says nothing of it: some solvers panic on an error that they should pass on.
fn shielded<T>(solve: impl FnOnce() -> T) -> std::thread::Result<T> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |panicked| {
            if !SHIELDED.get() {
                before(panicked);
            }
        }));
    });
    SHIELDED.set(true);
    let result = catch_unwind(AssertUnwindSafe(solve));
    SHIELDED.set(false);
    result
}

/// A reason short enough for a row of a table.
fn one_line(reason: &str) -> String {
    const MOST: usize = 60;
    let words = reason.split_whitespace().collect::<Vec<_>>().join(" ");
    match words.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &words[..end]),
        None => words,
    }
}
