//! Fig. 4: a layer is branches on branches, and conditions 2 and 4.

use snowglobe::hexgrid::Axial;
use snowglobe::lab::{
    Axis, Claim, Draw, Expect, Experiment, Lab, Mutant, Plot, Result, Series, Statistic, Table, average,
    smallest_rise,
};
use snowglobe::snow::{Branching, Crystal, Form, History, Light, Over, View};

use super::setup::{assumed, broken, grown, saturated};
use super::slide::{APERTURE, room, sheet, slide};

pub const FIGURE_4: Experiment = Experiment {
    id: "figure-4",
    title: "Layers and branches",
    source: "§1.1.1, §1.1.3, Fig. 4",
    says: "From a branch smaller ones branch, and from these again; the nearer to plate the likelier, and each order slower than the \
           one before.",
    claims: &[&RECURSION, &FULLER, &SLOWER, &FERN, &APART],
    run,
    mutant: Mutant {
        changes: "speed of a branch over that of its own",
        to: 1.0,
        why: "then no order is slower than another",
        turns_red: &["himeno/figure-4/slower"],
    },
};

static RECURSION: Claim = Claim {
    id: "himeno/figure-4/recursion",
    source: "Fig. 4",
    says: "branches branch again",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "highest order of branches that has grown, arms being 0, the least of all seeds",
    known: &[],
};
static FULLER: Claim = Claim {
    id: "himeno/figure-4/fuller",
    source: "§1.1.3, condition 2",
    says: "the nearer to plate the likelier a branch, the nearer to dendrite the less",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "share of its hexagon that a layer fills, mean of the seeds, in air from that of dendrites to that of plates: at -15 C and 16, \
             12, 9, 6 and 4.5 % over ice",
    known: &[],
};
static SLOWER: Claim = Claim {
    id: "himeno/figure-4/slower",
    source: "§1.1.3, condition 4",
    says: "the more often it has branched, the slower a branch grows",
    expect: Expect::AtLeast(0.2),
    statistic: Statistic::Mean,
    reason: "least part of its speed that an order loses to the one before it, orders 0 to 2: without any slowing tips still lose a tenth, \
             waiting for room; that they lose more is the paper's, how much is assumed",
    known: &[],
};
static FERN: Claim = Claim {
    id: "himeno/figure-4/fern",
    source: "Fig. 1 (a), 4",
    says: "side branches are the longer the nearer to the middle, as on a fern",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "longest side branch at 0.95, 0.8, 0.65 and 0.5 of an arm, mean of the seeds: what is older has grown longer",
    known: &[],
};
static APART: Claim = Claim {
    id: "himeno/figure-4/apart",
    source: "Fig. 1 (a), 4",
    says: "side branches stop before those of the next arm",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "cells of ice half-way between two arms, in the outer two thirds, of all seeds: none",
    known: &[],
};

const SEEDS: u64 = 12;

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 10e-6)?;
    let minutes = lab.pick(20.0, 6.0);
    let seeds = lab.seeds(SEEDS);
    let dendrites = many(lab, &branching, &saturated(-15.0, minutes)?, &seeds)?;
    let order = dendrites.iter().map(|crystal| crystal.tally().highest_order()).min();
    lab.found(&RECURSION, order.map(|order| order as f64));
    for (seed, crystal) in seeds.iter().zip(&dendrites) {
        let speeds: Option<Vec<f64>> = (0..=2).map(|order| crystal.tally().tip_speed(order)).collect();
        let lost = speeds.map(|v| v.windows(2).map(|v| 1.0 - v[1] / v[0]).fold(f64::INFINITY, f64::min));
        lab.found_with(&SLOWER, *seed, lost);
        let far = crystal.radius() / 3;
        let shut = (far..crystal.radius()).filter(|k| crystal.is_ice(Axial::new(*k, *k), 0)).count();
        lab.found_with(&APART, *seed, shut as f64);
    }
    let breadths = [0.95, 0.8, 0.65, 0.5].map(|part| breadth(&dendrites, part));
    lab.found(&FERN, smallest_rise(&breadths));

    let mut table = Table::new(["supersaturation_over_ice_pct", "minutes", "fill", "p1", "sector"]);
    let mut fills = Vec::new();
    for supersaturation in [0.16, 0.12, 0.09, 0.06, 0.045] {
        // So that all are about as wide: what grows looser is quicker.
        let minutes = minutes * if supersaturation > 0.1 { 1.0 } else { 2.0 };
        let history = History::constant(-15.0, supersaturation, Over::Ice, minutes).map_err(broken)?;
        let crystals = many(lab, &branching, &history, &seeds)?;
        let fill = average(&crystals.iter().map(Crystal::fill).collect::<Vec<_>>());
        let dense = snowglobe::snow::deposition_density(-15.0, supersaturation) / snowglobe::snow::ICE;
        let vigour = branching.vigour(dense);
        fills.push(fill);
        table.row([
            (100.0 * supersaturation).into(),
            minutes.into(),
            fill.into(),
            vigour.branching.into(),
            vigour.form.sector.into(),
        ]);
    }
    lab.found(&FULLER, smallest_rise(&fills));
    lab.keep(
        "plates",
        "Layers from dendrite to plate: how full they are, and p1 and the sector that made them so",
        table,
    )?;
    speeds(lab, &dendrites)?;
    sensitivity(lab, &branching, minutes)
}

