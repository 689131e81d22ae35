//! Both sides alike, six directions alike: conditions and Eq. (10), and why crystals grow on hexagons.

use std::collections::BTreeSet;

use snowglobe::hexgrid::Axial;
use snowglobe::lab::{Claim, Expect, Experiment, Lab, Mutant, Result, Statistic, Table};
use snowglobe::rng::Seed;
use snowglobe::snow::{Crystal, Cubes, Form, History, Over, Parameters, Vigour, Weather, grown_layer};

use super::joined::onto;
use super::setup::{assumed, broken, grown};

pub const SYMMETRY: Experiment = Experiment {
    id: "symmetry",
    title: "Six directions, both sides alike",
    source: "§1.1.2, §1.1.3, Eq. (10)",
    says: "Branches grow in six directions, 60 degrees apart, and alike on both sides.",
    claims: &[&TURNED, &MIRRORED, &FULL, &CUBIC],
    run,
    mutant: Mutant {
        changes: "angle between directions, degrees",
        to: 50.0,
        why: "no crystal comes upon itself after another angle",
        turns_red: &["himeno/symmetry/turned"],
    },
};

static TURNED: Claim = Claim {
    id: "himeno/symmetry/turned",
    source: "Eq. (10)",
    says: "the six directions are alike",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "elements that are not found again, the crystal turned in the plane by the angle between directions, of crystals from air that \
             changes by chance: none, for cells lie on hexagons",
    known: &[],
};
static MIRRORED: Claim = Claim {
    id: "himeno/symmetry/mirrored",
    source: "§1.1.3, condition 3",
    says: "branches grow alike on both sides",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "the same, mirrored at an arm: none",
    known: &[],
};
static FULL: Claim = Claim {
    id: "himeno/symmetry/full",
    source: "§1.1.3, conditions 2 and 4",
    says: "where branching is certain and nothing slows down, a plate grows",
    expect: Expect::Near { value: 0.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "cells that differ from the 3 n (n + 1) + 1 of a full hexagon, arms of 0 to 60 cells, the greatest: none",
    known: &[],
};
static CUBIC: Claim = Claim {
    id: "himeno/symmetry/cubic",
    source: "Eq. (7), (10)",
    says: "on a grid of cubes no crystal is six-fold: turned and rounded to it, elements fall together",
    expect: Expect::Between(0.05, 0.20),
    statistic: Statistic::Each,
    reason: "share of elements of a dendrite that fall together with others when it is turned by 60 degrees: of points of a lattice turned \
             against another of the same width about 1 in 7 to 12, and the finer the branches the fewer",
    known: &[],
};

fn run(lab: &mut Lab) -> Result<()> {
    let degrees = lab.printed("angle between directions, degrees", 60.0, "Eq. (10)");
    let branching = assumed(lab, 20e-6)?;
    let mut table =
        Table::new(["crystal", "name", "diameter_mm", "height_mm", "elements", "turned", "mirrored"]);
    let numbers: Vec<u64> = (0..lab.pick(60, 4)).collect();
    let stream = lab.stream("weather");
    let crystals = lab.each(&numbers, |number| -> Result<(Crystal, [usize; 2])> {
        let mut chance = stream.at(*number).place(0, 0, 0);
        let weather = (0..3).map(|k| Weather {
            minute: 6.0 * f64::from(k),
            temperature: -30.0 * chance.uniform(),
            supersaturation: 0.2 * chance.uniform(),
        });
        let history = History::new(weather.collect(), Over::Ice, 15.0).map_err(broken)?;
        let crystal = grown(&branching, &history, *number)?;
        let missing = [image(&crystal, degrees, false), image(&crystal, 0.0, true)];
        Ok((crystal, missing))
    });
    let mut missing = [0, 0];
    for (number, grown) in crystals.into_iter().enumerate() {
        let (crystal, [turned, mirrored]) = grown?;
        missing = [missing[0] + turned, missing[1] + mirrored];
        table.row([
            number.into(),
            crystal.name().into(),
            (1e3 * crystal.diameter()).into(),
            (1e3 * crystal.height()).into(),
            crystal.count().into(),
            turned.into(),
            mirrored.into(),
        ]);
        lab.count("elements", crystal.count() as u64);
    }
    lab.found(&TURNED, missing[0] as f64);
    lab.found(&MIRRORED, missing[1] as f64);
    lab.found(&FULL, fullest());

    let dendrite = grown(&branching, &super::setup::saturated(-15.0, lab.pick(15.0, 5.0))?, lab.seed().0)?;
    lab.found(&CUBIC, fall_together(&dendrite)?);
    lab.keep("crystals", "Sixty crystals from air that changes by chance, and what their images miss", table)
}

/// How many elements of a crystal have no element where they come to lie after a turn in the plane, or a mirror.
fn image(crystal: &Crystal, degrees: f64, mirrored: bool) -> usize {
    let all: BTreeSet<(Axial, i32)> = crystal.elements().collect();
    let (sine, cosine) = libm::sincos(degrees.to_radians());
    let missing = |(at, z): &&(Axial, i32)| {
        let place = at.position();
        let y = if mirrored { -place.y } else { place.y };
        let to = nalgebra::point![cosine * place.x - sine * y, sine * place.x + cosine * y];
        !all.contains(&(Axial::containing(to), *z))
    };
    all.iter().filter(missing).count()
}

/// Cells by which a layer with p1 = 1 and no slowing differs from the full hexagon, at worst.
fn fullest() -> f64 {
    let plate = Form { slowing: 1.0, ..Parameters::ASSUMED.plate };
    let all = Vigour { branching: 1.0, form: plate, plate: 1.0 };
    let off = |n: i32| {
        let layer = grown_layer(Seed(1), n, &all, &Parameters::ASSUMED);
        (layer.count() as i64 - i64::from(3 * n * (n + 1) + 1)).abs()
    };
    (0..=60).map(off).max().unwrap_or(0) as f64
}

/// Share of the cubic elements that are lost when a crystal is turned by 60 degrees and each is rounded to the grid.
fn fall_together(crystal: &Crystal) -> Result<f64> {
    let cubes = Cubes::new(crystal, 1).map_err(broken)?;
    let turn = onto(&nalgebra::Vector3::x(), &nalgebra::vector![0.5, 0.75_f64.sqrt(), 0.0]);
    let turn = nalgebra::Isometry3::from_parts(nalgebra::Translation3::identity(), turn);
    let places: BTreeSet<[i64; 3]> = cubes
        .places()
        .iter()
        .map(|place| {
            let centre = cubes.centre(*place, &turn);
            [centre.x, centre.y, centre.z].map(|along| libm::round(along / cubes.side()) as i64)
        })
        .collect();
    Ok(1.0 - places.len() as f64 / cubes.count() as f64)
}
