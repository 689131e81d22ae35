//! Triangles laid down on pixels, each by the area that it covers there: exact, so that nothing is jagged.
//!
//! An edge adds, to the pixels of every row that it passes, how much of the row is to its right; the edges of a triangle
//! cancel but within it, and a running sum along the row brings out the areas (as font renderers do).

use rayon::prelude::*;

/// Rows that are worked out together.
const BAND: usize = 64;

/// Numbers of pixels, `N` channels each, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster<const N: usize> {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The mean over each pixel's area, 0 where no triangle is.
    pub pixels: Vec<[f64; N]>,
    /// The share of each pixel that is covered.
    pub cover: Vec<f64>,
    /// Triangles that were laid down, those on the border of two bands twice.
    pub triangles: u64,
}

/// Some rows of a raster, in sums along each row.
pub(super) struct Band<const N: usize> {
    width: usize,
    first: f64,
    rows: usize,
    cells: Vec<Cell<N>>,
    pub triangles: u64,
}

/// What is added from a pixel on.
#[derive(Clone, Copy)]
struct Cell<const N: usize> {
    cover: f64,
    values: [f64; N],
}

impl<const N: usize> Raster<N> {
    /// Bands of rows, each painted by `paint` on its own, in parallel.
    pub(super) fn painted(width: usize, height: usize, paint: impl Fn(&mut Band<N>) + Sync) -> Self {
        let mut raster = Self {
            width,
            height,
            pixels: vec![[0.0; N]; width * height],
            cover: vec![0.0; width * height],
            triangles: 0,
        };
        let bands = raster.pixels.par_chunks_mut(width * BAND).zip(raster.cover.par_chunks_mut(width * BAND));
        let triangles = bands.enumerate().map(|(k, (pixels, cover))| {
            let mut band = Band::new(width, k * BAND, cover.len() / width);
            paint(&mut band);
            band.sum_up(pixels, cover);
            band.triangles
        });
        raster.triangles = triangles.sum();
        raster
    }
}

impl<const N: usize> Band<N> {
    fn new(width: usize, first: usize, rows: usize) -> Self {
        // One column more takes what is to the right of the picture.
        let cells = vec![Cell { cover: 0.0, values: [0.0; N] }; rows * (width + 1)];
        Self { width, first: first as f64, rows, cells, triangles: 0 }
    }

    /// The least and greatest y of the band.
    pub fn reach(&self) -> (f64, f64) {
        (self.first, self.first + self.rows as f64)
    }

    /// The width in pixels.
    pub fn width(&self) -> f64 {
        self.width as f64
    }

    /// Lays down a triangle whose corners are at these places of the picture, in pixels.
    #[inline]
    pub fn add(&mut self, corners: [[f64; 2]; 3], values: &[f64; N]) {
        self.triangles += 1;
        let [a, b, c] = corners;
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let cell =
            |p: [f64; 2]| ((p[0] as i64, (p[1] - self.first) as i64), p[0] >= 0.0 && p[1] >= self.first);
        let (at, inside) = cell(a);
        if cell(b) == (at, true) && cell(c) == (at, true) && inside {
            // All in one pixel, as most that are small: its area, taken away again in the next.
            let ((column, row), area) = (at, 0.5 * twice.abs());
            if (column as usize) < self.width && (row as usize) < self.rows {
                self.put(row as usize, column as usize, area, values);
                self.put(row as usize, column as usize + 1, -area, values);
            }
            return;
        }
        // What is to the right of an edge that goes down is outside, unless the triangle is wound the other way.
        let turn = if twice < 0.0 { 1.0 } else { -1.0 };
        for (from, to) in [(a, b), (b, c), (c, a)] {
            self.edge(from, to, turn, values);
        }
    }

    #[inline]
    fn edge(&mut self, from: [f64; 2], to: [f64; 2], turn: f64, values: &[f64; N]) {
        let (turn, from, to) = if from[1] <= to[1] { (turn, from, to) } else { (-turn, to, from) };
        let (top, bottom) = ((from[1] - self.first).max(0.0), (to[1] - self.first).min(self.rows as f64));
        if top >= bottom {
            return;
        }
        let slope = (to[0] - from[0]) / (to[1] - from[1]);
        let first = self.first;
        let at = |y: f64| from[0] + (y + first - from[1]) * slope;
        let (mut y, mut x) = (top, at(top));
        for row in top as usize..self.rows {
            let below = f64::min((row + 1) as f64, bottom);
            let next = at(below);
            self.pass(row, x, next, turn * (below - y), values);
            if below >= bottom {
                break;
            }
            (y, x) = (below, next);
        }
    }

    /// An edge that passes a row from one x to another while it goes down by `fall`.
    #[inline]
    fn pass(&mut self, row: usize, x: f64, next: f64, fall: f64, values: &[f64; N]) {
        let (low, high) = if x < next { (x, next) } else { (next, x) };
        if low < 0.0 || high >= self.width as f64 {
            return self.pass_border(row, [low, high], fall, values);
        }
        let (first, last) = (low as usize, high as usize);
        if first == last {
            // Within one pixel: what is to the right in it, and all of those beyond.
            let left = 0.5 * (low + high) - first as f64;
            self.put(row, first, fall * (1.0 - left), values);
            self.put(row, first + 1, fall * left, values);
            return;
        }
        let per = fall / (high - low);
        let mut from = low;
        for column in first..=last {
            let to = high.min((column + 1) as f64);
            let (part, left) = (per * (to - from), 0.5 * (from + to) - column as f64);
            self.put(row, column, part * (1.0 - left), values);
            self.put(row, column + 1, part * left, values);
            from = to;
        }
    }

