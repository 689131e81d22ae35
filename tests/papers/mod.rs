//! The papers, as the programs have them.

#[path = "../../experiments/amano/mod.rs"]
pub mod amano;
#[path = "../../experiments/dobashi/mod.rs"]
pub mod dobashi;
#[path = "../../experiments/himeno/mod.rs"]
pub mod himeno;
#[path = "../../experiments/miyata/mod.rs"]
pub mod miyata;
#[path = "../../experiments/optimizers/mod.rs"]
pub mod optimizers;
#[path = "../../experiments/sakai/mod.rs"]
pub mod sakai;

use snowglobe::lab::{Options, Suite};

/// The suite of the `snowglobe` program.
pub const SUITE: Suite = Suite {
    papers: &[
        &amano::PAPER,
        &sakai::PAPER,
        &miyata::PAPER,
        &dobashi::PAPER,
        &himeno::PAPER,
        &optimizers::PAPER,
    ],
};

/// A run at paper scale under the default readings only: what mutants are judged by.
#[allow(dead_code)] // not every test binary rehearses
pub fn default_readings() -> Options {
    Options::committed(std::path::PathBuf::new()).under_defaults(SUITE.papers)
}
