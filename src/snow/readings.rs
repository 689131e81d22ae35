//! What is disputed in Eq. (2), (4), (5) and (8), and in the conditions of §1.1.3.

use crate::reading::Reading;

/// What the supersaturation of Eq. (8) is over.
///
/// Fig. 2 and §1 have it over water; tables of growth, and the formulae of diffusion, have it over ice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// Over ice.
    Ice,
    /// Over water, as §1 says of the diagram.
    Water,
}

impl Reading for Over {
    const QUANTITY: &'static str = "supersaturation-over";
    const ALL: &'static [Self] = &[Self::Ice, Self::Water];

    fn name(self) -> &'static str {
        match self {
            Self::Ice => "ice",
            Self::Water => "water",
        }
    }
}

/// The brackets of Eq. (4).
///
/// §1.1.2 defines `[]` as "zero or one times". The rule is then a choice of `+FF`, `f+FF`, `f++F` and `F`: a chain that
/// turns and never branches, which cannot be Fig. 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Brackets {
    /// Zero or one times.
    AsPrinted,
    /// Those of *The Algorithmic Beauty of Plants*, which the paper cites: a branch, here always with its mirror image,
    /// as condition 3 of §1.1.3 asks; left out with probability 1 - p1.
    PushPop,
}

impl Reading for Brackets {
    const QUANTITY: &'static str = "brackets";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::PushPop];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::PushPop => "push-pop",
        }
    }
}

/// The third alternative of Eq. (4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Third {
    /// `f++F`: a branch at 120 degrees, which grows inwards.
    AsPrinted,
    /// `f-F`: the second alternative's mirror image, at -60 degrees.
    Mirrored,
}

impl Reading for Third {
    const QUANTITY: &'static str = "third-alternative";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::Mirrored];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::Mirrored => "mirrored",
        }
    }
}

/// How a branch gets longer: Eq. (5) against Eq. (6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Elongation {
    /// F -> FF: its length doubles in each step, Eq. (5).
    Doubling,
    /// l(t) = l(t - 1) + dl(t), Eq. (6); it rules, since Eq. (8) gives the growth as a speed.
    Linear,
}

impl Reading for Elongation {
    const QUANTITY: &'static str = "elongation";
    const ALL: &'static [Self] = &[Self::Doubling, Self::Linear];

    fn name(self) -> &'static str {
        match self {
            Self::Doubling => "doubling",
            Self::Linear => "linear",
        }
    }
}

/// How a crystal is made of layers: Eq. (2) against condition 5 of §1.1.3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layers {
    /// All alike: `C -> L(t)[L(t)]` and nothing else. A cookie cutter.
    Extruded,
    /// A cell begins the next layer the likelier the denser its surroundings and the nearer the habit to plate.
    Dense,
}

impl Reading for Layers {
    const QUANTITY: &'static str = "layers";
    const ALL: &'static [Self] = &[Self::Extruded, Self::Dense];

    fn name(self) -> &'static str {
        match self {
            Self::Extruded => "extruded",
            Self::Dense => "dense",
        }
    }
}
