//! `snowglobe automaton`: clouds of the cellular automaton, from chance or from a state of your own.

mod pictures;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use ndarray::Array3;
use ndarray_npy::ReadNpyExt;
use serde::{Deserialize, Serialize};
use snowglobe::automaton_cloud::{
    Activation, Brackets, Chance, Field, Injection, Interpolation, Lock, Metaballs, Packed, Point, Points,
    Rules, Smoothing,
};
use snowglobe::fieldfile::{self, FieldError};
use snowglobe::lab::{Error, Progress, Result, Table, print, set_threads};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;

use self::pictures::{Film, Look};
use super::npy::npy;
use super::own::OwnFolder;

const EXAMPLES: &str = "Examples:\n  snowglobe automaton --size 128,128,48 --steps 60\n  \
    snowglobe automaton --size 96,96,40 --steps 80 --start-hum 0.4 --p-ext 0.002 --t-ext 8\n  \
    snowglobe automaton --size 128,128,48 --steps 60 --points points.csv --interpolation gaussian --width 12\n  \
    snowglobe automaton --hum hum.npy --act act.npy --steps 20 --reading brackets=as-printed\n\n\
    Axes: x = i, y = j, z = k, up is increasing z; arrays are [z][y][x]. A step applies Eq. (1) to (5), then what is injected \
    comes on top.";

/// The lattice, the rules, and what is set to 1 on the way.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Cells along x, y and z; those of --hum by default.
    #[arg(long, value_name = "X,Y,Z")]
    size: Option<String>,
    /// Steps, 0 to 100000.
    #[arg(long, allow_hyphen_values = true)]
    steps: u64,
    /// T_ext: steps for which cloud that has come does not change, 0 to 255.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0)]
    t_ext: u8,
    /// Probability that vapour comes to a cell, in each step.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.004)]
    p_hum: f64,
    /// Probability that a cell is activated, in each step.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.0002)]
    p_act: f64,
    /// Probability that the cloud of a cell begins to vanish, in each step.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.001)]
    p_ext: f64,
    /// The same of vapour at the start; 0.3 by default.
    #[arg(long, allow_hyphen_values = true)]
    start_hum: Option<f64>,
    /// The same of activation at the start; 0.001 by default.
    #[arg(long, allow_hyphen_values = true)]
    start_act: Option<f64>,
    /// The same of vanishing at the start; 0 by default.
    #[arg(long, allow_hyphen_values = true)]
    start_ext: Option<f64>,
    /// Probabilities in each step, the start included, at points that may move: step,x,y,z,p_hum,p_act,p_ext, places in
    /// cells.
    #[arg(long, value_name = "F.csv", conflicts_with_all = ["start_hum", "start_act", "start_ext", "hum"])]
    points: Option<PathBuf>,
    /// Between points: inverse-distance, or gaussian of --width.
    #[arg(long, default_value = "inverse-distance")]
    interpolation: String,
    /// Width of the Gaussian in cells.
    #[arg(long, allow_hyphen_values = true, default_value_t = 16.0)]
    width: f64,
    /// Cells between knots, from which probabilities are interpolated along the axes.
    #[arg(long, allow_hyphen_values = true, default_value_t = 4)]
    knots: usize,
    /// Vapour to begin with, 0 or 1 (u8); nothing is injected.
    #[arg(long, value_name = "F.npy", requires = "act")]
    hum: Option<PathBuf>,
    /// Activation to begin with.
    #[arg(long, value_name = "F.npy", requires = "hum")]
    act: Option<PathBuf>,
    /// Vanishing to begin with.
    #[arg(long, value_name = "F.npy", requires = "hum")]
    ext: Option<PathBuf>,
    /// How the page is read, `enum=variant`; may be repeated. Default: activation=negated, brackets=mended, lock=cld.
    #[arg(long)]
    reading: Vec<String>,
    /// D, the radius of metaballs, in cells.
    #[arg(long, allow_hyphen_values = true, default_value_t = 2.5)]
    radius: f64,
    /// Width of a cell in m.
    #[arg(long, allow_hyphen_values = true, default_value_t = 40.0)]
    voxel: f64,
    /// Extinction deep in cloud in 1/m, of the pictures.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.05)]
    extinction: f64,
    /// Frames of the animation, 0 to 2000; 0 for none. By default 24, and none of more than 1048576 cells.
    #[arg(long, allow_hyphen_values = true)]
    frames: Option<u64>,
    /// Where to write; ./out/automaton by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The seed.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1)]
    seed: u64,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

