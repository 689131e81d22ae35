//! Representative points: probabilities are given at a few places, which may move, and interpolated between them, §2.3.
//!
//! How they are interpolated is not said: weights of two kinds are built, worked out at knots of a lattice as coarse as one
//! likes, between which all is linear. What that does to the cover is measured (`dobashi/control`).

use std::borrow::Cow;
use std::ops::Range;
use std::sync::OnceLock;

use rayon::prelude::*;

/// A representative point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Its place, in cells: the first cell's centre is 0, 0, 0.
    pub place: [f64; 3],
    /// The probabilities of hum, act and ext there, in a step.
    pub chances: [f64; 3],
}

/// How probabilities are interpolated between points: an assumption.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interpolation {
    /// Weights of one over the squared distance (Shepard 1968): at a point its own, far away the mean of all.
    InverseDistance,
    /// Weights of a Gaussian of the distance, in cells: close to a point its own, between two an edge as wide as it says.
    Gaussian(f64),
}

/// Representative points over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// At these steps, rising, the points are these.
    sets: Vec<(f64, Vec<Point>)>,
    interpolation: Interpolation,
    /// Cells from a knot to the next along each axis: between knots probabilities are linear in x, y and z.
    spacing: usize,
    kept: Kept,
}

/// The probabilities of points that do not move, worked out once. It is no part of what the points are.
#[derive(Debug, Default)]
struct Kept(OnceLock<([usize; 3], Lattice)>);

impl Clone for Kept {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl PartialEq for Kept {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Why there are no such points.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PointError {
    /// None at all.
    #[error("there are no points; at least one is needed")]
    None,
    /// A number that cannot be used.
    #[error("line {line}: {what} is {value}; {accepted} is accepted")]
    OutOfRange {
        /// Line of the table; 1 is its heading.
        line: usize,
        /// Which number.
        what: &'static str,
        /// What it is.
        value: f64,
        /// What could be used.
        accepted: &'static str,
    },
    /// Steps that fall.
    #[error("line {line}: step {step} comes after a later one; steps must not fall")]
    Falls {
        /// Line of the table.
        line: usize,
        /// The step.
        step: f64,
    },
}

impl Points {
    /// Points that do not move.
    pub fn still(points: Vec<Point>, interpolation: Interpolation, spacing: usize) -> Self {
        Self { sets: vec![(0.0, points)], interpolation, spacing: spacing.max(1), kept: Kept::default() }
    }

    /// Points at steps, as rows of a table have them: those of one step beside each other, steps rising. From one step to
    /// the next the first moves to the first, the second to the second; where their number differs, they wait.
    ///
    /// # Errors
    ///
    /// No row, falling steps, a place that is not finite, or a probability that is none.
    pub fn moving(
        rows: &[(f64, Point)],
        interpolation: Interpolation,
        spacing: usize,
    ) -> Result<Self, PointError> {
        let mut sets: Vec<(f64, Vec<Point>)> = Vec::new();
        for (number, (step, point)) in rows.iter().enumerate() {
            let line = number + 2;
            let refuse = |what, value, accepted| Err(PointError::OutOfRange { line, what, value, accepted });
            if !(0.0..=1e9).contains(step) {
                return refuse("the step", *step, "0 to 1e9");
            }
            for (what, value) in ["x", "y", "z"].into_iter().zip(point.place) {
                if !(-1e6..=1e6).contains(&value) {
                    return refuse(what, value, "-1e6 to 1e6");
                }
            }
            for (what, value) in ["p_hum", "p_act", "p_ext"].into_iter().zip(point.chances) {
                if !(0.0..=1.0).contains(&value) {
                    return refuse(what, value, "0 to 1");
                }
            }
            match sets.last_mut() {
                Some((last, _)) if *last > *step => return Err(PointError::Falls { line, step: *step }),
                Some((last, points)) if *last == *step => points.push(*point),
                _ => sets.push((*step, vec![*point])),
            }
        }
        if sets.is_empty() {
            return Err(PointError::None);
        }
        Ok(Self { sets, interpolation, spacing: spacing.max(1), kept: Kept::default() })
    }

