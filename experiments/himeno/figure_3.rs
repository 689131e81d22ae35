//! Fig. 3: a crystal is a stack of layers, and what condition 5 and 6 make of that.

use snowglobe::hexgrid::Axial;
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic, Table,
    average, maybe, smallest_rise,
};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::snow::{Crystal, History, Layers, Light, Over, View};

use super::setup::{assumed, broken, grown, saturated};
use super::slide::{APERTURE, room, sheet, slide};

pub const FIGURE_3: Experiment = Experiment {
    id: "figure-3",
    title: "Crystals and layers",
    source: "§1.1.1, §1.1.3, Fig. 3, Eq. (2)",
    says: "All crystals are stacks of layers of the xy plane: wide ones are plates and dendrites, high ones needles and columns; a \
           layer begins where the one below is dense, and branches above its branches.",
    claims: &[&STACK, &WIDE_OR_HIGH, &DENSE, &PLATES, &ABOVE, &RELIEF],
    run,
    mutant: Mutant {
        changes: "p1 above a branch",
        to: 0.0,
        why: "then nothing branches above a branch",
        turns_red: &["himeno/figure-3/above"],
    },
};

static STACK: Claim = Claim {
    id: "himeno/figure-3/stack",
    source: "Eq. (2)",
    says: "a crystal has as many layers as its height asks for",
    expect: Expect::AtMost(2.0),
    statistic: Statistic::Each,
    reason: "layers less the height of the spheroid over b_min, at worst of eight crystals: one on either side may have just begun, or not \
             begun, on a cell",
    known: &[],
};
static WIDE_OR_HIGH: Claim = Claim {
    id: "himeno/figure-3/wide-or-high",
    source: "§1.1.1",
    says: "grown in the xy plane crystals are dendrites and plates, along z needles and columns",
    expect: Expect::Near { value: 8.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "of eight crystals, those that are wider than high where plates and dendrites grow, and higher than wide where needles and \
             columns do: all",
    known: &[],
};
static DENSE: Claim = Claim {
    id: "himeno/figure-3/dense",
    source: "§1.1.3, condition 5",
    says: "a layer begins where it is dense around",
    expect: Expect::AtLeast(0.1),
    statistic: Statistic::Each,
    reason: "correlation, over cells of a dendrite's first layer, of a second above with the share of ice around, the least of all seeds: \
             above 0 by more than twice its own error, 0.05 for some thousand cells that are not independent",
    known: &[Known { reading: "layers=extruded", evidence: "all layers alike: the second is everywhere" }],
};
static PLATES: Claim = Claim {
    id: "himeno/figure-3/plates",
    source: "§1.1.3, condition 5",
    says: "and where the habit is near to plate",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "share of the first layer that is under a second, mean of the seeds: of dendrites, sectored plates, plates",
    known: &[Known { reading: "layers=extruded", evidence: "all of it, whatever the habit" }],
};
static ABOVE: Claim = Claim {
    id: "himeno/figure-3/above",
    source: "§1.1.3, condition 6",
    says: "on the second layer and above a branch is likelier where the layer below has branched",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "share of cells at which a branch began with a branch below, over the same without, all seeds together: a difference that is \
             not chance",
    known: &[],
};
static RELIEF: Claim = Claim {
    id: "himeno/figure-3/relief",
    source: "Fig. 3",
    says: "a crystal has relief: it is thickest in the middle, and thicker along its arms than beside",
    expect: Expect::AtLeast(1.2),
    statistic: Statistic::Each,
    reason: "thickness along the arms over that beside them, the least of all seeds, if the middle is nowhere exceeded: a fifth more is \
             seen in photographs as a ridge",
    known: &[Known { reading: "layers=extruded", evidence: "a cookie cutter has no ridge" }],
};

const SEEDS: u64 = 12;

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 10e-6)?;
    let minutes = lab.pick(20.0, 6.0);
    lab.assume("minutes of growth", minutes, "not printed; a dendrite is then 2 mm wide");
    let seeds = lab.seeds(SEEDS);
    stacks(lab, &branching, minutes)?;
    let air = [("dendrite", -15.0, 0.1608), ("sectored plate", -12.0, 0.1267), ("plate", -15.0, 0.045)];
    let mut table =
        Table::new(["layers", "air", "seed", "fill", "share_under_second", "correlation", "relief"]);
    let mut pictures = Vec::new();
    for layers in lab.readings::<Layers>() {
        lab.reading(layers);
        let mut shares = Vec::new();
        for (name, temperature, supersaturation) in air {
            // Plates take longer to be as wide.
            let minutes = if name == "plate" { 3.0 * minutes } else { minutes };
            let history =
                History::constant(temperature, supersaturation, Over::Ice, minutes).map_err(broken)?;
            let crystals = lab.each(&seeds, |seed| {
                Crystal::grow(&history, &branching, layers, Seed(*seed)).map_err(broken)
            });
            let crystals = crystals.into_iter().collect::<Result<Vec<_>>>()?;
            let under: Vec<f64> = crystals.iter().map(under_a_second).collect();
            for ((seed, crystal), under) in seeds.iter().zip(&crystals).zip(&under) {
                lab.count("elements", crystal.count() as u64);
                let (correlation, relief) = (crystal.correlation_with_density(), relief(crystal));
                if name == "dendrite" {
                    lab.found_with(&DENSE, *seed, correlation);
                    lab.found_with(&RELIEF, *seed, relief);
                }
                table.row([
                    layers.name().into(),
                    name.into(),
                    (*seed).into(),
                    crystal.fill().into(),
                    (*under).into(),
                    maybe(correlation),
                    maybe(relief),
                ]);
            }
            shares.push(average(&under));
            if name == "dendrite" {
                pictures.push((layers, crystals[0].clone()));
                if layers == Layers::Dense {
                    above(lab, &crystals);
                }
            }
        }
        lab.found(&PLATES, smallest_rise(&shares));
    }
    lab.default_reading();
    lab.keep(
        "conditions",
        "Layers of crystals: where the second begins, and how much relief there is",
        table,
    )?;
    keep(lab, &pictures)
}

