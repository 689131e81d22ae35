//! The index of what the papers print is whole, and what it names is there.

mod papers;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use papers::SUITE;
use snowglobe::lab::{Entry, Index, read_indices};

/// The five papers; `optimizers` and `scenes` are ours.
const PAPERS: [&str; 5] = ["amano", "sakai", "miyata", "dobashi", "himeno"];

fn home() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn indices() -> Vec<Index> {
    read_indices(&SUITE, &home().join("paper/coverage")).unwrap()
}

/// A source file, read once.
#[derive(Default)]
struct Sources(BTreeMap<String, String>);

impl Sources {
    fn text(&mut self, file: &str) -> Option<&str> {
        if !self.0.contains_key(file) {
            self.0.insert(file.to_owned(), fs::read_to_string(home().join(file)).ok()?);
        }
        self.0.get(file).map(String::as_str)
    }

    /// Whether the file defines the item: after a keyword, or as a variant or field on a line of its own.
    fn defines(&mut self, file: &str, item: &str) -> bool {
        let Some(text) = self.text(file) else { return false };
        let keywords = ["fn", "struct", "enum", "const", "static", "trait", "type", "mod"];
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        let after = |line: &str, start: &str| line.split(start).skip(1).any(ends);
        text.lines().any(|line| {
            let line = line.trim_start();
            let defined = keywords.iter().any(|keyword| after(line, &format!("{keyword} {item}")));
            let variant =
                line.strip_prefix(item).is_some_and(|rest| rest.starts_with([',', '(', ' ', '{', ':']));
            !line.starts_with("//") && (defined || variant)
        })
    }

    /// Whether the file has a test of this name: `#[test]` stands above it, or it is one of a property test's.
    fn tests(&mut self, file: &str, name: &str) -> bool {
        let Some(text) = self.text(file) else { return false };
        let Some(at) = text.find(&format!("fn {name}(")) else { return false };
        let before: Vec<&str> = text[..at].lines().rev().take(6).collect();
        before.iter().any(|line| line.trim() == "#[test]")
    }
}

fn split(reference: &str) -> (&str, &str) {
    reference.split_once('#').unwrap_or_else(|| panic!("`{reference}` is no file#item"))
}

#[test]
fn what_the_index_names_is_there() {
    let mut sources = Sources::default();
    let claims: Vec<&str> =
        SUITE.select(&[]).unwrap().iter().flat_map(|(_, e)| e.claims.iter().map(|claim| claim.id)).collect();
    let mut stale = Vec::new();
    for index in indices() {
        for entry in &index.entries {
            let name = format!("{}/{}", index.paper, entry.id);
            for reference in &entry.code {
                let (file, item) = split(reference);
                if !sources.defines(file, item) {
                    stale.push(format!("{name}: {reference} defines nothing"));
                }
            }
            for reference in &entry.tests {
                let (file, test) = split(reference);
                if !sources.tests(file, test) {
                    stale.push(format!("{name}: {reference} is no test"));
                }
            }
            stale.extend(
                entry
                    .claims
                    .iter()
                    .filter(|c| !claims.contains(&c.as_str()))
                    .map(|c| format!("{name}: no claim {c}")),
            );
        }
    }
    assert!(stale.is_empty(), "{}", stale.join("\n"));
}

#[test]
fn a_name_that_is_gone_is_found() {
    let mut sources = Sources::default();
    assert!(sources.defines("src/frost/reference.rs", "step") || sources.defines("src/frost/mod.rs", "step"));
    assert!(!sources.defines("src/frost/mod.rs", "no_such_item"));
    assert!(!sources.defines("src/no_such_file.rs", "step"));
    assert!(sources.tests("tests/coverage.rs", "a_name_that_is_gone_is_found"));
    assert!(!sources.tests("tests/coverage.rs", "home"));
}

#[test]
fn every_numbered_thing_has_its_entry() {
    let indices = indices();
    assert_eq!(indices.iter().map(|index| index.paper.as_str()).collect::<Vec<_>>(), PAPERS);
    for index in indices {
        let numbered = [
            ("equation", "eq", index.equations),
            ("figure", "figure", index.figures),
            ("table", "table", index.tables),
            ("condition", "condition", index.conditions),
        ];
        for (kind, prefix, count) in numbered {
            for number in 1..=count {
                let id = format!("{prefix}-{number}");
                let there = index.entries.iter().any(|entry| entry.id == id && entry.kind == kind);
                assert!(there, "{}: no entry {id}", index.paper);
            }
        }
        let mut ids: Vec<&str> = index.entries.iter().map(|entry| entry.id.as_str()).collect();
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "{}: an id twice", index.paper);
    }
}

#[test]
fn an_entry_is_found_somewhere_or_says_why_not() {
    let bare = |entry: &Entry| entry.code.is_empty() && entry.tests.is_empty() && entry.claims.is_empty();
    for index in indices() {
        for entry in &index.entries {
            let name = format!("{}/{}", index.paper, entry.id);
            assert!(!bare(entry) || !entry.why.is_empty(), "{name} is nowhere, and does not say why");
            assert!(!entry.says.is_empty() && !entry.place.is_empty(), "{name}");
            assert!(
                ["equation", "figure", "table", "condition", "assertion"].contains(&entry.kind.as_str()),
                "{name}: {}",
                entry.kind
            );
        }
    }
}

/// A claim that no sentence of a paper stands behind is ours, and its source says so.
#[test]
fn every_claim_of_the_papers_is_reached() {
    let indices = indices();
    let reached: Vec<&str> = indices
        .iter()
        .flat_map(|index| index.entries.iter().flat_map(|e| e.claims.iter().map(String::as_str)))
        .collect();
    for (paper, experiment) in SUITE.select(&[]).unwrap() {
        for claim in experiment.claims.iter().filter(|_| PAPERS.contains(&paper.id)) {
            let ours = claim.source.contains("ours")
                || claim.source.contains("not in the paper")
                || claim.source.contains("beyond");
            assert!(ours || reached.contains(&claim.id), "{} [{}] is in no index", claim.id, claim.source);
        }
    }
}
