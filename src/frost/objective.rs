//! Eq. (2): how far a film is from ending in the frame that the user asked for, as an argmin problem.

use argmin::core::{CostFunction, Error, Gradient, Operator};

use super::{EndFrame, EndRule, FrostError, Parameters, end_frame};
use crate::hexgrid::{Axial, Region};
use crate::reading::Reading;
use crate::rng::Seed;

/// Which number T_sim is (§3.4).
///
/// Transcribed: the frame in which 90 % or more of the points are ice. A whole number makes a staircase of Eq. (2),
/// whose derivative is 0 or a jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TSim {
    /// The first whole frame.
    Whole,
    /// The crossing of the share between the last frame before it and the first one after.
    Interpolated,
}

impl Reading for TSim {
    const QUANTITY: &'static str = "t-sim";
    const ALL: &'static [Self] = &[Self::Whole, Self::Interpolated];

    fn name(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::Interpolated => "interpolated",
        }
    }
}

/// `f(beta) = (T - T_sim(beta))^2`, Eq. (2), for one sketch, one seed and one target.
///
/// As a [`CostFunction`] it is f, as an [`Operator`] the residual `T_sim - T`, as a [`Gradient`] the central difference
/// of f over `h` on either side. Where ice cannot reach the share, T_sim counts as infinitely late.
#[derive(Clone, Debug)]
pub struct EndFrameObjective<'a> {
    /// The sketch.
    pub region: &'a Region,
    /// Where growth starts.
    pub starts: &'a [Axial],
    /// Everything but beta, which is what is sought.
    pub parameters: Parameters,
    /// The seed of r_t(p).
    pub seed: Seed,
    /// When the film ends.
    pub rule: EndRule,
    /// T, in frames.
    pub target: f64,
    /// Which number T_sim is.
    pub t_sim: TSim,
    /// Half the width of the central difference.
    pub h: f64,
    /// Frames after which a film counts as endless.
    pub frame_limit: u64,
}

impl EndFrameObjective<'_> {
    /// The end frame with this initial value; none if ice cannot reach the share.
    ///
    /// # Errors
    ///
    /// As [`end_frame`].
    pub fn end_frame(&self, beta: f64) -> Result<Option<EndFrame>, FrostError> {
        let parameters = Parameters { beta, ..self.parameters };
        end_frame(self.region, self.starts, parameters, self.seed, self.rule, self.frame_limit)
    }

    /// `T_sim(beta)` in frames, infinite where ice cannot reach the share.
    ///
    /// # Errors
    ///
    /// As [`end_frame`].
    pub fn end(&self, beta: f64) -> Result<f64, FrostError> {
        Ok(self.number(self.end_frame(beta)?))
    }

    /// The number that an end frame is, infinite for none.
    pub(super) fn number(&self, end: Option<EndFrame>) -> f64 {
        end.map_or(f64::INFINITY, |end| match self.t_sim {
            TSim::Whole => end.frame as f64,
            TSim::Interpolated => end.interpolated,
        })
    }
}

impl CostFunction for EndFrameObjective<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, beta: &f64) -> Result<f64, Error> {
        let residual = self.end(*beta)? - self.target;
        Ok(residual * residual)
    }
}

impl Operator for EndFrameObjective<'_> {
    type Param = f64;
    type Output = f64;

    fn apply(&self, beta: &f64) -> Result<f64, Error> {
        Ok(self.end(*beta)? - self.target)
    }
}

impl Gradient for EndFrameObjective<'_> {
    type Param = f64;
    type Gradient = f64;

    fn gradient(&self, beta: &f64) -> Result<f64, Error> {
        Ok((self.cost(&(beta + self.h))? - self.cost(&(beta - self.h))?) / (2.0 * self.h))
    }
}
