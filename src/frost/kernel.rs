//! The inner loops of the fast form, in lanes that become registers.
//!
//! They are slices and plain loops, inlined where they are dispatched from: a closure or a call would be compiled for
//! the least machine. The branch on new ice also keeps the compiler from interleaving lanes, which it does badly.

/// Cells in one turn of a kernel: a register of AVX2.
pub(super) const LANES: usize = 4;

/// The constants of a step, as the kernels want them.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    pub(super) kept: f64,
    pub(super) given: f64,
    pub(super) gamma: f64,
    pub(super) threshold: f64,
}

/// v of a row: what its cells show to their neighbours.
#[inline(always)]
pub(super) fn show<const ONLY_ICE: bool>(s: &[f64], v: &mut [f64]) {
    let (s, _) = s.as_chunks::<LANES>();
    let (v, _) = v.as_chunks_mut::<LANES>();
    for (v, s) in v.iter_mut().zip(s) {
        for (v, &s) in v.iter_mut().zip(s) {
            *v = match ONLY_ICE {
                true if s <= -1.0 => 0.0,
                true => s.abs(),
                false if s > 0.0 => s,
                false => 0.0,
            };
        }
    }
}

/// The rows of v around a span.
#[derive(Clone, Copy)]
pub(super) struct Shown<'a> {
    pub(super) above: &'a [f64],
    pub(super) here: &'a [f64],
    pub(super) below: &'a [f64],
    pub(super) column: usize,
}

/// `len` numbers from the one at `from` on, in lanes.
#[inline(always)]
fn lanes(row: &[f64], from: usize, len: usize) -> &[[f64; LANES]] {
    row[from..from + len].as_chunks().0
}

/// What the six neighbours of a span show, in lanes.
#[derive(Clone, Copy)]
struct Around<'a> {
    east: &'a [[f64; LANES]],
    west: &'a [[f64; LANES]],
    south_east: &'a [[f64; LANES]],
    north_west: &'a [[f64; LANES]],
    south_west: &'a [[f64; LANES]],
    north_east: &'a [[f64; LANES]],
}

/// `s` of the next step. No closure and no call in here: they would not become AVX2.
#[inline(always)]
fn next<const GATED: bool>(
    s: &[f64; LANES],
    r: &[f64; LANES],
    v: &Around,
    i: usize,
    rule: &Rule,
) -> [f64; LANES] {
    let mut next = [0.0; LANES];
    for k in 0..LANES {
        let across = v.east[i][k] + v.west[i][k];
        let falling = v.south_east[i][k] + v.north_west[i][k];
        let rising = v.south_west[i][k] + v.north_east[i][k];
        let inflow = rule.given * ((across + falling) + rising);
        let gain = if !GATED | (s[k] <= -1.0) | (r[k] > rule.threshold) { rule.gamma } else { 0.0 };
        let receptive = (s[k] - gain) - inflow;
        let other = s[k] * rule.kept + inflow;
        next[k] = if s[k].is_sign_negative() { receptive } else { other };
    }
    next
}

/// One step of a span. `fresh` gains the ordinals of its new ice, where the first cell has ordinal `first`.
#[inline(always)]
pub(super) fn advance<const GATED: bool>(
    s: &mut [f64],
    len: usize,
    r: &[f64],
    v: Shown,
    rule: &Rule,
    first: usize,
    fresh: &mut Vec<u32>,
) {
    let (column, padded) = (v.column, s.len());
    let around = Around {
        east: lanes(v.here, column + 1, padded),
        west: lanes(v.here, column - 1, padded),
        south_east: lanes(v.below, column, padded),
        north_west: lanes(v.above, column, padded),
        south_west: lanes(v.below, column - 1, padded),
        north_east: lanes(v.above, column + 1, padded),
    };
    let r = if GATED { lanes(r, 0, padded) } else { around.east };
    let (s, _) = s.as_chunks_mut::<LANES>();
    let whole = len / LANES;
    for i in 0..whole {
        let before = s[i];
        s[i] = next::<GATED>(&before, &r[i], &around, i, rule);
        let new = new_ice(&before, &s[i]);
        if new != 0 {
            note(new, first + i * LANES, fresh);
        }
    }
    if whole < s.len() {
        let rest = len - whole * LANES;
        let before = s[whole];
        let after = next::<GATED>(&before, &r[whole], &around, whole, rule);
        for k in 0..LANES {
            s[whole][k] = if k < rest { after[k] } else { before[k] };
        }
        let new = new_ice(&before, &s[whole]) & ((1 << rest) - 1);
        if new != 0 {
            note(new, first + whole * LANES, fresh);
        }
    }
}

/// Which of these cells have become ice: one bit for each, the first lowest.
#[inline(always)]
fn new_ice(before: &[f64; LANES], after: &[f64; LANES]) -> u32 {
    let mut bits = 0;
    for k in 0..LANES {
        bits |= u32::from((after[k].abs() >= 1.0) & (before[k] > -1.0)) << k;
    }
    bits
}

/// New ice, which is rare: kept out of the loop that finds it.
#[cold]
#[inline(never)]
fn note(bits: u32, first: usize, fresh: &mut Vec<u32>) {
    fresh.extend((0..LANES).filter(|k| bits >> k & 1 == 1).map(|k| (first + k) as u32));
}
