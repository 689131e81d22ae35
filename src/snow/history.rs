//! Temp(t) and Humid(t) of Eq. (8): what a crystal falls through.

use super::saturation::to_ice;
use super::{Over, SnowError};

/// The weather at a minute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weather {
    /// When, minutes after the crystal began to grow.
    pub minute: f64,
    /// Temperature, C.
    pub temperature: f64,
    /// Supersaturation, as a share: 0.16 is 16 %. Over what, the history says.
    pub supersaturation: f64,
}

/// Weather over minutes: linear between entries, constant before the first and after the last. Two entries at the same
/// minute are a jump.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    weather: Vec<Weather>,
    over: Over,
    minutes: f64,
}

impl History {
    /// The longest growth that is handled, minutes.
    pub const LONGEST: f64 = 1440.0;

    /// Weather, what its supersaturation is over, and how long the crystal grows, minutes.
    ///
    /// # Errors
    ///
    /// No entry; minutes that fall, or are not 0 to [`LONGEST`](Self::LONGEST); a temperature outside of -60 to 0 C; a
    /// supersaturation outside of -1 to 2.
    pub fn new(weather: Vec<Weather>, over: Over, minutes: f64) -> Result<Self, SnowError> {
        super::within("the time of growth, minutes,", minutes, 0.0, Self::LONGEST)?;
        if weather.is_empty() {
            return Err(SnowError::NoWeather);
        }
        let mut before = 0.0;
        for now in &weather {
            super::within("a minute of the history", now.minute, before, Self::LONGEST)?;
            super::within("the temperature, C,", now.temperature, -60.0, 0.0)?;
            super::within("the supersaturation, as a share,", now.supersaturation, -1.0, 2.0)?;
            before = now.minute;
        }
        Ok(Self { weather, over, minutes })
    }

    /// The same weather all the time.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn constant(
        temperature: f64,
        supersaturation: f64,
        over: Over,
        minutes: f64,
    ) -> Result<Self, SnowError> {
        Self::new(vec![Weather { minute: 0.0, temperature, supersaturation }], over, minutes)
    }

    /// Spells of constant temperature, C, and supersaturation over ice, as a share, each of so many minutes: jumps between.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn spells(spells: &[(f64, f64, f64)]) -> Result<Self, SnowError> {
        let (mut minute, mut weather) = (0.0, Vec::new());
        for &(temperature, supersaturation, minutes) in spells {
            weather.push(Weather { minute, temperature, supersaturation });
            minute += minutes;
            weather.push(Weather { minute, temperature, supersaturation });
        }
        Self::new(weather, Over::Ice, minute)
    }

    /// The same temperature, C, all the time, saturated over water.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn saturated(temperature: f64, minutes: f64) -> Result<Self, SnowError> {
        Self::constant(temperature, 0.0, Over::Water, minutes)
    }

    /// Needles at -6 C for 20 minutes, then plates at -12 C for 12, both saturated over water: a capped column.
    pub fn capped_column() -> Self {
        Self::known(&[(-6.0, 0.0614, 20.0), (-12.0, 0.1267, 12.0)])
    }

    /// At -15 C a plate at 4.5 % over ice for 40 minutes, then a dendrite at water saturation for 8: a plate with dendritic
    /// arms.
    pub fn plate_with_arms() -> Self {
        Self::known(&[(-15.0, 0.045, 40.0), (-15.0, 0.1608, 8.0)])
    }

    /// At -15 C a dendrite at water saturation for 15 minutes, then plates at 4.5 % over ice for 40: a dendrite with plate
    /// ends.
    pub fn dendrite_with_plates() -> Self {
        Self::known(&[(-15.0, 0.1608, 15.0), (-15.0, 0.045, 40.0)])
    }

    fn known(spells: &[(f64, f64, f64)]) -> Self {
        Self::spells(spells).expect("its numbers are in range")
    }

    /// How long the crystal grows, minutes.
    pub fn minutes(&self) -> f64 {
        self.minutes
    }

    /// What its supersaturation is over.
    pub fn over(&self) -> Over {
        self.over
    }

    /// Temperature, C, and supersaturation over ice, as a share, at a minute.
    pub fn at(&self, minute: f64) -> (f64, f64) {
        let next = self.weather.partition_point(|now| now.minute <= minute);
        let (temperature, supersaturation) = match (next.checked_sub(1), self.weather.get(next)) {
            (Some(k), Some(b)) => {
                let a = self.weather[k];
                let part = (minute - a.minute) / (b.minute - a.minute);
                (
                    a.temperature + part * (b.temperature - a.temperature),
                    a.supersaturation + part * (b.supersaturation - a.supersaturation),
                )
            }
            (k, _) => {
                let now = self.weather[k.unwrap_or(0)];
                (now.temperature, now.supersaturation)
            }
        };
        (temperature, to_ice(supersaturation, self.over, temperature))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weather_is_linear_between_entries_and_may_jump() {
        let entry = |minute, temperature| Weather { minute, temperature, supersaturation: 0.1 };
        let weather = vec![entry(2.0, -5.0), entry(4.0, -9.0), entry(4.0, -20.0)];
        let history = History::new(weather, Over::Ice, 10.0).unwrap();
        for (minute, temperature) in [(0.0, -5.0), (2.0, -5.0), (3.0, -7.0), (4.0, -20.0), (9.0, -20.0)] {
            assert_eq!(history.at(minute).0, temperature, "{minute}");
        }
    }

    #[test]
    fn what_is_no_history_is_refused_in_one_line() {
        let entry = |minute, temperature| Weather { minute, temperature, supersaturation: 0.1 };
        for weather in [
            vec![],
            vec![entry(2.0, -5.0), entry(1.0, -5.0)],
            vec![entry(0.0, 5.0)],
            vec![entry(f64::NAN, -5.0)],
        ] {
            let error = History::new(weather, Over::Ice, 10.0).unwrap_err().to_string();
            assert_eq!(error.lines().count(), 1);
        }
        assert!(History::constant(-15.0, 0.1, Over::Ice, 1e9).is_err());
    }
}
