//! How flakes fall: Eq. (17) to (22), and what is observed.

use nalgebra::Vector3;
use snowglobe::lab::{
    Axis, Claim, Draw, Error, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};
use snowglobe::reading::Reading;
use snowglobe::snow::fall::{Drag, FallSpeed, Falling, GRAVITY, in_vacuum};
use snowglobe::snow::{aggregate_density, diameter_of_melted};

use super::setup::broken;

pub const FALL: Experiment = Experiment {
    id: "fall",
    title: "How flakes fall",
    source: "§4, Eq. (17) to (22)",
    says: "In a vacuum flakes would fall far too fast, whatever their mass; with resistance in proportion to speed they fall steadily.",
    claims: &[&VACUUM, &STEADY, &EXACT, &ORDER, &UNSTABLE, &LAW, &SQUARE],
    run,
    mutant: Mutant {
        changes: "distance fallen, m",
        to: 0.01,
        why: "after a centimetre not even a stone is fast",
        turns_red: &["himeno/fall/vacuum"],
    },
};

static VACUUM: Claim = Claim {
    id: "himeno/fall/vacuum",
    source: "§4",
    says: "and flakes would be far too fast near the ground",
    expect: Expect::AtLeast(10.0),
    statistic: Statistic::Each,
    reason: "speed without air after a fall from a low cloud over the observed speed of a flake of 5 mm: too fast by an order of magnitude is \
             far too fast",
    known: &[],
};
static STEADY: Claim = Claim {
    id: "himeno/fall/steady",
    source: "Eq. (22)",
    says: "with resistance a flake soon falls steadily",
    expect: Expect::AtMost(0.5),
    statistic: Statistic::Each,
    reason: "distance, m, after which a flake of 5 mm falls at 99 % of its steady speed: below the height of a scene by far. By hand some 0.35 \
             m with linear drag, 0.2 m with quadratic",
    known: &[],
};
static EXACT: Claim = Claim {
    id: "himeno/fall/exact",
    source: "Eq. (22)",
    says: "Eq. (22) has a closed form, in which steps of any length agree",
    expect: Expect::AtMost(1e-12),
    statistic: Statistic::Each,
    reason: "a thousand exact steps against one, m/s: roundings of 1e-16 each",
    known: &[],
};
static ORDER: Claim = Claim {
    id: "himeno/fall/order",
    source: "ours",
    says: "Euler's method converges in the first order",
    expect: Expect::Near { value: 1.0, within: 0.05 },
    statistic: Statistic::Each,
    reason: "slope of the error over the step from 1/64 to 1/512 of m / c, on logarithmic axes: second-order terms are a hundredth and less",
    known: &[],
};
static UNSTABLE: Claim = Claim {
    id: "himeno/fall/unstable",
    source: "ours",
    says: "and is unstable in steps above 2 m / c",
    expect: Expect::Near { value: 2.0, within: 0.01 },
    statistic: Statistic::Each,
    reason: "the step, in m / c, from which a disturbance no longer decays, by halving: |1 - c dt / m| = 1. With quadratic drag the slope at the \
             steady speed is twice as steep, so that it is 1",
    known: &[Known {
        reading: "drag=quadratic",
        evidence: "at the steady speed the drag's derivative is 2 g / speed: the bound is half of that of linear drag",
    }],
};
static LAW: Claim = Claim {
    id: "himeno/fall/law",
    source: "Locatelli & Hobbs 1974",
    says: "flakes twice as large fall a tenth faster: resistance goes with the square of speed, not with speed",
    expect: Expect::Between(0.05, 0.45),
    statistic: Statistic::Each,
    reason: "exponent of steady speed by diameter that a drag whose coefficient is one number for all flakes predicts, mass by the density of \
             aggregates and area as of a disc; observed are 0.16 (dendrites) and 0.41 (plates and columns)",
    known: &[
        Known {
            reading: "drag=linear",
            evidence: "c as of Stokes, in proportion to the diameter: speed goes with mass over diameter, D^1.08",
        },
        Known {
            reading: "drag=quadratic",
            evidence: "D^0.039: density that falls as D^-0.922 leaves little; observed flakes have more mass for their area the larger \
                       they are",
        },
    ],
};
static SQUARE: Claim = Claim {
    id: "himeno/fall/coefficient",
    source: "Locatelli & Hobbs 1974",
    says: "and the coefficient is that of a blunt body",
    expect: Expect::Between(0.5, 2.5),
    statistic: Statistic::Each,
    reason: "drag coefficient of a disc of 5 mm at the observed speed, mass as above: discs in a turbulent wake have 1.1 to 1.2, porous flakes \
             up to twice as much",
    known: &[],
};

