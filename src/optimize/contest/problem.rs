//! What can be solved.

use argmin::core::Error;

use crate::rng::Seed;

/// An objective that solvers are compared on: a cost over a box, to be brought to 0.
///
/// A model adds problems by implementing this for one type, in one file.
pub trait Problem: Sync {
    /// Its name in kebab-case, unique in its suite.
    fn name(&self) -> String;

    /// The box in which x is sought, a pair of faces for each dimension.
    fn domain(&self) -> Vec<(f64, f64)>;

    /// Where every solver starts with this seed.
    fn start(&self, seed: Seed) -> Vec<f64>;

    /// The cost of a bad x: solvers that care for scale are shown costs in units of it.
    fn scale(&self) -> f64;

    /// The difference, as a part of the box's width, over which a derivative tells something.
    fn difference(&self) -> f64;

    /// The numbers that a solver is timed on, easiest first.
    fn targets(&self) -> Vec<Target>;

    /// What x gives with this seed, for an x in the box.
    ///
    /// # Errors
    ///
    /// Those of the model.
    fn measure(&self, x: &[f64], seed: Seed) -> Result<Measure, Error>;
}

/// What is asked of a solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// The target as it is written: frames, say.
    pub value: f64,
    /// The greatest cost that meets it.
    pub cost: f64,
}

impl Target {
    /// At most so far from the residual's root: the cost is the residual's square.
    pub fn within(value: f64) -> Self {
        Self { value, cost: value * value }
    }

    /// At most this cost.
    pub fn cost(value: f64) -> Self {
        Self { value, cost: value }
    }
}

/// What an evaluation gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// The cost, 0 or more; infinite where the model has no answer.
    pub cost: f64,
    /// The signed number whose square is the cost, where there is one: in one dimension a root may be sought.
    pub residual: Option<f64>,
}

impl Measure {
    /// A residual and its square.
    pub fn of_residual(residual: f64) -> Self {
        Self { cost: residual * residual, residual: Some(residual) }
    }

    /// A cost alone.
    pub fn of_cost(cost: f64) -> Self {
        Self { cost, residual: None }
    }
}
