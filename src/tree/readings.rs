//! How the page is read where it leaves a choice, equation by equation.

use crate::reading::Reading;

/// Names for the variants.
macro_rules! reading {
    ($reading:ident, $what:literal: $($variant:ident = $name:literal),+ $(,)?) => {
        impl Reading for $reading {
            const QUANTITY: &'static str = $what;
            const ALL: &'static [Self] = &[$(Self::$variant),+];

            fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name),+
                }
            }
        }
    };
}

/// The new position, Eq. (10).
///
/// Transcribed: `P(t + dt) = P(t) + v(t + dt)`; dt is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// As it stands: v is a displacement per step. As dt goes to 0 this becomes an overdamped motion without dt.
    AsPrinted,
    /// `P + v dt`.
    TimesDt,
}
reading! { Position, "position": AsPrinted = "as-printed", TimesDt = "times-dt" }

/// The damping 0.83 of Eq. (9).
///
/// Transcribed: `v(t + dt) = K_d v(t) + a dt`, a factor per step; with `P + v dt` that has no limit as dt goes to 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damping {
    /// The factor as it stands, once a step.
    PerStep,
    /// `K_d^(dt / dt_ref)`, [`Parameters::damping_step`](super::Parameters::damping_step) being dt_ref.
    Rate,
}
reading! { Damping, "damping": PerStep = "per-step", Rate = "rate" }

/// One symbol K_d in Eq. (6) and (9), for which §6 lists two numbers, the second as the damping "of the wind".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SharedSymbol {
    /// Reaction 0.8 in (6), damping 0.83 in (9).
    TwoNumbers,
    /// 0.8 in both, and 0.83 is a factor on the wind at a node.
    OneNumber,
}
reading! { SharedSymbol, "shared-symbol": TwoNumbers = "two-numbers", OneNumber = "one-number" }

/// Whether gravity is among the forces of Eq. (7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gravity {
    /// As Eq. (7) has it.
    AsPrinted,
    /// Not: the pose at rest is one that gravity has already bent.
    RestPose,
}
reading! { Gravity, "gravity": AsPrinted = "as-printed", RestPose = "rest-pose" }

/// The place P_0 that Eq. (5) pulls to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Turned with the parent's link (§3.4.2).
    Rotated,
    /// Fixed to the parent, but not turned.
    Absolute,
}
reading! { Target, "target": Rotated = "rotated", Absolute = "absolute" }

/// v_i of Eq. (3), a velocity subtracted from one in m/s, while Eq. (10) makes v a displacement per step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AirSpeed {
    /// v as it is kept.
    AsPrinted,
    /// The displacement of the last step over dt.
    PerTime,
}
reading! { AirSpeed, "air-speed": AsPrinted = "as-printed", PerTime = "per-time" }

/// The velocity after Eq. (11) has given the links their lengths back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VelocityAfterLength {
    /// Kept as Eq. (9) gave it.
    Kept,
    /// That of the way that the node has in fact gone.
    Corrected,
}
reading! { VelocityAfterLength, "velocity-after-length": Kept = "kept", Corrected = "corrected" }

/// The force of the wind, Eq. (3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drag {
    /// Linear in the velocity, as it stands.
    AsPrinted,
    /// `rho C_d / 2 |v| v` on the link's shadow, 2 r l.
    Quadratic,
}
reading! { Drag, "drag": AsPrinted = "as-printed", Quadratic = "quadratic" }

/// What the tree does to the wind (§5.2).
///
/// Transcribed: f_w, "the wind speed at the node", is taken off the nodes of the grid around it, times K_b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exchange {
    /// `-K_b` times the wind's velocity at the node, as an acceleration.
    Speed,
    /// `-K_b` times the force of Eq. (3), as an acceleration.
    Force,
    /// Minus the force of Eq. (3) on the mass of air around: momentum is conserved.
    Consistent,
    /// Nothing.
    OneWay,
}
reading! { Exchange, "exchange": Speed = "speed", Force = "force", Consistent = "consistent", OneWay = "one-way" }
