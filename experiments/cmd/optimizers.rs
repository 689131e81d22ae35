//! `snowglobe optimizers`

use std::path::PathBuf;
use std::process::ExitCode;

use snowglobe::lab::{
    Error, Lock, Options, Result, Suite, Told, out_folder, report_on, run_all, set_threads,
};

use crate::optimizers;

const EXAMPLES: &str = "Example: snowglobe optimizers --problem hexagon-0.8-100 --solver brent-root --solver cma-es \
    --seeds 20 --budget 60 --out mine\n\n\
    Without a flag the whole comparison is run into results/optimizers. A narrower or larger one judges no claim and \
    needs --out; it writes <out>/optimizers/<suite>/runtime.csv and large/log.csv, among others.";

/// What is compared, and where the results go.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Suites; by default those that have the problems that are named, or all.
    suites: Vec<String>,
    /// Only this problem; may be repeated.
    #[arg(long, value_name = "NAME")]
    problem: Vec<String>,
    /// Only this solver; may be repeated.
    #[arg(long, value_name = "NAME")]
    solver: Vec<String>,
    /// Evaluations for each solver, problem and seed.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = |text: &str| count(text, 1_000_000))]
    budget: Option<u64>,
    /// Seeds 1 to N.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = |text: &str| count(text, 100_000))]
    seeds: Option<u64>,
    /// Cells of the sketches N times as fine.
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = |text: &str| count(text, 16))]
    resolution: Option<u64>,
    /// Where results go, as optimizers/<suite>/; needed for anything but the whole comparison.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The first seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Run what is fresh, too.
    #[arg(long)]
    fresh: bool,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

pub fn run(args: &Args, suite: &'static Suite) -> Result<ExitCode> {
    set_threads(args.threads)?;
    let suites = suites(args)?;
    let mut options = Options { seed: args.seed, fresh: args.fresh, ..Options::committed(PathBuf::new()) };
    let mut set = |what: &str, which: String| options.settings.push((what.to_owned(), which));
    args.problem.iter().for_each(|name| set("problem", name.clone()));
    args.solver.iter().for_each(|name| set("solver", name.clone()));
    for (what, number) in [("budget", args.budget), ("seeds", args.seeds), ("resolution", args.resolution)] {
        if let Some(number) = number {
            set(what, number.to_string());
        }
    }
    let whole = args.suites.is_empty() && options.is_committed_kind();
    options.out = out_folder(args.out.as_deref(), whole)?;
    let _lock = Lock::take(&options.out)?;
    let names: Vec<String> = suites.iter().map(|name| format!("optimizers/{name}")).collect();
    let code = run_all(&suite.select(&names)?, &options, Told::Every)?;
    if args.out.is_none() {
        report_on(suite, None)?; // the README and the report show what was just committed
    }
    Ok(code)
}

fn count(text: &str, most: u64) -> std::result::Result<u64, String> {
    text.parse().ok().filter(|number| (1..=most).contains(number)).ok_or(format!("1 to {most} is accepted"))
}

/// The suites that are asked for; a name that is none is refused with what would be accepted.
fn suites(args: &Args) -> Result<Vec<&'static str>> {
    let (suites, solvers) = optimizers::accepted();
    let refuse = |flag: &str, name: &str, accepted: Vec<String>| {
        Err(Error::usage(format!("no `{name}`; accepted: {}", accepted.join(", "))).at(flag))
    };
    let ids = || suites.iter().map(|(id, _)| (*id).to_owned()).collect::<Vec<_>>();
    if let Some(unknown) = args.suites.iter().find(|name| !ids().contains(*name)) {
        return refuse("SUITES", unknown, ids());
    }
    if let Some(unknown) = args.solver.iter().find(|name| !solvers.contains(*name)) {
        return refuse("--solver", unknown, solvers);
    }
    let asked: Vec<_> = suites
        .iter()
        .filter(|(id, _)| args.suites.is_empty() || args.suites.iter().any(|name| name == id))
        .collect();
    let problems = || asked.iter().flat_map(|(_, problems)| problems);
    if let Some(unknown) = args.problem.iter().find(|name| !problems().any(|problem| problem == *name)) {
        let mut accepted: Vec<String> = problems().cloned().collect();
        accepted.sort();
        accepted.dedup();
        return refuse("--problem", unknown, accepted);
    }
    let has = |problems: &[String]| {
        args.problem.is_empty() || args.problem.iter().any(|name| problems.contains(name))
    };
    Ok(asked.iter().filter(|(_, problems)| has(problems)).map(|(id, _)| *id).collect())
}
