//! Figure 14: five skies from contours.

use std::f64::consts::TAU;

use snowglobe::contour_cloud::{
    Compositing, Contour, Cut, Fineness, Layer, Overhead, Passage, Patches, Plateau, Surface, Window, pixel,
};
use snowglobe::image::{ImageError, Picture};
use snowglobe::lab::{Artifact, Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};

use super::draw::{Drawing, LEVELS};
use super::landscape::{Hill, Landscape};
use super::setup::{CORRECTED, broken, displacement, ring};
use super::sky::Sky;

pub const FIGURE_14: Experiment = Experiment {
    id: "figure-14",
    title: "Figure 14: five skies",
    source: "§4, Fig. 14",
    says: "Clouds from various contours, alone and before a background: a summit under its cap, haze over a highland, the \
           waves of a mackerel sky.",
    claims: &[&BOUNDED, &COVER],
    run,
    mutant: Mutant {
        changes: "scale of gamma",
        to: 0.0,
        why: "droplets that take no light away are not seen",
        turns_red: &["miyata/figure-14/cover"],
    },
};

static BOUNDED: Claim = Claim {
    id: "miyata/figure-14/bounded",
    source: "Eq. (5)",
    says: "pixels of a cloud lie between black and white",
    expect: Expect::Between(0.0, 1.0),
    statistic: Statistic::Each,
    reason: "the f of a pixel of the five that is farthest outside of 0 to 1, less rounding of 1e-9",
    known: &[],
};
static COVER: Claim = Claim {
    id: "miyata/figure-14/cover",
    source: "Fig. 14",
    says: "each picture shows a cloud, and its background",
    expect: Expect::Between(2.0, 70.0),
    statistic: Statistic::Each,
    reason: "the mean f of the five pictures that is farthest from 36 %: below 2 there is nothing to see, above 70 \
             nothing behind",
    known: &[],
};

const SIZE: [usize; 2] = [768, 480];

/// A sky: where it is seen, its contours, and how they become a cloud.
struct Example {
    name: &'static str,
    caption: &'static str,
    contours: Vec<Contour>,
    side: f64,
    gain: f64,
    layer: Layer,
    overhead: Option<Overhead>,
}

fn run(lab: &mut Lab) -> Result<()> {
    lab.assume_that("contours and backgrounds", "drawn and rendered by us", "the paper's are lost");
    lab.assume_that("ground", "smooth, in even patches", "the patches of Fig. 2 leave creases in a sky");
    let scale = lab.assume("scale of gamma", 1.0, "rates of the five pictures are not given");
    let examples = examples(scale);
    let seed = lab.seed();
    let clouds = lab.each(&examples, |example| cloud(example, seed));
    let clouds = clouds.into_iter().collect::<Result<Vec<Vec<f64>>>>()?;
    let far = |values: &mut dyn Iterator<Item = f64>, from: f64| {
        values.fold(from, |worst, x| if (x - from).abs() > (worst - from).abs() { x } else { worst })
    };
    let rounded = |f: f64| if f < 0.0 { (f + 1e-9).min(0.0) } else { (f - 1e-9).max(0.0) };
    lab.found(&BOUNDED, far(&mut clouds.iter().flatten().map(|f| rounded(*f)), 0.5));
    let mean = |f: &Vec<f64>| f.iter().sum::<f64>() / f.len() as f64;
    lab.found(&COVER, far(&mut clouds.iter().map(|f| 100.0 * mean(f)), 36.0));
    let mut table = Table::new(["picture", "contours", "mean_f", "share_over_0.05"]);
    for (example, f) in examples.iter().zip(&clouds) {
        let seen = f.iter().filter(|f| **f > 0.05).count() as f64 / f.len() as f64;
        table.row([example.name.into(), example.contours.len().into(), mean(f).into(), seen.into()]);
    }
    lab.keep("skies", "How much of each picture is cloud", table)?;
    if !lab.keeps() {
        return Ok(());
    }
    for (example, f) in examples.iter().zip(&clouds) {
        let contours = drawing(example);
        lab.keep(
            &format!("{}-contours", example.name),
            &format!("{}: (a) contours", example.caption),
            contours,
        )?;
        let grey = f.iter().flat_map(|f| [libm::round(pixel(f.clamp(0.0, 1.0))) as u8; 3]);
        let alone = picture(grey.collect())?;
        let caption = format!("{}: (b) the cloud", example.caption);
        lab.keep(&format!("{}-cloud", example.name), &caption, Artifact::Drawing(alone))?;
        let behind = background(example.name, seed)?;
        let codes = behind.pixels().iter().zip(f).flat_map(|(behind, f)| {
            let value = pixel(f.clamp(0.0, 1.0));
            behind.map(|code| libm::round(Compositing::AsPrinted.over(value, f64::from(code))) as u8)
        });
        let caption = format!("{}: (c) before its background", example.caption);
        lab.keep(example.name, &caption, Artifact::Drawing(picture(codes.collect())?))?;
    }
    Ok(())
}

