//! Words, in DejaVu Sans.
//!
//! Glyphs are anti-aliased by their exact coverage and blended between the sRGB codes, where half a coverage looks half
//! way: between amounts of light, dark words on a light ground would look thin.

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, GlyphId, Point, ScaleFont, point};

use super::Picture;

/// The smallest and largest sizes that are drawn, in pixels; others are taken as the nearer of the two.
pub const SIZES: [f64; 2] = [1.0, 1024.0];

/// Weight of the letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// DejaVu Sans.
    Regular,
    /// DejaVu Sans Bold.
    Bold,
}

impl Face {
    fn font(self) -> &'static FontRef<'static> {
        static REGULAR: LazyLock<FontRef<'static>> = LazyLock::new(|| parsed(dejavu::sans::regular()));
        static BOLD: LazyLock<FontRef<'static>> = LazyLock::new(|| parsed(dejavu::sans::bold()));
        match self {
            Face::Regular => &REGULAR,
            Face::Bold => &BOLD,
        }
    }
}

fn parsed(bytes: &'static [u8]) -> FontRef<'static> {
    FontRef::try_from_slice(bytes).expect("the font is part of this program")
}

/// Writes one line of text, the left end of its baseline at (`x`, `y`) pixels; y runs down. Its em is `size` pixels high.
///
/// What lies outside the picture is cut off. A character that the font lacks, a line break too, becomes a box.
pub fn draw_text(picture: &mut Picture, x: f64, y: f64, size: f64, colour: [u8; 3], text: &str, face: Face) {
    let font = face.font();
    let scaled = font.as_scaled(scale(font, size));
    set(&scaled, text, |glyph, offset| {
        let at = point(x as f32 + offset, y as f32);
        if !near(picture, at, 4.0 * scaled.scale().y) {
            return;
        }
        let glyph = glyph.with_scale_and_position(scaled.scale(), at);
        if let Some(outlined) = font.outline_glyph(glyph) {
            let corner = outlined.px_bounds().min;
            outlined.draw(|column, row, coverage| {
                blend(
                    picture,
                    corner.x as i64 + i64::from(column),
                    corner.y as i64 + i64::from(row),
                    colour,
                    coverage,
                );
            });
        }
    });
}

/// How far the pen moves over one line of text, in pixels.
pub fn text_width(size: f64, text: &str, face: Face) -> f64 {
    let font = face.font();
    f64::from(set(&font.as_scaled(scale(font, size)), text, |_, _| ()))
}

/// The font's own measure of a size: from its highest ascent to its lowest descent, not its em.
fn scale(font: &FontRef<'_>, size: f64) -> f32 {
    let size = if size.is_nan() { SIZES[0] } else { size.clamp(SIZES[0], SIZES[1]) } as f32;
    size * font.height_unscaled() / font.units_per_em().unwrap_or(1.0)
}

/// Goes over the glyphs of a line, each with its offset from the start, and gives the offset of the end.
fn set<F: Font>(font: &impl ScaleFont<F>, text: &str, mut place: impl FnMut(GlyphId, f32)) -> f32 {
    let (mut pen, mut last) = (0.0, None);
    for character in text.chars() {
        let glyph = font.glyph_id(character);
        pen += last.map_or(0.0, |last| font.kern(last, glyph));
        place(glyph, pen);
        pen += font.h_advance(glyph);
        last = Some(glyph);
    }
    pen
}

/// Whether a glyph here might touch the picture; never for a place that is not a number.
fn near(picture: &Picture, at: Point, reach: f32) -> bool {
    let within = |place: f32, side: u32| place > -reach && place < side as f32 + reach;
    within(at.x, picture.width()) && within(at.y, picture.height())
}

fn blend(picture: &mut Picture, x: i64, y: i64, colour: [u8; 3], coverage: f32) {
    let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
    if let Some(under) = picture.get(x, y) {
        let share = f64::from(coverage.clamp(0.0, 1.0));
        let mix = |c: usize| f64::from(under[c]) + share * (f64::from(colour[c]) - f64::from(under[c]));
        picture.set(x, y, std::array::from_fn(|channel| libm::floor(mix(channel) + 0.5) as u8));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INK: [u8; 3] = [0; 3];

    fn paper() -> Picture {
        Picture::new(120, 40, [255; 3]).unwrap()
    }

    fn ink(picture: &Picture) -> f64 {
        picture.pixels().iter().map(|p| 1.0 - f64::from(p[0]) / 255.0).sum()
    }

    /// First and last row, first and last column with ink.
    fn extent(picture: &Picture) -> [usize; 4] {
        let inked = |at: &usize| picture.pixels()[*at] != [255; 3];
        let all: Vec<usize> = (0..picture.pixels().len()).filter(inked).collect();
        let columns = all.iter().map(|at| at % 120);
        [all[0] / 120, all[all.len() - 1] / 120, columns.clone().min().unwrap(), columns.max().unwrap()]
    }

    #[test]
    fn letters_stand_on_the_baseline_at_their_size() {
        let mut picture = paper();
        draw_text(&mut picture, 10.0, 30.0, 20.0, INK, "H", Face::Regular);
        let [top, bottom, left, right] = extent(&picture);
        assert_eq!((top, bottom), (15, 29)); // a capital is 0.729 em high
        assert!(left >= 10 && (right as f64) < 10.0 + text_width(20.0, "H", Face::Regular));
    }

    #[test]
    fn width_grows_with_the_text_the_size_and_the_weight() {
        let width = |size, text, face| text_width(size, text, face);
        assert_eq!(width(20.0, "", Face::Regular), 0.0);
        assert!((width(40.0, "snow", Face::Regular) - 2.0 * width(20.0, "snow", Face::Regular)).abs() < 1e-3);
        assert!(width(20.0, "snow", Face::Bold) > width(20.0, "snow", Face::Regular));
        assert!((width(1000.0, "0", Face::Regular) - 636.2).abs() < 0.1); // the font's own figure: 1303 / 2048
    }

    #[test]
    fn pairs_are_kerned() {
        let [pair, a, v] = ["AV", "A", "V"].map(|text| text_width(100.0, text, Face::Regular));
        assert!(pair < a + v - 1.0);
    }

    #[test]
    fn edges_are_soft_and_bold_is_heavier() {
        let [mut regular, mut bold] = [paper(), paper()];
        draw_text(&mut regular, 5.0, 30.0, 24.0, INK, "Frost", Face::Regular);
        draw_text(&mut bold, 5.0, 30.0, 24.0, INK, "Frost", Face::Bold);
        assert!(regular.pixels().iter().any(|p| (60..200).contains(&p[0])));
        assert!(regular.pixels().contains(&INK));
        assert!(ink(&bold) > 1.2 * ink(&regular));
    }

    #[test]
    fn what_lies_outside_is_cut_off() {
        let mut picture = paper();
        draw_text(&mut picture, -8.0, 10.0, 24.0, INK, "Snow and frost, snow and frost", Face::Regular);
        let [top, _, left, right] = extent(&picture);
        assert_eq!((top, left, right), (0, 0, 119));
        for (x, y) in [(1e9, 0.0), (-1e30, 5.0), (f64::NAN, 5.0), (5.0, f64::INFINITY), (500.0, -500.0)] {
            let mut picture = paper();
            draw_text(&mut picture, x, y, 24.0, INK, "snow", Face::Regular);
            assert_eq!(picture, paper());
        }
    }

    #[test]
    fn no_string_and_no_size_is_too_much() {
        let mut picture = paper();
        draw_text(&mut picture, 5.0, 30.0, 20.0, INK, "\u{10FFFF}", Face::Regular);
        assert!(ink(&picture) > 5.0, "a box stands for what the font lacks");
        for size in [f64::NAN, f64::INFINITY, -3.0, 0.0, 1e300] {
            draw_text(&mut picture, 5.0, 30.0, size, INK, "a\n\t\0\u{202e}é雪❄\u{fe0f}👩‍🚀", Face::Bold);
            assert!(text_width(size, "雪", Face::Bold).is_finite());
        }
    }
}
