//! A canvas of light: strokes over what is behind them.

use rayon::prelude::*;

use super::view::View;

/// A stroke with round ends, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// One end.
    pub from: [f32; 2],
    /// The other.
    pub to: [f32; 2],
    /// Half its width at either end.
    pub radius: [f32; 2],
    /// Its light.
    pub light: [f32; 3],
    /// How much of what is behind it it hides, 0 to 1.
    pub opacity: f32,
    /// The share of its half width in which it fades out; needles do, wood does not.
    pub soft: f32,
    /// Where it is darker, right and down, and by how much of its light at that edge.
    pub dark: [f32; 2],
    /// How far away it is, m.
    pub depth: f32,
}

/// A stroke of wood, hard and evenly lit.
pub fn stroke(ends: [[f64; 2]; 2], radius: [f64; 2], light: [f32; 3], depth: f64) -> Stroke {
    let [from, to] = ends.map(|end| end.map(|x| x as f32));
    let radius = radius.map(|radius| radius as f32);
    Stroke { from, to, radius, light, opacity: 1.0, soft: 0.0, dark: [0.0; 2], depth: depth as f32 }
}

/// Rows that are painted together.
pub const BAND: usize = 32;

/// Strokes in the order in which they are laid, and which of them reach each band of rows.
#[derive(Clone, Debug, Default)]
pub struct Sheaf {
    strokes: Vec<Stroke>,
    bands: Vec<Vec<u32>>,
}

impl Sheaf {
    /// An empty one.
    pub fn new(view: &View) -> Self {
        Self { strokes: Vec::new(), bands: vec![Vec::new(); view.size[1].div_ceil(BAND)] }
    }

    /// Whether it has no strokes.
    pub fn is_empty(&self) -> bool {
        self.strokes.is_empty()
    }

    /// A stroke on top of the others. What is thinner than a pixel is a pixel wide and lets more through.
    pub fn lay(&mut self, mut stroke: Stroke) {
        let widest = stroke.radius[0].max(stroke.radius[1]);
        if widest < THINNEST {
            stroke.opacity *= widest / THINNEST;
            stroke.radius = stroke.radius.map(|radius| radius * THINNEST / widest);
        }
        let reach = stroke.radius[0].max(stroke.radius[1]) + 0.5;
        let (low, high) =
            (stroke.from[1].min(stroke.to[1]) - reach, stroke.from[1].max(stroke.to[1]) + reach);
        if !(high > 0.0 && low < (self.bands.len() * BAND) as f32) || stroke.opacity < 1e-3 {
            return;
        }
        let number = self.strokes.len() as u32;
        let last = (high as usize / BAND).min(self.bands.len() - 1);
        for band in &mut self.bands[low.max(0.0) as usize / BAND..=last] {
            band.push(number);
        }
        self.strokes.push(stroke);
    }
}

/// Half a width that a pixel shows as such.
const THINNEST: f32 = 0.5;

/// How far one sees to the ground in a pixel, m; infinitely far into the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// To the nearer ground.
    pub near: f32,
    /// Over its edge.
    pub far: f32,
    /// The share of the pixel that the nearer one has; all of it where there is no edge.
    pub share: f32,
}

impl Reach {
    /// The same in all the pixel.
    pub fn even(depth: f32) -> Self {
        Self { near: depth, far: depth, share: 1.0 }
    }

    /// The share of the pixel in which the ground is farther than a depth.
    #[inline]
    fn free(&self, depth: f32, sharp: f32) -> f32 {
        let beyond = |ground: f32| ((ground - depth) * sharp + 0.5).clamp(0.0, 1.0);
        if self.share < 1.0 {
            self.share * beyond(self.near) + (1.0 - self.share) * beyond(self.far)
        } else {
            beyond(self.near)
        }
    }
}

/// A picture that is painted from the nearest to the farthest, so that what is hidden costs little.
pub struct Painting<'a> {
    bands: Vec<Rows<'a>>,
    width: usize,
}

