//! The heights of the surface on a grid over the drawing.
//!
//! No triangle is kept: each band of rows descends into the patches that reach it, and in them only into the parts that
//! do, for a displaced midpoint stays where it is in the plan.

use rayon::prelude::*;

use super::surface::{Corner, Levels, Piece, Surface};

/// Rows that are worked out together.
const BAND: usize = 16;

/// Where heights are wanted: evenly over a box of the plan, the corners included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Least x and y.
    pub low: [f64; 2],
    /// Greatest x and y.
    pub high: [f64; 2],
    /// Numbers along x and y, at least 2 each.
    pub counts: [usize; 2],
}

/// Why there is no such grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a grid of {width} x {height} numbers; 2 to {most} in a row and a column are handled, {all} in all")]
pub struct Outside {
    width: usize,
    height: usize,
    most: usize,
    all: usize,
}

impl Grid {
    /// The most numbers along x or y.
    pub const MOST: usize = 32_768;
    /// The most numbers in all: 1 GiB.
    pub const MOST_NUMBERS: usize = 1 << 27;

    /// Whether the grid is one.
    ///
    /// # Errors
    ///
    /// Too few numbers, or too many.
    pub fn check(&self) -> Result<(), Outside> {
        let [width, height] = self.counts;
        let sound = |count: usize| (2..=Self::MOST).contains(&count);
        if sound(width) && sound(height) && width * height <= Self::MOST_NUMBERS {
            return Ok(());
        }
        Err(Outside { width, height, most: Self::MOST, all: Self::MOST_NUMBERS })
    }

    /// Where a number is, in the plan.
    pub fn place(&self, column: usize, row: usize) -> [f64; 2] {
        let along = |axis: usize, k: usize| {
            let share = k as f64 / (self.counts[axis] - 1) as f64;
            if share == 1.0 {
                self.high[axis]
            } else {
                self.low[axis] + share * (self.high[axis] - self.low[axis])
            }
        };
        [along(0, column), along(1, row)]
    }

    /// The heights of the surface whose patches are divided `levels` times, row by row, the row of least y first; not a
    /// number where there is no patch. Between corners they are linear.
    ///
    /// # Errors
    ///
    /// Of [`check`](Self::check).
    pub fn heights(&self, surface: &Surface, levels: u32) -> Result<Vec<f64>, Outside> {
        self.check()?;
        let [width, height] = self.counts;
        let mut all = vec![f64::NAN; width * height];
        all.par_chunks_mut(width * BAND).enumerate().for_each(|(band, values)| {
            let first = band * BAND;
            let rows = values.len() / width;
            let reach = (self.place(0, first)[1], self.place(0, first + rows - 1)[1]);
            let mut band = Band { grid: self, first, values };
            let seen = |piece: &Piece| {
                let [a, b, c] = piece.corners.map(|corner| corner.place[1]);
                a.max(b).max(c) >= reach.0 && a.min(b).min(c) <= reach.1
            };
            for patch in 0..surface.patches.triangles.len() {
                let piece = surface.piece(patch, |_, _| levels);
                surface.visit(&piece, 0, &Levels, &seen, &mut |leaf| band.cover(leaf));
            }
        });
        Ok(all)
    }

    /// The first number at or after a place, and the last at or before another, along an axis; perhaps none.
    fn span(&self, axis: usize, from: f64, to: f64) -> std::ops::Range<usize> {
        let count = self.counts[axis];
        let per = (count - 1) as f64 / (self.high[axis] - self.low[axis]);
        // One more at either end: whether it is inside is found out exactly later.
        let first = libm::floor((from - self.low[axis]) * per) - 1.0;
        let last = libm::ceil((to - self.low[axis]) * per) + 1.0;
        if !(last >= 0.0 && first < count as f64) {
            return 0..0;
        }
        first.max(0.0) as usize..(last as usize + 1).min(count)
    }
}

/// Some rows of the grid.
struct Band<'a> {
    grid: &'a Grid,
    first: usize,
    values: &'a mut [f64],
}

impl Band<'_> {
    fn cover(&mut self, triangle: &[Corner; 3]) {
        let side = |axis: usize| {
            let [a, b, c] = triangle.map(|corner| corner.place[axis]);
            (a.min(b).min(c), a.max(b).max(c))
        };
        let ((left, right), (low, high)) = (side(0), side(1));
        let width = self.grid.counts[0];
        let rows = self.values.len() / width;
        let columns = self.grid.span(0, left, right);
        for row in self.grid.span(1, low, high) {
            if row < self.first || row >= self.first + rows {
                continue;
            }
            for column in columns.clone() {
                let value = &mut self.values[(row - self.first) * width + column];
                // Where triangles meet, the first one gives the number.
                if value.is_nan()
                    && let Some(height) = height(triangle, self.grid.place(column, row))
                {
                    *value = height;
                }
            }
        }
    }
}

