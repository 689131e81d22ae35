//! `snowglobe volume`: a picture of a density of your own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use ndarray::Array3;
use ndarray_npy::{ReadNpyExt, ReadableElement};
use serde::Serialize;
use snowglobe::image::{Exposure, ImageError, Photograph, ToneCurve, decode, encode, srgb_decode};
use snowglobe::lab::{Error, Result, print, set_threads};
use snowglobe::volume::{
    Camera, Density, Himeno, Octaves, Rendered, Shading, Single, Sums, VolumeError, render,
};

use super::npy::npy;
use super::own::OwnFolder;
use super::reading::reading;

const EXAMPLES: &str = "Examples:\n  snowglobe volume --density density.npy --voxel 40 --tau 0.004 --up 0,0,1 --view 0,1,0\n  \
    snowglobe volume --density cloud.npy --voxel 40 --tau 0.004 --shading octaves --camera pinhole --eye 2500,-3000,500 \
    --view 0,1,0.1 --up 0,0,1 --fov 50 --size 1280x720 --background sky.png\n  \
    snowglobe volume --density flake.npy --voxel 1e-5 --tau 2e4 --ka 0.4 --kd 0.6 --light 1,2,1\n\n\
    Arrays are [z][y][x]; the grid lies from 0,0,0 on, density is at the centres of voxels and linear between them. The \
    picture's right is the view times up; row 0 is its top. radiance.npy has rows, columns and red, green, blue.";

/// The density, the camera and the light.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// The density, 0 or more: numbers of 4 or 8 bytes, or bytes.
    #[arg(long, value_name = "F.npy")]
    density: PathBuf,
    /// Width of a voxel in m.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.0)]
    voxel: f64,
    /// Extinction in 1/m where the density is 1.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.0)]
    tau: f64,
    /// orthographic, which frames the grid exactly, or pinhole.
    #[arg(long, default_value = "orthographic")]
    camera: String,
    /// Direction of the rays, in the middle of the picture.
    #[arg(long, allow_hyphen_values = true, value_name = "X,Y,Z", default_value = "0,0,-1")]
    view: String,
    /// What is up in the picture.
    #[arg(long, allow_hyphen_values = true, value_name = "X,Y,Z", default_value = "0,1,0")]
    up: String,
    /// Where the pinhole is, in m.
    #[arg(long, allow_hyphen_values = true, value_name = "X,Y,Z")]
    eye: Option<String>,
    /// How high the pinhole's picture is, in degrees.
    #[arg(long, allow_hyphen_values = true, default_value_t = 40.0)]
    fov: f64,
    /// Width and height of the picture.
    #[arg(long, value_name = "WxH", default_value = "640x480")]
    size: String,
    /// Rays to a pixel along each side, 1 to 16.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1)]
    samples: usize,
    /// himeno (Eq. (11) of Himeno, Kenmochi & Kotani, exact in every cell), emission, single or octaves.
    #[arg(long, default_value = "himeno")]
    shading: String,
    /// Direction to the light.
    #[arg(long, allow_hyphen_values = true, value_name = "X,Y,Z", default_value = "0.4,0.8,0.45")]
    light: String,
    /// k_a of himeno.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.3)]
    ka: f64,
    /// k_d of himeno.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.7)]
    kd: f64,
    /// k_s of himeno.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.0)]
    ks: f64,
    /// n of himeno, Phong's power.
    #[arg(long, allow_hyphen_values = true, default_value_t = 10)]
    n: u32,
    /// How Eq. (11) of himeno is executed: sums=per-cell (default), or sums=as-printed, whose radiance no light bounds.
    #[arg(long)]
    reading: Vec<String>,
    /// Albedo of single and octaves.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.0)]
    albedo: f64,
    /// g of their phase function (Henyey & Greenstein): 0 scatters to all sides.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.0)]
    g: f64,
    /// A picture behind, of the same size; black by default.
    #[arg(long, value_name = "F.png")]
    background: Option<PathBuf>,
    /// Where to write; ./out/volume by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

/// White paper square to this is as bright as 1.
const SUN: f64 = std::f64::consts::PI;

