//! The surface on a picture: from straight above, or a flat layer overhead seen from the ground.

use super::raster::{Band, Raster};
use super::surface::{Corner, Edge, Limit, Piece, Surface};
use super::tile::Tile;

/// Levels that a tile takes at once.
const TILE: u32 = 5;
/// The most divisions of any edge.
pub(super) const MOST_LEVELS: u32 = 24;

/// How finely the surface is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fineness {
    /// Every patch so many times.
    Levels(u32),
    /// Until no edge on the picture is longer than this many pixels, or until it has been divided 24 times. At one pixel
    /// a triangle has less than half of one (√3/4 at most).
    Pixels(f64),
}

/// A window of the plan, seen from straight above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Least x and y: the picture's top left corner.
    pub low: [f64; 2],
    /// Greatest x and y.
    pub high: [f64; 2],
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
}

impl Window {
    /// The window that shows a box of the plan in the middle of a picture, pixels being square.
    pub fn around((low, high): ([f64; 2], [f64; 2]), size: [usize; 2]) -> Self {
        let per = [0, 1].map(|axis| (high[axis] - low[axis]) / size[axis] as f64);
        let per = f64::max(per[0], per[1]);
        let half = [0, 1].map(|axis| 0.5 * per * size[axis] as f64);
        let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        Self { low: [0, 1].map(|k| middle[k] - half[k]), high: [0, 1].map(|k| middle[k] + half[k]), size }
    }

    /// Pixels to a unit of the plan.
    fn per(&self) -> [f64; 2] {
        [0, 1].map(|k| self.size[k] as f64 / (self.high[k] - self.low[k]))
    }

    #[inline]
    fn pixel(&self, [x, y]: [f64; 2], per: [f64; 2]) -> [f64; 2] {
        [(x - self.low[0]) * per[0], (y - self.low[1]) * per[1]]
    }

    /// How often an edge has to be halved to be that fine.
    fn levels(&self, fineness: Fineness, from: [f64; 2], to: [f64; 2]) -> u32 {
        match fineness {
            Fineness::Levels(levels) => levels,
            Fineness::Pixels(most) => {
                let per = self.per();
                let ([ax, ay], [bx, by]) = (self.pixel(from, per), self.pixel(to, per));
                let halvings = libm::ceil(libm::log2(libm::hypot(bx - ax, by - ay) / most));
                halvings.clamp(0.0, f64::from(MOST_LEVELS)) as u32
            }
        }
    }

    /// The surface from above; `leaf` gives the values of a triangle.
    pub fn show<const N: usize>(
        &self,
        surface: &Surface,
        fineness: Fineness,
        leaf: impl Fn(&[Corner; 3]) -> [f64; N] + Sync,
    ) -> Raster<N> {
        let [width, height] = self.size;
        Raster::painted(width, height, |band| {
            let mut tiles: Vec<Tile> = (0..=TILE).map(Tile::new).collect();
            for patch in 0..surface.patches.triangles.len() {
                let piece = surface.piece(patch, |from, to| self.levels(fineness, from, to));
                let levels = piece.edges.iter().map(|edge| edge.levels).max().unwrap_or(0);
                self.descend(surface, &piece, [0, levels], &mut tiles, band, &leaf);
            }
        })
    }

    fn descend<const N: usize>(
        &self,
        surface: &Surface,
        piece: &Piece,
        [n, levels]: [u32; 2],
        tiles: &mut [Tile],
        band: &mut Band<N>,
        leaf: &impl Fn(&[Corner; 3]) -> [f64; N],
    ) {
        let per = self.per();
        let on_picture = |[a, b, c]: &[Corner; 3]| {
            [self.pixel(a.place, per), self.pixel(b.place, per), self.pixel(c.place, per)]
        };
        let places = on_picture(&piece.corners);
        if !band.is_reached(&places) {
            return;
        }
        if levels - n > TILE {
            let displaced = piece.edges.map(|edge| n < edge.levels);
            for part in &surface.divide(piece, n, displaced) {
                self.descend(surface, part, [n + 1, levels], tiles, band, leaf);
            }
            return;
        }
        let tile = &mut tiles[(levels - n) as usize];
        tile.fill(surface, piece, n);
        tile.triangles(&mut |corners| {
            let places = on_picture(corners);
            if band.is_reached(&places) {
                band.add(places, &leaf(corners));
            }
        });
    }
}

