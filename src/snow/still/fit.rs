//! What a level's optical depths are multiplied by, so that the whole body is as opaque as its voxels make it.
//!
//! Cells on a ray hide each other as if their voxels were scattered at random; plates and arms go on from cell to cell. For
//! each of some directions, rays through voxels and through cells are compared, and the multiplier is solved for that gives
//! both the same mean opacity. Between directions its logarithm is a polynomial of degree 6, alike for opposite ones, and
//! peaks where a crystal is seen edge on, for there it changes quickly.

use nalgebra::Vector3;

use crate::volume::exp;

use super::grid::{Grid, Ray};

/// Directions of half a sphere in which levels are compared: with normals, and without.
const DIRECTIONS: [usize; 2] = [64, 100];
/// More of them for each normal, at these cosines to it.
const PER_NORMAL: usize = 5;
const COSINES: [f64; 4] = [0.0, 0.04, -0.1, 0.2];
/// In each of them rays until so many have met a voxel.
const HITS: usize = 400;
/// The most rays.
const RAYS: usize = 4000;
/// Monomials of degree 6.
const MONOMIALS: usize = 28;
/// Crystals of which it matters that they are seen edge on.
pub(super) const NORMALS: usize = 3;
/// How wide peaks are, as cosines.
const WIDTHS: [f64; 3] = [0.02, 0.08, 0.25];
/// The one that changes as the crystal is seen from around its edge.
const AROUND: f64 = 0.08;
const TERMS: usize = MONOMIALS + (WIDTHS.len() + 2) * NORMALS;
/// The logarithm of the multiplier is at most so far from 0.
const FURTHEST: f64 = 4.0;
/// Extinctions that the multiplier is solved for, relative to the one that the body is made for.
const STRENGTHS: [f64; 3] = [0.25, 1.0, 4.0];

/// Multipliers of a level by direction and extinction.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    normals: [[f64; 3]; NORMALS],
    rows: [[f64; TERMS]; STRENGTHS.len()],
    /// What is added to each logarithm in all directions.
    all: Logarithms,
}

/// Of multipliers, one for each of the extinctions that they are solved for.
pub(super) type Logarithms = [f64; STRENGTHS.len()];

impl Fit {
    /// No change.
    const NONE: Self = Self {
        normals: [[0.0; 3]; NORMALS],
        rows: [[0.0; TERMS]; STRENGTHS.len()],
        all: [0.0; STRENGTHS.len()],
    };

    /// The multiplier along a direction of length 1, at an extinction relative to that of the body.
    pub fn multiplier(&self, direction: [f64; 3], strength: f64) -> f64 {
        let terms = terms(direction, &self.normals);
        let of =
            |row: usize| self.all[row] + terms.iter().zip(&self.rows[row]).map(|(a, b)| a * b).sum::<f64>();
        let logarithm = if strength == 1.0 {
            of(1)
        } else {
            // A parabola through the three, no further than they are.
            let s = (libm::log(strength.max(1e-9)) / libm::log(STRENGTHS[2])).clamp(-1.0, 1.0);
            0.5 * s * (s - 1.0) * of(0) + (1.0 - s * s) * of(1) + 0.5 * s * (s + 1.0) * of(2)
        };
        exp(logarithm.clamp(-FURTHEST, FURTHEST))
    }
}

/// The fits of all levels, of a body of crystals with these normals or none. The first, the voxels, is multiplied in all
/// directions by what `thinner` says, and the others are to be as opaque as it is then.
pub(super) fn fits(levels: &[Grid], normals: [[f64; 3]; NORMALS], thinner: Logarithms) -> Vec<Fit> {
    use rayon::prelude::*;
    let voxels = Fit { all: thinner, ..Fit::NONE };
    if levels.len() < 2 {
        return vec![voxels; levels.len()];
    }
    let directions = with_edges(&normals);
    let solved: Vec<Vec<[f64; STRENGTHS.len()]>> =
        directions.par_iter().map(|direction| compare(levels, *direction, thinner)).collect();
    let mut normal = [[0.0; TERMS]; TERMS];
    let rows: Vec<[f64; TERMS]> = directions.iter().map(|direction| terms(*direction, &normals)).collect();
    for row in &rows {
        for i in 0..TERMS {
            for j in 0..TERMS {
                normal[i][j] += row[i] * row[j];
            }
        }
    }
    // Peaks are kept low where nothing asks for them.
    for (i, row) in normal.iter_mut().enumerate().skip(MONOMIALS) {
        row[i] += 0.05;
    }
    let factor = cholesky(&normal);
    let mut fits = vec![voxels];
    for level in 0..levels.len() - 1 {
        let row = |strength: usize| {
            let mut right = [0.0; TERMS];
            for (terms, one) in rows.iter().zip(&solved) {
                for (sum, term) in right.iter_mut().zip(terms) {
                    *sum += term * one[level][strength];
                }
            }
            back(&factor, right)
        };
        fits.push(Fit { normals, rows: [row(0), row(1), row(2)], all: Fit::NONE.all });
    }
    fits
}

