//! Tables: what a run measured, as CSV.

use std::fmt::Display;

use super::error::{Error, Result};

/// A table with a header, written as CSV.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Column names, with units where they have them.
    pub columns: Vec<String>,
    /// The rows, as text.
    pub rows: Vec<Vec<String>>,
}

/// A cell of a table: a number to its last digit, a word, or nothing.
pub struct Cell(pub String);

impl<T: Display> From<T> for Cell {
    fn from(value: T) -> Self {
        Cell(value.to_string())
    }
}

/// A cell that may be empty.
pub fn maybe<T: Display>(value: Option<T>) -> Cell {
    Cell(value.map_or_else(String::new, |value| value.to_string()))
}

impl Table {
    /// An empty table with these columns.
    pub fn new<const N: usize>(columns: [&str; N]) -> Self {
        Self { columns: columns.map(String::from).to_vec(), rows: Vec::new() }
    }

    /// Adds a row; it has as many cells as there are columns.
    pub fn row<const N: usize>(&mut self, cells: [Cell; N]) {
        assert_eq!(N, self.columns.len(), "a row of {:?}", self.columns);
        self.rows.push(cells.map(|cell| cell.0).to_vec());
    }

    /// The same table with some of its rows only.
    pub fn only(&self, keep: impl Fn(&[String]) -> bool) -> Self {
        let rows = self.rows.iter().filter(|row| keep(row)).cloned().collect();
        Self { columns: self.columns.clone(), rows }
    }

    /// The table as CSV.
    pub fn to_csv(&self) -> Result<Vec<u8>> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let broken = |cause: csv::Error| Error::broken("cannot write a table").because(cause);
        writer.write_record(&self.columns).map_err(broken)?;
        for row in &self.rows {
            writer.write_record(row).map_err(broken)?;
        }
        writer.into_inner().map_err(|cause| Error::broken("cannot write a table").because(cause.to_string()))
    }

    /// Reads a table from CSV.
    pub fn from_csv(bytes: &[u8]) -> Result<Self> {
        let broken = |cause: csv::Error| Error::broken("not a table").because(cause);
        let mut reader = csv::Reader::from_reader(bytes);
        let columns = reader.headers().map_err(broken)?.iter().map(String::from).collect();
        let rows = reader
            .records()
            .map(|record| Ok(record.map_err(broken)?.iter().map(String::from).collect()))
            .collect::<Result<_>>()?;
        Ok(Self { columns, rows })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_to_the_last_digit() {
        let mut table = Table::new(["beta", "end_frame", "note"]);
        table.row([0.1f64.sqrt().into(), maybe::<u64>(None), "a, \"b\"".into()]);
        let back = Table::from_csv(&table.to_csv().unwrap()).unwrap();
        assert_eq!(back, table);
        assert_eq!(back.rows[0][0].parse::<f64>().unwrap(), 0.1f64.sqrt());
    }
}
