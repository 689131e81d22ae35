//! Lattice points laid over paint.

use std::ops::Range;

use nalgebra::{Point2, point};

use super::{Bend, MOST_CELLS, MOST_STARTS, Placement, Sketch, SketchError, Warp};
use crate::hexgrid::{Axial, ROW_HEIGHT, Region};

/// Something painted, in sketch units.
pub(super) trait Paint {
    /// Opposite corners of the box around it, least first.
    fn bounds(&self) -> (Point2<f64>, Point2<f64>);
    /// Whether a place is painted.
    fn covers(&self, place: Point2<f64>) -> Result<bool, SketchError>;
    /// Marks the points of the grid that are painted.
    fn fill(&self, grid: &mut Grid) -> Result<(), SketchError>;
}

/// The lattice points in a rectangle of the sketch, row by row, painted or not.
pub(super) struct Grid<'w> {
    pub origin: Point2<f64>,
    pub spacing: f64,
    /// Between the plane of the grid and the sketch.
    pub warp: Option<&'w Warp>,
    // x of the left side, in spacings from the origin.
    left: f64,
    first_row: i32,
    columns: usize,
    painted: Vec<bool>,
}

/// The plane on which the lattice is regular, and what of it is laid out.
struct Sheet<'w> {
    warp: Option<&'w Warp>,
    origin: Point2<f64>,
    least: Point2<f64>,
    greatest: Point2<f64>,
}

impl<'w> Sheet<'w> {
    /// The part that comes to lie on the paint, around the place that comes to lie at `anchor`.
    fn under(paint: &impl Paint, anchor: Point2<f64>, warp: Option<&'w Warp>) -> Self {
        let (least, greatest) = paint.bounds();
        let Some(flatten) = warp else { return Self { warp, origin: anchor, least, greatest } };
        // What is inside the box stays inside its image, so that walking around it is enough.
        const STEPS: u32 = 512;
        let corners = [least, point![greatest.x, least.y], greatest, point![least.x, greatest.y], least];
        let mut near = flatten.invert(least, least);
        let mut sheet = Self { warp, origin: flatten.invert(anchor, anchor), least: near, greatest: near };
        let mut longest: f64 = 0.0;
        for side in corners.windows(2) {
            for step in 1..=STEPS {
                let at = side[0] + (side[1] - side[0]) * (f64::from(step) / f64::from(STEPS));
                let place = flatten.invert(at, near);
                longest = longest.max((place - near).norm());
                near = place;
                sheet.least = sheet.least.inf(&near);
                sheet.greatest = sheet.greatest.sup(&near);
            }
        }
        let room = nalgebra::vector![longest, longest];
        Self { least: sheet.least - room, greatest: sheet.greatest + room, ..sheet }
    }
}

impl<'w> Grid<'w> {
    fn over(sheet: &Sheet<'w>, spacing: f64) -> Result<Self, SketchError> {
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(SketchError::Spacing(spacing));
        }
        let Sheet { warp, origin, least, greatest } = *sheet;
        let left = (least.x - origin.x) / spacing;
        let top = libm::floor((least.y - origin.y) / (spacing * ROW_HEIGHT));
        let columns = libm::ceil((greatest.x - least.x) / spacing) + 2.0;
        let rows = libm::ceil((greatest.y - origin.y) / (spacing * ROW_HEIGHT)) - top + 1.0;
        // Further out than this a row's number and its shear no longer fit.
        let reach = f64::from(Region::FURTHEST) / 4.0;
        let near = left.abs() <= reach && top.abs() <= reach && columns <= reach && rows <= reach;
        if !(near && columns * rows <= Region::MOST as f64) {
            return Err(SketchError::TooFine { spacing });
        }
        let (columns, rows) = (columns as usize, rows as usize);
        let painted = vec![false; columns * rows];
        Ok(Self { origin, spacing, warp, left, first_row: top as i32, columns, painted })
    }

    pub fn rows(&self) -> usize {
        self.painted.len() / self.columns
    }

    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The lattice row's r.
    pub fn r(&self, row: usize) -> i32 {
        self.first_row + row as i32
    }

    /// The q of the row's first column, left of the rectangle or on its side.
    pub fn first_q(&self, row: usize) -> i32 {
        libm::floor(self.left - 0.5 * f64::from(self.r(row))) as i32
    }

    /// In sketch units.
    pub fn position(&self, row: usize, column: usize) -> Point2<f64> {
        let at = Axial::new(self.first_q(row) + column as i32, self.r(row));
        let flat = self.origin + at.position().coords * self.spacing;
        self.warp.map_or(flat, |warp| warp.apply(flat))
    }

    pub fn set(&mut self, row: usize, columns: Range<usize>, painted: bool) {
        let row = &mut self.painted[row * self.columns..(row + 1) * self.columns];
        if let Some(stretch) = row.get_mut(columns) {
            stretch.fill(painted);
        }
    }

    fn count(&self) -> usize {
        self.painted.iter().filter(|p| **p).count()
    }

    fn region(&self) -> Result<Region, SketchError> {
        let cells = self.count();
        if cells > MOST_CELLS {
            return Err(SketchError::TooManyCells { cells });
        }
        if cells == 0 {
            return Err(SketchError::NoCells { spacing: self.spacing });
        }
        let cells = (0..self.rows()).flat_map(|row| {
            let (r, q) = (self.r(row), self.first_q(row));
            let painted = &self.painted[row * self.columns..(row + 1) * self.columns];
            let columns = painted.iter().enumerate().filter(|(_, p)| **p);
            columns.map(move |(column, _)| Axial::new(q + column as i32, r))
        });
        Ok(Region::new(cells)?)
    }
}

