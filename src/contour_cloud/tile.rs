//! A piece divided level by level: every midpoint once, where depth first works it out from both sides of its edge.
//!
//! The corners are the same to the last bit. A tile of five levels stays in the first cache.

use super::surface::{Corner, Piece, Surface};

/// The lattice of corners of a divided piece, used again for the next.
#[derive(Clone, Debug)]
pub struct Tile {
    levels: u32,
    corners: Vec<Corner>,
    rows: Vec<usize>,
    /// Midpoints of the level at hand on edges parallel to ab, bc and ca, with the places of one kind and their numbers.
    targets: [Vec<usize>; 3],
    places: Vec<[f64; 2]>,
    numbers: Vec<f64>,
}

impl Tile {
    /// Room for a piece that is divided `levels` times.
    pub fn new(levels: u32) -> Self {
        let side = 1_usize << levels;
        // Row j holds the corners (i, j) with i + j <= side.
        let rows: Vec<usize> =
            (0..=side + 1).map(|j| j * (side + 1) - (j * j.saturating_sub(1)) / 2).collect();
        Self {
            levels,
            corners: vec![Corner::default(); rows[side + 1]],
            rows,
            targets: Default::default(),
            places: Vec::new(),
            numbers: Vec::new(),
        }
    }

    /// Divides a piece of division `n`. Each edge is displaced as often as it says and straight from there on.
    pub fn fill(&mut self, surface: &Surface, piece: &Piece, n: u32) {
        let side = 1_usize << self.levels;
        let [a, b, c] = piece.corners;
        // Where D is the same all over, so is what it makes of the length.
        let even = a.dimension == b.dimension && b.dimension == c.dimension;
        (self.corners[0], self.corners[side], self.corners[self.rows[side]]) = (a, b, c);
        for level in 0..self.levels {
            let n = n + level;
            let of_even = even.then(|| surface.displacement.relative(n, a.dimension));
            self.straight(side >> level);
            for (edge, targets) in piece.edges.iter().zip(&self.targets) {
                if n >= edge.levels {
                    continue;
                }
                self.places.clear();
                self.places.extend(targets.iter().map(|target| self.corners[*target].place));
                self.numbers.resize(targets.len(), 0.0);
                surface.displacement.moment.normals(&self.places, &mut self.numbers);
                for (target, number) in targets.iter().zip(&self.numbers) {
                    let corner = &mut self.corners[*target];
                    let relative =
                        of_even.unwrap_or_else(|| surface.displacement.relative(n, corner.dimension));
                    surface.displace(corner, relative, edge, *number);
                }
            }
        }
    }

    /// Puts undisplaced midpoints on all edges of this many steps, and lists them.
    fn straight(&mut self, step: usize) {
        let half = step / 2;
        let side = 1_usize << self.levels;
        self.targets.iter_mut().for_each(Vec::clear);
        for j in (0..side).step_by(step) {
            let (row, middle, above) = (self.rows[j], self.rows[j + half], self.rows[j + step]);
            for i in (0..side - j).step_by(step) {
                let corners = [self.corners[row + i], self.corners[row + i + step], self.corners[above + i]];
                let targets = [row + i + half, middle + i + half, middle + i];
                for k in 0..3 {
                    self.corners[targets[k]] = corners[k].midway(&corners[(k + 1) % 3]);
                    self.targets[k].push(targets[k]);
                }
            }
        }
    }

    /// Visits the triangles, row by row.
    pub fn triangles(&self, leaf: &mut impl FnMut(&[Corner; 3])) {
        let side = 1_usize << self.levels;
        for j in 0..side {
            let (row, above) = (&self.corners[self.rows[j]..], &self.corners[self.rows[j + 1]..]);
            for i in 0..side - j {
                leaf(&[row[i], row[i + 1], above[i]]);
                if i + 1 < side - j {
                    leaf(&[row[i + 1], above[i + 1], above[i]]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::surface::tests::quadrangle;
    use super::super::{Amplitude, EdgeLength, Levels};
    use super::*;

    #[test]
    fn it_has_the_triangles_of_depth_first_to_the_last_bit() {
        let surface = quadrangle(Amplitude::ThreeMinusD, EdgeLength::Original, 2.4);
        let mut tile = Tile::new(4);
        for levels in [[4, 4, 4], [4, 2, 3], [1, 4, 0]] {
            let mut piece = surface.piece(1, |_, _| 0);
            for (edge, levels) in piece.edges.iter_mut().zip(levels) {
                edge.levels = levels;
            }
            let key = |leaf: &[Corner; 3]| {
                let mut all = leaf.map(|corner| corner.point().map(f64::to_bits));
                all.sort_unstable();
                all
            };
            let (mut by_level, mut by_depth) = (Vec::new(), BTreeSet::new());
            tile.fill(&surface, &piece, 0);
            tile.triangles(&mut |leaf| by_level.push(key(leaf)));
            surface.visit(&piece, 0, &Levels, &|_| true, &mut |leaf| {
                by_depth.insert(key(leaf));
            });
            let unique: BTreeSet<_> = by_level.iter().copied().collect();
            assert_eq!((by_level.len(), unique.len()), (256, 256));
            assert_eq!(unique, by_depth);
        }
    }
}
