//! Committed results made again at paper scale by this profile are the same to the byte; what they say of the claims is
//! what the claims' authors knew.

mod papers;

use std::path::Path;

use papers::SUITE;
use snowglobe::lab::{Expect, Level, Options, Told, compare_folders, read_findings, read_record, run_all};

fn results() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/results"))
}

/// Experiments of a second or two, which touch every floor of the house. `snowglobe check --exact` does all of them.
const QUICK: [&str; 7] = [
    "amano/figure-2",
    "amano/table-1",
    "amano/figure-4",
    "amano/figure-5",
    "amano/descent",
    "amano/reiter",
    "optimizers/control",
];

/// Debug and release agree: this is the one, `results/` was made by the other.
#[test]
fn a_run_by_this_profile_gives_the_committed_bytes() {
    let home = tempfile::tempdir().unwrap();
    let options = Options::committed(home.path().to_path_buf());
    let selection = SUITE.select(&QUICK.map(String::from)).unwrap();
    run_all(&selection, &options, Told::Nothing).unwrap();
    for (paper, experiment) in selection {
        let id = format!("{}/{}", paper.id, experiment.id);
        let cases = compare_folders(&results().join(&id), &home.path().join(&id)).unwrap();
        assert!(!cases.is_empty());
        for case in cases {
            assert_eq!(case.level, Level::Identical, "{id}: {}: {}", case.name, case.detail);
        }
    }
}

/// A failure that nobody explained is a fault; so is an explanation of a failure that is none.
#[test]
fn every_failure_is_known_and_every_known_failure_fails() {
    for (paper, experiment) in SUITE.select(&[]).unwrap() {
        let findings = read_findings(&results().join(paper.id).join(experiment.id)).unwrap();
        for claim in experiment.claims {
            let of_claim = || findings.iter().filter(|f| f.claim == claim.id && !f.verdict.is_empty());
            for finding in of_claim() {
                let known = claim.known_under(&finding.reading);
                match finding.verdict.as_str() {
                    "fails" => assert!(known.is_some(), "{} [{}] fails: why?", claim.id, finding.reading),
                    "holds" => assert!(
                        known.is_none(),
                        "{} [{}] holds, though: {known:?}",
                        claim.id,
                        finding.reading
                    ),
                    _ => {}
                }
            }
            for known in claim.known {
                let parts: Vec<&str> = known.reading.split(';').collect();
                let applies = |reading: &str| parts.iter().all(|part| reading.split(';').any(|p| p == *part));
                let fails = of_claim().any(|f| f.verdict == "fails" && applies(&f.reading));
                assert!(
                    fails || known.reading.is_empty(),
                    "{}: nothing fails under {}",
                    claim.id,
                    known.reading
                );
            }
        }
    }
}

#[test]
fn claims_are_named_for_their_place_and_say_why() {
    for (paper, experiment) in SUITE.select(&[]).unwrap() {
        for claim in experiment.claims {
            assert!(claim.id.starts_with(&format!("{}/{}/", paper.id, experiment.id)), "{}", claim.id);
            assert!(
                !claim.says.is_empty() && !claim.reason.is_empty() && !claim.source.is_empty(),
                "{}",
                claim.id
            );
            if let Expect::Exceeds(other) = claim.expect {
                assert!(experiment.claims.iter().any(|c| c.id == other), "{}", claim.id);
            }
        }
        for red in experiment.mutant.turns_red {
            assert!(experiment.claims.iter().any(|claim| claim.id == *red), "{red}");
        }
        assert!(!experiment.mutant.turns_red.is_empty());
    }
}

#[test]
fn what_is_committed_is_small_and_every_picture_is_sound() {
    let mut size = 0;
    for (paper, experiment) in SUITE.select(&[]).unwrap() {
        let folder = results().join(paper.id).join(experiment.id);
        let record = read_record(&folder).unwrap();
        for kept in record.artifacts.iter().filter(|kept| !kept.file.starts_with("large/")) {
            let bytes = std::fs::metadata(folder.join(&kept.file)).unwrap().len();
            assert!(bytes <= 1_000_000, "{} has {bytes} bytes", kept.file);
            size += bytes;
        }
        for (kept, signs) in record.artifacts.iter().filter_map(|kept| Some((kept, kept.vitals.as_ref()?))) {
            assert_eq!(signs.non_finite, 0, "{}", kept.file);
            assert!(signs.p99 > signs.p01, "{} shows nothing", kept.file);
        }
    }
    assert!(size < 20_000_000, "{size} bytes");
}
