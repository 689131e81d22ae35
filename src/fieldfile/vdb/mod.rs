//! OpenVDB, `.vdb`: one grid of floats, a fog volume, of which only the cells that are not zero are stored.
//!
//! File format 224, which every OpenVDB since 4.0 reads. The bytes of an OpenVDB 10, but for what would change from run
//! to run or with the library's memory: the identifier comes from the content, and `file_mem_bytes` and
//! `file_delayed_load` are left out, as the format allows.

#[cfg(test)]
mod reader;
mod tree;

use super::{Field, FieldError};
use tree::Tree;

/// " BDV", the file format, the library whose bytes these are, and that positions are stored.
const HEAD: &[u8; 21] = b" BDV\0\0\0\0\xe0\0\0\0\x0a\0\0\0\0\0\0\0\x01";
/// Length of an identifier as text.
const IDENTIFIER: usize = 36;
/// Flag of a grid whose nodes store active values only, and no other compression.
const ACTIVE_VALUES: u32 = 2;

/// A field as a VDB file, a voxel for each cell: in index coordinates the centre of cell (0, 0, 0) is (0, 0, 0), in the
/// world it is half a cell from the origin, m. A cell is active unless all of its bits are zero; the background is 0.
pub fn vdb(field: &Field<'_>) -> Result<Vec<u8>, FieldError> {
    field.check()?;
    let tree = Tree::new(field);
    let mut body = Vec::with_capacity(1024 + tree.topology.len() + tree.blocks.len());
    // No metadata of the file, one grid.
    body.extend(0_u32.to_le_bytes());
    body.extend(1_u32.to_le_bytes());
    text(&mut body, field.name);
    text(&mut body, "Tree_float_5_4_3");
    text(&mut body, "");
    let positions = body.len();
    body.resize(positions + 24, 0);
    let grid = body.len();
    body.extend(ACTIVE_VALUES.to_le_bytes());
    metadata(&mut body, field, &tree);
    transform(&mut body, field);
    body.extend(&tree.topology);
    let blocks = body.len();
    body.extend(&tree.blocks);
    for (k, at) in [grid, blocks, body.len()].into_iter().enumerate() {
        let position = (HEAD.len() + IDENTIFIER + at) as u64;
        body[positions + 8 * k..][..8].copy_from_slice(&position.to_le_bytes());
    }
    let mut file = Vec::with_capacity(HEAD.len() + IDENTIFIER + body.len());
    file.extend(HEAD);
    file.extend(identifier(&body).bytes());
    file.extend(body);
    Ok(file)
}

fn text(bytes: &mut Vec<u8>, text: &str) {
    bytes.extend((text.len() as u32).to_le_bytes());
    bytes.extend(text.bytes());
}

/// What is known of the grid, in the order of the names.
fn metadata(bytes: &mut Vec<u8>, field: &Field<'_>, tree: &Tree<'_>) {
    let corner = |at: [i32; 3]| at.map(i32::to_le_bytes).as_flattened().to_vec();
    let entries: [(&str, &str, Vec<u8>); 6] = [
        ("class", "string", b"fog volume".to_vec()),
        ("file_bbox_max", "vec3i", corner(tree.highest)),
        ("file_bbox_min", "vec3i", corner(tree.lowest)),
        ("file_compression", "string", b"active values".to_vec()),
        ("file_voxel_count", "int64", tree.active.to_le_bytes().to_vec()),
        ("name", "string", field.name.as_bytes().to_vec()),
    ];
    bytes.extend((entries.len() as u32).to_le_bytes());
    for (name, kind, value) in entries {
        text(bytes, name);
        text(bytes, kind);
        bytes.extend((value.len() as u32).to_le_bytes());
        bytes.extend(value);
    }
}

/// From index coordinates, whole numbers in the centres of cells, to the world.
fn transform(bytes: &mut Vec<u8>, field: &Field<'_>) {
    text(bytes, "UniformScaleTranslateMap");
    let (size, inverse) = (field.size, 1.0 / field.size);
    let translation = field.origin.map(|along| along + 0.5 * size);
    // The scale, the size of a voxel, and three numbers that OpenVDB derives and stores.
    for triple in
        [translation, [size; 3], [size; 3], [inverse; 3], [inverse * inverse; 3], [0.5 * inverse; 3]]
    {
        triple.iter().for_each(|along| bytes.extend(along.to_le_bytes()));
    }
}

/// 128 bits of FNV-1a over everything after it, as a UUID of version 8 (RFC 9562: a content of one's own).
fn identifier(body: &[u8]) -> String {
    let hash = fnv1a(body);
    let marked = hash & !(0xf << 76) & !(0x3 << 62) | 0x8 << 76 | 0x2 << 62;
    let digits = format!("{marked:032x}");
    [&digits[..8], &digits[8..12], &digits[12..16], &digits[16..20], &digits[20..]].join("-")
}

