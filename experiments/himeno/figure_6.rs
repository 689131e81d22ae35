//! Fig. 6: seven ways to hold on to each other, and flakes of many crystals.

use nalgebra::{Point3, Vector3};
use snowglobe::image::{Exposure, Face, ImageError, Photograph, Picture, ToneCurve, draw_text};
use snowglobe::lab::{
    Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table,
    average, maybe,
};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::snow::flake::{Assembly, Attachment, Flake, Joining, Template, Weights};
use snowglobe::snow::still::{Body, Camera, Placed, Scene, picture};
use snowglobe::snow::{Branching, Cubes, Parameters};
use snowglobe::volume::Himeno;

use super::joined::{aspect_ratio, four_types, log_slope, onto};
use super::setup::{assumed, broken};

pub const FIGURE_6: Experiment = Experiment {
    id: "figure-6",
    title: "Seven ways to hold on, and flakes of many",
    source: "§1.2, §1.2.1, Fig. 6",
    says: "Crystals are tangled, or meet face to face, face to line, face to point, line to line, line to point, point to point; flakes of \
           many repeat what flakes of few do.",
    claims: &[&SEVEN, &TOUCH, &PARALLEL, &TIPS, &EXPONENT, &ASPECT],
    run,
    mutant: Mutant {
        changes: "where tangles begin, share of the radius",
        to: 0.0,
        why: "then crystals tangle at their middles, too",
        turns_red: &["himeno/figure-6/tips"],
    },
};

