//! Regions of a black and white picture, and the dimension of their outlines from perimeters and areas: P ~ A^(D/2)
//! (Mandelbrot 1977; of clouds and rain Lovejoy, *Area-perimeter relation for rain and cloud areas*, Science 216, 1982).
//!
//! It takes regions of many sizes, seen at one resolution. Of one region at many resolutions it says nothing.

/// A region of a picture: what hangs together along rows and columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Region {
    /// Its pixels.
    pub area: u64,
    /// Pixels outside that have one of its own beside them, within its holes too. It is the perimeter of Schneider &
    /// Wöhlke, *Simplified model for fractal dimension of clouds*, Physica A 189, 1992.
    pub neighbours: u64,
    /// Sides of its pixels that the outside is beyond.
    pub edges: u64,
    /// Whether it comes to the picture's border, so that its size is not known.
    pub cut: bool,
}

/// The regions of a picture, row by row from the top, in the order in which they are met. Beyond the border is outside.
///
/// # Panics
///
/// If the picture is no whole number of rows.
pub fn regions(mask: &[bool], width: usize) -> Vec<Region> {
    assert!(width > 0 && mask.len().is_multiple_of(width), "whole rows");
    let sides = Sides { width, height: mask.len() / width };
    let mut found = vec![0_u32; mask.len()];
    // By which region an outer pixel was counted last; beyond the border each pixel has but one neighbour.
    let mut counted = vec![0_u32; mask.len()];
    let (mut all, mut stack) = (Vec::new(), Vec::new());
    for start in 0..mask.len() {
        if !mask[start] || found[start] > 0 {
            continue;
        }
        let mut region = Region::default();
        let number = all.len() as u32 + 1;
        found[start] = number;
        stack.push(start);
        while let Some(pixel) = stack.pop() {
            region.area += 1;
            for beside in sides.of(pixel) {
                match beside {
                    Some(beside) if mask[beside] => {
                        if found[beside] == 0 {
                            found[beside] = number;
                            stack.push(beside);
                        }
                    }
                    Some(beside) => {
                        region.edges += 1;
                        region.neighbours += u64::from(counted[beside] != number);
                        counted[beside] = number;
                    }
                    None => {
                        region.edges += 1;
                        region.neighbours += 1;
                        region.cut = true;
                    }
                }
            }
        }
        all.push(region);
    }
    all
}

/// All of a picture as one region, however many pieces it is in; none of a picture without any.
pub fn whole(mask: &[bool], width: usize) -> Option<Region> {
    assert!(width > 0 && mask.len().is_multiple_of(width), "whole rows");
    let sides = Sides { width, height: mask.len() / width };
    let mut region = Region::default();
    for (pixel, inside) in mask.iter().enumerate() {
        let beside = sides.of(pixel);
        if *inside {
            region.area += 1;
            let beyond = beside.iter().filter(|beside| beside.is_none()).count() as u64;
            region.edges += beside.iter().flatten().filter(|beside| !mask[**beside]).count() as u64 + beyond;
            region.neighbours += beyond;
            region.cut |= beyond > 0;
        } else {
            region.neighbours += u64::from(beside.iter().flatten().any(|beside| mask[*beside]));
        }
    }
    (region.area > 0).then_some(region)
}

struct Sides {
    width: usize,
    height: usize,
}

impl Sides {
    /// The pixels to the left and right, above and beneath; none beyond the border.
    fn of(&self, pixel: usize) -> [Option<usize>; 4] {
        let (x, y) = (pixel % self.width, pixel / self.width);
        [
            (x > 0).then(|| pixel - 1),
            (x + 1 < self.width).then(|| pixel + 1),
            (y > 0).then(|| pixel - self.width),
            (y + 1 < self.height).then(|| pixel + self.width),
        ]
    }
}

/// A dimension from perimeters and areas.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlines {
    /// D: twice the slope of log P over log A.
    pub dimension: f64,
    /// Mean log2 of area and of perimeter in each class of areas.
    pub classes: Vec<(f64, f64)>,
}

