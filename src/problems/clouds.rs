//! The parameters of a cloud from its picture (Miyata gives those of none but two of his): which D, gain and cut make a
//! picture with the statistics of one that was given?
//!
//! The picture is the model's own with parameters that the solver is not told. With the same throw of Gauss a cost of 0 is
//! known to exist; with another throw only the statistics can be alike.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use argmin::core::Error;

use super::{Suite, drawn};
use crate::contour_cloud::{
    Amplitude, Contour, ContourError, Cut, Displacement, EdgeLength, Grid, Passage, Patches, Plateau, Relief,
    Surface, lost,
};
use crate::optimize::contest::{Measure, Problem, Target};
use crate::rng::Seed;

/// How far statistics may be off, as a root mean square of the relative error.
pub const TARGETS: [f64; 5] = [0.1, 0.03, 0.01, 0.003, 0.001];
/// D, the gain, and the level of the cut in the unit of the plan.
const DOMAIN: [(f64, f64); 3] = [(2.05, 2.9), (0.05, 0.6), (-0.1, 0.3)];
/// Width and height of the plan.
const SIZE: [f64; 2] = [3.0, 2.0];
/// Numbers in a row and a column of the picture.
const COUNTS: [usize; 2] = [97, 65];
/// Below a pixel but for the longest patches.
const DIVISIONS: u32 = 3;
/// Of the light, to a unit of droplets.
const GAMMA: f64 = 6.0;
/// Distances in pixels at which pixels are compared.
const LAGS: [usize; 4] = [1, 2, 4, 8];

/// Of a picture's f: mean, standard deviation, and the root mean square difference of pixels at each of the lags.
pub type Statistics = [f64; 2 + LAGS.len()];

/// Whose throw of Gauss the solver's pictures are made with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Throw {
    /// That of the picture given.
    Same,
    /// Another.
    Another,
}

/// D, gain and cut from the statistics of a picture.
#[derive(Clone, Debug)]
pub struct PictureProblem {
    throw: Throw,
    wanted: Arc<Mutex<BTreeMap<u64, Statistics>>>,
}

impl PictureProblem {
    /// The problem with this throw.
    pub fn new(throw: Throw) -> Self {
        Self { throw, wanted: Arc::default() }
    }

    /// The parameters that the picture with this seed was made with: uniform in the middle half of the box.
    pub fn truth(&self, seed: Seed) -> Vec<f64> {
        drawn(seed, "clouds: hidden", &DOMAIN, 0.25, 0.5)
    }

    /// The statistics of the picture with these parameters, D, gain and cut, and this throw.
    ///
    /// # Errors
    ///
    /// Parameters that the model refuses.
    pub fn statistics(x: &[f64], throw: Seed) -> Result<Statistics, ContourError> {
        let &[dimension, gain, cut] = x else { return Err(ContourError::NoArea) };
        let surface = Surface {
            patches: Patches::new(&contours(dimension), Plateau::Raised)?,
            relief: Relief::Patches,
            displacement: Displacement {
                amplitude: Amplitude::ThreeMinusD,
                edge_length: EdgeLength::Original,
                gain,
                moment: throw.stream("clouds: Gauss").at(0),
            },
        };
        let grid = Grid { low: [0.0; 2], high: SIZE, counts: COUNTS };
        let heights = grid.heights(&surface, DIVISIONS).map_err(|_| ContourError::NoArea)?;
        let cut = Cut::Level { h: cut };
        let f: Vec<f64> =
            heights.iter().map(|z| lost(GAMMA, Passage::Above.length(*z, cut.height([0.0; 2])))).collect();
        Ok(of_picture(&f))
    }

    /// The statistics of the picture given, worked out once.
    fn wanted(&self, seed: Seed) -> Result<Statistics, ContourError> {
        let known = self.wanted.lock().ok().and_then(|wanted| wanted.get(&seed.0).copied());
        if let Some(statistics) = known {
            return Ok(statistics);
        }
        let statistics = Self::statistics(&self.truth(seed), seed)?;
        if let Ok(mut wanted) = self.wanted.lock() {
            wanted.insert(seed.0, statistics);
        }
        Ok(statistics)
    }
}

fn of_picture(f: &[f64]) -> Statistics {
    let [width, height] = COUNTS;
    let count = f.len() as f64;
    let mean = f.iter().sum::<f64>() / count;
    let mut all = [
        mean,
        libm::sqrt(f.iter().map(|f| (f - mean) * (f - mean)).sum::<f64>() / count),
        0.0,
        0.0,
        0.0,
        0.0,
    ];
    for (difference, lag) in all[2..].iter_mut().zip(LAGS) {
        let (mut sum, mut pairs) = (0.0, 0_u32);
        for y in 0..height {
            for x in 0..width {
                let here = f[y * width + x];
                let beside = [(x + lag, y), (x, y + lag)];
                for (x, y) in beside.into_iter().filter(|(x, y)| *x < width && *y < height) {
                    let off = f[y * width + x] - here;
                    (sum, pairs) = (sum + off * off, pairs + 1);
                }
            }
        }
        *difference = libm::sqrt(sum / f64::from(pairs));
    }
    all
}

