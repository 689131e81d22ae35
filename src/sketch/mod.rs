//! A user's sketch turned into a lattice region and its starts.
//!
//! After section 3.1 of Amano, Sato & Itoh: points are placed evenly, in a regular hexagonal pattern, inside the painted
//! area, and the points where growth starts are chosen among them. Three kinds of sketch are read, each from bytes:
//! [`read_svg`], [`read_png`] and, for a region that is already a list of lattice points, [`read_cells`].
//!
//! The lattice is anchored at the first start of the sketch (that start is lattice point (0, 0)) or, if there is none,
//! at the centre of the box around the paint. A lattice point belongs to the region if it lies in the paint; the row
//! direction is the sketch's x axis, and y runs down. What is read is the same on every machine: nothing here depends on
//! the system's mathematical library.
//!
//! [`read_svg_lines`] and [`read_geojson_lines`] read another kind of drawing: lines with a level each, which become no lattice.
//!
//! Beyond the page, the lattice may be bent by a [`Warp`]: its points then lie elsewhere, and have the same neighbours.

use nalgebra::Point2;

use crate::hexgrid::{Axial, Region, RegionError};
use crate::image::MOST_PIXELS;

mod chart;
mod csv;
mod geojson;
mod lines;
mod outline;
mod path;
mod place;
mod png;
mod style;
mod svg;
mod warp;

pub use self::chart::Chart;
pub use self::csv::{MOST_ROWS, read_cells};
pub use self::geojson::read_geojson_lines;
pub use self::lines::{ColourLevel, Line, read_svg_lines};
pub use self::png::{read_png, read_png_bent};
pub use self::svg::{MOST_BYTES, MOST_DEPTH, MOST_ELEMENTS, MOST_SEGMENTS, read_svg, read_svg_bent};
pub use self::warp::{Bend, MOST_DEGREES, Warp};

/// The most cells that a sketch may have.
pub const MOST_CELLS: usize = 4_000_000;
/// The most starts that a sketch may have.
pub const MOST_STARTS: usize = 4096;
/// The largest coordinate of a sketch, in its own units, either sign.
pub const FURTHEST: f64 = 1e9;

/// A region of the lattice, where growth starts in it, and how the lattice lies on the sketch.
#[derive(Clone, Debug, PartialEq)]
pub struct Sketch {
    /// The lattice points inside the paint.
    pub region: Region,
    /// Cells of the region, in the sketch's order, each once; empty if the sketch marks none.
    pub starts: Vec<Axial>,
    /// Distance between neighbouring lattice points, in sketch units (user units or pixels; 1 for a list of cells);
    /// under a warp, before it.
    pub spacing: f64,
    /// Where lattice point (0, 0) lies, in sketch units; under a warp, before it.
    pub origin: Point2<f64>,
    /// What bends the lattice, if anything does.
    pub warp: Option<Warp>,
}

impl Sketch {
    /// A region that was not drawn: spacing 1, the origin at (0, 0), no starts.
    pub fn of_cells(region: Region) -> Self {
        Self { region, starts: Vec::new(), spacing: 1.0, origin: Point2::origin(), warp: None }
    }

    /// Where a lattice point lies, in sketch units.
    pub fn position(&self, at: Axial) -> Point2<f64> {
        let flat = self.origin + at.position().coords * self.spacing;
        self.warp.as_ref().map_or(flat, |warp| warp.apply(flat))
    }

    /// The corners of the box around all positions: least x and y, greatest x and y.
    pub fn bounds(&self) -> (Point2<f64>, Point2<f64>) {
        let infinite = Point2::new(f64::INFINITY, f64::INFINITY);
        let places = self.region.cells().iter().map(|cell| self.position(*cell));
        places.fold((infinite, -infinite), |(least, greatest), at| (least.inf(&at), greatest.sup(&at)))
    }
}

/// How densely lattice points are placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Placement {
    /// So many spacings along the larger side of the box around the paint, at least 1.
    ///
    /// For an SVG the box is that of the shapes filled with anything but white, covered by white or not.
    Across(u32),
    /// This distance between neighbouring points, in sketch units: finite, above 0.
    Spacing(f64),
    /// The spacing, of some forty tried, whose region has most nearly this many cells (1 to [`MOST_CELLS`]).
    Points(usize),
}

