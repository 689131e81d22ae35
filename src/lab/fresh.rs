//! Freshness: whether what is on disk is what this program would write.

use std::fs;
use std::path::Path;

use super::folder::{content_digest, sha256};
use super::record::{self, PROVENANCE};
use super::suite::{Experiment, Options, Paper};

/// The program's key for an experiment: everything that its results depend on.
///
/// The same for debug and release builds and for every program of the package.
pub fn key(paper: &Paper, experiment: &Experiment, options: &Options) -> String {
    let mut readings: Vec<String> = options.readings.iter().map(|(q, v)| format!("{q}={v}")).collect();
    readings.sort();
    let settings: Vec<String> =
        options.settings.iter().map(|(what, which)| format!("{what}={which}")).collect();
    let mut parts = vec![
        env!("SNOWGLOBE_LIBRARY").to_owned(),
        env!("SNOWGLOBE_DATA").to_owned(),
        paper.sources.to_owned(),
        experiment.id.to_owned(),
        options.seed.to_string(),
        options.scale.name().to_owned(),
        readings.join(";"),
    ];
    parts.extend((!settings.is_empty()).then(|| settings.join(";")));
    sha256(parts.join("\n").as_bytes())
}

/// Whether the folder holds a whole run with this key, every file as its record says.
pub fn is_fresh(folder: &Path, key: &str) -> bool {
    let Ok(provenance) = record::read_provenance(folder) else { return false };
    let Ok(run) = record::read_record(folder) else { return false };
    let unchanged = |name: &str, digest: Option<&str>| {
        let Ok(bytes) = fs::read(folder.join(name)) else { return false };
        let as_written = provenance.files.get(name).is_some_and(|written| *written == sha256(&bytes));
        as_written || digest.is_some_and(|digest| content_digest(name, &bytes).is_ok_and(|d| d == digest))
    };
    provenance.key == key
        && unchanged(record::RUN, None)
        && run.artifacts.iter().all(|kept| unchanged(&kept.file, Some(&kept.digest)))
}

/// Takes the folder's word back that it is fresh, before it is written.
pub fn forget(folder: &Path) {
    let _ = fs::remove_file(folder.join(PROVENANCE)); // nothing to forget is as good
}