#[derive(Serialize)]
struct Summary {
    voxels: [usize; 3],
    voxel: f64,
    tau: f64,
    shading: String,
    size: [usize; 2],
    rays: u64,
    cells: u64,
    mean_transmittance: f64,
    least_transmittance: f64,
    greatest_radiance: f64,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    set_threads(args.threads)?;
    let unhandled = |cause: VolumeError| Error::usage(cause.to_string());
    let size = size(&args.size)?;
    let [view, up, to_light] = [("--view", &args.view), ("--up", &args.up), ("--light", &args.light)]
        .map(|(flag, text)| three(flag, text));
    let (view, up, to_light) = (view?, up?, to_light?);
    let shading = shading(args, to_light, up)?;
    let density = density(args)?;
    let camera = match (args.camera.as_str(), &args.eye) {
        ("orthographic", _) => Camera::orthographic(&density, view, up, size),
        ("pinhole", Some(eye)) => Camera::pinhole(three("--eye", eye)?, view, up, args.fov, size),
        ("pinhole", None) => return Err(Error::usage("is missing; X,Y,Z is needed by a pinhole").at("--eye")),
        (other, _) => {
            let what = format!("`{other}`; orthographic and pinhole are accepted");
            return Err(Error::usage(what).at("--camera"));
        }
    }
    .map_err(unhandled)?;
    let background = background(args, size)?;
    let folder = OwnFolder::claim(args.out.as_deref(), "volume")?;

    let seen = render(&density, args.tau, &camera, &shading, args.samples).map_err(unhandled)?;
    let of = |pick: fn(f64, f64) -> f64, values: &mut dyn Iterator<Item = f32>| {
        values.map(f64::from).reduce(pick).unwrap_or_default()
    };
    let count = seen.transmittance.len() as f64;
    let summary = Summary {
        voxels: density.counts(),
        voxel: args.voxel,
        tau: args.tau,
        shading: args.shading.clone(),
        size,
        rays: seen.work.rays,
        cells: seen.work.cells,
        mean_transmittance: seen.transmittance.iter().map(|t| f64::from(*t)).sum::<f64>() / count,
        least_transmittance: of(f64::min, &mut seen.transmittance.iter().copied()),
        greatest_radiance: of(f64::max, &mut seen.radiance.as_flattened().iter().copied()),
    };
    let text = serde_json::to_string_pretty(&summary)
        .map_err(|cause| Error::broken("cannot write a summary").because(cause))?;
    let [width, height] = size;
    let files = [
        ("radiance.npy".to_owned(), npy(&[height, width, 3], seen.radiance.as_flattened())?),
        ("transmittance.npy".to_owned(), npy(&[height, width], &seen.transmittance)?),
        ("volume.png".to_owned(), png(&seen, &background)?),
        ("summary.json".to_owned(), (text + "\n").into_bytes()),
    ];
    let path = folder.fill("volume", &files)?;
    print(&format!(
        "{} rays through {} cells; mean transmittance {:.4}, greatest radiance {:.4}; wrote {}\n",
        summary.rays,
        summary.cells,
        summary.mean_transmittance,
        summary.greatest_radiance,
        path.display()
    ));
    Ok(ExitCode::SUCCESS)
}

fn shading(args: &Args, to_light: [f64; 3], zenith: [f64; 3]) -> Result<Shading> {
    Ok(match args.shading.as_str() {
        "himeno" => reading(&args.reading, Sums::PerCell)?.shading(Himeno {
            diffuse: args.kd,
            specular: args.ks,
            power: args.n,
            ambient: args.ka,
            to_light,
            light: [1.0; 3],
            ambient_light: [1.0; 3],
        }),
        "emission" => Shading::Emission([1.0; 3]),
        "single" => {
            Shading::Single(Single { albedo: args.albedo, g: args.g, to_sun: to_light, sun: [SUN; 3] })
        }
        "octaves" => Shading::Octaves(Octaves {
            count: 6,
            attenuation: 0.5,
            contribution: 0.5,
            eccentricity: 0.5,
            normalised: false,
            albedo: args.albedo,
            g: args.g,
            to_sun: to_light,
            sun: [SUN; 3],
            zenith,
            sky: [0.22, 0.32, 0.5],
            ground: [0.12, 0.11, 0.09],
        }),
        other => {
            let what = format!("`{other}`; himeno, emission, single and octaves are accepted");
            return Err(Error::usage(what).at("--shading"));
        }
    })
}

