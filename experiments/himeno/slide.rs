//! A crystal on a slide: its light, a bar, and what it was grown in.

use snowglobe::image::{Face, ImageError, Picture, draw_text, srgb_encode};
use snowglobe::lab::{Error, Result};
use snowglobe::snow::{Crystal, INDEX, Light, Relief, View};

/// Empty around the crystal: the picture is so many times as wide.
const ROOM: f64 = 1.16;
/// Half-angle of the light's aperture, degrees: ridges of crystals are then as dark as in photographs of the time.
pub const APERTURE: f64 = 14.0;
/// Pale as the glass of a slide.
const GROUND: [f64; 3] = [0.80, 0.86, 0.93];
/// What is written on it.
pub const INK: [u8; 3] = [38, 50, 66];

/// Platelike crystals are seen along the c axis, columns across it; and how long they are that way, m.
pub fn view_of(crystal: &Crystal) -> (View, f64) {
    let [across, high] = [crystal.diameter(), crystal.height()];
    if across >= high && !crystal.is_capped() {
        (View::Above, across)
    } else {
        (View::Side, across.max(high))
    }
}

/// How wide a picture is that has room for a crystal so long, m, and for what smoothing adds to the smallest.
pub fn room(crystal: &Crystal, long: f64) -> f64 {
    (ROOM * long).max(long + 4.0 * crystal.element())
}

/// The colour of the slide where nothing lies on it.
pub fn ground() -> [u8; 3] {
    GROUND.map(|light| (255.0 * srgb_encode(light)).round() as u8)
}

/// Slides in bright field in rows.
pub fn sheet(slides: &[Picture], columns: usize) -> Result<Picture> {
    monochrome(&coloured_sheet(slides, columns)?)
}

/// A picture in bright field in half as many shades as a byte has: it is pale or dark and nothing else, and a palette holds it.
pub fn monochrome(picture: &Picture) -> Result<Picture> {
    let ground = GROUND.map(srgb_encode);
    let shade = |green: u8| {
        let share = f64::from(green & !1) / (255.0 * ground[1]);
        ground.map(|light| (255.0 * share * light).round().min(255.0) as u8)
    };
    let pixels = picture.pixels().iter().flat_map(|pixel| shade(pixel[1])).collect();
    Picture::from_rgb(picture.width(), picture.height(), pixels)
        .map_err(|cause: ImageError| Error::broken(cause.to_string()))
}

/// Slides in rows, in all their colours.
pub fn coloured_sheet(slides: &[Picture], columns: usize) -> Result<Picture> {
    Picture::grid(&slides.iter().collect::<Vec<_>>(), columns, 6, INK)
        .map_err(|cause: ImageError| Error::broken(cause.to_string()))
}

/// A crystal on a square slide of so many pixels that stand for `width` m, with a bar of a millimetre, or the tenth of
/// one where that would not fit, and a caption.
pub fn slide(
    crystal: &Crystal,
    view: View,
    width: f64,
    side: usize,
    light: Light,
    caption: &str,
) -> Result<Picture> {
    let relief = Relief::of(crystal, view, width, side).map_err(|cause| Error::broken(cause.to_string()))?;
    let mut picture = unmarked(&relief, light)?;
    mark(&mut picture, &relief, caption);
    Ok(picture)
}

/// A half-angle, radians, of an aperture that suits a crystal, as a photographer would set it: nine tenths of what is not flat
/// bend light by less.
pub fn suited(relief: &Relief) -> f64 {
    let mut bent: Vec<f64> =
        relief.slope().iter().map(|[x, y]| (INDEX - 1.0) * libm::hypot(*x, *y)).collect();
    bent.retain(|angle| *angle > 1e-3);
    bent.sort_unstable_by(f64::total_cmp);
    let strong = bent.get(bent.len() * 9 / 10).copied().unwrap_or(1.0);
    (0.7 * strong).clamp(0.02, 1.0)
}

/// The same with nothing written on it.
pub fn unmarked(relief: &Relief, light: Light) -> Result<Picture> {
    let side = relief.side() as u32;
    let code = |linear: f64| (255.0 * srgb_encode(linear.clamp(0.0, 1.0))).round() as u8;
    let shown = light.picture(relief);
    let pixels = shown.iter().flat_map(|rgb| [0, 1, 2].map(|c| code(rgb[c] * GROUND[c])));
    Picture::from_rgb(side, side, pixels.collect())
        .map_err(|cause: ImageError| Error::broken(cause.to_string()))
}

fn mark(picture: &mut Picture, relief: &Relief, caption: &str) {
    let side = f64::from(picture.width());
    let size = (side / 34.0).max(11.0);
    let margin = 0.8 * size;
    let (bar, name) = if 1e-3 / relief.pixel() < 0.6 * side { (1e-3, "1 mm") } else { (1e-4, "0.1 mm") };
    let bottom = side - margin;
    let thick = (0.22 * size).max(2.0) as u32;
    let length = (bar / relief.pixel()).round() as u32;
    for y in 0..thick {
        for x in 0..length.min(picture.width()) {
            picture.set(margin as u32 + x, bottom as u32 - thick + y, INK);
        }
    }
    draw_text(picture, margin, bottom - f64::from(thick) - 0.4 * size, size, INK, name, Face::Regular);
    draw_text(picture, margin, margin + 0.75 * size, size, INK, caption, Face::Regular);
}
