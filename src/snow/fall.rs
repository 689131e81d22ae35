//! How a flake falls: Eq. (17) to (22).
//!
//! Eq. (22) is `du/dt = -g - (c / m) u` and knows no wind; the paper says so. Here air moves by W: `c (u - W)`. c is not
//! printed: it follows from the speed at which a flake falls when it falls steadily, `c = m g / speed`.

use nalgebra::Vector3;

use super::{SnowError, within};
use crate::reading::Reading;

/// g, m/s2.
pub const GRAVITY: f64 = 9.81;

/// How the resistance of air grows with speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drag {
    /// In proportion: Eq. (20).
    Linear,
    /// With the square, as of bodies whose wake is turbulent.
    Quadratic,
}

impl Reading for Drag {
    const QUANTITY: &'static str = "drag";
    const ALL: &'static [Self] = &[Self::Linear, Self::Quadratic];

    fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Quadratic => "quadratic",
        }
    }
}

/// Speed without air, m/s downwards from rest after a time in s: Eq. (19). Mass does not enter.
pub fn in_vacuum(seconds: f64) -> f64 {
    GRAVITY * seconds
}

/// A flake in air that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Falling {
    /// c / m of Eq. (22), 1/s; of quadratic drag the same over its steady speed, 1/m.
    pub drag_per_mass: f64,
    /// How it grows with speed.
    pub drag: Drag,
    /// W, m/s; y is up.
    pub wind: Vector3<f64>,
}

impl Falling {
    /// A flake that falls steadily at a speed, m/s, in air that moves by `wind`.
    ///
    /// # Errors
    ///
    /// A speed that is not 1 mm/s to 100 m/s.
    pub fn at_steady_speed(speed: f64, drag: Drag, wind: Vector3<f64>) -> Result<Self, SnowError> {
        within("the steady speed, m/s,", speed, 1e-3, 100.0)?;
        let drag_per_mass = match drag {
            Drag::Linear => GRAVITY / speed,
            Drag::Quadratic => GRAVITY / (speed * speed),
        };
        Ok(Self { drag_per_mass, drag, wind })
    }

    /// The speed at which weight and resistance are equal, m/s.
    pub fn steady_speed(&self) -> f64 {
        match self.drag {
            Drag::Linear => GRAVITY / self.drag_per_mass,
            Drag::Quadratic => libm::sqrt(GRAVITY / self.drag_per_mass),
        }
    }

    /// du/dt of Eq. (22), m/s2.
    pub fn acceleration(&self, velocity: &Vector3<f64>) -> Vector3<f64> {
        let through = velocity - self.wind;
        let speed = match self.drag {
            Drag::Linear => 1.0,
            Drag::Quadratic => through.norm_squared().sqrt(),
        };
        Vector3::new(0.0, -GRAVITY, 0.0) - self.drag_per_mass * speed * through
    }

    /// One step of Euler's method: of first order, and unstable beyond 2 m / c.
    pub fn euler(&self, velocity: &Vector3<f64>, seconds: f64) -> Vector3<f64> {
        velocity + seconds * self.acceleration(velocity)
    }

    /// The velocity after a time, exactly, in m/s: of linear drag from any velocity, of quadratic drag where the flake
    /// moves straight up or down in the air.
    ///
    /// # Errors
    ///
    /// Quadratic drag and a flake that also moves sideways in the air: that has no closed form.
    pub fn after(&self, velocity: &Vector3<f64>, seconds: f64) -> Result<Vector3<f64>, SnowError> {
        let steady = Vector3::new(0.0, -self.steady_speed(), 0.0);
        let through = velocity - self.wind;
        if self.drag == Drag::Linear {
            let left = libm::exp(-self.drag_per_mass * seconds);
            return Ok(self.wind + steady + left * (through - steady));
        }
        within("the speed sideways in the air, m/s,", through.x.abs().max(through.z.abs()), 0.0, 0.0)?;
        Ok(self.wind + Vector3::new(0.0, -self.sinking(-through.y, seconds), 0.0))
    }

