//! Fields of density made visible: extinction, emission and scattered light along rays through a grid.
//!
//! Extinction is tau times density, 1/m. Between the centres of the voxels density is trilinear, so that the optical
//! depth of a ray within a cell between eight centres is a cubic's integral: no step length, no quadrature error.
//!
//! | to | open |
//! |---|---|
//! | give a field | [`Density`] |
//! | look at it | [`Camera`], [`Ray`] |
//! | say how it is lit | [`Shading`]: [`Single`], [`Himeno`], [`Octaves`]; [`henyey_greenstein`] |
//! | have a picture | [`render()`]; several of one field: [`Renderer`] |
//! | know how deep a place is beneath the sun or the sky | [`Depths`]; one ray, exactly: [`Bricks::depth`] |
//!
//! Pictures are the same bytes on any number of threads, in debug and in release, and with and without the skipping of
//! empty space.

mod bricks;
mod camera;
mod density;
mod depths;
mod exponential;
mod gathered;
mod lines;
mod octaves;
mod printed;
mod render;
mod shading;
mod stencil;
#[cfg(test)]
mod tests;
mod vector;
mod walk;

pub use bricks::Bricks;
pub use camera::{Camera, Ray};
pub use density::{Density, MOST_SAMPLES};
pub use depths::Depths;
pub use exponential::exp;
pub(crate) use exponential::mean;
pub use octaves::{MOST_OCTAVES, Octaves};
pub use printed::Sums;
pub use render::{CUTOFF, Rendered, Renderer, Seen, render};
pub use shading::{Himeno, Shading, Single, henyey_greenstein};
pub use walk::Work;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VolumeError {
    /// A number is outside what is handled.
    #[error("{name} is {value}; {accepted} is handled")]
    OutOfRange {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would be.
        accepted: &'static str,
    },
    /// A direction has no length, or one that is not finite.
    #[error("{name} is ({}, {}, {}), which is no direction; one of finite length above 0 is handled", .value[0], .value[1], .value[2])]
    NoDirection {
        /// Which.
        name: &'static str,
        /// Its value.
        value: [f64; 3],
    },
    /// There are not as many samples as voxels.
    #[error("{values} samples for {} x {} x {} voxels; one for each is needed", .counts[0], .counts[1], .counts[2])]
    Counts {
        /// Voxels along x, y and z.
        counts: [usize; 3],
        /// Samples given.
        values: usize,
    },
    /// A sample cannot be a density.
    #[error("sample {at} is {value}; a density is finite and at least 0")]
    Sample {
        /// Its place in the list.
        at: usize,
        /// Its value.
        value: f32,
    },
    /// A picture has no pixels, or too many, or too many samples in one.
    #[error("a picture of {} x {} pixels with {samples} x {samples} samples; 1 to 32768 each way and 1 to 64 samples are handled", .size[0], .size[1])]
    Picture {
        /// Pixels across and down.
        size: [usize; 2],
        /// Samples of a pixel along each side.
        samples: usize,
    },
}

/// Refuses what is not finite or not within the bounds, which are allowed themselves.
fn within(
    name: &'static str,
    value: f64,
    low: f64,
    high: f64,
    accepted: &'static str,
) -> Result<(), VolumeError> {
    // Not-a-number is in no range.
    if value >= low && value <= high {
        Ok(())
    } else {
        Err(VolumeError::OutOfRange { name, value, accepted })
    }
}
