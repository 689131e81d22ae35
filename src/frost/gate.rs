//! The random numbers of §3.2: which neighbours of ice miss their gamma.

use super::parameters::Parameters;
use super::readings::Redraw;
use crate::rng::{Moment, Seed, Stream};

/// `r_t(p)`, for the t at hand.
#[derive(Clone, Debug)]
pub(super) struct Gate {
    stream: Stream,
    redraw: Redraw,
    steps_per_frame: u64,
    // No number can decide anything at r_th 0, which all of (0, 1) exceeds, nor at 1, which none does.
    drawn: bool,
    now: Option<(u64, Moment)>,
}

impl Gate {
    pub(super) fn new(parameters: &Parameters, seed: Seed) -> Self {
        Self {
            stream: seed.stream("r_t"),
            redraw: parameters.redraw,
            steps_per_frame: u64::from(parameters.steps_per_frame),
            drawn: parameters.threshold > 0.0 && parameters.threshold < 1.0,
            now: None,
        }
    }

    /// Goes to the t of this step.
    pub(super) fn turn(&mut self, step: u64) {
        if !self.drawn {
            return;
        }
        let time = match self.redraw {
            Redraw::Frame => step / self.steps_per_frame,
            Redraw::Step => step,
            Redraw::Cell => 0,
        };
        if self.now.as_ref().is_none_or(|(t, _)| *t != time) {
            self.now = Some((time, self.stream.at(time)));
        }
    }

    /// The t and its numbers; none where they decide nothing.
    pub(super) fn now(&self) -> Option<(u64, &Moment)> {
        self.now.as_ref().map(|(time, moment)| (*time, moment))
    }

    /// Whether a cell that misses its gamma once misses it for ever.
    pub(super) fn is_fixed(&self) -> bool {
        !self.drawn || self.redraw == Redraw::Cell
    }
}
