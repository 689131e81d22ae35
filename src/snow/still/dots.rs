//! Flakes laid down on the picture: no ray has to meet them by chance.
//!
//! Of a flake smaller than pixels, or much blurred, the mean opacity in each pixel is worked out as a convolution: of what is
//! seen of it, in parts at most as large as the blur lets be told apart, with the circle that the lens makes of a point, its
//! way while the shutter is open, and the pixel. The second and third are points of lens and time, evenly spread; each part
//! at each point is a square that is shared among the pixels that it lies on. All shares together are its opacity.

use std::sync::LazyLock;

use super::camera::Camera;
use super::fit::spread;
use super::sequence::disc;

/// The most points.
const MOST: usize = 4096;
/// Points are so far apart, in pixels, and as a share of the circle's width if that is more.
const GRAIN: f64 = 0.5;
const COARSER: f64 = 1.0 / 14.0;
/// Spread over less, in pixels, it is one point.
const STILL: f64 = 0.02;

/// Places on a lens of radius 1.
static LENS: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| (0..MOST).map(|k| disc(spread(k))).collect());

/// A part of a flake.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// From the flake's centre to the right and up, m.
    pub at: [f64; 2],
    /// The integral of 1 - transmittance over the plane of the picture, as large as the flake, m^2.
    pub area: f64,
    /// The same of light that is reflected, of I_0 = 1, m^2.
    pub lit: f64,
}

/// A flake to lay down.
#[derive(Clone, Debug)]
pub(super) struct Dot {
    pub parts: Vec<Part>,
    /// The side of a part, m.
    pub side: f64,
    /// No part's middle is further from the centre, m.
    pub reach: f64,
}

/// How a point is blurred, in pixels: the radius of its circle, and its way.
pub(super) fn blur(camera: &Camera, place: [f64; 3], motion: [f64; 3]) -> [f64; 2] {
    let at = |time: f64| [0, 1, 2].map(|axis| place[axis] + motion[axis] * time);
    let [from, to] = [-0.5, 0.5].map(|time| camera.project(at(time), [0.0; 2]));
    let way = [to[0] - from[0], to[1] - from[1]];
    let way = (way[0] * way[0] + way[1] * way[1]).sqrt();
    [camera.confusion(at(-0.5)[2]).max(camera.confusion(at(0.5)[2])), way]
}

impl Dot {
    /// Gives each pixel within `columns` and `rows` that it is spread over, several times, a part of its opacity and of its
    /// light: column, row, parts. Returns the number of squares.
    pub fn lay(
        &self,
        camera: &Camera,
        place: [f64; 3],
        motion: [f64; 3],
        [columns, rows]: [[i64; 2]; 2],
        mut give: impl FnMut(i64, i64, [f64; 2]),
    ) -> u64 {
        let [circle, way] = blur(camera, place, motion);
        let area = circle * (std::f64::consts::PI * circle + 2.0 * way);
        let (count, grain) = if way + circle < STILL {
            (1, 0.0)
        } else {
            let apart = GRAIN.max(COARSER * 2.0 * circle);
            let count = ((area / (apart * apart)).max(way / apart) as usize + 8).min(MOST);
            let each = 1.0 / count as f64;
            (count, (1.3 * (area * each).sqrt()).max(way * each))
        };
        let each = 1.0 / count as f64;
        let mut squares = 0;
        for k in 0..count {
            let time = (k as f64 + 0.5) * each - 0.5;
            let place = [0, 1, 2].map(|axis| place[axis] + motion[axis] * time);
            let [x, y] = camera.project(place, LENS[k].map(|x| x * camera.aperture));
            let pixels = camera.scale / place[2];
            // A square as large as the part, wider by the points' distance.
            let own = self.side * pixels;
            let half = 0.5 * (own * own + grain * grain).sqrt();
            let reach = half + self.reach * pixels;
            let meets =
                |x: f64, span: [i64; 2]| x + reach >= span[0] as f64 && x - reach <= span[1] as f64 + 1.0;
            if !meets(x, columns) || !meets(y, rows) {
                continue;
            }
            squares += self.parts.len() as u64;
            let by = pixels * pixels * each / (4.0 * half * half);
            for part in &self.parts {
                let [x, y] = [x + part.at[0] * pixels, y - part.at[1] * pixels];
                let [left, right] = [floor(x - half).max(columns[0]), floor(x + half).min(columns[1])];
                for row in floor(y - half).max(rows[0])..=floor(y + half).min(rows[1]) {
                    let tall = by * overlap(y - half, y + half, row);
                    for column in left..=right {
                        let share = tall * overlap(x - half, x + half, column);
                        give(column, row, [part.area * share, part.lit * share]);
                    }
                }
            }
        }
        squares
    }
}

/// How much of a pixel's side lies between two places.
#[inline(always)]
fn overlap(from: f64, to: f64, pixel: i64) -> f64 {
    (to.min(pixel as f64 + 1.0) - from.max(pixel as f64)).max(0.0)
}

/// The pixel of a coordinate; those far outside are all alike.
#[inline(always)]
fn floor(x: f64) -> i64 {
    (x.clamp(-1e6, 1e6) + 2e6) as i64 - 2_000_000
}
