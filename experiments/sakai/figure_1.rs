//! Figure 1: the tree that the L-system draws after two rewrites.

use snowglobe::lab::{Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};
use snowglobe::lsystem::{LSystem, Structure, Turtle};
use snowglobe::reading::Reading;
use snowglobe::tree::{Frame, Parameters, ReadingSet, Readings, Skeleton, Tree};

use super::setup::broken;

pub const FIGURE_1: Experiment = Experiment {
    id: "figure-1",
    title: "Figure 1: the tree of the L-system",
    source: "§2.2, Fig. 1",
    says: "From F by F -> F[+F]F[-F][F], 20 degrees, rewritten twice.",
    claims: &[&LINKS, &TIPS, &HEIGHT, &COINCIDENT],
    run,
    mutant: Mutant {
        changes: "rewrites",
        to: 3.0,
        why: "one rewrite more makes five times the links",
        turns_red: &["sakai/figure-1/links", "sakai/figure-1/tips", "sakai/figure-1/height"],
    },
};

const fn exactly(value: f64) -> Expect {
    Expect::Near { value, within: 0.0 }
}

static LINKS: Claim = Claim {
    id: "sakai/figure-1/links",
    source: "§2.2",
    says: "each rewrite makes five segments of one",
    expect: exactly(25.0),
    statistic: Statistic::Each,
    reason: "5 x 5, counted in the rule",
    known: &[],
};
static TIPS: Claim = Claim {
    id: "sakai/figure-1/tips",
    source: "§2.2",
    says: "branches end in tips",
    expect: exactly(15.0),
    statistic: Statistic::Each,
    reason: "three of the five segments of a rule end freely, and only in the last rewrite: 3 x 5",
    known: &[],
};
static HEIGHT: Claim = Claim {
    id: "sakai/figure-1/height",
    source: "§2.2, Fig. 1",
    says: "the stem rises by all segments outside of brackets, and the last one within",
    expect: exactly(7.0),
    statistic: Statistic::Each,
    reason: "h' = 2 h + 1 segments from h = 1: the last [F] of the rule is in brackets, so 7 and not 9",
    known: &[],
};
static COINCIDENT: Claim = Claim {
    id: "sakai/figure-1/coincident",
    source: "§2.2, Fig. 1",
    says: "every segment is one that can be seen",
    expect: exactly(0.0),
    statistic: Statistic::Each,
    reason: "a drawing of 25 segments shows 25, unless some lie on others",
    known: &[snowglobe::lab::Known {
        reading: "",
        evidence: "the third child of a rule goes straight on, where the next F begins, and so does a [-F] beside it: \
                   3 of the 25 links lie on another (counts.csv)",
    }],
};

fn run(lab: &mut Lab) -> Result<()> {
    let angle = lab.printed("angle", 20.0, "§2.2");
    let rewrites = lab.printed("rewrites", 2.0, "§2.2");
    let draw = |steps: u32| -> Result<Structure> {
        let (draws, moves) = ("F".to_owned(), String::new());
        let turtle = Turtle { angle, step: 1.0, width: 1.0, thinner: 1.0, draws, moves };
        let system = LSystem::simple("F", 'F', "F[+F]F[-F][F]");
        let word = system.and_then(|system| system.derive(steps, lab.seed()));
        word.and_then(|word| turtle.draw(&word)).map_err(|cause| Error::broken(cause.to_string()))
    };
    let mut table =
        Table::new(["rewrites", "links", "tips", "height_in_segments", "coincident_links", "merged_links"]);
    for steps in 1..=lab.pick(6, 3) {
        let tree = draw(steps)?;
        table.row([
            steps.into(),
            tree.links().into(),
            tree.tips().into(),
            tree.longest_chain().into(),
            tree.coincident().into(),
            tree.merged().links().into(),
        ]);
    }
    let tree = draw(rewrites as u32)?;
    for set in lab.readings::<ReadingSet>().into_iter().filter(|set| *set == ReadingSet::ALL[0]) {
        lab.reading(set);
        lab.found(&LINKS, tree.links() as f64);
        lab.found(&TIPS, tree.tips() as f64);
        lab.found(&HEIGHT, tree.height());
        lab.found(&COINCIDENT, tree.coincident() as f64);
    }
    lab.keep("counts", "What each rewrite makes", table)?;
    let skeleton = Skeleton::new(&tree, 6.67, [0.05, 0.02]).map_err(broken)?;
    let still = Tree::new(skeleton, Parameters::PRINTED, Readings::PAPER).map_err(broken)?;
    lab.keep("tree", "Fig. 1 re-run, thick as §6 says", Frame::still(&still, "").svg(420))
}
