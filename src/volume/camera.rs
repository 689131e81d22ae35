//! Cameras: which ray belongs to which place of a picture. Row 0 is the top.

use super::vector::{add, cross, dot, square, unit};
use super::{Density, VolumeError, within};

/// Most pixels across or down.
pub(super) const MOST_PIXELS: usize = 1 << 15;

/// A half line from the eye into the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, m.
    pub origin: [f64; 3],
    /// Where it goes, of length 1.
    pub direction: [f64; 3],
}

impl Ray {
    /// From a place, m, in a direction of any length.
    ///
    /// # Errors
    ///
    /// [`VolumeError`] for a place that is not finite or a direction without length.
    pub fn new(origin: [f64; 3], direction: [f64; 3]) -> Result<Self, VolumeError> {
        for value in origin {
            within("where a ray starts, m,", value, -1e12, 1e12, "-1e12 to 1e12")?;
        }
        Ok(Self { origin, direction: unit("where a ray goes", direction)? })
    }

    /// The place after a length, m.
    pub fn place(&self, length: f64) -> [f64; 3] {
        add(self.origin, length, self.direction)
    }
}

/// A camera. To the right is view x up; up itself is turned until it is square to the view, and where it lies along the
/// view y is taken for it, and z where that does too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    size: [usize; 2],
    view: [f64; 3],
    right: [f64; 3],
    up: [f64; 3],
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// The picture's left top corner, m, and its width and height, m.
    Orthographic { corner: [f64; 3], sides: [f64; 2] },
    /// The eye, m, and half the picture's width and height at a distance of 1.
    Pinhole { eye: [f64; 3], half: [f64; 2] },
}

impl Camera {
    /// Parallel rays along `view`; the smallest rectangle around the box of the field, seen so, fills the picture, whose
    /// pixels need not be square.
    ///
    /// # Errors
    ///
    /// [`VolumeError`] for a view without length and a picture without pixels.
    pub fn orthographic(
        density: &Density,
        view: [f64; 3],
        up: [f64; 3],
        size: [usize; 2],
    ) -> Result<Self, VolumeError> {
        Self::parallel([[0.0; 3], density.extent()], view, up, size)
    }

    /// As [`Camera::orthographic`] around any box, given by its near and far corner, m.
    ///
    /// # Errors
    ///
    /// As [`Camera::orthographic`], and for a box that is seen from no side.
    pub fn parallel(
        around: [[f64; 3]; 2],
        view: [f64; 3],
        up: [f64; 3],
        size: [usize; 2],
    ) -> Result<Self, VolumeError> {
        let [view, right, up] = frame(view, up, size)?;
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for k in 0..8 {
            let place = [0, 1, 2].map(|axis| around[k >> axis & 1][axis]);
            for (axis, along) in [right, up, view].into_iter().enumerate() {
                let value = dot(place, along);
                (low[axis], high[axis]) = (low[axis].min(value), high[axis].max(value));
            }
        }
        let sides = [high[0] - low[0], high[1] - low[1]];
        for side in sides {
            within("the side of what is framed, m,", side, 1e-12, 1e12, "1e-12 to 1e12")?;
        }
        // A little before the box, so that no ray starts within it.
        let before = low[2] - 0.01 * (high[2] - low[2]).max(sides[0]);
        let corner = add(add(add([0.0; 3], low[0], right), high[1], up), before, view);
        Ok(Self { size, view, right, up, kind: Kind::Orthographic { corner, sides } })
    }

    /// All rays from one eye, m; the picture is `fov` degrees high and its pixels are square.
    ///
    /// # Errors
    ///
    /// [`VolumeError`] for an eye that is not finite, a view without length, an angle not between 0 and 180 and a picture
    /// without pixels.
    pub fn pinhole(
        eye: [f64; 3],
        view: [f64; 3],
        up: [f64; 3],
        fov: f64,
        size: [usize; 2],
    ) -> Result<Self, VolumeError> {
        let [view, right, up] = frame(view, up, size)?;
        for value in eye {
            within("where the eye is, m,", value, -1e12, 1e12, "-1e12 to 1e12")?;
        }
        within("the vertical field of view, degrees,", fov, 0.001, 179.999, "0.001 to 179.999")?;
        let high = libm::tan(0.5 * fov.to_radians());
        let half = [high * size[0] as f64 / size[1] as f64, high];
        Ok(Self { size, view, right, up, kind: Kind::Pinhole { eye, half } })
    }

    /// Pixels across and down.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Where it looks, of length 1.
    pub fn view(&self) -> [f64; 3] {
        self.view
    }

    /// To the right and up on the picture, each of length 1.
    pub fn axes(&self) -> [[f64; 3]; 2] {
        [self.right, self.up]
    }

    /// The ray of a place on the picture, in pixels from its left top corner.
    pub fn ray(&self, [column, row]: [f64; 2]) -> Ray {
        let [across, down] = [column / self.size[0] as f64, row / self.size[1] as f64];
        match self.kind {
            Kind::Orthographic { corner, sides } => {
                let at = add(add(corner, across * sides[0], self.right), -down * sides[1], self.up);
                Ray { origin: at, direction: self.view }
            }
            Kind::Pinhole { eye, half } => {
                let to = add(self.view, (2.0 * across - 1.0) * half[0], self.right);
                let to = add(to, (1.0 - 2.0 * down) * half[1], self.up);
                let length = dot(to, to).sqrt();
                Ray { origin: eye, direction: to.map(|x| x / length) }
            }
        }
    }

    /// The ray of sample (i, j) of a pixel, of `samples` x `samples` in the middles of as many equal parts.
    pub fn sample(&self, [column, row]: [usize; 2], [i, j]: [usize; 2], samples: usize) -> Ray {
        let at = |pixel: usize, part: usize| pixel as f64 + (part as f64 + 0.5) / samples as f64;
        self.ray([at(column, i), at(row, j)])
    }

