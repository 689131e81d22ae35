//! The display by billboards (§1; how stood on the page that is lost), compared with a volume renderer.

use snowglobe::automaton_cloud::{Billboards, Metaball};
use snowglobe::image::{Exposure, ToneCurve};
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic,
    Table,
};
use snowglobe::volume::{Shading, render};

use super::sky::{CELL, RADIUS, Weather, before_sky, many, once, photograph, unseen};

pub const DISPLAY: Experiment = Experiment {
    id: "display",
    title: "Billboards beside a volume renderer",
    source: "§1, §2.4",
    says: "The result is displayed quickly by billboards. How stood on the page that is lost: each metaball becomes a disc with a \
           shadow and a loss of light of its own, laid down from back to front.",
    claims: &[&ERROR, &CHEAPER, &CORE],
    run,
    mutant: Mutant {
        changes: "extinction of billboards over that of the volume",
        to: 0.0,
        why: "discs that take no light away scatter none",
        turns_red: &["dobashi/display/error"],
    },
};

static ERROR: Claim = Claim {
    id: "dobashi/display/error",
    source: "§1",
    says: "billboards show the clouds",
    expect: Expect::AtMost(0.2),
    statistic: Statistic::Each,
    reason: "root mean square difference of radiance from the volume renderer's, over its root mean square, light of the sun \
             scattered once, finest grid; a fifth, for a ball has one shadow where its places have many",
    known: &[],
};
static CHEAPER: Claim = Claim {
    id: "dobashi/display/cheaper",
    source: "§1",
    says: "billboards are quick",
    expect: Expect::AtLeast(1.0),
    statistic: Statistic::Each,
    reason: "cells that the volume renderer visits along its rays over pixels that the discs cover, finest grid: work, not time; \
             the volume's light is not counted",
    known: &[Known {
        reading: "",
        evidence: "every ball covers some hundred pixels, most of them behind others, where a ray ends in the first cloud it meets \
                   (grids.csv); what was quick was the graphics hardware",
    }],
};
static CORE: Claim = Claim {
    id: "dobashi/display/core",
    source: "ours",
    says: "these are clouds, and no haze",
    expect: Expect::AtLeast(20.0),
    statistic: Statistic::Each,
    reason: "optical depth from below to above through the thickest place, finest grid: a cumulus has 20 and more",
    known: &[],
};

fn run(lab: &mut Lab) -> Result<()> {
    let extinction = lab.assume("extinction", 0.08, "1/m deep in cloud; that of a cumulus of small droplets");
    let ratio = lab.assume("extinction of billboards over that of the volume", 1.0, "the same cloud");
    lab.assume_that("sky", "nine wet points low over a plain, dry ones between and above", "none is given");
    let steps = lab.pick(36, 8);
    let size = lab.pick([768, 432], [48, 27]);
    let sides: &[usize] = lab.pick(&[40, 80, 160], &[16, 24]);
    let mut table = Table::new([
        "cells_across",
        "metaballs",
        "splat_pixels",
        "shadow_pixels",
        "cells_visited",
        "relative_error",
        "core_optical_depth",
    ]);
    let mut errors = Vec::new();
    for side in sides {
        let weather = Weather { counts: [*side, *side, side / 4], seed: lab.seed().0, turn: None };
        let mut last = Vec::new();
        weather.film(8, steps, |cld| last = cld)?;
        let balls = weather.balls();
        let central = balls.central(&weather.widened(&last));
        let density = weather.density(&central)?;
        // Coarser cells are larger: the sky is the same.
        let scale = sides[sides.len() - 1] as f64 / *side as f64;
        let extinction = extinction * scale;
        let camera = weather.camera(size)?;
        let volume = render(&density, extinction, &camera, &Shading::Single(once()), 1).map_err(unseen)?;
        let [wide, deep, high] = balls.counts;
        let core = (0..wide * deep)
            .map(|at| (0..high).map(|k| f64::from(density.values()[k * wide * deep + at])).sum::<f64>())
            .fold(0.0, f64::max);
        let core = core * CELL * extinction;
        let metaballs: Vec<Metaball> = (0..central.len())
            .filter(|cell| central[*cell] > 0.0)
            .map(|cell| Metaball {
                centre: [cell % wide, cell / wide % deep, cell / (wide * deep)]
                    .map(|at| (at as f64 + 0.5) * CELL),
                density: f64::from(central[cell]),
                radius: RADIUS * CELL,
            })
            .collect();
        let Shading::Single(light) = Shading::Single(once()) else { continue };
        let billboards = Billboards {
            extinction: ratio * extinction / balls.whole(),
            g: light.g,
            to_sun: light.to_sun,
            sun: light.sun,
            shadow: [2 * wide, 2 * deep],
        };
        let shown = billboards.show(&metaballs, &camera).map_err(unseen)?;
        let square = |all: &mut dyn Iterator<Item = f64>| libm::sqrt(all.map(|x| x * x).sum::<f64>());
        let (a, b) = (volume.radiance.as_flattened(), shown.radiance.as_flattened());
        let off = square(&mut a.iter().zip(b).map(|(a, b)| f64::from(a - b)));
        let error = off / square(&mut a.iter().map(|a| f64::from(*a))).max(1e-12);
        table.row([
            (*side).into(),
            metaballs.len().into(),
            shown.work.pixels[1].into(),
            shown.work.pixels[0].into(),
            volume.work.cells.into(),
            error.into(),
            core.into(),
        ]);
        errors.push((*side as f64, 100.0 * error));
        lab.count("cells", volume.work.cells);
        if side == &sides[sides.len() - 1] {
            lab.found(&ERROR, error);
            lab.found(&CHEAPER, volume.work.cells as f64 / shown.work.pixels[1].max(1) as f64);
            lab.found(&CORE, core);
            if lab.keeps() {
                let many = render(&density, extinction, &camera, &many(6), 2).map_err(unseen)?;
                let (exposure, curve) = (Exposure { stops: 0.0 }, ToneCurve::Filmic);
                for (name, caption, photograph) in [
                    ("octaves", "Light scattered many times, as octaves: the picture", photograph(&many)?),
                    ("once", "Light scattered once, by the volume renderer: soot", photograph(&volume)?),
                    (
                        "billboards",
                        "Light scattered once, by billboards",
                        before_sky(size, &shown.radiance, &shown.transmittance)?,
                    ),
                ] {
                    // Soot is black: only the picture is judged as a photograph.
                    let artifact = if name == "octaves" {
                        Artifact::Photograph(photograph, exposure, curve)
                    } else {
                        Artifact::Drawing(photograph.develop(exposure, curve))
                    };
                    lab.keep(name, caption, artifact)?;
                }
            }
        }
    }
    lab.keep("grids", "Billboards and the volume renderer, by the grid", table)?;
    lab.keep(
        "error",
        "How far billboards are off",
        Plot {
            title: "Billboards against the volume renderer".to_owned(),
            x: Axis::of("cells across"),
            y: Axis::of("difference of radiance (%)"),
            series: vec![Series::new("scattered once", Draw::Joined, errors)],
            bands: Vec::new(),
        },
    )
}
