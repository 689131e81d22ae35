//! Does the tree sway? In a steady wind, and in gusts.

use std::f64::consts::PI;

use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Known, Lab, Mutant, Panels, Plot, Result, Series, Statistic, Table,
};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;
use snowglobe::tree::ReadingSet;

use super::setup::{Setup, broken};

pub const SWAY: Experiment = Experiment {
    id: "sway",
    title: "Sway in a steady wind and in gusts",
    source: "§6, Fig. 5",
    says: "The tree is seen to flutter in the wind.",
    claims: &[&REVERSALS, &PEAK_TO_PEAK],
    run,
    mutant: Mutant {
        changes: "wind coefficient",
        to: 0.0,
        why: "gusts that do not push do not move the tip",
        turns_red: &["sakai/sway/gust-peak-to-peak"],
    },
};

static REVERSALS: Claim = Claim {
    id: "sakai/sway/reversals",
    source: "§6",
    says: "the tree sways in the wind",
    expect: Expect::AtLeast(4.0),
    statistic: Statistic::Each,
    reason: "turns of the tip's motion along a steady wind of 5 m/s in 10 s, counted where it has come back by 1 mm: two \
             swings to and fro are the least that one would call swaying",
    known: &[
        Known {
            reading: "set=paper",
            evidence: "Eq. (10) as printed is overdamped, and no wind that is steady turns it back (steady.csv)",
        },
        Known {
            reading: "set=physical",
            evidence: "the damping outlasts the swing: the slowest mode only creeps to its balance (steady.csv)",
        },
    ],
};
static PEAK_TO_PEAK: Claim = Claim {
    id: "sakai/sway/gust-peak-to-peak",
    source: "§6",
    says: "the tree is seen to flutter",
    expect: Expect::Between(0.01, 3.0),
    statistic: Statistic::Mean,
    reason: "greatest less smallest displacement of the tip along the wind, m, in the last 5 of 10 s of gusts around 5 \
             m/s: a centimetre is the least that shows in a picture of ten metres, and 3 m would be half the tree",
    known: &[Known {
        reading: "set=literal",
        evidence: "the tree has fallen and thrashes about its root (gusts.csv)",
    }],
};

const WIND: f64 = 5.0;
const SECONDS: f64 = 10.0;
const SEEDS: u64 = 8;
const SAMPLES_PER_SECOND: f64 = 25.0;
/// A turn counts once the tip has come back so far, m.
const TURN: f64 = 1e-3;

fn run(lab: &mut Lab) -> Result<()> {
    let setup = Setup::new(lab);
    let strength = lab.assume(
        "gust strength",
        0.3,
        "standard deviation over mean: the turbulence of open country, near the ground",
    );
    let (slow, fast) = (0.1, 2.0);
    lab.assume("slowest gust", slow, "Hz: one in the ten seconds of a film");
    lab.assume("fastest gust", fast, "Hz: what a grid of 0.3 m and 5 m/s still carries");
    let seconds = lab.pick(SECONDS, 1.0);
    let mut steady = Table::new(["set", "t", "tip_x", "tip_y"]);
    let mut gusts = Table::new(["set", "seed", "t", "wind_m_s", "tip_x"]);
    let mut spectrum = Table::new(["set", "frequency_hz", "amplitude_m", "wind_amplitude_m_s"]);
    let (mut plots, mut spectra) = (Vec::new(), Vec::new());
    for set in lab.readings::<ReadingSet>() {
        lab.reading(set);
        let seeds = lab.seeds(SEEDS);
        let winds: Vec<Option<Seed>> =
            std::iter::once(None).chain(seeds.iter().map(|s| Some(Seed(*s)))).collect();
        let blown = lab.each(&winds, |seed| {
            let gust = seed.map(|seed| Gust::new(seed, strength, [slow, fast]));
            trace(&setup, set, seconds, |t| WIND * gust.as_ref().map_or(1.0, |gust| gust.at(t)))
        });
        let blown = blown.into_iter().collect::<Result<Vec<Trace>>>()?;
        lab.count("steps", winds.len() as u64 * setup.steps(seconds));
        lab.found(&REVERSALS, reversals(&blown[0].tip.iter().map(|tip| tip[0]).collect::<Vec<_>>()));
        for (trace, seed) in blown[1..].iter().zip(&seeds) {
            let late = &trace.tip[trace.tip.len() / 2..];
            let (least, most) =
                late.iter().fold((f64::MAX, f64::MIN), |(a, b), tip| (a.min(tip[0]), b.max(tip[0])));
            lab.found_with(&PEAK_TO_PEAK, *seed, most - least);
        }
        for (k, tip) in blown[0].tip.iter().enumerate() {
            steady.row([set.name().into(), time(k).into(), tip[0].into(), tip[1].into()]);
        }
        let first = &blown[1];
        for (k, (tip, wind)) in first.tip.iter().zip(&first.wind).enumerate() {
            gusts.row([set.name().into(), seeds[0].into(), time(k).into(), (*wind).into(), tip[0].into()]);
        }
        let mut of_set = Vec::new();
        for k in 1..=(fast * seconds) as usize {
            let frequency = k as f64 / seconds;
            let mean = |pick: &dyn Fn(&Trace) -> Vec<f64>| {
                blown[1..].iter().map(|t| amplitude(&pick(t), frequency)).sum::<f64>() / seeds.len() as f64
            };
            let tip = mean(&|t: &Trace| t.tip.iter().map(|tip| tip[0]).collect());
            let wind = mean(&|t: &Trace| t.wind.clone());
            spectrum.row([set.name().into(), frequency.into(), tip.into(), wind.into()]);
            of_set.push((frequency, tip));
        }
        spectra.push(Series::new(set.name(), Draw::Joined, of_set));
        let line = |name: &str, trace: &Trace| {
            Series::new(name, Draw::Line, trace.tip.iter().enumerate().map(|(k, tip)| (time(k), tip[0])))
        };
        plots.push(Plot {
            title: format!("Set {}", set.name()),
            x: Axis::of("time (s)"),
            y: Axis::of("tip along the wind (m)"),
            series: vec![line("steady wind", &blown[0]), line("gusts, seed 1", first)],
            bands: Vec::new(),
        });
    }
    lab.keep("steady", "The tip in a steady wind of 5 m/s", steady)?;
    lab.keep("gusts", "Wind and tip in gusts around 5 m/s, first seed", gusts)?;
    lab.keep("spectrum", "Amplitudes of tip and wind in gusts, mean over the seeds", spectrum)?;
    let title = "The tip at 5 m/s, steady and in gusts".to_owned();
    lab.keep("tip", "The tip at 5 m/s, steady and in gusts", Panels { title, columns: 3, plots })?;
    lab.keep(
        "spectra",
        "Amplitude of the tip by frequency in gusts, mean over the seeds",
        Plot {
            title: "What the tip follows of the gusts".to_owned(),
            x: Axis::log("frequency (Hz)", 0.1, 2.0),
            y: Axis::log("amplitude of the tip (m)", 1e-3, 3.0),
            series: spectra,
            bands: Vec::new(),
        },
    )
}

