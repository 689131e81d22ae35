//! What an experiment is handed.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::lab::artifact::{Artifact, LARGEST};
use crate::lab::claim::{Claim, Expect, Statistic};
use crate::lab::error::{Error, Result};
use crate::lab::folder::Folder;
use crate::lab::progress::Progress;
use crate::lab::record::{self, Expected, Finding, Given, Kept, Record};
use crate::lab::suite::{Experiment, Options, Paper};
use crate::lab::verdict::{Judgement, Verdict, judge};
use crate::reading::Reading;
use crate::rng::{Seed, Stream};

/// How much is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// What the paper did: the claims are judged.
    Paper,
    /// As little as shows that everything runs: every claim is undecided.
    Smoke,
}

impl Scale {
    /// `paper` or `smoke`.
    pub fn name(self) -> &'static str {
        match self {
            Scale::Paper => "paper",
            Scale::Smoke => "smoke",
        }
    }
}

/// The workbench of one experiment: what it may ask for, and where it leaves what it found.
pub struct Lab<'a> {
    paper: &'a Paper,
    experiment: &'a Experiment,
    options: &'a Options,
    // None in a rehearsal, which keeps nothing.
    folder: Option<Folder>,
    progress: Progress,
    // One variant for each quantity of the paper that has readings, in the paper's order.
    reading: Vec<(&'static str, &'static str)>,
    given: (Vec<Given>, Vec<Given>),
    changed: Vec<String>,
    found: Vec<Found>,
    work: BTreeMap<String, u64>,
    kept: Vec<Kept>,
}

struct Found {
    claim: &'static Claim,
    reading: String,
    seed: Option<u64>,
    value: Option<f64>,
    command: String,
}

/// A finding that has just been made; say here which command reproduces it.
pub struct Made<'l>(&'l mut Found);

impl Made<'_> {
    /// The command that reproduces the number to the last digit.
    pub fn by(self, command: impl Into<String>) {
        self.0.command = command.into();
    }
}

impl<'a> Lab<'a> {
    pub(in crate::lab) fn new(
        paper: &'a Paper,
        experiment: &'a Experiment,
        options: &'a Options,
        folder: Option<Folder>,
        progress: Progress,
    ) -> Self {
        let reading = paper.readings.iter().map(|kind| (kind.quantity, kind.default)).collect();
        Self {
            paper,
            experiment,
            options,
            folder,
            progress,
            reading,
            given: Default::default(),
            changed: Vec::new(),
            found: Vec::new(),
            work: BTreeMap::new(),
            kept: Vec::new(),
        }
    }

    /// The seed.
    pub fn seed(&self) -> Seed {
        Seed(self.options.seed)
    }

    /// `count` seeds, from the run's own on; fewer at smoke scale.
    pub fn seeds(&self, count: u64) -> Vec<u64> {
        (0..self.pick(count, count.min(2))).map(|i| self.options.seed + i).collect()
    }

    /// Random numbers of one name.
    pub fn stream(&self, name: &str) -> Stream {
        self.seed().stream(name)
    }

    /// How much is run.
    pub fn scale(&self) -> Scale {
        self.options.scale
    }

    /// The first at paper scale, the second at smoke scale.
    pub fn pick<T>(&self, paper: T, smoke: T) -> T {
        match self.options.scale {
            Scale::Paper => paper,
            Scale::Smoke => smoke,
        }
    }

    /// A number that the paper prints, and where.
    pub fn printed(&mut self, name: &str, value: f64, place: &str) -> f64 {
        let value = self.mutated(name, value);
        record_given(&mut self.given.0, name, value.to_string(), place);
        value
    }

    /// A number that the paper does not give, and why this one.
    pub fn assume(&mut self, name: &str, value: f64, why: &str) -> f64 {
        let value = self.mutated(name, value);
        record_given(&mut self.given.1, name, value.to_string(), why);
        value
    }

    /// Something other than a number that the paper does not give.
    pub fn assume_that(&mut self, name: &str, what: &str, why: &str) {
        record_given(&mut self.given.1, name, what.to_owned(), why);
    }

    fn mutated(&mut self, name: &str, value: f64) -> f64 {
        match self.options.mutations.iter().find(|mutation| mutation.name == name) {
            Some(mutation) => {
                self.changed.push(name.to_owned());
                mutation.change.of(value)
            }
            None => value,
        }
    }

    /// Which of something the run is narrowed to; none for all of them.
    pub fn settings(&self, what: &str) -> Vec<&str> {
        let of = self.options.settings.iter().filter(|(name, _)| name == what);
        of.map(|(_, which)| which.as_str()).collect()
    }

    /// Whether the run is narrowed, so that no claim is judged.
    pub fn is_narrowed(&self) -> bool {
        !self.options.settings.is_empty()
    }

