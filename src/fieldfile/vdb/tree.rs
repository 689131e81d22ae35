//! The tree of a grid: a root, nodes of 32^3 and of 16^3 children, leaves of 8^3 voxels.
//!
//! Places within a node are numbered z fastest. A mask is a bit for each place, the lowest bit of a byte first.

use super::super::Field;

/// Of the nodes under the root, from above: binary logarithms of the children along an axis and of a child's voxels.
const LEVELS: [(usize, usize); 2] = [(5, 7), (4, 3)];
/// Voxels along a child of the root.
const SPAN: usize = 1 << 12;
/// Voxels along a leaf.
const LEAF: usize = 8;
/// In front of the values of a node: those that are not active are not stored, and are the background.
const ACTIVE_ONLY: u8 = 0;

/// The two parts in which a tree is stored, and what it holds.
pub struct Tree<'a> {
    field: &'a Field<'a>,
    /// Which nodes there are, and which voxels of leaves are active.
    pub topology: Vec<u8>,
    /// For each leaf, in the same order, its mask once more and its active values.
    pub blocks: Vec<u8>,
    /// How many voxels are active.
    pub active: i64,
    /// The lowest coordinates of active voxels; the largest number, if there are none.
    pub lowest: [i32; 3],
    /// The highest ones; the smallest number, if there are none.
    pub highest: [i32; 3],
}

impl<'a> Tree<'a> {
    pub fn new(field: &'a Field<'a>) -> Self {
        let (lowest, highest) = ([i32::MAX; 3], [i32::MIN; 3]);
        let (topology, blocks) = (Vec::new(), Vec::new());
        let mut tree = Self { field, topology, blocks, active: 0, lowest, highest };
        // One buffer in each leaf, the background, no tiles; then the number of children.
        tree.topology.extend(1_u32.to_le_bytes());
        tree.topology.extend(0_f32.to_le_bytes());
        tree.topology.extend(0_u32.to_le_bytes());
        let place = tree.topology.len();
        tree.topology.extend(0_u32.to_le_bytes());
        let mut children = 0_u32;
        for [x, y, z] in places(field.counts.map(|count| count.div_ceil(SPAN))) {
            let corner = [x, y, z].map(|along| along * SPAN);
            let start = tree.topology.len();
            corner.iter().for_each(|along| tree.topology.extend((*along as i32).to_le_bytes()));
            if tree.node(0, corner) {
                children += 1;
            } else {
                tree.topology.truncate(start);
            }
        }
        tree.topology[place..place + 4].copy_from_slice(&children.to_le_bytes());
        tree
    }

    /// Adds the node with this lowest corner and all below it, if a voxel is active; whether one is.
    fn node(&mut self, level: usize, corner: [usize; 3]) -> bool {
        let Some((sides, span)) = LEVELS.get(level) else { return self.leaf(corner) };
        // Children, then tiles, of which there are none.
        let start = self.topology.len();
        let mask = (1 << (3 * sides)) / 8;
        self.topology.resize(start + 2 * mask, 0);
        self.topology.push(ACTIVE_ONLY);
        let mut any = false;
        for [x, y, z] in places(self.within(corner, 1 << sides, 1 << span)) {
            let below = [corner[0] + (x << span), corner[1] + (y << span), corner[2] + (z << span)];
            if self.node(level + 1, below) {
                let place = (x << (2 * sides)) | (y << sides) | z;
                self.topology[start + place / 8] |= 1 << (place % 8);
                any = true;
            }
        }
        if !any {
            self.topology.truncate(start);
        }
        any
    }

    fn leaf(&mut self, corner: [usize; 3]) -> bool {
        let [nx, ny, _] = self.field.counts;
        let [wide, high, deep] = self.within(corner, LEAF, 1);
        let mut bits = [0_u32; LEAF * LEAF * LEAF];
        for z in 0..deep {
            for y in 0..high {
                let first = corner[0] + nx * (corner[1] + y + ny * (corner[2] + z));
                for (x, value) in self.field.values[first..first + wide].iter().enumerate() {
                    bits[(x * LEAF + y) * LEAF + z] = value.to_bits();
                }
            }
        }
        let mut mask = [0_u8; LEAF * LEAF];
        for (byte, along_z) in mask.iter_mut().zip(bits.chunks(LEAF)) {
            *byte = (0..LEAF).map(|z| u8::from(along_z[z] != 0) << z).sum();
        }
        if mask == [0; LEAF * LEAF] {
            return false;
        }
        for (row, byte) in mask.iter().enumerate().filter(|(_, byte)| **byte != 0) {
            let ends = [byte.trailing_zeros(), 7 - byte.leading_zeros()];
            for z in ends {
                let at = [corner[0] + row / LEAF, corner[1] + row % LEAF, corner[2] + z as usize];
                for (axis, along) in at.into_iter().enumerate() {
                    self.lowest[axis] = self.lowest[axis].min(along as i32);
                    self.highest[axis] = self.highest[axis].max(along as i32);
                }
            }
            self.active += i64::from(byte.count_ones());
        }
        self.topology.extend(mask);
        self.blocks.extend(mask);
        self.blocks.push(ACTIVE_ONLY);
        bits.iter().filter(|value| **value != 0).for_each(|value| self.blocks.extend(value.to_le_bytes()));
        true
    }

    /// How many of `most` children along each axis, `span` voxels wide, begin within the lattice.
    fn within(&self, corner: [usize; 3], most: usize, span: usize) -> [usize; 3] {
        std::array::from_fn(|axis| (self.field.counts[axis] - corner[axis]).div_ceil(span).min(most))
    }
}

/// All places of a box, z fastest.
fn places([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..nx).flat_map(move |x| (0..ny).flat_map(move |y| (0..nz).map(move |z| [x, y, z])))
}
