//! One experiment with one thing changed.

use std::panic::{self, AssertUnwindSafe};
use std::path::Path;

use rayon::prelude::*;

use super::FACTORS;
use crate::lab::error::{Error, Result};
use crate::lab::progress::Progress;
use crate::lab::record::{Finding, Given, read_findings};
use crate::lab::report::default_reading;
use crate::lab::run::rehearsal;
use crate::lab::suite::{Change, Experiment, Mutation, Options, Paper};
use crate::lab::table::{Table, maybe};

/// What one mutation did to one claim.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub experiment: String,
    /// The number's name, or the quantity that is read otherwise.
    pub mutation: String,
    /// `printed`, `assumed`, `mutant` or `reading`.
    pub kind: String,
    pub from: String,
    pub to: String,
    pub claim: String,
    pub before: Option<f64>,
    pub after: Option<f64>,
    pub verdict_before: String,
    /// A verdict, or `broke` where the model refused the number or broke with it.
    pub verdict_after: String,
}

impl Row {
    /// Whether a claim that held fails now. That a run breaks says nothing of a claim.
    pub fn is_red(&self) -> bool {
        self.verdict_before == "holds" && self.verdict_after == "fails"
    }
}

const COLUMNS: [&str; 10] = [
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
];

/// The rows as a table, so that an interrupted run goes on.
pub(super) fn to_table(rows: &[Row]) -> Table {
    let mut table = Table::new(COLUMNS);
    for r in rows {
        let text = [&r.experiment, &r.mutation, &r.kind, &r.from, &r.to, &r.claim];
        let [experiment, mutation, kind, from, to, claim] = text.map(|text| text.as_str().into());
        let verdicts = [&r.verdict_before, &r.verdict_after].map(|text| text.as_str().into());
        let [verdict_before, verdict_after] = verdicts;
        let (before, after) = (maybe(r.before), maybe(r.after));
        table.row([
            experiment,
            mutation,
            kind,
            from,
            to,
            claim,
            before,
            after,
            verdict_before,
            verdict_after,
        ]);
    }
    table
}

/// The rows of a table.
pub(super) fn from_table(table: &Table) -> std::result::Result<Vec<Row>, String> {
    if table.columns != COLUMNS {
        return Err(format!("columns {COLUMNS:?} are accepted"));
    }
    let number = |cell: &str| match cell {
        "" => Ok(None),
        cell => cell.parse().map(Some).map_err(|_| format!("`{cell}` is no number")),
    };
    let rows = table.rows.iter().map(|cells| {
        let text = |k: usize| cells[k].clone();
        Ok(Row {
            experiment: text(0),
            mutation: text(1),
            kind: text(2),
            from: text(3),
            to: text(4),
            claim: text(5),
            before: number(&cells[6])?,
            after: number(&cells[7])?,
            verdict_before: text(8),
            verdict_after: text(9),
        })
    });
    rows.collect()
}

/// A mutation to try: kind, the number's value as it is, what it becomes.
struct Trial {
    kind: &'static str,
    from: String,
    to: String,
    mutation: Mutation,
}

/// Every number a quarter more and a quarter less, then the experiment's own mutant.
pub(super) fn all_of(paper: &Paper, experiment: &Experiment, options: &Options) -> Result<Vec<Row>> {
    let id = format!("{}/{}", paper.id, experiment.id);
    let whole = rehearsal(paper, experiment, options)?;
    let before = leads(paper, &whole.findings);
    let trials = trials(experiment, &whole.given);
    let bar = Progress::of(&format!("power of {id}")).over(trials.len() as u64);
    let loud = panic::take_hook();
    panic::set_hook(Box::new(|_| {})); // what breaks is a row
    let rows: Vec<Vec<Row>> = trials
        .par_iter()
        .map(|trial| {
            let mut mutated = options.clone();
            mutated.mutations = vec![trial.mutation.clone()];
            let run = || rehearsal(paper, experiment, &mutated);
            let after = panic::catch_unwind(AssertUnwindSafe(run)).ok().and_then(Result::ok);
            bar.inc(1);
            let after = after.map(|finished| leads(paper, &finished.findings));
            rows_of(&id, trial, &before, after.as_deref())
        })
        .collect();
    panic::set_hook(loud);
    bar.finish_and_clear();
    Ok(rows.concat())
}

