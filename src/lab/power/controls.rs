//! Negative controls: models that know nothing, judged as the real one is.

use std::path::Path;

use crate::lab::claim::{Claim, Expect, Statistic};
use crate::lab::error::Result;
use crate::lab::record::read_findings;
use crate::lab::report::default_reading;
use crate::lab::suite::{Experiment, Paper};
use crate::lab::table::Table;
use crate::lab::verdict::{Judgement, Verdict, judge};

/// For each experiment: how many of its claims hold, at best hold of one constant, and hold of its own measured
/// numbers moved on by one claim.
pub(super) fn table(selection: &[(&Paper, &Experiment)], results: &Path) -> Result<Table> {
    let mut table =
        Table::new(["experiment", "claims", "hold", "hold_of_a_constant", "constant", "hold_if_shuffled"]);
    for (paper, experiment) in selection {
        let measured = measured(paper, experiment, results)?;
        let holds = |claim: &Claim, value| verdict(claim, value) == Verdict::Holds;
        let as_measured =
            experiment.claims.iter().zip(&measured).filter(|(claim, value)| holds(claim, **value)).count();
        let (best, constant) = best_constant(experiment);
        let moved = measured.iter().cycle().skip(1);
        let shuffled =
            experiment.claims.iter().zip(moved).filter(|(claim, value)| holds(claim, **value)).count();
        table.row([
            format!("{}/{}", paper.id, experiment.id).into(),
            experiment.claims.len().into(),
            as_measured.into(),
            best.into(),
            constant.into(),
            shuffled.into(),
        ]);
    }
    Ok(table)
}

/// The measured number of each claim under the default reading; of one that compares, by how much it is greater.
fn measured(paper: &Paper, experiment: &Experiment, results: &Path) -> Result<Vec<Option<f64>>> {
    let findings = read_findings(&results.join(paper.id).join(experiment.id))?;
    let default = default_reading(paper);
    let lead = |id: &str| {
        let of_claim = || findings.iter().filter(|f| f.claim == id && !f.verdict.is_empty());
        of_claim().find(|f| f.reading == default).or_else(|| of_claim().next()).and_then(|f| f.measured)
    };
    let value = |claim: &&Claim| match claim.expect {
        Expect::Exceeds(other) => lead(claim.id).zip(lead(other)).map(|(mine, theirs)| mine - theirs),
        _ => lead(claim.id),
    };
    Ok(experiment.claims.iter().map(value).collect())
}

/// The constant that most claims of an experiment accept, among all the bounds that they name.
fn best_constant(experiment: &Experiment) -> (usize, f64) {
    let named = experiment.claims.iter().flat_map(|claim| match claim.expect {
        Expect::Near { value, within } => vec![value - within, value, value + within],
        Expect::Between(from, to) => vec![from, 0.5 * (from + to), to],
        Expect::AtLeast(bound) | Expect::AtMost(bound) => vec![bound],
        Expect::Rises | Expect::Exceeds(_) | Expect::True => vec![0.0, 1.0],
    });
    let mut best = (0, 0.0);
    for constant in named {
        let count = experiment.claims.iter().filter(|c| verdict(c, Some(constant)) == Verdict::Holds).count();
        if count > best.0 {
            best = (count, constant);
        }
    }
    best
}

/// What one number says of a claim, whatever its statistic. The same constant exceeds nothing and never rises.
fn verdict(claim: &Claim, value: Option<f64>) -> Verdict {
    let expect = match claim.expect {
        Expect::Exceeds(_) => Expect::Rises,
        other => other,
    };
    let Judgement { verdict, .. } = judge(expect, Statistic::Each, &[value], &[value]);
    verdict
}
