//! Crystals whose air has changed: Temp(t) and Humid(t) of Eq. (8).

use snowglobe::hexgrid::Axial;
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Panels, Plot, Result, Series, Statistic, Table,
};
use snowglobe::snow::{Crystal, History, Layer, Light, View};

use super::setup::{assumed, broken, grown};
use super::slide::{APERTURE, room, sheet, slide};

pub const HISTORIES: Experiment = Experiment {
    id: "histories",
    title: "Air that changes while a crystal grows",
    source: "§1.1.2, Eq. (8)",
    says: "Temperature and humidity may change with time; a crystal shows what it has fallen through.",
    claims: &[&CAPPED, &STEM, &HEART, &ARMS, &ENDS],
    run,
    mutant: Mutant {
        changes: "temperature of the caps, C",
        to: -6.0,
        why: "there the column goes on",
        turns_red: &["himeno/histories/capped"],
    },
};

static CAPPED: Claim = Claim {
    id: "himeno/histories/capped",
    source: "Eq. (8), Fig. 2",
    says: "a column that comes into air of plates grows caps",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "width of the ends over that of the middle, of three seeds: capped columns in photographs look like spools, at least twice",
    known: &[],
};
static STEM: Claim = Claim {
    id: "himeno/histories/stem",
    source: "Eq. (8), Fig. 2",
    says: "between its caps it is still a column",
    expect: Expect::AtLeast(1.5),
    statistic: Statistic::Each,
    reason: "length over the width of the middle: of a column",
    known: &[],
};
static HEART: Claim = Claim {
    id: "himeno/histories/heart",
    source: "Eq. (8), Fig. 2",
    says: "a plate that comes into humid air keeps its hexagon",
    expect: Expect::AtLeast(0.99),
    statistic: Statistic::Each,
    reason: "share of ice within the hexagon that the plate had when its air changed: all of it",
    known: &[],
};
static ARMS: Claim = Claim {
    id: "himeno/histories/arms",
    source: "Eq. (8), Fig. 2",
    says: "and grows a dendrite's arms",
    expect: Expect::AtMost(0.6),
    statistic: Statistic::Each,
    reason: "share of ice between that hexagon and the one around the tips: arms leave gaps, about half and less",
    known: &[],
};
static ENDS: Claim = Claim {
    id: "himeno/histories/ends",
    source: "Eq. (8), Fig. 2",
    says: "a dendrite that comes into dry air grows plates at its ends",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "breadth of the ice on an arm at nine tenths of its length, over the same of the dendrite when its air changed: ends of \
             plates are at least twice as broad as branches",
    known: &[],
};

