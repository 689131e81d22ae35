//! Scene-linear light, and how it is developed for a display.
//!
//! Developing is: exposure (times 2^stops), tone curve, sRGB transfer, dither to 8 bits. The dither is triangular
//! noise, one code value to either side, so that the mean of the codes is the signal and slow gradients do not band.
//! Within half a code of black and of white, where triangular noise would leave the range and bias the mean, uniform
//! noise is taken, which has the same mean; black and white themselves are exact. The noise of a channel of a pixel
//! is a hash of its address, PCG3D of (x, y, channel): Jarzynski and Olano, "Hash Functions for GPU Rendering",
//! Journal of Computer Graphics Techniques 9(3), 2020.

use super::{ImageError, Kind, Picture, check_samples, srgb_encode};

/// Scene-linear radiance in the primaries of Rec. 709 under D65, row-major from the top left; 1 is the white of the
/// display at zero stops through [`ToneCurve::Linear`].
#[derive(Clone, Debug, PartialEq)]
pub struct Photograph {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

/// How long the film is exposed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposure {
    /// Each stop doubles the light.
    pub stops: f64,
}

/// From exposed light to the light of the display, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToneCurve {
    /// Unbent; what is brighter than 1 is clipped.
    Linear,
    /// L (1 + L / white²) / (1 + L) of the luminance, the colour scaled with it and clipped: Reinhard et al.,
    /// "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equation 4.
    Reinhard {
        /// The least luminance that becomes white, above 0.
        white: f64,
    },
    /// x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) of each channel: Narkowicz, "ACES Filmic Tone Mapping Curve",
    /// 2015, a fit to the reference rendering of the Academy.
    Filmic,
}

impl ToneCurve {
    /// The display's light, not yet clipped, for light that is not negative.
    fn bend(self, light: [f64; 3]) -> [f64; 3] {
        match self {
            ToneCurve::Linear => light,
            ToneCurve::Reinhard { white } => {
                let luminance = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
                let scale = (1.0 + luminance / (white * white)) / (1.0 + luminance);
                light.map(|x| x * scale)
            }
            ToneCurve::Filmic => light.map(|x| x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)),
        }
    }
}

