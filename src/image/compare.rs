//! Whether two files are the same picture, whatever their bytes.

use sha2::{Digest, Sha256};

use super::ImageError;
use super::file::narrowed;
use super::reel::Reel;

/// SHA-256 in lower-case hexadecimal of what a PNG shows, the same for all encodings of the same pixels.
///
/// Hashed are: `snowglobe pixels 1`, width and height (4 bytes each, big endian), bits of a sample (1 byte: 8 or 16),
/// and for each frame as shown its delay (numerator and denominator, 2 bytes each; zeroes for a still) and its RGBA
/// samples, row-major, big endian.
pub fn pixel_digest(bytes: &[u8]) -> Result<String, ImageError> {
    let mut reel = Reel::open(bytes)?;
    let (width, height) = reel.size();
    let deep = reel.is_deep();
    let mut digest = Sha256::new();
    digest.update(b"snowglobe pixels 1");
    digest.update([width, height].map(u32::to_be_bytes).as_flattened());
    digest.update([if deep { 16 } else { 8 }]);
    let mut samples = Vec::new();
    while let Some(frame) = reel.next_frame()? {
        samples.clear();
        let shown = frame.rgba.as_flattened().iter().copied();
        if deep {
            samples.extend(shown.flat_map(u16::to_be_bytes));
        } else {
            samples.extend(shown.map(narrowed));
        }
        digest.update(frame.delay.map(u16::to_be_bytes).as_flattened());
        digest.update(&samples);
    }
    Ok(digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// The largest difference between the samples of two PNGs, over all pixels, all channels (alpha too) and all frames,
/// in steps of 8 bits; `None` when width, height or the number of frames differ.
///
/// 16-bit samples that differ at all differ by at least 1: their difference is rounded up.
pub fn largest_difference(a: &[u8], b: &[u8]) -> Result<Option<u8>, ImageError> {
    let (mut a, mut b) = (Reel::open(a)?, Reel::open(b)?);
    if (a.size(), a.frames()) != (b.size(), b.frames()) {
        return Ok(None);
    }
    let mut largest = 0;
    while let (Some(a), Some(b)) = (a.next_frame()?, b.next_frame()?) {
        let pairs = a.rgba.as_flattened().iter().zip(b.rgba.as_flattened());
        largest = pairs.fold(largest, |largest, (a, b)| largest.max(a.abs_diff(*b)));
    }
    Ok(Some(largest.div_ceil(257) as u8))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{Grey16Alpha, Picture, encode, encode_animation, encode_grey16_alpha};

    fn picture(green: u8) -> Picture {
        let mut picture = Picture::new(8, 8, [10, 20, 30]).unwrap();
        picture.set(3, 4, [10, green, 30]);
        picture
    }

    fn encoded_otherwise(picture: &Picture) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::NoCompression);
        encoder.write_header().unwrap().write_image_data(picture.rgb()).unwrap();
        bytes
    }

    #[test]
    fn the_digest_is_of_the_pixels_not_of_the_file() {
        let (one, other) = (encode(&picture(99)), encoded_otherwise(&picture(99)));
        assert_ne!(one, other);
        assert_eq!(pixel_digest(&one), pixel_digest(&other));
        assert_ne!(pixel_digest(&one), pixel_digest(&encode(&picture(98))));
        assert_eq!(pixel_digest(&one).unwrap().len(), 64);
    }

    #[test]
    fn the_digest_is_as_documented() {
        let mut digest = Sha256::new();
        digest.update(b"snowglobe pixels 1\0\0\0\x01\0\0\0\x02\x08\0\0\0\0\x01\x02\x03\xff\x01\x02\x03\xff");
        let expected: String = digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(pixel_digest(&encode(&Picture::new(1, 2, [1, 2, 3]).unwrap())), Ok(expected));
    }

    #[test]
    fn the_digest_of_an_animation_holds_its_frames_and_delays() {
        let film = |frames: &[Picture], rate| pixel_digest(&encode_animation(frames, rate).unwrap()).unwrap();
        let frames = [picture(1), picture(2), picture(3)];
        let swapped = [picture(1), picture(3), picture(2)];
        assert_ne!(film(&frames, 10), film(&swapped, 10));
        assert_ne!(film(&frames, 10), film(&frames, 11));
        assert_ne!(film(&frames[..1], 10), pixel_digest(&encode(&frames[0])).unwrap());
    }

    #[test]
    fn the_largest_difference_is_found() {
        let difference = |a: &[u8], b: &[u8]| largest_difference(a, b).unwrap();
        assert_eq!(difference(&encode(&picture(99)), &encoded_otherwise(&picture(99))), Some(0));
        assert_eq!(difference(&encode(&picture(20)), &encode(&picture(255))), Some(235));
        assert_eq!(difference(&encode(&picture(20)), &encode(&Picture::new(8, 9, [0; 3]).unwrap())), None);
        let matte = |grey| encode_grey16_alpha(&Grey16Alpha::new(1, 1, vec![grey], vec![0]).unwrap());
        assert_eq!(difference(&matte(500), &matte(501)), Some(1));
        assert_eq!(difference(&matte(0), &matte(65_535)), Some(255));
    }

    #[test]
    fn animations_are_compared_frame_by_frame() {
        let film = |last| encode_animation(&[picture(1), picture(2), picture(last)], 9).unwrap();
        assert_eq!(largest_difference(&film(3), &film(10)), Ok(Some(7)));
        assert_eq!(largest_difference(&film(3), &encode(&picture(1))), Ok(None));
    }
}
