//! Measures of a shape of ice: how lopsided it is, how ragged, and how it fills the plane.

use crate::hexgrid::{Axial, ROW_HEIGHT, Region};

/// Length of one edge of a cell, where neighbouring points are one unit apart: 1/√3.
pub const EDGE_LENGTH: f64 = 0.577_350_269_189_625_8;

/// Share of the shape's images that they do not have in common, 0 to 1: 1 - |intersection| / |union| of the twelve
/// images under turns by 60 degrees and mirrors about `centre`. Exactly 0 for a snow crystal, and for no ice at all.
pub fn asymmetry(ice: &[Axial], centre: Axial) -> f64 {
    let Some(shape) = shape(ice.iter().map(|at| Axial::new(at.q - centre.q, at.r - centre.r))) else {
        return 0.0;
    };
    let (mut common, mut all) = (0, 0);
    for &at in shape.cells() {
        let images = images(at);
        let of_shape = || images.iter().filter(|image| shape.contains(**image));
        if of_shape().min() == Some(&at) {
            // Each set of images once.
            all += images.len();
            if of_shape().count() == images.len() {
                common += images.len();
            }
        }
    }
    1.0 - f64::from(common as u32) / f64::from(all as u32)
}

/// The up to twelve images of a point.
fn images(at: Axial) -> Vec<Axial> {
    let mut images = Vec::with_capacity(12);
    let mut turned = at;
    for _ in 0..6 {
        images.extend([turned, turned.mirrored()]);
        turned = turned.rotated();
    }
    images.sort_unstable();
    images.dedup();
    images
}

/// Length of the boundary over the root of the area, without unit; 0 for no ice.
///
/// The boundary is every edge ([`EDGE_LENGTH`]) between an ice cell and one that is not, inside the region or out; a
/// cell's area is √3/2. A single cell has 2 √3 / √(√3/2) = 3.72, and the more ragged a shape, the more.
pub fn raggedness(ice: &[Axial]) -> f64 {
    let Some(shape) = shape(ice.iter().copied()) else { return 0.0 };
    let edges: usize = shape.cells().iter().map(|&at| open_edges(&shape, at)).sum();
    edges as f64 * EDGE_LENGTH / libm::sqrt(shape.len() as f64 * ROW_HEIGHT)
}

/// Dimension of the boundary by counting boxes; none where it is too small for three sizes.
///
/// The boundary is the positions of the ice cells that touch what is not ice. Boxes are squares of side 2, 4, 8, ...
/// up to a quarter of its greater extent, from its least x and y on; the dimension is minus the slope of the least-squares
/// line through (log side, log number of boxes with a point of it).
pub fn box_dimension(ice: &[Axial]) -> Option<f64> {
    let shape = shape(ice.iter().copied())?;
    let boundary = shape.cells().iter().filter(|at| open_edges(&shape, **at) > 0);
    let points: Vec<(f64, f64)> = boundary.map(|at| (at.position().x, at.position().y)).collect();
    let least = points.iter().fold((f64::MAX, f64::MAX), |l, p| (l.0.min(p.0), l.1.min(p.1)));
    let extent = points.iter().fold(0.0, |e: f64, p| e.max(p.0 - least.0).max(p.1 - least.1));

    let mut counts = Vec::new();
    let mut side = 2.0;
    while side <= extent / 4.0 {
        let number = |x: f64, from: f64| libm::floor((x - from) / side) as i64;
        let mut boxes: Vec<(i64, i64)> =
            points.iter().map(|p| (number(p.0, least.0), number(p.1, least.1))).collect();
        boxes.sort_unstable();
        boxes.dedup();
        counts.push((libm::log(side), libm::log(boxes.len() as f64)));
        side *= 2.0;
    }
    (counts.len() >= 3).then(|| -slope(&counts))
}

/// The slope of the least-squares line.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let sum = points.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    let mean = (sum.0 / n, sum.1 / n);
    let (mut xy, mut xx) = (0.0, 0.0);
    for (x, y) in points {
        xy += (x - mean.0) * (y - mean.1);
        xx += (x - mean.0) * (x - mean.0);
    }
    xy / xx
}

fn open_edges(shape: &Region, at: Axial) -> usize {
    at.neighbours().iter().filter(|q| !shape.contains(**q)).count()
}

/// The ice as a set of points; none where it is empty. Ice lies in a region, so it is no larger than one may be.
fn shape(ice: impl Iterator<Item = Axial>) -> Option<Region> {
    Region::new(ice).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_and_hexagons_are_symmetric_about_their_centre_only() {
        for region in [Region::disc(100), Region::hexagon(5), Region::disc(0)] {
            assert_eq!(asymmetry(region.cells(), Axial::ORIGIN), 0.0);
        }
        let moved: Vec<Axial> =
            Region::disc(9).cells().iter().map(|at| Axial::new(at.q + 3, at.r - 7)).collect();
        assert_eq!(asymmetry(&moved, Axial::new(3, -7)), 0.0);
        assert!(asymmetry(&moved, Axial::new(3, -6)) > 0.1);
        assert_eq!(asymmetry(&[], Axial::ORIGIN), 0.0);
    }

    #[test]
    fn one_arm_more_is_counted_among_the_images() {
        let ice = [Axial::ORIGIN, Axial::new(1, 0)];
        assert_eq!(asymmetry(&ice, Axial::ORIGIN), 1.0 - 1.0 / 7.0);
        // A pinwheel has the turns but not the mirrors.
        let mut wheel = vec![Axial::ORIGIN, Axial::new(2, 1)];
        while wheel.len() < 7 {
            wheel.push(wheel[wheel.len() - 1].rotated());
        }
        assert_eq!(asymmetry(&wheel, Axial::ORIGIN), 1.0 - 1.0 / 13.0);
    }

    #[test]
    fn raggedness_of_one_cell_and_of_seven() {
        let area = |cells: f64| libm::sqrt(cells * ROW_HEIGHT);
        assert!((raggedness(&[Axial::ORIGIN]) - 6.0 * EDGE_LENGTH / area(1.0)).abs() < 1e-15);
        assert!((raggedness(Region::hexagon(1).cells()) - 18.0 * EDGE_LENGTH / area(7.0)).abs() < 1e-15);
        assert_eq!(raggedness(&[]), 0.0);
    }

    #[test]
    fn a_line_has_dimension_one_and_a_field_of_holes_nearly_two() {
        let line: Vec<Axial> = (0..1024).map(|q| Axial::new(q, 0)).collect();
        assert!((box_dimension(&line).unwrap() - 1.0).abs() < 0.02);
        let sieve: Vec<Axial> = Region::hexagon(128)
            .cells()
            .iter()
            .copied()
            .filter(|at| (at.q - at.r).rem_euclid(3) != 0)
            .collect();
        // The large boxes that the outline cuts draw it below 2.
        let dimension = box_dimension(&sieve).unwrap();
        assert!((1.85..2.0).contains(&dimension), "{dimension}");
        assert_eq!(box_dimension(&[Axial::ORIGIN]), None);
        assert_eq!(box_dimension(&[]), None);
    }
}
