//! Flows that are known exactly, to check a solver against.

use std::f64::consts::PI;

/// A flow that is known exactly.
pub trait Exact {
    /// Velocity at a place (m) and time (s), m/s.
    fn velocity(&self, place: [f64; 2], time: f64) -> [f64; 2];
}

/// Taylor and Green's decaying vortices in a box of `pi` by `pi` m without friction on its sides:
/// `u = sin x cos y e^(-2 nu t)`, `v = -cos x sin y e^(-2 nu t)`, x from the left side.
#[derive(Clone, Copy, Debug)]
pub struct TaylorGreen {
    /// Kinematic viscosity, m2/s.
    pub viscosity: f64,
}

impl TaylorGreen {
    /// Rate at which kinetic energy decays, 1/s: `4 nu`.
    pub fn decay(&self) -> f64 {
        4.0 * self.viscosity
    }
}

impl Exact for TaylorGreen {
    fn velocity(&self, place: [f64; 2], time: f64) -> [f64; 2] {
        let ((sin_x, cos_x), (sin_y, cos_y)) = (libm::sincos(place[0] + 0.5 * PI), libm::sincos(place[1]));
        let left = libm::exp(-2.0 * self.viscosity * time);
        [sin_x * cos_y * left, -cos_x * sin_y * left]
    }
}

/// Poiseuille's flow between walls at 0 and `height` m, as it is far behind an inflow: `u = 6 mean y (h - y) / h^2`.
#[derive(Clone, Copy, Debug)]
pub struct Poiseuille {
    /// Distance of the walls, m.
    pub height: f64,
    /// Mean speed, m/s, which is that of a uniform inflow.
    pub mean: f64,
}

impl Exact for Poiseuille {
    fn velocity(&self, place: [f64; 2], _: f64) -> [f64; 2] {
        let y = place[1] / self.height;
        [6.0 * self.mean * y * (1.0 - y), 0.0]
    }
}
