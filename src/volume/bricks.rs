//! The field as rays read it: bricks of 8^3 cells between samples, each with the 9^3 samples of its corners in one place,
//! and none where all samples are 0.
//!
//! In the coordinates of the lattice a voxel is 1 long and sample i is at i + 1: one more sample lies outside of either
//! face, as large as its neighbour, so that the field is trilinear all over the box, from 0.5 to n + 0.5.

use rayon::prelude::*;

use super::walk::Work;
use super::{Density, Ray};

/// Cells along the side of a brick.
pub(super) const SIDE: usize = 8;
/// Samples along it.
pub(super) const EDGE: usize = SIDE + 1;
/// Samples of a brick.
pub(super) const CORNERS: usize = EDGE * EDGE * EDGE;
/// The number of a brick without density.
pub(super) const EMPTY: u32 = u32::MAX;

/// The field in bricks.
#[derive(Clone, Debug)]
pub struct Bricks {
    counts: [usize; 3],
    voxel: f64,
    /// Bricks along x, y and z.
    pub(super) across: [usize; 3],
    /// For every brick where its samples are, or [`EMPTY`].
    pub(super) index: Vec<u32>,
    pub(super) samples: Vec<[f32; CORNERS]>,
    /// The bricks with density are within these, first and one past the last, along each axis.
    pub(super) range: [[usize; 2]; 3],
    /// The same in lattice coordinates, within the box.
    pub(super) bounds: [[f64; 2]; 3],
}

/// A ray in lattice coordinates; its parameter is its length in voxels.
#[derive(Clone, Copy, Debug)]
pub(super) struct LatticeRay {
    pub origin: [f64; 3],
    pub direction: [f64; 3],
}

impl Bricks {
    /// The bricks of a field.
    pub fn new(density: &Density) -> Self {
        Self::build(density, true)
    }

    /// With `skip` off every brick is kept, and nothing is skipped.
    pub(super) fn build(density: &Density, skip: bool) -> Self {
        let counts = density.counts();
        let across = counts.map(|count| (count + 1).div_ceil(SIDE));
        let place = |k: usize| [k % across[0], k / across[0] % across[1], k / (across[0] * across[1])];
        let number: usize = across.iter().product();
        let kept: Vec<usize> = (0..number)
            .into_par_iter()
            .filter(|k| {
                let mut any = !skip;
                gather(density, place(*k), |_, row| any |= row.iter().any(|value| *value > 0.0));
                any
            })
            .collect();
        let samples: Vec<[f32; CORNERS]> = kept
            .par_iter()
            .map(|k| {
                let mut corners = [0.0; CORNERS];
                gather(density, place(*k), |at, row| corners[at..][..EDGE].copy_from_slice(row));
                corners
            })
            .collect();
        let mut index = vec![EMPTY; number];
        let mut range = [[usize::MAX, 0]; 3];
        for (at, k) in kept.iter().enumerate() {
            index[*k] = at as u32;
            for (bound, b) in range.iter_mut().zip(place(*k)) {
                *bound = [bound[0].min(b), bound[1].max(b + 1)];
            }
        }
        let bounds = [0, 1, 2].map(|axis| {
            let [low, high] = range[axis].map(|b| b.saturating_mul(SIDE) as f64);
            [low.max(0.5), high.min(counts[axis] as f64 + 0.5)]
        });
        Self { counts, voxel: density.voxel(), across, index, samples, range, bounds }
    }

    /// The side of a voxel, m.
    pub fn voxel(&self) -> f64 {
        self.voxel
    }

    /// Voxels along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// Bricks with density, and all.
    pub fn occupied(&self) -> [usize; 2] {
        [self.samples.len(), self.index.len()]
    }

    pub(super) fn lattice(&self, ray: &Ray) -> LatticeRay {
        LatticeRay { origin: ray.origin.map(|x| x / self.voxel + 0.5), direction: ray.direction }
    }

    /// Optical depth for tau = 1 along a ray, from its origin to where it leaves the box: density times m, exactly.
    pub fn depth(&self, ray: &Ray) -> f64 {
        let mut sum = 0.0;
        self.walk(&self.lattice(ray), &mut Work::default(), |segment| {
            sum += segment.depth;
            false
        });
        sum * self.voxel
    }

    /// Where a ray is within the box, from and to, m; nothing if it misses it.
    pub fn inside(&self, ray: &Ray) -> Option<[f64; 2]> {
        let ray = self.lattice(ray);
        let (mut from, mut to) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            let faces = [0.5, self.counts[axis] as f64 + 0.5];
            if d == 0.0 {
                if !(faces[0]..=faces[1]).contains(&o) {
                    return None;
                }
            } else {
                let [a, b] = faces.map(|face| (face - o) / d);
                (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
            }
        }
        (from < to).then_some([from * self.voxel, to * self.voxel])
    }

