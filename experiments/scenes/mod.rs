//! What stands behind the papers' pictures: ours, for the papers' own are lost.

pub mod sky;
