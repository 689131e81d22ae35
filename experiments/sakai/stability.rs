//! Can the tree stand? The force linearised about the pose at rest.

use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic, Table, maybe,
};
use snowglobe::reading::Reading;
use snowglobe::tree::{Gravity, Linearised, Parameters, ReadingSet, Readings, Target};

use super::setup::{Setup, blow, broken};

pub const STABILITY: Experiment = Experiment {
    id: "stability",
    title: "Whether the tree can stand, and how long a step may be",
    source: "§3.2 to §3.5, §6",
    says: "Wind, gravity, the restoring force and its reaction move the nodes; with the numbers of §6 the tree is seen to \
           stand.",
    claims: &[&STANDS, &CRITICAL, &STEP],
    run,
    mutant: Mutant {
        changes: "restoring coefficient",
        to: 0.0,
        why: "without a restoring force nothing that is bent goes back",
        turns_red: &["sakai/stability/stands"],
    },
};

static STANDS: Claim = Claim {
    id: "sakai/stability/stands",
    source: "§6, Fig. 5 (a)",
    says: "the tree stands when no wind blows",
    expect: Expect::AtMost(-1e-3),
    statistic: Statistic::Each,
    reason: "the greatest real part of the eigenvalues of angular acceleration by angle, 1/s2: below 0 every small bend \
             goes back; 0.001 would take half a minute and more",
    known: &[Known {
        reading: "set=literal",
        evidence: "with gravity in Eq. (7) the upright tree is a pencil on its tip: a mode grows by e in a tenth of a \
                   second (sets.csv)",
    }],
};
static CRITICAL: Claim = Claim {
    id: "sakai/stability/critical-restoring",
    source: "§6",
    says: "the printed restoring coefficient holds the tree up",
    expect: Expect::AtMost(10_000.0),
    statistic: Statistic::Each,
    reason: "the least restoring coefficient in N/m2 with which every mode goes back; §6 prints 10000",
    known: &[
        Known {
            reading: "set=physical",
            evidence: "with gravity it takes 24 times as much (sets.csv): the reaction of Eq. (6) takes most of what \
                       the restoring force gives",
        },
        Known { reading: "set=literal", evidence: "as in the physical set: the same forces (sets.csv)" },
    ],
};
static STEP: Claim = Claim {
    id: "sakai/stability/largest-step",
    source: "§3.5, Eq. (9), (10)",
    says: "the steps of the model can be taken",
    expect: Expect::AtLeast(0.002),
    statistic: Statistic::Each,
    reason: "the largest step in s at which no mode grows that is pulled back; ours is 0.002",
    known: &[],
};

fn run(lab: &mut Lab) -> Result<()> {
    let setup = Setup::new(lab);
    let skeleton = setup.skeleton()?;
    let mut sets = Table::new([
        "set",
        "restoring",
        "greatest_eigenvalue_per_s2",
        "least_eigenvalue_per_s2",
        "largest_step_s",
        "critical_restoring",
        "e_folding_s",
        "fallen_after_s",
    ]);
    let mut modes = Table::new(["set", "mode", "real_per_s2", "imaginary_per_s2"]);
    for set in lab.readings::<ReadingSet>() {
        let (given, readings) = (setup.given(set), set.readings());
        let linear = Linearised::new(&skeleton, given, readings).map_err(broken)?;
        let critical = Linearised::critical_restoring(&skeleton, given, readings).map_err(broken)?;
        let (first, last) = (linear.modes()[0].real, linear.modes()[linear.modes().len() - 1].real);
        lab.reading(set);
        lab.found(&STANDS, digits(first));
        lab.found(&CRITICAL, critical.map(digits));
        lab.found(&STEP, digits(linear.largest_step()));
        sets.row([
            set.name().into(),
            given.restoring.into(),
            digits(first).into(),
            digits(last).into(),
            digits(linear.largest_step()).into(),
            maybe(critical.map(digits)),
            maybe(linear.e_folding(setup.air.dt).map(digits)),
            maybe(fallen(&setup, set, lab.pick(5.0, 0.1))?),
        ]);
        for (number, mode) in linear.modes().iter().enumerate() {
            modes.row([
                set.name().into(),
                (number + 1).into(),
                digits(mode.real).into(),
                digits(mode.imaginary).into(),
            ]);
        }
    }
    lab.keep("sets", "Eigenvalues, steps and the critical restoring coefficient of each set", sets)?;
    lab.keep("modes", "All eigenvalues, the most unstable first", modes)?;
    let (table, plot) = by_reaction(&setup)?;
    lab.keep(
        "reaction",
        "The critical restoring coefficient with gravity, by the reaction of Eq. (6)",
        table,
    )?;
    lab.keep("critical-restoring", "What the reaction asks of the restoring coefficient, with gravity", plot)
}

/// Six digits: what an iteration to the last bit, and a derivative by differences, can promise.
fn digits(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    let size = libm::floor(libm::log10(x.abs())) as i32 - 5;
    // Powers of ten up to 10^22 are exact; dividing by them is what reading "1.23e-5" does.
    let ten = (0..size.abs()).fold(1.0, |power, _| power * 10.0);
    if size < 0 { libm::round(x * ten) / ten } else { libm::round(x / ten) * ten }
}

/// Until when the tip of a tree has come down to half its height without any wind, s; none within five seconds.
fn fallen(setup: &Setup, set: ReadingSet, seconds: f64) -> Result<Option<f64>> {
    let mut sway = setup.sway(set, 0.0)?;
    for _ in 0..setup.steps(seconds) {
        blow(&mut sway, 1)?;
        if sway.tree().bend().tip.y < -0.5 * setup.height {
            return Ok(Some(sway.time()));
        }
    }
    Ok(None)
}

fn by_reaction(setup: &Setup) -> Result<(Table, Plot)> {
    let skeleton = setup.skeleton()?;
    let mut table = Table::new(["target", "reaction", "critical_restoring"]);
    let mut series = Vec::new();
    for target in [Target::Rotated, Target::Absolute] {
        let readings = Readings { gravity: Gravity::AsPrinted, target, ..Readings::PAPER };
        let mut points = Vec::new();
        for tenth in 0..=12 {
            let reaction = f64::from(tenth) / 10.0;
            let given = Parameters { reaction, ..setup.parameters };
            let critical = Linearised::critical_restoring(&skeleton, given, readings).map_err(broken)?;
            table.row([target.name().into(), reaction.into(), maybe(critical.map(digits))]);
            points.extend(critical.map(|critical| (reaction, critical / 1000.0)));
        }
        series.push(Series::new(format!("target {}", target.name()), Draw::Joined, points));
    }
    series.push(Series::new("printed, §6", Draw::Printed, [(0.0, 10.0), (1.2, 10.0)]));
    let plot = Plot {
        title: "The restoring coefficient that holds the tree up under gravity".to_owned(),
        x: Axis::within("reaction of Eq. (6), K_d", 0.0, 1.25),
        y: Axis::log("critical restoring coefficient (kN/m2)", 1.0, 2000.0),
        series,
        bands: Vec::new(),
    };
    Ok((table, plot))
}
