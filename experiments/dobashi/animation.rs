//! A sky that forms and dissolves (§1, §2.3): ten seconds of it.

use snowglobe::automaton_cloud::{Metaballs, Smoothing};
use snowglobe::image::{Exposure, Picture, ToneCurve};
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic,
    Table, average,
};
use snowglobe::volume::{Rendered, render};

use super::sky::{Weather, many, photograph, unseen};

pub const ANIMATION: Experiment = Experiment {
    id: "animation",
    title: "A sky that forms and dissolves",
    source: "§1, §2.3",
    says: "Clouds are animated: points call them up, and, changed in time, let them go.",
    claims: &[&FORMS, &DISSOLVES, &STEADY],
    run,
    mutant: Mutant {
        changes: "step at which vapour ends",
        to: 1e6,
        why: "points that do not change let nothing go",
        turns_red: &["dobashi/animation/dissolves"],
    },
};

static FORMS: Claim = Claim {
    id: "dobashi/animation/forms",
    source: "§2.3",
    says: "clouds come up out of a clear sky",
    expect: Expect::AtLeast(10.0),
    statistic: Statistic::Each,
    reason: "greatest share of cells with cloud over that of the second step, when cloud first can be; tenfold is a sky that has \
             changed",
    known: &[],
};
static DISSOLVES: Claim = Claim {
    id: "dobashi/animation/dissolves",
    source: "§2.3",
    says: "and dissolve when the points are changed",
    expect: Expect::AtMost(0.1),
    statistic: Statistic::Each,
    reason: "share of cells with cloud in the last step over the greatest: nine tenths are gone",
    known: &[],
};

static STEADY: Claim = Claim {
    id: "dobashi/animation/steady",
    source: "Eq. (7)",
    says: "smoothed over time, and with frames between steps, the film does not boil",
    expect: Expect::Between(0.0, 0.5),
    statistic: Statistic::Each,
    reason: "mean over pixels and frames of how far luminance is from the mean of the frames before and after, over the same of the film as \
             printed, each step shown as it is until the next: a half is half the boiling",
    known: &[],
};

const FRAMES_PER_SECOND: u16 = 12;
/// Weights of the steps before and after: so that the film does not boil.
const WEIGHTS: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
/// Frames to a step, between which central densities are linear.
const BETWEEN: usize = 2;

