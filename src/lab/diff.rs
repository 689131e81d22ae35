//! Two result folders, claim by claim.

use std::collections::BTreeMap;
use std::path::Path;

use super::error::{Error, Result};
use super::folder::files_below;
use super::record::{FINDINGS, Finding, read_findings};

/// A claim whose finding differs between two folders; none where one folder does not have it.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The claim and its reading.
    pub claim: String,
    /// In the first folder: measured and verdict.
    pub before: Option<String>,
    /// In the second.
    pub after: Option<String>,
}

/// Compares the verdicts and numbers of two result folders; also says how many claims are the same.
pub fn diff(before: &Path, after: &Path) -> Result<(Vec<Difference>, usize)> {
    let (before, after) = (findings(before)?, findings(after)?);
    let mut names: Vec<&String> = before.keys().chain(after.keys()).collect();
    names.sort();
    names.dedup();
    let differences: Vec<Difference> = names
        .iter()
        .map(|name| Difference {
            claim: (*name).clone(),
            before: before.get(*name).cloned(),
            after: after.get(*name).cloned(),
        })
        .filter(|difference| difference.before != difference.after)
        .collect();
    let same = names.len() - differences.len();
    Ok((differences, same))
}

fn findings(results: &Path) -> Result<BTreeMap<String, String>> {
    let mut all = BTreeMap::new();
    for file in files_below(results)?.iter().filter(|file| file.ends_with(&format!("/{FINDINGS}"))) {
        let folder = results.join(file.trim_end_matches(FINDINGS));
        for finding in read_findings(&folder)?.iter().filter(|f| !f.verdict.is_empty()) {
            all.insert(format!("{} [{}]", finding.claim, finding.reading), show(finding));
        }
    }
    if all.is_empty() {
        let what = format!("no findings below it; a results folder has <paper>/<experiment>/{FINDINGS}");
        return Err(Error::usage(what).at(results.display()));
    }
    Ok(all)
}

fn show(finding: &Finding) -> String {
    let measured = finding.measured.map_or_else(|| "none".to_owned(), |m| m.to_string());
    let within = finding.tolerance.map_or_else(String::new, |t| format!(" +-{t}"));
    format!("{measured} (expected {}{within}: {})", finding.expected, finding.verdict)
}
