//! Wavefront OBJ.

use std::fmt::Write;

use super::Mesh;

/// A mesh as an OBJ file, metres.
pub fn obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    for [x, y, z] in &mesh.points {
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for [x, y, z] in &mesh.normals {
        let _ = writeln!(text, "vn {x} {y} {z}");
    }
    for [a, b, c] in mesh.triangles.iter().map(|corners| corners.map(|corner| corner + 1)) {
        let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_counts_from_one() {
        let mesh = Mesh {
            points: vec![[0.0, 0.0, 0.0], [1e-6, 0.0, 0.0], [0.0, 0.5, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 3],
            triangles: vec![[0, 1, 2]],
        };
        let text = obj(&mesh);
        assert!(text.starts_with("v 0 0 0\nv 0.000001 0 0\n"), "{text}");
        assert!(text.ends_with("vn 0 0 1\nf 1//1 2//2 3//3\n"));
    }
}