/// At the start, where nothing else is said.
const START: [f64; 3] = [0.3, 0.001, 0.0];
/// Cells of the command: a density of a quarter of a gibibyte.
const MOST_CELLS: usize = 1 << 26;
/// Cells of which there is a film without being asked for.
const MOST_FILMED: usize = 1 << 20;
const FRAMES: u64 = 24;

#[derive(Serialize)]
struct Summary {
    size: [usize; 3],
    steps: u64,
    t_ext: u8,
    seed: u64,
    readings: Vec<String>,
    cover: f64,
    greatest_cover: f64,
    radius: f64,
    voxel: f64,
    greatest_density: f64,
    density_deep_in_cloud: f64,
}

/// A row of --points.
#[derive(Deserialize)]
struct Row {
    step: f64,
    x: f64,
    y: f64,
    z: f64,
    p_hum: f64,
    p_act: f64,
    p_ext: f64,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    set_threads(args.threads)?;
    for (flag, value, least, most) in [
        ("--steps", args.steps as f64, 0.0, 100_000.0),
        ("--p-hum", args.p_hum, 0.0, 1.0),
        ("--p-act", args.p_act, 0.0, 1.0),
        ("--p-ext", args.p_ext, 0.0, 1.0),
        ("--start-hum", args.start_hum.unwrap_or(0.0), 0.0, 1.0),
        ("--start-act", args.start_act.unwrap_or(0.0), 0.0, 1.0),
        ("--start-ext", args.start_ext.unwrap_or(0.0), 0.0, 1.0),
        ("--width", args.width, 0.1, 1e6),
        ("--knots", args.knots as f64, 1.0, 1e6),
        ("--radius", args.radius, 0.5, 32.0),
        ("--voxel", args.voxel, 2e-5, 1e9),
        ("--extinction", args.extinction, 0.0, 1e9),
        ("--frames", args.frames.unwrap_or(0) as f64, 0.0, 2000.0),
    ] {
        if !(least..=most).contains(&value) {
            return Err(Error::usage(format!("{value}; {least} to {most} is accepted")).at(flag));
        }
    }
    let rules = rules(args)?;
    let given = given(args)?;
    let size = size(args, &given)?;
    let injections = injections(args)?;
    let mut clouds =
        Packed::new(size, rules).map_err(|cause| Error::usage(cause.to_string()).at("--size"))?;
    for (field, path, values) in &given {
        let values = values.as_slice().unwrap_or_default();
        clouds.set(*field, values).map_err(|cause| Error::usage(cause.to_string()).at(path.display()))?;
    }
    let folder = OwnFolder::claim(args.out.as_deref(), "automaton")?;