/// A hill with two tops, its frame low.
fn contours(dimension: f64) -> Vec<Contour> {
    let [width, height] = SIZE;
    let contour = |level: f64, points: Vec<[f64; 2]>| Contour {
        name: format!("at {level}"),
        level,
        dimension,
        points,
        closed: true,
    };
    let ring = |x: f64, y: f64, rx: f64, ry: f64| -> Vec<[f64; 2]> {
        (0..12)
            .map(|k| {
                let angle = std::f64::consts::TAU * f64::from(k) / 12.0;
                let (sine, cosine) = libm::sincos(angle);
                let wave = 1.0 + 0.08 * libm::sin(3.0 * angle + x) + 0.05 * libm::sin(5.0 * angle + y);
                [x + rx * wave * cosine, y + ry * wave * sine]
            })
            .collect()
    };
    vec![
        contour(-0.25, vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]]),
        contour(0.0, ring(1.5, 1.0, 1.2, 0.75)),
        contour(0.15, ring(1.5, 1.0, 0.95, 0.55)),
        contour(0.3, ring(1.05, 0.97, 0.32, 0.28)),
        contour(0.3, ring(1.95, 1.04, 0.32, 0.28)),
    ]
}

impl Problem for PictureProblem {
    fn name(&self) -> String {
        match self.throw {
            Throw::Same => "picture-same-throw".to_owned(),
            Throw::Another => "picture-another-throw".to_owned(),
        }
    }

    fn domain(&self) -> Vec<(f64, f64)> {
        DOMAIN.to_vec()
    }

    /// Uniform in the box, with every seed another.
    fn start(&self, seed: Seed) -> Vec<f64> {
        drawn(seed, "clouds: start", &DOMAIN, 0.0, 1.0)
    }

    /// Statistics that are off by as much as they are.
    fn scale(&self) -> f64 {
        1.0
    }

    /// f has a kink at the cut, but there are many pixels.
    fn difference(&self) -> f64 {
        1e-4
    }

    fn targets(&self) -> Vec<Target> {
        TARGETS.map(Target::within).to_vec()
    }

    fn measure(&self, x: &[f64], seed: Seed) -> Result<Measure, Error> {
        let own = match self.throw {
            Throw::Same => seed,
            Throw::Another => Seed(seed.0.wrapping_add(1 << 32)),
        };
        let wanted = self.wanted(seed)?;
        let found = Self::statistics(x, own)?;
        let errors = wanted.iter().zip(&found).map(|(wanted, found)| (found - wanted) / wanted);
        Ok(Measure::of_cost(errors.map(|error| error * error).sum::<f64>() / wanted.len() as f64))
    }
}

/// The suite: the same throw, and another.
pub fn suite() -> Vec<PictureProblem> {
    vec![PictureProblem::new(Throw::Same), PictureProblem::new(Throw::Another)]
}

/// The suite as problems of any kind.
pub fn boxed(problems: Vec<PictureProblem>) -> Suite {
    problems.into_iter().map(|problem| Box::new(problem) as Box<_>).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hidden_parameters_cost_nothing_and_others_something() {
        let (problem, seed) = (PictureProblem::new(Throw::Same), Seed(3));
        let truth = problem.truth(seed);
        assert_eq!(problem.measure(&truth, seed).unwrap().cost, 0.0);
        for k in 0..3 {
            let mut other = truth.clone();
            other[k] += 0.02;
            let cost = problem.measure(&other, seed).unwrap().cost;
            assert!(cost > 1e-6, "{k}: {cost}");
        }
        let another = PictureProblem::new(Throw::Another).measure(&truth, seed).unwrap().cost;
        assert!(another > 0.0);
    }

    #[test]
    fn no_corner_of_the_box_is_refused() {
        for problem in suite() {
            for corner in 0..8 {
                let face = |k: usize| if corner >> k & 1 == 0 { DOMAIN[k].0 } else { DOMAIN[k].1 };
                let cost = problem.measure(&[face(0), face(1), face(2)], Seed(1)).unwrap().cost;
                assert!(cost.is_finite() && cost > 0.0, "{} {corner}: {cost}", problem.name());
            }
        }
    }

    /// By hand: a ramp of 0 to 1 along rows.
    #[test]
    fn a_ramp_has_the_statistics_that_it_must() {
        let [width, height] = COUNTS;
        let ramp: Vec<f64> = (0..width * height).map(|k| (k % width) as f64 / (width - 1) as f64).collect();
        let [mean, deviation, one, two, ..] = of_picture(&ramp);
        let n = width as f64;
        assert!((mean - 0.5).abs() < 1e-12);
        assert!((deviation - libm::sqrt((n + 1.0) / (12.0 * (n - 1.0)))).abs() < 1e-12);
        let along = (96 * 65) as f64 / (96 * 65 + 97 * 64) as f64;
        assert!((one - libm::sqrt(along) / 96.0).abs() < 1e-12);
        let along = (95 * 65) as f64 / (95 * 65 + 97 * 63) as f64;
        assert!((two - 2.0 * libm::sqrt(along) / 96.0).abs() < 1e-12);
    }
}
