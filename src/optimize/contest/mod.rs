//! Solvers compared on the same problems, from the same starts, with the same budget of evaluations.
//!
//! After COCO (Hansen et al., *COCO: a platform for comparing continuous optimizers in a black-box setting*,
//! Optimization Methods and Software 36, 2021): a runtime is a number of evaluations to a target, never a time.
//!
//! | to | open |
//! |---|---|
//! | add a problem | [`Problem`] |
//! | add a solver | [`Entrant`], [`Oracle`] |
//! | see who takes part, with which settings | [`field()`] |
//! | compare | [`Contest`], [`Trial`] |
//! | summarise | [`Standing`], [`Landscape`] |
//!
//! ```
//! use snowglobe::optimize::contest::{Contest, Entrant, Family};
//! use snowglobe::problems::control;
//!
//! let halving = Entrant::new("halving", Family::Direct, "always towards the middle", |oracle| {
//!     let mut x = oracle.start().to_vec();
//!     loop {
//!         oracle.evaluate(&x)?; // an error when the budget is used up: pass it on
//!         x.iter_mut().for_each(|x| *x *= 0.5);
//!     }
//! });
//! let contest = Contest::new(control::boxed(control::suite()), vec![halving]).seeds(2).budget(40);
//! let trials = contest.run();
//! assert_eq!(trials.len(), contest.problems().len() * 2);
//! ```

mod entrant;
mod field;
mod ioh;
mod oracle;
mod problem;
mod standing;
mod statistics;
#[cfg(test)]
mod tests;
mod trial;
mod truth;
mod view;

pub use entrant::{Entrant, Family};
pub use field::field;
pub use ioh::{IohFile, export};
pub use oracle::{Evaluation, Oracle};
pub use problem::{Measure, Problem, Target};
pub use standing::{Paired, Standing, data_profile, pairs, standings, summary};
pub use statistics::*;
pub use trial::{Arrival, Status, Trial};
pub use truth::{Landscape, Rank};
pub use view::{Annealed, Line, Root, View};

use rayon::prelude::*;

use crate::rng::Seed;

/// Problems, solvers, seeds and a budget.
pub struct Contest {
    problems: Vec<Box<dyn Problem + Send>>,
    entrants: Vec<Entrant>,
    seeds: Vec<u64>,
    budget: Budget,
}

/// Evaluations that a solver may make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Budget {
    /// So many.
    Evaluations(u64),
    /// So many for each dimension and one more, as simplex gradients count (Moré & Wild 2009).
    PerDimension(u64),
}

impl Budget {
    /// Evaluations in so many dimensions.
    pub fn evaluations(self, dimension: usize) -> u64 {
        match self {
            Self::Evaluations(evaluations) => evaluations,
            Self::PerDimension(each) => each * (dimension as u64 + 1),
        }
    }
}

/// A solver, a problem and a seed, by their place in the contest's lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pairing {
    /// Which problem.
    pub problem: usize,
    /// Which solver.
    pub entrant: usize,
    /// The seed of the problem, of its start and of the solver.
    pub seed: u64,
}

impl Contest {
    /// These solvers on these problems, with seed 1 and 50 evaluations for each dimension and one more.
    pub fn new(problems: Vec<Box<dyn Problem + Send>>, entrants: Vec<Entrant>) -> Self {
        Self { problems, entrants, seeds: vec![1], budget: Budget::PerDimension(50) }
    }

    /// The same with seeds 1 to `count`.
    #[must_use]
    pub fn seeds(self, count: u64) -> Self {
        self.with_seeds((1..=count).collect())
    }

    /// The same with these seeds.
    #[must_use]
    pub fn with_seeds(mut self, seeds: Vec<u64>) -> Self {
        self.seeds = seeds;
        self
    }

    /// The same with so many evaluations for each solver.
    #[must_use]
    pub fn budget(self, evaluations: u64) -> Self {
        self.with_budget(Budget::Evaluations(evaluations))
    }

    /// The same with this budget.
    #[must_use]
    pub fn with_budget(mut self, budget: Budget) -> Self {
        self.budget = budget;
        self
    }

    /// The problems.
    pub fn problems(&self) -> &[Box<dyn Problem + Send>] {
        &self.problems
    }

    /// The solvers.
    pub fn entrants(&self) -> &[Entrant] {
        &self.entrants
    }

    /// Every trial that is to be made: problem by problem, solver by solver, seed by seed. A solver for one dimension
    /// is paired with problems of more, too, so that nobody is missing: it ends as inapplicable.
    pub fn pairings(&self) -> Vec<Pairing> {
        let mut pairings = Vec::new();
        for problem in 0..self.problems.len() {
            for entrant in 0..self.entrants.len() {
                pairings.extend(self.seeds.iter().map(|&seed| Pairing { problem, entrant, seed }));
            }
        }
        pairings
    }

    /// Makes one trial.
    pub fn play(&self, pairing: &Pairing) -> Trial {
        let problem = &*self.problems[pairing.problem];
        let budget = self.budget.evaluations(problem.domain().len());
        Trial::run(problem, &self.entrants[pairing.entrant], Seed(pairing.seed), budget)
    }

    /// Makes all trials, on all threads; they keep the order of the pairings.
    pub fn run(&self) -> Vec<Trial> {
        self.pairings().par_iter().map(|pairing| self.play(pairing)).collect()
    }
}
