//! `snowglobe power`

use std::path::PathBuf;
use std::process::ExitCode;

use snowglobe::lab::{Lock, Result, Suite, out_folder, power, print, set_threads};

/// Whose claims are put to the test, and where what is found goes.
#[derive(clap::Args)]
#[command(
    after_help = "Changes every number that an experiment is given by a quarter, up and down, and reads every \
    formula otherwise;\nsays which claims turn red, and which nothing can turn red. Takes much longer than the main \
    job; an interrupted run goes on.\n\nExample: snowglobe power amano/table-1 --out mine"
)]
pub struct Args {
    /// Experiments (`amano/table-1`) or papers (`amano`); all of them by default.
    names: Vec<String>,
    /// Tries again what was tried.
    #[arg(long)]
    fresh: bool,
    /// Results whose claims are tried, and below which `power/` is written; the project's by default, for all
    /// experiments only.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

pub fn run(args: &Args, suite: &'static Suite) -> Result<ExitCode> {
    set_threads(args.threads)?;
    let selection = suite.select(&args.names)?;
    let out = out_folder(args.out.as_deref(), args.names.is_empty())?;
    let _lock = Lock::take(&out)?;
    power(suite, &selection, &out, args.fresh)?;
    print(&format!("{}\n", out.join("power").display()));
    Ok(ExitCode::SUCCESS)
}
