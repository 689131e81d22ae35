//! Held-out rows: what is predicted rather than fitted.

use snowglobe::frost::{Inflow, Redraw};
use snowglobe::lab::{Lab, Result, Table};

use super::super::setup::GammaRule;
use super::super::shape::{Shape, Start};
use super::claims::{LEFT_OUT, PREDICTED};
use super::fit::{Candidate, Fit, Printed, Second, largest, on_table_2, squares};
use super::select::is_of_class;

/// Predicts Table 2 from Table 1, and each row from the other seven.
pub fn judge(
    lab: &mut Lab,
    candidates: &[Candidate],
    screened: &[Fit],
    seeds: &[u64],
    printed: &Printed,
) -> Result<()> {
    let mut table = Table::new([
        "held_out",
        "fitted_to",
        "shape",
        "half_width",
        "cells",
        "steps_per_frame",
        "row",
        "end_frame_printed",
        "end_frame_predicted",
        "residual",
    ]);
    let predicted = table_2_from_table_1(lab, candidates, seeds, printed)?;
    for fit in &predicted {
        for row in 4..8 {
            table.row(cells("Table 2", "Table 1", fit, row, printed));
        }
    }
    let of_one_number = predicted.iter().filter(|fit| fit.candidate.family.shape.numbers() == 1);
    let best =
        of_one_number.min_by(|a, b| squares(&a.candidate.table_1).total_cmp(&squares(&b.candidate.table_1)));
    lab.found(&PREDICTED, best.map(|fit| largest(&fit.table_2)).filter(|most| most.is_finite()));

    let class: Vec<&Fit> = screened.iter().filter(|fit| is_of_class(fit, Redraw::Frame)).collect();
    let mut errors = Vec::new();
    for row in 0..8 {
        let of_others = |fit: &Fit| {
            let residuals = fit.residuals();
            squares(&residuals) - residuals[row] * residuals[row]
        };
        let finite = class.iter().filter(|fit| fit.residuals().iter().all(|r| r.is_finite()));
        if let Some(fit) = finite.min_by(|a, b| of_others(a).total_cmp(&of_others(b))) {
            errors.push(fit.residuals()[row]);
            table.row(cells("one row", "the other seven", fit, row, printed));
        }
    }
    lab.found(&LEFT_OUT, Some(largest(&errors)).filter(|_| !errors.is_empty()));
    lab.keep(
        "held-out",
        "Rows predicted from rows that they had no part in: Table 2 from the sketch of each shape that fits Table 1 \
         best (mean over 20 seeds), and each row from the sketch that fits the other seven best (8 seeds)",
        table,
    )
}

/// For each shape the sketch that fits Table 1 best, on Table 2, to which nothing is fitted.
fn table_2_from_table_1(
    lab: &Lab,
    candidates: &[Candidate],
    seeds: &[u64],
    printed: &Printed,
) -> Result<Vec<Fit>> {
    let best = Shape::ALL.iter().filter_map(|shape| {
        let of_shape = candidates
            .iter()
            .filter(|c| c.family.is_plain() && c.family.start == Start::Centre && c.family.shape == *shape);
        of_shape.min_by(|a, b| squares(&a.table_1).total_cmp(&squares(&b.table_1)))
    });
    let best: Vec<&Candidate> = best.collect();
    let second = Second { inflow: Inflow::ReiterGated, redraw: Redraw::Frame, rule: GammaRule::MeanKept };
    let fits = lab.each(&best, |candidate| {
        let gamma = second.rule.gamma(candidate.family.gamma, printed.threshold);
        on_table_2(candidate, second, gamma, seeds, printed)
    });
    fits.into_iter().collect()
}

fn cells(
    held_out: &str,
    fitted_to: &str,
    fit: &Fit,
    row: usize,
    printed: &Printed,
) -> [snowglobe::lab::Cell; 10] {
    let (name, frame) = printed.row(row);
    let (candidate, residual) = (&fit.candidate, fit.residuals()[row]);
    [
        held_out.into(),
        fitted_to.into(),
        candidate.family.shape.name().into(),
        candidate.size.into(),
        candidate.region.len().into(),
        candidate.family.steps_per_frame.into(),
        name.into(),
        frame.into(),
        (frame + residual).into(),
        residual.into(),
    ]
}
