//! `snowglobe contour-cloud`: a cloud, and a mountain, from contours of your own.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde::Serialize;
use snowglobe::contour_cloud::{
    Amplitude, Compositing, Contour, ContourError, Cut, Displacement, EdgeLength, Fineness, Grid, Layer,
    Passage, Patches, Plateau, Relief, Surface, SurfaceDimension, Traced, Window, dimensions, lambert,
    traced,
};
use snowglobe::image::{Grey16Alpha, Picture, decode, encode, encode_grey16_alpha, srgb_encode};
use snowglobe::lab::{Error, Result, print, set_threads};
use snowglobe::mesh::{Motion, Part, glb, ply};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::sketch::{ColourLevel, Line, read_geojson_lines, read_svg_lines};

use super::npy::npy;
use super::own::OwnFolder;
use crate::miyata::sky::Sky;

const EXAMPLES: &str = "Examples:\n  snowglobe contour-cloud --contours hills.svg\n  \
    snowglobe contour-cloud --contours hills.svg --dimension 2.3 --cut 1.5 --gamma 2 --background sky.png\n  \
    snowglobe contour-cloud --contours map.geojson --rewrites 9 --gain 0.2 --grid 1024x768\n  \
    snowglobe contour-cloud --contours hills.svg --waves 0.3,1.2,6,2 --smooth\n\n\
    A line's level is its attribute `data-level` (SVG, or --colours), or the property `level` (GeoJSON), in the unit of \
    the drawing.";

/// The contours, the surface, the droplets, and what to write.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Contours of equal density, each with its level.
    #[arg(long, value_name = "F.svg|F.geojson")]
    contours: PathBuf,
    /// Levels that colours of SVG lines stand for: `#ff0000=1,#00ff00=2`.
    #[arg(long)]
    colours: Option<String>,
    /// D of the surface, 2 to 3; measured on every contour by default.
    #[arg(long, allow_hyphen_values = true)]
    dimension: Option<f64>,
    /// How often every patch is divided for height.npy and the meshes, 0 to 14.
    #[arg(long, allow_hyphen_values = true, default_value_t = 7)]
    rewrites: u32,
    /// What displacements are multiplied by.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.0)]
    gain: f64,
    /// How the page is read, `enum=variant`; may be repeated.
    #[arg(long)]
    reading: Vec<String>,
    /// The level at which the droplets end below; the lowest contour by default.
    #[arg(long, allow_hyphen_values = true)]
    cut: Option<f64>,
    /// A tilted cut instead: A,B,C,D of A x + B y + C z + D = 0.
    #[arg(long, allow_hyphen_values = true, value_name = "A,B,C,D")]
    plane: Option<String>,
    /// A wavy cut instead, Eq. (10), around --cut: A,B,ALPHA,BETA.
    #[arg(long, allow_hyphen_values = true, value_name = "A,B,ALPHA,BETA")]
    waves: Option<String>,
    /// What of the light is taken away per unit; 2 over the height of the contours by default.
    #[arg(long, allow_hyphen_values = true)]
    gamma: Option<f64>,
    /// A picture behind the cloud; a clear sky by default.
    #[arg(long, value_name = "F.png")]
    background: Option<PathBuf>,
    /// Numbers along x and y of height.npy; 2^N + 1 each by default, 32769 at most.
    #[arg(long, value_name = "WxH")]
    grid: Option<String>,
    /// Width and height of the pictures; the background's, or 1024 along the longer side.
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// For pictures to be looked at: displaces a smooth ground through the contours, in patches of one size.
    #[arg(long)]
    smooth: bool,
    /// How far the polygon through the feature points may be off a contour; a 2000th of the drawing by default.
    #[arg(long, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Where to write; ./out/contour-cloud by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The seed.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1)]
    seed: u64,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

/// The most triangles that are put into a mesh.
const MOST_TRIANGLES: u64 = 1 << 20;

/// How the page is read.
#[derive(Clone, Copy)]
struct Readings {
    amplitude: Amplitude,
    edge_length: EdgeLength,
    plateau: Plateau,
    passage: Passage,
    compositing: Compositing,
    surface_dimension: SurfaceDimension,
}

