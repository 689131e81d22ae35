//! Which place of the lattice a pixel shows, for sketches whose lattice is bent as for those whose is not.

use nalgebra::{Point2, Vector2, point, vector};
use rayon::prelude::*;

use super::Sketch;
use crate::image::{ImageError, pixel_count};

/// Pixels between the places that are computed. Between them a warp is as good as straight.
const STEP: f64 = 8.0;
/// From a lattice point to the furthest corner of its hexagon, in spacings; a warp enlarges it less than twice that.
const REACH: f64 = 0.6;
/// What a picture that is filled leaves out of the sketch at both sides together, in spacings.
const EDGE: f64 = 6.0;

/// A picture laid on a sketch: from its pixels to the plane in which neighbouring points of the lattice are one apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    width: u32,
    height: u32,
    units_per_pixel: f64,
    columns: usize,
    nodes: Vec<[f64; 2]>,
}

impl Chart {
    /// The whole sketch in a picture `width` pixels wide, with `margin` empty pixels on each side; the height follows.
    ///
    /// # Errors
    ///
    /// Margins that leave no room, and a picture that is too large.
    pub fn around(sketch: &Sketch, width: u32, margin: u32) -> Result<Self, ImageError> {
        let (least, greatest) = extent(sketch);
        let room = f64::from(width) - 2.0 * f64::from(margin);
        let units_per_pixel = (greatest.x - least.x) / room;
        let height = libm::ceil((greatest.y - least.y) / units_per_pixel) + 2.0 * f64::from(margin);
        Self::of(sketch, width, height as u32, nalgebra::center(&least, &greatest), units_per_pixel)
    }

    /// The whole sketch in the middle of a picture, at least `margin` pixels from its edge.
    ///
    /// # Errors
    ///
    /// As [`around`](Self::around).
    pub fn fitted(sketch: &Sketch, width: u32, height: u32, margin: u32) -> Result<Self, ImageError> {
        let (least, greatest) = extent(sketch);
        let across = |size: f64, pixels: u32| size / (f64::from(pixels) - 2.0 * f64::from(margin));
        let (x, y) = (across(greatest.x - least.x, width), across(greatest.y - least.y, height));
        let units_per_pixel = if x > 0.0 && y > 0.0 { x.max(y) } else { f64::NAN };
        Self::of(sketch, width, height, nalgebra::center(&least, &greatest), units_per_pixel)
    }

    /// The picture filled by the sketch, which is cut off where its shape is another.
    ///
    /// # Errors
    ///
    /// A picture that is too large.
    pub fn filled(sketch: &Sketch, width: u32, height: u32) -> Result<Self, ImageError> {
        let (least, greatest) = extent(sketch);
        // The ragged edge stays outside.
        let inside = greatest - least - vector![EDGE, EDGE] * sketch.spacing;
        let (x, y) = (inside.x / f64::from(width), inside.y / f64::from(height));
        Self::of(sketch, width, height, nalgebra::center(&least, &greatest), x.min(y))
    }

    fn of(
        sketch: &Sketch,
        width: u32,
        height: u32,
        centre: Point2<f64>,
        units_per_pixel: f64,
    ) -> Result<Self, ImageError> {
        pixel_count(width, height)?;
        if !(units_per_pixel.is_finite() && units_per_pixel > 0.0) {
            return Err(ImageError::Scale(1.0 / units_per_pixel));
        }
        let nodes_along = |pixels: u32| (f64::from(pixels) / STEP) as usize + 2;
        let (columns, rows) = (nodes_along(width), nodes_along(height));
        let middle: Vector2<f64> = vector![0.5 * f64::from(width), 0.5 * f64::from(height)];
        let row = |row: usize| {
            let mut near = None;
            let node = |column: usize| {
                let pixel = vector![STEP * column as f64, STEP * row as f64];
                let place = centre + (pixel - middle) * units_per_pixel;
                let flat = match &sketch.warp {
                    Some(warp) => *near.insert(warp.invert(place, near.unwrap_or(place))),
                    None => place,
                };
                let unit = (flat - sketch.origin) / sketch.spacing;
                [unit.x, unit.y]
            };
            (0..columns).map(node).collect::<Vec<_>>()
        };
        let nodes = (0..rows).into_par_iter().flat_map_iter(row).collect();
        Ok(Self { width, height, units_per_pixel, columns, nodes })
    }

