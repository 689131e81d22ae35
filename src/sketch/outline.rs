//! Filled outlines: which lattice points lie inside.

use kurbo::{Affine, BezPath, ParamCurve, PathSeg, Point, Shape as _};
use nalgebra::{Point2, point};

use super::place::{Grid, Paint};
use super::{SketchError, Warp};
use crate::hexgrid::ROW_HEIGHT;

/// The most straight pieces, and the most crossings of rows, in one drawing laid on one lattice.
const MOST_PIECES: usize = 1 << 23;
/// Curves are followed to this part of a spacing.
const TOLERANCE: f64 = 1.0 / 64.0;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FillRule {
    NonZero,
    EvenOdd,
}

impl FillRule {
    fn inside(self, winding: i32) -> bool {
        match self {
            Self::NonZero => winding != 0,
            Self::EvenOdd => winding % 2 != 0,
        }
    }
}

/// A filled shape, in sketch units.
#[derive(Debug)]
pub(super) struct Shape {
    pub path: BezPath,
    pub rule: FillRule,
    /// White: what it covers is no longer paint.
    pub erases: bool,
}

/// Shapes from the lowest to the topmost.
#[derive(Debug)]
pub(super) struct Drawing {
    shapes: Vec<Shape>,
    least: Point2<f64>,
    greatest: Point2<f64>,
}

impl Drawing {
    /// Nothing if no shape paints.
    pub fn new(shapes: Vec<Shape>) -> Option<Self> {
        let boxes = shapes.iter().filter(|s| !s.erases).map(|s| s.path.bounding_box());
        // A line has an outline but no inside.
        let whole = boxes.filter(|b| b.width() > 0.0 && b.height() > 0.0).reduce(|a, b| a.union(b))?;
        let (least, greatest) = (point![whole.x0, whole.y0], point![whole.x1, whole.y1]);
        Some(Self { shapes, least, greatest })
    }
}

/// A straight piece, with the rows at whole y.
#[derive(Clone, Copy)]
struct Edge {
    from: Point,
    to: Point,
}

impl Edge {
    /// The rows it crosses; one that ends where the next begins is crossed once.
    fn rows(self) -> (f64, f64) {
        let (low, high) = (self.from.y.min(self.to.y), self.from.y.max(self.to.y));
        (libm::ceil(low), libm::ceil(high))
    }

    fn crossing(self, row: f64) -> f64 {
        // From the lower end always, so that an outline walked either way crosses at the same place.
        let (a, b) = if self.from.y <= self.to.y { (self.from, self.to) } else { (self.to, self.from) };
        a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x)
    }

    fn direction(self) -> i32 {
        if self.from.y < self.to.y { 1 } else { -1 }
    }
}

fn intricate() -> SketchError {
    SketchError::TooIntricate { what: "straight pieces or crossings with rows", most: MOST_PIECES }
}

/// The outline with curves flattened and every part closed; the budget is what may still be made.
fn edges(path: &BezPath, onto: Affine, budget: &mut usize) -> Result<Vec<Edge>, SketchError> {
    let mut edges = Vec::new();
    let mut take = |number: f64| {
        if number <= *budget as f64 {
            *budget -= number as usize;
            return Ok(number as usize);
        }
        Err(intricate())
    };
    for part in parts(path) {
        let mut first = None;
        let mut at = Point::ORIGIN;
        for segment in kurbo::segments(part.iter().map(|element| onto * *element)) {
            first.get_or_insert(segment.start());
            let pieces = take(chords(&segment, TOLERANCE))?;
            at = segment.start();
            for i in 1..=pieces {
                let to = if i == pieces { segment.end() } else { segment.eval(i as f64 / pieces as f64) };
                edges.push(Edge { from: at, to });
                at = to;
            }
        }
        if let Some(first) = first.filter(|first| *first != at) {
            take(1.0)?;
            edges.push(Edge { from: at, to: first });
        }
    }
    Ok(edges)
}

/// The outline on the plane where a warped lattice is regular, in pieces short enough to be straight there.
fn flattened(
    outline: &[Edge],
    warp: &Warp,
    onto: Affine,
    budget: &mut usize,
) -> Result<Vec<Edge>, SketchError> {
    /// In spacings.
    const LONGEST: f64 = 3.0;
    let back = onto.inverse();
    // A corner becomes the same number from either side: the guess is the place itself.
    let flat = |at: Point| {
        let place = back * at;
        let place = warp.invert(point![place.x, place.y], point![place.x, place.y]);
        onto * Point::new(place.x, place.y)
    };
    let mut pieces = Vec::new();
    for edge in outline {
        let (x, y) = (edge.to.x - edge.from.x, edge.to.y - edge.from.y);
        let number = libm::ceil(libm::sqrt(x * x + y * y) / LONGEST).max(1.0);
        *budget = budget.checked_sub(number as usize).ok_or_else(intricate)?;
        let mut from = flat(edge.from);
        for piece in 1..=number as usize {
            let share = piece as f64 / number;
            let to = if share == 1.0 { edge.to } else { edge.from.lerp(edge.to, share) };
            let to = flat(to);
            pieces.push(Edge { from, to });
            from = to;
        }
    }
    Ok(pieces)
}

