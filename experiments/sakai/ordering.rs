//! The bend against the wind: "the tree bends the more, the stronger the wind is" (§6).

use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Panels, Plot, Result, Series, Statistic, Table,
};
use snowglobe::reading::Reading;
use snowglobe::tree::{Bend, ReadingSet};

use super::setup::{Setup, beyond};

pub const ORDERING: Experiment = Experiment {
    id: "ordering",
    title: "The bend in winds of 1 to 20 m/s",
    source: "§6",
    says: "The tree bends the more, the stronger the wind is.",
    claims: &[&TIP, &ANGLE, &CENTROID, &AT_REST],
    run,
    mutant: Mutant {
        changes: "wind coefficient",
        to: 0.0,
        why: "a wind that does not push does not bend",
        turns_red: &["sakai/ordering/tip", "sakai/ordering/mean-bend", "sakai/ordering/centroid"],
    },
};

const fn ordered(id: &'static str, says: &'static str, known: &'static [Known]) -> Claim {
    Claim {
        id,
        source: "§6, Fig. 5 (d) to (f)",
        says,
        expect: Expect::Between(1.25, 2.1),
        statistic: Statistic::Each,
        reason: "after 3 s, less the same without wind: the smaller of the ratios of 7 to 5 and of 10 to 7 m/s. Speeds \
                 are 1.4 times each other, linear drag with them and quadratic drag twice: a bend that follows is \
                 between, and 1.25 is what an eye sees",
        known,
    }
}

const FALLEN: &[Known] = &[Known {
    reading: "set=literal",
    evidence: "the tree has fallen before the wind can bend it (bend.csv)",
}];

static TIP: Claim = ordered("sakai/ordering/tip", "the tip moves further in a stronger wind", FALLEN);
static ANGLE: Claim =
    ordered("sakai/ordering/mean-bend", "the links turn further in a stronger wind", FALLEN);
static CENTROID: Claim =
    ordered("sakai/ordering/centroid", "the centre of mass moves further in a stronger wind", FALLEN);
static AT_REST: Claim = Claim {
    id: "sakai/ordering/at-rest",
    source: "§3.4, §6",
    says: "what bends the tree is the wind: without, it stays in its initial pose",
    expect: Expect::AtMost(1e-9),
    statistic: Statistic::Each,
    reason: "displacement of the tip in m after 3 s without wind: no force acts, so only rounding is left",
    known: &[
        Known {
            reading: "set=physical",
            evidence: "gravity acts, and the initial pose is not its balance: the tree leans over by itself (bend.csv)",
        },
        Known { reading: "set=literal", evidence: "gravity fells the tree without any wind (bend.csv)" },
    ],
};

const MOST: u64 = 20;
const SECONDS: f64 = 3.0;

fn run(lab: &mut Lab) -> Result<()> {
    let setup = Setup::new(lab);
    let seconds = lab.pick(SECONDS, 0.1);
    let mut table = Table::new(["set", "wind_m_s", "tip_m", "mean_bend_deg", "centroid_m", "tip_x", "tip_y"]);
    let mut series: [Vec<Series>; 3] = Default::default();
    for set in lab.readings::<ReadingSet>() {
        // A rehearsal looks at what the claims need.
        let winds: Vec<u64> = (0..=MOST).filter(|wind| lab.keeps() || [0, 5, 7, 10].contains(wind)).collect();
        let bends = lab.each(&winds, |wind| setup.bend(set, *wind as f64, seconds));
        let bends = bends.into_iter().collect::<Result<Vec<Bend>>>()?;
        lab.count("steps", winds.len() as u64 * setup.steps(seconds));
        let still = bends[0];
        let of = |wind: u64| {
            winds.iter().position(|w| *w == wind).map(|k| beyond(&bends[k], &still)).unwrap_or_default()
        };
        lab.reading(set);
        for (k, claim) in [&TIP, &ANGLE, &CENTROID].into_iter().enumerate() {
            let ratio = |a: u64, b: u64| of(b)[k] / of(a)[k];
            lab.found(claim, Some(ratio(5, 7).min(ratio(7, 10))).filter(|ratio| ratio.is_finite()));
        }
        lab.found(&AT_REST, still.tip.norm());
        for (wind, bend) in winds.iter().zip(&bends) {
            let [tip, angle, centroid] = beyond(bend, &still);
            table.row([
                set.name().into(),
                (*wind).into(),
                tip.into(),
                angle.into(),
                centroid.into(),
                bend.tip.x.into(),
                bend.tip.y.into(),
            ]);
        }
        for (k, series) in series.iter_mut().enumerate() {
            let points = winds.iter().zip(&bends).map(|(wind, bend)| (*wind as f64, beyond(bend, &still)[k]));
            series.push(Series::new(set.name(), Draw::Joined, points));
        }
    }
    lab.keep(
        "bend",
        "After 3 s in winds of 0 to 20 m/s, less the same without wind; tip_x and tip_y are not",
        table,
    )?;
    let titles = [
        ("Tip", "displacement (m)"),
        ("Links", "mean bend (degrees)"),
        ("Centre of mass", "displacement (m)"),
    ];
    let plots = series.into_iter().zip(titles).map(|(series, (title, label))| Plot {
        title: title.to_owned(),
        x: Axis::within("wind (m/s)", 0.0, 20.5),
        y: Axis::of(label),
        series,
        bands: Vec::new(),
    });
    lab.keep(
        "bend-by-wind",
        "How far the tree has gone after 3 s, less the same without wind",
        Panels {
            title: "After 3 s, less the same without wind".to_owned(),
            columns: 3,
            plots: plots.collect(),
        },
    )
}
