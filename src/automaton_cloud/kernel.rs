//! The inner loop of the packed form: 64 cells a word, four words a turn.
//!
//! Slices and plain loops, inlined where they are dispatched from, as in the frost's: only so do they become AVX2.

/// Words in one turn of a kernel: a register of AVX2.
pub(super) const LANES: usize = 4;

type Words<'a> = &'a [[u64; LANES]];

/// A variable in the words of a plane and around them, slices of one length.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    here: Words<'a>,
    east: Words<'a>,
    west: Words<'a>,
    north: Words<'a>,
    south: Words<'a>,
    north_2: Words<'a>,
    south_2: Words<'a>,
    above: Words<'a>,
    below: Words<'a>,
    below_2: Words<'a>,
}

/// Where the words of a plane are within the room that it has.
#[derive(Clone, Copy)]
pub(super) struct Room {
    /// Words of a row.
    pub row: usize,
    /// Words of the plane, up to a whole number of turns.
    pub words: usize,
}

impl Room {
    /// Words of 0 before and behind a plane: two rows.
    pub fn margin(self) -> usize {
        2 * self.row
    }

    /// Words from one plane to the next.
    pub fn stride(self) -> usize {
        self.words + 2 * self.margin()
    }

    #[inline(always)]
    fn cut(self, plane: &[u64], from: usize) -> Words<'_> {
        plane[from..from + self.words].as_chunks().0
    }
}

impl<'a> Around<'a> {
    #[inline(always)]
    pub fn new(room: Room, here: &'a [u64], [above, below, below_2]: [&'a [u64]; 3]) -> Self {
        let (margin, row) = (room.margin(), room.row);
        Self {
            here: room.cut(here, margin),
            east: room.cut(here, margin + 1),
            west: room.cut(here, margin - 1),
            north: room.cut(here, margin + row),
            south: room.cut(here, margin - row),
            north_2: room.cut(here, margin + 2 * row),
            south_2: room.cut(here, margin - 2 * row),
            above: room.cut(above, margin),
            below: room.cut(below, margin),
            below_2: room.cut(below_2, margin),
        }
    }
}

/// Which bits of a plane's words are cells, and which words have a neighbour in their row.
pub(super) struct Masks {
    pub valid: Vec<u64>,
    pub east: Vec<u64>,
    pub west: Vec<u64>,
}

/// The variables of a plane at t, which become those at t + 1, and those that go out.
pub(super) struct Plane<'a> {
    pub hum: &'a mut [u64],
    pub cld: &'a mut [u64],
    pub act: &'a mut [u64],
    pub ext: &'a mut [u64],
    /// Cells that are locked, and out of it those that have become cloud; empty without a lifetime.
    pub locked: Vec<u64>,
}

/// No lifetime, one of the cloud, one of all variables.
pub(super) const FREE: u8 = 0;
pub(super) const CLOUD: u8 = 1;
pub(super) const ALL: u8 = 2;

/// `gate && near || far`, or with the bracket mended `gate && (near || far)`, of the cells of one turn.
#[inline(always)]
fn spread<const MENDED: bool>(
    field: &Around,
    turn: usize,
    gate: [u64; LANES],
    east: &[u64; LANES],
    west: &[u64; LANES],
) -> [u64; LANES] {
    let mut out = [0; LANES];
    for k in 0..LANES {
        let here = field.here[turn][k];
        let right = field.east[turn][k] & east[k];
        let left = field.west[turn][k] & west[k];
        let near = (here >> 1 | right << 63) | (here << 1 | left >> 63);
        let near = near | field.north[turn][k] | field.south[turn][k];
        let near = near | field.above[turn][k] | field.below[turn][k];
        let far = (here >> 2 | right << 62) | (here << 2 | left >> 62);
        let far = far | field.north_2[turn][k] | field.south_2[turn][k] | field.below_2[turn][k];
        out[k] = if MENDED { gate[k] & (near | far) } else { gate[k] & near | far };
    }
    out
}

/// A step of a plane.
#[inline(always)]
pub(super) fn advance<const NEGATED: bool, const MENDED: bool, const LOCK: u8>(
    masks: &Masks,
    act: &Around,
    ext: &Around,
    plane: &mut Plane,
    margin: usize,
) {
    let words = act.here.len() * LANES;
    let (hum, cld) = (&mut plane.hum[margin..margin + words], &mut plane.cld[margin..margin + words]);
    let (hum, cld) = (hum.as_chunks_mut::<LANES>().0, cld.as_chunks_mut::<LANES>().0);
    let (next_act, next_ext) =
        (&mut plane.act[margin..margin + words], &mut plane.ext[margin..margin + words]);
    let (next_act, next_ext) = (next_act.as_chunks_mut::<LANES>().0, next_ext.as_chunks_mut::<LANES>().0);
    let locked = plane.locked.as_chunks_mut::<LANES>().0;
    let valid = masks.valid.as_chunks::<LANES>().0;
    let (east, west) = (masks.east.as_chunks::<LANES>().0, masks.west.as_chunks::<LANES>().0);
    for turn in 0..act.here.len() {
        let (a, e, h, c) = (act.here[turn], ext.here[turn], hum[turn], cld[turn]);
        let (mut gate_act, mut gate_ext) = ([0; LANES], [0; LANES]);
        for k in 0..LANES {
            gate_act[k] = h[k] & if NEGATED { !a[k] } else { a[k] };
            gate_ext[k] = c[k] & !e[k];
        }
        let mut to_act = spread::<MENDED>(act, turn, gate_act, &east[turn], &west[turn]);
        let mut to_ext = spread::<MENDED>(ext, turn, gate_ext, &east[turn], &west[turn]);
        let (mut to_hum, mut to_cld) = ([0; LANES], [0; LANES]);
        for k in 0..LANES {
            to_act[k] &= valid[turn][k];
            to_ext[k] &= valid[turn][k];
            to_hum[k] = h[k] & !a[k];
            to_cld[k] = !e[k] & (c[k] | a[k]);
        }
        if LOCK != FREE {
            for k in 0..LANES {
                let kept = locked[turn][k];
                to_cld[k] |= kept;
                locked[turn][k] = to_cld[k] & !c[k];
                if LOCK == ALL {
                    to_act[k] = to_act[k] & !kept | a[k] & kept;
                    to_ext[k] = to_ext[k] & !kept | e[k] & kept;
                    to_hum[k] = to_hum[k] & !kept | h[k] & kept;
                }
            }
        }
        (hum[turn], cld[turn]) = (to_hum, to_cld);
        (next_act[turn], next_ext[turn]) = (to_act, to_ext);
    }
}