#[derive(Serialize)]
struct Summary {
    contours: Vec<Measured>,
    low: [f64; 2],
    high: [f64; 2],
    triangles: usize,
    flat_triangles: usize,
    raised_points: usize,
    repeated_points: usize,
    rewrites: u32,
    mesh_rewrites: u32,
    gain: f64,
    readings: Vec<String>,
    gamma: f64,
    cut: String,
    least_height: f64,
    greatest_height: f64,
    heights_png: [f64; 2],
    cover: f64,
    mean_f: f64,
}

#[derive(Serialize)]
struct Measured {
    name: String,
    level: f64,
    points: usize,
    feature_points: usize,
    line_dimension: Option<f64>,
    dimension: f64,
}

/// Of the patches between the contours.
struct Counted {
    triangles: usize,
    flat: usize,
    raised: usize,
    repeated: usize,
}

impl Counted {
    fn of(patches: &Patches) -> Self {
        let (triangles, flat) = (patches.triangles.len(), patches.flat.len());
        Self { triangles, flat, raised: patches.raised, repeated: patches.repeated }
    }
}

pub fn run(args: &Args) -> Result<ExitCode> {
    set_threads(args.threads)?;
    for (flag, value, least, most) in [
        ("--dimension", args.dimension.unwrap_or(2.0), 2.0, 3.0),
        ("--rewrites", f64::from(args.rewrites), 0.0, 14.0),
        ("--gain", args.gain, -1e6, 1e6),
        ("--cut", args.cut.unwrap_or(0.0), -1e9, 1e9),
        ("--gamma", args.gamma.unwrap_or(0.0), 0.0, 1e9),
        ("--tolerance", args.tolerance.unwrap_or(0.0), 0.0, 1e9),
    ] {
        if !(least..=most).contains(&value) {
            return Err(Error::usage(format!("{value}; {least} to {most} is accepted")).at(flag));
        }
    }
    let readings = readings(args)?;
    let lines = lines(args)?;
    let (given, mut measured) = contours(args, &lines, readings);
    let at = |cause: ContourError| Error::usage(cause.to_string()).at(args.contours.display());
    let Traced { contours, patches } =
        traced(&given, tolerance(args, &lines), readings.plateau).map_err(at)?;
    for (measured, contour) in measured.iter_mut().zip(&contours) {
        measured.feature_points = contour.points.len();
    }
    let displacement = Displacement {
        amplitude: readings.amplitude,
        edge_length: readings.edge_length,
        gain: args.gain,
        moment: Seed(args.seed).stream("miyata: Gauss").at(0),
    };
    let (low, high) = patches.bounds();
    let counted = Counted::of(&patches);
    let surface = if args.smooth {
        let longer = f64::max(high[0] - low[0], high[1] - low[1]);
        Surface::smooth(&patches, longer / 12.0, displacement)
    } else {
        Surface { patches, relief: Relief::Patches, displacement }
    };
    let levels =
        |pick: fn(f64, f64) -> f64| contours.iter().map(|c| c.level).reduce(pick).unwrap_or_default();
    let (lowest, highest) = (levels(f64::min), levels(f64::max));
    let cut = cut(args, lowest)?;
    let gamma = args.gamma.unwrap_or(if highest > lowest { 2.0 / (highest - lowest) } else { 1.0 });
    let layer = Layer { cut, passage: readings.passage, gamma };
    let side = (1_usize << args.rewrites) + 1;
    let counts = args.grid.as_deref().map_or(Ok([side, side]), |text| pair(text, "--grid"))?;
    let grid = Grid { low, high, counts };
    grid.check().map_err(|cause| Error::usage(cause.to_string()).at("--grid"))?;
    let (size, background) = background(args, [high[0] - low[0], high[1] - low[1]])?;
    let folder = OwnFolder::claim(args.out.as_deref(), "contour-cloud")?;

    let heights = grid
        .heights(&surface, args.rewrites)
        .map_err(|cause| Error::usage(cause.to_string()).at("--grid"))?;
    let of = |pick: fn(f64, f64) -> f64| heights.iter().copied().filter(|h| !h.is_nan()).reduce(pick);
    let range = [of(f64::min).unwrap_or_default(), of(f64::max).unwrap_or_default()];
    let window = Window::around((low, high), size);
    let cloud = layer.seen_from_above(&surface, &window, Fineness::Pixels(1.0));
    let f: Vec<f64> = cloud.pixels.iter().map(|[f]| f.clamp(0.0, 1.0)).collect();
    let mountain = window.show(&surface, Fineness::Pixels(1.0), |corners| [lambert(corners, SUN)]);
    let patch_count = surface.patches.triangles.len();
    let mesh_rewrites =
        (0..=args.rewrites).rev().find(|n| patch_count as u64 * 4_u64.pow(*n) <= MOST_TRIANGLES).unwrap_or(0);
    let mesh = surface.mesh(mesh_rewrites);
    let summary = Summary {
        contours: measured,
        low,
        high,
        triangles: counted.triangles,
        flat_triangles: counted.flat,
        raised_points: counted.raised,
        repeated_points: counted.repeated,
        rewrites: args.rewrites,
        mesh_rewrites,
        gain: args.gain,
        readings: readings.named(),
        gamma,
        cut: format!("{cut:?}"),
        least_height: range[0],
        greatest_height: range[1],
        heights_png: range,
        cover: mean(&cloud.cover),
        mean_f: mean(&f),
    };
    let text = serde_json::to_string_pretty(&summary)
        .map_err(|cause| Error::broken("cannot write a summary").because(cause))?;
    let [width, height] = size.map(|side| side as u32);
    let grey = |values: &mut dyn Iterator<Item = f64>| {
        let pixels = values.flat_map(|value| [libm::round(255.0 * value.clamp(0.0, 1.0)) as u8; 3]);
        Picture::from_rgb(width, height, pixels.collect()).map_err(picture_error)
    };
    let part =
        Part { name: "surface".to_owned(), mesh, colour: [0.5; 3], pose: ([0.0; 3], [0.0, 0.0, 0.0, 1.0]) };
    let files = [
        ("height.npy".to_owned(), npy(&[counts[1], counts[0]], &heights)?),
        ("height.png".to_owned(), deep(counts, &heights, range)?),
        ("surface.ply".to_owned(), ply(&part.mesh)),
        ("surface.glb".to_owned(), glb(&[part], &Motion::default())),
        ("cloud.png".to_owned(), encode(&grey(&mut f.iter().copied())?)),
        (
            "mountain.png".to_owned(),
            encode(&grey(&mut mountain.pixels.iter().map(|[light]| srgb_encode(light.max(0.0))))?),
        ),
        ("composite.png".to_owned(), encode(&composite(&background, &f, readings.compositing)?)),
        ("summary.json".to_owned(), (text + "\n").into_bytes()),
    ];
    let path = folder.fill("contour-cloud", &files)?;
    print(&format!(
        "{} contours, {} patches ({} flat), heights {} to {}; droplets cover a mean f of {:.4}; wrote {}\n",
        contours.len(),
        counted.triangles,
        counted.flat,
        range[0],
        range[1],
        mean(&f),
        path.display()
    ));
    Ok(ExitCode::SUCCESS)
}

