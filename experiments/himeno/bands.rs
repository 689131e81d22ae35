//! Which habit is observed in which air: bands of temperature, as the literature has them.

use snowglobe::lab::{Error, Result};
use snowglobe::snow::Habit;

/// The table of the literature; its rows say how many sources agree.
const TABLE: &str = include_str!("../data/snow/habit_bands.csv");

/// A band of temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    pub scheme: String,
    /// From the warmer end to the colder one, C.
    pub warm: f64,
    pub cold: f64,
    /// Whether plates grow there, or columns.
    pub platelike: bool,
    /// The habits where it is humid and where it is dry, in the words of the source.
    pub humid: String,
    pub dry: String,
    /// Whether two sources agree: others may be drawn and never judge.
    pub confirmed: bool,
}

pub fn bands() -> Result<Vec<Band>> {
    let broken = || Error::broken("the table of bands is not what it was");
    let mut reader = csv::Reader::from_reader(TABLE.as_bytes());
    let mut found = Vec::new();
    for row in reader.records() {
        let row = row.map_err(|cause| broken().because(cause))?;
        let number = |k: usize| row.get(k).and_then(|text| text.parse().ok()).ok_or_else(broken);
        let text = |k: usize| row.get(k).map(str::to_owned).ok_or_else(broken);
        found.push(Band {
            scheme: text(0)?,
            warm: number(1)?,
            cold: number(2)?,
            platelike: text(3)? == "plate",
            humid: text(4)?,
            dry: text(5)?,
            confirmed: text(7)? == "2src",
        });
    }
    Ok(found)
}

impl Band {
    pub fn holds(&self, temperature: f64) -> bool {
        temperature <= self.warm && temperature > self.cold
    }

    /// The habit of the classic scheme, among the six that are told apart here.
    pub fn habit(&self, humid: bool) -> Option<Habit> {
        let words = if humid { &self.humid } else { &self.dry };
        Some(match words.as_str() {
            "thin plate" | "plate" | "plate/sector" => Habit::Plate,
            "sector plate" => Habit::SectoredPlate,
            "dendrite" => Habit::Dendrite,
            "needle" => Habit::Needle,
            "hollow column" | "hollow column/sheath" => Habit::HollowColumn,
            "solid column" | "column" => Habit::SolidColumn,
            _ => return None,
        })
    }
}

/// The band of a scheme that holds a temperature.
pub fn band_at<'a>(bands: &'a [Band], scheme: &str, temperature: f64) -> Option<&'a Band> {
    bands.iter().find(|band| band.scheme == scheme && band.holds(temperature))
}
