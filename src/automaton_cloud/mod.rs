//! Clouds of a cellular automaton (Y. Dobashi, T. Nishita & T. Okita, *Simulation of clouds using a cellular automaton,
//! and their display*; in Japanese, of which the first page survives).
//!
//! | symbol | here | meaning |
//! |---|---|---|
//! | hum | [`Cells::hum`] | there is vapour |
//! | act | [`Cells::act`] | vapour turns into cloud |
//! | cld | [`Cells::cld`] | there is cloud |
//! | ext | [`Cells::ext`] | cloud vanishes |
//! | T_ext | [`Rules::lifetime`] | steps for which cloud that has come does not change |
//! | i, j, k | x, y, z | k rises upwards: Eq. (1) reads act two cells below, not two above |
//! | q, f, D, rho | [`Smoothing`], [`Metaballs`] | central density, profile, effective radius, density, §2.4 |
//!
//! All but the density is 0 or 1. Cells outside of the lattice are 0. A step applies Eq. (1) to (5) to the state at t; what
//! is injected at t + 1, §2.3, comes on top.
//!
//! | to | open |
//! |---|---|
//! | see where the page is disputed | [`Activation`], [`Brackets`], [`Lock`] |
//! | read the rules | [`Cells::step`] |
//! | run them fast, to the same bits | [`Packed`] |
//! | set cells to 1 at random, §2.3 | [`Injection`], [`Chance`], [`Point`] |
//! | have a continuous density, §2.4 | [`Smoothing`], [`Metaballs`] |
//! | display it by billboards, §1 | [`Billboards`], [`Metaball`] |

mod billboard;
mod cells;
mod density;
mod injection;
mod kernel;
mod packed;
mod points;
mod readings;

pub use billboard::{Billboards, Metaball, Shown, Splats};
pub use cells::{Cells, Outside};
pub use density::{Metaballs, Smoothing, profile};
pub use injection::{Chance, Field, Injection};
pub use packed::Packed;
pub use points::{Interpolation, Point, PointError, Points};
pub use readings::{Activation, Brackets, Lock, Rules};