/// How many chords of equal parameter it takes for none to stray farther than `tolerance`.
pub(super) fn chords(segment: &PathSeg, tolerance: f64) -> f64 {
    // The greatest second derivative bounds how far a chord strays: |B''| / 8 over the number squared.
    let bend = match segment {
        PathSeg::Line(_) => 0.0,
        PathSeg::Quad(c) => 2.0 * bend(c.p0, c.p1, c.p2),
        PathSeg::Cubic(c) => 6.0 * bend(c.p0, c.p1, c.p2).max(bend(c.p1, c.p2, c.p3)),
    };
    libm::ceil(libm::sqrt(bend / (8.0 * tolerance))).max(1.0)
}

/// The stretches from one `MoveTo` to the next.
pub(super) fn parts(path: &BezPath) -> impl Iterator<Item = &[kurbo::PathEl]> {
    let moves = |element: &kurbo::PathEl| matches!(element, kurbo::PathEl::MoveTo(_));
    path.elements().chunk_by(move |_, next| !moves(next))
}

fn bend(a: Point, b: Point, c: Point) -> f64 {
    let (x, y) = (a.x - 2.0 * b.x + c.x, a.y - 2.0 * b.y + c.y);
    libm::sqrt(x * x + y * y)
}

/// Takes a place to (0, 0) and a spacing to 1, a row's height to 1.
fn onto(place: Point2<f64>, spacing: f64) -> Affine {
    let (x, y) = (1.0 / spacing, 1.0 / (spacing * ROW_HEIGHT));
    Affine::new([x, 0.0, 0.0, y, -place.x * x, -place.y * y])
}

impl Paint for Drawing {
    fn bounds(&self) -> (Point2<f64>, Point2<f64>) {
        (self.least, self.greatest)
    }

    fn covers(&self, place: Point2<f64>) -> Result<bool, SketchError> {
        // Only how closely curves are followed depends on this spacing.
        let size = self.greatest - self.least;
        let onto = onto(place, size.x.max(size.y) / 1000.0);
        let mut budget = MOST_PIECES;
        for shape in self.shapes.iter().rev() {
            let winding: i32 = edges(&shape.path, onto, &mut budget)?
                .iter()
                .filter(|e| e.rows().0 <= 0.0 && e.rows().1 > 0.0 && e.crossing(0.0) <= 0.0)
                .map(|e| e.direction())
                .sum();
            if shape.rule.inside(winding) {
                return Ok(!shape.erases);
            }
        }
        Ok(false)
    }

    fn fill(&self, grid: &mut Grid) -> Result<(), SketchError> {
        let onto = onto(grid.origin, grid.spacing);
        let (first, rows) = (f64::from(grid.r(0)), grid.rows() as f64);
        let (mut pieces, mut budget) = (MOST_PIECES, MOST_PIECES);
        let mut crossings: Vec<(u32, i32, f64)> = Vec::new();
        for shape in &self.shapes {
            crossings.clear();
            let mut outline = edges(&shape.path, onto, &mut pieces)?;
            if let Some(warp) = grid.warp {
                outline = flattened(&outline, warp, onto, &mut pieces)?;
            }
            for edge in outline {
                let (from, to) = edge.rows();
                let (from, to) = ((from - first).max(0.0), (to - first).min(rows));
                if from >= to {
                    continue;
                }
                budget = budget.checked_sub((to - from) as usize).ok_or_else(intricate)?;
                crossings.extend(
                    (from as u32..to as u32)
                        .map(|row| (row, edge.direction(), edge.crossing(first + f64::from(row)))),
                );
            }
            crossings.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.2.total_cmp(&b.2)));
            for row in crossings.chunk_by(|a, b| a.0 == b.0) {
                let mut winding = 0;
                for pair in row.windows(2) {
                    winding += pair[0].1;
                    if shape.rule.inside(winding) {
                        let row = pair[0].0 as usize;
                        let columns = column(grid, row, pair[0].2)..column(grid, row, pair[1].2);
                        grid.set(row, columns, !shape.erases);
                    }
                }
            }
        }
        Ok(())
    }
}

/// The first column at a place of the row or right of it.
fn column(grid: &Grid, row: usize, x: f64) -> usize {
    let q = libm::ceil(x - 0.5 * f64::from(grid.r(row))) - f64::from(grid.first_q(row));
    q.clamp(0.0, grid.columns() as f64) as usize
}
