//! Figure 12: a mountain and a cloud of the same data.

use std::sync::atomic::{AtomicU64, Ordering};

use snowglobe::contour_cloud::{Corner, Cut, Fineness, Layer, Passage, Raster, Window, lambert};
use snowglobe::image::{Picture, srgb_encode};
use snowglobe::lab::{Artifact, Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};

use super::draw::{Drawing, LEVELS};
use super::setup::{CORRECTED, PAPER_SIZE, contours, hills, surface};

pub const FIGURE_12: Experiment = Experiment {
    id: "figure-12",
    title: "Figure 12: a mountain and a cloud of the same data",
    source: "§4, Fig. 12",
    says: "(a) contours; (b) the mountain made of them, from straight above; (c) the cloud.",
    claims: &[&SAME, &BOUNDED],
    run,
    mutant: Mutant {
        changes: "divisions of the cloud",
        to: 5.0,
        why: "a cloud of a coarser surface is not of the same data",
        turns_red: &["miyata/figure-12/same"],
    },
};

static SAME: Claim = Claim {
    id: "miyata/figure-12/same",
    source: "§3.4, §4, Fig. 12",
    says: "one surface is shown as a mountain and as a cloud",
    expect: Expect::True,
    statistic: Statistic::Each,
    reason: "a digest of every triangle that either picture lays down, bit for bit",
    known: &[],
};
static BOUNDED: Claim = Claim {
    id: "miyata/figure-12/bounded",
    source: "Eq. (5), (6) of 3.2",
    says: "pixels of a cloud lie between black and white",
    expect: Expect::AtMost(1e-9),
    statistic: Statistic::Each,
    reason: "how far the f of a pixel is outside of 0 to 1 at most: rounding",
    known: &[],
};

/// Light from the upper left.
const SUN: [f64; 3] = [-0.5, -0.5, std::f64::consts::FRAC_1_SQRT_2];
/// Linear colours of heights, lighter with every step: wood, meadow, rock, snow.
const TINTS: [(f64, [f64; 3]); 4] = [
    (-60.0, [0.02, 0.07, 0.05]),
    (20.0, [0.13, 0.22, 0.07]),
    (80.0, [0.42, 0.34, 0.22]),
    (125.0, [0.92, 0.94, 0.97]),
];

fn run(lab: &mut Lab) -> Result<()> {
    let drawn = hills(lab, 800);
    let distance = lab.assume("distance", 4.0, "patches about as long as contours are apart");
    let dimension = lab.assume("dimension", 2.15, "Fig. 12 gives none");
    let gain = lab.assume("gain", 0.12, "at 1, as printed, displacement is as high as the hills");
    let divisions = lab.assume("divisions", 6.0, "not given; below a pixel nearly everywhere") as u32;
    let of_cloud = lab.assume("divisions of the cloud", 6.0, "those of the mountain") as u32;
    let gamma = lab.assume("gamma", 0.02, "not given; from 0 to 1 - 1/e^2 over the height of the hills");
    let contours = contours(&drawn, distance, dimension);
    let surface = surface(&contours, CORRECTED, gain, lab.seed())?;
    let size = lab.pick([576, 384], [90, 60]);
    let window = Window { low: [0.0; 2], high: PAPER_SIZE, size };
    let (of_mountain, of_layer) = (AtomicU64::new(0), AtomicU64::new(0));
    let mountain = window.show(&surface, Fineness::Levels(divisions), |corners| {
        note(&of_mountain, corners);
        shade(corners)
    });
    let layer = Layer { cut: Cut::Level { h: 0.0 }, passage: Passage::Above, gamma };
    let cloud = window.show(&surface, Fineness::Levels(of_cloud), |corners| {
        note(&of_layer, corners);
        [layer.lost(corners)]
    });
    let digests = [of_mountain, of_layer].map(AtomicU64::into_inner);
    lab.found(&SAME, f64::from(u8::from(digests[0] == digests[1] && digests[0] != 0)));
    let outside = cloud.pixels.iter().map(|[f]| f64::max(-f, f - 1.0).max(0.0));
    let worst = outside.fold(0.0, f64::max);
    lab.found(&BOUNDED, worst);
    lab.count("triangles", mountain.triangles + cloud.triangles);
    let mut table = Table::new(["picture", "triangles", "digest", "mean"]);
    let mean = |sum: f64| sum / cloud.pixels.len() as f64;
    let light = mean(mountain.pixels.iter().map(|rgb| rgb.iter().sum::<f64>() / 3.0).sum());
    let lost = mean(cloud.pixels.iter().map(|[f]| f).sum());
    for (name, triangles, digest, mean) in
        [("mountain", mountain.triangles, digests[0], light), ("cloud", cloud.triangles, digests[1], lost)]
    {
        table.row([name.into(), triangles.into(), format!("{digest:016x}").into(), mean.into()]);
    }
    lab.keep("pictures", "What either picture is made of", table)?;
    let mut sheet = Drawing::new(PAPER_SIZE);
    for (level, line) in drawn.iter().enumerate() {
        sheet.line(&line.points, true, LEVELS[[0, 1, 2, 4, 4, 5, 5][level]], 2.0, "none");
    }
    lab.keep("contours", "Fig. 12(a) re-run: contours of our own", sheet.svg())?;
    if lab.keeps() {
        let light = picture(&mountain, size, srgb_encode)?;
        lab.keep("mountain", "Fig. 12(b) re-run: the mountain from straight above", light)?;
        let dark = picture(&cloud, size, |f| f)?;
        lab.keep("cloud", "Fig. 12(c) re-run: the cloud", dark)?;
    }
    Ok(())
}

/// Height by colour, slope by light: of the sun, and a third of it from the sky all around.
fn shade(corners: &[Corner; 3]) -> [f64; 3] {
    let height = corners.iter().map(Corner::height).sum::<f64>() / 3.0;
    let upper = TINTS.iter().position(|(level, _)| *level > height).unwrap_or(TINTS.len() - 1).max(1);
    let ((below, low), (above, high)) = (TINTS[upper - 1], TINTS[upper]);
    let share = ((height - below) / (above - below)).clamp(0.0, 1.0);
    let light = 0.35 + 0.95 * lambert(corners, SUN);
    [0, 1, 2].map(|k| light * (low[k] + share * (high[k] - low[k])))
}

/// A digest of triangles that does not depend on their order; triangles on the border of two bands, which come twice,
/// cancel in both pictures.
fn note(digest: &AtomicU64, corners: &[Corner; 3]) {
    let mut mixed = 0_u64;
    for word in corners.iter().flat_map(|corner| corner.point().map(f64::to_bits)) {
        mixed = (mixed ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29);
    }
    digest.fetch_xor(mixed, Ordering::Relaxed);
}

/// A picture of one value, in grey, or of three.
pub fn picture<const N: usize>(
    raster: &Raster<N>,
    [width, height]: [usize; 2],
    code: impl Fn(f64) -> f64,
) -> Result<Artifact> {
    let byte = |value: f64| libm::round(255.0 * code(value.clamp(0.0, 1.0))) as u8;
    let rgb = raster.pixels.iter().flat_map(|values| [0, 1, 2].map(|k| byte(values[k % N])));
    Picture::from_rgb(width as u32, height as u32, rgb.collect())
        .map(Artifact::Drawing)
        .map_err(|cause| Error::broken(cause.to_string()))
}