/// Condition 6, of all crystals together; extruded layers do not branch of their own.
fn above(lab: &mut Lab, crystals: &[Crystal]) {
    let share = |below: bool| {
        let counts = crystals.iter().map(|crystal| crystal.tally().tried_and_branched(below));
        let (tried, branched) = counts.fold((0, 0), |all, one| (all.0 + one.0, all.1 + one.1));
        (tried > 0).then(|| branched as f64 / tried as f64)
    };
    let ratio = share(true).zip(share(false)).map(|(with, without)| with / without);
    lab.found(&ABOVE, ratio.filter(|ratio| ratio.is_finite()));
}

/// Eight crystals as stacks.
fn stacks(lab: &mut Lab, branching: &snowglobe::snow::Branching, minutes: f64) -> Result<()> {
    let air = [-2.0, -12.0, -15.0, -17.0, -5.0, -6.0, -8.0, -25.0];
    let crystals = lab.each(&air, |temperature| grown(branching, &saturated(*temperature, minutes)?, 1));
    let (mut off, mut as_said) = (0.0_f64, 0);
    let mut table =
        Table::new(["temperature_c", "name", "layers", "height_over_element", "diameter_mm", "height_mm"]);
    for (temperature, crystal) in air.iter().zip(crystals) {
        let crystal = crystal?;
        let layers = 2 * crystal.layers().len() - 1;
        let wanted = 2.0 * crystal.axes().c / crystal.element();
        off = off.max((layers as f64 - wanted).abs());
        let flat = crystal.diameter() > crystal.height();
        // Plates near 0 C and from -10 to -20 C, columns between and below: the paper's diagram.
        let wide = *temperature > -4.0 || (-22.0..=-10.0).contains(temperature);
        as_said += i32::from(flat == wide);
        table.row([
            (*temperature).into(),
            crystal.name().into(),
            layers.into(),
            wanted.into(),
            (1e3 * crystal.diameter()).into(),
            (1e3 * crystal.height()).into(),
        ]);
    }
    lab.found(&STACK, off);
    lab.found(&WIDE_OR_HIGH, f64::from(as_said));
    lab.keep("stacks", "Eight crystals as stacks of layers", table)
}

/// The share of a crystal's first layer that lies under a second.
fn under_a_second(crystal: &Crystal) -> f64 {
    let layers = &crystal.layers()[crystal.lead()..];
    layers.get(1).map_or(0.0, |second| second.count() as f64 / layers[0].count() as f64)
}

/// Mean thickness of cells on the arms, over that of cells beside them; none where the middle is exceeded, or nothing is beside.
fn relief(crystal: &Crystal) -> Option<f64> {
    let thickness = |at: &Axial| crystal.thickness(*at) as f64;
    let on_arm = |at: &Axial| at.q == 0 || at.r == 0 || at.q + at.r == 0;
    let (on, beside): (Vec<Axial>, Vec<Axial>) = crystal.layers()[0].cells().partition(on_arm);
    let most = crystal.thickness(Axial::ORIGIN);
    let exceeded = on.iter().chain(&beside).any(|at| crystal.thickness(*at) > most);
    if exceeded || beside.is_empty() {
        return None;
    }
    let mean = |cells: &[Axial]| average(&cells.iter().map(thickness).collect::<Vec<_>>());
    Some(mean(&on) / mean(&beside))
}

fn keep(lab: &mut Lab, pictures: &[(Layers, Crystal)]) -> Result<()> {
    if !lab.keeps() {
        return Ok(());
    }
    let mut slides = Vec::new();
    let mut series = Vec::new();
    for (layers, crystal) in pictures {
        let light = Light::BrightField(APERTURE.to_radians());
        let caption = format!("layers {}: -15 °C, 16.1 % over ice, 20 min", layers.name());
        slides.push(slide(crystal, View::Above, room(crystal, crystal.diameter()), 460, light, &caption)?);
        let radius = crystal.radius();
        let along = |at: &dyn Fn(i32) -> Axial| -> Vec<(f64, f64)> {
            let micro = 1e6 * crystal.element();
            let height = |k: i32| (f64::from(k) * micro, micro * crystal.thickness(at(k)) as f64);
            (-radius..=radius).map(height).collect()
        };
        let name = |what: &str| format!("{}, {what}", layers.name());
        series.push(Series::new(name("along an arm"), Draw::Step, along(&|k| Axial::new(k, 0))));
    }
    let seen = sheet(&slides, 2)?;
    lab.keep(
        "layers-seen",
        "The same dendrite with layers all alike, and with layers where it is dense",
        seen,
    )?;
    lab.keep(
        "section",
        "Thickness along an arm, from tip to tip; heights stretched",
        Plot {
            title: "A section through a dendrite".to_owned(),
            x: Axis::of("along an arm (µm)"),
            y: Axis::of("thickness (µm)"),
            series,
            bands: Vec::new(),
        },
    )
}
