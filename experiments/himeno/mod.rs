//! Himeno, Kenmochi & Kotani: snow from the structure of its crystals.
//!
//! Crystals by an L-system, flakes of them, and a still of a thousand; how they move is an outlook.

mod bands;
mod branching;
mod fall;
mod figure_1;
mod figure_2;
mod figure_3;
mod figure_4;
mod figure_5;
mod figure_6;
mod figure_7;
mod figure_8;
mod figure_9;
mod histories;
mod joined;
mod optics;
mod poster;
mod setup;
pub mod slide;
pub mod stage;
mod symmetry;
#[path = "../scenes/winter/mod.rs"]
pub mod winter;

use snowglobe::lab::{Paper, ReadingKind};
use snowglobe::reading::Reading;
use snowglobe::snow::fall::Drag;
use snowglobe::snow::flake::Assembly;
use snowglobe::snow::{Brackets, Elongation, Layers, Over, Third};

/// The paper.
pub const PAPER: Paper = Paper {
    id: "himeno",
    title: "雪の結晶構造に基づく降雪シーンの CG生成に関する研究",
    english: "Creation of snowing scene based on the structure of snow crystals",
    about: "Crystals grow by an L-system whose speed and branching follow temperature and humidity; they join to flakes, and a \
            thousand of these are rendered as volumes before a picture of snow.",
    authors: "Himeno, Kenmochi & Kotani",
    sources: concat!(env!("SNOWGLOBE_HIMENO"), env!("SNOWGLOBE_SCENES")),
    readings: &[
        ReadingKind {
            quantity: Brackets::QUANTITY,
            says: "`[]` of Eq. (4) is defined as zero or one times: then a branch turns and never branches. The book that the paper \
                   cites has them as push and pop.",
            variants: || Brackets::ALL.iter().map(|reading| reading.name()).collect(),
            default: "push-pop",
        },
        ReadingKind {
            quantity: Third::QUANTITY,
            says: "The third alternative of Eq. (4), f++F, turns by 120 degrees and grows inwards; mirrored it is the second's other \
                   side.",
            variants: || Third::ALL.iter().map(|reading| reading.name()).collect(),
            default: "mirrored",
        },
        ReadingKind {
            quantity: Elongation::QUANTITY,
            says: "F -> FF of Eq. (5) doubles a branch in each step, Eq. (6) adds to it what the growth speed gives.",
            variants: || Elongation::ALL.iter().map(|reading| reading.name()).collect(),
            default: "linear",
        },
        ReadingKind {
            quantity: Layers::QUANTITY,
            says: "Eq. (2) makes layers and says nothing of their difference; condition 5 has them begin where it is dense.",
            variants: || Layers::ALL.iter().map(|reading| reading.name()).collect(),
            default: "dense",
        },
        ReadingKind {
            quantity: Over::QUANTITY,
            says: "The paper's diagram has supersaturation over water; tables of growth have it over ice.",
            variants: || Over::ALL.iter().map(|reading| reading.name()).collect(),
            default: "ice",
        },
        ReadingKind {
            quantity: Assembly::QUANTITY,
            says: "Flakes of many crystals repeat what flakes of few do (1.2.1): crystal by crystal, or flake by flake.",
            variants: || Assembly::ALL.iter().map(|reading| reading.name()).collect(),
            default: "one-by-one",
        },
        ReadingKind {
            quantity: Drag::QUANTITY,
            says: "Resistance in proportion to speed, Eq. (20), or to its square, as of bodies that leave a wake.",
            variants: || Drag::ALL.iter().map(|reading| reading.name()).collect(),
            default: "linear",
        },
    ],
    experiments: &[
        figure_1::FIGURE_1,
        figure_2::FIGURE_2,
        figure_3::FIGURE_3,
        figure_4::FIGURE_4,
        figure_5::FIGURE_5,
        figure_6::FIGURE_6,
        figure_7::FIGURE_7,
        figure_8::FIGURE_8,
        figure_9::FIGURE_9,
        branching::BRANCHING,
        symmetry::SYMMETRY,
        histories::HISTORIES,
        poster::POSTER,
        optics::OPTICS,
        fall::FALL,
    ],
};