impl Default for Placement {
    fn default() -> Self {
        Self::Across(80)
    }
}

/// Why a sketch cannot be used; every message is one line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SketchError {
    /// The list of cells does not name its columns.
    #[error("line 1: expected a header with the columns `q` and `r`, found {found}")]
    Header {
        /// The first line, quoted and shortened.
        found: String,
    },
    /// A coordinate in the list of cells is not a number.
    #[error(
        "line {line}, column `{column}`: expected a whole number from -{0} to {0}, found {found}",
        Region::FURTHEST
    )]
    Coordinate {
        /// The line, from 1.
        line: u64,
        /// `q` or `r`.
        column: &'static str,
        /// The field, quoted and shortened.
        found: String,
    },
    /// The list of cells is too long.
    #[error("the list of cells has more than {MOST_ROWS} rows; at most that many are read")]
    TooManyRows,
    /// The cells do not make a region.
    #[error(transparent)]
    Region(#[from] RegionError),
    /// The region is too large.
    #[error("the sketch has {cells} cells; at most {MOST_CELLS} are handled: choose a larger spacing")]
    TooManyCells {
        /// Cells found.
        cells: usize,
    },
    /// The lattice around the paint is too fine to be laid out.
    #[error(
        "a spacing of {spacing} is too fine for this sketch; at most {} points are laid out around the paint",
        Region::MOST
    )]
    TooFine {
        /// In sketch units.
        spacing: f64,
    },
    /// The spacing is not one.
    #[error("the spacing is {0}; expected a finite number above 0")]
    Spacing(f64),
    /// The number asked for cannot be had.
    #[error("{0} points were asked for; expected 1 to {MOST_CELLS}")]
    Points(usize),
    /// The angle of a warp is not one.
    #[error("a warp of {0} degrees; 0 to {MOST_DEGREES} are accepted")]
    Bend(f64),
    /// Nothing is painted.
    #[error("no paint: expected {expected}")]
    NoPaint {
        /// What counts as paint.
        expected: &'static str,
    },
    /// Paint, but no lattice point in it.
    #[error("no lattice point lies in the paint at a spacing of {spacing}; a smaller one is needed")]
    NoCells {
        /// In sketch units.
        spacing: f64,
    },
    /// A start is not on the paint.
    #[error("start {number} at ({x}, {y}) lies outside the region; expected a place in the paint")]
    StartOutside {
        /// Which start, from 1, in the sketch's order.
        number: usize,
        /// In sketch units.
        x: f64,
        /// In sketch units.
        y: f64,
    },
    /// Too many places are marked.
    #[error("the sketch marks more than {MOST_STARTS} starts; at most that many are handled")]
    TooManyStarts,
    /// The picture cannot be decoded.
    #[error("the picture cannot be read: {what}; expected a complete PNG file")]
    Png {
        /// The decoder's words.
        what: String,
    },
    /// The picture is too large.
    #[error("the picture has {width} x {height} pixels; at most {MOST_PIXELS} in all are read")]
    TooManyPixels {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The drawing is not XML, or not SVG.
    #[error("the drawing cannot be read: {what}; expected an SVG file in UTF-8")]
    Xml {
        /// What is wrong and where.
        what: String,
    },
    /// The file is not GeoJSON, or a feature of it cannot be used.
    #[error("{place}: {what}")]
    GeoJson {
        /// The feature, or the file.
        place: String,
        /// What is wrong, and what is accepted.
        what: String,
    },
    /// The drawing is too large or too intricate.
    #[error("the drawing has more than {most} {what}; at most that many are handled")]
    TooIntricate {
        /// What is counted.
        what: &'static str,
        /// The limit.
        most: usize,
    },
    /// Something is wrong with one element of the drawing.
    #[error("line {line}, column {column}, `{element}`: {what}")]
    Element {
        /// The element's name.
        element: String,
        /// From 1.
        line: u32,
        /// From 1.
        column: u32,
        /// What was found and what would be accepted.
        what: String,
    },
}

/// Somebody else's text as part of a one-line message: quoted, escaped and shortened.
fn quoted(text: &str) -> String {
    let mut short: String = text.chars().take(40).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    format!("{short:?}")
}

/// A decoder's message on one line, shortened.
fn one_line(message: impl std::fmt::Display) -> String {
    let text = message.to_string();
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}

#[cfg(test)]
mod tests;
