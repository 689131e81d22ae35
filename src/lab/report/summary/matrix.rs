//! The interpretation matrix: each reading of a paper against each of its claims.

use crate::lab::record::Finding;
use crate::lab::report::{Shelf, default_reading};
use crate::lab::suite::{Paper, Suite};
use crate::lab::table::{Table, maybe};

/// Every claim under every reading that it was judged under.
pub(super) fn all(shelves: &[Shelf]) -> Table {
    let mut table = Table::new([
        "paper",
        "experiment",
        "claim",
        "reading",
        "default",
        "expected",
        "tolerance",
        "measured",
        "verdict",
    ]);
    for shelf in shelves {
        for finding in shelf.verdicts() {
            table.row([
                shelf.paper.id.into(),
                format!("{}/{}", shelf.paper.id, shelf.experiment.id).into(),
                finding.claim.as_str().into(),
                finding.reading.as_str().into(),
                shelf.is_default(finding).into(),
                finding.expected.as_str().into(),
                maybe(finding.tolerance),
                maybe(finding.measured),
                finding.verdict.as_str().into(),
            ]);
        }
    }
    table
}

/// How a reading fares.
#[derive(Default)]
struct Score<'a> {
    reading: &'a str,
    claims: usize,
    holds: usize,
    fails: usize,
    undecided: usize,
    /// Of claims that at least two readings were judged by.
    contested: usize,
    contested_holds: usize,
}

impl Score<'_> {
    /// What readings are compared by: claims that hold among the contested, then fewest others.
    fn rank(&self) -> (usize, std::cmp::Reverse<usize>) {
        (self.contested_holds, std::cmp::Reverse(self.contested - self.contested_holds))
    }
}

/// Each reading of each paper: how many claims it satisfies, and whether no other satisfies more.
///
/// Some experiments run under the default reading alone; so that this is no merit of it, readings are compared by the
/// claims that at least two readings were judged by.
pub(super) fn readings(suite: &Suite, shelves: &[Shelf]) -> Table {
    let mut table = Table::new([
        "paper",
        "reading",
        "default",
        "claims",
        "holds",
        "fails",
        "undecided",
        "contested",
        "contested_holds",
        "most",
    ]);
    for paper in suite.papers.iter().filter(|paper| !paper.readings.is_empty()) {
        let scores = scores(paper, shelves);
        let best = scores.iter().map(Score::rank).max();
        for score in &scores {
            table.row([
                paper.id.into(),
                score.reading.into(),
                (score.reading == default_reading(paper)).into(),
                score.claims.into(),
                score.holds.into(),
                score.fails.into(),
                score.undecided.into(),
                score.contested.into(),
                score.contested_holds.into(),
                (Some(score.rank()) == best).into(),
            ]);
        }
    }
    table
}

fn scores<'a>(paper: &Paper, shelves: &'a [Shelf]) -> Vec<Score<'a>> {
    let mut scores: Vec<Score> = Vec::new();
    for shelf in shelves.iter().filter(|shelf| shelf.paper.id == paper.id) {
        for claim in shelf.experiment.claims {
            let rows: Vec<&Finding> = shelf.verdicts().into_iter().filter(|f| f.claim == claim.id).collect();
            for row in &rows {
                let at = scores.iter().position(|s| s.reading == row.reading).unwrap_or_else(|| {
                    scores.push(Score { reading: &row.reading, ..Score::default() });
                    scores.len() - 1
                });
                let score = &mut scores[at];
                let holds = usize::from(row.verdict == "holds");
                score.claims += 1;
                score.holds += holds;
                score.fails += usize::from(row.verdict == "fails");
                score.undecided += usize::from(row.verdict == "undecided");
                if rows.len() > 1 {
                    score.contested += 1;
                    score.contested_holds += holds;
                }
            }
        }
    }
    scores
}

/// The claims that no reading satisfies, each with the reading that comes nearest.
pub(super) fn unmet(shelves: &[Shelf]) -> Table {
    let mut table = Table::new([
        "paper",
        "claim",
        "readings",
        "nearest_reading",
        "measured",
        "expected",
        "tolerance",
        "verdict",
        "known",
    ]);
    for shelf in shelves {
        for claim in shelf.experiment.claims {
            let rows: Vec<&Finding> = shelf.verdicts().into_iter().filter(|f| f.claim == claim.id).collect();
            if rows.is_empty() || rows.iter().any(|row| row.verdict == "holds") {
                continue;
            }
            let (from, to, _) = claim.expect.accepted();
            let off = |row: &Finding| row.measured.map_or(f64::INFINITY, |m| (from - m).max(m - to));
            let Some(nearest) = rows.iter().min_by(|a, b| off(a).total_cmp(&off(b))) else { continue };
            table.row([
                shelf.paper.id.into(),
                claim.id.into(),
                rows.len().into(),
                nearest.reading.as_str().into(),
                maybe(nearest.measured),
                nearest.expected.as_str().into(),
                maybe(nearest.tolerance),
                nearest.verdict.as_str().into(),
                claim.known_under(&nearest.reading).unwrap_or("").into(),
            ]);
        }
    }
    table
}