fn trials(experiment: &Experiment, given: &(Vec<Given>, Vec<Given>)) -> Vec<Trial> {
    let mut trials: Vec<Trial> = Vec::new();
    for (kind, list) in [("printed", &given.0), ("assumed", &given.1)] {
        let mut names: Vec<&str> = Vec::new();
        for given in list {
            if !names.contains(&given.name.as_str()) {
                names.push(&given.name);
            }
        }
        for name in names {
            let values: Option<Vec<f64>> = list
                .iter()
                .filter(|given| given.name == name)
                .map(|given| given.value.parse().ok())
                .collect();
            let Some(values) = values else { continue }; // words are readings or rules, not numbers
            for factor in FACTORS {
                let change = Change::Times(factor);
                let join = |change: &dyn Fn(f64) -> f64| {
                    values.iter().map(|value| change(*value).to_string()).collect::<Vec<_>>().join(" ")
                };
                let (from, to) = (join(&|value| value), join(&|value| change.of(value)));
                trials.push(Trial { kind, from, to, mutation: Mutation { name: name.to_owned(), change } });
            }
        }
    }
    let mutant = &experiment.mutant;
    let values = given.0.iter().chain(&given.1).filter(|given| given.name == mutant.changes);
    let from = values.map(|given| given.value.clone()).collect::<Vec<_>>().join(" ");
    let mutation = Mutation { name: mutant.changes.to_owned(), change: Change::To(mutant.to) };
    trials.push(Trial { kind: "mutant", from, to: mutant.to.to_string(), mutation });
    trials
}

/// The row by which each claim is judged first: the default reading's, else the first.
fn leads(paper: &Paper, findings: &[Finding]) -> Vec<Finding> {
    let default = default_reading(paper);
    let mut leads: Vec<Finding> = Vec::new();
    for finding in findings.iter().filter(|f| !f.verdict.is_empty()) {
        match leads.iter_mut().find(|lead| lead.claim == finding.claim) {
            None => leads.push(finding.clone()),
            Some(lead) if lead.reading != default && finding.reading == default => *lead = finding.clone(),
            Some(_) => {}
        }
    }
    leads
}

fn rows_of(id: &str, trial: &Trial, before: &[Finding], after: Option<&[Finding]>) -> Vec<Row> {
    let row = |was: &Finding| {
        let is = after.and_then(|after| after.iter().find(|f| f.claim == was.claim));
        Row {
            experiment: id.to_owned(),
            mutation: trial.mutation.name.clone(),
            kind: trial.kind.to_owned(),
            from: trial.from.clone(),
            to: trial.to.clone(),
            claim: was.claim.clone(),
            before: was.measured,
            after: is.and_then(|f| f.measured),
            verdict_before: was.verdict.clone(),
            verdict_after: is.map_or_else(|| "broke".to_owned(), |f| f.verdict.clone()),
        }
    };
    before.iter().map(row).collect()
}

/// Every formula read otherwise, one quantity at a time: what the findings on disk say of it.
pub(super) fn readings(paper: &Paper, experiment: &Experiment, results: &Path) -> Result<Vec<Row>> {
    let id = format!("{}/{}", paper.id, experiment.id);
    let findings = read_findings(&results.join(&id))
        .map_err(|_| Error::usage("no findings there; run the experiment first").at(&id))?;
    let default = default_reading(paper);
    let verdicts = || findings.iter().filter(|f| !f.verdict.is_empty());
    let mut rows = Vec::new();
    for is in verdicts() {
        let changed: Vec<(&str, &str)> =
            default.split(';').zip(is.reading.split(';')).filter(|(was, is)| was != is).collect();
        let [(from, to)] = changed[..] else { continue };
        let Some(was) = verdicts().find(|f| f.claim == is.claim && f.reading == default) else { continue };
        let variant = |part: &str| part.split_once('=').map_or(part, |(_, variant)| variant).to_owned();
        rows.push(Row {
            experiment: id.clone(),
            mutation: from.split_once('=').map_or(from, |(quantity, _)| quantity).to_owned(),
            kind: "reading".to_owned(),
            from: variant(from),
            to: variant(to),
            claim: is.claim.clone(),
            before: was.measured,
            after: is.measured,
            verdict_before: was.verdict.clone(),
            verdict_after: is.verdict.clone(),
        });
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(before: &str, after: &str) -> Row {
        Row {
            experiment: "p/e".into(),
            mutation: "two".into(),
            kind: "printed".into(),
            from: "2".into(),
            to: "2.5".into(),
            claim: "p/e/c".into(),
            before: Some(0.1f64.sqrt()),
            after: None,
            verdict_before: before.into(),
            verdict_after: after.into(),
        }
    }

    #[test]
    fn rows_come_back_whole() {
        let rows = [row("holds", "fails"), row("fails", "broke")];
        let bytes = to_table(&rows).to_csv().unwrap();
        assert_eq!(from_table(&Table::from_csv(&bytes).unwrap()).unwrap(), rows);
        let mut other = to_table(&rows);
        other.rows[0][6] = "much".into();
        assert!(from_table(&other).unwrap_err().contains("`much`"));
    }

    #[test]
    fn red_is_what_held_and_fails_now() {
        assert!(row("holds", "fails").is_red());
        for (before, after) in
            [("holds", "holds"), ("fails", "fails"), ("holds", "broke"), ("holds", "undecided")]
        {
            assert!(!row(before, after).is_red());
        }
    }
}
