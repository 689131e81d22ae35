//! Figures 4, 5, 6, 8 and 11: how the model works, drawn from what it computes.

use snowglobe::contour_cloud::{Corner, Cut, Grid, Layer, Passage, Surface, centroid, lost, transmitted};
use snowglobe::lab::{Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};

use super::draw::Drawing;
use super::setup::{CORRECTED, PAPER_SIZE, contours, hills, surface};

pub const DRAWINGS: Experiment = Experiment {
    id: "drawings",
    title: "Figures 4, 5, 6, 8 and 11: light, layer, cut and procedure",
    source: "§3, Fig. 4, 5, 6, 8, 11",
    says: "Light is lost on its way through droplets; droplets are what lies between the surface and a cutting face; mountain \
           and cloud share all steps but the last.",
    claims: &[&LAYERS, &AS_IT_IS, &PLANE],
    run,
    mutant: Mutant {
        changes: "H",
        to: 30.0,
        why: "only with H = 0 is the shape taken as it is",
        turns_red: &["miyata/drawings/as-it-is"],
    },
};

const fn same(id: &'static str, source: &'static str, says: &'static str, reason: &'static str) -> Claim {
    Claim { id, source, says, expect: Expect::AtMost(1e-12), statistic: Statistic::Each, reason, known: &[] }
}

static LAYERS: Claim = same(
    "miyata/drawings/layers",
    "Eq. (2), Fig. 4",
    "what comes out of one layer goes into the next",
    "greatest difference of I_out behind two layers, one after the other, from that behind one as long as both: rounding",
);
static AS_IT_IS: Claim = same(
    "miyata/drawings/as-it-is",
    "Eq. (9), Fig. 5",
    "with H = 0 the shape is the droplets",
    "greatest difference of f at a triangle's centre from 1 - exp(-gamma Z), 0 below: rounding",
);
static PLANE: Claim = same(
    "miyata/drawings/plane",
    "Eq. (7), (9), Fig. 8",
    "for a level plane (7) becomes (9)",
    "greatest difference of f at a triangle's centre, the cut being Z = H or 0 X + 0 Y + 2 Z - 2 H = 0: rounding",
);

const GREY: &str = "#5a6b78";
const SUNLIGHT: &str = "#c9821b";
const DROPLETS: &str = "#a9c6de";
const CUT: &str = "#a63d2f";
const INK: &str = "#222222";
const DIVISIONS: u32 = 3;

fn run(lab: &mut Lab) -> Result<()> {
    let drawn = hills(lab, 800);
    let gamma = lab.assume("gamma", 0.02, "as in Fig. 12");
    let h = lab.assume("H", 0.0, "Fig. 5: the shape as it is");
    let contours = contours(&drawn, 8.0, 2.3);
    let surface = surface(&contours, CORRECTED, 0.3, lab.seed())?;
    let mut triangles = Vec::new();
    surface.triangles(DIVISIONS, &mut |corners| triangles.push(*corners));

    let (mut layers, mut as_it_is, mut plane) = (0.0_f64, 0.0_f64, 0.0_f64);
    for k in 0..=100 {
        let (first, second) = (f64::from(k), f64::from(100 - k));
        let behind = transmitted(transmitted(1.0, gamma, first), gamma, second);
        layers = layers.max((behind - transmitted(1.0, gamma, first + second)).abs());
    }
    let layer = |cut| Layer { cut, passage: Passage::Above, gamma };
    let (level, as_plane) = (layer(Cut::Level { h }), layer(Cut::Plane { abcd: [0.0, 0.0, 2.0, -2.0 * h] }));
    for corners in &triangles {
        let [_, _, z] = centroid(corners);
        as_it_is = as_it_is.max((level.lost(corners) - lost(gamma, z.max(0.0))).abs());
        plane = plane.max((level.lost(corners) - as_plane.lost(corners)).abs());
    }
    lab.found(&LAYERS, layers);
    lab.found(&AS_IT_IS, as_it_is);
    lab.found(&PLANE, plane);

    lab.keep(
        "figure-4",
        "Fig. 4 re-run: light on its way through a layer, its strength as its width",
        light(gamma),
    )?;
    let section = Section::of(&surface, &triangles)?;
    for (name, caption, cut, ways) in [
        ("figure-5", "Fig. 5 re-run: the shape itself as the droplets", Cut::Level { h }, false),
        (
            "figure-6",
            "Fig. 6 re-run: droplets between the shape and a cutting face P, L from M to N",
            Cut::Waves { a: 14.0, b: 0.0, alpha: 0.045, beta: 0.0, level: 10.0 },
            true,
        ),
        (
            "figure-8",
            "Fig. 8 re-run: the cutting face is a plane",
            Cut::Plane { abcd: [-0.06, 0.0, 1.0, 12.0] },
            true,
        ),
    ] {
        lab.keep(name, caption, section.drawing(&layer(cut), ways))?;
    }
    let given: usize = drawn.iter().map(|line| line.points.len()).sum();
    let kept: usize = contours.iter().map(|contour| contour.points.len()).sum();
    let counts = [drawn.len(), given, kept, surface.patches.triangles.len(), triangles.len()];
    let mut table = Table::new(["contours", "points", "feature_points", "patches", "triangles"]);
    table.row(counts.map(Into::into));
    lab.keep("counts", "What each step of Fig. 11 hands on, in this run", table)?;
    lab.keep("figure-11", "Fig. 11 re-run: the steps, and what each handed on in this run", procedure(counts))
}