fn many(lab: &mut Lab, branching: &Branching, history: &History, seeds: &[u64]) -> Result<Vec<Crystal>> {
    let crystals = lab.each(seeds, |seed| grown(branching, history, *seed));
    let crystals = crystals.into_iter().collect::<Result<Vec<_>>>()?;
    lab.count("elements", crystals.iter().map(|crystal| crystal.count() as u64).sum());
    Ok(crystals)
}

/// Steps from the arm to the furthest cell of the side branches around a part of it, mean.
fn breadth(crystals: &[Crystal], part: f64) -> f64 {
    let of = |crystal: &Crystal| {
        let longest = |k: i32| (0..k).filter(|r| crystal.is_ice(Axial::new(k, *r), 0)).max().unwrap_or(0);
        let middle = (part * f64::from(crystal.radius())) as i32;
        f64::from((middle - 4..=middle + 4).map(longest).max().unwrap_or(0))
    };
    average(&crystals.iter().map(of).collect::<Vec<_>>())
}

fn speeds(lab: &mut Lab, dendrites: &[Crystal]) -> Result<()> {
    let orders = (0..=3).filter_map(|order| {
        let found: Vec<f64> = dendrites.iter().filter_map(|c| c.tally().tip_speed(order)).collect();
        (!found.is_empty()).then(|| (order as f64, 1e6 * dendrites[0].element() * average(&found)))
    });
    lab.keep(
        "speeds",
        "Speed of tips by order of branching, dendrites at -15 C and water saturation, mean of the seeds",
        Plot {
            title: "The more often branched, the slower".to_owned(),
            x: Axis::within("order of branching", 0.0, 3.0),
            y: Axis::of("speed of tips (µm/s)"),
            series: vec![Series::new("tips", Draw::Joined, orders)],
            bands: Vec::new(),
        },
    )
}

/// What the factor of condition 4, which is not printed, does to a dendrite.
fn sensitivity(lab: &mut Lab, branching: &Branching, minutes: f64) -> Result<()> {
    let factors = [0.5, 0.6, 0.7, 0.8, 0.9];
    let history = saturated(-15.0, minutes)?;
    let seeds = lab.seeds(4);
    let jobs: Vec<f64> = factors.to_vec();
    let grown_so = lab.each(&jobs, |slowing| -> Result<Vec<Crystal>> {
        let mut parameters = *branching.parameters();
        parameters.dendrite = Form { slowing: *slowing, ..parameters.dendrite };
        let branching = Branching::new(&parameters).map_err(broken)?;
        seeds.iter().map(|seed| grown(&branching, &history, *seed)).collect()
    });
    let mut table =
        Table::new(["speed_of_a_branch_over_its_own", "fill", "breadth_at_half", "mass_ug", "highest_order"]);
    let mut slides = Vec::new();
    for (slowing, crystals) in factors.iter().zip(grown_so) {
        let crystals = crystals?;
        let mean = |of: &dyn Fn(&Crystal) -> f64| average(&crystals.iter().map(of).collect::<Vec<_>>());
        table.row([
            (*slowing).into(),
            mean(&Crystal::fill).into(),
            breadth(&crystals, 0.5).into(),
            mean(&|crystal| 1e9 * crystal.mass()).into(),
            mean(&|crystal| crystal.tally().highest_order() as f64).into(),
        ]);
        if lab.keeps() && [0.5, 0.7, 0.9].contains(slowing) {
            let light = Light::BrightField(APERTURE.to_radians());
            let width = room(&crystals[0], crystals[0].diameter());
            slides.push(slide(
                &crystals[0],
                View::Above,
                width,
                360,
                light,
                &format!("slowing {slowing}: -15 °C, 16.1 %"),
            )?);
        }
    }
    lab.keep("sensitivity", "What the factor of condition 4, which is assumed, does to dendrites", table)?;
    if lab.keeps() {
        let seen = sheet(&slides, 3)?;
        lab.keep("slowing-seen", "The same seed with three factors of condition 4", seen)?;
    }
    Ok(())
}
