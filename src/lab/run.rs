//! Running experiments: what is not fresh is run, and what a run replaces is said.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::{Instant, SystemTime};

use super::error::{At, Result};
use super::folder::{Folder, write_whole};
use super::fresh::{self, key};
use super::progress::Progress;
use super::record::{self, Finding, PROVENANCE, Provenance};
use super::suite::{Experiment, Options, Paper};
use super::workbench::{Finished, Lab};

/// What became of one experiment.
pub struct Outcome {
    /// `paper/experiment`.
    pub id: String,
    /// Seconds that it took; none if it was fresh.
    pub seconds: Option<f64>,
    /// Each value that was replaced: what, old, new.
    pub replaced: Vec<(String, String, String)>,
}

/// Runs one experiment into its folder, unless that is fresh.
pub fn run_one(paper: &Paper, experiment: &Experiment, options: &Options) -> Result<Outcome> {
    let id = format!("{}/{}", paper.id, experiment.id);
    let folder = options.out.join(paper.id).join(experiment.id);
    let key = key(paper, experiment, options);
    if !options.fresh && fresh::is_fresh(&folder, &key) {
        return Ok(Outcome { id, seconds: None, replaced: Vec::new() });
    }
    let before = record::read_findings(&folder).unwrap_or_default();
    fresh::forget(&folder);
    let (started, clock) = (seconds_since_1970(), now());
    let mut lab =
        Lab::new(paper, experiment, options, Some(Folder::begin(folder.clone())?), Progress::of(&id));
    (experiment.run)(&mut lab).map_err(|error| error.at(&id))?;
    let finished = lab.finish().map_err(|error| error.at(&id))?;
    let provenance = Provenance {
        key,
        files: finished.files,
        revision: revision(),
        rustc: env!("SNOWGLOBE_RUSTC").to_owned(),
        processor: processor(),
        threads: rayon::current_num_threads(),
        started,
        seconds: clock.elapsed().as_secs_f64(),
    };
    let path = folder.join(PROVENANCE);
    write_whole(&path, &serde_json::to_vec_pretty(&provenance).at("cannot write", &path)?)?;
    let seconds = Some(provenance.seconds);
    Ok(Outcome { id, seconds, replaced: replaced(&before, &finished.findings) })
}

/// Runs an experiment in memory and returns its findings; nothing is written.
pub fn rehearse(paper: &Paper, experiment: &Experiment, options: &Options) -> Result<Vec<Finding>> {
    Ok(rehearsal(paper, experiment, options)?.findings)
}

/// Runs an experiment in memory.
pub(super) fn rehearsal(paper: &Paper, experiment: &Experiment, options: &Options) -> Result<Finished> {
    let mut lab = Lab::new(paper, experiment, options, None, Progress::silent());
    (experiment.run)(&mut lab)?;
    lab.finish()
}

/// Each finding whose value or verdict differs: what, old, new.
pub fn replaced(before: &[Finding], after: &[Finding]) -> Vec<(String, String, String)> {
    let name = |f: &Finding| (f.claim.clone(), f.reading.clone(), f.seed.clone());
    let value = |f: &Finding| {
        let measured = f.measured.map_or_else(|| "none".to_owned(), |m| m.to_string());
        if f.verdict.is_empty() { measured } else { format!("{measured} ({})", f.verdict) }
    };
    let old: BTreeMap<_, _> = before.iter().map(|f| (name(f), value(f))).collect();
    after
        .iter()
        .filter_map(|f| {
            let (was, is) = (old.get(&name(f))?, value(f));
            let seed = if f.seed == "all" { String::new() } else { format!(" seed {}", f.seed) };
            (*was != is).then(|| (format!("{}{seed} [{}]", f.claim, f.reading), was.clone(), is))
        })
        .collect()
}

/// The revision of the sources in the folder above, read from git's own files.
fn revision() -> Option<String> {
    let home = std::env::current_dir().ok()?;
    let git = home.ancestors().map(|folder| folder.join(".git")).find(|path| path.is_dir())?;
    let head = fs::read_to_string(git.join("HEAD")).ok()?;
    match head.trim().strip_prefix("ref: ") {
        None => Some(head.trim().to_owned()),
        Some(name) => fs::read_to_string(git.join(name)).ok().map(|text| text.trim().to_owned()),
    }
}

fn processor() -> Option<String> {
    let text = fs::read_to_string(Path::new("/proc/cpuinfo")).ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

#[allow(clippy::disallowed_methods)] // the harness owns the clock; only provenance.json sees it
fn now() -> Instant {
    Instant::now()
}

#[allow(clippy::disallowed_methods)] // as above
fn seconds_since_1970() -> u64 {
    SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, |time| time.as_secs())
}
