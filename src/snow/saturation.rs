//! Vapour over water and ice.
//!
//! Magnus' formula with the coefficients of Sonntag (1990) that the WMO's guide to instruments has (No. 8, annex 4.B):
//! over water from -45 to 60 C, over ice from -65 to 0 C.

use super::Over;

/// Gas constant of vapour, J/(kg K).
pub const VAPOUR: f64 = 461.5;
/// 0 C in K.
pub const ZERO: f64 = 273.15;

/// Saturation pressure over water at a temperature in C, Pa.
pub fn over_water(temperature: f64) -> f64 {
    611.2 * libm::exp(17.62 * temperature / (243.12 + temperature))
}

/// Saturation pressure over ice at a temperature in C, Pa.
pub fn over_ice(temperature: f64) -> f64 {
    611.2 * libm::exp(22.46 * temperature / (272.62 + temperature))
}

/// Supersaturation over ice of air that is saturated over water, as a share: 0.16 at -15 C.
pub fn water_saturation(temperature: f64) -> f64 {
    over_water(temperature) / over_ice(temperature) - 1.0
}

/// Supersaturation over ice, as a share, of one over ice or water.
pub fn to_ice(supersaturation: f64, over: Over, temperature: f64) -> f64 {
    match over {
        Over::Ice => supersaturation,
        Over::Water => (1.0 + supersaturation) * (1.0 + water_saturation(temperature)) - 1.0,
    }
}

/// Density of the vapour in excess of saturation over ice, kg/m3; the supersaturation is over ice.
pub fn excess_density(temperature: f64, supersaturation: f64) -> f64 {
    supersaturation * over_ice(temperature) / (VAPOUR * (ZERO + temperature))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of `water_saturation.csv`, which has four decimals: 0.00005, and as much for the constants' own last digit.
    #[test]
    fn water_saturation_is_that_of_the_table() {
        for (temperature, supersaturation, excess) in [
            (-1.0, 0.01, 0.0446),
            (-5.0, 0.0509, 0.1652),
            (-12.0, 0.1267, 0.2285),
            (-15.0, 0.1608, 0.2231),
            (-22.0, 0.2442, 0.1793),
            (-40.0, 0.4803, 0.0574),
        ] {
            let found = water_saturation(temperature);
            assert!((found - supersaturation).abs() <= 1e-4, "{temperature}: {found}");
            let found = 1e3 * excess_density(temperature, found);
            assert!((found - excess).abs() <= 1e-4, "{temperature}: {found} g/m3");
        }
    }

    #[test]
    fn over_water_nothing_is_what_water_saturation_is_over_ice() {
        for temperature in [-2.0, -15.0, -30.0] {
            let found = to_ice(0.0, Over::Water, temperature);
            assert!((found - water_saturation(temperature)).abs() < 1e-15);
            assert_eq!(to_ice(0.07, Over::Ice, temperature), 0.07);
        }
    }
}