/// A flat layer overhead, seen by a camera on the ground that looks at the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overhead {
    /// Where in the plan the camera stands.
    pub eye: [f64; 2],
    /// Where it looks, of length 1.
    pub heading: [f64; 2],
    /// How far the layer is above it, in the unit of the plan.
    pub above: f64,
    /// Pixels to a unit at a distance of one.
    pub focal: f64,
    /// The row of the horizon, counted from the top.
    pub horizon: f64,
    /// Width and height of the picture in pixels.
    pub size: [usize; 2],
}

impl Overhead {
    /// The place on the picture, and the distance along the heading.
    fn pixel(&self, place: [f64; 2]) -> ([f64; 2], f64) {
        let [dx, dy] = [place[0] - self.eye[0], place[1] - self.eye[1]];
        let [hx, hy] = self.heading;
        let (depth, side) = (dx * hx + dy * hy, dy * hx - dx * hy);
        let column = 0.5 * self.size[0] as f64 + self.focal * side / depth;
        ([column, self.horizon - self.focal * self.above / depth], depth)
    }

    /// The distance at which the layer leaves the picture at the top, less a little.
    fn near(&self) -> f64 {
        0.9 * self.focal * self.above / self.horizon.max(1.0)
    }

    /// The layer; `leaf` gives the values of a triangle.
    pub fn show<const N: usize>(
        &self,
        surface: &Surface,
        pixels: f64,
        leaf: impl Fn(&[Corner; 3]) -> [f64; N] + Sync,
    ) -> Raster<N> {
        let [width, height] = self.size;
        let (limit, near) = (Projected { view: self, pixels }, self.near());
        Raster::painted(width, height, |band| {
            let (top, bottom) = band.reach();
            let seen = |piece: &Piece| {
                let all = piece.corners.map(|corner| self.pixel(corner.place));
                if all.iter().all(|(_, depth)| *depth < near) {
                    return false;
                }
                // A row is a distance: what of it is in front reaches from the nearest to the farthest corner.
                let row = |depth: f64| self.horizon - self.focal * self.above / depth.max(near);
                let [a, b, c] = all.map(|(_, depth)| row(depth));
                let right = |(pixel, _): &([f64; 2], f64)| pixel[0] > width as f64;
                let left = |(pixel, _): &([f64; 2], f64)| pixel[0] < 0.0;
                let in_front = all.iter().all(|(_, depth)| *depth >= near);
                a.max(b).max(c) >= top
                    && a.min(b).min(c) <= bottom
                    && !(in_front && (all.iter().all(left) || all.iter().all(right)))
            };
            for patch in 0..surface.patches.triangles.len() {
                let piece = surface.piece(patch, |_, _| 0);
                surface.visit(&piece, 0, &limit, &seen, &mut |corners| {
                    let all = corners.map(|corner| self.pixel(corner.place));
                    if all.iter().all(|(_, depth)| *depth >= near) {
                        band.add(all.map(|(pixel, _)| pixel), &leaf(corners));
                    }
                });
            }
        })
    }
}

/// Divides what is longer than so many pixels.
struct Projected<'a> {
    view: &'a Overhead,
    pixels: f64,
}

impl Limit for Projected<'_> {
    fn divides(&self, n: u32, from: &Corner, to: &Corner, edge: &Edge) -> bool {
        let near = self.view.near();
        let [(a, from), (b, to)] = [from, to].map(|corner| self.view.pixel(corner.place));
        if n >= MOST_LEVELS || (from < near && to < near) {
            return false;
        }
        if from < near || to < near {
            return edge.original * libm::exp2(-f64::from(n)) > 0.02 * near;
        }
        let [dx, dy] = [a[0] - b[0], a[1] - b[1]];
        dx * dx + dy * dy > self.pixels * self.pixels
    }
}

