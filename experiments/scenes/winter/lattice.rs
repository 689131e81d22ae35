//! Fractal surfaces of Miyata's midpoint displacement, kept as numbers on a lattice.

use rayon::prelude::*;
use snowglobe::contour_cloud::{
    Amplitude, Contour, Displacement, EdgeLength, Grid, Patches, Plateau, Relief, Surface,
};
use snowglobe::lab::{Error, Result};
use snowglobe::rng::Seed;

/// Numbers on a square lattice, read by a uniform cubic B-spline; at the rim and beyond the last ones go on.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// Where the first number is.
    low: [f64; 2],
    /// Between neighbours.
    spacing: f64,
    columns: usize,
    values: Vec<f32>,
}

impl Lattice {
    /// Zeros.
    pub fn level(low: [f64; 2], extent: f64, columns: usize) -> Self {
        Self { low, spacing: extent / (columns - 1) as f64, columns, values: vec![0.0; columns * columns] }
    }

    /// A fractal surface of midpoint displacement without hills of its own: rough in lengths up to `side`, of dimension
    /// `dimension`, over a square of `columns` numbers a side.
    pub fn fractal(low: [f64; 2], extent: f64, columns: usize, rough: Rough, seed: Seed) -> Result<Self> {
        let high = low.map(|x| x + extent);
        let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
        let contour = Contour {
            name: rough.name.to_owned(),
            level: 0.0,
            dimension: rough.dimension,
            points: corners.to_vec(),
            closed: true,
        };
        let patches =
            Patches::new(&[contour], Plateau::AsPrinted).map_err(|cause| Error::broken(cause.to_string()))?;
        let displacement = Displacement {
            amplitude: Amplitude::ThreeMinusD,
            edge_length: EdgeLength::Original,
            gain: rough.gain,
            moment: seed.stream(rough.name).at(0),
        };
        let patches = patches.even(rough.side, &displacement.moment);
        let surface = Surface { patches, relief: Relief::Patches, displacement };
        let grid = Grid { low, high, counts: [columns; 2] };
        let heights =
            grid.heights(&surface, rough.levels).map_err(|cause| Error::broken(cause.to_string()))?;
        let values = heights.into_iter().map(|height| height as f32).collect();
        Ok(Self { low, spacing: extent / (columns - 1) as f64, columns, values })
    }

    /// Averages with the neighbours in both directions, 1, 2, 1, so many times.
    pub fn smoothed(&self, times: usize) -> Self {
        let n = self.columns;
        let mut values = self.values.clone();
        for _ in 0..times {
            let before = values.clone();
            let near = |k: usize, step: usize, along: usize| {
                let last = if along > 0 { before[k - step] } else { before[k] };
                let next = if along + 1 < n { before[k + step] } else { before[k] };
                0.25 * (last + 2.0 * before[k] + next)
            };
            let across: Vec<f32> = (0..n * n).into_par_iter().map(|k| near(k, 1, k % n)).collect();
            let near = |k: usize| {
                let last = if k >= n { across[k - n] } else { across[k] };
                let next = if k + n < n * n { across[k + n] } else { across[k] };
                0.25 * (last + 2.0 * across[k] + next)
            };
            values = (0..n * n).into_par_iter().map(near).collect();
        }
        Self { values, ..self.clone() }
    }

    /// Every so many-th number only.
    pub fn thinned(&self, every: usize) -> Self {
        let columns = (self.columns - 1) / every + 1;
        let value = |k: usize| self.values[k / columns * every * self.columns + k % columns * every];
        let values = (0..columns * columns).map(value).collect();
        Self { low: self.low, spacing: self.spacing * every as f64, columns, values }
    }

    /// Each number changed, given its place.
    pub fn changed(mut self, by: impl Fn([f64; 2], f32) -> f32 + Sync) -> Self {
        let (n, low, spacing) = (self.columns, self.low, self.spacing);
        self.values.par_iter_mut().enumerate().for_each(|(k, value)| {
            let place = [low[0] + (k % n) as f64 * spacing, low[1] + (k / n) as f64 * spacing];
            *value = by(place, *value);
        });
        self
    }

    /// The value at a place, and its slope along both axes.
    pub fn at(&self, place: [f64; 2]) -> [f32; 3] {
        let last = (self.columns - 1) as f64;
        let [(i, wx, sx), (j, wy, sy)] = [0, 1].map(|axis| {
            let x = ((place[axis] - self.low[axis]) / self.spacing).clamp(0.0, last);
            let cell = libm::floor(x).min(last - 1.0);
            let (weights, slopes) = spline((x - cell) as f32);
            (cell as usize, weights, slopes)
        });
        let mut sums = [0.0; 3];
        for k in 0..4 {
            let row = (j + k).saturating_sub(1).min(self.columns - 1) * self.columns;
            let (mut value, mut slope) = (0.0, 0.0);
            for l in 0..4 {
                let number = self.values[row + (i + l).saturating_sub(1).min(self.columns - 1)];
                value += wx[l] * number;
                slope += sx[l] * number;
            }
            sums[0] += wy[k] * value;
            sums[1] += wy[k] * slope;
            sums[2] += sy[k] * value;
        }
        let per = (1.0 / self.spacing) as f32;
        [sums[0], sums[1] * per, sums[2] * per]
    }
}

/// How a fractal surface is rough.
#[derive(Clone, Copy, Debug)]
pub struct Rough {
    /// Of its random numbers.
    pub name: &'static str,
    /// D, 2 to 3.
    pub dimension: f64,
    /// The longest billow.
    pub side: f64,
    /// What Eq. (1) is multiplied by.
    pub gain: f64,
    /// Divisions.
    pub levels: u32,
}

/// The uniform cubic B-spline's weights of the four numbers around, and their slopes.
fn spline(t: f32) -> ([f32; 4], [f32; 4]) {
    let s = 1.0 - t;
    let weights = [
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    ];
    let slopes = [-0.5 * s * s, -2.0 * t + 1.5 * t * t, 2.0 * s - 1.5 * s * s, 0.5 * t * t];
    (weights, slopes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Lattice {
        let rough = Rough { name: "test", dimension: 2.3, side: 2.0, gain: 0.3, levels: 4 };
        Lattice::fractal([-4.0, 1.0], 8.0, 65, rough, Seed(1)).unwrap()
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        let lattice = lattice();
        for place in [[0.31, 4.2], [-3.9, 1.05], [3.2, 8.7]] {
            let [_, dx, dy] = lattice.at(place);
            for (axis, slope) in [dx, dy].into_iter().enumerate() {
                let at = |off: f64| {
                    let mut place = place;
                    place[axis] += off;
                    f64::from(lattice.at(place)[0])
                };
                assert!((f64::from(slope) - (at(1e-3) - at(-1e-3)) / 2e-3).abs() < 2e-3);
            }
        }
        assert!(lattice.at([1e9, -1e9])[0].is_finite());
    }

    #[test]
    fn smoothing_keeps_what_is_level_and_takes_roughness() {
        let (rough, level) = (lattice(), Lattice::level([0.0; 2], 1.0, 9).changed(|_, _| 0.7));
        assert!(level.smoothed(5).values.iter().all(|value| (value - 0.7).abs() < 1e-6));
        let power = |lattice: &Lattice| lattice.values.iter().map(|x| x * x).sum::<f32>();
        assert!(power(&rough.smoothed(8)) < 0.9 * power(&rough));
        assert_eq!(rough.thinned(8).values[9], rough.values[8 * 65]);
    }
}
