//! Cells with density in bricks of 4^3, and a ray's way through them.
//!
//! Cells lie in the order of their Morton codes, so that those of a brick, and those of a coarser cell, follow each other.
//! Only cells with density are kept: a brick has 64 bits that say which, and the number of its first.

/// The index of a brick without density.
const EMPTY: u32 = u32::MAX;
/// Along an axis that a ray hardly moves on, it moves by so much: no plane is at infinity.
const LEAST: f64 = 1e-12;
/// Bits of a place in a brick along x; along y and z they are shifted.
const BITS: [u32; 4] = [0, 1, 8, 9];

/// A cell with density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    /// Optical depth per side of a cell along x, y and z.
    pub depth: [f32; 3],
    /// How density changes from the lower neighbour and to the higher one, along each axis; of any unit.
    pub slopes: [[i8; 2]; 3],
    /// The box within the cell that holds all it has, in finest voxels.
    pub low: [u8; 3],
    pub high: [u8; 3],
}

impl Cell {
    /// Optical depth per side along a direction of which these are the squares.
    #[inline(always)]
    pub fn along(&self, squares: [f64; 3]) -> f64 {
        let d = self.depth;
        f64::from(d[0]) * squares[0] + f64::from(d[1]) * squares[1] + f64::from(d[2]) * squares[2]
    }
}

/// The Morton code of a place.
pub(super) fn code(place: [u32; 3]) -> u64 {
    let spread = |x: u32| {
        let mut x = u64::from(x) & 0x1f_ffff;
        x = (x | x << 32) & 0x001f_0000_0000_ffff;
        x = (x | x << 16) & 0x001f_0000_ff00_00ff;
        x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
        x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
        (x | x << 2) & 0x1249_2492_4924_9249
    };
    spread(place[0]) | spread(place[1]) << 1 | spread(place[2]) << 2
}

/// A ray in sides of a cell from the grid's corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub origin: [f64; 3],
    /// Of length 1, no component 0.
    pub direction: [f64; 3],
    pub inverse: [f64; 3],
}

impl Ray {
    #[inline(always)]
    pub fn new(origin: [f64; 3], direction: [f64; 3]) -> Self {
        let direction = direction.map(|d| if d.abs() < LEAST { LEAST } else { d });
        Self { origin, direction, inverse: direction.map(|d| 1.0 / d) }
    }

    #[inline(always)]
    pub fn at(&self, t: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.origin[axis] + self.direction[axis] * t)
    }

    /// Squares of the direction's components.
    #[inline(always)]
    pub fn squares(&self) -> [f64; 3] {
        self.direction.map(|d| d * d)
    }

    /// Where it enters and leaves a box, from t = 0 on; it misses unless the first is smaller.
    #[inline(always)]
    pub fn through(&self, low: [f64; 3], high: [f64; 3]) -> [f64; 2] {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let a = (low[axis] - self.origin[axis]) * self.inverse[axis];
            let b = (high[axis] - self.origin[axis]) * self.inverse[axis];
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        [enter, leave]
    }
}

/// What a ray meets: a cell, by its number and place, and where the ray enters and leaves the box in it.
pub(super) struct Met<'a> {
    pub number: usize,
    pub cell: &'a Cell,
    /// The box, in sides of a cell from the grid's corner.
    pub low: [f64; 3],
    pub high: [f64; 3],
    pub from: f64,
    pub to: f64,
}

/// Cells of one side.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    /// The side of a cell, m.
    pub side: f64,
    /// Finest voxels along it.
    pub block: u32,
    /// The far corner of what has density, in sides; the near one is 0.
    pub extent: [f64; 3],
    pub cells: Vec<Cell>,
    pub places: Vec<[u16; 3]>,
    bricks: [usize; 3],
    index: Vec<u32>,
    masks: Vec<u64>,
    firsts: Vec<u32>,
}

