//! A camera with a thin lens.

use nalgebra::{Point3, Vector3};

use super::super::{SnowError, within};

/// The width of full frame film, m.
pub const FULL_FRAME: f64 = 0.036;
/// The most pixels along a side.
const MOST_PIXELS: usize = 1 << 15;

/// What a camera is set to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Focal length f, m.
    pub focal: f64,
    /// f-number N: the lens is f / N wide. Infinite for a pinhole.
    pub number: f64,
    /// Distance s, along the view, of what is sharp, m.
    pub focus: f64,
    /// Width of the sensor, m, [`FULL_FRAME`] as a rule; its height is by the picture's shape.
    pub sensor: f64,
    /// Time for which the shutter is open, s; what moves is in the middle of its way at half of it.
    pub shutter: f64,
}

/// A camera: where it is, where it looks, its lens, and its picture.
///
/// y is up, x to the right, and it looks along -z if turned so: right-handed. Rows are counted from the top. The sensor is
/// where a thin lens makes what is at the focus sharp, f s / (s - f) behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    pub(super) eye: Point3<f64>,
    /// To the right, up, and along the view.
    pub(super) axes: [Vector3<f64>; 3],
    pub(super) focus: f64,
    /// Radius of the lens, m.
    pub(super) aperture: f64,
    pub(super) shutter: f64,
    /// Pixels per unit of the tangent of the angle from the view.
    pub(super) scale: f64,
    pub(super) size: [usize; 2],
    /// The part of the picture that is made: left, top, width, height.
    pub(super) window: [usize; 4],
}

impl Camera {
    /// A camera at `eye` that looks along `view`, with `up` up as far as that goes, for a picture of so many pixels across
    /// and down.
    ///
    /// # Errors
    ///
    /// Directions of no or infinite length, `up` along the view; focal length not 1e-4 to 10 m; f-number below 0.1; focus
    /// nearer than 1.001 focal lengths or beyond 1e9 m; sensor not 1e-4 to 10 m wide; shutter not 0 to 1e6 s; size not 1 to
    /// 32768.
    pub fn new(
        eye: Point3<f64>,
        view: Vector3<f64>,
        up: Vector3<f64>,
        lens: Lens,
        size: [usize; 2],
    ) -> Result<Self, SnowError> {
        for x in eye.iter() {
            within("a coordinate of the eye, m,", *x, -1e9, 1e9)?;
        }
        let forward = unit("the length of the view", view)?;
        let up = unit("the length of up", up)?;
        let right = unit("the length of up across the view", forward.cross(&up))?;
        within("the focal length, m,", lens.focal, 1e-4, 10.0)?;
        within("the f-number", lens.number, 0.1, f64::INFINITY)?;
        within("the distance of the focus, m,", lens.focus, 1.001 * lens.focal, 1e9)?;
        within("the width of the sensor, m,", lens.sensor, 1e-4, 10.0)?;
        within("the time of the shutter, s,", lens.shutter, 0.0, 1e6)?;
        for pixels in size {
            within("the number of pixels along a side", pixels as f64, 1.0, MOST_PIXELS as f64)?;
        }
        let image = lens.focal * lens.focus / (lens.focus - lens.focal);
        Ok(Self {
            eye,
            axes: [right, right.cross(&forward), forward],
            focus: lens.focus,
            aperture: 0.5 * lens.focal / lens.number,
            shutter: lens.shutter,
            scale: size[0] as f64 * image / lens.sensor,
            size,
            window: [0, 0, size[0], size[1]],
        })
    }

    /// The same camera, of whose picture only a part is made, the same bits as in the whole: from column `left` and row `top`
    /// on, so many pixels wide and high.
    ///
    /// # Errors
    ///
    /// A part that is empty or not within the picture.
    pub fn window(&self, [left, top, width, height]: [usize; 4]) -> Result<Self, SnowError> {
        for (from, length, most) in [(left, width, self.size[0]), (top, height, self.size[1])] {
            within("the first pixel of a window", from as f64, 0.0, most as f64 - 1.0)?;
            within("the number of pixels along a window", length as f64, 1.0, (most - from) as f64)?;
        }
        Ok(Self { window: [left, top, width, height], ..self.clone() })
    }

    /// Pixels across and down of the whole picture.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Pixels across and down of what is made of it.
    pub fn made(&self) -> [usize; 2] {
        [self.window[2], self.window[3]]
    }

    /// A place seen from the camera, m: to the right, up, and along the view.
    pub(super) fn seen(&self, place: &Point3<f64>) -> [f64; 3] {
        self.turned(&(place - self.eye))
    }

    /// The same of a direction.
    pub(super) fn turned(&self, direction: &Vector3<f64>) -> [f64; 3] {
        self.axes.map(|axis| axis.dot(direction))
    }

    /// Where in the picture, in pixels from its upper left corner, a place seen from the camera is seen through a place of
    /// the lens.
    #[inline]
    pub(super) fn project(&self, [x, y, z]: [f64; 3], lens: [f64; 2]) -> [f64; 2] {
        let near = 1.0 / z;
        let shift = 1.0 / self.focus - near;
        [
            0.5 * self.size[0] as f64 + self.scale * (x * near + lens[0] * shift),
            0.5 * self.size[1] as f64 - self.scale * (y * near + lens[1] * shift),
        ]
    }

    /// The radius in pixels of the circle that a point at a distance along the view is seen as.
    pub(super) fn confusion(&self, z: f64) -> f64 {
        self.scale * self.aperture * (1.0 / self.focus - 1.0 / z).abs()
    }

