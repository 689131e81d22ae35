//! T(beta), far and near.

use snowglobe::frost::{EndFrame, EndRule, end_frames};
use snowglobe::lab::{Axis, Draw, Error, Lab, Plot, Result, Series, Table, average, maybe};
use snowglobe::rng::Seed;

use super::super::setup::{START, Setup};
use super::claims::*;
use super::{Definition, ENDLESS};

/// A stretch of beta in equal steps.
struct Stretch {
    name: &'static str,
    from: f64,
    to: f64,
    steps: u32,
}

const FAR: Stretch = Stretch { name: "far", from: 0.2, to: 0.4, steps: 100 };
const NEAR: Stretch = Stretch { name: "near", from: 0.3, to: 0.32, steps: 100 };

impl Stretch {
    fn betas(&self, steps: u32) -> Vec<f64> {
        let part = |i: u32| self.from + (self.to - self.from) * f64::from(i) / f64::from(steps);
        // Rounded, so that a table shows the numbers that were meant.
        (0..=steps).map(|i| libm::round(part(i) * 1e6) / 1e6).collect()
    }
}

/// The end frames over one stretch, with one definition, threshold and seed.
struct Curve {
    threshold: f64,
    seed: u64,
    definition: usize,
    betas: Vec<f64>,
    ends: Vec<Option<EndFrame>>,
}

impl Curve {
    fn interpolated(&self) -> Vec<f64> {
        self.ends.iter().flatten().map(|end| end.interpolated).collect()
    }

    /// Share of the steps over which T rises though there is more vapour.
    fn rising(&self) -> f64 {
        let ends = self.interpolated();
        let rising = ends.windows(2).filter(|pair| pair[1] > pair[0]).count();
        rising as f64 / (ends.len().max(2) - 1) as f64
    }

    /// The way that T goes up and down, over its net change: 1 where it only falls.
    fn roughness(&self) -> Option<f64> {
        let ends = self.interpolated();
        let way: f64 = ends.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
        let net = (ends.last()? - ends.first()?).abs();
        (net > 0.0).then(|| way / net)
    }

    /// The largest change over one step.
    fn jump(&self) -> f64 {
        self.interpolated().windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max)
    }

    /// The slope of log T against log beta, by least squares.
    fn slope(&self) -> Option<f64> {
        let pairs =
            self.betas.iter().zip(&self.ends).filter_map(|(beta, end)| Some((*beta, (*end)?.interpolated)));
        let logs: Vec<(f64, f64)> = pairs.map(|(beta, t)| (libm::log(beta), libm::log(t))).collect();
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| average(&logs.iter().map(of).collect::<Vec<_>>());
        let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
        let (xy, xx) = logs
            .iter()
            .fold((0.0, 0.0), |(xy, xx), p| (xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x) * (p.0 - x)));
        (logs.len() > 2).then(|| xy / xx)
    }
}

/// Measures T over both stretches, with every definition, threshold and seed.
pub fn survey(lab: &mut Lab, setups: &[(Setup, f64, u64)], definitions: &[Definition]) -> Result<()> {
    let far = measure(lab, &FAR, setups, definitions)?;
    let near = measure(lab, &NEAR, setups, definitions)?;

    for curve in far.iter().filter(|curve| curve.definition == 0 && curve.threshold != 0.4) {
        let claim = if curve.threshold == 0.0 { &EVEN_SLOPE } else { &RANDOM_SLOPE };
        lab.found_with(claim, curve.seed, curve.slope());
    }
    let rising = near.iter().filter(|curve| curve.definition == 0).map(Curve::rising);
    lab.found(&SMALL_CHANGES, rising.fold(f64::INFINITY, f64::min));
    let rougher = setups.iter().map(|(_, threshold, _)| {
        let of = |definition: usize| -> Option<f64> {
            let curves = far.iter().filter(|c| c.threshold == *threshold && c.definition == definition);
            Some(average(&curves.map(Curve::roughness).collect::<Option<Vec<_>>>()?))
        };
        Some(of(1)? - of(0)?)
    });
    let rougher: Option<Vec<f64>> = rougher.collect();
    lab.found(&ALL_IS_ROUGHER, rougher.map(|all| all.into_iter().fold(f64::INFINITY, f64::min)));
    let films =
        |curves: &[Curve]| curves.iter().map(|curve| curve.ends.len()).sum::<usize>() / definitions.len();
    lab.count("films grown", (films(&far) + films(&near)) as u64);

    keep(lab, &[(&FAR, far), (&NEAR, near)], setups, definitions)
}