/// The k-th direction around z at a cosine to it.
fn around(k: usize, z: f64, step: f64) -> [f64; 3] {
    let radius = (1.0 - z * z).sqrt();
    let (sine, cosine) = libm::sincos(step * k as f64);
    [radius * cosine, radius * sine, z]
}

/// Half a sphere evenly.
pub(super) fn directions(count: usize) -> Vec<[f64; 3]> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(|k| around(k, (k as f64 + 0.5) / count as f64, golden)).collect()
}

/// Half a sphere evenly, and more of what is nearly square to normals.
fn with_edges(normals: &[[f64; 3]; NORMALS]) -> Vec<[f64; 3]> {
    let mut directions = directions(DIRECTIONS[usize::from(normals[0] == [0.0; 3])]);
    for normal in normals.iter().filter(|normal| **normal != [0.0; 3]) {
        let along = Vector3::from(*normal);
        let [a, b] = square(along);
        for (at, cosine) in COSINES.into_iter().enumerate() {
            for k in 0..PER_NORMAL {
                // Half a turn is enough: opposite directions are alike.
                let step = std::f64::consts::PI / PER_NORMAL as f64;
                let [x, y, z] = around(4 * k + at, cosine, 0.25 * step);
                let direction = a * x + b * y + along * z;
                directions.push([direction.x, direction.y, direction.z]);
            }
        }
    }
    directions
}

/// Logarithms of the multipliers that make each level but the first as opaque as the first.
fn compare(levels: &[Grid], direction: [f64; 3], thinner: Logarithms) -> Vec<Logarithms> {
    let plane = Plane::across(&levels[0], direction);
    let mut depths = vec![Depths::new(); levels.len()];
    for k in 0..RAYS {
        let ray = plane.ray(spread(k));
        let mut between = [0.0, f64::INFINITY];
        // What misses a cell misses all that is in it.
        for (level, grid) in levels.iter().enumerate().rev() {
            let by = 1.0 / f64::from(grid.block);
            let scaled = Ray { origin: ray.origin.map(|x| x * by), ..ray };
            // Four times as thin, it is still opaque.
            let depth = grid.depth_between(&scaled, &mut between, 30.0);
            if depth == 0.0 {
                break;
            }
            depths[level].add(depth);
            // In sides of the next, and a little more for rounding.
            between = [2.0 * between[0] - 1e-6, 2.0 * between[1] + 1e-6];
        }
        if depths[0].count == HITS {
            break;
        }
    }
    depths[1..].iter().map(|cells| agreeing(&depths[0], thinner, cells)).collect()
}

/// Logarithms of the multipliers of cells that make them as opaque as voxels that are multiplied so; or voxels as ice.
pub(super) fn agreeing(voxels: &Depths, thinner: Logarithms, cells: &Depths) -> Logarithms {
    let mut start = 0.0;
    std::array::from_fn(|k| {
        start = solve(voxels, exp(thinner[k]), cells, STRENGTHS[k], start);
        start
    })
}

/// Optical depths of rays that meet something, those within an eighth of an octave as their mean.
#[derive(Clone)]
pub(super) struct Depths {
    bins: Vec<[f64; 2]>,
    count: usize,
}

impl Depths {
    /// Bins of an octave, octaves, and the least of them as an exponent of f64.
    const PARTS: u32 = 3;
    const OCTAVES: u64 = 20;
    const LEAST: u64 = 1023 - 14;

    pub fn new() -> Self {
        Self { bins: vec![[0.0; 2]; (Self::OCTAVES << Self::PARTS) as usize], count: 0 }
    }

    pub fn add(&mut self, depth: f64) {
        let place = (depth.to_bits() >> (52 - Self::PARTS)).saturating_sub(Self::LEAST << Self::PARTS);
        let bin = &mut self.bins[(place as usize).min((Self::OCTAVES << Self::PARTS) as usize - 1)];
        *bin = [bin[0] + 1.0, bin[1] + depth];
        self.count += 1;
    }

    pub fn count(&self) -> usize {
        self.count
    }

    /// Those of other rays, too.
    pub fn join(&mut self, other: &Self) {
        for (bin, other) in self.bins.iter_mut().zip(&other.bins) {
            *bin = [bin[0] + other[0], bin[1] + other[1]];
        }
        self.count += other.count;
    }

    /// How many there are of each, and which.
    fn each(&self) -> impl Iterator<Item = (f64, f64)> {
        self.bins.iter().filter(|bin| bin[0] > 0.0).map(|bin| (bin[0], bin[1] / bin[0]))
    }
}

