//! `snowglobe crystal`: a snow crystal grown in air of your own.

use std::path::PathBuf;
use std::process::ExitCode;

use serde::{Deserialize, Serialize};
use snowglobe::image::encode;
use snowglobe::lab::{Error, Result, print, set_threads};
use snowglobe::mesh::{Motion, Part, glb, obj, ply};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::snow::{
    Branching, Crystal, Cubes, History, Layers, Light, Over, Parameters, Relief, SnowError, Voxels, Weather,
};

use super::npy::npy;
use super::own::OwnFolder;
use super::reading::reading;
use crate::himeno::slide::{APERTURE, room, slide, view_of};

const EXAMPLES: &str = "Examples:\n  snowglobe crystal --temperature -15 --supersaturation 17 --minutes 20\n  \
    snowglobe crystal --temperature -6 --supersaturation 8 --over water --minutes 10 --element 5\n  \
    snowglobe crystal --history balloon.csv --seed 7\n\n\
    A history is a table minute,temperature_c,supersaturation_pct; between its rows air changes evenly, two rows of one \
    minute are a jump. Platelike crystals are shown along the c axis, columns across it.";

/// The air, and how the crystal is grown and shown.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Temperature, C, -60 to 0.
    #[arg(long, allow_hyphen_values = true, conflicts_with = "history", requires = "supersaturation")]
    temperature: Option<f64>,
    /// Supersaturation, per cent, of what --over says.
    #[arg(long, allow_hyphen_values = true, conflicts_with = "history", requires = "temperature")]
    supersaturation: Option<f64>,
    /// What supersaturation is over: ice or water.
    #[arg(long, default_value = "ice")]
    over: String,
    /// Minutes of growth, 0 to 1440; 15, or those of the history.
    #[arg(long, allow_hyphen_values = true)]
    minutes: Option<f64>,
    /// Air that changes: minute,temperature_c,supersaturation_pct.
    #[arg(long, value_name = "F.csv")]
    history: Option<PathBuf>,
    /// Side of an element in um, 2 to 100.
    #[arg(long, allow_hyphen_values = true, default_value_t = 10.0)]
    element: f64,
    /// How layers come about, layers=dense (default) or layers=extruded.
    #[arg(long)]
    reading: Vec<String>,
    /// Width and height of the pictures in pixels, 64 to 4096.
    #[arg(long, allow_hyphen_values = true, default_value_t = 640)]
    size: usize,
    /// Half-angle of the light's aperture in degrees, 1 to 60.
    #[arg(long, allow_hyphen_values = true, default_value_t = APERTURE)]
    aperture: f64,
    /// Where to write; ./out/crystal by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The seed.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1)]
    seed: u64,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

/// Minutes of growth where nothing says otherwise.
const MINUTES: f64 = 15.0;

#[derive(Serialize)]
struct Summary {
    habit: &'static str,
    habits: Vec<(&'static str, f64)>,
    diameter_mm: f64,
    height_mm: f64,
    spheroid_a_mm: f64,
    spheroid_c_mm: f64,
    mass_mg: f64,
    elements: usize,
    element_um: f64,
    layers: usize,
    fill: f64,
    minutes: f64,
    supersaturation_over: &'static str,
    reading: String,
    seed: u64,
    voxel_um: f64,
    voxels: [usize; 3],
}

/// A row of --history.
#[derive(Deserialize)]
struct Row {
    minute: f64,
    temperature_c: f64,
    supersaturation_pct: f64,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    set_threads(args.threads)?;
    for (flag, value, least, most) in [
        ("--element", args.element, 2.0, 100.0),
        ("--size", args.size as f64, 64.0, 4096.0),
        ("--aperture", args.aperture, 1.0, 60.0),
        ("--minutes", args.minutes.unwrap_or(MINUTES), 0.0, History::LONGEST),
    ] {
        if !(least..=most).contains(&value) {
            return Err(Error::usage(format!("{value}; {least} to {most} is accepted")).at(flag));
        }
    }
    let over = Over::named(&args.over).ok_or_else(|| {
        let accepted = Over::names();
        Error::usage(format!("`{}`; {accepted} are accepted", args.over)).at("--over")
    })?;
    let layers = reading(&args.reading, Layers::Dense)?;
    let history = history(args, over)?;
    let refuse = |cause: SnowError| Error::usage(cause.to_string());
    let parameters = Parameters { element: 1e-6 * args.element, ..Parameters::ASSUMED };
    let branching = Branching::new(&parameters).map_err(refuse)?;
    let crystal = Crystal::grow(&history, &branching, layers, Seed(args.seed)).map_err(refuse)?;
    let folder = OwnFolder::claim(args.out.as_deref(), "crystal")?;

