//! The surface as a mountain in perspective: what is nearer hides what is behind (§3).
//!
//! The camera is level and its picture shifted, as an architect's: what is upright stays upright, and a column of the
//! picture shows one slice of the plan however high the ground is, so that columns can be worked out apart.

use rayon::prelude::*;

use super::surface::{Corner, Edge, Limit, Piece, Surface};
use super::view::MOST_LEVELS;

/// Columns that are worked out together.
const STRIP: usize = 32;
/// Samples of a pixel along each side.
const SAMPLES: usize = 2;

/// A level camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands: x, y and height.
    pub eye: [f64; 3],
    /// Where it looks in the plan, of length 1.
    pub heading: [f64; 2],
    /// Pixels to a unit at a distance of one.
    pub focal: f64,
    /// The row of the horizon, counted from the top.
    pub horizon: f64,
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
    /// What is nearer is not seen.
    pub near: f64,
}

/// A picture of light before a background.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Pixels in a row.
    pub width: usize,
    /// Light, red, green and blue, and the share of the pixel that the ground covers, row by row from the top. Light is
    /// that of the covered share.
    pub pixels: Vec<([f64; 3], f64)>,
    /// Triangles that were drawn, those on the border of two strips twice.
    pub triangles: u64,
}

/// The nearest that was seen along one ray.
#[derive(Clone, Copy)]
struct Sample {
    depth: f64,
    light: [f32; 3],
}

impl Camera {
    /// Column, row and distance along the heading.
    pub fn pixel(&self, [x, y, z]: [f64; 3]) -> ([f64; 2], f64) {
        let [dx, dy] = [x - self.eye[0], y - self.eye[1]];
        let [hx, hy] = self.heading;
        let (depth, side) = (dx * hx + dy * hy, dy * hx - dx * hy);
        let column = 0.5 * self.size[0] as f64 + self.focal * side / depth;
        ([column, self.horizon - self.focal * (z - self.eye[2]) / depth], depth)
    }

    /// The ground, divided until no edge on the picture is longer than `pixels`; `shade` gives the light of a triangle
    /// at a distance.
    pub fn show(
        &self,
        surface: &Surface,
        pixels: f64,
        shade: impl Fn(&[Corner; 3], f64) -> [f64; 3] + Sync,
    ) -> Scene {
        let [width, height] = self.size;
        let limit = Projected { camera: self, pixels };
        let strips: Vec<(Vec<Sample>, u64)> = (0..width.div_ceil(STRIP))
            .into_par_iter()
            .map(|k| {
                let first = k * STRIP;
                let mut strip = Strip::new(first, STRIP.min(width - first), height);
                let (left, right) = (first as f64, (first + STRIP) as f64);
                let seen = |piece: &Piece| {
                    let all = piece.corners.map(|corner| self.pixel(corner.point()));
                    if all.iter().all(|(_, depth)| *depth < self.near) {
                        return false;
                    }
                    let in_front = all.iter().all(|(_, depth)| *depth >= self.near);
                    let [a, b, c] = all.map(|(pixel, _)| pixel);
                    if !in_front {
                        return true;
                    }
                    // What is displaced stays in its column.
                    if a[0].max(b[0]).max(c[0]) < left || a[0].min(b[0]).min(c[0]) > right {
                        return false;
                    }
                    let (top, bottom) = (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]));
                    let off = f64::max(top - height as f64, -bottom);
                    let near = all.iter().map(|(_, depth)| *depth).fold(f64::INFINITY, f64::min);
                    off <= 0.0 || off <= surface.reach(piece) * self.focal / near
                };
                for patch in 0..surface.patches.triangles.len() {
                    let piece = surface.piece(patch, |_, _| 0);
                    surface.visit(&piece, 0, &limit, &seen, &mut |corners| {
                        let all = corners.map(|corner| self.pixel(corner.point()));
                        if all.iter().all(|(_, depth)| *depth >= self.near) {
                            strip.draw(&all, |depth| shade(corners, depth));
                        }
                    });
                }
                (strip.samples, strip.triangles)
            })
            .collect();
        let mut scene = Scene {
            width,
            pixels: Vec::with_capacity(width * height),
            triangles: strips.iter().map(|strip| strip.1).sum(),
        };
        for row in 0..height {
            for column in 0..width {
                let strip = &strips[column / STRIP].0;
                let across = STRIP.min(width - column / STRIP * STRIP) * SAMPLES;
                let (mut light, mut hits) = ([0.0; 3], 0.0);
                for k in 0..SAMPLES * SAMPLES {
                    let (x, y) = (column % STRIP * SAMPLES + k % SAMPLES, row * SAMPLES + k / SAMPLES);
                    let sample = &strip[y * across + x];
                    if sample.depth.is_finite() {
                        hits += 1.0;
                        (0..3).for_each(|c| light[c] += f64::from(sample.light[c]));
                    }
                }
                let mean = if hits > 0.0 { light.map(|sum| sum / hits) } else { light };
                scene.pixels.push((mean, hits / (SAMPLES * SAMPLES) as f64));
            }
        }
        scene
    }
}

