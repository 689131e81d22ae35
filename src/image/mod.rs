//! Pictures, one way, for five models.
//!
//! There are two kinds of data that become a picture, and confusing them is the commonest way to ruin a comparison.
//! A [`Photograph`] holds scene-linear radiance: light, which may be brighter than any display. It is *developed*:
//! exposed, bent by a tone curve, encoded for the sRGB display and dithered to 8 bits. [`CodeValues`] hold what an
//! equation says the pixel *is*, from 0 to 255: they are rounded and nothing else, because any curve would draw a
//! different equation. What is neither, a chart or a coloured lattice, is a drawing. [`Kind`] tells the three apart,
//! and [`Vitals`] judges each by its own standard.
//!
//! | what | where |
//! |---|---|
//! | light to pixels, numbers to pixels | [`photograph`], [`code`] |
//! | is it over-exposed, is it finite | [`vitals`] |
//! | PNG and animated PNG, there and back; are two files the same picture | [`mod@file`], [`film`], [`compare`] |
//! | drawing: words, hexagons, colours | [`text`], [`lattice`], [`colour`] |
//! | the sRGB transfer function, averages of light | [`transfer`] |
//!
//! Every function gives the same bytes on every machine: the only transcendental functions are those of `libm`.

pub mod code;
pub mod colour;
pub mod compare;
pub mod file;
pub mod film;
pub mod lattice;
pub mod photograph;
mod picture;
mod reel;
pub mod text;
pub mod transfer;
pub mod vitals;

pub use code::CodeValues;
pub use compare::{largest_difference, pixel_digest};
pub use file::{Decoded, decode, decode_16, encode, encode_grey16_alpha};
pub use film::encode_animation;
pub use lattice::{LatticeRaster, LatticeView};
pub use photograph::{Exposure, Photograph, ToneCurve};
pub use picture::{Grey16Alpha, Picture};
pub use text::{Face, draw_text, text_width};
pub use transfer::{mean_light, srgb_decode, srgb_encode};
pub use vitals::Vitals;

/// The most pixels one picture may have.
pub const MOST_PIXELS: u64 = 64 << 20;

/// What a picture is of, and so by which standard it is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Developed from scene-linear radiance.
    Photograph,
    /// The values of an equation, unbent.
    CodeValues,
    /// Anything else: a chart, a lattice, a sheet of other pictures.
    Drawing,
}

impl Kind {
    /// `photograph`, `code-values` or `drawing`.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Photograph => "photograph",
            Kind::CodeValues => "code-values",
            Kind::Drawing => "drawing",
        }
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ImageError {
    /// A side is zero.
    #[error("a picture of {width} x {height} pixels has nothing in it")]
    Empty {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// More than [`MOST_PIXELS`].
    #[error("{width} x {height} pixels are too many; at most {MOST_PIXELS} are handled")]
    TooLarge {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// The samples handed over are not one for every pixel (and channel).
    #[error("{expected} samples are needed for the size, {found} were given")]
    Samples {
        /// What the size asks for.
        expected: usize,
        /// What was there.
        found: usize,
    },
    /// The bytes are not a PNG, or a broken one.
    #[error("not a readable PNG: {0}")]
    Unreadable(String),
    /// More pixels over all frames than are handled.
    #[error("an animation of {frames} frames of {width} x {height} pixels is too long")]
    TooLong {
        /// Frames it announces.
        frames: u32,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// There is no picture to arrange or to animate.
    #[error("no pictures were given; at least one is needed")]
    NoPictures,
    /// A frame has not the size of the first.
    #[error("frame {frame} is {width} x {height} pixels, unlike the first frame")]
    FrameSize {
        /// Which frame, counted from 0.
        frame: usize,
        /// Its width in pixels.
        width: u32,
        /// Its height in pixels.
        height: u32,
    },
    /// No frame may last for ever.
    #[error("an animation needs at least one frame per second")]
    FrameRate,
    /// The scale of a view is not a positive, finite number of pixels.
    #[error("a lattice cannot be drawn at {0} pixels per unit")]
    Scale(f64),
}

/// The number of pixels of a size that is handled.
pub(crate) fn pixel_count(width: u32, height: u32) -> Result<usize, ImageError> {
    match u64::from(width) * u64::from(height) {
        0 => Err(ImageError::Empty { width, height }),
        count if count > MOST_PIXELS => Err(ImageError::TooLarge { width, height }),
        count => Ok(count as usize),
    }
}

/// Checks that there are `channels` samples for every pixel of a size that is handled.
pub(crate) fn check_samples(
    width: u32,
    height: u32,
    channels: usize,
    found: usize,
) -> Result<(), ImageError> {
    let expected = pixel_count(width, height)? * channels;
    if found == expected { Ok(()) } else { Err(ImageError::Samples { expected, found }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_checked_without_overflow() {
        assert_eq!(pixel_count(8192, 8192), Ok(1 << 26));
        assert!(matches!(pixel_count(8193, 8192), Err(ImageError::TooLarge { .. })));
        assert!(matches!(pixel_count(u32::MAX, u32::MAX), Err(ImageError::TooLarge { .. })));
        assert!(matches!(pixel_count(0, u32::MAX), Err(ImageError::Empty { .. })));
    }

    #[test]
    fn an_error_is_one_line() {
        let errors = [
            ImageError::TooLarge { width: 9000, height: 9000 },
            ImageError::Samples { expected: 3, found: 4 },
            ImageError::Scale(f64::NAN),
        ];
        for error in errors {
            assert_eq!(error.to_string().lines().count(), 1);
        }
    }
}
