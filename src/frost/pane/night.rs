//! What lies behind the glass: a winter evening out of focus, and the same ever more blurred.
//!
//! The camera is focused on the frost. The scene is ours, drawn by a few formulas in heights of the picture from its
//! left edge and its top; the lights are discs, as a round aperture makes of them.

use rayon::prelude::*;

/// Light in red, green and blue; the fourth number makes it one vector and is not used.
pub(super) type Light = [f32; 4];

/// Rows of the scene, nearly: it has no detail finer than that.
const ROWS: u32 = 270;
/// Blur of each copy, as the standard deviation of a Gaussian in heights of the picture.
const BLURS: [f64; 5] = [0.003, 0.007, 0.014, 0.032, 0.075];
/// How far the scene is out of focus, likewise; its lamps are discs in any case.
const FOCUS: f64 = 0.009;

/// A light far away: place, radius of its disc, colour.
struct Lamp(f32, f32, f32, [f32; 3]);

const SODIUM: [f32; 3] = [1.0, 0.50, 0.14];
const TUNGSTEN: [f32; 3] = [1.0, 0.66, 0.32];
const COOL: [f32; 3] = [0.55, 0.78, 1.0];
const RED: [f32; 3] = [1.0, 0.13, 0.07];

static LAMPS: [Lamp; 16] = [
    Lamp(0.295, 0.588, 0.027, SODIUM),
    Lamp(0.410, 0.625, 0.022, TUNGSTEN),
    Lamp(0.485, 0.602, 0.021, SODIUM),
    Lamp(0.560, 0.638, 0.018, TUNGSTEN),
    Lamp(0.628, 0.626, 0.018, RED),
    Lamp(0.670, 0.633, 0.018, RED),
    Lamp(0.725, 0.590, 0.025, SODIUM),
    Lamp(0.805, 0.632, 0.019, COOL),
    Lamp(0.872, 0.610, 0.022, TUNGSTEN),
    Lamp(0.938, 0.640, 0.017, SODIUM),
    Lamp(1.010, 0.572, 0.028, SODIUM),
    Lamp(1.165, 0.648, 0.023, TUNGSTEN),
    Lamp(1.212, 0.640, 0.025, TUNGSTEN),
    Lamp(1.290, 0.604, 0.021, SODIUM),
    Lamp(1.385, 0.628, 0.022, COOL),
    Lamp(1.470, 0.596, 0.027, SODIUM),
];