/// Light through a layer.
fn light(gamma: f64) -> String {
    let mut sheet = Drawing::new([900.0, 300.0]);
    let (left, width, middle) = (230.0, 440.0, 140.0);
    let corners = [[left, 50.0], [left + width, 50.0], [left + width, 230.0], [left, 230.0]];
    sheet.line(&corners, true, GREY, 1.5, DROPLETS);
    // The beam, as wide as it is strong.
    let half = |x: f64| 45.0 * transmitted(1.0, gamma, (x - left).clamp(0.0, width) * 0.2);
    let upper = (0..=90).map(|k| 10.0 * f64::from(k)).map(|x| [x, middle - half(x)]);
    let lower = (0..=90).rev().map(|k| 10.0 * f64::from(k)).map(|x| [x, middle + half(x)]);
    sheet.line(&upper.chain(lower).collect::<Vec<_>>(), true, SUNLIGHT, 1.0, "#f2d9a8");
    for at in [120.0, 800.0] {
        arrow(&mut sheet, [at - 60.0, middle], [at + 40.0, middle], INK);
    }
    let out = transmitted(1.0, gamma, 0.2 * width);
    sheet.text([110.0, 215.0], 20.0, "I_in = 1");
    sheet.text([790.0, 215.0], 20.0, &format!("I_out = {out:.3}"));
    sheet.text([450.0, 265.0], 20.0, &format!("L = {:.0}, gamma = {gamma}", 0.2 * width));
    sheet.svg()
}

fn arrow(sheet: &mut Drawing, from: [f64; 2], to: [f64; 2], colour: &str) {
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypot(way[0], way[1]);
    let unit = way.map(|x| x / length);
    sheet.line(&[from, to], false, colour, 2.0, "none");
    let wing = |side: f64| {
        [to[0] - 9.0 * unit[0] - side * 4.0 * unit[1], to[1] - 9.0 * unit[1] + side * 4.0 * unit[0]]
    };
    sheet.line(&[to, wing(1.0), wing(-1.0)], true, colour, 1.0, colour);
}

/// A section through the surface along x, half-way up the drawing.
struct Section {
    heights: Vec<f64>,
    /// Centres of triangles at the section.
    centres: Vec<[f64; 3]>,
}

const PLACES: usize = 481;

impl Section {
    fn of(surface: &Surface, triangles: &[[Corner; 3]]) -> Result<Self> {
        let [width, height] = PAPER_SIZE;
        let grid = Grid { low: [0.0, 0.5 * height], high: [width, 0.5 * height + 1.0], counts: [PLACES, 2] };
        let heights = grid.heights(surface, DIVISIONS).map_err(|cause| Error::broken(cause.to_string()))?;
        let mut centres: Vec<[f64; 3]> =
            triangles.iter().map(centroid).filter(|m| (m[1] - 0.5 * height).abs() < 2.5).collect();
        centres.sort_by(|a, b| a[0].total_cmp(&b[0]));
        // About twenty, so that they can be told apart.
        let mut last = f64::NEG_INFINITY;
        centres.retain(|m| {
            let apart = m[0] - last >= 40.0;
            if apart {
                last = m[0];
            }
            apart
        });
        Ok(Self { heights: heights[..PLACES].to_vec(), centres })
    }

