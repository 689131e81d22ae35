//! Which D does a surface have that was asked for one?

use snowglobe::contour_cloud::{
    Amplitude, Contour, EdgeLength, Grid, Levels, Limit, Piece, Surface, divider,
};
use snowglobe::lab::{
    Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Panels, Plot, Result, Series, Statistic,
    Table, smallest_rise,
};
use snowglobe::rng::Seed;

use super::estimators::{ESTIMATORS, variogram};
use super::fractional::{Fractional, curve, deviation};
use super::setup::{CORRECTED, contours, hills, surface};

pub const DIMENSION: Experiment = Experiment {
    id: "dimension",
    title: "D asked for and D measured",
    source: "§2.1, §2.2, Eq. (1)",
    says: "D of the contours is measured, and goes into Eq. (1). Does the surface come out with it? Four estimators, tried \
           first on surfaces whose D is known.",
    claims: &[&CONTROL, &EQUATION, &SPECTRAL, &DETAIL, &VARIOGRAM, &BOXES, &SPREAD, &DIVIDER],
    run,
    mutant: Mutant {
        changes: "gain",
        to: 0.0,
        why: "without displacement every surface is flat, whatever D was asked for",
        turns_red: &["miyata/dimension/spectral", "miyata/dimension/detail", "miyata/dimension/variogram"],
    },
};

const fn claim(id: &'static str, says: &'static str, expect: Expect, reason: &'static str) -> Claim {
    Claim { id, source: "Eq. (1)", says, expect, statistic: Statistic::Each, reason, known: &[] }
}

static CONTROL: Claim = claim(
    "miyata/dimension/control",
    "the spectral estimator reads the D of exact surfaces",
    Expect::AtMost(0.03),
    "greatest |D measured - D| over seven D from 2.05 to 2.9, each the mean of 8 exact fractional Brownian surfaces: an \
     estimator that is farther off is no judge of 0.15",
);
static EQUATION: Claim = claim(
    "miyata/dimension/equation",
    "displacements fall with 2 to the power of -(n + 1)(3 - D)",
    Expect::AtMost(0.01),
    "|slope of log2 rms(v / L) against n + (3 - D)| at D = 2.41, six divisions of the patches of Fig. 2, eight seeds together, each \
     division weighted with its number of displacements; a correct program is 0.003 off by chance",
);
static SPECTRAL: Claim = claim(
    "miyata/dimension/spectral",
    "the surface has nearly the D that was asked for",
    Expect::AtMost(0.15),
    "greatest |spectral D - D asked|, means of 8 seeds: midpoints are displaced independently of their neighbours, which is \
     known to leave the surface rougher than it should be",
);
static DETAIL: Claim = claim(
    "miyata/dimension/detail",
    "measured as it was made, the surface has the D that was asked for",
    Expect::AtMost(0.05),
    "greatest |detail D - D asked|, means of 8 seeds: the estimator undoes Eq. (1); by chance it is off by 0.01 to 0.02",
);
static VARIOGRAM: Claim = claim(
    "miyata/dimension/variogram",
    "a greater D makes a rougher surface, by the variogram",
    Expect::Rises,
    "least difference of the D measured between neighbours in the row of D asked, every seed; good for order only",
);
static BOXES: Claim = claim(
    "miyata/dimension/box",
    "a greater D makes a rougher surface, by counting boxes",
    Expect::Rises,
    "least difference of the D measured between neighbours in the row of D asked, means of 8 seeds: few boxes, and so \
     good for order only",
);
static SPREAD: Claim = Claim {
    source: "§2.2",
    ..claim(
        "miyata/dimension/spread",
        "the surface is not strictly a fractal: its D depends on the scale",
        Expect::AtLeast(2.0),
        "spread (greatest less least) over scales of the local D of the variogram, at D = 2.41, mean of 8 seeds, over that of \
         exact surfaces, where it is chance: twice is more than chance would make of a surface that is as good",
    )
};
static DIVIDER: Claim = Claim {
    source: "§2.1",
    ..claim(
        "miyata/dimension/divider",
        "the D of a contour can be measured",
        Expect::AtMost(0.05),
        "greatest |D measured - D| by dividers on random midpoint curves of 2049 points, D from 1.1 to 1.4, means of 32 seeds",
    )
};