/// Light from the upper left, as on maps: x, y (down) and height.
const SUN: [f64; 3] = [-0.5, -0.5, std::f64::consts::FRAC_1_SQRT_2];

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn picture_error(cause: snowglobe::image::ImageError) -> Error {
    Error::usage(cause.to_string()).at("--size")
}

/// Heights from the least, 0, to the greatest, 65535; clear where there are none.
fn deep([columns, rows]: [usize; 2], heights: &[f64], [least, most]: [f64; 2]) -> Result<Vec<u8>> {
    let code = |height: &f64| libm::round((height - least) / (most - least).max(1e-300) * 65535.0) as u16;
    let alpha = heights.iter().map(|height| if height.is_nan() { 0 } else { u16::MAX });
    let matte =
        Grey16Alpha::new(columns as u32, rows as u32, heights.iter().map(code).collect(), alpha.collect());
    Ok(encode_grey16_alpha(&matte.map_err(|cause| Error::usage(cause.to_string()).at("--grid"))?))
}

/// The cloud before a background: (6) of §3.3.
fn composite(background: &Picture, f: &[f64], how: Compositing) -> Result<Picture> {
    let pixels =
        background.pixels().iter().zip(f).flat_map(|(behind, f)| {
            behind.map(|code| libm::round(how.over(255.0 * f, f64::from(code))) as u8)
        });
    Picture::from_rgb(background.width(), background.height(), pixels.collect()).map_err(picture_error)
}

