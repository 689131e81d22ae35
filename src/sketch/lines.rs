//! Lines with a level each, from a drawing: contours of density or height.

use kurbo::{BezPath, PathEl};

use super::outline::{chords, parts};
use super::svg::traced;
use super::{MOST_SEGMENTS, SketchError};

/// A line of one level.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// What messages call it: its id, or where it stands in the file.
    pub name: String,
    /// Its level.
    pub level: f64,
    /// Its points, no two in succession the same; y points down, as in the drawing.
    pub points: Vec<[f64; 2]>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
}

/// What a colour of lines stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourLevel {
    /// Red, green and blue of the `stroke`.
    pub colour: [u8; 3],
    /// The level of lines in it.
    pub level: f64,
}

/// Reads the lines of an SVG drawing: every `path`, `polyline`, `polygon`, `rect`, `circle` and `ellipse`, filled or
/// not, whose level stands in the attribute `data-level`, its own or that of the element around it, or else is that of
/// its `stroke` in the table of colours, which may be empty.
///
/// Curves are replaced by chords that stray at most `tolerance` user units. A part of a path that is closed, or that
/// ends where it began, is closed. What [`read_svg`](super::read_svg) says of transforms, `use`, `display` and limits
/// holds here.
///
/// # Errors
/// As [`read_svg`](super::read_svg); a shape without a level, or with one that is no number up to 1e9; no lines at all.
pub fn read_svg_lines(
    bytes: &[u8],
    tolerance: f64,
    colours: &[ColourLevel],
) -> Result<Vec<Line>, SketchError> {
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(SketchError::Spacing(tolerance));
    }
    let mut lines = Vec::new();
    let mut budget = MOST_SEGMENTS;
    for shape in traced(bytes, colours)? {
        let several = parts(&shape.path).count() > 1;
        for (number, part) in parts(&shape.path).enumerate() {
            let (points, closed) = flatten(part, tolerance, &mut budget)?;
            let part = if several { format!(", part {}", number + 1) } else { String::new() };
            lines.push(Line { name: format!("{}{part}", shape.name), level: shape.level, points, closed });
        }
    }
    if lines.is_empty() {
        return Err(SketchError::NoPaint {
            expected: "at least one path, polyline, polygon, rect, circle or ellipse with a `data-level`",
        });
    }
    Ok(lines)
}

/// A shape with its level.
pub(super) struct Traced {
    pub path: BezPath,
    pub level: f64,
    pub name: String,
}

/// The points of one part, and whether it is closed.
fn flatten(
    part: &[PathEl],
    tolerance: f64,
    budget: &mut usize,
) -> Result<(Vec<[f64; 2]>, bool), SketchError> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut push = |place: kurbo::Point| {
        let place = [place.x, place.y];
        if points.last() != Some(&place) {
            points.push(place);
        }
    };
    for segment in kurbo::segments(part.iter().copied()) {
        let pieces = chords(&segment, tolerance);
        if pieces > *budget as f64 {
            return Err(SketchError::TooIntricate { what: "straight pieces", most: MOST_SEGMENTS });
        }
        *budget -= pieces as usize;
        push(kurbo::ParamCurve::start(&segment));
        for i in 1..=pieces as usize {
            let last = i == pieces as usize;
            let share = if last { 1.0 } else { i as f64 / pieces };
            push(if last {
                kurbo::ParamCurve::end(&segment)
            } else {
                kurbo::ParamCurve::eval(&segment, share)
            });
        }
    }
    let back = points.len() > 3 && points.first() == points.last();
    let closed = back || part.contains(&PathEl::ClosePath);
    if closed && points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    Ok((points, closed))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(body: &str) -> Result<Vec<Line>, SketchError> {
        read_svg_lines(
            format!("<svg xmlns='http://www.w3.org/2000/svg'>\n{body}\n</svg>").as_bytes(),
            0.01,
            &[],
        )
    }

    #[test]
    fn paths_have_levels_of_their_own_or_of_their_group() {
        let lines = read(
            "<g data-level='2' transform='translate(10 0)'><path id='a' d='M0 0H4V4H0Z'/>\
             <path data-level='-1.5' d='M0 0L1 1M5 5L6 6L7 5'/></g>\n<circle data-level='3' r='2' fill='none'/>",
        )
        .unwrap();
        let seen: Vec<(&str, f64, usize, bool)> =
            lines.iter().map(|l| (l.name.as_str(), l.level, l.points.len(), l.closed)).collect();
        let count = lines[3].points.len();
        assert_eq!(
            seen,
            [
                ("#a", 2.0, 4, true),
                ("path in line 2, column 77, part 1", -1.5, 2, false),
                ("path in line 2, column 77, part 2", -1.5, 3, false),
                ("circle in line 3, column 1", 3.0, count, true),
            ]
        );
        assert_eq!(lines[0].points, [[10.0, 0.0], [14.0, 0.0], [14.0, 4.0], [10.0, 4.0]]);
        assert!((16..100).contains(&count));
        for [x, y] in &lines[3].points {
            assert!((libm::hypot(*x, *y) - 2.0).abs() < 1e-5);
        }
    }

    #[test]
    fn a_colour_may_stand_for_a_level() {
        let colours =
            [([255, 0, 0], 3.0), ([0, 128, 0], 5.0)].map(|(colour, level)| ColourLevel { colour, level });
        let read = |body: &str| {
            let file = format!("<svg xmlns='http://www.w3.org/2000/svg'>{body}</svg>");
            read_svg_lines(file.as_bytes(), 0.01, &colours)
        };
        let lines = read(
            "<style>.low { stroke: red }</style><path class='low' d='M0 0L1 1'/>\
             <g stroke='green'><path d='M0 3L1 4'/><path data-level='9' d='M0 5L1 6'/></g>",
        )
        .unwrap();
        assert_eq!(lines.iter().map(|line| line.level).collect::<Vec<_>>(), [3.0, 5.0, 9.0]);
        let said = read("<path stroke='#0000ff' d='M0 0L1 1'/>").unwrap_err().to_string();
        assert!(said.contains("the stroke #0000ff; expected one of #ff0000, #008000"), "{said}");
    }

    #[test]
    fn a_line_that_ends_where_it_began_is_closed() {
        let lines = read("<polyline data-level='1' points='0,0 1,0 1,1 0,0'/>").unwrap();
        assert_eq!((lines[0].points.len(), lines[0].closed), (3, true));
    }

    #[test]
    fn what_is_missing_is_named() {
        let says = |body: &str| read(body).unwrap_err().to_string();
        assert!(says("<path d='M0 0L1 1'/>").contains("no `data-level`"));
        assert!(says("<path d='M0 0L1 1' data-level='high'/>").contains("`data-level` is"));
        assert!(says("<path d='M0 0L1 1' data-level='1e12'/>").contains("up to"));
        assert!(says("<text>none</text>").contains("data-level"));
        assert!(read_svg_lines(b"<svg/>", 0.0, &[]).is_err());
    }
}
