//! Colours that are told apart by everyone: sequential and diverging maps, and a palette of names.
//!
//! Maps go through control points, in straight lines through Oklab (Ottosson, "A perceptual color space for image
//! processing", 2020). In a sequential map the points lie where their lightness puts them, so that equal steps of the
//! number are equal steps of lightness, and the map reads the same in grey.

use std::sync::LazyLock;

use super::transfer::{srgb_decode, srgb_encode};

/// Black, in the palette of Okabe and Ito.
pub const BLACK: [u8; 3] = [0, 0, 0];
/// Orange, in the palette of Okabe and Ito.
pub const ORANGE: [u8; 3] = [230, 159, 0];
/// Sky blue, in the palette of Okabe and Ito.
pub const SKY_BLUE: [u8; 3] = [86, 180, 233];
/// Bluish green, in the palette of Okabe and Ito.
pub const BLUISH_GREEN: [u8; 3] = [0, 158, 115];
/// Yellow, in the palette of Okabe and Ito.
pub const YELLOW: [u8; 3] = [240, 228, 66];
/// Blue, in the palette of Okabe and Ito.
pub const BLUE: [u8; 3] = [0, 114, 178];
/// Vermilion, in the palette of Okabe and Ito.
pub const VERMILION: [u8; 3] = [213, 94, 0];
/// Reddish purple, in the palette of Okabe and Ito.
pub const REDDISH_PURPLE: [u8; 3] = [204, 121, 167];

/// The palette for categories with its names: Okabe and Ito, "Color Universal Design", 2008.
pub const OKABE_ITO: [(&str, [u8; 3]); 8] = [
    ("black", BLACK),
    ("orange", ORANGE),
    ("sky blue", SKY_BLUE),
    ("bluish green", BLUISH_GREEN),
    ("yellow", YELLOW),
    ("blue", BLUE),
    ("vermilion", VERMILION),
    ("reddish purple", REDDISH_PURPLE),
];

/// Sequential, for the age of frost: from deep night through glacier blue to near-white.
pub static FROST: LazyLock<ColourMap> = LazyLock::new(|| {
    ColourMap::sequential(&[
        0x070b1f, 0x0c2148, 0x114074, 0x1b669e, 0x378fbe, 0x6cb7d6, 0xa9d9e8, 0xd9eff4, 0xfafdfe,
    ])
});

/// Sequential, blue to yellow: Nuñez, Anderton and Renslow, "Optimizing colormaps with consideration for color vision
/// deficiency", PLoS ONE 13(7), 2018, at ten points.
pub static CIVIDIS: LazyLock<ColourMap> = LazyLock::new(|| {
    ColourMap::sequential(&[
        0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46,
    ])
});

/// Diverging: blue below the middle, near-white at it, orange above.
pub static DIVERGING: LazyLock<ColourMap> = LazyLock::new(|| {
    ColourMap::even(&[0x1e487c, 0x4684c0, 0x9cc7e8, 0xf7f7f5, 0xe8b683, 0xb56c25, 0x6f3603])
});

/// 256 colours for the numbers 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourMap {
    colours: [[u8; 3]; 256],
}

impl ColourMap {
    /// The colour of a number; below 0 that of 0, above 1 that of 1, and that of 0 for what is not a number.
    pub fn at(&self, number: f64) -> [u8; 3] {
        self.colours[libm::floor(255.0 * number + 0.5) as u8 as usize] // the cast clamps, and takes NaN to 0
    }

    /// All colours, in order.
    pub fn colours(&self) -> &[[u8; 3]; 256] {
        &self.colours
    }

    /// Through these colours (0xRRGGBB), each at the place of its lightness; the lightness must rise.
    fn sequential(points: &[u32]) -> Self {
        let points: Vec<[f64; 3]> = points.iter().map(|point| oklab(hex(*point))).collect();
        let (darkest, lightest) = (points[0][0], points[points.len() - 1][0]);
        let place = |lab: &[f64; 3]| (lab[0] - darkest) / (lightest - darkest);
        Self::through(&points.iter().map(|lab| (place(lab), *lab)).collect::<Vec<_>>())
    }

    /// Through these colours (0xRRGGBB) in even steps.
    fn even(points: &[u32]) -> Self {
        let last = (points.len() - 1) as f64;
        let place = |(at, point): (usize, &u32)| (at as f64 / last, oklab(hex(*point)));
        Self::through(&points.iter().enumerate().map(place).collect::<Vec<_>>())
    }

    fn through(points: &[(f64, [f64; 3])]) -> Self {
        let colour = |entry: usize| {
            let place = entry as f64 / 255.0;
            let above = points.partition_point(|point| point.0 < place).clamp(1, points.len() - 1);
            let ((start, from), (end, to)) = (points[above - 1], points[above]);
            let share = (place - start) / (end - start);
            true_to_lightness(std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis])))
        };
        Self { colours: std::array::from_fn(colour) }
    }
}

