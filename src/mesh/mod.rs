//! Triangle meshes, and the files that other programs open: PLY, OBJ and glTF.
//!
//! Right-handed, y up, metres, as glTF has it; triangles are wound anticlockwise seen from outside.

mod gltf;
mod obj;
mod ply;

pub use gltf::{Motion, Part, glb};
pub use obj::obj;
pub use ply::ply;

/// A mesh of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners, m.
    pub points: Vec<[f32; 3]>,
    /// The direction outwards in each corner, of length 1.
    pub normals: Vec<[f32; 3]>,
    /// Corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// A round stick along +y from the origin, its radius changing evenly; ends are flat. At least three sides are
    /// taken.
    pub fn stick(length: f64, radius: [f64; 2], sides: u32) -> Self {
        let sides = sides.max(3);
        let mut mesh = Self::default();
        // The side leans outwards where the stick gets thinner.
        let slope = (radius[0] - radius[1]) / length;
        let flat = 1.0 / libm::sqrt(1.0 + slope * slope);
        let ring: Vec<(f64, f64)> = (0..sides)
            .map(|k| libm::sincos(2.0 * std::f64::consts::PI * f64::from(k) / f64::from(sides)))
            .collect();
        let narrow = |point: [f64; 3]| point.map(|x| x as f32);
        for (y, r) in [(0.0, radius[0]), (length, radius[1])] {
            for (sine, cosine) in &ring {
                mesh.points.push(narrow([r * cosine, y, r * sine]));
                mesh.normals.push(narrow([flat * cosine, flat * slope, flat * sine]));
            }
        }
        for k in 0..sides {
            let next = (k + 1) % sides;
            mesh.triangles.extend([[k, k + sides, next], [next, k + sides, next + sides]]);
        }
        for (y, r, up) in [(0.0, radius[0], -1.0), (length, radius[1], 1.0)] {
            let first = mesh.points.len() as u32;
            for (sine, cosine) in &ring {
                mesh.points.push(narrow([r * cosine, y, r * sine]));
                mesh.normals.push(narrow([0.0, up, 0.0]));
            }
            for k in 1..sides - 1 {
                mesh.triangles.push(if up < 0.0 {
                    [first, first + k, first + k + 1]
                } else {
                    [first, first + k + 1, first + k]
                });
            }
        }
        mesh
    }

    /// Adds another mesh, turned by a quaternion (x, y, z, w) and then moved.
    pub fn add(&mut self, other: &Self, translation: [f64; 3], rotation: [f64; 4]) {
        let first = self.points.len() as u32;
        let turn = nalgebra::UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(
            rotation[3],
            rotation[0],
            rotation[1],
            rotation[2],
        ));
        let wide = |point: &[f32; 3]| nalgebra::Vector3::from(point.map(f64::from));
        let narrow = |v: nalgebra::Vector3<f64>| [v.x as f32, v.y as f32, v.z as f32];
        let moved = nalgebra::Vector3::from(translation);
        self.points.extend(other.points.iter().map(|point| narrow(turn * wide(point) + moved)));
        self.normals.extend(other.normals.iter().map(|normal| narrow(turn * wide(normal))));
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|corner| corner + first)));
    }
}

/// The turn about z that takes +y to a direction in the plane, as a quaternion (x, y, z, w); none for no direction.
pub fn turn_in_plane(x: f64, y: f64) -> [f64; 4] {
    let size = libm::sqrt(x * x + y * y);
    if size == 0.0 {
        return [0.0, 0.0, 0.0, 1.0];
    }
    // Half the angle from +y, anticlockwise: cos a = y, sin a = -x.
    let w = libm::sqrt((0.5 * (1.0 + y / size)).max(0.0));
    let z = libm::sqrt((0.5 * (1.0 - y / size)).max(0.0));
    [0.0, 0.0, if x > 0.0 { -z } else { z }, w]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// Volume by the divergence theorem.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |c: u32| nalgebra::Vector3::from(mesh.points[c as usize].map(f64::from));
        mesh.triangles.iter().map(|[a, b, c]| corner(*a).dot(&corner(*b).cross(&corner(*c))) / 6.0).sum()
    }

    #[test]
    fn a_stick_is_closed_and_has_its_volume() {
        let (length, [a, b], sides) = (2.0, [0.3, 0.1], 12_u32);
        let stick = Mesh::stick(length, [a, b], sides);
        let polygon = 0.5 * f64::from(sides) * libm::sin(2.0 * std::f64::consts::PI / f64::from(sides));
        let exact = polygon * length * (a * a + a * b + b * b) / 3.0;
        assert!((volume(&stick) / exact - 1.0).abs() < 1e-6, "{} {exact}", volume(&stick));
        let mut edges = BTreeMap::new();
        let key = |c: u32| stick.points[c as usize].map(f32::to_bits);
        for [a, b, c] in &stick.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((key(*from), key(*to))).or_insert(0) += 1;
                *edges.entry((key(*to), key(*from))).or_insert(0) -= 1;
            }
        }
        assert!(edges.values().all(|count| *count == 0), "each edge has its opposite");
        for ([x, y, z], [nx, ny, nz]) in stick.points.iter().zip(&stick.normals) {
            assert!(((nx * nx + ny * ny + nz * nz) - 1.0).abs() < 1e-6);
            assert!(x * nx + z * nz + (y - 1.0) * ny > 0.0, "outwards");
        }
    }

    #[test]
    fn a_turn_takes_up_to_its_direction() {
        for degrees in (-180..=180).step_by(15) {
            let (x, y) = libm::sincos(f64::from(degrees).to_radians());
            let mut mesh = Mesh::default();
            let up =
                Mesh { points: vec![[0.0, 2.0, 0.0]], normals: vec![[0.0, 1.0, 0.0]], triangles: vec![] };
            mesh.add(&up, [1.0, 0.0, 0.0], turn_in_plane(x, y));
            let [px, py, pz] = mesh.points[0].map(f64::from);
            assert!(
                (px - 1.0 - 2.0 * x).abs() < 1e-6 && (py - 2.0 * y).abs() < 1e-6 && pz.abs() < 1e-6,
                "{degrees}"
            );
        }
    }
}
