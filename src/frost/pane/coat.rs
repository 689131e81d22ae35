//! A field on the lattice made smooth: the box spline of the lattice's three directions.
//!
//! Each cell spreads over the two rings around it with the limit of Loop's subdivision, piecewise quartic and twice
//! continuously differentiable; the twelve weights in a triangle are those of Stam, "Evaluation of Loop Subdivision
//! Surfaces", 1998, over 12. They are not negative and add up to 1.

use nalgebra::Point2;

use crate::hexgrid::{Axial, ROW_HEIGHT, Region};

/// What is known of a cell: four numbers, made smooth alike.
pub(super) type Sample = [f32; 4];

/// Cells around the region that are nothing, so that no weight falls outside.
const MARGIN: i32 = 3;

/// The three corners of a triangle, what lies across its sides, and the two more beyond each corner, in axial steps.
const AROUND: [(i32, i32); 12] =
    [(0, 0), (1, 0), (0, 1), (1, 1), (-1, 1), (1, -1), (0, -1), (-1, 0), (2, -1), (2, 0), (-1, 2), (0, 2)];

/// Numbers on the cells of a region, nothing outside.
pub(super) struct Coat {
    least: Axial,
    columns: i32,
    rows: i32,
    cells: Vec<Sample>,
    // Where within the reach of the spline there is something.
    covered: Vec<bool>,
}

impl Coat {
    pub(super) fn new(region: &Region, sample: impl Fn(usize) -> Sample) -> Self {
        let bounds = region.bounds();
        let least = Axial::new(bounds.least.q - MARGIN, bounds.least.r - MARGIN);
        let (columns, rows) = (bounds.columns() as i32 + 2 * MARGIN, bounds.rows() as i32 + 2 * MARGIN);
        let mut coat = Self {
            least,
            columns,
            rows,
            cells: vec![[0.0; 4]; columns as usize * rows as usize],
            covered: vec![false; columns as usize * rows as usize],
        };
        for (ordinal, cell) in region.cells().iter().enumerate() {
            let sample = sample(ordinal);
            if sample != [0.0; 4] {
                let at = (cell.r - least.r) * columns + (cell.q - least.q);
                coat.cells[at as usize] = sample;
                // The unit squares of axial coordinates whose samples this cell reaches.
                for r in -2..=1 {
                    let row = (at + r * columns) as usize;
                    coat.covered[row - 2..row + 2].fill(true);
                }
            }
        }
        coat
    }

    /// The smooth field at a place of the lattice's plane; nothing where no cell near has anything.
    #[inline]
    pub(super) fn at(&self, place: Point2<f64>) -> Option<Sample> {
        let r = place.y / ROW_HEIGHT;
        let q = place.x - 0.5 * r;
        // From the corner of the rectangle, so that the cast rounds down.
        let (q, r) = (q - f64::from(self.least.q), r - f64::from(self.least.r));
        let (column, row) = (q as i32, r as i32);
        if !(2..self.columns - 2).contains(&column) || !(2..self.rows - 2).contains(&row) {
            return None;
        }
        let (a, b) = ((q - f64::from(column)) as f32, (r - f64::from(row)) as f32);
        let at = row * self.columns + column;
        if !self.covered[at as usize] {
            return None;
        }
        // The square's far triangle is the near one turned about the square's middle.
        let (weights, corner, side) = if a + b <= 1.0 {
            (weights(a, b), at, 1)
        } else {
            (weights(1.0 - a, 1.0 - b), at + self.columns + 1, -1)
        };
        let mut sum = [0.0; 4];
        for (weight, (q, r)) in weights.iter().zip(AROUND) {
            let sample = &self.cells[(corner + side * (r * self.columns + q)) as usize];
            for (sum, part) in sum.iter_mut().zip(sample) {
                *sum += weight * part;
            }
        }
        Some(sum)
    }
}

