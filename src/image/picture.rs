//! Finished pictures: 8-bit colour, and 16-bit grey with alpha for mattes.

use super::{ImageError, Kind, check_samples, pixel_count};

/// A finished 8-bit sRGB picture; rows from the top, pixels from the left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    height: u32,
    rgb: Vec<u8>,
    kind: Kind,
}

impl Picture {
    /// A drawing of one colour; refused when a side is zero or the pixels are too many.
    pub fn new(width: u32, height: u32, fill: [u8; 3]) -> Result<Self, ImageError> {
        let rgb = fill.repeat(pixel_count(width, height)?);
        Ok(Self { width, height, rgb, kind: Kind::Drawing })
    }

    /// A drawing of these samples (`width * height * 3`, row-major); refused when they are more or fewer.
    pub fn from_rgb(width: u32, height: u32, rgb: Vec<u8>) -> Result<Self, ImageError> {
        check_samples(width, height, 3, rgb.len())?;
        Ok(Self { width, height, rgb, kind: Kind::Drawing })
    }

    /// A picture of a size already checked, each row painted by `paint(y, row)`, rows in parallel.
    pub(crate) fn painted(
        width: u32,
        height: u32,
        kind: Kind,
        paint: impl Fn(usize, &mut [[u8; 3]]) + Sync,
    ) -> Self {
        use rayon::prelude::*;
        let mut rgb = vec![0; width as usize * height as usize * 3];
        rgb.as_chunks_mut().0.par_chunks_mut(width as usize).enumerate().for_each(|(y, row)| paint(y, row));
        Self { width, height, rgb, kind }
    }

    /// The same pixels, judged as another kind.
    pub fn with_kind(self, kind: Kind) -> Self {
        Self { kind, ..self }
    }

    /// Width in pixels, at least one.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels, at least one.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// By which standard it is judged.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// All samples, `width * height * 3`.
    pub fn rgb(&self) -> &[u8] {
        &self.rgb
    }

    /// All pixels, `width * height`.
    pub fn pixels(&self) -> &[[u8; 3]] {
        self.rgb.as_chunks().0
    }

    /// One row of pixels; `y` is below the height.
    pub(crate) fn row(&self, y: usize) -> &[[u8; 3]] {
        &self.pixels()[y * self.width as usize..][..self.width as usize]
    }

    /// The colour at column `x` of row `y`, if that is in the picture.
    pub fn get(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        self.index(x, y).map(|at| self.pixels()[at])
    }

    /// Colours a pixel; outside the picture nothing happens.
    pub fn set(&mut self, x: u32, y: u32, colour: [u8; 3]) {
        if let Some(at) = self.index(x, y) {
            self.rgb[3 * at..3 * at + 3].copy_from_slice(&colour);
        }
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width && y < self.height).then(|| y as usize * self.width as usize + x as usize)
    }

    /// Copies another picture over this one, its top left corner at (`x`, `y`); what sticks out is cut off.
    pub fn paste(&mut self, other: &Picture, x: i32, y: i32) {
        let Some((to_x, from_x, columns)) = overlap(self.width, other.width, x) else { return };
        let Some((to_y, from_y, rows)) = overlap(self.height, other.height, y) else { return };
        for row in 0..rows {
            let to = 3 * ((to_y + row) * self.width as usize + to_x);
            let from = &other.row(from_y + row)[from_x..from_x + columns];
            self.rgb[to..to + 3 * columns].copy_from_slice(from.as_flattened());
        }
    }

    /// Pictures in a row, `gap` pixels between them and around them, on a ground of one colour.
    pub fn side_by_side(pictures: &[&Picture], gap: u32, ground: [u8; 3]) -> Result<Self, ImageError> {
        Self::grid(pictures, pictures.len(), gap, ground)
    }

    /// Pictures in rows of `columns` (at least 1 is taken), `gap` pixels between them and around them, on a ground of
    /// one colour. Every place is as large as the largest picture, and each picture is in the middle of its place.
    pub fn grid(
        pictures: &[&Picture],
        columns: usize,
        gap: u32,
        ground: [u8; 3],
    ) -> Result<Self, ImageError> {
        let columns = columns.clamp(1, pictures.len().max(1));
        let (Some(wide), Some(high)) =
            (pictures.iter().map(|p| p.width).max(), pictures.iter().map(|p| p.height).max())
        else {
            return Err(ImageError::NoPictures);
        };
        let mut sheet = Picture::new(
            sheet_side(columns, wide, gap),
            sheet_side(pictures.len().div_ceil(columns), high, gap),
            ground,
        )?;
        for (place, picture) in pictures.iter().enumerate() {
            let x = sheet_side(place % columns, wide, gap) + (wide - picture.width) / 2;
            let y = sheet_side(place / columns, high, gap) + (high - picture.height) / 2;
            sheet.paste(picture, x as i32, y as i32);
        }
        Ok(sheet)
    }
}