/// Density of air near 0 C, kg/m3.
const AIR: f64 = 1.29;
/// A flake that is looked at, m.
const FLAKE: f64 = 5e-3;
/// The table of the literature; its rows say how many sources agree.
const OBSERVED: &str = include_str!("../data/snow/fall_speed.csv");
const CALM: Vector3<f64> = Vector3::new(0.0, 0.0, 0.0);

fn run(lab: &mut Lab) -> Result<()> {
    let height = lab.assume("distance fallen, m", 500.0, "a low cloud's base");
    lab.assume("density of air, kg/m3", AIR, "near the ground at 0 C");
    let observed = FallSpeed::AGGREGATES.of(FLAKE);
    let seconds = libm::sqrt(2.0 * height / GRAVITY);
    lab.found(&VACUUM, in_vacuum(seconds) / observed);
    for drag in lab.readings::<Drag>() {
        lab.reading(drag);
        let falling = Falling::at_steady_speed(observed, drag, CALM).map_err(broken)?;
        lab.found(&STEADY, settles(&falling)?);
        lab.found(&EXACT, in_steps(&falling)?);
        lab.found(&ORDER, order(&falling)?);
        lab.found(&UNSTABLE, bound(&falling));
        let speeds = [1.0, 10.0].map(|mm| predicted(drag, 1e-3 * mm));
        lab.found(&LAW, libm::log10(speeds[1] / speeds[0]));
    }
    lab.default_reading();
    let mass = aggregate_density(1e3 * FLAKE) * std::f64::consts::PI / 6.0 * FLAKE * FLAKE * FLAKE;
    let area = 0.25 * std::f64::consts::PI * FLAKE * FLAKE;
    lab.found(&SQUARE, 2.0 * mass * GRAVITY / (AIR * area * observed * observed));
    observations(lab)?;
    curves(lab, observed)
}

/// Metres until 99 % of the steady speed.
fn settles(falling: &Falling) -> Result<f64> {
    let (step, mut fallen, mut k) = (1e-4, 0.0, 0);
    loop {
        let speed = -falling.after(&CALM, step * (f64::from(k) + 0.5)).map_err(broken)?.y;
        fallen += step * speed;
        k += 1;
        if speed >= 0.99 * falling.steady_speed() || k > 100_000 {
            return Ok(fallen);
        }
    }
}

/// By how much a thousand steps differ from one.
fn in_steps(falling: &Falling) -> Result<f64> {
    let mut velocity = CALM;
    for _ in 0..1000 {
        velocity = falling.after(&velocity, 2e-4).map_err(broken)?;
    }
    Ok((velocity - falling.after(&CALM, 0.2).map_err(broken)?).y.abs())
}

/// Order of Euler's method.
fn order(falling: &Falling) -> Result<f64> {
    let time = falling.steady_speed() / GRAVITY;
    let known = falling.after(&CALM, time).map_err(broken)?.y;
    let error = |steps: u32| {
        let mut velocity = CALM;
        (0..steps).for_each(|_| velocity = falling.euler(&velocity, time / f64::from(steps)));
        (velocity.y - known).abs()
    };
    Ok(libm::log(error(64) / error(512)) / libm::log(8.0))
}

