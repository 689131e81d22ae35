//! Descent towards each definition of the end, from many starts.

use snowglobe::frost::{Aim, EndFrameObjective, TSim};
use snowglobe::lab::{Error, Lab, Result, Table, average};
use snowglobe::optimize::Derivative;
use snowglobe::rng::Seed;

use super::super::setup::{START, Setup};
use super::super::table_2;
use super::claims::ALL_FAILS_MORE;
use super::{Definition, ENDLESS};

/// First values: this many, evenly from the first to the second; each has a seed of its own.
const STARTS: (u64, f64, f64) = (20, 0.2, 0.4);
const ITERATIONS: u64 = 12;

/// One descent of many.
struct Job<'s> {
    setup: &'s Setup,
    definition: Definition,
    number: u64,
}

/// How it ended, and what it cost.
struct Outcome {
    reached: bool,
    steps: f64,
    films: u64,
    why: String,
}

/// Compares how often descent reaches its target.
pub fn compare(lab: &mut Lab, setups: &[(Setup, f64, u64)], definitions: &[Definition]) -> Result<()> {
    let eta = lab.printed("eta", 1.0e-6, "§4");
    let tolerance = lab.printed("tolerance", 4.0, "§4");
    let known = lab.printed("beta of the targets", table_2::PRINTED[3].0, "Table 2, step 3");
    let h = lab.assume("h", 0.01, "the difference of a search's first derivative is not given");
    let first = lab.seed().0;
    let mut table = Table::new([
        "threshold",
        "ends_with",
        "starts",
        "within_4_frames",
        "mean_steps",
        "mean_films",
        "left_the_domain_or_flat",
        "iterations_used_up",
    ]);
    let mut shares = vec![Vec::new(); definitions.len()];
    for (setup, threshold, _) in setups {
        for (k, definition) in definitions.iter().enumerate() {
            let jobs: Vec<Job> = (0..lab.pick(STARTS.0, 2))
                .map(|number| Job { setup, definition: *definition, number })
                .collect();
            let aim =
                Aim { start: 0.0, eta, tolerance, derivative: Derivative::Secant, h, iterations: ITERATIONS };
            let outcomes = lab.each(&jobs, |job| descend(job, first, known, &aim));
            let outcomes = outcomes.into_iter().collect::<Result<Vec<_>>>()?;
            let count = |is: &dyn Fn(&Outcome) -> bool| outcomes.iter().filter(|o| is(o)).count();
            let mean = |of: &dyn Fn(&Outcome) -> f64| average(&outcomes.iter().map(of).collect::<Vec<_>>());
            let reached = count(&|o| o.reached);
            let used_up = count(&|o| !o.reached && o.why.contains("iterations"));
            table.row([
                threshold.into(),
                definition.name.into(),
                outcomes.len().into(),
                reached.into(),
                mean(&|o| o.steps).into(),
                mean(&|o| o.films as f64).into(),
                (outcomes.len() - reached - used_up).into(),
                used_up.into(),
            ]);
            lab.count("films grown", outcomes.iter().map(|o| o.films).sum());
            shares[k].push(reached as f64 / outcomes.len() as f64);
        }
    }
    lab.found(&ALL_FAILS_MORE, average(&shares[0]) - average(&shares[1]));
    lab.keep(
        "descents",
        "How often descent by Eq. (3) (the secant of the interpolated end frame) came within 4 frames of its target, \
         from 20 starts between 0.2 and 0.4, each with a seed of its own",
        table,
    )
}

fn descend(job: &Job, first_seed: u64, known: f64, aim: &Aim) -> Result<Outcome> {
    let (count, from, to) = STARTS;
    let start = from + (to - from) * job.number as f64 / (count - 1) as f64;
    let mut objective = EndFrameObjective {
        region: &job.setup.region,
        starts: &START,
        parameters: job.setup.parameters,
        seed: Seed(first_seed + job.number),
        rule: job.definition.rule,
        target: 0.0,
        t_sim: TSim::Interpolated,
        h: aim.h,
        frame_limit: ENDLESS,
    };
    objective.target = objective.end_frame(known)?.map_or(f64::INFINITY, |end| end.frame as f64);
    let search =
        objective.descend(&Aim { start, ..*aim }).map_err(|cause| Error::broken(cause.to_string()))?;
    Ok(Outcome {
        reached: search.reached,
        steps: search.iterates.len() as f64 - 1.0,
        films: search.evaluations,
        why: search.why,
    })
}
