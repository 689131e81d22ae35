//! Fig. 9: the picture to compare with, made by a program that nobody knows. A stand-in for it, and what tells the two apart.

use nalgebra::{Point3, Vector3};
use snowglobe::image::{Exposure, ImageError, Photograph, ToneCurve};
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic,
    Table,
};
use snowglobe::rng::Seed;
use snowglobe::snow::flake::{Assembly, Joining};
use snowglobe::snow::still::{Camera, Catalogue, Placed, Scene, picture};

use super::joined::onto;
use super::setup::{assumed, grown, saturated};
use super::stage::{Settings, Stage, background, broken, looking};

pub const FIGURE_9: Experiment = Experiment {
    id: "figure-9",
    title: "Against crystals that are drawn as such",
    source: "§3, Fig. 9",
    says: "In a picture of a commercial program the shape of crystals shows, and that is unnatural; in theirs it does not.",
    claims: &[&METHOD, &STAND_IN, &KNOWN],
    run,
    mutant: Mutant {
        changes: "order of symmetry that is looked for",
        to: 5.0,
        why: "no crystal is five-fold",
        turns_red: &["himeno/figure-9/stand-in"],
    },
};

static METHOD: Claim = Claim {
    id: "himeno/figure-9/method",
    source: "§3",
    says: "in the method's picture crystal shapes do not show",
    expect: Expect::AtMost(0.03),
    statistic: Statistic::Each,
    reason: "share of the thousand flakes whose silhouette, seen as large as 24 pixels, has E6 above 0.35: of 100 flakes three may be single \
             crystals that happen to face the camera",
    known: &[],
};
static STAND_IN: Claim = Claim {
    id: "himeno/figure-9/stand-in",
    source: "§3, Fig. 9",
    says: "in that of the commercial program they do",
    expect: Expect::AtLeast(0.85),
    statistic: Statistic::Each,
    reason: "the same of a stand-in, stellar crystals that face the camera, at 12 pixels: the program is unknown, so this says that the measure \
             sees what it should, and nothing of the program",
    known: &[],
};
static KNOWN: Claim = Claim {
    id: "himeno/figure-9/known",
    source: "ours",
    says: "the measure tells a six-fold star from a disc",
    expect: Expect::AtLeast(0.7),
    statistic: Statistic::Each,
    reason: "E6 of a star r = 0.65 + 0.3 cos 6 theta, less that of the same with 5 in the place of 6: most and none, since some of the power of a \
             star of six rays is in order 12",
    known: &[],
};

/// E6 above which a shape shows.
const SHOWS: f64 = 0.35;
/// Pixels across at which flakes are looked at.
const SIDES: [usize; 3] = [8, 12, 24];

