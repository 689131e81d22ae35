//! What a match leaves as tables.

use std::collections::BTreeMap;

use snowglobe::lab::{Artifact, Lab, Result, Table, maybe, wilson_95};
use snowglobe::optimize::contest::{Landscape, Rank, Standing, Trial, export, pairs, standings};
use snowglobe::rng::Moment;

use super::narrow::Match;

/// What a grid says of a problem with one seed.
pub struct Truth {
    pub problem: String,
    pub sketch: String,
    pub threshold: f64,
    pub seed: u64,
    pub target: f64,
    pub landscape: Landscape,
}

/// The target at which solvers are summed up: the second, the paper's 4 frames.
const MAIN: usize = 1;

/// Random numbers of the bootstrap.
pub fn moment(lab: &Lab) -> Moment {
    lab.stream("bootstrap").at(0)
}

/// Keeps the tables of a match, its log and the log's export.
pub fn keep(lab: &mut Lab, suite: &str, played: &Match, truths: &[Truth]) -> Result<()> {
    if !lab.keeps() {
        return Ok(());
    }
    let ranks = ranked(&played.trials, truths);
    let target = played.trials.first().and_then(|t| t.targets.get(MAIN)).map_or(0.0, |target| target.value);
    lab.keep(
        "solvers",
        &format!(
            "Every solver at the target of {target}, over the whole suite: share of successes and expected runtime, with \
             95 % intervals; trials whose best x is the best, a basin, or neither"
        ),
        solvers(lab, played, &ranks),
    )?;
    lab.keep("settings", "Every solver's settings", settings(played))?;
    lab.keep(
        "standings",
        "Every solver at every target over the whole suite, with 95 % intervals; one leads only where the interval of its \
         expected runtime overlaps no other's",
        standing_table(lab, &played.trials),
    )?;
    lab.keep(
        "pairs",
        &format!(
            "Every pair of solvers at the target of {target}, over the same problems and seeds: Wilcoxon's signed ranks of \
             the runtimes. The effect is the rank-biserial correlation, positive where the first is slower; p after Holm"
        ),
        pair_table(played),
    )?;
    lab.keep(
        "runtime",
        "Evaluations of every trial to every target",
        runtime(played.trials.iter().chain(&played.inapplicable)),
    )?;
    lab.keep(
        "large/trials",
        "How every trial ended, its best x, and what that is by the grid",
        trial_table(&played.trials, &ranks),
    )?;
    if !truths.is_empty() {
        lab.keep(
            "truth",
            "What a grid of initial values says of every problem and seed",
            truth_table(truths),
        )?;
    }
    lab.keep(
        "large/runtime-by-problem",
        "Every solver at every target of every problem: successes and expected runtime with its 95 % interval",
        by_problem(lab, played),
    )?;
    lab.keep("large/log", "Every evaluation of every trial", log(&played.trials))?;
    let names: Vec<String> = played.contest.problems().iter().map(|problem| problem.name()).collect();
    let files = export(suite, &names, played.contest.entrants(), &played.trials);
    lab.keep(
        "large/ioh",
        "The log in the form of IOHprofiler, a folder for each solver",
        Artifact::Archive(files),
    )
}

/// The rank of each trial whose landscape is known, by problem and seed.
fn ranked(trials: &[Trial], truths: &[Truth]) -> Vec<Option<Rank>> {
    let known: BTreeMap<(&str, u64), &Landscape> =
        truths.iter().map(|truth| ((truth.problem.as_str(), truth.seed), &truth.landscape)).collect();
    let rank = |trial: &Trial| Some(known.get(&(trial.problem.as_str(), trial.seed))?.rank(trial));
    trials.iter().map(rank).collect()
}

fn solvers(lab: &Lab, played: &Match, ranks: &[Option<Rank>]) -> Table {
    let mut table = Table::new([
        "solver",
        "family",
        "trials",
        "success",
        "success_low",
        "success_high",
        "runtime",
        "runtime_low",
        "runtime_high",
        "best",
        "basin",
        "stuck",
    ]);
    let standings = standings(&played.trials, &moment(lab));
    for entrant in played.contest.entrants() {
        let of_solver: Vec<_> = standings.iter().filter(|standing| standing.solver == entrant.name).collect();
        let Some(main) = of_solver.get(MAIN.min(of_solver.len().saturating_sub(1))) else { continue };
        let (low, high) = wilson_95(main.reached, main.trials);
        let mine = || played.trials.iter().zip(ranks).filter(|(trial, _)| trial.solver == entrant.name);
        let certified = mine().any(|(_, rank)| rank.is_some());
        let count = |rank: Rank| maybe(certified.then(|| mine().filter(|(_, r)| **r == Some(rank)).count()));
        table.row([
            entrant.name.as_str().into(),
            entrant.family.name().into(),
            main.trials.into(),
            main.success().into(),
            low.into(),
            high.into(),
            maybe(main.expected_runtime),
            maybe(main.interval.map(|interval| interval.0)),
            maybe(main.interval.map(|interval| interval.1)),
            count(Rank::Best),
            count(Rank::Basin),
            count(Rank::Stuck),
        ]);
    }
    table
}

fn settings(played: &Match) -> Table {
    let mut table = Table::new(["solver", "family", "settings"]);
    for entrant in played.contest.entrants() {
        table.row([
            entrant.name.as_str().into(),
            entrant.family.name().into(),
            entrant.settings.as_str().into(),
        ]);
    }
    table
}

