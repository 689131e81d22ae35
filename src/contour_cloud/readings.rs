//! What is disputed in Eq. (1).

use crate::reading::Reading;

/// The exponent of Eq. (1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amplitude {
    /// `2^(-(n+1)(D-1))`: with the D of a surface a greater D makes the surface smoother, against §4 and Fig. 13.
    AsPrinted,
    /// `2^(-(n+1)(D-2))`, what is printed with the D of a line, one less than that of the surface.
    LineDimension,
    /// `2^(-(n+1)(3-D))`: H = 3 - D of a surface, by which a greater D is rougher.
    ThreeMinusD,
}

impl Reading for Amplitude {
    const QUANTITY: &'static str = "amplitude";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::LineDimension, Self::ThreeMinusD];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::LineDimension => "line-dimension",
            Self::ThreeMinusD => "three-minus-d",
        }
    }
}

/// L of Eq. (1), "the length of the edge that is divided".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeLength {
    /// Of the edge as it is now, half as long after every division.
    Current,
    /// Of the patch's edge that it is a part of: its plan length times 2^n.
    Original,
}

impl Reading for EdgeLength {
    const QUANTITY: &'static str = "edge-length";
    const ALL: &'static [Self] = &[Self::Current, Self::Original];

    fn name(self) -> &'static str {
        match self {
            Self::Current => "current",
            Self::Original => "original",
        }
    }
}

/// What is done with triangles all of whose corners are at one level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plateau {
    /// Nothing: they are level before they are displaced.
    AsPrinted,
    /// A point is added on the medial axis of the region that they make up, raised as the slopes around it say.
    Raised,
}

impl Reading for Plateau {
    const QUANTITY: &'static str = "plateau";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::Raised];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::Raised => "raised",
        }
    }
}

/// The D of a surface whose level lines have a dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceDimension {
    /// One more, the practice of the time.
    PlusOne,
    /// Twice: a single level line of a surface of fractional Brownian motion has about half of its D.
    Twice,
}

impl SurfaceDimension {
    /// D of the surface, 2 to 3.
    pub fn of_line(self, line: f64) -> f64 {
        match self {
            Self::PlusOne => (line + 1.0).clamp(2.0, 3.0),
            Self::Twice => (2.0 * line).clamp(2.0, 3.0),
        }
    }
}

impl Reading for SurfaceDimension {
    const QUANTITY: &'static str = "surface-dimension";
    const ALL: &'static [Self] = &[Self::PlusOne, Self::Twice];

    fn name(self) -> &'static str {
        match self {
            Self::PlusOne => "plus-one",
            Self::Twice => "twice",
        }
    }
}
