//! `--reading` of commands that have one quantity to read.

use snowglobe::lab::{Error, Result};
use snowglobe::reading::Reading;

/// The last of the readings asked for, each `quantity=variant` or the variant alone; `default` where none is.
pub fn reading<R: Reading>(asked: &[String], default: R) -> Result<R> {
    let mut reading = default;
    for asked in asked {
        let (quantity, name) = asked.split_once('=').unwrap_or((R::QUANTITY, asked));
        reading = R::named(name).filter(|_| quantity == R::QUANTITY).ok_or_else(|| {
            let accepted = R::names().replace(", ", "|");
            let what = format!("`{asked}` is no reading; accepted: {}={accepted}", R::QUANTITY);
            Error::usage(what).at("--reading")
        })?;
    }
    Ok(reading)
}
