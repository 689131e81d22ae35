//! `snowglobe list`

use std::process::ExitCode;

use clap::ValueEnum;
use snowglobe::lab::{Result, Suite, print, results_folder};

/// What to list, and how.
#[derive(clap::Args)]
#[command(after_help = "Example: snowglobe list --format json")]
pub struct Args {
    /// For people or for programs.
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
}

pub fn run(args: &Args, suite: &Suite) -> Result<ExitCode> {
    // Assumptions are read from the results, where there are any.
    let results = results_folder().unwrap_or_default();
    print(&match args.format {
        Format::Text => suite.to_text(),
        Format::Json => format!("{:#}\n", suite.to_json(&results)),
    });
    Ok(ExitCode::SUCCESS)
}
