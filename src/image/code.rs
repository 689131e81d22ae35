//! Pictures whose equation gives the pixel.

use super::{ImageError, Kind, Picture, check_samples};

/// A grey picture of code values, 0 (black) to 255 (white), as an equation gave them; row-major from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct CodeValues {
    width: u32,
    height: u32,
    values: Vec<f64>,
}

impl CodeValues {
    /// The picture of these values, `width * height`; refused when they are more or fewer.
    pub fn new(width: u32, height: u32, values: Vec<f64>) -> Result<Self, ImageError> {
        check_samples(width, height, 1, values.len())?;
        Ok(Self { width, height, values })
    }

    /// Width in pixels, at least one.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels, at least one.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The value of every pixel.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Number of values that are infinite or not a number.
    pub fn non_finite(&self) -> u64 {
        self.values.iter().filter(|value| !value.is_finite()).count() as u64
    }

    /// The picture: every value rounded, half up, and clamped to 0..=255. No curve, no transfer, no dither.
    ///
    /// What is not a number is drawn black; [`non_finite`](CodeValues::non_finite) counts it.
    pub fn picture(&self) -> Picture {
        let columns = self.width as usize;
        Picture::painted(self.width, self.height, Kind::CodeValues, |y, row| {
            for (pixel, value) in row.iter_mut().zip(&self.values[y * columns..]) {
                *pixel = [code(*value); 3];
            }
        })
    }
}

/// Rounds half up. Adding 0.5 first would lift the largest number below one half to 1.
fn code(value: f64) -> u8 {
    let below = libm::floor(value);
    (if value - below >= 0.5 { below + 1.0 } else { below }) as u8 // the cast clamps, and takes NaN to 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_rounded_half_up_and_clamped() {
        for (value, expected) in [
            (127.4, 127),
            (127.5, 128),
            (128.5, 129),
            (0.5_f64.next_down(), 0),
            (254.5, 255),
            (-0.5, 0),
            (-1e300, 0),
            (1e300, 255),
            (f64::INFINITY, 255),
            (f64::NAN, 0),
        ] {
            assert_eq!(code(value), expected, "of {value}");
        }
    }

    #[test]
    fn nothing_bends_the_values() {
        let values: Vec<f64> = (0..256).map(f64::from).collect();
        let picture = CodeValues::new(16, 16, values).unwrap().picture();
        assert_eq!(picture.kind(), Kind::CodeValues);
        for (code, pixel) in picture.pixels().iter().enumerate() {
            assert_eq!(*pixel, [code as u8; 3]);
        }
    }

    #[test]
    fn what_is_not_finite_is_counted() {
        let values = CodeValues::new(2, 2, vec![f64::NAN, 1.0, f64::NEG_INFINITY, 1e308]).unwrap();
        assert_eq!(values.non_finite(), 2);
        assert!(CodeValues::new(2, 2, vec![0.0; 5]).is_err());
    }
}
