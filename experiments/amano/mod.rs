//! Amano, Sato & Itoh: frost that fills a sketch by a chosen frame.
//!
//! One file per figure or table; what they share is in `setup.rs`.

mod descent;
mod end_frame;
mod figure_2;
mod figure_3;
mod figures_4_5;
mod forensics;
mod pane;
mod reconstruction;
mod reiter;
mod setup;
mod shape;
mod sketch;
mod table_1;
mod table_2;

use snowglobe::frost::{Edge, Inflow, Redraw, RingTouchingIce, TSim};
use snowglobe::lab::{Paper, ReadingKind};
use snowglobe::optimize::Derivative;
use snowglobe::reading::Reading;

use setup::Reconstruction;

/// The paper.
pub const PAPER: Paper = Paper {
    id: "amano",
    title: "スケッチ入力を用いた氷・霜アニメーション生成のための初期値最適化による成長速度制御",
    english: "Growth speed controlled by optimising the initial value, for animations of ice and frost from sketches",
    about: "Ice and frost spread from a start over a region that a user sketches; steepest descent on the initial \
            vapour makes the film end in a chosen frame.",
    authors: "Amano, Sato & Itoh",
    sources: env!("SNOWGLOBE_AMANO"),
    readings: &[
        ReadingKind {
            quantity: Inflow::QUANTITY,
            says: "Eq. (1) gives a neighbour of ice either diffusion or gamma; Reiter's rule, which it extends, gives \
                   both.",
            variants: names::<Inflow>,
            default: "reiter-gated",
        },
        ReadingKind {
            quantity: Redraw::QUANTITY,
            says: "r is indexed by the frame; a frame may take several steps of the solver.",
            variants: names::<Redraw>,
            default: "frame",
        },
        ReadingKind {
            quantity: Edge::QUANTITY,
            says: "The paper reflects at the edge of the sketch; Reiter holds the edge at beta.",
            variants: names::<Edge>,
            default: "reflecting",
        },
        ReadingKind {
            quantity: RingTouchingIce::QUANTITY,
            says: "Whether a point outside that touches ice shows 0, as the cells inside do, is left open.",
            variants: names::<RingTouchingIce>,
            default: "zero",
        },
        ReadingKind {
            quantity: Reconstruction::QUANTITY,
            says: "The size and shape of the region, the steps per frame and gamma of the tables are not given: two \
                   named sets of assumptions.",
            variants: names::<Reconstruction>,
            default: "hexagon-1387",
        },
        ReadingKind {
            quantity: TSim::QUANTITY,
            says: "The tables print whole frames; the derivative of Eq. (3) may have been that of a frame that is \
                   interpolated. The printed steps say that it was (amano/forensics).",
            variants: names::<TSim>,
            default: "interpolated",
        },
        ReadingKind {
            quantity: Derivative::QUANTITY,
            says: "How the derivative in Eq. (3) is taken is not said.",
            variants: names::<Derivative>,
            default: "secant",
        },
    ],
    experiments: &[
        reiter::REITER,
        figure_2::FIGURE_2,
        figure_3::FIGURE_3,
        reconstruction::RECONSTRUCTION,
        table_1::TABLE_1,
        figures_4_5::FIGURE_4,
        table_2::TABLE_2,
        figures_4_5::FIGURE_5,
        descent::DESCENT,
        forensics::FORENSICS,
        end_frame::END_FRAME,
        sketch::SKETCH,
        pane::PANE,
    ],
};

fn names<R: Reading>() -> Vec<&'static str> {
    R::ALL.iter().map(|reading| reading.name()).collect()
}
