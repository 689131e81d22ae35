//! What the search leaves: every candidate, the best of each kind, and the lead.

use snowglobe::lab::{Axis, Cell, Draw, Lab, Plot, Result, Series, Table, maybe};

use super::fit::{Candidate, Fit, Printed, largest, squares};
use super::space::{ALPHA, GAMMA};

/// A residual, empty where the film never ends.
fn residual(number: f64) -> Cell {
    maybe(number.is_finite().then_some(number))
}

/// Every candidate for Table 1.
pub fn candidates(lab: &mut Lab, candidates: &[Candidate]) -> Result<()> {
    let mut table = Table::new([
        "inflow",
        "ring_touching_ice",
        "start",
        "shape",
        "half_width",
        "cells",
        "steps_per_frame",
        "alpha",
        "gamma",
        "residual_0",
        "residual_1",
        "residual_2",
        "residual_3",
        "largest",
    ]);
    for Candidate { family, size, region, table_1 } in candidates {
        let [first, second, third, fourth] = table_1.map(residual);
        table.row([
            family.inflow.name().into(),
            family.ring.name().into(),
            family.start.name().into(),
            family.shape.name().into(),
            size.into(),
            region.len().into(),
            family.steps_per_frame.into(),
            family.alpha.into(),
            family.gamma.into(),
            first,
            second,
            third,
            fourth,
            residual(largest(table_1)),
        ]);
    }
    lab.keep("search", "Every sketch that was tried on Table 1: measured less printed end frames", table)
}

/// The best sets of each kind, on all eight rows.
pub fn best(lab: &mut Lab, judged: &[Fit], lead: Option<&Fit>) -> Result<()> {
    let mut table = Table::new([
        "lead",
        "inflow",
        "redraw",
        "ring_touching_ice",
        "start",
        "shape",
        "half_width",
        "cells",
        "steps_per_frame",
        "alpha",
        "gamma",
        "gamma_rule",
        "gamma_at_threshold",
        "fitted_numbers",
        "t1_0",
        "t1_1",
        "t1_2",
        "t1_3",
        "t2_0",
        "t2_1",
        "t2_2",
        "t2_3",
        "seeds",
        "largest",
        "sum_of_squares",
    ]);
    let mut sorted: Vec<&Fit> = judged.iter().collect();
    sorted.sort_by(|a, b| largest(&a.residuals()).total_cmp(&largest(&b.residuals())));
    for fit in sorted {
        let (candidate, family) = (&fit.candidate, &fit.candidate.family);
        let all = fit.residuals();
        let [a, b, c, d, e, f, g, h] = all.map(residual);
        table.row([
            (if lead.is_some_and(|lead| std::ptr::eq(lead, fit)) { "lead" } else { "" }).into(),
            fit.inflow.name().into(),
            fit.redraw.name().into(),
            family.ring.name().into(),
            family.start.name().into(),
            family.shape.name().into(),
            candidate.size.into(),
            candidate.region.len().into(),
            family.steps_per_frame.into(),
            family.alpha.into(),
            family.gamma.into(),
            fit.rule.name().into(),
            fit.gamma.into(),
            fit.fitted_numbers().into(),
            a,
            b,
            c,
            d,
            e,
            f,
            g,
            h,
            fit.seeds.into(),
            residual(largest(&all)),
            residual(squares(&all)),
        ]);
    }
    lab.keep(
        "reconstructions",
        "The best sets of each reading, redraw, gamma rule and shape: measured less printed end frames of all eight \
         rows (those of Table 2 in the mean over seeds), and how many numbers were fitted to them",
        table,
    )
}

/// The set that leads: its rows, what it assumes, and a plot of the residuals.
pub fn lead(lab: &mut Lab, lead: &Fit, printed: &Printed) -> Result<()> {
    let mut table =
        Table::new(["row", "beta", "end_frame_printed", "end_frame", "residual", "standard_error", "within"]);
    for (row, residual) in lead.residuals().into_iter().enumerate() {
        let (name, frame) = printed.row(row);
        let error = (row >= 4).then(|| lead.errors[row - 4]);
        table.row([
            name.into(),
            printed.rows()[row].0.into(),
            frame.into(),
            (frame + residual).into(),
            residual.into(),
            maybe(error),
            (if residual.abs() <= printed.tolerance { "yes" } else { "no" }).into(),
        ]);
    }
    lab.keep("lead", "The eight rows of the set that assumes least, printed and measured", table)?;
    lab.keep(
        "assumed",
        "What the lead assumes that the page does not print, and what was fitted",
        assumed(lead),
    )?;

    let points = |rows: std::ops::Range<usize>| {
        let of_row = |row: usize| (printed.rows()[row].0, lead.residuals()[row]);
        rows.map(of_row).collect::<Vec<_>>()
    };
    let mut second =
        Series::new("Table 2 (mean over 40 seeds, two standard errors)", Draw::Dots, points(4..8));
    second.errors = lead.errors.iter().map(|error| 2.0 * error).collect();
    lab.keep(
        "lead",
        "Residuals of the lead: measured less printed end frames, with the paper's tolerance",
        Plot {
            title: "Measured less printed end frame".to_owned(),
            x: Axis::of("initial value β"),
            y: Axis::within("frames", -10.0, 10.0),
            series: vec![Series::new("Table 1", Draw::Dots, points(0..4)), second],
            bands: vec![("the paper's ± 4 frames".to_owned(), -printed.tolerance, printed.tolerance)],
        },
    )
}

fn assumed(lead: &Fit) -> Table {
    let (candidate, family) = (&lead.candidate, &lead.candidate.family);
    let mut table = Table::new(["quantity", "value", "fitted_to_the_tables", "on_the_page"]);
    let fitted = |was: bool| if was { "yes" } else { "no" };
    let mut row = |quantity: &str, value: String, was: bool, page: &str| {
        table.row([quantity.into(), value.into(), fitted(was).into(), page.into()]);
    };
    row(
        "reading of Eq. (1)",
        lead.inflow.name().to_owned(),
        false,
        "Reiter's rule is named, and Eq. (1) contradicts it",
    );
    row("redraw of r", lead.redraw.name().to_owned(), false, "r has the frame as its index (§3.2)");
    row("ring that touches ice", family.ring.name().to_owned(), false, "left open (§3.2, §3.3)");
    row("start", family.start.name().to_owned(), false, "one start (§4), its place not given");
    row("shape of the sketch", family.shape.name(), false, "not given; of six that were tried");
    row("half its width, in cells", candidate.size.to_string(), true, "not given");
    row("steps per frame", family.steps_per_frame.to_string(), true, "only that a frame has 1/24 s (§4)");
    row("alpha", family.alpha.to_string(), family.alpha != ALPHA, "not given; Reiter's 1");
    row("gamma at r_th 0", family.gamma.to_string(), family.gamma != GAMMA, "0.005 for the pictures (§4)");
    row("gamma at r_th 0.8", lead.gamma.to_string(), false, "not given; gamma / (1 - r_th)");
    table
}