fn hex(colour: u32) -> [u8; 3] {
    let [_, r, g, b] = colour.to_be_bytes();
    [r, g, b]
}

/// An sRGB colour in Oklab: lightness (0 to 1), green to red, blue to yellow.
pub fn oklab(colour: [u8; 3]) -> [f64; 3] {
    let [r, g, b] = colour.map(|code| srgb_decode(f64::from(code) / 255.0));
    let l = libm::cbrt(0.412_221_470_8 * r + 0.536_332_536_3 * g + 0.051_445_992_9 * b);
    let m = libm::cbrt(0.211_903_498_2 * r + 0.680_699_545_1 * g + 0.107_396_956_6 * b);
    let s = libm::cbrt(0.088_302_461_9 * r + 0.281_718_837_6 * g + 0.629_978_700_5 * b);
    [
        0.210_454_255_3 * l + 0.793_617_785_0 * m - 0.004_072_046_8 * s,
        1.977_998_495_1 * l - 2.428_592_205_0 * m + 0.450_593_709_9 * s,
        0.025_904_037_1 * l + 0.782_771_766_2 * m - 0.808_675_766_0 * s,
    ]
}

/// The sRGB colour of one in Oklab, each channel clipped and rounded; the inverse of [`oklab`].
pub fn from_oklab(lab: [f64; 3]) -> [u8; 3] {
    signal(lab).map(|code| libm::floor(code + 0.5) as u8)
}

/// Like [`from_oklab`], but of the eight colours around, the one that is truest in lightness above all: rounding each
/// channel alone would let the lightness of a map fall back here and there.
fn true_to_lightness(lab: [f64; 3]) -> [u8; 3] {
    let below = signal(lab).map(libm::floor);
    let corner =
        |up: u8| std::array::from_fn(|channel| (below[channel] as u8).saturating_add(up >> channel & 1));
    let error = |colour: [u8; 3]| {
        let [l, a, b] = oklab(colour);
        9.0 * (l - lab[0]) * (l - lab[0]) + (a - lab[1]) * (a - lab[1]) + (b - lab[2]) * (b - lab[2])
    };
    (1..8).map(corner).fold(corner(0), |best, next| if error(next) < error(best) { next } else { best })
}

/// The sRGB signal of a colour in Oklab, 0 to 255, not rounded.
fn signal([lightness, a, b]: [f64; 3]) -> [f64; 3] {
    let cubed = |x: f64| x * x * x;
    let l = cubed(lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let m = cubed(lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let s = cubed(lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ]
    .map(|light| (255.0 * srgb_encode(light)).clamp(0.0, 255.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lightness(map: &ColourMap) -> Vec<f64> {
        map.colours().iter().map(|colour| oklab(*colour)[0]).collect()
    }

    #[test]
    fn oklab_is_that_of_its_author() {
        let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4);
        assert!(close(oklab([255; 3]), [1.0, 0.0, 0.0]));
        assert!(close(oklab([255, 0, 0]), [0.627_96, 0.224_86, 0.125_85]));
        for colour in OKABE_ITO.map(|(_, colour)| colour) {
            assert_eq!(from_oklab(oklab(colour)), colour);
        }
    }

    #[test]
    fn sequential_maps_rise_in_lightness_evenly() {
        for map in [&*FROST, &*CIVIDIS] {
            let lightness = lightness(map);
            assert!(lightness.is_sorted_by(|a, b| a < b));
            let (first, last) = (lightness[0], lightness[255]);
            for (entry, l) in lightness.iter().enumerate() {
                let even = first + (last - first) * entry as f64 / 255.0;
                assert!((l - even).abs() < 0.004, "entry {entry}");
            }
        }
    }

    #[test]
    fn frost_is_from_night_to_near_white() {
        assert_eq!((FROST.at(0.0), FROST.at(1.0)), ([7, 11, 31], [250, 253, 254]));
        assert!(lightness(&FROST)[255] - lightness(&FROST)[0] > 0.8);
        assert!(FROST.colours().iter().all(|[r, g, b]| r <= g && g <= b));
    }

    #[test]
    fn the_diverging_map_is_lightest_in_the_middle() {
        let lightness = lightness(&DIVERGING);
        assert!(lightness[..128].is_sorted() && lightness[128..].is_sorted_by(|a, b| a >= b));
        assert!(
            (0..128).all(|i| (lightness[i] - lightness[255 - i]).abs() < 0.006),
            "both sides weigh the same"
        );
    }

    #[test]
    fn numbers_outside_take_the_ends() {
        for map in [&*FROST, &*DIVERGING] {
            assert_eq!((map.at(-1e300), map.at(f64::INFINITY)), (map.at(0.0), map.at(1.0)));
            assert_eq!(map.at(f64::NAN), map.at(0.0));
        }
    }
}
