//! The surface as a mesh that other programs open.

use super::surface::{Corner, Surface};
use crate::mesh::Mesh;

impl Surface {
    /// The mesh of all patches, each divided `levels` times: 4^levels triangles of each. x is the plan's, y is up and z
    /// the plan's y, which points down on a drawing, so that the mesh is not mirrored.
    pub fn mesh(&self, levels: u32) -> Mesh {
        let mut corners: Vec<Corner> = Vec::new();
        self.triangles(levels, &mut |leaf| corners.extend(leaf));
        // Corners at one place are one point, numbered in the order of places.
        let mut order: Vec<usize> = (0..corners.len()).collect();
        let key = |k: usize| corners[k].place.map(|x| (x + 0.0).to_bits());
        order.sort_by_key(|k| key(*k));
        let mut number = vec![0_u32; corners.len()];
        let mut mesh = Mesh::default();
        for (k, &corner) in order.iter().enumerate() {
            if k == 0 || key(order[k - 1]) != key(corner) {
                let [x, y, height] = corners[corner].point();
                mesh.points.push([x as f32, height as f32, y as f32]);
            }
            number[corner] = mesh.points.len() as u32 - 1;
        }
        let mut normals = vec![[0.0_f64; 3]; mesh.points.len()];
        for (k, leaf) in corners.chunks_exact(3).enumerate() {
            let [a, b, c] = [leaf[0], leaf[1], leaf[2]].map(|corner| corner.point());
            let (p, q) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
            // Twice the area, towards increasing height.
            let up = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
            let [a, b, c] = [0, 1, 2].map(|i| number[3 * k + i]);
            // In the mesh's axes that is seen from above when wound the other way.
            mesh.triangles.push([a, c, b]);
            for corner in [a, b, c] {
                let normal = &mut normals[corner as usize];
                (normal[0], normal[1], normal[2]) = (normal[0] + up[0], normal[1] + up[2], normal[2] + up[1]);
            }
        }
        mesh.normals = normals
            .into_iter()
            .map(|n| {
                let length = libm::sqrt(n.iter().map(|x| x * x).sum());
                n.map(|x| (x / length) as f32)
            })
            .collect();
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::quadrangle;
    use super::super::{Amplitude, EdgeLength};

    #[test]
    fn it_is_one_sheet_seen_from_above() {
        let surface = quadrangle(Amplitude::ThreeMinusD, EdgeLength::Original, 2.3);
        let mesh = surface.mesh(4);
        // Two patches of 16 edges a side: of (n + 1)(n + 2) / 2 corners each, 17 are shared.
        assert_eq!((mesh.points.len(), mesh.triangles.len()), (2 * 153 - 17, 512));
        for [a, b, c] in &mesh.triangles {
            let [a, b, c] = [a, b, c].map(|k| mesh.points[*k as usize].map(f64::from));
            let (p, q) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
            assert!(p[2] * q[0] - p[0] * q[2] > 0.0, "anticlockwise from above");
        }
        assert!(mesh.normals.iter().all(|[_, up, _]| *up > 0.0 && *up <= 1.0));
    }
}
