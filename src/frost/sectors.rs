//! Directions from the start, which the paper's outlook (§5) gives vapour of their own: 始点からの各方向毎.

use super::parameters::FrostError;
use crate::hexgrid::{Axial, Region};

/// Parts into which a twelfth of a turn is counted.
const PARTS: u64 = 1 << 32;

/// The cells of a region in equal angular sectors around one of them.
///
/// Sector k of n holds the angles from 360 k/n degrees on and below 360 (k + 1)/n, from +x towards +y, which is
/// clockwise in a picture; the cell in the middle belongs to sector 0. Multiples of 30 degrees are met exactly, and a
/// sector lies wholly in one of any divisor of n.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sectors {
    centre: Axial,
    count: usize,
    of: Vec<u32>,
}

impl Sectors {
    /// The most sectors that are handled.
    pub const MOST: usize = 360;

    /// `count` sectors, 1 to [`MOST`](Self::MOST), around a cell.
    ///
    /// # Errors
    ///
    /// Another count, and a centre outside the region.
    pub fn around(region: &Region, centre: Axial, count: usize) -> Result<Self, FrostError> {
        if !(1..=Self::MOST).contains(&count) {
            let (value, most) = (count as f64, Self::MOST as f64);
            return Err(FrostError::OutOfRange { name: "sectors", value, least: 1.0, most });
        }
        if !region.contains(centre) {
            return Err(FrostError::StartOutside(centre.q, centre.r));
        }
        let sector = |at: &Axial| {
            let angle = angle(Axial::new(at.q - centre.q, at.r - centre.r));
            (angle * count as u64 / (12 * PARTS)) as u32
        };
        Ok(Self { centre, count, of: region.cells().iter().map(sector).collect() })
    }

    /// The cell in the middle.
    pub fn centre(&self) -> Axial {
        self.centre
    }

    /// Number of sectors, n.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Number of cells, in all sectors together.
    pub fn cells(&self) -> usize {
        self.of.len()
    }

    /// The sector of the cell of this ordinal, 0 to n - 1.
    pub fn of(&self, ordinal: usize) -> usize {
        self.of[ordinal] as usize
    }

    /// A number for every cell, by ordinal, from one for every sector.
    ///
    /// # Errors
    ///
    /// Not one number for each sector.
    pub fn field(&self, numbers: &[f64]) -> Result<Vec<f64>, FrostError> {
        if numbers.len() != self.count {
            return Err(FrostError::Count { given: numbers.len(), needed: self.count, each: "sector" });
        }
        Ok(self.of.iter().map(|&sector| numbers[sector as usize]).collect())
    }
}

/// The angle of a point from +x towards +y in `12 * PARTS` parts of a turn, rounded down; 0 for the origin.
fn angle(mut at: Axial) -> u64 {
    if at == Axial::ORIGIN {
        return 0;
    }
    let mut sixth = 0;
    while !(at.q > 0 && at.r >= 0) {
        at = at.rotated();
        sixth = (sixth + 5) % 6;
    }
    // Whole twelfths are found in integers; the rest is the angle from the row, or from the line q = r.
    let (q, r) = (f64::from(at.q), f64::from(at.r));
    let root = 3.0_f64.sqrt();
    let (twelfth, across, along) =
        if at.r < at.q { (2 * sixth, root * r, 2.0 * q + r) } else { (2 * sixth + 1, r - q, root * (q + r)) };
    let share = libm::atan2(across, along) * (6.0 / std::f64::consts::PI);
    twelfth * PARTS + ((share * PARTS as f64) as u64).min(PARTS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(at: Axial) -> f64 {
        let place = at.position();
        libm::atan2(place.y, place.x).to_degrees().rem_euclid(360.0)
    }

    #[test]
    fn a_sector_holds_the_cells_of_its_angles() {
        let region = Region::disc(150);
        let centre = Axial::new(3, -5);
        for count in [1, 2, 3, 5, 6, 7, 12, 24, 360] {
            let sectors = Sectors::around(&region, centre, count).unwrap();
            for (ordinal, at) in region.cells().iter().enumerate() {
                let k = degrees(Axial::new(at.q - centre.q, at.r - centre.r)) * count as f64 / 360.0;
                let sure = (k - k.round()).abs() > 1e-9;
                assert!(!sure || sectors.of(ordinal) == k as usize, "{at:?} of {count}: {k}");
            }
        }
    }

    #[test]
    fn lines_of_the_lattice_begin_their_sector() {
        let region = Region::hexagon(40);
        let sectors = Sectors::around(&region, Axial::ORIGIN, 12).unwrap();
        let sector = |at| sectors.of(region.ordinal(at).unwrap());
        for length in 1..=20 {
            let (mut row, mut between) = (Axial::new(2 * length, 0), Axial::new(length, length));
            for sixth in 0..6 {
                assert_eq!((sector(row), sector(between)), (2 * sixth, 2 * sixth + 1), "{row:?} {between:?}");
                (row, between) = (row.rotated(), between.rotated());
            }
        }
        assert_eq!(sector(Axial::ORIGIN), 0);
        assert_eq!(sector(Axial::new(-1, -2)), 7, "y runs down: above is beyond 180 degrees");
    }

    #[test]
    fn sectors_lie_in_the_sectors_of_a_divisor() {
        let region = Region::disc(400);
        let of = |count| Sectors::around(&region, Axial::new(-7, 2), count).unwrap();
        for (few, many) in [(1, 7), (2, 6), (2, 12), (3, 6), (5, 35), (6, 12), (7, 14), (12, 360)] {
            let (coarse, fine) = (of(few), of(many));
            assert!((0..region.len()).all(|i| coarse.of(i) == fine.of(i) * few / many), "{few} {many}");
        }
    }

    #[test]
    fn angles_far_away_are_in_order() {
        let far = 1 << 28;
        let line: Vec<u64> =
            [0, 1, 2, far / 2, far - 1, far, far + 1].map(|r| angle(Axial::new(far, r))).to_vec();
        assert!(line.is_sorted() && line[0] == 0 && line[5] == PARTS, "{line:?}");
        assert!(angle(Axial::new(far, -1)) < 12 * PARTS);
    }

    #[test]
    fn what_divides_nothing_is_refused() {
        let region = Region::hexagon(2);
        let refused = |centre, count| Sectors::around(&region, centre, count).unwrap_err().to_string();
        assert_eq!(refused(Axial::ORIGIN, 0), "sectors is 0; 1 to 360 is handled");
        assert_eq!(refused(Axial::ORIGIN, 361), "sectors is 361; 1 to 360 is handled");
        assert_eq!(refused(Axial::new(3, 0), 6), "the start 3,0 is outside the region");
        let sectors = Sectors::around(&region, Axial::ORIGIN, 3).unwrap();
        let error = sectors.field(&[0.1, 0.2]).unwrap_err().to_string();
        assert_eq!(error, "2 numbers are given; 3 are needed, one for each sector");
    }
}
