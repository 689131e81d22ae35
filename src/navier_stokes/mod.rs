//! Incompressible flow in a box: Navier-Stokes by the marker-and-cell (MAC) method.
//!
//! ```text
//! div v = 0                                                        Eq. (12)
//! dv/dt = -(v . grad) v - grad phi + nu laplace v + f              Eq. (13)
//! ```
//!
//! The numbers are those of Sakai, Ueda & Yamaguchi, "物理モデルによる風の流を考慮した樹木の揺れのシミュレーションの研究", whose wind it is.
//!
//! | symbol | name here | meaning | unit |
//! |---|---|---|---|
//! | v = (u, v) | `velocity` | velocity | m/s |
//! | phi | `pressure` | pressure over density | m2/s2 |
//! | nu | `viscosity` | kinematic viscosity | m2/s |
//! | f | `push` | force from outside over mass | m/s2 |
//!
//! | to | open |
//! |---|---|
//! | run the paper's own form: all unknowns in the nodes, §4.2 | [`Collocated`] |
//! | run a form that conserves mass: velocities on the faces | [`Staggered`] |
//! | solve for the pressure | [`Poisson`]; [`relax`], which is slower, to compare |
//! | know the largest time step | [`Step::largest`] |
//! | check a solver | [`exact`], [`Cavity`] |
//! | read a velocity or leave a force between nodes, Eq. (19) | [`Lattice`] |
//!
//! Here are two dimensions. The parts that know of them are the two solvers and [`Lattice`]; the transform takes rows of
//! any grid. The middle of the ground is the origin, x along the wind, y up.

mod bound;
mod cavity;
mod collocated;
mod cosine;
mod domain;
pub mod exact;
mod kernel;
mod lattice;
mod poisson;
mod relaxation;
mod stability;
mod staggered;
#[cfg(test)]
mod tests;

pub use cavity::{Cavity, Circulation, Scheme};
pub use collocated::{Collocated, Forcing, WallPressure};
pub use domain::{Convection, Domain, Flow, FlowError, Side, Sides};
pub use lattice::{Corners, Lattice};
pub use poisson::Poisson;
pub use relaxation::{Relaxed, relax};
pub use stability::Step;
pub(crate) use stability::larger_root;
pub use staggered::Staggered;
