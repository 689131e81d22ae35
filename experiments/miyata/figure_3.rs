//! Figure 3: the recursive division of a triangle.

use std::collections::BTreeMap;

use snowglobe::contour_cloud::{Contour, Corner, Patches, Plateau};
use snowglobe::lab::{Claim, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};

use super::draw::Drawing;
use super::setup::{CORRECTED, broken, surface};

pub const FIGURE_3: Experiment = Experiment {
    id: "figure-3",
    title: "Figure 3: recursive division",
    source: "§2.2, Fig. 3",
    says: "The middles of a triangle's sides are moved along the vertical and joined: four triangles of one, and so on.",
    claims: &[&FOURFOLD, &CRACKS, &CORNERS, &OVERHANGS],
    run,
    mutant: Mutant {
        changes: "divisions",
        to: 0.0,
        why: "undivided, there are two triangles and not 4^n of each",
        turns_red: &["miyata/figure-3/fourfold"],
    },
};

const fn exactly(id: &'static str, says: &'static str, value: f64, reason: &'static str) -> Claim {
    Claim {
        id,
        source: "§2.2, Fig. 3",
        says,
        expect: Expect::Near { value, within: 0.0 },
        statistic: Statistic::Each,
        reason,
        known: &[],
    }
}

static FOURFOLD: Claim = exactly(
    "miyata/figure-3/fourfold",
    "each division makes four triangles of one",
    2048.0,
    "two patches divided five times: 2 x 4^5, counted",
);
static CRACKS: Claim = exactly(
    "miyata/figure-3/cracks",
    "the divided surface hangs together",
    0.0,
    "places at which two triangles have different heights, to the last bit, over 8 seeds",
);
static CORNERS: Claim = exactly(
    "miyata/figure-3/corners",
    "corners of patches stay on their contours",
    0.0,
    "corners of the patches whose height has changed, over 8 seeds",
);
static OVERHANGS: Claim = Claim {
    id: "miyata/figure-3/overhangs",
    source: "§2.2",
    says: "overhangs may come about",
    expect: Expect::AtLeast(1.0),
    statistic: Statistic::Each,
    reason: "triangles turned over in the plan, over 8 seeds: one at least in 16,384 if they may come about at all",
    known: &[snowglobe::lab::Known {
        reading: "",
        evidence: "displacement is vertical, so that the surface is a height over the plan and none is turned over",
    }],
};

fn run(lab: &mut Lab) -> Result<()> {
    let divisions = lab.assume("divisions", 5.0, "enough to see; the figure shows two") as u32;
    let gain = lab.printed("gain", 1.0, "Eq. (1)");
    let dimension = lab.assume("dimension", 2.3, "Fig. 3 gives none");
    let points = vec![[0.0, 0.0], [4.0, 0.0], [5.0, 3.0], [1.0, 3.0]];
    let rim = Contour { name: "rim".to_owned(), level: 0.0, dimension, points, closed: true };
    Patches::new(std::slice::from_ref(&rim), Plateau::AsPrinted).map_err(broken)?;
    let (mut cracks, mut moved, mut over, mut count) = (0, 0, 0, 0);
    for seed in lab.seeds(8) {
        let surface = surface(std::slice::from_ref(&rim), CORRECTED, gain, snowglobe::rng::Seed(seed))?;
        let mut heights: BTreeMap<[u64; 2], u64> = BTreeMap::new();
        count = 0;
        surface.triangles(divisions, &mut |leaf| {
            count += 1;
            for corner in leaf {
                let height = corner.height().to_bits();
                let seen = *heights.entry(corner.place.map(f64::to_bits)).or_insert(height);
                cracks += usize::from(seen != height);
            }
            over += usize::from(turn(leaf) <= 0.0);
        });
        let given = &surface.patches.corners;
        moved += given
            .iter()
            .filter(|corner| heights[&corner.place.map(f64::to_bits)] != corner.height().to_bits())
            .count();
    }
    lab.found(&FOURFOLD, f64::from(count));
    lab.found(&CRACKS, cracks as f64);
    lab.found(&CORNERS, moved as f64);
    lab.found(&OVERHANGS, over as f64);
    let mut table = Table::new(["divisions", "triangles"]);
    let surface = surface(&[rim], CORRECTED, 0.5 * gain, lab.seed())?;
    let mut sheet = Drawing::new([1640.0, 560.0]);
    for n in 0..=4_u32 {
        let mut leaves: Vec<[Corner; 3]> = Vec::new();
        surface.triangles(n, &mut |leaf| leaves.push(*leaf));
        table.row([n.into(), leaves.len().into()]);
        // From the back to the front, so that what is nearer covers what is behind.
        leaves.sort_by(|a, b| middle(a).total_cmp(&middle(b)));
        let mut part = Drawing::new([310.0, 300.0]);
        for leaf in &leaves {
            let oblique = |corner: &Corner| {
                let [x, y] = corner.place;
                [20.0 + 50.0 * (x + 0.25 * (3.0 - y)), 300.0 + 50.0 * (0.5 * y - 1.1 * corner.height())]
            };
            let points: Vec<[f64; 2]> = leaf.iter().map(oblique).collect();
            part.line(&points, true, "#1b3a5c", 1.0, "#e8eef4");
        }
        part.text([150.0, 520.0], 24.0, &format!("n = {n}"));
        sheet.place(&part, [10.0 + 322.0 * f64::from(n), 0.0]);
    }
    lab.keep("counts", "Triangles after each division", table)?;
    lab.keep(
        "division",
        "Fig. 3 re-run: two patches, divided four times; half the gain, to be seen",
        sheet.svg(),
    )
}

/// Twice the area in the plan.
fn turn(leaf: &[Corner; 3]) -> f64 {
    let [a, b, c] = leaf.map(|corner| corner.place);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn middle(leaf: &[Corner; 3]) -> f64 {
    leaf.iter().map(|corner| corner.place[1]).sum()
}
