//! How far midpoints are displaced: Eq. (1).

use super::readings::{Amplitude, EdgeLength};
use crate::rng::Moment;

/// How midpoints are displaced: Eq. (1).
#[derive(Clone, Debug)]
pub struct Displacement {
    /// The exponent.
    pub amplitude: Amplitude,
    /// What L is.
    pub edge_length: EdgeLength,
    /// What the displacement is multiplied by; 1 as printed.
    pub gain: f64,
    /// The random numbers.
    pub moment: Moment,
}

impl Displacement {
    /// The standard deviation of v over the length of the original edge, at division `n`, the first being 0, where the
    /// surface has this dimension.
    pub fn relative(&self, n: u32, dimension: f64) -> f64 {
        let exponent = match self.amplitude {
            Amplitude::AsPrinted => dimension - 1.0,
            Amplitude::LineDimension => dimension - 2.0,
            Amplitude::ThreeMinusD => 3.0 - dimension,
        };
        let halved = match self.edge_length {
            EdgeLength::Original => 0.0,
            EdgeLength::Current => f64::from(n),
        };
        self.gain * libm::exp2(-f64::from(n + 1) * exponent - halved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    /// By hand, from (1): D = 2.5, third division, an edge of 8.
    #[test]
    fn the_exponent_is_that_of_the_reading() {
        let v = |amplitude, edge_length| {
            let moment = Seed(1).stream("Gauss").at(0);
            8.0 * Displacement { amplitude, edge_length, gain: 1.0, moment }.relative(2, 2.5)
        };
        let root = std::f64::consts::SQRT_2;
        for (amplitude, original) in [
            (Amplitude::AsPrinted, 8.0 / (16.0 * root)),
            (Amplitude::LineDimension, 8.0 / (2.0 * root)),
            (Amplitude::ThreeMinusD, 8.0 / (2.0 * root)),
        ] {
            assert!((v(amplitude, EdgeLength::Original) - original).abs() < 1e-14);
            assert!((v(amplitude, EdgeLength::Current) - original / 4.0).abs() < 1e-14);
        }
    }
}
