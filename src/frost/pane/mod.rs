//! Frost as a camera sees it on a window at night. Beyond the page, which colours points.
//!
//! u above 1 is ice that was deposited ([`Frost::u`]), so it is the thickness: a cell that froze early has gained ice
//! ever since, and stands out. Of the 1 that a cell holds when it freezes a quarter counts, as new ice is a film. What
//! the model does not have is fitted to the look, and stated: the pane is [`PANE_MM`] wide, and of the ice of the film's
//! last frame 95 % is thinner than [`THICK_MM`]. That scale is one for the film, which does not flicker.
//!
//! | step | how |
//! |---|---|
//! | cells to a surface | the smooth box spline of the lattice, at 4 samples a cell or more along each axis |
//! | the surface's normal | central differences of the thickness between samples |
//! | crystals | each branch leans a little, at random: `branch.rs` |
//! | light | milk, refraction, blur, Fresnel: `optics.rs` |
//! | the scene behind | a winter evening out of focus: `night.rs` |
//! | samples to pixels | their mean, as light |
//!
//! The result is scene-linear; [`EXPOSURE`] and [`CURVE`] develop it.

mod branch;
mod coat;
mod night;
mod optics;

use nalgebra::point;
use rayon::prelude::*;

use super::Frost;
use crate::hexgrid::Region;
use crate::image::{Exposure, ImageError, Photograph, ToneCurve};
use crate::rng::Seed;
use crate::sketch::Chart;
use coat::{Coat, Sample};
use night::{Light, Night};
pub use optics::{EXTINCTION, INDEX};
use optics::{Place, seen};

/// Width of the pane in mm, whatever its pixels.
pub const PANE_MM: f64 = 420.0;
/// Of the ice in the last frame 95 % is thinner than this, in mm.
pub const THICK_MM: f64 = 0.9;
/// How the photographs are exposed.
pub const EXPOSURE: Exposure = Exposure { stops: 0.0 };
/// How they are developed.
pub const CURVE: ToneCurve = ToneCurve::Filmic;

/// How far the scene is behind the pane: the shift by a slope of 1 in a ray's direction, in mm on the pane.
const DEPTH_MM: f32 = 26.0;
/// Ice of this thickness, in mm, blurs what is behind by 1 - 1/e of the most.
const ROUGH_MM: f32 = 0.20;
/// What of the 1 that a cell holds when it freezes lies above the glass: new ice is a film. In units of u.
const NEW: f32 = 0.25;
/// Samples of a cell along an axis, at the least.
const SAMPLES: f64 = 4.0;
/// Samples of a pixel along an axis, at the least and at the most.
const FINE: (f64, f64) = (2.0, 6.0);
/// Pixels along the sides of a tile, in which all pixels have equally many samples.
const TILE: usize = 16;

/// Thickness of the ice on each cell at one moment, in units of u.
#[derive(Clone, Debug, PartialEq)]
pub struct Thickness(Vec<f32>);

impl Thickness {
    /// That of a film's frame: u where it is 1 or more, no ice elsewhere.
    pub fn of(frost: &Frost) -> Self {
        let ice = |cell| if frost.is_ice(cell) { frost.u(cell) as f32 } else { 0.0 };
        Self((0..frost.region().len()).map(ice).collect())
    }

    /// The thickness that this share of the ice does not exceed; 1 where there is no ice.
    pub fn quantile(&self, share: f64) -> f32 {
        let mut ice: Vec<f32> = self.0.iter().copied().filter(|h| *h > 0.0).collect();
        ice.sort_unstable_by(f32::total_cmp);
        let at = (share * ice.len() as f64) as usize;
        ice.get(at.min(ice.len().saturating_sub(1))).copied().unwrap_or(1.0)
    }
}

/// A pane that is photographed again and again while frost grows on it.
pub struct Pane {
    chart: Chart,
    shift: f32,
    leans: Vec<[f32; 2]>,
    mm_per_u: f32,
    night: Night,
    region: Region,
}

impl Pane {
    /// Photographs of the film that ends as `last`, laid out by a chart of its sketch; the seed decides how crystals
    /// lean. What the last frame fixes is the same in every frame: nothing flickers.
    pub fn new(chart: Chart, last: &Frost, seed: Seed) -> Self {
        let typical = Thickness::of(last).quantile(0.95);
        Self {
            // A thin prism turns the ray by (index - 1) times its slope.
            shift: (INDEX - 1.0) * DEPTH_MM * (f64::from(chart.width()) / PANE_MM) as f32,
            leans: branch::leans(last, seed),
            mm_per_u: THICK_MM as f32 / (typical - 1.0 + NEW),
            night: Night::new(chart.width(), chart.height()),
            region: last.region().clone(),
            chart,
        }
    }

    /// Samples of a pixel along each axis in the tile there: as many as its cells need.
    fn samples(&self, left: usize, top: usize) -> usize {
        let cell = self.chart.cell_pixels(left as f64, top as f64);
        libm::ceil(SAMPLES / cell).clamp(FINE.0, FINE.1) as usize
    }

