//! Frost in one dimension: the initial value that ends a film in a chosen frame.

use snowglobe::frost::TSim;
use snowglobe::lab::{Error, Experiment, Lab, Mutant, Result, wilson_95};
use snowglobe::optimize::contest::{
    Budget, Contest, Landscape, Standing, Status, field, quantile, standings,
};
use snowglobe::problems::frost::{self, EndFrameProblem};
use snowglobe::problems::{Suite, frost::boxed};
use snowglobe::rng::Seed;

use super::claims::{self, FrostClaims};
use super::narrow::{self, Match};
use super::tables::Truth;
use super::{plots, tables};

pub const WHOLE: Experiment = Experiment {
    id: "frost-whole",
    title: "Which optimiser ends the film in time: whole end frames",
    source: "Amano §3.4, §4 and §5",
    says: "The end frame is a whole number, so the objective is a staircase: derivatives are 0 or a jump.",
    claims: &[
        &claims::WHOLE.table_1,
        &claims::WHOLE.table_2,
        &claims::WHOLE.stalls,
        &claims::WHOLE.better,
        &claims::WHOLE.rises,
        &claims::WHOLE.basins,
    ],
    run: |lab| run(lab, TSim::Whole, &claims::WHOLE),
    mutant: Mutant {
        changes: "budget",
        to: 1.0,
        why: "after one film the paper's rule still stands where it began",
        turns_red: &["optimizers/frost-whole/table-1", "optimizers/frost-whole/table-2"],
    },
};

pub const INTERPOLATED: Experiment = Experiment {
    id: "frost-interpolated",
    title: "Which optimiser ends the film in time: interpolated end frames",
    source: "Amano §3.4, §4 and §5",
    says: "The end is the crossing of 90 % between two frames: still rough, but no staircase.",
    claims: &[
        &claims::INTERPOLATED.table_1,
        &claims::INTERPOLATED.table_2,
        &claims::INTERPOLATED.stalls,
        &claims::INTERPOLATED.better,
        &claims::INTERPOLATED.rises,
        &claims::INTERPOLATED.basins,
    ],
    run: |lab| run(lab, TSim::Interpolated, &claims::INTERPOLATED),
    mutant: Mutant {
        changes: "budget",
        to: 1.0,
        why: "after one film the paper's rule still stands where it began",
        turns_red: &["optimizers/frost-interpolated/table-2"],
    },
};

/// Seeds of the suite, and those with which the paper's second table is searched.
const SEEDS: u64 = 3;
const TABLE_SEEDS: u64 = 40;
/// Steps of the grid that certifies what is best.
const GRID: u32 = 300;
/// The second of the suite's targets: the paper's 4 frames.
const PAPERS_OWN: usize = 1;
/// The problem over whose curve the searches are drawn.
const DRAWN: &str = "hexagon-0.8-100";

/// The suite with this id.
pub fn problems(id: &str, resolution: u32) -> Suite {
    let t_sim = if id == WHOLE.id { TSim::Whole } else { TSim::Interpolated };
    boxed(frost::suite(t_sim, resolution))
}

fn run(lab: &mut Lab, t_sim: TSim, claims: &'static FrostClaims) -> Result<()> {
    let id = if t_sim == TSim::Whole { WHOLE.id } else { INTERPOLATED.id };
    let budget = lab.assume(
        "budget",
        60.0,
        "evaluations for each solver, problem and seed; not the paper's: enough for bisection many times over, and for \
         chance to come within 4 frames more often than not",
    );
    let resolution = narrow::number(lab, narrow::RESOLUTION).unwrap_or(1) as u32;
    lab.assume_that(
        "given up",
        "a film is given up at four times its target, and counts as ending there",
        "so that every initial value has an end frame",
    );
    lab.assume_that(
        "sketches",
        "seven shapes of about 300 cells, 4 to 8 steps a frame",
        "small enough to be grown some hundred thousand times",
    );
    let suite = frost::suite(t_sim, resolution);
    let played = narrow::run(lab, boxed(suite.clone()), SEEDS, Budget::Evaluations(budget as u64))?;
    let truths = certify(lab, &suite, &played)?;
    if !lab.is_narrowed() {
        let budget = lab.pick(budget as u64, 6);
        judge(lab, claims, t_sim, budget, &played, &truths)?;
    }
    tables::keep(lab, id, &played, &truths)?;
    plots::keep(lab, &played, "frames", 0.5)?;
    plots::keep_searches(lab, DRAWN, &played, &truths)
}

