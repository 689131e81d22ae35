//! Dobashi, Nishita & Okita: clouds of a cellular automaton.
//!
//! Of two pages the first survives: rules, lifetime, control and density, of which every sentence can be tried. The
//! display and the timings stood on the other.

mod animation;
mod clusters;
mod control;
mod density;
mod display;
mod extinction;
mod growth;
mod islands;
mod lifetime;
mod readings;
mod scales;
mod setup;
mod shape;
pub mod sky;
mod threshold;

use snowglobe::automaton_cloud::{Activation, Brackets, Lock};
use snowglobe::lab::{Paper, ReadingKind};
use snowglobe::reading::Reading;

/// The paper.
pub const PAPER: Paper = Paper {
    id: "dobashi",
    title: "セルオートマトンを用いた雲のシミュレーションとその表示",
    english: "Simulation of clouds using a cellular automaton, and their display",
    about: "Vapour turns into cloud, and cloud vanishes, by rules of one bit a cell; probabilities at a few points steer it, and \
            metaballs make a density of it.",
    authors: "Dobashi, Nishita & Okita",
    sources: env!("SNOWGLOBE_DOBASHI"),
    readings: &[
        ReadingKind {
            quantity: Activation::QUANTITY,
            says: "Eq. (1) as printed asks that a cell be active already; then nothing grows. Eq. (4), \"after that of act\", \
                   negates its own variable.",
            variants: || Activation::ALL.iter().map(|reading| reading.name()).collect(),
            default: "negated",
        },
        ReadingKind {
            quantity: Brackets::QUANTITY,
            says: "The bracket of Eq. (1) and (4) closes after the six near cells, with a stray one at the end; far cells then \
                   turn into cloud what has no vapour.",
            variants: || Brackets::ALL.iter().map(|reading| reading.name()).collect(),
            default: "mended",
        },
        ReadingKind {
            quantity: Lock::QUANTITY,
            says: "For T_ext steps after cloud has come there is no change of state: of the cloud, or of all four variables.",
            variants: || Lock::ALL.iter().map(|reading| reading.name()).collect(),
            default: "cld",
        },
    ],
    experiments: &[
        growth::GROWTH,
        extinction::EXTINCTION,
        lifetime::LIFETIME,
        control::CONTROL,
        threshold::THRESHOLD,
        density::DENSITY,
        shape::SHAPE,
        readings::READINGS,
        display::DISPLAY,
        animation::ANIMATION,
    ],
};