fn time(sample: usize) -> f64 {
    sample as f64 / SAMPLES_PER_SECOND
}

/// Gusts: waves of equal strength at frequencies apart by the same ratio, their phases drawn.
struct Gust {
    waves: Vec<(f64, f64)>,
    strength: f64,
}

impl Gust {
    const WAVES: usize = 16;

    fn new(seed: Seed, strength: f64, [slow, fast]: [f64; 2]) -> Self {
        let moment = seed.stream("gust").at(0);
        let wave = |k: usize| {
            let part = k as f64 / (Self::WAVES - 1) as f64;
            let phase = 2.0 * PI * moment.place(k as i32, 0, 0).uniform();
            (slow * libm::pow(fast / slow, part), phase)
        };
        // Sines of equal amplitude a have the deviation a sqrt(n / 2).
        let strength = strength / libm::sqrt(Self::WAVES as f64 / 2.0);
        Self { waves: (0..Self::WAVES).map(wave).collect(), strength }
    }

    /// What the wind is multiplied by; never below a tenth, so that it does not turn round.
    fn at(&self, time: f64) -> f64 {
        let sum: f64 = self.waves.iter().map(|(f, phase)| libm::sin(2.0 * PI * f * time + phase)).sum();
        (1.0 + self.strength * sum).max(0.1)
    }
}

struct Trace {
    tip: Vec<[f64; 2]>,
    wind: Vec<f64>,
}

fn trace(setup: &Setup, set: ReadingSet, seconds: f64, wind: impl Fn(f64) -> f64) -> Result<Trace> {
    let mut sway = setup.sway(set, WIND)?;
    let mut trace = Trace { tip: Vec::new(), wind: Vec::new() };
    let steps = setup.steps(seconds);
    let every = setup.steps(1.0 / SAMPLES_PER_SECOND).max(1);
    for step in 0..=steps {
        let speed = wind(sway.time());
        if step % every == 0 {
            let bend = sway.tree().bend();
            trace.tip.push([bend.tip.x, bend.tip.y]);
            trace.wind.push(speed);
        }
        sway.set_wind(speed);
        sway.step().map_err(broken)?;
    }
    Ok(trace)
}

/// How often a motion turns, counting a turn once it has come back by [`TURN`].
fn reversals(motion: &[f64]) -> f64 {
    let (mut turns, mut way, mut far) = (0.0, 0.0, motion[0]);
    for &now in motion {
        if way == 0.0 {
            if (now - far).abs() > TURN {
                way = (now - far).signum();
                far = now;
            }
        } else if (now - far) * way > 0.0 {
            far = now;
        } else if (far - now) * way > TURN {
            turns += 1.0;
            way = -way;
            far = now;
        }
    }
    turns
}

/// Amplitude of one frequency in samples whose mean is taken away.
fn amplitude(samples: &[f64], frequency: f64) -> f64 {
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let (mut re, mut im) = (0.0, 0.0);
    for (k, sample) in samples.iter().enumerate() {
        let (sine, cosine) = libm::sincos(2.0 * PI * frequency * time(k));
        re += (sample - mean) * cosine;
        im += (sample - mean) * sine;
    }
    2.0 * libm::hypot(re, im) / samples.len() as f64
}
