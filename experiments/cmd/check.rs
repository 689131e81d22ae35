//! `snowglobe check`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::ValueEnum;
use snowglobe::lab::{Format, Result, Suite, check, print, print_error, results_folder, set_threads};

/// What to check, and how strictly.
#[derive(clap::Args)]
#[command(after_help = "Example: snowglobe check --exact --format junit > check.xml")]
pub struct Args {
    /// Experiments or papers; all of them by default.
    names: Vec<String>,
    /// Accept only identical files.
    #[arg(long)]
    exact: bool,
    /// How the outcome is printed.
    #[arg(long, value_enum, default_value = "text")]
    format: FormatName,
    /// The results that are checked; the project's by default.
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum FormatName {
    Text,
    Json,
    Junit,
    Markdown,
}

pub fn run(args: &Args, suite: &'static Suite) -> Result<ExitCode> {
    set_threads(args.threads)?;
    let selection = suite.select(&args.names)?;
    let results = args.results.clone().map_or_else(results_folder, Ok)?;
    let format = match args.format {
        FormatName::Text => Format::Text,
        FormatName::Json => Format::Json,
        FormatName::Junit => Format::Junit,
        FormatName::Markdown => Format::Markdown,
    };
    let all = check::check(&selection, &results, |checked| {
        let line = check::text_of(checked, args.exact);
        // Standard output belongs to the format that was asked for.
        if format == Format::Text { print(&line) } else { print_error(&line) }
    })?;
    print(&check::render(&all, args.exact, format));
    let passes = all.iter().all(|checked| checked.passes(args.exact));
    Ok(if passes { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