fn run(lab: &mut Lab) -> Result<()> {
    let order = lab.assume("order of symmetry that is looked for", 6.0, "crystals are six-fold") as usize;
    let threshold =
        lab.assume("E6 from which a shape shows", SHOWS, "even power in orders 2 to 12 is 0.09 each");
    let settings = Settings { size: lab.pick(Settings::ASSUMED.size, [64, 48]), ..Settings::ASSUMED };
    lab.assume_that(
        "snow, camera, light",
        "those of himeno/figure-8",
        "the two pictures differ in nothing else",
    );
    let seed = lab.seed();
    let camera = looking(settings.lens, settings.size).map_err(broken)?;
    let (behind, snow) = background(&camera, &settings.lens, seed)?;
    let settings = Settings { element: lab.pick(settings.element, 100e-6), ..settings };
    let stage = Stage::new(settings, Assembly::OneByOne, snow, seed).map_err(broken)?;
    let flakes = stage.flakes(lab.pick(1000, 20), seed).map_err(broken)?;
    let method: Vec<Placed> = flakes.iter().map(|flake| flake.placed).collect();
    let stars = Stars::new(lab, &stage, seed)?;
    let stand_in = stars.placed(&method, &stage);

    lab.found(&KNOWN, star(6, order) - star(5, order));
    let mut table = Table::new(["picture", "pixels_across", "flakes", "share_that_shows", "median_e6"]);
    let mut series = Vec::new();
    let bodies: [(&str, &[Placed], &Catalogue); 2] =
        [("method", &method, &stage.catalogue), ("stand-in", &stand_in, &stars.catalogue)];
    for (name, flakes, catalogue) in bodies {
        for side in SIDES {
            let found = lab.each(flakes, |flake| -> Result<f64> {
                let scene = Scene {
                    bodies: catalogue.bodies(),
                    flakes: &[alone(flake)],
                    extinction: stage.settings.extinction,
                    light: stage.light,
                };
                silhouette(&scene, &catalogue.bodies()[flake.template], flake.scale, side, seed)
                    .map(|image| share_of_order(&image, side, order))
            });
            let mut found = found.into_iter().collect::<Result<Vec<f64>>>()?;
            let shows = found.iter().filter(|e6| **e6 > threshold).count() as f64 / found.len() as f64;
            found.sort_unstable_by(f64::total_cmp);
            table.row([
                name.into(),
                side.into(),
                found.len().into(),
                shows.into(),
                found[found.len() / 2].into(),
            ]);
            if side != SIDES[0] {
                let n = found.len() as f64;
                let points = found.iter().enumerate().map(|(k, e6)| (*e6, 100.0 * (1.0 - k as f64 / n)));
                series.push(Series::new(format!("{name}, {side} pixels across"), Draw::Line, points));
            }
            match (name, side) {
                ("method", 24) => drop(lab.found(&METHOD, shows)),
                ("stand-in", 12) => drop(lab.found(&STAND_IN, shows)),
                _ => {}
            }
            lab.count("silhouettes", found.len() as u64);
        }
    }
    lab.keep("shapes", "Share of flakes whose shape shows, by how large they are seen", table)?;
    lab.keep(
        "e6",
        "How six-fold silhouettes are: share of flakes whose E6 is larger; from 0.35 on the shape shows",
        Plot {
            title: "Does the crystal show?".to_owned(),
            x: Axis::within("E6", 0.0, 1.0),
            y: Axis::within("flakes with more (%)", 0.0, 100.0),
            series,
            bands: Vec::new(),
        },
    )?;
    if lab.keeps() {
        let scene = Scene { bodies: stars.catalogue.bodies(), ..stage.scene(&stand_in) };
        let still = picture(&scene, &stage.camera, &behind, 64, seed).map_err(broken)?;
        let [width, height] = still.size.map(|side| side as u32);
        let photograph = Photograph::new(width, height, still.radiance)
            .map_err(|cause: ImageError| Error::broken(cause.to_string()))?;
        lab.keep(
            "figure-9-stand-in",
            "A stand-in for the commercial program's picture: every flake a stellar crystal that faces the camera",
            Artifact::Photograph(photograph, Exposure { stops: 0.0 }, ToneCurve::Linear),
        )?;
    }
    Ok(())
}

/// Stellar crystals.
struct Stars {
    catalogue: Catalogue,
}

impl Stars {
    fn new(lab: &mut Lab, stage: &Stage, seed: Seed) -> Result<Self> {
        let branching = assumed(lab, stage.settings.element)?;
        let crystals = (0..6).map(|k| grown(&branching, &saturated(-15.0, 20.0)?, seed.0 + k));
        let crystals = crystals.collect::<Result<Vec<_>>>()?;
        let numbers = [1; 6];
        let catalogue = Catalogue::assembled(
            crystals,
            &numbers,
            Assembly::OneByOne,
            &Joining::assumed(),
            stage.settings.extinction,
            seed,
        );
        Ok(Self { catalogue: catalogue.map_err(broken)? })
    }

    /// The same flakes with stars in their place, as large, turned to the camera and rolled as they may be.
    fn placed(&self, flakes: &[Placed], stage: &Stage) -> Vec<Placed> {
        let star = |(number, flake): (usize, &Placed)| {
            let template = number % self.catalogue.bodies().len();
            let diameter = flake.scale * stage.catalogue.diameters()[flake.template];
            let scale = diameter / self.catalogue.diameters()[template];
            // Its c axis along the line of sight.
            Placed { template, scale, turn: onto(&Vector3::z(), &-flake.at.coords), ..*flake }
        };
        flakes.iter().enumerate().map(star).collect()
    }
}

