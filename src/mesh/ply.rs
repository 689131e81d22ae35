//! PLY, binary and little-endian.

use super::Mesh;

/// A mesh as a PLY file.
pub fn ply(mesh: &Mesh) -> Vec<u8> {
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         property float nx\nproperty float ny\nproperty float nz\nelement face {}\nproperty list uchar uint \
         vertex_indices\nend_header\n",
        mesh.points.len(),
        mesh.triangles.len()
    );
    let mut bytes = header.into_bytes();
    for (point, normal) in mesh.points.iter().zip(&mesh.normals) {
        point.iter().chain(normal).for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    for corners in &mesh.triangles {
        bytes.push(3);
        corners.iter().for_each(|corner| bytes.extend(corner.to_le_bytes()));
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_body_is_as_long_as_the_header_says() {
        let stick = Mesh::stick(1.0, [0.2, 0.1], 8);
        let bytes = ply(&stick);
        let end = bytes.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
        assert_eq!(bytes.len() - end, 24 * stick.points.len() + 13 * stick.triangles.len());
        let first: Vec<f32> =
            bytes[end..end + 12].chunks(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        assert_eq!(first, stick.points[0]);
    }
}
