//! Outlines from SVG path data and basic shapes.
//!
//! Kurbo's own arcs and shapes use the system's mathematical functions where another crate switches its `std` on; here
//! only its arithmetic is used, and sines come from `libm`.

use std::f64::consts::{FRAC_PI_8, PI};

use kurbo::{BezPath, Point, Vec2};
use svgtypes::{NumberListParser, PathParser, PathSegment};

/// Curves reached by a walk through path data, and what `S` and `T` need to go on from.
struct Pen {
    path: BezPath,
    at: Point,
    // Where the part began, if nothing was drawn since it was closed.
    first: Point,
    closed: bool,
    control: Control,
}

#[derive(Clone, Copy)]
enum Control {
    None,
    Cubic(Point),
    Quadratic(Point),
}

/// The outline of a `d` attribute, of at most `most` elements; the error says what is wrong.
pub(super) fn path(data: &str, most: usize) -> Result<Option<BezPath>, String> {
    let (origin, none) = (Point::ORIGIN, Control::None);
    let mut pen = Pen { path: BezPath::new(), at: origin, first: origin, closed: true, control: none };
    for segment in PathParser::from(data) {
        pen.draw(segment.map_err(|e| e.to_string())?);
        if pen.path.elements().len() > most {
            return Ok(None);
        }
    }
    Ok(Some(pen.path))
}

