//! The vital signs of a picture: is it exposed, is it finite.

use super::{Kind, Picture};

/// The largest share of a photograph's pixels that may be clipped.
pub const MOST_CLIPPED: f64 = 0.01;

/// Measured on a finished picture, and on the numbers it was made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vitals {
    /// Share of the pixels, 0 to 1, with all channels at 0.
    pub black: f64,
    /// Share of the pixels, 0 to 1, with all channels at 255.
    pub white: f64,
    /// The luma code (Rec. 709 weights) that at least 1 % of the pixels do not exceed.
    pub p01: u8,
    /// The luma code (Rec. 709 weights) that at least 99 % of the pixels do not exceed.
    pub p99: u8,
    /// Numbers that were infinite or not a number before the picture was made.
    pub non_finite: u64,
}

impl Vitals {
    /// Measures a picture; `non_finite` is counted on what it was made of, by [`Photograph::non_finite`] or
    /// [`CodeValues::non_finite`], and is 0 for a drawing.
    ///
    /// [`Photograph::non_finite`]: super::Photograph::non_finite
    /// [`CodeValues::non_finite`]: super::CodeValues::non_finite
    pub fn of(picture: &Picture, non_finite: u64) -> Self {
        let pixels = picture.pixels();
        let share = |code: u8| {
            pixels.iter().filter(|pixel| **pixel == [code; 3]).count() as f64 / pixels.len() as f64
        };
        let mut histogram = [0_u64; 256];
        for pixel in pixels {
            histogram[usize::from(luma(*pixel))] += 1;
        }
        Self {
            black: share(0),
            white: share(255),
            p01: percentile(&histogram, 1),
            p99: percentile(&histogram, 99),
            non_finite,
        }
    }

    /// One line on what is wrong with a picture of this kind, or nothing.
    ///
    /// A photograph must be finite and have no more than [`MOST_CLIPPED`] of its pixels at 0 and at 255 together; code
    /// values must be finite; a drawing may be anything.
    pub fn fault(&self, kind: Kind) -> Option<String> {
        if kind == Kind::Drawing {
            return None;
        }
        if self.non_finite > 0 {
            return Some(format!("{} values are infinite or not a number", self.non_finite));
        }
        let clipped = kind == Kind::Photograph && self.black + self.white > MOST_CLIPPED;
        clipped.then(|| {
            format!(
                "{:.1} % of the pixels are black and {:.1} % white; at most {} % may be clipped",
                100.0 * self.black,
                100.0 * self.white,
                100.0 * MOST_CLIPPED
            )
        })
    }
}

/// The luma of a colour, in whole numbers.
fn luma([r, g, b]: [u8; 3]) -> u8 {
    ((2126 * u32::from(r) + 7152 * u32::from(g) + 722 * u32::from(b) + 5000) / 10_000) as u8
}

/// The least code that `percent` of the counts do not exceed.
fn percentile(histogram: &[u64; 256], percent: u64) -> u8 {
    let enough = (histogram.iter().sum::<u64>() * percent).div_ceil(100);
    let mut seen = 0;
    histogram
        .iter()
        .position(|count| {
            seen += count;
            seen >= enough
        })
        .map_or(255, |code| code as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(black: usize, white: usize) -> Picture {
        let mut rgb = vec![100; 30_000];
        rgb[..3 * black].fill(0);
        rgb[30_000 - 3 * white..].fill(255);
        Picture::from_rgb(100, 100, rgb).unwrap()
    }

    #[test]
    fn shares_and_percentiles_are_counted() {
        let vitals = Vitals::of(&picture(99, 100), 0);
        assert_eq!((vitals.black, vitals.white), (0.0099, 0.01));
        assert_eq!((vitals.p01, vitals.p99), (100, 100));
        let vitals = Vitals::of(&picture(100, 9000), 0);
        assert_eq!((vitals.p01, vitals.p99), (0, 255));
    }

    #[test]
    fn luma_has_the_weights_of_rec_709() {
        assert_eq!([[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]].map(luma), [54, 182, 18, 255]);
    }

    #[test]
    fn a_photograph_may_clip_one_percent() {
        assert_eq!(Vitals::of(&picture(60, 40), 0).fault(Kind::Photograph), None);
        let clipped = Vitals::of(&picture(300, 40), 0);
        assert_eq!(
            clipped.fault(Kind::Photograph).as_deref(),
            Some("3.0 % of the pixels are black and 0.4 % white; at most 1 % may be clipped")
        );
        assert_eq!(clipped.fault(Kind::CodeValues), None);
    }

    #[test]
    fn what_is_not_finite_is_a_fault_in_all_but_a_drawing() {
        let sick = Vitals::of(&picture(0, 0), 7);
        assert_eq!(sick.fault(Kind::CodeValues).as_deref(), Some("7 values are infinite or not a number"));
        assert!(sick.fault(Kind::Photograph).is_some());
        assert_eq!(sick.fault(Kind::Drawing), None);
    }
}
