//! Light that is scattered many times, as a sum of octaves: M. Wrenninge, C. Kulla & V. Lundqvist, *Oz: the great and
//! volumetric*, SIGGRAPH 2013 talks.
//!
//! Each octave is light scattered once in a medium that is thinner, by a, and scatters less, by b, and less forward, by c:
//! sum over i of b^i sigma_s L p(c^i g) exp(-a^i depth).

use super::exponential::{exp, mean};
use super::shading::henyey_greenstein;
use super::vector::unit;
use super::{VolumeError, within};

/// Most octaves.
pub const MOST_OCTAVES: usize = 8;

/// How many octaves, and the three lights: the sun, the sky above and the ground beneath.
///
/// Sky and ground are half a sphere of one radiance each, scattered as by an isotropic phase function and reaching a place
/// straight from above and from beneath.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octaves {
    /// How many, 1 to 8.
    pub count: usize,
    /// a, what is left of the extinction towards the light from one octave to the next, 0 to 1.
    pub attenuation: f64,
    /// b, what is left of the scattered light, 0 to 1.
    pub contribution: f64,
    /// c, what is left of g, 0 to 1.
    pub eccentricity: f64,
    /// Whether the weights b^i are divided by their sum. Then uniform white light is never more than itself, whatever a
    /// and b; as printed it may become as much as [`Octaves::gain`] times as strong.
    pub normalised: bool,
    /// The share of the light taken away that is scattered, 0 to 1.
    pub albedo: f64,
    /// g of the phase function of Henyey & Greenstein, within -1 to 1.
    pub g: f64,
    /// Where the sun is.
    pub to_sun: [f64; 3],
    /// Irradiance of what is square to the sun, red, green and blue.
    pub sun: [f64; 3],
    /// Where the zenith is.
    pub zenith: [f64; 3],
    /// Radiance of the sky, red, green and blue.
    pub sky: [f64; 3],
    /// Radiance of the ground, red, green and blue.
    pub ground: [f64; 3],
}

impl Octaves {
    /// The sum of b^i.
    pub fn gain(&self) -> f64 {
        self.row(self.contribution).iter().sum()
    }

    /// 1, `by`, its square and so on; 0 from `count` on.
    fn row(&self, by: f64) -> [f64; MOST_OCTAVES] {
        let (mut row, mut value) = ([0.0; MOST_OCTAVES], 1.0);
        for to in row.iter_mut().take(self.count) {
            *to = value;
            value *= by;
        }
        row
    }

    /// The octaves' weights, and how much of the extinction is left in each.
    pub(super) fn rows(&self) -> [[f64; MOST_OCTAVES]; 2] {
        let by = if self.normalised { 1.0 / self.gain() } else { 1.0 };
        [self.row(self.contribution).map(|weight| weight * by), self.row(self.attenuation)]
    }

    /// The phase functions of the octaves for light that is turned by an angle of this cosine, 1/sr.
    pub(super) fn phases(&self, cosine: f64) -> [f64; MOST_OCTAVES] {
        self.row(self.eccentricity).map(|c| henyey_greenstein(c * self.g, cosine))
    }

    pub(super) fn check(&self) -> Result<(), VolumeError> {
        within("the number of octaves", self.count as f64, 1.0, MOST_OCTAVES as f64, "1 to 8")?;
        let shares = [
            ("a, the attenuation of octaves,", self.attenuation),
            ("b, the contribution of octaves,", self.contribution),
            ("c, the eccentricity of octaves,", self.eccentricity),
            ("the albedo", self.albedo),
        ];
        for (name, value) in shares {
            within(name, value, 0.0, 1.0, "0 to 1")?;
        }
        within("g", self.g, -0.9999, 0.9999, "-0.9999 to 0.9999")?;
        let lights = [
            ("the irradiance of the sun", self.sun),
            ("the radiance of the sky", self.sky),
            ("the radiance of the ground", self.ground),
        ];
        for (name, rgb) in lights {
            rgb.into_iter().try_for_each(|value| within(name, value, 0.0, 1e30, "0 to 1e30"))?;
        }
        unit("the direction to the sun", self.to_sun)?;
        unit("the zenith", self.zenith).map(|_| ())
    }
}

/// Light gathered along one ray from one direction in all octaves: N of them, of which some may weigh nothing.
pub(super) struct Octave<const N: usize> {
    weights: [f64; N],
    thinner: [f64; N],
    depth: f64,
    at: f64,
    /// The exponents of all octaves at the place at hand, and e to minus these.
    before: [[f64; N]; 2],
    /// The sum.
    pub sum: f64,
}

impl<const N: usize> Octave<N> {
    /// With the octaves' weights.
    pub fn new(octaves: &Octaves, weights: [f64; MOST_OCTAVES]) -> Self {
        let thinner = octaves.rows()[1];
        Self {
            weights: std::array::from_fn(|i| weights[i]),
            thinner: std::array::from_fn(|i| thinner[i]),
            depth: 0.0,
            at: f64::NEG_INFINITY,
            before: [[0.0; N]; 2],
            sum: 0.0,
        }
    }

    #[inline(always)]
    fn exponents(&self, light: f64) -> [[f64; N]; 2] {
        let x: [f64; N] = std::array::from_fn(|i| self.depth + self.thinner[i] * light);
        [x, std::array::from_fn(|i| exp(-x[i]))]
    }

    /// Goes on over a part of the way of optical depth `depth`; `light` gives the depth to the light at a place.
    #[inline(always)]
    pub fn add(&mut self, [from, to]: [f64; 2], depth: f64, light: impl Fn(f64) -> f64) {
        if from != self.at {
            self.before = self.exponents(light(from));
        }
        self.depth += depth;
        let after = self.exponents(light(to));
        let [[x0, a0], [x1, a1]] = [self.before, after];
        let means: [f64; N] = std::array::from_fn(|i| mean(a0[i], a1[i], x0[i], x1[i]));
        let mut sum = 0.0;
        for (weight, mean) in self.weights.iter().zip(means) {
            sum += weight * mean;
        }
        self.sum += depth * sum;
        (self.before, self.at) = (after, to);
    }
}
