//! The control: problems whose answers are known beforehand.

use snowglobe::lab::{Experiment, Lab, Mutant, Result};
use snowglobe::optimize::contest::{Budget, Contest, Status, field};
use snowglobe::problems::{self, Suite};
use snowglobe::rng::Seed;

use super::claims::{BISECTION, MINIMA, RANDOM_SEARCH, SECANT};
use super::{narrow, plots, tables};

pub const CONTROL: Experiment = Experiment {
    id: "control",
    title: "Control: functions whose minimum is known",
    source: "argmin_testfunctions",
    says: "Before the solvers are believed on frost, they are tried on functions with a known minimum, and those whose \
           runtime arithmetic predicts are held to it.",
    claims: &[&MINIMA, &BISECTION, &SECANT, &RANDOM_SEARCH],
    run,
    mutant: Mutant {
        changes: "budget for each dimension and one more",
        to: 1.0,
        why: "with two evaluations in one dimension nothing can be reached",
        turns_red: &["optimizers/control/bisection", "optimizers/control/secant"],
    },
};

const SEEDS: u64 = 5;
const DRAWS: u64 = 2000;

/// The suite.
pub fn problems() -> Suite {
    problems::control::boxed(problems::control::suite())
}

fn run(lab: &mut Lab) -> Result<()> {
    let each = lab.assume(
        "budget for each dimension and one more",
        100.0,
        "evaluations; enough for most solvers to show how they end",
    );
    let played = narrow::run(lab, problems(), SEEDS, Budget::PerDimension(each as u64))?;
    judge(lab, &played)?;
    tables::keep(lab, CONTROL.id, &played, &[])?;
    plots::keep(lab, &played, "f", 1.0)
}

fn judge(lab: &mut Lab, played: &narrow::Match) -> Result<()> {
    let at_minimum = problems::control::suite().into_iter().map(|control| {
        use snowglobe::optimize::contest::Problem;
        let minimum = (control.minimum)(control.domain().len());
        control.measure(&minimum, Seed(1)).map_or(f64::INFINITY, |measure| measure.cost)
    });
    lab.found(&MINIMA, at_minimum.fold(0.0, f64::max));

    // Evaluations of a solver on the line with each seed, to each target; none if one is not met.
    let on_the_line = |solver: &str| -> Vec<Option<Vec<u64>>> {
        let trials = played.trials.iter().filter(|t| t.solver == solver && t.problem == "line-1");
        trials
            .map(|trial| {
                let arrivals = trial.targets.iter().map(|target| trial.runtime(*target));
                arrivals.map(|a| (a.status == Status::Reached).then_some(a.evaluations)).collect()
            })
            .collect()
    };
    let bisection = on_the_line("bisection");
    lab.found(
        &BISECTION,
        bisection.first().cloned().flatten().map(|counts| counts.iter().sum::<u64>() as f64),
    );
    let secant: Option<Vec<u64>> =
        on_the_line("secant").into_iter().map(|counts| counts.and_then(|c| c.last().copied())).collect();
    lab.found(&SECANT, secant.and_then(|counts| counts.into_iter().max()).map(|most| most as f64));

    let line = problems::control::suite().into_iter().filter(|control| control.name == "line").collect();
    let random = field().into_iter().filter(|entrant| entrant.name == "random-search").collect();
    let seeds = lab.pick(DRAWS, 4);
    let draws = Contest::new(problems::control::boxed(line), random).seeds(seeds).budget(400).run();
    let times =
        draws.iter().filter_map(|trial| Some(trial.runtime(*trial.targets.get(1)?).evaluations as f64));
    lab.found(&RANDOM_SEARCH, times.sum::<f64>() / draws.len().max(1) as f64);
    Ok(())
}
