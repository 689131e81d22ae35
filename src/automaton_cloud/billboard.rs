//! Metaballs shown as billboards: discs that face the viewer, each as opaque as its ball is along the line of sight.
//!
//! Two passes. Seen from the sun, nearest to it first, each ball finds in its centre the light that the balls before it
//! have left, and then takes its own share. Seen from the camera, farthest first, each is blended over what is behind it.
//!
//! The density of a ball is Wyvill's, with r the distance from its centre over its radius D: q (1 - 4/9 r^6 + 17/9 r^4 -
//! 22/9 r^2). With v = 1 - r^2 it is q (5 v^2 + 4 v^3) / 9, and its integral along a line b from the centre
//! q D u^5 (16/27 + 128/315 u^2), u^2 = 1 - b^2 / D^2: no table is needed.

use std::ops::Range;

use rayon::prelude::*;

use crate::volume::{Camera, VolumeError, exp, henyey_greenstein};

/// Pixels along the side of a tile, which one thread works out.
const TILE: usize = 32;

/// A ball of density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metaball {
    /// Its centre, m.
    pub centre: [f64; 3],
    /// q, the density there.
    pub density: f64,
    /// D, beyond which there is none, m.
    pub radius: f64,
}

impl Metaball {
    /// The density at a squared distance from the centre, m2.
    pub fn at(&self, square: f64) -> f64 {
        let v = 1.0 - square / (self.radius * self.radius);
        if v > 0.0 { self.density * v * v * (5.0 + 4.0 * v) / 9.0 } else { 0.0 }
    }

    /// The integral of density along a line at a squared distance, m2, from the centre: density times m.
    pub fn depth(&self, square: f64) -> f64 {
        let v = 1.0 - square / (self.radius * self.radius);
        if v <= 0.0 {
            return 0.0;
        }
        self.density * self.radius * v * v * v.sqrt() * (16.0 / 27.0 + 128.0 / 315.0 * v)
    }
}

/// How the balls are lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Billboards {
    /// tau, the extinction of a density of 1, 1/m.
    pub extinction: f64,
    /// g of the phase function of Henyey & Greenstein, within -1 to 1.
    pub g: f64,
    /// Where the sun is.
    pub to_sun: [f64; 3],
    /// Irradiance of what is square to the sun, red, green and blue.
    pub sun: [f64; 3],
    /// Pixels across and down of the picture as the sun sees it, which is framed around all balls.
    pub shadow: [usize; 2],
}

/// What was done, the same on every machine: in the sun's pass, then in the camera's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Splats {
    /// Balls of which some disc is on the picture.
    pub splats: [u64; 2],
    /// Pixels of their discs.
    pub pixels: [u64; 2],
}

/// A picture of light before a background: radiance + transmittance x background.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Radiance, red, green and blue, row by row from the top.
    pub radiance: Vec<[f32; 3]>,
    /// What is left of the background's light.
    pub transmittance: Vec<f32>,
    /// What of the sun's light reaches each ball's centre, 0 to 1.
    pub shadows: Vec<f64>,
    /// What was done.
    pub work: Splats,
}

/// The disc of a ball on a picture.
#[derive(Clone, Copy)]
struct Disc {
    ball: usize,
    /// Its centre, pixels, and how far away it is, m.
    pixel: [f64; 2],
    far: f64,
    /// Metres to a pixel across and down.
    metres: [f64; 2],
}

