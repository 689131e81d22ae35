//! Flakes made ready for a picture: where they are seen, at which level, and lit.

use nalgebra::Matrix3;

use crate::volume::Himeno;

use super::camera::Camera;
use super::dots::{Dot, blur};
use super::grid::Ray;
use super::sight::Lit;
use super::{Body, Manner, Placed, Scene};

/// A flake whose sharp picture is less wide is laid down as one part, pixels.
const DOT: f64 = 1.5;
/// One that is more blurred than this, in pixels, and than this share of its width, is laid down in parts.
const BLURRED: f64 = 1.5;
const SHARE: f64 = 0.12;
/// The side of a part as a share of the circle of confusion's width.
const PART: f64 = 0.2;
/// The side of cells as a share of a pixel, at most.
const FINER: f64 = 0.75;
/// Flakes nearer to the plane of the lens than this may be anywhere, m.
const NEAR: f64 = 1e-6;

/// Where in the picture a flake may be seen: about the way between two places, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Screen {
    ends: [[f64; 2]; 2],
    radius: f64,
}

impl Screen {
    /// None of what is behind.
    fn of(camera: &Camera, place: [f64; 3], motion: [f64; 3], radius: f64) -> Option<Self> {
        let ends = [-0.5, 0.5].map(|time| [0, 1, 2].map(|axis| place[axis] + motion[axis] * time));
        let near = ends[0][2].min(ends[1][2]) - radius;
        let far = ends[0][2].max(ends[1][2]) + radius;
        if far <= 0.0 {
            return None;
        }
        if near <= NEAR {
            let anywhere = [0.5 * camera.size[0] as f64, 0.5 * camera.size[1] as f64];
            return Some(Self { ends: [anywhere; 2], radius: f64::INFINITY });
        }
        let confusion = camera.confusion(near).max(camera.confusion(far));
        let wide = ends.map(|[x, y, z]| {
            // Away from the middle of the view a sphere is seen as an ellipse; its longer half, through any place of the
            // lens.
            let off = (x * x + y * y).sqrt() + camera.aperture;
            let squared = radius * radius;
            camera.scale * (off * squared / z + radius * (off * off + z * z - squared).sqrt())
                / (z * z - squared)
        });
        let radius = 1.001 * (wide[0].max(wide[1]) + confusion) + 0.01;
        Some(Self { ends: ends.map(|end| camera.project(end, [0.0; 2])), radius })
    }

    /// The first and last pixels of it along an axis, with `more` around, clipped to `from..end`; none if there are none.
    pub fn span(&self, axis: usize, more: f64, from: usize, end: usize) -> Option<[usize; 2]> {
        let [a, b] = self.ends.map(|end| end[axis]);
        let low = (a.min(b) - self.radius - more).max(from as f64);
        let high = (a.max(b) + self.radius + more).min(end as f64);
        if low > high {
            return None;
        }
        Some([low as usize, (high as usize).min(end - 1)])
    }

    /// How much further a flake that is laid down may be spread, pixels.
    pub fn margin(&self) -> f64 {
        4.0 + 0.2 * self.radius
    }

    /// Whether a pixel may show it.
    #[inline]
    pub fn meets(&self, pixel: [usize; 2]) -> bool {
        let [a, b] = self.ends;
        let from = [pixel[0] as f64 + 0.5 - a[0], pixel[1] as f64 + 0.5 - a[1]];
        let way = [b[0] - a[0], b[1] - a[1]];
        let length = way[0] * way[0] + way[1] * way[1];
        let along = (from[0] * way[0] + from[1] * way[1]) / length.max(1e-12);
        let along = along.clamp(0.0, 1.0);
        let off = [from[0] - along * way[0], from[1] - along * way[1]];
        // Half the diagonal of a pixel.
        let reach = self.radius + 0.708;
        off[0] * off[0] + off[1] * off[1] <= reach * reach
    }
}

/// How a flake is drawn.
#[derive(Clone, Debug)]
pub(super) enum Drawn<'a> {
    /// By rays.
    Traced(Box<Traced<'a>>),
    /// Laid down.
    Dot(Dot),
}

/// A flake that rays go through.
#[derive(Clone, Debug)]
pub(super) struct Traced<'a> {
    pub lit: Lit<'a>,
    /// From the camera's axes to the body's.
    turn: [[f64; 3]; 3],
    /// Sides of a cell in a metre.
    units: f64,
    /// The corner of the grid, sides.
    corner: [f64; 3],
    extent: [f64; 3],
    radius: f64,
}

/// A flake made ready.
#[derive(Clone, Debug)]
pub(super) struct Ready<'a> {
    /// Seen from the camera in the middle of its time, m.
    pub place: [f64; 3],
    /// How far it moves in the whole of its time, m.
    pub motion: [f64; 3],
    pub screen: Screen,
    pub drawn: Drawn<'a>,
}

