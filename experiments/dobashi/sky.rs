//! A sky for pictures: representative points low over a plain, the clouds that they draw, and a camera beneath.

use snowglobe::automaton_cloud::{
    Chance, Injection, Interpolation, Metaballs, Packed, Point, PointError, Points, Rules,
};
use snowglobe::image::{ImageError, Photograph};
use snowglobe::lab::{Error, Result};
use snowglobe::rng::Seed;
use snowglobe::volume::{Camera, Density, Octaves, Rendered, Shading, Single, VolumeError};

use super::setup::{MENDED, broken};

/// Width of a cell, m.
pub const CELL: f64 = 30.0;
/// Cells without cloud around the automaton's, so that no cloud is cut off straight.
pub const MARGIN: usize = 3;
/// D in cells.
pub const RADIUS: f64 = 2.5;
/// Towards the sun.
const SUN: [f64; 3] = [-0.55, -0.35, 0.75];
/// Irradiance that makes white paper as bright as 1.
const IRRADIANCE: f64 = std::f64::consts::PI;

/// Where vapour rises: shares of the width and depth.
const WET: [[f64; 2]; 9] = [
    [0.16, 0.30],
    [0.28, 0.38],
    [0.55, 0.22],
    [0.80, 0.34],
    [0.88, 0.46],
    [0.42, 0.62],
    [0.66, 0.70],
    [0.14, 0.78],
    [0.90, 0.86],
];

/// Clouds that form over wet points and, from `turn` on, dissolve.
pub struct Weather {
    pub counts: [usize; 3],
    pub seed: u64,
    /// The step from which there is no more vapour; none for ever.
    pub turn: Option<f64>,
}

impl Weather {
    fn points(&self) -> Result<Points> {
        let [nx, ny, nz] = self.counts.map(|count| count as f64);
        let wet = WET.map(|[x, y]| [x * nx, y * ny, 0.1 * nz]);
        // Dry ones all over, higher and between.
        let mut dry = Vec::new();
        for j in 0..6 {
            for i in 0..6 {
                let at = [f64::from(i) / 5.0 * nx, f64::from(j) / 5.0 * ny];
                dry.push([at[0], at[1], 0.9 * nz]);
                if WET.iter().all(|w| libm::hypot(w[0] * nx - at[0], w[1] * ny - at[1]) > 0.13 * nx) {
                    dry.push([at[0], at[1], 0.1 * nz]);
                }
            }
        }
        let at = |step: f64, vapour: f64, vanishing: f64| {
            let rising = wet.iter().map(move |place| (*place, [vapour, 0.03 * vapour, vanishing]));
            let clear = dry.iter().map(|place| (*place, [0.0, 0.0, 0.03]));
            rising
                .chain(clear)
                .map(move |(place, chances)| (step, Point { place, chances }))
                .collect::<Vec<_>>()
        };
        let mut rows = at(0.0, 0.06, 0.002);
        if let Some(turn) = self.turn {
            rows.extend(at(turn, 0.06, 0.002));
            rows.extend(at(1.25 * turn, 0.0, 0.02));
        }
        Points::moving(&rows, Interpolation::Gaussian(0.07 * nx), 4)
            .map_err(|cause: PointError| Error::broken(cause.to_string()))
    }

    /// The clouds after each of so many steps.
    pub fn film(&self, lifetime: u8, steps: usize, mut seen: impl FnMut(Vec<u8>)) -> Result<()> {
        let injection = Injection { seed: Seed(self.seed), chance: Chance::Points(self.points()?) };
        let mut clouds = Packed::new(self.counts, Rules { lifetime, ..MENDED }).map_err(broken)?;
        clouds.inject(&injection);
        for _ in 0..steps {
            clouds.step();
            clouds.inject(&injection);
            seen(clouds.cld());
        }
        Ok(())
    }

    /// Metaballs on these cells and the margin around them.
    pub fn balls(&self) -> Metaballs {
        Metaballs { counts: self.counts.map(|count| count + 2 * MARGIN), radius: RADIUS }
    }

    /// Clouds with the margin around.
    pub fn widened(&self, cld: &[u8]) -> Vec<u8> {
        let [nx, ny, _] = self.counts;
        let [wide, deep, high] = self.balls().counts;
        let mut all = vec![0; wide * deep * high];
        for (row, cells) in cld.chunks(nx).enumerate() {
            let at = ((row / ny + MARGIN) * deep + row % ny + MARGIN) * wide + MARGIN;
            all[at..at + nx].copy_from_slice(cells);
        }
        all
    }

    /// rho over that deep in cloud, on the cells and the margin.
    pub fn density(&self, central: &[f32]) -> Result<Density> {
        let balls = self.balls();
        let whole = balls.whole();
        let rho = balls.density(central).into_iter().map(|rho| (f64::from(rho) / whole) as f32);
        Density::new(balls.counts, CELL, rho.collect()).map_err(unseen)
    }

    /// From the ground, in front of the clouds.
    pub fn camera(&self, size: [usize; 2]) -> Result<Camera> {
        let [width, depth, _] = self.balls().counts.map(|count| count as f64 * CELL);
        Camera::pinhole([0.5 * width, -0.34 * depth, -0.14 * width], [0.0, 1.0, 0.3], UP, 46.0, size)
            .map_err(unseen)
    }
}

const UP: [f64; 3] = [0.0, 0.0, 1.0];

pub fn unseen(cause: VolumeError) -> Error {
    Error::broken(cause.to_string())
}

/// The sun's light, scattered once.
pub fn once() -> Single {
    Single { albedo: 1.0, g: 0.3, to_sun: SUN, sun: [IRRADIANCE; 3] }
}

/// The sun's, the sky's and the ground's, scattered many times.
pub fn many(count: usize) -> Shading {
    Shading::Octaves(Octaves {
        count,
        attenuation: 0.5,
        contribution: 0.5,
        eccentricity: 0.5,
        normalised: false,
        albedo: 1.0,
        g: 0.3,
        to_sun: SUN,
        sun: [1.0, 0.95, 0.86].map(|light| light * IRRADIANCE),
        zenith: UP,
        sky: [0.16, 0.25, 0.42],
        ground: [0.10, 0.10, 0.08],
    })
}

/// Light before a clear sky, paler towards the horizon at the bottom.
pub fn before_sky(size: [usize; 2], radiance: &[[f32; 3]], transmittance: &[f32]) -> Result<Photograph> {
    let [width, height] = size;
    let pixel = |(k, (light, left)): (usize, (&[f32; 3], &f32))| {
        let share = (k / width) as f64 / height as f64;
        let (top, bottom) = ([0.07, 0.17, 0.42], [0.36, 0.52, 0.74]);
        [0, 1, 2].map(|c| {
            let behind = top[c] + share * share * (bottom[c] - top[c]);
            (f64::from(light[c]) + f64::from(*left) * behind) as f32
        })
    };
    let pixels = radiance.iter().zip(transmittance).enumerate().map(pixel).collect();
    Photograph::new(width as u32, height as u32, pixels)
        .map_err(|cause: ImageError| Error::broken(cause.to_string()))
}

/// The same of a rendered volume.
pub fn photograph(seen: &Rendered) -> Result<Photograph> {
    before_sky(seen.size, &seen.radiance, &seen.transmittance)
}
