//! `snowglobe run`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::ValueEnum;
use snowglobe::lab::{
    Lock, Options, Result, Scale, Suite, Told, out_folder, report_on, run_all, set_threads,
};

/// What to run, and where.
#[derive(clap::Args)]
#[command(after_help = "Example: snowglobe run amano/table-1 --out mine --seed 2")]
pub struct Args {
    /// Experiments (`amano/table-1`) or papers (`amano`); all of them by default.
    names: Vec<String>,
    /// What the paper did, or as little as shows that everything runs.
    #[arg(long, value_enum, default_value = "paper")]
    scale: ScaleName,
    /// Run what is fresh, too.
    #[arg(long)]
    fresh: bool,
    /// Where results go, as <paper>/<experiment>/; needed for anything but the whole suite at paper scale.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only this reading, `enum=variant`; may be repeated.
    #[arg(long, value_name = "READING")]
    reading: Vec<String>,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

#[derive(Clone, Copy, ValueEnum)]
enum ScaleName {
    Paper,
    Smoke,
}

pub fn run(args: &Args, suite: &'static Suite) -> Result<ExitCode> {
    set_threads(args.threads)?;
    let selection = suite.select(&args.names)?;
    let mut options = Options {
        seed: args.seed,
        scale: match args.scale {
            ScaleName::Paper => Scale::Paper,
            ScaleName::Smoke => Scale::Smoke,
        },
        readings: args.reading.iter().map(|text| suite.parse_reading(text)).collect::<Result<_>>()?,
        mutations: Vec::new(),
        settings: Vec::new(),
        fresh: args.fresh,
        out: PathBuf::new(),
    };
    let whole = args.names.is_empty() && options.is_committed_kind();
    options.out = out_folder(args.out.as_deref(), whole)?;
    let _lock = Lock::take(&options.out)?;
    let code = run_all(&selection, &options, Told::Every)?;
    if args.out.is_none() {
        report_on(suite, None)?; // the README and the report show what was just committed
    }
    Ok(code)
}
