//! `snowglobe report`

use std::path::PathBuf;
use std::process::ExitCode;

use snowglobe::lab::{Result, Suite, print, report_on};

/// Where the results are.
#[derive(clap::Args)]
#[command(after_help = "Example: snowglobe report")]
pub struct Args {
    /// The results to report on; the project's by default, whose README gets the table of claims as well.
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
}

pub fn run(args: &Args, suite: &Suite) -> Result<ExitCode> {
    let page = report_on(suite, args.results.as_deref())?;
    print(&format!("{}\n", page.display()));
    Ok(ExitCode::SUCCESS)
}
