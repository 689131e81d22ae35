//! A crystal under the microscope: light from beneath is bent by its relief, and what a pixel shows is the light source at
//! the angle from which its light comes.
//!
//! A thin crystal whose thickness rises by grad h bends light by (n - 1) grad h. The source is the condenser's aperture; its
//! image is seen through the objective's, which is as wide.

use super::relief::Relief;

/// Index of refraction of ice, for yellow light.
pub const INDEX: f64 = 1.31;

/// How the crystal is lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Bright field: a disc of white light of this half-angle, radians. Where light is bent out of the aperture it is dark:
    /// at rims and ridges, as in Nakaya's photographs.
    BrightField(f64),
    /// The same disc, white in its middle and around it coloured by direction (Rheinberg 1896): the hue tells where
    /// light is bent to.
    Coloured(f64),
}

impl Light {
    /// Linear light, red, green and blue, of a place whose thickness has this slope; 1 where nothing bends it.
    pub fn through(self, slope: [f64; 2]) -> [f64; 3] {
        let bent = slope.map(|rise| (INDEX - 1.0) * rise);
        let angle = libm::hypot(bent[0], bent[1]);
        match self {
            Self::BrightField(aperture) => [overlap(angle / aperture); 3],
            Self::Coloured(aperture) => {
                let bright = overlap(0.6 * angle / aperture);
                let depth = (angle / aperture).min(1.0);
                let turn = libm::atan2(bent[1], bent[0]);
                [0.0, 1.0, 2.0].map(|channel| {
                    let hue = 0.5 + 0.5 * libm::cos(turn - channel * std::f64::consts::TAU / 3.0);
                    bright * (1.0 + depth * (hue - 1.0))
                })
            }
        }
    }

    /// All pixels of a relief.
    pub fn picture(self, relief: &Relief) -> Vec<[f64; 3]> {
        relief.slope().iter().map(|slope| self.through(*slope)).collect()
    }
}

/// The share that two equal discs have in common when their middles are `apart` radii from each other.
fn overlap(apart: f64) -> f64 {
    let half = 0.5 * apart;
    if half >= 1.0 {
        return 0.0;
    }
    2.0 * (libm::acos(half) - half * (1.0 - half * half).sqrt()) / std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_flat_is_as_bright_as_the_ground_and_what_is_steep_dark() {
        for light in [Light::BrightField(0.3), Light::Coloured(0.3)] {
            assert_eq!(light.through([0.0; 2]), [1.0; 3]);
        }
        // Bent by twice the aperture nothing of the source is left.
        assert_eq!(Light::BrightField(0.3).through([2.0 * 0.3 / 0.31 + 1e-9, 0.0]), [0.0; 3]);
        let brightness: Vec<f64> =
            (0..=20).map(|k| Light::BrightField(0.3).through([0.1 * f64::from(k), 0.0])[0]).collect();
        assert!(brightness.windows(2).all(|pair| pair[1] <= pair[0]));
    }

    /// Discs one radius apart: 2 pi / 3 - sqrt(3) / 2 over pi.
    #[test]
    fn discs_overlap_by_the_lens_between_them() {
        let known = 2.0 / 3.0 - 3_f64.sqrt() / (2.0 * std::f64::consts::PI);
        assert!((overlap(1.0) - known).abs() < 1e-15);
        assert_eq!([overlap(0.0), overlap(2.0), overlap(9.0)], [1.0, 0.0, 0.0]);
    }

    /// A third of a turn moves the colours on by one.
    #[test]
    fn the_hue_is_the_direction() {
        let light = Light::Coloured(0.4);
        let at = |degrees: f64| {
            let (sine, cosine) = libm::sincos(degrees.to_radians());
            light.through([cosine, sine])
        };
        let ([r, g, b], [r2, g2, b2]) = (at(10.0), at(130.0));
        for (one, other) in [(r, g2), (g, b2), (b, r2)] {
            assert!((one - other).abs() < 1e-12);
        }
        assert!(r > g && r > b);
    }
}
