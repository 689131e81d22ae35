//! Fig. 1: the four types of crystals, and those between.

use snowglobe::image::Picture;
use snowglobe::lab::{Artifact, Claim, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};
use snowglobe::mesh::Part;
use snowglobe::snow::{Crystal, History, Light, Over, saturation};

use super::setup::{assumed, broken, grown};
use super::slide::{APERTURE, coloured_sheet, room, sheet, slide, view_of};

pub const FIGURE_1: Experiment = Experiment {
    id: "figure-1",
    title: "Four types of crystals",
    source: "§1, Fig. 1",
    says: "Snow crystals are dendrites, needles, plates and columns, by temperature and humidity.",
    claims: &[&DENDRITE, &INTRICATE, &NEEDLE, &PLATE, &FULL, &COLUMN],
    run,
    mutant: Mutant {
        changes: "temperature of (a), C",
        to: -6.0,
        why: "there columns grow",
        turns_red: &["himeno/figure-1/dendrite"],
    },
};

static DENDRITE: Claim = Claim {
    id: "himeno/figure-1/dendrite",
    source: "Fig. 1 (a)",
    says: "a dendrite is flat",
    expect: Expect::AtLeast(5.0),
    statistic: Statistic::Each,
    reason: "width over height: the paper's is a star of six thin arms; of plates 5 is already thick",
    known: &[],
};
static INTRICATE: Claim = Claim {
    id: "himeno/figure-1/intricate",
    source: "Fig. 1 (a)",
    says: "a dendrite's arms leave most of its hexagon empty, and branch twice over",
    expect: Expect::Between(0.1, 0.5),
    statistic: Statistic::Each,
    reason: "share of its hexagon that is ice, if branches of branches have grown: less than half, more than arms alone",
    known: &[],
};
static NEEDLE: Claim = Claim {
    id: "himeno/figure-1/needle",
    source: "Fig. 1 (b)",
    says: "a needle is slender",
    expect: Expect::AtLeast(5.0),
    statistic: Statistic::Each,
    reason: "length over width: needles are told from columns by some 5",
    known: &[],
};
static PLATE: Claim = Claim {
    id: "himeno/figure-1/plate",
    source: "Fig. 1 (c)",
    says: "a plate is wider than high",
    expect: Expect::AtLeast(1.5),
    statistic: Statistic::Each,
    reason: "width over height; thick plates are still plates",
    known: &[],
};
static FULL: Claim = Claim {
    id: "himeno/figure-1/full",
    source: "Fig. 1 (c)",
    says: "a plate is a hexagon without gaps",
    expect: Expect::AtLeast(0.95),
    statistic: Statistic::Each,
    reason: "share of its hexagon that is ice, but for a cell or two along its sides",
    known: &[],
};
static COLUMN: Claim = Claim {
    id: "himeno/figure-1/column",
    source: "Fig. 1 (d)",
    says: "a column is longer than wide, and no needle",
    expect: Expect::Between(1.2, 5.0),
    statistic: Statistic::Each,
    reason: "length over width",
    known: &[],
};

