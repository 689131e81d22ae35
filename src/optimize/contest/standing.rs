//! What the trials of a contest say of each solver.

use std::collections::{BTreeMap, BTreeSet};

use super::statistics::{
    Runtime, SignedRank, bootstrap_stratified, expected_runtime, holm, wilcoxon_signed_rank,
};
use super::trial::{Status, Trial};
use crate::rng::Moment;

/// A solver at one target, over all problems and seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// The solver.
    pub solver: String,
    /// The target.
    pub target: f64,
    /// Trials.
    pub trials: usize,
    /// Trials that met it.
    pub reached: usize,
    /// Expected runtime: all evaluations over the trials that met the target; none if none did.
    pub expected_runtime: Option<f64>,
    /// Its 95 % interval by bootstrap over the seeds of each problem; the upper end may be infinite.
    pub interval: Option<(f64, f64)>,
}

impl Standing {
    /// The share of trials that met the target.
    pub fn success(&self) -> f64 {
        self.reached as f64 / self.trials.max(1) as f64
    }
}

/// Bootstrap samples of an expected runtime.
const RESAMPLES: u64 = 1000;

/// The standing of every solver at every target, solvers in the order of the trials, targets easiest first.
pub fn standings(trials: &[Trial], moment: &Moment) -> Vec<Standing> {
    let mut standings = Vec::new();
    for solver in solvers(trials) {
        let of_solver: Vec<&Trial> =
            trials.iter().filter(|trial| trial.solver == solver && trial.counts()).collect();
        let targets = of_solver.first().map_or(0, |trial| trial.targets.len());
        for target in 0..targets {
            let mut by_problem: BTreeMap<&str, Vec<Runtime>> = BTreeMap::new();
            for trial in &of_solver {
                by_problem.entry(&trial.problem).or_default().push(runtime(trial, target));
            }
            let groups: Vec<Vec<Runtime>> = by_problem.into_values().collect();
            let all: Vec<Runtime> = groups.iter().flatten().copied().collect();
            standings.push(Standing {
                solver: solver.to_owned(),
                target: of_solver[0].targets[target].value,
                trials: all.len(),
                reached: all.iter().filter(|run| run.reached).count(),
                expected_runtime: expected_runtime(&all),
                interval: bootstrap_stratified(&groups, 0.95, RESAMPLES, moment),
            });
        }
    }
    standings
}

/// The solvers that were asked anything, in the order of the trials.
pub fn solvers(trials: &[Trial]) -> Vec<&str> {
    let mut seen = BTreeSet::new();
    let asked = trials.iter().filter(|trial| trial.counts()).map(|trial| trial.solver.as_str());
    asked.filter(|solver| seen.insert(*solver)).collect()
}

fn runtime(trial: &Trial, target: usize) -> Runtime {
    let arrival = trial.runtime(trial.targets[target]);
    Runtime { evaluations: arrival.evaluations, reached: arrival.status == Status::Reached }
}

/// Two solvers on the same problems with the same seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Paired {
    /// One solver.
    pub first: String,
    /// The other.
    pub second: String,
    /// The signed ranks of the first's runtimes minus the second's; a target that was not met is later than all.
    pub ranks: SignedRank,
    /// The p-value after Holm's correction for all pairs.
    pub adjusted: f64,
}

/// Wilcoxon's test on every pair of solvers, at one target, over the problems and seeds that both tried.
pub fn pairs(trials: &[Trial], target: usize) -> Vec<Paired> {
    let solvers = solvers(trials);
    let mut runtimes: BTreeMap<(&str, &str, u64), f64> = BTreeMap::new();
    for trial in trials.iter().filter(|trial| trial.counts() && target < trial.targets.len()) {
        let run = runtime(trial, target);
        let time = if run.reached { run.evaluations as f64 } else { f64::INFINITY };
        runtimes.insert((&trial.solver, &trial.problem, trial.seed), time);
    }
    let mut pairs = Vec::new();
    for (k, first) in solvers.iter().enumerate() {
        for second in &solvers[k + 1..] {
            let both = runtimes.iter().filter(|((solver, ..), _)| solver == first);
            let both: Vec<(f64, f64)> = both
                .filter_map(|((_, problem, seed), time)| {
                    Some((*time, *runtimes.get(&(*second, *problem, *seed))?))
                })
                .collect();
            let ranks = wilcoxon_signed_rank(&both);
            pairs.push(Paired {
                first: (*first).to_owned(),
                second: (*second).to_owned(),
                ranks,
                adjusted: 1.0,
            });
        }
    }
    let adjusted = holm(&pairs.iter().map(|pair| pair.ranks.p).collect::<Vec<_>>());
    for (pair, adjusted) in pairs.iter_mut().zip(adjusted) {
        pair.adjusted = adjusted;
    }
    pairs
}

/// Moré and Wild's data profile (SIAM J. Optim. 20, 2009, Eq. 2.2 and 2.8): for each solver the evaluations, in units
/// of simplex gradients (n + 1), by which each problem and seed was solved to the accuracy tau, none where it was not.
///
/// Solved means f(x0) - f(x) >= (1 - tau) (f(x0) - f_L), with f_L the least cost that any solver found.
pub fn data_profile(trials: &[Trial], tau: f64) -> Vec<(String, Vec<Option<f64>>)> {
    let mut least: BTreeMap<(&str, u64), f64> = BTreeMap::new();
    for trial in trials {
        if let Some(best) = trial.best() {
            let entry = least.entry((&trial.problem, trial.seed)).or_insert(f64::INFINITY);
            *entry = entry.min(best.cost);
        }
    }
    solvers(trials)
        .into_iter()
        .map(|solver| {
            let own = trials.iter().filter(|trial| trial.solver == solver && trial.counts());
            let solved = own.map(|trial| {
                let key = (trial.problem.as_str(), trial.seed);
                let (start, least) = (trial.start_cost?, *least.get(&key)?);
                let enough = start - (1.0 - tau) * (start - least);
                let before = trial.best_so_far().iter().position(|cost| *cost <= enough)?;
                Some((before + 1) as f64 / (trial.dimension as f64 + 1.0))
            });
            (solver.to_owned(), solved.collect())
        })
        .collect()
}

/// The standings as a text for a terminal: each solver's successes and expected runtime at each target.
pub fn summary(trials: &[Trial]) -> String {
    use std::fmt::Write;
    let standings = standings(trials, &crate::rng::Seed(1).stream("bootstrap").at(0));
    let mut text = String::from("solver                   target   met      expected runtime (95 %)\n");
    for standing in standings {
        let runtime = match (standing.expected_runtime, standing.interval) {
            (Some(mean), Some((low, high))) => format!("{mean:.1} ({low:.1} to {high:.1})"),
            _ => "never".to_owned(),
        };
        let met = format!("{}/{}", standing.reached, standing.trials);
        let _ = writeln!(text, "{:<24} {:<8} {met:<8} {runtime}", standing.solver, standing.target);
    }
    text
}
