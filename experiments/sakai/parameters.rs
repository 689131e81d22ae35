//! One number at a time: what each parameter does to the sway (§6).

use snowglobe::lab::{Claim, Expect, Experiment, Known, Lab, Mutant, Result, Statistic, Table};
use snowglobe::reading::Reading;
use snowglobe::tree::ReadingSet;

use super::setup::{Setup, beyond, blow};

pub const PARAMETERS: Experiment = Experiment {
    id: "parameters",
    title: "Each parameter halved and doubled",
    source: "§6",
    says: "Changing the parameters changes the sway.",
    claims: &[&EACH, &STIFFER, &WINDIER],
    run,
    mutant: Mutant {
        changes: "wind coefficient",
        to: 0.0,
        why: "a wind that does not push leaves nothing to change",
        turns_red: &["sakai/parameters/each", "sakai/parameters/stiffer", "sakai/parameters/windier"],
    },
};

const FALLEN: Known = Known {
    reading: "set=literal",
    evidence: "after 3 s the tree lies on the ground, and where depends on chance more than on the number (table.csv)",
};

static EACH: Claim = Claim {
    id: "sakai/parameters/each",
    source: "§6",
    says: "every parameter changes how the tree sways",
    expect: Expect::AtLeast(0.05),
    statistic: Statistic::Each,
    reason: "the least, over the parameters, of the greater relative change of the tip's displacement when it is halved \
             or doubled: 5 % is about what one sees in two pictures side by side",
    known: &[
        Known {
            reading: "set=paper",
            evidence: "what the branches take from the wind hardly matters: its coefficient halved or doubled moves the \
                       tip by less than 1 % (table.csv)",
        },
        Known {
            reading: "set=physical",
            evidence: "the exchange that conserves momentum has no use for the branch-on-wind coefficient (table.csv)",
        },
    ],
};
static STIFFER: Claim = Claim {
    id: "sakai/parameters/stiffer",
    source: "§3.2, Eq. (5)",
    says: "a tree that is pulled back more strongly bends less",
    expect: Expect::Between(0.2, 0.95),
    statistic: Statistic::Each,
    reason: "displacement of the tip at twice the restoring coefficient over that at the printed one: half, if the tree \
             is at its balance, and more before",
    known: &[FALLEN],
};
static WINDIER: Claim = Claim {
    id: "sakai/parameters/windier",
    source: "§3.2, Eq. (3)",
    says: "a tree that the wind takes hold of more strongly bends more",
    expect: Expect::Between(1.25, 2.1),
    statistic: Statistic::Each,
    reason: "displacement of the tip at twice the wind coefficient over that at the printed one: the force is twice as \
             large, and the bend not more than that",
    known: &[FALLEN],
};

