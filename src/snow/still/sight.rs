//! A body lit and seen: Eq. (11) and (16), exact for each cell.

use crate::volume::{Himeno, exp, mean};

use super::dots::{Dot, Part};
use super::fit::{Plane, spread};
use super::grid::{Cell, Grid, Met, Ray};

/// What is behind less transmittance than this is not asked for.
pub(super) const CUTOFF: f64 = 1e-4;
/// Its optical depth.
const DEEP: f64 = 9.3;
/// Optical depth towards the light beyond which there is none.
const DARK: f64 = 30.0;

/// The most rays for the parts of a flake that is laid down.
const MOST_RAYS: usize = 40_000;

/// What a ray brings: light that is reflected, of I_0 = 1, and the share of what is behind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    pub lit: f64,
    pub transmittance: f64,
}

impl Seen {
    pub const NOTHING: Self = Self { lit: 0.0, transmittance: 1.0 };

    /// This before another.
    #[inline]
    pub fn before(self, other: Self) -> Self {
        Self {
            lit: self.lit + self.transmittance * other.lit,
            transmittance: self.transmittance * other.transmittance,
        }
    }
}

/// A level of a body, of one size, with light from one side.
#[derive(Clone, Debug)]
pub(super) struct Lit<'a> {
    grid: &'a Grid,
    himeno: &'a Himeno,
    /// What depths of cells are multiplied by along the view, and towards the light.
    view: f64,
    light: f64,
    /// Where the light is, seen from the body.
    to_light: [f64; 3],
    inverse: [f64; 3],
    squares: [f64; 3],
    /// The share of light that comes to the box of a cell, for each.
    outside: Vec<f32>,
}

impl<'a> Lit<'a> {
    /// Works out the light. `view` and `light` multiply optical depths of cells.
    pub fn new(grid: &'a Grid, himeno: &'a Himeno, view: f64, light: f64, to_light: [f64; 3]) -> Self {
        use rayon::prelude::*;
        let ray = Ray::new([0.0; 3], to_light);
        let mut lit = Self {
            grid,
            himeno,
            view,
            light,
            to_light: ray.direction,
            inverse: ray.inverse,
            squares: ray.squares(),
            outside: Vec::new(),
        };
        let number = grid.cells.len();
        lit.outside = if number > 4096 {
            (0..number).into_par_iter().with_min_len(512).map(|cell| lit.reaching(cell)).collect()
        } else {
            (0..number).map(|cell| lit.reaching(cell)).collect()
        };
        lit
    }

