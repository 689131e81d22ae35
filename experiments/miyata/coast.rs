//! A real contour: the coast of Great Britain, its dimension, and a cloud of its shape.

use snowglobe::contour_cloud::{
    Compositing, Contour, Cut, Fineness, Layer, Passage, Plateau, Surface, SurfaceDimension, Window, divider,
    pixel, traced, walk,
};
use snowglobe::image::{ImageError, Picture};
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic,
    Table,
};
use snowglobe::sketch::read_geojson_lines;

use super::setup::{CORRECTED, broken, displacement};
use super::sky::Sky;

pub const COAST: Experiment = Experiment {
    id: "coast",
    title: "A coast as a contour",
    source: "§2.1",
    says: "The dimension of a contour is measured and goes into the surface. Here it is measured on coasts whose dimension is \
           published, and one of them is made into a cloud.",
    claims: &[&BRITAIN, &AUSTRALIA, &ROUGHER],
    run,
    mutant: Mutant {
        changes: "points from one to the next",
        to: 300.0,
        why: "a coast of a dozen points is smooth",
        turns_red: &["miyata/coast/britain"],
    },
};

/// What the estimator is allowed on curves of known dimension.
const WITHIN: f64 = 0.05;

static BRITAIN: Claim = Claim {
    id: "miyata/coast/britain",
    source: "Mandelbrot 1967, Science 156, 636-638",
    says: "the coast of Great Britain has D = 1.25",
    expect: Expect::Near { value: 1.25, within: WITHIN },
    statistic: Statistic::Each,
    reason: "dividers from about 10 to 100 km; what the estimator is allowed on curves of known D. The number is Richardson's for \
             the west coast, from larger maps",
    known: &[],
};
static AUSTRALIA: Claim = Claim {
    id: "miyata/coast/australia",
    source: "Mandelbrot 1967, Science 156, 636-638",
    says: "the coast of Australia has D = 1.13",
    expect: Expect::Near { value: 1.13, within: WITHIN },
    statistic: Statistic::Each,
    reason: "as for Great Britain",
    known: &[],
};
static ROUGHER: Claim = Claim {
    id: "miyata/coast/rougher",
    source: "Mandelbrot 1967, Science 156, 636-638",
    says: "the coast of Great Britain is the rougher of the two",
    expect: Expect::Exceeds("miyata/coast/australia"),
    statistic: Statistic::Each,
    reason: "D of Great Britain against that of Australia: an order needs no tolerance",
    known: &[],
};

/// A degree of latitude, km.
const DEGREE: f64 = 111.2;

/// A coast on a plane, in km.
struct Coast {
    name: String,
    points: Vec<[f64; 2]>,
}

fn coasts() -> Result<Vec<Coast>> {
    let lines = read_geojson_lines(include_bytes!("../data/coasts.geojson"))
        .map_err(|cause| Error::broken(cause.to_string()))?;
    let flat = |points: &[[f64; 2]]| {
        let middle = points.iter().map(|p| p[1]).sum::<f64>() / points.len() as f64;
        let narrower = libm::cos(middle.to_radians());
        points.iter().map(|[x, y]| [x * DEGREE * narrower, y * DEGREE]).collect()
    };
    // What is in brackets is the name in the file.
    let named =
        |name: &str| name.split_once('(').map_or(name, |(_, rest)| rest.trim_end_matches(')')).to_owned();
    Ok(lines.iter().map(|line| Coast { name: named(&line.name), points: flat(&line.points) }).collect())
}

