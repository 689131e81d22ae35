//! Where things are in the picture.

/// Where the camera is and what it sees: it stands in the origin and looks horizontally along z; x is right, y up, m.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Pixels along x and y.
    pub size: [usize; 2],
    /// Focal length in pixels.
    pub focal: f64,
}

impl View {
    /// The view whose horizontal field is so many degrees wide.
    pub fn new(size: [usize; 2], field_of_view: f64) -> Self {
        let half = (0.5 * field_of_view.clamp(1.0, 170.0)).to_radians();
        Self { size, focal: 0.5 * size[0] as f64 / libm::tan(half) }
    }

    /// Where a place is seen, in pixels from the upper left corner, and pixels to a metre there.
    pub fn seen(&self, [x, y, z]: [f64; 3]) -> ([f64; 2], f64) {
        let scale = self.focal / z.max(0.1);
        ([0.5 * self.size[0] as f64 + x * scale, 0.5 * self.size[1] as f64 - y * scale], scale)
    }

    /// Whether any of a ball may be seen.
    pub fn sees(&self, centre: [f64; 3], radius: f64) -> bool {
        let ([x, y], scale) = self.seen([centre[0], centre[1], centre[2] - radius]);
        let ([u, v], _) = self.seen([centre[0], centre[1], centre[2] + radius]);
        let reach = radius * scale;
        let meets = |a: f64, b: f64, side: usize| a.max(b) + reach > 0.0 && a.min(b) - reach < side as f64;
        centre[2] > radius && meets(x, u, self.size[0]) && meets(y, v, self.size[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_of_view_is_the_pictures_width() {
        for size in [[640, 480], [1920, 1080]] {
            let view = View::new(size, 50.0);
            let edge = libm::tan(25.0_f64.to_radians());
            let ([x, y], scale) = view.seen([4.0 * edge, 0.0, 4.0]);
            assert!((x - size[0] as f64).abs() < 1e-9 && y == 0.5 * size[1] as f64);
            assert!((scale - view.focal / 4.0).abs() < 1e-12);
            assert!(view.sees([4.2 * edge, 0.0, 4.0], 0.3) && !view.sees([6.0 * edge, 0.0, 4.0], 0.3));
        }
    }
}
