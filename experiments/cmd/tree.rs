//! `snowglobe tree`: a tree in a computed wind, the paper's or a user's own.

use std::path::PathBuf;
use std::process::ExitCode;

use snowglobe::lab::{Error, Progress, Result, Table, print, set_threads};
use snowglobe::lsystem::{Spec, Structure};
use snowglobe::mesh::{Mesh, Motion, Part, glb, ply, turn_in_plane};
use snowglobe::navier_stokes::{Convection, Forcing, Scheme, WallPressure};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::tree::{
    AirSpeed, Damping, Drag, Exchange, Frame, Gravity, Parameters, Position, ReadingSet, Readings, Setting,
    SharedSymbol, Skeleton, Sway, Target, Tree, TreeError, VelocityAfterLength, papers_tree,
    physical_restoring,
};

use super::own::OwnFolder;

const EXAMPLES: &str = "Examples:\n  snowglobe tree --wind 7 --seconds 3\n  \
    snowglobe tree --wind 10 --seconds 5 --set physical --out mine\n  \
    snowglobe tree --wind 5 --seconds 2 --rules bush.toml --inflow gust.csv\n\n\
    A file of rules: axiom = \"F\", steps = 2, angle = 20, productions = [{ from = \"F\", to = \"F[+F]F[-F][F]\" }]; \
    several productions of a symbol are drawn from by their weight.";

/// The tree, the wind, the numbers of the model, and what to write.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Speed of the wind in m/s; from the right where it is negative.
    #[arg(long, allow_hyphen_values = true, default_value_t = 5.0)]
    wind: f64,
    /// How long it blows, in s.
    #[arg(long, allow_hyphen_values = true, default_value_t = 3.0)]
    seconds: f64,
    /// How the page is read: paper, physical or literal.
    #[arg(long, default_value = "paper")]
    set: String,
    /// A reading of one place instead of the set's, `enum=variant`; may be repeated.
    #[arg(long)]
    reading: Vec<String>,
    /// The paper's tree as it is derived, or with coincident links merged: derived or merged.
    #[arg(long, default_value = "derived")]
    tree: String,
    /// Rules of a tree of your own.
    #[arg(long, value_name = "F.toml")]
    rules: Option<PathBuf>,
    /// Speed of the inflow over time, with the columns `t,u`; instead of --wind.
    #[arg(long, value_name = "F.csv")]
    inflow: Option<PathBuf>,
    /// Time between the rows of motion.csv, in s.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.01)]
    every: f64,
    /// Height of the tree in m.
    #[arg(long, allow_hyphen_values = true, default_value_t = 6.67)]
    height: f64,
    /// Density of wood in kg/m3.
    #[arg(long, allow_hyphen_values = true, default_value_t = 230.0)]
    density: f64,
    /// Radius of the stem in m.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.05)]
    radius: f64,
    /// Radius of the last branches in m.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.02)]
    radius_tip: f64,
    /// Restoring coefficient in N/m2; the paper's 10000, or in the physical set twice the critical one.
    #[arg(long, allow_hyphen_values = true)]
    restoring: Option<f64>,
    /// Wind coefficient in kg/(m2 s).
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.08)]
    wind_coefficient: f64,
    /// What the wind loses at a node.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.1)]
    branch_on_wind: f64,
    /// What is left of a velocity after a step.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.83)]
    damping: f64,
    /// What of the restoring force acts back on the parent.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.8)]
    reaction: f64,
    /// Viscosity of air in m2/s.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1.5e-5)]
    viscosity: f64,
    /// Cells of air along each side of the box.
    #[arg(long, allow_hyphen_values = true, default_value_t = 32)]
    cells: usize,
    /// Width and height of the box of air in m.
    #[arg(long, allow_hyphen_values = true, default_value_t = 10.0)]
    size: f64,
    /// Time step in s.
    #[arg(long, allow_hyphen_values = true, default_value_t = 0.002)]
    dt: f64,
    /// Pictures a second.
    #[arg(long, allow_hyphen_values = true, default_value_t = 10.0)]
    frames: f64,
    /// Width of the pictures in pixels.
    #[arg(long, allow_hyphen_values = true, default_value_t = 480)]
    width: u32,
    /// Where to write; ./out/tree by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The seed, where rules leave something to chance.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1)]
    seed: u64,
    /// Threads; as many as there are processors by default.
    #[arg(long, allow_hyphen_values = true)]
    threads: Option<usize>,
}

