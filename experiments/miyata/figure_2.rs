//! Figure 2: triangular patches between contours.

use snowglobe::contour_cloud::{Patches, Plateau};
use snowglobe::lab::{Claim, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};

use super::draw::{Drawing, LEVELS};
use super::setup::{PAPER_SIZE, broken, contours, hills};

pub const FIGURE_2: Experiment = Experiment {
    id: "figure-2",
    title: "Figure 2: triangular patches",
    source: "§2.1, Fig. 2",
    says: "Triangles between the polygons of Fig. 1(b) lift the plane drawing into space.",
    claims: &[&COVERS, &CROSSES, &FLAT],
    run,
    mutant: Mutant {
        changes: "width of the frame",
        to: 950.0,
        why: "a narrower frame leaves a strip of the drawing without patches",
        turns_red: &["miyata/figure-2/covers"],
    },
};

static COVERS: Claim = Claim {
    id: "miyata/figure-2/covers",
    source: "Fig. 2",
    says: "the patches cover the drawing once",
    expect: Expect::Near { value: 1.0, within: 1e-12 },
    statistic: Statistic::Each,
    reason: "sum of the areas of the triangles over that of the frame: only rounding is left",
    known: &[],
};
static CROSSES: Claim = Claim {
    id: "miyata/figure-2/crosses",
    source: "Fig. 2",
    says: "no patch lies across a contour",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "sides of contours that are cut by a side of a triangle, counted pair by pair",
    known: &[],
};
static FLAT: Claim = Claim {
    id: "miyata/figure-2/flat",
    source: "§2.1",
    says: "triangles between contours stand for the space between them",
    expect: Expect::AtMost(0.0),
    statistic: Statistic::Each,
    reason: "share of triangles all of whose corners are on one level: on these the surface would be a plateau, which the \
             paper does not mention",
    known: &[snowglobe::lab::Known {
        reading: "",
        evidence: "within the innermost contours and in their bays triangles have nothing but one contour (patches.csv)",
    }],
};

fn run(lab: &mut Lab) -> Result<()> {
    let mut drawn = hills(lab, 800);
    let width = lab.assume("width of the frame", PAPER_SIZE[0], "that of the drawing");
    drawn[0].points.iter_mut().for_each(|[x, _]| *x = x.min(width));
    let distance = lab.assume("distance", 2.0, "as in Fig. 1");
    let contours = contours(&drawn, distance, 2.3);
    let patches = Patches::new(&contours, Plateau::AsPrinted).map_err(broken)?;
    let raised = Patches::new(&contours, Plateau::Raised).map_err(broken)?;
    let place = |corner: usize| patches.corners[corner].place;
    let turn =
        |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let area: f64 =
        patches.triangles.iter().map(|t| 0.5 * turn(place(t[0]), place(t[1]), place(t[2])).abs()).sum();
    lab.found(&COVERS, area / (PAPER_SIZE[0] * PAPER_SIZE[1]));
    let mut crossed = 0;
    for contour in &contours {
        for k in 0..contour.points.len() {
            let (a, b) = (contour.points[k], contour.points[(k + 1) % contour.points.len()]);
            let cut = |p: [f64; 2], q: [f64; 2]| {
                let (c, d) = (turn(a, b, p), turn(a, b, q));
                let (e, f) = (turn(p, q, a), turn(p, q, b));
                c * d < 0.0 && e * f < 0.0
            };
            crossed += patches
                .triangles
                .iter()
                .filter(|t| (0..3).any(|k| cut(place(t[k]), place(t[(k + 1) % 3]))))
                .count();
        }
    }
    lab.found(&CROSSES, crossed as f64);
    lab.found(&FLAT, patches.flat.len() as f64 / patches.triangles.len() as f64);
    let mut table = Table::new(["plateaus", "corners", "triangles", "flat_triangles", "raised_points"]);
    for (name, patches) in [("as-printed", &patches), ("raised", &raised)] {
        table.row([
            name.into(),
            patches.corners.len().into(),
            patches.triangles.len().into(),
            patches.flat.len().into(),
            patches.raised.into(),
        ]);
    }
    lab.keep("patches", "Triangles, and those of one level", table)?;
    let mut sheet = Drawing::new([2.0 * PAPER_SIZE[0] + 60.0, PAPER_SIZE[1] + 70.0]);
    for (k, (label, patches)) in
        [("triangles of one level in grey", &patches), ("with raised points", &raised)]
            .into_iter()
            .enumerate()
    {
        let mut part = Drawing::new(PAPER_SIZE);
        for (number, triangle) in patches.triangles.iter().enumerate() {
            let fill = if patches.flat.contains(&number) { "#d5d5d5" } else { "none" };
            let corners: Vec<[f64; 2]> =
                triangle.iter().map(|corner| patches.corners[*corner].place).collect();
            part.line(&corners, true, "#8a8a8a", 0.8, fill);
        }
        for (level, contour) in contours.iter().enumerate() {
            part.line(&contour.points, true, LEVELS[[0, 1, 2, 4, 4, 5, 5][level]], 2.5, "none");
        }
        for corner in &patches.corners[patches.corners.len() - patches.raised..] {
            part.dot(corner.place, 4.0, "#a63d2f");
        }
        part.text([PAPER_SIZE[0] / 2.0, PAPER_SIZE[1] + 45.0], 30.0, label);
        sheet.place(&part, [10.0 + k as f64 * (PAPER_SIZE[0] + 40.0), 10.0]);
    }
    lab.keep("triangles", "Fig. 2 re-run: the patches between the contours of Fig. 1", sheet.svg())
}
