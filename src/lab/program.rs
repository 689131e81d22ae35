//! What every program of the project does alike: its arguments, its errors, its exit codes, its main job.

use std::io::Write;
use std::panic;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;

use super::error::{Error, Result};
use super::folder::Lock;
use super::progress::set_threads;
use super::run::run_one;
use super::suite::{Experiment, Options, Paper, Suite};

/// Parses the arguments and runs the program; an error is one line on standard error.
pub fn program<Cli: Parser>(run: impl FnOnce(Cli) -> Result<ExitCode>) -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(refused) => return refuse(&refused),
    };
    panic::set_hook(Box::new(|bug| {
        let bug = bug.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
        print_error(&format!("error: this is a bug in snowglobe; please report it: {bug}\n"));
    }));
    match panic::catch_unwind(panic::AssertUnwindSafe(|| run(cli))) {
        Ok(Ok(code)) => code,
        Ok(Err(error)) => {
            print_error(&format!("error: {error}\n"));
            ExitCode::from(error.exit_code())
        }
        Err(_) => ExitCode::FAILURE,
    }
}

/// Help goes to standard output; a refusal becomes one line that says where to look.
fn refuse(refused: &clap::Error) -> ExitCode {
    if matches!(refused.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        print(&refused.render().to_string());
        return ExitCode::SUCCESS;
    }
    let text = refused.render().to_string();
    let paragraphs = text.split("\n\n").take_while(|part| !part.trim_start().starts_with("Usage:"));
    let line: Vec<&str> = paragraphs.flat_map(str::split_whitespace).collect();
    print_error(&format!("{} (--help says what is accepted)\n", line.join(" ")));
    ExitCode::from(2)
}

/// Writes to standard output; a reader who has left is no error.
pub fn print(text: &str) {
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
    let _ = std::io::stdout().flush();
}

/// Writes to standard error.
pub fn print_error(text: &str) {
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// The project's folder: the nearest one above that holds its `Cargo.toml` and its experiments.
fn project() -> Result<PathBuf> {
    let here = std::env::current_dir().map_err(|cause| Error::broken("no current folder").because(cause))?;
    let is_project = |folder: &&Path| {
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap_or_default();
        manifest.contains("name = \"snowglobe\"") && folder.join("experiments").is_dir()
    };
    here.ancestors().find(is_project).map(Path::to_path_buf).ok_or_else(|| {
        Error::usage("not inside the project, which has the results; go there, or name a folder")
            .at(here.display())
    })
}

/// The project's results.
pub fn results_folder() -> Result<PathBuf> {
    Ok(project()?.join("results"))
}

/// Where a run writes: `--out`, or the project's results if the run is of the kind that is committed.
pub fn out_folder(out: Option<&Path>, committed_kind: bool) -> Result<PathBuf> {
    match out {
        Some(out) => Ok(out.to_path_buf()),
        None if committed_kind => results_folder(),
        None => Err(Error::usage(
            "only the whole suite at paper scale, seed 1 and all readings writes into results/; give --out DIR",
        )
        .at("--out")),
    }
}

/// How much of a run is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Told {
    /// A line for every experiment.
    Every,
    /// A line for what was run.
    OnlyRun,
    /// Nothing but errors.
    Nothing,
}

/// Runs the selected experiments one after the other; one that breaks does not stop the others.
pub fn run_all(
    selection: &[(&'static Paper, &'static Experiment)],
    options: &Options,
    told: Told,
) -> Result<ExitCode> {
    let mut broken = 0;
    for (paper, experiment) in selection {
        match run_one(paper, experiment, options) {
            Ok(outcome) => {
                if told == Told::Nothing {
                    continue;
                }
                match outcome.seconds {
                    Some(seconds) => print(&format!("{:<28} {seconds:.1} s\n", outcome.id)),
                    None if told == Told::Every => print(&format!("{:<28} fresh\n", outcome.id)),
                    None => {}
                }
                for (what, old, new) in &outcome.replaced {
                    print(&format!("    {what}: {old} -> {new}\n"));
                }
            }
            Err(error) => {
                broken += 1;
                print_error(&format!("error: {error}\n"));
            }
        }
    }
    Ok(if broken == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The main job's options.
#[derive(Clone, Debug, clap::Args)]
pub struct MainJob {
    /// Run what is fresh, too.
    #[arg(long)]
    fresh: bool,
    /// Where results go; the project's results by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The seed; another than 1 needs --out.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

impl MainJob {
    /// Runs every experiment that is not fresh, judges every claim, writes the report, prints the table of claims.
    pub fn run(&self, suite: &'static Suite) -> Result<ExitCode> {
        let (out, code) = self.experiments(suite)?;
        let page = suite.write_report(&out)?;
        if self.out.is_none() {
            splice(suite, &out)?;
        }
        print(&suite.claims_as_text(&out));
        print(&format!("report: {}\n", page.display()));
        Ok(code)
    }

    fn experiments(&self, suite: &'static Suite) -> Result<(PathBuf, ExitCode)> {
        set_threads(self.threads)?;
        let mut options =
            Options { seed: self.seed, fresh: self.fresh, ..Options::committed(PathBuf::new()) };
        options.out = out_folder(self.out.as_deref(), options.is_committed_kind())?;
        let _lock = Lock::take(&options.out)?;
        let code = run_all(&suite.select(&[])?, &options, Told::OnlyRun)?;
        Ok((options.out, code))
    }
}

/// Writes the report on a results folder, and the README's table if it is the project's.
pub fn report_on(suite: &Suite, results: Option<&Path>) -> Result<PathBuf> {
    match results {
        Some(results) if !results.is_dir() => {
            Err(Error::usage("no such results folder").at(results.display()))
        }
        Some(results) => suite.write_report(results),
        None => {
            let results = results_folder()?;
            splice(suite, &results)?;
            suite.write_report(&results)
        }
    }
}

fn splice(suite: &Suite, results: &Path) -> Result<()> {
    suite.splice_readme(results, &results.with_file_name("README.md"))
}

/// A program that re-runs one paper alone.
#[derive(Parser)]
#[command(version, about = "Re-runs this paper's experiments and judges its claims")]
#[command(after_help = "Example: cargo run --release --bin amano -- --threads 2")]
struct PaperProgram {
    #[command(flatten)]
    job: MainJob,
}

/// Runs one paper: its experiments, then its table of claims. The report is `snowglobe`'s.
pub fn paper_program(suite: &'static Suite) -> ExitCode {
    program(|cli: PaperProgram| {
        let (out, code) = cli.job.experiments(suite)?;
        print(&suite.claims_as_text(&out));
        Ok(code)
    })
}
