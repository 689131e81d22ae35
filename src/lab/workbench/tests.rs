//! A paper of our own invention, run in memory.

use std::path::PathBuf;

use super::*;
use crate::lab::run::rehearse;
use crate::lab::suite::{Change, Mutant, Mutation, ReadingKind};

#[derive(Clone, Copy, PartialEq)]
enum Sign {
    AsPrinted,
    Turned,
}

impl Reading for Sign {
    const QUANTITY: &'static str = "sign";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::Turned];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::Turned => "turned",
        }
    }
}

const fn claim(id: &'static str, expect: Expect, statistic: Statistic) -> Claim {
    Claim { id, source: "p. 1", says: "so", expect, statistic, reason: "because", known: &[] }
}

static NEAR: Claim = claim("p/e/near", Expect::Near { value: 2.0, within: 0.5 }, Statistic::Each);
static MEAN: Claim = claim("p/e/mean", Expect::Near { value: 2.0, within: 0.5 }, Statistic::Mean);
static MORE: Claim = claim("p/e/more", Expect::Exceeds("p/e/mean"), Statistic::Mean);
static OTHER: Claim = claim("p/e/other", Expect::True, Statistic::Each);

static READINGS: [ReadingKind; 1] = [ReadingKind {
    quantity: "sign",
    says: "",
    variants: || vec!["as-printed", "turned"],
    default: "turned",
}];

/// Sets of claims that are declared.
static ONLY_NEAR: [&Claim; 1] = [&NEAR];
static SEEDED: [&Claim; 2] = [&MEAN, &MORE];
static ONE_TOO_MANY: [&Claim; 2] = [&NEAR, &OTHER];
static ANOTHER: [&Claim; 1] = [&OTHER];

fn changed(name: &str) -> Vec<Mutation> {
    vec![Mutation { name: name.to_owned(), change: Change::To(3.0) }]
}

fn lab_of(
    claims: &'static [&'static Claim],
    run: fn(&mut Lab) -> Result<()>,
    change: impl FnOnce(&mut Options),
) -> Result<Vec<Finding>> {
    let mutant = Mutant { changes: "two", to: 3.0, why: "it is not two", turns_red: &["p/e/near"] };
    let experiment = Experiment { id: "e", title: "", source: "", says: "", claims, run, mutant };
    let paper = Paper {
        id: "p",
        title: "",
        english: "",
        about: "",
        authors: "",
        sources: "",
        readings: &READINGS,
        experiments: &[],
    };
    let mut options = Options::committed(PathBuf::new());
    change(&mut options);
    rehearse(&paper, &experiment, &options)
}

fn near(lab: &mut Lab) -> Result<()> {
    for sign in lab.readings::<Sign>() {
        lab.reading(sign);
        let two = lab.printed("two", 2.0, "p. 1");
        lab.found(&NEAR, if sign == Sign::Turned { two } else { -two }).by("echo 2");
    }
    Ok(())
}

fn seeded(lab: &mut Lab) -> Result<()> {
    for seed in lab.seeds(4) {
        lab.found_with(&MEAN, seed, 1.8 + 0.1 * seed as f64);
        lab.found_with(&MORE, seed, 3.0 + 0.1 * seed as f64);
    }
    Ok(())
}

#[test]
fn a_finding_names_its_reading_and_its_command() {
    let findings = lab_of(&ONLY_NEAR, near, |_| ()).unwrap();
    let rows: Vec<_> = findings
        .iter()
        .map(|f| (f.reading.as_str(), f.seed.as_str(), f.measured, f.verdict.as_str()))
        .collect();
    assert_eq!(
        rows,
        [("sign=as-printed", "all", Some(-2.0), "fails"), ("sign=turned", "all", Some(2.0), "holds")]
    );
    assert_eq!((findings[0].command.as_str(), findings[0].tolerance), ("echo 2", Some(0.5)));
    let narrowed =
        lab_of(&ONLY_NEAR, near, |options| options.readings = vec![("sign".into(), "turned".into())])
            .unwrap();
    assert_eq!(narrowed.len(), 1);
}

#[test]
fn seeds_have_rows_of_their_own_and_one_for_all() {
    let findings = lab_of(&SEEDED, seeded, |_| ()).unwrap();
    let mean: Vec<_> = findings.iter().filter(|f| f.claim == MEAN.id).collect();
    let seeds: Vec<&str> = mean.iter().map(|f| f.seed.as_str()).collect();
    assert_eq!(seeds, ["1", "2", "3", "4", "all"]);
    assert!(mean[..4].iter().all(|f| f.verdict.is_empty()));
    assert_eq!(
        (mean[4].verdict.as_str(), mean[4].measured.map(|m| (m * 100.0).round())),
        ("holds", Some(205.0))
    );
    let more = findings.last().unwrap();
    assert_eq!((more.claim.as_str(), more.verdict.as_str()), ("p/e/more", "holds"));
    // Its own numbers are shown, their differences judged.
    assert!((more.measured.unwrap() - 3.25).abs() < 1e-12);
}

#[test]
fn at_smoke_scale_every_claim_is_undecided() {
    let findings = lab_of(&ONLY_NEAR, near, |options| options.scale = Scale::Smoke).unwrap();
    assert!(findings.iter().all(|f| f.verdict == "undecided"));
}

#[test]
fn what_is_declared_is_found_and_what_is_found_is_declared() {
    let missing = lab_of(&ONE_TOO_MANY, near, |_| ()).unwrap_err().to_string();
    assert!(missing.contains("p/e/other") && missing.contains("not found"), "{missing}");
    let extra = lab_of(&ANOTHER, near, |_| ()).unwrap_err().to_string();
    assert!(extra.contains("p/e/near") && extra.contains("not declared"), "{extra}");
    let twice = |lab: &mut Lab| {
        lab.found(&NEAR, 2.0);
        lab.found(&NEAR, 2.0);
        Ok(())
    };
    assert!(lab_of(&ONLY_NEAR, twice, |_| ()).unwrap_err().to_string().contains("found twice"));
}

#[test]
fn a_mutation_changes_the_number_of_its_name_and_no_other() {
    let mutated = lab_of(&ONLY_NEAR, near, |options| options.mutations = changed("two")).unwrap();
    assert!(mutated.iter().all(|f| f.verdict == "fails"));
    let unknown = lab_of(&ONLY_NEAR, near, |options| options.mutations = changed("three"));
    assert!(unknown.unwrap_err().to_string().contains("three"));
}

#[test]
fn the_smallest_rise_decides() {
    assert_eq!(smallest_rise(&[1.0, 3.0, 2.5]), Some(-0.5));
    assert_eq!(smallest_rise(&[1.0]), None);
}
