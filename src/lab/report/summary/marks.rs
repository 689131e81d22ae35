//! Marks of figures and tables, after the Stanford Exploration Project's: reproduced, conditional, not reproducible.

use super::coverage::{Entry, Index};
use crate::lab::record::Finding;
use crate::lab::report::Shelf;
use crate::lab::table::Table;

/// A mark, and what it depends on.
struct Mark {
    mark: &'static str,
    conditions: Vec<String>,
    why: String,
}

/// The mark of every figure and table that the papers print.
///
/// *Reproduced*: every claim that judges it holds under the default reading, and no other reading and no quarter more or
/// less of an assumed number turns one. *Conditional*: all hold, but something that the page does not fix can turn one.
/// *Not reproducible*: a claim does not hold, or nothing can judge it.
pub(super) fn table(shelves: &[Shelf], indices: &[Index], power: &Table) -> Table {
    let mut table = Table::new(["paper", "label", "kind", "claims", "mark", "conditions", "why"]);
    for index in indices {
        for entry in index.entries.iter().filter(|entry| entry.kind == "figure" || entry.kind == "table") {
            let Mark { mark, conditions, why } = mark(shelves, entry, power);
            table.row([
                index.paper.as_str().into(),
                label(entry).into(),
                entry.kind.as_str().into(),
                entry.claims.join(";").into(),
                mark.into(),
                conditions.join("; ").into(),
                why.into(),
            ]);
        }
    }
    table
}

/// `Fig. 4(a)` of `figure-4a`.
fn label(entry: &Entry) -> String {
    let number = entry.id.split_once('-').map_or(entry.id.as_str(), |(_, number)| number);
    let digits = number.trim_end_matches(|c: char| c.is_ascii_lowercase());
    let part = &number[digits.len()..];
    let name = if entry.kind == "table" { "Table" } else { "Fig." };
    if part.is_empty() { format!("{name} {digits}") } else { format!("{name} {digits}({part})") }
}

fn mark(shelves: &[Shelf], entry: &Entry, power: &Table) -> Mark {
    let not = |why: String| Mark { mark: "not-reproducible", conditions: Vec::new(), why };
    if entry.claims.is_empty() {
        return not(if entry.why.is_empty() { "nothing judges it".to_owned() } else { entry.why.clone() });
    }
    let mut conditions: Vec<String> = Vec::new();
    for claim in &entry.claims {
        let Some((shelf, lead)) = shelves.iter().find_map(|shelf| Some((shelf, shelf.lead(claim)?))) else {
            return not(format!("{claim} has not been judged"));
        };
        if lead.verdict != "holds" {
            let declared = shelf.experiment.claims.iter().find(|c| c.id == claim);
            let known = declared.and_then(|c| c.known_under(&lead.reading));
            return not(format!(
                "{claim} {}: {}",
                lead.verdict,
                known.unwrap_or("its interval straddles the bound")
            ));
        }
        let turned = shelf.verdicts().into_iter().filter(|f| f.claim == *claim && f.verdict != "holds");
        let words = turned.filter_map(|f| only_difference(lead, f)).map(|variant| format!("not {variant}"));
        let numbers = red_rows(power, claim)
            .filter(|row| row.kind == "assumed")
            .map(|row| format!("{} = {}", row.mutation, row.from));
        for condition in words.chain(numbers) {
            if !conditions.contains(&condition) {
                conditions.push(condition);
            }
        }
    }
    let mark = if conditions.is_empty() { "reproduced" } else { "conditional" };
    Mark { mark, conditions, why: entry.why.clone() }
}

/// The one part in which another reading differs from the first: `inflow=as-printed`.
fn only_difference<'f>(first: &Finding, other: &'f Finding) -> Option<&'f str> {
    let mut parts = first.reading.split(';').zip(other.reading.split(';')).filter(|(a, b)| a != b);
    let (_, part) = parts.next()?;
    parts.next().is_none().then_some(part)
}

/// What turned a claim red.
pub(super) struct Red<'t> {
    pub mutation: &'t str,
    pub kind: &'t str,
    pub from: &'t str,
}

/// The mutations that turned a claim red.
pub(super) fn red_rows<'t>(power: &'t Table, claim: &str) -> impl Iterator<Item = Red<'t>> {
    let at = |name: &str| power.columns.iter().position(|column| column == name);
    let columns = (at("claim"), at("mutation"), at("kind"), at("from"), at("red"));
    let claim = claim.to_owned();
    power.rows.iter().filter_map(move |row| {
        let (Some(of), Some(mutation), Some(kind), Some(from), Some(red)) = columns else { return None };
        (row[of] == claim && row[red] == "true").then(|| Red {
            mutation: &row[mutation],
            kind: &row[kind],
            from: &row[from],
        })
    })
}