/// Fewest classes of areas from which D is told, each twice as large as the one before: a decade and a half.
pub const FEWEST_CLASSES: usize = 5;
/// Fewest regions of a class.
pub const FEWEST_REGIONS: usize = 3;

/// D from pairs of area and perimeter, areas from `least` on; none where there are too few of too few sizes.
///
/// Small regions are many, large ones few: each class of areas counts once, a line of least squares goes through their
/// means. Below some twenty pixels a region's outline is that of its pixels; `least` keeps those out.
pub fn outline_dimension(pairs: impl IntoIterator<Item = (u64, u64)>, least: u64) -> Option<Outlines> {
    // Of each class the number, and the sums of the logarithms.
    let mut classes: Vec<(usize, f64, f64)> = Vec::new();
    for (area, perimeter) in pairs {
        if area < least.max(1) || perimeter == 0 {
            continue;
        }
        let class = (area / least.max(1)).ilog2() as usize;
        if classes.len() <= class {
            classes.resize(class + 1, (0, 0.0, 0.0));
        }
        let (number, a, p) = &mut classes[class];
        *number += 1;
        *a += libm::log2(area as f64);
        *p += libm::log2(perimeter as f64);
    }
    let classes: Vec<(f64, f64)> = classes
        .into_iter()
        .filter(|(number, _, _)| *number >= FEWEST_REGIONS)
        .map(|(number, a, p)| (a / number as f64, p / number as f64))
        .collect();
    if classes.len() < FEWEST_CLASSES {
        return None;
    }
    let count = classes.len() as f64;
    let (x, y) = classes.iter().fold((0.0, 0.0), |(x, y), class| (x + class.0 / count, y + class.1 / count));
    let (mut xx, mut xy) = (0.0, 0.0);
    for class in &classes {
        (xx, xy) = (xx + (class.0 - x) * (class.0 - x), xy + (class.0 - x) * (class.1 - y));
    }
    Some(Outlines { dimension: 2.0 * xy / xx, classes })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(rows: &[&str]) -> (Vec<bool>, usize) {
        (rows.iter().flat_map(|row| row.bytes().map(|c| c == b'#')).collect(), rows[0].len())
    }

    #[test]
    fn regions_are_counted_by_hand() {
        let (mask, width) = drawn(&[
            ".......", //
            ".###.#.", //
            ".#.#...", //
            ".###..#", //
            ".......",
        ]);
        let found = regions(&mask, width);
        let ring = Region { area: 8, neighbours: 13, edges: 16, cut: false };
        assert_eq!(found[0], ring);
        assert_eq!(found[1], Region { area: 1, neighbours: 4, edges: 4, cut: false });
        assert_eq!(found[2], Region { area: 1, neighbours: 4, edges: 4, cut: true });
        assert_eq!(found.len(), 3);
        // The place between the ring and the pixel beside it is beside both.
        let all = whole(&mask, width).unwrap();
        assert_eq!(all, Region { area: 10, neighbours: 20, edges: 24, cut: true });
    }

    #[test]
    fn corners_do_not_connect() {
        let (mask, width) = drawn(&["#.", ".#"]);
        assert_eq!(regions(&mask, width).len(), 2);
        assert_eq!(whole(&[false; 4], 2), None);
    }

    #[test]
    fn squares_have_outlines_of_dimension_one() {
        let squares = (4_u64..400).map(|side| (side * side, 4 * side));
        let found = outline_dimension(squares, 16).unwrap();
        assert!((found.dimension - 1.0).abs() < 1e-3, "{}", found.dimension);
        assert!(found.classes.len() > 10);
    }

    /// P = A is what lines and dust have.
    #[test]
    fn dust_has_dimension_two_and_few_sizes_none() {
        let dust = (16_u64..4096).map(|area| (area, 4 * area));
        assert!((outline_dimension(dust, 16).unwrap().dimension - 2.0).abs() < 1e-9);
        assert_eq!(outline_dimension((16_u64..200).map(|area| (area, area)), 16), None);
        assert_eq!(outline_dimension([(16, 16), (4096, 300)], 16), None);
        assert_eq!(outline_dimension([], 0), None);
    }
}
