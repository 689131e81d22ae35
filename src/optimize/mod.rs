//! Minimising a number that a simulation gives, as argmin `Solver`s: they stand beside argmin's own.
//!
//! | solver | rule |
//! |---|---|
//! | [`FixedStepDescent`] | x − η f′(x), the derivative taken in one of several ways |
//! | [`FixedStep`] | the same in several dimensions, as a line search of argmin's steepest descent |
//! | [`Bisection`] | halves a bracket of the residual |
//! | [`Secant`] | the root of the line through the last two residuals |
//! | [`CmaEs`] | a normal distribution that learns from the better half of its samples |
//! | [`RandomSearch`] | uniform in a box |
//!
//! [`contest`] compares them, argmin's and anybody's own, on the same problems with the same budget.
//! [`forensics`] goes the other way: from printed iterates to the rule that can have produced them.
//!
//! History is observed from outside ([`Iterates`]): a solver does not print. Evaluations are counted by the problem,
//! derivatives included.

mod bisection;
mod cma_es;
pub mod contest;
mod descent;
mod fixed_step;
pub mod forensics;
mod iterates;
mod random_search;
mod secant;

pub use bisection::Bisection;
pub use cma_es::{CmaEs, Strategy};
pub use descent::{Derivative, FixedStepDescent};
pub use fixed_step::FixedStep;
pub use iterates::{Iterate, Iterates};
pub use random_search::RandomSearch;
pub use secant::Secant;
