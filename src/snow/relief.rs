//! How thick a crystal is where light goes through it, and how steeply its surfaces rise: what a microscope shows.
//!
//! Elements are hexagonal prisms; a crystal has no such steps. Thickness is smoothed over about two cells, so that edges are
//! bevelled by about a cell and contours have no stairs; where prisms fill the plane it stays what it is. So does the volume:
//! the sum of thickness over the picture is that of the elements.

use nalgebra::point;

use crate::hexgrid::{Axial, ROW_HEIGHT};

use super::{Crystal, SnowError, within};

/// Half the width of what thickness is smoothed by, in elements.
const SPREAD: f64 = 1.8;
/// And in pixels at least, that slopes of small pictures are smooth, too.
const LEAST: f64 = 1.5;

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
        let prisms = Prisms::new(crystal, view);
        // Places of a pixel at which the prisms are looked up: two for each element, so that none is missed; from beside more
        // down than across, since flat crystals have few layers, whose edges lie along rows.
        let least = (2.0 * pixel / element).ceil().clamp(1.0, 64.0) as usize;
        let parts = if view == View::Side { [least, least.max(8)] } else { [least; 2] };
        let half = 0.5 * side as f64;
        let place = |k: usize, part: usize, parts: usize| {
            (k as f64 + (part as f64 + 0.5) / parts as f64 - half) * pixel / element
        };
        let mut steps = vec![0.0; side * side];
        for (row, line) in steps.chunks_exact_mut(side).enumerate() {
            for (column, at) in line.iter_mut().enumerate() {
                let mut sum = 0.0;
                for j in 0..parts[1] {
                    let y = place(row, j, parts[1]);
                    sum += (0..parts[0]).map(|i| prisms.at([place(column, i, parts[0]), y])).sum::<f64>();
                }
                *at = element * sum / (parts[0] * parts[1]) as f64;
            }
        }
        let reach = (SPREAD * element / pixel).max(LEAST);
        let (weights, rates) = kernel(reach);
        let smoothed = along_rows(&steps, side, &weights);
        let rising = along_rows(&steps, side, &rates);
        let thickness = along_columns(&smoothed, side, &weights);
        let [right, down] = [along_columns(&rising, side, &weights), along_columns(&smoothed, side, &rates)];
        let slope = right.iter().zip(&down).map(|(x, y)| [x / pixel, y / pixel]).collect();
        Ok(Self { side, pixel, thickness, slope })
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

/// Elements over and under each other, of a lattice that is seen from above or beside.
struct Prisms {
    view: View,
    /// From above by cell, q and r; from beside by row of cells and layer, r and z: how many lie behind each other. Both go from
    /// -reach to reach.
    reach: [i32; 2],
    counts: Vec<f64>,
}

impl Prisms {
    fn new(crystal: &Crystal, view: View) -> Self {
        let (radius, top) = (crystal.radius(), crystal.layers().len() as i32);
        let reach = match view {
            View::Above => [radius, radius],
            View::Side => [radius, top],
        };
        let counts = vec![0.0; reach.iter().map(|reach| 2 * *reach as usize + 1).product()];
        let mut prisms = Self { view, reach, counts };
        for (at, z) in crystal.elements() {
            let place = match view {
                View::Above => [at.q, at.r],
                View::Side => [at.r, z],
            };
            if let Some(index) = prisms.index(place) {
                prisms.counts[index] += 1.0;
            }
        }
        prisms
    }

    fn index(&self, place: [i32; 2]) -> Option<usize> {
        let inside = (0..2).all(|k| place[k].abs() <= self.reach[k]);
        let [i, j] = [0, 1].map(|k| (place[k] + self.reach[k]) as usize);
        inside.then(|| j * (2 * self.reach[0] as usize + 1) + i)
    }

    fn count(&self, place: [i32; 2]) -> f64 {
        self.index(place).map_or(0.0, |index| self.counts[index])
    }

