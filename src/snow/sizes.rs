//! How many flakes there are of which size, none of which the paper says.
//!
//! Diameters of the drops that flakes melt to follow an exponential law (Gunn & Marshall 1958); a flake's own diameter
//! follows from the density of aggregates (Brandes et al. 2007).

use super::{SnowError, within};

/// An exponential law of melted diameters, cut at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// N_0, 1/(m3 mm).
    pub intercept: f64,
    /// Lambda, 1/mm.
    pub slope: f64,
    /// The smallest melted diameter, mm.
    pub least: f64,
    /// The largest, mm.
    pub most: f64,
}

impl Sizes {
    /// Gunn & Marshall's law at a rate, mm of water an hour: N_0 = 3800 R^-0.87 and Lambda = 2.55 R^-0.48.
    ///
    /// # Errors
    ///
    /// A rate that is not 0.01 to 100; bounds, mm, that are not 0.01 to 10, or the first not below the second.
    pub fn gunn_marshall(rate: f64, [least, most]: [f64; 2]) -> Result<Self, SnowError> {
        within("the rate, mm/h,", rate, 0.01, 100.0)?;
        within("the largest melted diameter, mm,", most, 0.02, 10.0)?;
        within("the smallest melted diameter, mm,", least, 0.01, 0.999 * most)?;
        let (intercept, slope) = (3.8e3 * libm::pow(rate, -0.87), 2.55 * libm::pow(rate, -0.48));
        Ok(Self { intercept, slope, least, most })
    }

    /// Flakes in a cubic metre.
    pub fn number_density(&self) -> f64 {
        self.intercept / self.slope * (self.left(self.least) - self.left(self.most))
    }

    /// The melted diameter, mm, below which a share of the flakes is, 0 to 1.
    pub fn quantile(&self, share: f64) -> f64 {
        let (least, most) = (self.left(self.least), self.left(self.most));
        let melted = -libm::log(least - share * (least - most)) / self.slope;
        melted.clamp(self.least, self.most)
    }

    /// Share of an uncut law that is above.
    fn left(&self, melted: f64) -> f64 {
        libm::exp(-self.slope * melted)
    }
}

/// The density of an aggregate of a diameter in mm, kg/m3: 178 D^-0.922 (Brandes et al. 2007), not above that of ice.
pub fn aggregate_density(diameter: f64) -> f64 {
    (178.0 * libm::pow(diameter, -0.922)).min(super::ICE)
}

/// The diameter of a flake that melts to a drop of a diameter, both in mm: their masses are one.
pub fn diameter_of_melted(melted: f64) -> f64 {
    let cube = melted * melted * melted;
    let compact = libm::cbrt(cube * 1000.0 / super::ICE);
    // Loose ones are larger than that of ice alone.
    libm::pow(cube / 0.178, 1.0 / 2.078).max(compact)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At 1 mm/h: N_0 / Lambda = 1490 a cubic metre, of which exp(-0.765) are above 0.3 mm.
    #[test]
    fn there_are_as_many_as_the_law_says() {
        let sizes = Sizes::gunn_marshall(1.0, [0.3, 6.0]).unwrap();
        let known = 3800.0 / 2.55 * (libm::exp(-0.765) - libm::exp(-15.3));
        assert!((sizes.number_density() / known - 1.0).abs() < 1e-12);
        // Little is left of the law at 6 mm, so that its rounding is multiplied.
        assert!(sizes.quantile(0.0) == 0.3 && (sizes.quantile(1.0) - 6.0).abs() < 1e-9);
        // The median of what is above 0.3 mm is ln 2 / Lambda further.
        assert!((sizes.quantile(0.5) - 0.3 - libm::log(2.0) / 2.55).abs() < 1e-5);
        for (rate, bounds) in [(0.0, [0.3, 6.0]), (1.0, [6.0, 0.3]), (f64::NAN, [0.3, 6.0])] {
            assert!(Sizes::gunn_marshall(rate, bounds).is_err());
        }
    }

    #[test]
    fn melting_keeps_the_mass() {
        for melted in [0.05, 0.2, 0.5, 1.0, 2.0, 5.0] {
            let diameter = diameter_of_melted(melted);
            let share = aggregate_density(diameter) * diameter * diameter * diameter
                / (1000.0 * melted * melted * melted);
            assert!((share - 1.0).abs() < 1e-9, "{melted}: {share}");
        }
        // By hand: (1 / 0.178)^(1 / 2.078).
        assert!((diameter_of_melted(1.0) - 2.295).abs() < 1e-3);
    }
}
