//! Re-runs the paper of Himeno alone.

#[path = "mod.rs"]
mod himeno;

use std::process::ExitCode;

use snowglobe::lab::{Suite, paper_program};

const SUITE: Suite = Suite { papers: &[&himeno::PAPER] };

fn main() -> ExitCode {
    paper_program(&SUITE)
}
