//! `snowglobe snow`: a still of falling snow before a picture of your own.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde::Serialize;
use snowglobe::image::{Exposure, ImageError, Photograph, ToneCurve, decode, encode, srgb_decode};
use snowglobe::lab::{Error, Result, print, set_threads};
use snowglobe::mesh::ply;
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::snow::flake::Assembly;
use snowglobe::snow::still::{FULL_FRAME, Flying, Lens, picture};
use snowglobe::snow::{Over, SnowError, saturation};

use super::npy::npy;
use super::own::OwnFolder;
use super::reading::reading;
use crate::himeno::stage::{Settings, Stage, background, looking, placed};

const EXAMPLES: &str = "Examples:\n  snowglobe snow --flakes 1000 --size 640x480 --spp 64\n  \
    snowglobe snow --background garden.png --temperature -2 --rate 3 --f-number 4 --shutter 0.01\n  \
    snowglobe snow --size 1920x1080 --veil 30000 --seed 7\n\n\
    Diameters follow Gunn & Marshall (1958) at the rate; flakes are as many as are asked for, as near as they would be at that \
    rate. A veil is more of them, behind. Without --background there is a winter wood of our own.";

/// The snow, the camera, and what is behind.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Flakes whose bounding spheres meet the view, 0 to 1000000.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1000)]
    flakes: usize,
    /// More flakes behind them, 0 to 1000000.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0)]
    veil: usize,
    /// Pixels across and down, 16 to 4096 each.
    #[arg(long, value_name = "WxH", default_value = "640x480")]
    size: String,
    /// Samples of a pixel, 1 to 4096.
    #[arg(long, allow_hyphen_values = true, default_value_t = 16)]
    spp: usize,
    /// Temperature in which the crystals grew, C, -30 to -1.
    #[arg(long, allow_hyphen_values = true, default_value_t = -15.0)]
    temperature: f64,
    /// Supersaturation in which they grew, per cent, above 0 to 40; nearly saturated over water by default.
    #[arg(long, allow_hyphen_values = true)]
    supersaturation: Option<f64>,
    /// What supersaturation is over: ice or water.
    #[arg(long, default_value = "ice")]
    over: String,
    /// Rate of the snowfall, mm of water an hour, 0.1 to 50.
    #[arg(long, allow_hyphen_values = true, default_value_t = 8.0)]
    rate: f64,
    /// The smallest melted diameter, mm, 0.1 to 3.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.0)]
    smallest: f64,
    /// How flakes of many crystals come about, assembly=one-by-one (default) or assembly=flake-to-flake.
    #[arg(long)]
    reading: Vec<String>,
    /// Focal length, mm, on a sensor 36 mm wide, 5 to 1000.
    #[arg(long, allow_hyphen_values = true, default_value_t = 38.0)]
    focal: f64,
    /// f-number, 0.7 to 64.
    #[arg(long, allow_hyphen_values = true, default_value_t = 11.0)]
    f_number: f64,
    /// Distance of what is sharp, m, 0.1 to 1000, and above the focal length.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.3)]
    focus: f64,
    /// Seconds for which the shutter is open, 0 to 10.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.002)]
    shutter: f64,
    /// The nearest flake, m, 0.05 to 100.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.3)]
    near: f64,
    /// How the air moves, to the right, up, and towards the camera, m/s.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, default_value = "0.35,0,0.1")]
    wind: String,
    /// A picture behind the flakes; it is fitted to the size.
    #[arg(long, value_name = "F.png")]
    background: Option<PathBuf>,
    /// How bright white flakes are, 0.01 to 10 of what a display shows at most; as the brightest tenth of the background by
    /// default, and 0.3 at least.
    #[arg(long, allow_hyphen_values = true)]
    white: Option<f64>,
    /// Where to write; ./out/snow by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The seed.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1)]
    seed: u64,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