impl Grid {
    /// Cells in the order of their codes, at their places.
    pub fn new(side: f64, block: u32, extent: [f64; 3], places: Vec<[u16; 3]>, cells: Vec<Cell>) -> Self {
        let bricks = [0, 1, 2].map(|axis| {
            let most = places.iter().map(|place| place[axis]).max().unwrap_or(0);
            usize::from(most) / 4 + 1
        });
        let mut grid = Self {
            side,
            block,
            extent,
            cells,
            places: Vec::new(),
            bricks,
            index: vec![EMPTY; bricks.iter().product()],
            masks: Vec::new(),
            firsts: Vec::new(),
        };
        for (number, place) in places.iter().enumerate() {
            let at = grid.brick(place.map(|x| usize::from(x) / 4));
            if grid.index[at] == EMPTY {
                grid.index[at] = grid.masks.len() as u32;
                grid.masks.push(0);
                grid.firsts.push(number as u32);
            }
            grid.masks[grid.index[at] as usize] |= 1 << bit(place.map(|x| usize::from(x) % 4));
        }
        grid.places = places;
        grid
    }

    #[inline(always)]
    fn brick(&self, at: [usize; 3]) -> usize {
        (at[2] * self.bricks[1] + at[1]) * self.bricks[0] + at[0]
    }

    /// The number of the cell at a place that may lie outside.
    pub fn number(&self, place: [i32; 3]) -> Option<usize> {
        let inside = (0..3).all(|axis| place[axis] >= 0 && (place[axis] as usize) < 4 * self.bricks[axis]);
        if !inside {
            return None;
        }
        let place = place.map(|x| x as usize);
        let brick = self.index[self.brick(place.map(|x| x / 4))];
        if brick == EMPTY {
            return None;
        }
        let (mask, bit) = (self.masks[brick as usize], bit(place.map(|x| x % 4)));
        let before = (mask & ((1 << bit) - 1)).count_ones();
        (mask >> bit & 1 == 1).then_some((self.firsts[brick as usize] + before) as usize)
    }

    /// The box of a cell at a place, in sides.
    #[inline(always)]
    pub fn within(&self, cell: &Cell, place: [f64; 3]) -> [[f64; 3]; 2] {
        if self.block == 1 {
            return [place, place.map(|x| x + 1.0)];
        }
        let part = 1.0 / f64::from(self.block);
        let at = |offset: [u8; 3]| [0, 1, 2].map(|axis| place[axis] + f64::from(offset[axis]) * part);
        [at(cell.low), at(cell.high)]
    }

    /// Visits the cells that a ray meets, in order, until `visit` says that it is enough.
    #[inline(always)]
    pub fn walk(&self, ray: &Ray, visit: impl FnMut(&Met) -> bool) {
        self.walk_between(ray, [0.0, f64::INFINITY], visit);
    }

    /// The same between two places of the ray.
    #[inline(always)]
    pub fn walk_between(&self, ray: &Ray, [from, to]: [f64; 2], mut visit: impl FnMut(&Met) -> bool) {
        let [at, leave] = ray.through([0.0; 3], self.extent);
        let (mut at, leave) = (at.max(from), leave.min(to));
        if at >= leave {
            return;
        }
        let Ray { origin, direction, inverse } = *ray;
        let ahead = direction.map(|d| usize::from(d > 0.0));
        let plane = |axis: usize, place: usize| (place as f64 - origin[axis]) * inverse[axis];
        let place = |axis: usize, t: f64| origin[axis] + direction[axis] * t;
        let mut brick =
            [0, 1, 2].map(|axis| ((place(axis, at) * 0.25).max(0.0) as usize).min(self.bricks[axis] - 1));
        let mut next = [0, 1, 2].map(|axis| plane(axis, 4 * (brick[axis] + ahead[axis])));
        loop {
            let exit = next[0].min(next[1]).min(next[2]).min(leave);
            let number = self.index[self.brick(brick)];
            if number != EMPTY && self.pass(ray, brick, number as usize, [at, exit], &mut visit) {
                return;
            }
            if exit >= leave {
                return;
            }
            let axis = first(next);
            if ahead[axis] == 1 {
                brick[axis] += 1;
                if brick[axis] == self.bricks[axis] {
                    return;
                }
            } else {
                if brick[axis] == 0 {
                    return;
                }
                brick[axis] -= 1;
            }
            next[axis] = plane(axis, 4 * (brick[axis] + ahead[axis]));
            at = at.max(exit);
        }
    }

