//! The fast form of `ReiterGated` and `OnlyIceHidden`: the same bits as the plain form.
//!
//! One number per cell holds both u and whether the cell is receptive: `s = u`, or `-u` on ice and its neighbours. A
//! step goes down the rows once and in place. The v of a row is written out two rows before it is needed, while its
//! old s still stands, so that six sums read it and the kernel has no branch. New ice is rare, and seen to afterwards.

use multiversion::multiversion;

use super::gate::Gate;
use super::kernel::{LANES, Rule, Shown, advance, show};
use super::parameters::Parameters;
use super::readings::{Edge, Inflow, RingTouchingIce};
use super::reference::State;
use crate::hexgrid::{Axial, Region};

/// Rows of v at hand: the one above, the one at work, the one below and the one after, which is being written.
const ROWS: usize = 4;

/// Cells next to one another in a row.
#[derive(Clone, Debug)]
struct Span {
    column: usize,
    len: usize,
    ordinal: usize,
}

#[derive(Clone, Debug, Default)]
struct Row {
    spans: std::ops::Range<usize>,
    // First column and number of columns that hold a cell or a point of the ring.
    first: usize,
    len: usize,
    // Receptive cells that are not ice: the only ones that a gate can stop.
    waiting: usize,
    drawn: Option<u64>,
}

impl Row {
    fn hold(&mut self, column: usize) {
        if self.len == 0 {
            self.first = column;
        }
        let end = (self.first + self.len).max(column + 1);
        self.first = self.first.min(column);
        self.len = end - self.first;
    }

    /// The columns that hold something, in whole lanes.
    fn columns(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.len.next_multiple_of(LANES)
    }
}

/// A point of the ring and where the cells lie that it touches.
#[derive(Clone, Copy, Debug)]
struct RingPoint {
    place: u32,
    count: u32,
    inner: [u32; 6],
}

/// The rectangle, row after row, with the margin that the ring needs.
#[derive(Clone, Debug)]
pub(super) struct Fast {
    width: usize,
    least: Axial,
    rows: Vec<Row>,
    spans: Vec<Span>,
    places: Vec<u32>,
    ring: Vec<RingPoint>,
    zero_on_ice: bool,
    s: Vec<f64>,
    r: Vec<f64>,
    shown: [Vec<f64>; ROWS],
}

impl Fast {
    /// Whether there is a fast form of the reading.
    pub(super) fn covers(inflow: Inflow) -> bool {
        matches!(inflow, Inflow::ReiterGated | Inflow::OnlyIceHidden)
    }

    /// The lattice with these values of u, by ordinal.
    pub(super) fn new(region: &Region, parameters: &Parameters, u: &[f64]) -> Self {
        let bounds = region.bounds();
        let width = bounds.columns() + 2;
        let size = width * (bounds.rows() + 2);
        let least = Axial::new(bounds.least.q - 1, bounds.least.r - 1);
        let mut fast = Self {
            width,
            least,
            rows: vec![Row::default(); bounds.rows() + 2],
            spans: Vec::new(),
            places: Vec::with_capacity(region.len()),
            ring: Vec::new(),
            zero_on_ice: parameters.edge == Edge::Reflecting
                && parameters.ring_touching_ice == RingTouchingIce::Zero,
            s: vec![0.0; size + LANES],
            r: if parameters.threshold > 0.0 { vec![0.0; size + LANES] } else { Vec::new() },
            shown: std::array::from_fn(|_| vec![0.0; width + 2 * LANES]),
        };
        for (ordinal, (cell, &u)) in region.cells().iter().zip(u).enumerate() {
            fast.add_cell(*cell, ordinal);
            fast.s[fast.places[ordinal] as usize] = u;
        }
        for at in region.ring() {
            fast.add_ring_point(at, region, parameters);
        }
        fast.ring.sort_by_key(|point| point.count); // so that the loop over `inner` is foreseen
        let fresh: Vec<u32> = (0..u.len()).filter(|&i| u[i] >= 1.0).map(|i| i as u32).collect();
        fast.freeze(&fresh, region);
        fast
    }

    fn place(&self, at: Axial) -> usize {
        (at.r - self.least.r) as usize * self.width + (at.q - self.least.q) as usize
    }

    fn add_cell(&mut self, at: Axial, ordinal: usize) {
        let place = self.place(at);
        let new = self.spans.len();
        let (row, column) = (&mut self.rows[place / self.width], place % self.width);
        row.hold(column);
        if row.spans.is_empty() {
            row.spans = new..new;
        }
        let goes_on = row.spans.clone().last().map(|last| &mut self.spans[last]);
        match goes_on.filter(|span| span.column + span.len == column) {
            Some(span) => span.len += 1,
            None => {
                row.spans.end += 1;
                self.spans.push(Span { column, len: 1, ordinal });
            }
        }
        self.places.push(place as u32);
    }

