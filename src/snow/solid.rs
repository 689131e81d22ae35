//! A crystal as a mesh, and as a map of how thick it is.

use std::collections::BTreeMap;

use crate::hexgrid::{Axial, STEPS};
use crate::mesh::Mesh;

use super::Crystal;

/// Corner `k` of a cell lies in the direction of 60 k + 30 degrees, at 1/sqrt 3 of the spacing; its side `k` faces step
/// `k`. These are sines and cosines of 30, 90, ... degrees over sqrt 3.
const CORNERS: [[f64; 2]; 6] =
    [[0.5, SIXTH], [0.0, 2.0 * SIXTH], [-0.5, SIXTH], [-0.5, -SIXTH], [0.0, -2.0 * SIXTH], [0.5, -SIXTH]];
/// 1 / (2 sqrt 3).
const SIXTH: f64 = 0.288_675_134_594_812_9;

impl Crystal {
    /// The surface of the crystal: cells as hexagonal prisms, of which sides that touch ice are left out. The crystal's z
    /// axis is the mesh's y, upwards; the first arm is along x.
    pub fn mesh(&self) -> Mesh {
        let mut mesh = Mesh::default();
        let top = self.layers().len() as i32 - 1;
        let runs = |of: &dyn Fn(i32) -> bool| {
            let mut runs: Vec<[i32; 2]> = Vec::new();
            for z in (-top..=top).filter(|z| of(*z)) {
                match runs.last_mut() {
                    Some(run) if run[1] == z => run[1] = z + 1,
                    _ => runs.push([z, z + 1]),
                }
            }
            runs
        };
        let mut cells: Vec<Axial> = self.layers().iter().flat_map(|layer| layer.cells()).collect();
        cells.sort_unstable();
        cells.dedup();
        for at in cells {
            for run in runs(&|z| self.is_ice(at, z)) {
                self.add_end(&mut mesh, at, run[1], 1.0);
                self.add_end(&mut mesh, at, run[0], -1.0);
            }
            for (side, (dq, dr)) in STEPS.into_iter().enumerate() {
                let beside = Axial::new(at.q + dq, at.r + dr);
                for run in runs(&|z| self.is_ice(at, z) && !self.is_ice(beside, z)) {
                    self.add_side(&mut mesh, at, side, run);
                }
            }
        }
        mesh
    }

    /// Corner of a cell, at the lower face of layer `z`, in the mesh's axes, m. The lattice's y runs down, that is to +z.
    fn corner(&self, at: Axial, corner: usize, z: i32) -> [f32; 3] {
        let [x, y] = CORNERS[corner % 6];
        let place = at.position();
        [place.x + x, f64::from(z) - 0.5, place.y + y].map(|along| (along * self.element()) as f32)
    }

    fn add_end(&self, mesh: &mut Mesh, at: Axial, z: i32, up: f32) {
        let first = mesh.points.len() as u32;
        for k in 0..6 {
            mesh.points.push(self.corner(at, k, z));
            mesh.normals.push([0.0, up, 0.0]);
        }
        // Corners turn from +x to +z, which seen from above is clockwise.
        for k in 1..5 {
            let (j, k) = if up > 0.0 { (k + 1, k) } else { (k, k + 1) };
            mesh.triangles.push([first, first + j, first + k]);
        }
    }

    fn add_side(&self, mesh: &mut Mesh, at: Axial, side: usize, run: [i32; 2]) {
        let first = mesh.points.len() as u32;
        // Side k is between corners k - 1 and k.
        let ends = [side + 5, side];
        let normal = Axial::new(STEPS[side].0, STEPS[side].1).position();
        for z in run {
            for end in ends {
                mesh.points.push(self.corner(at, end, z));
                mesh.normals.push([normal.x as f32, 0.0, normal.y as f32]);
            }
        }
        mesh.triangles.extend([[first, first + 2, first + 1], [first + 1, first + 2, first + 3]]);
    }

    /// Elements of ice over and under each other at every cell that has any, in page order: its relief.
    pub fn thickness_map(&self) -> BTreeMap<Axial, usize> {
        let mut map = BTreeMap::new();
        for (number, layer) in self.layers().iter().enumerate() {
            for at in layer.cells() {
                *map.entry(at).or_insert(0) += if number == 0 { 1 } else { 2 };
            }
        }
        map
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Branching, Crystal, History, Layers, Parameters};
    use crate::rng::Seed;

    /// By the divergence theorem a closed mesh, wound outwards, has the volume of its cells. Corners have single precision:
    /// 1e-4.
    #[test]
    fn the_mesh_is_closed_and_holds_the_elements() {
        let branching = Branching::new(&Parameters { element: 20e-6, ..Parameters::ASSUMED }).unwrap();
        for history in [History::saturated(-15.0, 8.0).unwrap(), History::capped_column()] {
            let crystal = Crystal::grow(&history, &branching, Layers::Dense, Seed(1)).unwrap();
            let mesh = crystal.mesh();
            let corner = |c: u32| nalgebra::Vector3::from(mesh.points[c as usize].map(f64::from));
            let volume: f64 = mesh
                .triangles
                .iter()
                .map(|[a, b, c]| corner(*a).dot(&corner(*b).cross(&corner(*c))) / 6.0)
                .sum();
            let expected = crystal.mass() / super::super::ICE;
            assert!((volume / expected - 1.0).abs() < 1e-4, "{volume} for {expected}");
            for [a, b, c] in &mesh.triangles {
                let across = (corner(*b) - corner(*a)).cross(&(corner(*c) - corner(*a)));
                let normal = nalgebra::Vector3::from(mesh.normals[*a as usize].map(f64::from));
                assert!(across.dot(&normal) > 0.0);
            }
            let map = crystal.thickness_map();
            assert_eq!(map.values().sum::<usize>(), crystal.count());
            assert!(map.iter().all(|(at, thickness)| crystal.thickness(*at) == *thickness));
        }
    }
}
