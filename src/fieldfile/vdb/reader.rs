//! Reads what this module writes, and nothing more; for the tests.

/// What a file holds.
#[derive(Debug, Default)]
pub struct Volume {
    /// Active voxels and the bits of their values, in the order of the file.
    pub voxels: Vec<([i32; 3], u32)>,
    /// How many there are, as the metadata say.
    pub count: i64,
    /// Their bounding box, as the metadata say.
    pub lowest: [i32; 3],
    /// Its other corner.
    pub highest: [i32; 3],
    /// Nodes of 32^3, of 16^3, leaves.
    pub nodes: [usize; 3],
}

struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    fn take(&mut self, count: usize) -> &'a [u8] {
        self.at += count;
        &self.bytes[self.at - count..self.at]
    }

    fn word(&mut self) -> u32 {
        u32::from_le_bytes(self.take(4).try_into().unwrap())
    }

    fn long(&mut self) -> usize {
        u64::from_le_bytes(self.take(8).try_into().unwrap()) as usize
    }

    fn text(&mut self) -> &'a str {
        let length = self.word() as usize;
        std::str::from_utf8(self.take(length)).unwrap()
    }

    fn triple(&mut self) -> [i32; 3] {
        [0; 3].map(|_| self.word() as i32)
    }
}

fn set(mask: &[u8]) -> Vec<usize> {
    (0..8 * mask.len()).filter(|place| mask[place / 8] >> (place % 8) & 1 == 1).collect()
}

/// The place with this number in a node of so many sides, as a binary logarithm, moved and stretched.
fn corner(from: [i32; 3], place: usize, sides: usize, span: i32) -> [i32; 3] {
    let mask = (1 << sides) - 1;
    let within = [place >> (2 * sides), place >> sides & mask, place & mask];
    std::array::from_fn(|axis| from[axis] + span * within[axis] as i32)
}

/// The volume of a file; panics where it is not as this module writes it.
pub fn read(bytes: &[u8]) -> Volume {
    let mut cursor = Cursor { bytes, at: 57 };
    let mut volume = Volume::default();
    assert_eq!((cursor.word(), cursor.word()), (0, 1));
    let name = cursor.text();
    assert_eq!((cursor.text(), cursor.text()), ("Tree_float_5_4_3", ""));
    let positions = [0; 3].map(|_| cursor.long());
    assert_eq!((positions[0], positions[2]), (cursor.at, bytes.len()));
    assert_eq!(cursor.word(), 2);
    for _ in 0..cursor.word() {
        let (entry, kind, length) = (cursor.text(), cursor.text(), cursor.word());
        let end = cursor.at + length as usize;
        match (entry, kind) {
            ("file_bbox_min", "vec3i") => volume.lowest = cursor.triple(),
            ("file_bbox_max", "vec3i") => volume.highest = cursor.triple(),
            ("file_voxel_count", "int64") => volume.count = cursor.long() as i64,
            ("name", "string") => assert_eq!(cursor.take(length as usize), name.as_bytes()),
            (_, kind) => assert_eq!((kind, cursor.take(length as usize).is_empty()), ("string", false)),
        }
        assert_eq!(cursor.at, end);
    }
    assert_eq!(cursor.text(), "UniformScaleTranslateMap");
    cursor.take(6 * 24);
    assert_eq!((cursor.word(), cursor.word(), cursor.word()), (1, 0, 0));
    let mut leaves = Vec::new();
    let mut last = None;
    for _ in 0..cursor.word() {
        let root = cursor.triple();
        assert!(last < Some(root), "the root's children are in order");
        last = Some(root);
        volume.nodes[0] += 1;
        for upper in node(&mut cursor, 5) {
            volume.nodes[1] += 1;
            let middle = corner(root, upper, 5, 128);
            for lower in node(&mut cursor, 4) {
                leaves.push((corner(middle, lower, 4, 8), cursor.take(64)));
            }
        }
    }
    assert_eq!(cursor.at, positions[1]);
    volume.nodes[2] = leaves.len();
    for (from, mask) in leaves {
        assert_eq!((cursor.take(64), cursor.take(1)), (mask, &[0][..]));
        for place in set(mask) {
            volume.voxels.push((corner(from, place, 3, 1), cursor.word()));
        }
    }
    assert_eq!(cursor.at, bytes.len());
    volume
}

/// The children of a node, which must not have tiles.
fn node(cursor: &mut Cursor<'_>, sides: usize) -> Vec<usize> {
    let length = (1 << (3 * sides)) / 8;
    let children = set(cursor.take(length));
    assert!(set(cursor.take(length)).is_empty() && !children.is_empty());
    assert_eq!(cursor.take(1), [0]);
    children
}