    /// The same within a brick; whether it was enough.
    #[inline(always)]
    fn pass(
        &self,
        ray: &Ray,
        brick: [usize; 3],
        number: usize,
        [mut at, exit]: [f64; 2],
        visit: &mut impl FnMut(&Met) -> bool,
    ) -> bool {
        let mask = self.masks[number];
        let corner = brick.map(|x| (4 * x) as f64);
        let ahead = ray.direction.map(|d| if d > 0.0 { 1.0 } else { 0.0 });
        let mut cell = [0, 1, 2].map(|axis| {
            let inside = ray.origin[axis] + ray.direction[axis] * at - corner[axis];
            (inside.max(0.0) as usize).min(3)
        });
        let plane = |axis: usize, cell: usize| {
            (corner[axis] + cell as f64 + ahead[axis] - ray.origin[axis]) * ray.inverse[axis]
        };
        let mut next = [0, 1, 2].map(|axis| plane(axis, cell[axis]));
        loop {
            let to = next[0].min(next[1]).min(next[2]).min(exit);
            let bit = bit(cell);
            if mask >> bit & 1 == 1 {
                let before = (mask & ((1 << bit) - 1)).count_ones();
                let number = (self.firsts[number] + before) as usize;
                let content = &self.cells[number];
                let place = [0, 1, 2].map(|axis| corner[axis] + cell[axis] as f64);
                let [low, high] = self.within(content, place);
                let [mut from, mut end] = [at, to];
                if self.block > 1 {
                    let [enter, leave] = ray.through(low, high);
                    (from, end) = (from.max(enter), end.min(leave));
                }
                if from < end && visit(&Met { number, cell: content, low, high, from, to: end }) {
                    return true;
                }
            }
            if to >= exit {
                return false;
            }
            let axis = first(next);
            if ahead[axis] > 0.0 {
                cell[axis] += 1;
                if cell[axis] == 4 {
                    return false;
                }
            } else {
                if cell[axis] == 0 {
                    return false;
                }
                cell[axis] -= 1;
            }
            next[axis] = plane(axis, cell[axis]);
            at = at.max(to);
        }
    }

    /// Optical depth along a ray, up to about `enough`.
    #[inline]
    pub fn depth(&self, ray: &Ray, enough: f64) -> f64 {
        self.depth_between(ray, &mut [0.0, f64::INFINITY], enough)
    }

    /// The same between two places of the ray; they become those between which it met something.
    #[inline]
    pub fn depth_between(&self, ray: &Ray, between: &mut [f64; 2], enough: f64) -> f64 {
        let squares = ray.squares();
        let (mut depth, mut met_between) = (0.0, [f64::INFINITY, 0.0]);
        self.walk_between(ray, *between, |met| {
            depth += met.cell.along(squares) * (met.to - met.from);
            met_between = [met_between[0].min(met.from), met.to];
            depth > enough
        });
        // What is behind is not known.
        *between = if depth > enough { [met_between[0], between[1]] } else { met_between };
        depth
    }
}

/// The bit of a place in a brick.
#[inline(always)]
fn bit(place: [usize; 3]) -> u32 {
    BITS[place[0] & 3] | BITS[place[1] & 3] << 1 | BITS[place[2] & 3] << 2
}

/// The axis of the least.
#[inline(always)]
fn first(next: [f64; 3]) -> usize {
    if next[0] <= next[1] {
        if next[0] <= next[2] { 0 } else { 2 }
    } else if next[1] <= next[2] {
        1
    } else {
        2
    }
}
