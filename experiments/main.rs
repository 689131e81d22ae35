//! The `snowglobe` program: its papers, and one file below `cmd/` for each subcommand.

mod amano;
mod cmd;
mod dobashi;
mod himeno;
mod miyata;
mod optimizers;
mod sakai;

use std::process::ExitCode;

use snowglobe::lab::Suite;

/// The papers, in the order in which they are run.
const SUITE: Suite = Suite {
    papers: &[
        &amano::PAPER,
        &sakai::PAPER,
        &miyata::PAPER,
        &dobashi::PAPER,
        &himeno::PAPER,
        &optimizers::PAPER,
    ],
};

fn main() -> ExitCode {
    cmd::main(&SUITE)
}