impl<'a> Ready<'a> {
    /// None if it cannot be in what is made of the picture.
    pub fn new(
        scene: &Scene<'a>,
        himeno: &'a Himeno,
        camera: &Camera,
        flake: &Placed,
        manner: Manner,
    ) -> Option<Self> {
        let body: &'a Body = &scene.bodies[flake.template];
        let place = camera.seen(&flake.at);
        let motion = camera.turned(&(flake.velocity * camera.shutter));
        let radius = body.radius * flake.scale;
        let screen = Screen::of(camera, place, motion, radius)?;
        let [left, top, width, height] = camera.window;
        screen.span(0, screen.margin(), left, left + width)?;
        screen.span(1, screen.margin(), top, top + height)?;
        let nearest = place[2] - radius;
        let wide = 2.0 * radius * camera.scale / place[2];
        let [circle, way] = blur(camera, place, motion);
        let blurred = 2.0 * circle + way;
        let is_whole = manner == Manner::Swift && screen.radius.is_finite() && nearest > 0.0;
        let is_dot = is_whole && wide < DOT;
        let is_laid = is_dot || is_whole && blurred > BLURRED.max(SHARE * wide);
        let level = if is_dot {
            body.levels.len() - 1
        } else {
            let pixel = nearest.max(NEAR) / camera.scale;
            let fits = |level: &usize| body.levels[*level].0.side * flake.scale <= FINER * pixel;
            (1..body.levels.len()).rev().find(fits).unwrap_or(0)
        };
        let (grid, fit) = &body.levels[level];
        let turn: Matrix3<f64> =
            flake.turn.inverse().to_rotation_matrix().into_inner() * Matrix3::from_columns(&camera.axes);
        let turn = [0, 1, 2].map(|row| [turn[(row, 0)], turn[(row, 1)], turn[(row, 2)]]);
        let to_light = unit(turned(&turn, camera.turned(&himeno.to_light.into())));
        let seen_along = unit(if place == [0.0; 3] { [0.0, 0.0, 1.0] } else { place });
        let view = turned(&turn, seen_along);
        let strength = scene.extinction * flake.scale / body.extinction;
        let by = |direction| strength * fit.multiplier(direction, strength);
        let lit = Lit::new(grid, himeno, by(view), by(to_light), to_light);
        let side = grid.side * flake.scale;
        let corner = body.corner.map(|x| x / grid.side);
        let drawn = if is_laid {
            // A square as large as the disc, or what the blur leaves to see.
            // What moves is blurred along its way alone.
            let part = if is_dot { 0.886 * wide } else { (PART * 2.0 * circle).max(FINER) };
            let part = part * place[2] / camera.scale;
            // From the body's axes to the camera's.
            let to_camera = [0, 1, 2].map(|column| turn.map(|row| row[column]));
            let place = |[x, y, z]: [f64; 3]| {
                let [x, y, z] = turned(&to_camera, [x + corner[0], y + corner[1], z + corner[2]]);
                // Along the view onto the plane of the picture.
                let along = z / seen_along[2];
                [(x - seen_along[0] * along) * side, (y - seen_along[1] * along) * side]
            };
            let by = side * side / seen_along[2];
            Drawn::Dot(lit.parts(view, place, by, part, (!is_dot).then_some(radius / seen_along[2])))
        } else {
            Drawn::Traced(Box::new(Traced {
                lit,
                turn,
                units: 1.0 / side,
                corner,
                extent: grid.extent,
                radius,
            }))
        };
        Some(Self { place, motion, screen, drawn })
    }
}

impl Traced<'_> {
    /// The ray in sides of a cell, and how far away it enters the body, m; none if it misses. `ray` is where it begins and
    /// its direction, `centre` where the flake is.
    #[inline]
    pub fn enter(&self, [origin, direction]: [[f64; 3]; 2], centre: [f64; 3]) -> Option<(f64, Ray)> {
        let from = [0, 1, 2].map(|axis| origin[axis] - centre[axis]);
        let along = -dot(from, direction);
        let off = dot(from, from) - along * along;
        if off > self.radius * self.radius || along + self.radius < 0.0 {
            return None;
        }
        let begin = turned(&self.turn, from);
        let begin = [0, 1, 2].map(|axis| begin[axis] * self.units - self.corner[axis]);
        let ray = Ray::new(begin, turned(&self.turn, direction));
        let [enter, leave] = ray.through([0.0; 3], self.extent);
        (enter < leave).then(|| (enter / self.units, ray))
    }
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn turned(turn: &[[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
    turn.map(|row| dot(row, vector))
}

fn unit(vector: [f64; 3]) -> [f64; 3] {
    let length = dot(vector, vector).sqrt();
    vector.map(|x| x / length)
}
