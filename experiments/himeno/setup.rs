//! What the experiments share: how crystals are grown, and what that assumes.

use snowglobe::lab::{Error, Lab, Result};
use snowglobe::rng::Seed;
use snowglobe::snow::{Branching, Crystal, Form, History, Layers, Parameters, SnowError};

pub fn broken(cause: SnowError) -> Error {
    Error::broken(cause.to_string())
}

/// How crystals are grown, of elements of a side in m: what it assumes is recorded, each number with its reason.
pub fn assumed(lab: &mut Lab, element: f64) -> Result<Branching> {
    let all = Parameters::ASSUMED;
    let element = lab.pick(element, 4.0 * element);
    let element = lab.assume("b_min, m", element, "the finest side branches are twice as wide, or nearly");
    let dendrite = Form {
        slowing: lab.assume(
            "speed of a branch over that of its own",
            all.dendrite.slowing,
            "condition 4 prints no factor; arms are then as wide as a fern, as in photographs",
        ),
        sparing: lab.assume(
            "p1 of a branch over that of its own",
            all.dendrite.sparing,
            "in photographs side branches are many, and their own branches few",
        ),
        widening: lab.assume(
            "speed of sides over that of tips",
            all.dendrite.widening,
            "branches widen with age; twice as wide as an element when arms have grown by 0.2 mm",
        ),
        ..all.dendrite
    };
    let parameters = Parameters {
        element,
        dendrite,
        relief: lab.assume(
            "share of a dendrite's layers that lies over its first",
            all.relief,
            "the first layer then fills a third of its hexagon at water saturation",
        ),
        spacing: lab.assume("spacing of side branches, m", all.spacing, "50 um and more in photographs"),
        ridge: lab.assume("speed of ridges over that of arms", all.ridge, "ridges end before tips do"),
        above_branch: lab.assume("p1 above a branch", all.above_branch, "condition 6 prints no number"),
        above_none: lab.assume(
            "factor of p1 above none",
            all.above_none,
            "condition 6 asks that it is less than above a branch",
        ),
        births: lab.assume(
            "chance to begin a layer amid ice",
            all.births,
            "condition 5 prints none; faces of plates come out flat",
        ),
        ..all
    };
    Branching::new(&parameters).map_err(broken)
}

/// A crystal that grows through a history.
pub fn grown(branching: &Branching, history: &History, seed: u64) -> Result<Crystal> {
    Crystal::grow(history, branching, Layers::Dense, Seed(seed)).map_err(broken)
}

/// The same air all the time, saturated over water.
pub fn saturated(temperature: f64, minutes: f64) -> Result<History> {
    History::saturated(temperature, minutes).map_err(broken)
}