    /// An edge that is beyond the picture on the left or right, or partly.
    #[cold]
    fn pass_border(&mut self, row: usize, [low, high]: [f64; 2], fall: f64, values: &[f64; N]) {
        let width = self.width as f64;
        let per = if high > low { fall / (high - low) } else { 0.0 };
        let (before, after) = (high.min(0.0) - low.min(0.0), high.max(width) - low.max(width));
        let all_before = high <= 0.0;
        let all_after = low >= width;
        let part = |length: f64, all: bool| if all { fall } else { per * length };
        self.put(row, 0, part(before, all_before), values);
        self.put(row, self.width, part(after, all_after && !all_before), values);
        let (from, to) = (low.clamp(0.0, width), high.clamp(0.0, width));
        let mut x = from;
        while x < to {
            let column = x as usize;
            let next = to.min((column + 1) as f64);
            let (part, left) = (per * (next - x), 0.5 * (x + next) - column as f64);
            self.put(row, column, part * (1.0 - left), values);
            self.put(row, column + 1, part * left, values);
            x = next;
        }
    }

    #[inline]
    fn put(&mut self, row: usize, column: usize, share: f64, values: &[f64; N]) {
        let cell = &mut self.cells[row * (self.width + 1) + column];
        cell.cover += share;
        for (sum, value) in cell.values.iter_mut().zip(values) {
            *sum += share * value;
        }
    }

    fn sum_up(&self, pixels: &mut [[f64; N]], cover: &mut [f64]) {
        for row in 0..self.rows {
            let (mut values, mut covered) = ([0.0; N], 0.0);
            for column in 0..self.width {
                let at = row * (self.width + 1) + column;
                covered += self.cells[at].cover;
                for (sum, more) in values.iter_mut().zip(&self.cells[at].values) {
                    *sum += more;
                }
                pixels[row * self.width + column] = values;
                cover[row * self.width + column] = covered.clamp(0.0, 1.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The area of a polygon within a square, by clipping it at the four sides.
    fn clipped(corners: [[f64; 2]; 3], x: f64, y: f64) -> f64 {
        let mut polygon = corners.to_vec();
        for (axis, sign, at) in [(0, 1.0, x), (0, -1.0, -(x + 1.0)), (1, 1.0, y), (1, -1.0, -(y + 1.0))] {
            let inside = |p: &[f64; 2]| sign * p[axis] - at;
            let mut kept = Vec::new();
            for k in 0..polygon.len() {
                let (p, q) = (polygon[k], polygon[(k + 1) % polygon.len()]);
                let (a, b) = (inside(&p), inside(&q));
                if a >= 0.0 {
                    kept.push(p);
                }
                if a * b < 0.0 {
                    let t = a / (a - b);
                    kept.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
                }
            }
            polygon = kept;
        }
        let next = |k: usize| polygon[(k + 1) % polygon.len()];
        (0.5 * (0..polygon.len())
            .map(|k| polygon[k][0] * next(k)[1] - polygon[k][1] * next(k)[0])
            .sum::<f64>())
        .abs()
    }

    #[test]
    fn every_pixel_gets_the_area_that_is_covered() {
        let mut state = crate::rng::Seed(1).stream("triangles").at(0).place(0, 0, 0);
        let mut number = |low: f64, high: f64| low + (high - low) * state.uniform();
        for size in [0.4, 1.3, 6.0, 60.0] {
            for _ in 0..60 {
                let centre = [number(-2.0, 23.0), number(-2.0, 40.0)];
                let corners = [(); 3].map(|()| centre.map(|c| c + number(-size, size)));
                let raster = Raster::painted(21, 37, |band| band.add(corners, &[2.0]));
                for (k, (pixel, cover)) in raster.pixels.iter().zip(&raster.cover).enumerate() {
                    let known = clipped(corners, (k % 21) as f64, (k / 21) as f64);
                    assert!((cover - known).abs() < 1e-11, "{corners:?} {k}: {cover} for {known}");
                    assert!((pixel[0] - 2.0 * known).abs() < 1e-11);
                }
            }
        }
    }

    #[test]
    fn triangles_side_by_side_leave_no_gap() {
        let raster = Raster::painted(40, 40, |band| {
            for k in 0..100 {
                let (x, y) = (f64::from(k % 10) * 4.4 - 1.3, f64::from(k / 10) * 4.4 - 1.3);
                let (right, low) = (x + 4.4, y + 4.4);
                band.add([[x, y], [right, y], [x, low]], &[1.0]);
                band.add([[right, low], [right, y], [x, low]], &[3.0]);
            }
        });
        assert!(raster.cover.iter().all(|cover| (cover - 1.0).abs() < 1e-9));
        let mean = raster.pixels.iter().map(|pixel| pixel[0]).sum::<f64>() / 1600.0;
        assert!((mean - 2.0).abs() < 0.1, "{mean}");
    }
}