fn measure(
    lab: &mut Lab,
    stretch: &Stretch,
    setups: &[(Setup, f64, u64)],
    definitions: &[Definition],
) -> Result<Vec<Curve>> {
    let betas = stretch.betas(lab.pick(stretch.steps, 2));
    let rules: Vec<EndRule> = definitions.iter().map(|definition| definition.rule).collect();
    let mut curves = Vec::new();
    for (setup, threshold, seeds) in setups {
        for seed in lab.seeds(*seeds) {
            let ends = lab.each(&betas, |beta| {
                end_frames(&setup.region, &START, setup.at(*beta), Seed(seed), &rules, ENDLESS)
                    .map_err(|cause| Error::broken("cannot grow frost").because(cause))
            });
            let ends = ends.into_iter().collect::<Result<Vec<_>>>()?;
            for definition in 0..rules.len() {
                let ends = ends.iter().map(|of_film| of_film[definition]).collect();
                curves.push(Curve { threshold: *threshold, seed, definition, betas: betas.clone(), ends });
            }
        }
    }
    Ok(curves)
}

fn keep(
    lab: &mut Lab,
    stretches: &[(&Stretch, Vec<Curve>)],
    setups: &[(Setup, f64, u64)],
    definitions: &[Definition],
) -> Result<()> {
    let mut all =
        Table::new(["threshold", "seed", "ends_with", "beta", "end_frame", "end_frame_interpolated"]);
    let mut measures = Table::new([
        "stretch",
        "threshold",
        "seed",
        "ends_with",
        "log_slope",
        "share_of_rising_steps",
        "roughness",
        "largest_jump",
        "never_ended",
    ]);
    for (stretch, curves) in stretches {
        for curve in curves {
            let name = definitions[curve.definition].name;
            for (beta, end) in curve.betas.iter().zip(&curve.ends) {
                all.row([
                    curve.threshold.into(),
                    curve.seed.into(),
                    name.into(),
                    beta.into(),
                    maybe(end.map(|end| end.frame)),
                    maybe(end.map(|end| end.interpolated)),
                ]);
            }
            measures.row([
                stretch.name.into(),
                curve.threshold.into(),
                curve.seed.into(),
                name.into(),
                maybe(curve.slope()),
                curve.rising().into(),
                maybe(curve.roughness()),
                curve.jump().into(),
                curve.ends.iter().filter(|end| end.is_none()).count().into(),
            ]);
        }
        for (_, threshold, _) in setups {
            let of = curves.iter().filter(|c| c.threshold == *threshold && c.seed == lab.seed().0);
            let series = of.map(|curve| {
                let points = curve.betas.iter().zip(&curve.ends);
                let points = points.filter_map(|(beta, end)| Some((*beta, (*end)?.interpolated)));
                Series::new(definitions[curve.definition].name, Draw::Line, points)
            });
            let series: Vec<Series> = series.collect();
            lab.keep(
                &format!("{}-{threshold}", stretch.name),
                &format!(
                    "The interpolated end frame over beta from {} to {} at threshold {threshold}, by each definition \
                     of the end; one seed",
                    stretch.from, stretch.to
                ),
                Plot {
                    title: format!("End frame against initial value, r_th {threshold}"),
                    x: Axis::within("initial value β", stretch.from, stretch.to),
                    y: Axis::of("end frame"),
                    series,
                    bands: Vec::new(),
                },
            )?;
        }
    }
    lab.keep("measures", "Slope, rising steps, roughness and largest jump of every curve", measures)?;
    lab.keep("end-frames", "Every end frame of both stretches", all)
}
