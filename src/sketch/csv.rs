//! Lists of lattice points.

use super::{MOST_CELLS, SketchError, one_line, quoted};
use crate::hexgrid::{Axial, Region};

/// The most rows of a list of cells.
pub const MOST_ROWS: usize = 16_000_000;

/// Reads a region from CSV text with the columns `q` and `r` (axial coordinates, whole numbers).
///
/// The first line names the columns; others may stand among them, in any order, and are ignored. A byte order mark and
/// blank lines are tolerated, and a cell named twice counts once.
///
/// # Errors
/// A missing header, a field that is no whole number, more than [`MOST_ROWS`] rows, no row at all, or a region that is
/// too large: [`SketchError`] names line and column.
pub fn read_cells(bytes: &[u8]) -> Result<Region, SketchError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut reader = ::csv::ReaderBuilder::new().flexible(true).trim(::csv::Trim::All).from_reader(bytes);
    let header = reader.byte_headers().map_err(|e| SketchError::Header { found: one_line(e) })?;
    let column = |name: &str| header.iter().position(|field| field == name.as_bytes());
    let (Some(q), Some(r)) = (column("q"), column("r")) else {
        let line = String::from_utf8_lossy(&bytes[..bytes.len().min(400)]);
        return Err(SketchError::Header { found: quoted(line.lines().next().unwrap_or_default()) });
    };
    let mut cells = Vec::new();
    let mut record = ::csv::ByteRecord::new();
    loop {
        let more = reader.read_byte_record(&mut record);
        let line = record.position().map_or(0, ::csv::Position::line);
        let broken = |e| SketchError::Coordinate { line, column: "q", found: one_line(e) };
        if !more.map_err(broken)? {
            break;
        }
        if cells.len() == MOST_ROWS {
            return Err(SketchError::TooManyRows);
        }
        let coordinate = |at: usize, column: &'static str| {
            let field = record.get(at).unwrap_or_default();
            std::str::from_utf8(field)
                .ok()
                .and_then(|text| text.parse::<i32>().ok())
                .filter(|value| value.unsigned_abs() <= Region::FURTHEST as u32)
                .ok_or_else(|| SketchError::Coordinate {
                    line,
                    column,
                    found: quoted(&String::from_utf8_lossy(&field[..field.len().min(400)])),
                })
        };
        cells.push(Axial::new(coordinate(q, "q")?, coordinate(r, "r")?));
    }
    cells.sort_unstable();
    cells.dedup();
    if cells.len() > MOST_CELLS {
        return Err(SketchError::TooManyCells { cells: cells.len() });
    }
    Ok(Region::new(cells)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hexgrid::RegionError;

    #[test]
    fn columns_stand_anywhere_and_a_cell_counts_once() {
        let text = "\u{feff}name, r ,q\r\nstart,0,0\n\"a,b\",0,1\n\nx,0,1\n";
        let region = read_cells(text.as_bytes()).unwrap();
        assert_eq!(region.cells(), [Axial::new(0, 0), Axial::new(1, 0)]);
    }

    #[test]
    fn each_fault_is_named_on_one_line() {
        for (text, part) in [
            ("", "columns `q` and `r`"),
            ("1,2\n", "found \"1,2\""),
            ("q,r\n1,2\n3,2.5\n", "line 3, column `r`"),
            ("q,r\n1\n", "found \"\""),
            ("q,r\n1,268435457\n", "from -268435456 to 268435456"),
            ("q,r\n9\n9,1", "line 2"),
            ("q,r\n\"9\n\",\"x\ny\"\n", "found \"x\\ny\""),
            ("q,r\n0,0\n99999,99999\n", "spans 100000 x 100000"),
        ] {
            let message = read_cells(text.as_bytes()).unwrap_err().to_string();
            assert!(message.contains(part) && !message.contains('\n'), "{message}");
        }
        assert_eq!(read_cells(b"q,r\n"), Err(SketchError::Region(RegionError::Empty)));
    }
}
