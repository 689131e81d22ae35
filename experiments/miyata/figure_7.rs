//! Figure 7: how the light that is lost grows with the way through the droplets.

use snowglobe::contour_cloud::{lost, transmitted};
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table,
};

pub const FIGURE_7: Experiment = Experiment {
    id: "figure-7",
    title: "Figure 7: the light that is lost",
    source: "§3.2, Eq. (5), Fig. 7",
    says: "f(L) = 1 - exp(-gamma L) rises from 0 and levels off at 1.",
    claims: &[&AGREES, &HALF, &RISES],
    run,
    mutant: Mutant {
        changes: "gamma",
        to: 0.0,
        why: "where nothing is taken away nothing is lost",
        turns_red: &["miyata/figure-7/half", "miyata/figure-7/rises"],
    },
};

static AGREES: Claim = Claim {
    id: "miyata/figure-7/agrees",
    source: "Eq. (2), (5)",
    says: "what is lost and what goes through make up the light",
    expect: Expect::AtMost(1e-12),
    statistic: Statistic::Each,
    reason: "greatest difference of f + I_out / I_in from 1 and of f from 1 - exp(-gamma L), over 1001 lengths: rounding",
    known: &[],
};
static HALF: Claim = Claim {
    id: "miyata/figure-7/half",
    source: "Eq. (5)",
    says: "half of the light is lost after ln 2 / gamma",
    expect: Expect::Near { value: 0.5, within: 1e-12 },
    statistic: Statistic::Each,
    reason: "f at ln 2 over the gamma of the figure: rounding",
    known: &[],
};
static RISES: Claim = Claim {
    id: "miyata/figure-7/rises",
    source: "Fig. 7",
    says: "the longer the way, the more is lost",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "f at 0 to 5 in steps of a half",
    known: &[],
};

fn run(lab: &mut Lab) -> Result<()> {
    let gamma = lab.assume("gamma", 1.0, "the figure's scale is lost");
    let mut worst = 0.0_f64;
    for k in 0..=1000 {
        let length = 0.01 * f64::from(k);
        let f = lost(gamma, length);
        worst = worst.max((f + transmitted(1.0, gamma, length) - 1.0).abs());
        worst = worst.max((f - (1.0 - libm::exp(-gamma * length))).abs());
    }
    lab.found(&AGREES, worst);
    lab.found(&HALF, lost(gamma, std::f64::consts::LN_2));
    let along: Vec<f64> = (0..=10).map(|k| lost(gamma, 0.5 * f64::from(k))).collect();
    lab.found(&RISES, snowglobe::lab::smallest_rise(&along));
    let mut table = Table::new(["length", "gamma_0.5", "gamma_1", "gamma_2"]);
    let gammas = [0.5, 1.0, 2.0];
    for k in 0..=50 {
        let length = 0.1 * f64::from(k);
        let [a, b, c] = gammas.map(|scale| lost(scale * gamma, length));
        table.row([length.into(), a.into(), b.into(), c.into()]);
    }
    lab.keep("f", "f against L", table)?;
    let curve = |scale: f64| {
        let points =
            (0..=100).map(|k| 0.05 * f64::from(k)).map(|length| (length, lost(scale * gamma, length)));
        Series::new(format!("gamma = {}", scale * gamma), Draw::Line, points)
    };
    lab.keep(
        "loss",
        "Fig. 7 re-run",
        Plot {
            title: "Light lost in a layer of droplets".to_owned(),
            x: Axis::within("way through the layer, L (1 / unit of gamma)", 0.0, 5.0),
            y: Axis::within("share of the light that is lost, f", 0.0, 1.0),
            series: gammas.map(curve).into(),
            bands: Vec::new(),
        },
    )
}
