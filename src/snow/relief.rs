//! How thick a crystal is where light goes through it, and how steeply its surfaces rise: what a microscope shows.
//!
//! Elements are hexagonal prisms; a crystal has no such steps. Each is spread over a disc of about two cells, smoothly,
//! so that edges are bevelled by about a cell and contours have no stairs. Volume stays: the sum of thickness over the
//! picture is that of the elements.

use crate::hexgrid::ROW_HEIGHT;

use super::{Crystal, SnowError, within};

/// Radius of the disc that an element is spread over, in elements.
const SPREAD: f64 = 1.9;

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Along the c axis: plates and dendrites.
    Above,
    /// Across it, along an arm: columns.
    Side,
}

/// Thickness and its slope on a square of pixels, the crystal in the middle.
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    side: usize,
    pixel: f64,
    thickness: Vec<f64>,
    slope: Vec<[f64; 2]>,
}

impl Relief {
    /// Of a crystal on `side` x `side` pixels that stand for `width` m, 16 to 4096 of them.
    ///
    /// # Errors
    ///
    /// Another number of pixels, or a width that is not between 1 um and 1 m.
    pub fn of(crystal: &Crystal, view: View, width: f64, side: usize) -> Result<Self, SnowError> {
        within("the width in pixels", side as f64, 16.0, 4096.0)?;
        within("the width of the picture, m,", width, 1e-6, 1.0)?;
        let pixel = width / side as f64;
        let element = crystal.element();
        let radius = SPREAD * element;
        // A prism over a hexagon whose centres are one apart; the disc's profile is (1 - r^2)^3, of integral pi / 4.
        let volume = ROW_HEIGHT * element * element * element;
        let height = volume / (0.25 * std::f64::consts::PI * radius * radius);
        let mut relief =
            Self { side, pixel, thickness: vec![0.0; side * side], slope: vec![[0.0; 2]; side * side] };
        for (at, z) in crystal.elements() {
            let place = at.position();
            let [x, y] = match view {
                View::Above => [place.x, place.y],
                View::Side => [place.y, -f64::from(z)],
            };
            relief.spread([x * element, y * element], radius, height);
        }
        Ok(relief)
    }

    /// Adds a disc's profile, its middle at a place, m, from that of the picture.
    fn spread(&mut self, middle: [f64; 2], radius: f64, height: f64) {
        let half = 0.5 * self.side as f64;
        let [x, y] = middle.map(|at| at / self.pixel + half);
        let reach = radius / self.pixel;
        let range = |at: f64| {
            let from = (at - reach - 0.5).ceil().max(0.0) as usize;
            from..((at + reach + 0.5).floor().max(0.0) as usize).min(self.side)
        };
        for row in range(y) {
            let v = (row as f64 + 0.5 - y) / reach;
            for column in range(x) {
                let u = (column as f64 + 0.5 - x) / reach;
                let inner = 1.0 - u * u - v * v;
                if inner <= 0.0 {
                    continue;
                }
                let pixel = row * self.side + column;
                self.thickness[pixel] += height * inner * inner * inner;
                let rate = -6.0 * height * inner * inner / radius;
                self.slope[pixel][0] += rate * u;
                self.slope[pixel][1] += rate * v;
            }
        }
    }

    /// Pixels along the side.
    pub fn side(&self) -> usize {
        self.side
    }

    /// What a pixel stands for, m.
    pub fn pixel(&self) -> f64 {
        self.pixel
    }

    /// Thickness in m, row by row from the top.
    pub fn thickness(&self) -> &[f64] {
        &self.thickness
    }

    /// How much thickness rises to the right and downwards, m per m.
    pub fn slope(&self) -> &[[f64; 2]] {
        &self.slope
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Branching, Crystal, History, ICE, Layers, Parameters};
    use super::*;
    use crate::rng::Seed;

    fn crystal(temperature: f64) -> Crystal {
        let branching = Branching::new(&Parameters { element: 20e-6, ..Parameters::ASSUMED }).unwrap();
        let history = History::saturated(temperature, 8.0).unwrap();
        Crystal::grow(&history, &branching, Layers::Dense, Seed(1)).unwrap()
    }

    /// The sum over pixels of a smooth profile is its integral but for the pixels' size: 1 %.
    #[test]
    fn volume_stays_from_wherever_it_is_seen() {
        for temperature in [-15.0, -5.5] {
            let crystal = crystal(temperature);
            let width = 1.3 * crystal.diameter().max(crystal.height());
            for view in [View::Above, View::Side] {
                let relief = Relief::of(&crystal, view, width, 400).unwrap();
                let area = relief.pixel() * relief.pixel();
                let volume = relief.thickness().iter().sum::<f64>() * area;
                assert!((volume * ICE / crystal.mass() - 1.0).abs() < 0.01, "{temperature} {view:?}");
            }
        }
    }

    /// Central differences of the thickness; a pixel is small beside an element.
    #[test]
    fn the_slope_is_that_of_the_thickness() {
        let crystal = crystal(-15.0);
        let relief = Relief::of(&crystal, View::Above, 1.2 * crystal.diameter(), 600).unwrap();
        let (n, h) = (relief.side(), relief.thickness());
        let steepest = relief.slope().iter().map(|[x, _]| x.abs()).fold(0.0, f64::max);
        for row in 1..n - 1 {
            for column in 1..n - 1 {
                let at = row * n + column;
                let known =
                    [h[at + 1] - h[at - 1], h[at + n] - h[at - n]].map(|d| d / (2.0 * relief.pixel()));
                for (found, known) in relief.slope()[at].iter().zip(known) {
                    assert!((found - known).abs() < 0.05 * steepest);
                }
            }
        }
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let crystal = crystal(-15.0);
        let refused = |width, side| Relief::of(&crystal, View::Above, width, side).unwrap_err().to_string();
        assert_eq!(refused(1e-3, 4), "the width in pixels is 4; 16 to 4096 is accepted");
        assert_eq!(refused(0.0, 64), "the width of the picture, m, is 0; 0.000001 to 1 is accepted");
    }
}
