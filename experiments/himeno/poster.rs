//! A hundred crystals from a hundred histories, on one sheet.

use std::collections::BTreeSet;

use snowglobe::image::{Face, ImageError, Picture, draw_text, text_width};
use snowglobe::lab::{Claim, Error, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};
use snowglobe::rng::Place;
use snowglobe::snow::{Crystal, History, Light, Over, Relief, View, Weather, saturation, symmetry_mismatch};

use super::setup::{assumed, broken, grown};
use super::slide::{INK, ground, monochrome, suited, unmarked};

pub const POSTER: Experiment = Experiment {
    id: "poster",
    title: "A hundred crystals from a hundred histories",
    source: "§1, Eq. (8)",
    says: "No two crystals are alike, for no two fall through the same air.",
    claims: &[&DIFFERENT, &SIXFOLD, &KINDS],
    run,
    mutant: Mutant {
        changes: "time of growth",
        to: 0.0,
        why: "what has not grown is all alike",
        turns_red: &["himeno/poster/different", "himeno/poster/kinds"],
    },
};

static DIFFERENT: Claim = Claim {
    id: "himeno/poster/different",
    source: "§1",
    says: "no two crystals are alike",
    expect: Expect::Near { value: 100.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "different sets of elements among a hundred: all",
    known: &[],
};
static SIXFOLD: Claim = Claim {
    id: "himeno/poster/six-fold",
    source: "Eq. (10), §1.1.3, condition 3",
    says: "each is alike in six directions and on both sides",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "elements without an image, of all hundred: none",
    known: &[],
};
static KINDS: Claim = Claim {
    id: "himeno/poster/kinds",
    source: "§1",
    says: "besides the types of the diagram there are many between",
    expect: Expect::AtLeast(3.0),
    statistic: Statistic::Each,
    reason: "sequences of habits that crystals with flat arms have grown through: plates, sectored plates, dendrites, and their orders make \
             more than the three",
    known: &[],
};

const COUNT: u64 = 100;
const COLUMNS: usize = 10;
/// Supersaturation over ice as a share of that at saturation over water.
const DRY: [f64; 2] = [0.2, 0.5];
const HUMID: [f64; 2] = [0.8, 1.1];
/// The poster's crystals, pixels, and those of its small copy.
const SIDE: [usize; 2] = [300, 76];

fn run(lab: &mut Lab) -> Result<()> {
    let branching = assumed(lab, 8e-6)?;
    let coarse = branching.with_element(32e-6).map_err(broken)?;
    let middle = lab.assume("mean temperature, C", -14.8, "where flat crystals of all kinds grow");
    let time = lab.assume("time of growth", 1.0, "three spells of 4 to 9 minutes, times this");
    let spread = lab.assume("spread of temperature, C", 3.0, "a crystal falls through a few hundred metres");
    lab.assume_that(
        "humidity",
        "of saturation over water 0.2 to 0.5, or as likely 0.8 to 1.1",
        "outside of a cloud, or in it",
    );
    let numbers: Vec<u64> = (0..lab.pick(COUNT, 4)).collect();
    let stream = lab.stream("poster");
    let jobs = lab.each(&numbers, |number| -> Result<(History, Crystal)> {
        let history = fallen_through(&mut stream.at(*number).place(0, 0, 0), middle, spread, time)?;
        // All as fine, in their own size.
        let long = grown(&coarse, &history, *number)?.diameter();
        let element = (long / lab.pick(260.0, 40.0)).clamp(2e-6, 20e-6);
        let finer = branching.with_element(element).map_err(broken)?;
        let crystal = grown(&finer, &history, *number)?;
        Ok((history, crystal))
    });
    let grown_so = jobs.into_iter().collect::<Result<Vec<_>>>()?;
    let crystals: Vec<&Crystal> = grown_so.iter().map(|(_, crystal)| crystal).collect();
    let shapes: BTreeSet<Vec<_>> = crystals.iter().map(|crystal| crystal.elements().collect()).collect();
    // At smoke scale there are fewer, and nothing is judged.
    lab.found(&DIFFERENT, shapes.len() as f64);
    lab.found(&SIXFOLD, crystals.iter().flat_map(|crystal| symmetry_mismatch(crystal)).sum::<usize>() as f64);
    let kinds: BTreeSet<Vec<_>> =
        crystals.iter().map(|c| c.habits().iter().map(|(habit, _)| *habit).collect()).collect();
    lab.found(&KINDS, kinds.len() as f64);
    let mut table = Table::new([
        "crystal",
        "name",
        "minutes",
        "first_temperature_c",
        "last_temperature_c",
        "first_over_ice_pct",
        "last_over_ice_pct",
        "diameter_mm",
        "fill",
    ]);
    for (number, (history, crystal)) in grown_so.iter().enumerate() {
        let [first, last] = [history.at(0.0), history.at(history.minutes())];
        lab.count("elements", crystal.count() as u64);
        table.row([
            number.into(),
            crystal.name().into(),
            history.minutes().into(),
            first.0.into(),
            last.0.into(),
            (100.0 * first.1).into(),
            (100.0 * last.1).into(),
            (1e3 * crystal.diameter()).into(),
            crystal.fill().into(),
        ]);
    }
    lab.keep("crystals", "A hundred crystals, and the air that they fell through", table)?;
    if lab.keeps() {
        let caption =
            "A hundred crystals, each from a history of its own, in light coloured by direction; to print";
        lab.keep("large/poster", caption, poster(lab, &crystals, lab.pick(SIDE[0], 32), Light::Coloured)?)?;
        let small = poster(lab, &crystals, SIDE[1], Light::BrightField)?;
        lab.keep("small", "The same, small and in bright field", monochrome(&small)?)?;
    }
    Ok(())
}

/// Air by chance: it cools or warms, dries or moistens, in three spells.
fn fallen_through(chance: &mut Place, middle: f64, spread: f64, time: f64) -> Result<History> {
    let mut between = |from: f64, to: f64| from + (to - from) * chance.uniform();
    let mut minute = 0.0;
    let mut weather = Vec::new();
    for _ in 0..3 {
        let temperature = between(middle - spread, middle + spread).clamp(-30.0, -1.0);
        let [least, most] = if between(0.0, 1.0) < 0.5 { DRY } else { HUMID };
        let supersaturation = between(least, most) * saturation::water_saturation(temperature);
        weather.push(Weather { minute, temperature, supersaturation });
        minute += time * between(4.0, 9.0);
        // Half of the changes are sudden.
        if between(0.0, 1.0) < 0.5 {
            weather.push(Weather { minute: (minute - 0.5).max(0.0), temperature, supersaturation });
        }
    }
    History::new(weather, Over::Ice, minute).map_err(broken)
}

/// All crystals on one sheet, all of one size: what is shown is the shape.
fn poster(lab: &Lab, crystals: &[&Crystal], side: usize, light: fn(f64) -> Light) -> Result<Picture> {
    let drawn = lab.each(crystals, |crystal| -> Result<Picture> {
        let relief = Relief::of(crystal, View::Above, 1.08 * crystal.diameter(), side).map_err(broken)?;
        unmarked(&relief, light(suited(&relief)))
    });
    let pictures = drawn.into_iter().collect::<Result<Vec<_>>>()?;
    let grid = Picture::grid(&pictures.iter().collect::<Vec<_>>(), COLUMNS, side as u32 / 14, ground())
        .map_err(|cause: ImageError| Error::broken(cause.to_string()))?;
    let margin = (side / 2) as u32;
    let below = side as u32;
    let mut sheet = Picture::new(grid.width() + 2 * margin, grid.height() + margin + below, ground())
        .map_err(|cause: ImageError| Error::broken(cause.to_string()))?;
    sheet.paste(&grid, margin as i32, margin as i32);
    let size = side as f64 / 3.2;
    let words = "One hundred crystals, one hundred histories";
    let x = 0.5 * (f64::from(sheet.width()) - text_width(size, words, Face::Bold));
    let y = f64::from(sheet.height()) - 0.45 * f64::from(below);
    draw_text(&mut sheet, x, y, size, INK, words, Face::Bold);
    Ok(sheet)
}
