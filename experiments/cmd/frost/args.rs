//! What a user may ask of `snowglobe frost`.

use std::fs;
use std::path::{Path, PathBuf};

use snowglobe::frost::{Aim, Edge, EndOf, EndRule, Inflow, Parameters, Redraw, RingTouchingIce, TSim};
use snowglobe::hexgrid::Axial;
use snowglobe::lab::{Error, Result};
use snowglobe::optimize::Derivative;
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::sketch::{Bend, MOST_DEGREES, Placement, Sketch, read_cells, read_png_bent, read_svg_bent};

use super::shaded::Shade;

const EXAMPLES: &str = "Examples:\n  snowglobe frost --sketch leaf.svg --beta 0.3\n  \
    snowglobe frost --sketch pane.png --points 20000 --target 130 --threshold 0.4 --seed 7\n  \
    snowglobe frost --cells region.csv --start 0,0 --beta 0.35 --frames 80\n  \
    snowglobe frost --sketch night-window.svg --points 200000 --warp 60 --seed 2 --beta 0.4 --gamma 0.0003 \\\n      \
    --threshold 0.4 --steps-per-frame 40 --share 0.45 --shaded --fill\n\n\
    A sketch: in an SVG, filled paths are the region and a circle of class `start` is a start; in a PNG, any opaque \
    paint but white is the region and each pure red dot a start.";

/// The region, the starts, the parameters and readings of the model, and what to write.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// The region as a CSV of cells in axial coordinates, with the columns `q,r`.
    #[arg(long, value_name = "F.csv", required_unless_present = "sketch", conflicts_with = "sketch")]
    cells: Option<PathBuf>,
    /// The region as a drawing.
    #[arg(long, value_name = "F.png|svg")]
    sketch: Option<PathBuf>,
    /// Distance between cells in the sketch's units; by default 80 cells fit across the region.
    #[arg(long, allow_hyphen_values = true, conflicts_with_all = ["points", "cells"])]
    spacing: Option<f64>,
    /// Number of cells, as nearly as a spacing gives it.
    #[arg(long, value_name = "N", allow_hyphen_values = true, conflicts_with = "cells")]
    points: Option<usize>,
    /// Beyond the page: bends the lattice smoothly and one-to-one, by so many degrees at the most (below 85), so that
    /// the arms of all starts are no longer parallel. Neighbours stay neighbours and the rule does not change; cells
    /// become larger here and smaller there. The seed decides where; 0 bends nothing.
    #[arg(
        long,
        value_name = "DEGREES",
        allow_hyphen_values = true,
        default_value_t = 0.0,
        conflicts_with = "cells"
    )]
    pub warp: f64,
    /// A start, in axial coordinates; may be repeated; instead of the sketch's own.
    #[arg(long, value_name = "Q,R", allow_hyphen_values = true, required_unless_present = "sketch")]
    start: Vec<String>,
    /// The vapour at first, below 1; needed without --target, and where the search begins with it (0.25).
    #[arg(long, allow_hyphen_values = true, required_unless_present = "target")]
    beta: Option<f64>,
    /// The weight of diffusion, 0 to 2.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.0)]
    alpha: f64,
    /// What a receptive cell gains in a step.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.005)]
    gamma: f64,
    /// The share of ice's neighbours that miss their gamma, 0 to 1.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.0)]
    threshold: f64,
    /// Steps of the solver in a frame.
    #[arg(long, allow_hyphen_values = true, default_value_t = 12)]
    steps_per_frame: u32,
    /// The share of cells that are ice when the film ends.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.9)]
    share: f64,
    /// Of which cells that share is: all of them, or the region's border.
    #[arg(long, value_name = "all|border", default_value = "all")]
    share_of: String,
    /// A reading, `enum=variant` or the variant alone; may be repeated. Of inflow: as-printed, reiter-gated (default),
    /// passive-is-vapour, passive-diffuses, only-ice-hidden; of t-sim: whole, interpolated (default); of derivative:
    /// secant (default), forward, central; and those of the three flags below.
    #[arg(long)]
    reading: Vec<String>,
    /// How often r is drawn: frame (default), step, cell.
    #[arg(long)]
    redraw: Option<String>,
    /// The edge: reflecting (default), held.
    #[arg(long)]
    edge: Option<String>,
    /// What a reflecting point shows that touches ice: zero (default), mean.
    #[arg(long)]
    ring_touching_ice: Option<String>,
    /// Run exactly so many frames; by default to the end frame, or until it cannot be reached.
    #[arg(long, allow_hyphen_values = true)]
    pub frames: Option<u64>,
    /// Frames after which a film that has not ended is given up.
    #[arg(long, allow_hyphen_values = true, default_value_t = 10_000)]
    frame_limit: u64,
    /// Find the initial value whose film ends in this frame.
    #[arg(long, value_name = "FRAME", allow_hyphen_values = true)]
    target: Option<f64>,
    /// Frames by which the end may miss the target.
    #[arg(long, allow_hyphen_values = true, default_value_t = 4.0)]
    tolerance: f64,
    /// The step length of the descent.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.0e-6)]
    eta: f64,
    /// The difference in beta by which its derivative is taken.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.01)]
    difference: f64,
    /// Width of the pictures in pixels.
    #[arg(long, allow_hyphen_values = true, default_value_t = 640)]
    pub width: u32,
    #[command(flatten)]
    pub shade: Shade,
    /// Where to write; ./out/frost by default.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// The seed.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1)]
    pub seed: u64,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    pub threads: Option<usize>,
}