    /// The pane with so much ice on it.
    ///
    /// # Errors
    ///
    /// None for a chart of its size; the type is that of [`Photograph::new`].
    pub fn photograph(&self, thickness: &Thickness) -> Result<Photograph, ImageError> {
        let coat = Coat::new(&self.region, |cell| match thickness.0[cell] {
            u if u > 0.0 => [(u - 1.0 + NEW) * self.mm_per_u, self.leans[cell][0], self.leans[cell][1], 1.0],
            _ => [0.0; 4],
        });
        let (width, height) = (self.chart.width() as usize, self.chart.height() as usize);
        let mut pixels = vec![[0.0; 3]; width * height];
        pixels.par_chunks_mut(width * TILE).enumerate().for_each(|(band, pixels)| {
            self.band(&coat, band * TILE, pixels);
        });
        Photograph::new(self.chart.width(), self.chart.height(), pixels)
    }

    /// Some rows of pixels, from row `top` on.
    fn band(&self, coat: &Coat, top: usize, pixels: &mut [[f32; 3]]) {
        let width = self.chart.width() as usize;
        let mut surface = Vec::new();
        for left in (0..width).step_by(TILE) {
            let tile = Tile { left, top, columns: TILE.min(width - left), rows: pixels.len() / width };
            self.tile(coat, &tile, &mut surface, |x, y, light| pixels[y * width + left + x] = light);
        }
    }

    /// The pixels of a tile, each handed to `put` with its place in the tile.
    fn tile(
        &self,
        coat: &Coat,
        tile: &Tile,
        surface: &mut Vec<Option<Sample>>,
        mut put: impl FnMut(usize, usize, [f32; 3]),
    ) {
        let fine = self.samples(tile.left, tile.top);
        let step = 1.0 / fine as f64;
        // One sample more on every side, for differences.
        let (across, down) = (tile.columns * fine + 2, tile.rows * fine + 2);
        let x = |i: usize| tile.left as f64 + (i as f64 - 0.5) * step;
        let y = |j: usize| tile.top as f64 + (j as f64 - 0.5) * step;
        surface.clear();
        for j in 0..down {
            surface.extend((0..across).map(|i| coat.at(self.chart.place_of(point![x(i), y(j)])).map(shaped)));
        }
        let slope_scale = (0.5 * f64::from(self.chart.width()) / (PANE_MM * step)) as f32;
        let weight = 1.0 / (fine * fine) as f32;
        for row in 0..tile.rows {
            for column in 0..tile.columns {
                let (px, py) = ((tile.left + column) as f32 + 0.5, (tile.top + row) as f32 + 0.5);
                let mut sum: Light = [0.0; 4];
                let mut add = |light: Light, weight: f32| {
                    for (sum, light) in sum.iter_mut().zip(light) {
                        *sum += weight * light;
                    }
                };
                let mut bare = 0;
                let mut glow = None;
                for j in row * fine + 1..=(row + 1) * fine {
                    for i in column * fine + 1..=(column + 1) * fine {
                        let at = j * across + i;
                        let Some(sample) = surface[at] else {
                            bare += 1;
                            continue;
                        };
                        let thick = |at: usize| surface[at].map_or(0.0, |sample| sample[0]);
                        let slope = [
                            (thick(at + 1) - thick(at - 1)) * slope_scale,
                            (thick(at + across) - thick(at - across)) * slope_scale,
                        ];
                        let glow = *glow.get_or_insert_with(|| self.night.at(px, py, 1.0));
                        add(self.lit(sample, slope, glow, [x(i) as f32, y(j) as f32]), weight);
                    }
                }
                if bare > 0 {
                    add(self.night.at(px, py, 0.0), weight * bare as f32);
                }
                let lens = self.lens(px, py);
                put(column, row, [lens * sum[0], lens * sum[1], lens * sum[2]]);
            }
        }
    }

    /// The light from a place with ice, in pixels.
    #[inline]
    fn lit(
        &self,
        [h, lean_x, lean_y, open]: Sample,
        slope: [f32; 2],
        glow: Light,
        [x, y]: [f32; 2],
    ) -> Light {
        let slope = [slope[0] + lean_x, slope[1] + lean_y];
        let rough = 1.0 - libm::expf(-h / ROUGH_MM);
        let behind = self.night.at(x + self.shift * slope[0], y + self.shift * slope[1], rough);
        seen(&Place { passes: libm::expf(-EXTINCTION * h), slope, behind, glow, open })
    }

    /// What the lens lets through towards its corners: the fourth power of the cosine, 25 degrees from the axis there.
    fn lens(&self, x: f32, y: f32) -> f32 {
        const TANGENT: f32 = 0.466;
        let (width, height) = (self.chart.width() as f32, self.chart.height() as f32);
        let (x, y) = (x - 0.5 * width, y - 0.5 * height);
        let squared = 1.0 + 4.0 * TANGENT * TANGENT * (x * x + y * y) / (width * width + height * height);
        1.0 / (squared * squared)
    }
}

/// A part of the picture, in pixels.
struct Tile {
    left: usize,
    top: usize,
    columns: usize,
    rows: usize,
}

/// The spline's blur at the rim of the ice undone: as thick as it is where the rim is, and nothing outside.
fn shaped([h, x, y, cover]: Sample) -> Sample {
    let t = ((cover - 0.12) / 0.5).clamp(0.0, 1.0);
    let rim = t * t * (3.0 - 2.0 * t);
    let each = if cover > 0.0 { rim / cover } else { 0.0 };
    [h * rim, x * each, y * each, 0.55 + 0.45 * rim]
}

#[cfg(test)]
mod tests;
