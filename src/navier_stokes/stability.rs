//! The largest stable time step: von Neumann's analysis of one step with frozen coefficients.

use std::f64::consts::PI;

use super::Convection;

/// Growth per step that is let pass: Adams-Bashforth lets undamped waves grow by the fourth power of the Courant
/// number, which is harmless as long as it is small; a step forward in time has no such excuse, but for rounding.
const GROWTH: [f64; 2] = [1e-12, 1e-4];
/// Wave numbers looked at in each direction, from 0 to pi.
const WAVES: usize = 48;

/// How a step is taken in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// All terms forward in time, Eq. (17).
    Euler,
    /// Convection by second-order Adams-Bashforth, diffusion forward in time.
    AdamsBashforth,
}

impl Step {
    /// What the staggered solver takes with a form of convection: forward in time for [`Convection::Upwind`], whose
    /// damping Adams-Bashforth takes badly.
    pub fn of(convection: Convection) -> Self {
        match convection {
            Convection::Central => Self::AdamsBashforth,
            Convection::Upwind => Self::Euler,
        }
    }

    /// The largest time step in s at which no wave grows, where the air moves with (`u`, `v`) m/s; cells of `spacing`
    /// m, viscosity in m2/s. Infinite where nothing limits it.
    pub fn largest(self, convection: Convection, viscosity: f64, spacing: [f64; 2], speed: [f64; 2]) -> f64 {
        let rate =
            (0..2).map(|a| 4.0 * viscosity / (spacing[a] * spacing[a]) + 2.0 * speed[a].abs() / spacing[a]);
        let rate: f64 = rate.sum();
        if rate == 0.0 {
            return f64::INFINITY;
        }
        // At 8 / rate nothing is stable, at 0 everything.
        let (mut stable, mut unstable) = (0.0, 8.0 / rate);
        for _ in 0..40 {
            let dt = 0.5 * (stable + unstable);
            if self.growth(convection, viscosity, spacing, speed, dt)
                <= 1.0 + GROWTH[usize::from(self == Self::AdamsBashforth)]
            {
                stable = dt;
            } else {
                unstable = dt;
            }
        }
        stable
    }

    /// The largest modulus of an amplification factor over all waves.
    fn growth(
        self,
        convection: Convection,
        viscosity: f64,
        spacing: [f64; 2],
        speed: [f64; 2],
        dt: f64,
    ) -> f64 {
        let mut largest: f64 = 0.0;
        let along = |axis: usize, wave: usize| {
            let theta = PI * wave as f64 / WAVES as f64;
            let courant = dt * speed[axis].abs() / spacing[axis];
            let even = 1.0 - libm::cos(theta);
            let upwind = if convection == Convection::Upwind { courant * even } else { 0.0 };
            let diffusion = 2.0 * dt * viscosity / (spacing[axis] * spacing[axis]) * even;
            (diffusion, upwind, courant * libm::sin(theta))
        };
        for (d_x, re_x, im_x) in (0..=WAVES).map(|wave| along(0, wave)) {
            for (d_y, re_y, im_y) in (0..=WAVES).map(|wave| along(1, wave)) {
                let (diffusion, re, im) = (d_x + d_y, re_x + re_y, im_x + im_y);
                largest = largest.max(match self {
                    Self::Euler => libm::hypot(1.0 - diffusion - re, im),
                    // G^2 - (1 - d - 3/2 c) G - c/2 = 0.
                    Self::AdamsBashforth => {
                        larger_root((1.0 - diffusion - 1.5 * re, -1.5 * im), (0.5 * re, 0.5 * im))
                    }
                });
            }
        }
        largest
    }
}

/// The larger modulus of the roots of `g^2 - b g - c = 0` with complex b and c.
pub(crate) fn larger_root(b: (f64, f64), c: (f64, f64)) -> f64 {
    let (re, im) = (b.0 * b.0 - b.1 * b.1 + 4.0 * c.0, 2.0 * b.0 * b.1 + 4.0 * c.1);
    let modulus = libm::hypot(re, im);
    let root = (libm::sqrt(0.5 * (modulus + re).max(0.0)), libm::sqrt(0.5 * (modulus - re).max(0.0)));
    let root = (root.0, if im < 0.0 { -root.1 } else { root.1 });
    let of = |sign: f64| 0.5 * libm::hypot(b.0 + sign * root.0, b.1 + sign * root.1);
    of(1.0).max(of(-1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textbook_bounds_come_out() {
        let h = 1.0 / 64.0;
        let still = Step::Euler.largest(Convection::Central, 0.01, [h, h], [0.0, 0.0]);
        assert!((still / (h * h / 0.04) - 1.0).abs() < 1e-3, "h^2 / (4 nu): {still}");
        // Forward in time and centred in space: 2 nu / u^2 where that is the smaller one, in one direction.
        let wind = Step::Euler.largest(Convection::Central, 0.001, [h, 1e9], [1.0, 0.0]);
        assert!((wind / 0.002 - 1.0).abs() < 2e-3, "2 nu / u^2: {wind}");
        let upwind = Step::Euler.largest(Convection::Upwind, 0.001, [h, h], [1.0, 0.5]);
        let bound = 1.0 / (1.5 / h + 4.0 * 0.001 / (h * h));
        assert!((upwind / bound - 1.0).abs() < 1e-3, "{upwind} {bound}");
        assert_eq!(Step::Euler.largest(Convection::Upwind, 0.0, [h, h], [0.0, 0.0]), f64::INFINITY);
    }

    #[test]
    fn the_cavity_of_128_cells_at_1000_may_take_5_ms() {
        let h = 1.0 / 128.0;
        let most = Step::AdamsBashforth.largest(Convection::Central, 0.001, [h, h], [1.0, 0.0]);
        assert!((0.005..0.008).contains(&most), "{most}");
    }
}
