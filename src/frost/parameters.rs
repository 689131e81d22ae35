//! The numbers of a run, and what is wrong with them.

use super::readings::{Edge, Inflow, Redraw, RingTouchingIce};

/// The numbers and readings of a run; none has a default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// alpha, the weight of diffusion, 0 to 2: the share of its vapour that a cell gives away in a step is alpha/2.
    pub alpha: f64,
    /// beta, the vapour that every cell holds at first; 1 is ice. Under [`Frost::with_vapour`](super::Frost::with_vapour)
    /// it is no more than what [`Edge::Held`] holds.
    pub beta: f64,
    /// gamma, the vapour that a receptive cell gains per step.
    pub gamma: f64,
    /// r_th, the share of neighbours of ice that miss their gamma, 0 to 1.
    pub threshold: f64,
    /// Steps of the solver in one frame.
    pub steps_per_frame: u32,
    /// How Eq. (1) is read.
    pub inflow: Inflow,
    /// How often r is drawn.
    pub redraw: Redraw,
    /// What the points around the region hold.
    pub edge: Edge,
    /// What such a point shows once it touches ice.
    pub ring_touching_ice: RingTouchingIce,
}

/// Why there is no frost.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FrostError {
    /// A number is infinite or none at all.
    #[error("{name} is {value}; a finite number is needed")]
    NotFinite {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Diffusion would overshoot.
    #[error("alpha is {alpha}; the explicit step is stable from 0 to {most} only")]
    Unstable {
        /// What was given.
        alpha: f64,
        /// The largest that is stable.
        most: f64,
    },
    /// A number is outside what is handled.
    #[error("{name} is {value}; {least} to {most} is handled")]
    OutOfRange {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least.
        least: f64,
        /// The most.
        most: f64,
    },
    /// A start is not a cell of the region.
    #[error("the start {0},{1} is outside the region")]
    StartOutside(i32, i32),
    /// A cell's vapour is none at all, or outside what is handled.
    #[error("the vapour of the cell {q},{r} is {value}; 0 to {most} is handled", most = Parameters::MOST_VAPOUR)]
    Vapour {
        /// Along the row.
        q: i32,
        /// The row.
        r: i32,
        /// The vapour.
        value: f64,
    },
    /// Numbers are missing, or too many.
    #[error("{given} numbers are given; {needed} are needed, one for each {each}")]
    Count {
        /// How many there are.
        given: usize,
        /// How many there must be.
        needed: usize,
        /// What each belongs to.
        each: &'static str,
    },
    /// A share that cannot be an end.
    #[error("the share of ice at the end is {0}; above 0 and at most 1 is handled")]
    Share(f64),
}

impl Parameters {
    /// The largest alpha with which `1 - alpha/2`, the share that a cell keeps, is not negative.
    pub const MOST_ALPHA: f64 = 2.0;
    /// The most vapour that a cell may hold at first.
    pub const MOST_VAPOUR: f64 = 1e6;

    /// Whether the numbers can be run with.
    ///
    /// # Errors
    ///
    /// The first number, in the order of the fields, that cannot.
    pub fn check(&self) -> Result<(), FrostError> {
        let Self { alpha, beta, gamma, threshold, steps_per_frame, .. } = *self;
        if alpha.is_finite() && !(0.0..=Self::MOST_ALPHA).contains(&alpha) {
            return Err(FrostError::Unstable { alpha, most: Self::MOST_ALPHA });
        }
        for (name, value, least, most) in [
            ("alpha", alpha, 0.0, Self::MOST_ALPHA),
            ("beta", beta, 0.0, Self::MOST_VAPOUR),
            ("gamma", gamma, 0.0, 1e6),
            ("threshold", threshold, 0.0, 1.0),
            ("steps_per_frame", f64::from(steps_per_frame), 1.0, 1e5),
        ] {
            if !value.is_finite() {
                return Err(FrostError::NotFinite { name, value });
            }
            if !(least..=most).contains(&value) {
                return Err(FrostError::OutOfRange { name, value, least, most });
            }
        }
        Ok(())
    }
}
