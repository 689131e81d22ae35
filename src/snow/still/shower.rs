//! Which flakes are before a camera, and how they move: what the paper's still is of.

use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

use crate::rng::{Place, Seed};
use crate::volume::Himeno;

use super::super::fall::FallSpeed;
use super::super::{Sizes, SnowError, diameter_of_melted, within};
use super::{Camera, Catalogue, Placed, Scene, picture};

/// Snow that falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shower {
    /// Diameters of the drops that flakes melt to, and how many there are.
    pub sizes: Sizes,
    /// How fast flakes of a size fall.
    pub fall: FallSpeed,
    /// How the air moves, m/s.
    pub wind: Vector3<f64>,
    /// The largest that gusts add to it along each axis, m/s: each flake has its own.
    pub gust: f64,
}

/// A flake that falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flying {
    /// Where and how.
    pub placed: Placed,
    /// Its diameter, m.
    pub diameter: f64,
}

impl Shower {
    /// How far from the camera, m, so many flakes are expected to be, the nearest of them at `near`.
    pub fn reach(&self, camera: &Camera, near: f64, count: usize) -> f64 {
        let [x, y] = camera.tangents();
        // The volume of the pyramid of view is 4 x y z^3 / 3.
        let volume = count as f64 / self.sizes.number_density();
        libm::cbrt(near * near * near + 0.75 * volume / (x * y))
    }

    /// Flakes whose bounding spheres meet a camera's view, exactly `count` of them, at depths from `near` to `far`, m.
    ///
    /// They are drawn evenly from a pyramid that is larger than that of the view by the largest flake, one after the other, until
    /// there are as many as asked for. Their turn is by chance, all turns alike. A flake's numbers depend on the seed and on its
    /// own number alone.
    ///
    /// # Errors
    ///
    /// A near that is not above 0 and below far; more than 10 million flakes.
    pub fn before(
        &self,
        camera: &Camera,
        catalogue: &Catalogue,
        [near, far]: [f64; 2],
        count: usize,
        seed: Seed,
    ) -> Result<Vec<Flying>, SnowError> {
        if count == 0 {
            return Ok(Vec::new());
        }
        within("the nearest distance of a flake, m,", near, 1e-3, far)?;
        within("the farthest distance of a flake, m,", far, 1e-3, 1e6)?;
        within("the number of flakes", count as f64, 0.0, 1e7)?;
        let largest = 1e-3 * diameter_of_melted(self.sizes.most);
        let stream = seed.stream("falling");
        let moment = stream.at(0);
        let mut found = Vec::with_capacity(count);
        let mut number = 0_i32;
        while found.len() < count {
            let mut chance = moment.place(number, 0, 0);
            number += 1;
            let depth =
                libm::cbrt(near * near * near + chance.uniform() * (far * far * far - near * near * near));
            let across = [0, 1].map(|axis| {
                let half = camera.tangents()[axis] * depth + largest;
                half * (2.0 * chance.uniform() - 1.0)
            });
            // Where the pyramid is wider by its margin it is drawn from less often: so all of it is drawn from evenly.
            let [x, y] = camera.tangents().map(|tangent| (tangent * depth + largest) / (tangent * depth));
            let most = camera.tangents().map(|tangent| (tangent * near + largest) / (tangent * near));
            let kept = chance.uniform() * most[0] * most[1] <= x * y;
            let flying = self.flying(camera.place(across, depth), catalogue, &mut chance);
            let radius = catalogue.bodies()[flying.placed.template].radius() * flying.placed.scale;
            if kept && camera.sees(&flying.placed.at, radius) {
                found.push(flying);
            }
        }
        Ok(found)
    }

    fn flying(&self, at: Point3<f64>, catalogue: &Catalogue, chance: &mut Place) -> Flying {
        let diameter = 1e-3 * diameter_of_melted(self.sizes.quantile(chance.uniform()));
        let (template, scale) = catalogue.choose(diameter, chance.uniform());
        let gust = [0; 3].map(|_| self.gust * (2.0 * chance.uniform() - 1.0));
        let velocity = self.wind + Vector3::from(gust) - Vector3::y() * self.fall.of(diameter);
        Flying { placed: Placed { template, at, turn: any_turn(chance), scale, velocity }, diameter }
    }
}

