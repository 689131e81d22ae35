//! How a field is lit: what is emitted or scattered at a place.

use super::vector::{dot, unit};
use super::{Octaves, VolumeError, within};

/// How a field is lit.
#[derive(Clone, Debug, PartialEq)]
pub enum Shading {
    /// Absorption and emission: a source of constant radiance, red, green and blue; of 0, absorption alone.
    Emission([f64; 3]),
    /// Light that is scattered once.
    Single(Single),
    /// Eq. (11) of Himeno, Kenmochi & Kotani, exact per cell.
    Himeno(Himeno),
    /// The same as printed: [`Himeno::as_printed`], with tau of extinction times the voxel's side. Every sample sums up what
    /// is before it anew, so a ray's time grows with the square of the grid's side.
    Printed(Himeno),
    /// Light that is scattered more than once, as octaves of the first time.
    Octaves(Octaves),
}

/// Light of the sun that is scattered once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Single {
    /// The share of the light taken away that is scattered, 0 to 1.
    pub albedo: f64,
    /// g of the phase function of Henyey & Greenstein, the mean cosine, within -1 to 1; 0 is isotropic.
    pub g: f64,
    /// Where the sun is.
    pub to_sun: [f64; 3],
    /// Irradiance of what is square to the sun, red, green and blue: its radiance over its solid angle.
    pub sun: [f64; 3],
}

/// What Eq. (11) and (16) of Himeno, Kenmochi & Kotani need.
///
/// {I(w) (k_d cos phi + k_s cos^n zeta) + k_a I_a}, with I(w) = I_0 exp(-tau times the depth to the light). The normal is
/// against the gradient of density; where there is none, and on the side that is turned away from the light, what needs
/// it is 0; so is a cosine below 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Himeno {
    /// k_d.
    pub diffuse: f64,
    /// k_s.
    pub specular: f64,
    /// n, Phong's power.
    pub power: u32,
    /// k_a.
    pub ambient: f64,
    /// Where the light is.
    pub to_light: [f64; 3],
    /// I_0, red, green and blue.
    pub light: [f64; 3],
    /// I_a, red, green and blue.
    pub ambient_light: [f64; 3],
}

impl Himeno {
    /// k_d cos phi + k_s cos^n zeta, seen along `view`, with a gradient of density of any length.
    #[inline]
    pub fn reflected(&self, gradient: [f64; 3], view: [f64; 3], to_light: [f64; 3]) -> f64 {
        let length = dot(gradient, gradient).sqrt();
        if length == 0.0 {
            return 0.0;
        }
        let normal = gradient.map(|x| -x / length);
        let cosine = dot(normal, to_light);
        if cosine <= 0.0 {
            return 0.0;
        }
        // The mirrored light is 2 (n l) n - l; towards the eye is against the view.
        let zeta = (dot(to_light, view) - 2.0 * cosine * dot(normal, view)).clamp(0.0, 1.0);
        self.diffuse * cosine.min(1.0) + self.specular * power(zeta, self.power)
    }
}

/// x to a whole power, by squares.
fn power(mut x: f64, mut n: u32) -> f64 {
    let mut product = 1.0;
    while n > 0 {
        if n & 1 == 1 {
            product *= x;
        }
        x *= x;
        n >>= 1;
    }
    product
}

/// The phase function of Henyey & Greenstein, 1/sr, whose integral over all directions is 1; `cosine` is that of the
/// angle by which light is turned.
pub fn henyey_greenstein(g: f64, cosine: f64) -> f64 {
    let base = (1.0 + g * g - 2.0 * g * cosine).max(1e-300);
    (1.0 - g * g) / (4.0 * std::f64::consts::PI * base * base.sqrt())
}

impl Shading {
    /// Refuses numbers that make no picture.
    pub(super) fn check(&self) -> Result<(), VolumeError> {
        let colour = |name, rgb: [f64; 3]| {
            rgb.into_iter().try_for_each(|value| within(name, value, 0.0, 1e30, "0 to 1e30"))
        };
        match self {
            Self::Emission(source) => colour("the radiance of the source", *source),
            Self::Single(single) => {
                within("the albedo", single.albedo, 0.0, 1.0, "0 to 1")?;
                within("g", single.g, -0.9999, 0.9999, "-0.9999 to 0.9999")?;
                colour("the irradiance of the sun", single.sun)?;
                unit("the direction to the sun", single.to_sun).map(|_| ())
            }
            Self::Himeno(himeno) | Self::Printed(himeno) => {
                let numbers = [("k_d", himeno.diffuse), ("k_s", himeno.specular), ("k_a", himeno.ambient)];
                for (name, value) in numbers {
                    within(name, value, 0.0, 1e30, "0 to 1e30")?;
                }
                colour("I_0", himeno.light)?;
                colour("I_a", himeno.ambient_light)?;
                unit("the direction to the light", himeno.to_light).map(|_| ())
            }
            Self::Octaves(octaves) => octaves.check(),
        }
    }
}
