//! Figure 9: a wavy cut makes bands, as of a mackerel sky.

use std::f64::consts::TAU;

use snowglobe::contour_cloud::{Contour, Cut, Fineness, Layer, Passage, W, Window, pixel};
use snowglobe::image::{CodeValues, Picture};
use snowglobe::lab::{Artifact, Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};
use snowglobe::reading::Reading;

use super::setup::{CORRECTED, surface};

pub const FIGURE_9: Experiment = Experiment {
    id: "figure-9",
    title: "Figure 9: waves",
    source: "§3.2, Eq. (10), Fig. 9",
    says: "P = A cos(alpha X + B cos(beta Y)) as the cutting face makes bands.",
    claims: &[&PEAK, &POWER],
    run,
    mutant: Mutant {
        changes: "A",
        to: 0.0,
        why: "a cut without waves makes no bands",
        turns_red: &["miyata/figure-9/peak"],
    },
};

static PEAK: Claim = Claim {
    id: "miyata/figure-9/peak",
    source: "Eq. (10), Fig. 9",
    says: "there are alpha / 2 pi bands to a unit",
    expect: Expect::Near { value: 12.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "the wave number of greatest power in the picture's rows: 12 waves over the width were asked, a whole number, so \
             that it falls on one",
    known: &[],
};
static POWER: Claim = Claim {
    id: "miyata/figure-9/power",
    source: "Eq. (10), Fig. 9",
    says: "the bands are all that is seen",
    expect: Expect::Between(0.9, 1.0),
    statistic: Statistic::Each,
    reason: "share of the power of the rows within one wave number of the greatest; with gamma A = 0.5 the bend of Eq. (5) \
             leaves 0.985 by its Fourier series (Bessel functions)",
    known: &[],
};

const SIZE: usize = 384;

fn run(lab: &mut Lab) -> Result<()> {
    let a = lab.assume("A", 0.1, "constants of Fig. 9 are not given; the width of the picture is 1");
    let b = lab.assume("B", 1.2, "so that crests wind");
    let waves = lab.assume("waves over the width", 12.0, "so that they can be counted");
    let windings = lab.assume("windings over the height", 2.0, "so that crests wind");
    let gamma = lab.assume("gamma", 5.0, "half of the light at twice A, about");
    let seed = lab.seed();
    let of = |b: f64, level: f64, passage: Passage| -> Result<Vec<f64>> {
        // A flat sheet at the height of the crests or at their middle.
        let points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let sheet = Contour { name: "sheet".to_owned(), level, dimension: 2.0, points, closed: true };
        let surface = surface(&[sheet], CORRECTED, 0.0, seed)?;
        let cut = Cut::Waves { a, b, alpha: TAU * waves, beta: TAU * windings, level: 0.0 };
        let window = Window { low: [0.0; 2], high: [1.0; 2], size: [SIZE, SIZE] };
        let layer = Layer { cut, passage, gamma };
        let seen = layer.seen_from_above(&surface, &window, Fineness::Pixels(1.0));
        Ok(seen.pixels.iter().map(|[f]| f.clamp(0.0, 1.0)).collect())
    };
    let winding = of(b, 0.1, Passage::Above)?;
    let mut table = Table::new(["sheet", "passage", "B", "bands_over_the_width", "share_of_power"]);
    for (name, level) in [("at the crests", 0.1), ("in the middle", 0.0)] {
        for passage in Passage::ALL {
            let (peak, share) = peak(&of(0.0, level, *passage)?);
            table.row([name.into(), passage.name().into(), 0.0.into(), peak.into(), share.into()]);
            if level > 0.0 && *passage == Passage::Above {
                lab.found(&PEAK, peak as f64);
                lab.found(&POWER, share);
            }
        }
    }
    lab.keep("bands", "Bands of straight waves, under both readings of L", table)?;
    let straight = of(0.0, 0.1, Passage::Above)?;
    for (name, caption, f) in [
        ("straight", "Straight waves, B = 0", &straight),
        ("winding", "Fig. 9 re-run: the sheet above a wavy cut", &winding),
    ] {
        let values = f.iter().map(|f| pixel(*f) / W * 255.0).collect();
        let broken = |cause: snowglobe::image::ImageError| Error::broken(cause.to_string());
        let values: Vec<f64> = values;
        if lab.keeps() {
            let picture: Picture =
                CodeValues::new(SIZE as u32, SIZE as u32, values).map_err(broken)?.picture();
            lab.keep(name, caption, Artifact::Drawing(picture))?;
        }
    }
    Ok(())
}

/// The wave number of greatest power in the rows of a square picture, and the share of the power within one of it.
fn peak(f: &[f64]) -> (usize, f64) {
    let table: Vec<(f64, f64)> = (0..SIZE).map(|k| libm::sincos(TAU * k as f64 / SIZE as f64)).collect();
    let mut power = vec![0.0; SIZE / 2];
    for row in f.chunks(SIZE).step_by(8) {
        for (k, power) in power.iter_mut().enumerate().skip(1) {
            let (mut sine, mut cosine) = (0.0, 0.0);
            for (x, value) in row.iter().enumerate() {
                let (s, c) = table[k * x % SIZE];
                (sine, cosine) = (sine + value * s, cosine + value * c);
            }
            *power += sine * sine + cosine * cosine;
        }
    }
    let best = (1..power.len()).fold(1, |best, k| if power[k] > power[best] { k } else { best });
    let all: f64 = power.iter().sum();
    let near: f64 = power[best.saturating_sub(1)..(best + 2).min(power.len())].iter().sum();
    (best, if all > 0.0 { near / all } else { 0.0 })
}