fn picture(rgb: Vec<u8>) -> Result<Picture> {
    Picture::from_rgb(SIZE[0] as u32, SIZE[1] as u32, rgb)
        .map_err(|cause: ImageError| Error::broken(cause.to_string()))
}

/// f of every pixel.
fn cloud(example: &Example, seed: snowglobe::rng::Seed) -> Result<Vec<f64>> {
    let patches = Patches::new(&example.contours, Plateau::Raised).map_err(broken)?;
    let mut by = displacement(CORRECTED, example.gain, seed);
    by.moment = seed.stream(&format!("miyata: {}", example.name)).at(0);
    let surface = Surface::smooth(&patches, example.side, by);
    let seen = match &example.overhead {
        Some(view) => example.layer.seen_from_below(&surface, view, 1.0),
        None => {
            let window = Window { low: [0.0; 2], high: SIZE.map(|side| side as f64), size: SIZE };
            example.layer.seen_from_above(&surface, &window, Fineness::Pixels(1.0))
        }
    };
    Ok(seen.pixels.iter().map(|[f]| *f).collect())
}

fn drawing(example: &Example) -> String {
    let all = || example.contours.iter().flat_map(|contour| &contour.points);
    let least = [0, 1].map(|axis| all().map(|p| p[axis]).fold(f64::INFINITY, f64::min));
    let most = [0, 1].map(|axis| all().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max));
    let per = 760.0 / (most[0] - least[0]);
    let mut sheet = Drawing::new([780.0, per * (most[1] - least[1]) + 20.0]);
    let mut levels: Vec<f64> = example.contours.iter().map(|contour| contour.level).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    for contour in &example.contours {
        let place = |p: &[f64; 2]| [0, 1].map(|axis| 10.0 + per * (p[axis] - least[axis]));
        let points: Vec<[f64; 2]> = contour.points.iter().map(place).collect();
        let rank = levels.iter().position(|level| *level == contour.level).unwrap_or_default();
        sheet.line(&points, contour.closed, LEVELS[rank.min(5)], 2.0, "none");
    }
    sheet.svg()
}

/// The edge of a drawing, well below the cut.
fn frame(level: f64, [left, top]: [f64; 2], [right, bottom]: [f64; 2]) -> Contour {
    let points = vec![[left, top], [right, top], [right, bottom], [left, bottom]];
    Contour { name: "frame".to_owned(), level, dimension: 2.3, points, closed: true }
}

/// Nested rings, from the outermost level upwards.
fn nest(centre: [f64; 2], radii: [f64; 2], levels: &[f64], dimension: f64, phase: f64) -> Vec<Contour> {
    let one = |(k, level): (usize, &f64)| {
        let share = 1.0 - 0.8 * k as f64 / levels.len() as f64;
        Contour {
            name: format!("ring at {}, {}, level {level}", centre[0], centre[1]),
            level: *level,
            dimension,
            points: ring(centre, radii.map(|r| r * share), 48, phase),
            closed: true,
        }
    };
    levels.iter().enumerate().map(one).collect()
}