static SEVEN: Claim = Claim {
    id: "himeno/figure-6/seven",
    source: "Fig. 6",
    says: "there are seven ways",
    expect: Expect::Near { value: 7.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "ways for which a flake was assembled: all",
    known: &[],
};
static TOUCH: Claim = Claim {
    id: "himeno/figure-6/touch",
    source: "Fig. 6",
    says: "the two crystals touch",
    expect: Expect::AtMost(2.0),
    statistic: Statistic::Each,
    reason: "distance between the nearest elements of both, in elements, the furthest of all flakes of two: elements that touch along a \
             diagonal are 1.7 apart",
    known: &[],
};
static PARALLEL: Claim = Claim {
    id: "himeno/figure-6/parallel",
    source: "Fig. 6",
    says: "face to face their faces are parallel",
    expect: Expect::AtMost(1e-6),
    statistic: Statistic::Each,
    reason: "1 - cosine between c axes, the greatest: roundings",
    known: &[],
};
static TIPS: Claim = Claim {
    id: "himeno/figure-6/tips",
    source: "§1.2.1",
    says: "dendrites tangle at their tips",
    expect: Expect::AtLeast(0.6),
    statistic: Statistic::Each,
    reason: "where elements of one lie in the other, from the middle of either, over its radius, the least of all tangles: the outer third, but for an \
             element's width",
    known: &[],
};
static EXPONENT: Claim = Claim {
    id: "himeno/figure-6/exponent",
    source: "Brandes et al. 2007; Holroyd 1971",
    says: "the mass of flakes goes with the square of their size",
    expect: Expect::Near { value: 2.04, within: 0.25 },
    statistic: Statistic::Each,
    reason: "slope of mass over diameter, logarithmic, flakes of 2 to 32 dendrites: observed densities go with D^-0.922 and D^-1, so masses with \
             2.08 and 2.0; the spread is thrice the slope's own error",
    known: &[],
};
static ASPECT: Claim = Claim {
    id: "himeno/figure-6/aspect",
    source: "ours",
    says: "the more crystals, the rounder the flake",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "shortest over longest axis, mean of the flakes of 2, of 4 to 8, and of 16 to 32 dendrites",
    known: &[],
};

/// Crystals of flakes of many.
const NUMBERS: [usize; 7] = [2, 3, 4, 8, 12, 16, 32];
/// Pixels across a flake of the gallery.
const SIDE: usize = 190;

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 20e-6)?;
    let templates = four_types(&branching, lab.seed().0)?;
    let from = lab.assume("where tangles begin, share of the radius", 2.0 / 3.0, "§1.2.1: at the tips");
    let joining = Joining { tangle_from: from, ..Joining::assumed() };
    lab.assume_that("largest tilt", "20 degrees", "crystals tumble");
    let each = u64::from(lab.pick(24_u32, 2));
    let mut gallery = Vec::new();
    let (mut made, mut apart, mut askew, mut out) = (0, 0.0_f64, 0.0_f64, f64::INFINITY);
    let mut table = Table::new(["way", "flakes", "furthest_apart_elements", "overlap"]);
    for way in Attachment::ALL {
        // The pair of types that shows it best: dendrites, or a dendrite and a needle where a face meets a line.
        let chosen = match way {
            Attachment::FaceLine | Attachment::FacePoint | Attachment::LinePoint => [0, 1],
            Attachment::LineLine => [1, 3],
            Attachment::FaceFace => [2, 0],
            _ => [0, 0],
        };
        let only = only(way);
        let joining = Joining { weights: only, ..joining.clone() };
        let numbers: Vec<u64> = (0..each).collect();
        let flakes = lab.each(&numbers, |number| {
            let seed = Seed(lab.seed().0 + 7919 * number);
            Flake::assemble(&templates, &chosen, Assembly::OneByOne, &joining, seed).map_err(broken)
        });
        let flakes = flakes.into_iter().collect::<Result<Vec<_>>>()?;
        made += usize::from(flakes.iter().all(|f| f.members[1].held.map(|(_, how)| how) == Some(way)));
        let furthest = flakes.iter().map(|flake| gap(flake, &templates)).fold(0.0, f64::max);
        apart = apart.max(furthest);
        if way == Attachment::FaceFace {
            askew = flakes.iter().map(crossed).fold(0.0, f64::max);
        }
        if way == Attachment::Tangle {
            out = flakes.iter().map(|flake| innermost(flake, &templates)).fold(f64::INFINITY, f64::min);
        }
        let overlap =
            flakes.iter().map(|flake| flake.overlap(&templates)).map(|o| o[0].max(o[1])).fold(0.0, f64::max);
        table.row([way.name().into(), flakes.len().into(), furthest.into(), overlap.into()]);
        gallery.push((way, chosen, joining));
        lab.count("flakes", flakes.len() as u64);
    }
    lab.found(&SEVEN, made as f64);
    lab.found(&TOUCH, apart);
    lab.found(&PARALLEL, askew);
    lab.found(&TIPS, out);
    lab.keep("ways", "Flakes of two in each of the seven ways", table)?;
    if lab.keeps() {
        let sheet = sheet(lab, &gallery)?;
        lab.keep("figure-6", "The seven ways, rendered by Eq. (11); a bar of 0.5 mm", sheet)?;
    }
    many(lab, &templates)
}

/// Weights for one way alone.
fn only(way: Attachment) -> Weights {
    let mut weights = Weights::UNIFORM;
    for ways in weights.0.as_flattened_mut() {
        *ways = [0.0; 7];
        ways[way as usize] = 1.0;
    }
    weights
}

/// Distance between the nearest elements of two crystals, in elements.
fn gap(flake: &Flake, templates: &[Template]) -> f64 {
    let places = |k: usize| -> Vec<Point3<f64>> {
        let member = &flake.members[k];
        templates[member.template].surface().iter().map(|place| member.pose * place).collect()
    };
    let (a, mut b) = (places(0), places(1));
    let element = templates[flake.members[0].template].crystal().element();
    // By x, so that only those near along it are looked at.
    b.sort_unstable_by(|p, q| p.x.total_cmp(&q.x));
    let mut least = f64::INFINITY;
    for place in &a {
        let reach = least.min(8.0 * element);
        let first = b.partition_point(|other| other.x < place.x - reach);
        for other in b[first..].iter().take_while(|other| other.x <= place.x + reach) {
            least = least.min((place - other).norm_squared().sqrt());
        }
    }
    least / element
}