/// The logarithm of c such that the sums of 1 - exp(-c strength cells) and of 1 - exp(-by strength voxels) agree.
fn solve(voxels: &Depths, by: f64, cells: &Depths, strength: f64, start: f64) -> f64 {
    let by = by * strength;
    let wanted: f64 = voxels.each().map(|(count, depth)| count * (1.0 - exp(-by * depth))).sum();
    let mut logarithm = start;
    for _ in 0..12 {
        let c = exp(logarithm) * strength;
        let (mut sum, mut slope) = (0.0, 0.0);
        for (count, depth) in cells.each() {
            let through = exp(-c * depth);
            sum += count * (1.0 - through);
            slope += count * c * depth * through;
        }
        // Newton's step, no longer than 1; none where nothing more can be taken away.
        let step = ((wanted - sum) / slope.max(1e-6 * (1.0 + wanted))).clamp(-1.0, 1.0);
        logarithm = (logarithm + step).clamp(-FURTHEST, FURTHEST);
        if step.abs() < 1e-3 {
            break;
        }
    }
    logarithm
}

/// The k-th of points spread evenly over a unit square: multiples of the powers of the plastic number.
pub(super) fn spread(k: usize) -> [f64; 2] {
    let part = |step: f64| {
        let x = 0.5 + step * k as f64;
        x - (x as u64) as f64
    };
    [part(0.754_877_666_246_692_8), part(0.569_840_290_998_053_2)]
}

/// A rectangle across a direction, before a grid and as wide as it, in sides of its cells.
pub(super) struct Plane {
    corner: Vector3<f64>,
    across: Vector3<f64>,
    down: Vector3<f64>,
    direction: [f64; 3],
    /// Its area, in squares of a side.
    pub area: f64,
}

impl Plane {
    pub fn across(grid: &Grid, direction: [f64; 3]) -> Self {
        let along = Vector3::from(direction);
        let [a, b] = square(along);
        let extent = Vector3::from(grid.extent);
        let middle = 0.5 * extent;
        let reach = |axis: &Vector3<f64>| 0.5 * axis.abs().dot(&extent);
        let (half, other) = (reach(&a), reach(&b));
        let corner = middle - along * (reach(&along) + 1.0) - a * half - b * other;
        Self {
            corner,
            across: a * (2.0 * half),
            down: b * (2.0 * other),
            direction,
            area: 4.0 * half * other,
        }
    }

    /// The ray through a place of it, each from 0 to 1.
    pub fn ray(&self, [u, v]: [f64; 2]) -> Ray {
        let origin = self.corner + self.across * u + self.down * v;
        Ray::new([origin.x, origin.y, origin.z], self.direction)
    }
}

/// Two directions square to one of length 1 and to each other.
fn square(along: Vector3<f64>) -> [Vector3<f64>; 2] {
    // The axis that it is least along.
    let least = if along.x.abs() < 0.6 { Vector3::x() } else { Vector3::y() };
    let a = along.cross(&least);
    let a = a / a.norm_squared().sqrt();
    [a, along.cross(&a)]
}

/// Products of six components, and peaks.
fn terms(direction: [f64; 3], normals: &[[f64; 3]; NORMALS]) -> [f64; TERMS] {
    let [x, y, z] = direction;
    let powers = |x: f64| {
        let mut powers = [1.0; 7];
        for k in 1..=6 {
            powers[k] = powers[k - 1] * x;
        }
        powers
    };
    let (x, y, z) = (powers(x), powers(y), powers(z));
    let mut terms = [0.0; TERMS];
    let mut at = 0;
    for i in 0..=6 {
        for j in 0..=6 - i {
            terms[at] = x[i] * y[j] * z[6 - i - j];
            at += 1;
        }
    }
    for normal in normals.iter().filter(|normal| **normal != [0.0; 3]) {
        let (normal, direction) = (Vector3::from(*normal), Vector3::from(direction));
        let cosine = normal.dot(&direction).abs();
        for width in WIDTHS {
            terms[at] = width / (width + cosine);
            at += 1;
        }
        let [a, b] = square(normal).map(|axis| axis.dot(&direction));
        let peak = AROUND / (AROUND + cosine);
        terms[at] = peak * (a * a - b * b);
        terms[at + 1] = peak * 2.0 * a * b;
        at += 2;
    }
    terms
}

type Matrix = [[f64; TERMS]; TERMS];

/// The lower triangle whose product with itself turned is the matrix.
fn cholesky(matrix: &Matrix) -> Matrix {
    let mut lower = [[0.0; TERMS]; TERMS];
    for i in 0..TERMS {
        for j in 0..=i {
            let rest = matrix[i][j] - (0..j).map(|k| lower[i][k] * lower[j][k]).sum::<f64>();
            lower[i][j] = if i == j { rest.max(1e-12).sqrt() } else { rest / lower[j][j] };
        }
    }
    lower
}

/// Solves for a right-hand side.
fn back(lower: &Matrix, mut x: [f64; TERMS]) -> [f64; TERMS] {
    for i in 0..TERMS {
        x[i] = (x[i] - (0..i).map(|k| lower[i][k] * x[k]).sum::<f64>()) / lower[i][i];
    }
    for i in (0..TERMS).rev() {
        x[i] = (x[i] - (i + 1..TERMS).map(|k| lower[k][i] * x[k]).sum::<f64>()) / lower[i][i];
    }
    x
}
