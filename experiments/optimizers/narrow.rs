//! A suite, narrowed to what the run asks for, and its trials.

use snowglobe::lab::{Lab, Result};
use snowglobe::optimize::contest::{Budget, Contest, Entrant, Trial, field};
use snowglobe::problems::Suite;

/// Names of the settings by which `snowglobe optimizers` narrows a run.
pub const PROBLEM: &str = "problem";
pub const SOLVER: &str = "solver";
pub const BUDGET: &str = "budget";
pub const SEEDS: &str = "seeds";
pub const RESOLUTION: &str = "resolution";

/// A suite as it is run.
pub struct Match {
    pub contest: Contest,
    pub seeds: Vec<u64>,
    pub trials: Vec<Trial>,
    /// Trials of solvers that have no form for the problem.
    pub inapplicable: Vec<Trial>,
}

/// A number among the settings.
pub fn number(lab: &Lab, name: &str) -> Option<u64> {
    lab.settings(name).first().and_then(|text| text.parse().ok())
}

/// Every solver of the field on every problem of a suite with `seeds` seeds, or what the run is narrowed to.
pub fn run(lab: &mut Lab, problems: Suite, seeds: u64, budget: Budget) -> Result<Match> {
    let asked = |name: &str, of: &str| {
        let names = lab.settings(name);
        names.is_empty() || names.contains(&of)
    };
    // At smoke scale as little as shows that everything runs: not the large problems that come first.
    let (skipped, taken) = lab.pick((0, usize::MAX), (2, 2));
    let problems = problems.into_iter().filter(|p| asked(PROBLEM, &p.name()));
    let problems: Suite = problems.skip(skipped).take(taken).collect();
    let entrants: Vec<Entrant> = field().into_iter().filter(|e| asked(SOLVER, &e.name)).collect();
    let seeds = match number(lab, SEEDS) {
        Some(count) => (0..count).map(|k| lab.seed().0 + k).collect(),
        None => lab.seeds(seeds),
    };
    let budget = match number(lab, BUDGET) {
        Some(evaluations) => Budget::Evaluations(evaluations),
        None => lab.pick(budget, Budget::Evaluations(6)),
    };
    let contest = Contest::new(problems, entrants).with_seeds(seeds.clone()).with_budget(budget);
    let pairings = contest.pairings();
    let trials = lab.each(&pairings, |pairing| contest.play(pairing));
    lab.count("evaluations", trials.iter().map(|trial| trial.log.len() as u64).sum());
    let (trials, inapplicable) = trials.into_iter().partition(Trial::counts);
    Ok(Match { contest, seeds, trials, inapplicable })
}
