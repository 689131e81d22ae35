//! What grows in which air: Fig. 2 in numbers.
//!
//! Fig. 2 and the function N of Eq. (8) are not printed as numbers. Here they are the inherent growth ratio and the
//! deposition density of Chen & Lamb (1994, J. Atmos. Sci. 51, 1206).

use super::saturation::excess_density;

/// Density of ice, kg/m3.
pub const ICE: f64 = 910.0;

/// dc/da over c/a at -1, -2, ... -60 C: Chen & Lamb (1994), Fig. 3, after Lamb & Scott (1972), as the public ports of WRF's
/// ISHMAEL have it. To -47 C three sources agree; below there is one. ISHMAEL itself then takes 0.7 below -20 C, for plates grow
/// there (Bailey & Hallett 2009); this is the table.
const GROWTH_RATIO: [f64; 60] = [
    0.910_547, 0.818_07, 0.687_4, 0.601_27, 1.597_67, 2.324_23, 2.088_18, 1.619_21, 1.158_65, 0.863_071,
    0.617_586, 0.453_917, 0.351_975, 0.287_94, 0.269_298, 0.287_94, 0.333_623, 0.418_883, 0.569_92,
    0.796_458, 1.143_25, 1.641_03, 1.901_38, 1.826_53, 1.619_21, 1.474_36, 1.324_63, 1.255_56, 1.222_39,
    1.206, 1.115_22, 1.107_51, 1.107_38, 1.114_84, 1.122_34, 1.122_21, 1.145_29, 1.168_84, 1.201_04,
    1.225_73, 1.250_94, 1.276_66, 1.311_83, 1.338_8, 1.357_04, 1.375_53, 1.384_79, 1.394_11, 1.403_49,
    1.412_94, 1.422_45, 1.432_02, 1.441_66, 1.451_37, 1.461_14, 1.470_97, 1.480_87, 1.501_05, 1.500_87,
    1.510_98,
];

/// The inherent growth ratio at a temperature in C: below 1 plates grow, above 1 columns.
///
/// Between whole degrees it is linear, as in the source; so it is from -1 C to 1 at 0 C, and below -60 C it stays.
pub fn growth_ratio(temperature: f64) -> f64 {
    let degrees = (-temperature).clamp(0.0, 60.0);
    let whole = (degrees as usize).min(59);
    let at = |k: usize| if k == 0 { 1.0 } else { GROWTH_RATIO[k - 1] };
    let rest = degrees - whole as f64;
    (1.0 - rest) * at(whole) + rest * at(whole + 1)
}

/// The density at which ice is deposited, kg/m3: `910 exp(-3 max(excess - 0.05, 0) / ratio)`, the excess of vapour over
/// saturation over ice in g/m3 (Chen & Lamb 1994).
///
/// The excess is that of the air around, as in most of the public codes; some take it at the crystal's surface, which is warmer,
/// and find loose ice a third to three quarters denser. The faster it grows, the more air there is between branches.
pub fn deposition_density(temperature: f64, supersaturation: f64) -> f64 {
    let excess = 1e3 * excess_density(temperature, supersaturation);
    ICE * libm::exp(-3.0 * (excess - 0.05).max(0.0) / growth_ratio(temperature))
}

/// What a crystal looks like: the four of Fig. 1, and two between.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Habit {
    /// Fig. 1 (c).
    Plate,
    /// A plate of six broad branches.
    SectoredPlate,
    /// Fig. 1 (a).
    Dendrite,
    /// Fig. 1 (d).
    SolidColumn,
    /// A column with a funnel in each end.
    HollowColumn,
    /// Fig. 1 (b).
    Needle,
}

