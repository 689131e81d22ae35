//! The index of what the papers print: every numbered equation, figure, table, listed condition, and every sentence that
//! asserts something; where it is, what tests it, what judges it, or why it is not there.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use crate::lab::error::{At, Result};
use crate::lab::suite::Suite;
use crate::lab::table::Table;

/// The index of one paper, `paper/coverage/<paper>.toml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Index {
    /// The paper.
    pub paper: String,
    /// How many equations it numbers.
    pub equations: usize,
    /// How many figures.
    pub figures: usize,
    /// How many tables.
    pub tables: usize,
    /// How many conditions it lists.
    pub conditions: usize,
    /// The entries, in the paper's order.
    #[serde(rename = "entry")]
    pub entries: Vec<Entry>,
}

/// Something that a paper prints.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// `eq-1`, `figure-4a`, `table-2`, `condition-3`, `says-12`.
    pub id: String,
    /// `equation`, `figure`, `table`, `condition` or `assertion`.
    pub kind: String,
    /// Where the paper has it.
    pub place: String,
    /// What it says, in our words.
    pub says: String,
    /// Where it is implemented, `file#item`.
    #[serde(default)]
    pub code: Vec<String>,
    /// What tests it, `file#function`.
    #[serde(default)]
    pub tests: Vec<String>,
    /// The claims that judge it.
    #[serde(default)]
    pub claims: Vec<String>,
    /// Why it is not there, or only in part.
    #[serde(default)]
    pub why: String,
}

/// Reads the indices of the papers that have one, in the suite's order; none where the folder is missing.
pub fn read_indices(suite: &Suite, folder: &Path) -> Result<Vec<Index>> {
    let paths = suite.papers.iter().map(|paper| folder.join(format!("{}.toml", paper.id)));
    paths
        .filter(|path| path.is_file())
        .map(|path| {
            toml::from_str(&fs::read_to_string(&path).at("cannot read", &path)?).at("not an index", &path)
        })
        .collect()
}

/// All entries as one table.
pub(super) fn table(indices: &[Index]) -> Table {
    let mut table = Table::new(["paper", "id", "kind", "place", "says", "code", "tests", "claims", "why"]);
    for index in indices {
        for entry in &index.entries {
            table.row([
                index.paper.as_str().into(),
                entry.id.as_str().into(),
                entry.kind.as_str().into(),
                entry.place.as_str().into(),
                entry.says.as_str().into(),
                entry.code.join(";").into(),
                entry.tests.join(";").into(),
                entry.claims.join(";").into(),
                entry.why.as_str().into(),
            ]);
        }
    }
    table
}
