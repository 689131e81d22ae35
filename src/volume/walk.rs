//! A ray's way through the bricks: from brick to brick, and within those with density from cell to cell.
//!
//! Where a plane between bricks or cells is passed is worked out from the plane itself, never by adding up steps, and the
//! brick at a place of the ray is a function of that place alone. So a way that begins later, because what was before it
//! is empty, goes on with the same bits.

use super::bricks::{Bricks, Cell, EDGE, EMPTY, LatticeRay, SIDE};

/// What was done, the same on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Rays.
    pub rays: u64,
    /// Cells that a ray passed in bricks with density.
    pub cells: u64,
    /// Bricks without density that were passed at one step each.
    pub skipped: u64,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.cells += other.cells;
        self.skipped += other.skipped;
    }
}

/// A ray's part in one cell that has density.
pub(super) struct Segment {
    /// Where it begins and ends on the ray, voxels.
    pub from: f64,
    pub to: f64,
    /// The integral of density over it, voxels.
    pub depth: f64,
    /// The cell, and the part's middle in it, 0 to 1.
    pub cell: Cell,
    pub middle: [f64; 3],
}

impl Segment {
    /// The integral of density between two places of the part, voxels; the ray's direction.
    #[inline(always)]
    pub fn between(&self, from: f64, to: f64, direction: [f64; 3]) -> f64 {
        let off = 0.5 * (from + to) - 0.5 * (self.from + self.to);
        let place = [0, 1, 2].map(|axis| self.middle[axis] + direction[axis] * off);
        gauss(&self.cell, place, direction, 0.5 * (to - from))
    }
}

/// What all steps of a ray need.
struct Way {
    origin: [f64; 3],
    direction: [f64; 3],
    /// One over the direction.
    inverse: [f64; 3],
    /// From where planes are measured: the origin, but along an axis that the ray does not move on a place before all
    /// planes, which are never reached.
    from: [f64; 3],
}

impl Way {
    /// Where a plane square to an axis is passed.
    #[inline(always)]
    fn passes(&self, axis: usize, plane: f64) -> f64 {
        (plane - self.from[axis]) * self.inverse[axis]
    }

    fn forward(&self, axis: usize) -> bool {
        self.inverse[axis] > 0.0
    }
}

impl Bricks {
    /// Visits the parts of a ray in cells with density, in order, until `visit` says that it is enough.
    #[inline]
    pub(super) fn walk(&self, ray: &LatticeRay, work: &mut Work, mut visit: impl FnMut(&Segment) -> bool) {
        let &LatticeRay { origin, direction } = ray;
        let still = direction.map(|d| d == 0.0);
        let way = Way {
            origin,
            direction,
            inverse: [0, 1, 2].map(|k| if still[k] { f64::INFINITY } else { 1.0 / direction[k] }),
            from: [0, 1, 2].map(|k| if still[k] { -1.0 } else { origin[k] }),
        };
        let Some([mut at, leave]) = self.enter(&way) else {
            return;
        };
        let mut brick = [0, 1, 2].map(|axis| self.brick_at(&way, axis, at));
        let ahead = |axis: usize, brick: usize| {
            way.passes(axis, ((brick + usize::from(way.forward(axis))) * SIDE) as f64)
        };
        let mut next = [0, 1, 2].map(|axis| ahead(axis, brick[axis]));
        loop {
            let exit = next[0].min(next[1]).min(next[2].min(leave));
            let number = (brick[2] * self.across[1] + brick[1]) * self.across[0] + brick[0];
            match self.index[number] {
                EMPTY => work.skipped += 1,
                k => {
                    if self.pass(&way, brick, k, [at, exit], work, &mut visit) {
                        return;
                    }
                }
            }
            if exit >= leave {
                return;
            }
            at = exit;
            for axis in 0..3 {
                if next[axis] <= exit {
                    let [first, end] = self.range[axis];
                    if way.forward(axis) {
                        brick[axis] += 1;
                        if brick[axis] >= end {
                            return;
                        }
                    } else {
                        if brick[axis] <= first {
                            return;
                        }
                        brick[axis] -= 1;
                    }
                    next[axis] = ahead(axis, brick[axis]);
                }
            }
        }
    }

