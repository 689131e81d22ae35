//! Re-runs the paper of Miyata alone.

#[path = "mod.rs"]
mod miyata;

use std::process::ExitCode;

use snowglobe::lab::{Suite, paper_program};

const SUITE: Suite = Suite { papers: &[&miyata::PAPER] };

fn main() -> ExitCode {
    paper_program(&SUITE)
}
