//! The path of a search, observed from outside.

use std::sync::{Arc, Mutex};

use argmin::core::observers::Observe;
use argmin::core::{Error, KV, State};

/// One iterate of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iterate {
    /// Its number; 0 is the start.
    pub step: u64,
    /// The parameter.
    pub x: f64,
    /// The objective there.
    pub cost: f64,
}

/// An observer that writes the iterates down; clones share one list.
#[derive(Clone, Debug, Default)]
pub struct Iterates(Arc<Mutex<Vec<Iterate>>>);

impl Iterates {
    /// The iterates so far, the start first.
    pub fn list(&self) -> Vec<Iterate> {
        self.0.lock().map(|list| list.clone()).unwrap_or_default()
    }

    fn note<I: State<Param = f64, Float = f64>>(&self, state: &I) {
        if let (Some(x), Ok(mut list)) = (state.get_param(), self.0.lock()) {
            let iterate = Iterate { step: list.len() as u64, x: *x, cost: state.get_cost() };
            // A solver that stops where it stands reports its last iterate once more.
            if list.last().is_none_or(|last| last.x != iterate.x) {
                list.push(iterate);
            }
        }
    }
}

impl<I: State<Param = f64, Float = f64>> Observe<I> for Iterates {
    fn observe_init(&mut self, _solver: &str, state: &I, _kv: &KV) -> Result<(), Error> {
        self.note(state);
        Ok(())
    }

    fn observe_iter(&mut self, state: &I, _kv: &KV) -> Result<(), Error> {
        self.note(state);
        Ok(())
    }
}
