//! Landscapes to stand behind clouds: the paper's mountain (§3), in perspective, with the air between.

use snowglobe::contour_cloud::{Camera, Contour, Corner, Patches, Plateau, Surface, lambert, normal};
use snowglobe::image::{Exposure, Photograph, Picture, ToneCurve};
use snowglobe::lab::{Error, Result};
use snowglobe::rng::Seed;

use super::setup::{CORRECTED, broken, displacement, ring};
use super::sky::Sky;

/// A hill: its centre and radii at the foot, its height, and how concave its flanks are (1 is a cone).
#[derive(Clone, Copy, Debug)]
pub struct Hill {
    pub centre: [f64; 2],
    pub radii: [f64; 2],
    pub height: f64,
    pub concave: f64,
}

/// A view of hills on a plain, in km: the camera stands at the origin and looks along -y.
pub struct Landscape<'a> {
    pub hills: &'a [Hill],
    /// Height of the camera above the plain.
    pub eye: f64,
    pub focal: f64,
    pub horizon: f64,
    pub size: [usize; 2],
    pub sky: Sky,
    /// Towards the sun: x, y and up.
    pub sun: [f64; 3],
    /// Above this height lies snow.
    pub snow: f64,
    /// What of the light is left after a kilometre of air.
    pub clear: f64,
    pub gain: f64,
}

/// Contours to a hill.
const RINGS: u32 = 6;

impl Landscape<'_> {
    /// The picture of it, before its sky.
    pub fn picture(&self, seed: Seed) -> Result<Picture> {
        let patches = Patches::new(&self.contours(), Plateau::Raised).map_err(broken)?;
        let mut by = displacement(CORRECTED, self.gain, seed);
        by.moment = seed.stream("miyata: landscape").at(0);
        let surface = Surface::smooth(&patches, 1.6, by);
        let camera = Camera {
            eye: [0.0, 0.0, self.eye],
            heading: [0.0, -1.0],
            focal: self.focal,
            horizon: self.horizon,
            size: self.size,
            near: 0.6,
        };
        let above = self.sky.light(60.0);
        let (haze, loss) = (self.sky.light(1.0), libm::log(self.clear));
        let scene = camera.show(&surface, 1.0, |corners, depth| {
            let light = self.shade(corners, above);
            // Blue is scattered out and in first.
            let tinted = [0.8, 1.0, 1.3].map(|share| libm::exp(share * depth * loss));
            [0, 1, 2].map(|k| light[k] * tinted[k] + haze[k] * (1.0 - tinted[k]))
        });
        let width = self.size[0];
        let pixel = |(k, (light, cover)): (usize, &([f64; 3], f64))| {
            let up = libm::atan((self.horizon - ((k / width) as f64 + 0.5)) / self.focal).to_degrees();
            let behind = self.sky.light(up.max(0.3));
            [0, 1, 2].map(|c| (light[c] * cover + behind[c] * (1.0 - cover)) as f32)
        };
        let pixels = scene.pixels.iter().enumerate().map(pixel).collect();
        let error = |cause: snowglobe::image::ImageError| Error::broken(cause.to_string());
        let photograph = Photograph::new(width as u32, self.size[1] as u32, pixels).map_err(error)?;
        Ok(photograph.develop(Exposure { stops: self.sky.exposure }, ToneCurve::Filmic))
    }

    /// Rings of equal height, and the plain's edge.
    fn contours(&self) -> Vec<Contour> {
        let rim = vec![[-24.0, -46.0], [24.0, -46.0], [24.0, 1.0], [-24.0, 1.0]];
        let contour = |name: String, level: f64, points: Vec<[f64; 2]>| Contour {
            name,
            level,
            dimension: 2.2,
            points,
            closed: true,
        };
        let mut all = vec![contour("plain".to_owned(), 0.0, rim)];
        for (number, hill) in self.hills.iter().enumerate() {
            for k in 1..=RINGS {
                let share = f64::from(k) / (f64::from(RINGS) + 0.5);
                // From the foot, where the height is 0, inwards.
                let radius = 1.0 - libm::pow(share, 1.0 / hill.concave);
                let radii = hill.radii.map(|r| r * radius.max(0.04));
                let points = ring(hill.centre, radii, 48, number as f64);
                all.push(contour(format!("hill {number}, {k}"), hill.height * share, points));
            }
        }
        all
    }

    /// Forest, rock and snow in the light of the sun, and of the sky above.
    fn shade(&self, corners: &[Corner; 3], above: [f64; 3]) -> [f64; 3] {
        let height = corners.iter().map(Corner::height).sum::<f64>() / 3.0;
        let flat = normal(corners)[2];
        let blend = |a: [f64; 3], b: [f64; 3], t: f64| [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * t);
        let step = |x: f64, from: f64, to: f64| ((x - from) / (to - from)).clamp(0.0, 1.0);
        let rock =
            blend([0.035, 0.06, 0.022], [0.13, 0.11, 0.09], step(height, 0.3 * self.snow, 0.75 * self.snow));
        let lies = step(height + 0.5 * (flat - 0.8), 0.9 * self.snow, 1.1 * self.snow);
        let ground = blend(rock, [0.85, 0.87, 0.9], lies);
        let sun = lambert(corners, self.sun);
        [0, 1, 2].map(|k| ground[k] * (1.1 * sun + 1.6 * above[k] * (0.5 + 0.5 * flat)))
    }
}
