//! Many flakes before a background, by volume rendering: Eq. (11) to (16) of Himeno, Kenmochi & Kotani.
//!
//! Each flake is a volume of its own; flakes that look alike share a [`Body`]. Along a ray a cell of optical depth d takes
//! away 1 - exp(-d), exactly, and light comes to it through the flake's own shadow, Eq. (16).
//!
//! | of a flake | is |
//! |---|---|
//! | its voxels | [`Body::new`], at most as fine as a pixel shows them; as opaque as its prisms by [`Body::true_to`] |
//! | less than 1.5 pixels wide | laid down by its mean opacity and light, never met by chance |
//! | out of focus, moving | laid down as well, spread over lens and time, if it is more blurred than an eighth of its width |
//! | nearly sharp | rays through places of the lens at times of the shutter |
//!
//! | to | open |
//! |---|---|
//! | have flakes of all sizes | [`Catalogue`] |
//! | let them fall before a camera | [`Shower`] |
//! | make one flake visible | [`Body`] |
//! | say where they are | [`Placed`], [`Scene`] |
//! | look | [`Camera`], [`Lens`] |
//! | have a picture | [`picture()`]; one to measure it by, [`by_rays()`] |
//!
//! Pictures are the same bytes on any number of threads, in debug and in release, and in parts.

mod body;
mod camera;
mod catalogue;
mod dots;
mod fit;
mod frame;
mod grid;
mod levels;
mod prisms;
mod ready;
mod sequence;
mod shower;
mod sight;
#[cfg(test)]
mod tests;
mod tiles;

pub use body::Body;
pub use camera::{Camera, FULL_FRAME, Lens};
pub use catalogue::{Catalogue, crystals_in};
pub use shower::{Flying, Shower, as_white_as};

use nalgebra::{Point3, UnitQuaternion, Vector3};
use rayon::prelude::*;

use crate::rng::Seed;
use crate::volume::Himeno;

use super::{SnowError, within};
use ready::Ready;
use sequence::{MOST_SAMPLES, Samples};

/// A flake in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Which of the bodies it looks like.
    pub template: usize,
    /// Where its centre of mass is when the shutter is half through, m.
    pub at: Point3<f64>,
    /// From the body's axes to those of the scene.
    pub turn: UnitQuaternion<f64>,
    /// How many times as large as the body it is, 1e-3 to 1e3.
    pub scale: f64,
    /// How it moves, m/s.
    pub velocity: Vector3<f64>,
}

/// Flakes and their light.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// How flakes look.
    pub bodies: &'a [Body],
    /// The flakes, in any order: only where two are equally far does it matter.
    pub flakes: &'a [Placed],
    /// tau, optical depth per m of what is dense, of all flakes. Coarse levels are true to their voxels from a fourth to four
    /// times what their body is made for, its scale included.
    pub extinction: f64,
    /// Light and how it is reflected, Eq. (11).
    pub light: Himeno,
}

/// A picture of flakes before a background.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Linear red, green and blue of each pixel, the background included; row by row from the top.
    pub radiance: Vec<[f32; 3]>,
    /// 1 - the mean transmittance of each pixel, 0 to 1.
    pub coverage: Vec<f32>,
    /// How many flakes' bounding spheres meet the whole picture's view, see [`Camera::sees`].
    pub visible: usize,
    /// What was done.
    pub work: Work,
}

/// What a picture took, the same on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Samples of all pixels.
    pub samples: u64,
    /// Those that were followed as rays, for a traced flake is near.
    pub rays: u64,
    /// Times that a ray entered a flake's box.
    pub flakes: u64,
    /// Cells with density that rays passed.
    pub cells: u64,
    /// Flakes that were traced.
    pub traced: u64,
    /// Flakes that were laid down.
    pub laid: u64,
    /// Squares that they were laid down as.
    pub squares: u64,
}

impl std::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.samples += other.samples;
        self.rays += other.rays;
        self.flakes += other.flakes;
        self.cells += other.cells;
        self.traced += other.traced;
        self.laid += other.laid;
        self.squares += other.squares;
    }
}

/// How flakes are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Manner {
    /// Laid down where they are small or blurred, traced where not.
    Swift,
    /// All traced.
    ByRays,
}

