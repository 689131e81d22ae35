//! What the trials say, for people: which mutation turned which claim red, and which claims nothing can.

use super::trial::Row;
use crate::lab::suite::{Experiment, Paper};
use crate::lab::table::{Table, maybe};

/// The mutations that changed a measured number or a verdict; what stayed as it was is counted in [`claims`] only.
pub(super) fn mutations(rows: &[Row]) -> Table {
    let mut table = Table::new([
        "experiment",
        "mutation",
        "kind",
        "from",
        "to",
        "claim",
        "before",
        "after",
        "verdict_before",
        "verdict_after",
        "red",
    ]);
    let changed = |row: &&Row| row.before != row.after || row.verdict_before != row.verdict_after;
    for row in rows.iter().filter(changed) {
        table.row([
            row.experiment.as_str().into(),
            row.mutation.as_str().into(),
            row.kind.as_str().into(),
            row.from.as_str().into(),
            row.to.as_str().into(),
            row.claim.as_str().into(),
            maybe(row.before.map(short)),
            maybe(row.after.map(short)),
            row.verdict_before.as_str().into(),
            row.verdict_after.as_str().into(),
            row.is_red().into(),
        ]);
    }
    table
}

/// Four significant digits: these are shown, never computed with.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Every claim: how many mutations were tried on it, how many turned it red, and which.
pub(super) fn claims(selection: &[(&Paper, &Experiment)], rows: &[Row]) -> Table {
    let mut table = Table::new(["claim", "verdict", "mutations", "broke", "red", "by"]);
    for claim in selection.iter().flat_map(|(_, experiment)| experiment.claims) {
        let of_claim: Vec<&Row> = rows.iter().filter(|row| row.claim == claim.id).collect();
        let verdict = of_claim.first().map_or("", |row| row.verdict_before.as_str());
        let count = |test: &dyn Fn(&Row) -> bool| of_claim.iter().filter(|row| test(row)).count();
        let mut by: Vec<&str> = Vec::new();
        for row in of_claim.iter().filter(|row| row.is_red()) {
            if !by.contains(&row.mutation.as_str()) {
                by.push(&row.mutation);
            }
        }
        table.row([
            claim.id.into(),
            verdict.into(),
            of_claim.len().into(),
            count(&|row| row.verdict_after == "broke").into(),
            count(&Row::is_red).into(),
            by.join(";").into(),
        ]);
    }
    table
}