fn fnv1a(bytes: &[u8]) -> u128 {
    bytes.iter().fold(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d, |hash: u128, byte| {
        (hash ^ u128::from(*byte)).wrapping_mul(0x0100_0000_0000_0000_0000_013b)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use reader::{Volume, read};

    /// A field whose values are not zero where `keep` says, and the bits of all of its values.
    fn sample(counts: [usize; 3], keep: impl Fn([usize; 3]) -> bool) -> Vec<f32> {
        let [nx, ny, nz] = counts;
        let mut values = Vec::new();
        for place in 0..nx * ny * nz {
            let at = [place % nx, place / nx % ny, place / nx / ny];
            values.push(if keep(at) { 1.0 + place as f32 } else { 0.0 });
        }
        values
    }

    fn written(counts: [usize; 3], values: &[f32]) -> (Vec<u8>, Volume) {
        let bytes =
            vdb(&Field { name: "density", counts, size: 0.25, origin: [1.0, 2.0, -3.0], values }).unwrap();
        let volume = read(&bytes);
        (bytes, volume)
    }

    #[test]
    fn what_is_read_is_what_was_written() {
        let near_a_wall = |[x, y, z]: [usize; 3]| x % 61 == 5 && y % 3 == 1 || z == 130;
        for counts in [[1, 1, 1], [8, 8, 8], [9, 7, 17], [131, 5, 140]] {
            for values in [
                sample(counts, |_| true),
                sample(counts, |_| false),
                sample(counts, near_a_wall),
                sample(counts, |at| at == counts.map(|count| count - 1)),
            ] {
                let (_, volume) = written(counts, &values);
                let [nx, ny, _] = counts;
                let expected: Vec<([i32; 3], u32)> = (0..values.len())
                    .filter(|place| values[*place].to_bits() != 0)
                    .map(|place| {
                        (
                            [place % nx, place / nx % ny, place / nx / ny].map(|at| at as i32),
                            values[place].to_bits(),
                        )
                    })
                    .collect();
                let mut found = volume.voxels.clone();
                found.sort_by_key(|([x, y, z], _)| (*z, *y, *x));
                assert!(found == expected, "{counts:?}");
                assert_eq!(volume.count, expected.len() as i64);
                for axis in 0..3 {
                    let along = || expected.iter().map(|(at, _)| at[axis]);
                    assert_eq!(volume.lowest[axis], along().min().unwrap_or(i32::MAX));
                    assert_eq!(volume.highest[axis], along().max().unwrap_or(i32::MIN));
                }
            }
        }
    }

    #[test]
    fn nodes_without_an_active_voxel_are_not_stored() {
        let counts = [4100, 9, 130];
        let mut values = vec![0.0; counts.iter().product()];
        assert_eq!(written(counts, &values).1.nodes, [0, 0, 0]);
        values[4097] = 1.0;
        assert_eq!(written(counts, &values).1.nodes, [1, 1, 1]);
        // In the other child of the root, and beside it in the same leaf; then in another node of the middle.
        values[0] = -0.0;
        values[1] = f32::NAN;
        assert_eq!(written(counts, &values).1.nodes, [2, 2, 2]);
        values[4100 * 9 * 129 + 4100 * 8 + 1] = 1e-45;
        let (bytes, volume) = written(counts, &values);
        assert_eq!((volume.nodes, volume.count), ([2, 3, 3], 4));
        assert!(bytes.len() < 30_000, "{}", bytes.len());
    }

    #[test]
    fn the_file_of_an_empty_grid_is_the_format_s_to_the_byte() {
        let (bytes, _) = written([3, 1, 1], &[0.0; 3]);
        let mut expected = b" BDV\0\0\0\0\xe0\0\0\0\x0a\0\0\0\0\0\0\0\x01".to_vec();
        expected.extend(&bytes[21..57]);
        expected.extend(b"\0\0\0\0\x01\0\0\0\x07\0\0\0density\x10\0\0\0Tree_float_5_4_3\0\0\0\0");
        expected.extend(b"\x7c\0\0\0\0\0\0\0\x2a\x02\0\0\0\0\0\0\x2a\x02\0\0\0\0\0\0\x02\0\0\0\x06\0\0\0");
        expected.extend(b"\x05\0\0\0class\x06\0\0\0string\x0a\0\0\0fog volume");
        expected.extend(b"\x0d\0\0\0file_bbox_max\x05\0\0\0vec3i\x0c\0\0\0\0\0\0\x80\0\0\0\x80\0\0\0\x80");
        expected.extend(b"\x0d\0\0\0file_bbox_min\x05\0\0\0vec3i\x0c\0\0\0");
        expected.extend(b"\xff\xff\xff\x7f\xff\xff\xff\x7f\xff\xff\xff\x7f");
        expected.extend(b"\x10\0\0\0file_compression\x06\0\0\0string\x0d\0\0\0active values");
        expected.extend(b"\x10\0\0\0file_voxel_count\x05\0\0\0int64\x08\0\0\0\0\0\0\0\0\0\0\0");
        expected.extend(b"\x04\0\0\0name\x06\0\0\0string\x07\0\0\0density\x18\0\0\0UniformScaleTranslateMap");
        for number in [1.125_f64, 2.125, -2.875]
            .into_iter()
            .chain([0.25; 6])
            .chain([4.0; 3])
            .chain([16.0; 3])
            .chain([2.0; 3])
        {
            expected.extend(number.to_le_bytes());
        }
        // One buffer in each leaf, the background, no tiles, no children.
        expected.extend(b"\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0");
        assert_eq!(bytes.escape_ascii().to_string(), expected.escape_ascii().to_string());
    }

    #[test]
    fn the_identifier_is_of_the_content() {
        assert_eq!(fnv1a(b""), 0x6c62272e07bb014262b821756295c58d);
        assert_eq!(fnv1a(b"a"), 0xd228cb696f1a8caf78912b704e4a8964);
        assert_eq!(identifier(b"a"), "d228cb69-6f1a-8caf-b891-2b704e4a8964");
        let of = |values: &[f32]| written([3, 1, 1], values).0;
        assert_eq!(of(&[0.0, 1.0, 2.0]), of(&[0.0, 1.0, 2.0]));
        assert_ne!(of(&[0.0, 1.0, 2.0])[21..57], of(&[0.0, 1.0, 3.0])[21..57]);
    }
}