    /// The ray from a place of the lens through a place of the picture: where it begins, and its direction of length 1.
    #[inline]
    pub(super) fn ray(&self, pixel: [f64; 2], lens: [f64; 2]) -> [[f64; 3]; 2] {
        let by = self.focus / self.scale;
        let x = (pixel[0] - 0.5 * self.size[0] as f64) * by - lens[0];
        let y = (0.5 * self.size[1] as f64 - pixel[1]) * by - lens[1];
        let length = (x * x + y * y + self.focus * self.focus).sqrt();
        [[lens[0], lens[1], 0.0], [x, y, self.focus].map(|x| x / length)]
    }

    /// Whether a sphere meets what is seen through the middle of the lens, of the whole picture, near and far.
    pub fn sees(&self, centre: &Point3<f64>, radius: f64) -> bool {
        let place = Vector3::from(self.seen(centre));
        self.distance(&place) <= radius
    }

    /// The distance of a place to the pyramid of view, 0 within it.
    fn distance(&self, place: &Vector3<f64>) -> f64 {
        let [x, y] = self.size.map(|pixels| 0.5 * pixels as f64 / self.scale);
        let corners = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vector3::new(x, y, 1.0));
        let mut inside = true;
        let mut nearest = f64::INFINITY;
        for k in 0..4 {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            // Inwards: the corners go round the view against the clock, and it is along z.
            let normal = a.cross(&b);
            let normal = normal / normal.norm_squared().sqrt();
            let height = normal.dot(place);
            inside &= height >= 0.0;
            // On the face, between its two edges.
            let foot = place - normal * height;
            if a.cross(&foot).dot(&normal) >= 0.0 && foot.cross(&b).dot(&normal) >= 0.0 {
                nearest = nearest.min(height.abs());
            }
            // On the edge, which begins in the eye.
            let along = (a.dot(place) / a.norm_squared()).max(0.0);
            nearest = nearest.min((place - a * along).norm_squared().sqrt());
        }
        if inside { 0.0 } else { nearest }
    }
}

/// A vector of length 1.
fn unit(name: &'static str, vector: Vector3<f64>) -> Result<Vector3<f64>, SnowError> {
    let length = vector.norm_squared().sqrt();
    within(name, length, 1e-9, 1e9)?;
    Ok(vector / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let lens = Lens { focal: 0.035, number: 8.0, focus: 1.2, sensor: FULL_FRAME, shutter: 0.004 };
        Camera::new(Point3::new(0.1, 0.2, 0.3), -Vector3::z(), Vector3::y(), lens, [640, 480]).unwrap()
    }

    /// A ray through where a place is seen, whatever the place of the lens, meets the place.
    #[test]
    fn rays_meet_what_is_projected() {
        let camera = camera();
        for (k, place) in [[0.1, -0.2, 0.9], [-0.3, 0.1, 1.2], [0.0, 0.02, 2.5]].into_iter().enumerate() {
            let lens = [1e-3, -5e-4 * k as f64];
            let [origin, direction] = camera.ray(camera.project(place, lens), lens);
            for axis in 0..3 {
                let reached = origin[axis] + direction[axis] * place[2] / direction[2];
                assert!((reached - place[axis]).abs() < 1e-12, "{k} {axis}");
            }
        }
        // Right is to the right, up is at the top.
        let [x, y] = camera.project(camera.seen(&Point3::new(0.2, 0.4, -1.0)), [0.0; 2]);
        assert!(x > 320.0 && y < 240.0);
    }

    /// Against points of the pyramid, many of them: a sphere is seen just if one of them is near enough.
    #[test]
    fn spheres_are_seen_that_meet_the_view() {
        let camera = camera();
        let [x, y] = [320.0 / camera.scale, 240.0 / camera.scale];
        for k in 0..60 {
            let part = |a: f64| (f64::from(k) * a) % 2.0 - 1.0;
            let place = Vector3::new(part(0.37), part(0.59), 1.4 * part(0.83));
            let mut nearest = f64::INFINITY;
            for z in 0..=80 {
                for u in -40..=40 {
                    for v in -40..=40 {
                        let z = f64::from(z) * 0.025;
                        let point = Vector3::new(x * z * f64::from(u) / 40.0, y * z * f64::from(v) / 40.0, z);
                        nearest = nearest.min((point - place).norm_squared());
                    }
                }
            }
            let distance = camera.distance(&place);
            assert!((distance - nearest.sqrt()).abs() < 0.03, "{place}: {distance}, {}", nearest.sqrt());
            let world =
                camera.eye + camera.axes[0] * place.x + camera.axes[1] * place.y + camera.axes[2] * place.z;
            assert!(camera.sees(&world, distance + 1e-9));
            assert!(distance == 0.0 || !camera.sees(&world, distance - 1e-9));
        }
    }

    #[test]
    fn what_is_no_camera_is_refused() {
        let lens = Lens { focal: 0.035, number: 8.0, focus: 1.2, sensor: FULL_FRAME, shutter: 0.004 };
        let make = |view, lens, size| Camera::new(Point3::origin(), view, Vector3::y(), lens, size);
        for refused in [
            make(Vector3::y(), lens, [4, 4]),
            make(Vector3::zeros(), lens, [4, 4]),
            make(Vector3::x(), Lens { focal: f64::NAN, ..lens }, [4, 4]),
            make(Vector3::x(), Lens { focus: 0.03, ..lens }, [4, 4]),
            make(Vector3::x(), Lens { shutter: -1.0, ..lens }, [4, 4]),
            make(Vector3::x(), lens, [0, 4]),
            camera().window([600, 0, 41, 1]),
        ] {
            assert_eq!(refused.unwrap_err().to_string().lines().count(), 1);
        }
    }
}