    /// The readings of a quantity that this run looks at, one after the other.
    pub fn readings<R: Reading>(&self) -> Vec<R> {
        R::ALL.iter().copied().filter(|reading| self.options.admits(R::QUANTITY, reading.name())).collect()
    }

    /// From here on, the findings are made under this reading.
    pub fn reading<R: Reading>(&mut self, reading: R) {
        let slot = self.reading.iter_mut().find(|(quantity, _)| *quantity == R::QUANTITY);
        *slot.unwrap_or_else(|| panic!("{} declares no reading of {}", self.paper.id, R::QUANTITY)) =
            (R::QUANTITY, reading.name());
    }

    /// From here on, the findings are made under the paper's default readings.
    pub fn default_reading(&mut self) {
        self.reading = self.paper.readings.iter().map(|kind| (kind.quantity, kind.default)).collect();
    }

    /// What was measured for a claim, where chance does not enter.
    pub fn found(&mut self, claim: &'static Claim, value: impl Into<Option<f64>>) -> Made<'_> {
        self.add(claim, None, value.into())
    }

    /// What was measured for a claim with one seed of several.
    pub fn found_with(
        &mut self,
        claim: &'static Claim,
        seed: u64,
        value: impl Into<Option<f64>>,
    ) -> Made<'_> {
        self.add(claim, Some(seed), value.into())
    }