/// The largest frame number that a 16-bit picture of ages can hold.
const MOST_FRAMES: u64 = 65_000;

/// A request that makes sense.
pub struct Request<'a> {
    args: &'a Args,
    pub parameters: Parameters,
    pub rule: EndRule,
    pub t_sim: TSim,
    pub seed: Seed,
    pub frame_limit: u64,
    /// The target frame and how it is sought.
    pub aim: Option<(f64, Aim)>,
}

impl<'a> Request<'a> {
    pub fn of(args: &'a Args) -> Result<Self> {
        let mut readings = Readings::default();
        for text in &args.reading {
            readings.read(text)?;
        }
        for (flag, quantity, value) in [
            ("--redraw", Redraw::QUANTITY, &args.redraw),
            ("--edge", Edge::QUANTITY, &args.edge),
            ("--ring-touching-ice", RingTouchingIce::QUANTITY, &args.ring_touching_ice),
        ] {
            if let Some(value) = value {
                readings.read(&format!("{quantity}={value}")).map_err(|error| error.at(flag))?;
            }
        }
        let parameters = Parameters {
            alpha: args.alpha,
            beta: args.beta.unwrap_or(0.25),
            gamma: args.gamma,
            threshold: args.threshold,
            steps_per_frame: args.steps_per_frame,
            inflow: readings.inflow,
            redraw: readings.redraw,
            edge: readings.edge,
            ring_touching_ice: readings.ring,
        };
        parameters.check().map_err(super::usage)?;
        let of = match args.share_of.as_str() {
            "all" => EndOf::AllCells,
            "border" => EndOf::Border,
            other => {
                return Err(Error::usage(format!("`{other}`; all or border are accepted")).at("--share-of"));
            }
        };
        for (flag, frames) in [("--frames", args.frames), ("--frame-limit", Some(args.frame_limit))] {
            if let Some(frames) = frames.filter(|frames| *frames > MOST_FRAMES) {
                return Err(
                    Error::usage(format!("{frames} frames; up to {MOST_FRAMES} are handled")).at(flag)
                );
            }
        }
        if !(16..=4096).contains(&args.width) {
            return Err(Error::usage(format!("{} pixels; 16 to 4096 are accepted", args.width)).at("--width"));
        }
        Ok(Self {
            args,
            parameters,
            rule: EndRule { share: args.share, of },
            t_sim: readings.t_sim,
            seed: Seed(args.seed),
            frame_limit: args.frame_limit,
            aim: args
                .target
                .map(|target| aim(args, target, parameters.beta, readings.derivative))
                .transpose()?,
        })
    }

    /// The sketch and the starts on it.
    pub fn sketch(&self) -> Result<(Sketch, Vec<Axial>)> {
        let sketch = match (&self.args.cells, &self.args.sketch) {
            (Some(path), _) => {
                let region = read_cells(&read(path)?);
                Sketch::of_cells(region.map_err(|cause| Error::usage(cause.to_string()).at(path.display()))?)
            }
            (None, Some(path)) => {
                let kind = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
                let sketch = match kind.as_str() {
                    "svg" => read_svg_bent(&read(path)?, self.placement(), self.bend()?),
                    "png" => read_png_bent(&read(path)?, self.placement(), self.bend()?),
                    _ => return Err(Error::usage("a sketch is a file .svg or .png").at(path.display())),
                };
                sketch.map_err(|cause| Error::usage(cause.to_string()).at(path.display()))?
            }
            (None, None) => return Err(Error::usage("a region is needed: --cells or --sketch")),
        };
        let given = self.args.start.iter().map(|text| start(text)).collect::<Result<Vec<_>>>()?;
        let starts = if given.is_empty() { sketch.starts.clone() } else { given };
        if starts.is_empty() {
            return Err(Error::usage(
                "no start; mark one in the sketch (SVG: a circle of class `start`; PNG: a pure red dot) or give \
                 --start Q,R",
            ));
        }
        Ok((sketch, starts))
    }

