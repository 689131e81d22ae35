//! The picture, tile by tile: each pixel by itself, so that no number of threads changes a bit.

use rayon::prelude::*;

use super::camera::Camera;
use super::dots::Dot;
use super::grid::Ray;
use super::ready::{Drawn, Ready, Traced};
use super::sequence::Samples;
use super::sight::{CUTOFF, Seen};
use super::{Picture, Scene, Work};

/// The side of a tile, pixels.
const TILE: usize = 32;

/// A flake that is drawn by rays.
struct Followed<'a> {
    ready: &'a Ready<'a>,
    traced: &'a Traced<'a>,
}

/// A dot.
struct Laid<'a> {
    ready: &'a Ready<'a>,
    dot: &'a Dot,
}

/// A dot's share of a pixel.
#[derive(Clone, Copy)]
struct Layer {
    pixel: u32,
    opacity: f32,
    lit: f32,
    dot: u32,
}

impl Layer {
    fn share(&self) -> Seen {
        Seen { lit: f64::from(self.lit), transmittance: 1.0 - f64::from(self.opacity) }
    }
}

/// What a ray enters: how far away, which, and the ray within.
type Entry = (f64, usize, Ray);

/// What all tiles need.
struct Tiles<'a> {
    scene: &'a Scene<'a>,
    camera: &'a Camera,
    background: &'a [[f32; 3]],
    samples: Samples,
    followed: Vec<Followed<'a>>,
    laid: Vec<Laid<'a>>,
}

/// Makes the picture of flakes, near ones first.
pub(super) fn picture(
    scene: &Scene,
    camera: &Camera,
    background: &[[f32; 3]],
    samples: Samples,
    ready: &[Ready],
) -> Picture {
    let [left, top, width, height] = camera.window;
    let (across, down) = (width.div_ceil(TILE), height.div_ceil(TILE));
    let (mut followed, mut laid) = (Vec::new(), Vec::new());
    let mut lists: Vec<[Vec<u32>; 2]> = vec![[Vec::new(), Vec::new()]; across * down];
    for ready in ready {
        let (kind, number) = match &ready.drawn {
            Drawn::Traced(traced) => {
                followed.push(Followed { ready, traced });
                (0, followed.len() - 1)
            }
            Drawn::Dot(dot) => {
                laid.push(Laid { ready, dot });
                (1, laid.len() - 1)
            }
        };
        let more = [1.0, ready.screen.margin()][kind];
        let columns = ready.screen.span(0, more, left, left + width);
        let rows = ready.screen.span(1, more, top, top + height);
        if let (Some(columns), Some(rows)) = (columns, rows) {
            for row in (rows[0] - top) / TILE..=(rows[1] - top) / TILE {
                for column in (columns[0] - left) / TILE..=(columns[1] - left) / TILE {
                    lists[row * across + column][kind].push(number as u32);
                }
            }
        }
    }
    let tiles = Tiles { scene, camera, background, samples, followed, laid };
    let place = |tile: usize| {
        let [x, y] = [left + tile % across * TILE, top + tile / across * TILE];
        [[x, (x + TILE).min(left + width)], [y, (y + TILE).min(top + height)]]
    };
    let made: Vec<_> = lists
        .par_iter()
        .enumerate()
        .map(|(tile, [followed, laid])| tiles.tile(place(tile), followed, laid))
        .collect();
    let mut picture = Picture {
        size: [width, height],
        radiance: vec![[0.0; 3]; width * height],
        coverage: vec![0.0; width * height],
        visible: 0,
        work: Work::default(),
    };
    for (tile, (pixels, work)) in made.into_iter().enumerate() {
        picture.work += work;
        let [columns, rows] = place(tile);
        let wide = columns[1] - columns[0];
        for (row, pixels) in (rows[0]..rows[1]).zip(pixels.chunks_exact(wide)) {
            let first = (row - top) * width + columns[0] - left;
            for (at, (radiance, coverage)) in (first..).zip(pixels) {
                picture.radiance[at] = *radiance;
                picture.coverage[at] = *coverage;
            }
        }
    }
    picture
}

