//! Eq. (3) to (6) as they stand, and as a tree: which of them can be Fig. 4.

use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Error, Expect, Experiment, Known, Lab, Mutant, Panels, Plot, Result, Series,
    Statistic, Table, average, maybe, smallest_rise,
};
use snowglobe::lsystem::{LSystemError, Structure};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::snow::{
    Brackets, Elongation, Parameters, Third, Vigour, box_dimension, grammar, grown_layer, layer_fill,
};

pub const BRANCHING: Experiment = Experiment {
    id: "branching",
    title: "The rules, word for word",
    source: "§1.1.2, Eq. (3) to (6), (10)",
    says: "A branch branches in three ways with probability p1, and again, so that crystals become intricate.",
    claims: &[&BRANCHES, &ALIKE, &OUTWARDS, &LINEAR, &FILL, &DIMENSION],
    run,
    mutant: Mutant {
        changes: "p1",
        to: 0.0,
        why: "then nothing branches",
        turns_red: &["himeno/branching/branches"],
    },
};

static BRANCHES: Claim = Claim {
    id: "himeno/branching/branches",
    source: "§1.1.2, Fig. 4",
    says: "from a branch smaller ones branch, and from these again",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "joints of a branch after all steps, from which more than one segment begins: a branch on a branch makes two",
    known: &[Known {
        reading: "brackets=as-printed",
        evidence: "`[]` defined as zero or one times makes a choice of +FF, f+FF, f++F and F: a chain that turns",
    }],
};
static ALIKE: Claim = Claim {
    id: "himeno/branching/alike",
    source: "§1.1.3, condition 3",
    says: "branches grow in pairs, one to each side",
    expect: Expect::Near { value: 1.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "turns to one side over turns to the other: as many. Chance then differs from branch to branch, so that words are no more \
             alike than that; crystals take one side's chance for both (himeno/symmetry)",
    known: &[
        Known {
            reading: "brackets=as-printed;third-alternative=as-printed",
            evidence: "a chain turns to one side only",
        },
        Known {
            reading: "brackets=as-printed;third-alternative=mirrored;elongation=linear",
            evidence: "a chain turns to either side by chance",
        },
    ],
};
static OUTWARDS: Claim = Claim {
    id: "himeno/branching/outwards",
    source: "Eq. (4), Fig. 4",
    says: "branches grow outwards",
    expect: Expect::AtLeast(0.0),
    statistic: Statistic::Each,
    reason: "cosine of the largest turn at one place: 60 degrees give one half",
    known: &[Known {
        reading: "third-alternative=as-printed",
        evidence: "f++F turns by 120 degrees: it grows back towards the middle",
    }],
};
static LINEAR: Claim = Claim {
    id: "himeno/branching/linear",
    source: "Eq. (6)",
    says: "a branch gets longer by what the growth speed gives, in each step",
    expect: Expect::Near { value: 1.0, within: 1e-12 },
    statistic: Statistic::Each,
    reason: "length of a branch without side branches after all steps, over steps times the growth of one",
    known: &[Known {
        reading: "elongation=doubling",
        evidence: "Eq. (5), F -> FF, doubles it in each step: it disagrees with Eq. (6)",
    }],
};
static FILL: Claim = Claim {
    id: "himeno/branching/fill",
    source: "§1.1.3, condition 2",
    says: "the higher p1, the fuller a layer",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "share of its hexagon that a layer fills, mean of eight, for p1 of 0, 0.1, ... 1",
    known: &[],
};
static DIMENSION: Claim = Claim {
    id: "himeno/branching/dimension",
    source: "§1.1.3, condition 2",
    says: "the higher p1, the higher the box dimension of a layer",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "mean of eight layers, for p1 of 0, 0.1, 0.3, 1: from arms alone to a layer that fills its fans",
    known: &[],
};

fn run(lab: &mut Lab) -> Result<()> {
    let p1 = lab.assume("p1", 0.5, "not printed; half of the tips branch in a step");
    let steps = lab.pick(5, 3);
    let mut drawings = Vec::new();
    let mut table = Table::new([
        "brackets",
        "third_alternative",
        "elongation",
        "segments",
        "joints",
        "alike",
        "outwards",
        "lengthening",
    ]);
    for brackets in lab.readings::<Brackets>() {
        for third in lab.readings::<Third>() {
            for elongation in lab.readings::<Elongation>() {
                lab.reading(brackets);
                lab.reading(third);
                lab.reading(elongation);
                let shown = Shown::of(brackets, third, elongation, p1, steps, lab.seed())?;
                lab.found(&BRANCHES, shown.joints as f64);
                lab.found(&ALIKE, shown.alike);
                lab.found(&OUTWARDS, shown.outwards);
                lab.found(&LINEAR, shown.lengthening);
                table.row([
                    brackets.name().into(),
                    third.name().into(),
                    elongation.name().into(),
                    shown.drawn.links().into(),
                    shown.joints.into(),
                    maybe(shown.alike),
                    maybe(shown.outwards),
                    shown.lengthening.into(),
                ]);
                let names = [brackets.name(), third.name(), elongation.name()];
                drawings.push((names, shown.drawn));
            }
        }
    }
    lab.default_reading();
    lab.keep("rules", "What the rules make after all steps, in every reading", table)?;
    lab.keep("branches", "One branch in every reading, drawn six times", Artifact::Svg(sheet(&drawings)))?;
    rising(lab)
}

/// One branch, and what is to be said of it.
struct Shown {
    drawn: Structure,
    joints: usize,
    alike: Option<f64>,
    outwards: Option<f64>,
    lengthening: f64,
}

impl Shown {
    fn of(
        brackets: Brackets,
        third: Third,
        elongation: Elongation,
        p1: f64,
        steps: u32,
        seed: Seed,
    ) -> Result<Self> {
        let word = |p1: f64| -> Result<String> {
            let system = grammar::system(brackets, third, elongation, p1).map_err(broken)?;
            system.derive(steps, seed).map_err(broken)
        };
        let (branched, bare) = (word(p1)?, word(0.0)?);
        let drawn = grammar::branch(&branched).map_err(broken)?;
        let [left, right] = ['+', '-'].map(|turn| branched.matches(turn).count());
        let of_both = left.min(right) as f64 / left.max(right) as f64;
        // The largest turn at one place: the longest row of turns to one side.
        let turns =
            branched.split(|c| c != '+').chain(branched.split(|c| c != '-')).map(str::len).max().unwrap_or(0);
        let turned = (grammar::TURN * turns as f64).to_radians();
        Ok(Self {
            joints: grammar::joints(&drawn),
            alike: (left + right > 0).then_some(of_both),
            outwards: (turns > 0).then(|| libm::cos(turned)),
            lengthening: bare.matches('F').count() as f64 / f64::from(steps),
            drawn,
        })
    }
}

fn broken(cause: LSystemError) -> Error {
    Error::broken(cause.to_string())
}

/// Fill and dimension of layers by p1.
fn rising(lab: &mut Lab) -> Result<()> {
    let parameters = Parameters::ASSUMED;
    let radius = lab.pick(80, 24);
    let seeds: Vec<u64> = (1..=lab.pick(8, 2)).collect();
    let of = |p1: f64| {
        let vigour = Vigour { branching: p1, form: parameters.dendrite, plate: 0.15 };
        let layers: Vec<_> =
            seeds.iter().map(|seed| grown_layer(Seed(*seed), radius, &vigour, &parameters)).collect();
        let fill = average(&layers.iter().map(|layer| layer_fill(layer, radius)).collect::<Vec<_>>());
        let dimensions: Vec<f64> = layers.iter().filter_map(box_dimension).collect();
        (fill, if dimensions.is_empty() { f64::NAN } else { average(&dimensions) })
    };
    let chances: Vec<f64> = (0..=10).map(|k| f64::from(k) / 10.0).collect();
    let grown = lab.each(&chances, |p1| of(*p1));
    let fills: Vec<f64> = grown.iter().map(|(fill, _)| *fill).collect();
    let dimensions: Vec<f64> = [0, 1, 3, 10].iter().map(|k| grown[*k].1).collect();
    lab.found(&FILL, smallest_rise(&fills));
    lab.found(&DIMENSION, smallest_rise(&dimensions));
    let mut table = Table::new(["p1", "fill", "box_dimension"]);
    for (p1, (fill, dimension)) in chances.iter().zip(&grown) {
        table.row([(*p1).into(), (*fill).into(), (*dimension).into()]);
    }
    lab.keep("p1", "Fill and box dimension of layers by p1, mean of eight", table)?;
    let series = |name: &str, of: &dyn Fn(&(f64, f64)) -> f64| {
        vec![Series::new(name, Draw::Joined, chances.iter().copied().zip(grown.iter().map(of)))]
    };
    let plot = |title: &str, label: &str, range: (f64, f64), series| Plot {
        title: title.to_owned(),
        x: Axis::within("p1", 0.0, 1.0),
        y: Axis::within(label, range.0, range.1),
        series,
        bands: Vec::new(),
    };
    lab.keep(
        "rising",
        "The higher p1, the fuller a layer; a dendrite's slowing and sector, so that even p1 = 1 is no plate",
        Panels {
            title: "What p1 does to a layer".to_owned(),
            columns: 2,
            plots: vec![
                plot("Share of its hexagon", "share of ice", (0.0, 1.0), series("fill", &|g| g.0)),
                plot("Box dimension", "box dimension", (1.0, 2.0), series("dimension", &|g| g.1)),
            ],
        },
    )
}

/// A drawing of each reading: the branch along all six directions.
fn sheet(drawings: &[([&str; 3], Structure)]) -> String {
    use std::fmt::Write;
    const CELL: f64 = 230.0;
    let columns = 4.min(drawings.len().max(1));
    let rows = drawings.len().div_ceil(columns);
    let (width, height) = (CELL * columns as f64, (CELL + 46.0) * rows as f64 + 10.0);
    let mut svg = format!(
        "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" xmlns=\"http://www.w3.org/2000/svg\">\n\
         <title>Eq. (3) to (6) in every reading</title>\
         <style>text{{font-family:system-ui,sans-serif}}@media(prefers-color-scheme:dark){{rect{{fill:#14181d}}text{{fill:#e6e9ed}}path{{stroke:#8ecbff}}}}</style>\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for (number, ([brackets, third, elongation], drawn)) in drawings.iter().enumerate() {
        let (x, y) = (CELL * (number % columns) as f64, (CELL + 46.0) * (number / columns) as f64);
        let reach =
            drawn.nodes.iter().map(|node| libm::hypot(node.place.x, node.place.y)).fold(1e-9, f64::max);
        let scale = 0.46 * CELL / reach;
        let mut path = String::new();
        for node in &drawn.nodes {
            let Some(parent) = node.parent else { continue };
            let [a, b] =
                [drawn.nodes[parent].place, node.place].map(|place| [scale * place.x, -scale * place.y]);
            let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", a[0], a[1], b[0], b[1]);
        }
        for sixth in 0..6 {
            let _ = writeln!(
                svg,
                "<path d=\"{path}\" transform=\"translate({} {}) rotate({})\" fill=\"none\" stroke=\"#0b4f8a\" stroke-width=\"1.4\"/>",
                x + 0.5 * CELL,
                y + 0.5 * CELL,
                60 * sixth
            );
        }
        for (line, words) in
            [format!("brackets {brackets}"), format!("third {third}, {elongation}")].iter().enumerate()
        {
            let _ = writeln!(
                svg,
                "<text x=\"{}\" y=\"{}\" font-size=\"14\" text-anchor=\"middle\">{words}</text>",
                x + 0.5 * CELL,
                y + CELL + 16.0 + 18.0 * line as f64
            );
        }
    }
    svg + "</svg>\n"
}