    let balls = Metaballs { counts: size, radius: args.radius };
    let look = Look { balls, voxel: args.voxel, extinction: args.extinction };
    let filmed = size.iter().product::<usize>() <= MOST_FILMED;
    let mut film = Film::new(look, args.steps, args.frames.unwrap_or(if filmed { FRAMES } else { 0 }));
    let mut cover = Table::new(["t", "cover"]);
    let bar = Progress::of("automaton").over(args.steps);
    let mut greatest = 0.0_f64;
    for t in 0..=args.steps {
        if t > 0 {
            clouds.step();
            bar.inc(1);
        }
        if let Some([start, later]) = &injections {
            clouds.inject(if t == 0 { start } else { later });
        }
        greatest = greatest.max(clouds.cover());
        cover.row([(t as f64).into(), clouds.cover().into()]);
        film.see(t, &clouds)?;
    }
    bar.finish_and_clear();
    let cld = clouds.cld();
    let density = balls.density(&Metaballs::over_time(&Smoothing::Space, &[&balls.central(&cld)]));
    let summary = Summary {
        size,
        steps: args.steps,
        t_ext: args.t_ext,
        seed: args.seed,
        readings: vec![
            format!("{}={}", Activation::QUANTITY, rules.activation.name()),
            format!("{}={}", Brackets::QUANTITY, rules.brackets.name()),
            format!("{}={}", Lock::QUANTITY, rules.lock.name()),
        ],
        cover: clouds.cover(),
        greatest_cover: greatest,
        radius: args.radius,
        voxel: args.voxel,
        greatest_density: density.iter().fold(0.0, |most, rho| f64::max(most, f64::from(*rho))),
        density_deep_in_cloud: balls.whole(),
    };
    let text = serde_json::to_string_pretty(&summary)
        .map_err(|cause| Error::broken("cannot write a summary").because(cause))?;
    let field = fieldfile::Field {
        name: "density",
        counts: size,
        size: args.voxel,
        origin: [0.0; 3],
        values: &density,
    };
    let broken = |cause: FieldError| Error::broken(cause.to_string());
    let shape = [size[2], size[1], size[0]];
    let mut files = vec![
        ("cld.npy".to_owned(), npy(&shape, &cld)?),
        ("cover.csv".to_owned(), cover.to_csv()?),
        ("density.npy".to_owned(), npy(&shape, &density)?),
        ("density.vti".to_owned(), fieldfile::vti(&field).map_err(broken)?),
        ("density.vdb".to_owned(), fieldfile::vdb(&field).map_err(broken)?),
        ("cloud.png".to_owned(), look.still(&clouds)?),
        ("summary.json".to_owned(), (text + "\n").into_bytes()),
    ];
    files.extend(film.file()?.map(|film| ("animation.png".to_owned(), film)));
    let path = folder.fill("automaton", &files)?;
    print(&format!(
        "{} steps of {} x {} x {} cells; cloud in {:.3} % of them, {:.3} % at most; wrote {}\n",
        args.steps,
        size[0],
        size[1],
        size[2],
        100.0 * summary.cover,
        100.0 * greatest,
        path.display()
    ));
    Ok(ExitCode::SUCCESS)
}

fn rules(args: &Args) -> Result<Rules> {
    let mut rules = Rules {
        activation: Activation::Negated,
        brackets: Brackets::Mended,
        lock: Lock::Cld,
        lifetime: args.t_ext,
    };
    for asked in &args.reading {
        let (quantity, name) = asked.split_once('=').unwrap_or(("", asked));
        let of = |wanted: &str| quantity.is_empty() || quantity == wanted;
        let activation = Activation::named(name).filter(|_| of(Activation::QUANTITY));
        let brackets = Brackets::named(name).filter(|_| of(Brackets::QUANTITY));
        let lock = Lock::named(name).filter(|_| of(Lock::QUANTITY));
        match (activation, brackets, lock) {
            (Some(activation), None, None) => rules.activation = activation,
            (None, Some(brackets), None) => rules.brackets = brackets,
            (None, None, Some(lock)) => rules.lock = lock,
            _ => {
                let what = format!(
                    "`{asked}` is no reading, or more than one; accepted: activation={}; brackets={}; lock={}",
                    Activation::names().replace(", ", "|"),
                    Brackets::names().replace(", ", "|"),
                    Lock::names().replace(", ", "|")
                );
                return Err(Error::usage(what).at("--reading"));
            }
        }
    }
    Ok(rules)
}

type Given<'a> = (Field, &'a Path, Array3<u8>);