/// The step, in steady speeds over g, from which a small disturbance grows.
fn bound(falling: &Falling) -> f64 {
    let time = falling.steady_speed() / GRAVITY;
    let steady = Vector3::new(0.0, -falling.steady_speed(), 0.0);
    let grows = |step: f64| {
        let off = 1e-7;
        let disturbed = steady + Vector3::new(0.0, off, 0.0);
        let after = falling.euler(&disturbed, step * time) - falling.euler(&steady, step * time);
        after.y.abs() > off
    };
    let (mut low, mut high) = (0.1, 8.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if grows(middle) { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// Steady speed that a law of drag predicts, m/s, whose coefficient is one number for all flakes.
fn predicted(drag: Drag, diameter: f64) -> f64 {
    let mass =
        aggregate_density(1e3 * diameter) * std::f64::consts::PI / 6.0 * diameter * diameter * diameter;
    let reference = FallSpeed::AGGREGATES.of(FLAKE);
    let mass_of_reference =
        aggregate_density(1e3 * FLAKE) * std::f64::consts::PI / 6.0 * FLAKE * FLAKE * FLAKE;
    // Fitted at one size; what is predicted is how it changes.
    match drag {
        Drag::Linear => reference * (mass / diameter) / (mass_of_reference / FLAKE),
        Drag::Quadratic => {
            let area = |d: f64| d * d;
            reference * libm::sqrt((mass / area(diameter)) / (mass_of_reference / area(FLAKE)))
        }
    }
}

/// Observed laws of fall speed: what two sources have is drawn as a line, the rest faintly.
fn observations(lab: &mut Lab) -> Result<()> {
    let bad = || Error::broken("the table of fall speeds is not what it was");
    let mut reader = csv::Reader::from_reader(OBSERVED.as_bytes());
    let diameters: Vec<f64> = (0..=40).map(|k| libm::pow(10.0, -0.4 + 0.036 * f64::from(k))).collect();
    let mut series = Vec::new();
    let mut table = Table::new(["particle", "v_at_1_mm", "exponent", "sources"]);
    for row in reader.records() {
        let row = row.map_err(|cause| bad().because(cause))?;
        let text = |k: usize| row.get(k).ok_or_else(bad);
        let number = |k: usize| text(k)?.parse::<f64>().map_err(|cause| bad().because(cause));
        let (name, confirmed) = (text(0)?.to_owned(), text(7)?.starts_with("v 2src"));
        let sources = if confirmed { "two sources" } else { "unconfirmed" };
        let law = FallSpeed { coefficient: number(1)?, exponent: number(2)? };
        table.row([name.as_str().into(), law.coefficient.into(), law.exponent.into(), sources.into()]);
        if name.contains("melted") {
            continue;
        }
        let points = diameters.iter().map(|d| (*d, law.of(1e-3 * d)));
        let (name, draw) = if confirmed {
            (format!("observed: {name}"), Draw::Printed)
        } else {
            (String::new(), Draw::Ghost)
        };
        series.push(Series::new(name, draw, points));
    }
    for drag in Drag::ALL {
        let points = diameters.iter().map(|d| (*d, predicted(*drag, 1e-3 * d)));
        series.push(Series::new(format!("{} drag, fitted at 5 mm", drag.name()), Draw::Line, points));
    }
    lab.keep(
        "observed",
        "Observed laws of fall speed, v = a D^b, m/s and mm, and how many sources agree",
        table,
    )?;
    lab.keep(
        "by-size",
        "Steady speed by size: observed laws (faint ones unconfirmed), and two laws of drag fitted at 5 mm",
        Plot {
            title: "How fast flakes of a size fall".to_owned(),
            x: Axis::log("diameter (mm)", 0.4, 11.0),
            y: Axis::log("steady speed (m/s)", 0.05, 5.0),
            series,
            bands: Vec::new(),
        },
    )?;
    let mut melted = Table::new(["melted_mm", "diameter_mm", "density_kg_m3"]);
    for k in 1..=20 {
        let drop = 0.2 * f64::from(k);
        let diameter = diameter_of_melted(drop);
        melted.row([drop.into(), diameter.into(), aggregate_density(diameter).into()]);
    }
    lab.keep(
        "melted",
        "Diameters of flakes by that of the drops that they melt to (Brandes et al. 2007)",
        melted,
    )
}

/// Speeds from rest, with and without air.
fn curves(lab: &mut Lab, observed: f64) -> Result<()> {
    let times: Vec<f64> = (0..=60).map(|k| 0.01 * f64::from(k)).collect();
    let mut series = vec![Series::new(
        "vacuum, Eq. (19)",
        Draw::Line,
        times.iter().map(|t| (*t, in_vacuum(*t))).filter(|(_, v)| *v <= 2.0),
    )];
    for drag in Drag::ALL {
        let falling = Falling::at_steady_speed(observed, *drag, CALM).map_err(broken)?;
        let exact = times.iter().map(|t| Ok((*t, -falling.after(&CALM, *t).map_err(broken)?.y)));
        let exact = exact.collect::<Result<Vec<_>>>()?;
        series.push(Series::new(format!("{} drag, exact", drag.name()), Draw::Line, exact));
    }
    let falling = Falling::at_steady_speed(observed, Drag::Linear, CALM).map_err(broken)?;
    let step = 2.2 * observed / GRAVITY;
    let mut velocity = CALM;
    let mut points = vec![(0.0, 0.0)];
    while points.len() < 4 {
        velocity = falling.euler(&velocity, step);
        points.push((step * points.len() as f64, -velocity.y));
    }
    points.retain(|(t, _)| *t <= 0.6);
    series.push(Series::new("Euler's method in steps of 2.2 m / c", Draw::Joined, points));
    lab.keep(
        "speeds",
        "A flake of 5 mm from rest",
        Plot {
            title: "From rest to a steady fall".to_owned(),
            x: Axis::within("time (s)", 0.0, 0.6),
            y: Axis::within("speed downwards (m/s)", -0.5, 2.5),
            series,
            bands: Vec::new(),
        },
    )
}