    /// Downwards in the air after a time, quadratic drag, m/s.
    fn sinking(&self, now: f64, seconds: f64) -> f64 {
        let steady = self.steady_speed();
        let rate = GRAVITY / steady;
        if now < 0.0 {
            // Upwards both weight and air slow it: tan falls to 0, then it sinks from rest.
            let turn = libm::atan(-now / steady) / rate;
            return if seconds < turn {
                -steady * libm::tan(rate * (turn - seconds))
            } else {
                steady * libm::tanh(rate * (seconds - turn))
            };
        }
        // Sum of hyperbolic tangents.
        let gained = libm::tanh(rate * seconds);
        steady * (now + steady * gained) / (steady + now * gained)
    }
}

/// Fall speed by size: v = coefficient D^exponent, m/s and mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FallSpeed {
    /// Speed of a flake of 1 mm, m/s.
    pub coefficient: f64,
    /// The power.
    pub exponent: f64,
}

impl FallSpeed {
    /// Unrimed aggregates of dendrites (Locatelli & Hobbs 1974, table 1).
    pub const AGGREGATES: Self = Self { coefficient: 0.8, exponent: 0.16 };

    /// The speed of a flake of a diameter in m, m/s.
    pub fn of(&self, diameter: f64) -> f64 {
        self.coefficient * libm::pow(1e3 * diameter, self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CALM: Vector3<f64> = Vector3::new(0.0, 0.0, 0.0);
    const BREEZE: Vector3<f64> = Vector3::new(1.5, 0.2, -0.7);

    /// A fourth-order Runge-Kutta integration in 20000 steps: 1e-12 and what they round.
    fn integrated(falling: &Falling, mut velocity: Vector3<f64>, seconds: f64) -> Vector3<f64> {
        let step = seconds / 20_000.0;
        for _ in 0..20_000 {
            let a = falling.acceleration(&velocity);
            let b = falling.acceleration(&(velocity + 0.5 * step * a));
            let c = falling.acceleration(&(velocity + 0.5 * step * b));
            let d = falling.acceleration(&(velocity + step * c));
            velocity += step / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        }
        velocity
    }

    #[test]
    fn the_closed_forms_are_the_integrals() {
        for (drag, wind, from) in [
            (Drag::Linear, BREEZE, Vector3::new(-2.0, 3.0, 0.4)),
            (Drag::Quadratic, CALM, CALM),
            (Drag::Quadratic, CALM, Vector3::new(0.0, 3.0, 0.0)),
            (Drag::Quadratic, BREEZE, BREEZE - Vector3::new(0.0, 4.0, 0.0)),
        ] {
            let falling = Falling::at_steady_speed(1.1, drag, wind).unwrap();
            for seconds in [0.01, 0.2, 0.5] {
                let off = falling.after(&from, seconds).unwrap() - integrated(&falling, from, seconds);
                assert!(off.norm_squared().sqrt() < 1e-11, "{drag:?} {seconds}: {off}");
            }
        }
    }

    #[test]
    fn it_ends_at_its_steady_speed() {
        for drag in Drag::ALL {
            let falling = Falling::at_steady_speed(0.9, *drag, CALM).unwrap();
            assert!((falling.steady_speed() - 0.9).abs() < 1e-15);
            let last = falling.after(&CALM, 60.0).unwrap();
            assert!((last.y + 0.9).abs() < 1e-12);
        }
        assert!(Falling::at_steady_speed(0.0, Drag::Linear, CALM).is_err());
        let aside = Falling::at_steady_speed(1.0, Drag::Quadratic, CALM).unwrap().after(&BREEZE, 1.0);
        assert_eq!(aside.unwrap_err().to_string().lines().count(), 1);
    }

    /// By hand: 0.8 m/s at 1 mm, and 2^0.16 = 1.117 times as much at 2 mm.
    #[test]
    fn larger_flakes_fall_a_little_faster() {
        assert!((FallSpeed::AGGREGATES.of(1e-3) - 0.8).abs() < 1e-12);
        assert!((FallSpeed::AGGREGATES.of(2e-3) - 0.8938).abs() < 1e-4);
    }
}