/// The most steps one run takes.
const MOST_STEPS: f64 = 1e7;

pub fn run(args: &Args) -> Result<ExitCode> {
    set_threads(args.threads)?;
    for (flag, value, least, most) in [
        ("--wind", args.wind, -1e3, 1e3),
        ("--seconds", args.seconds, 0.0, 1e5),
        ("--dt", args.dt, 1e-7, 1.0),
        ("--every", args.every, 1e-6, 1e5),
        ("--frames", args.frames, 0.0, 1e3),
        ("--width", f64::from(args.width), 64.0, 4096.0),
        ("--size", args.size, 0.1, 1e5),
        ("--cells", args.cells as f64, 4.0, 2048.0),
    ] {
        if !(least..=most).contains(&value) {
            return Err(Error::usage(format!("{value}; {least} to {most} is accepted")).at(flag));
        }
    }
    let steps = libm::round(args.seconds / args.dt);
    if steps > MOST_STEPS || steps * f64::from(args.width) > 1e11 {
        return Err(Error::usage(format!("{steps} steps; up to {MOST_STEPS} are handled")).at("--seconds"));
    }
    let readings = readings(args)?;
    let structure = structure(args)?;
    let structure = match args.tree.as_str() {
        "derived" => structure,
        "merged" => structure.merged(),
        other => return Err(Error::usage(format!("`{other}`; derived or merged is accepted")).at("--tree")),
    };
    let skeleton = Skeleton::new(&structure, args.height, [args.radius, args.radius_tip]).map_err(usage)?;
    let mut given = Parameters {
        density: args.density,
        wind: args.wind_coefficient,
        branch_on_wind: args.branch_on_wind,
        damping: args.damping,
        reaction: args.reaction,
        ..Parameters::PRINTED
    };
    given.restoring = match (args.restoring, args.set.as_str()) {
        (Some(restoring), _) => restoring,
        (None, "physical") => physical_restoring(&skeleton, given, readings).map_err(usage)?,
        (None, _) => given.restoring,
    };
    let inflow = inflow(args)?;
    let setting = Setting {
        size: [args.size; 2],
        cells: [args.cells; 2],
        viscosity: args.viscosity,
        wind: inflow.as_ref().map_or(args.wind, |inflow| strongest(inflow)),
        dt: args.dt,
    };
    let tree = Tree::new(skeleton, given, readings).map_err(usage)?;
    let mut sway = Sway::new(tree, setting).map_err(usage)?;
    let folder = OwnFolder::claim(args.out.as_deref(), "tree")?;
    let files = blow(args, &mut sway, steps as u64, inflow.as_deref())?;
    let path = folder.fill("tree", &files)?;
    let (bend, counted) = (sway.tree().bend(), sway.counted());
    print(&format!(
        "after {} s the tip has moved by ({}, {}) m, the links have turned by {} degrees in the mean; {} of {} times a \
         node was outside of the air; restoring coefficient {}; wrote {}\n",
        sway.time(),
        bend.tip.x,
        bend.tip.y,
        bend.mean_angle,
        counted.outside,
        counted.inside + counted.outside,
        given.restoring,
        path.display()
    ));
    Ok(ExitCode::SUCCESS)
}

