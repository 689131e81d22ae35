//! The surface shown as a layer of droplets: §3, Eq. (2) to (10).
//!
//! The paper has two equations (6); they are called (6) of §3.2 and (6) of §3.3 here.

use crate::image::{srgb_decode, srgb_encode};
use crate::reading::Reading;

/// W, the greatest value of a pixel.
pub const W: f64 = 255.0;

/// What is left of light of `incoming` strength after `length` of droplets that take away `gamma` of it per unit: Eq. (2).
pub fn transmitted(incoming: f64, gamma: f64, length: f64) -> f64 {
    incoming * libm::exp(-gamma * length)
}

/// f, the share of the light that is lost on the way: Eq. (5).
pub fn lost(gamma: f64, length: f64) -> f64 {
    -libm::expm1(-gamma * length)
}

/// The value of a pixel that has lost `f`, white where all is: Eq. (6) of §3.2.
pub fn pixel(f: f64) -> f64 {
    W * f
}

/// The face that cuts the layer off below: Z = P(x, y), Eq. (4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cut {
    /// Z = H, Eq. (8).
    Level {
        /// H.
        h: f64,
    },
    /// A X + B Y + C Z + D = 0, of Eq. (7); C is not 0.
    Plane {
        /// A, B, C and D.
        abcd: [f64; 4],
    },
    /// A cos(alpha X + B cos(beta Y)), Eq. (10), on a level.
    Waves {
        /// A, half the height of a wave.
        a: f64,
        /// How far the crests wind, in radians.
        b: f64,
        /// Waves along x: 2 pi over the wave length.
        alpha: f64,
        /// Windings along y: 2 pi over their length.
        beta: f64,
        /// The level around which they go; 0 as printed.
        level: f64,
    },
}

impl Cut {
    /// P(x, y).
    pub fn height(&self, [x, y]: [f64; 2]) -> f64 {
        match *self {
            Self::Level { h } => h,
            Self::Plane { abcd: [a, b, c, d] } => -(a * x + b * y + d) / c,
            Self::Waves { a, b, alpha, beta, level } => {
                level + a * libm::cos(alpha * x + b * libm::cos(beta * y))
            }
        }
    }
}

/// L of Eq. (3), (7) and (9), which differ in sign; the text calls it a distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// max(0, Z - P): droplets are above the cut and below the surface.
    Above,
    /// |Z - P|: droplets are wherever surface and cut are apart.
    Between,
}

impl Reading for Passage {
    const QUANTITY: &'static str = "passage";
    const ALL: &'static [Self] = &[Self::Above, Self::Between];

    fn name(self) -> &'static str {
        match self {
            Self::Above => "above",
            Self::Between => "between",
        }
    }
}

impl Passage {
    /// The length of the way through the droplets, from the surface at height `z` to the cut at `p`.
    pub fn length(self, z: f64, p: f64) -> f64 {
        match self {
            Self::Above => f64::max(0.0, z - p),
            Self::Between => (z - p).abs(),
        }
    }
}

/// What the values of Eq. (6) of §3.3 are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compositing {
    /// Code values of a frame buffer, as printed.
    AsPrinted,
    /// Light: code values are decoded before and encoded after (sRGB).
    LinearLight,
}

impl Reading for Compositing {
    const QUANTITY: &'static str = "compositing";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::LinearLight];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::LinearLight => "linear-light",
        }
    }
}

impl Compositing {
    /// A cloud's value before a background's, each 0 to [`W`]: Eq. (6) of §3.3, which is a screen blend.
    pub fn over(self, cloud: f64, background: f64) -> f64 {
        match self {
            Self::AsPrinted => background + (W - background) * cloud / W,
            Self::LinearLight => {
                let [a, b] = [cloud, background].map(|value| srgb_decode(value / W));
                W * srgb_encode(b + (1.0 - b) * a)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fig. 7.
    #[test]
    fn the_loss_grows_from_nothing_to_all() {
        for gamma in [0.1, 1.0, 7.0] {
            assert_eq!(lost(gamma, 0.0), 0.0);
            assert!((lost(gamma, std::f64::consts::LN_2 / gamma) - 0.5).abs() < 1e-15);
            let mut before = -1.0;
            for k in 0..200 {
                let length = f64::from(k) * 0.05;
                let f = lost(gamma, length);
                assert!((f - (1.0 - libm::exp(-gamma * length))).abs() < 1e-12);
                assert!((transmitted(3.0, gamma, length) - 3.0 * (1.0 - f)).abs() < 1e-12);
                assert!((0.0..=1.0).contains(&f) && f >= before);
                before = f;
            }
        }
        assert_eq!((pixel(0.0), pixel(1.0)), (0.0, 255.0));
    }

    /// Eq. (7), (8) and (9) are the same for a plane parallel to the ground, and (7) lies on its plane.
    #[test]
    fn a_level_is_a_plane() {
        let plane = Cut::Plane { abcd: [0.3, -0.2, 2.0, 1.0] };
        for place in [[0.0, 0.0], [3.0, -2.0], [-7.0, 0.5]] {
            let [x, y] = place;
            let z = 1.25;
            let by_7 = (0.3 * x - 0.2 * y + 2.0 * z + 1.0) / 2.0;
            assert!((z - plane.height(place) - by_7).abs() < 1e-12);
            assert_eq!(Cut::Plane { abcd: [0.0, 0.0, 2.0, -3.0] }.height(place), 1.5);
            assert_eq!(Cut::Level { h: 1.5 }.height(place), 1.5);
        }
    }

    /// Eq. (10): as high at a wave length along x and at a winding along y, and between -A and A.
    #[test]
    fn waves_repeat() {
        let (alpha, beta) = (2.0, 0.5);
        let waves = Cut::Waves { a: 0.4, b: 1.3, alpha, beta, level: 0.0 };
        let tau = std::f64::consts::TAU;
        for k in 0..50 {
            let (x, y) = (f64::from(k) * 0.13, f64::from(k) * -0.37);
            let p = waves.height([x, y]);
            assert!(p.abs() <= 0.4);
            assert!((waves.height([x + tau / alpha, y]) - p).abs() < 1e-12);
            assert!((waves.height([x, y + tau / beta]) - p).abs() < 1e-12);
        }
        assert!((waves.height([-1.3 / alpha, 0.0]) - 0.4).abs() < 1e-15, "a crest where the phase is 0");
    }

    #[test]
    fn nothing_is_below_the_cut_unless_it_is_between() {
        assert_eq!((Passage::Above.length(2.0, 0.5), Passage::Between.length(2.0, 0.5)), (1.5, 1.5));
        assert_eq!((Passage::Above.length(0.5, 2.0), Passage::Between.length(0.5, 2.0)), (0.0, 1.5));
    }

    /// Fig. 10: black leaves the background, white gives white, and it does not matter which is in front.
    #[test]
    fn compositing_is_a_screen() {
        for how in Compositing::ALL {
            for a in (0..=255).step_by(15).map(f64::from) {
                assert!((how.over(0.0, a) - a).abs() < 1e-9);
                assert!((how.over(W, a) - W).abs() < 1e-9);
                for b in (0..=255).step_by(17).map(f64::from) {
                    assert!((how.over(a, b) - how.over(b, a)).abs() < 1e-9);
                    assert!(how.over(a, b) >= f64::max(a, b) - 1e-9);
                }
            }
        }
        assert_eq!(Compositing::AsPrinted.over(51.0, 102.0), 102.0 + 153.0 * 0.2);
    }
}