    /// The points at a time.
    pub fn at(&self, time: f64) -> Vec<Point> {
        let later = self.sets.partition_point(|(step, _)| *step <= time);
        let before = &self.sets[later.saturating_sub(1)];
        let Some(after) = self.sets.get(later).filter(|after| later > 0 && after.1.len() == before.1.len())
        else {
            return before.1.clone();
        };
        let share = (time - before.0) / (after.0 - before.0);
        let mix = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] + share * (b[k] - a[k]));
        let both = before.1.iter().zip(&after.1);
        both.map(|(a, b)| Point { place: mix(a.place, b.place), chances: mix(a.chances, b.chances) })
            .collect()
    }

    /// The probabilities of hum, act and ext at a place.
    fn chances(&self, points: &[Point], place: [f64; 3]) -> [f64; 3] {
        let squared = |point: &Point| {
            (0..3).map(|k| (point.place[k] - place[k]) * (point.place[k] - place[k])).sum::<f64>()
        };
        // Of equal weights far from all points only their ratio is left: distances count from the nearest.
        let nearest = points.iter().map(squared).fold(f64::INFINITY, f64::min);
        let (mut sum, mut whole) = ([0.0; 3], 0.0);
        for point in points {
            let weight = match self.interpolation {
                Interpolation::InverseDistance if nearest == 0.0 => {
                    f64::from(u8::from(squared(point) == 0.0))
                }
                Interpolation::InverseDistance => nearest / squared(point),
                Interpolation::Gaussian(width) => {
                    let exponent = (nearest - squared(point)) / (2.0 * width * width);
                    // Of e^-50 of the nearest's weight no probability shows anything.
                    if exponent < -50.0 {
                        continue;
                    }
                    libm::exp(exponent)
                }
            };
            whole += weight;
            for (sum, chance) in sum.iter_mut().zip(point.chances) {
                *sum += weight * chance;
            }
        }
        sum.map(|sum| (sum / whole).clamp(0.0, 1.0))
    }

    /// The probabilities at knots over a lattice of cells at a time.
    pub(super) fn lattice(&self, counts: [usize; 3], time: f64) -> Cow<'_, Lattice> {
        if self.sets.len() == 1 {
            let (of, kept) = self.kept.0.get_or_init(|| (counts, self.worked_out(counts, time)));
            if *of == counts {
                return Cow::Borrowed(kept);
            }
        }
        Cow::Owned(self.worked_out(counts, time))
    }

    fn worked_out(&self, counts: [usize; 3], time: f64) -> Lattice {
        let points = self.at(time);
        let spacing = self.spacing;
        let [nx, ny, nz] = counts.map(|count| (count - 1).div_ceil(spacing) + 1);
        let knots = (0..nx * ny * nz)
            .into_par_iter()
            .with_min_len(64)
            .map(|knot| {
                let at = [knot % nx, knot / nx % ny, knot / (nx * ny)];
                self.chances(&points, at.map(|at| (at * spacing) as f64))
            })
            .collect();
        Lattice { spacing, counts: [nx, ny, nz], knots }
    }
}

/// Probabilities of hum, act and ext at knots, linear between them.
#[derive(Clone, Debug)]
pub(super) struct Lattice {
    spacing: usize,
    counts: [usize; 3],
    knots: Vec<[f64; 3]>,
}

impl Lattice {
    fn knot(&self, number: usize, [i, j, k]: [usize; 3]) -> f64 {
        let [nx, ny, _] = self.counts;
        self.knots[(k * ny + j) * nx + i][number]
    }

    /// The knots before and after a cell along an axis, and how far it is from the first to the second.
    fn between(&self, axis: usize, cell: usize) -> ([usize; 2], f64) {
        let first = cell / self.spacing;
        let share = (cell % self.spacing) as f64 / self.spacing as f64;
        ([first, (first + 1).min(self.counts[axis] - 1)], share)
    }

    /// The probability of variable `number` in a cell.
    pub fn at(&self, number: usize, cell: [usize; 3]) -> f64 {
        let [(x, u), (y, v), (z, w)] = [0, 1, 2].map(|axis| self.between(axis, cell[axis]));
        let mix = |a: f64, b: f64, share: f64| a + share * (b - a);
        let along_x =
            |j: usize, k: usize| mix(self.knot(number, [x[0], j, k]), self.knot(number, [x[1], j, k]), u);
        let along_y = |k: usize| mix(along_x(y[0], k), along_x(y[1], k), v);
        mix(along_y(z[0]), along_y(z[1]), w)
    }

