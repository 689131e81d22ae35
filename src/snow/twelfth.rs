//! A layer with the symmetry of a hexagon, kept as one twelfth of it.
//!
//! Condition 3 of §1.1.3 has both sides alike and Eq. (10) six directions alike: turns by 60 degrees and mirrors make
//! twelve cells of one. The lattice is hexagonal since sin 60 is irrational: on a cubic one no crystal is six-fold.

use crate::hexgrid::Axial;

/// The cell of the twelfth 0 <= r <= q that turns and mirrors bring to this one.
pub fn representative(at: Axial) -> Axial {
    // Turns and mirrors permute the three cube coordinates and change all their signs; the largest is the sum of the others.
    let (q, r) = (at.q.unsigned_abs(), at.r.unsigned_abs());
    let s = at.q.wrapping_add(at.r).unsigned_abs();
    let most = q.max(r).max(s);
    let least = q.min(r).min(s);
    Axial::new((most - least) as i32, least as i32)
}

/// All cells that turns and mirrors make of one: 1, 6 or 12.
pub fn images(at: Axial) -> impl Iterator<Item = Axial> {
    let at = representative(at);
    let turns = if at.q == 0 { 1 } else { 6 };
    let mirrors = if at.r == 0 || at.r == at.q { 1 } else { 2 };
    (0..turns).flat_map(move |turn| {
        let turned = (0..turn).fold(at, |at, _| at.rotated());
        [turned, turned.mirrored()].into_iter().take(mirrors)
    })
}

/// How many cells turns and mirrors make of this one.
pub(super) fn multiplicity(at: Axial) -> usize {
    match (at.q, at.r) {
        (0, _) => 1,
        (q, r) if r == 0 || r == q => 6,
        _ => 12,
    }
}

/// Steps from the centre to a cell.
pub(super) fn steps_out(at: Axial) -> i32 {
    at.q.abs().max(at.r.abs()).max((at.q + at.r).abs())
}

/// No time: the cell is empty.
const NEVER: u32 = u32::MAX;

/// The cells of one layer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    // By q (q + 1) / 2 + r.
    born: Vec<u32>,
    branched: Vec<bool>,
    progress: Vec<f32>,
    // Cells between it and the tip's path that it grew sideways from.
    depth: Vec<u16>,
    reach: i32,
}

fn index(at: Axial) -> usize {
    let (q, r) = (at.q as usize, at.r as usize);
    q * (q + 1) / 2 + r
}

impl Layer {
    /// Whether a cell, of whichever twelfth, is ice.
    pub fn is_ice(&self, at: Axial) -> bool {
        self.born(at).is_some()
    }

    /// The step in which a cell became ice; none if it is empty.
    pub fn born(&self, at: Axial) -> Option<u32> {
        self.born.get(index(representative(at))).copied().filter(|born| *born != NEVER)
    }

    /// Whether a branch began in a cell.
    pub fn is_branched(&self, at: Axial) -> bool {
        self.branched.get(index(representative(at))).copied().unwrap_or(false)
    }

    /// No cell of the layer has a greater q in its twelfth.
    pub(super) fn reach(&self) -> i32 {
        self.reach
    }

    pub(super) fn set(&mut self, at: Axial, step: u32) {
        let place = self.place(at);
        if self.born[place] == NEVER {
            self.born[place] = step;
        }
    }

    pub(super) fn set_branched(&mut self, at: Axial) {
        let place = self.place(at);
        self.branched[place] = true;
    }

    /// How many cells lie between a cell and the path of the tip that it grew sideways from.
    pub(super) fn depth(&self, at: Axial) -> u16 {
        self.depth.get(index(representative(at))).copied().unwrap_or(0)
    }

    pub(super) fn set_depth(&mut self, at: Axial, depth: u16) {
        let place = self.place(at);
        self.depth[place] = depth;
    }

    /// Adds to how far a cell has been grown over from its sides, and gives the sum.
    pub(super) fn press(&mut self, at: Axial, by: f32) -> f32 {
        let place = self.place(at);
        self.progress[place] += by;
        self.progress[place]
    }

    fn place(&mut self, at: Axial) -> usize {
        let at = representative(at);
        let place = index(at);
        if place >= self.born.len() {
            let length = index(Axial::new(at.q + at.q / 2 + 4, 0));
            self.born.resize(length, NEVER);
            self.branched.resize(length, false);
            self.progress.resize(length, 0.0);
            self.depth.resize(length, 0);
        }
        self.reach = self.reach.max(at.q);
        place
    }

    /// The cells of ice of the twelfth, by q, then r.
    pub(super) fn twelfth(&self) -> impl Iterator<Item = Axial> {
        (0..=self.reach)
            .flat_map(|q| (0..=q).map(move |r| Axial::new(q, r)))
            .filter(|at| self.born.get(index(*at)).is_some_and(|born| *born != NEVER))
    }

    /// All cells of ice.
    pub fn cells(&self) -> impl Iterator<Item = Axial> {
        self.twelfth().flat_map(images)
    }

    /// How many cells are ice.
    pub fn count(&self) -> usize {
        self.twelfth().map(multiplicity).sum()
    }

    /// The share of ice among the 18 cells at most two steps from one, itself not counted.
    pub fn density(&self, at: Axial) -> f64 {
        let mut ice = 0_u32;
        for q in -2_i32..=2 {
            for r in (-2).max(-2 - q)..=2.min(2 - q) {
                ice += u32::from(self.is_ice(Axial::new(at.q + q, at.r + r)));
            }
        }
        f64::from(ice - u32::from(self.is_ice(at))) / 18.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn twelve_cells_have_one_representative() {
        for q in -9..=9 {
            for r in -9..=9 {
                let at = Axial::new(q, r);
                let found = representative(at);
                assert!(0 <= found.r && found.r <= found.q, "{at:?}: {found:?}");
                assert_eq!(found.norm(), at.norm());
                assert_eq!(representative(at.rotated()), found);
                assert_eq!(representative(at.mirrored()), found);
                assert_eq!(representative(found), found);
            }
        }
    }

    #[test]
    fn images_are_a_hexagons_orbit() {
        let mut seen = BTreeSet::new();
        for q in 0..=9 {
            for r in 0..=q {
                let at = Axial::new(q, r);
                let images: Vec<Axial> = images(at).collect();
                assert_eq!(images.len(), multiplicity(at));
                for image in images {
                    assert_eq!(representative(image), at);
                    assert!(seen.insert(image), "{image:?} twice");
                }
            }
        }
        assert!(seen.iter().filter(|at| steps_out(**at) <= 6).count() == 3 * 6 * 7 + 1);
    }

    #[test]
    fn density_counts_two_rings() {
        let mut layer = Layer::default();
        layer.set(Axial::new(1, 0), 0);
        assert_eq!(layer.density(Axial::ORIGIN), 6.0 / 18.0);
        assert_eq!(layer.density(Axial::new(1, 0)), 5.0 / 18.0);
        assert_eq!(layer.count(), 6);
        assert_eq!(layer.born(Axial::new(0, -1)), Some(0));
        assert!(!layer.is_ice(Axial::ORIGIN));
    }
}
