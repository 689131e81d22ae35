//! Runs the comparison of optimisers alone.

#[path = "mod.rs"]
mod optimizers;

use std::process::ExitCode;

use snowglobe::lab::{Suite, paper_program};

const SUITE: Suite = Suite { papers: &[&optimizers::PAPER] };

fn main() -> ExitCode {
    paper_program(&SUITE)
}
