//! Islands of known dimension, to try an estimator on: D of their coasts is known by their construction.

/// What is drawn, from its circumradius in pixels, as rows of pixels that lie in it.
pub struct Island {
    pub name: &'static str,
    /// D of its outline.
    pub dimension: f64,
    /// The corners of an initiator of circumradius 1.
    initiator: &'static [[f64; 2]],
    /// What takes the place of a segment from (0, 0) to (1, 0): the points between.
    generator: &'static [[f64; 2]],
}

/// sin 60 degrees.
const HIGH: f64 = 0.866_025_403_784_438_6;
/// sin 45 degrees.
const SLANT: f64 = std::f64::consts::FRAC_1_SQRT_2;
const SQUARE: &[[f64; 2]] = &[[SLANT, SLANT], [SLANT, -SLANT], [-SLANT, -SLANT], [-SLANT, SLANT]];

/// A square; von Koch's island (1904), log 4 / log 3; Mandelbrot's quadric one, log 8 / log 4.
pub const ISLANDS: [Island; 3] = [
    Island { name: "square", dimension: 1.0, initiator: SQUARE, generator: &[] },
    Island {
        name: "Koch's island",
        dimension: 1.261_859_507_142_914_8,
        initiator: &[[0.0, 1.0], [HIGH, -0.5], [-HIGH, -0.5]],
        generator: &[[1.0 / 3.0, 0.0], [0.5, HIGH / 3.0], [2.0 / 3.0, 0.0]],
    },
    Island {
        name: "quadric island",
        dimension: 1.5,
        initiator: SQUARE,
        generator: &[
            [0.25, 0.0],
            [0.25, 0.25],
            [0.5, 0.25],
            [0.5, 0.0],
            [0.5, -0.25],
            [0.75, -0.25],
            [0.75, 0.0],
        ],
    },
];

impl Island {
    /// A square picture of the island, and its width: `radius` in pixels, turned by an angle, its middle off by shares of
    /// a pixel. Segments are replaced until they are shorter than half a pixel.
    pub fn draw(&self, radius: f64, angle: f64, off: [f64; 2]) -> (Vec<bool>, usize) {
        let width = 2 * (1.6 * radius) as usize + 8;
        let middle = off.map(|off| 0.5 * width as f64 + off);
        let (sine, cosine) = libm::sincos(angle);
        let corner = |[x, y]: &[f64; 2]| {
            let (x, y) = (radius * x, radius * y);
            [middle[0] + cosine * x - sine * y, middle[1] + sine * x + cosine * y]
        };
        let corners: Vec<[f64; 2]> = self.initiator.iter().map(corner).collect();
        let mut coast = Vec::new();
        for (k, from) in corners.iter().enumerate() {
            self.refine(*from, corners[(k + 1) % corners.len()], &mut coast);
        }
        (filled(&coast, width), width)
    }

    fn refine(&self, from: [f64; 2], to: [f64; 2], coast: &mut Vec<[f64; 2]>) {
        let along = [to[0] - from[0], to[1] - from[1]];
        if self.generator.is_empty() || libm::hypot(along[0], along[1]) < 0.5 {
            coast.push(from);
            return;
        }
        let mut before = from;
        for [x, y] in self.generator.iter().chain(&[[1.0, 0.0]]) {
            let next = [from[0] + x * along[0] - y * along[1], from[1] + x * along[1] + y * along[0]];
            self.refine(before, next, coast);
            before = next;
        }
    }
}

/// Pixels whose middle lies in a closed curve, by even and odd crossings.
fn filled(coast: &[[f64; 2]], width: usize) -> Vec<bool> {
    let mut crossings = vec![Vec::new(); width];
    for (k, [x0, y0]) in coast.iter().enumerate() {
        let [x1, y1] = coast[(k + 1) % coast.len()];
        let (low, high) = (y0.min(y1), y0.max(y1));
        let first = (low - 0.5).ceil().max(0.0) as usize;
        for row in (first..width).take_while(|row| (*row as f64 + 0.5) < high) {
            crossings[row].push(x0 + (row as f64 + 0.5 - y0) / (y1 - y0) * (x1 - x0));
        }
    }
    let mut mask = vec![false; width * width];
    for (row, crossings) in mask.chunks_exact_mut(width).zip(&mut crossings) {
        crossings.sort_by(f64::total_cmp);
        for pair in crossings.chunks_exact(2) {
            let pixel = |x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(width);
            row[pixel(pair[0])..pixel(pair[1])].fill(true);
        }
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Areas by the constructions: Koch's island 8/5 of its triangle, the quadric one that of its square.
    #[test]
    fn islands_have_the_areas_that_they_must() {
        let radius = 150.0;
        let triangle = 3.0 * HIGH / 2.0 * radius * radius;
        let square = 2.0 * radius * radius;
        for (island, known) in ISLANDS.iter().zip([square, 1.6 * triangle, square]) {
            let (mask, _) = island.draw(radius, 0.3, [0.2, 0.4]);
            let area = mask.iter().filter(|inside| **inside).count() as f64;
            assert!((area / known - 1.0).abs() < 0.01, "{}: {area} for {known}", island.name);
        }
    }
}