/// Measures every landscape of the match on a grid.
fn certify(lab: &mut Lab, suite: &[EndFrameProblem], played: &Match) -> Result<Vec<Truth>> {
    let steps = lab.pick(GRID, 8);
    let mut truths = Vec::new();
    // Claims speak of threshold 0.8 only; a rehearsal keeps nothing else.
    let wanted = |problem: &&EndFrameProblem| {
        let tried = played.contest.problems().iter().any(|other| other.name() == problem.name);
        tried && (lab.keeps() || problem.films.parameters().threshold == 0.8)
    };
    for problem in suite.iter().filter(wanted) {
        for seed in &played.seeds {
            let x = Landscape::points(problem, steps);
            let residual = lab.each(&x, |x| Landscape::at(problem, *x, Seed(*seed)));
            let residual = residual.into_iter().collect::<std::result::Result<Vec<f64>, _>>();
            let residual =
                residual.map_err(|cause| Error::broken("cannot grow frost").because(cause.to_string()))?;
            let threshold = problem.films.parameters().threshold;
            truths.push(Truth {
                problem: problem.name.clone(),
                sketch: problem.name.split("-0").next().unwrap_or_default().to_owned(),
                threshold,
                seed: *seed,
                target: problem.target,
                landscape: Landscape { x, residual },
            });
        }
    }
    // Films are shared by problems that differ in their target only.
    let mut films: Vec<&EndFrameProblem> = Vec::new();
    for problem in suite {
        if !films.iter().any(|other| std::sync::Arc::ptr_eq(&other.films, &problem.films)) {
            films.push(problem);
        }
    }
    lab.count("films grown", films.iter().map(|problem| problem.films.count()).sum());
    Ok(truths)
}

fn judge(
    lab: &mut Lab,
    claims: &'static FrostClaims,
    t_sim: TSim,
    budget: u64,
    played: &Match,
    truths: &[Truth],
) -> Result<()> {
    let paper = || field().into_iter().filter(|entrant| entrant.name == "paper").collect::<Vec<_>>();
    for (table, claim, seeds) in [("table-1", &claims.table_1, 1), ("table-2", &claims.table_2, TABLE_SEEDS)]
    {
        let own = frost::tables(t_sim).into_iter().filter(|problem| problem.name == table).collect();
        let contest = Contest::new(boxed(own), paper()).with_seeds(lab.seeds(seeds)).budget(budget);
        let pairings = contest.pairings();
        for trial in lab.each(&pairings, |pairing| contest.play(pairing)) {
            lab.found_with(claim, trial.seed, trial.best().map(|best| libm::sqrt(best.cost)));
        }
    }

    let of_paper: Vec<_> = played.trials.iter().filter(|trial| trial.solver == "paper").collect();
    let stalled = of_paper.iter().filter(|trial| {
        let missed =
            trial.targets.get(PAPERS_OWN).is_some_and(|t| trial.runtime(*t).status != Status::Reached);
        missed && trial.reason.contains("is 0")
    });
    lab.found(&claims.stalls, stalled.count() as f64 / of_paper.len().max(1) as f64);

    lab.found(&claims.better, better(lab, played));

    let rough: Vec<&Truth> = truths.iter().filter(|truth| truth.threshold == 0.8).collect();
    let mut sketches: Vec<&str> = rough.iter().map(|truth| truth.sketch.as_str()).collect();
    sketches.dedup();
    let rising = sketches.iter().map(|sketch| {
        let of = rough.iter().filter(|truth| truth.sketch == *sketch);
        snowglobe::lab::average(&of.map(|truth| truth.landscape.rising()).collect::<Vec<_>>())
    });
    lab.found(&claims.rises, rising.fold(f64::INFINITY, f64::min));
    let basins: Vec<f64> = rough.iter().map(|truth| truth.landscape.basins().len() as f64).collect();
    lab.found(&claims.basins, quantile(&basins, 0.5));
    Ok(())
}

/// Solvers that are better than the paper's rule at 4 frames, beyond doubt.
fn better(lab: &Lab, played: &Match) -> f64 {
    let target = frost::TARGETS[PAPERS_OWN];
    let standings = standings(&played.trials, &tables::moment(lab));
    let at: Vec<&Standing> = standings.iter().filter(|standing| standing.target == target).collect();
    let Some(paper) = at.iter().find(|standing| standing.solver == "paper") else { return 0.0 };
    let beats = |other: &&&Standing| {
        let more_often = wilson_95(other.reached, other.trials).0 > wilson_95(paper.reached, paper.trials).1;
        let sooner = match (other.interval, paper.interval) {
            (Some(theirs), Some(papers)) => theirs.1 < papers.0,
            (Some(theirs), None) => theirs.1.is_finite(),
            _ => false,
        };
        more_often && sooner
    };
    at.iter().filter(beats).count() as f64
}