    fn drawing(&self, layer: &Layer, ways: bool) -> String {
        let [width, height] = PAPER_SIZE;
        let mut sheet = Drawing::new([width, 400.0]);
        let on = |x: f64, z: f64| [x, 290.0 - 1.4 * z];
        let x = |k: usize| width * k as f64 / (PLACES - 1) as f64;
        let cut = |x: f64| layer.cut.height([x, 0.5 * height]);
        let top: Vec<[f64; 2]> = self.heights.iter().enumerate().map(|(k, z)| on(x(k), *z)).collect();
        // What is above the cut and below the surface.
        let upper = self.heights.iter().enumerate().map(|(k, z)| on(x(k), z.max(cut(x(k)))));
        let lower = (0..PLACES).rev().map(|k| on(x(k), cut(x(k))));
        sheet.line(&upper.chain(lower).collect::<Vec<_>>(), true, "none", 0.0, DROPLETS);
        for k in 0..12 {
            let at = 60.0 + 76.0 * f64::from(k);
            arrow(&mut sheet, [at, 14.0], [at, 52.0], SUNLIGHT);
        }
        sheet.line(&top, false, INK, 2.0, "none");
        let face: Vec<[f64; 2]> = (0..PLACES).map(|k| on(x(k), cut(x(k)))).collect();
        sheet.line(&face, false, CUT, 2.0, "none");
        let lit = self.centres.iter().filter(|m| m[2] - cut(m[0]) > 4.0);
        for m in lit.filter(|_| ways) {
            let (from, to) = (on(m[0], m[2]), on(m[0], cut(m[0])));
            sheet.line(&[from, to], false, GREY, 1.0, "none");
            sheet.dot(from, 3.5, INK);
            sheet.dot(to, 3.5, CUT);
        }
        let words = if ways {
            "black: the shape, its triangles' centres M; red: the cutting face P, with N; blue: droplets"
        } else {
            "black: the shape; red: Z = 0; blue: droplets"
        };
        sheet.text([0.5 * width, 385.0], 18.0, words);
        sheet.svg()
    }
}

/// The steps for a mountain and for a cloud.
fn procedure([contours, points, kept, patches, triangles]: [usize; 5]) -> String {
    let mut sheet = Drawing::new([900.0, 640.0]);
    let step = |sheet: &mut Drawing, x: f64, y: f64, words: [&str; 2], fill: &str| {
        let corners =
            [[x - 190.0, y - 36.0], [x + 190.0, y - 36.0], [x + 190.0, y + 36.0], [x - 190.0, y + 36.0]];
        sheet.line(&corners, true, GREY, 1.5, fill);
        sheet.text([x, y - 6.0], 18.0, words[0]);
        sheet.text([x, y + 20.0], 15.0, words[1]);
    };
    let shared = [
        ["contours of equal density", &format!("{contours} lines of {points} points")],
        ["feature points, fractal dimension", &format!("{kept} points")],
        ["triangular patches", &format!("{patches} patches")],
        ["recursive subdivision, Eq. (1)", &format!("{triangles} triangles after {DIVISIONS} divisions")],
    ];
    for (k, words) in shared.into_iter().enumerate() {
        let y = 50.0 + 110.0 * k as f64;
        if k > 0 {
            arrow(&mut sheet, [450.0, y - 74.0], [450.0, y - 38.0], INK);
        }
        step(&mut sheet, 450.0, y, words, "#eef2f5");
    }
    for (x, words, fill) in [
        (230.0, ["hidden surfaces, shading", "a mountain"], "#f3ead8"),
        (670.0, ["cutting face, loss of light", "a cloud, before a background"], "#dde9f3"),
    ] {
        arrow(&mut sheet, [450.0 + 0.4 * (x - 450.0), 418.0], [x, 512.0], INK);
        step(&mut sheet, x, 550.0, words, fill);
    }
    sheet.svg()
}
