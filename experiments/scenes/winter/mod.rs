//! A clearing in a winter wood under an overcast sky: what is behind falling snow.
//!
//! The ground is Miyata's fractional midpoint displacement, bare trees are Sakai's L-system, spruces are one of our
//! own. It is a photograph of nothing: radiance is in units in which snow in front is 0.8, hollows and crests together.

mod bare;
mod canvas;
mod defocus;
mod frond;
mod ground;
mod lattice;
mod spruce;
mod stand;
mod tufts;
mod view;

use rayon::prelude::*;
use snowglobe::lab::Result;
use snowglobe::rng::Seed;

use self::bare::Bare;
use self::canvas::{Painting, Sheaf};
use self::frond::Fronds;
use self::ground::{Ground, SNOW};
use self::lattice::{Lattice, Rough};
use self::spruce::Spruce;
use self::view::View;

/// The scene; the camera stands in it.
#[derive(Clone, Debug)]
pub struct Winter {
    ground: Ground,
    clouds: Lattice,
    fronds: Fronds,
    spruces: Vec<Spruce>,
    bare: Vec<Bare>,
}

/// Light that the air among the trees adds in the end.
const HAZE: [f64; 3] = [0.215, 0.245, 0.285];
/// How far one sees in it, m: blue is lost first.
const CLEAR: [f64; 3] = [250.0, 226.0, 200.0];
/// Over so much of the clouds the sky's light differs; the lattice of them is a square of this width.
const CLOUDS: f64 = 16.0;

/// Trees that are painted together.
const TOGETHER: usize = 16;

impl Winter {
    /// Grows the wood and lays the snow.
    ///
    /// # Errors
    ///
    /// What the models that it is made of refuse; of their numbers here they refuse none.
    pub fn new(seed: Seed) -> Result<Self> {
        let spots = stand::spots(seed);
        let trees: Vec<[f64; 4]> = spots
            .iter()
            .map(|spot| [spot.place[0], spot.place[1], 0.3 + 0.14 * spot.height, spot.height])
            .collect();
        let ground = Ground::new(&trees, seed)?;
        let rough = Rough { name: "winter: clouds", dimension: 2.45, side: 3.0, gain: 0.10, levels: 5 };
        let clouds = Lattice::fractal([-0.5 * CLOUDS, 0.0], CLOUDS, 257, rough, seed)?.smoothed(3);
        let fronds = Fronds::new(seed)?;
        let spruces = stand::spruces(&spots, &ground, seed);
        let bare = stand::bare(&ground, seed)?;
        Ok(Self { ground, clouds, fronds, spruces, bare })
    }

    /// Linear radiance, row by row from the top, of a picture of so many pixels, seen by a camera at eye height (1.5 m)
    /// that looks horizontally, with the horizontal field of view given in degrees. All is within 0 to 1.
    pub fn picture(&self, size: [usize; 2], field_of_view: f64) -> Vec<[f32; 3]> {
        let view = View::new(size, field_of_view);
        let reaches = self.ground.reaches(&view);
        let mut painting = Painting::new(size[0], &reaches);
        self.paint(&view, &mut painting);
        let mut light = painting.finished(|pixel, depth| {
            let (column, row) = (pixel % size[0], pixel / size[0]);
            let across = (column as f64 + 0.5 - 0.5 * size[0] as f64) / view.focal;
            let depth = f64::from(depth);
            if depth.is_finite() {
                air(self.ground.light([across * depth, depth], &view).map(f64::from), depth)
            } else {
                self.sky(across, (0.5 * size[1] as f64 - row as f64 - 0.5) / view.focal)
            }
        });
        light.par_iter_mut().for_each(|light| *light = light.map(|x| x.clamp(0.0, 1.0)));
        light
    }

    /// A picture of so many pixels out of focus, as it is behind flakes near the camera: spread by a bell whose standard
    /// deviation is `share` of its width; its mean stays. A lens of a diameter A that is focused on a distance F spreads
    /// what is far by about A / (8 F tan(field / 2)).
    pub fn defocused(light: &[[f32; 3]], size: [usize; 2], share: f64) -> Vec<[f32; 3]> {
        defocus::defocused(light, size, share)
    }

    /// Paints all trees, the nearest first, some at a time: those behind are often hidden, and never drawn.
    fn paint(&self, view: &View, painting: &mut Painting<'_>) {
        let mut bare = self.bare.iter().rev().peekable();
        for some in self.spruces.rchunks(TOGETHER) {
            let shown = |spruce: &Spruce| {
                let (low, high) = spruce.frame(view);
                if painting.is_open(low, high) {
                    spruce.strokes(&self.fronds, view)
                } else {
                    Sheaf::default()
                }
            };
            let sheaves: Vec<Sheaf> = some.par_iter().rev().map(shown).collect();
            let mut all = Vec::new();
            for (spruce, sheaf) in some.iter().rev().zip(sheaves) {
                while let Some(nearer) = bare.next_if(|tree| tree.depth() < spruce.foot[2]) {
                    all.push(nearer.strokes(view));
                }
                if !sheaf.is_empty() {
                    all.push(sheaf);
                }
            }
            painting.lay(&all);
        }
        painting.lay(&bare.map(|tree| tree.strokes(view)).collect::<Vec<_>>());
    }

