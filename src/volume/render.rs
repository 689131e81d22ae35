//! Pictures: a ray for every sample of every pixel.

use rayon::prelude::*;

use super::bricks::LatticeRay;
use super::camera::MOST_PIXELS;
use super::exponential::exp;
use super::gathered::Gathered;
use super::octaves::{MOST_OCTAVES, Octave};
use super::shading::henyey_greenstein;
use super::vector::{dot, unit};
use super::walk::Segment;
use super::{
    Bricks, Camera, Density, Depths, Himeno, Octaves, Ray, Shading, Single, VolumeError, Work, within,
};

/// Beyond this optical depth, 24 ln 2, a ray ends: what is behind would add less than 6e-8 of the brightest source.
pub const CUTOFF: f64 = 24.0 * std::f64::consts::LN_2;
/// Pixels along the side of a tile, which one thread works out.
const TILE: usize = 16;
/// Most samples of a pixel along each side.
const MOST_PARTS: usize = 64;

/// A picture of light before a background, which is the caller's: what is seen is radiance + transmittance x background.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Radiance of the medium, red, green and blue, row by row from the top.
    pub radiance: Vec<[f32; 3]>,
    /// What is left of the background's light.
    pub transmittance: Vec<f32>,
    /// What was done.
    pub work: Work,
}

/// What is seen along one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Radiance of the medium, red, green and blue.
    pub radiance: [f64; 3],
    /// What is left of the light from behind.
    pub transmittance: f64,
}

/// Radiance and transmittance.
type Pixel = ([f32; 3], f32);

/// A field that is ready to be seen from anywhere: in bricks, with the depths towards its lights.
#[derive(Clone, Debug)]
pub struct Renderer {
    bricks: Bricks,
    /// tau, 1/m for a density of 1.
    extinction: f64,
    shading: Shading,
    /// Towards the sun or light, then the zenith, then the nadir, as far as the shading has them.
    depths: Vec<Depths>,
}

/// A picture of a field with extinction `extinction` times density, 1/m, and `samples` x `samples` rays a pixel.
///
/// # Errors
///
/// [`VolumeError`] for numbers that make no picture.
pub fn render(
    density: &Density,
    extinction: f64,
    camera: &Camera,
    shading: &Shading,
    samples: usize,
) -> Result<Rendered, VolumeError> {
    Renderer::new(density, extinction, shading)?.picture(camera, samples)
}

impl Renderer {
    /// A field with extinction `extinction` times density, 1/m, lit so.
    ///
    /// # Errors
    ///
    /// [`VolumeError`] for numbers that make no picture.
    pub fn new(density: &Density, extinction: f64, shading: &Shading) -> Result<Self, VolumeError> {
        Self::with_bricks(density, Bricks::new(density), extinction, shading)
    }

    pub(super) fn with_bricks(
        density: &Density,
        bricks: Bricks,
        extinction: f64,
        shading: &Shading,
    ) -> Result<Self, VolumeError> {
        within("the extinction, 1/m,", extinction, 0.0, 1e30, "0 to 1e30")?;
        shading.check()?;
        let mut shading = shading.clone();
        let mut directions = Vec::new();
        match &mut shading {
            Shading::Emission(_) => {}
            Shading::Single(Single { to_sun: light, .. })
            | Shading::Himeno(Himeno { to_light: light, .. }) => {
                *light = unit("the direction to the light", *light)?;
                directions.push(*light);
            }
            Shading::Printed(himeno) => {
                himeno.to_light = unit("the direction to the light", himeno.to_light)?
            }
            Shading::Octaves(Octaves { to_sun, zenith, .. }) => {
                *to_sun = unit("the direction to the sun", *to_sun)?;
                *zenith = unit("the zenith", *zenith)?;
                directions.extend([*to_sun, *zenith, zenith.map(|x| -x)]);
            }
        }
        // Octaves are no exact answer: a finer one to the light would be lost on them.
        let depths = if matches!(shading, Shading::Octaves(_)) { Depths::toward } else { Depths::finely };
        let depths = directions.into_iter().map(|direction| depths(density, direction));
        Ok(Self { bricks, extinction, shading, depths: depths.collect::<Result<_, _>>()? })
    }