impl<'a> Painting<'a> {
    /// With nothing on it; `ground` says how far the ground is in every pixel, m.
    pub fn new(width: usize, ground: &'a [Reach]) -> Self {
        let band = |(band, ground): (usize, &'a [Reach])| {
            let tile = |tile: usize| (width - tile * BAND).min(BAND) * (ground.len() / width);
            Rows {
                light: vec![[0.0; 3]; ground.len()],
                left: vec![1.0; ground.len()],
                open: (0..width.div_ceil(BAND)).map(tile).collect(),
                ground,
                width,
                first: band * BAND,
            }
        };
        Self { bands: ground.chunks(width * BAND).enumerate().map(band).collect(), width }
    }

    /// Lays sheaves behind all that has been laid, the nearest first, where the ground is no nearer.
    pub fn lay(&mut self, sheaves: &[Sheaf]) {
        self.bands.par_iter_mut().enumerate().for_each(|(band, rows)| {
            for sheaf in sheaves {
                for number in sheaf.bands[band].iter().rev() {
                    rows.lay(&sheaf.strokes[*number as usize]);
                }
            }
        });
    }

    /// Whether light comes through anywhere between two corners, in pixels.
    pub fn is_open(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        let tiles = |from: f64, to: f64, count: usize| {
            let tile = |x: f64| (x.max(0.0) as usize / BAND).min(count - 1);
            tile(from)..tile(to) + 1
        };
        let columns = tiles(low[0], high[0], self.width.div_ceil(BAND));
        let bands = &self.bands[tiles(low[1], high[1], self.bands.len())];
        bands.iter().any(|rows| rows.open[columns.clone()].iter().any(|open| *open > 0))
    }

    /// The light of every pixel, row by row, with that of the ground and the sky, which is asked for where it is seen
    /// only, by pixel and distance.
    pub fn finished(self, behind: impl Fn(usize, f32) -> [f32; 3] + Sync) -> Vec<[f32; 3]> {
        let finish = |mut rows: Rows<'_>| {
            let first = rows.first * rows.width;
            for (k, (light, left)) in rows.light.iter_mut().zip(&rows.left).enumerate() {
                let reach = rows.ground[k];
                // What stands behind the edge of the nearer ground leaves all of that.
                let near = left.min(reach.share);
                for (left, depth) in [(near, reach.near), (left - near, reach.far)] {
                    if left > NOTHING {
                        let behind = behind(first + k, depth);
                        *light = [0, 1, 2].map(|k| light[k] + left * behind[k]);
                    }
                }
            }
            rows.light
        };
        let bands: Vec<Vec<[f32; 3]>> = self.bands.into_par_iter().map(finish).collect();
        bands.concat()
    }
}

/// What is left of the light behind when no more is looked for.
const NOTHING: f32 = 1.0 / 512.0;

struct Rows<'a> {
    light: Vec<[f32; 3]>,
    /// What of the light behind each pixel comes through.
    left: Vec<f32>,
    /// How many pixels of each tile let any through.
    open: Vec<usize>,
    ground: &'a [Reach],
    width: usize,
    first: usize,
}