    /// The share of light that comes to a cell's box, on the line to the light through the box's middle.
    fn reaching(&self, number: usize) -> f32 {
        let place = self.grid.places[number].map(f64::from);
        let [low, high] = self.grid.within(&self.grid.cells[number], place);
        let middle = [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]));
        let ray = Ray { origin: middle, direction: self.to_light, inverse: self.inverse };
        let mut depth = 0.0;
        self.grid.walk(&ray, |met| {
            if met.number != number {
                depth += self.light * met.cell.along(self.squares) * (met.to - met.from);
            }
            depth > DARK
        });
        exp(-depth) as f32
    }

    /// Optical depth towards the light that lies within a cell's box, from a place in it.
    #[inline(always)]
    fn inside(&self, met: &Met, per_side: f64, place: [f64; 3]) -> f64 {
        let ways = [0, 1, 2].map(|axis| {
            let plane = if self.inverse[axis] > 0.0 { met.high[axis] } else { met.low[axis] };
            (plane - place[axis]) * self.inverse[axis]
        });
        let way = ways[0].min(ways[1]).min(ways[2]);
        per_side * way.max(0.0)
    }

    /// What is seen along a ray in sides of a cell; cells are counted.
    #[inline]
    pub fn see(&self, ray: &Ray, cells: &mut u64) -> Seen {
        let squares = ray.squares();
        let (mut depth, mut transmittance, mut lit) = (0.0, 1.0, 0.0);
        self.grid.walk(ray, |met| {
            *cells += 1;
            let part = self.view * met.cell.along(squares) * (met.to - met.from);
            let through = exp(-part);
            let taken = 1.0 - through;
            // Where it is seen, on average.
            let share = if part < 1e-3 { 0.5 } else { 1.0 / part - through / taken };
            let gradient =
                gradient(met.cell, met.low, met.high, ray.at(met.from + (met.to - met.from) * share));
            let strength = self.himeno.reflected(gradient, ray.direction, self.to_light);
            if strength > 0.0 {
                // Along the ray depths from the eye and from the light both change evenly: the integral of their
                // exponential is exact.
                let per_side = self.light * met.cell.along(self.squares);
                let [near, far] = [met.from, met.to].map(|t| self.inside(met, per_side, ray.at(t)));
                let far = part + far;
                let arrives = part * mean(exp(-near), exp(-far), near, far);
                // Of a cell no more than it takes away, up to rounding.
                lit += transmittance * strength * f64::from(self.outside[met.number]) * arrives.min(taken);
            }
            depth += part;
            transmittance *= through;
            depth > DEEP
        });
        Seen { lit, transmittance }
    }

    /// The flake seen along a direction, in square parts of side `side`, or as one part without `reach`, the largest distance
    /// of a part from the centre. `place` says where in the picture's plane a place of the grid is seen, m; `by` is what an
    /// area across the direction, in squares of a cell's side, is in that plane.
    pub fn parts(
        &self,
        direction: [f64; 3],
        place: impl Fn([f64; 3]) -> [f64; 2],
        by: f64,
        side: f64,
        reach: Option<f64>,
    ) -> Dot {
        let plane = Plane::across(self.grid, direction);
        // What is less than a pixel need not be known as well.
        let (per_cell, least) = if reach.is_some() { (16.0, 6144) } else { (4.0, 64) };
        let rays = ((per_cell * plane.area) as usize).clamp(least, MOST_RAYS);
        let across = reach.map_or(1, |reach| (2.0 * reach / side) as usize + 1);
        let first = -0.5 * side * across as f64;
        let mut sums = vec![[0.0; 4]; across * across];
        let mut cells = 0;
        for k in 0..rays {
            let ray = plane.ray(spread(k));
            let seen = self.see(&ray, &mut cells);
            if seen.transmittance < 1.0 {
                let taken = 1.0 - seen.transmittance;
                let at = place(ray.origin);
                let cell = at.map(|x| (((x - first) / side).max(0.0) as usize).min(across - 1));
                let sum = &mut sums[cell[1] * across + cell[0]];
                for (sum, value) in sum.iter_mut().zip([taken, seen.lit, taken * at[0], taken * at[1]]) {
                    *sum += value;
                }
            }
        }
        let by = by * plane.area / rays as f64;
        let parts: Vec<Part> = sums
            .iter()
            .filter(|[taken, ..]| *taken > 0.0)
            .map(|[taken, lit, x, y]| Part { at: [x / taken, y / taken], area: taken * by, lit: lit * by })
            .collect();
        Dot { parts, side, reach: reach.unwrap_or(0.0).max(side) }
    }
}

/// The gradient of density at a place of a box: from its lower sides to its higher ones it goes from what changes there to
/// what changes here, as that of a trilinear density does.
#[inline(always)]
fn gradient(cell: &Cell, low: [f64; 3], high: [f64; 3], place: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let [lower, higher] = cell.slopes[axis].map(f64::from);
        let at = ((place[axis] - low[axis]) / (high[axis] - low[axis])).clamp(0.0, 1.0);
        lower + (higher - lower) * at
    })
}

#[cfg(test)]
mod tests {
    use super::super::Body;
    use super::*;

    /// Within a block light is taken away by what is above, to the rounding of f32.
    #[test]
    fn light_comes_through_what_is_above() {
        let body = Body::of_density([6, 5, 8], 20e-6, &[0.4; 240], 1e4).unwrap();
        let (grid, _) = &body.levels[0];
        let himeno = Himeno {
            diffuse: 1.0,
            specular: 0.0,
            power: 1,
            ambient: 0.0,
            to_light: [0.0, 0.0, 1.0],
            light: [1.0; 3],
            ambient_light: [0.0; 3],
        };
        let lit = Lit::new(grid, &himeno, 1.0, 1.0, himeno.to_light);
        for (number, place) in grid.places.iter().enumerate() {
            let known = exp(-0.08 * f64::from(7 - place[2]));
            assert!((f64::from(lit.outside[number]) / known - 1.0).abs() < 1e-6, "{place:?}");
        }
    }
}