fn step(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn mix(a: [f32; 3], b: [f32; 3], share: f32) -> [f32; 3] {
    std::array::from_fn(|i| a[i] + share * (b[i] - a[i]))
}

/// A bump of width 1 around 0.
fn bump(x: f32) -> f32 {
    1.0 / (1.0 + x * x * (1.0 + x * x))
}

/// A fir: how much of it is at (x, y), with its foot at (`x0`, `y0`).
fn fir(x: f32, y: f32, x0: f32, y0: f32, height: f32) -> f32 {
    let up = (y0 - y) / height;
    if !(-0.06..1.0).contains(&up) {
        return 0.0;
    }
    // The skirt goes down into the snow, which lies round it.
    let foot = step(-0.05, 0.05, up - 0.9 * ((x - x0) / height) * ((x - x0) / height));
    let up = up.max(0.0);
    // Boughs: the outline widens downwards in seven steps.
    let tier = 7.0 * up;
    let tier = tier - tier.floor();
    let half = height * 0.25 * ((1.0 - up) * 0.75 + 0.28 * (1.0 - tier) * (1.0 - up).sqrt());
    foot * (1.0 - step(0.8 * half, 1.1 * half + 0.004, (x - x0).abs()))
}

/// The light at a place of the scene.
fn scene(x: f32, y: f32) -> [f32; 3] {
    const HORIZON: f32 = 0.645;
    // The last light, low and to the left.
    let height = ((HORIZON - y) / HORIZON).clamp(0.0, 1.0);
    let mut light = mix([0.080, 0.115, 0.205], [0.010, 0.023, 0.068], step(0.0, 0.95, height.sqrt()));
    let glow = bump((x - 0.52) / 0.62) * bump((y - HORIZON) / 0.17);
    light = std::array::from_fn(|i| light[i] + glow * [0.340, 0.150, 0.100][i]);
    // Hills, and a wood on them.
    let ridge = HORIZON - 0.030 - 0.035 * bump((x - 0.25) / 0.28) - 0.050 * bump((x - 1.55) / 0.36)
        + 0.008 * wave(9.0 * x)
        + 0.004 * wave(31.0 * x + 0.4);
    light = mix(light, [0.013, 0.021, 0.040], step(ridge - 0.004, ridge + 0.006, y));
    // Snow in front, with the sky in it and the lamps on it.
    let near = step(HORIZON, 1.0, y);
    let lit = bump((x - 0.75) / 0.55) * bump((y - 0.70) / 0.09);
    let snow: [f32; 3] = std::array::from_fn(|i| {
        [0.036, 0.054, 0.098][i] * (1.0 - 0.55 * near) + lit * [0.060, 0.036, 0.016][i]
    });
    let bank = HORIZON + 0.012 + 0.010 * wave(2.3 * x);
    light = mix(light, snow, step(bank - 0.006, bank + 0.008, y));
    // Roofs of the village, and firs.
    for (x0, top, half) in [(0.955, 0.590, 0.085), (1.190, 0.545, 0.135), (1.335, 0.600, 0.075)] {
        let slope = top + 0.62 * (x - x0).abs();
        let house = step(slope - 0.003, slope + 0.003, y) * step(half + 0.004, half - 0.004, (x - x0).abs());
        light = mix(light, [0.011, 0.014, 0.025], house * step(0.690, 0.672, y));
    }
    for (x0, y0, size) in [
        (0.075, 0.80, 0.62),
        (0.185, 0.74, 0.36),
        (0.015, 0.72, 0.40),
        (1.062, 0.690, 0.150),
        (1.432, 0.705, 0.200),
        (1.700, 0.82, 0.70),
        (1.585, 0.735, 0.33),
    ] {
        light = mix(light, [0.0062, 0.0100, 0.0190], fir(x, y, x0, y0, size));
    }
    light
}

/// A ripple with period 1, from -1 to 1, of two parabolas.
fn wave(x: f32) -> f32 {
    let t = 2.0 * (x - x.floor()) - 1.0;
    4.0 * t * (1.0 - t.abs())
}

/// The discs of light on top: a little brighter at the rim, as an aperture makes them.
fn lamps(x: f32, y: f32) -> [f32; 3] {
    let mut light = [0.0; 3];
    for Lamp(x0, y0, radius, colour) in &LAMPS {
        let distance = ((x - x0) * (x - x0) + (y - y0) * (y - y0)).sqrt();
        let disc = 1.0 - step(radius - 0.0035, radius + 0.0035, distance);
        let rim = 0.75 + 0.45 * step(0.55 * radius, radius + 0.001, distance);
        let halo = 0.035 * bump(distance / (2.8 * radius));
        // The same light in a larger disc is dimmer.
        let strength = 0.00040 / (radius * radius);
        for (sum, colour) in light.iter_mut().zip(colour) {
            *sum += strength * colour * (disc * rim + halo);
        }
    }
    light
}

/// The scene, and the same through ever rougher glass.
pub(super) struct Night {
    width: usize,
    height: usize,
    per_pixel: f32,
    levels: Vec<Vec<Light>>,
}

impl Night {
    /// The scene for a picture of this size.
    pub(super) fn new(width: u32, height: u32) -> Self {
        let coarse = (height / ROWS).max(1);
        let (columns, rows) = (width.div_ceil(coarse) as usize + 1, height.div_ceil(coarse) as usize + 1);
        let unit = coarse as f32 / height as f32;
        // The scene is made for 16:9; another shape shows its middle.
        let aside = 0.5 * (16.0 / 9.0 - width as f32 / height as f32);
        let drawn = |light: fn(f32, f32) -> [f32; 3]| -> Vec<Light> {
            let pixel = |row: usize, column: usize| {
                let mut sum = [0.0; 4];
                for (i, j) in [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)] {
                    let (x, y) = ((column as f32 + i) * unit + aside, (row as f32 + j) * unit);
                    for (sum, light) in sum.iter_mut().zip(light(x, y)) {
                        *sum += 0.25 * light;
                    }
                }
                sum
            };
            let row = |row: usize| (0..columns).map(move |column| pixel(row, column));
            (0..rows).into_par_iter().flat_map_iter(row).collect()
        };
        let mut sharp = blurred(&drawn(scene), columns, FOCUS * rows as f64);
        for (sum, lamp) in sharp.iter_mut().zip(drawn(lamps)) {
            *sum = std::array::from_fn(|channel| sum[channel] + lamp[channel]);
        }
        let levels = BLURS.iter().map(|blur| blurred(&sharp, columns, blur * rows as f64)).collect();
        Self { width: columns, height: rows, per_pixel: 1.0 / coarse as f32, levels }
    }

    /// The light at a place of the picture (in its pixels), through glass of a roughness from 0 (none) to 1 (milk).
    #[inline]
    pub(super) fn at(&self, x: f32, y: f32, roughness: f32) -> Light {
        let level = roughness.clamp(0.0, 1.0) * (BLURS.len() - 1) as f32;
        let lower = (level as usize).min(BLURS.len() - 2);
        let share = level - lower as f32;
        let (x, y) = (x * self.per_pixel, y * self.per_pixel);
        let x = x.clamp(0.0, (self.width - 1) as f32 - 0.001);
        let y = y.clamp(0.0, (self.height - 1) as f32 - 0.001);
        let (column, row) = (x as usize, y as usize);
        let (right, down) = (x - column as f32, y - row as f32);
        let at = row * self.width + column;
        let mut sum = [0.0; 4];
        for (copy, weight) in [(&self.levels[lower], 1.0 - share), (&self.levels[lower + 1], share)] {
            let corners = [copy[at], copy[at + 1], copy[at + self.width], copy[at + self.width + 1]];
            for (channel, sum) in sum.iter_mut().enumerate() {
                let above = corners[0][channel] + right * (corners[1][channel] - corners[0][channel]);
                let below = corners[2][channel] + right * (corners[3][channel] - corners[2][channel]);
                *sum += weight * (above + down * (below - above));
            }
        }
        sum
    }
}