impl Billboards {
    /// The picture of the balls. A disc stands square to the view at its ball's centre; balls whose centres are behind a
    /// pinhole are not seen.
    ///
    /// # Errors
    ///
    /// [`VolumeError`] for numbers that make no picture.
    pub fn show(&self, balls: &[Metaball], camera: &Camera) -> Result<Shown, VolumeError> {
        self.check(balls)?;
        let size = camera.size();
        let mut work = Splats::default();
        let shadows = if balls.is_empty() { Vec::new() } else { self.shadows(balls, &mut work)? };
        let mut discs = discs(balls, camera);
        discs.sort_by(|a, b| b.far.total_cmp(&a.far).then(a.ball.cmp(&b.ball)));
        // Any box: what is asked for is the direction, of length 1.
        let sun = Camera::parallel([[0.0; 3], [1.0; 3]], self.to_sun, camera.view(), [1, 1])?.view();
        let pass = pass(&discs, balls, size, |[columns, rows], inside| {
            let mut pixels = vec![(0.0, 1.0); columns.len() * rows.len()];
            let mut count = 0;
            for disc in inside {
                let ball = &balls[disc.ball];
                let light = shadows[disc.ball];
                disc.pixels(ball, [&columns, &rows], |at, square| {
                    let left = exp(-self.extinction * ball.depth(square));
                    let (lit, transmittance): &mut (f64, f64) = &mut pixels[at];
                    *lit = light * (1.0 - left) + left * *lit;
                    *transmittance *= left;
                    count += 1;
                });
            }
            (pixels, count)
        });
        work.splats[1] = pass.splats;
        let mut shown = Shown {
            size,
            radiance: vec![[0.0; 3]; size[0] * size[1]],
            transmittance: vec![1.0; size[0] * size[1]],
            shadows,
            work,
        };
        for ([columns, rows], (pixels, count)) in pass.tiles {
            shown.work.pixels[1] += count;
            for (k, (lit, transmittance)) in pixels.into_iter().enumerate() {
                let [column, row] = [columns.start + k % columns.len(), rows.start + k / columns.len()];
                let to = camera.sample([column, row], [0, 0], 1).direction;
                let cosine = sun[0] * to[0] + sun[1] * to[1] + sun[2] * to[2];
                let phase = henyey_greenstein(self.g, cosine);
                shown.radiance[row * size[0] + column] = self.sun.map(|sun| (sun * phase * lit) as f32);
                shown.transmittance[row * size[0] + column] = transmittance as f32;
            }
        }
        Ok(shown)
    }

    /// What of the sun's light reaches each ball's centre: the pixel that the centre is in, as the balls nearer to the sun
    /// left it. Optical depths are added, which is transmittances multiplied.
    fn shadows(&self, balls: &[Metaball], work: &mut Splats) -> Result<Vec<f64>, VolumeError> {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for ball in balls {
            for axis in 0..3 {
                low[axis] = low[axis].min(ball.centre[axis] - ball.radius);
                high[axis] = high[axis].max(ball.centre[axis] + ball.radius);
            }
        }
        let away = self.to_sun.map(|x| -x);
        let camera = Camera::parallel([low, high], away, [0.0, 0.0, 1.0], self.shadow)?;
        let mut discs = discs(balls, &camera);
        discs.sort_by(|a, b| a.far.total_cmp(&b.far).then(a.ball.cmp(&b.ball)));
        let pass = pass(&discs, balls, self.shadow, |[columns, rows], inside| {
            let mut depths = vec![0.0; columns.len() * rows.len()];
            let (mut found, mut count) = (Vec::new(), 0);
            for disc in inside {
                let [column, row] = disc.pixel.map(|x| x.max(0.0) as usize);
                // Rounding may put a centre on the far edge of the picture.
                let [column, row] = [column.min(self.shadow[0] - 1), row.min(self.shadow[1] - 1)];
                if columns.contains(&column) && rows.contains(&row) {
                    let at = (row - rows.start) * columns.len() + column - columns.start;
                    found.push((disc.ball, exp(-self.extinction * depths[at])));
                }
                let ball = &balls[disc.ball];
                disc.pixels(ball, [&columns, &rows], |at, square| {
                    depths[at] += ball.depth(square);
                    count += 1;
                });
            }
            (found, count)
        });
        work.splats[0] = pass.splats;
        let mut shadows = vec![1.0; balls.len()];
        for (_, (found, count)) in pass.tiles {
            work.pixels[0] += count;
            found.into_iter().for_each(|(ball, light)| shadows[ball] = light);
        }
        Ok(shadows)
    }