/// Length of `count` places of `side` pixels with gaps between and around: also where the next place begins.
fn sheet_side(count: usize, side: u32, gap: u32) -> u32 {
    let (side, gap) = (u64::from(side), u64::from(gap));
    u32::try_from((count as u64).saturating_mul(side + gap).saturating_add(gap)).unwrap_or(u32::MAX)
}

/// Where a span of `length` laid at `offset` meets `0..room`: start there, start in the span, and how many.
fn overlap(room: u32, length: u32, offset: i32) -> Option<(usize, usize, usize)> {
    let (room, length, offset) = (i64::from(room), i64::from(length), i64::from(offset));
    let (start, end) = (offset.max(0), (offset + length).min(room));
    (start < end).then(|| (start as usize, (start - offset) as usize, (end - start) as usize))
}

/// A 16-bit grey picture with a 16-bit alpha channel that does not multiply it: a matte.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grey16Alpha {
    width: u32,
    height: u32,
    grey: Vec<u16>,
    alpha: Vec<u16>,
}

impl Grey16Alpha {
    /// A matte of these samples, `width * height` each, row-major; refused when they are more or fewer.
    pub fn new(width: u32, height: u32, grey: Vec<u16>, alpha: Vec<u16>) -> Result<Self, ImageError> {
        check_samples(width, height, 1, grey.len())?;
        check_samples(width, height, 1, alpha.len())?;
        Ok(Self { width, height, grey, alpha })
    }

    /// Width in pixels, at least one.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels, at least one.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Grey of every pixel, 0 to 65535.
    pub fn grey(&self) -> &[u16] {
        &self.grey
    }

    /// Alpha of every pixel, 0 (clear) to 65535 (opaque).
    pub fn alpha(&self) -> &[u16] {
        &self.alpha
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: [u8; 3] = [255, 0, 0];
    const BLUE: [u8; 3] = [0, 0, 255];

    #[test]
    fn outside_the_picture_nothing_is_read_or_written() {
        let mut picture = Picture::new(3, 2, RED).unwrap();
        picture.set(3, 0, BLUE);
        picture.set(0, 2, BLUE);
        assert_eq!(picture, Picture::new(3, 2, RED).unwrap());
        assert_eq!(picture.get(3, 0), None);
        picture.set(2, 1, BLUE);
        assert_eq!(picture.get(2, 1), Some(BLUE));
    }

    #[test]
    fn what_sticks_out_of_a_paste_is_cut_off() {
        let stamp = Picture::new(4, 4, BLUE).unwrap();
        for (x, y, blue) in
            [(-2, -3, 2), (3, 1, 8), (4, 4, 1), (5, 0, 0), (-4, 0, 0), (i32::MIN, i32::MAX, 0)]
        {
            let mut picture = Picture::new(5, 5, RED).unwrap();
            picture.paste(&stamp, x, y);
            assert_eq!(picture.pixels().iter().filter(|p| **p == BLUE).count(), blue, "at {x}, {y}");
        }
        let mut picture = Picture::new(5, 5, RED).unwrap();
        picture.paste(&stamp, 3, 1);
        assert_eq!(
            (picture.get(3, 1), picture.get(2, 1), picture.get(3, 0)),
            (Some(BLUE), Some(RED), Some(RED))
        );
    }

    #[test]
    fn a_grid_has_gaps_between_and_around() {
        let (one, two) = (Picture::new(2, 2, RED).unwrap(), Picture::new(4, 2, BLUE).unwrap());
        let sheet = Picture::grid(&[&one, &two, &one], 2, 1, [9; 3]).unwrap();
        assert_eq!((sheet.width(), sheet.height()), (11, 7));
        assert_eq!(sheet.get(2, 1), Some(RED)); // in the middle of a place 4 wide
        assert_eq!(sheet.get(1, 1), Some([9; 3]));
        assert_eq!(sheet.get(6, 1), Some(BLUE));
        assert_eq!(sheet.get(2, 4), Some(RED));
        assert_eq!(sheet.pixels().iter().filter(|p| **p == RED).count(), 8);
        assert_eq!(Picture::grid(&[], 2, 1, RED), Err(ImageError::NoPictures));
        assert!(matches!(Picture::side_by_side(&[&one], u32::MAX, RED), Err(ImageError::TooLarge { .. })));
    }

    #[test]
    fn samples_must_fit_the_size() {
        assert_eq!(
            Picture::from_rgb(2, 2, vec![0; 11]),
            Err(ImageError::Samples { expected: 12, found: 11 })
        );
        assert!(Grey16Alpha::new(2, 2, vec![0; 4], vec![0; 3]).is_err());
    }
}
