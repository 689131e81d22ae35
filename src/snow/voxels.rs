//! From cells to voxels: Eq. (7) and (12) to (15).
//!
//! A crystal grows on hexagonal cells; last of all it becomes cubic elements of side b_min, and these are counted in
//! voxels of side b_v. An element is ice if its centre lies in a cell of ice.

use nalgebra::{Isometry3, Point3};

use super::{Crystal, SnowError, within};
use crate::hexgrid::Axial;

/// The most voxels that are handled.
pub const MOST_VOXELS: usize = 1 << 27;

/// The cubic elements of a crystal: v(x, y, z) = 1 of Eq. (7).
#[derive(Clone, Debug, PartialEq)]
pub struct Cubes {
    side: f64,
    places: Vec<[i32; 3]>,
}

impl Cubes {
    /// The elements of a crystal, `parts` of them along the spacing of its cells: an odd number, so that one of them lies in
    /// the crystal's middle and layers meet between them. The first arm is along x.
    ///
    /// # Errors
    ///
    /// `parts` not 1, 3, 5 or 7.
    pub fn new(crystal: &Crystal, parts: u32) -> Result<Self, SnowError> {
        if !matches!(parts, 1 | 3 | 5 | 7) {
            return Err(SnowError::Parts(parts));
        }
        let n = f64::from(parts);
        let radius = crystal.radius();
        let reach = (radius + 1) * parts as i32;
        let top = (crystal.layers().len() as i32 - 1) * parts as i32 + parts as i32 / 2;
        let mut places = Vec::new();
        for y in -reach..=reach {
            for x in -reach..=reach {
                // Some centres lie between two cells: as mirror images all are of the same one.
                let at = Axial::containing(nalgebra::point![f64::from(x.abs()) / n, f64::from(y.abs()) / n]);
                if super::twelfth::steps_out(at) > radius {
                    continue;
                }
                for z in -top..=top {
                    let layer = libm::round(f64::from(z) / n) as i32;
                    if crystal.is_ice(at, layer) {
                        places.push([x, y, z]);
                    }
                }
            }
        }
        Ok(Self { side: crystal.element() / n, places })
    }

    /// b_min, m.
    pub fn side(&self) -> f64 {
        self.side
    }

    /// Centres of the elements, in sides.
    pub fn places(&self) -> &[[i32; 3]] {
        &self.places
    }

    /// M_i of Eq. (14).
    pub fn count(&self) -> usize {
        self.places.len()
    }

    /// The centre of an element in a crystal so posed, m.
    pub fn centre(&self, place: [i32; 3], pose: &Isometry3<f64>) -> Point3<f64> {
        pose * Point3::from(place.map(|along| f64::from(along) * self.side))
    }
}

/// Elements counted in voxels.
#[derive(Clone, Debug, PartialEq)]
pub struct Voxels {
    counts: [usize; 3],
    origin: [f64; 3],
    side: f64,
    capacity: u32,
    elements: Vec<u32>,
}

impl Voxels {
    /// Counts crystals, each posed by an isometry in m, into voxels of `per_side` elements along each side. All must have
    /// elements of one side.
    ///
    /// An element is counted where its centre is. The grid is that of the first crystal's elements if its pose is the
    /// identity: then no voxel holds more of it than (b_v / b_min)^3.
    ///
    /// # Errors
    ///
    /// No element at all; elements of several sides; `per_side` not 1 to 1000; more than [`MOST_VOXELS`].
    pub fn new(crystals: &[(&Cubes, Isometry3<f64>)], per_side: u32) -> Result<Self, SnowError> {
        within("the number of elements along a voxel", f64::from(per_side), 1.0, 1000.0)?;
        let b_min = crystals.first().map_or(0.0, |(cubes, _)| cubes.side);
        if crystals.iter().any(|(cubes, _)| cubes.side != b_min) {
            return Err(SnowError::Sides);
        }
        // Where centres are, in elements: rounded to one part in 2^20, so that what lies on a grid lies on it exactly.
        let mut places = Vec::with_capacity(crystals.iter().map(|(cubes, _)| cubes.count()).sum());
        for (cubes, pose) in crystals {
            for place in &cubes.places {
                let centre = cubes.centre(*place, pose);
                places.push(
                    [centre.x, centre.y, centre.z]
                        .map(|along| libm::floor(libm::round(along / b_min * FINE) / FINE + 0.5) as i64),
                );
            }
        }
        let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
        for place in &places {
            for axis in 0..3 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
        }
        if places.is_empty() {
            return Err(SnowError::NoElements);
        }
        let per = i64::from(per_side);
        let counts = [0, 1, 2].map(|axis| ((high[axis] - low[axis]) / per + 1) as usize);
        let number = counts.iter().fold(1_usize, |product, count| product.saturating_mul(*count));
        within("the number of voxels", number as f64, 1.0, MOST_VOXELS as f64)?;
        let mut elements = vec![0; number];
        for place in places {
            let at = [0, 1, 2].map(|axis| ((place[axis] - low[axis]) / per) as usize);
            elements[(at[2] * counts[1] + at[1]) * counts[0] + at[0]] += 1;
        }
        let origin = low.map(|low| (low as f64 - 0.5) * b_min);
        let side = b_min * f64::from(per_side);
        Ok(Self { counts, origin, side, capacity: per_side * per_side * per_side, elements })
    }

    /// Voxels along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// The lowest corner, m.
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// b_v, m.
    pub fn side(&self) -> f64 {
        self.side
    }

    /// (b_v / b_min)^3.
    pub fn capacity(&self) -> u32 {
        self.capacity
    }