    /// Where the ray is within the bounds of what is not empty.
    fn enter(&self, way: &Way) -> Option<[f64; 2]> {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        if self.samples.is_empty() {
            return None;
        }
        for axis in 0..3 {
            let [low, high] = self.bounds[axis];
            if way.direction[axis] == 0.0 {
                if !(low..=high).contains(&way.origin[axis]) {
                    return None;
                }
            } else {
                let (a, b) = (way.passes(axis, low), way.passes(axis, high));
                (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
            }
        }
        (enter < leave).then_some([enter, leave])
    }

    /// The brick along an axis at a place of the ray: all planes that are passed there are behind it.
    fn brick_at(&self, way: &Way, axis: usize, at: f64) -> usize {
        let [first, end] = self.range[axis];
        let place = way.origin[axis] + way.direction[axis] * at;
        let mut brick = ((place.max(0.0) / SIDE as f64) as usize).clamp(first, end - 1);
        if way.direction[axis] == 0.0 {
            return brick;
        }
        let passed = |plane: usize| way.passes(axis, (plane * SIDE) as f64) <= at;
        if way.forward(axis) {
            while brick + 1 < end && passed(brick + 1) {
                brick += 1;
            }
            while brick > first && !passed(brick) {
                brick -= 1;
            }
        } else {
            while brick > first && passed(brick) {
                brick -= 1;
            }
            while brick + 1 < end && !passed(brick + 1) {
                brick += 1;
            }
        }
        brick
    }

    /// From cell to cell of a brick; whether it was enough.
    #[inline(always)]
    fn pass(
        &self,
        way: &Way,
        brick: [usize; 3],
        number: u32,
        [mut at, exit]: [f64; 2],
        work: &mut Work,
        visit: &mut impl FnMut(&Segment) -> bool,
    ) -> bool {
        let samples = &self.samples[number as usize];
        let (mut low, mut ahead, mut step, mut stride) = ([0.0; 3], [0.0; 3], [0.0; 3], [0_isize; 3]);
        let mut corner = 0_usize;
        for axis in 0..3 {
            let base = (brick[axis] * SIDE) as f64;
            let local = (way.origin[axis] + way.direction[axis] * at - base).max(0.0);
            let cell = (local as usize).min(SIDE - 1);
            let along = [1, EDGE, EDGE * EDGE][axis];
            corner += cell * along;
            low[axis] = base + cell as f64;
            let forward = way.forward(axis);
            ahead[axis] = way.passes(axis, if forward { low[axis] + 1.0 } else { low[axis] });
            step[axis] = if forward { 1.0 } else { -1.0 };
            stride[axis] = if forward { along as isize } else { -(along as isize) };
        }
        let plane = step.map(|s| if s > 0.0 { 1.0 } else { 0.0 });
        let mut cells = 0;
        let enough = loop {
            let first = ahead[0].min(ahead[1]).min(ahead[2]);
            let to = first.min(exit);
            let length = to - at;
            if length > 0.0 {
                cells += 1;
                let cell = Cell::of(samples, corner);
                if !cell.empty() {
                    let segment = integrate(way, low, cell, at, to);
                    if visit(&segment) {
                        break true;
                    }
                }
                at = to;
            }
            if first >= exit {
                break false;
            }
            // No branches: which plane is next cannot be foreseen.
            for axis in 0..3 {
                let passed = ahead[axis] <= first;
                low[axis] += if passed { step[axis] } else { 0.0 };
                corner = corner.wrapping_add_signed(if passed { stride[axis] } else { 0 });
                ahead[axis] = way.passes(axis, low[axis] + plane[axis]);
            }
        };
        work.cells += cells;
        enough
    }
}

/// A ray's part in a cell, from and to, voxels.
#[inline(always)]
fn integrate(way: &Way, low: [f64; 3], cell: Cell, from: f64, to: f64) -> Segment {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let place = [0, 1, 2].map(|axis| (way.origin[axis] - low[axis]) + way.direction[axis] * middle);
    let depth = gauss(&cell, place, way.direction, half);
    Segment { from, to, depth, cell, middle: place }
}

/// The integral of density in a cell along a line through `place`, half of it on either side; Gauss's two places are exact
/// for the cubic that a trilinear field is along it.
#[inline(always)]
fn gauss(cell: &Cell, place: [f64; 3], direction: [f64; 3], half: f64) -> f64 {
    const GAUSS: f64 = 0.577_350_269_189_625_8; // 1 / sqrt(3)
    let aside = half * GAUSS;
    let (mut before, mut after) = ([0.0; 3], [0.0; 3]);
    for axis in 0..3 {
        let off = direction[axis] * aside;
        before[axis] = (place[axis] - off) as f32;
        after[axis] = (place[axis] + off) as f32;
    }
    // Not below 0, should a place be outside of its cell by a rounding.
    let sum = f64::from(cell.value(before)) + f64::from(cell.value(after));
    (half * sum).max(0.0)
}
