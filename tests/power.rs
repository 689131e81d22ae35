//! Claims have power: a wrong model, a model that knows nothing, and a table with its rows shuffled do not pass.

mod papers;

use papers::{SUITE, default_readings};
use snowglobe::lab::{
    Change, Claim, Expect, Finding, Judgement, Mutation, Options, Statistic, Verdict, judge, read_findings,
    rehearse,
};

/// Each experiment's mutant, a number changed, turns the claims red that it says.
#[test]
fn mutants_turn_their_claims_red() {
    for (paper, experiment) in SUITE.select(&[]).unwrap() {
        let mutant = &experiment.mutant;
        let mutation = Mutation { name: mutant.changes.to_owned(), change: Change::To(mutant.to) };
        let options = Options { mutations: vec![mutation], ..default_readings() };
        let findings = rehearse(paper, experiment, &options).unwrap();
        for claim in mutant.turns_red {
            let verdicts: Vec<&Finding> =
                findings.iter().filter(|f| f.claim == *claim && !f.verdict.is_empty()).collect();
            assert!(!verdicts.is_empty());
            for finding in verdicts {
                let now = finding.verdict.as_str();
                assert_eq!(
                    now, "fails",
                    "{claim} with {} = {}: {:?}",
                    mutant.changes, mutant.to, finding.measured
                );
            }
        }
    }
}

/// The default reading's committed measurements of an experiment, claim by claim.
fn measured(paper: &str, experiment: &str, claims: &[&'static Claim]) -> Vec<(&'static Claim, Option<f64>)> {
    let folder = format!("{}/results/{paper}/{experiment}", env!("CARGO_MANIFEST_DIR"));
    let findings = read_findings(std::path::Path::new(&folder)).unwrap();
    let lead = |id: &str| findings.iter().find(|f| f.claim == id && f.seed == "all").and_then(|f| f.measured);
    claims.iter().map(|claim| (*claim, lead(claim.id))).collect()
}

fn verdict(claim: &Claim, value: Option<f64>) -> Verdict {
    let expect = match claim.expect {
        Expect::Exceeds(_) => Expect::Rises,
        other => other,
    };
    let Judgement { verdict, .. } = judge(expect, Statistic::Each, &[value], &[value]);
    verdict
}

/// Whatever constant a trivial model returns for every claim of an experiment, some claim fails.
#[test]
fn a_model_that_returns_constants_does_not_pass() {
    for (paper, experiment) in SUITE.select(&[]).unwrap() {
        let constants = experiment.claims.iter().flat_map(|claim| match claim.expect {
            Expect::Near { value, within } => vec![value, value - within, value + within],
            Expect::Between(from, to) => vec![from, to, 0.5 * (from + to)],
            Expect::AtLeast(bound) | Expect::AtMost(bound) => vec![bound],
            Expect::Rises | Expect::Exceeds(_) | Expect::True => vec![0.0, 1.0],
        });
        // One target for all its sketches: there the mutant, not a constant, tells a wrong model.
        let one_value = experiment.claims.windows(2).all(|pair| pair[0].expect == pair[1].expect);
        for constant in constants.filter(|_| !one_value) {
            let passes =
                experiment.claims.iter().all(|claim| verdict(claim, Some(constant)) == Verdict::Holds);
            assert!(!passes, "{}/{} passes with {constant} everywhere", paper.id, experiment.id);
        }
    }
}

/// The measurements of the tables, moved on by one row or turned upside down, do not pass.
#[test]
fn a_table_with_its_rows_shuffled_does_not_pass() {
    for table in ["table-1", "table-2"] {
        let [(paper, experiment)] = SUITE.select(&[format!("amano/{table}")]).unwrap()[..] else { panic!() };
        let rows: Vec<_> = measured(paper.id, experiment.id, experiment.claims)
            .into_iter()
            .filter(|(claim, _)| claim.id.contains("/step-"))
            .collect();
        assert_eq!(rows.len(), 4);
        let passes = |order: &[usize]| {
            rows.iter().zip(order).all(|((claim, _), other)| verdict(claim, rows[*other].1) == Verdict::Holds)
        };
        for shuffled in [[1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2], [3, 2, 1, 0], [1, 0, 2, 3], [0, 2, 1, 3]] {
            assert!(!passes(&shuffled), "{table} passes as {shuffled:?}");
        }
    }
}
