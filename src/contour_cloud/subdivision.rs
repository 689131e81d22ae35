//! Recursive subdivision of triangles with displaced midpoints: §2.2, Eq. (1), Fig. 3.
//!
//! The displacement of a midpoint belongs to its place: the two triangles at an edge move it by the same, to the last
//! bit, whichever is visited first. So the surface has no cracks.

use super::readings::{Amplitude, EdgeLength};
use crate::rng::Moment;

/// A corner of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Its place in the plan.
    pub place: [f64; 2],
    /// Its height, in the unit of the plan.
    pub height: f64,
    /// D around it, the dimension of a surface, 2 to 3.
    pub dimension: f64,
}

/// How midpoints are displaced: Eq. (1).
#[derive(Clone, Debug)]
pub struct Displacement {
    /// The exponent.
    pub amplitude: Amplitude,
    /// What L is.
    pub edge_length: EdgeLength,
    /// What the displacement is multiplied by; 1 as printed.
    pub gain: f64,
    /// The random numbers.
    pub moment: Moment,
}

impl Displacement {
    /// The standard deviation of v over the length of the original edge, at division `n`, the first being 0.
    pub fn relative(&self, n: u32, dimension: f64) -> f64 {
        let exponent = match self.amplitude {
            Amplitude::AsPrinted => dimension - 1.0,
            Amplitude::LineDimension => dimension - 2.0,
            Amplitude::ThreeMinusD => 3.0 - dimension,
        };
        let halved = match self.edge_length {
            EdgeLength::Original => 0.0,
            EdgeLength::Current => f64::from(n),
        };
        self.gain * libm::exp2(-f64::from(n + 1) * exponent - halved)
    }

    /// The displaced midpoint of an edge that is divided for the (n + 1)-th time. D of the midpoint is the mean of the
    /// ends', an assumption: the paper gives none to edges on no contour.
    pub fn midpoint(&self, n: u32, a: &Corner, b: &Corner) -> Corner {
        let mean = |p: f64, q: f64| 0.5 * (p + q);
        let place = [mean(a.place[0], b.place[0]), mean(a.place[1], b.place[1])];
        let [dx, dy] = [a.place[0] - b.place[0], a.place[1] - b.place[1]];
        let original = libm::sqrt(dx * dx + dy * dy) * libm::exp2(f64::from(n));
        let dimension = mean(a.dimension, b.dimension);
        let v = self.relative(n, dimension) * self.moment.normal(place) * original;
        Corner { place, height: mean(a.height, b.height) + v, dimension }
    }
}