/// A parameter and how to multiply it.
type Turn = (&'static str, fn(&mut Setup, f64));

const TURNS: [Turn; 9] = [
    ("restoring coefficient", |s, f| {
        s.parameters.restoring *= f;
        s.physical *= f;
    }),
    ("wind coefficient", |s, f| s.parameters.wind *= f),
    ("branch-on-wind coefficient", |s, f| s.parameters.branch_on_wind *= f),
    // Half of what is lost in a step, or twice that.
    ("loss of velocity, 1 - damping", |s, f| s.parameters.damping = 1.0 - f * (1.0 - s.parameters.damping)),
    // Twice the reaction would be no tree: the change is a tenth.
    ("reaction, by 1.1", |s, f| s.parameters.reaction *= if f > 1.0 { 1.1 } else { 1.0 / 1.1 }),
    ("density", |s, f| s.parameters.density *= f),
    ("radius", |s, f| s.radii = s.radii.map(|r| r * f)),
    ("height", |s, f| {
        // A tree twice as high needs more air around it.
        s.height *= if f > 1.0 { 1.2 } else { 1.0 / 1.2 };
    }),
    ("wind", |_, _| {}),
];

const WIND: f64 = 5.0;
const SECONDS: f64 = 3.0;

fn run(lab: &mut Lab) -> Result<()> {
    let setup = Setup::new(lab);
    let seconds = lab.pick(SECONDS, 0.1);
    let mut table = Table::new([
        "set",
        "parameter",
        "factor",
        "tip_m",
        "mean_bend_deg",
        "centroid_m",
        "tip_over_printed",
        "note",
    ]);
    for set in lab.readings::<ReadingSet>() {
        let runs: Vec<(usize, f64)> = std::iter::once((TURNS.len(), 1.0))
            .chain((0..TURNS.len()).flat_map(|k| [(k, 0.5), (k, 2.0)]))
            .collect();
        let bends = lab.each(&runs, |(which, factor)| {
            let mut turned = setup.clone();
            let mut wind = WIND;
            if let Some((name, turn)) = TURNS.get(*which) {
                turn(&mut turned, *factor);
                if *name == "wind" {
                    wind *= factor;
                }
            }
            bend(&turned, set, wind, seconds)
        });
        lab.count("steps", 2 * runs.len() as u64 * setup.steps(seconds));
        let printed = bends[0].as_ref().ok().copied();
        let over = |bend: &std::result::Result<[f64; 3], String>| {
            let ratio = bend.as_ref().ok()?[0] / printed?[0];
            ratio.is_finite().then_some(ratio)
        };
        lab.reading(set);
        // The wind is no parameter of §6; the rest is.
        let changes = bends[1..]
            .chunks(2)
            .take(TURNS.len() - 1)
            .map(|pair| pair.iter().filter_map(over).map(|ratio| (ratio - 1.0).abs()).reduce(f64::max));
        lab.found(
            &EACH,
            changes.collect::<Option<Vec<f64>>>().and_then(|all| all.into_iter().reduce(f64::min)),
        );
        let of = |name: &str| {
            let which = TURNS.iter().position(|(turn, _)| *turn == name)?;
            over(&bends[2 + 2 * which])
        };
        lab.found(&STIFFER, of("restoring coefficient"));
        lab.found(&WINDIER, of("wind coefficient"));
        for ((which, factor), bend) in runs.iter().zip(&bends) {
            let name = TURNS.get(*which).map_or("as printed", |(name, _)| *name);
            let (numbers, note) = match bend {
                Ok(numbers) => (numbers.map(|x| x.to_string()), String::new()),
                Err(why) => (Default::default(), why.clone()),
            };
            let [tip, angle, centroid] = numbers;
            table.row([
                set.name().into(),
                name.into(),
                (*factor).into(),
                tip.into(),
                angle.into(),
                centroid.into(),
                snowglobe::lab::maybe(over(bend)),
                note.into(),
            ]);
        }
    }
    readings(lab, &setup, seconds)?;
    lab.keep(
        "table",
        "The tree after 3 s at 5 m/s, less the same without wind, with one parameter changed at a time",
        table,
    )
}

/// One disputed place of a set at a time, read in each other way.
fn readings(lab: &mut Lab, setup: &Setup, seconds: f64) -> Result<()> {
    let mut table = Table::new(["set", "changed", "tip_x", "tip_y", "mean_bend_deg", "still_tip_x", "note"]);
    if !lab.keeps() {
        return Ok(());
    }
    for set in lab.readings::<ReadingSet>() {
        let (own, given) = (set.readings(), setup.given(set));
        let all: Vec<_> = std::iter::once((String::new(), own)).chain(own.neighbours()).collect();
        let ran = lab.each(&all, |(_, readings)| -> Result<_> {
            let run = |wind: f64| -> Result<_> {
                let mut sway = setup.sway_read(*readings, given, wind)?;
                blow(&mut sway, setup.steps(seconds))?;
                Ok(sway.tree().bend())
            };
            Ok((run(WIND)?, run(0.0)?))
        });
        for ((name, _), ran) in all.iter().zip(&ran) {
            let (numbers, note) = match ran {
                Ok((bend, still)) => {
                    let numbers = [bend.tip.x, bend.tip.y, bend.mean_angle, still.tip.x];
                    (numbers.map(|x| x.to_string()), String::new())
                }
                Err(why) => (Default::default(), why.to_string()),
            };
            let [x, y, angle, still] = numbers;
            table.row([
                set.name().into(),
                name.into(),
                x.into(),
                y.into(),
                angle.into(),
                still.into(),
                note.into(),
            ]);
        }
    }
    lab.keep(
        "readings",
        "After 3 s at 5 m/s and without wind, one disputed place read otherwise at a time",
        table,
    )
}

/// How far the tree goes; or why it does not.
fn bend(setup: &Setup, set: ReadingSet, wind: f64, seconds: f64) -> std::result::Result<[f64; 3], String> {
    let run = |wind: f64| -> Result<_> {
        let mut sway = setup.sway(set, wind)?;
        blow(&mut sway, setup.steps(seconds))?;
        Ok(sway.tree().bend())
    };
    let bends = run(wind).and_then(|bend| Ok(beyond(&bend, &run(0.0)?)));
    bends.map_err(|why| why.to_string())
}