    /// The field in bricks.
    pub fn bricks(&self) -> &Bricks {
        &self.bricks
    }

    /// Optical depth between a place, m, and the sun or light; nothing where the shading has none.
    pub fn light_depth(&self, place: [f64; 3]) -> Option<f64> {
        self.depths.first().map(|depths| self.extinction * depths.at(place))
    }

    /// What is seen along a ray, which may start within the field, and what that took is added to `work`.
    pub fn see(&self, ray: &Ray, work: &mut Work) -> Seen {
        work.rays += 1;
        let way = self.bricks.lattice(ray);
        match &self.shading {
            Shading::Emission(source) => {
                let transmittance = self.gather(&way, work, |_, _| {});
                Seen { radiance: source.map(|value| value * (1.0 - transmittance)), transmittance }
            }
            Shading::Single(single) => self.single(single, &way, work),
            Shading::Himeno(himeno) => self.himeno(himeno, &way, work),
            Shading::Printed(himeno) => {
                himeno.printed(&self.bricks, self.extinction * self.bricks.voxel(), ray, work)
            }
            // An even number of them, for pairs are worked out together.
            Shading::Octaves(octaves) => match octaves.count {
                0..=2 => self.octaves::<2>(octaves, &way, work),
                3..=4 => self.octaves::<4>(octaves, &way, work),
                5..=6 => self.octaves::<6>(octaves, &way, work),
                _ => self.octaves::<MOST_OCTAVES>(octaves, &way, work),
            },
        }
    }

    /// Visits the parts of a ray, with their optical depth, to the cutoff; the transmittance.
    #[inline(always)]
    fn gather(&self, way: &LatticeRay, work: &mut Work, mut visit: impl FnMut(&Segment, f64)) -> f64 {
        let scale = self.extinction * self.bricks.voxel();
        let mut depth = 0.0;
        self.bricks.walk(way, work, |segment| {
            let part = scale * segment.depth;
            visit(segment, part);
            depth += part;
            depth >= CUTOFF
        });
        exp(-depth)
    }