/// 1 - cosine between two c axes.
fn crossed(flake: &Flake) -> f64 {
    let axis = |k: usize| flake.members[k].pose.rotation * Vector3::z();
    1.0 - axis(0).dot(&axis(1)).abs()
}

/// How near to the middle of either crystal an element of the other is in its ice, over its radius.
fn innermost(flake: &Flake, templates: &[Template]) -> f64 {
    let mut least = f64::INFINITY;
    for [a, b] in [[0, 1], [1, 0]] {
        let (of, other) = (&flake.members[a], &flake.members[b]);
        let seen = of.pose.inverse() * other.pose;
        let template = &templates[of.template];
        for place in templates[other.template].surface() {
            let there = seen * place;
            if template.is_ice(&there) {
                least = least.min(there.coords.norm_squared().sqrt() / template.radius());
            }
        }
    }
    least
}

/// Flakes of many dendrites: mass and shape.
fn many(lab: &mut Lab, templates: &[Template]) -> Result<()> {
    let joining = Joining::assumed();
    let seeds = lab.seeds(lab.pick(6, 2));
    let numbers: &[usize] = lab.pick(&NUMBERS, &NUMBERS[..4]);
    let jobs: Vec<(usize, u64)> =
        numbers.iter().flat_map(|n| seeds.iter().map(move |seed| (*n, *seed))).collect();
    let mut table =
        Table::new(["assembly", "crystals", "seed", "diameter_mm", "mass_mg", "aspect_ratio", "overlap"]);
    let mut series = Vec::new();
    for assembly in lab.readings::<Assembly>() {
        lab.reading(assembly);
        let flakes = lab.each(&jobs, |(number, seed)| {
            let chosen = vec![0; *number];
            let seed = Seed(1000 * seed + *number as u64);
            Flake::assemble(templates, &chosen, assembly, &joining, seed).map_err(broken)
        });
        let mut points = Vec::new();
        let mut round = [Vec::new(), Vec::new(), Vec::new()];
        for ((number, seed), flake) in jobs.iter().zip(flakes) {
            let flake = flake?;
            let (diameter, mass) = (1e3 * flake.diameter(templates), 1e6 * flake.mass(templates));
            let aspect = aspect_ratio(&flake, templates);
            let overlap = if *number <= 8 { Some(flake.overlap(templates)[0]) } else { None };
            points.push((diameter, mass));
            match number {
                2 => round[0].push(aspect),
                4 | 8 => round[1].push(aspect),
                16 | 32 => round[2].push(aspect),
                _ => {}
            }
            table.row([
                assembly.name().into(),
                (*number).into(),
                (*seed).into(),
                diameter.into(),
                mass.into(),
                aspect.into(),
                maybe(overlap),
            ]);
        }
        lab.found(&EXPONENT, log_slope(&points).map(|(slope, _)| slope));
        let means: Vec<f64> = round.iter().filter(|all| !all.is_empty()).map(|all| average(all)).collect();
        lab.found(&ASPECT, snowglobe::lab::smallest_rise(&means));
        let slope =
            log_slope(&points).map_or(String::new(), |(slope, error)| format!(": {slope:.2} ± {error:.2}"));
        series.push(Series::new(format!("{}{slope}", assembly.name()), Draw::Dots, points));
    }
    lab.default_reading();
    let density = (0..=20).map(|k| {
        let d = libm::pow(10.0, 0.05 * f64::from(k));
        let kilograms = snowglobe::snow::aggregate_density(d) * std::f64::consts::PI / 6.0 * d * d * d * 1e-9;
        (d, 1e6 * kilograms)
    });
    series.push(Series::new("Brandes et al. 2007, spheres: 2.08", Draw::Line, density));
    lab.keep(
        "many",
        "Flakes of many dendrites: size, mass and shape, crystal by crystal and flake by flake",
        table,
    )?;
    lab.keep(
        "mass-by-size",
        "Mass of flakes of 2 to 32 dendrites by their diameter",
        Plot {
            title: "How mass grows with size".to_owned(),
            x: Axis::log("diameter (mm)", 1.0, 12.0),
            y: Axis::log("mass (mg)", 0.01, 30.0),
            series,
            bands: Vec::new(),
        },
    )
}

