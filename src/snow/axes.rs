//! How fast a crystal grows: the function N of Eq. (8).
//!
//! The paper takes it from the diagram and prints no number. Here a crystal gathers vapour as a spheroid of half axes a
//! (in the plane) and c (along z) does by diffusion (Maxwell 1890; Pruppacher & Klett 1997, §13.3), at the density of
//! [`deposition_density`]; what is deposited goes to a and c by [`growth_ratio`], `d ln c = ratio d ln a` (Chen & Lamb 1994).

use super::SnowError;
use super::habit::{deposition_density, growth_ratio};
use super::saturation::{VAPOUR, ZERO, over_ice};

/// Latent heat of sublimation, J/kg.
const SUBLIMATION: f64 = 2.834e6;

/// The air that a crystal grows in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Temperature, C.
    pub temperature: f64,
    /// Supersaturation over ice, as a share. At 0 and below nothing grows; crystals do not shrink here.
    pub supersaturation: f64,
    /// Pressure, Pa.
    pub pressure: f64,
    /// By how much a crystal that falls gathers more than one at rest. 1: at rest.
    pub ventilation: f64,
}

impl Air {
    /// # Errors
    ///
    /// A temperature outside of -60 to 0 C, a supersaturation outside of -1 to 2, a pressure outside of 1e4 to 2e5 Pa, a
    /// ventilation outside of 0 to 100.
    pub fn check(&self) -> Result<(), SnowError> {
        super::within("the temperature, C,", self.temperature, -60.0, 0.0)?;
        super::within("the supersaturation over ice, as a share,", self.supersaturation, -1.0, 2.0)?;
        super::within("the pressure, Pa,", self.pressure, 1e4, 2e5)?;
        super::within("the ventilation", self.ventilation, 0.0, 100.0)
    }

    /// The mass that a crystal of capacitance 1 m gathers, kg/(m s): `4 pi s / (F_k + F_d)`.
    fn gathered(&self) -> f64 {
        let kelvin = ZERO + self.temperature;
        // Conductivity of heat in air, W/(m K), and diffusivity of vapour, m2/s (Pruppacher & Klett 1997, 13-18a and 13-3).
        let conductivity = 4.184e-3 * (5.69 + 0.017 * self.temperature);
        let diffusivity = 2.11e-5 * libm::pow(kelvin / ZERO, 1.94) * (101_325.0 / self.pressure);
        let heat = (SUBLIMATION / (VAPOUR * kelvin) - 1.0) * SUBLIMATION / (conductivity * kelvin);
        let vapour = VAPOUR * kelvin / (diffusivity * over_ice(self.temperature));
        4.0 * std::f64::consts::PI * self.supersaturation.max(0.0) * self.ventilation / (heat + vapour)
    }
}

/// A crystal's half axes and mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// Half axis in the plane: from the centre to a corner, m.
    pub a: f64,
    /// Half axis along z, m.
    pub c: f64,
    /// Mass, kg.
    pub mass: f64,
}

impl Axes {
    /// A sphere of ice that begins to grow, m: an assumption of the harness.
    pub const SEED: f64 = 10e-6;

    /// A sphere of ice of a radius in m.
    pub fn sphere(radius: f64) -> Self {
        let mass = 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius * super::habit::ICE;
        Self { a: radius, c: radius, mass }
    }

    /// Volume of the spheroid, m3.
    pub fn volume(&self) -> f64 {
        4.0 / 3.0 * std::f64::consts::PI * self.a * self.a * self.c
    }

    /// Its capacitance, m: `a e / asin e` of an oblate one, `A / ln((c + A) / a)` of a prolate one.
    pub fn capacitance(&self) -> f64 {
        let flat = self.c / self.a;
        // Near the sphere both are a (2 + flat) / 3 to second order.
        if (flat - 1.0).abs() < 1e-4 {
            self.a * (2.0 + flat) / 3.0
        } else if flat < 1.0 {
            let e = (1.0 - flat * flat).sqrt();
            self.a * e / libm::asin(e)
        } else {
            let reach = (flat * flat - 1.0).sqrt();
            self.a * reach / libm::log(flat + reach)
        }
    }