    /// The density and its gradient, 1/m, at a place, m; 0 outside of the box.
    pub fn at(&self, place: [f64; 3]) -> (f64, [f64; 3]) {
        let (mut brick, mut corner, mut rest) = ([0; 3], [0; 3], [0.0_f32; 3]);
        for axis in 0..3 {
            let q = place[axis] / self.voxel + 0.5;
            let far = self.counts[axis] as f64 + 0.5;
            if !(q >= 0.5 && q <= far) {
                return (0.0, [0.0; 3]);
            }
            let cell = (q as usize).min(self.counts[axis]);
            (brick[axis], corner[axis]) = (cell / SIDE, cell % SIDE);
            rest[axis] = (q - cell as f64) as f32;
        }
        let number = (brick[2] * self.across[1] + brick[1]) * self.across[0] + brick[0];
        let at = (corner[2] * EDGE + corner[1]) * EDGE + corner[0];
        match self.index[number] {
            EMPTY => (0.0, [0.0; 3]),
            k => {
                let cell = Cell::of(&self.samples[k as usize], at);
                let slope = cell.gradient(rest).map(|x| f64::from(x) / self.voxel);
                (f64::from(cell.value(rest)), slope)
            }
        }
    }
}

/// Hands the rows of a brick's samples on, with where they begin in it.
fn gather(density: &Density, brick: [usize; 3], mut row: impl FnMut(usize, &[f32])) {
    let [nx, ny, nz] = density.counts();
    // Lattice place q holds sample q - 1; beyond the faces the outermost is repeated.
    let sample = |q: usize, count: usize| q.clamp(1, count) - 1;
    let first = brick[0] * SIDE;
    let whole = first >= 1 && first + EDGE - 1 <= nx;
    for z in 0..EDGE {
        for y in 0..EDGE {
            let from = density.row(sample(brick[1] * SIDE + y, ny), sample(brick[2] * SIDE + z, nz));
            let at = (z * EDGE + y) * EDGE;
            if whole {
                row(at, &from[first - 1..][..EDGE]);
            } else {
                let mut edge = [0.0; EDGE];
                for (x, value) in edge.iter_mut().enumerate() {
                    *value = from[sample(first + x, nx)];
                }
                row(at, &edge);
            }
        }
    }
}

/// The eight samples around a cell: in pairs along x, those of y inner, those of z outer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell(pub [[[f32; 2]; 2]; 2]);

/// From the first to the last sample of a cell.
const SPAN: usize = EDGE * EDGE + EDGE + 2;

impl Cell {
    #[inline(always)]
    pub fn of(brick: &[f32; CORNERS], at: usize) -> Self {
        let c = &brick[at..at + SPAN];
        const Z: usize = EDGE * EDGE;
        Self([[[c[0], c[1]], [c[EDGE], c[EDGE + 1]]], [[c[Z], c[Z + 1]], [c[Z + EDGE], c[Z + EDGE + 1]]]])
    }

    /// Whether there is nothing.
    #[inline(always)]
    pub fn empty(&self) -> bool {
        let [[a, b], [c, d]] = self.0;
        ((a[0] + a[1]) + (b[0] + b[1])) + ((c[0] + c[1]) + (d[0] + d[1])) == 0.0
    }

    /// Trilinear; exact where all eight are equal. All four along z, then both along y: side by side.
    #[inline(always)]
    pub fn value(&self, [x, y, z]: [f32; 3]) -> f32 {
        let [[a, b], [c, d]] = self.0;
        let (low, high) = ([a[0], a[1], b[0], b[1]], [c[0], c[1], d[0], d[1]]);
        let mix = |k: usize| low[k] + z * (high[k] - low[k]);
        let [p, q, r, s] = [mix(0), mix(1), mix(2), mix(3)];
        let line = [p + y * (r - p), q + y * (s - q)];
        line[0] + x * (line[1] - line[0])
    }

    /// Its gradient, for one voxel.
    #[inline(always)]
    pub fn gradient(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        let mix = |a: f32, b: f32, by: f32| a + by * (b - a);
        let [[a, b], [c, d]] = self.0;
        let along = |p: [f32; 2]| p[1] - p[0];
        let at = |p: [f32; 2]| mix(p[0], p[1], x);
        [
            mix(mix(along(a), along(b), y), mix(along(c), along(d), y), z),
            mix(at(b) - at(a), at(d) - at(c), z),
            mix(at(c) - at(a), at(d) - at(b), y),
        ]
    }
}
