//! A coordinate that is linear or logarithmic.

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::Ranged;

/// Equal distances are equal differences, or equal ratios.
pub(super) enum Coord {
    Linear(RangedCoordf64),
    Log(f64, f64),
}

impl Coord {
    pub(super) fn new((from, to): (f64, f64), log: bool) -> Self {
        // There are no ratios from 0 or below.
        match log && from > 0.0 && to > from && to.is_finite() {
            true => Self::Log(from, to),
            false => Self::Linear((from..to).into()),
        }
    }

    /// The numbers 1, 2 and 5 times powers of ten, as many as there is room for.
    fn ticks(from: f64, to: f64, most: usize) -> Vec<f64> {
        let first = libm::floor(libm::log10(from)) as i32;
        let last = libm::ceil(libm::log10(to)) as i32;
        let with = |steps: &[f64]| -> Vec<f64> {
            let decades = (first..=last).map(|k| libm::exp10(f64::from(k)));
            // Rounded, so that 10 is 10.
            let all = decades.flat_map(|ten| {
                steps.iter().map(move |s| if ten < 1.0 { s * ten } else { libm::round(s * ten) })
            });
            all.filter(|tick| *tick >= from * 0.999 && *tick <= to * 1.001).collect()
        };
        let steps: [&[f64]; 3] = [&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0], &[1.0, 2.0, 5.0], &[1.0]];
        let fitting = steps[1..].iter().map(|steps| with(steps)).find(|ticks| ticks.len() <= most);
        let ticks = fitting.unwrap_or_else(|| {
            let all = with(steps[2]);
            let every = all.len().div_ceil(most.max(1));
            all.into_iter().step_by(every).collect()
        });
        if ticks.len() < 2 { with(steps[0]) } else { ticks }
    }
}

impl Ranged for Coord {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        match self {
            Self::Linear(linear) => linear.map(value, limit),
            Self::Log(from, to) => {
                let part = libm::log10((value / from).max(f64::MIN_POSITIVE)) / libm::log10(to / from);
                let part = part.clamp(-1.0, 2.0);
                limit.0 + libm::round(part * f64::from(limit.1 - limit.0)) as i32
            }
        }
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match self {
            Self::Linear(linear) => linear.key_points(hint),
            Self::Log(from, to) => Self::ticks(*from, *to, hint.bold_points()),
        }
    }

    fn range(&self) -> Range<f64> {
        match self {
            Self::Linear(linear) => linear.range(),
            Self::Log(from, to) => *from..*to,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_ratios_are_equal_distances() {
        let coord = Coord::new((1.0, 100.0), true);
        assert_eq!([1.0, 10.0, 100.0].map(|v| coord.map(&v, (0, 200))), [0, 100, 200]);
        assert_eq!(Coord::ticks(1.0, 60.0, 9), [1.0, 2.0, 5.0, 10.0, 20.0, 50.0]);
        assert_eq!(Coord::ticks(0.25, 1000.0, 4), [1.0, 10.0, 100.0, 1000.0]);
        assert_eq!(Coord::ticks(30.0, 45.0, 9), [30.0, 40.0]);
        assert!(Coord::ticks(1e-9, 1e4, 5).len() <= 5);
    }

    #[test]
    fn what_has_no_ratio_does_no_harm() {
        let coord = Coord::new((1.0, 100.0), true);
        assert!(coord.map(&0.0, (0, 200)) < 0 && coord.map(&-3.0, (0, 200)) < 0);
        assert!(matches!(Coord::new((0.0, 10.0), true), Coord::Linear(_)));
    }
}