/// The size of the pictures, and what is behind.
fn background(args: &Args, extent: [f64; 2]) -> Result<([usize; 2], Picture)> {
    let asked = args.size.as_deref().map(|text| pair(text, "--size")).transpose()?;
    if let Some([width, height]) = asked
        && (width.min(height) < 16 || width.max(height) > 8192)
    {
        return Err(Error::usage(format!("{width}x{height}; 16 to 8192 is accepted")).at("--size"));
    }
    let Some(path) = &args.background else {
        let longer = f64::max(extent[0], extent[1]);
        let fitted = extent.map(|side| libm::round(1024.0 * side / longer).max(16.0) as usize);
        let size = asked.unwrap_or(fitted);
        let sky = Sky::DAY.picture(size[0] as u32, size[1] as u32).map_err(picture_error)?;
        return Ok((size, sky));
    };
    let at = |what: String| Error::usage(what).at(path.display());
    let bytes = std::fs::read(path).map_err(|cause| at("cannot read".into()).because(cause))?;
    let decoded = decode(&bytes).map_err(|cause| at(cause.to_string()))?;
    let size = [decoded.width as usize, decoded.height as usize];
    if asked.is_some_and(|asked| asked != size) {
        return Err(at(format!("is {} x {} pixels; --size must be the same", size[0], size[1])));
    }
    if size[0].max(size[1]) > 8192 || size[0].min(size[1]) < 16 {
        return Err(at(format!("is {} x {} pixels; 16 to 8192 is accepted", size[0], size[1])));
    }
    let pixels = decoded.rgba.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
    let picture = Picture::from_rgb(decoded.width, decoded.height, pixels).map_err(picture_error)?;
    Ok((size, picture))
}

fn lines(args: &Args) -> Result<Vec<Line>> {
    let path: &Path = &args.contours;
    let at = |what: String| Error::usage(what).at(path.display());
    let bytes = std::fs::read(path).map_err(|cause| at("cannot read".into()).because(cause))?;
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("svg") => {
            // Chords of curves stray less than the polygon through the feature points may.
            let tolerance = args.tolerance.filter(|t| *t > 0.0).map_or(0.05, |t| 0.25 * t);
            read_svg_lines(&bytes, tolerance, &colours(args)?).map_err(|cause| at(cause.to_string()))
        }
        Some("geojson" | "json") => read_geojson_lines(&bytes).map_err(|cause| at(cause.to_string())),
        _ => Err(at("the name ends in neither .svg nor .geojson".into())),
    }
}

fn colours(args: &Args) -> Result<Vec<ColourLevel>> {
    let entry = |text: &str| {
        let (colour, level) = text.trim().split_once('=')?;
        let hex = colour.trim().strip_prefix('#').filter(|hex| hex.len() == 6 && hex.is_ascii())?;
        let part = |k: usize| u8::from_str_radix(&hex[2 * k..2 * k + 2], 16).ok();
        let level = level.trim().parse().ok().filter(|level: &f64| level.abs() <= 1e9)?;
        Some(ColourLevel { colour: [part(0)?, part(1)?, part(2)?], level })
    };
    let all = args.colours.iter().flat_map(|table| table.split(','));
    all.map(|text| {
        entry(text)
            .ok_or_else(|| Error::usage(format!("`{text}`; #rrggbb=LEVEL is accepted")).at("--colours"))
    })
    .collect()
}

/// The contours, each with its D.
fn contours(args: &Args, lines: &[Line], readings: Readings) -> (Vec<Contour>, Vec<Measured>) {
    let curves: Vec<(&[[f64; 2]], bool)> =
        lines.iter().map(|line| (line.points.as_slice(), line.closed)).collect();
    let measured = dimensions(&curves);
    let mut contours = Vec::with_capacity(lines.len());
    let mut table = Vec::with_capacity(lines.len());
    for (line, of_line) in lines.iter().zip(measured) {
        // What is too short to be measured is taken as smooth.
        let dimension =
            args.dimension.unwrap_or_else(|| readings.surface_dimension.of_line(of_line.unwrap_or(1.0)));
        table.push(Measured {
            name: line.name.clone(),
            level: line.level,
            points: line.points.len(),
            feature_points: 0,
            line_dimension: of_line,
            dimension,
        });
        let (name, level, closed) = (line.name.clone(), line.level, line.closed);
        contours.push(Contour { name, level, dimension, points: line.points.clone(), closed });
    }
    (contours, table)
}

