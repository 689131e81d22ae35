//! Reads PNG files frame by frame, each frame as a viewer would show it.

use std::io::Cursor;

use png::{
    BitDepth, BlendOp, ColorType, Decoder, DecodingError, DisposeOp, FrameControl, Info, Limits, Reader,
    Transformations,
};

use super::file::Decoded;
use super::{ImageError, MOST_PIXELS, pixel_count};

/// The most pixels over all frames: what a small file can ask for must not take hours.
const MOST_FILM: u64 = MOST_PIXELS << 6;

/// What the decoder may allocate for itself beside the pixels: a row for each frame, a palette, a colour profile.
const WORKSPACE: usize = 64 << 20;

/// How an animation begins.
const CLEAR: [u16; 4] = [0; 4];

/// A PNG being read. Samples have 16 bits; those of 8 bits are kept times 257, which is exact.
pub(crate) struct Reel<'a> {
    reader: Reader<Cursor<&'a [u8]>>,
    width: u32,
    height: u32,
    frames: u32,
    shown: u32,
    canvas: Vec<[u16; 4]>,
    // A subframe as the decoder hands it over.
    raw: Vec<u8>,
    // What the last frame wants done before the next.
    mend: Option<Mend>,
}

/// One frame, as a viewer shows it.
pub(crate) struct Frame<'a> {
    /// The whole picture, row-major.
    pub(crate) rgba: &'a [[u16; 4]],
    /// How long it is shown, as a fraction of a second; 0 / 0 for a still.
    pub(crate) delay: [u16; 2],
}

/// A rectangle of the canvas.
#[derive(Clone, Copy)]
struct Area {
    x: usize,
    y: usize,
    width: usize,
    height: usize,
}

/// A rectangle and what to put there.
struct Mend {
    area: Area,
    pixels: Vec<[u16; 4]>,
}