/// The height of a triangle at a place; none outside. Its edges belong to it.
fn height(triangle: &[Corner; 3], place: [f64; 2]) -> Option<f64> {
    let [a, b, c] = triangle;
    let areas = [area(b, c, place), area(c, a, place), area(a, b, place)];
    let inside = areas.iter().all(|area| *area >= 0.0) || areas.iter().all(|area| *area <= 0.0);
    let whole = areas[0] + areas[1] + areas[2];
    if !inside || whole == 0.0 {
        return None;
    }
    Some((areas[0] * a.height() + areas[1] * b.height() + areas[2] * c.height()) / whole)
}

/// Twice the area between an edge and a place: from the other side of the edge the same with its sign turned, to the
/// last bit, so that no place falls between two triangles.
fn area(from: &Corner, to: &Corner, [x, y]: [f64; 2]) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
    let ordered =
        from.place[0] < to.place[0] || (from.place[0] == to.place[0] && from.place[1] < to.place[1]);
    if ordered { cross(from.place, to.place) } else { -cross(to.place, from.place) }
}

#[cfg(test)]
mod tests {
    use super::super::{Amplitude, Contour, Displacement, EdgeLength, Patches, Plateau, Relief};
    use super::*;
    use crate::rng::Seed;

    /// A square of level 0 with another of level 1 in it.
    fn surface(gain: f64) -> Surface {
        let square = |name: &str, level: f64, half: f64| Contour {
            name: name.to_owned(),
            level,
            dimension: 2.3,
            points: vec![[-half, -half], [half, -half], [half, half], [-half, half]],
            closed: true,
        };
        let both = [square("base", 0.0, 4.0), square("top", 1.0, 2.0)];
        Surface {
            patches: Patches::new(&both, Plateau::AsPrinted).unwrap(),
            relief: Relief::Patches,
            displacement: Displacement {
                amplitude: Amplitude::ThreeMinusD,
                edge_length: EdgeLength::Original,
                gain,
                moment: Seed(1).stream("Gauss").at(0),
            },
        }
    }

    fn grid(count: usize) -> Grid {
        Grid { low: [-4.0, -4.0], high: [4.0, 4.0], counts: [count, count] }
    }

    #[test]
    fn without_displacement_it_is_a_frustum() {
        let grid = grid(65);
        let heights = grid.heights(&surface(0.0), 3).unwrap();
        for row in 0..65 {
            for column in 0..65 {
                let [x, y] = grid.place(column, row);
                let known = (0.5 * (4.0 - x.abs().max(y.abs()))).min(1.0);
                let ours = heights[row * 65 + column];
                assert!((ours - known).abs() < 1e-12, "{x} {y}: {ours} for {known}");
            }
        }
    }

    /// Every corner of the divided surface that lies on the grid has its own height there.
    #[test]
    fn corners_are_where_the_division_put_them() {
        let (surface, grid) = (surface(0.3), grid(129));
        let heights = grid.heights(&surface, 5).unwrap();
        assert!(heights.iter().all(|height| height.is_finite()), "no gap");
        let (mut met, per) = (0, 128.0 / 8.0);
        surface.triangles(5, &mut |leaf| {
            for corner in leaf {
                let [column, row] = corner.place.map(|x| (x + 4.0) * per);
                if column == libm::floor(column) && row == libm::floor(row) {
                    let ours = heights[row as usize * 129 + column as usize];
                    assert!((ours - corner.height()).abs() < 1e-12);
                    met += 1;
                }
            }
        });
        assert!(met > 10_000, "{met}");
    }

    #[test]
    fn threads_and_the_rest_of_the_grid_do_not_matter() {
        let surface = surface(1.0);
        let wide = Grid { low: [-5.0, -4.5], high: [4.5, 4.0], counts: [77, 53] };
        let bits = |heights: Vec<f64>| heights.iter().map(|height| height.to_bits()).collect::<Vec<_>>();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            bits(pool.install(|| wide.heights(&surface, 6)).unwrap())
        };
        let one = with(1);
        assert_eq!(one, with(3));
        let outside = one.iter().filter(|bits| f64::from_bits(**bits).is_nan()).count();
        let beyond = (0..53).flat_map(|row| (0..77).map(move |column| wide.place(column, row)));
        assert_eq!(outside, beyond.filter(|[x, y]| x.abs() > 4.0 || y.abs() > 4.0).count());
    }

    #[test]
    fn a_grid_that_is_too_large_is_refused_before_memory_is_asked_for() {
        assert!(grid(1).heights(&surface(1.0), 1).is_err());
        assert!(grid(32_768).heights(&surface(1.0), 1).unwrap_err().to_string().contains("32768 x 32768"));
    }
}