/// Places the lattice on the paint and the starts in the region.
pub(super) fn lay(
    paint: &impl Paint,
    starts: &[Point2<f64>],
    placement: Placement,
    bend: Option<Bend>,
) -> Result<Sketch, SketchError> {
    if starts.len() > MOST_STARTS {
        return Err(SketchError::TooManyStarts);
    }
    let (least, greatest) = paint.bounds();
    let origin = starts.first().copied().unwrap_or_else(|| nalgebra::center(&least, &greatest));
    let warp = bend.map(|bend| Warp::around(least, greatest, bend)).transpose()?;
    let sheet = Sheet::under(paint, origin, warp.as_ref());
    let filled = |spacing: f64| -> Result<Grid, SketchError> {
        let mut grid = Grid::over(&sheet, spacing)?;
        paint.fill(&mut grid)?;
        Ok(grid)
    };
    let size = greatest - least;
    let grid = match placement {
        Placement::Across(number) => filled(size.x.max(size.y) / f64::from(number))?,
        Placement::Spacing(spacing) => filled(spacing)?,
        Placement::Points(number) => {
            if !(1..=MOST_CELLS).contains(&number) {
                return Err(SketchError::Points(number));
            }
            let area = size.x * size.y;
            // A warp costs: the forty are eight then, which come as near in all but a tiny sketch.
            let fine = if warp.is_some() { 0 } else { 16 };
            filled(search(number, area, fine, |spacing| Ok(filled(spacing)?.count()))?)?
        }
    };
    let outside = |i: usize| SketchError::StartOutside { number: i + 1, x: starts[i].x, y: starts[i].y };
    let region = match grid.region() {
        // The first start is a lattice point: with no cell at all, it cannot be in the paint.
        Err(SketchError::NoCells { .. }) if !starts.is_empty() => return Err(outside(0)),
        other => other?,
    };
    let mut cells = Vec::new();
    for (i, start) in starts.iter().enumerate() {
        let cell = snap(paint, &region, &grid, *start)?.ok_or_else(|| outside(i))?;
        if !cells.contains(&cell) {
            cells.push(cell);
        }
    }
    let (spacing, origin) = (grid.spacing, grid.origin);
    Ok(Sketch { region, starts: cells, spacing, origin, warp })
}

/// The cell for a start: its own, or the nearest one at most two spacings away if the start is in the paint.
fn snap(
    paint: &impl Paint,
    region: &Region,
    grid: &Grid,
    start: Point2<f64>,
) -> Result<Option<Axial>, SketchError> {
    let flat = grid.warp.map_or(start, |warp| warp.invert(start, start));
    let place = Point2::from((flat - grid.origin) / grid.spacing);
    let own = Axial::containing(place);
    if region.contains(own) {
        return Ok(Some(own));
    }
    if !paint.covers(start)? {
        return Ok(None);
    }
    let near = (-3..=3).flat_map(|r| (-3..=3).map(move |q| (q, r)));
    let away = |at: &Axial| (at.position() - place).norm_squared();
    Ok(near
        .filter_map(|(q, r)| Some(Axial::new(own.q.checked_add(q)?, own.r.checked_add(r)?)))
        .filter(|at| region.contains(*at) && away(at) <= 4.0)
        .min_by(|a, b| away(a).total_cmp(&away(b)).then(a.cmp(b))))
}

/// The spacing whose count comes nearest to `number`; of equals the one tried first.
fn search(
    number: usize,
    box_area: f64,
    fine: u32,
    count: impl Fn(f64) -> Result<usize, SketchError>,
) -> Result<f64, SketchError> {
    let goal = number as f64;
    // A lattice of this spacing has so many points in the box; finer ones until some fall in the paint.
    let mut spacing = libm::sqrt(box_area / (ROW_HEIGHT * goal));
    let mut best = (usize::MAX, spacing);
    let attempt = |spacing: f64, best: &mut (usize, f64)| -> Result<f64, SketchError> {
        let found = count(spacing)?;
        let miss = found.abs_diff(number);
        if miss < best.0 {
            *best = (miss, spacing);
        }
        Ok(found as f64)
    };
    for _ in 0..8 {
        let found = attempt(spacing, &mut best)?;
        if best.0 == 0 {
            return Ok(best.1);
        }
        // The count goes as the inverse square of the spacing.
        spacing *= if found > 0.0 { libm::sqrt(found / goal) } else { 0.5 };
    }
    // Then one cell up and down at a time, where the edge of the paint lets it.
    let middle = best.1;
    for k in 1..=fine {
        for side in [1.0, -1.0] {
            attempt(middle / (1.0 + side * f64::from(k) / (32.0 + 2.0 * goal)), &mut best)?;
            if best.0 == 0 {
                return Ok(best.1);
            }
        }
    }
    Ok(best.1)
}
