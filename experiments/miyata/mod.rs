//! Miyata: clouds from density contour lines.
//!
//! One file per figure or question; what they share is in `setup.rs`, and how lines are drawn in `draw.rs`.

mod coast;
mod density;
mod dimension;
mod draw;
mod drawings;
mod estimators;
mod figure_1;
mod figure_10;
mod figure_12;
mod figure_13;
mod figure_14;
mod figure_2;
mod figure_3;
mod figure_7;
mod figure_9;
mod fractional;
mod landscape;
mod readings;
mod setup;
pub mod sky;

use snowglobe::contour_cloud::{Amplitude, EdgeLength};
use snowglobe::lab::{Paper, ReadingKind};
use snowglobe::reading::Reading;

/// The paper.
pub const PAPER: Paper = Paper {
    id: "miyata",
    title: "等濃度線を用いた雲画像の生成法",
    english: "A generation method of cloud images using density contour lines",
    about: "Contours of equal density are taken as those of a mountain; its surface, made rough by recursive subdivision, \
            is the upper face of a layer of droplets that takes light away.",
    authors: "Miyata",
    sources: env!("SNOWGLOBE_MIYATA"),
    readings: &[
        ReadingKind {
            quantity: Amplitude::QUANTITY,
            says: "Eq. (1) as printed makes a surface of greater D smoother, against §4 and Fig. 13; with 3 - D in its \
                   exponent it does not.",
            variants: || Amplitude::ALL.iter().map(|reading| reading.name()).collect(),
            default: "three-minus-d",
        },
        ReadingKind {
            quantity: EdgeLength::QUANTITY,
            says: "L of Eq. (1) is the length of the edge that is divided: as it is now, or of the patch's edge.",
            variants: || EdgeLength::ALL.iter().map(|reading| reading.name()).collect(),
            default: "original",
        },
    ],
    experiments: &[
        figure_1::FIGURE_1,
        figure_2::FIGURE_2,
        figure_3::FIGURE_3,
        drawings::DRAWINGS,
        figure_7::FIGURE_7,
        figure_9::FIGURE_9,
        figure_10::FIGURE_10,
        figure_12::FIGURE_12,
        figure_13::FIGURE_13,
        figure_14::FIGURE_14,
        density::DENSITY,
        dimension::DIMENSION,
        readings::READINGS,
        coast::COAST,
    ],
};