#[derive(Serialize)]
struct Summary {
    flakes: usize,
    visible: usize,
    veil: usize,
    nearest_m: f64,
    farthest_m: f64,
    farthest_of_veil_m: Option<f64>,
    flakes_per_m3: f64,
    coverage: f64,
    templates: usize,
    crystals: usize,
    samples_per_pixel: usize,
    rays: u64,
    extinction_per_m: f64,
    element_um: f64,
    k_d: f64,
    k_s: f64,
    n: u32,
    k_a: f64,
    i_0: [f64; 3],
    i_a: [f64; 3],
    to_light: [f64; 3],
    focal_mm: f64,
    f_number: f64,
    focus_m: f64,
    shutter_s: f64,
    sensor_mm: f64,
    reading: String,
    seed: u64,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    set_threads(args.threads)?;
    let settings = settings(args)?;
    let assembly = reading(&args.reading, Assembly::OneByOne)?;
    let refuse = |cause: SnowError| Error::usage(cause.to_string());
    let seed = Seed(args.seed);
    let camera = looking(settings.lens, settings.size).map_err(refuse)?;
    let (behind, snow) = match &args.background {
        Some(path) => fitted(path, settings.size)?,
        None => background(&camera, &settings.lens, seed)?,
    };
    let snow = args.white.map_or(snow, |white| [white; 3]);
    let air = |cause: SnowError| Error::usage(cause.to_string()).at("--temperature and --supersaturation");
    let stage = Stage::new(settings, assembly, snow, seed).map_err(air)?;
    let flakes = stage.flakes(args.flakes, seed).map_err(refuse)?;
    let reach = [args.flakes, args.flakes + args.veil].map(|count| stage.reach(count));
    let veil = if args.veil == 0 {
        Vec::new()
    } else {
        let seed = Seed(args.seed.wrapping_add(1));
        stage.shower.before(&stage.camera, &stage.catalogue, reach, args.veil, seed).map_err(refuse)?
    };
    let folder = OwnFolder::claim(args.out.as_deref(), "snow")?;
    let all = [placed(&flakes), placed(&veil)].concat();
    let still = picture(&stage.scene(&all), &stage.camera, &behind, args.spp, seed).map_err(refuse)?;
    let [width, height] = still.size;
    let broken = |cause: ImageError| Error::broken(cause.to_string());
    let photograph = Photograph::new(width as u32, height as u32, still.radiance.clone()).map_err(broken)?;
    let png = encode(&photograph.develop(Exposure { stops: 0.0 }, ToneCurve::Linear));
    let covered: f64 = still.coverage.iter().map(|coverage| f64::from(*coverage)).sum();
    let summary = Summary {
        flakes: flakes.len(),
        visible: still.visible,
        veil: veil.len(),
        nearest_m: settings.near,
        farthest_m: reach[0],
        farthest_of_veil_m: (args.veil > 0).then_some(reach[1]),
        flakes_per_m3: stage.shower.sizes.number_density(),
        coverage: covered / still.coverage.len() as f64,
        templates: stage.catalogue.flakes().len(),
        crystals: stage.catalogue.crystals().len(),
        samples_per_pixel: args.spp,
        rays: still.work.samples,
        extinction_per_m: settings.extinction,
        element_um: 1e6 * settings.element,
        k_d: stage.light.diffuse,
        k_s: stage.light.specular,
        n: stage.light.power,
        k_a: stage.light.ambient,
        i_0: stage.light.light,
        i_a: stage.light.ambient_light,
        to_light: stage.light.to_light,
        focal_mm: args.focal,
        f_number: args.f_number,
        focus_m: args.focus,
        shutter_s: args.shutter,
        sensor_mm: 1e3 * FULL_FRAME,
        reading: format!("{}={}", Assembly::QUANTITY, assembly.name()),
        seed: args.seed,
    };
    let text = serde_json::to_string_pretty(&summary)
        .map_err(|cause| Error::broken("cannot write a summary").because(cause))?;
    let mut files = vec![
        ("snow.png".to_owned(), png),
        ("radiance.npy".to_owned(), npy(&[height, width, 3], still.radiance.as_flattened())?),
        ("coverage.npy".to_owned(), npy(&[height, width], &still.coverage)?),
        ("flakes.csv".to_owned(), table(&flakes).into_bytes()),
        ("templates.csv".to_owned(), templates(&stage).into_bytes()),
    ];
    if !veil.is_empty() {
        files.push(("veil.csv".to_owned(), table(&veil).into_bytes()));
    }
    for (number, crystal) in stage.catalogue.crystals().iter().enumerate() {
        files.push((format!("crystal-{number}.ply"), ply(&crystal.crystal().mesh())));
    }
    files.push(("summary.json".to_owned(), (text + "\n").into_bytes()));
    let path = folder.fill("snow", &files)?;
    print(&format!(
        "{} flakes to {:.2} m, {:.2} % of the picture covered; wrote {}\n",
        flakes.len(),
        reach[0],
        100.0 * summary.coverage,
        path.display()
    ));
    Ok(ExitCode::SUCCESS)
}