/// A crystal of the figure, or one between: name, temperature, supersaturation over ice, minutes.
struct Sample {
    name: &'static str,
    /// b_min, um: some hundred along the crystal and more, that none is seen.
    element: f64,
    temperature: f64,
    supersaturation: f64,
    minutes: f64,
}

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 10e-6)?;
    let coarser = lab.pick(1.0, 4.0);
    lab.assume_that("b_min of smaller crystals", "2.5 to 5 um", "some hundred elements along each");
    let why = "not printed; where the paper's diagram has this type";
    let of = |lab: &mut Lab, letter: char, temperature: f64| {
        lab.assume(&format!("temperature of ({letter}), C"), temperature, why)
    };
    let water = saturation::water_saturation;
    let [a, b, c, d] = [('a', -15.0), ('b', -6.0), ('c', -15.0), ('d', -8.0)].map(|(k, t)| of(lab, k, t));
    lab.assume_that(
        "supersaturation",
        "that of (a) and (b) is saturation over water",
        "humid air, as in cloud",
    );
    let dry = lab.assume("supersaturation of (c) over ice", 0.045, "plates grow at -15 C where it is drier");
    let drier = lab.assume("supersaturation of (d) over ice", 0.025, "columns are solid where it is drier");
    let samples = [
        Sample {
            name: "(a) dendrite",
            element: 10.0,
            temperature: a,
            supersaturation: water(a),
            minutes: 20.0,
        },
        Sample { name: "(b) needle", element: 2.5, temperature: b, supersaturation: water(b), minutes: 25.0 },
        Sample { name: "(c) plate", element: 4.0, temperature: c, supersaturation: dry, minutes: 60.0 },
        Sample { name: "(d) column", element: 2.5, temperature: d, supersaturation: drier, minutes: 70.0 },
        Sample {
            name: "sectored plate",
            element: 5.0,
            temperature: -12.0,
            supersaturation: water(-12.0),
            minutes: 25.0,
        },
        Sample {
            name: "hollow column",
            element: 2.5,
            temperature: -8.0,
            supersaturation: water(-8.0),
            minutes: 30.0,
        },
    ];
    let seed = lab.seed().0;
    let crystals = lab.each(&samples, |sample| {
        let Sample { temperature, supersaturation, minutes, .. } = *sample;
        let history = History::constant(temperature, supersaturation, Over::Ice, minutes).map_err(broken)?;
        let finer = branching.with_element(1e-6 * coarser * sample.element).map_err(broken)?;
        grown(&finer, &history, seed)
    });
    let crystals = crystals.into_iter().collect::<Result<Vec<Crystal>>>()?;
    let flat = |k: usize| crystals[k].diameter() / crystals[k].height();
    lab.found(&DENDRITE, flat(0));
    let twice = crystals[0].tally().highest_order() >= 2;
    lab.found(&INTRICATE, twice.then(|| crystals[0].fill()));
    lab.found(&NEEDLE, 1.0 / flat(1));
    lab.found(&PLATE, flat(2));
    lab.found(&FULL, crystals[2].fill());
    lab.found(&COLUMN, 1.0 / flat(3));
    keep(lab, &samples, &crystals)
}

fn keep(lab: &mut Lab, samples: &[Sample], crystals: &[Crystal]) -> Result<()> {
    let mut table = Table::new([
        "sample",
        "element_um",
        "temperature_c",
        "supersaturation_over_ice_pct",
        "minutes",
        "name",
        "diameter_mm",
        "height_mm",
        "fill",
        "highest_order",
        "layers",
        "mass_ug",
        "spheroid_mass_ug",
    ]);
    for (sample, crystal) in samples.iter().zip(crystals) {
        lab.count("elements", crystal.count() as u64);
        table.row([
            sample.name.into(),
            (1e6 * crystal.element()).into(),
            sample.temperature.into(),
            (100.0 * sample.supersaturation).into(),
            sample.minutes.into(),
            crystal.name().into(),
            (1e3 * crystal.diameter()).into(),
            (1e3 * crystal.height()).into(),
            crystal.fill().into(),
            crystal.tally().highest_order().into(),
            (2 * crystal.layers().len() - 1).into(),
            (1e9 * crystal.mass()).into(),
            (1e9 * crystal.axes().mass).into(),
        ]);
    }
    lab.keep("crystals", "The crystals of Fig. 1 and two between, measured", table)?;
    if !lab.keeps() {
        return Ok(());
    }
    let caption = |sample: &Sample| {
        format!(
            "{}: {} °C, {:.1} % over ice, {} min",
            sample.name,
            sample.temperature,
            100.0 * sample.supersaturation,
            sample.minutes
        )
    };
    let picture = |light: Light, side: usize| -> Result<Vec<Picture>> {
        let of = |(sample, crystal): (&Sample, &Crystal)| {
            let (view, long) = view_of(crystal);
            slide(crystal, view, room(crystal, long), side, light, &caption(sample))
        };
        samples.iter().zip(crystals).map(of).collect()
    };
    let aperture = APERTURE.to_radians();
    let bright = picture(Light::BrightField(aperture), 500)?;
    lab.keep("figure-1", "The four types, in bright field", sheet(&bright[..4], 2)?)?;
    let coloured = picture(Light::Coloured(aperture), 280)?;
    lab.keep(
        "coloured",
        "The four types and two between, in light coloured by direction",
        coloured_sheet(&coloured, 3)?,
    )?;
    for (name, crystal) in ["dendrite", "needle", "plate", "column"].iter().zip(crystals) {
        let part = Part {
            name: (*name).to_owned(),
            mesh: crystal.mesh(),
            colour: [0.86, 0.93, 1.0],
            pose: ([0.0; 3], [0.0, 0.0, 0.0, 1.0]),
        };
        let caption = format!("The {name} as a body; glTF, y upwards along its c axis");
        lab.keep(name, &caption, Artifact::Bodies(vec![part]))?;
    }
    Ok(())
}