    fn add(&mut self, claim: &'static Claim, seed: Option<u64>, value: Option<f64>) -> Made<'_> {
        let at = self.found.len();
        let reading = self.reading.iter().map(|(q, v)| format!("{q}={v}")).collect::<Vec<_>>().join(";");
        self.found.push(Found { claim, reading, seed, value, command: String::new() });
        Made(&mut self.found[at])
    }

    /// Does the same to many items on all threads, with a bar for the impatient; the results keep the items' order.
    pub fn each<T: Sync, R: Send>(&self, items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
        let bar = self.progress.over(items.len() as u64);
        let results = items
            .par_iter()
            .map(|item| {
                let result = work(item);
                bar.inc(1);
                result
            })
            .collect();
        bar.finish_and_clear();
        results
    }

    /// Adds to the work done: cell updates, evaluations, rays.
    pub fn count(&mut self, what: &str, amount: u64) {
        *self.work.entry(what.to_owned()).or_default() += amount;
    }

    /// Whether artifacts are kept: in a rehearsal, where they are not, what only makes them may be left out.
    pub fn keeps(&self) -> bool {
        self.folder.is_some()
    }

    /// Leaves an artifact under a name without extension; the caption says what it shows.
    pub fn keep(&mut self, name: &str, caption: &str, artifact: impl Into<Artifact>) -> Result<()> {
        let Some(folder) = &mut self.folder else { return Ok(()) };
        for made in artifact.into().make(name)? {
            if made.bytes.len() > LARGEST && !made.file.starts_with("large/") {
                let what = format!("{} bytes; over {LARGEST} belong below large/", made.bytes.len());
                return Err(Error::broken(what).at(&made.file));
            }
            if self.kept.iter().any(|kept| kept.file == made.file) {
                return Err(Error::broken("kept twice").at(&made.file));
            }
            let digest = folder.write(&made.file, &made.bytes)?;
            let caption = caption.to_owned();
            self.kept.push(Kept { file: made.file, digest, caption, vitals: made.vitals });
        }
        Ok(())
    }

    /// Judges what was found, writes the findings and then the record, which makes the experiment whole.
    pub(in crate::lab) fn finish(mut self) -> Result<Finished> {
        let findings = self.judged()?;
        let unused = self.options.mutations.iter().find(|mutation| !self.changed.contains(&mutation.name));
        if let Some(mutation) = unused {
            return Err(Error::broken("no such number to change").at(&mutation.name));
        }
        let mut files = BTreeMap::new();
        let given = self.given.clone();
        if let Some(mut folder) = self.folder.take() {
            let digest = folder.write(record::FINDINGS, &record::findings_to_csv(&findings)?)?;
            let caption = "Every finding with its verdict".to_owned();
            self.kept.push(Kept { file: record::FINDINGS.to_owned(), digest, caption, vitals: None });
            let run = self.record();
            let text = toml::to_string(&run)
                .map_err(|cause| Error::broken("cannot write a record").because(cause))?;
            folder.write(record::RUN, text.as_bytes())?;
            files = folder.finish()?;
        }
        Ok(Finished { findings, files, given })
    }

    fn record(&self) -> Record {
        Record {
            seed: self.options.seed,
            scale: self.options.scale.name().to_owned(),
            work: self.work.clone(),
            printed: self.given.0.clone(),
            assumptions: self.given.1.clone(),
            claims: self.experiment.claims.iter().map(|claim| expected(claim)).collect(),
            artifacts: self.kept.clone(),
        }
    }

    fn judged(&self) -> Result<Vec<Finding>> {
        let declared = |claim: &Claim| self.experiment.claims.iter().any(|other| other.id == claim.id);
        if let Some(found) = self.found.iter().find(|found| !declared(found.claim)) {
            return Err(Error::broken("found, but not declared").at(found.claim.id));
        }
        let mut findings = Vec::new();
        for claim in self.experiment.claims {
            let of_claim: Vec<&Found> =
                self.found.iter().filter(|found| found.claim.id == claim.id).collect();
            if of_claim.is_empty() && self.is_narrowed() {
                continue;
            }
            if of_claim.is_empty() {
                return Err(Error::broken("declared, but not found").at(claim.id));
            }
            let mut readings: Vec<&str> = Vec::new();
            for found in &of_claim {
                if !readings.contains(&found.reading.as_str()) {
                    readings.push(&found.reading);
                }
            }
            for reading in readings {
                let group: Vec<&Found> = of_claim.iter().copied().filter(|f| f.reading == reading).collect();
                findings.extend(self.rows(claim, reading, &group)?);
            }
        }
        Ok(findings)
    }

    /// The rows of one claim under one reading: a row for each of several seeds, then the one with the verdict.
    fn rows(&self, claim: &Claim, reading: &str, group: &[&Found]) -> Result<Vec<Finding>> {
        let row = |seed: String, measured: Option<f64>, command: &str, verdict: String| Finding {
            claim: claim.id.to_owned(),
            source: claim.source.to_owned(),
            reading: reading.to_owned(),
            seed,
            expected: match claim.statistic {
                Statistic::Share(least) => format!("{} for >={least} of the seeds", claim.expect),
                _ => claim.expect.to_string(),
            },
            tolerance: claim.expect.tolerance(),
            measured,
            command: command.to_owned(),
            verdict,
        };
        let mut rows = Vec::new();
        let seeded = group.iter().all(|found| found.seed.is_some());
        if group.len() > 1 {
            if !seeded {
                return Err(Error::broken("found twice under one reading").at(claim.id));
            }
            for found in group {
                let seed = found.seed.map_or_else(String::new, |seed| seed.to_string());
                rows.push(row(seed, found.value, &found.command, String::new()));
            }
        }
        let shown: Vec<Option<f64>> = group.iter().map(|found| found.value).collect();
        let values = match claim.expect {
            Expect::Exceeds(other) => self.differences(other, reading, group)?,
            _ => shown.clone(),
        };
        let Judgement { measured, mut verdict } = judge(claim.expect, claim.statistic, &values, &shown);
        if self.options.scale == Scale::Smoke || self.is_narrowed() {
            verdict = Verdict::Undecided;
        }
        let command = if group.len() == 1 { group[0].command.as_str() } else { "" };
        rows.push(row("all".to_owned(), measured, command, verdict.to_string()));
        Ok(rows)
    }

    fn differences(&self, other: &str, reading: &str, group: &[&Found]) -> Result<Vec<Option<f64>>> {
        group
            .iter()
            .map(|found| {
                let theirs = self
                    .found
                    .iter()
                    .find(|f| f.claim.id == other && f.reading == reading && f.seed == found.seed)
                    .ok_or_else(|| {
                        Error::broken(format!("nothing to compare with: no finding for {other}"))
                            .at(found.claim.id)
                    })?;
                Ok(found.value.zip(theirs.value).map(|(mine, theirs)| mine - theirs))
            })
            .collect()
    }
}

/// What a finished experiment leaves in memory.
pub(in crate::lab) struct Finished {
    pub findings: Vec<Finding>,
    pub files: BTreeMap<String, String>,
    /// The numbers that went in: printed, and assumed.
    pub given: (Vec<Given>, Vec<Given>),
}

/// A claim as `run.toml` records it.
pub(in crate::lab) fn expected(claim: &Claim) -> Expected {
    Expected {
        id: claim.id.to_owned(),
        expected: claim.expect.to_string(),
        statistic: claim.statistic.to_string(),
        tolerance: claim.expect.tolerance(),
        reason: claim.reason.to_owned(),
    }
}

fn record_given(list: &mut Vec<Given>, name: &str, value: String, why: &str) {
    let given = Given { name: name.to_owned(), value, why: why.to_owned() };
    if !list.contains(&given) {
        list.push(given);
    }
}

/// The smallest rise from one number to the next: what [`Expect::Rises`] is judged by.
pub fn smallest_rise(series: &[f64]) -> Option<f64> {
    series.windows(2).map(|pair| pair[1] - pair[0]).min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests;