impl<const N: usize> Band<N> {
    /// Whether a triangle reaches into the band.
    #[inline]
    fn is_reached(&self, places: &[[f64; 2]; 3]) -> bool {
        let (top, bottom) = self.reach();
        let [a, b, c] = places.map(|place| place[1]);
        a.max(b).max(c) >= top
            && a.min(b).min(c) <= bottom
            && places.iter().any(|place| place[0] >= 0.0)
            && places.iter().any(|place| place[0] <= self.width())
    }
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::quadrangle;
    use super::super::{Amplitude, EdgeLength, centroid};
    use super::*;

    fn window() -> Window {
        Window { low: [-0.1, -0.2], high: [1.3, 1.2], size: [40, 40] }
    }

    #[test]
    fn a_finer_surface_shows_the_same_plan() {
        let surface = quadrangle(Amplitude::ThreeMinusD, EdgeLength::Original, 2.4);
        let place = |leaf: &[Corner; 3]| {
            let [x, y, _] = centroid(leaf);
            [x, y]
        };
        let coarse = window().show(&surface, Fineness::Levels(2), place);
        let fine = window().show(&surface, Fineness::Pixels(0.5), place);
        for k in 0..1600 {
            assert!((coarse.cover[k] - fine.cover[k]).abs() < 1e-9);
            if fine.cover[k] > 1.0 - 1e-9 {
                let known = [-0.1 + 0.035 * ((k % 40) as f64 + 0.5), -0.2 + 0.035 * ((k / 40) as f64 + 0.5)];
                for (ours, known) in fine.pixels[k].iter().zip(known) {
                    assert!((ours - known).abs() < 0.01);
                }
            }
        }
        // Edges of 28 to 46 pixels are halved six times at least.
        assert!(fine.triangles >= 2 * 4_u64.pow(6) && coarse.triangles < 200);
    }

    #[test]
    fn threads_do_not_matter() {
        let surface = quadrangle(Amplitude::ThreeMinusD, EdgeLength::Original, 2.4);
        let view = Overhead {
            eye: [0.6, 2.0],
            heading: [0.0, -1.0],
            above: 0.4,
            focal: 60.0,
            horizon: 45.0,
            size: [64, 64],
        };
        let height = |leaf: &[Corner; 3]| [centroid(leaf)[2]];
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                (window().show(&surface, Fineness::Pixels(0.7), height), view.show(&surface, 0.7, height))
            })
        };
        assert_eq!(with(1), with(3));
    }

    /// A square grid of a flat layer: each place is where the formula of perspective has it, nothing below the horizon.
    #[test]
    fn overhead_is_a_perspective() {
        let surface = quadrangle(Amplitude::ThreeMinusD, EdgeLength::Original, 2.0);
        let view = Overhead {
            eye: [0.6, 2.0],
            heading: [0.0, -1.0],
            above: 0.4,
            focal: 60.0,
            horizon: 45.0,
            size: [64, 64],
        };
        let place = |leaf: &[Corner; 3]| {
            let [x, y, _] = centroid(leaf);
            [x, y]
        };
        let seen = view.show(&surface, 0.5, place);
        let mut met = 0;
        for k in (0..64 * 64).filter(|k| seen.cover[*k] > 1.0 - 1e-9) {
            let (column, row) = ((k % 64) as f64 + 0.5, (k / 64) as f64 + 0.5);
            let depth = 60.0 * 0.4 / (45.0 - row);
            let known = [0.6 + (column - 32.0) * depth / 60.0, 2.0 - depth];
            for (ours, known) in seen.pixels[k].iter().zip(known) {
                assert!((ours - known).abs() < 0.02, "{k}");
            }
            met += 1;
        }
        assert!(met > 100, "{met}");
        assert!((45 * 64..64 * 64).all(|k| seen.cover[k] < 1e-12));
    }
}
