//! Sakai, Ueda & Yamaguchi: a tree that sways in a computed wind.
//!
//! One file per figure or question; what they share is in `setup.rs`.

mod cavity;
mod convergence;
mod figure_1;
mod figure_5;
mod ordering;
mod parameters;
mod plausibility;
mod setup;
mod stability;
mod sway;
mod wind;

use snowglobe::lab::{Paper, ReadingKind};
use snowglobe::reading::Reading;
use snowglobe::tree::ReadingSet;

/// The paper.
pub const PAPER: Paper = Paper {
    id: "sakai",
    title: "物理モデルによる風の流を考慮した樹木の揺れのシミュレーションの研究",
    english: "Simulating the sway of trees with a physical model that takes the flow of the wind into account",
    about: "An L-system grows a tree of nodes and rigid links; a wind computed by the MAC method bends it, and the tree \
            slows the wind.",
    authors: "Sakai, Ueda & Yamaguchi",
    sources: env!("SNOWGLOBE_SAKAI"),
    readings: &[ReadingKind {
        quantity: ReadingSet::QUANTITY,
        says: "Executed word for word the model collapses. Three sets of readings: near the page but sound (paper), as \
               mechanics has it (physical), and word for word with gravity (literal).",
        variants: || ReadingSet::ALL.iter().map(|set| set.name()).collect(),
        default: "paper",
    }],
    experiments: &[
        figure_1::FIGURE_1,
        figure_5::FIGURE_5,
        ordering::ORDERING,
        parameters::PARAMETERS,
        sway::SWAY,
        stability::STABILITY,
        plausibility::PLAUSIBILITY,
        wind::WIND,
        cavity::CAVITY,
        convergence::CONVERGENCE,
    ],
};