impl<'a> Reel<'a> {
    /// Reads up to the first pixel; the size is checked before anything is allocated for it.
    pub(crate) fn open(bytes: &'a [u8]) -> Result<Self, ImageError> {
        let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: WORKSPACE });
        decoder.set_transformations(Transformations::EXPAND);
        decoder.set_ignore_text_chunk(true);
        decoder.set_ignore_iccp_chunk(true);
        let (width, height) = decoder.read_header_info().map_err(unreadable)?.size();
        let pixels = pixel_count(width, height)?;
        let reader = decoder.read_info().map_err(unreadable)?;
        check_palette(reader.info())?;
        let frames = reader.info().animation_control.map_or(1, |control| control.num_frames);
        if u64::from(frames) * pixels as u64 > MOST_FILM {
            return Err(ImageError::TooLong { frames, width, height });
        }
        if reader.info().animation_control.is_some() && reader.info().interlaced {
            return Err(ImageError::Unreadable("an interlaced animation is not handled".into()));
        }
        let room = reader.output_buffer_size().ok_or_else(|| unreadable(DecodingError::LimitsExceeded))?;
        let (canvas, raw) = (vec![CLEAR; pixels], vec![0; room]);
        Ok(Self { reader, width, height, frames, shown: 0, canvas, raw, mend: None })
    }

    /// Width and height in pixels.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// How many frames [`next_frame`](Reel::next_frame) gives if the file is whole.
    pub(crate) fn frames(&self) -> u32 {
        self.frames
    }

    /// Whether samples have 16 bits in the file; otherwise all are multiples of 257.
    pub(crate) fn is_deep(&self) -> bool {
        self.reader.output_color_type().1 == BitDepth::Sixteen
    }

    /// The still picture, or the one that a viewer shows which knows no animation.
    pub(crate) fn into_first_picture(mut self) -> Result<Decoded<u16>, ImageError> {
        self.expose(self.everything(), BlendOp::Source)?;
        self.reader.finish().map_err(unreadable)?;
        Ok(Decoded { width: self.width, height: self.height, rgba: self.canvas })
    }

    /// The next frame, or nothing after the last; the file must be whole to its end.
    pub(crate) fn next_frame(&mut self) -> Result<Option<Frame<'_>>, ImageError> {
        if self.shown == self.frames {
            self.reader.finish().map_err(unreadable)?;
            return Ok(None);
        }
        let control = self.next_control()?;
        let delay = match control {
            Some(control) => self.show(&control)?,
            None => self.expose(self.everything(), BlendOp::Source).map(|()| [0, 0])?,
        };
        self.shown += 1;
        Ok(Some(Frame { rgba: &self.canvas, delay }))
    }

    /// What the file says about the next frame; nothing about a still.
    fn next_control(&mut self) -> Result<Option<FrameControl>, ImageError> {
        let info = self.reader.info();
        if info.animation_control.is_none() {
            return Ok(None);
        }
        // The picture that comes first in the file is a frame only if a frame control stands before it.
        if self.shown == 0 && info.frame_control.is_some() {
            return Ok(info.frame_control);
        }
        self.reader.next_frame_info().map(|control| Some(*control)).map_err(unreadable)
    }

    /// Brings the canvas to one frame of an animation, and gives its delay.
    fn show(&mut self, control: &FrameControl) -> Result<[u16; 2], ImageError> {
        if let Some(Mend { area, pixels }) = self.mend.take() {
            self.put(area, pixels.into_iter());
        }
        let area = Area {
            x: control.x_offset as usize,
            y: control.y_offset as usize,
            width: control.width as usize,
            height: control.height as usize,
        };
        let under = match control.dispose_op {
            DisposeOp::None => None,
            DisposeOp::Background => Some(vec![CLEAR; area.width * area.height]),
            DisposeOp::Previous => Some(self.copy_of(area)),
        };
        self.mend = under.map(|pixels| Mend { area, pixels });
        self.expose(area, control.blend_op)?;
        Ok([control.delay_num, control.delay_den])
    }

    /// Decodes the subframe that comes next onto its area of the canvas.
    fn expose(&mut self, area: Area, blend: BlendOp) -> Result<(), ImageError> {
        let info = self.reader.next_frame(&mut self.raw).map_err(unreadable)?;
        let deep = info.bit_depth == BitDepth::Sixteen;
        let stride = info.color_type.samples() * if deep { 2 } else { 1 };
        let raw = std::mem::take(&mut self.raw);
        let fresh = raw.chunks_exact(stride).map(|bytes| rgba(bytes, info.color_type, deep));
        match blend {
            BlendOp::Source => self.put(area, fresh),
            BlendOp::Over => {
                let under = self.copy_of(area);
                let unit = if deep { 1 } else { 257 };
                self.put(area, fresh.zip(under).map(|(fresh, under)| over(fresh, under, unit)));
            }
        }
        self.raw = raw;
        Ok(())
    }

    fn everything(&self) -> Area {
        Area { x: 0, y: 0, width: self.width as usize, height: self.height as usize }
    }

    fn put(&mut self, area: Area, mut pixels: impl Iterator<Item = [u16; 4]>) {
        for row in self.canvas.chunks_exact_mut(self.width as usize).skip(area.y).take(area.height) {
            for (pixel, fresh) in row[area.x..][..area.width].iter_mut().zip(pixels.by_ref()) {
                *pixel = fresh;
            }
        }
    }

    fn copy_of(&self, area: Area) -> Vec<[u16; 4]> {
        let rows = self.canvas.chunks_exact(self.width as usize).skip(area.y).take(area.height);
        rows.flat_map(|row| &row[area.x..][..area.width]).copied().collect()
    }
}

/// The decoder takes whole palettes for granted, and would panic.
fn check_palette(info: &Info<'_>) -> Result<(), ImageError> {
    match &info.palette {
        Some(palette) if palette.is_empty() || palette.len() % 3 != 0 || palette.len() > 3 * 256 => {
            Err(ImageError::Unreadable(format!("a palette of {} bytes", palette.len())))
        }
        _ => Ok(()),
    }
}

/// One pixel, opaque unless the file says otherwise.
fn rgba(bytes: &[u8], colour: ColorType, deep: bool) -> [u16; 4] {
    let sample = |channel: usize| match deep {
        true => u16::from_be_bytes([bytes[2 * channel], bytes[2 * channel + 1]]),
        false => u16::from(bytes[channel]) * 257,
    };
    match colour {
        ColorType::Grayscale | ColorType::Indexed => [sample(0), sample(0), sample(0), u16::MAX],
        ColorType::GrayscaleAlpha => [sample(0), sample(0), sample(0), sample(1)],
        ColorType::Rgb => [sample(0), sample(1), sample(2), u16::MAX],
        ColorType::Rgba => [sample(0), sample(1), sample(2), sample(3)],
    }
}