const ASKED: [f64; 7] = [2.05, 2.19, 2.3, 2.41, 2.6, 2.75, 2.9];
const LINES: [f64; 4] = [1.1, 1.2, 1.3, 1.4];
const SEEDS: u64 = 8;
/// Curves are cheap, and each is off by chance as much as by the method.
const CURVES: u64 = 32;

fn run(lab: &mut Lab) -> Result<()> {
    let gain = lab.assume("gain", 1.0, "as printed; D does not depend on it");
    lab.assume_that("surface", "a level square in two patches", "contours of our own would add their relief");
    let power = lab.pick(8, 6);
    let side = (1_usize << power) + 1;
    let seeds = lab.seeds(lab.pick(SEEDS, 2));
    let made = lab.each(&seeds, |seed| {
        let of = |d: &f64| heights(&square(*d, CORRECTED, gain, Seed(*seed))?, power);
        ASKED.iter().map(of).collect::<Result<Vec<_>>>()
    });
    let made = made.into_iter().collect::<Result<Vec<_>>>()?;
    // One D at a time, for the embedding of one is large.
    let exact = lab.each(&ASKED, |d| -> Result<Vec<Vec<f64>>> {
        let drawn = Fractional::new(power, *d).ok_or_else(|| Error::broken("no embedding"))?;
        // Two come of one seed.
        Ok(seeds.chunks(2).flat_map(|two| drawn.draw(Seed(two[0])).into_iter().take(two.len())).collect())
    });
    let exact = exact.into_iter().collect::<Result<Vec<_>>>()?;

    estimate(lab, &seeds, &made, &exact)?;
    let third = ASKED.iter().position(|d| *d == 2.41).unwrap_or_default();
    scales(lab, side, &of_dimension(&made, third), &exact[third])?;
    equation(lab, gain, &seeds)?;
    let seeds = lab.seeds(lab.pick(CURVES, 2));
    curves(lab, &seeds)
}

