//! Fig. 8: a still of a thousand flakes.

use snowglobe::image::{Exposure, ImageError, Photograph, ToneCurve};
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic,
    Table, average,
};
use snowglobe::rng::Seed;
use snowglobe::snow::flake::Assembly;
use snowglobe::snow::still::{Flying, Picture, by_rays, picture};

use super::stage::{Settings, Stage, background, broken, placed};

pub const FIGURE_8: Experiment = Experiment {
    id: "figure-8",
    title: "A still of a thousand flakes",
    source: "§2, §3, Fig. 8, Eq. (11) to (16)",
    says: "A thousand flakes, each a volume, are rendered before a picture of snow while none falls.",
    claims: &[&COUNT, &VISIBLE, &WHITE, &COVERAGE, &REFERENCE, &BEHIND, &SCALES],
    run,
    mutant: Mutant {
        changes: "brightness of flakes over that of snow",
        to: 0.4,
        why: "then flakes are grey dust",
        turns_red: &["himeno/figure-8/white"],
    },
};

static COUNT: Claim = Claim {
    id: "himeno/figure-8/count",
    source: "§3",
    says: "a thousand flakes",
    expect: Expect::Near { value: 1000.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "bounding spheres that meet the pyramid of view: exactly as many",
    known: &[],
};
static VISIBLE: Claim = Claim {
    id: "himeno/figure-8/visible",
    source: "§3",
    says: "they are to be seen",
    expect: Expect::AtLeast(700.0),
    statistic: Statistic::Each,
    reason: "flakes that, alone, would change a pixel by more than one of 255 steps of brightness: by the law of sizes few are too small; \
             some hide others, and those out of focus are faint",
    known: &[],
};
static WHITE: Claim = Claim {
    id: "himeno/figure-8/white",
    source: "Fig. 8",
    says: "flakes are white",
    expect: Expect::Between(0.85, 1.1),
    statistic: Statistic::Each,
    reason: "brightness of what covers pixels, weighed by how much it covers, over that of the snow on the ground: calibrated on flakes of the \
             catalogue seen alone and sharp, so fitted; in the picture sizes and turns are others",
    known: &[],
};
static COVERAGE: Claim = Claim {
    id: "himeno/figure-8/coverage",
    source: "ours",
    says: "they cover of the picture what their sizes and distances say",
    expect: Expect::Near { value: 1.0, within: 0.1 },
    statistic: Statistic::Each,
    reason: "sum of all pixels' coverage over the sum of each flake's opacity area, alone, divided by the square of its distance: what flakes hide \
             of each other and what the edge cuts off are below a tenth",
    known: &[],
};
static REFERENCE: Claim = Claim {
    id: "himeno/figure-8/reference",
    source: "ours",
    says: "the picture has converged",
    expect: Expect::AtMost(0.01),
    statistic: Statistic::Each,
    reason: "root mean square of the difference in radiance of 64 samples a pixel from 1024, over the snow's, in the middle quarter of the picture: \
             two of 255 steps of brightness. In the reference every flake is followed by rays, the small and blurred ones too, which the picture \
             lays down",
    known: &[],
};
static BEHIND: Claim = Claim {
    id: "himeno/figure-8/behind",
    source: "§2",
    says: "where no flake is the picture behind is seen",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "pixels without coverage that differ from the picture behind, bit for bit: none",
    known: &[],
};
static SCALES: Claim = Claim {
    id: "himeno/figure-8/sizes",
    source: "Gunn & Marshall 1958",
    says: "diameters follow the law that they are drawn from",
    expect: Expect::AtMost(0.0515),
    statistic: Statistic::Each,
    reason: "Kolmogorov & Smirnov's distance of the thousand melted diameters from the law: its 99 % quantile, 1.63 / sqrt 1000. Flakes that only \
             reach into the view are larger than most, which adds a little",
    known: &[],
};

/// Samples of a pixel of the picture, and of what it is compared with.
const SAMPLES: [usize; 2] = [64, 1024];
const FLAKES: usize = 1000;
/// Flakes of the veil; at smoke scale there are fewer.
const VEIL: [usize; 2] = [30_000, 100];

fn run(lab: &mut Lab) -> Result<()> {
    let settings = assumed(lab);
    let count = lab.printed("flakes", lab.pick(FLAKES, 20) as f64, "§3") as usize;
    let seed = lab.seed();
    let stage = set(lab, settings)?;
    let flakes = stage.0.flakes(count, seed).map_err(broken)?;
    let (stage, behind, snow) = stage;
    let seen = placed(&flakes);
    let samples = lab.pick(SAMPLES, [2, 4]);
    let still = picture(&stage.scene(&seen), &stage.camera, &behind, samples[0], seed).map_err(broken)?;
    lab.count("samples", still.work.samples);
    lab.count("cells", still.work.cells);
    lab.found(&COUNT, still.visible as f64);
    lab.found(&BEHIND, touched(&still, &behind) as f64);
    lab.found(&WHITE, whiteness(&still, &behind, snow));
    let alone = opacity_in_pixels(&stage, &flakes);
    let covered: f64 = still.coverage.iter().map(|coverage| f64::from(*coverage)).sum();
    lab.found(&COVERAGE, covered / alone);
    lab.found(&SCALES, from_the_law(&stage, &flakes));
    let (error, rays) = error(&stage, &flakes, &still, &behind, samples[1], seed, snow)?;
    lab.found(&REFERENCE, error);
    lab.count("samples of the reference", rays);
    let visible = visible(lab, &stage, &flakes, &behind, seed)?;
    lab.found(&VISIBLE, visible as f64);

    let mut table = Table::new(["what", "value"]);
    for (what, value) in [
        ("flakes", flakes.len() as f64),
        ("visible flakes", visible as f64),
        ("traced flakes", still.work.traced as f64),
        ("farthest flake, m", stage.reach(count)),
        ("flakes in a cubic metre", stage.shower.sizes.number_density()),
        ("coverage, share of the picture", covered / still.coverage.len() as f64),
        ("error against the reference", error),
        ("ambient term k_a I_a, green", stage.light.ambient_light[1]),
        ("snow on the ground, green", snow[1]),
        ("largest scale of a body", most(&flakes, |flake| flake.placed.scale)),
        ("smallest scale of a body", 1.0 / most(&flakes, |flake| 1.0 / flake.placed.scale)),
    ] {
        table.row([what.into(), value.into()]);
    }
    lab.keep("still", "The still in numbers", table)?;
    sizes(lab, &stage, &flakes)?;
    if lab.keeps() {
        lab.keep("figure-8", "A thousand flakes before a winter wood", photograph(&still)?)?;
        let more = lab.pick(VEIL[0], VEIL[1]);
        let veil = veil(&stage, &flakes, more, seed)?;
        let caption = format!(
            "The same thousand, and behind them a veil: {more} more flakes of the same sizes, to {:.1} m",
            stage.reach(count + more)
        );
        let with = picture(&stage.scene(&veil), &stage.camera, &behind, samples[0], seed).map_err(broken)?;
        lab.keep("veil", &caption, photograph(&with)?)?;
        large(lab, &stage, &flakes)?;
    }
    Ok(())
}

fn most(flakes: &[Flying], of: impl Fn(&Flying) -> f64) -> f64 {
    flakes.iter().map(of).fold(0.0, f64::max)
}

/// What is set, each with its reason.
fn assumed(lab: &mut Lab) -> Settings {
    let mut settings = Settings::ASSUMED;
    let lens = &mut settings.lens;
    settings.rate = lab.assume(
        "rate, mm of water an hour",
        settings.rate,
        "not printed; heavy snow, as a winter picture has",
    );
    settings.melted = [
        lab.assume(
            "smallest melted diameter, mm",
            settings.melted[0],
            "smaller ones are below a pixel; at this rate they are half of all",
        ),
        lab.assume("largest melted diameter, mm", settings.melted[1], "a flake of 2 cm; larger are rare"),
    ];
    settings.extinction = lab.assume(
        "tau, 1/m",
        settings.extinction,
        "not printed; an element of ice of 25 um hides nine tenths of what is behind",
    );
    settings.temperature = lab.assume("temperature, C", settings.temperature, "dendrites, which join most");
    settings.supersaturation =
        lab.assume("supersaturation over ice", settings.supersaturation, "nearly that of a cloud at -15 C");
    settings.element =
        lab.assume("b_min, m", lab.pick(settings.element, 100e-6), "a tenth of a pixel and less");
    lens.focal = lab.assume("focal length, m", lens.focal, "a photographer's; 51 degrees across");
    lens.number = lab.assume("f-number", lens.number, "a grey day's");
    lens.focus = lab.assume("focus, m", lens.focus, "amid the flakes");
    lens.shutter = lab.assume("shutter, s", lens.shutter, "flakes are streaks of a pixel or two");
    settings.near = lab.assume("nearest flake, m", settings.near, "nearer ones would hide the picture");
    settings.gust = lab.assume("gusts, m/s", settings.gust, "flakes of one size do not move alike");
    lab.assume_that("wind, m/s", "0.35 to the right, 0.1 towards the camera", "a light air");
    lab.assume_that(
        "fall speed",
        "0.8 D^0.16, m/s and mm",
        "aggregates of dendrites, Locatelli & Hobbs 1974",
    );
    lab.assume_that("k_d, k_s, n", "0.3, 0.05, 8", "not printed; crystals glitter a little");
    settings.size = lab.pick(settings.size, [64, 48]);
    settings
}

/// The stage, the picture behind, and how bright its snow is.
fn set(lab: &mut Lab, settings: Settings) -> Result<(Stage, Vec<[f32; 3]>, [f64; 3])> {
    let camera = super::stage::looking(settings.lens, settings.size).map_err(broken)?;
    let (behind, snow) = background(&camera, &settings.lens, lab.seed())?;
    let share = lab.assume("brightness of flakes over that of snow", 1.0, "flakes are snow");
    let stage =
        Stage::new(settings, Assembly::OneByOne, snow.map(|x| share * x), lab.seed()).map_err(broken)?;
    Ok((stage, behind, snow))
}

/// Pixels that nothing covers and that are not what is behind.
fn touched(still: &Picture, behind: &[[f32; 3]]) -> usize {
    let pixels = still.radiance.iter().zip(behind).zip(&still.coverage);
    pixels.filter(|((seen, behind), coverage)| **coverage == 0.0 && seen != behind).count()
}

/// Radiance of what covers, by how much it covers, over that of snow.
fn whiteness(still: &Picture, behind: &[[f32; 3]], snow: [f64; 3]) -> f64 {
    let (mut light, mut covered) = (0.0, 0.0);
    for ((seen, behind), coverage) in still.radiance.iter().zip(behind).zip(&still.coverage) {
        let coverage = f64::from(*coverage);
        light += f64::from(seen[1]) - (1.0 - coverage) * f64::from(behind[1]);
        covered += coverage;
    }
    light / covered / snow[1]
}

/// Pixels that flakes would cover, each alone: opacity area over the square of the distance.
fn opacity_in_pixels(stage: &Stage, flakes: &[Flying]) -> f64 {
    let [across, _] = stage.camera.tangents();
    let pixels = 0.5 * stage.camera.size()[0] as f64 / across;
    let of = |flake: &Flying| {
        let placed = &flake.placed;
        let body = &stage.catalogue.bodies()[placed.template];
        let view = placed.turn.inverse() * placed.at.coords;
        let depth = -placed.at.z;
        // The body is drawn larger or smaller, and is deeper or thinner then: nearly the same opacity.
        let area = body.opacity(1.min(body.levels() - 1), view.into(), 128) * placed.scale * placed.scale;
        // A plane picture stretches what is aside: by one over the cosine of its angle.
        let slant = placed.at.coords.norm_squared().sqrt() / depth;
        area * pixels * pixels / (depth * depth) * slant
    };
    flakes.iter().map(of).sum()
}

/// Kolmogorov and Smirnov's distance of melted diameters from the law.
fn from_the_law(stage: &Stage, flakes: &[Flying]) -> f64 {
    let mut diameters: Vec<f64> = flakes.iter().map(|flake| 1e3 * flake.diameter).collect();
    diameters.sort_unstable_by(f64::total_cmp);
    let n = diameters.len() as f64;
    // The law's own diameters at shares of a fine scale.
    let law: Vec<f64> = (0..=4000)
        .map(|k| snowglobe::snow::diameter_of_melted(stage.shower.sizes.quantile(f64::from(k) / 4000.0)))
        .collect();
    let share = |diameter: f64| law.partition_point(|own| *own <= diameter) as f64 / law.len() as f64;
    diameters
        .iter()
        .enumerate()
        .map(|(k, diameter)| {
            let below = share(*diameter);
            (below - k as f64 / n).abs().max((below - (k + 1) as f64 / n).abs())
        })
        .fold(0.0, f64::max)
}

/// Root mean square against many samples, in the middle of the picture.
fn error(
    stage: &Stage,
    flakes: &[Flying],
    still: &Picture,
    behind: &[[f32; 3]],
    samples: usize,
    seed: Seed,
    snow: [f64; 3],
) -> Result<(f64, u64)> {
    let [width, height] = stage.camera.size();
    let [left, top, wide, high] = [width / 4, height / 4, width / 2, height / 2];
    let window = stage.camera.window([left, top, wide, high]).map_err(broken)?;
    let part = |of: &[[f32; 3]]| -> Vec<[f32; 3]> {
        (0..high).flat_map(|row| of[(top + row) * width + left..][..wide].to_vec()).collect()
    };
    let seen = placed(flakes);
    // Every flake by rays; and another seed, for the same places of lens and time would agree by themselves.
    let seed = Seed(seed.0.wrapping_add(1));
    let reference = by_rays(&stage.scene(&seen), &window, &part(behind), samples, seed).map_err(broken)?;
    let squares: Vec<f64> = part(&still.radiance)
        .iter()
        .zip(&reference.radiance)
        .map(|(a, b)| {
            let off = f64::from(a[1]) - f64::from(b[1]);
            off * off
        })
        .collect();
    Ok((average(&squares).sqrt() / snow[1], reference.work.samples))
}

/// Flakes that alone change a pixel by more than one step of brightness.
fn visible(lab: &Lab, stage: &Stage, flakes: &[Flying], behind: &[[f32; 3]], seed: Seed) -> Result<usize> {
    let [width, height] = stage.camera.size();
    let counted = lab.each(flakes, |flake| -> Result<usize> {
        // What is around it, which is all that it can change.
        let at = flake.placed.at;
        let [across, _] = stage.camera.tangents();
        let pixels = 0.5 * width as f64 / across;
        let [x, y] =
            [0.5 * width as f64 + pixels * at.x / -at.z, 0.5 * height as f64 - pixels * at.y / -at.z];
        let reach = pixels * flake.diameter / -at.z + 24.0;
        let span = |middle: f64, length: usize| {
            let from = (middle - reach).clamp(0.0, length as f64 - 1.0) as usize;
            let end = ((middle + reach) as usize + 1).clamp(from + 1, length);
            (from, end - from)
        };
        let ((left, wide), (top, high)) = (span(x, width), span(y, height));
        let window = stage.camera.window([left, top, wide, high]).map_err(broken)?;
        let part: Vec<[f32; 3]> =
            (0..high).flat_map(|row| behind[(top + row) * width + left..][..wide].to_vec()).collect();
        let placed = [flake.placed];
        let alone = picture(&stage.scene(&placed), &window, &part, 4, seed).map_err(broken)?;
        let step = |light: f32| 255.0 * snowglobe::image::srgb_encode(f64::from(light).clamp(0.0, 1.0));
        let changed = alone.radiance.iter().zip(&part).any(|(a, b)| (step(a[1]) - step(b[1])).abs() > 1.0);
        Ok(usize::from(changed))
    });
    counted.into_iter().sum()
}

/// The thousand and those behind them.
fn veil(
    stage: &Stage,
    flakes: &[Flying],
    more: usize,
    seed: Seed,
) -> Result<Vec<snowglobe::snow::still::Placed>> {
    let reach = [flakes.len(), flakes.len() + more].map(|count| stage.reach(count));
    let seed = Seed(seed.0.wrapping_add(1));
    let more = stage.shower.before(&stage.camera, &stage.catalogue, reach, more, seed).map_err(broken)?;
    Ok([placed(flakes), placed(&more)].concat())
}

fn photograph(still: &Picture) -> Result<Artifact> {
    let [width, height] = still.size.map(|side| side as u32);
    let photograph = Photograph::new(width, height, still.radiance.clone())
        .map_err(|cause: ImageError| Error::broken(cause.to_string()))?;
    Ok(Artifact::Photograph(photograph, Exposure { stops: 0.0 }, ToneCurve::Linear))
}

/// The same at 1920 x 1080.
fn large(lab: &mut Lab, stage: &Stage, flakes: &[Flying]) -> Result<()> {
    let stage = stage.of_size(lab.pick([1920, 1080], [96, 54])).map_err(broken)?;
    let (behind, _) = background(&stage.camera, &stage.settings.lens, lab.seed())?;
    let still = picture(&stage.scene(&placed(flakes)), &stage.camera, &behind, 16, lab.seed());
    let artifact = photograph(&still.map_err(broken)?)?;
    lab.keep("large/figure-8-large", "The same flakes at 1920 x 1080", artifact)
}

fn sizes(lab: &mut Lab, stage: &Stage, flakes: &[Flying]) -> Result<()> {
    let mut diameters: Vec<f64> = flakes.iter().map(|flake| 1e3 * flake.diameter).collect();
    diameters.sort_unstable_by(f64::total_cmp);
    let n = diameters.len() as f64;
    let drawn = diameters.iter().enumerate().step_by(4).map(|(k, d)| (*d, 1.0 - k as f64 / n));
    let law = (0..200).map(|k| {
        let share = f64::from(k) / 200.0;
        (snowglobe::snow::diameter_of_melted(stage.shower.sizes.quantile(share)), 1.0 - share)
    });
    lab.keep(
        "sizes",
        "Share of flakes that are larger: the thousand of the still, and the law that they are drawn from",
        Plot {
            title: "How large the flakes are".to_owned(),
            x: Axis::log("diameter (mm)", 2.0, 30.0),
            y: Axis::log("share that is larger", 1e-3, 1.0),
            series: vec![
                Series::new("Gunn & Marshall 1958, with the density of aggregates", Draw::Line, law),
                Series::new("drawn", Draw::Dots, drawn),
            ],
            bands: Vec::new(),
        },
    )
}