    /// No cell of these rows of plane `k` has a greater probability.
    pub fn most(&self, number: usize, rows: Range<usize>, k: usize) -> f64 {
        let ([low, _], _) = self.between(1, rows.start);
        let ([_, high], _) = self.between(1, rows.end - 1);
        let (planes, _) = self.between(2, k);
        let mut most = 0.0_f64;
        for k in planes {
            for j in low..=high {
                let from = (k * self.counts[1] + j) * self.counts[0];
                let row = &self.knots[from..from + self.counts[0]];
                most = row.iter().fold(most, |most, knot| most.max(knot[number]));
            }
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, p: f64) -> Point {
        Point { place: [x, 2.0, 3.0], chances: [p, 0.5 * p, 0.0] }
    }

    #[test]
    fn points_move_from_one_step_to_the_next() {
        let rows = [(0.0, point(0.0, 0.2)), (0.0, point(8.0, 0.0)), (10.0, point(4.0, 0.4))];
        let way = Interpolation::InverseDistance;
        let waiting = Points::moving(&rows, way, 1).unwrap();
        assert_eq!(waiting.at(5.0).len(), 2, "another number of points: they wait");
        let moving = Points::moving(&[rows[0], rows[2]], way, 1).unwrap();
        assert_eq!(moving.at(2.5), [Point { place: [1.0, 2.0, 3.0], chances: [0.25, 0.125, 0.0] }]);
        assert_eq!(moving.at(99.0), [rows[2].1]);
    }

    #[test]
    fn at_a_point_its_own_probability_holds_and_far_away_the_mean() {
        let points = vec![point(1.0, 0.2), point(21.0, 0.6)];
        let still = Points::still(points.clone(), Interpolation::InverseDistance, 1);
        assert_eq!(still.chances(&points, [1.0, 2.0, 3.0]), [0.2, 0.1, 0.0]);
        assert!((still.chances(&points, [1e6, 2.0, 3.0])[0] - 0.4).abs() < 1e-4);
        assert!((still.chances(&points, [11.0, 2.0, 3.0])[0] - 0.4).abs() < 1e-12, "half way");
        let gauss = Points::still(points.clone(), Interpolation::Gaussian(4.0), 1);
        // exp(-400 / 32) of the other's weight.
        let other = libm::exp(-12.5);
        let known = (0.2 + 0.6 * other) / (1.0 + other);
        assert!((gauss.chances(&points, [1.0, 2.0, 3.0])[0] - known).abs() < 1e-12);
        assert!(gauss.chances(&points, [1e6, 0.0, 0.0])[0] > 0.59, "no point is near enough to be lost");
    }

    #[test]
    fn a_band_knows_its_greatest() {
        let points = vec![point(3.0, 0.9), Point { place: [3.0, 30.0, 3.0], chances: [0.1, 0.0, 0.0] }];
        for spacing in [1, 4, 7] {
            let still = Points::still(points.clone(), Interpolation::Gaussian(5.0), spacing);
            let lattice = still.lattice([20, 40, 9], 0.0);
            let other = still.lattice([20, 40, 8], 0.0);
            assert!(
                other.at(0, [3, 3, 3]) == lattice.at(0, [3, 3, 3]),
                "of another lattice what is kept is no use"
            );
            for k in 0..9 {
                for first in (0..40).step_by(16) {
                    let rows = first..(first + 16).min(40);
                    let most = lattice.most(0, rows.clone(), k);
                    for j in rows {
                        assert!((0..20).all(|i| lattice.at(0, [i, j, k]) <= most + 1e-12));
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_no_point_is_refused() {
        let way = Interpolation::InverseDistance;
        assert_eq!(Points::moving(&[], way, 1), Err(PointError::None));
        let says = |rows: &[(f64, Point)]| Points::moving(rows, way, 1).unwrap_err().to_string();
        assert_eq!(says(&[(0.0, point(0.0, 1.5))]), "line 2: p_hum is 1.5; 0 to 1 is accepted");
        assert!(says(&[(5.0, point(0.0, 0.1)), (4.0, point(0.0, 0.1))]).starts_with("line 3: step 4 comes"));
        assert!(says(&[(0.0, point(f64::NAN, 0.1))]).starts_with("line 2: x is NaN"));
    }
}