    /// Width of the picture in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height of the picture in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Sketch units that a pixel is wide.
    pub fn units_per_pixel(&self) -> f64 {
        self.units_per_pixel
    }

    /// Pixels between neighbouring lattice points around a place of the picture.
    pub fn cell_pixels(&self, x: f64, y: f64) -> f64 {
        let (a, b) = (self.place_of(point![x, y]), self.place_of(point![x + STEP, y]));
        STEP / (b - a).norm()
    }

    /// The place of the lattice's plane, where neighbouring points are one apart, at a place of the picture, in pixels
    /// from its top left corner; the middle of the first pixel is (0.5, 0.5).
    pub fn place_of(&self, pixel: Point2<f64>) -> Point2<f64> {
        let rows = self.nodes.len() / self.columns;
        let (x, y) = (pixel.x / STEP, pixel.y / STEP);
        let (column, row) = ((x as usize).min(self.columns - 2), (y as usize).min(rows - 2)); // from 0 on: casts clamp
        let (right, down) = (x - column as f64, y - row as f64);
        let at = row * self.columns + column;
        let [a, b] = [self.nodes[at], self.nodes[at + 1]];
        let [c, d] = [self.nodes[at + self.columns], self.nodes[at + self.columns + 1]];
        let mixed = |i: usize| {
            let (above, below) = (a[i] + right * (b[i] - a[i]), c[i] + right * (d[i] - c[i]));
            above + down * (below - above)
        };
        point![mixed(0), mixed(1)]
    }
}

/// The box around a sketch and its hexagons.
fn extent(sketch: &Sketch) -> (Point2<f64>, Point2<f64>) {
    let (least, greatest) = sketch.bounds();
    let reach = vector![REACH, REACH] * sketch.spacing;
    (least - reach, greatest + reach)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;
    use crate::sketch::{Bend, Placement, read_svg_bent};

    const BOX: &[u8] = br#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 60"><rect width="90" height="60"/></svg>"#;

    #[test]
    fn a_pixel_shows_the_lattice_point_that_lies_there() {
        for degrees in [0.0, 60.0] {
            let bend = (degrees > 0.0).then_some(Bend { degrees, seed: Seed(3) });
            let sketch = read_svg_bent(BOX, Placement::Points(6000), bend).unwrap();
            let chart = Chart::around(&sketch, 900, 10).unwrap();
            let (least, greatest) = extent(&sketch);
            let centre = nalgebra::center(&least, &greatest);
            let middle = vector![0.5 * f64::from(chart.width()), 0.5 * f64::from(chart.height())];
            for cell in sketch.region.cells().iter().step_by(37) {
                let pixel =
                    Point2::from((sketch.position(*cell) - centre) / chart.units_per_pixel() + middle);
                assert!((chart.place_of(pixel) - cell.position()).norm() < 0.02, "{cell:?} at {degrees}");
            }
        }
    }

    #[test]
    fn a_picture_without_room_is_refused() {
        let sketch = read_svg_bent(BOX, Placement::Points(100), None).unwrap();
        assert!(matches!(Chart::around(&sketch, 20, 10), Err(ImageError::Scale(_))));
        assert!(matches!(Chart::fitted(&sketch, 20, 40, 10), Err(ImageError::Scale(_))));
        assert!(matches!(Chart::filled(&sketch, 0, 10), Err(ImageError::Empty { .. })));
        assert!(matches!(Chart::filled(&sketch, 1 << 20, 1 << 20), Err(ImageError::TooLarge { .. })));
    }
}
