//! A sky with structure at several scales, seen from above as by a satellite.

use snowglobe::automaton_cloud::{
    Chance, Injection, Interpolation, Metaballs, Packed, Point, Points, Rules, Smoothing,
};
use snowglobe::lab::Result;
use snowglobe::rng::Seed;
use snowglobe::volume::{Camera, Density, Rendered, Shading, render};

use super::setup::{MENDED, broken};
use super::sky::{CELL, RADIUS, unseen};

/// Cells from a point to the next.
const SPACING: usize = 8;
/// Cells of the scales at which vapour varies.
const SCALES: [usize; 5] = [128, 64, 32, 16, 8];
/// Probability that a cell is activated, over that of vapour; that its cloud begins to vanish.
const ACTIVE: f64 = 0.01;
const VANISHING: f64 = 0.004;
const LIFETIME: u8 = 8;

/// A sky of points on a lattice, each as wet as all scales say.
pub struct Scales {
    pub counts: [usize; 3],
    pub seed: u64,
    /// Probability of vapour, each step, of a point that is neither wet nor dry.
    pub vapour: f64,
    /// The logarithm of how much wetter the wettest is than the driest, at each scale.
    pub spread: f64,
    /// The probability that is everywhere alike instead.
    pub even: Option<f64>,
    pub steps: usize,
}

impl Scales {
    /// The points and the probability of vapour there: the product of a factor for each scale, as in a cascade, but smooth.
    fn points(&self) -> Vec<([f64; 3], f64)> {
        let wetness = Seed(self.seed).stream("a sky of several scales: wetness");
        // From -0.5 to 0.5, smooth between places that far apart.
        let wave = |number: usize, at: [usize; 2]| {
            let scale = SCALES[number];
            let corner = |x: usize, y: usize| {
                let place = [at[0] / scale + x, at[1] / scale + y].map(|place| place as i32);
                wetness.at(number as u64).place(place[0], place[1], 0).uniform() - 0.5
            };
            let [u, v] = at.map(|at| (at % scale) as f64 / scale as f64).map(|u| u * u * (3.0 - 2.0 * u));
            let row = |y: usize| corner(0, y) + u * (corner(1, y) - corner(0, y));
            row(0) + v * (row(1) - row(0))
        };
        let [nx, ny, nz] = self.counts;
        let mut points = Vec::new();
        for y in (SPACING / 2..ny).step_by(SPACING) {
            for x in (SPACING / 2..nx).step_by(SPACING) {
                let waves = (0..SCALES.len()).map(|number| wave(number, [x, y])).sum::<f64>();
                let vapour = (self.vapour * libm::exp(self.spread * waves)).min(1.0);
                points.push(([x as f64, y as f64, 0.3 * nz as f64], vapour));
            }
        }
        points
    }

    /// Probabilities in each step, from the points or everywhere their mean.
    fn chance(&self) -> Chance {
        let chances = |vapour: f64| [vapour, ACTIVE * vapour, VANISHING];
        if let Some(vapour) = self.even {
            return Chance::Uniform(chances(vapour));
        }
        let points =
            self.points().into_iter().map(|(place, vapour)| Point { place, chances: chances(vapour) });
        // Knots as close as the Gaussian is wide.
        let width = SPACING / 2;
        Chance::Points(Points::still(points.collect(), Interpolation::Gaussian(width as f64), width))
    }

    /// The clouds after all steps, as central densities.
    pub fn central(&self) -> Result<Vec<f32>> {
        let injection = Injection { seed: Seed(self.seed), chance: self.chance() };
        let mut clouds = Packed::new(self.counts, Rules { lifetime: LIFETIME, ..MENDED }).map_err(broken)?;
        clouds.inject(&injection);
        for _ in 0..self.steps {
            clouds.step();
            clouds.inject(&injection);
        }
        Ok(self.balls().central(&clouds.cld()))
    }

    fn balls(&self) -> Metaballs {
        Metaballs { counts: self.counts, radius: RADIUS }
    }

    /// From above, with so many pixels.
    pub fn seen_from_above(&self, extinction: f64, shading: &Shading, size: [usize; 2]) -> Result<Rendered> {
        let balls = self.balls();
        let central = Metaballs::over_time(&Smoothing::Space, &[&self.central()?]);
        let whole = balls.whole() as f32;
        let rho = balls.density(&central).into_iter().map(|rho| rho / whole).collect();
        let density = Density::new(self.counts, CELL, rho).map_err(unseen)?;
        let camera =
            Camera::orthographic(&density, [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], size).map_err(unseen)?;
        render(&density, extinction, &camera, shading, 1).map_err(unseen)
    }
}
