//! Problems for optimisers, one file for each model: what a solver that takes part in a [`contest`] is given to solve.
//!
//! | file | problems |
//! |---|---|
//! | [`frost`] | the initial value that ends a film in a chosen frame |
//! | [`sectors`] | the initial value in each sector, so that ice reaches the border everywhere in a chosen frame |
//! | [`mod@tree`] | the restoring and wind coefficients that make a tree move as one that was filmed |
//! | [`clouds`] | the dimension, gain and cut that make a picture with the statistics of one that was given |
//! | [`automaton`] | the probabilities that make a sky cloud over as a curve of cover says |
//! | [`control`] | functions with a known minimum: whether the contest is fair |
//!
//! Another model adds a file with a type that is a [`Problem`] and a function that lists its suite.
//!
//! [`contest`]: crate::optimize::contest
//! [`Problem`]: crate::optimize::contest::Problem

pub mod automaton;
pub mod clouds;
pub mod control;
pub mod frost;
pub mod sectors;
pub mod tree;

use crate::optimize::contest::Problem;
use crate::rng::Seed;

/// The problems of one suite.
pub type Suite = Vec<Box<dyn Problem + Send>>;

/// A place in a box, drawn with a seed under a name: uniform, on each side from the share `low` of it on, over the share
/// `span`.
fn drawn(seed: Seed, name: &str, domain: &[(f64, f64)], low: f64, span: f64) -> Vec<f64> {
    let moment = seed.stream(name).at(0);
    let inside = |(k, (from, to)): (usize, &(f64, f64))| {
        from + (to - from) * (low + span * moment.place(k as i32, 0, 0).uniform())
    };
    domain.iter().enumerate().map(inside).collect()
}
