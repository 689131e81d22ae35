//! Where in a camera's view something is, from the picture to the scene.

use nalgebra::{Point3, Vector3};

use super::super::SnowError;
use super::{Camera, Lens};

impl Camera {
    /// Tangents of half the angles of view, across and up.
    pub fn tangents(&self) -> [f64; 2] {
        self.size.map(|pixels| 0.5 * pixels as f64 / self.scale)
    }

    /// The place at a depth along the view, m to the right and up from its middle.
    pub fn place(&self, [right, up]: [f64; 2], depth: f64) -> Point3<f64> {
        self.eye + self.axes[0] * right + self.axes[1] * up + self.axes[2] * depth
    }

    /// A pinhole that looks from the origin along -z onto a sphere at a distance, m, which just fits a square picture.
    ///
    /// # Errors
    ///
    /// A radius that is not 1e-5 to 0.5 of the distance; pixels not 1 to 32768.
    pub fn onto(distance: f64, radius: f64, pixels: usize) -> Result<Self, SnowError> {
        // A pinhole has everything sharp, so that any focal length will do.
        let focal = 10.0;
        let sensor = 2.0 * focal * radius / distance;
        let lens = Lens { focal, number: f64::INFINITY, focus: 1e9, sensor, shutter: 0.0 };
        Self::new(Point3::origin(), -Vector3::z(), Vector3::y(), lens, [pixels; 2])
    }
}

#[cfg(test)]
mod tests {
    use super::super::FULL_FRAME;
    use super::*;

    #[test]
    fn a_place_is_seen_where_it_was_put() {
        let lens = Lens { focal: 0.035, number: 8.0, focus: 1.2, sensor: FULL_FRAME, shutter: 0.0 };
        let eye = Point3::new(0.1, 0.2, 0.3);
        let camera = Camera::new(eye, Vector3::new(0.3, -0.1, -1.0), Vector3::y(), lens, [640, 480]).unwrap();
        let [x, y] = camera.tangents();
        assert!((x / y - 640.0 / 480.0).abs() < 1e-12);
        let inside = camera.place([0.999 * x * 2.0, -0.999 * y * 2.0], 2.0);
        let outside = camera.place([1.001 * x * 2.0, 0.0], 2.0);
        assert!(camera.sees(&inside, 0.0) && !camera.sees(&outside, 0.0));
    }

    /// The sphere's rim is at the edge of the picture, whose middle row sees it end to end: 1e-3, the perspective of a sphere.
    #[test]
    fn onto_a_sphere_it_fits_the_picture() {
        for (distance, radius) in [(10.0, 1e-3), (10.0, 5e-3), (2.0, 2e-3)] {
            let camera = Camera::onto(distance, radius, 24).unwrap();
            assert!((camera.tangents()[0] * distance / radius - 1.0).abs() < 1e-3);
        }
    }
}
