//! `snowglobe cavity`: the lid-driven cavity, to be laid beside other people's numbers.

use std::path::PathBuf;
use std::process::ExitCode;

use serde::Serialize;
use snowglobe::lab::{Error, Progress, Result, Table, print, set_threads};
use snowglobe::navier_stokes::Cavity;
use snowglobe::reading::Reading;

use super::own::OwnFolder;

const EXAMPLES: &str = "Examples:\n  snowglobe cavity --reynolds 100 --cells 64\n  \
    snowglobe cavity --reynolds 1000 --cells 128 --dt 0.005 --time 10\n  \
    snowglobe cavity --reynolds 400 --cells 65 --scheme collocated --convection upwind --out mine";

/// The box, the flow in it, and how it is computed.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Speed of the lid times 1 m over the viscosity.
    #[arg(long, allow_hyphen_values = true)]
    reynolds: f64,
    /// Cells along each side, 4 to 4096.
    #[arg(long, allow_hyphen_values = true, default_value_t = 128)]
    cells: usize,
    /// The time step in s; half of the largest stable one by default.
    #[arg(long, allow_hyphen_values = true)]
    dt: Option<f64>,
    /// Time from rest in s.
    #[arg(long, allow_hyphen_values = true, default_value_t = 40.0)]
    time: f64,
    /// Where the unknowns are: staggered or collocated.
    #[arg(long, default_value = "staggered")]
    scheme: String,
    /// How convection is differenced: central or upwind.
    #[arg(long, default_value = "central")]
    convection: String,
    /// Speed of the lid in m/s.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.0)]
    lid: f64,
    /// Where to write; ./out/cavity by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

/// The most steps one run takes.
const MOST_STEPS: f64 = 1e8;

#[derive(Serialize)]
struct Summary {
    reynolds: f64,
    cells: usize,
    lid: f64,
    scheme: &'static str,
    convection: &'static str,
    dt: f64,
    time: f64,
    steps: u64,
    largest_stable_dt: f64,
    kinetic_energy: f64,
    max_divergence: f64,
    /// Times the width of a cell, over the speed of the lid: what a cell loses of what passes it.
    max_divergence_scaled: f64,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    set_threads(args.threads)?;
    let cavity = Cavity {
        reynolds: within("--reynolds", args.reynolds, 1e-3, 1e7)?,
        cells: within("--cells", args.cells as f64, 4.0, 4096.0)? as usize,
        lid: args.lid,
        scheme: named("--scheme", &args.scheme)?,
        convection: named("--convection", &args.convection)?,
    };
    within("the size of --lid", args.lid.abs(), 1e-6, 1e4)?;
    let most = cavity.largest_step();
    let dt = args.dt.unwrap_or(0.5 * most);
    within("--time", args.time, 0.0, 1e9)?;
    if !(dt > 0.0 && dt <= most) {
        let what = format!(
            "a time step of {dt} s is unstable; above 0 and up to {most} s is accepted with --reynolds {}, --cells {}, \
             --scheme {} and --convection {}",
            args.reynolds, args.cells, args.scheme, args.convection
        );
        return Err(Error::usage(what).at("--dt"));
    }
    let steps = libm::round(args.time / dt);
    if steps > MOST_STEPS {
        return Err(Error::usage(format!("{steps} steps; up to {MOST_STEPS} are handled")).at("--time"));
    }
    let folder = OwnFolder::claim(args.out.as_deref(), "cavity")?;
    let bar = Progress::of("cavity").over(steps as u64);
    let end = cavity.run(dt, steps as u64, || bar.inc(1));
    bar.finish_and_clear();
    let end = end.map_err(|cause| Error::broken(cause.to_string()))?;
    let summary = Summary {
        reynolds: args.reynolds,
        cells: args.cells,
        lid: args.lid,
        scheme: cavity.scheme.name(),
        convection: cavity.convection.name(),
        dt,
        time: dt * end.steps as f64,
        steps: end.steps,
        largest_stable_dt: most,
        kinetic_energy: end.kinetic_energy,
        max_divergence: end.divergence,
        max_divergence_scaled: end.divergence / (args.cells as f64 * args.lid.abs()),
    };
    let text = serde_json::to_string_pretty(&summary)
        .map_err(|cause| Error::broken("cannot write a summary").because(cause))?;
    let files = [
        ("u.csv".to_owned(), line(["y", "u"], &end.u)?),
        ("v.csv".to_owned(), line(["x", "v"], &end.v)?),
        ("summary.json".to_owned(), (text + "\n").into_bytes()),
    ];
    let path = folder.fill("cavity", &files)?;
    print(&format!(
        "{} steps of {dt} s; kinetic energy {}, greatest divergence {}; wrote {}\n",
        end.steps,
        end.kinetic_energy,
        end.divergence,
        path.display()
    ));
    Ok(ExitCode::SUCCESS)
}

fn line(columns: [&str; 2], points: &[(f64, f64)]) -> Result<Vec<u8>> {
    let mut table = Table::new(columns);
    for (place, value) in points {
        table.row([(*place).into(), (*value).into()]);
    }
    table.to_csv()
}

fn within(flag: &'static str, value: f64, least: f64, most: f64) -> Result<f64> {
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    Err(Error::usage(format!("{value}; {least} to {most} is accepted")).at(flag))
}

fn named<R: Reading>(flag: &'static str, name: &str) -> Result<R> {
    R::named(name).ok_or_else(|| Error::usage(format!("`{name}`; {} are accepted", R::names())).at(flag))
}