/// Blurred by three boxes each way, which together are near a Gaussian of this standard deviation, in pixels; the
/// picture goes on beyond its edge as it is there.
fn blurred(light: &[Light], columns: usize, deviation: f64) -> Vec<Light> {
    // A box of n pixels has the variance (n² - 1) / 12.
    let box_size = libm::sqrt(4.0 * deviation * deviation + 1.0);
    let reach = libm::round(0.5 * (box_size - 1.0)).max(0.0) as usize;
    let mut now = light.to_vec();
    if reach == 0 {
        return now;
    }
    // Along the rows, then along the columns, which are rows for a while.
    let rows = light.len() / columns;
    for across in [columns, rows] {
        for _ in 0..3 {
            now = now.par_chunks(across).flat_map_iter(|row| averaged(row, reach)).collect();
        }
        now = turned(&now, across);
    }
    now
}

/// Rows as columns.
fn turned(light: &[Light], columns: usize) -> Vec<Light> {
    let rows = light.len() / columns;
    (0..columns).flat_map(|column| (0..rows).map(move |row| light[row * columns + column])).collect()
}

/// The mean over `reach` neighbours on either side.
fn averaged(row: &[Light], reach: usize) -> Vec<Light> {
    let last = row.len() - 1;
    let scale = 1.0 / (2 * reach + 1) as f64;
    let value = |at: isize| row[at.clamp(0, last as isize) as usize];
    let mut sum = [0.0f64; 4];
    for at in -(reach as isize)..=reach as isize {
        for (sum, part) in sum.iter_mut().zip(value(at)) {
            *sum += f64::from(part);
        }
    }
    (0..row.len())
        .map(|at| {
            let mean = sum.map(|sum| (sum * scale) as f32);
            let (gone, come) = (value(at as isize - reach as isize), value(at as isize + reach as isize + 1));
            for channel in 0..4 {
                sum[channel] += f64::from(come[channel]) - f64::from(gone[channel]);
            }
            mean
        })
        .collect()
}
