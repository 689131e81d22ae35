//! Checking: every experiment is run again beside the files on disk, and compared with them.

use std::fs;
use std::path::{Path, PathBuf};

use serde::Serialize;

pub use super::compare::Level;
use super::compare::{compare_files, same_number};
use super::error::{Error, Result};
use super::folder::files_below;
use super::record::{self, FINDINGS, Finding, PROVENANCE, RUN, Record};
use super::run::run_one;
use super::suite::{Experiment, Options, Paper};

/// How the result of a check is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Lines for people.
    Text,
    /// For programs.
    Json,
    /// For CI viewers.
    Junit,
    /// For a job's summary.
    Markdown,
}

/// One thing that was compared: a claim under a reading, or a file.
#[derive(Clone, Debug)]
pub struct Case {
    /// The claim's id and reading, or the file's name.
    pub name: String,
    /// How far it agrees.
    pub level: Level,
    /// What differs.
    pub detail: String,
    /// The verdict now, of a claim.
    pub verdict: Option<String>,
}

/// One experiment, checked.
#[derive(Clone, Debug)]
pub struct Checked {
    /// `paper/experiment`.
    pub id: String,
    /// What was compared.
    pub cases: Vec<Case>,
    /// Why it could not be run.
    pub broke: Option<String>,
    /// Seconds that the run took.
    pub seconds: f64,
}

impl Checked {
    /// The worst level of all cases.
    pub fn level(&self) -> Level {
        if self.broke.is_some() {
            return Level::Changed;
        }
        self.cases.iter().map(|case| case.level).max().unwrap_or(Level::Changed)
    }

    /// Whether it passes: at least equal, or identical where that is asked for.
    pub fn passes(&self, exact: bool) -> bool {
        self.level() <= if exact { Level::Identical } else { Level::Equal }
    }
}

/// A folder for the run that is compared; removed when dropped.
struct Scratch(PathBuf);

impl Scratch {
    fn make() -> Result<Self> {
        let path = std::env::temp_dir().join(format!("snowglobe-check-{}", std::process::id()));
        fs::create_dir_all(&path)
            .map_err(|cause| Error::broken("cannot make the folder").at(path.display()).because(cause))?;
        Ok(Self(path))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0); // a leftover in the temporary folder harms nobody
    }
}

/// Runs the experiments again, with their committed options, and compares them with `results`.
pub fn check(
    selection: &[(&'static Paper, &'static Experiment)],
    results: &Path,
    mut done: impl FnMut(&Checked),
) -> Result<Vec<Checked>> {
    let scratch = Scratch::make()?;
    let options = Options::committed(scratch.0.clone());
    let mut all = Vec::new();
    for (paper, experiment) in selection {
        let id = format!("{}/{}", paper.id, experiment.id);
        let checked = match run_one(paper, experiment, &options) {
            Ok(outcome) => Checked {
                cases: compare_folders(&results.join(&id), &scratch.0.join(&id))?,
                id,
                broke: None,
                seconds: outcome.seconds.unwrap_or(0.0),
            },
            Err(error) => Checked { id, cases: Vec::new(), broke: Some(error.to_string()), seconds: 0.0 },
        };
        done(&checked);
        all.push(checked);
    }
    Ok(all)
}

/// Compares an experiment's folder on disk with one that was just made.
pub fn compare_folders(old: &Path, new: &Path) -> Result<Vec<Case>> {
    let mut cases = claim_cases(old, new)?;
    let was = record::read_record(old).ok();
    let is = record::read_record(new)?;
    let ours = |file: &String| file != PROVENANCE;
    let made: Vec<String> = files_below(new)?.into_iter().filter(ours).collect();
    for file in &made {
        let (level, detail) = match (fs::read(old.join(file)), fs::read(new.join(file))) {
            (Ok(old), Ok(new)) => compare_files(file, &old, &new),
            // What git ignores is compared by its committed digest.
            (Err(_), Ok(_)) if file.starts_with("large/") => compare_digests(file, was.as_ref(), &is),
            _ => (Level::Changed, "not on disk".to_owned()),
        };
        cases.push(Case { name: file.clone(), level, detail, verdict: None });
    }
    for file in files_below(old)?.into_iter().filter(ours).filter(|file| !made.contains(file)) {
        let detail = "on disk, but no longer made".to_owned();
        cases.push(Case { name: file, level: Level::Changed, detail, verdict: None });
    }
    Ok(cases)
}

fn compare_digests(file: &str, old: Option<&Record>, new: &Record) -> (Level, String) {
    let digest =
        |record: &Record| record.artifacts.iter().find(|kept| kept.file == file).map(|k| k.digest.clone());
    match (old.and_then(digest), digest(new)) {
        (Some(a), Some(b)) if a == b => (Level::Identical, "by its digest".to_owned()),
        _ => (Level::Changed, format!("its digest in {RUN} differs")),
    }
}