    /// Thickness at a place of the picture, all in elements.
    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        if self.view == View::Above {
            let at = Axial::containing(point![x, y]);
            return self.count([at.q, at.r]);
        }
        let z = libm::round(-y) as i32;
        // Across the middle of a row a hexagon is as wide as it is; where rows interlock it narrows to a corner.
        let row = x / ROW_HEIGHT;
        let nearest = libm::round(row);
        let share = |r: f64| {
            let off = ((row - r) * ROW_HEIGHT).abs();
            (2.0 * CORNER - off).clamp(0.0, CORNER) / CORNER
        };
        let rows = [nearest - 1.0, nearest, nearest + 1.0];
        rows.into_iter().map(|r| share(r) * self.count([r as i32, z])).sum()
    }
}

/// Half a side of a cell, 1 / (2 sqrt 3): its corners are at twice of it, its narrowing begins at it.
const CORNER: f64 = 0.288_675_134_594_812_9;

/// Weights (1 - u^2)^3 over a reach in pixels, whose sum is 1, and what they make of a slope: their derivative, such that a
/// plane keeps its own.
fn kernel(reach: f64) -> (Vec<f64>, Vec<f64>) {
    let half = reach.ceil() as i32;
    let inner = |k: i32| {
        let u = f64::from(k) / reach;
        (1.0 - u * u).max(0.0)
    };
    let taps = || (-half..=half).map(|k| (f64::from(k), inner(k)));
    let sum: f64 = taps().map(|(_, inner)| inner * inner * inner).sum();
    let moment: f64 = taps().map(|(k, inner)| k * k * inner * inner).sum();
    let weights = taps().map(|(_, inner)| inner * inner * inner / sum).collect();
    let rates = taps().map(|(k, inner)| k * inner * inner / moment).collect();
    (weights, rates)
}

/// Every row with the taps around each pixel; outside there is nothing.
fn along_rows(values: &[f64], side: usize, taps: &[f64]) -> Vec<f64> {
    let half = taps.len() / 2;
    let mut out = vec![0.0; values.len()];
    for (row, to) in values.chunks_exact(side).zip(out.chunks_exact_mut(side)) {
        for (column, to) in to.iter_mut().enumerate() {
            let (first, last) = (column.saturating_sub(half), (column + half).min(side - 1));
            let taps = &taps[first + half - column..];
            *to = row[first..=last].iter().zip(taps).map(|(value, tap)| value * tap).sum();
        }
    }
    out
}

/// Every column in the same way.
fn along_columns(values: &[f64], side: usize, taps: &[f64]) -> Vec<f64> {
    let half = taps.len() / 2;
    let mut out = vec![0.0; values.len()];
    for (row, to) in out.chunks_exact_mut(side).enumerate() {
        for from in row.saturating_sub(half)..=(row + half).min(side - 1) {
            let tap = taps[from + half - row];
            let line = &values[from * side..][..side];
            to.iter_mut().zip(line).for_each(|(to, value)| *to += tap * value);
        }
    }
    out
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

    /// Elements side by side are as thick as they are, not rippled: a plate that is full is flat but at its edge. 1e-9: sums.
    #[test]
    fn what_is_full_is_flat() {
        let branching = Branching::new(&Parameters { element: 4e-6, ..Parameters::ASSUMED }).unwrap();
        let history = History::constant(-8.0, 0.01, super::super::Over::Ice, 60.0).unwrap();
        let column = Crystal::grow(&history, &branching, Layers::Dense, Seed(1)).unwrap();
        let relief = Relief::of(&column, View::Above, 1.3 * column.diameter(), 300).unwrap();
        let middle = relief.slope()[150 * 300 + 150];
        assert!(middle[0].abs() < 1e-9 && middle[1].abs() < 1e-9, "{middle:?}");
        let thickness = relief.thickness()[150 * 300 + 150];
        let known = column.element() * column.thickness(Axial::ORIGIN) as f64;
        assert!((thickness / known - 1.0).abs() < 1e-9, "{thickness} for {known}");
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