/// The picture that a camera makes of a scene before a background: linear red, green and blue for each pixel that is made.
///
/// `samples` of each pixel spread over the pixel, the lens and the time; `seed` decides which.
///
/// # Errors
///
/// A body that there is not; a place or velocity beyond 1e9; a scale not 1e-3 to 1e3; an extinction not 0 to 1e12; light or
/// coefficients not 0 to 1e30, a direction to the light of no length; a background of another size; samples not 1 to 4096.
pub fn picture(
    scene: &Scene,
    camera: &Camera,
    background: &[[f32; 3]],
    samples: usize,
    seed: Seed,
) -> Result<Picture, SnowError> {
    drawn(scene, camera, background, samples, seed, Manner::Swift)
}

/// The same with every flake followed by rays, however small or blurred it is: noisy with few samples, and right with many. What
/// [`picture()`] is measured by.
///
/// # Errors
///
/// As [`picture()`].
pub fn by_rays(
    scene: &Scene,
    camera: &Camera,
    background: &[[f32; 3]],
    samples: usize,
    seed: Seed,
) -> Result<Picture, SnowError> {
    drawn(scene, camera, background, samples, seed, Manner::ByRays)
}

fn drawn(
    scene: &Scene,
    camera: &Camera,
    background: &[[f32; 3]],
    samples: usize,
    seed: Seed,
    manner: Manner,
) -> Result<Picture, SnowError> {
    scene.check()?;
    let [width, height] = camera.made();
    let pixels = (width * height) as f64;
    within("the number of pixels of the background", background.len() as f64, pixels, pixels)?;
    within("the number of samples of a pixel", samples as f64, 1.0, MOST_SAMPLES as f64)?;
    let light = Vector3::from(scene.light.to_light);
    let himeno = Himeno { to_light: (light / light.norm_squared().sqrt()).into(), ..scene.light };
    let made = |flake: &Placed| {
        let sees = camera.sees(&flake.at, scene.bodies[flake.template].radius * flake.scale);
        (sees, Ready::new(scene, &himeno, camera, flake, manner))
    };
    let made: Vec<_> = scene.flakes.par_iter().map(made).collect();
    let visible = made.iter().filter(|(sees, _)| *sees).count();
    let mut ready: Vec<Ready> = made.into_iter().filter_map(|(_, ready)| ready).collect();
    // Those equally far stay in their order.
    ready.sort_by(|a, b| a.place[2].total_cmp(&b.place[2]));
    let laid = ready.iter().filter(|ready| matches!(ready.drawn, ready::Drawn::Dot(_))).count() as u64;
    let mut picture = tiles::picture(scene, camera, background, Samples::new(samples, seed), &ready);
    picture.visible = visible;
    picture.work.laid = laid;
    picture.work.traced = ready.len() as u64 - laid;
    Ok(picture)
}

impl Scene<'_> {
    fn check(&self) -> Result<(), SnowError> {
        within("the extinction, 1/m,", self.extinction, 0.0, 1e12)?;
        let Himeno { diffuse, specular, ambient, to_light, light, ambient_light, .. } = self.light;
        for (name, value) in [("k_d", diffuse), ("k_s", specular), ("k_a", ambient)] {
            within(name, value, 0.0, 1e30)?;
        }
        for (name, colour) in [("I_0", light), ("I_a", ambient_light)] {
            colour.into_iter().try_for_each(|value| within(name, value, 0.0, 1e30))?;
        }
        let length = Vector3::from(to_light).norm_squared().sqrt();
        within("the length of the direction to the light", length, 1e-9, 1e9)?;
        for flake in self.flakes {
            within("the number of a body", flake.template as f64, 0.0, self.bodies.len() as f64 - 1.0)?;
            within("the scale of a flake", flake.scale, 1e-3, 1e3)?;
            for x in flake.at.iter().chain(flake.velocity.iter()) {
                within("a place or velocity of a flake, m or m/s,", *x, -1e9, 1e9)?;
            }
            for x in flake.turn.coords.iter() {
                within("the turn of a flake", *x, -1.0 - 1e-9, 1.0 + 1e-9)?;
            }
        }
        Ok(())
    }
}