impl Pen {
    fn draw(&mut self, segment: PathSegment) {
        let from = self.at;
        let place = |abs: bool, x: f64, y: f64| {
            if abs { Point::new(x, y) } else { Point::new(from.x + x, from.y + y) }
        };
        if let PathSegment::MoveTo { abs, x, y } = segment {
            self.at = place(abs, x, y);
            (self.first, self.closed, self.control) = (self.at, true, Control::None);
            return;
        }
        if let PathSegment::ClosePath { .. } = segment {
            if !self.closed {
                self.path.close_path();
            }
            (self.at, self.closed, self.control) = (self.first, true, Control::None);
            return;
        }
        if self.closed {
            self.path.move_to(from);
            self.closed = false;
        }
        let mirrored = |control: Point| (2.0 * from.to_vec2() - control.to_vec2()).to_point();
        let mut control = Control::None;
        self.at = match segment {
            PathSegment::LineTo { abs, x, y } => self.line(place(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => self.line(Point::new(place(abs, x, 0.0).x, from.y)),
            PathSegment::VerticalLineTo { abs, y } => self.line(Point::new(from.x, place(abs, 0.0, y).y)),
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                let (b, c, to) = (place(abs, x1, y1), place(abs, x2, y2), place(abs, x, y));
                control = Control::Cubic(c);
                self.path.curve_to(b, c, to);
                to
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let b = if let Control::Cubic(last) = self.control { mirrored(last) } else { from };
                let (c, to) = (place(abs, x2, y2), place(abs, x, y));
                control = Control::Cubic(c);
                self.path.curve_to(b, c, to);
                to
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                let (b, to) = (place(abs, x1, y1), place(abs, x, y));
                control = Control::Quadratic(b);
                self.path.quad_to(b, to);
                to
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                let b = if let Control::Quadratic(last) = self.control { mirrored(last) } else { from };
                let to = place(abs, x, y);
                control = Control::Quadratic(b);
                self.path.quad_to(b, to);
                to
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let to = place(abs, x, y);
                arc_to(&mut self.path, from, to, Vec2::new(rx, ry), x_axis_rotation, large_arc, sweep);
                to
            }
            PathSegment::MoveTo { .. } | PathSegment::ClosePath { .. } => from,
        };
        self.control = control;
    }

    fn line(&mut self, to: Point) -> Point {
        self.path.line_to(to);
        to
    }
}

/// Sine and cosine of an angle in degrees, exact for quarter turns.
pub(super) fn turn(degrees: f64) -> (f64, f64) {
    let degrees = degrees % 360.0;
    match (degrees + 360.0) % 360.0 {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => libm::sincos(degrees * (PI / 180.0)),
    }
}

/// Part of an ellipse, in radians, as cubic curves; a quarter of a quarter each, so that they stray 1e-7 of its radius.
fn arc(path: &mut BezPath, centre: Point, radii: Vec2, (sin, cos): (f64, f64), from: f64, sweep: f64) {
    let pieces = libm::ceil(sweep.abs() / FRAC_PI_8 - 1e-9).clamp(1.0, 17.0);
    let step = sweep / pieces;
    let arm = 4.0 / 3.0 * libm::tan(0.25 * step);
    let place = |u: f64, v: f64| {
        let (x, y) = (radii.x * u, radii.y * v);
        Point::new(centre.x + cos * x - sin * y, centre.y + sin * x + cos * y)
    };
    for i in 0..pieces as u32 {
        let (s0, c0) = libm::sincos(from + step * f64::from(i));
        let (s1, c1) = libm::sincos(from + step * f64::from(i + 1));
        path.curve_to(
            place(c0 - arm * s0, s0 + arm * c0),
            place(c1 + arm * s1, s1 - arm * c1),
            place(c1, s1),
        );
    }
}

/// An arc given by its ends, as in the implementation notes of SVG (F.6.5, F.6.6).
fn arc_to(path: &mut BezPath, from: Point, to: Point, radii: Vec2, degrees: f64, large: bool, sweep: bool) {
    let (sin, cos) = turn(degrees);
    let half = Vec2::new(0.5 * (from.x - to.x), 0.5 * (from.y - to.y));
    let (mut rx, mut ry) = (radii.x.abs(), radii.y.abs());
    // Half the chord, in the ellipse's own directions and radii.
    let (u, v) = ((cos * half.x + sin * half.y) / rx, (cos * half.y - sin * half.x) / ry);
    let square = u * u + v * v;
    if !(square.is_finite() && square > 0.0) {
        // No radius, or no way to go: a straight line.
        return path.line_to(to);
    }
    // Radii too small to reach are scaled up until they do.
    let stretch = libm::sqrt(square).max(1.0);
    (rx, ry) = (rx * stretch, ry * stretch);
    let (u, v) = (u / stretch, v / stretch);
    let side = libm::sqrt((stretch * stretch / square - 1.0).max(0.0));
    let side = if large == sweep { -side } else { side };
    let (cu, cv) = (side * v, -side * u);
    let centre = Point::new(
        cos * cu * rx - sin * cv * ry + 0.5 * (from.x + to.x),
        sin * cu * rx + cos * cv * ry + 0.5 * (from.y + to.y),
    );
    let start = libm::atan2(v - cv, u - cu);
    let mut angle = libm::atan2(-v - cv, -u - cu) - start;
    if sweep && angle < 0.0 {
        angle += 2.0 * PI;
    } else if !sweep && angle > 0.0 {
        angle -= 2.0 * PI;
    }
    arc(path, centre, Vec2::new(rx, ry), (sin, cos), start, angle);
    path.line_to(to); // mends the last rounding
}

/// An ellipse, nothing without area.
pub(super) fn ellipse(centre: Point, radii: Vec2) -> BezPath {
    let mut path = BezPath::new();
    if radii.x > 0.0 && radii.y > 0.0 {
        path.move_to(Point::new(centre.x + radii.x, centre.y));
        arc(&mut path, centre, radii, (0.0, 1.0), 0.0, 2.0 * PI);
        path.close_path();
    }
    path
}

/// A rectangle with rounded corners, nothing without area.
pub(super) fn rectangle(corner: Point, size: Vec2, radii: Vec2) -> BezPath {
    let mut path = BezPath::new();
    if !(size.x > 0.0 && size.y > 0.0) {
        return path;
    }
    let (rx, ry) = (radii.x.min(0.5 * size.x), radii.y.min(0.5 * size.y));
    let (right, foot) = (corner.x + size.x, corner.y + size.y);
    let mut corner_at = |x: f64, y: f64, from: f64| {
        let (s, c) = turn(from);
        let begin = Point::new(x + rx * c, y + ry * s);
        if path.elements().is_empty() {
            path.move_to(begin)
        } else {
            path.line_to(begin)
        }
        if rx > 0.0 && ry > 0.0 {
            arc(&mut path, Point::new(x, y), Vec2::new(rx, ry), (0.0, 1.0), from * (PI / 180.0), 0.5 * PI);
        }
    };
    let (rx, ry) = if rx > 0.0 && ry > 0.0 { (rx, ry) } else { (0.0, 0.0) };
    corner_at(right - rx, foot - ry, 0.0);
    corner_at(corner.x + rx, foot - ry, 90.0);
    corner_at(corner.x + rx, corner.y + ry, 180.0);
    corner_at(right - rx, corner.y + ry, 270.0);
    path.close_path();
    path
}

/// The outline of a `points` attribute, of at most `most` elements.
pub(super) fn polygon(points: &str, most: usize) -> Result<Option<BezPath>, String> {
    let mut path = BezPath::new();
    let mut numbers = NumberListParser::from(points);
    while let Some(x) = numbers.next() {
        let x = x.map_err(|e| e.to_string())?;
        let y = numbers.next().ok_or("a point without its y")?.map_err(|e| e.to_string())?;
        match path.elements() {
            [] => path.move_to(Point::new(x, y)),
            elements if elements.len() > most => return Ok(None),
            _ => path.line_to(Point::new(x, y)),
        }
    }
    if path.elements().len() > 1 {
        path.close_path();
    }
    Ok(Some(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(data: &str) -> f64 {
        use kurbo::Shape as _;
        path(data, 1000).unwrap().unwrap().area()
    }

    #[test]
    fn arcs_sweep_what_they_should() {
        let pi = PI;
        for (data, expected) in [
            ("M10 0 A10 10 0 0 1 -10 0 A10 10 0 0 1 10 0z", 100.0 * pi),
            ("M10 0 a10 10 0 1 0 -20 0a10 10 0 10 20 0z", -100.0 * pi),
            ("M20 0 A20 5 0 0 1 -20 0 A20 5 0 0 1 20 0", 100.0 * pi),
            ("M0 20 A20 5 90 0 1 0 -20 A20 5 450 0 1 0 20", 100.0 * pi),
            ("M10 0 A1 1 0 0 1 -10 0z", 50.0 * pi), // too small: scaled up
            ("M10 0 A10 10 0 0 1 0 10z", 25.0 * pi - 50.0),
            ("M10 0 A10 10 0 1 0 0 10z", -(75.0 * pi + 50.0)),
            ("M0 0 A0 5 0 0 1 10 0 v10z", 50.0),
        ] {
            assert!((area(data) - expected).abs() < 1e-4, "{data}: {} {expected}", area(data));
        }
    }

    #[test]
    fn relative_and_smooth_commands_go_on_from_where_the_pen_is() {
        assert_eq!(area("m1 1 2 0 0 2-2 0z m4 4h1v1h-1z"), 5.0);
        assert_eq!(area("M0 0H4V4H0Z h1 v-1 h-1z"), 15.0);
        assert_eq!(area("M0 0 Q1 2 2 0 T4 0 z"), area("M0 0 Q1 2 2 0 Q3-2 4 0z"));
        assert_eq!(area("M0 0 C0 1 1 2 2 2 S4 1 4 0z"), area("M0 0c0 1 1 2 2 2 1 0 2-1 2-2"));
        assert!(path("M0 0L1", 1000).is_err() && path("L1 1", 1000).is_err());
        assert!(path("M0 0h1 1 1 1 1", 3).unwrap().is_none());
    }
}