/// A turn of which all are alike: Shoemake's, by three numbers.
fn any_turn(chance: &mut Place) -> UnitQuaternion<f64> {
    let [u, v, w] = [0; 3].map(|_| chance.uniform());
    let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
    let [(sine, cosine), (sine_2, cosine_2)] = [v, w].map(|turn| libm::sincos(std::f64::consts::TAU * turn));
    let turn = Quaternion::new(b * cosine_2, a * sine, a * cosine, b * sine_2);
    let norm = (turn.w * turn.w + turn.i * turn.i + turn.j * turn.j + turn.k * turn.k).sqrt();
    UnitQuaternion::new_unchecked(turn / norm)
}

/// The same light with k_a I_a such that a flake nothing shows through is as bright as snow of this radiance on the ground: its
/// mean over a catalogue's flakes, seen by a camera along -z.
///
/// Light comes to the inside of what is dense only weakly, so that what Eq. (11) reflects is little: most of the whiteness is
/// k_a I_a, in the place of all that is scattered more than once.
///
/// # Errors
///
/// Light that [`picture()`] refuses; snow of which a colour is less bright than what is reflected alone.
pub fn as_white_as(
    snow: [f64; 3],
    light: Himeno,
    catalogue: &Catalogue,
    extinction: f64,
) -> Result<Himeno, SnowError> {
    let alone = Himeno { ambient: 1.0, ambient_light: [0.0; 3], ..light };
    let (mut sums, mut covered) = ([0.0_f64; 3], 0.0_f64);
    for (template, body) in catalogue.bodies().iter().enumerate() {
        let mut chance = Seed(0).stream("white").at(template as u64).place(0, 0, 0);
        let flake = Placed {
            template,
            at: Point3::new(0.0, 0.0, -FAR * body.radius()),
            turn: any_turn(&mut chance),
            scale: 1.0,
            velocity: Vector3::zeros(),
        };
        let scene = Scene { bodies: catalogue.bodies(), flakes: &[flake], extinction, light: alone };
        let camera = Camera::onto(FAR * body.radius(), body.radius(), SEEN)?;
        let seen = picture(&scene, &camera, &vec![[0.0; 3]; SEEN * SEEN], 1, Seed(0))?;
        for (radiance, coverage) in seen.radiance.iter().zip(&seen.coverage) {
            covered += f64::from(*coverage);
            sums.iter_mut().zip(radiance).for_each(|(sum, light)| *sum += f64::from(*light));
        }
    }
    let missing = [0, 1, 2].map(|colour| snow[colour] - sums[colour] / covered.max(1e-300));
    for rest in missing {
        within("what is left of the snow's radiance for k_a I_a", rest, 0.0, 1e30)?;
    }
    Ok(Himeno { ambient_light: missing, ..alone })
}

/// How far away flakes are measured, in radii.
const FAR: f64 = 1000.0;
/// Pixels along the side of the pictures that flakes are measured by.
const SEEN: usize = 24;

#[cfg(test)]
mod tests {
    use super::super::super::flake::{Assembly, Joining};
    use super::super::super::{Branching, Over, Parameters};
    use super::super::{FULL_FRAME, Lens, crystals_in};
    use super::*;

    const TAU: f64 = 1e5;

    fn catalogue() -> Catalogue {
        let branching = Branching::new(&Parameters { element: 40e-6, ..Parameters::ASSUMED }).unwrap();
        let crystals = crystals_in(-15.0, 0.16, Over::Ice, 3, &branching, Seed(1)).unwrap();
        let joining = Joining::assumed();
        Catalogue::assembled(crystals, &[1, 2, 3, 4], Assembly::OneByOne, &joining, TAU, Seed(1)).unwrap()
    }

