//! The tree in two dimensions: its coefficients from its motion.

use snowglobe::lab::{Axis, Draw, Experiment, Lab, Mutant, Plot, Result, Series, Table};
use snowglobe::optimize::contest::{Budget, Problem};
use snowglobe::problems::Suite;
use snowglobe::problems::tree::{self, CoefficientProblem};
use snowglobe::rng::Seed;

use super::claims::COEFFICIENTS;
use super::{narrow, plots, tables};

pub const TREE: Experiment = Experiment {
    id: "tree",
    title: "Which optimiser finds a tree's coefficients in its motion",
    source: "Sakai §6",
    says: "The restoring and the wind coefficient are given without a word on where they come from. Could they be had from \
           a film of a tree? Here the film is the model's own, with coefficients that the solvers are not told.",
    claims: &[&COEFFICIENTS],
    run,
    mutant: Mutant {
        changes: "budget for each dimension and one more",
        to: 1.0,
        why: "with three films two numbers cannot be found",
        turns_red: &[COEFFICIENTS.id],
    },
};

const SEEDS: u64 = 2;

/// The suite.
pub fn problems() -> Suite {
    tree::boxed(tree::suite())
}

fn run(lab: &mut Lab) -> Result<()> {
    let each = lab.assume(
        "budget for each dimension and one more",
        20.0,
        "evaluations: sixty of the two coefficients, for time",
    );
    lab.assume_that(
        "film",
        "24 frames of all nodes in a gust of 5, 10 and 2 m/s",
        "long enough to bend the tree and let it go",
    );
    lab.assume_that(
        "hidden coefficients",
        "drawn with the seed from the middle half of the box, in logarithms",
        "the paper has no film to fit to",
    );
    let played = narrow::run(lab, problems(), SEEDS, Budget::PerDimension(each as u64))?;
    let suite = tree::suite();
    if !lab.is_narrowed() {
        // The worst trial of the best solver of each problem and seed, in metres.
        let worst = suite.iter().flat_map(|problem| {
            let (played, name) = (&played, problem.name());
            played.seeds.iter().map(move |seed| {
                tables::best(&played.trials, &name, *seed)
                    .map_or(f64::INFINITY, |(_, cost, _)| libm::sqrt(cost))
            })
        });
        lab.found(&COEFFICIENTS, worst.fold(0.0, f64::max));
        keep_found(lab, &suite, &played)?;
    }
    tables::keep(lab, TREE.id, &played, &[])?;
    plots::keep(lab, &played, "m", 0.5)
}

fn keep_found(lab: &mut Lab, suite: &[CoefficientProblem], played: &narrow::Match) -> Result<()> {
    let mut table = Table::new([
        "problem",
        "seed",
        "found_by",
        "rms_m",
        "restoring_n_m2",
        "restoring_hidden_n_m2",
        "wind_kg_m2_s",
        "wind_hidden_kg_m2_s",
    ]);
    let mut series = Vec::new();
    for problem in suite {
        let (mut hidden, mut found) = (Vec::new(), Vec::new());
        for seed in &played.seeds {
            let Some((solver, cost, x)) = tables::best(&played.trials, &problem.name(), *seed) else {
                continue;
            };
            let truth = problem.truth(Seed(*seed));
            table.row([
                problem.name().into(),
                (*seed).into(),
                solver.into(),
                libm::sqrt(cost).into(),
                libm::exp10(x[0]).into(),
                libm::exp10(truth[0]).into(),
                libm::exp10(x[1]).into(),
                libm::exp10(truth[1]).into(),
            ]);
            hidden.push((libm::exp10(truth[0]), libm::exp10(truth[1])));
            found.push((libm::exp10(x[0]), libm::exp10(x[1])));
        }
        series.push(Series::new(format!("{}: hidden", problem.name()), Draw::Printed, hidden));
        series.push(Series::new(format!("{}: found", problem.name()), Draw::Dots, found));
    }
    lab.keep(
        "found",
        "The best coefficients that any solver found, beside those the film was made with",
        table,
    )?;
    let plot = Plot {
        title: "Coefficients: hidden and found".to_owned(),
        x: Axis::log("restoring coefficient (N/m2)", 1e3, 2e6),
        y: Axis::log("wind coefficient (kg/(m2 s))", 1e-2, 5.0),
        series,
        bands: Vec::new(),
    };
    lab.keep("coefficients", "The coefficients each film was made with, and the best found", plot)
}