    fn check(&self, balls: &[Metaball]) -> Result<(), VolumeError> {
        let within = |name, value: f64, low, high, accepted| {
            if value >= low && value <= high {
                Ok(())
            } else {
                Err(VolumeError::OutOfRange { name, value, accepted })
            }
        };
        within("the extinction, 1/m,", self.extinction, 0.0, 1e30, "0 to 1e30")?;
        within("g", self.g, -0.9999, 0.9999, "-0.9999 to 0.9999")?;
        for value in self.sun {
            within("the irradiance of the sun", value, 0.0, 1e30, "0 to 1e30")?;
        }
        for ball in balls {
            within("a ball's density", ball.density, 0.0, 1e30, "0 to 1e30")?;
            within("a ball's radius, m,", ball.radius, 1e-9, 1e9, "1e-9 to 1e9")?;
            for value in ball.centre {
                within("a ball's place, m,", value, -1e9, 1e9, "-1e9 to 1e9")?;
            }
        }
        Ok(())
    }
}

fn discs(balls: &[Metaball], camera: &Camera) -> Vec<Disc> {
    let disc = |(ball, of): (usize, &Metaball)| {
        let (pixel, far, scale) = camera.project(of.centre)?;
        Some(Disc { ball, pixel, far, metres: scale.map(|pixels| 1.0 / pixels) })
    };
    balls.iter().enumerate().filter_map(disc).collect()
}

impl Disc {
    /// The pixels whose middles may be on it along an axis, of a picture with `most`.
    fn range(&self, axis: usize, radius: f64, most: usize) -> Range<usize> {
        let half = radius / self.metres[axis];
        // A float that is too large for a whole number becomes the largest.
        let low = (self.pixel[axis] - half - 0.5).ceil().max(0.0) as usize;
        let high = (self.pixel[axis] + half + 0.5).floor().max(0.0) as usize;
        low.min(most)..high.min(most)
    }

    /// Visits the pixels of a tile whose middles are on it, with the squared distance, m2, of each from its centre.
    fn pixels(
        &self,
        ball: &Metaball,
        [columns, rows]: [&Range<usize>; 2],
        mut visit: impl FnMut(usize, f64),
    ) {
        let part = |axis: usize, tile: &Range<usize>| {
            let all = self.range(axis, ball.radius, tile.end);
            all.start.max(tile.start)..all.end
        };
        let (across, down) = (part(0, columns), part(1, rows));
        let off = |axis: usize, at: usize| {
            let off = (at as f64 + 0.5 - self.pixel[axis]) * self.metres[axis];
            off * off
        };
        let most = ball.radius * ball.radius;
        for row in down {
            let above = off(1, row);
            let first = (row - rows.start) * columns.len();
            for column in across.clone() {
                let square = off(0, column) + above;
                if square < most {
                    visit(first + column - columns.start, square);
                }
            }
        }
    }
}

/// All tiles of a picture, in order, with what came of each.
struct Pass<T> {
    splats: u64,
    tiles: Vec<([Range<usize>; 2], T)>,
}

/// Works tiles out side by side, each with the discs that touch it, in their order.
fn pass<T: Send>(
    discs: &[Disc],
    balls: &[Metaball],
    size: [usize; 2],
    tile: impl Fn([Range<usize>; 2], &mut dyn Iterator<Item = &Disc>) -> T + Sync,
) -> Pass<T> {
    let [across, down] = size.map(|pixels| pixels.div_ceil(TILE));
    let mut lists: Vec<Vec<u32>> = vec![Vec::new(); across * down];
    let mut splats = 0;
    for (k, disc) in discs.iter().enumerate() {
        let range = [0, 1].map(|axis| disc.range(axis, balls[disc.ball].radius, size[axis]));
        splats += u64::from(range.iter().all(|range| !range.is_empty()));
        // The centre's own tile too, however small the disc.
        let tiles = |axis: usize, most: usize| {
            let centre = (disc.pixel[axis].max(0.0) as usize).min(size[axis] - 1);
            let low = range[axis].start.min(centre) / TILE;
            low..(range[axis].end.max(centre + 1).div_ceil(TILE)).min(most)
        };
        for row in tiles(1, down) {
            tiles(0, across).for_each(|column| lists[row * across + column].push(k as u32));
        }
    }
    let tiles = lists.par_iter().enumerate().map(|(k, list)| {
        let range = |at: usize, most: usize| at * TILE..((at + 1) * TILE).min(most);
        let part = [range(k % across, size[0]), range(k / across, size[1])];
        let result = tile(part.clone(), &mut list.iter().map(|k| &discs[*k as usize]));
        (part, result)
    });
    Pass { splats, tiles: tiles.collect() }
}

#[cfg(test)]
mod tests;