/// D of all surfaces by all estimators: those made, by seed and D, and the exact ones, by D and seed.
fn estimate(lab: &mut Lab, seeds: &[u64], made: &[Vec<Vec<f64>>], exact: &[Vec<Vec<f64>>]) -> Result<()> {
    let side = libm::sqrt(exact[0][0].len() as f64) as usize;
    let mut table = Table::new(["surface", "estimator", "d", "seed", "measured"]);
    let mut bias = Table::new(["estimator", "d", "exact_mean", "exact_bias", "made_mean", "made_bias"]);
    let asked = || vec![Series::new("as asked", Draw::Ghost, ASKED.map(|d| (d, d)).to_vec())];
    let mut panels = [asked(), asked()];
    for estimator in &ESTIMATORS {
        // A surface of which nothing can be told is smooth.
        let measure = |heights: &[f64]| (estimator.measure)(heights, side).unwrap_or(2.0);
        let (mut means, mut lowest_rise) = ([Vec::new(), Vec::new()], f64::INFINITY);
        let mut by_seed = vec![Vec::new(); seeds.len()];
        for (k, d) in ASKED.iter().enumerate() {
            for (which, surfaces) in [exact[k].clone(), of_dimension(made, k)].into_iter().enumerate() {
                let all: Vec<f64> = surfaces.iter().map(|heights| measure(heights)).collect();
                for (seed, measured) in seeds.iter().zip(&all) {
                    let name = ["exact", "made"][which];
                    table.row([
                        name.into(),
                        estimator.name.into(),
                        (*d).into(),
                        (*seed).into(),
                        (*measured).into(),
                    ]);
                }
                if which == 1 {
                    by_seed.iter_mut().zip(&all).for_each(|(row, measured)| row.push(*measured));
                }
                means[which].push(all.iter().sum::<f64>() / all.len() as f64);
            }
            let [exact, made] = [0, 1].map(|which| means[which][k]);
            bias.row([
                estimator.name.into(),
                (*d).into(),
                exact.into(),
                (exact - d).into(),
                made.into(),
                (made - d).into(),
            ]);
        }
        for row in &by_seed {
            lowest_rise = smallest_rise(row).map_or(lowest_rise, |rise| rise.min(lowest_rise));
        }
        let off = |which: usize| {
            means[which].iter().zip(ASKED).map(|(mean, d): (&f64, f64)| (mean - d).abs()).fold(0.0, f64::max)
        };
        match estimator.name {
            "spectral" => {
                lab.found(&CONTROL, off(0));
                lab.found(&SPECTRAL, off(1));
            }
            "detail" => {
                lab.found(&DETAIL, off(1));
            }
            "variogram" => {
                lab.found(&VARIOGRAM, lowest_rise);
            }
            _ => {
                lab.found(&BOXES, smallest_rise(&means[1]));
            }
        }
        for (panel, means) in panels.iter_mut().zip(means) {
            let points: Vec<(f64, f64)> = ASKED.into_iter().zip(means).collect();
            panel.push(Series::new(estimator.name, Draw::Joined, points));
        }
    }
    lab.keep("measured", "D of every surface by four estimators", table)?;
    lab.keep("bias", "What the estimators say of exact surfaces, and of those made by Eq. (1)", bias)?;
    lab.keep(
        "dimensions",
        "D measured against D asked, means over the seeds: on exact surfaces, and on those made by Eq. (1)",
        Panels {
            title: "Fractal dimension: asked for and measured".to_owned(),
            columns: 2,
            plots: ["exact surfaces", "surfaces made by Eq. (1)"]
                .into_iter()
                .zip(panels)
                .map(|(title, series)| Plot {
                    title: title.to_owned(),
                    x: Axis::within("D asked", 2.0, 3.0),
                    y: Axis::within("D measured", 2.0, 3.0),
                    series,
                    bands: Vec::new(),
                })
                .collect(),
        },
    )?;
    Ok(())
}

/// The surfaces of one D.
fn of_dimension(made: &[Vec<Vec<f64>>], k: usize) -> Vec<Vec<f64>> {
    made.iter().map(|all| all[k].clone()).collect()
}

/// A level square in two patches.
pub fn square(dimension: f64, how: (Amplitude, EdgeLength), gain: f64, seed: Seed) -> Result<Surface> {
    let points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    surface(
        &[Contour { name: "square".to_owned(), level: 0.0, dimension, points, closed: true }],
        how,
        gain,
        seed,
    )
}

/// Its heights, `2^power + 1` to a side.
pub fn heights(surface: &Surface, power: u32) -> Result<Vec<f64>> {
    let side = (1_usize << power) + 1;
    let grid = Grid { low: [0.0; 2], high: [1.0; 2], counts: [side; 2] };
    grid.heights(surface, power).map_err(|cause| Error::broken(cause.to_string()))
}

