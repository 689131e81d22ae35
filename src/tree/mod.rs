//! Sakai, Ueda & Yamaguchi: "物理モデルによる風の流を考慮した樹木の揺れのシミュレーションの研究", a tree that sways in a computed wind.
//!
//! A tree is nodes and rigid links. Wind, the restoring force, its reaction and gravity move the nodes; then the links
//! get their lengths back.
//!
//! | symbol | name here | meaning | unit |
//! |---|---|---|---|
//! | m_P, Eq. (1) | [`Skeleton::mass`] | mass of a node's link, `pi r^2 l delta` | kg |
//! | s_P, Eq. (2) | [`Skeleton::surface`] | its surface, `2 pi r l` | m2 |
//! | l_P, r_P | [`Skeleton::length`], [`Skeleton::radius`] | length and radius of the link that ends in P | m |
//! | delta | [`Parameters::density`] | density of wood | kg/m3 |
//! | K_w | [`Parameters::wind`] | F_w = K_w (v_w - v_i) s_P, Eq. (3) | kg/(m2 s) |
//! | K_r | [`Parameters::restoring`] | F_r = pi r^2 / l K_r (P_0 - P), Eq. (5) | N/m2 |
//! | K_d, Eq. (6) | [`Parameters::reaction`] | what of it acts back on the parent | - |
//! | K_d, Eq. (9) | [`Parameters::damping`] | what is left of a velocity after a step | - |
//! | K_b | [`Parameters::branch_on_wind`] | what the wind loses at a node, §5.2 | - |
//!
//! | to | open |
//! |---|---|
//! | see how the page is read | [`Readings`] and its three sets |
//! | move a tree in a wind of your own | [`Tree`] |
//! | let tree and wind act on each other, §5 | [`Sway`] |
//! | know whether it can stand, and the largest step | [`Linearised`] |
//! | draw it | [`Frame`] |

mod drawing;
mod forces;
mod linear;
mod motion;
mod parameters;
mod readings;
mod sets;
mod skeleton;
mod sway;
#[cfg(test)]
mod tests;

pub use drawing::Frame;
pub use linear::{Linearised, Mode};
pub use motion::{Bend, Tree};
pub use parameters::{Parameters, TreeError};
pub use readings::{
    AirSpeed, Damping, Drag, Exchange, Gravity, Position, SharedSymbol, Target, VelocityAfterLength,
};
pub use sets::{ReadingSet, Readings, physical_restoring};
pub use skeleton::{Skeleton, papers_tree};
pub use sway::{Counted, Setting, Sway};

/// A place or a vector in the plane of the tree, m: x along the wind, y up.
pub type Vector = nalgebra::Vector2<f64>;