fn run(lab: &mut Lab) -> Result<()> {
    let every = lab.assume("points from one to the next", 1.0, "all points of the map") as usize;
    lab.assume_that("map", "Natural Earth, 1:10,000,000", "a map that is free, and comes in a package");
    let mut coasts = coasts()?;
    for coast in &mut coasts {
        coast.points = coast.points.iter().step_by(every).copied().collect();
    }
    let published = [
        ("Great Britain", lab.printed("D of Great Britain", 1.25, "Mandelbrot 1967"), &BRITAIN),
        ("Australia", lab.printed("D of Australia", 1.13, "Mandelbrot 1967"), &AUSTRALIA),
    ];
    let mut table = Table::new(["coast", "points", "length_km", "measured_d", "published_d"]);
    let (mut series, mut britain) = (Vec::new(), 1.0);
    for coast in &coasts {
        // A line of which nothing can be told is smooth.
        let d = divider(&coast.points, true).unwrap_or(1.0);
        let mut closed = coast.points.clone();
        closed.extend(coast.points.first());
        let length: f64 = closed.windows(2).map(|p| libm::hypot(p[1][0] - p[0][0], p[1][1] - p[0][1])).sum();
        let known = published.iter().find(|(name, _, _)| *name == coast.name);
        table.row([
            coast.name.as_str().into(),
            coast.points.len().into(),
            length.into(),
            d.into(),
            known.map_or_else(|| "".into(), |(_, d, _)| (*d).into()),
        ]);
        if let Some((name, _, claim)) = known {
            lab.found(claim, d);
            if *name == "Great Britain" {
                lab.found(&ROUGHER, d);
                britain = d;
            }
        }
        let steps = (0..=16).map(|k| 8.0 * libm::exp2(f64::from(k) / 4.0));
        let lengths = steps.map(|step| (step, step * walk(&closed, step))).collect::<Vec<_>>();
        series.push(Series::new(format!("{}, D = {d:.2}", coast.name), Draw::Joined, lengths));
    }
    lab.keep("coasts", "D of coasts, measured and published", table)?;
    lab.keep(
        "richardson",
        "The finer the dividers, the longer the coast: Richardson's plot, whose slope is 1 - D",
        Plot {
            title: "How long is a coast?".to_owned(),
            x: Axis::log("opening of the dividers (km)", 7.0, 150.0),
            y: Axis::log("length (km)", 1000.0, 30000.0),
            series,
            bands: Vec::new(),
        },
    )?;
    let gain = lab.assume("gain", 0.1, "at 1, as printed, displacement hides the coast");
    let gamma = lab.assume("gamma", 0.06, "per km; by eye");
    if lab.keeps() {
        let coast = coasts.iter().find(|coast| coast.name == "Great Britain");
        let coast = coast.ok_or_else(|| Error::broken("no Great Britain in the data"))?;
        let picture = cloud(coast, SurfaceDimension::PlusOne.of_line(britain), (gain, gamma), lab.seed())?;
        lab.keep(
            "britain",
            "A cloud of the shape of Great Britain, its D that of the coast and one",
            picture,
        )?;
    }
    Ok(())
}

fn cloud(
    coast: &Coast,
    dimension: f64,
    (gain, gamma): (f64, f64),
    seed: snowglobe::rng::Seed,
) -> Result<Artifact> {
    let size = [400, 600];
    let contour = |name: &str, level: f64, points: Vec<[f64; 2]>| Contour {
        name: name.to_owned(),
        level,
        dimension,
        points,
        closed: true,
    };
    let points = coast.points.clone();
    let of = |pick: fn(f64, f64) -> f64, axis: usize| {
        points.iter().map(|p| p[axis]).reduce(pick).unwrap_or_default()
    };
    let low = [0, 1].map(|axis| of(f64::min, axis) - 60.0);
    let high = [0, 1].map(|axis| of(f64::max, axis) + 60.0);
    let window = Window::around((low, high), size);
    let ([left, top], [right, bottom]) = (window.low, window.high);
    let frame = vec![[left, top], [right, top], [right, bottom], [left, bottom]];
    let contours = [contour("frame", -40.0, frame), contour("coast", 0.0, points)];
    let patches = traced(&contours, 2.0, Plateau::Raised).map_err(broken)?.patches;
    let surface = Surface::smooth(&patches, 60.0, displacement(CORRECTED, gain, seed));
    let layer = Layer { cut: Cut::Level { h: 0.0 }, passage: Passage::Above, gamma };
    let seen = layer.seen_from_above(&surface, &window, Fineness::Pixels(1.0));
    let wrong = |cause: ImageError| Error::broken(cause.to_string());
    let sky = Sky::DAY.picture(size[0] as u32, size[1] as u32).map_err(wrong)?;
    let codes = sky.pixels().iter().zip(&seen.pixels).flat_map(|(behind, [f])| {
        let value = pixel(f.clamp(0.0, 1.0));
        behind.map(|code| libm::round(Compositing::AsPrinted.over(value, f64::from(code))) as u8)
    });
    Picture::from_rgb(size[0] as u32, size[1] as u32, codes.collect()).map(Artifact::Drawing).map_err(wrong)
}