fn examples(scale: f64) -> Vec<Example> {
    let level =
        |h: f64, gamma: f64| Layer { cut: Cut::Level { h }, passage: Passage::Above, gamma: gamma * scale };
    let [width, height] = SIZE.map(|side| side as f64);
    let full = |at: f64| frame(at, [0.0, 0.0], [width, height]);
    let mut cap = vec![full(-60.0)];
    cap.extend(nest([384.0, 128.0], [220.0, 52.0], &[0.0, 20.0, 40.0, 60.0], 2.2, 0.4));
    let mut haze = vec![full(-50.0)];
    // Banks in the valleys, long and thin, the nearer the lower in the picture.
    for (k, (x, y, w, h)) in [
        (165.0, 286.0, 135.0, 7.0),
        (540.0, 290.0, 175.0, 8.0),
        (330.0, 312.0, 210.0, 10.0),
        (610.0, 338.0, 130.0, 11.0),
        (200.0, 346.0, 160.0, 13.0),
        (470.0, 384.0, 250.0, 16.0),
        (270.0, 425.0, 215.0, 15.0),
        (640.0, 430.0, 95.0, 13.0),
    ]
    .iter()
    .enumerate()
    {
        haze.extend(nest([*x, *y], [*w, *h], &[0.0, 12.0, 22.0], 2.2, k as f64));
    }
    let mut cumulus = vec![full(-70.0)];
    cumulus.extend(nest([290.0, 225.0], [200.0, 112.0], &[0.0, 30.0, 60.0, 90.0], 2.4, 1.0));
    cumulus.extend(nest([655.0, 130.0], [88.0, 48.0], &[0.0, 25.0, 50.0], 2.4, 2.0));
    cumulus.extend(nest([640.0, 360.0], [80.0, 34.0], &[0.0, 20.0, 40.0], 2.4, 3.0));
    let mut mackerel = vec![frame(-0.4, [-30.0, -80.0], [30.0, -3.0])];
    mackerel.extend(nest([-3.0, -26.0], [21.0, 15.0], &[0.0, 0.15, 0.3], 2.25, 0.7));
    mackerel.extend(nest([6.0, -62.0], [22.0, 11.0], &[0.0, 0.15, 0.3], 2.25, 1.7));
    let mut fair = vec![frame(-0.5, [-40.0, -90.0], [40.0, -3.0])];
    for (k, (x, y, r)) in [
        (-8.0, -11.0, 3.0),
        (3.0, -15.0, 4.2),
        (12.0, -24.0, 4.6),
        (-14.0, -29.0, 6.0),
        (2.0, -39.0, 5.5),
        (22.0, -45.0, 6.0),
        (-24.0, -56.0, 8.0),
        (6.0, -64.0, 8.0),
        (28.0, -76.0, 7.0),
    ]
    .iter()
    .enumerate()
    {
        fair.extend(nest([*x, *y], [*r, 0.7 * r], &[0.0, 0.3, 0.6], 2.35, k as f64));
    }
    let overhead = |above: f64, horizon: f64| Overhead {
        eye: [0.0, 0.0],
        heading: [0.0, -1.0],
        above,
        focal: 560.0,
        horizon,
        size: SIZE,
    };
    let waves = Cut::Waves { a: 0.22, b: 1.6, alpha: TAU / 1.9, beta: TAU / 17.0, level: 0.12 };
    vec![
        Example {
            name: "cap",
            caption: "A cap on a summit",
            contours: cap,
            side: 64.0,
            gain: 0.16,
            layer: level(0.0, 0.035),
            overhead: None,
        },
        Example {
            name: "haze",
            caption: "Haze on a highland",
            contours: haze,
            side: 44.0,
            gain: 0.22,
            layer: level(-4.0, 0.032),
            overhead: None,
        },
        Example {
            name: "cumulus",
            caption: "Fair weather, from the side",
            contours: cumulus,
            side: 72.0,
            gain: 0.4,
            layer: level(10.0, 0.03),
            overhead: None,
        },
        Example {
            name: "heaps",
            caption: "Heaps of cloud to the horizon",
            contours: fair,
            side: 2.6,
            gain: 0.18,
            layer: level(0.0, 4.0),
            overhead: Some(overhead(3.0, 470.0)),
        },
        Example {
            name: "mackerel",
            caption: "A mackerel sky, by a wavy cut",
            contours: mackerel,
            side: 2.2,
            gain: 0.1,
            layer: Layer { cut: waves, passage: Passage::Above, gamma: 3.2 * scale },
            overhead: Some(overhead(4.5, 450.0)),
        },
    ]
}

fn background(name: &str, seed: snowglobe::rng::Seed) -> Result<Picture> {
    let low = Sky { sun: 32.0, top: 40.0, bottom: 0.5, exposure: 0.7 };
    let broken = |cause: ImageError| Error::broken(cause.to_string());
    let hill = |x: f64, y: f64, rx: f64, ry: f64, height: f64, concave: f64| Hill {
        centre: [x, y],
        radii: [rx, ry],
        height,
        concave,
    };
    let base = Landscape {
        hills: &[],
        eye: 0.5,
        focal: 760.0,
        horizon: 330.0,
        size: SIZE,
        sky: low,
        sun: [-0.64, 0.43, 0.64],
        snow: 2.3,
        clear: 0.955,
        gain: 0.1,
    };
    match name {
        "cap" => Landscape {
            hills: &[
                hill(0.0, -17.0, 10.5, 9.5, 5.2, 1.7),
                hill(-14.5, -30.0, 7.0, 5.0, 1.6, 1.3),
                hill(15.0, -32.0, 7.0, 6.0, 1.8, 1.3),
            ],
            ..base
        }
        .picture(seed),
        "haze" => Landscape {
            hills: &[
                hill(-9.0, -15.0, 5.5, 4.5, 1.3, 1.2),
                hill(6.5, -19.0, 6.5, 5.0, 1.7, 1.2),
                hill(-4.0, -31.0, 9.0, 6.0, 2.6, 1.2),
                hill(15.5, -34.0, 7.0, 6.0, 2.9, 1.2),
            ],
            horizon: 250.0,
            eye: 1.0,
            snow: 2.6,
            clear: 0.968,
            ..base
        }
        .picture(seed),
        "cumulus" => Sky::DAY.picture(SIZE[0] as u32, SIZE[1] as u32).map_err(broken),
        _ => Landscape {
            hills: &[hill(-11.0, -24.0, 8.0, 5.0, 1.0, 1.2), hill(12.0, -27.0, 9.0, 6.0, 1.2, 1.2)],
            horizon: if name == "heaps" { 470.0 } else { 450.0 },
            focal: 560.0,
            eye: 0.3,
            ..base
        }
        .picture(seed),
    }
}