/// Some columns of the picture.
struct Strip {
    first: f64,
    across: usize,
    down: usize,
    samples: Vec<Sample>,
    triangles: u64,
}

impl Strip {
    fn new(first: usize, columns: usize, rows: usize) -> Self {
        let (across, down) = (columns * SAMPLES, rows * SAMPLES);
        let none = Sample { depth: f64::INFINITY, light: [0.0; 3] };
        Self { first: first as f64, across, down, samples: vec![none; across * down], triangles: 0 }
    }

    fn draw(&mut self, corners: &[([f64; 2], f64); 3], light: impl Fn(f64) -> [f64; 3]) {
        self.triangles += 1;
        let per = SAMPLES as f64;
        let [a, b, c] = corners.map(|(pixel, _)| [(pixel[0] - self.first) * per - 0.5, pixel[1] * per - 0.5]);
        let range = |axis: usize, count: usize| {
            let low = libm::ceil(a[axis].min(b[axis]).min(c[axis])).max(0.0);
            let high = libm::floor(a[axis].max(b[axis]).max(c[axis])).min(count as f64 - 1.0);
            if low <= high { low as usize..high as usize + 1 } else { 0..0 }
        };
        let depth = (corners[0].1 + corners[1].1 + corners[2].1) / 3.0;
        let mut shaded = None;
        let columns = range(0, self.across);
        for y in range(1, self.down) {
            for x in columns.clone() {
                let at = [x as f64, y as f64];
                let sides = [side(a, b, at), side(b, c, at), side(c, a, at)];
                let inside = sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0);
                let sample = &mut self.samples[y * self.across + x];
                // Of two at one distance the first stays, whatever the number of threads.
                if inside && depth < sample.depth {
                    let light = shaded.get_or_insert_with(|| light(depth).map(|channel| channel as f32));
                    *sample = Sample { depth, light: *light };
                }
            }
        }
    }
}

/// On which side of an edge a place is: of the edge turned round, the same with its sign turned.
fn side(from: [f64; 2], to: [f64; 2], at: [f64; 2]) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]);
    let ordered = from[0] < to[0] || (from[0] == to[0] && from[1] < to[1]);
    if ordered { cross(from, to) } else { -cross(to, from) }
}

/// Divides what is longer than so many pixels.
struct Projected<'a> {
    camera: &'a Camera,
    pixels: f64,
}

impl Limit for Projected<'_> {
    fn divides(&self, n: u32, from: &Corner, to: &Corner, edge: &Edge) -> bool {
        let near = self.camera.near;
        let [(a, from), (b, to)] = [from, to].map(|corner| self.camera.pixel(corner.point()));
        if n >= MOST_LEVELS || (from < near && to < near) {
            return false;
        }
        if from < near || to < near {
            return edge.original * libm::exp2(-f64::from(n)) > 0.25 * near;
        }
        let [dx, dy] = [a[0] - b[0], a[1] - b[1]];
        dx * dx + dy * dy > self.pixels * self.pixels
    }
}