    /// The sky of an overcast day is three times as bright overhead as at the horizon (CIE), and snow that throws back
    /// nine tenths as bright as the sky at 30 degrees.
    fn sky(&self, across: f64, up: f64) -> [f32; 3] {
        let sine = up / (1.0 + across * across + up * up).sqrt();
        let bright = (1.0 + 2.0 * sine.max(0.0)) / 3.0 / 0.7;
        // On the clouds' lower face, one unit over the eye.
        let plane = 1.0 / up.max(0.07);
        let cloud = f64::from(self.clouds.at([across * plane, plane])[0]);
        let light = f64::from(SNOW) * bright * (1.0 + (0.9 * cloud).clamp(-0.16, 0.16));
        [0.955 * light, 0.99 * light, 1.035 * light].map(|x| x as f32)
    }

    /// Radiance of snow on the ground, red, green and blue: the mean of what lies 5 to 10 m before the camera.
    pub fn snow_radiance(&self) -> [f64; 3] {
        let view = View::new([640, 480], 50.0);
        let mut sums = [0.0; 3];
        for row in 0..20 {
            for column in 0..20 {
                let z = 5.25 + 0.25 * f64::from(row);
                let light = self.ground.light([z * (f64::from(column) - 9.5) / 25.0, z], &view);
                for (sum, light) in sums.iter_mut().zip(air(light.map(f64::from), z)) {
                    *sum += f64::from(light);
                }
            }
        }
        sums.map(|sum| sum / 400.0)
    }
}

/// What is seen of light through so many metres of air.
fn air(light: [f64; 3], depth: f64) -> [f32; 3] {
    [0, 1, 2].map(|k| {
        let left = libm::exp(-depth / CLEAR[k]);
        (light[k] * left + HAZE[k] * (1.0 - left)) as f32
    })
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use super::*;

    const SIZE: [usize; 2] = [320, 240];

    static WINTER: LazyLock<Winter> = LazyLock::new(|| Winter::new(Seed(1)).unwrap());
    static PICTURE: LazyLock<Vec<[f32; 3]>> = LazyLock::new(|| WINTER.picture(SIZE, 50.0));

    fn luminance(light: &[f32; 3]) -> f64 {
        let [r, g, b] = light.map(f64::from);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn mean(light: &[[f32; 3]]) -> f64 {
        light.iter().map(luminance).sum::<f64>() / light.len() as f64
    }

    #[test]
    fn all_is_light_that_a_display_shows() {
        assert_eq!(PICTURE.len(), 320 * 240);
        assert!(PICTURE.as_flattened().iter().all(|x| (0.0..1.0).contains(x)));
    }

    #[test]
    fn flakes_would_be_seen_before_most_of_it() {
        let snow = luminance(&WINTER.snow_radiance().map(|x| x as f32));
        assert!((0.78..0.92).contains(&snow), "{snow}");
        for (size, light) in [(SIZE, &*PICTURE), ([480, 270], &WINTER.picture([480, 270], 50.0))] {
            let dark = light.iter().filter(|light| luminance(light) < 0.12 * snow).count();
            let share = dark as f64 / light.len() as f64;
            assert!(share > 0.5, "{size:?}: {share}");
        }
    }

    #[test]
    fn the_ground_is_bright_and_the_wood_dark() {
        let rows = |from: usize, to: usize| mean(&PICTURE[from * 320..to * 320]);
        let (wood, ground) = (rows(80, 150), rows(200, 240));
        assert!(ground > 0.7 && ground < 0.95, "{ground}");
        assert!(wood < 0.2 * ground, "{wood} {ground}");
        let sky = luminance(&WINTER.sky(0.0, 0.3));
        assert!(sky < 1.1 * ground && sky > 0.5 * ground, "{sky}");
    }

    #[test]
    fn threads_do_not_matter() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Winter::new(Seed(1)).unwrap().picture([96, 72], 50.0))
        };
        let one = with(1);
        assert!(one == with(3));
        assert!(one == WINTER.picture([96, 72], 50.0));
    }

    /// Composed by angle: a picture of more pixels shows the same.
    #[test]
    fn the_size_does_not_change_the_scene() {
        let small = WINTER.picture([160, 120], 50.0);
        let pooled = |k: usize| {
            let (x, y) = (2 * (k % 160), 2 * (k / 160));
            [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(i, j)| luminance(&PICTURE[(y + j) * 320 + x + i]))
                .iter()
                .sum::<f64>()
                / 4.0
        };
        let off =
            small.iter().enumerate().map(|(k, light)| (luminance(light) - pooled(k)).abs()).sum::<f64>();
        assert!(off / 19_200.0 < 0.02, "{}", off / 19_200.0);
    }
}
