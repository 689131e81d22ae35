//! PNG files: writing them in one way, and reading them all.
//!
//! The same picture gives the same bytes: compression level and filter are fixed, nothing is stamped with a time, and
//! colours enter a palette in the order in which they appear. [`decode`] takes every colour type of the format.

use std::borrow::Cow;

use png::{BitDepth, ColorType, DeflateCompression, Encoder, Filter};

use super::reel::Reel;
use super::{Grey16Alpha, ImageError, Picture};

/// The one compression level.
const LEVEL: u8 = 6;

/// A decoded picture with 8-bit (`u8`) or 16-bit (`u16`) samples; alpha does not multiply the colour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decoded<T = u8> {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue and alpha of every pixel, row-major from the top left.
    pub rgba: Vec<[T; 4]>,
}

/// The PNG of a picture, with a palette when it has at most 256 colours.
pub fn encode(picture: &Picture) -> Vec<u8> {
    let paint = Paint::of([picture.pixels()]);
    let mut bytes = Vec::new();
    let encoder = paint.encoder(&mut bytes, picture.width(), picture.height());
    write_still(encoder, &paint.samples(picture.pixels()));
    bytes
}

/// The 16-bit grey and alpha PNG of a matte.
pub fn encode_grey16_alpha(matte: &Grey16Alpha) -> Vec<u8> {
    let samples: Vec<u8> = matte
        .grey()
        .iter()
        .zip(matte.alpha())
        .flat_map(|(g, a)| [*g, *a])
        .flat_map(u16::to_be_bytes)
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = encoder(&mut bytes, matte.width(), matte.height(), Filter::Adaptive);
    encoder.set_color(ColorType::GrayscaleAlpha);
    encoder.set_depth(BitDepth::Sixteen);
    write_still(encoder, &samples);
    bytes
}

/// The picture of a PNG (the first, of an animation) with 8-bit samples; 16-bit samples are rounded to the nearest.
///
/// A size over [`MOST_PIXELS`](super::MOST_PIXELS) is refused before memory is asked for, and bytes that are no PNG or
/// a broken one before a picture is returned.
pub fn decode(bytes: &[u8]) -> Result<Decoded, ImageError> {
    let deep = decode_16(bytes)?;
    let rgba = deep.rgba.iter().map(|pixel| pixel.map(narrowed)).collect();
    Ok(Decoded { width: deep.width, height: deep.height, rgba })
}

/// Like [`decode`] with 16-bit samples; those of fewer bits are widened so that full stays full.
pub fn decode_16(bytes: &[u8]) -> Result<Decoded<u16>, ImageError> {
    Reel::open(bytes)?.into_first_picture()
}

/// The nearest 8-bit sample.
pub(crate) fn narrowed(sample: u16) -> u8 {
    ((u32::from(sample) + 128) / 257) as u8
}

/// An encoder with the settings that all files share.
fn encoder(bytes: &mut Vec<u8>, width: u32, height: u32, filter: Filter) -> Encoder<'_, &mut Vec<u8>> {
    let mut encoder = Encoder::new(bytes, width, height);
    encoder.set_deflate_compression(DeflateCompression::Level(LEVEL));
    encoder.set_filter(filter);
    encoder
}

fn write_still(encoder: Encoder<'_, &mut Vec<u8>>, samples: &[u8]) {
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(samples)?;
        writer.finish()
    });
    written.expect("a picture has a size and its samples, and memory takes every byte");
}

/// How the pixels of one file are stored.
pub(crate) enum Paint {
    Palette(Palette),
    Rgb,
}