    fn shower() -> Shower {
        Shower {
            sizes: Sizes::gunn_marshall(2.0, [0.5, 5.0]).unwrap(),
            fall: FallSpeed::AGGREGATES,
            wind: Vector3::new(0.5, 0.0, 0.0),
            gust: 0.1,
        }
    }

    fn camera() -> Camera {
        let lens = Lens { focal: 0.035, number: 8.0, focus: 1.2, sensor: FULL_FRAME, shutter: 0.0 };
        Camera::new(Point3::origin(), -Vector3::z(), Vector3::y(), lens, [64, 48]).unwrap()
    }

    /// As many as asked for, all in view and between near and far, spread evenly: the cube of depth is uniform but for the margin
    /// around the view, whose share falls with depth. 600 of them, mean within 4 standard deviations, 0.29 / sqrt 600, and 1 %.
    #[test]
    fn flakes_fill_the_view_evenly() {
        let (catalogue, shower, camera) = (catalogue(), shower(), camera());
        let far = shower.reach(&camera, 0.3, 600);
        let flakes = shower.before(&camera, &catalogue, [0.3, far], 600, Seed(4)).unwrap();
        assert_eq!(flakes.len(), 600);
        let mut mean = 0.0;
        for Flying { placed, diameter } in &flakes {
            let depth = -placed.at.z;
            assert!((0.3..=far).contains(&depth));
            assert!(camera.sees(&placed.at, catalogue.bodies()[placed.template].radius() * placed.scale));
            assert!((placed.scale * catalogue.diameters()[placed.template] / diameter - 1.0).abs() < 1e-12);
            let sinking = -placed.velocity.y - shower.fall.of(*diameter);
            assert!(sinking.abs() <= 0.1 && (placed.velocity.x - 0.5).abs() <= 0.1);
            mean += (depth * depth * depth - 0.027) / (far * far * far - 0.027) / 600.0;
        }
        assert!((mean - 0.5).abs() < 0.058, "{mean}");
        // A flake does not depend on how many are asked for.
        let fewer = shower.before(&camera, &catalogue, [0.3, far], 100, Seed(4)).unwrap();
        assert_eq!(fewer, flakes[..100]);
        assert!(shower.before(&camera, &catalogue, [0.3, far], 0, Seed(4)).unwrap().is_empty());
        assert!(shower.before(&camera, &catalogue, [3.0, 2.0], 5, Seed(4)).is_err());
    }

    /// The density of flakes in the pyramid of view is that of the law.
    #[test]
    fn so_far_there_are_so_many() {
        let (shower, camera) = (shower(), camera());
        let [x, y] = camera.tangents();
        let far = shower.reach(&camera, 0.0, 1000);
        let volume = 4.0 / 3.0 * x * y * far * far * far;
        assert!((volume * shower.sizes.number_density() / 1000.0 - 1.0).abs() < 1e-12);
    }

    /// By construction, on the catalogue itself; 1e-3 is single precision over some thousand pixels.
    #[test]
    fn flakes_are_as_white_as_snow() {
        let catalogue = catalogue();
        let snow = [0.8, 0.82, 0.85];
        let light = Himeno {
            diffuse: 0.3,
            specular: 0.05,
            power: 8,
            ambient: 9.0,
            to_light: [0.2, 0.9, 0.4],
            light: snow,
            ambient_light: [7.0; 3],
        };
        let light = as_white_as(snow, light, &catalogue, TAU).unwrap();
        assert!(
            light
                .ambient_light
                .iter()
                .zip(snow)
                .all(|(ambient, snow)| *ambient > 0.6 * snow && *ambient < snow)
        );
        let again = as_white_as(snow, light, &catalogue, TAU).unwrap();
        assert_eq!(again, light, "what is in place of k_a I_a before does not matter");
        let dark = as_white_as([0.0; 3], light, &catalogue, TAU);
        assert_eq!(dark.unwrap_err().to_string().lines().count(), 1);
    }
}