/// One path.
struct Path {
    name: &'static str,
    /// Its air in words.
    air: &'static str,
    history: History,
    view: View,
    /// b_min, m: some hundred along the crystal and more.
    element: f64,
}

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 10e-6)?;
    let caps = lab.assume("temperature of the caps, C", -12.0, "not printed; sectored plates grow there");
    let (short, coarser) = (lab.pick(1.0, 0.4), lab.pick(1.0, 2.0));
    lab.assume_that("b_min of smaller crystals", "4 and 5 um", "some hundred elements along each");
    let spells = |spells: &[(f64, f64, f64)]| History::spells(spells).map_err(broken);
    let firsts = [(-6.0, 0.0614, 20.0 * short), (-15.0, 0.045, 40.0 * short), (-15.0, 0.1608, 15.0 * short)];
    let paths = [
        Path {
            name: "capped column",
            air: "-6 °C, 6 %, then -12 °C, 13 %",
            history: spells(&[firsts[0], (caps, 0.1267, 12.0 * short)])?,
            view: View::Side,
            element: 4e-6 * coarser,
        },
        Path {
            name: "plate with dendritic arms",
            air: "-15 °C, 4.5 %, then 16 %",
            history: spells(&[firsts[1], (-15.0, 0.1608, 8.0 * short)])?,
            view: View::Above,
            element: 5e-6 * coarser,
        },
        Path {
            name: "dendrite with plate ends",
            air: "-15 °C, 16 %, then 4.5 %",
            history: spells(&[firsts[2], (-15.0, 0.045, 40.0 * short)])?,
            view: View::Above,
            element: 10e-6,
        },
    ];
    lab.assume_that(
        "paths",
        "jumps between two kinds of air, -6 and -12 C or -15 C at 4.5 and 16.1 % over ice",
        "the paper prints none; each is the shortest that makes its crystal",
    );
    let seeds = lab.seeds(3);
    let mut table =
        Table::new(["path", "seed", "name", "diameter_mm", "height_mm", "mass_ug", "fill", "layers"]);
    let mut shown = Vec::new();
    let jobs: Vec<(usize, u64)> =
        (0..3).flat_map(|path| seeds.iter().map(move |seed| (path, *seed))).collect();
    // What it was when its air changed: the first spell alone.
    let crystals = lab.each(&jobs, |(path, seed)| -> Result<[Crystal; 2]> {
        let first = spells(&[firsts[*path]])?;
        let branching = branching.with_element(paths[*path].element).map_err(broken)?;
        Ok([grown(&branching, &paths[*path].history, *seed)?, grown(&branching, &first, *seed)?])
    });
    for ((path, seed), found) in jobs.iter().zip(crystals) {
        let [crystal, first] = found?;
        match path {
            0 => {
                let [middle, end] =
                    [0, crystal.lead()].map(|k| f64::from(2 * reach(&crystal.layers()[k]) + 1));
                lab.found_with(&CAPPED, *seed, end / middle);
                lab.found_with(&STEM, *seed, crystal.height() / (crystal.element() * middle));
            }
            1 => {
                let [heart, arms] = parts(&crystal, first.radius());
                lab.found_with(&HEART, *seed, heart);
                lab.found_with(&ARMS, *seed, arms);
            }
            _ => {
                lab.found_with(&ENDS, *seed, breadth(&crystal) / breadth(&first));
            }
        }
        lab.count("elements", crystal.count() as u64);
        table.row([
            paths[*path].name.into(),
            (*seed).into(),
            crystal.name().into(),
            (1e3 * crystal.diameter()).into(),
            (1e3 * crystal.height()).into(),
            (1e9 * crystal.mass()).into(),
            crystal.fill().into(),
            (2 * crystal.layers().len() - 1).into(),
        ]);
        if *seed == seeds[0] {
            shown.push(crystal);
        }
    }
    lab.keep("crystals", "Crystals of three paths", table)?;
    lab.keep("paths", "What the crystals fell through", plots(&paths))?;
    if lab.keeps() {
        let mut pictures = Vec::new();
        for (path, crystal) in paths.iter().zip(&shown) {
            let width = room(crystal, crystal.diameter().max(crystal.height()));
            let light = Light::BrightField(APERTURE.to_radians());
            let caption = format!("{}: {}", path.name, path.air);
            pictures.push(slide(crystal, path.view, width, 460, light, &caption)?);
        }
        let seen = sheet(&pictures, 3)?;
        lab.keep(
            "crystals-seen",
            "Capped column, plate with dendritic arms, dendrite with plate ends; supersaturation over ice",
            seen,
        )?;
    }
    Ok(())
}

/// Steps from the middle to the furthest cell of a layer.
fn reach(layer: &Layer) -> i32 {
    layer.cells().map(steps).max().unwrap_or(0)
}

fn steps(at: Axial) -> i32 {
    at.q.abs().max(at.r.abs()).max((at.q + at.r).abs())
}

/// Shares of ice within a hexagon, and between it and the one around all.
fn parts(crystal: &Crystal, radius: i32) -> [f64; 2] {
    let layer = &crystal.layers()[crystal.lead()];
    let hexagon = |n: i32| f64::from(3 * n * (n + 1) + 1);
    let inside = layer.cells().filter(|at| steps(*at) <= radius).count() as f64;
    let outside = layer.count() as f64 - inside;
    let all = hexagon(reach(layer)) - hexagon(radius);
    [inside / hexagon(radius), outside / all.max(1.0)]
}

/// Cells of ice in a row from an arm outwards to one side, at nine tenths of its length.
fn breadth(crystal: &Crystal) -> f64 {
    let k = (0.9 * f64::from(crystal.radius())) as i32;
    (0..).take_while(|r| crystal.is_ice(Axial::new(k, *r), 0)).count() as f64
}

fn plots(paths: &[Path]) -> Panels {
    let of = |path: &Path, title: &str, label: &str, range: (f64, f64), value: &dyn Fn((f64, f64)) -> f64| {
        let minutes = path.history.minutes();
        let points = (0..=400).map(|k| minutes * f64::from(k) / 400.0);
        Plot {
            title: format!("{}: {title}", path.name),
            x: Axis::of("minute"),
            y: Axis::within(label, range.0, range.1),
            series: vec![Series::new(label, Draw::Line, points.map(|t| (t, value(path.history.at(t)))))],
            bands: Vec::new(),
        }
    };
    let row = |path: &Path| {
        [
            of(path, "temperature", "temperature (°C)", (-20.0, 0.0), &|air| air.0),
            of(path, "humidity", "supersaturation over ice (%)", (0.0, 20.0), &|air| 100.0 * air.1),
        ]
    };
    Panels {
        title: "Three paths through air".to_owned(),
        columns: 2,
        plots: paths.iter().flat_map(row).collect(),
    }
}