/// Flake in the middle of what a camera far away sees, turned to it as it was to the camera of the picture.
fn alone(flake: &Placed) -> Placed {
    let turn = onto(&flake.at.coords, &-Vector3::z()) * flake.turn;
    Placed { at: Point3::new(0.0, 0.0, -10.0), turn, velocity: Vector3::zeros(), ..*flake }
}

/// Its coverage in a square of pixels, sharp.
fn silhouette(
    scene: &Scene,
    body: &snowglobe::snow::still::Body,
    scale: f64,
    side: usize,
    seed: Seed,
) -> Result<Vec<f32>> {
    let camera = Camera::onto(10.0, body.radius() * scale, side).map_err(broken)?;
    let dark = vec![[0.0; 3]; side * side];
    Ok(picture(scene, &camera, &dark, 4, seed).map_err(broken)?.coverage)
}

/// The share of angular power of orders 2 to 12 that is of one order, over radii of 0.35 to 0.95 of the silhouette: E6.
fn share_of_order(image: &[f32], side: usize, order: usize) -> f64 {
    const ANGLES: usize = 96;
    const RINGS: usize = 13;
    // Around the middle of what is covered; as far as the furthest that is.
    let weight = |k: usize| f64::from(image[k]);
    let place = |k: usize| [(k % side) as f64 + 0.5, (k / side) as f64 + 0.5];
    let all: f64 = (0..image.len()).map(weight).sum();
    if all <= 0.0 {
        return 0.0;
    }
    let middle = [0, 1].map(|axis| (0..image.len()).map(|k| weight(k) * place(k)[axis]).sum::<f64>() / all);
    let reach = (0..image.len())
        .filter(|k| weight(*k) > 0.1)
        .map(|k| libm::hypot(place(k)[0] - middle[0], place(k)[1] - middle[1]))
        .fold(1.0, f64::max);
    let at = |x: f64, y: f64| {
        let (x, y) = (x - 0.5, y - 0.5);
        let (i, j) = (libm::floor(x), libm::floor(y));
        let sample = |i: f64, j: f64| {
            let inside = i >= 0.0 && j >= 0.0 && i < side as f64 && j < side as f64;
            if inside { f64::from(image[j as usize * side + i as usize]) } else { 0.0 }
        };
        let (u, v) = (x - i, y - j);
        (1.0 - v) * ((1.0 - u) * sample(i, j) + u * sample(i + 1.0, j))
            + v * ((1.0 - u) * sample(i, j + 1.0) + u * sample(i + 1.0, j + 1.0))
    };
    let mut power = [0.0; 13];
    for ring in 0..RINGS {
        let radius = (0.35 + 0.6 * ring as f64 / (RINGS - 1) as f64) * reach;
        let values: Vec<f64> = (0..ANGLES)
            .map(|k| {
                let (sine, cosine) = libm::sincos(std::f64::consts::TAU * k as f64 / ANGLES as f64);
                at(middle[0] + radius * cosine, middle[1] + radius * sine)
            })
            .collect();
        for (m, power) in power.iter_mut().enumerate().skip(2) {
            let (mut re, mut im) = (0.0, 0.0);
            for (k, value) in values.iter().enumerate() {
                let turn = std::f64::consts::TAU * ((m * k) % ANGLES) as f64 / ANGLES as f64;
                let (sine, cosine) = libm::sincos(turn);
                re += value * cosine;
                im += value * sine;
            }
            *power += radius * (re * re + im * im);
        }
    }
    let sum: f64 = power[2..].iter().sum();
    if sum > 0.0 { power[order] / sum } else { 0.0 }
}

/// The measure of a star of so many rays, smooth, on 96 pixels.
fn star(rays: u32, order: usize) -> f64 {
    const SIDE: usize = 96;
    let half = 0.5 * SIDE as f64;
    let image: Vec<f32> = (0..SIDE * SIDE)
        .map(|k| {
            let (x, y) = ((k % SIDE) as f64 + 0.5 - half, (k / SIDE) as f64 + 0.5 - half);
            let edge = half * (0.65 + 0.3 * libm::cos(f64::from(rays) * libm::atan2(y, x)));
            (edge - libm::hypot(x, y) + 0.5).clamp(0.0, 1.0) as f32
        })
        .collect();
    share_of_order(&image, SIDE, order)
}
