//! How the paper is read where its words leave a choice.

use std::fmt;
use std::str::FromStr;

use crate::reading::Reading;

/// A name that is not one of a reading's variants.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reading} cannot be `{name}`; accepted: {accepted}")]
pub struct UnknownName {
    /// Which reading was asked for.
    pub reading: &'static str,
    /// What was given.
    pub name: String,
    /// All names, separated by commas.
    pub accepted: String,
}

/// Names for the variants, both ways.
macro_rules! named {
    ($reading:ident, $what:literal, $count:literal: $($variant:ident = $name:literal),+ $(,)?) => {
        impl $reading {
            /// Every variant, in the order of the documentation.
            pub const ALL: [Self; $count] = [$(Self::$variant),+];

            /// The name in files and on command lines.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name),+
                }
            }
        }

        impl Reading for $reading {
            const QUANTITY: &'static str = $what;
            const ALL: &'static [Self] = &Self::ALL;

            fn name(self) -> &'static str {
                self.name()
            }
        }

        impl fmt::Display for $reading {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.pad(self.name())
            }
        }

        impl FromStr for $reading {
            type Err = UnknownName;

            fn from_str(name: &str) -> Result<Self, UnknownName> {
                Self::ALL.into_iter().find(|variant| variant.name() == name).ok_or_else(|| UnknownName {
                    reading: $what,
                    name: name.to_owned(),
                    accepted: Self::ALL.map(Self::name).join(", "),
                })
            }
        }
    };
}

/// How Eq. (1) is read.
///
/// Transcribed: `u_{t+1}(p) = u_t(p) + D_t(p)` where `r_t(p) <= r_th`, `u_t(p) + gamma` where `r_t(p) > r_th`, with
/// `D_t(p) = alpha/12 (-6 u_t(p) + sum_{q in nn(p)} u_t(q))`, for the neighbours of ice (§3.2). The text before it
/// sends the reader to Reiter for the rest, and Reiter adds gamma *to* the inflow, which Eq. (1) leaves out.
///
/// Below, v is what a cell shows to its neighbours, and `sum v` is over all six of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Inflow {
    /// The equation as it stands: gamma without inflow above r_th, diffusion with the u of all six neighbours at or
    /// below it. Ice gets gamma alone. Elsewhere `u (1 - alpha/2) + alpha/12 sum v`, v = 0 on receptive cells.
    AsPrinted,
    /// Reiter's rule, where a neighbour of ice with r <= r_th misses its gamma and keeps its inflow. v = u on cells
    /// that are not receptive and 0 on those that are; receptive: `u + gamma + alpha/12 sum v`.
    ReiterGated,
    /// As `ReiterGated`, but neighbours of ice with r <= r_th follow the diffusion equation of the other cells,
    /// `u (1 - alpha/2) + alpha/12 sum v`; they show 0 all the same.
    PassiveIsVapour,
    /// As `PassiveIsVapour`, but what those neighbours take in is the u of all six:
    /// `u (1 - alpha/2) + alpha/12 sum u`.
    PassiveDiffuses,
    /// v = u everywhere but on ice, where it is 0; the rest as `ReiterGated`.
    OnlyIceHidden,
}

named! { Inflow, "inflow", 5:
    AsPrinted = "as-printed",
    ReiterGated = "reiter-gated",
    PassiveIsVapour = "passive-is-vapour",
    PassiveDiffuses = "passive-diffuses",
    OnlyIceHidden = "only-ice-hidden",
}

/// How often `r_t(p)` is drawn (§3.2).
///
/// Transcribed: `r_t(p)`, where t is the frame number; but a frame may take several steps of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Redraw {
    /// Once a frame, and held over its steps.
    Frame,
    /// Anew for each step of the solver.
    Step,
    /// Once and for all.
    Cell,
}

named! { Redraw, "redraw", 3: Frame = "frame", Step = "step", Cell = "cell" }

/// What the points around the region hold (§3.3).
///
/// Transcribed: they are never ice, and take the mean of those of their six neighbours that are not boundary points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Edge {
    /// The mean of the u of the neighbours inside, of the same state: what flows out comes back.
    Reflecting,
    /// beta for ever, as in Reiter 2005; whatever they touch.
    Held,
}

named! { Edge, "edge", 2: Reflecting = "reflecting", Held = "held" }

/// What a reflecting point shows once it touches ice (§3.2 and §3.3).
///
/// Transcribed: diffusion is computed with 0.0 on ice and its neighbours (§3.2); boundary points are never ice and
/// take a mean (§3.3). Whether one that touches ice counts as such a neighbour is left open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RingTouchingIce {
    /// 0, as the receptive cells do.
    Zero,
    /// The mean, ice included.
    Mean,
}

named! { RingTouchingIce, "ring-touching-ice", 2: Zero = "zero", Mean = "mean" }

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back() {
        for inflow in Inflow::ALL {
            assert_eq!(inflow.to_string().parse(), Ok(inflow));
        }
        for redraw in Redraw::ALL {
            assert_eq!(redraw.name().parse(), Ok(redraw));
        }
        for edge in Edge::ALL {
            assert_eq!(edge.name().parse(), Ok(edge));
        }
        for ring in RingTouchingIce::ALL {
            assert_eq!(ring.name().parse(), Ok(ring));
        }
    }

    #[test]
    fn a_wrong_name_is_told_the_right_ones() {
        let error = "Frame".parse::<Redraw>().unwrap_err();
        assert_eq!(error.to_string(), "redraw cannot be `Frame`; accepted: frame, step, cell");
    }
}