/// Where one habit becomes another. Nobody has printed such numbers: these are assumptions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HabitLimits {
    /// Below this share of ice a plate is a dendrite. 0.25: at water saturation that is from -12.7 to -17.2 C, where
    /// Bailey & Hallett (2009) have dendrites, from -12.7 to -17.1 C.
    pub dendrite: f64,
    /// Below this one it is sectored. 0.6: at water saturation from about -9.5 to -20.1 C.
    pub sectored: f64,
    /// Below this share of ice a column is hollow. 0.9.
    pub hollow: f64,
    /// From this growth ratio on a column is a needle, if it would be hollow. 1.95: only the peak near -6 C is above.
    pub needle: f64,
}

impl HabitLimits {
    /// The numbers above.
    pub const ASSUMED: Self = Self { dendrite: 0.25, sectored: 0.6, hollow: 0.9, needle: 1.95 };
}

impl Habit {
    /// All six.
    pub const ALL: [Self; 6] = [
        Self::Plate,
        Self::SectoredPlate,
        Self::Dendrite,
        Self::SolidColumn,
        Self::HollowColumn,
        Self::Needle,
    ];

    /// What grows at a temperature, C, and a supersaturation over ice, as a share.
    pub fn grown(temperature: f64, supersaturation: f64, limits: &HabitLimits) -> Self {
        let ratio = growth_ratio(temperature);
        let fill = deposition_density(temperature, supersaturation) / ICE;
        if ratio < 1.0 {
            match fill {
                fill if fill < limits.dendrite => Self::Dendrite,
                fill if fill < limits.sectored => Self::SectoredPlate,
                _ => Self::Plate,
            }
        } else {
            match fill {
                fill if fill >= limits.hollow => Self::SolidColumn,
                _ if ratio >= limits.needle => Self::Needle,
                _ => Self::HollowColumn,
            }
        }
    }

    /// Whether it is wider than long.
    pub fn is_platelike(self) -> bool {
        matches!(self, Self::Plate | Self::SectoredPlate | Self::Dendrite)
    }

    /// In kebab-case: `sectored-plate`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plate => "plate",
            Self::SectoredPlate => "sectored-plate",
            Self::Dendrite => "dendrite",
            Self::SolidColumn => "solid-column",
            Self::HollowColumn => "hollow-column",
            Self::Needle => "needle",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::saturation::water_saturation;
    use super::*;

    #[test]
    fn the_growth_ratio_is_the_table_and_linear_between() {
        for (temperature, ratio) in [
            (0.0, 1.0),
            (-0.5, 0.5 * (1.0 + 0.910547)),
            (-1.0, 0.910547),
            (-6.0, 2.32423),
            (-15.0, 0.269298),
            (-15.5, 0.5 * (0.269298 + 0.28794)),
            (-60.0, 1.51098),
            (-75.0, 1.51098),
        ] {
            assert!((growth_ratio(temperature) - ratio).abs() < 1e-12, "{temperature}");
        }
    }

    /// Worked by hand: at -15 C and water saturation the excess is 0.2231 g/m3.
    #[test]
    fn ice_is_deposited_loosely_where_dendrites_grow() {
        let density = deposition_density(-15.0, water_saturation(-15.0));
        assert!((density - 132.3).abs() < 0.5, "{density}");
        assert_eq!(deposition_density(-15.0, 0.02), ICE);
    }

    #[test]
    fn habits_at_water_saturation() {
        let at = |t: f64| Habit::grown(t, water_saturation(t), &HabitLimits::ASSUMED);
        for (t, habit) in [
            (-2.0, Habit::Plate),
            (-6.0, Habit::Needle),
            (-8.0, Habit::HollowColumn),
            (-12.0, Habit::SectoredPlate),
            (-15.0, Habit::Dendrite),
            (-18.0, Habit::SectoredPlate),
            (-25.0, Habit::HollowColumn),
        ] {
            assert_eq!(at(t), habit, "{t}");
        }
        assert_eq!(Habit::grown(-15.0, 0.03, &HabitLimits::ASSUMED), Habit::Plate);
        assert_eq!(Habit::grown(-8.0, 0.02, &HabitLimits::ASSUMED), Habit::SolidColumn);
    }
}
