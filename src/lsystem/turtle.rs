//! The turtle: it walks along a word and draws.
//!
//! | symbol | does | ABOP |
//! |---|---|---|
//! | one of [`Turtle::draws`] | one step ahead, drawing a segment | 1.3 |
//! | one of [`Turtle::moves`] | one step ahead without drawing | 1.3 |
//! | `+` `-` | turns left, right | 1.3 |
//! | `&` `^` | pitches down, up | 1.5 |
//! | `\` `/` | rolls left, right | 1.5 |
//! | `|` | turns around | 1.5 |
//! | `[` `]` | remembers where it is, and goes back there | 1.6.1 |
//! | `!` | makes what follows thinner | 1.6 |
//!
//! Every other symbol does nothing.

use nalgebra::{Matrix3, Point3, Vector3};

use super::{LSystemError, Node, Structure};

/// How a word is drawn. The turtle starts in the origin, heads along +y with -x at its left, and +z is up to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Turtle {
    /// The angle of every turn, degrees.
    pub angle: f64,
    /// Length of a segment, m.
    pub step: f64,
    /// Width of the first segment, m.
    pub width: f64,
    /// By what `!` multiplies the width.
    pub thinner: f64,
    /// Symbols that draw.
    pub draws: String,
    /// Symbols that move without drawing.
    pub moves: String,
}

#[derive(Clone)]
struct State {
    place: Point3<f64>,
    frame: Frame,
    width: f64,
    node: usize,
    depth: usize,
}

/// Which way the turtle looks. In its first plane turns are counted and not multiplied, so that a walk closes, and its
/// mirror image is one, to the last bit.
#[derive(Clone)]
enum Frame {
    Plane(i64),
    // Columns: heading, left, up.
    Space(Matrix3<f64>),
}

impl Turtle {
    /// Walks along a word.
    ///
    /// # Errors
    ///
    /// Numbers that are not finite or (step, width) not above 0; a `]` too many; no segment at all.
    pub fn draw(&self, word: &str) -> Result<Structure, LSystemError> {
        for (name, value) in [("the step", self.step), ("the width", self.width), ("thinner", self.thinner)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(LSystemError::OutOfRange { name, value, accepted: "above 0" });
            }
        }
        if !self.angle.is_finite() {
            let (name, value) = ("the angle", self.angle);
            return Err(LSystemError::OutOfRange { name, value, accepted: "a finite number of degrees" });
        }
        let root = |place| Node { place, parent: None, depth: 0, width: self.width };
        let mut nodes = vec![root(Point3::origin())];
        let mut now =
            State { place: Point3::origin(), frame: Frame::Plane(0), width: self.width, node: 0, depth: 0 };
        let mut stack = Vec::new();
        for symbol in word.chars() {
            if self.draws.contains(symbol) {
                now.place += self.step * self.heading(&now.frame);
                nodes.push(Node {
                    place: now.place,
                    parent: Some(now.node),
                    depth: now.depth,
                    width: now.width,
                });
                now.node = nodes.len() - 1;
            } else if self.moves.contains(symbol) {
                now.place += self.step * self.heading(&now.frame);
                nodes.push(root(now.place));
                now.node = nodes.len() - 1;
            } else {
                match symbol {
                    '[' => {
                        stack.push(now.clone());
                        now.depth += 1;
                    }
                    ']' => now = stack.pop().ok_or_else(|| LSystemError::Brackets(word.to_owned()))?,
                    '!' => now.width *= self.thinner,
                    _ => now.frame = self.turned(now.frame, symbol),
                }
            }
        }
        if nodes.iter().all(|node| node.parent.is_none()) {
            return Err(LSystemError::NothingDrawn { draws: self.draws.clone() });
        }
        Ok(Structure { nodes, step: self.step })
    }

    fn heading(&self, frame: &Frame) -> Vector3<f64> {
        match frame {
            Frame::Plane(turns) => {
                // Odd in the number of turns, bit for bit.
                let (sine, cosine) = sine_cosine(turns.unsigned_abs() as f64 * self.angle);
                Vector3::new(if *turns < 0 { sine } else { -sine }, cosine, 0.0)
            }
            Frame::Space(frame) => frame.column(0).into_owned(),
        }
    }

    fn turned(&self, frame: Frame, symbol: char) -> Frame {
        match (frame, symbol) {
            (Frame::Plane(turns), '+') => Frame::Plane(turns + 1),
            (Frame::Plane(turns), '-') => Frame::Plane(turns - 1),
            (frame, '+') => self.rotated(frame, self.angle, 2),
            (frame, '-') => self.rotated(frame, -self.angle, 2),
            (frame, '&') => self.rotated(frame, self.angle, 1),
            (frame, '^') => self.rotated(frame, -self.angle, 1),
            (frame, '\\') => self.rotated(frame, self.angle, 0),
            (frame, '/') => self.rotated(frame, -self.angle, 0),
            (frame, '|') => self.rotated(frame, 180.0, 2),
            (frame, _) => frame,
        }
    }

    /// Turns about one of the turtle's own axes, by the matrices R_H, R_L and R_U of ABOP 1.5.
    fn rotated(&self, frame: Frame, degrees: f64, axis: usize) -> Frame {
        let frame = match frame {
            Frame::Space(frame) => frame,
            Frame::Plane(_) => {
                let heading = self.heading(&frame);
                Matrix3::from_columns(&[heading, Vector3::new(-heading.y, heading.x, 0.0), Vector3::z()])
            }
        };
        let (sine, cosine) = sine_cosine(degrees.abs());
        let s = if degrees < 0.0 { -sine } else { sine };
        let c = cosine;
        let turn = match axis {
            0 => Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
            1 => Matrix3::new(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c),
            _ => Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
        };
        Frame::Space(orthonormal(frame * turn))
    }
}

/// Sine and cosine of an angle of 0 degrees or more; right angles exactly.
fn sine_cosine(degrees: f64) -> (f64, f64) {
    let turn = libm::fmod(degrees, 360.0);
    match turn {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => libm::sincos(turn.to_radians()),
    }
}

/// The frame without what rounding has put on it, however long the walk.
fn orthonormal(frame: Matrix3<f64>) -> Matrix3<f64> {
    let heading = frame.column(0).normalize();
    let left = frame.column(1) - heading * heading.dot(&frame.column(1));
    let left = left.normalize();
    Matrix3::from_columns(&[heading, left, heading.cross(&left)])
}
