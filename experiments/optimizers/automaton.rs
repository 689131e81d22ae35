//! The clouds of the automaton: probabilities from a curve of cover.

use snowglobe::lab::{Axis, Draw, Error, Experiment, Lab, Mutant, Plot, Result, Series, Table};
use snowglobe::optimize::contest::{Budget, Problem};
use snowglobe::problems::Suite;
use snowglobe::problems::automaton;
use snowglobe::rng::Seed;

use super::claims::{ALL_THREE, CURVE, VAPOUR};
use super::{narrow, plots, tables};

pub const AUTOMATON: Experiment = Experiment {
    id: "automaton",
    title: "Which optimiser makes a sky cloud over as asked",
    source: "Dobashi §2.3",
    says: "Probabilities of vapour, activation and extinction steer the clouds, and must be set by hand. Could they be had from a \
           curve that says how much of the sky is to be covered, and when? Here the curve is the model's own, of a sky that the \
           solvers do not see.",
    claims: &[&CURVE, &VAPOUR, &ALL_THREE],
    run,
    mutant: Mutant {
        changes: "budget for each dimension and one more",
        to: 1.0,
        why: "with four skies three numbers cannot be found",
        turns_red: &[CURVE.id],
    },
};

const SEEDS: u64 = 3;

/// The suite.
pub fn problems() -> Suite {
    automaton::boxed(automaton::suite())
}

fn run(lab: &mut Lab) -> Result<()> {
    let each = lab.assume(
        "budget for each dimension and one more",
        20.0,
        "evaluations: eighty of the three probabilities, for time",
    );
    lab.assume_that(
        "hidden probabilities",
        "drawn with the seed from the middle half of the box, in logarithms",
        "the paper gives none",
    );
    let played = narrow::run(lab, problems(), SEEDS, Budget::PerDimension(each as u64))?;
    if !lab.is_narrowed() {
        let mut table = Table::new([
            "problem",
            "seed",
            "found_by",
            "error",
            "p_hum",
            "p_hum_hidden",
            "p_act",
            "p_act_hidden",
            "p_ext",
            "p_ext_hidden",
        ]);
        let mut curves = Vec::new();
        for problem in automaton::suite() {
            let calm = problem.name() == "cover-calm";
            let (mut error, mut off, mut shares) = (0.0_f64, 0.0_f64, Vec::new());
            for seed in &played.seeds {
                let Some((solver, cost, x)) = tables::best(&played.trials, &problem.name(), *seed) else {
                    (error, off) = (f64::INFINITY, f64::INFINITY);
                    continue;
                };
                let truth = problem.truth(Seed(*seed));
                error = error.max(libm::sqrt(cost));
                off = off.max((x[0] - truth[0]).abs());
                let domain = problem.domain();
                let share = |x: &[f64], k: usize| (x[k] - domain[k].0) / (domain[k].1 - domain[k].0);
                shares.extend((0..3).map(|k| (share(&truth, k), share(&x, k))));
                let [found, hidden] = [&x, &truth].map(|x| [0, 1, 2].map(|k| libm::exp10(x[k])));
                table.row([
                    problem.name().into(),
                    (*seed).into(),
                    solver.into(),
                    libm::sqrt(cost).into(),
                    found[0].into(),
                    hidden[0].into(),
                    found[1].into(),
                    hidden[1].into(),
                    found[2].into(),
                    hidden[2].into(),
                ]);
                if calm {
                    let broken =
                        |cause: snowglobe::automaton_cloud::Outside| Error::broken(cause.to_string());
                    let wanted = problem.wanted(Seed(*seed)).map_err(broken)?;
                    let found =
                        problem.cover(&x, automaton::CoverProblem::own(Seed(*seed))).map_err(broken)?;
                    for (what, draw, curve) in
                        [("asked", Draw::Printed, wanted), ("found", Draw::Line, found)]
                    {
                        let points =
                            curve.iter().enumerate().map(|(t, cover)| (t as f64 + 1.0, 100.0 * cover));
                        curves.push(Series::new(
                            format!("{what}, seed {seed}"),
                            draw,
                            points.collect::<Vec<_>>(),
                        ));
                    }
                }
            }
            if calm {
                lab.found(&CURVE, error);
                lab.found(&VAPOUR, off);
                lab.found(&ALL_THREE, slope(&shares));
            }
        }
        lab.keep(
            "found",
            "The best probabilities that any solver found, beside those the curve was made with",
            table,
        )?;
        lab.keep(
            "curves",
            "Cover asked for, and that of the best sky found, 64 x 64 x 24 cells",
            Plot {
                title: "A sky clouds over as asked".to_owned(),
                x: Axis::of("step"),
                y: Axis::of("cells with cloud (%)"),
                series: curves,
                bands: Vec::new(),
            },
        )?;
    }
    tables::keep(lab, AUTOMATON.id, &played, &[])?;
    plots::keep(lab, &played, "relative error", 0.5)
}

/// Of least squares.
fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let count = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
    let (xx, xy) = points.iter().fold((0.0, 0.0), |(xx, xy), point| {
        (xx + (point.0 - x) * (point.0 - x), xy + (point.0 - x) * (point.1 - y))
    });
    (xx > 0.0).then(|| xy / xx)
}
