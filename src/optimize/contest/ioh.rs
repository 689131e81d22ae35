//! The log as IOHprofiler reads it (de Nobel et al., *IOHexperimenter*, Evolutionary Computation 32, 2024): a folder
//! for each solver, in it a JSON file for each problem, beside it the evaluations that improved on all before.

use std::fmt::Write;

use serde::Serialize;

use super::entrant::Entrant;
use super::trial::Trial;

/// A file of the export: its path and its text.
pub type IohFile = (String, String);

/// The version of IOHexperimenter whose form this is.
const VERSION: &str = "0.3.22";

#[derive(Serialize)]
struct Meta<'a> {
    version: &'a str,
    suite: &'a str,
    function_id: usize,
    function_name: &'a str,
    maximization: bool,
    algorithm: Algorithm<'a>,
    attributes: [&'a str; 2],
    scenarios: [Scenario; 1],
}

#[derive(Serialize)]
struct Algorithm<'a> {
    name: &'a str,
    info: &'a str,
}

#[derive(Serialize)]
struct Scenario {
    dimension: usize,
    path: String,
    runs: Vec<Run>,
}

#[derive(Serialize)]
struct Run {
    instance: u64,
    evals: usize,
    best: Best,
}

#[derive(Serialize)]
struct Best {
    evals: usize,
    y: f64,
    x: Vec<f64>,
}

/// The files of a suite, solver by solver and problem by problem; an instance is a seed.
///
/// A trial without an evaluation has nothing that the format could hold, and is left out.
pub fn export(suite: &str, problems: &[String], entrants: &[Entrant], trials: &[Trial]) -> Vec<IohFile> {
    let mut files = Vec::new();
    for entrant in entrants {
        for (number, problem) in problems.iter().enumerate() {
            let of = |trial: &&Trial| {
                trial.solver == entrant.name && trial.problem == *problem && trial.best().is_some()
            };
            let trials: Vec<&Trial> = trials.iter().filter(of).collect();
            if let Some(first) = trials.first() {
                let made = of_problem(suite, (number + 1, problem), entrant, &trials, first.dimension);
                files.extend(made.into_iter().flatten());
            }
        }
    }
    files
}

fn of_problem(
    suite: &str,
    (id, problem): (usize, &str),
    entrant: &Entrant,
    trials: &[&Trial],
    dimension: usize,
) -> Option<[IohFile; 2]> {
    let path = format!("data_f{id}_{problem}/IOHprofiler_f{id}_DIM{dimension}.dat");
    let mut data = String::new();
    let mut runs = Vec::new();
    for trial in trials {
        let names: String = (0..dimension).map(|k| format!(" x{k}")).collect();
        let _ = writeln!(data, "evaluations raw_y{names}");
        let mut best: Option<(usize, f64, &[f64])> = None;
        for (before, evaluation) in trial.log.iter().enumerate() {
            let better = best.is_none_or(|(_, cost, _)| evaluation.cost < cost);
            let last = before + 1 == trial.log.len();
            if better {
                best = Some((before + 1, evaluation.cost, &evaluation.x));
            } else if !last {
                continue;
            }
            let x: String = evaluation.x.iter().map(|x| format!(" {x}")).collect();
            let _ = writeln!(data, "{} {}{x}", before + 1, evaluation.cost);
        }
        let (evals, y, x) = best?;
        runs.push(Run {
            instance: trial.seed,
            evals: trial.log.len(),
            best: Best { evals, y, x: x.to_vec() },
        });
    }
    let meta = Meta {
        version: VERSION,
        suite,
        function_id: id,
        function_name: problem,
        maximization: false,
        algorithm: Algorithm { name: &entrant.name, info: &entrant.settings },
        attributes: ["evaluations", "raw_y"],
        scenarios: [Scenario { dimension, path: path.clone(), runs }],
    };
    let json = serde_json::to_string_pretty(&meta).ok()? + "\n";
    let folder = &entrant.name;
    Some([(format!("{folder}/IOHprofiler_f{id}_{problem}.json"), json), (format!("{folder}/{path}"), data)])
}
