//! Figure 1: feature points of contours.

use snowglobe::contour_cloud::feature_points;
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};

use super::draw::{Drawing, LEVELS};
use super::setup::{Drawn, PAPER_SIZE, hills};

pub const FIGURE_1: Experiment = Experiment {
    id: "figure-1",
    title: "Figure 1: feature points",
    source: "§2.1, Fig. 1",
    says: "(a) contours as they are given; (b) the polygons through their feature points.",
    claims: &[&NEAR, &FEWER],
    run,
    mutant: Mutant {
        changes: "distance",
        to: 1e-4,
        why: "a polygon that may hardly stray keeps nearly every point",
        turns_red: &["miyata/figure-1/fewer"],
    },
};

static NEAR: Claim = Claim {
    id: "miyata/figure-1/near",
    source: "§2.1, Fig. 1",
    says: "the polygon keeps to the contour",
    expect: Expect::AtMost(1.0),
    statistic: Statistic::Each,
    reason: "greatest distance of a point of a contour from its polygon over the distance asked, at 0.5 to 32 units: the \
             method promises 1",
    known: &[],
};
static FEWER: Claim = Claim {
    id: "miyata/figure-1/fewer",
    source: "§2.1, Fig. 1",
    says: "few points stand for the contour",
    expect: Expect::AtLeast(10.0),
    statistic: Statistic::Each,
    reason: "points of the contours to one that is kept at the figure's distance. A polygon of n sides strays from a smooth curve by \
             a fall with n squared: a tenth of the points at 2 units of a drawing of 960, as much as a pen's width",
    known: &[],
};

const POINTS: usize = 800;

fn run(lab: &mut Lab) -> Result<()> {
    let drawn = hills(lab, POINTS);
    let distance = lab.assume("distance", 2.0, "the paper's tracer is not described; a pen's width");
    let mut table = Table::new(["distance", "points", "feature_points", "greatest_distance"]);
    let mut worst = 0.0_f64;
    let (mut counts, mut strays) = (Vec::new(), Vec::new());
    for asked in [0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0] {
        let kept: Vec<Vec<usize>> =
            drawn[1..].iter().map(|line| feature_points(&line.points, true, asked)).collect();
        let stray = drawn[1..].iter().zip(&kept).map(|(line, kept)| stray(line, kept)).fold(0.0, f64::max);
        worst = worst.max(stray / asked);
        let count: usize = kept.iter().map(Vec::len).sum();
        table.row([asked.into(), ((drawn.len() - 1) * POINTS).into(), count.into(), stray.into()]);
        counts.push((asked, count as f64));
        strays.push((asked, stray));
    }
    lab.found(&NEAR, worst);
    let kept: Vec<Vec<usize>> =
        drawn.iter().map(|line| feature_points(&line.points, true, distance)).collect();
    let count: usize = kept[1..].iter().map(Vec::len).sum();
    lab.found(&FEWER, ((drawn.len() - 1) * POINTS) as f64 / count as f64);
    lab.keep("feature-points", "How many points are kept, and how far the polygons stray", table)?;
    let [width, height] = PAPER_SIZE;
    let mut sheet = Drawing::new([2.0 * width + 60.0, height + 70.0]);
    for (k, label) in ["(a) contours as given", "(b) polygons through feature points"].into_iter().enumerate()
    {
        let mut part = Drawing::new(PAPER_SIZE);
        for (level, (line, kept)) in drawn.iter().zip(&kept).enumerate() {
            let colour = LEVELS[[0, 1, 2, 4, 4, 5, 5][level]];
            let points: Vec<[f64; 2]> =
                if k == 0 { line.points.clone() } else { kept.iter().map(|k| line.points[*k]).collect() };
            part.line(&points, true, colour, 2.0, "none");
            if k == 1 {
                points.iter().for_each(|point| part.dot(*point, 4.0, colour));
            }
        }
        part.text([width / 2.0, height + 45.0], 30.0, label);
        sheet.place(&part, [10.0 + k as f64 * (width + 40.0), 10.0]);
    }
    lab.keep("contours", "Fig. 1 re-run with contours of our own", sheet.svg())?;
    lab.keep(
        "stray",
        "What a greater distance spares and costs",
        Plot {
            title: "Feature points against the distance asked".to_owned(),
            x: Axis::log("distance asked (units of the drawing)", 0.4, 40.0),
            y: Axis::log("points kept; distance reached (units)", 0.2, 2000.0),
            series: vec![
                Series::new("points kept", Draw::Joined, counts),
                Series::new("greatest distance", Draw::Joined, strays),
            ],
            bands: Vec::new(),
        },
    )
}

/// The greatest distance of a point of the line from the polygon through the points kept.
fn stray(line: &Drawn, kept: &[usize]) -> f64 {
    let points = &line.points;
    let mut most = 0.0_f64;
    for (k, from) in kept.iter().enumerate() {
        let to = kept.get(k + 1).copied().unwrap_or(kept[0] + points.len());
        let (a, b) = (points[*from], points[to % points.len()]);
        for between in *from..=to {
            most = most.max(off(points[between % points.len()], a, b));
        }
    }
    most
}

fn off(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let along = way[0] * way[0] + way[1] * way[1];
    let t = (((p[0] - a[0]) * way[0] + (p[1] - a[1]) * way[1]) / along).clamp(0.0, 1.0);
    libm::hypot(p[0] - a[0] - t * way[0], p[1] - a[1] - t * way[1])
}
