//! The cloud in three dimensions: its parameters from its picture.

use snowglobe::lab::{Axis, Draw, Experiment, Lab, Mutant, Plot, Result, Series, Table};
use snowglobe::optimize::contest::{Budget, Problem};
use snowglobe::problems::Suite;
use snowglobe::problems::clouds::{self, PictureProblem, Throw};
use snowglobe::rng::Seed;

use super::claims::{PICTURE, STATISTICS, TOLD_APART};
use super::{narrow, plots, tables};

pub const CLOUDS: Experiment = Experiment {
    id: "clouds",
    title: "Which optimiser finds a cloud's parameters in its picture",
    source: "Miyata §4",
    says: "Of twelve pictures of clouds only two are printed with a number. Could D, the gain and the cut be had from a picture? \
           Here the picture is the model's own, with parameters that the solvers are not told.",
    claims: &[&PICTURE, &STATISTICS, &TOLD_APART],
    run,
    mutant: Mutant {
        changes: "budget for each dimension and one more",
        to: 1.0,
        why: "with four pictures three numbers cannot be found",
        turns_red: &[PICTURE.id],
    },
};

const SEEDS: u64 = 2;

/// The suite.
pub fn problems() -> Suite {
    clouds::boxed(clouds::suite())
}

fn run(lab: &mut Lab) -> Result<()> {
    let each = lab.assume(
        "budget for each dimension and one more",
        20.0,
        "evaluations: eighty of the three parameters, for time",
    );
    lab.assume_that(
        "statistics",
        "mean, standard deviation and differences at 1, 2, 4 and 8 pixels",
        "what a picture tells of D, gain and cut without its contours being traced",
    );
    lab.assume_that(
        "hidden parameters",
        "drawn with the seed from the middle half of the box",
        "the parameters of the paper's pictures are not given",
    );
    let played = narrow::run(lab, problems(), SEEDS, Budget::PerDimension(each as u64))?;
    if !lab.is_narrowed() {
        let mut table = Table::new([
            "problem",
            "seed",
            "found_by",
            "error",
            "d",
            "d_hidden",
            "gain",
            "gain_hidden",
            "cut",
            "cut_hidden",
        ]);
        let mut series = vec![Series::new("as hidden", Draw::Ghost, vec![(2.0, 2.0), (3.0, 3.0)])];
        for (throw, claim) in [(Throw::Same, &PICTURE), (Throw::Another, &STATISTICS)] {
            let problem = PictureProblem::new(throw);
            let (mut worst, mut points) = (0.0_f64, Vec::new());
            for seed in &played.seeds {
                let Some((solver, cost, x)) = tables::best(&played.trials, &problem.name(), *seed) else {
                    worst = f64::INFINITY;
                    continue;
                };
                let truth = problem.truth(Seed(*seed));
                worst = worst.max((x[0] - truth[0]).abs());
                points.push((truth[0], x[0]));
                table.row([
                    problem.name().into(),
                    (*seed).into(),
                    solver.into(),
                    libm::sqrt(cost).into(),
                    x[0].into(),
                    truth[0].into(),
                    x[1].into(),
                    truth[1].into(),
                    x[2].into(),
                    truth[2].into(),
                ]);
            }
            lab.found(claim, worst);
            if throw == Throw::Another {
                lab.found(&TOLD_APART, told_apart(&points));
            }
            series.push(Series::new(problem.name(), Draw::Dots, points));
        }
        lab.keep(
            "found",
            "The best parameters that any solver found, beside those the picture was made with",
            table,
        )?;
        lab.keep(
            "dimension",
            "D of the picture, hidden and found",
            Plot {
                title: "D: hidden and found".to_owned(),
                x: Axis::within("D hidden", 2.0, 3.0),
                y: Axis::within("D found", 2.0, 3.0),
                series,
                bands: Vec::new(),
            },
        )?;
    }
    tables::keep(lab, CLOUDS.id, &played, &[])?;
    plots::keep(lab, &played, "relative error", 0.5)
}

/// The difference of D found over the difference hidden, of the pictures of greatest and least D; none of fewer than two.
fn told_apart(points: &[(f64, f64)]) -> Option<f64> {
    let least = points.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
    let greatest = points.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    (greatest.0 > least.0).then(|| (greatest.1 - least.1) / (greatest.0 - least.0))
}