    /// After a time in s, in steps in which the volume grows by at most one part in 50.
    pub fn grown(&self, air: &Air, seconds: f64) -> Self {
        let ratio = growth_ratio(air.temperature);
        let density = deposition_density(air.temperature, air.supersaturation);
        let gathered = air.gathered();
        let (mut axes, mut left) = (*self, seconds);
        while left > 0.0 && gathered > 0.0 {
            let speed = gathered * axes.capacitance(); // kg/s
            let swelling = speed / (density * axes.volume()); // of ln V, 1/s
            let step = left.min(0.02 / swelling);
            let along_a = swelling * step / (2.0 + ratio);
            axes.a *= libm::exp(along_a);
            axes.c *= libm::exp(ratio * along_a);
            axes.mass += speed * step;
            left -= step;
        }
        axes
    }
}

#[cfg(test)]
mod tests {
    use super::super::saturation::water_saturation;
    use super::*;

    fn saturated(temperature: f64) -> Air {
        let supersaturation = water_saturation(temperature);
        Air { temperature, supersaturation, pressure: 1e5, ventilation: 1.0 }
    }

    fn after(minutes: f64, temperature: f64) -> Axes {
        Axes::sphere(Axes::SEED).grown(&saturated(temperature), 60.0 * minutes)
    }

    /// -15 C (Takahashi & Fukuta 1988; Libbrecht), within the half degree of the scan and the table's own degree.
    #[test]
    fn along_a_it_grows_fastest_at_15_below() {
        let best = (4..80).max_by(|j, k| {
            let at = |k: i32| after(10.0, -0.5 * f64::from(k)).a;
            at(*j).total_cmp(&at(*k))
        });
        assert_eq!(best, Some(30));
    }

    /// -5.5 C (Takahashi & Fukuta 1988), within 1 degree, which is the table's.
    #[test]
    fn along_c_it_grows_fastest_near_6_below() {
        let best = (4..80)
            .max_by(|j, k| {
                let at = |k: i32| after(10.0, -0.5 * f64::from(k)).c;
                at(*j).total_cmp(&at(*k))
            })
            .unwrap();
        assert!((-0.5 * f64::from(best) + 5.5).abs() <= 1.0, "{best}");
    }

    /// A sphere's a^2 grows linearly: dm/dt = 4 pi a G s. The growth ratio is 1 between -9 and -10 C, but not the density
    /// ice, hence little vapour: 0.02 s. Steps of 1 part in 50 of the volume are one of 150 of the radius, first order:
    /// 1 %.
    #[test]
    fn a_sphere_follows_the_square_root_law() {
        let temperature = -9.0 - 0.15865 / (1.15865 - 0.863071);
        let air = Air { supersaturation: 0.02, ..saturated(temperature) };
        assert!((growth_ratio(temperature) - 1.0).abs() < 1e-12);
        let start = Axes::sphere(10e-6);
        let end = start.grown(&air, 600.0);
        let expected = (1e-10 + 2.0 * air.gathered() * 600.0 / (4.0 * std::f64::consts::PI * 910.0)).sqrt();
        assert!((end.a / expected - 1.0).abs() < 0.01, "{} against {expected}", end.a);
        assert!((end.a / end.c - 1.0).abs() < 1e-9);
    }

    #[test]
    fn capacitance_is_continuous_and_that_of_a_disc() {
        let of = |a, c| Axes { a, c, mass: 0.0 }.capacitance();
        for (low, high) in [(0.999_899, 0.999_901), (1.000_099, 1.000_101)] {
            assert!((of(1.0, low) - of(1.0, high)).abs() < 1e-5);
        }
        assert!((of(1.0, 1e-9) - 2.0 / std::f64::consts::PI).abs() < 1e-6);
    }

    #[test]
    fn nothing_grows_where_there_is_no_excess() {
        let air = Air { supersaturation: -0.1, ..saturated(-15.0) };
        assert_eq!(Axes::sphere(1e-5).grown(&air, 600.0), Axes::sphere(1e-5));
        assert!(Air { temperature: 1.0, ..air }.check().is_err());
        assert!(Air { pressure: f64::NAN, ..air }.check().is_err());
    }
}