/// The gallery, two rows, of crystals twice as fine.
fn sheet(lab: &mut Lab, gallery: &[(Attachment, [usize; 2], Joining)]) -> Result<Picture> {
    const TAU: f64 = 8e4;
    let bad = |cause: ImageError| Error::broken(cause.to_string());
    let fine = lab.assume("b_min of the gallery, m", lab.pick(10e-6, 60e-6), "a pixel shows some 10 um");
    let branching = Branching::new(&Parameters { element: fine, ..Parameters::ASSUMED }).map_err(broken)?;
    let templates = four_types(&branching, lab.seed().0)?;
    let cubes = templates.iter().map(|t| Cubes::new(t.crystal(), 3).map_err(broken));
    let cubes = cubes.collect::<Result<Vec<_>>>()?;
    let light = Himeno {
        diffuse: 0.75,
        specular: 0.15,
        power: 8,
        ambient: 0.32,
        to_light: [-0.5, 0.8, 0.6],
        light: [0.95, 0.95, 0.92],
        ambient_light: [0.72, 0.82, 1.0],
    };
    let mut pictures = Vec::new();
    for (way, chosen, joining) in gallery {
        let flake = Flake::assemble(&templates, chosen, Assembly::OneByOne, joining, lab.seed());
        let body = Body::new(&flake.map_err(broken)?, &cubes, 3, TAU).map_err(broken)?;
        // From where most of both is to be seen.
        let coarse = body.levels() - 1;
        let seen_from = |k: i32| {
            let z = 1.0 - (f64::from(k) + 0.5) / 20.0;
            let (sine, cosine) = libm::sincos(2.4 * f64::from(k));
            let r = (1.0 - z * z).sqrt();
            [r * cosine, r * sine, z]
        };
        let most = (0..40)
            .map(seen_from)
            .max_by(|a, b| body.opacity(coarse, *a, 300).total_cmp(&body.opacity(coarse, *b, 300)));
        let view = Vector3::from(most.unwrap_or([0.0, 0.0, 1.0]));
        let placed = Placed {
            template: 0,
            at: Point3::new(0.0, 0.0, -10.0),
            turn: onto(&view, &Vector3::new(0.1, 0.2, 1.0)),
            scale: 1.0,
            velocity: Vector3::zeros(),
        };
        let radius = 1.04 * body.radius();
        let scene = Scene { bodies: &[body], flakes: &[placed], extinction: TAU, light };
        let camera = Camera::onto(10.0, radius, SIDE).map_err(broken)?;
        let night = vec![[0.012, 0.02, 0.036]; SIDE * SIDE];
        let seen = picture(&scene, &camera, &night, 64, Seed(1)).map_err(broken)?;
        let photograph = Photograph::new(SIDE as u32, SIDE as u32, seen.radiance).map_err(bad)?;
        let shown = photograph.develop(Exposure { stops: 0.0 }, ToneCurve::Linear);
        let mut tile = Picture::new(SIDE as u32, SIDE as u32 + 26, [22, 30, 42]).map_err(bad)?;
        tile.paste(&shown, 0, 0);
        let words = way.name().replace('-', " ");
        draw_text(&mut tile, 8.0, SIDE as f64 + 18.0, 15.0, [225, 232, 240], &words, Face::Regular);
        let bar = (0.5e-3 / (2.0 * radius) * SIDE as f64) as u32;
        for x in 0..bar.min(SIDE as u32 - 16) {
            for y in 0..3 {
                tile.set(SIDE as u32 - 8 - x, SIDE as u32 - 10 + y, [225, 232, 240]);
            }
        }
        pictures.push(tile);
    }
    Picture::grid(&pictures.iter().collect::<Vec<_>>(), 4, 6, [22, 30, 42]).map_err(bad)
}