/// The density of a file, whatever its numbers are.
fn density(args: &Args) -> Result<Density> {
    let path: &Path = &args.density;
    let refuse = |what: String| Error::usage(what).at(path.display());
    let bytes = fs::read(path).map_err(|cause| refuse("cannot be read".to_owned()).because(cause))?;
    let array = array::<f32>(&bytes)
        .or_else(|| array::<f64>(&bytes).map(|all| all.mapv(|value| value as f32)))
        .or_else(|| array::<u8>(&bytes).map(|all| all.mapv(f32::from)));
    let Some(array) = array else {
        let what = "is no density; a .npy of three axes, [z][y][x], of f4, f8 or u1 is accepted";
        return Err(refuse(what.to_owned()));
    };
    let (z, y, x) = array.dim();
    let values = array.as_standard_layout().iter().copied().collect();
    Density::new([x, y, z], args.voxel, values).map_err(|cause| refuse(cause.to_string()))
}

fn array<T: ReadableElement>(bytes: &[u8]) -> Option<Array3<T>> {
    Array3::<T>::read_npy(bytes).ok()
}

fn size(text: &str) -> Result<[usize; 2]> {
    let both = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    both.filter(|[width, height]: &[usize; 2]| (1..=8192).contains(width) && (1..=8192).contains(height))
        .ok_or_else(|| {
            Error::usage(format!("`{text}`; WIDTHxHEIGHT up to 8192 is accepted, as 640x480")).at("--size")
        })
}

fn three(flag: &'static str, text: &str) -> Result<[f64; 3]> {
    let parts: Vec<Option<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match parts[..] {
        [Some(x), Some(y), Some(z)] if [x, y, z].iter().all(|value| value.is_finite()) => Ok([x, y, z]),
        _ => Err(Error::usage(format!("`{text}`; three numbers, X,Y,Z, are accepted")).at(flag)),
    }
}

/// The light behind, linear; none where there is no picture.
fn background(args: &Args, [width, height]: [usize; 2]) -> Result<Vec<[f64; 3]>> {
    let Some(path) = &args.background else { return Ok(vec![[0.0; 3]; width * height]) };
    let refuse = |what: String| Error::usage(what).at(path.display());
    let bytes = fs::read(path).map_err(|cause| refuse("cannot be read".to_owned()).because(cause))?;
    let decoded = decode(&bytes).map_err(|cause| refuse(cause.to_string()))?;
    if [decoded.width as usize, decoded.height as usize] != [width, height] {
        let what = format!(
            "is {} x {} pixels; {width} x {height}, as --size says, is accepted",
            decoded.width, decoded.height
        );
        return Err(refuse(what));
    }
    let light = |code: u8| srgb_decode(f64::from(code) / 255.0);
    Ok(decoded.rgba.iter().map(|[r, g, b, _]| [*r, *g, *b].map(light)).collect())
}

fn png(seen: &Rendered, background: &[[f64; 3]]) -> Result<Vec<u8>> {
    let broken = |cause: ImageError| Error::broken(cause.to_string());
    let over = |((radiance, left), behind): ((&[f32; 3], &f32), &[f64; 3])| {
        [0, 1, 2].map(|k| (f64::from(radiance[k]) + f64::from(*left) * behind[k]) as f32)
    };
    let pixels = seen.radiance.iter().zip(&seen.transmittance).zip(background).map(over).collect();
    let [width, height] = seen.size.map(|side| side as u32);
    let photograph = Photograph::new(width, height, pixels).map_err(broken)?;
    Ok(encode(&photograph.develop(Exposure { stops: 0.0 }, ToneCurve::Linear)))
}