fn settings(args: &Args) -> Result<Settings> {
    let size = args
        .size
        .split_once('x')
        .and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]))
        .filter(|size: &[usize; 2]| size.iter().all(|side| (16..=4096).contains(side)))
        .ok_or_else(|| {
            Error::usage(format!("`{}`; WxH with 16 to 4096 each is accepted", args.size)).at("--size")
        })?;
    let wind: Vec<f64> = args.wind.split(',').filter_map(|part| part.trim().parse().ok()).collect();
    let wind = <[f64; 3]>::try_from(wind)
        .ok()
        .filter(|wind| args.wind.split(',').count() == 3 && wind.iter().all(|speed| speed.abs() <= 100.0))
        .ok_or_else(|| {
            Error::usage(format!("`{}`; X,Y,Z of at most 100 m/s is accepted", args.wind)).at("--wind")
        })?;
    let over = Over::named(&args.over).ok_or_else(|| {
        let accepted = Over::names();
        Error::usage(format!("`{}`; {accepted} are accepted", args.over)).at("--over")
    })?;
    let per_cent = args.supersaturation.unwrap_or_else(|| match over {
        Over::Ice => 93.0 * saturation::water_saturation(args.temperature.clamp(-60.0, 0.0)),
        Over::Water => 1.0,
    });
    let focal = 1e-3 * args.focal;
    for (flag, value, least, most) in [
        ("--flakes", args.flakes as f64, 0.0, 1e6),
        ("--veil", args.veil as f64, 0.0, 1e6),
        ("--spp", args.spp as f64, 1.0, 4096.0),
        ("--temperature", args.temperature, -30.0, -1.0),
        ("--supersaturation", per_cent, 0.01, 40.0),
        ("--rate", args.rate, 0.1, 50.0),
        ("--smallest", args.smallest, 0.1, 3.0),
        ("--focal", args.focal, 5.0, 1000.0),
        ("--f-number", args.f_number, 0.7, 64.0),
        ("--focus", args.focus, (1.1 * focal).max(0.1), 1000.0),
        ("--shutter", args.shutter, 0.0, 10.0),
        ("--near", args.near, 0.05, 100.0),
        ("--white", args.white.unwrap_or(1.0), 0.01, 10.0),
    ] {
        if !(least..=most).contains(&value) {
            return Err(Error::usage(format!("{value}; {least} to {most} is accepted")).at(flag));
        }
    }
    Ok(Settings {
        temperature: args.temperature,
        supersaturation: per_cent / 100.0,
        over,
        rate: args.rate,
        melted: [args.smallest, 6.0],
        size,
        lens: Lens {
            focal,
            number: args.f_number,
            focus: args.focus,
            sensor: FULL_FRAME,
            shutter: args.shutter,
        },
        near: args.near,
        wind,
        ..Settings::ASSUMED
    })
}

