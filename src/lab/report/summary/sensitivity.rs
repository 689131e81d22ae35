//! How near each verdict is to flipping, and on which of the assumed numbers it rests.

use crate::lab::claim::{Claim, Expect, Statistic};
use crate::lab::record::Finding;
use crate::lab::report::Shelf;
use crate::lab::table::{Table, maybe};
use crate::lab::verdict::{average, standard_error, student_975};

/// For each claim under each reading: the tolerance or bound at which its verdict would be the other, how far that is
/// from the one that was declared, and the assumptions of which a quarter more or less turns it.
pub(super) fn table(shelves: &[Shelf], power: &Table) -> Table {
    let mut table = Table::new([
        "claim",
        "reading",
        "expected",
        "tolerance",
        "measured",
        "verdict",
        "flips_at",
        "slack",
        "rests_on",
    ]);
    for shelf in shelves {
        for finding in shelf.verdicts() {
            let Some(claim) = shelf.experiment.claims.iter().find(|claim| claim.id == finding.claim) else {
                continue;
            };
            let flip = flip(claim, finding, &seeds(shelf, finding));
            let rests_on = if shelf.is_default(finding) { rests_on(power, claim.id) } else { String::new() };
            table.row([
                claim.id.into(),
                finding.reading.as_str().into(),
                finding.expected.as_str().into(),
                maybe(finding.tolerance),
                maybe(finding.measured),
                finding.verdict.as_str().into(),
                maybe(flip.map(|flip| flip.at)),
                maybe(flip.and_then(|flip| flip.slack())),
                rests_on.into(),
            ]);
        }
    }
    table
}

/// The numbers of the seeds that a verdict was made of.
fn seeds(shelf: &Shelf, of: &Finding) -> Vec<f64> {
    let own = |f: &&Finding| f.claim == of.claim && f.reading == of.reading && f.verdict.is_empty();
    shelf.findings.iter().filter(own).filter_map(|f| f.measured).collect()
}

/// The assumed numbers, and the readings, whose change turns the claim.
fn rests_on(power: &Table, claim: &str) -> String {
    let mut names: Vec<&str> = Vec::new();
    for row in super::marks::red_rows(power, claim) {
        if row.kind == "assumed" && !names.contains(&row.mutation) {
            names.push(row.mutation);
        }
    }
    names.join(";")
}

/// Where a verdict flips.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flip {
    /// The tolerance, or the bound, at which it would be the other.
    at: f64,
    /// The tolerance or bound that was declared.
    declared: f64,
}

impl Flip {
    /// The distance between the two, as a share of what was declared; none where that is zero.
    fn slack(self) -> Option<f64> {
        (self.declared != 0.0).then(|| (self.declared - self.at).abs() / self.declared.abs())
    }
}

/// Where the verdict of a claim flips; none where no tolerance does (a statement is true or not).
fn flip(claim: &Claim, finding: &Finding, seeds: &[f64]) -> Option<Flip> {
    if matches!(claim.statistic, Statistic::Share(_)) {
        return None; // what counts there is how many seeds meet the bound
    }
    let measured = finding.measured?;
    // A mean holds when its interval does.
    let reach = match claim.statistic {
        Statistic::Mean if seeds.len() > 1 => student_975(seeds.len() - 1) * standard_error(seeds),
        _ => 0.0,
    };
    let centre =
        if seeds.len() > 1 && claim.statistic == Statistic::Mean { average(seeds) } else { measured };
    let side = if finding.verdict == "holds" { reach } else { -reach };
    Some(match claim.expect {
        Expect::Near { value, within } => {
            Flip { at: ((centre - value).abs() + side).max(0.0), declared: within }
        }
        Expect::AtLeast(declared) => Flip { at: centre - side, declared },
        Expect::AtMost(declared) => Flip { at: centre + side, declared },
        Expect::Between(from, to) => {
            let (low, high) = (centre - side, centre + side);
            if (low - from).abs() < (to - high).abs() {
                Flip { at: low, declared: from }
            } else {
                Flip { at: high, declared: to }
            }
        }
        Expect::Rises => Flip { at: centre, declared: 0.0 },
        Expect::Exceeds(_) | Expect::True => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flipped(
        expect: Expect,
        statistic: Statistic,
        measured: f64,
        verdict: &str,
        seeds: &[f64],
    ) -> Option<Flip> {
        let claim = Claim { id: "p/e/c", source: "", says: "", expect, statistic, reason: "", known: &[] };
        let finding = Finding {
            claim: "p/e/c".into(),
            source: String::new(),
            reading: String::new(),
            seed: "all".into(),
            expected: String::new(),
            tolerance: None,
            measured: Some(measured),
            command: String::new(),
            verdict: verdict.into(),
        };
        flip(&claim, &finding, seeds)
    }

    #[test]
    fn a_tolerance_flips_where_it_equals_the_distance() {
        let near = Expect::Near { value: 160.0, within: 4.0 };
        let flip = flipped(near, Statistic::Each, 163.0, "holds", &[]).unwrap();
        assert_eq!((flip.at, flip.slack()), (3.0, Some(0.25)));
        assert_eq!(flipped(Expect::AtLeast(2.0), Statistic::Each, 3.0, "holds", &[]).unwrap().at, 3.0);
        assert_eq!(
            flipped(Expect::Between(0.0, 10.0), Statistic::Each, 9.0, "holds", &[]).unwrap().declared,
            10.0
        );
        assert_eq!(flipped(Expect::True, Statistic::Each, 1.0, "holds", &[]), None);
    }

    #[test]
    fn the_interval_of_a_mean_counts() {
        // Mean 2, standard error 1 of two seeds: 12.706 to both sides.
        let seeds = [1.0, 3.0];
        let flip = flipped(Expect::AtMost(20.0), Statistic::Mean, 2.0, "holds", &seeds).unwrap();
        assert!((flip.at - 14.706).abs() < 1e-3, "{flip:?}");
        let flip = flipped(Expect::AtMost(-20.0), Statistic::Mean, 2.0, "fails", &seeds).unwrap();
        assert!((flip.at + 10.706).abs() < 1e-3, "{flip:?}");
    }
}
