//! Maps of what the tables do not determine.

use snowglobe::frost::Redraw;
use snowglobe::lab::{HeatMap, Lab, Result};

use super::super::shape::{Shape, Start};
use super::fit::{Candidate, Fit, Printed, Second, largest, on_table_1, on_table_2};
use super::space::{ALPHA, ALPHAS, FEW_STEPS, Family, GAMMA, GAMMAS, STEPS};

/// Half widths of the map of both tables; gammas of Table 2 in tenths of Table 1's.
const SIZES: std::ops::RangeInclusive<u32> = 17..=26;
const TENTHS: [u32; 9] = [30, 35, 40, 45, 50, 55, 60, 65, 70];

pub fn keep(lab: &mut Lab, candidates: &[Candidate], lead: Option<&Fit>, printed: &Printed) -> Result<()> {
    if let Some(lead) = lead {
        size_against_steps(lab, lead, printed)?;
        gamma_against_redraw(lab, lead, printed)?;
    }
    let every: Vec<u32> = STEPS.collect();
    let hexagon = |f: &Family| f.shape == Shape::Hexagon && f.start == Start::Centre;
    let plain = |f: &Family| Family { alpha: ALPHA, gamma: GAMMA, ..*f }.is_plain();
    for (name, quantity, values, steps, chosen) in [
        (
            "shape-steps",
            "shape",
            Shape::ALL.map(Shape::name).to_vec(),
            &every[..],
            &(|f: &Family, k: usize| f.is_plain() && f.shape == Shape::ALL[k] && f.start == Start::Centre)
                as &dyn Fn(&Family, usize) -> bool,
        ),
        ("alpha-steps", "α", ALPHAS.map(|a| a.to_string()).to_vec(), &FEW_STEPS, &|f, k| {
            hexagon(f) && plain(f) && f.gamma == GAMMA && f.alpha == ALPHAS[k]
        }),
        ("gamma-steps", "γ", GAMMAS.map(|g| g.to_string()).to_vec(), &FEW_STEPS, &|f, k| {
            hexagon(f) && plain(f) && f.alpha == ALPHA && f.gamma == GAMMAS[k]
        }),
    ] {
        let of = |k: usize, steps: u32| best(candidates, &|f| f.steps_per_frame == steps && chosen(f, k));
        let cells = (0..values.len()).map(|k| steps.iter().map(|steps| of(k, *steps)).collect()).collect();
        lab.keep(
            &format!("identified-{name}"),
            &format!(
                "What Table 1 says of {quantity} and the steps in a frame: its largest residual, in frames, at the size \
                 that fits best"
            ),
            HeatMap {
                title: format!("Table 1: largest residual, by {quantity} and steps"),
                x: ("steps per frame".to_owned(), steps.iter().map(u32::to_string).collect()),
                y: (quantity.to_owned(), values),
                cells,
                darkest: 20.0,
                accepted: Some((printed.tolerance, "all four rows within 4 frames".to_owned())),
                digits: 0,
            },
        )?;
    }
    Ok(())
}

/// The least largest residual of Table 1 among candidates.
fn best(candidates: &[Candidate], chosen: &dyn Fn(&Family) -> bool) -> Option<f64> {
    let of = candidates.iter().filter(|c| chosen(&c.family)).map(|c| largest(&c.table_1));
    of.min_by(f64::total_cmp).filter(|least| least.is_finite())
}

/// Size and steps in a frame about the lead, on all eight rows.
fn size_against_steps(lab: &mut Lab, lead: &Fit, printed: &Printed) -> Result<()> {
    let family = lead.candidate.family;
    let sizes: Vec<u32> = lab.pick(SIZES, 21..=21).collect();
    let steps: Vec<u32> = (7..=11).collect();
    let jobs: Vec<(u32, u32)> =
        sizes.iter().flat_map(|size| steps.iter().map(move |steps| (*size, *steps))).collect();
    let seeds = lab.seeds(4);
    let largest_of = |(size, steps): &(u32, u32)| -> Result<Option<f64>> {
        let family = Family { steps_per_frame: *steps, ..family };
        let size = f64::from(*size);
        let region = family.shape.region(size);
        let table_1 = on_table_1(&family, &region, printed)?;
        let candidate = Candidate { family, size, region, table_1 };
        let fit = on_table_2(&candidate, lead.second(), lead.gamma, &seeds, printed)?;
        Ok(Some(largest(&fit.residuals())).filter(|most| most.is_finite()))
    };
    let cells = lab.each(&jobs, largest_of).into_iter().collect::<Result<Vec<_>>>()?;
    lab.keep(
        "identified-size-steps",
        "What both tables say of the sketch's size and the steps in a frame, about the lead: the largest residual of \
         all eight rows, in frames (those of Table 2 in the mean over 4 seeds)",
        HeatMap {
            title: "Both tables: largest residual, by size and steps".to_owned(),
            x: ("steps per frame".to_owned(), steps.iter().map(u32::to_string).collect()),
            y: ("half the width".to_owned(), sizes.iter().map(u32::to_string).collect()),
            cells: cells.chunks(steps.len()).map(<[_]>::to_vec).collect(),
            darkest: 40.0,
            accepted: Some((printed.tolerance, "all eight rows within 4 frames".to_owned())),
            digits: 0,
        },
    )
}

/// gamma of Table 2 against the redraw of r, for the lead's sketch.
fn gamma_against_redraw(lab: &mut Lab, lead: &Fit, printed: &Printed) -> Result<()> {
    let redraws = [Redraw::Frame, Redraw::Step];
    let tenths = lab.pick(&TENTHS[..], &TENTHS[..1]);
    let jobs: Vec<(Redraw, u32)> =
        redraws.iter().flat_map(|redraw| tenths.iter().map(move |tenths| (*redraw, *tenths))).collect();
    let seeds = lab.seeds(8);
    let largest_of = |(redraw, tenths): &(Redraw, u32)| -> Result<Option<f64>> {
        let second = Second { redraw: *redraw, ..lead.second() };
        let gamma = lead.candidate.family.gamma * f64::from(*tenths) / 10.0;
        let fit = on_table_2(&lead.candidate, second, gamma, &seeds, printed)?;
        Ok(Some(largest(&fit.table_2)).filter(|most| most.is_finite()))
    };
    let cells = lab.each(&jobs, largest_of).into_iter().collect::<Result<Vec<_>>>()?;
    let ratio = |tenths: &u32| (f64::from(*tenths) / 10.0).to_string();
    lab.keep(
        "identified-gamma-redraw",
        "What Table 2 says of its gamma and of the redraw of r, for the lead's sketch: the largest residual, in frames \
         (mean over 8 seeds); 1/(1 - r_th) is 5",
        HeatMap {
            title: "Table 2: largest residual, by γ and redraw".to_owned(),
            x: ("γ of Table 2 over γ of Table 1".to_owned(), tenths.iter().map(ratio).collect()),
            y: ("r redrawn".to_owned(), redraws.map(|redraw| redraw.to_string()).to_vec()),
            cells: cells.chunks(tenths.len()).map(<[_]>::to_vec).collect(),
            darkest: 40.0,
            accepted: Some((printed.tolerance, "all four rows within 4 frames".to_owned())),
            digits: 0,
        },
    )
}