/// A case for each claim and reading: expectation, tolerance, reason, measured number and verdict.
fn claim_cases(old: &Path, new: &Path) -> Result<Vec<Case>> {
    let was = record::read_findings(old).unwrap_or_default();
    let reasons = |folder: &Path| record::read_record(folder).map(|run| run.claims).unwrap_or_default();
    let (old_claims, new_claims) = (reasons(old), reasons(new));
    let same = |a: &Finding, b: &Finding| (&a.claim, &a.reading, &a.seed) == (&b.claim, &b.reading, &b.seed);
    let judged = |finding: &&Finding| !finding.verdict.is_empty();
    let mut cases = Vec::new();
    let now = record::read_findings(new)?;
    for finding in now.iter().filter(judged) {
        let declared = |claims: &[record::Expected]| claims.iter().find(|c| c.id == finding.claim).cloned();
        let (level, detail) = match was.iter().find(|f| same(f, finding)) {
            None => (Level::Changed, format!("not in {FINDINGS} on disk")),
            Some(_) if declared(&old_claims) != declared(&new_claims) => {
                (Level::Changed, "its expectation, tolerance or reason changed".to_owned())
            }
            Some(before) => compare_findings(before, finding),
        };
        let name = format!("{} [{}]", finding.claim, finding.reading);
        cases.push(Case { name, level, detail, verdict: Some(finding.verdict.clone()) });
    }
    for gone in was.iter().filter(judged).filter(|f| !now.iter().any(|other| same(f, other))) {
        cases.push(Case {
            name: format!("{} [{}]", gone.claim, gone.reading),
            level: Level::Changed,
            detail: "on disk, but no longer found".to_owned(),
            verdict: None,
        });
    }
    Ok(cases)
}

fn compare_findings(old: &Finding, new: &Finding) -> (Level, String) {
    if old == new {
        return (Level::Identical, String::new());
    }
    let rounding = match (old.measured, new.measured) {
        (Some(a), Some(b)) => same_number(a, b),
        (a, b) => a == b,
    };
    let rounded = Finding { measured: new.measured, ..old.clone() };
    if rounding && rounded == *new {
        return (Level::Equal, "within rounding".to_owned());
    }
    let show = |f: &Finding| {
        let measured = f.measured.map_or_else(|| "none".to_owned(), |m| m.to_string());
        format!("{measured} ({})", f.verdict)
    };
    (Level::Changed, format!("{} -> {}", show(old), show(new)))
}

/// The check as text in one of the formats.
pub fn render(all: &[Checked], exact: bool, format: Format) -> String {
    match format {
        Format::Text => text(all, exact),
        Format::Json => json(all, exact),
        Format::Junit => junit(all, exact),
        Format::Markdown => markdown(all, exact),
    }
}

/// A line for an experiment and one for each case that does not pass.
pub fn text_of(checked: &Checked, exact: bool) -> String {
    let mut lines = format!("{:<28} {:<10} {:.1} s\n", checked.id, checked.level().name(), checked.seconds);
    if let Some(broke) = &checked.broke {
        lines += &format!("    broke: {broke}\n");
    }
    for case in checked.cases.iter().filter(|case| fails(case, exact)) {
        lines += &format!("    {} {}: {}\n", case.level.name(), case.name, case.detail);
    }
    lines
}

fn fails(case: &Case, exact: bool) -> bool {
    case.level > if exact { Level::Identical } else { Level::Equal }
}

fn text(all: &[Checked], exact: bool) -> String {
    let passed = all.iter().filter(|checked| checked.passes(exact)).count();
    let wanted = if exact { "identical" } else { "equal or better" };
    format!("{passed} of {} experiments {wanted}\n", all.len())
}

#[derive(Serialize)]
struct JsonCase<'a> {
    name: &'a str,
    level: &'a str,
    detail: &'a str,
    verdict: Option<&'a str>,
}

fn json(all: &[Checked], exact: bool) -> String {
    let experiments: Vec<_> = all
        .iter()
        .map(|checked| {
            let cases: Vec<_> = checked
                .cases
                .iter()
                .map(|c| JsonCase {
                    name: &c.name,
                    level: c.level.name(),
                    detail: &c.detail,
                    verdict: c.verdict.as_deref(),
                })
                .collect();
            serde_json::json!({
                "id": checked.id, "level": checked.level().name(), "passes": checked.passes(exact),
                "broke": checked.broke, "cases": cases,
            })
        })
        .collect();
    let passes = all.iter().all(|checked| checked.passes(exact));
    let value = serde_json::json!({ "exact": exact, "passes": passes, "experiments": experiments });
    format!("{value:#}\n")
}