/// The standings of each problem alone.
fn by_problem(lab: &Lab, played: &Match) -> Table {
    let mut table =
        Table::new(["problem", "solver", "target", "trials", "reached", "expected_runtime", "low", "high"]);
    for problem in played.contest.problems() {
        let name = problem.name();
        let own: Vec<Trial> = played.trials.iter().filter(|trial| trial.problem == name).cloned().collect();
        for standing in standings(&own, &moment(lab)) {
            table.row([
                name.as_str().into(),
                standing.solver.into(),
                standing.target.into(),
                standing.trials.into(),
                standing.reached.into(),
                maybe(standing.expected_runtime),
                maybe(standing.interval.map(|interval| interval.0)),
                maybe(standing.interval.map(|interval| interval.1)),
            ]);
        }
    }
    table
}

/// Whether a solver is ahead of all others at its target beyond doubt: those that met the target later, those that never
/// did less often, by intervals that do not overlap. Who was not tried on everything leads nobody.
fn leads(mine: &Standing, standings: &[Standing]) -> bool {
    let share = |standing: &Standing| wilson_95(standing.reached, standing.trials);
    let rivals = || standings.iter().filter(|o| o.target == mine.target && o.solver != mine.solver);
    let behind = |other: &Standing| match (mine.interval, other.interval) {
        (Some(mine), Some(theirs)) => mine.1 < theirs.0,
        (Some(_), None) => share(mine).0 > share(other).1,
        (None, _) => false,
    };
    rivals().all(|other| other.trials <= mine.trials && behind(other))
}

fn standing_table(lab: &Lab, trials: &[Trial]) -> Table {
    let mut table = Table::new([
        "solver",
        "target",
        "trials",
        "reached",
        "success",
        "success_low",
        "success_high",
        "expected_runtime",
        "low",
        "high",
        "leads",
    ]);
    let standings = standings(trials, &moment(lab));
    for standing in &standings {
        let (low, high) = wilson_95(standing.reached, standing.trials);
        let leads = leads(standing, &standings);
        table.row([
            standing.solver.as_str().into(),
            standing.target.into(),
            standing.trials.into(),
            standing.reached.into(),
            standing.success().into(),
            low.into(),
            high.into(),
            maybe(standing.expected_runtime),
            maybe(standing.interval.map(|interval| interval.0)),
            maybe(standing.interval.map(|interval| interval.1)),
            (if leads { "yes" } else { "no" }).into(),
        ]);
    }
    table
}

fn pair_table(played: &Match) -> Table {
    let mut table = Table::new(["first", "second", "pairs", "equal", "effect", "p", "p_holm"]);
    for pair in pairs(&played.trials, MAIN) {
        table.row([
            pair.first.into(),
            pair.second.into(),
            pair.ranks.pairs.into(),
            pair.ranks.zeros.into(),
            pair.ranks.effect.into(),
            pair.ranks.p.into(),
            pair.adjusted.into(),
        ]);
    }
    table
}

fn runtime<'t>(trials: impl Iterator<Item = &'t Trial>) -> Table {
    let mut table = Table::new(["problem", "solver", "seed", "target", "evaluations", "status", "reason"]);
    for trial in trials {
        for target in &trial.targets {
            let arrival = trial.runtime(*target);
            table.row([
                trial.problem.as_str().into(),
                trial.solver.as_str().into(),
                trial.seed.into(),
                target.value.into(),
                arrival.evaluations.into(),
                arrival.status.name().into(),
                arrival.reason.into(),
            ]);
        }
    }
    table
}

fn trial_table(trials: &[Trial], ranks: &[Option<Rank>]) -> Table {
    let mut table =
        Table::new(["problem", "solver", "seed", "evaluations", "status", "best_x", "best_f", "best_is"]);
    for (trial, rank) in trials.iter().zip(ranks) {
        let best = trial.best();
        table.row([
            trial.problem.as_str().into(),
            trial.solver.as_str().into(),
            trial.seed.into(),
            trial.log.len().into(),
            trial.status.name().into(),
            maybe(best.map(|best| joined(&best.x))),
            maybe(best.map(|best| best.cost)),
            maybe(rank.map(Rank::name)),
        ]);
    }
    table
}

fn truth_table(truths: &[Truth]) -> Table {
    let mut table = Table::new([
        "problem",
        "seed",
        "target",
        "best_beta",
        "least_miss",
        "basins",
        "share_of_rising_steps",
        "share_of_level_steps",
    ]);
    for truth in truths {
        let optimum = truth.landscape.optimum();
        table.row([
            truth.problem.as_str().into(),
            truth.seed.into(),
            truth.target.into(),
            maybe(optimum.map(|optimum| optimum.0)),
            maybe(optimum.map(|optimum| optimum.1)),
            truth.landscape.basins().len().into(),
            truth.landscape.rising().into(),
            truth.landscape.level().into(),
        ]);
    }
    table
}

fn log(trials: &[Trial]) -> Table {
    let mut table = Table::new(["problem", "solver", "seed", "evaluation", "x", "f"]);
    for trial in trials {
        for (before, evaluation) in trial.log.iter().enumerate() {
            table.row([
                trial.problem.as_str().into(),
                trial.solver.as_str().into(),
                trial.seed.into(),
                (before + 1).into(),
                joined(&evaluation.x).into(),
                evaluation.cost.into(),
            ]);
        }
    }
    table
}

/// Coordinates joined by `;`.
fn joined(x: &[f64]) -> String {
    x.iter().map(f64::to_string).collect::<Vec<_>>().join(";")
}

/// The best that any solver found for a problem and seed: who, at what cost, and where.
pub fn best<'a>(trials: &'a [Trial], problem: &str, seed: u64) -> Option<(&'a str, f64, Vec<f64>)> {
    let of = trials.iter().filter(|trial| trial.problem == problem && trial.seed == seed);
    let bests =
        of.filter_map(|trial| trial.best().map(|best| (trial.solver.as_str(), best.cost, best.x.clone())));
    bests.min_by(|a, b| a.1.total_cmp(&b.1))
}