    /// How the lattice is bent, if it is.
    fn bend(&self) -> Result<Option<Bend>> {
        let degrees = self.args.warp;
        if !(0.0..=MOST_DEGREES).contains(&degrees) {
            let what = format!("{degrees} degrees; 0 to {MOST_DEGREES} are accepted");
            return Err(Error::usage(what).at("--warp"));
        }
        Ok((degrees > 0.0).then_some(Bend { degrees, seed: self.seed }))
    }

    fn placement(&self) -> Placement {
        match (self.args.spacing, self.args.points) {
            (Some(spacing), _) => Placement::Spacing(spacing),
            (None, Some(points)) => Placement::Points(points),
            (None, None) => Placement::default(),
        }
    }
}

fn aim(args: &Args, target: f64, start: f64, derivative: Derivative) -> Result<(f64, Aim)> {
    for (flag, value, least, most) in [
        ("--target", target, 1.0, args.frame_limit as f64),
        ("--tolerance", args.tolerance, 0.0, 1e4),
        ("--eta", args.eta, f64::MIN_POSITIVE, 1.0),
        ("--difference", args.difference, 1e-9, 0.5),
        ("--beta", start, 1e-3, 0.999),
    ] {
        if !(least..=most).contains(&value) {
            return Err(
                Error::usage(format!("{value}; {least} to {most} is accepted with --target")).at(flag)
            );
        }
    }
    let aim = Aim {
        start,
        eta: args.eta,
        tolerance: args.tolerance,
        derivative,
        h: args.difference,
        iterations: 20,
    };
    Ok((target, aim))
}

fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).map_err(|cause| Error::usage("cannot read").at(path.display()).because(cause))
}

fn start(text: &str) -> Result<Axial> {
    let whole = |part: &str| part.trim().parse::<i32>().ok();
    text.split_once(',')
        .and_then(|(q, r)| Some(Axial::new(whole(q)?, whole(r)?)))
        .ok_or_else(|| Error::usage(format!("`{text}`; two whole numbers Q,R are accepted")).at("--start"))
}

/// The readings that a film can be made under.
struct Readings {
    inflow: Inflow,
    redraw: Redraw,
    edge: Edge,
    ring: RingTouchingIce,
    t_sim: TSim,
    derivative: Derivative,
}

impl Default for Readings {
    fn default() -> Self {
        Self {
            inflow: Inflow::ReiterGated,
            redraw: Redraw::Frame,
            edge: Edge::Reflecting,
            ring: RingTouchingIce::Zero,
            t_sim: TSim::Interpolated,
            derivative: Derivative::Secant,
        }
    }
}

impl Readings {
    /// Takes `enum=variant`, or a variant alone: no two quantities share one.
    fn read(&mut self, text: &str) -> Result<()> {
        let (quantity, variant) = text.split_once('=').map_or((None, text), |(q, v)| (Some(q), v));
        let known = set(&mut self.inflow, quantity, variant)
            || set(&mut self.redraw, quantity, variant)
            || set(&mut self.edge, quantity, variant)
            || set(&mut self.ring, quantity, variant)
            || set(&mut self.t_sim, quantity, variant)
            || set(&mut self.derivative, quantity, variant);
        if known {
            return Ok(());
        }
        let accepted = [
            accepted::<Inflow>(),
            accepted::<Redraw>(),
            accepted::<Edge>(),
            accepted::<RingTouchingIce>(),
            accepted::<TSim>(),
            accepted::<Derivative>(),
        ];
        let of_quantity = accepted.iter().find(|(name, _)| Some(*name) == quantity);
        let choices = match of_quantity {
            Some((name, variants)) => format!("{name}={variants}"),
            None => accepted.map(|(name, variants)| format!("{name}={variants}")).join("; "),
        };
        Err(Error::usage(format!("`{text}` is no reading; accepted: {choices}")).at("--reading"))
    }
}

fn set<R: Reading>(slot: &mut R, quantity: Option<&str>, variant: &str) -> bool {
    let named = R::named(variant).filter(|_| quantity.is_none_or(|q| q == R::QUANTITY));
    if let Some(reading) = named {
        *slot = reading;
    }
    named.is_some()
}

fn accepted<R: Reading>() -> (&'static str, String) {
    (R::QUANTITY, R::names().replace(", ", "|"))
}
