//! The commands: parse, call the library, print.

mod automaton;
mod cavity;
mod check;
mod contour_cloud;
mod crystal;
mod diff;
mod forensics;
mod frost;
mod list;
mod npy;
mod optimizers;
mod own;
mod power;
mod reading;
mod report;
mod run;
mod snow;
mod tree;
mod volume;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use snowglobe::lab::{self, MainJob, Result, Suite};

/// Five papers on snow, frost, clouds and trees in the wind, re-run.
///
/// Without a command: runs every experiment that is not fresh in this copy, judges every claim, writes the report and
/// prints the table of claims.
#[derive(Parser)]
#[command(name = "snowglobe", version, args_conflicts_with_subcommands = true, after_help = EXAMPLES)]
struct Cli {
    #[command(flatten)]
    job: MainJob,
    #[command(subcommand)]
    command: Option<Command>,
}

const EXAMPLES: &str = "Examples:\n  snowglobe                              re-run the papers\n  \
    snowglobe run amano/table-1 --out mine re-run one experiment elsewhere\n  \
    snowglobe check --exact                compare a re-run with results/\n  \
    snowglobe frost --sketch leaf.svg --target 130\n  \
    snowglobe tree --wind 7 --seconds 3\n  \
    snowglobe cavity --reynolds 1000 --cells 128\n  \
    snowglobe contour-cloud --contours hills.svg --gain 0.3\n  \
    snowglobe automaton --size 128,128,48 --steps 60\n  \
    snowglobe volume --density density.npy --voxel 40 --tau 0.004\n  \
    snowglobe crystal --temperature -15 --supersaturation 17 --minutes 20\n  \
    snowglobe snow --background garden.png --flakes 1000\n  \
    snowglobe forensics --iterates table.csv --target 130 --eta 1e-6\n  \
    snowglobe optimizers --solver cma-es --seeds 20 --out mine";

#[derive(Subcommand)]
enum Command {
    /// Lists papers, experiments, claims, readings and assumptions.
    List(list::Args),
    /// Re-runs what is not fresh and says what it replaces.
    Run(run::Args),
    /// Re-runs into a temporary folder and compares with the files on disk.
    Check(check::Args),
    /// Writes the report and the README's table from the results on disk.
    Report(report::Args),
    /// Changes what claims rest on, and says which of them notice.
    Power(power::Args),
    /// Compares two result folders, claim by claim.
    Diff(diff::Args),
    /// Grows frost on your own sketch, and finds the initial value that ends the film in a chosen frame.
    Frost(Box<frost::Args>),
    /// Runs the lid-driven cavity, a benchmark of flow solvers.
    Cavity(cavity::Args),
    /// Sways a tree in a computed wind: the paper's or one of your own rules.
    Tree(Box<tree::Args>),
    /// Makes a cloud and a mountain of your own contours.
    ContourCloud(Box<contour_cloud::Args>),
    /// Grows clouds of the cellular automaton, from chance or from a state of your own.
    Automaton(Box<automaton::Args>),
    /// Renders a density of your own.
    Volume(Box<volume::Args>),
    /// Grows a snow crystal in air of your own.
    Crystal(Box<crystal::Args>),
    /// Lets snow fall before a picture of your own.
    Snow(Box<snow::Args>),
    /// Compares optimisers on objectives that are simulations.
    Optimizers(optimizers::Args),
    /// Says which rules for the derivative can have produced a printed table of iterates.
    Forensics(forensics::Args),
}

/// Runs the program.
pub fn main(suite: &'static Suite) -> ExitCode {
    lab::program(|cli: Cli| dispatch(cli, suite))
}

fn dispatch(cli: Cli, suite: &'static Suite) -> Result<ExitCode> {
    match cli.command {
        None => cli.job.run(suite),
        Some(Command::List(args)) => list::run(&args, suite),
        Some(Command::Run(args)) => run::run(&args, suite),
        Some(Command::Check(args)) => check::run(&args, suite),
        Some(Command::Report(args)) => report::run(&args, suite),
        Some(Command::Power(args)) => power::run(&args, suite),
        Some(Command::Diff(args)) => diff::run(&args),
        Some(Command::Frost(args)) => frost::run(&args),
        Some(Command::Cavity(args)) => cavity::run(&args),
        Some(Command::Tree(args)) => tree::run(&args),
        Some(Command::ContourCloud(args)) => contour_cloud::run(&args),
        Some(Command::Automaton(args)) => automaton::run(&args),
        Some(Command::Volume(args)) => volume::run(&args),
        Some(Command::Crystal(args)) => crystal::run(&args),
        Some(Command::Snow(args)) => snow::run(&args),
        Some(Command::Optimizers(args)) => optimizers::run(&args, suite),
        Some(Command::Forensics(args)) => forensics::run(&args),
    }
}