impl Paint {
    /// A palette for all these pixels if their colours fit one.
    pub(crate) fn of<'a>(pictures: impl IntoIterator<Item = &'a [[u8; 3]]>) -> Self {
        let mut palette = Palette::new();
        let fits = pictures.into_iter().all(|pixels| palette.takes(pixels));
        if fits { Paint::Palette(palette) } else { Paint::Rgb }
    }

    /// An encoder of pixels stored so. Neighbouring palette entries are not alike, so filters would only do harm.
    pub(crate) fn encoder<'a>(
        &self,
        bytes: &'a mut Vec<u8>,
        width: u32,
        height: u32,
    ) -> Encoder<'a, &'a mut Vec<u8>> {
        match self {
            Paint::Palette(palette) => {
                let mut encoder = encoder(bytes, width, height, Filter::NoFilter);
                encoder.set_color(ColorType::Indexed);
                encoder.set_palette(palette.colours.as_flattened().to_vec());
                encoder
            }
            Paint::Rgb => {
                let mut encoder = encoder(bytes, width, height, Filter::Adaptive);
                encoder.set_color(ColorType::Rgb);
                encoder
            }
        }
    }

    /// What is stored for pixels that were among those of [`of`](Paint::of).
    pub(crate) fn samples<'a>(&self, pixels: &'a [[u8; 3]]) -> Cow<'a, [u8]> {
        match self {
            Paint::Palette(palette) => pixels.iter().map(|pixel| palette.entry(*pixel)).collect(),
            Paint::Rgb => Cow::Borrowed(pixels.as_flattened()),
        }
    }
}

/// Up to 256 colours, found again through a table over all 2^24.
pub(crate) struct Palette {
    colours: Vec<[u8; 3]>,
    // One more than the entry of each colour; 0 for a colour not met, so that the table starts as untouched memory.
    places: Vec<u16>,
}

impl Palette {
    fn new() -> Self {
        Self { colours: Vec::new(), places: vec![0; 1 << 24] }
    }

    /// Learns the colours of these pixels; false when they are too many.
    fn takes(&mut self, pixels: &[[u8; 3]]) -> bool {
        for pixel in pixels {
            let place = &mut self.places[address(*pixel)];
            if *place == 0 {
                if self.colours.len() == 256 {
                    return false;
                }
                self.colours.push(*pixel);
                *place = self.colours.len() as u16;
            }
        }
        true
    }

    /// The entry of a colour that was learnt.
    fn entry(&self, pixel: [u8; 3]) -> u8 {
        self.places[address(pixel)].wrapping_sub(1) as u8
    }
}