/// D between one scale and its double.
fn scales(lab: &mut Lab, side: usize, made: &[Vec<f64>], exact: &[Vec<f64>]) -> Result<()> {
    let local = |surfaces: &[Vec<f64>]| -> Vec<(f64, f64)> {
        let all: Vec<Vec<(f64, f64)>> = surfaces.iter().map(|heights| variogram(heights, side)).collect();
        let mean = |k: usize| all.iter().map(|logs| logs[k].1).sum::<f64>() / all.len() as f64;
        (1..all[0].len())
            .map(|k| (libm::exp2(all[0][k].0 - 0.5), 3.0 - 0.5 * (mean(k) - mean(k - 1))))
            .collect()
    };
    let spread = |local: &[(f64, f64)]| {
        let all = || local.iter().map(|(_, d)| *d);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    let (made, exact) = (local(made), local(exact));
    lab.found(&SPREAD, spread(&made) / spread(&exact));
    let mut table = Table::new(["distance", "made", "exact"]);
    for ((distance, made), (_, exact)) in made.iter().zip(&exact) {
        table.row([(*distance).into(), (*made).into(), (*exact).into()]);
    }
    lab.keep("scales", "D between a distance, in places of the grid, and its double, at D = 2.41", table)?;
    lab.keep(
        "local",
        "D from one scale to the next, at D = 2.41: of one fractal it would be the same at all",
        Plot {
            title: "Local dimension by the variogram".to_owned(),
            x: Axis::log("distance (places of the grid)", 1.0, 64.0),
            y: Axis::within("local D", 2.3, 2.6),
            series: vec![
                Series::new("made by Eq. (1)", Draw::Joined, made),
                Series::new("exact surface", Draw::Joined, exact),
            ],
            bands: Vec::new(),
        },
    )
}

/// Eq. (1) itself, on the displacements as they are made.
fn equation(lab: &mut Lab, gain: f64, seeds: &[u64]) -> Result<()> {
    const DIVISIONS: u32 = 6;
    let drawn = hills(lab, 800);
    let mut table = Table::new(["n", "displacements", "rms_over_length"]);
    let (mut sums, mut counts) = ([0.0; DIVISIONS as usize], [0_u64; DIVISIONS as usize]);
    for seed in seeds {
        let surface = surface(&contours(&drawn, 8.0, 2.41), CORRECTED, gain, Seed(*seed))?;
        for patch in 0..surface.patches.triangles.len() {
            let mut level: Vec<Piece> = vec![surface.piece(patch, |_, _| DIVISIONS)];
            for n in 0..DIVISIONS {
                for piece in &level {
                    for k in 0..3 {
                        let (a, b, edge) = (&piece.corners[k], &piece.corners[(k + 1) % 3], &piece.edges[k]);
                        if Levels.divides(n, a, b, edge) {
                            let v = surface.midpoint(n, a, b, edge, true).rough - 0.5 * (a.rough + b.rough);
                            sums[n as usize] += v * v / (edge.original * edge.original);
                            counts[n as usize] += 1;
                        }
                    }
                }
                level = level.iter().flat_map(|piece| surface.divide(piece, n, [true; 3])).collect();
            }
        }
    }
    let (mut all, mut x, mut y) = (0.0, 0.0, 0.0);
    let mut logs = Vec::new();
    for (n, (sum, count)) in sums.iter().zip(counts).enumerate() {
        let rms = libm::sqrt(sum / count as f64);
        table.row([n.into(), count.into(), rms.into()]);
        logs.push((n as f64, libm::log2(rms)));
        let weight = count as f64;
        (all, x, y) = (all + weight, x + weight * n as f64, y + weight * libm::log2(rms));
    }
    let (mut up, mut down) = (0.0, 0.0);
    for ((n, log), count) in logs.iter().zip(counts) {
        let off = n - x / all;
        (up, down) = (up + count as f64 * off * (log - y / all), down + count as f64 * off * off);
    }
    lab.found(&EQUATION, (up / down + (3.0 - 2.41)).abs());
    lab.keep("equation", "Displacements by division, at D = 2.41", table)
}

/// The divider estimator on curves whose D is known: y of a random midpoint curve over x.
fn curves(lab: &mut Lab, seeds: &[u64]) -> Result<()> {
    let mut table = Table::new(["d", "points", "measured_mean", "bias"]);
    let mut worst = 0.0_f64;
    for d in LINES {
        let deviation = deviation(d);
        for power in [10_u32, 11, 12, 13] {
            let measured: Option<Vec<f64>> =
                seeds.iter().map(|seed| divider(&curve(deviation, power, Seed(*seed)), false)).collect();
            let measured = measured.ok_or_else(|| Error::broken("a curve without a dimension"))?;
            let mean = measured.iter().sum::<f64>() / measured.len() as f64;
            if power == 11 {
                worst = worst.max((mean - d).abs());
            }
            table.row([d.into(), ((1_u32 << power) + 1).into(), mean.into(), (mean - d).into()]);
        }
    }
    lab.found(&DIVIDER, worst);
    lab.keep("curves", "The divider estimator on random midpoint curves", table)
}
