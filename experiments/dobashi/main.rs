//! Re-runs the paper of Dobashi alone.

#[path = "mod.rs"]
mod dobashi;

use std::process::ExitCode;

use snowglobe::lab::{Suite, paper_program};

const SUITE: Suite = Suite { papers: &[&dobashi::PAPER] };

fn main() -> ExitCode {
    paper_program(&SUITE)
}