/// A picture behind, cut to the shape of ours and brought to its size: a mean of its pixels where it is larger, between them
/// where it is smaller. And how bright its snow is: what nine tenths of it are darker than.
fn fitted(path: &Path, size: [usize; 2]) -> Result<(Vec<[f32; 3]>, [f64; 3])> {
    let bytes = std::fs::read(path)
        .map_err(|cause| Error::usage("cannot be read").at(path.display()).because(cause))?;
    let decoded = decode(&bytes).map_err(|cause| Error::usage(cause.to_string()).at(path.display()))?;
    let own = [decoded.width, decoded.height].map(|side| side as usize);
    let own_light: Vec<[f64; 3]> = decoded
        .rgba
        .iter()
        .map(|pixel| [0, 1, 2].map(|channel| srgb_decode(f64::from(pixel[channel]) / 255.0)))
        .collect();
    // Pixels of the picture for one of ours, in both directions alike.
    let step = [0, 1].map(|axis| own[axis] as f64 / size[axis] as f64);
    let step = step[0].min(step[1]);
    let taps = |k: usize, axis: usize| -> Vec<(usize, f64)> {
        let first = 0.5 * (own[axis] as f64 - step * size[axis] as f64) + step * k as f64;
        // A box as wide as our pixel, or as theirs if that is wider: then it is linear between their middles.
        let wide = step.max(1.0);
        let from = first + 0.5 * (step - wide);
        let last = own[axis] - 1;
        let range = from.floor() as i64..=(from + wide).ceil() as i64;
        let share = |at: i64| (from + wide).min((at + 1) as f64) - from.max(at as f64);
        range.map(|at| ((at.max(0) as usize).min(last), share(at).max(0.0) / wide)).collect()
    };
    let columns: Vec<_> = (0..size[0]).map(|k| taps(k, 0)).collect();
    let mut light = Vec::with_capacity(size[0] * size[1]);
    for row in 0..size[1] {
        let rows = taps(row, 1);
        for column in &columns {
            let mut sum = [0.0; 3];
            for (y, down) in &rows {
                for (x, across) in column {
                    let pixel = own_light[y * own[0] + x];
                    sum.iter_mut().zip(pixel).for_each(|(sum, light)| *sum += down * across * light);
                }
            }
            light.push(sum.map(|sum| sum as f32));
        }
    }
    let mut green: Vec<(f32, usize)> = light.iter().enumerate().map(|(k, rgb)| (rgb[1], k)).collect();
    green.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let bright = light[green[green.len() * 9 / 10].1];
    // Flakes are to be seen before a dark picture, too.
    let snow = bright.map(|channel| f64::from(channel).max(0.3));
    Ok((light, snow))
}

/// Where flakes are and how they move.
fn table(flakes: &[Flying]) -> String {
    let mut text = String::from("frame,id,template,x,y,z,qw,qx,qy,qz,vx,vy,vz,diameter_mm\n");
    for (id, Flying { placed, diameter }) in flakes.iter().enumerate() {
        let (at, turn, velocity) = (placed.at, placed.turn, placed.velocity);
        let _ = writeln!(
            text,
            "0,{id},{},{},{},{},{},{},{},{},{},{},{},{}",
            placed.template,
            at.x,
            at.y,
            at.z,
            turn.w,
            turn.i,
            turn.j,
            turn.k,
            velocity.x,
            velocity.y,
            velocity.z,
            1e3 * diameter
        );
    }
    text
}

/// Crystals of each template: a flake is drawn as many times as large as its template as their diameters say.
fn templates(stage: &Stage) -> String {
    let mut text = String::from("template,diameter_mm,mass_mg,member,crystal,x,y,z,qw,qx,qy,qz\n");
    let catalogue = &stage.catalogue;
    for (number, flake) in catalogue.flakes().iter().enumerate() {
        let centre = flake.centre(catalogue.crystals());
        let mass = 1e6 * flake.mass(catalogue.crystals());
        for (member, part) in flake.members.iter().enumerate() {
            let (at, turn) = (part.pose.translation.vector - centre.coords, part.pose.rotation);
            let _ = writeln!(
                text,
                "{number},{},{mass},{member},{},{},{},{},{},{},{},{}",
                1e3 * catalogue.diameters()[number],
                part.template,
                at.x,
                at.y,
                at.z,
                turn.w,
                turn.i,
                turn.j,
                turn.k
            );
        }
    }
    text
}