/// The arrays that the user gave.
fn given(args: &Args) -> Result<Vec<Given<'_>>> {
    let mut all: Vec<Given> = Vec::new();
    for (field, path) in [(Field::Hum, &args.hum), (Field::Act, &args.act), (Field::Ext, &args.ext)] {
        let Some(path) = path else { continue };
        let refuse = |what: String| Error::usage(what).at(path.display());
        let file =
            fs::File::open(path).map_err(|cause| refuse("cannot be opened".to_owned()).because(cause))?;
        let values = Array3::<u8>::read_npy(file).map_err(|cause| {
            refuse(format!(
                "no such array ({cause}); a .npy of unsigned bytes with three axes, [z][y][x], is accepted"
            ))
        })?;
        let values = values.as_standard_layout().into_owned();
        if let Some((_, first, other)) = all.first().filter(|first| first.2.dim() != values.dim()) {
            let what = format!(
                "its shape is {:?}, that of {} {:?}; the same is accepted",
                values.dim(),
                first.display(),
                other.dim()
            );
            return Err(refuse(what));
        }
        all.push((field, path, values));
    }
    Ok(all)
}

fn size(args: &Args, given: &[Given]) -> Result<[usize; 3]> {
    let of_file = given.first().map(|(_, _, values)| {
        let (z, y, x) = values.dim();
        [x, y, z]
    });
    let asked = match &args.size {
        Some(text) => {
            let parts: Vec<Option<usize>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
            let [Some(x), Some(y), Some(z)] = parts[..] else {
                let what = format!("`{text}`; three whole numbers, X,Y,Z, are accepted");
                return Err(Error::usage(what).at("--size"));
            };
            Some([x, y, z])
        }
        None => None,
    };
    let size = match (asked, of_file) {
        (Some(asked), Some(found)) if asked != found => {
            let what = format!("{asked:?}, but the arrays have {found:?} cells along x, y and z");
            return Err(Error::usage(what).at("--size"));
        }
        (Some(size), _) | (None, Some(size)) => size,
        (None, None) => return Err(Error::usage("is missing; X,Y,Z is needed without --hum").at("--size")),
    };
    let cells = size.iter().try_fold(1_usize, |all, side| all.checked_mul(*side)).unwrap_or(usize::MAX);
    if cells == 0 || cells > MOST_CELLS {
        let [x, y, z] = size;
        let what = format!("{x} x {y} x {z} cells; 1 to {MOST_CELLS} in all are accepted");
        return Err(Error::usage(what).at("--size"));
    }
    Ok(size)
}

/// What is injected at the start, and later; nothing into a state that was given.
fn injections(args: &Args) -> Result<Option<[Injection; 2]>> {
    let seed = Seed(args.seed);
    if args.hum.is_some() {
        return Ok(None);
    }
    let Some(path) = &args.points else {
        let later = [args.p_hum, args.p_act, args.p_ext];
        let asked = [args.start_hum, args.start_act, args.start_ext];
        let start = [0, 1, 2].map(|k| asked[k].unwrap_or(START[k]));
        return Ok(Some([start, later].map(|all| Injection { seed, chance: Chance::Uniform(all) })));
    };
    let refuse = |what: String| Error::usage(what).at(path.display());
    let interpolation = match args.interpolation.as_str() {
        "inverse-distance" => Interpolation::InverseDistance,
        "gaussian" => Interpolation::Gaussian(args.width),
        other => {
            let what = format!("`{other}`; inverse-distance and gaussian are accepted");
            return Err(Error::usage(what).at("--interpolation"));
        }
    };
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_path(path)
        .map_err(|cause| refuse("cannot be read".to_owned()).because(cause))?;
    let mut rows = Vec::new();
    for row in reader.deserialize() {
        let row: Row = row.map_err(|cause| {
            refuse("is no table of points; step,x,y,z,p_hum,p_act,p_ext is accepted".to_owned())
                .because(cause)
        })?;
        let point = Point { place: [row.x, row.y, row.z], chances: [row.p_hum, row.p_act, row.p_ext] };
        rows.push((row.step, point));
    }
    let points =
        Points::moving(&rows, interpolation, args.knots).map_err(|cause| refuse(cause.to_string()))?;
    let injection = Injection { seed, chance: Chance::Points(points) };
    Ok(Some([injection.clone(), injection]))
}