    fn add_ring_point(&mut self, at: Axial, region: &Region, parameters: &Parameters) {
        let place = self.place(at);
        self.rows[place / self.width].hold(place % self.width);
        let mut point = RingPoint { place: place as u32, count: 0, inner: [0; 6] };
        for ordinal in at.neighbours().iter().filter_map(|q| region.ordinal(*q)) {
            point.inner[point.count as usize] = self.places[ordinal];
            point.count += 1;
        }
        match parameters.edge {
            Edge::Reflecting => self.ring.push(point),
            Edge::Held => self.s[place] = parameters.beta, // and nothing ever writes there
        }
    }

    pub(super) fn u(&self, ordinal: usize) -> f64 {
        self.s[self.places[ordinal] as usize].abs()
    }

    pub(super) fn state(&self, ordinal: usize) -> State {
        let s = self.s[self.places[ordinal] as usize];
        if s <= -1.0 {
            State::Ice
        } else if s.is_sign_negative() {
            State::Neighbour
        } else {
            State::Other
        }
    }

    /// One step of the solver, all cells at once. `fresh` is left with the ordinals of the new ice.
    pub(super) fn step(&mut self, parameters: &Parameters, gate: &Gate, fresh: &mut Vec<u32>) {
        let rule = Rule {
            kept: 1.0 - parameters.alpha / 2.0,
            given: parameters.alpha / 12.0,
            gamma: parameters.gamma,
            threshold: parameters.threshold,
        };
        match parameters.inflow {
            Inflow::OnlyIceHidden => sweep_only_ice_hidden(self, rule, gate, fresh),
            _ => sweep_reiter_gated(self, rule, gate, fresh),
        }
    }

    /// Makes ice of these cells, and their neighbours receptive.
    /// Then the points around.
    pub(super) fn freeze(&mut self, fresh: &[u32], region: &Region) {
        for &ordinal in fresh {
            let place = self.places[ordinal as usize] as usize;
            if self.s[place].is_sign_negative() {
                self.rows[place / self.width].waiting -= 1;
            }
            self.s[place] = -self.s[place].abs();
        }
        let mut ring_touched = false;
        for &ordinal in fresh {
            for at in region.cells()[ordinal as usize].neighbours() {
                let place = self.place(at);
                let counts = region.contains(at) || self.zero_on_ice;
                if !counts || self.s[place].is_sign_negative() {
                    continue;
                }
                if region.contains(at) {
                    self.s[place] = -self.s[place];
                    self.rows[place / self.width].waiting += 1;
                } else {
                    self.s[place] = -0.0; // for good
                    ring_touched = true;
                }
            }
        }
        if ring_touched {
            self.ring.retain(|point| self.s[point.place as usize].is_sign_positive());
        }
        self.surround();
    }

    /// The points around the region (§3.3).
    fn surround(&mut self) {
        for point in &self.ring {
            let inner = &point.inner[..point.count as usize];
            let sum: f64 = inner.iter().fold(0.0, |sum, &q| sum + self.s[q as usize].abs());
            self.s[point.place as usize] = sum / f64::from(point.count);
        }
    }

    /// All rows once, in place.
    #[inline(always)]
    fn sweep<const ONLY_ICE: bool>(&mut self, rule: Rule, gate: &Gate, fresh: &mut Vec<u32>) {
        let Self { width, least, rows, spans, s, r, shown, .. } = self;
        let mut shown = shown.each_mut().map(Vec::as_mut_slice);
        for row in 0..3 {
            let columns = rows[row].columns();
            show::<ONLY_ICE>(&s[row * *width..][columns.clone()], &mut shown[row][columns]);
        }
        for row in 1..rows.len() - 1 {
            if let Some(next) = rows.get(row + 2) {
                show::<ONLY_ICE>(&s[(row + 2) * *width..][next.columns()], &mut shown[3][next.columns()]);
            }
            let at = &mut rows[row];
            let gated = at.waiting > 0 && rule.threshold > 0.0;
            if gated && let Some((time, moment)) = gate.now().filter(|(time, _)| at.drawn != Some(*time)) {
                at.drawn = Some(time);
                for span in &spans[at.spans.clone()] {
                    let from = row * *width + span.column;
                    let q = least.q + span.column as i32;
                    moment.fill_row(least.r + row as i32, q, &mut r[from..from + span.len]);
                }
            }
            for span in &spans[at.spans.clone()] {
                let from = row * *width + span.column;
                let own = &mut s[from..from + span.len.next_multiple_of(LANES)];
                let v = Shown { above: shown[0], here: shown[1], below: shown[2], column: span.column };
                if gated {
                    advance::<true>(own, span.len, &r[from..], v, &rule, span.ordinal, fresh);
                } else {
                    advance::<false>(own, span.len, &[], v, &rule, span.ordinal, fresh);
                }
            }
            shown.rotate_left(1);
        }
    }
}

#[multiversion(targets("x86_64+avx2"))]
fn sweep_reiter_gated(fast: &mut Fast, rule: Rule, gate: &Gate, fresh: &mut Vec<u32>) {
    fast.sweep::<false>(rule, gate, fresh);
}

#[multiversion(targets("x86_64+avx2"))]
fn sweep_only_ice_hidden(fast: &mut Fast, rule: Rule, gate: &Gate, fresh: &mut Vec<u32>) {
    fast.sweep::<true>(rule, gate, fresh);
}