fn junit(all: &[Checked], exact: bool) -> String {
    let count = |checked: &Checked| checked.cases.iter().filter(|case| fails(case, exact)).count();
    let errors = |checked: &Checked| usize::from(checked.broke.is_some());
    let tests = |checked: &Checked| checked.cases.len() + errors(checked);
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"snowglobe check\" tests=\"{}\" \
         failures=\"{}\" errors=\"{}\" time=\"{:.3}\">\n",
        all.iter().map(tests).sum::<usize>(),
        all.iter().map(count).sum::<usize>(),
        all.iter().map(errors).sum::<usize>(),
        all.iter().map(|checked| checked.seconds).sum::<f64>(),
    );
    for checked in all {
        xml += &format!(
            "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"{:.3}\">\n",
            escape(&checked.id),
            tests(checked),
            count(checked),
            errors(checked),
            checked.seconds
        );
        let class = escape(&checked.id.replace('/', "."));
        if let Some(broke) = &checked.broke {
            xml += &format!(
                "    <testcase classname=\"{class}\" name=\"run\" time=\"0\"><error message=\"{}\"/></testcase>\n",
                escape(broke)
            );
        }
        for case in &checked.cases {
            let name = escape(&case.name);
            let inside = if fails(case, exact) {
                format!("<failure type=\"{}\" message=\"{}\"/>", case.level.name(), escape(&case.detail))
            } else {
                // A claim that fails as it did when it was committed is a result, not a failure.
                case.verdict
                    .as_ref()
                    .map_or_else(String::new, |v| format!("<system-out>verdict: {v}</system-out>"))
            };
            xml += &format!(
                "    <testcase classname=\"{class}\" name=\"{name}\" time=\"0\">{inside}</testcase>\n"
            );
        }
        xml += "  </testsuite>\n";
    }
    xml + "</testsuites>\n"
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn markdown(all: &[Checked], exact: bool) -> String {
    let mut page = format!(
        "## Results re-run and compared\n\n{}\n| experiment | level | claims hold | fail | undecided | files |\n\
         |---|---|---:|---:|---:|---:|\n",
        text(all, exact)
    );
    for checked in all {
        let with =
            |verdict: &str| checked.cases.iter().filter(|c| c.verdict.as_deref() == Some(verdict)).count();
        let files = checked.cases.iter().filter(|case| case.verdict.is_none()).count();
        let mark = if checked.passes(exact) { "" } else { " ✗" };
        page += &format!(
            "| {} | {}{mark} | {} | {} | {} | {files} |\n",
            checked.id,
            checked.level().name(),
            with("holds"),
            with("fails"),
            with("undecided")
        );
    }
    let bad: Vec<String> = all
        .iter()
        .flat_map(|checked| {
            let broke = checked.broke.iter().map(|broke| format!("- `{}` broke: {broke}\n", checked.id));
            let cases = checked.cases.iter().filter(|case| fails(case, exact));
            broke
                .chain(cases.map(|c| format!("- `{}` {}: {}\n", c.name, c.level.name(), c.detail)))
                .collect::<Vec<_>>()
        })
        .collect();
    if bad.is_empty() { page } else { format!("{page}\n{}", bad.concat()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(level: Level, verdict: &str) -> Checked {
        let case = Case {
            name: "p/e/c [a=b]".into(),
            level,
            detail: "1 -> <2>".into(),
            verdict: Some(verdict.into()),
        };
        Checked { id: "p/e".into(), cases: vec![case], broke: None, seconds: 1.0 }
    }

    #[test]
    fn exact_accepts_only_identical() {
        assert!(checked(Level::Equal, "holds").passes(false));
        assert!(!checked(Level::Equal, "holds").passes(true));
        assert!(!checked(Level::Changed, "holds").passes(false));
    }

    #[test]
    fn an_unchanged_failure_is_a_passed_case() {
        let xml = junit(&[checked(Level::Identical, "fails")], true);
        let page = roxmltree::Document::parse(&xml).unwrap();
        assert_eq!(page.root_element().attribute("failures"), Some("0"));
        let xml = junit(&[checked(Level::Changed, "holds")], true);
        let page = roxmltree::Document::parse(&xml).unwrap();
        assert_eq!(page.root_element().attribute("failures"), Some("1"));
        let failure = page.descendants().find(|n| n.has_tag_name("failure")).unwrap();
        assert_eq!(failure.attribute("message"), Some("1 -> <2>"));
    }
}
