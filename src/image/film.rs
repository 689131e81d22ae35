//! Animated PNG: every frame stores only the rectangle in which it differs from the one before.

use png::BlendOp;

use super::file::Paint;
use super::{ImageError, Picture};

/// How long the last frame is shown, in seconds, as a fraction.
const LAST_DELAY: [u16; 2] = [3, 2];

/// An animated PNG that repeats for ever, `frames_per_second` frames a second, the last held for 1.5 s; with one palette
/// for all frames when they have at most 256 colours together.
///
/// Refused are no frames, frames of different sizes, and a rate of zero.
pub fn encode_animation(frames: &[Picture], frames_per_second: u16) -> Result<Vec<u8>, ImageError> {
    let first = frames.first().ok_or(ImageError::NoPictures)?;
    if frames_per_second == 0 {
        return Err(ImageError::FrameRate);
    }
    let size = |picture: &Picture| (picture.width(), picture.height());
    if let Some(frame) = frames.iter().position(|frame| size(frame) != size(first)) {
        let (width, height) = size(&frames[frame]);
        return Err(ImageError::FrameSize { frame, width, height });
    }
    let mut bytes = Vec::new();
    write(&mut bytes, first, frames, frames_per_second)
        .expect("frames lie in the picture and have their samples, and memory takes every byte");
    Ok(bytes)
}

fn write(
    bytes: &mut Vec<u8>,
    first: &Picture,
    frames: &[Picture],
    rate: u16,
) -> Result<(), png::EncodingError> {
    let paint = Paint::of(frames.iter().map(Picture::pixels));
    let mut encoder = paint.encoder(bytes, first.width(), first.height());
    encoder.set_animated(frames.len() as u32, 0)?;
    encoder.set_blend_op(BlendOp::Source)?;
    let mut writer = encoder.write_header()?;
    for (at, frame) in frames.iter().enumerate() {
        let area = match at {
            0 => Rectangle { left: 0, top: 0, right: first.width(), bottom: first.height() },
            _ => Rectangle::of_change(&frames[at - 1], frame),
        };
        let [numerator, denominator] = if at + 1 == frames.len() { LAST_DELAY } else { [1, rate] };
        writer.set_frame_delay(numerator, denominator)?;
        writer.reset_frame_position()?; // or else the next size would be checked at the old position
        writer.set_frame_dimension(area.right - area.left, area.bottom - area.top)?;
        writer.set_frame_position(area.left, area.top)?;
        writer.write_image_data(&paint.samples(&area.cut(frame)))?;
    }
    writer.finish()
}

/// Columns `left..right` of rows `top..bottom`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rectangle {
    left: u32,
    top: u32,
    right: u32,
    bottom: u32,
}

impl Rectangle {
    /// The smallest rectangle in which two pictures of one size differ; one pixel when they do not, as a frame cannot
    /// be empty.
    fn of_change(before: &Picture, after: &Picture) -> Self {
        let mut changed: Option<Self> = None;
        for y in 0..after.height() {
            let (old, new) = (before.row(y as usize), after.row(y as usize));
            let differs = |x: &usize| old[*x] != new[*x];
            let (Some(first), Some(last)) = ((0..new.len()).find(differs), (0..new.len()).rfind(differs))
            else {
                continue;
            };
            let row = Self { left: first as u32, top: y, right: last as u32 + 1, bottom: y + 1 };
            changed = Some(changed.map_or(row, |area| area.joined(row)));
        }
        changed.unwrap_or(Self { left: 0, top: 0, right: 1, bottom: 1 })
    }

    fn joined(self, other: Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }

    fn cut(self, picture: &Picture) -> Vec<[u8; 3]> {
        let rows = self.top as usize..self.bottom as usize;
        rows.flat_map(|y| &picture.row(y)[self.left as usize..self.right as usize]).copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::decode;
    use crate::image::reel::Reel;

    /// A dot that moves over a ground of `shades` colours.
    fn frames(count: u32, shades: u32) -> Vec<Picture> {
        let ground = (0..64 * 48).flat_map(|i| [0, ((i % shades) >> 8) as u8, (i % shades) as u8]).collect();
        let ground = Picture::from_rgb(64, 48, ground).unwrap();
        let dotted = |i| {
            let mut frame = ground.clone();
            frame.set(3 + i, 5 + i, [200, 10, 10]);
            frame
        };
        (0..count).map(dotted).collect()
    }

    #[test]
    fn every_frame_is_shown_as_it_was_given() {
        for shades in [3, 1000] {
            let mut frames = frames(6, shades);
            frames.insert(3, frames[3].clone()); // nothing changes
            let bytes = encode_animation(&frames, 25).unwrap();
            let mut reel = Reel::open(&bytes).unwrap();
            for (at, frame) in frames.iter().enumerate() {
                let shown = reel.next_frame().unwrap().unwrap();
                let codes: Vec<_> =
                    shown.rgba.iter().map(|p| [p[0], p[1], p[2]].map(|c| (c / 257) as u8)).collect();
                assert_eq!(codes, frame.pixels(), "frame {at} of {shades} shades");
                assert_eq!(shown.delay, if at == 6 { [3, 2] } else { [1, 25] });
            }
            assert!(reel.next_frame().unwrap().is_none());
        }
    }

    #[test]
    fn only_the_change_is_stored() {
        let one = encode_animation(&frames(1, 1000), 25).unwrap().len();
        let fifty = encode_animation(&frames(40, 1000), 25).unwrap().len();
        assert!((fifty - one) / 39 < 150, "{} bytes a frame", (fifty - one) / 39);
        let frames = frames(3, 9);
        let change = Rectangle::of_change(&frames[1], &frames[2]);
        assert_eq!(change, Rectangle { left: 4, top: 6, right: 6, bottom: 8 });
    }

    #[test]
    fn a_viewer_without_animation_shows_the_first_frame() {
        let frames = frames(4, 9);
        let still = decode(&encode_animation(&frames, 25).unwrap()).unwrap();
        assert!(still.rgba.iter().zip(frames[0].pixels()).all(|(shown, given)| shown[..3] == given[..]));
    }

    #[test]
    fn what_is_no_animation_is_refused() {
        assert_eq!(encode_animation(&[], 25), Err(ImageError::NoPictures));
        assert_eq!(encode_animation(&frames(2, 9), 0), Err(ImageError::FrameRate));
        let mut uneven = frames(2, 9);
        uneven.push(Picture::new(64, 47, [0; 3]).unwrap());
        assert_eq!(
            encode_animation(&uneven, 25),
            Err(ImageError::FrameSize { frame: 2, width: 64, height: 47 })
        );
    }
}
