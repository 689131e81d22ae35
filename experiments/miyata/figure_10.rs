//! Figure 10: a cloud before a background.

use snowglobe::contour_cloud::{
    Compositing, Cut, Fineness, Layer, Passage, Patches, Plateau, Surface, W, Window, pixel,
};
use snowglobe::image::{ImageError, Picture};
use snowglobe::lab::{
    Artifact, Axis, Claim, Draw, Error, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic,
    Table,
};
use snowglobe::reading::Reading;

use super::setup::{CORRECTED, PAPER_SIZE, broken, contours, displacement, hills};
use super::sky::Sky;

pub const FIGURE_10: Experiment = Experiment {
    id: "figure-10",
    title: "Figure 10: cloud and background",
    source: "§3.3, Eq. (6) of 3.3, Fig. 10",
    says: "Where the cloud is black the background stays; where it is white, white.",
    claims: &[&BLACK, &WHITE, &COMMUTES, &LIGHT],
    run,
    mutant: Mutant {
        changes: "W",
        to: 200.0,
        why: "with another greatest value white is not white",
        turns_red: &["miyata/figure-10/white"],
    },
};

const fn within(id: &'static str, says: &'static str, reason: &'static str) -> Claim {
    Claim {
        id,
        source: "Eq. (6) of §3.3",
        says,
        expect: Expect::AtMost(1e-9),
        statistic: Statistic::Each,
        reason,
        known: &[],
    }
}

static BLACK: Claim = within(
    "miyata/figure-10/black",
    "a black cloud leaves the background as it is",
    "greatest change of the 256 values of a background, as printed and in light: rounding",
);
static WHITE: Claim = Claim {
    id: "miyata/figure-10/white",
    source: "Eq. (6) of §3.3",
    says: "a white cloud hides the background",
    expect: Expect::Near { value: 255.0, within: 1e-9 },
    statistic: Statistic::Each,
    reason: "least value over the 256 values of a background, as printed and in light: rounding",
    known: &[],
};
static COMMUTES: Claim = within(
    "miyata/figure-10/commutes",
    "it does not matter which is in front",
    "greatest difference between both orders, over 52 x 52 pairs of values, as printed and in light: rounding",
);
static LIGHT: Claim = Claim {
    id: "miyata/figure-10/light",
    source: "Eq. (6) of §3.3",
    says: "values of pixels are added as light is",
    expect: Expect::AtMost(1.0),
    statistic: Statistic::Each,
    reason: "greatest difference between blending code values and blending light, in codes: one at most if a pixel's value \
             were proportional to light",
    known: &[snowglobe::lab::Known {
        reading: "",
        evidence: "a display's values are not proportional to light (sRGB): a grey cloud before a grey background is \
                   brighter as printed, by many codes (difference.csv)",
    }],
};

fn run(lab: &mut Lab) -> Result<()> {
    let white = lab.printed("W", W, "Eq. (6)");
    let codes: Vec<f64> = (0..=255).map(f64::from).collect();
    let of = |value: &dyn Fn(Compositing, f64) -> f64| {
        let all = Compositing::ALL.iter().flat_map(|how| codes.iter().map(|code| value(*how, *code)));
        all.fold(0.0, f64::max)
    };
    lab.found(&BLACK, of(&|how, code| (how.over(0.0, code) - code).abs()));
    lab.found(&WHITE, 255.0 - of(&|how, code| 255.0 - how.over(white, code)));
    let pairs = codes.iter().step_by(5);
    let commutes = of(&|how, code| {
        pairs.clone().map(|other| (how.over(code, *other) - how.over(*other, code)).abs()).fold(0.0, f64::max)
    });
    lab.found(&COMMUTES, commutes);
    let difference = |cloud: f64, behind: f64| {
        Compositing::AsPrinted.over(cloud, behind) - Compositing::LinearLight.over(cloud, behind)
    };
    let most = of(&|_, code| codes.iter().map(|other| difference(code, *other).abs()).fold(0.0, f64::max));
    lab.found(&LIGHT, most);
    let mut table = Table::new(["cloud", "background", "as_printed", "linear_light"]);
    for cloud in codes.iter().step_by(51) {
        for behind in codes.iter().step_by(51) {
            table.row([
                (*cloud).into(),
                (*behind).into(),
                Compositing::AsPrinted.over(*cloud, *behind).into(),
                Compositing::LinearLight.over(*cloud, *behind).into(),
            ]);
        }
    }
    if lab.keeps() {
        before_a_sky(lab)?;
    }
    lab.keep("difference", "Values as printed and with light in between", table)?;
    let mut series = Vec::new();
    for behind in [0.0, 102.0, 178.0] {
        for how in Compositing::ALL {
            let points = codes.iter().step_by(5).map(|cloud| (*cloud, how.over(*cloud, behind)));
            let draw = if *how == Compositing::AsPrinted { Draw::Line } else { Draw::Ghost };
            series.push(Series::new(format!("{}, background {behind}", how.name()), draw, points));
        }
    }
    lab.keep(
        "screen",
        "Eq. (6) of 3.3 on code values, and on light (pale)",
        Plot {
            title: "A cloud before a background".to_owned(),
            x: Axis::within("value of the cloud (code)", 0.0, 255.0),
            y: Axis::within("value seen (code)", 0.0, 255.0),
            series,
            bands: Vec::new(),
        },
    )
}

/// The picture of the figure: a cloud, a sky, and one before the other under both readings.
fn before_a_sky(lab: &mut Lab) -> Result<()> {
    let drawn = hills(lab, 800);
    let gain = lab.assume("gain", 0.3, "at 1, as printed, displacement hides the contours");
    let patches = Patches::new(&contours(&drawn, 2.0, 2.4), Plateau::Raised).map_err(broken)?;
    let surface = Surface::smooth(&patches, 90.0, displacement(CORRECTED, gain, lab.seed()));
    let size = [480, 320];
    let window = Window { low: [0.0; 2], high: PAPER_SIZE, size };
    let layer = Layer { cut: Cut::Level { h: 20.0 }, passage: Passage::Above, gamma: 0.025 };
    let cloud = layer.seen_from_above(&surface, &window, Fineness::Pixels(1.0));
    let picture_error = |cause: ImageError| Error::broken(cause.to_string());
    let sky = Sky::DAY.picture(480, 320).map_err(picture_error)?;
    let grey = cloud.pixels.iter().flat_map(|[f]| [libm::round(pixel(f.clamp(0.0, 1.0))) as u8; 3]);
    let mut parts = vec![Picture::from_rgb(480, 320, grey.collect()).map_err(picture_error)?, sky.clone()];
    for how in Compositing::ALL {
        let codes = sky.pixels().iter().zip(&cloud.pixels).flat_map(|(behind, [f])| {
            let value = pixel(f.clamp(0.0, 1.0));
            behind.map(|code| libm::round(how.over(value, f64::from(code))) as u8)
        });
        parts.push(Picture::from_rgb(480, 320, codes.collect()).map_err(picture_error)?);
    }
    let refs: Vec<&Picture> = parts.iter().collect();
    let sheet = Picture::grid(&refs, 2, 8, [255; 3]).map_err(picture_error)?;
    let caption = "Fig. 10 re-run: a cloud, a sky, the cloud before the sky as printed, and with light";
    lab.keep("cloud-and-sky", caption, Artifact::Drawing(sheet))
}