/// Lets the wind blow, and makes the files.
fn blow(
    args: &Args,
    sway: &mut Sway,
    steps: u64,
    inflow: Option<&[(f64, f64)]>,
) -> Result<Vec<(String, Vec<u8>)>> {
    let mut table = Table::new(["t", "tip_x", "tip_y", "mean_bend_deg", "centroid_x", "centroid_y"]);
    let mut files = Vec::new();
    let bar = Progress::of("tree").over(steps);
    let (mut row, mut picture) = (0_u64, 0_u64);
    let links = links(sway.tree());
    let mut motion = Motion { times: Vec::new(), poses: vec![Vec::new(); links.len()] };
    for step in 0..=steps {
        let time = step as f64 * args.dt;
        if time >= row as f64 * args.every - 1e-9 {
            let bend = sway.tree().bend();
            let cells = [time, bend.tip.x, bend.tip.y, bend.mean_angle, bend.centroid.x, bend.centroid.y];
            table.row(cells.map(Into::into));
            row = libm::floor(time / args.every + 1e-9) as u64 + 1;
        }
        if args.frames > 0.0 && time >= picture as f64 / args.frames - 1e-9 {
            let frame = Frame::of(sway, format!("{time:.2} s, {} m/s", args.wind));
            files.push((format!("frame-{picture:05}.svg"), frame.svg(args.width).into_bytes()));
            motion.times.push(time as f32);
            for (poses, (node, _)) in motion.poses.iter_mut().zip(&links) {
                let (place, turn) = pose(sway.tree(), *node);
                poses.push((place.map(|x| x as f32), turn.map(|x| x as f32)));
            }
            picture += 1;
        }
        if step < steps {
            if let Some(inflow) = inflow {
                sway.set_wind(at(inflow, time));
            }
            sway.step().map_err(|cause| Error::broken(cause.to_string()))?;
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let mut whole = Mesh::default();
    let mut parts = Vec::with_capacity(links.len());
    for (node, mesh) in links {
        let (place, turn) = pose(sway.tree(), node);
        whole.add(&mesh, place, turn);
        let pose = (place.map(|x| x as f32), turn.map(|x| x as f32));
        parts.push(Part { name: format!("link-{node}"), mesh, colour: WOOD, pose });
    }
    files.insert(0, ("motion.csv".to_owned(), table.to_csv()?));
    files.push(("tree.ply".to_owned(), ply(&whole)));
    files.push(("tree.glb".to_owned(), glb(&parts, &motion)));
    Ok(files)
}

/// Bark, linear red, green and blue.
const WOOD: [f32; 3] = [0.09, 0.05, 0.02];
/// Sides of a link in a mesh.
const SIDES: u32 = 12;

/// Each link with its mesh, as thick at its beginning as the one before it ends.
fn links(tree: &Tree) -> Vec<(usize, Mesh)> {
    let skeleton = tree.skeleton();
    let link = |node: usize| {
        let parent = skeleton.parent(node)?;
        let radius = skeleton.radius(node);
        let before = if skeleton.parent(parent).is_some() { skeleton.radius(parent) } else { radius };
        Some((node, Mesh::stick(skeleton.length(node), [before.min(1.3 * radius), radius], SIDES)))
    };
    (0..skeleton.nodes()).filter_map(link).collect()
}

/// Where a link begins and how it is turned.
fn pose(tree: &Tree, node: usize) -> ([f64; 3], [f64; 4]) {
    let from = tree.skeleton().parent(node).map_or_else(|| tree.place(node), |parent| tree.place(parent));
    let way = tree.place(node) - from;
    ([from.x, from.y, 0.0], turn_in_plane(way.x, way.y))
}

fn structure(args: &Args) -> Result<Structure> {
    let Some(path) = &args.rules else {
        return papers_tree().map_err(|cause| Error::broken(cause.to_string()));
    };
    let at = |cause: String| Error::usage(cause).at(path.display());
    let text = std::fs::read_to_string(path).map_err(|cause| at("cannot read".into()).because(cause))?;
    let spec: Spec =
        toml::from_str(&text).map_err(|cause| at(cause.to_string().trim().replace('\n', "; ")))?;
    let word = spec.system().and_then(|system| system.derive(spec.steps, Seed(args.seed)));
    word.and_then(|word| spec.turtle(1.0).draw(&word)).map_err(|cause| at(cause.to_string()))
}

/// The inflow of a file: times that rise, speeds that all blow the same way.
fn inflow(args: &Args) -> Result<Option<Vec<(f64, f64)>>> {
    let Some(path) = &args.inflow else { return Ok(None) };
    let at = |what: String| Error::usage(what).at(path.display());
    let bytes = std::fs::read(path).map_err(|cause| at("cannot read".into()).because(cause))?;
    let table = Table::from_csv(&bytes)?;
    if table.columns != ["t", "u"] {
        return Err(at(format!("the columns are `{}`; `t,u` is accepted", table.columns.join(","))));
    }
    let mut rows: Vec<(f64, f64)> = Vec::with_capacity(table.rows.len());
    for (number, row) in table.rows.iter().enumerate() {
        let number = number + 2;
        let value = |k: usize| row[k].trim().parse::<f64>().ok().filter(|value| value.is_finite());
        let (Some(t), Some(u)) = (value(0), value(1)) else {
            return Err(at(format!("line {number} is `{}`; two numbers are accepted", row.join(","))));
        };
        if rows.last().is_some_and(|before| before.0 >= t) {
            return Err(at(format!("line {number} has t {t}; times must rise")));
        }
        if u * args.wind < 0.0 || u.abs() > 1e3 {
            return Err(at(format!(
                "line {number} has u {u}; a speed up to 1000 m/s from the side of --wind is accepted"
            )));
        }
        rows.push((t, u));
    }
    if rows.is_empty() {
        return Err(at("no row; at least one is needed".into()));
    }
    Ok(Some(rows))
}

fn strongest(inflow: &[(f64, f64)]) -> f64 {
    inflow.iter().fold(0.0, |most: f64, (_, u)| if u.abs() > most.abs() { *u } else { most })
}

/// The speed at a time: linear between the rows, and that of the first or last outside.
fn at(inflow: &[(f64, f64)], time: f64) -> f64 {
    let after = inflow.partition_point(|(t, _)| *t <= time);
    match (after.checked_sub(1).map(|k| inflow[k]), inflow.get(after)) {
        (Some((t0, u0)), Some((t1, u1))) => u0 + (u1 - u0) * (time - t0) / (t1 - t0),
        (Some((_, u)), None) => u,
        (None, Some((_, u))) => *u,
        (None, None) => 0.0,
    }
}

fn readings(args: &Args) -> Result<Readings> {
    let set = ReadingSet::named(&args.set).ok_or_else(|| {
        Error::usage(format!("`{}`; {} are accepted", args.set, ReadingSet::names())).at("--set")
    })?;
    let mut now = set.readings();
    for text in &args.reading {
        let (quantity, variant) = text.split_once('=').map_or((None, text.as_str()), |(q, v)| (Some(q), v));
        let known = [
            put(&mut now.position, quantity, variant),
            put(&mut now.damping, quantity, variant),
            put(&mut now.shared_symbol, quantity, variant),
            put(&mut now.gravity, quantity, variant),
            put(&mut now.target, quantity, variant),
            put(&mut now.air_speed, quantity, variant),
            put(&mut now.velocity, quantity, variant),
            put(&mut now.drag, quantity, variant),
            put(&mut now.exchange, quantity, variant),
            put(&mut now.scheme, quantity, variant),
            put(&mut now.convection, quantity, variant),
            put(&mut now.wall_pressure, quantity, variant),
            put(&mut now.forcing, quantity, variant),
        ];
        match known.iter().filter(|known| **known).count() {
            1 => {}
            0 => {
                let what = format!("`{text}` is no reading; accepted: {}", accepted());
                return Err(Error::usage(what).at("--reading"));
            }
            _ => {
                let what = format!("`{text}` is a reading of several places; enum={variant} is accepted");
                return Err(Error::usage(what).at("--reading"));
            }
        }
    }
    Ok(now)
}

fn put<R: Reading>(slot: &mut R, quantity: Option<&str>, variant: &str) -> bool {
    let named = R::named(variant).filter(|_| quantity.is_none_or(|q| q == R::QUANTITY));
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
        of::<Position>(),
        of::<Damping>(),
        of::<SharedSymbol>(),
        of::<Gravity>(),
        of::<Target>(),
        of::<AirSpeed>(),
        of::<VelocityAfterLength>(),
        of::<Drag>(),
        of::<Exchange>(),
        of::<Scheme>(),
        of::<Convection>(),
        of::<WallPressure>(),
        of::<Forcing>(),
    ]
    .join("; ")
}

fn usage(cause: TreeError) -> Error {
    Error::usage(cause.to_string())
}
