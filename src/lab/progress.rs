//! Progress for people who wait, and the number of threads.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};

use super::error::{Error, Result};

/// Shows on a terminal how far an experiment is; silent in a pipe.
#[derive(Clone)]
pub struct Progress {
    label: String,
    shown: bool,
}

impl Progress {
    /// Progress of something with a name.
    pub fn of(label: &str) -> Self {
        Self { label: label.to_owned(), shown: std::io::stderr().is_terminal() }
    }

    /// No progress at all.
    pub fn silent() -> Self {
        Self { label: String::new(), shown: false }
    }

    /// A bar over `length` items.
    pub fn over(&self, length: u64) -> ProgressBar {
        if !self.shown {
            return ProgressBar::hidden();
        }
        let style = ProgressStyle::with_template("{prefix:24} {bar:32} {pos}/{len} {elapsed} (left {eta})");
        ProgressBar::new(length)
            .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
            .with_prefix(self.label.clone())
    }
}

/// Uses this many threads from here on; as many as there are processors when none is given.
pub fn set_threads(threads: Option<usize>) -> Result<()> {
    let Some(threads) = threads else { return Ok(()) };
    if !(1..=1024).contains(&threads) {
        return Err(Error::usage(format!("{threads} threads; 1 to 1024 are accepted")).at("--threads"));
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()
        .map_err(|cause| Error::broken("cannot start the threads").because(cause))
}