impl Rows<'_> {
    fn lay(&mut self, stroke: &Stroke) {
        let [a, b] = [stroke.from, stroke.to];
        let most = stroke.radius[0].max(stroke.radius[1]) + 0.5;
        let left = (a[0].min(b[0]) - most).clamp(0.0, self.width as f32) as usize;
        let right = (a[0].max(b[0]) + most + 1.0).clamp(0.0, self.width as f32) as usize;
        if left >= right || self.open[left / BAND..right.div_ceil(BAND)].iter().all(|open| *open == 0) {
            return;
        }
        let along = [b[0] - a[0], b[1] - a[1]];
        let square = along[0] * along[0] + along[1] * along[1];
        let per = if square > 0.0 { 1.0 / square } else { 0.0 };
        let count = self.light.len() / self.width;
        let top = (a[1].min(b[1]) - most - self.first as f32).max(0.0) as usize;
        let bottom = (a[1].max(b[1]) + most + 1.0 - self.first as f32).clamp(0.0, count as f32) as usize;
        let thick = stroke.radius[1] - stroke.radius[0];
        // The ground hides gradually, within a fiftieth of the distance.
        let sharp = 50.0 / stroke.depth;
        for row in top..bottom {
            let y = (self.first + row) as f32 + 0.5 - a[1];
            let Some((left, right)) = span(a, along, y, most, self.width) else { continue };
            for column in left..right {
                let at = row * self.width + column;
                let behind = self.left[at];
                if behind <= NOTHING {
                    continue;
                }
                let x = column as f32 + 0.5 - a[0];
                let part = ((x * along[0] + y * along[1]) * per).clamp(0.0, 1.0);
                let off = [x - part * along[0], y - part * along[1]];
                let distance = (off[0] * off[0] + off[1] * off[1]).sqrt();
                let radius = stroke.radius[0] + part * thick;
                let fade = (stroke.soft * radius).max(1.0);
                let covered = ((radius + 0.5 - distance) / fade).min(1.0);
                if covered <= 0.0 {
                    continue;
                }
                let share = covered * stroke.opacity * self.ground[at].free(stroke.depth, sharp);
                let across = (off[0] * stroke.dark[0] + off[1] * stroke.dark[1]) / radius.max(THINNEST);
                let lost = 0.5 * (stroke.dark[0].abs() + stroke.dark[1].abs() + across.clamp(-1.0, 1.0));
                let bright = behind * share * (1.0 - lost);
                let pixel = &mut self.light[at];
                for (pixel, light) in pixel.iter_mut().zip(stroke.light) {
                    *pixel += light * bright;
                }
                self.left[at] = behind * (1.0 - share);
                if self.left[at] <= NOTHING {
                    self.open[column / BAND] -= 1;
                }
            }
        }
    }
}

/// The columns of a row that a stroke may reach, `y` below its first end.
fn span(from: [f32; 2], along: [f32; 2], y: f32, reach: f32, width: usize) -> Option<(usize, usize)> {
    // Where along the stroke its middle is within reach of the row.
    let (mut low, mut high) = (0.0_f32, 1.0_f32);
    if along[1].abs() > 1e-3 {
        let (p, q) = ((y - reach) / along[1], (y + reach) / along[1]);
        low = low.max(p.min(q));
        high = high.min(p.max(q));
    } else if y.abs() > reach + 1.0 {
        return None;
    }
    if low > high {
        return None;
    }
    let (p, q) = (low * along[0], high * along[0]);
    let left = (from[0] + p.min(q) - reach).max(0.0) as usize;
    let right = (from[0] + p.max(q) + reach + 1.0).clamp(0.0, width as f32) as usize;
    (left < right).then_some((left, right))
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: View = View { size: [40, 64], focal: 40.0 };

    fn stroke(radius: f32) -> Stroke {
        let (from, to) = ([10.0, 20.0], [30.0, 44.0]);
        let light = [1.0; 3];
        Stroke { from, to, radius: [radius; 2], light, opacity: 1.0, soft: 0.0, dark: [0.0; 2], depth: 5.0 }
    }

    fn painted(stroke: Stroke, ground: f32) -> f64 {
        let mut sheaf = Sheaf::new(&VIEW);
        sheaf.lay(stroke);
        let ground = [Reach::even(ground); 40 * 64];
        let mut painting = Painting::new(40, &ground);
        painting.lay(&[sheaf]);
        let light = painting.finished(|_, _| [0.0; 3]);
        light.iter().map(|light| f64::from(light[0])).sum()
    }

    #[test]
    fn a_stroke_has_its_area_however_thin() {
        let length = 976.0_f64.sqrt();
        for radius in [0.1_f32, 0.3, 0.5, 1.0, 3.0] {
            let r = f64::from(radius);
            let wide = r.max(0.5);
            let known = (2.0 * wide * length + std::f64::consts::PI * wide * wide) * r / wide;
            let ours = painted(stroke(radius), f32::INFINITY);
            assert!((ours / known - 1.0).abs() < 0.05, "{radius}: {ours} for {known}");
        }
    }

    #[test]
    fn the_ground_hides_what_is_behind_it() {
        assert_eq!(painted(stroke(2.0), 4.0), 0.0);
        assert_eq!(painted(stroke(2.0), 6.0), painted(stroke(2.0), f32::INFINITY));
    }
}
