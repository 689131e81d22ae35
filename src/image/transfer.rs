//! The sRGB transfer function, and averages of light taken between 8-bit colours.

use std::sync::LazyLock;

/// Display-linear light (0 to 1) to the sRGB signal (0 to 1), exactly as IEC 61966-2-1 has it; odd beyond.
pub fn srgb_encode(linear: f64) -> f64 {
    let size = linear.abs();
    let signal = if size <= 0.003_130_8 { 12.92 * size } else { 1.055 * libm::pow(size, 1.0 / 2.4) - 0.055 };
    signal.copysign(linear)
}

/// The sRGB signal (0 to 1) to display-linear light (0 to 1), the inverse of [`srgb_encode`].
pub fn srgb_decode(signal: f64) -> f64 {
    let size = signal.abs();
    let linear = if size <= 0.040_45 { size / 12.92 } else { libm::pow((size + 0.055) / 1.055, 2.4) };
    linear.copysign(signal)
}

/// Light of a full channel, in the whole numbers that averages are taken in.
const FULL: f64 = (1u64 << 32) as f64;

/// Light of each code.
static LIGHT: LazyLock<[u64; 256]> = LazyLock::new(|| std::array::from_fn(|code| light(code as f64)));

/// Light halfway (in code) between each code and the next: where rounding changes its mind.
static HALFWAY: LazyLock<[u64; 255]> = LazyLock::new(|| std::array::from_fn(|code| light(code as f64 + 0.5)));

fn light(code: f64) -> u64 {
    libm::round(srgb_decode(code / 255.0) * FULL) as u64
}

/// The colour of a surface covered by several colours, each over its `weight` of the area: the mean of their light.
///
/// Exact to the code, whatever the order. Black when the weights sum to zero.
pub fn mean_light(parts: impl IntoIterator<Item = ([u8; 3], u16)>) -> [u8; 3] {
    let (mut sums, mut total) = ([0; 3], 0);
    for (colour, weight) in parts {
        total += u64::from(weight);
        for (sum, code) in sums.iter_mut().zip(colour) {
            *sum += LIGHT[usize::from(code)] * u64::from(weight);
        }
    }
    sums.map(|sum| HALFWAY.partition_point(|halfway| halfway * total.max(1) <= sum) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transfer_function_is_that_of_the_standard() {
        assert_eq!((srgb_encode(0.0), srgb_decode(0.0)), (0.0, 0.0));
        assert!((srgb_encode(1.0) - 1.0).abs() < 1e-15 && (srgb_decode(1.0) - 1.0).abs() < 1e-15);
        assert!((srgb_encode(0.18) - 0.461_356_129_500_441_64).abs() < 1e-12);
        assert!((srgb_decode(0.5) - 0.214_041_140_482_232_55).abs() < 1e-12);
        assert_eq!(srgb_encode(-0.001), -srgb_encode(0.001));
    }

    #[test]
    fn encoding_undoes_decoding() {
        for i in 0..=1000 {
            let signal = f64::from(i) / 1000.0;
            assert!((srgb_encode(srgb_decode(signal)) - signal).abs() < 1e-7);
        }
    }

    #[test]
    fn the_mean_of_one_colour_is_that_colour() {
        for code in 0..=255 {
            let colour = [code, 255 - code, code / 2];
            assert_eq!(mean_light([(colour, 3), (colour, 6)]), colour);
        }
    }

    #[test]
    fn half_black_and_half_white_is_brighter_than_middle_code() {
        assert_eq!(mean_light([([0; 3], 1), ([255; 3], 1)]), [188; 3]);
        assert_eq!(mean_light([([255; 3], 1), ([0; 3], 1)]), [188; 3]);
        assert_eq!(mean_light([]), [0; 3]);
    }
}
