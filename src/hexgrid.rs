//! The triangular lattice of points whose cells are regular hexagons, in axial coordinates.
//!
//! A point (q, r) lies at x = q + r/2, y = r √3/2 when neighbouring points are one unit apart; y runs down, as in a
//! picture. A [`Region`] is a finite set of points; the [ring](Region::ring) around it is where boundary conditions live.

use std::collections::VecDeque;

use nalgebra::{Point2, point};

/// √3 / 2, the height of one row.
pub const ROW_HEIGHT: f64 = 0.866_025_403_784_438_6;

/// A point of the lattice, or the hexagon around it.
///
/// The order is that of a page: by row, then along the row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Axial {
    /// Along the row.
    pub q: i32,
    /// The row.
    pub r: i32,
}

impl PartialOrd for Axial {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Axial {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        (self.r, self.q).cmp(&(other.r, other.q))
    }
}

/// The six steps to a neighbour, in turning order; steps `k` and `k + 3` are opposite.
pub const STEPS: [(i32, i32); 6] = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)];

impl Axial {
    /// The point where lattices begin.
    pub const ORIGIN: Axial = Axial { q: 0, r: 0 };

    /// The point at (q, r).
    pub const fn new(q: i32, r: i32) -> Self {
        Self { q, r }
    }

    /// The six neighbours, in the order of [`STEPS`].
    pub fn neighbours(self) -> [Axial; 6] {
        STEPS.map(|(q, r)| Axial::new(self.q + q, self.r + r))
    }

    /// Squared Euclidean distance from the origin, q² + qr + r².
    pub fn norm(self) -> i64 {
        let (q, r) = (i64::from(self.q), i64::from(self.r));
        q * q + q * r + r * r
    }

    /// Turned by 60 degrees about the origin.
    pub fn rotated(self) -> Axial {
        Axial::new(-self.r, self.q + self.r)
    }

    /// Reflected in the row through the origin's neighbour (1, 0).
    pub fn mirrored(self) -> Axial {
        Axial::new(self.q + self.r, -self.r)
    }

    /// Where the point lies in the plane; neighbouring points are one unit apart.
    pub fn position(self) -> Point2<f64> {
        point![f64::from(self.q) + 0.5 * f64::from(self.r), ROW_HEIGHT * f64::from(self.r)]
    }

    /// The point whose hexagon contains a place of the plane (the inverse of [`position`](Axial::position)).
    pub fn containing(place: Point2<f64>) -> Axial {
        let r = place.y / ROW_HEIGHT;
        let q = place.x - 0.5 * r;
        // Round the three cube coordinates, then mend the one that moved furthest.
        let (rq, rr, rs) = (libm::round(q), libm::round(r), libm::round(-q - r));
        let (dq, dr, ds) = ((rq - q).abs(), (rr - r).abs(), (rs + q + r).abs());
        if dq > dr && dq > ds {
            Axial::new((-rr - rs) as i32, rr as i32)
        } else if dr > ds {
            Axial::new(rq as i32, (-rq - rs) as i32)
        } else {
            Axial::new(rq as i32, rr as i32)
        }
    }
}

/// Why a set of points is not a region.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionError {
    /// There is no point in it.
    #[error("the region is empty; at least one cell is needed")]
    Empty,
    /// Its bounding box, in axial coordinates, holds more points than are handled.
    #[error("the region spans {columns} x {rows} cells; at most {} in all are handled", Region::MOST)]
    TooWide {
        /// Extent in q.
        columns: i64,
        /// Extent in r.
        rows: i64,
    },
    /// A coordinate is so large that its neighbours cannot be counted.
    #[error("the cell {0},{1} is further out than {limit}", limit = Region::FURTHEST)]
    TooFar(i32, i32),
}

/// A rectangle of axial coordinates, both ends inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// Least q and r.
    pub least: Axial,
    /// Greatest q and r.
    pub greatest: Axial,
}

impl Bounds {
    /// Number of columns (q).
    pub fn columns(&self) -> usize {
        (self.greatest.q - self.least.q) as usize + 1
    }

    /// Number of rows (r).
    pub fn rows(&self) -> usize {
        (self.greatest.r - self.least.r) as usize + 1
    }

    /// Position in a row-major array of the rectangle, if the point is inside.
    pub fn index(&self, at: Axial) -> Option<usize> {
        let inside = (self.least.q..=self.greatest.q).contains(&at.q)
            && (self.least.r..=self.greatest.r).contains(&at.r);
        inside.then(|| (at.r - self.least.r) as usize * self.columns() + (at.q - self.least.q) as usize)
    }
}