    /// Optical depth towards a light along a ray, by the place on it.
    fn toward<'a>(&'a self, light: usize, way: &LatticeRay) -> impl Fn(f64) -> f64 + use<'a> {
        let (depths, extinction) = (&self.depths[light], self.extinction);
        let sheared = depths.along(way);
        move |at| extinction * depths.read(&sheared, at)
    }

    fn single(&self, single: &Single, way: &LatticeRay, work: &mut Work) -> Seen {
        let toward = self.toward(0, way);
        let mut lit = Gathered::new(way.direction);
        let transmittance = self.gather(way, work, |segment, depth| {
            lit.add(segment, depth, 1.0, &toward);
        });
        // Light comes against `to_sun` and goes on against the view: their cosine is that of the turn.
        let phase = henyey_greenstein(single.g, dot(single.to_sun, way.direction));
        let scattered = single.albedo * phase * lit.sum;
        Seen { radiance: single.sun.map(|sun| sun * scattered), transmittance }
    }

    fn himeno(&self, himeno: &Himeno, way: &LatticeRay, work: &mut Work) -> Seen {
        let toward = self.toward(0, way);
        let mut lit = Gathered::new(way.direction);
        let transmittance = self.gather(way, work, |segment, depth| {
            let gradient = segment.cell.gradient(segment.middle.map(|x| x as f32)).map(f64::from);
            let strength = himeno.reflected(gradient, way.direction, himeno.to_light);
            lit.add(segment, depth, strength, &toward);
        });
        let ambient = himeno.ambient * (1.0 - transmittance);
        let channel = |c: usize| himeno.light[c] * lit.sum + himeno.ambient_light[c] * ambient;
        Seen { radiance: [0, 1, 2].map(channel), transmittance }
    }

    fn octaves<const N: usize>(&self, octaves: &Octaves, way: &LatticeRay, work: &mut Work) -> Seen {
        let weights = octaves.rows()[0];
        let phases = octaves.phases(dot(octaves.to_sun, way.direction));
        let of_sun: [f64; MOST_OCTAVES] = std::array::from_fn(|i| weights[i] * phases[i]);
        let lights = [0, 1, 2].map(|light| self.toward(light, way));
        let mut lit = [of_sun, weights, weights].map(|weights| Octave::<N>::new(octaves, weights));
        // What gives no light is not asked for.
        let shines = [octaves.sun, octaves.sky, octaves.ground].map(|rgb| rgb != [0.0; 3]);
        let transmittance = self.gather(way, work, |segment, depth| {
            for light in 0..3 {
                if shines[light] {
                    lit[light].add([segment.from, segment.to], depth, &lights[light]);
                }
            }
        });
        let [sun, sky, ground] = [lit[0].sum, 0.5 * lit[1].sum, 0.5 * lit[2].sum];
        let channel = |c: usize| {
            octaves.albedo * (octaves.sun[c] * sun + octaves.sky[c] * sky + octaves.ground[c] * ground)
        };
        Seen { radiance: [0, 1, 2].map(channel), transmittance }
    }

    /// A picture with `samples` x `samples` rays a pixel.
    ///
    /// # Errors
    ///
    /// [`VolumeError::Picture`] for no samples or more than 64 along each side.
    pub fn picture(&self, camera: &Camera, samples: usize) -> Result<Rendered, VolumeError> {
        let [width, height] = camera.size();
        if !(1..=MOST_PARTS).contains(&samples) || width.max(height) > MOST_PIXELS {
            return Err(VolumeError::Picture { size: [width, height], samples });
        }
        let across = width.div_ceil(TILE);
        let range = |tile: usize, most: usize| tile * TILE..((tile + 1) * TILE).min(most);
        let place = |tile: usize| [range(tile % across, width), range(tile / across, height)];
        let tiles: Vec<(Vec<Pixel>, Work)> = (0..across * height.div_ceil(TILE))
            .into_par_iter()
            .map(|tile| {
                let [columns, rows] = place(tile);
                let mut work = Work::default();
                let mut pixels = Vec::with_capacity(columns.len() * rows.len());
                for row in rows {
                    for column in columns.clone() {
                        pixels.push(self.pixel(camera, [column, row], samples, &mut work));
                    }
                }
                (pixels, work)
            })
            .collect();
        let mut rendered = Rendered {
            size: [width, height],
            radiance: vec![[0.0; 3]; width * height],
            transmittance: vec![1.0; width * height],
            work: Work::default(),
        };
        for (tile, (pixels, work)) in tiles.iter().enumerate() {
            rendered.work += *work;
            let [columns, rows] = place(tile);
            for (from, row) in pixels.chunks_exact(columns.len()).zip(rows) {
                for ((radiance, transmittance), column) in from.iter().zip(columns.clone()) {
                    rendered.radiance[row * width + column] = *radiance;
                    rendered.transmittance[row * width + column] = *transmittance;
                }
            }
        }
        Ok(rendered)
    }

    /// The mean over the samples of a pixel.
    fn pixel(&self, camera: &Camera, at: [usize; 2], samples: usize, work: &mut Work) -> Pixel {
        let (mut radiance, mut transmittance) = ([0.0; 3], 0.0);
        for j in 0..samples {
            for i in 0..samples {
                let seen = self.see(&camera.sample(at, [i, j], samples), work);
                (0..3).for_each(|c| radiance[c] += seen.radiance[c]);
                transmittance += seen.transmittance;
            }
        }
        let number = (samples * samples) as f64;
        (radiance.map(|sum| (sum / number) as f32), (transmittance / number) as f32)
    }
}
