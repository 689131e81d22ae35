//! Figure 10: a cloud before a background.

use snowglobe::contour_cloud::{Compositing, W};
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};
use snowglobe::reading::Reading;

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
static WHITE: Claim = within(
    "miyata/figure-10/white",
    "a white cloud hides the background",
    "greatest distance from 255 over the 256 values of a background, as printed and in light: rounding",
);
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
    lab.found(&WHITE, of(&|how, code| (how.over(white, code) - 255.0).abs()));
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
