//! Re-runs this paper alone.

#[path = "mod.rs"]
mod amano;

use std::process::ExitCode;

use snowglobe::lab::{Suite, paper_program};

const SUITE: Suite = Suite { papers: &[&amano::PAPER] };

fn main() -> ExitCode {
    paper_program(&SUITE)
}
