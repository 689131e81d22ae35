//! What an experiment leaves beside its artifacts: findings, `run.toml`, `provenance.json`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::error::{At, Error, Result};
use super::verdict::Verdict;

/// The findings of an experiment.
pub const FINDINGS: &str = "findings.csv";
/// The record of a run, the same on every machine; its presence says that the experiment is whole.
pub const RUN: &str = "run.toml";
/// When and where this copy was made; git ignores it.
pub const PROVENANCE: &str = "provenance.json";

/// One row of `findings.csv`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Claim's id.
    pub claim: String,
    /// Page, table, cell.
    pub source: String,
    /// The full set of readings, `enum=variant` joined by `;`.
    pub reading: String,
    /// A seed, or `all`.
    pub seed: String,
    /// What is expected.
    pub expected: String,
    /// The tolerance, where there is one.
    pub tolerance: Option<f64>,
    /// What was measured; none fails.
    pub measured: Option<f64>,
    /// A command that reproduces `measured` to the last digit, where a model command exists.
    pub command: String,
    /// Empty in a seed's own row.
    pub verdict: String,
}

impl Finding {
    /// The verdict, in a row for all seeds.
    pub fn verdict(&self) -> Option<Verdict> {
        self.verdict.parse().ok()
    }
}

/// `run.toml`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The seed.
    pub seed: u64,
    /// `paper` or `smoke`.
    pub scale: String,
    /// Work done: cell updates, evaluations, rays.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub work: BTreeMap<String, u64>,
    /// Numbers that the paper prints.
    #[serde(default, rename = "printed", skip_serializing_if = "Vec::is_empty")]
    pub printed: Vec<Given>,
    /// Numbers that the paper does not give.
    #[serde(default, rename = "assumption", skip_serializing_if = "Vec::is_empty")]
    pub assumptions: Vec<Given>,
    /// What was expected, so that a change of mind shows.
    #[serde(default, rename = "claim", skip_serializing_if = "Vec::is_empty")]
    pub claims: Vec<Expected>,
    /// The files, in the order in which they were kept.
    #[serde(default, rename = "artifact", skip_serializing_if = "Vec::is_empty")]
    pub artifacts: Vec<Kept>,
}

/// A number that went into a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Given {
    /// Its name.
    pub name: String,
    /// Its value.
    pub value: String,
    /// Where it is printed, or why it was assumed.
    pub why: String,
}

/// A claim as it was declared.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Expected {
    /// Claim's id.
    pub id: String,
    /// Expectation.
    pub expected: String,
    /// Statistic.
    pub statistic: String,
    /// Tolerance, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Why this expectation and tolerance.
    pub reason: String,
}

/// A file of the experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// Path below the experiment's folder.
    pub file: String,
    /// `sha256:` of the bytes, or `pixels:` of the decoded picture.
    pub digest: String,
    /// What it shows, in a sentence.
    pub caption: String,
    /// Vital signs of a picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vitals: Option<Signs>,
}

/// Vital signs of a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Signs {
    /// `photograph`, `code-values` or `drawing`.
    pub kind: String,
    /// Share of pixels at 0 in every channel.
    pub black: f64,
    /// Share of pixels at 255 in every channel.
    pub white: f64,
    /// First percentile of the code values.
    pub p01: u8,
    /// 99th percentile of the code values.
    pub p99: u8,
    /// Values that are not finite, before they were made into codes.
    pub non_finite: u64,
}

/// `provenance.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// The program's key for this experiment.
    pub key: String,
    /// SHA-256 of each file's bytes, so that an unchanged file is known without decoding it.
    pub files: BTreeMap<String, String>,
    /// Revision of the sources, where known.
    pub revision: Option<String>,
    /// Compiler.
    pub rustc: String,
    /// Processor, where known.
    pub processor: Option<String>,
    /// Number of threads.
    pub threads: usize,
    /// Start, seconds since 1970.
    pub started: u64,
    /// Duration in seconds.
    pub seconds: f64,
}

/// Findings as CSV.
pub fn findings_to_csv(findings: &[Finding]) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for finding in findings {
        writer.serialize(finding).map_err(|cause| Error::broken("cannot write findings").because(cause))?;
    }
    writer.into_inner().map_err(|cause| Error::broken("cannot write findings").because(cause.to_string()))
}

/// Findings from CSV.
pub fn findings_from_csv(bytes: &[u8], path: &Path) -> Result<Vec<Finding>> {
    csv::Reader::from_reader(bytes)
        .deserialize()
        .collect::<std::result::Result<_, csv::Error>>()
        .at("not findings", path)
}

/// Reads the findings of an experiment's folder.
pub fn read_findings(folder: &Path) -> Result<Vec<Finding>> {
    let path = folder.join(FINDINGS);
    findings_from_csv(&std::fs::read(&path).at("cannot read", &path)?, &path)
}

/// Reads the record of an experiment's folder.
pub fn read_record(folder: &Path) -> Result<Record> {
    let path = folder.join(RUN);
    toml::from_str(&std::fs::read_to_string(&path).at("cannot read", &path)?).at("not a record", &path)
}

/// Reads when and where an experiment's folder was made.
pub fn read_provenance(folder: &Path) -> Result<Provenance> {
    let path = folder.join(PROVENANCE);
    serde_json::from_slice(&std::fs::read(&path).at("cannot read", &path)?).at("not a provenance", &path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_come_back() {
        let finding = Finding {
            claim: "a/b/c".into(),
            source: "Table 1, \"row\" 0".into(),
            reading: "inflow=as-printed".into(),
            seed: "all".into(),
            expected: "160".into(),
            tolerance: Some(4.0),
            measured: None,
            command: String::new(),
            verdict: "fails".into(),
        };
        let bytes = findings_to_csv(std::slice::from_ref(&finding)).unwrap();
        assert!(
            bytes.starts_with(b"claim,source,reading,seed,expected,tolerance,measured,command,verdict\n")
        );
        assert_eq!(findings_from_csv(&bytes, Path::new("x")).unwrap(), [finding]);
    }
}
