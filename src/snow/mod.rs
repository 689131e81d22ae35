//! Snow crystals and flakes (Y. Himeno, Y. Kenmochi & K. Kotani, *Creation of snowing scene based on the structure of snow
//! crystals*; in Japanese).
//!
//! | symbol | here | meaning |
//! |---|---|---|
//! | S(t), Eq. (1) | [`flake::Flake`] | a flake: crystals that hold on to each other |
//! | C(t), Eq. (2) | [`Crystal`] | a crystal: layers |
//! | L(t), Eq. (3) | [`Layer`] | a layer: branches along six directions |
//! | F(t), Eq. (4) to (6) | [`grammar`], [`Vigour`] | a branch: as words, and as tips on the lattice |
//! | p1(t), Eq. (4) | [`Vigour::branching`] | the probability that a branch begins |
//! | p2(t), Eq. (5) | [`Elongation`] | disputed: Eq. (6) rules |
//! | l(t), dl(t), N, Eq. (6), (8) | [`Axes::grown`] | length of a branch, and how fast it grows in which air |
//! | Temp(t), Humid(t), Eq. (8) | [`History`] | temperature and supersaturation, which may change |
//! | d_s, Eq. (10) | [`crate::hexgrid::STEPS`] | six directions, 60 degrees apart |
//! | g, c, m, u, W, Eq. (17) to (22) | [`fall`] | weight, resistance, and wind |
//! | v, M_i, Eq. (7), (14) | [`Cubes`] | elements of a crystal |
//! | b_min, b_v, b_s, rho, §2 | [`Cubes::side`], [`Voxels`] | sides of elements and voxels, elements of a voxel, density |
//!
//! | condition of §1.1.3 | is in |
//! |---|---|
//! | 1 speed from the diagram | [`Axes::grown`] with [`growth_ratio`] and [`deposition_density`] |
//! | 2 p1 high near plates, low near dendrites | [`Branching`] |
//! | 3 both sides alike | [`Layer`] is kept as one twelfth; branches come in mirrored pairs |
//! | 4 slower with order | [`Form::slowing`] |
//! | 5 layers begin where it is dense and platelike | [`Manner::births`], [`Layers::Dense`] |
//! | 6 branches above branches | [`Manner::above_branch`], [`Manner::above_none`] |
//!
//! | to | open |
//! |---|---|
//! | see where the page is disputed | [`Over`], [`Brackets`], [`Third`], [`Elongation`], [`Layers`], [`flake::Assembly`], [`fall::Drag`] |
//! | know what is assumed | [`Parameters::ASSUMED`], [`HabitLimits::ASSUMED`], [`flake::Joining::assumed`] |
//! | grow a crystal | [`Branching::new`] once, then [`Crystal::grow`] |
//! | know what grows in which air | [`Habit`], [`saturation`] |
//! | see many flakes before a background | [`still::Body`], then [`still::picture()`] |
//! | see one as under a microscope | [`Relief::of`], then [`Light::picture`] |
//! | know how many flakes fall, of which size | [`Sizes`] |
//! | test the conditions | [`Tally`], [`box_dimension`], [`symmetry_mismatch`] |
//!
//! The same seed gives the same crystal and flake, to the last bit.

mod axes;
mod branching;
mod crystal;
pub mod fall;
pub mod flake;
pub mod grammar;
mod growth;
mod habit;
mod history;
mod measure;
mod micrograph;
mod parameters;
mod readings;
mod relief;
pub mod saturation;
mod shoots;
mod sizes;
mod solid;
pub mod still;
mod tally;
#[cfg(test)]
mod tests;
mod twelfth;
mod voxels;

pub use axes::{Air, Axes};
pub use branching::{Branching, grown_layer, layer_fill};
pub use crystal::Crystal;
pub use habit::{Habit, HabitLimits, ICE, deposition_density, growth_ratio};
pub use history::{History, Weather};
pub use measure::{box_dimension, symmetry_mismatch};
pub use micrograph::{INDEX, Light};
pub use parameters::{Form, Parameters};
pub use readings::{Brackets, Elongation, Layers, Over, Third};
pub use relief::{Relief, View};
pub use shoots::{Manner, Vigour};
pub use sizes::{Sizes, aggregate_density, diameter_of_melted};
pub use tally::Tally;
pub use twelfth::{Layer, images, representative};
pub use voxels::{Cubes, MOST_VOXELS, Voxels};

/// Why there is no crystal or flake.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SnowError {
    /// A number is outside what is handled, or none at all.
    #[error("{name} is {value}; {least} to {most} is accepted")]
    OutOfRange {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least.
        least: f64,
        /// The most.
        most: f64,
    },
    /// A history without an entry.
    #[error("the history has no weather; at least one entry is needed")]
    NoWeather,
    /// There is nothing to count.
    #[error("there are no elements; at least one is needed")]
    NoElements,
    /// Elements of crystals that are put together differ in size.
    #[error("the crystals have elements of different sides; one side is needed")]
    Sides,
    /// Elements that do not fit cells.
    #[error("{0} elements along a cell; 1, 3, 5 and 7 are accepted")]
    Parts(u32),
    /// Crystals do not come to hold on to each other.
    #[error("no contact was found for {crystals} crystals in all tries: allow more ways or more tries")]
    NoContact {
        /// How many the flake would have had.
        crystals: usize,
    },
    /// The crystal grows out of what is handled.
    #[error(
        "{name} of the crystal is {cells} elements; up to 1000 are handled: take larger elements or less time"
    )]
    TooLarge {
        /// What of it.
        name: &'static str,
        /// Its size in elements.
        cells: f64,
    },
}

/// Refuses what is not a number within bounds, which are accepted themselves.
fn within(name: &'static str, value: f64, least: f64, most: f64) -> Result<(), SnowError> {
    // Not-a-number is in no range.
    if (least..=most).contains(&value) {
        Ok(())
    } else {
        Err(SnowError::OutOfRange { name, value, least, most })
    }
}
