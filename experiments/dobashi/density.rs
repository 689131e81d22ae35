//! From bits to a density (§2.4).

use snowglobe::automaton_cloud::{Metaballs, Packed, Rules, Smoothing, profile};
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};

use super::setup::{MENDED, broken, uniform};

pub const DENSITY: Experiment = Experiment {
    id: "density",
    title: "A continuous density",
    source: "§2.4, Eq. (6) and (7)",
    says: "Metaballs in the cells, their central densities smoothed, make a continuous density of bits.",
    claims: &[&EVEN, &WHOLE, &BOUNDED, &CALMER],
    run,
    mutant: Mutant {
        changes: "effective radius",
        to: 1.0,
        why: "balls that reach no further than their neighbours leave holes between cells",
        turns_red: &["dobashi/density/even"],
    },
};

static EVEN: Claim = Claim {
    id: "dobashi/density/even",
    source: "Eq. (6)",
    says: "the density is continuous: deep in cloud it is even",
    expect: Expect::AtMost(0.03),
    statistic: Statistic::Each,
    reason: "greatest deviation from the mean over 512 places within a cell, all cells being cloud: 3 % is not seen",
    known: &[],
};
static WHOLE: Claim = Claim {
    id: "dobashi/density/not-bounded",
    source: "Eq. (6)",
    says: "rho is not bounded by 1",
    expect: Expect::AtLeast(1.0),
    statistic: Statistic::Each,
    reason: "rho deep in cloud: the sum of f over all balls that reach there",
    known: &[],
};
static BOUNDED: Claim = Claim {
    id: "dobashi/density/central",
    source: "Eq. (7)",
    says: "central densities that are not 0 lie above 0 and do not exceed 1",
    expect: Expect::AtMost(0.0),
    statistic: Statistic::Each,
    reason: "how far any of a film exceeds 1: a mean of zeros and ones cannot",
    known: &[],
};
static CALMER: Claim = Claim {
    id: "dobashi/density/calmer",
    source: "Eq. (7)",
    says: "smoothed over time as well, a film flickers less than as printed",
    expect: Expect::Between(0.0, 0.7),
    statistic: Statistic::Each,
    reason: "mean change of rho from a step to the next, five steps weighted 1, 4, 6, 4, 1, over that smoothed over space alone; \
             the weights take the fastest flicker, on and off in turn, away altogether, and leave slow changes",
    known: &[Known {
        reading: "",
        evidence: "most of the change is cloud that comes and goes for good: with and without smoothing over time it rises and falls \
                   together (flicker.svg)",
    }],
};

/// Weights of the steps before and after.
const WEIGHTS: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];

fn run(lab: &mut Lab) -> Result<()> {
    let radius = lab.assume("effective radius", 2.5, "D is the user's; in cells");
    let mut table = Table::new(["radius", "whole", "greatest_deviation"]);
    let mut worst_of = |radius: f64| {
        let counts = [20; 3];
        let balls = Metaballs { counts, radius };
        let q = balls.central(&vec![1; 8000]);
        let place = |n: usize| [n % 8, n / 8 % 8, n / 64].map(|x| 9.0 + x as f64 / 8.0);
        let found: Vec<f64> = (0..512).map(|n| balls.at(&q, place(n))).collect();
        let mean = found.iter().sum::<f64>() / 512.0;
        let worst = found.iter().map(|rho| (rho / mean - 1.0).abs()).fold(0.0, f64::max);
        table.row([radius.into(), balls.whole().into(), worst.into()]);
        (balls.whole(), worst)
    };
    for radius in [1.0, 1.5, 2.0, 3.0, 4.0] {
        worst_of(radius);
    }
    let (whole, worst) = worst_of(radius);
    lab.found(&EVEN, worst);
    lab.found(&WHOLE, whole);
    lab.keep("even", "rho deep in cloud, by the radius of the balls, in cells", table)?;
    lab.keep(
        "profile",
        "f, Wyvill's polynomial, taken for the paper's, which is lost",
        Plot {
            title: "The density of a metaball".to_owned(),
            x: Axis::within("distance over D", 0.0, 1.0),
            y: Axis::within("f", 0.0, 1.0),
            series: vec![Series::new(
                "f",
                Draw::Line,
                (0..=100).map(|k| (f64::from(k) / 100.0, profile(f64::from(k * k) / 1e4))),
            )],
            bands: Vec::new(),
        },
    )?;

    let lifetime = lab.assume("T_ext", 2.0, "not given; short, so that there is flicker") as u8;
    let counts = lab.pick([48, 48, 24], [12, 12, 8]);
    let steps = lab.pick(60, 12);
    let mut clouds = Packed::new(counts, Rules { lifetime, ..MENDED }).map_err(broken)?;
    clouds.inject(&uniform(lab.seed().0, [0.4, 0.001, 0.0]));
    let later = uniform(lab.seed().0, [0.02, 0.001, 0.005]);
    let balls = Metaballs { counts, radius };
    let mut central = Vec::new();
    for _ in 0..steps {
        clouds.step();
        clouds.inject(&later);
        central.push(balls.central(&clouds.cld()));
    }
    let most = central.iter().flatten().map(|q| f64::from(*q)).fold(0.0, f64::max);
    lab.found(&BOUNDED, (most - 1.0).max(0.0));
    let films = [Smoothing::Space, Smoothing::SpaceTime(WEIGHTS.to_vec())].map(|smoothing| {
        let reach = smoothing.reach();
        // The same steps of both films.
        let of = |t: usize| {
            let around: Vec<&[f32]> = (t - reach..=t + reach).map(|t| &central[t][..]).collect();
            balls.density(&Metaballs::over_time(&smoothing, &around))
        };
        (2..steps - 2).map(of).collect::<Vec<_>>()
    });
    let flicker = films.each_ref().map(|film| {
        let change = |pair: &[Vec<f32>]| {
            let sum: f64 = pair[0].iter().zip(&pair[1]).map(|(a, b)| f64::from((a - b).abs())).sum();
            let all: f64 = pair[1].iter().map(|rho| f64::from(*rho)).sum();
            sum / all.max(1e-12)
        };
        film.windows(2).map(change).collect::<Vec<f64>>()
    });
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    lab.found(&CALMER, mean(&flicker[1]) / mean(&flicker[0]));
    let series =
        ["over space, Eq. (7)", "over space and time"].into_iter().zip(&flicker).map(|(name, all)| {
            let points = all.iter().enumerate().map(|(t, change)| (t as f64 + 3.0, 100.0 * change));
            Series::new(name, Draw::Line, points.collect::<Vec<_>>())
        });
    lab.keep(
        "flicker",
        "How much of the density changes from one step to the next",
        Plot {
            title: "Does the film boil?".to_owned(),
            x: Axis::of("step"),
            y: Axis::of("change of rho (% of all)"),
            series: series.collect(),
            bands: Vec::new(),
        },
    )
}
