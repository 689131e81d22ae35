//! Shapes of the sketch, which the paper does not give.

use snowglobe::hexgrid::{Axial, Region};

/// A shape around the origin; its size is half its width in spacings of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Round.
    Disc,
    /// The lattice's own shape.
    Hexagon,
    /// As wide as it is high.
    Square,
    /// Wider than high, by a ratio of two whole numbers.
    Rectangle(u8, u8),
}

impl Shape {
    /// Shapes that the search tries, the ones with fewest numbers first.
    pub const ALL: [Self; 6] = [
        Self::Disc,
        Self::Hexagon,
        Self::Square,
        Self::Rectangle(3, 2),
        Self::Rectangle(16, 9),
        Self::Rectangle(2, 1),
    ];

    /// `hexagon`, `rectangle-3:2`.
    pub fn name(self) -> String {
        match self {
            Self::Disc => "disc".to_owned(),
            Self::Hexagon => "hexagon".to_owned(),
            Self::Square => "square".to_owned(),
            Self::Rectangle(width, height) => format!("rectangle-{width}:{height}"),
        }
    }

    /// Numbers that say which one it is: its size and, for a rectangle, its proportions.
    pub fn numbers(self) -> usize {
        match self {
            Self::Disc | Self::Hexagon | Self::Square => 1,
            Self::Rectangle(..) => 2,
        }
    }

    /// The cells.
    pub fn region(self, size: f64) -> Region {
        match self {
            Self::Disc => Region::disc(libm::floor(size * size + 1e-9) as u32),
            Self::Hexagon => Region::hexagon(libm::floor(size) as u16),
            Self::Square => Region::rectangle(size, size),
            Self::Rectangle(width, height) => {
                Region::rectangle(size, size * f64::from(height) / f64::from(width))
            }
        }
    }
}

/// Where growth starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// In the middle of the sketch.
    Centre,
    /// In the middle of its upper edge.
    Edge,
}

impl Start {
    /// Both, the one without a direction first.
    pub const ALL: [Self; 2] = [Self::Centre, Self::Edge];

    /// `centre` or `edge`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Centre => "centre",
            Self::Edge => "edge",
        }
    }

    /// The cell of a region around the origin.
    pub fn of(self, region: &Region) -> Axial {
        match self {
            Self::Centre => Axial::ORIGIN,
            Self::Edge => {
                let top = region.bounds().least.r;
                let of_row = region.cells().iter().filter(|cell| cell.r == top);
                let off_centre = |cell: &&Axial| (2 * cell.q + cell.r).abs();
                of_row.min_by_key(off_centre).copied().unwrap_or(Axial::ORIGIN)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_is_as_wide_as_it_says_and_holds_its_starts() {
        for shape in Shape::ALL {
            let region = shape.region(20.0);
            let row = |r: i32| region.cells().iter().filter(|at| at.r == r).count();
            assert_eq!(row(0), 41, "{shape:?}");
            for start in Start::ALL {
                assert!(region.contains(start.of(&region)), "{shape:?} {start:?}");
            }
            let edge = region.ordinal(Start::Edge.of(&region)).unwrap();
            assert!(region.border().contains(&edge));
        }
    }
}
