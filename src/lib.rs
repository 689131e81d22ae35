//! Five papers on snow, frost, clouds and trees in the wind, re-run.
//!
//! The map, from the ground up; nothing may import what stands below it in this list:
//!
//! | floor | modules |
//! |---|---|
//! | ground, no physics | [`rng`], [`reading`], [`hexgrid`], [`image`], [`sketch`], [`mesh`], [`fieldfile`] |
//! | methods | [`optimize`], [`lsystem`], [`navier_stokes`], [`volume`], [`regions`] |
//! | models, one paper each | [`frost`], [`tree`], [`contour_cloud`], [`automaton_cloud`], [`snow`] |
//! | problems for optimisers, one file for each model | [`problems`] |
//! | the harness | [`lab`] |
//!
//! The experiments that use them are programs of their own, in `experiments/`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod automaton_cloud;
pub mod contour_cloud;
pub mod fieldfile;
pub mod frost;
pub mod hexgrid;
pub mod image;
pub mod lab;
pub mod lsystem;
pub mod mesh;
pub mod navier_stokes;
pub mod optimize;
pub mod problems;
pub mod reading;
pub mod regions;
pub mod rng;
pub mod sketch;
pub mod snow;
pub mod tree;
pub mod volume;