/// The weights of the cells in [`AROUND`] at (a, b) of the triangle a, b >= 0, a + b <= 1.
#[inline]
fn weights(v: f32, w: f32) -> [f32; 12] {
    let u = 1.0 - v - w;
    let across = |u: f32, v: f32, w: f32| {
        let (uv, sum) = (u * v, u + v);
        // u⁴ + v⁴ + 6 uv (u² + v²) + 12 u²v² + 2 w (u³ + v³) + 6 uvw (u + v)
        let (uu, vv) = (u * u, v * v);
        uu * uu
            + vv * vv
            + 6.0 * uv * (uu + vv)
            + 12.0 * uv * uv
            + 2.0 * w * (uu * u + vv * v)
            + 6.0 * uv * w * sum
    };
    let beyond = |u: f32, v: f32| u * u * u * (u + 2.0 * v);
    let (va, wa, ua) = (across(v, w, u), across(u, w, v), across(u, v, w));
    let outer = [beyond(u, v), beyond(u, w), beyond(v, u), beyond(v, w), beyond(w, u), beyond(w, v)];
    let own = |u: f32, v: f32, w: f32| {
        let (uu, vv, ww) = (u * u, v * v, w * w);
        6.0 * uu * uu
            + 24.0 * uu * u * (v + w)
            + uu * (24.0 * (vv + ww) + 60.0 * v * w)
            + u * (8.0 * (vv * v + ww * w) + 36.0 * v * w * (v + w))
            + vv * vv
            + ww * ww
            + 6.0 * v * w * (vv + ww)
            + 12.0 * vv * ww
    };
    [
        own(u, v, w),
        own(v, u, w),
        own(w, u, v),
        va,
        wa,
        ua,
        outer[0],
        outer[1],
        outer[2],
        outer[3],
        outer[4],
        outer[5],
    ]
    .map(|weight| weight * (1.0 / 12.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{point, vector};

    #[test]
    fn weights_add_up_to_one_and_none_is_negative() {
        for i in 0..=20 {
            for j in 0..=20 - i {
                let all = weights(i as f32 / 20.0, j as f32 / 20.0);
                assert!((all.iter().sum::<f32>() - 1.0).abs() < 1e-6);
                assert!(all.iter().all(|weight| *weight >= -1e-7));
            }
        }
    }

    /// Planes come out as planes: the box spline repeats what is linear.
    #[test]
    fn a_slope_stays_a_slope() {
        let disc = Region::disc(400);
        let height = |place: Point2<f64>| 3.0 + 0.25 * place.x - 0.125 * place.y;
        let coat = Coat::new(&disc, |cell| {
            let place = disc.cells()[cell].position();
            [height(place) as f32, place.x as f32, place.y as f32, 1.0]
        });
        for i in 0..500 {
            let place = point![f64::from(i % 23) * 0.71 - 8.0, f64::from(i % 31) * 0.53 - 8.0];
            let [h, x, y, one] = coat.at(place).unwrap();
            assert!((f64::from(h) - height(place)).abs() < 2e-5, "{place}");
            assert!((f64::from(x) - place.x).abs() < 2e-5 && (f64::from(y) - place.y).abs() < 2e-5);
            assert!((one - 1.0).abs() < 1e-6);
        }
    }

    /// One cell spreads alike in all six directions, without a step or a kink.
    #[test]
    fn one_cell_is_a_smooth_bump_with_six_sides() {
        let disc = Region::disc(100);
        let coat =
            Coat::new(&disc, |cell| if disc.cells()[cell] == Axial::ORIGIN { [1.0; 4] } else { [0.0; 4] });
        let at = |place: Point2<f64>| coat.at(place).map_or(0.0, |sample| f64::from(sample[0]));
        assert!((at(point![0.0, 0.0]) - 0.5).abs() < 1e-6);
        for radius in [0.3, 0.9, 1.4, 1.9] {
            let ring: Vec<f64> = (0..6)
                .map(|k| {
                    let angle = 0.2 + f64::from(k) * std::f64::consts::FRAC_PI_3;
                    at(point![radius * libm::cos(angle), radius * libm::sin(angle)])
                })
                .collect();
            assert!(ring.iter().all(|value| (value - ring[0]).abs() < 1e-6), "{radius}: {ring:?}");
        }
        let (start, step) = (point![-2.2, -1.3], vector![0.01, 0.006]);
        let line: Vec<f64> = (0..440).map(|i| at(start + step * f64::from(i))).collect();
        let bend = line.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs()).fold(0.0, f64::max);
        assert!(bend < 3e-4, "{bend}");
    }
}