/// The upward direction at right angles to a triangle, of length 1: x, y of the plan and height.
pub fn normal(corners: &[Corner; 3]) -> [f64; 3] {
    let [a, b, c] = corners.map(|corner| corner.point());
    let (p, q) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let across = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let length = libm::sqrt(across.iter().map(|x| x * x).sum());
    let turn = if across[2] < 0.0 { -1.0 } else { 1.0 };
    across.map(|x| turn * x / length)
}

/// The light that a matt triangle throws back, of a far light of 1 from this direction (of length 1): Lambert's cosine.
pub fn lambert(corners: &[Corner; 3], towards: [f64; 3]) -> f64 {
    let n = normal(corners);
    (n[0] * towards[0] + n[1] * towards[1] + n[2] * towards[2]).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::super::{Amplitude, Contour, Displacement, EdgeLength, Patches, Plateau, Relief};
    use super::*;
    use crate::rng::Seed;

    fn ramp(gain: f64) -> Surface {
        let line = |name: &str, y: f64, level: f64| Contour {
            name: name.to_owned(),
            level,
            dimension: 2.3,
            points: vec![[-10.0, y], [10.0, y]],
            closed: false,
        };
        // Rises to a wall 1.5 high at a distance of 6, with low ground behind.
        let lines = [
            line("near", -1.0, 0.0),
            line("foot", -5.0, 0.0),
            line("top", -6.0, 1.5),
            line("far", -20.0, -1.0),
        ];
        Surface {
            patches: Patches::new(&lines, Plateau::AsPrinted).unwrap(),
            relief: Relief::Patches,
            displacement: Displacement {
                amplitude: Amplitude::ThreeMinusD,
                edge_length: EdgeLength::Original,
                gain,
                moment: Seed(1).stream("Gauss").at(0),
            },
        }
    }

    fn camera() -> Camera {
        Camera {
            eye: [0.0, 0.0, 1.0],
            heading: [0.0, -1.0],
            focal: 40.0,
            horizon: 20.0,
            size: [50, 50],
            near: 0.5,
        }
    }

    #[test]
    fn what_is_nearer_hides_what_is_behind() {
        let scene = camera().show(&ramp(0.0), 0.5, |corners, depth| {
            let y = corners.iter().map(|corner| -corner.place[1]).sum::<f64>() / 3.0;
            [y, depth, 1.0]
        });
        // The top of the wall is 0.5 above the eye at a distance of 6: row 20 - 40 / 12.
        for row in 0..50 {
            let (light, cover) = scene.pixels[row * 50 + 25];
            let known = if row < 16 { 0.0 } else { 1.0 };
            if row != 16 {
                assert_eq!(cover, known, "{row}");
            }
            if cover == 1.0 {
                assert!(light[0] < 6.2, "{row}: the ground behind the wall shows");
                assert!((light[0] - light[1]).abs() < 1e-6, "depth is that along the heading");
            }
            // On the flat ground before it the row tells the distance.
            let flat = 40.0 / (row as f64 + 0.5 - 20.0);
            if row >= 29 {
                assert!((light[0] - flat).abs() < 0.03 * flat, "{row}: {} for {flat}", light[0]);
            }
        }
    }

    #[test]
    fn a_rough_ground_has_no_holes_and_threads_do_not_matter() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                camera().show(&ramp(0.05), 0.5, |corners, _| [lambert(corners, [0.6, 0.0, 0.8]); 3])
            })
        };
        let scene = with(1);
        assert!((30 * 50..50 * 50).all(|k| scene.pixels[k].1 == 1.0));
        assert_eq!(scene, with(3));
    }

    #[test]
    fn light_from_above_is_thrown_back_by_the_cosine() {
        let corner = |x: f64, y: f64, base: f64| Corner { place: [x, y], base, rough: 0.0, dimension: 2.0 };
        let slope = [corner(0.0, 0.0, 0.0), corner(0.0, 1.0, 0.0), corner(1.0, 0.0, 1.0)];
        assert!((lambert(&slope, [0.0, 0.0, 1.0]) - 0.5_f64.sqrt()).abs() < 1e-15);
        assert_eq!(lambert(&slope, [1.0, 0.0, 0.0]), 0.0);
        assert!((lambert(&slope, [-1.0, 0.0, 0.0]) - 0.5_f64.sqrt()).abs() < 1e-15);
    }
}