impl Photograph {
    /// The photograph of these pixels, `width * height`; refused when they are more or fewer.
    pub fn new(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Result<Self, ImageError> {
        check_samples(width, height, 1, pixels.len())?;
        Ok(Self { width, height, pixels })
    }

    /// Width in pixels, at least one.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels, at least one.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The light of every pixel.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// Number of channels of pixels that are infinite or not a number.
    pub fn non_finite(&self) -> u64 {
        self.pixels.as_flattened().iter().filter(|x| !x.is_finite()).count() as u64
    }

    /// The picture for a display. Negative light and what is not a number count as none, infinite light as the
    /// brightest that there is.
    pub fn develop(&self, exposure: Exposure, curve: ToneCurve) -> Picture {
        let columns = self.width as usize;
        let gain = libm::exp2(exposure.stops);
        Picture::painted(self.width, self.height, Kind::Photograph, |y, row| {
            let light = &self.pixels[y * columns..];
            for (x, (pixel, light)) in row.iter_mut().zip(light).enumerate() {
                let bent = curve.bend(light.map(|channel| exposed(channel, gain)));
                *pixel = std::array::from_fn(|channel| {
                    dithered(
                        255.0 * srgb_encode(bent[channel].min(1.0)),
                        [x as u32, y as u32, channel as u32],
                    )
                });
            }
        })
    }
}

/// Light after exposure: a number from 0 to `BRIGHTEST`, within which no tone curve overflows.
fn exposed(light: f32, gain: f64) -> f64 {
    const BRIGHTEST: f64 = 1e30;
    let exposed = f64::from(light) * gain;
    if exposed > 0.0 { exposed.min(BRIGHTEST) } else { 0.0 }
}

/// The code of a signal (0 to 255) at an address, equal to the signal in the mean over addresses.
fn dithered(signal: f64, address: [u32; 3]) -> u8 {
    if signal <= 0.0 || signal >= 255.0 {
        return signal as u8;
    }
    let [first, second, _] = pcg3d(address).map(|bits| (f64::from(bits) + 0.5) / 4_294_967_296.0);
    let noise = if (0.5..=254.5).contains(&signal) { first + second - 0.5 } else { first };
    libm::floor(signal + noise) as u8
}

/// PCG3D: three well mixed words from three words.
fn pcg3d([x, y, z]: [u32; 3]) -> [u32; 3] {
    let step = |word: u32| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    let stir = |[mut x, mut y, mut z]: [u32; 3]| {
        x = x.wrapping_add(y.wrapping_mul(z));
        y = y.wrapping_add(z.wrapping_mul(x));
        z = z.wrapping_add(x.wrapping_mul(y));
        [x, y, z]
    };
    stir(stir([x, y, z].map(step)).map(|word| word ^ (word >> 16)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::srgb_decode;

    const AS_IS: Exposure = Exposure { stops: 0.0 };

    fn flat(side: u32, light: f32) -> Photograph {
        Photograph::new(side, side, vec![[light; 3]; (side * side) as usize]).unwrap()
    }

    fn mean(picture: &Picture) -> f64 {
        picture.rgb().iter().map(|code| f64::from(*code)).sum::<f64>() / picture.rgb().len() as f64
    }

    #[test]
    fn dither_does_not_bias_the_mean_anywhere() {
        for signal in [0.02, 0.3, 0.49, 0.51, 1.2, 100.3, 127.75, 254.45, 254.7, 254.99] {
            let picture = flat(256, srgb_decode(signal / 255.0) as f32).develop(AS_IS, ToneCurve::Linear);
            assert!((mean(&picture) - signal).abs() < 0.006, "{signal} became {}", mean(&picture));
        }
    }

    #[test]
    fn dither_is_triangular_noise_that_channels_do_not_share() {
        let picture = flat(256, srgb_decode(100.0 / 255.0) as f32).develop(AS_IS, ToneCurve::Linear);
        let share = |code: u8| picture.rgb().iter().filter(|c| **c == code).count() as f64 / 196_608.0;
        assert!((share(100) - 0.75).abs() < 0.005);
        assert!((share(99) - 0.125).abs() < 0.005 && (share(101) - 0.125).abs() < 0.005);
        assert!(picture.pixels().iter().any(|p| p[0] != p[1] && p[1] != p[2]));
    }

    #[test]
    fn black_and_white_are_exact() {
        for curve in [ToneCurve::Linear, ToneCurve::Reinhard { white: 4.0 }, ToneCurve::Filmic] {
            assert!(flat(64, 0.0).develop(AS_IS, curve).rgb().iter().all(|code| *code == 0));
            assert!(flat(64, 20.0).develop(AS_IS, curve).rgb().iter().all(|code| *code == 255));
        }
    }

    #[test]
    fn a_stop_doubles_the_light() {
        let once = flat(16, 0.25).develop(Exposure { stops: 1.0 }, ToneCurve::Filmic);
        assert_eq!(once, flat(16, 0.5).develop(AS_IS, ToneCurve::Filmic));
    }

    #[test]
    fn curves_rise_and_reach_white_where_they_say() {
        for curve in [ToneCurve::Linear, ToneCurve::Reinhard { white: 4.0 }, ToneCurve::Filmic] {
            let bent: Vec<f64> = (0..500).map(|i| curve.bend([f64::from(i) * 0.02; 3])[0]).collect();
            assert!(bent.is_sorted_by(|a, b| a < b), "{curve:?}");
        }
        assert!((ToneCurve::Reinhard { white: 4.0 }.bend([4.0; 3])[0] - 1.0).abs() < 1e-12);
        assert!((ToneCurve::Filmic.bend([1.0; 3])[1] - 2.54 / 3.16).abs() < 1e-12);
        let [r, g, _] = ToneCurve::Reinhard { white: 4.0 }.bend([2.0, 1.0, 0.5]);
        assert!((r / g - 2.0).abs() < 1e-12, "the hue is kept");
    }

    #[test]
    fn what_is_no_light_is_black_and_the_infinite_is_white() {
        let pixels = vec![[f32::NAN, -1.0, f32::NEG_INFINITY], [f32::INFINITY; 3]];
        let photograph = Photograph::new(2, 1, pixels).unwrap();
        assert_eq!(photograph.non_finite(), 5);
        for curve in [ToneCurve::Linear, ToneCurve::Reinhard { white: 2.0 }, ToneCurve::Filmic] {
            assert_eq!(photograph.develop(AS_IS, curve).rgb(), [0, 0, 0, 255, 255, 255]);
        }
    }

    #[test]
    fn the_hash_is_the_published_one() {
        // Computed from the listing of the paper with another program.
        assert_eq!(pcg3d([1, 2, 3]), [4204755366, 1223881804, 1500469937]);
    }
}
