//! Where the still is taken: the snow, the camera, the light, and the picture behind.

use nalgebra::{Point3, Vector3};
use snowglobe::lab::{Error, Result};
use snowglobe::rng::Seed;
use snowglobe::snow::fall::FallSpeed;
use snowglobe::snow::flake::{Assembly, Joining};
use snowglobe::snow::still::{
    Camera, Catalogue, FULL_FRAME, Flying, Lens, Placed, Scene, Shower, as_white_as, crystals_in,
};
use snowglobe::snow::{Branching, Over, Parameters, Sizes, SnowError};
use snowglobe::volume::Himeno;

use super::winter::Winter;

/// What is set. Of all this the paper prints the number of flakes alone.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Air in which crystals have grown: C, and supersaturation as a share.
    pub temperature: f64,
    pub supersaturation: f64,
    pub over: Over,
    /// Rate of the snowfall, mm of water an hour, and the bounds of melted diameters, mm.
    pub rate: f64,
    pub melted: [f64; 2],
    /// The side of an element, m.
    pub element: f64,
    /// tau, 1/m.
    pub extinction: f64,
    /// Across and down.
    pub size: [usize; 2],
    pub lens: Lens,
    /// The nearest flake, m.
    pub near: f64,
    /// m/s.
    pub wind: [f64; 3],
    pub gust: f64,
}

impl Settings {
    /// Each with its reason where an experiment assumes it.
    pub const ASSUMED: Self = Self {
        temperature: -15.0,
        supersaturation: 0.15,
        over: Over::Ice,
        rate: 8.0,
        melted: [1.0, 6.0],
        element: 25e-6,
        extinction: 1e5,
        size: [640, 480],
        lens: Lens { focal: 0.038, number: 11.0, focus: 1.3, sensor: FULL_FRAME, shutter: 1.0 / 500.0 },
        near: 0.3,
        wind: [0.35, 0.0, 0.1],
        gust: 0.25,
    };
}

/// Crystals of flakes of the catalogue: many small ones, few large ones.
const NUMBERS: [usize; 40] = [
    1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 6, 6, 7, 8, 9, 10, 11, 12,
    13, 14, 16, 18, 20, 24,
];
/// Crystals to choose from.
const CRYSTALS: usize = 10;

/// All but the flakes.
#[derive(Clone)]
pub struct Stage {
    pub settings: Settings,
    pub catalogue: Catalogue,
    pub camera: Camera,
    pub shower: Shower,
    /// Light by which flakes are as white as the snow on the ground.
    pub light: Himeno,
}

impl Stage {
    /// Grows crystals, assembles flakes, and sets the light so that they are as white as `snow`.
    pub fn new(
        settings: Settings,
        assembly: Assembly,
        snow: [f64; 3],
        seed: Seed,
    ) -> std::result::Result<Self, SnowError> {
        let branching = Branching::new(&Parameters { element: settings.element, ..Parameters::ASSUMED })?;
        let Settings { temperature, supersaturation, over, extinction, .. } = settings;
        let crystals = crystals_in(temperature, supersaturation, over, CRYSTALS, &branching, seed)?;
        let catalogue =
            Catalogue::assembled(crystals, &NUMBERS, assembly, &Joining::assumed(), extinction, seed)?;
        let shower = Shower {
            sizes: Sizes::gunn_marshall(settings.rate, settings.melted)?,
            fall: FallSpeed::AGGREGATES,
            wind: Vector3::from(settings.wind),
            gust: settings.gust,
        };
        let light = as_white_as(snow, overcast(snow), &catalogue, extinction)?;
        Ok(Self { settings, catalogue, camera: looking(settings.lens, settings.size)?, shower, light })
    }

    /// The same with a picture of another size.
    pub fn of_size(&self, size: [usize; 2]) -> std::result::Result<Self, SnowError> {
        let settings = Settings { size, ..self.settings };
        Ok(Self { settings, camera: looking(settings.lens, size)?, ..self.clone() })
    }

    /// So many flakes, the nearest of all.
    pub fn flakes(&self, count: usize, seed: Seed) -> std::result::Result<Vec<Flying>, SnowError> {
        let far = self.reach(count);
        self.shower.before(&self.camera, &self.catalogue, [self.settings.near, far], count, seed)
    }

    /// How far the last of so many is, m.
    pub fn reach(&self, count: usize) -> f64 {
        self.shower.reach(&self.camera, self.settings.near, count)
    }

    /// The flakes before the picture behind, still without a picture.
    pub fn scene<'a>(&'a self, flakes: &'a [Placed]) -> Scene<'a> {
        Scene {
            bodies: self.catalogue.bodies(),
            flakes,
            extinction: self.settings.extinction,
            light: self.light,
        }
    }
}

/// The camera at the eye's height that looks ahead; the scene's origin is in it.
pub fn looking(lens: Lens, size: [usize; 2]) -> std::result::Result<Camera, SnowError> {
    Camera::new(Point3::origin(), -Vector3::z(), Vector3::y(), lens, size)
}

/// The sky of an overcast day, brightest above and a little before the camera; as bright as the snow, which it lights.
fn overcast(snow: [f64; 3]) -> Himeno {
    Himeno {
        diffuse: 0.3,
        specular: 0.05,
        power: 8,
        ambient: 1.0,
        to_light: [-0.3, 0.9, 0.35],
        light: snow,
        ambient_light: [0.0; 3],
    }
}

/// Our own picture behind, as it is seen by a camera that is focused on flakes; and how bright its snow is.
pub fn background(camera: &Camera, lens: &Lens, seed: Seed) -> Result<(Vec<[f32; 3]>, [f64; 3])> {
    let winter = Winter::new(seed)?;
    let tangent = camera.tangents()[0];
    let field = 2.0 * libm::atan(tangent).to_degrees();
    let size = camera.size();
    let sharp = winter.picture(size, field);
    let blur = lens.focal / lens.number / (8.0 * lens.focus * tangent);
    Ok((Winter::defocused(&sharp, size, blur), winter.snow_radiance()))
}

/// Where the flakes are.
pub fn placed(flakes: &[Flying]) -> Vec<Placed> {
    flakes.iter().map(|flake| flake.placed).collect()
}

pub fn broken(cause: SnowError) -> Error {
    Error::broken(cause.to_string())
}