fn address([r, g, b]: [u8; 3]) -> usize {
    usize::from(r) << 16 | usize::from(g) << 8 | usize::from(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(colours: u32) -> Picture {
        let rgb = (0..40 * 30).flat_map(|i| [(i % colours) as u8, ((i % colours) >> 8) as u8, 7]).collect();
        Picture::from_rgb(40, 30, rgb).unwrap()
    }

    fn png(
        colour: ColorType,
        depth: BitDepth,
        extra: impl Fn(&mut Encoder<'_, &mut Vec<u8>>),
        data: &[u8],
    ) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(colour);
        encoder.set_depth(depth);
        extra(&mut encoder);
        write_still(encoder, data);
        bytes
    }

    #[test]
    fn what_is_written_is_read_back() {
        for colours in [1, 2, 256, 257, 1200] {
            let picture = picture(colours);
            let decoded = decode(&encode(&picture)).unwrap();
            assert_eq!((decoded.width, decoded.height), (40, 30));
            let expected: Vec<_> = picture.pixels().iter().map(|[r, g, b]| [*r, *g, *b, 255]).collect();
            assert_eq!(decoded.rgba, expected, "of {colours} colours");
        }
    }

    #[test]
    fn a_palette_is_used_up_to_256_colours() {
        let colour_type = |colours| encode(&picture(colours))[25];
        assert_eq!((colour_type(256), colour_type(257)), (3, 2));
    }

    #[test]
    fn a_matte_keeps_all_its_bits() {
        let matte = Grey16Alpha::new(2, 1, vec![0x1234, 1], vec![65_535, 2]).unwrap();
        let bytes = encode_grey16_alpha(&matte);
        assert_eq!(decode_16(&bytes).unwrap().rgba, [[0x1234, 0x1234, 0x1234, 65_535], [1, 1, 1, 2]]);
        assert_eq!(decode(&bytes).unwrap().rgba, [[18, 18, 18, 255], [0, 0, 0, 0]]);
    }

    #[test]
    fn every_colour_type_is_read() {
        use {BitDepth::*, ColorType::*};
        let none = |_: &mut Encoder<'_, &mut Vec<u8>>| ();
        let cases = [
            (png(Grayscale, One, none, &[0b0100_0000]), [[0, 0, 0, 255], [255; 4]]),
            (png(Grayscale, Four, none, &[0x1f]), [[17, 17, 17, 255], [255; 4]]),
            (png(Grayscale, Eight, none, &[3, 4]), [[3, 3, 3, 255], [4, 4, 4, 255]]),
            (png(Grayscale, Sixteen, none, &[3, 200, 4, 0]), [[4, 4, 4, 255], [4, 4, 4, 255]]),
            (png(GrayscaleAlpha, Eight, none, &[3, 0, 4, 9]), [[3, 3, 3, 0], [4, 4, 4, 9]]),
            (png(Rgb, Eight, none, &[1, 2, 3, 4, 5, 6]), [[1, 2, 3, 255], [4, 5, 6, 255]]),
            (png(Rgba, Eight, none, &[1, 2, 3, 4, 5, 6, 7, 8]), [[1, 2, 3, 4], [5, 6, 7, 8]]),
            (
                png(Rgb, Eight, |e| e.set_trns(vec![0, 4, 0, 5, 0, 6]), &[1, 2, 3, 4, 5, 6]),
                [[1, 2, 3, 255], [4, 5, 6, 0]],
            ),
            (png(Grayscale, Eight, |e| e.set_trns(vec![0, 4]), &[3, 4]), [[3, 3, 3, 255], [4, 4, 4, 0]]),
        ];
        for (case, (bytes, expected)) in cases.iter().enumerate() {
            assert_eq!(decode(bytes).unwrap().rgba, expected, "case {case}");
        }
        let palette = |e: &mut Encoder<'_, &mut Vec<u8>>| {
            e.set_palette(vec![1, 2, 3, 4, 5, 6]);
            e.set_trns(vec![9]);
        };
        let decoded = decode(&png(Indexed, Two, palette, &[0b0001_0000])).unwrap();
        assert_eq!(decoded.rgba, [[1, 2, 3, 9], [4, 5, 6, 255]]);
    }

    #[test]
    fn samples_narrow_to_the_nearest() {
        for code in 0..=255_u8 {
            let wide = u16::from(code) * 257;
            assert_eq!(narrowed(wide), code);
            assert_eq!(
                (narrowed(wide.saturating_add(128)), narrowed(wide.saturating_sub(128))),
                (code, code)
            );
        }
    }

    #[test]
    fn a_size_too_large_is_refused_by_its_header_alone() {
        let mut bytes = encode(&picture(3));
        bytes[16..20].copy_from_slice(&60_000_u32.to_be_bytes());
        bytes[20..24].copy_from_slice(&60_000_u32.to_be_bytes());
        let sum = crc32(&bytes[12..29]).to_be_bytes();
        bytes.splice(29..33, sum);
        assert_eq!(decode(&bytes), Err(ImageError::TooLarge { width: 60_000, height: 60_000 }));
    }

    fn crc32(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(u32::MAX, |crc, byte| {
            (0..8).fold(
                crc ^ u32::from(*byte),
                |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 },
            )
        })
    }

    #[test]
    fn bytes_that_are_no_png_are_one_line_of_error() {
        let whole = encode(&picture(1200));
        let mut broken = whole.clone();
        broken[60] ^= 1;
        for bytes in
            [&[][..], b"GIF89a", &whole[..20], &whole[..whole.len() / 2], &whole[..whole.len() - 6], &broken]
        {
            let error = decode(bytes).unwrap_err();
            assert!(matches!(error, ImageError::Unreadable(_)));
            assert_eq!(error.to_string().lines().count(), 1, "{error}");
        }
    }

    #[test]
    fn a_palette_cut_short_is_refused_and_does_not_panic() {
        let mut bytes = encode(&picture(2));
        assert_eq!((&bytes[37..41], bytes[36]), (&b"PLTE"[..], 6));
        bytes[36] = 5;
        let sum = crc32(&bytes[37..46]).to_be_bytes();
        bytes.splice(46..51, sum);
        assert_eq!(decode(&bytes), Err(ImageError::Unreadable("a palette of 5 bytes".into())));
    }

    #[test]
    fn no_flipped_byte_makes_it_panic() {
        let whole = encode(&picture(5));
        for at in 0..whole.len() {
            for flip in [1, 0x80, 0xff] {
                let mut broken = whole.clone();
                broken[at] ^= flip;
                let _ = decode(&broken);
            }
        }
    }
}