/// How far the polygons may be off the lines.
fn tolerance(args: &Args, lines: &[Line]) -> f64 {
    let of = |pick: fn(f64, f64) -> f64, axis: usize| {
        lines.iter().flat_map(|line| &line.points).map(|p| p[axis]).reduce(pick).unwrap_or_default()
    };
    let extent = [0, 1].map(|axis| of(f64::max, axis) - of(f64::min, axis));
    args.tolerance.unwrap_or(f64::max(extent[0], extent[1]) / 2000.0)
}

fn cut(args: &Args, lowest: f64) -> Result<Cut> {
    let level = args.cut.unwrap_or(lowest);
    let four = |text: &str, flag: &'static str| -> Result<[f64; 4]> {
        let numbers: Vec<f64> = text.split(',').filter_map(|part| part.trim().parse().ok()).collect();
        <[f64; 4]>::try_from(numbers)
            .ok()
            .filter(|all| text.split(',').count() == 4 && all.iter().all(|x| x.abs() <= 1e9))
            .ok_or_else(|| Error::usage(format!("`{text}`; four numbers up to 1e9 are accepted")).at(flag))
    };
    match (&args.plane, &args.waves) {
        (Some(_), Some(_)) => Err(Error::usage("a cut is tilted or wavy, not both").at("--plane")),
        (Some(text), None) => {
            let abcd = four(text, "--plane")?;
            if abcd[2] == 0.0 {
                return Err(Error::usage("C is 0: the plane is upright; another C is accepted").at("--plane"));
            }
            Ok(Cut::Plane { abcd })
        }
        (None, Some(text)) => {
            let [a, b, alpha, beta] = four(text, "--waves")?;
            Ok(Cut::Waves { a, b, alpha, beta, level })
        }
        (None, None) => Ok(Cut::Level { h: level }),
    }
}

fn pair(text: &str, flag: &'static str) -> Result<[usize; 2]> {
    text.split_once('x')
        .and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]))
        .ok_or_else(|| Error::usage(format!("`{text}`; WIDTHxHEIGHT is accepted, as 640x480")).at(flag))
}

impl Readings {
    fn named(self) -> Vec<String> {
        fn of<R: Reading>(reading: R) -> String {
            format!("{}={}", R::QUANTITY, reading.name())
        }
        vec![
            of(self.amplitude),
            of(self.edge_length),
            of(self.plateau),
            of(self.passage),
            of(self.compositing),
            of(self.surface_dimension),
        ]
    }
}

fn readings(args: &Args) -> Result<Readings> {
    let mut now = Readings {
        amplitude: Amplitude::ThreeMinusD,
        edge_length: EdgeLength::Original,
        plateau: Plateau::Raised,
        passage: Passage::Above,
        compositing: Compositing::AsPrinted,
        surface_dimension: SurfaceDimension::PlusOne,
    };
    for text in &args.reading {
        let put = text.split_once('=').is_some_and(|(quantity, variant)| {
            put(&mut now.amplitude, quantity, variant)
                || put(&mut now.edge_length, quantity, variant)
                || put(&mut now.plateau, quantity, variant)
                || put(&mut now.passage, quantity, variant)
                || put(&mut now.compositing, quantity, variant)
                || put(&mut now.surface_dimension, quantity, variant)
        });
        if !put {
            let what = format!("`{text}` is no reading; accepted: {}", accepted());
            return Err(Error::usage(what).at("--reading"));
        }
    }
    Ok(now)
}

fn put<R: Reading>(slot: &mut R, quantity: &str, variant: &str) -> bool {
    let named = R::named(variant).filter(|_| quantity == R::QUANTITY);
    if let Some(reading) = named {
        *slot = reading;
    }
    named.is_some()
}

fn accepted() -> String {
    fn of<R: Reading>() -> String {
        format!("{}={}", R::QUANTITY, R::names().replace(", ", "|"))
    }
    [
        of::<Amplitude>(),
        of::<EdgeLength>(),
        of::<Plateau>(),
        of::<Passage>(),
        of::<Compositing>(),
        of::<SurfaceDimension>(),
    ]
    .join("; ")
}
