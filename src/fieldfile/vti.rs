//! VTK image data, `.vti`: XML with the numbers appended as they are, little-endian.

use super::{Field, FieldError};

/// A field as a VTI file: cell data, lengths in metres.
pub fn vti(field: &Field<'_>) -> Result<Vec<u8>, FieldError> {
    field.check()?;
    let [x, y, z] = field.counts;
    let extent = format!("0 {x} 0 {y} 0 {z}");
    let [left, low, near] = field.origin;
    let (size, name) = (field.size, escaped(field.name));
    // `{:?}` gives the fewest digits that read back as the same number.
    let header = format!(
        r#"<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <ImageData WholeExtent="{extent}" Origin="{left:?} {low:?} {near:?}" Spacing="{size:?} {size:?} {size:?}">
    <Piece Extent="{extent}">
      <CellData Scalars="{name}">
        <DataArray type="Float32" Name="{name}" format="appended" offset="0"/>
      </CellData>
    </Piece>
  </ImageData>
  <AppendedData encoding="raw">
   _"#
    );
    let length = 4 * field.values.len();
    let mut bytes = header.into_bytes();
    bytes.reserve(length + 64);
    bytes.extend((length as u64).to_le_bytes());
    field.values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend(b"\n  </AppendedData>\n</VTKFile>\n");
    Ok(bytes)
}

/// Text within the quotes of an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_is_the_format_s_to_the_byte() {
        let values = [1.0, -0.0, f32::MIN_POSITIVE, f32::NAN, 1e-45, 3.5];
        let field = Field {
            name: r#"a<b & "c""#,
            counts: [3, 2, 1],
            size: 0.1,
            origin: [-1.0, 1e-7, 1.0 / 3.0],
            values: &values,
        };
        let bytes = vti(&field).unwrap();
        let start = bytes.windows(2).position(|pair| pair == b" _").unwrap() + 2;
        let expected = r#"<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <ImageData WholeExtent="0 3 0 2 0 1" Origin="-1.0 1e-7 0.3333333333333333" Spacing="0.1 0.1 0.1">
    <Piece Extent="0 3 0 2 0 1">
      <CellData Scalars="a&lt;b &amp; &quot;c&quot;">
        <DataArray type="Float32" Name="a&lt;b &amp; &quot;c&quot;" format="appended" offset="0"/>
      </CellData>
    </Piece>
  </ImageData>
  <AppendedData encoding="raw">
   _"#;
        assert_eq!(std::str::from_utf8(&bytes[..start]).unwrap(), expected);
        assert_eq!(bytes[start..start + 8], 24_u64.to_le_bytes());
        let body: Vec<u32> = bytes[start + 8..start + 32]
            .chunks(4)
            .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
            .collect();
        assert_eq!(body, values.map(f32::to_bits));
        assert_eq!(&bytes[start + 32..], b"\n  </AppendedData>\n</VTKFile>\n");
    }
}
