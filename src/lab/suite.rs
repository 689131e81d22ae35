//! What can be run: papers, their experiments, and the options of a run.

use std::path::PathBuf;

use super::claim::Claim;
use super::error::{Error, Result};
use super::workbench::{Lab, Scale};

/// A paper and its experiments.
pub struct Paper {
    /// The first author, in kebab-case: the folder of the results.
    pub id: &'static str,
    /// Title, in the paper's language.
    pub title: &'static str,
    /// The title in English.
    pub english: &'static str,
    /// What it is about, in a sentence of ours.
    pub about: &'static str,
    /// Authors.
    pub authors: &'static str,
    /// Digest of the folder of its experiments, from `build.rs`.
    pub sources: &'static str,
    /// The quantities that can be read in several ways.
    pub readings: &'static [ReadingKind],
    /// The experiments, in the paper's order.
    pub experiments: &'static [Experiment],
}

/// A quantity that can be read in several ways.
pub struct ReadingKind {
    /// The quantity: `inflow`.
    pub quantity: &'static str,
    /// What is in dispute.
    pub says: &'static str,
    /// The names of the variants.
    pub variants: fn() -> Vec<&'static str>,
    /// The reading that findings are made under unless an experiment says otherwise.
    pub default: &'static str,
}

/// An experiment of a paper: a record and functions, nothing to override.
pub struct Experiment {
    /// The paper's own label, in kebab-case: `table-1`.
    pub id: &'static str,
    /// A title.
    pub title: &'static str,
    /// Where the paper has it.
    pub source: &'static str,
    /// What the paper says of it, in our words.
    pub says: &'static str,
    /// The claims, written before the run.
    pub claims: &'static [&'static Claim],
    /// Runs it.
    pub run: fn(&mut Lab) -> Result<()>,
    /// A change that must turn claims red.
    pub mutant: Mutant,
}

/// One number changed, and the claims that must then fail under the default reading.
pub struct Mutant {
    /// The number's name, as it is printed or assumed.
    pub changes: &'static str,
    /// Its wrong value.
    pub to: f64,
    /// Why the claims must fail then.
    pub why: &'static str,
    /// The claims.
    pub turns_red: &'static [&'static str],
}

/// The papers of a program.
pub struct Suite {
    /// The papers, in the order in which they are run and reported.
    pub papers: &'static [&'static Paper],
}

impl Suite {
    /// The experiments named by ids or papers; all of them if none is named.
    pub fn select(&self, names: &[String]) -> Result<Vec<(&'static Paper, &'static Experiment)>> {
        let all = || self.papers.iter().flat_map(|paper| paper.experiments.iter().map(move |e| (*paper, e)));
        let named = |name: &str, (paper, e): &(&Paper, &Experiment)| {
            name == paper.id || name == format!("{}/{}", paper.id, e.id)
        };
        if let Some(unknown) = names.iter().find(|name| !all().any(|pair| named(name, &pair))) {
            let accepted: Vec<String> = self
                .papers
                .iter()
                .flat_map(|p| {
                    std::iter::once(p.id.to_owned())
                        .chain(p.experiments.iter().map(|e| format!("{}/{}", p.id, e.id)))
                })
                .collect();
            return Err(
                Error::usage(format!("no such experiment; accepted: {}", accepted.join(", "))).at(unknown)
            );
        }
        Ok(all().filter(|pair| names.is_empty() || names.iter().any(|name| named(name, pair))).collect())
    }

    /// Checks `enum=variant` (or a variant alone, where it is unambiguous) against the papers' readings.
    pub fn parse_reading(&self, text: &str) -> Result<(String, String)> {
        let kinds = || self.papers.iter().flat_map(|paper| paper.readings);
        let (quantity, variant) = match text.split_once('=') {
            Some((quantity, variant)) => (Some(quantity), variant),
            None => (None, text),
        };
        let matching: Vec<_> = kinds()
            .filter(|kind| {
                quantity.is_none_or(|q| q == kind.quantity) && (kind.variants)().contains(&variant)
            })
            .collect();
        match matching.as_slice() {
            [kind] => Ok((kind.quantity.to_owned(), variant.to_owned())),
            [] => {
                let accepted: Vec<String> = kinds()
                    .flat_map(|k| (k.variants)().into_iter().map(|v| format!("{}={v}", k.quantity)))
                    .collect();
                Err(Error::usage(format!("`{text}` is no reading; accepted: {}", accepted.join(", ")))
                    .at("--reading"))
            }
            _ => {
                let choices: Vec<String> =
                    matching.iter().map(|k| format!("{}={variant}", k.quantity)).collect();
                Err(Error::usage(format!("`{text}` is ambiguous: {}", choices.join(" or "))).at("--reading"))
            }
        }
    }
}

/// A number changed on purpose.
#[derive(Clone, Debug, PartialEq)]
pub struct Mutation {
    /// The number's name, as it is printed or assumed.
    pub name: String,
    /// What becomes of it.
    pub change: Change,
}

/// What becomes of a number that is changed on purpose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// This value, whatever it was.
    To(f64),
    /// This many times what it was; a zero becomes the difference of the factor from 1.
    Times(f64),
}

impl Change {
    /// The changed number.
    pub fn of(self, value: f64) -> f64 {
        match self {
            Change::To(other) => other,
            Change::Times(factor) if value == 0.0 => (factor - 1.0).abs(),
            Change::Times(factor) => value * factor,
        }
    }
}

/// The options of a run.
#[derive(Clone, Debug)]
pub struct Options {
    /// The seed.
    pub seed: u64,
    /// How much is run.
    pub scale: Scale,
    /// Readings to which the run is narrowed, (quantity, variant); empty for all.
    pub readings: Vec<(String, String)>,
    /// Numbers changed on purpose: a mutant.
    pub mutations: Vec<Mutation>,
    /// What the run is narrowed to, (what, which) in an experiment's own words; empty for the whole. A narrowed run
    /// judges no claim.
    pub settings: Vec<(String, String)>,
    /// Runs what is fresh, too.
    pub fresh: bool,
    /// Where results are written: `<out>/<paper>/<experiment>/`.
    pub out: PathBuf,
}

impl Options {
    /// The run that writes committed results: paper scale, seed 1, all readings.
    pub fn committed(out: PathBuf) -> Self {
        Self {
            seed: 1,
            scale: Scale::Paper,
            readings: Vec::new(),
            mutations: Vec::new(),
            settings: Vec::new(),
            fresh: false,
            out,
        }
    }

    /// Narrowed to the readings that are the papers' defaults.
    pub fn under_defaults(mut self, papers: &[&Paper]) -> Self {
        let kinds = papers.iter().flat_map(|paper| paper.readings);
        self.readings = kinds.map(|kind| (kind.quantity.to_owned(), kind.default.to_owned())).collect();
        self
    }

    /// Whether the run looks at this variant of a quantity.
    pub(super) fn admits(&self, quantity: &str, variant: &str) -> bool {
        let mut of_quantity = self.readings.iter().filter(|(q, _)| q == quantity).peekable();
        of_quantity.peek().is_none() || of_quantity.any(|(_, v)| v == variant)
    }

    /// Whether these options give results that may be committed.
    pub fn is_committed_kind(&self) -> bool {
        let narrowed = !self.readings.is_empty() || !self.mutations.is_empty() || !self.settings.is_empty();
        self.seed == 1 && self.scale == Scale::Paper && !narrowed
    }
}
