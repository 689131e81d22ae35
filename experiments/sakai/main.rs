//! Re-runs the paper of Sakai, Ueda & Yamaguchi alone.

#[path = "mod.rs"]
mod sakai;

use std::process::ExitCode;

use snowglobe::lab::{Suite, paper_program};

const SUITE: Suite = Suite { papers: &[&sakai::PAPER] };

fn main() -> ExitCode {
    paper_program(&SUITE)
}
