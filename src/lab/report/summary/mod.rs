//! What the results say together: all readings against all claims, marks of figures and tables, how near each verdict is
//! to flipping, and where everything that the papers print is to be found. Written as CSV below `summary/`.

mod coverage;
mod marks;
mod matrix;
mod sensitivity;

use std::path::Path;

pub use coverage::{Entry, Index, read_indices};

use super::Shelf;
use crate::lab::error::Result;
use crate::lab::folder::write_whole;
use crate::lab::suite::Suite;
use crate::lab::table::Table;

/// The folder below the results.
pub(in crate::lab) const FOLDER: &str = "summary";

/// Writes the tables; `paper` is the folder of the write-up, which has the index of what the papers print.
pub(super) fn write(suite: &Suite, shelves: &[Shelf], results: &Path, paper: &Path) -> Result<()> {
    let indices = read_indices(suite, &paper.join("coverage"))?;
    let power = Table::from_csv(&std::fs::read(results.join("power/mutations.csv")).unwrap_or_default());
    let power = power.unwrap_or_default();
    let tables = [
        ("matrix", matrix::all(shelves)),
        ("readings", matrix::readings(suite, shelves)),
        ("unmet", matrix::unmet(shelves)),
        ("sensitivity", sensitivity::table(shelves, &power)),
        ("coverage", coverage::table(&indices)),
        ("marks", marks::table(shelves, &indices, &power)),
    ];
    for (name, table) in tables {
        let path = results.join(FOLDER).join(format!("{name}.csv"));
        let bytes = table.to_csv()?;
        if std::fs::read(&path).ok().as_ref() != Some(&bytes) {
            write_whole(&path, &bytes)?;
        }
    }
    Ok(())
}