/// A finite set of points: connected or not, with holes or without.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    cells: Vec<Axial>,
    bounds: Bounds,
    // Ordinal of each cell in `cells`, over the bounds; `NONE` outside.
    ordinals: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Region {
    /// The largest bounding box that is handled, in points.
    pub const MOST: i64 = 1 << 26;
    /// The largest coordinate that is handled.
    pub const FURTHEST: i32 = 1 << 28;

    /// The region of these cells; a cell named twice counts once.
    pub fn new(cells: impl IntoIterator<Item = Axial>) -> Result<Self, RegionError> {
        let mut cells: Vec<Axial> = cells.into_iter().collect();
        cells.sort_unstable();
        cells.dedup();
        let (Some(first), Some(last)) = (cells.first(), cells.last()) else {
            return Err(RegionError::Empty);
        };
        if let Some(far) = cells.iter().find(|c| {
            c.q.unsigned_abs() > Self::FURTHEST as u32 || c.r.unsigned_abs() > Self::FURTHEST as u32
        }) {
            return Err(RegionError::TooFar(far.q, far.r));
        }
        let least_q = cells.iter().map(|c| c.q).min().unwrap_or(0);
        let greatest_q = cells.iter().map(|c| c.q).max().unwrap_or(0);
        let bounds = Bounds { least: Axial::new(least_q, first.r), greatest: Axial::new(greatest_q, last.r) };
        let (columns, rows) = (bounds.columns() as i64, bounds.rows() as i64);
        if columns * rows > Self::MOST {
            return Err(RegionError::TooWide { columns, rows });
        }
        let mut ordinals = vec![NONE; bounds.columns() * bounds.rows()];
        for (ordinal, cell) in cells.iter().enumerate() {
            if let Some(index) = bounds.index(*cell) {
                ordinals[index] = ordinal as u32;
            }
        }
        Ok(Self { cells, bounds, ordinals })
    }

    /// The disc q² + qr + r² <= `norm` around the origin: round in the plane.
    pub fn disc(norm: u32) -> Self {
        let reach = libm::ceil(2.0 * libm::sqrt(f64::from(norm) / 3.0)) as i32;
        Self::filled(reach, |at| at.norm() <= i64::from(norm))
    }

    /// The hexagon of points at most `radius` steps from the origin.
    pub fn hexagon(radius: u16) -> Self {
        let radius = i32::from(radius);
        Self::filled(radius, |at| (at.q + at.r).abs() <= radius)
    }

    /// The rectangle |x| <= `half_width`, |y| <= `half_height` around the origin, in spacings of the lattice.
    ///
    /// # Panics
    ///
    /// If a half is negative, not finite or above 4000.
    pub fn rectangle(half_width: f64, half_height: f64) -> Self {
        assert!((0.0..=4000.0).contains(&half_width) && (0.0..=4000.0).contains(&half_height));
        let rows = libm::floor(half_height / ROW_HEIGHT) as i32;
        // A row's x is q + r/2.
        let reach = libm::ceil(half_width) as i32 + rows / 2 + 1;
        Self::filled(reach.max(rows), |at| at.r.abs() <= rows && at.position().x.abs() <= half_width)
    }

    fn filled(reach: i32, inside: impl Fn(Axial) -> bool) -> Self {
        let cells = (-reach..=reach)
            .flat_map(|r| (-reach..=reach).map(move |q| Axial::new(q, r)))
            .filter(|at| inside(*at));
        Self::new(cells).expect("the origin is inside, and 16 bits of radius fit")
    }

    /// The cells, in page order.
    pub fn cells(&self) -> &[Axial] {
        &self.cells
    }

    /// Number of cells, at least one.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// The smallest rectangle of axial coordinates around the cells.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Position of a cell in [`cells`](Region::cells).
    pub fn ordinal(&self, at: Axial) -> Option<usize> {
        let ordinal = self.ordinals[self.bounds.index(at)?];
        (ordinal != NONE).then_some(ordinal as usize)
    }

    /// Whether the point is a cell of the region.
    pub fn contains(&self, at: Axial) -> bool {
        self.ordinal(at).is_some()
    }

    /// The points outside that touch the region, one layer deep, in page order (holes have a ring too).
    pub fn ring(&self) -> Vec<Axial> {
        let mut ring: Vec<Axial> =
            self.cells.iter().flat_map(|c| c.neighbours()).filter(|at| !self.contains(*at)).collect();
        ring.sort_unstable();
        ring.dedup();
        ring
    }

    /// Ordinals of the cells that touch the ring: the edge of the sketch.
    pub fn border(&self) -> Vec<usize> {
        (0..self.len()).filter(|&i| self.cells[i].neighbours().iter().any(|at| !self.contains(*at))).collect()
    }

    /// For each cell the number of its connected piece, counted from 0 in page order.
    pub fn pieces(&self) -> Vec<usize> {
        let mut piece = vec![usize::MAX; self.len()];
        let mut count = 0;
        for first in 0..self.len() {
            if piece[first] != usize::MAX {
                continue;
            }
            let mut queue = VecDeque::from([first]);
            piece[first] = count;
            while let Some(i) = queue.pop_front() {
                for neighbour in self.cells[i].neighbours().iter().filter_map(|at| self.ordinal(*at)) {
                    if piece[neighbour] == usize::MAX {
                        piece[neighbour] = count;
                        queue.push_back(neighbour);
                    }
                }
            }
            count += 1;
        }
        piece
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_turns_and_two_mirrors_come_back() {
        let at = Axial::new(5, -2);
        assert_eq!((0..6).fold(at, |p, _| p.rotated()), at);
        assert_eq!(at.mirrored().mirrored(), at);
        assert_eq!(at.rotated().norm(), at.norm());
        assert_eq!(at.mirrored().norm(), at.norm());
    }

    #[test]
    fn neighbours_are_one_unit_away_and_opposite_in_pairs() {
        for (k, n) in Axial::ORIGIN.neighbours().into_iter().enumerate() {
            let p = n.position();
            assert!(((p.x * p.x + p.y * p.y) - 1.0).abs() < 1e-15);
            let o = Axial::ORIGIN.neighbours()[(k + 3) % 6];
            assert_eq!((n.q + o.q, n.r + o.r), (0, 0));
        }
    }

    #[test]
    fn a_place_belongs_to_the_nearest_point() {
        for i in 0..2000 {
            let place = point![f64::from(i % 53) * 0.173 - 4.0, f64::from(i % 71) * 0.119 - 4.0];
            let at = Axial::containing(place);
            let d = (at.position() - place).norm_squared();
            for n in at.neighbours() {
                assert!(d <= (n.position() - place).norm_squared() + 1e-12);
            }
        }
    }

    #[test]
    fn a_rectangle_has_the_rows_and_columns_that_fit() {
        let region = Region::rectangle(2.5, 1.8);
        let row = |r: i32| region.cells().iter().filter(|at| at.r == r).count();
        assert_eq!([-3, -2, -1, 0, 1, 2, 3].map(row), [0, 5, 6, 5, 6, 5, 0]);
        assert_eq!(Region::rectangle(0.0, 0.0).cells(), [Axial::ORIGIN]);
        let wide = Region::rectangle(40.0, 3.0);
        assert!(wide.cells().iter().all(|at| wide.contains(Axial::new(-at.q, -at.r))));
    }

    #[test]
    fn discs_and_hexagons_have_as_many_cells_as_they_should() {
        assert_eq!(Region::disc(576).len(), 2083);
        assert_eq!(Region::disc(1444).len(), 5239);
        assert_eq!(Region::hexagon(31).len(), 1 + 3 * 31 * 32);
        assert_eq!(Region::disc(0).len(), 1);
    }

    #[test]
    fn a_hole_has_a_ring_and_two_pieces_are_told_apart() {
        let hollow = Region::new(Axial::ORIGIN.neighbours()).unwrap();
        assert!(hollow.ring().contains(&Axial::ORIGIN));
        assert_eq!(hollow.ring().len(), 13);
        assert_eq!(hollow.border().len(), 6);
        let two = Region::new([Axial::new(0, 0), Axial::new(1, 0), Axial::new(4, 0)]).unwrap();
        assert_eq!(two.pieces(), [0, 0, 1]);
    }

    #[test]
    fn what_is_no_region_is_refused_before_memory_is_asked_for() {
        assert_eq!(Region::new([]), Err(RegionError::Empty));
        assert!(matches!(
            Region::new([Axial::new(0, 0), Axial::new(1 << 20, 1 << 20)]),
            Err(RegionError::TooWide { .. })
        ));
        assert!(matches!(Region::new([Axial::new(i32::MAX, 0)]), Err(RegionError::TooFar(..))));
    }
}