    let (view, long) = view_of(&crystal);
    let relief = Relief::of(&crystal, view, room(&crystal, long), args.size).map_err(refuse)?;
    let cubes = Cubes::new(&crystal, 1).map_err(refuse)?;
    let voxels = Voxels::new(&[(&cubes, nalgebra::Isometry3::identity())], 1).map_err(refuse)?;
    let habit = crystal.name();
    let summary = Summary {
        habit,
        habits: crystal.habits().iter().map(|(habit, seconds)| (habit.name(), seconds / 60.0)).collect(),
        diameter_mm: 1e3 * crystal.diameter(),
        height_mm: 1e3 * crystal.height(),
        spheroid_a_mm: 1e3 * crystal.axes().a,
        spheroid_c_mm: 1e3 * crystal.axes().c,
        mass_mg: 1e6 * crystal.mass(),
        elements: crystal.count(),
        element_um: args.element,
        layers: 2 * crystal.layers().len() - 1,
        fill: crystal.fill(),
        minutes: history.minutes(),
        supersaturation_over: over.name(),
        reading: format!("{}={}", Layers::QUANTITY, layers.name()),
        seed: args.seed,
        voxel_um: 1e6 * voxels.side(),
        voxels: voxels.counts(),
    };
    let text = serde_json::to_string_pretty(&summary)
        .map_err(|cause| Error::broken("cannot write a summary").because(cause))?;
    let aperture = args.aperture.to_radians();
    let caption = caption(args, &history, over);
    let picture = |light: Light| {
        slide(&crystal, view, room(&crystal, long), args.size, light, &caption)
            .map(|picture| encode(&picture))
    };
    let mesh = crystal.mesh();
    let part = Part {
        name: "crystal".to_owned(),
        mesh: mesh.clone(),
        colour: [0.86, 0.93, 1.0],
        pose: ([0.0; 3], [0.0, 0.0, 0.0, 1.0]),
    };
    let thickness: Vec<f32> = relief.thickness().iter().map(|metres| *metres as f32).collect();
    let [nx, ny, nz] = voxels.counts();
    let files = [
        ("crystal.png".to_owned(), picture(Light::BrightField(aperture))?),
        ("coloured.png".to_owned(), picture(Light::Coloured(aperture))?),
        ("thickness.npy".to_owned(), npy(&[args.size; 2], &thickness)?),
        ("voxels.npy".to_owned(), npy(&[nz, ny, nx], &voxels.density())?),
        ("crystal.obj".to_owned(), obj(&mesh).into_bytes()),
        ("crystal.ply".to_owned(), ply(&mesh)),
        ("crystal.glb".to_owned(), glb(&[part], &Motion::default())),
        ("summary.json".to_owned(), (text + "\n").into_bytes()),
    ];
    let path = folder.fill("crystal", &files)?;
    print(&format!(
        "a {habit}, {:.2} mm across and {:.3} mm high, {:.3} ug; wrote {}\n",
        summary.diameter_mm,
        summary.height_mm,
        1e3 * summary.mass_mg,
        path.display()
    ));
    Ok(ExitCode::SUCCESS)
}

fn history(args: &Args, over: Over) -> Result<History> {
    let Some(path) = &args.history else {
        let (Some(temperature), Some(supersaturation)) = (args.temperature, args.supersaturation) else {
            let what = "are missing; both, or --history, are needed";
            return Err(Error::usage(what).at("--temperature and --supersaturation"));
        };
        let minutes = args.minutes.unwrap_or(MINUTES);
        return History::constant(temperature, supersaturation / 100.0, over, minutes)
            .map_err(|cause| Error::usage(cause.to_string()));
    };
    let refuse = |what: String| Error::usage(what).at(path.display());
    if path.is_dir() {
        return Err(refuse(
            "is a folder; a table minute,temperature_c,supersaturation_pct is accepted".to_owned(),
        ));
    }
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_path(path)
        .map_err(|cause| refuse("cannot be read".to_owned()).because(cause))?;
    let mut weather = Vec::new();
    for row in reader.deserialize() {
        let row: Row = row.map_err(|cause| {
            refuse("is no history; minute,temperature_c,supersaturation_pct is accepted".to_owned())
                .because(cause)
        })?;
        weather.push(Weather {
            minute: row.minute,
            temperature: row.temperature_c,
            supersaturation: row.supersaturation_pct / 100.0,
        });
    }
    let minutes = args.minutes.or_else(|| weather.last().map(|last| last.minute)).unwrap_or(MINUTES);
    History::new(weather, over, minutes).map_err(|cause| refuse(cause.to_string()))
}

fn caption(args: &Args, history: &History, over: Over) -> String {
    let minutes = history.minutes();
    match (args.temperature, args.supersaturation) {
        (Some(temperature), Some(supersaturation)) => {
            format!("{temperature} °C, {supersaturation} % over {}, {minutes} min", over.name())
        }
        _ => {
            let [(first, _), (last, _)] = [0.0, minutes].map(|minute| history.at(minute));
            format!("{first} to {last} °C in {minutes} min")
        }
    }
}
