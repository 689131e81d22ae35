//! Is it a tree? What the printed numbers amount to as wood and as wind.

use snowglobe::lab::{Claim, Expect, Experiment, Known, Lab, Mutant, Result, Statistic, Table};
use snowglobe::reading::Reading;
use snowglobe::tree::{Drag, ReadingSet, Readings};

use super::setup::{Setup, blow};

pub const PLAUSIBILITY: Experiment = Experiment {
    id: "plausibility",
    title: "What the numbers amount to",
    source: "§3, §6",
    says: "The motion is computed physically: natural laws as relations between quantities.",
    claims: &[&MODULUS, &BUCKLING, &OWN_BUCKLING, &DRAG],
    run,
    mutant: Mutant {
        changes: "height",
        to: 60.0,
        why: "no stem of 5 cm radius stands 60 m high",
        turns_red: &["sakai/plausibility/self-buckling-of-wood"],
    },
};

static MODULUS: Claim = Claim {
    id: "sakai/plausibility/youngs-modulus",
    source: "§3.2, Eq. (5), §6",
    says: "the restoring coefficient is that of a tree",
    expect: Expect::Between(2e9, 2e10),
    statistic: Statistic::Each,
    reason: "Young's modulus in Pa of a cantilever that pulls its end back as Eq. (5) does, 4 K_r l^2 / (3 r^2), of the \
             stem; green wood has 2 to 20 GPa along the grain",
    known: &[Known {
        reading: "",
        evidence: "three orders of magnitude too soft, and rubber rather than wood; the physical set's two (numbers.csv)",
    }],
};
static BUCKLING: Claim = Claim {
    id: "sakai/plausibility/self-buckling-of-wood",
    source: "§6",
    says: "a tree of this height and radius can stand",
    expect: Expect::Between(0.01, 1.0),
    statistic: Statistic::Each,
    reason: "its height over that at which a column of wood (10 GPa) and of its radius buckles under its own weight, \
             (7.8373 E r^2 / (4 rho g))^(1/3) (Greenhill 1881)",
    known: &[],
};
static OWN_BUCKLING: Claim = Claim {
    id: "sakai/plausibility/self-buckling",
    source: "§6",
    says: "the tree of the model can stand",
    expect: Expect::Between(0.01, 1.0),
    statistic: Statistic::Each,
    reason: "the same with the modulus that its own restoring coefficient amounts to",
    known: &[
        Known {
            reading: "set=paper",
            evidence: "three times too high for so soft a stem (numbers.csv); the set leaves gravity out",
        },
        Known {
            reading: "set=literal",
            evidence: "three times too high for so soft a stem (numbers.csv): it falls",
        },
    ],
};
static DRAG: Claim = Claim {
    id: "sakai/plausibility/wind-force",
    source: "§3.2, Eq. (3), §6",
    says: "the wind pushes as a wind does",
    expect: Expect::Between(0.5, 2.0),
    statistic: Statistic::Each,
    reason: "force of Eq. (3) over quadratic drag on a cylinder (C_d 1.2), of a still link at 10 m/s: a factor of two is \
             what shape and roughness leave open",
    known: &[Known {
        reading: "",
        evidence: "a thirtieth of it (numbers.csv); linear drag also grows too little with the wind",
    }],
};

const WOOD: f64 = 1e10;

fn run(lab: &mut Lab) -> Result<()> {
    let setup = Setup::new(lab);
    lab.assume("Young's modulus of wood", WOOD, "Pa, green wood along the grain, as tables have it");
    let mut table = Table::new(["set", "quantity", "unit", "value"]);
    for set in lab.readings::<ReadingSet>() {
        let given = setup.given(set);
        let skeleton = setup.skeleton()?;
        let (l, r) = (skeleton.length(1), skeleton.radius(1));
        // F = pi r^2 / l K_r x beside F = 3 E I / l^3 x with I = pi r^4 / 4.
        let modulus = 4.0 * given.restoring * l * l / (3.0 * r * r);
        let buckles =
            |modulus: f64| libm::cbrt(7.8373 * modulus * r * r / (4.0 * given.density * given.gravity));
        let linear = given.wind * skeleton.surface(1) * 10.0;
        let quadratic = 0.5 * given.air_density * given.drag * 2.0 * r * l * 100.0;
        lab.reading(set);
        lab.found(&MODULUS, modulus);
        lab.found(&BUCKLING, setup.height / buckles(WOOD));
        lab.found(&OWN_BUCKLING, setup.height / buckles(modulus));
        lab.found(&DRAG, linear / quadratic);
        // A cantilever of wood, as high and thick as the stem, under the drag of 10 m/s along its length.
        let load = quadratic / l;
        let bends = load * fourth(setup.height) / (8.0 * WOOD * std::f64::consts::PI * fourth(r) / 4.0);
        let mut row = |quantity: &str, unit: &str, value: f64| {
            table.row([set.name().into(), quantity.into(), unit.into(), value.into()]);
        };
        row("implied Young's modulus of the stem", "Pa", modulus);
        row("height at which wood buckles under itself", "m", buckles(WOOD));
        row("height at which the implied stem does", "m", buckles(modulus));
        row("wind force on the lowest link at 10 m/s, Eq. (3)", "N", linear);
        row("quadratic drag on it", "N", quadratic);
        row("tip of a wooden cantilever in that drag, without branches", "m", bends);
        for (name, drag) in [("linear", Drag::AsPrinted), ("quadratic", Drag::Quadratic)] {
            let readings = Readings { drag, ..set.readings() };
            for wind in [5.0, 10.0] {
                let mut sway = setup.sway_read(readings, given, wind)?;
                blow(&mut sway, setup.steps(lab.pick(3.0, 0.1)))?;
                row(&format!("tip after 3 s at {wind} m/s, {name} drag"), "m", sway.tree().bend().tip.norm());
            }
        }
    }
    lab.keep("numbers", "What the numbers amount to as wood and as wind", table)
}

fn fourth(x: f64) -> f64 {
    x * x * x * x
}