/// One pixel over another, rounded to a multiple of `unit`.
fn over(fresh: [u16; 4], under: [u16; 4], unit: u64) -> [u16; 4] {
    const FULL: u64 = u16::MAX as u64;
    // Shares of the two in the result, and their sum, all times FULL.
    let first = u64::from(fresh[3]) * FULL;
    let second = u64::from(under[3]) * (FULL - u64::from(fresh[3]));
    let both = first + second;
    if both == 0 {
        return CLEAR;
    }
    let rounded = |value: u64, part: u64| ((2 * value + part * unit) / (2 * part * unit) * unit) as u16;
    let mix = |c: usize| rounded(u64::from(fresh[c]) * first + u64::from(under[c]) * second, both);
    [mix(0), mix(1), mix(2), rounded(both, FULL)]
}

/// The decoder's complaint, on one line.
fn unreadable(error: DecodingError) -> ImageError {
    let words = error.to_string();
    ImageError::Unreadable(words.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A 2 x 1 animation of three frames of one channel; each begins at `x` and is disposed of and blended as told.
    fn film(default_apart: bool, frames: &[(u32, &[u8], DisposeOp, BlendOp)]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(ColorType::GrayscaleAlpha);
        encoder.set_animated(frames.len() as u32, 0).unwrap();
        encoder.set_sep_def_img(default_apart).unwrap();
        let mut writer = encoder.write_header().unwrap();
        if default_apart {
            writer.write_image_data(&[77; 4]).unwrap();
        }
        for (x, data, dispose, blend) in frames {
            writer.reset_frame_position().unwrap();
            writer.set_frame_dimension(data.len() as u32 / 2, 1).unwrap();
            writer.set_frame_position(*x, 0).unwrap();
            writer.set_dispose_op(*dispose).unwrap();
            writer.set_blend_op(*blend).unwrap();
            writer.write_image_data(data).unwrap();
        }
        writer.finish().unwrap();
        bytes
    }

    fn shown(bytes: &[u8]) -> Vec<Vec<[u16; 2]>> {
        let mut reel = Reel::open(bytes).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = reel.next_frame().unwrap() {
            frames.push(frame.rgba.iter().map(|p| [p[0] / 257, p[3] / 257]).collect());
        }
        frames
    }

    #[test]
    fn frames_are_blended_and_disposed_of_as_the_format_says() {
        use {BlendOp::*, DisposeOp::*};
        let bytes = film(
            false,
            &[
                (0, &[100, 255, 50, 255], None, Source),
                (0, &[9, 255], Previous, Source),
                (1, &[200, 51], Background, Over),
                (0, &[0, 0], None, Over),
                (0, &[0, 0], None, Source),
            ],
        );
        let expected = [
            [[100, 255], [50, 255]],
            [[9, 255], [50, 255]],
            [[100, 255], [80, 255]], // 200 over 50 at one fifth
            [[100, 255], [0, 0]],
            [[0, 0], [0, 0]],
        ];
        assert_eq!(shown(&bytes), expected);
    }

    #[test]
    fn a_default_picture_that_is_no_frame_is_passed_over() {
        use {BlendOp::*, DisposeOp::*};
        let bytes = film(true, &[(0, &[1, 255, 2, 255], None, Source), (1, &[3, 255], None, Source)]);
        assert_eq!(shown(&bytes), [[[1, 255], [2, 255]], [[1, 255], [3, 255]]]);
        let first = Reel::open(&bytes).unwrap().into_first_picture().unwrap();
        assert_eq!(first.rgba, [[77 * 257; 4]; 2]);
    }

    #[test]
    fn a_short_film_is_an_error() {
        use {BlendOp::*, DisposeOp::*};
        let bytes = film(false, &[(0, &[1, 255, 2, 255], None, Source), (1, &[3, 255], None, Source)]);
        for kept in 0..bytes.len() {
            let read = Reel::open(&bytes[..kept]).and_then(|mut reel| {
                while reel.next_frame()?.is_some() {}
                Ok(())
            });
            assert!(matches!(read, Err(ImageError::Unreadable(_))), "{kept} bytes of {}", bytes.len());
        }
    }

    #[test]
    fn half_clear_over_half_clear() {
        let half = u16::MAX / 2 + 1;
        let [value, .., alpha] = over([60_000, 0, 0, half], [30_000, 0, 0, half], 1);
        assert!(value.abs_diff(50_000) <= 1 && alpha.abs_diff(49_152) <= 1);
        assert_eq!(over([1, 2, 3, 0], [4, 5, 6, 0], 1), CLEAR);
    }
}
