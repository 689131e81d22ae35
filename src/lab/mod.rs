//! The harness: claims, findings, verdicts, artifacts, the report. It owns the disk and the clock.
//!
//! An [`Experiment`] is handed a [`Lab`], says what it assumes and under which reading it works, and leaves findings
//! and artifacts. What it leaves is judged against the [`Claim`]s that it declared before the run.
//!
//! | to | open |
//! |---|---|
//! | state what a paper says | [`Claim`], [`Expect`], [`Statistic`] |
//! | write an experiment | [`Experiment`], [`Lab`], [`Artifact`] |
//! | run, check, compare, report | [`Suite`] |
//!
//! A paper that does not hold is a result; a result that changed since it was committed is a failure.

mod artifact;

pub mod check;
mod claim;
mod compare;
mod diff;
mod error;
mod folder;
mod fresh;
mod heatmap;
mod list;
mod plot;
mod power;
mod program;
mod progress;
mod record;
mod report;
mod run;
mod suite;
mod table;
mod verdict;
mod workbench;

pub use artifact::Artifact;
pub use check::{Format, Level, compare_folders};
pub use claim::{Claim, Expect, Known, Statistic};
pub use diff::{Difference, diff};
pub use error::{Error, Result};
pub use folder::{Lock, sha256, write_whole};
pub use heatmap::HeatMap;
pub use plot::{Axis, Draw, Panels, Plot, Series};
pub use power::power;
pub use program::{
    MainJob, Told, out_folder, paper_program, print, print_error, program, report_on, results_folder, run_all,
};
pub use progress::{Progress, set_threads};
pub use record::{Finding, Given, Kept, Record, read_findings, read_record};
pub use report::{Entry, Index, read_indices};
pub use run::{Outcome, rehearse};
pub use suite::{Change, Experiment, Mutant, Mutation, Options, Paper, ReadingKind, Suite};
pub use table::{Cell, Table, maybe};
pub use verdict::{Judgement, Verdict, average, judge, standard_error, student_975, wilson_95};
pub use workbench::{Lab, Scale, smallest_rise};
