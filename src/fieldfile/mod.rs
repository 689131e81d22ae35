//! Scalar fields on a regular lattice, and the files that other programs open: VTK image data and OpenVDB.
//!
//! A value belongs to a cell, a cube, and stands for its centre: cell (0, 0, 0) has its lowest corner in the origin.
//! Axes are kept as they are. Both files hold the values to the last bit, whatever they are.

mod vdb;
mod vti;

pub use vdb::vdb;
pub use vti::vti;

/// A scalar field on a lattice of cubic cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field<'a> {
    /// What is stored: the name by which other programs list it.
    pub name: &'a str,
    /// Cells along x, y and z.
    pub counts: [usize; 3],
    /// Edge of a cell, m.
    pub size: f64,
    /// Lowest corner of cell (0, 0, 0), m.
    pub origin: [f64; 3],
    /// A value for each cell, x fastest, then y.
    pub values: &'a [f32],
}

/// Most cells along an axis: coordinates in a file are signed numbers of 32 bits.
const MOST: usize = i32::MAX as usize;

/// Why a field cannot be written; every message is one line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// The name cannot be kept in a file.
    #[error("the field's name is {0:?}; one without control characters, not empty, is accepted")]
    Name(String),
    /// The lattice has no cells, or too many along an axis.
    #[error("a lattice of {} x {} x {} cells; from 1 to {MOST} along each axis are accepted", .0[0], .0[1], .0[2])]
    Counts([usize; 3]),
    /// There is not one value for each cell.
    #[error(
        "a lattice of {} x {} x {} cells with {found} values; one for each cell is accepted",
        .counts[0], .counts[1], .counts[2]
    )]
    Length {
        /// Cells along each axis.
        counts: [usize; 3],
        /// How many values there are.
        found: usize,
    },
    /// A length that cannot be used.
    #[error("{what} is {value} m; {accepted} is accepted")]
    OutOfRange {
        /// Which length.
        what: &'static str,
        /// Its value, m.
        value: f64,
        /// What would be.
        accepted: &'static str,
    },
}

impl Field<'_> {
    fn check(&self) -> Result<(), FieldError> {
        if self.name.is_empty() || self.name.contains(char::is_control) {
            return Err(FieldError::Name(self.name.to_owned()));
        }
        if self.counts.iter().any(|count| !(1..=MOST).contains(count)) {
            return Err(FieldError::Counts(self.counts));
        }
        let cells = self.counts.iter().fold(1_usize, |product, count| product.saturating_mul(*count));
        if cells != self.values.len() {
            return Err(FieldError::Length { counts: self.counts, found: self.values.len() });
        }
        // OpenVDB takes a transform with a determinant below 3e-15 for singular and does not open it.
        if !(2e-5..=1e9).contains(&self.size) {
            let accepted = "a length from 2e-5 to 1e9";
            return Err(FieldError::OutOfRange { what: "the edge of a cell", value: self.size, accepted });
        }
        match self.origin.iter().find(|along| !along.is_finite()) {
            Some(&value) => {
                let accepted = "a finite number";
                Err(FieldError::OutOfRange { what: "a coordinate of the origin", value, accepted })
            }
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: Field<'_> =
        Field { name: "density", counts: [2, 1, 3], size: 0.5, origin: [0.0; 3], values: &[0.0; 6] };

    #[test]
    fn a_field_that_no_file_can_hold_is_refused_in_one_line() {
        assert!(vti(&GOOD).is_ok() && vdb(&GOOD).is_ok());
        for (field, message) in [
            (
                Field { values: &[0.0; 5], ..GOOD },
                "a lattice of 2 x 1 x 3 cells with 5 values; one for each cell is accepted",
            ),
            (
                Field { counts: [2, 0, 3], values: &[], ..GOOD },
                "a lattice of 2 x 0 x 3 cells; from 1 to 2147483647 along each axis are accepted",
            ),
            (
                Field { counts: [MOST; 3], ..GOOD },
                "a lattice of 2147483647 x 2147483647 x 2147483647 cells with 6 values; one for each cell is accepted",
            ),
            (
                Field { name: "a\nb", ..GOOD },
                r#"the field's name is "a\nb"; one without control characters, not empty, is accepted"#,
            ),
            (
                Field { name: "", ..GOOD },
                r#"the field's name is ""; one without control characters, not empty, is accepted"#,
            ),
            (
                Field { size: 1e-5, ..GOOD },
                "the edge of a cell is 0.00001 m; a length from 2e-5 to 1e9 is accepted",
            ),
            (
                Field { size: f64::NAN, ..GOOD },
                "the edge of a cell is NaN m; a length from 2e-5 to 1e9 is accepted",
            ),
            (
                Field { origin: [0.0, f64::INFINITY, 0.0], ..GOOD },
                "a coordinate of the origin is inf m; a finite number is accepted",
            ),
        ] {
            for answer in [vti(&field), vdb(&field)] {
                assert_eq!(answer.unwrap_err().to_string(), message);
            }
        }
    }
}