    /// b_s of each voxel, Eq. (13): its elements; x fastest, then y.
    pub fn elements(&self) -> &[u32] {
        &self.elements
    }

    /// How many elements are more than their voxels hold: none of a crystal on its own grid. Turned elements lie on no
    /// grid, and a voxel may get some too many.
    pub fn overfull(&self) -> u64 {
        self.elements.iter().map(|count| u64::from(count.saturating_sub(self.capacity))).sum()
    }

    /// How many pieces there are: voxels with elements that touch by a face, an edge or a corner are of one piece.
    pub fn pieces(&self) -> usize {
        let [nx, ny, nz] = self.counts;
        let mut seen = vec![false; self.elements.len()];
        let mut pieces = 0;
        for first in 0..seen.len() {
            if seen[first] || self.elements[first] == 0 {
                continue;
            }
            pieces += 1;
            seen[first] = true;
            let mut stack = vec![first];
            while let Some(at) = stack.pop() {
                let [x, y, z] = [at % nx, at / nx % ny, at / (nx * ny)];
                for k in z.saturating_sub(1)..=(z + 1).min(nz - 1) {
                    for j in y.saturating_sub(1)..=(y + 1).min(ny - 1) {
                        for i in x.saturating_sub(1)..=(x + 1).min(nx - 1) {
                            let near = (k * ny + j) * nx + i;
                            if !seen[near] && self.elements[near] > 0 {
                                seen[near] = true;
                                stack.push(near);
                            }
                        }
                    }
                }
            }
        }
        pieces
    }

    /// rho of each voxel, Eq. (12), from 0 to 1: a full voxel holds no more.
    pub fn density(&self) -> Vec<f32> {
        let full = f64::from(self.capacity);
        self.elements.iter().map(|count| (f64::from((*count).min(self.capacity)) / full) as f32).collect()
    }
}

/// Parts of an element to which centres are rounded.
const FINE: f64 = (1 << 20) as f64;

#[cfg(test)]
mod tests {
    use super::super::{Branching, History, Layers, Parameters};
    use super::*;
    use crate::rng::Seed;

    fn crystal() -> Crystal {
        let branching = Branching::new(&Parameters::ASSUMED).unwrap();
        let history = History::saturated(-15.0, 6.0).unwrap();
        Crystal::grow(&history, &branching, Layers::Dense, Seed(2)).unwrap()
    }

    /// The check of the readings: sum of rho b_v^3 = number of elements, in whole numbers; rho from 0 to 1.
    #[test]
    fn no_element_is_lost_and_no_voxel_is_overfull() {
        let cubes = Cubes::new(&crystal(), 1).unwrap();
        for per_side in [1, 2, 3, 4, 7] {
            let voxels = Voxels::new(&[(&cubes, Isometry3::identity())], per_side).unwrap();
            let sum: u64 = voxels.elements().iter().map(|count| u64::from(*count)).sum();
            assert_eq!(sum, cubes.count() as u64, "{per_side}");
            assert_eq!(voxels.overfull(), 0, "{per_side}");
            assert!(voxels.density().iter().all(|rho| (0.0..=1.0).contains(rho)));
        }
        let apart = Isometry3::translation(0.01, 0.0, 0.0);
        let two = Voxels::new(&[(&cubes, Isometry3::identity()), (&cubes, apart)], 4).unwrap();
        assert_eq!(two.pieces(), 2);
        let finest = Voxels::new(&[(&cubes, Isometry3::identity())], 1).unwrap();
        assert!(finest.elements().iter().all(|count| *count <= 1));
    }

    /// A cell has 0.866 of the area of a square on its spacing. With 7 elements along it, a cell whose middle is that of an
    /// element gets 41 of 42.4 of them, 3 % too few, and others are met as they come: 2 %.
    #[test]
    fn elements_have_the_crystals_volume() {
        let crystal = crystal();
        let cubes = Cubes::new(&crystal, 7).unwrap();
        let expected = crystal.count() as f64 * crate::hexgrid::ROW_HEIGHT * 343.0;
        let found = cubes.count() as f64;
        assert!((found / expected - 1.0).abs() < 0.02, "{found} for {expected}");
    }

    #[test]
    fn turned_elements_are_all_counted() {
        let cubes = Cubes::new(&crystal(), 1).unwrap();
        let turn = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(0.9, 0.3, -0.2, 0.4));
        let pose = Isometry3::from_parts(nalgebra::Translation3::new(1e-3, 2e-5, -3e-4), turn);
        let voxels = Voxels::new(&[(&cubes, pose)], 4).unwrap();
        let sum: u64 = voxels.elements().iter().map(|count| u64::from(*count)).sum();
        assert_eq!(sum, cubes.count() as u64);
        assert!(voxels.overfull() < sum / 50);
        let rho: f64 = voxels.density().iter().map(|rho| f64::from(*rho)).sum();
        assert!((rho * 64.0 - (sum - voxels.overfull()) as f64).abs() < 1e-6 * sum as f64);
    }

    #[test]
    fn what_is_no_grid_is_refused() {
        let cubes = Cubes::new(&crystal(), 1).unwrap();
        let far = Isometry3::translation(10.0, 10.0, 10.0);
        assert_eq!(Voxels::new(&[], 1), Err(SnowError::NoElements));
        assert!(Voxels::new(&[(&cubes, far), (&cubes, Isometry3::identity())], 1).is_err());
        let fine = Cubes::new(&crystal(), 3).unwrap();
        assert_eq!(Voxels::new(&[(&cubes, far), (&fine, far)], 1), Err(SnowError::Sides));
        assert_eq!(Cubes::new(&crystal(), 2), Err(SnowError::Parts(2)));
    }
}
