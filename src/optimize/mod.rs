//! Minimising a number that a simulation gives, as argmin `Solver`s: they stand beside argmin's own.
//!
//! | solver | rule |
//! |---|---|
//! | [`FixedStepDescent`] | x − η f′(x), the derivative taken in one of several ways |
//! | [`Bisection`] | halves a bracket of the residual |
//!
//! [`forensics`] goes the other way: from printed iterates to the rule that can have produced them.
//!
//! History is observed from outside ([`Iterates`]): a solver does not print. Evaluations are counted by the problem,
//! derivatives included.

mod bisection;
mod descent;
pub mod forensics;
mod iterates;

pub use bisection::Bisection;
pub use descent::{Derivative, FixedStepDescent};
pub use iterates::{Iterate, Iterates};
