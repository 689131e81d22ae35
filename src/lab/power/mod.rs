//! Power: what has to be wrong for a claim to fail.
//!
//! Every number that an experiment is given, printed or assumed, is made a quarter greater and a quarter less, one at a
//! time; so are the experiment's own mutants, and every reading of a formula in the place of the default one. A claim
//! that holds and that none of these turns red has no power: it would hold of a wrong model, too. It is reported, not
//! hidden.
//!
//! What was tried is kept beside the results, one file for each experiment, so that an interrupted run goes on.

mod controls;
mod tables;
mod trial;

use std::fs;
use std::path::{Path, PathBuf};

use super::error::{At, Error, Result};
use super::folder::{sha256, write_whole};
use super::program::print;
use super::record::RUN;
use super::suite::{Experiment, Options, Paper, Suite};
use super::table::Table;
use trial::Row;

/// What every number is multiplied by.
const FACTORS: [f64; 2] = [1.25, 0.75];

/// The folder below the results.
const FOLDER: &str = "power";

/// Tries all mutations of the selected experiments and writes what turned red below `<out>/power/`; the experiments'
/// own findings are read from `out`.
pub fn power(
    suite: &Suite,
    selection: &[(&'static Paper, &'static Experiment)],
    out: &Path,
    fresh: bool,
) -> Result<()> {
    let options = Options::committed(out.to_path_buf()).under_defaults(suite.papers);
    let mut rows: Vec<Row> = Vec::new();
    for (paper, experiment) in selection {
        let path = kept(out, paper, experiment)?;
        let tried = match fs::read(&path) {
            Ok(bytes) if !fresh => trial::from_table(&Table::from_csv(&bytes)?)
                .map_err(|what| Error::broken(what).at(path.display()))?,
            _ => {
                let tried = trial::all_of(paper, experiment, &options)?;
                forget_others(&path)?;
                write_whole(&path, &trial::to_table(&tried).to_csv()?)?;
                tried
            }
        };
        let red = tried.iter().filter(|row| row.is_red()).count();
        print(&format!(
            "{:<28} {red} of {} findings turn red\n",
            format!("{}/{}", paper.id, experiment.id),
            tried.len()
        ));
        rows.extend(tried);
        rows.extend(trial::readings(paper, experiment, out)?);
    }
    let folder = out.join(FOLDER);
    write_whole(&folder.join("mutations.csv"), &tables::mutations(&rows).to_csv()?)?;
    write_whole(&folder.join("claims.csv"), &tables::claims(selection, &rows).to_csv()?)?;
    write_whole(&folder.join("controls.csv"), &controls::table(selection, out)?.to_csv()?)?;
    Ok(())
}

/// Where the trials of an experiment are kept: under a name that its record gives them, for what gives the same record
/// unchanged is the same model.
fn kept(out: &Path, paper: &Paper, experiment: &Experiment) -> Result<PathBuf> {
    let record = out.join(paper.id).join(experiment.id).join(RUN);
    let bytes = fs::read(&record).map_err(|cause| {
        Error::usage("no results there; run the experiment first").at(record.display()).because(cause)
    })?;
    let key = sha256(&bytes);
    Ok(out.join(FOLDER).join("large").join(format!("{}-{}-{}.csv", paper.id, experiment.id, &key[..12])))
}

/// Removes the trials of the same experiment with other results.
fn forget_others(path: &Path) -> Result<()> {
    let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else { return Ok(()) };
    let name = name.to_string_lossy();
    let stem = &name[..name.len() - "0123456789ab.csv".len()];
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let other = entry.file_name().to_string_lossy().into_owned();
        let same = other.strip_prefix(stem).is_some_and(|rest| rest.len() == "0123456789ab.csv".len());
        if same {
            fs::remove_file(entry.path()).at("cannot remove", &entry.path())?;
        }
    }
    Ok(())
}