impl Tiles<'_> {
    fn tile(
        &self,
        [columns, rows]: [[usize; 2]; 2],
        followed: &[u32],
        laid: &[u32],
    ) -> (Vec<([f32; 3], f32)>, Work) {
        let mut work = Work::default();
        let wide = columns[1] - columns[0];
        let number = wide * (rows[1] - rows[0]);
        work.samples += (number * self.samples.count()) as u64;
        let (layers, firsts) = self.layers([columns, rows], laid, &mut work);
        let (mut may, mut entries) = (Vec::new(), Vec::new());
        let mut pixels = Vec::with_capacity(number);
        for row in rows[0]..rows[1] {
            for column in columns[0]..columns[1] {
                let at = pixels.len();
                let pixel = [column, row];
                let layers = &layers[firsts[at]..firsts[at + 1]];
                may.clear();
                may.extend(followed.iter().filter(|k| self.followed[**k as usize].ready.screen.meets(pixel)));
                let seen = self.pixel(pixel, layers, &may, &mut entries, &mut work);
                let [left, top, width, _] = self.camera.window;
                pixels.push(self.colour(seen, self.background[(row - top) * width + column - left]));
            }
        }
        (pixels, work)
    }

    /// Shares of dots, of each pixel of the tile near ones first, and where those of each pixel begin.
    fn layers(
        &self,
        [columns, rows]: [[usize; 2]; 2],
        laid: &[u32],
        work: &mut Work,
    ) -> (Vec<Layer>, Vec<usize>) {
        let wide = columns[1] - columns[0];
        let number = wide * (rows[1] - rows[0]);
        let clip = [columns, rows].map(|[from, end]| [from as i64, end as i64 - 1]);
        let mut shares = [[0.0_f64; 2]; TILE * TILE];
        let mut unsorted: Vec<Layer> = Vec::new();
        let mut firsts = vec![0; number + 1];
        for k in laid {
            let Laid { ready, dot } = &self.laid[*k as usize];
            // Pixels that it was laid on.
            let (mut from, mut end) = ([TILE; 2], [0; 2]);
            work.squares += dot.lay(self.camera, ready.place, ready.motion, clip, |column, row, share| {
                let at = [(column - clip[0][0]) as usize, (row - clip[1][0]) as usize];
                for axis in 0..2 {
                    from[axis] = from[axis].min(at[axis]);
                    end[axis] = end[axis].max(at[axis] + 1);
                }
                let sum = &mut shares[at[1] * TILE + at[0]];
                *sum = [sum[0] + share[0], sum[1] + share[1]];
            });
            for row in from[1]..end[1] {
                for column in from[0]..end[0] {
                    let [share, lit] = std::mem::take(&mut shares[row * TILE + column]);
                    if share > 0.0 {
                        let pixel = row * wide + column;
                        firsts[pixel + 1] += 1;
                        unsorted.push(Layer {
                            pixel: pixel as u32,
                            opacity: share.min(1.0) as f32,
                            lit: lit as f32,
                            dot: *k,
                        });
                    }
                }
            }
        }
        for at in 0..number {
            firsts[at + 1] += firsts[at];
        }
        let mut next = firsts.clone();
        let mut layers = vec![Layer { pixel: 0, opacity: 0.0, lit: 0.0, dot: 0 }; unsorted.len()];
        for layer in unsorted {
            let at = &mut next[layer.pixel as usize];
            layers[*at] = layer;
            *at += 1;
        }
        (layers, firsts)
    }

    /// The mean over the samples of a pixel.
    fn pixel(
        &self,
        pixel: [usize; 2],
        layers: &[Layer],
        may: &[&u32],
        entries: &mut Vec<Entry>,
        work: &mut Work,
    ) -> Seen {
        let dots = layers.iter().fold(Seen::NOTHING, |seen, layer| seen.before(layer.share()));
        if may.is_empty() {
            return dots;
        }
        let mut sum = Seen { lit: 0.0, transmittance: 0.0 };
        for sample in self.samples.of(pixel) {
            work.rays += 1;
            let place = [pixel[0] as f64 + sample.pixel[0], pixel[1] as f64 + sample.pixel[1]];
            let ray = self.camera.ray(place, sample.lens.map(|x| x * self.camera.aperture));
            entries.clear();
            for k in may {
                let Followed { ready, traced } = &self.followed[**k as usize];
                let centre = [0, 1, 2].map(|axis| ready.place[axis] + ready.motion[axis] * sample.time);
                if let Some((distance, within)) = traced.enter(ray, centre) {
                    entries.push((distance, **k as usize, within));
                }
            }
            let seen = if entries.is_empty() {
                dots
            } else {
                entries.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                self.along(entries, ray[1][2], layers, work)
            };
            sum.lit += seen.lit;
            sum.transmittance += seen.transmittance;
        }
        let count = self.samples.count() as f64;
        Seen { lit: sum.lit / count, transmittance: sum.transmittance / count }
    }

    /// What flakes and dots show along a ray, by their distance; `slope` is how much of it is along the view.
    fn along(&self, entries: &[Entry], slope: f64, layers: &[Layer], work: &mut Work) -> Seen {
        let mut seen = Seen::NOTHING;
        let mut layers = layers.iter().peekable();
        for (distance, k, ray) in entries {
            let z = distance * slope;
            while let Some(layer) = layers.next_if(|layer| self.laid[layer.dot as usize].ready.place[2] < z) {
                seen = seen.before(layer.share());
            }
            if seen.transmittance < CUTOFF {
                return seen;
            }
            work.flakes += 1;
            seen = seen.before(self.followed[*k].traced.lit.see(ray, &mut work.cells));
        }
        layers.fold(seen, |seen, layer| seen.before(layer.share()))
    }

    /// Radiance before a background, and coverage.
    fn colour(&self, seen: Seen, background: [f32; 3]) -> ([f32; 3], f32) {
        if seen.transmittance == 1.0 && seen.lit == 0.0 {
            return (background, 0.0);
        }
        let himeno = &self.scene.light;
        let coverage = (1.0 - seen.transmittance).max(0.0);
        let channel = |c: usize| {
            let flakes = himeno.light[c] * seen.lit + himeno.ambient * himeno.ambient_light[c] * coverage;
            (flakes + f64::from(background[c]) * seen.transmittance) as f32
        };
        ([0, 1, 2].map(channel), coverage as f32)
    }
}