    /// Where on the picture a place, m, is seen, in pixels, how far along the view, m, and how many pixels a metre across
    /// and down is there; nothing behind a pinhole.
    pub fn project(&self, place: [f64; 3]) -> Option<([f64; 2], f64, [f64; 2])> {
        let [width, height] = self.size.map(|pixels| pixels as f64);
        match self.kind {
            Kind::Orthographic { corner, sides } => {
                let from = add(place, -1.0, corner);
                let scale = [width / sides[0], height / sides[1]];
                let pixel = [dot(from, self.right) * scale[0], -dot(from, self.up) * scale[1]];
                Some((pixel, dot(from, self.view), scale))
            }
            Kind::Pinhole { eye, half } => {
                let from = add(place, -1.0, eye);
                let far = dot(from, self.view);
                let scale = [0.5 * width / (half[0] * far), 0.5 * height / (half[1] * far)];
                let pixel = [
                    0.5 * width + dot(from, self.right) * scale[0],
                    0.5 * height - dot(from, self.up) * scale[1],
                ];
                (far > 0.0).then_some((pixel, far, scale))
            }
        }
    }
}

/// View, right and up, each of length 1 and square to the others.
fn frame(view: [f64; 3], up: [f64; 3], size: [usize; 2]) -> Result<[[f64; 3]; 3], VolumeError> {
    if size.iter().any(|pixels| !(1..=MOST_PIXELS).contains(pixels)) {
        return Err(VolumeError::Picture { size, samples: 1 });
    }
    let view = unit("the view", view)?;
    let up = square(view, unit("up", up)?);
    Ok([view, cross(view, up), up])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-12)
    }

    #[test]
    fn the_box_fills_the_picture() {
        let field = Density::new([3, 2, 4], 0.5, vec![0.0; 24]).unwrap();
        // Along -z with y up: x to the right, so the left top corner is (0, 1).
        let camera = Camera::orthographic(&field, [0.0, 0.0, -2.0], [0.0, 3.0, 0.1], [6, 8]).unwrap();
        assert!(near(camera.ray([0.0, 0.0]).origin, [0.0, 1.0, camera.ray([1.0, 2.0]).origin[2]]));
        assert!(near(camera.ray([6.0, 8.0]).direction, [0.0, 0.0, -1.0]));
        assert!(camera.ray([6.0, 8.0]).origin[0] == 1.5 && camera.ray([6.0, 8.0]).origin[2] > 2.0);
        let oblique = Camera::orthographic(&field, [1.0, -0.7, 0.4], [0.0, 0.0, 1.0], [40, 30]).unwrap();
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for k in 0..8 {
            let place = [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { field.extent()[axis] } else { 0.0 });
            let (pixel, far, _) = oblique.project(place).unwrap();
            assert!(far > 0.0);
            assert!(near(oblique.ray(pixel).place(far), place));
            for axis in 0..2 {
                (low[axis], high[axis]) = (low[axis].min(pixel[axis]), high[axis].max(pixel[axis]));
            }
        }
        for (got, known) in [(low, [0.0, 0.0]), (high, [40.0, 30.0])] {
            assert!((got[0] - known[0]).abs() < 1e-12 && (got[1] - known[1]).abs() < 1e-12, "{got:?}");
        }
    }

    #[test]
    fn a_pinhole_has_its_angle() {
        let camera =
            Camera::pinhole([1.0, 2.0, 3.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], 90.0, [200, 100]).unwrap();
        assert!(near(camera.ray([100.0, 50.0]).direction, [0.0, 1.0, 0.0]));
        let half = 0.5_f64.sqrt();
        assert!(near(camera.ray([100.0, 0.0]).direction, [0.0, half, half]));
        assert!(camera.ray([150.0, 50.0]).direction[0] > 0.0, "right is view x up");
        let place = [1.3, 5.0, 2.2];
        let (pixel, far, scale) = camera.project(place).unwrap();
        let ray = camera.ray(pixel);
        assert!(near(ray.place(far / ray.direction[1]), place));
        let aside = camera.project(add(place, 0.01, camera.axes()[0])).unwrap().0;
        assert!((aside[0] - pixel[0] - 0.01 * scale[0]).abs() < 1e-9);
        assert_eq!(camera.project([1.0, 1.0, 3.0]), None);
    }

    #[test]
    fn up_along_the_view_is_replaced() {
        let look = |view, up| Camera::pinhole([0.0; 3], view, up, 40.0, [2, 2]).unwrap().axes();
        assert_eq!(look([0.0, 0.0, 1.0], [0.0, 0.0, -3.0]), [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert_eq!(look([0.0, 1.0, 0.0], [0.0, 1.0, 0.0]), [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    }

    #[test]
    fn what_is_no_camera_is_refused() {
        let pinhole = |view, fov, size| Camera::pinhole([0.0; 3], view, [0.0, 1.0, 0.0], fov, size);
        let view = [0.0, 0.0, 1.0];
        assert_eq!(
            pinhole([0.0; 3], 40.0, [2, 2]).unwrap_err().to_string(),
            "the view is (0, 0, 0), which is no direction; one of finite length above 0 is handled"
        );
        for fov in [0.0, 180.0, -1.0, f64::NAN] {
            assert!(pinhole(view, fov, [2, 2]).is_err());
        }
        for size in [[0, 2], [2, 0], [2, MOST_PIXELS + 1]] {
            assert!(matches!(pinhole(view, 40.0, size), Err(VolumeError::Picture { .. })));
        }
        assert!(pinhole([f64::INFINITY, 0.0, 0.0], 40.0, [2, 2]).is_err());
    }
}