/// The four triangles of one, its own orientation kept: three at the corners, then the one in the middle.
pub fn divide(triangle: &[Corner; 3], n: u32, by: &Displacement) -> [[Corner; 3]; 4] {
    let [a, b, c] = triangle;
    let (ab, bc, ca) = (by.midpoint(n, a, b), by.midpoint(n, b, c), by.midpoint(n, c, a));
    [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
}

/// Visits the 4^levels triangles of a patch depth first, keeping none but those on the way.
pub fn visit(patch: &[Corner; 3], levels: u32, by: &Displacement, leaf: &mut impl FnMut(&[Corner; 3])) {
    descend(patch, 0, levels, by, leaf);
}

fn descend(
    triangle: &[Corner; 3],
    n: u32,
    levels: u32,
    by: &Displacement,
    leaf: &mut impl FnMut(&[Corner; 3]),
) {
    if n == levels {
        leaf(triangle);
        return;
    }
    for part in &divide(triangle, n, by) {
        descend(part, n + 1, levels, by, leaf);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::reading::Reading;
    use crate::rng::Seed;

    fn by(amplitude: Amplitude, edge_length: EdgeLength) -> Displacement {
        Displacement { amplitude, edge_length, gain: 1.0, moment: Seed(1).stream("Gauss").at(0) }
    }

    fn corner(x: f64, y: f64, dimension: f64) -> Corner {
        Corner { place: [x, y], height: 0.0, dimension }
    }

    /// Two patches on either side of an edge, turned against each other.
    fn patches(dimension: f64) -> [[Corner; 3]; 2] {
        let [a, b, c, d] = [(0.0, 0.0), (1.0, 0.1), (0.3, 0.9), (1.2, 1.1)];
        let at = |p: (f64, f64)| corner(p.0, p.1, dimension);
        [[at(a), at(b), at(c)], [at(c), at(b), at(d)]]
    }

    /// Height of every corner by its place; a place that were visited with two heights would be a crack.
    #[test]
    fn patches_fit_together_to_the_last_bit() {
        for amplitude in Amplitude::ALL {
            let by = by(*amplitude, EdgeLength::Original);
            let mut heights: BTreeMap<[u64; 2], u64> = BTreeMap::new();
            let mut edges: BTreeMap<[[u64; 2]; 2], u32> = BTreeMap::new();
            let mut leaves = 0;
            for patch in patches(2.4) {
                visit(&patch, 5, &by, &mut |leaf| {
                    leaves += 1;
                    let keys = leaf.map(|corner| corner.place.map(f64::to_bits));
                    for (key, corner) in keys.iter().zip(leaf) {
                        let seen = *heights.entry(*key).or_insert(corner.height.to_bits());
                        assert_eq!(seen, corner.height.to_bits());
                    }
                    for k in 0..3 {
                        let mut edge = [keys[k], keys[(k + 1) % 3]];
                        edge.sort_unstable();
                        *edges.entry(edge).or_default() += 1;
                    }
                });
            }
            assert_eq!(leaves, 2 * 4_u32.pow(5));
            // Watertight: each edge belongs to two triangles but those of the rim, 4 sides of 32 edges.
            assert!(edges.values().all(|count| *count <= 2));
            assert_eq!(edges.values().filter(|count| **count == 1).count(), 4 * 32);
            for corner in patches(2.4).iter().flatten() {
                assert_eq!(heights[&corner.place.map(f64::to_bits)], 0.0_f64.to_bits(), "corners stay");
            }
        }
    }

    /// Displacement is vertical: the plan's triangles are as they would be without, none is turned over.
    #[test]
    fn no_triangle_overhangs() {
        for patch in patches(2.9) {
            let area = |t: &[Corner; 3]| {
                let [a, b, c] = t.map(|corner| corner.place);
                0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
            };
            let whole = area(&patch);
            let by = by(Amplitude::ThreeMinusD, EdgeLength::Original);
            visit(&patch, 6, &by, &mut |leaf| {
                assert!((area(leaf) / whole * 4096.0 - 1.0).abs() < 1e-9);
            });
        }
    }

    /// The slope of log2 rms(v / L) against n is the exponent of Eq. (1) with its sign turned, within 0.03 over levels
    /// with at least 1000 midpoints: the deviation of an rms of m numbers is 1 / sqrt(2 m), 0.022 at most.
    #[test]
    fn displacements_fall_with_the_exponent_that_is_read() {
        for (amplitude, dimension, slope) in [
            (Amplitude::AsPrinted, 2.41, -1.41),
            (Amplitude::AsPrinted, 2.19, -1.19),
            (Amplitude::LineDimension, 2.41, -0.41),
            (Amplitude::ThreeMinusD, 2.41, -0.59),
            (Amplitude::ThreeMinusD, 2.19, -0.81),
        ] {
            let by = by(amplitude, EdgeLength::Original);
            let mut level: Vec<[Corner; 3]> = patches(dimension).to_vec();
            let mut logs = Vec::new();
            for n in 0..8_u32 {
                let (mut sum, mut count) = (0.0, 0_u32);
                for [a, b, _] in &level {
                    let mid = by.midpoint(n, a, b);
                    let length = libm::hypot(a.place[0] - b.place[0], a.place[1] - b.place[1])
                        * libm::exp2(f64::from(n));
                    let v = (mid.height - 0.5 * (a.height + b.height)) / length;
                    (sum, count) = (sum + v * v, count + 1);
                }
                if count >= 1000 {
                    logs.push((f64::from(n), 0.5 * libm::log2(sum / f64::from(count))));
                }
                level = level.iter().flat_map(|t| divide(t, n, &by)).collect();
            }
            let (first, last) = (logs[0], logs[logs.len() - 1]);
            let measured = (last.1 - first.1) / (last.0 - first.0);
            assert!((measured - slope).abs() < 0.03, "{amplitude:?} {dimension}: {measured}");
        }
    }
}
