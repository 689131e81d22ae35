//! The report: results on disk to HTML and Markdown. It reads files and runs nothing.

mod html;
mod markdown;
mod summary;

use std::fs;
use std::path::{Path, PathBuf};

pub use summary::{Entry, Index, read_indices};

use super::error::{At, Result};
use super::folder::write_whole;
use super::record::{self, Finding, Record};
use super::suite::{Experiment, Paper, Suite};
use super::table::Table;

/// One experiment as it lies on disk.
pub(super) struct Shelf {
    pub paper: &'static Paper,
    pub experiment: &'static Experiment,
    pub folder: PathBuf,
    pub findings: Vec<Finding>,
    pub run: Record,
}

impl Shelf {
    /// The rows that carry a verdict, those of the default readings first.
    pub fn verdicts(&self) -> Vec<&Finding> {
        let mut rows: Vec<&Finding> = self.findings.iter().filter(|f| !f.verdict.is_empty()).collect();
        rows.sort_by_key(|f| !self.is_default(f));
        rows
    }

    /// Whether a finding was made under the paper's default readings.
    pub fn is_default(&self, finding: &Finding) -> bool {
        default_reading(self.paper) == finding.reading
    }

    /// The row by which a claim is shown first: the default reading's, else the first.
    pub fn lead(&self, claim: &str) -> Option<&Finding> {
        self.verdicts().into_iter().find(|f| f.claim == claim)
    }

    /// A table of the experiment.
    pub fn table(&self, file: &str) -> Option<Table> {
        Table::from_csv(&fs::read(self.folder.join(file)).ok()?).ok()
    }

    /// Whether a kept file is on disk; what git ignores may be missing in a new clone.
    pub fn has(&self, file: &str) -> bool {
        self.folder.join(file).is_file()
    }
}

/// The full set of default readings of a paper.
pub(in crate::lab) fn default_reading(paper: &Paper) -> String {
    paper
        .readings
        .iter()
        .map(|kind| format!("{}={}", kind.quantity, kind.default))
        .collect::<Vec<_>>()
        .join(";")
}

impl Suite {
    /// Reads the experiments that are whole on disk.
    pub(super) fn shelves(&self, results: &Path) -> Vec<Shelf> {
        let all = self.papers.iter().flat_map(|paper| paper.experiments.iter().map(move |e| (*paper, e)));
        all.filter_map(|(paper, experiment)| {
            let folder = results.join(paper.id).join(experiment.id);
            let findings = record::read_findings(&folder).ok()?;
            let run = record::read_record(&folder).ok()?;
            Some(Shelf { paper, experiment, folder, findings, run })
        })
        .collect()
    }

    /// Writes the tables of `summary/`, then `index.html` beside the results, and returns its path.
    pub fn write_report(&self, results: &Path) -> Result<PathBuf> {
        summary::write(self, &self.shelves(results), results, &results.with_file_name("paper"))?;
        let path = results.join("index.html");
        let page = html::page(self, &self.shelves(results));
        if fs::read(&path).ok().as_deref() != Some(page.as_bytes()) {
            write_whole(&path, page.as_bytes())?;
        }
        Ok(path)
    }

    /// The table of claims as text for a terminal.
    pub fn claims_as_text(&self, results: &Path) -> String {
        markdown::terminal(&self.shelves(results))
    }

    /// Splices the table of claims into a README, between its markers.
    pub fn splice_readme(&self, results: &Path, readme: &Path) -> Result<()> {
        let text = fs::read_to_string(readme).at("cannot read", readme)?;
        let spliced = markdown::splice(&text, &markdown::claims(&self.shelves(results)))
            .ok_or_else(|| super::Error::broken("no markers for the table of claims").at(readme.display()))?;
        if spliced != text {
            write_whole(readme, spliced.as_bytes())?;
        }
        Ok(())
    }
}

/// What is expected, for people: `160 ± 4`, `130 ± 4 for >=0.5 of the seeds`.
pub(super) fn expectation(finding: &Finding) -> String {
    let (number, rest) = finding.expected.split_once(' ').unwrap_or((&finding.expected, ""));
    let number = number.parse().map_or_else(|_| number.to_owned(), |number: f64| short(Some(number)));
    let within = match finding.tolerance {
        Some(0.0) | None => String::new(),
        Some(tolerance) if tolerance < 1e-6 => format!(" ± {tolerance:e}"),
        Some(tolerance) => format!(" ± {}", short(Some(tolerance))),
    };
    format!("{number}{within} {rest}").trim_end().to_owned()
}

/// A measured number for people: six significant digits.
pub(super) fn short(value: Option<f64>) -> String {
    let Some(value) = value else { return "none".to_owned() };
    if value == libm::trunc(value) && value.abs() < 1e9 {
        return format!("{value}");
    }
    let text = format!("{value:.*}", decimals(value));
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-" { "0".to_owned() } else { text.to_owned() }
}

fn decimals(value: f64) -> usize {
    let mut digits = 5;
    let mut magnitude = value.abs();
    while magnitude >= 10.0 && digits > 0 {
        magnitude /= 10.0;
        digits -= 1;
    }
    while magnitude < 1.0 && digits < 12 && magnitude > 0.0 {
        magnitude *= 10.0;
        digits += 1;
    }
    digits
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn six_digits_are_enough_for_people() {
        assert_eq!(short(Some(160.0)), "160");
        assert_eq!(short(Some(152.074_999)), "152.075");
        assert_eq!(short(Some(0.012_345_678)), "0.0123457");
        assert_eq!(short(None), "none");
    }
}
