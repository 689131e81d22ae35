//! `snowglobe diff`

use std::path::PathBuf;
use std::process::ExitCode;

use snowglobe::lab::{Result, diff, print};

/// The folders to compare.
#[derive(clap::Args)]
#[command(after_help = "Example: snowglobe diff results mine")]
pub struct Args {
    /// A results folder.
    before: PathBuf,
    /// Another.
    after: PathBuf,
    /// Exit with 1 if a claim differs.
    #[arg(long)]
    exit_code: bool,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    let (differences, same) = diff(&args.before, &args.after)?;
    let none = || "not there".to_owned();
    for difference in &differences {
        let before = difference.before.clone().unwrap_or_else(none);
        let after = difference.after.clone().unwrap_or_else(none);
        print(&format!("{}\n    {before}\n -> {after}\n", difference.claim));
    }
    print(&format!("{} claims differ, {same} are the same\n", differences.len()));
    Ok(if args.exit_code && !differences.is_empty() { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}