fn run(lab: &mut Lab) -> Result<()> {
    let extinction =
        lab.assume("extinction", 0.12, "1/m deep in cloud; the sky is half as wide as in dobashi/display");
    let turn = lab.assume("step at which vapour ends", 24.0, "before half time");
    let lifetime = lab.assume("T_ext", 4.0, "not given; short, for a short film") as u8;
    let steps = lab.pick(61, 8);
    let size = lab.pick([320, 180], [32, 18]);
    let side = lab.pick(80, 16);
    let weather = Weather { counts: [side, side, side / 4], seed: lab.seed().0, turn: Some(turn) };
    let balls = weather.balls();
    let smoothing = Smoothing::SpaceTime(WEIGHTS.to_vec());
    let reach = smoothing.reach();
    // A clear sky before and behind.
    let clear = vec![0.0_f32; balls.counts.iter().product()];
    let mut central = vec![clear.clone(); reach];
    let mut cover = vec![(0.0, 0.0)];
    weather.film(lifetime, steps, |cld| {
        let share = cld.iter().map(|cld| f64::from(*cld)).sum::<f64>() / cld.len() as f64;
        cover.push((cover.len() as f64, 100.0 * share));
        central.push(balls.central(&weather.widened(&cld)));
    })?;
    let last = central[central.len() - 1].clone();
    central.resize(central.len() + reach, last);
    let most = cover.iter().map(|(_, share)| *share).fold(0.0, f64::max);
    let first = cover[2].1;
    lab.found(&FORMS, (first > 0.0).then(|| most / first));
    lab.found(&DISSOLVES, cover[cover.len() - 1].1 / most.max(1e-12));
    let mut table = Table::new(["step", "cover_percent"]);
    for (step, share) in &cover {
        table.row([(*step).into(), (*share).into()]);
    }
    lab.keep("cover", "How much of the lattice is cloud", table)?;
    lab.keep(
        "formation",
        "Clouds form, and dissolve once vapour ends",
        Plot {
            title: "A sky forms and dissolves".to_owned(),
            x: Axis::of("step"),
            y: Axis::of("cells with cloud (%)"),
            series: vec![Series::new("cover", Draw::Joined, cover)],
            bands: Vec::new(),
        },
    )?;
    let smoothed: Vec<Vec<f32>> = central
        .windows(WEIGHTS.len())
        .map(|steps| Metaballs::over_time(&smoothing, &steps.iter().map(|q| &q[..]).collect::<Vec<_>>()))
        .collect();
    let light = many(4);
    let small = weather.camera(size.map(|side| side / 4))?;
    boiling(lab, &central[reach..central.len() - reach], &smoothed, |central| {
        let seen = render(&weather.density(central)?, extinction, &small, &light, 1).map_err(unseen)?;
        let luminance = |[r, g, b]: &[f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        Ok(photograph(&seen)?.pixels().iter().map(luminance).collect())
    })?;
    if !lab.keeps() {
        return Ok(());
    }
    let camera = weather.camera(size)?;
    let frames: Vec<usize> = (0..(smoothed.len() - 1) * BETWEEN).collect();
    // One frame after the other: each is rendered on all threads, and many fields at once would not fit the caches.
    let mut film = Vec::new();
    for frame in frames {
        let central = between(&smoothed, frame);
        let seen: Rendered =
            render(&weather.density(&central)?, extinction, &camera, &light, 1).map_err(unseen)?;
        lab.count("cells", seen.work.cells);
        film.push(photograph(&seen)?.develop(Exposure { stops: 0.0 }, ToneCurve::Filmic));
    }
    let stills: Vec<&Picture> = (0..6).map(|k| &film[(2 * k + 1) * film.len() / 12]).collect();
    let sheet = Picture::grid(&stills, 3, 2, [255; 3]).map_err(|cause| Error::broken(cause.to_string()))?;
    lab.keep("stills", "Six moments of the film, from left to right and down", Artifact::Drawing(sheet))?;
    lab.keep(
        "film",
        "A sky that forms and dissolves",
        Artifact::Animation { frames: film, frames_per_second: FRAMES_PER_SECOND },
    )
}

/// The central densities of a frame, linear between those of steps.
fn between(steps: &[Vec<f32>], frame: usize) -> Vec<f32> {
    let (step, share) = (frame / BETWEEN, (frame % BETWEEN) as f32 / BETWEEN as f32);
    steps[step].iter().zip(&steps[step + 1]).map(|(a, b)| a + share * (b - a)).collect()
}

/// How restless the film is: as printed, each step shown until the next; with frames between; and smoothed over time too.
fn boiling(
    lab: &mut Lab,
    printed: &[Vec<f32>],
    smoothed: &[Vec<f32>],
    luminance: impl Fn(&[f32]) -> Result<Vec<f32>> + Sync,
) -> Result<()> {
    let frames: Vec<usize> = (0..(printed.len() - 1) * BETWEEN).collect();
    let steps: Vec<usize> = (0..printed.len() - 1).collect();
    let held = lab.each(&steps, |step| luminance(&printed[*step])).into_iter().collect::<Result<Vec<_>>>()?;
    let film = |steps: &[Vec<f32>]| {
        let shown = lab.each(&frames, |frame| luminance(&between(steps, *frame)));
        shown.into_iter().collect::<Result<Vec<_>>>()
    };
    let films = [
        ("as printed, steps held", frames.iter().map(|frame| held[frame / BETWEEN].clone()).collect()),
        ("as printed, frames between", film(printed)?),
        ("smoothed over time, frames between", film(smoothed)?),
    ];
    let mut table = Table::new(["film", "mean_change_percent", "mean_restlessness_percent"]);
    let (mut series, mut restless) = (Vec::new(), Vec::new());
    for (name, film) in films {
        let bright = average(&film.iter().flatten().map(|light| f64::from(*light)).collect::<Vec<_>>());
        let pixels = film[0].len() as f64;
        let share = |sum: f32| 100.0 * f64::from(sum) / (pixels * bright);
        let changes: Vec<f64> = film
            .windows(2)
            .map(|pair: &[Vec<f32>]| share(pair[0].iter().zip(&pair[1]).map(|(a, b)| (b - a).abs()).sum()))
            .collect();
        let off = |three: &[Vec<f32>]| {
            let pixels = three[0].iter().zip(&three[1]).zip(&three[2]);
            share(pixels.map(|((a, b), c)| (b - 0.5 * (a + c)).abs()).sum())
        };
        let offs: Vec<f64> = film.windows(3).map(off).collect();
        table.row([name.into(), average(&changes).into(), average(&offs).into()]);
        let points = changes.iter().enumerate().map(|(frame, change)| (frame as f64 + 1.0, *change));
        series.push(Series::new(name, Draw::Line, points.collect::<Vec<_>>()));
        restless.push(average(&offs));
    }
    lab.found(&STEADY, restless[2] / restless[0].max(1e-12));
    lab.keep(
        "luminance",
        "How much of the luminance changes from frame to frame, and how restlessly",
        table,
    )?;
    lab.keep(
        "changes",
        "Change of luminance from frame to frame",
        Plot {
            title: "Does the film boil?".to_owned(),
            x: Axis::of("frame"),
            y: Axis::of("change of luminance (% of the mean)"),
            series,
            bands: Vec::new(),
        },
    )
}
