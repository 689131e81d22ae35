//! The surface: patches, divided again and again, their midpoints displaced (§2.2, Fig. 3).
//!
//! The displacement of a midpoint belongs to its place: the two triangles at an edge move it by the same, to the last
//! bit, whichever is visited first. So the surface has no cracks.

use super::{Displacement, Patches, Relief, Smooth};

/// A corner of the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// Its place in the plan.
    pub place: [f64; 2],
    /// The height of the relief here, in the unit of the plan.
    pub base: f64,
    /// What displacement has added.
    pub rough: f64,
    /// D around it, the dimension of a surface, 2 to 3.
    pub dimension: f64,
}

impl Corner {
    /// Its height, in the unit of the plan.
    #[inline]
    pub fn height(&self) -> f64 {
        self.base + self.rough
    }

    /// The middle between two. Its D is the mean of theirs, an assumption: the paper gives none to edges on no contour.
    #[inline]
    pub fn midway(&self, other: &Self) -> Self {
        let mean = |p: f64, q: f64| 0.5 * (p + q);
        Self {
            place: [mean(self.place[0], other.place[0]), mean(self.place[1], other.place[1])],
            base: mean(self.base, other.base),
            rough: mean(self.rough, other.rough),
            dimension: mean(self.dimension, other.dimension),
        }
    }

    /// Its place and height.
    #[inline]
    pub fn point(&self) -> [f64; 3] {
        [self.place[0], self.place[1], self.height()]
    }
}

/// What a patch's edge bequeaths to the edges within the patch that are parallel to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The length of the patch's edge in the plan: the original L of Eq. (1).
    pub original: f64,
    /// How many times its parts are divided with displacement.
    pub levels: u32,
}

/// A triangle of the surface at some division.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// a, b and c.
    pub corners: [Corner; 3],
    /// Of ab, bc and ca.
    pub edges: [Edge; 3],
}

/// The surface that contours stand for.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The triangles between contours.
    pub patches: Patches,
    /// What is displaced.
    pub relief: Relief,
    /// How.
    pub displacement: Displacement,
}

/// Which edges are fine enough to be left straight.
pub trait Limit {
    /// Whether the edge between two corners, of division `n`, is divided with displacement. It must say the same of an
    /// edge whichever triangle asks, and no of the halves of an edge that it has said no of.
    fn divides(&self, n: u32, from: &Corner, to: &Corner, edge: &Edge) -> bool;
}

/// As many times as the patch's edge says.
#[derive(Clone, Copy, Debug)]
pub struct Levels;

impl Limit for Levels {
    fn divides(&self, n: u32, _: &Corner, _: &Corner, edge: &Edge) -> bool {
        n < edge.levels
    }
}

impl Surface {
    /// A surface for pictures to be looked at rather than compared with the paper's: a smooth ground through the
    /// contours, and patches of one size and shape on it, so that neither the creases nor the slivers of Fig. 2 show.
    /// `side` is the patches' size and so that of the largest billow that displacement makes.
    pub fn smooth(patches: &Patches, side: f64, displacement: Displacement) -> Self {
        let relief = Relief::Smooth(Smooth::new(patches, 257, 1));
        Self { patches: patches.even(side, &displacement.moment), relief, displacement }
    }

    /// A patch, each of its edges to be divided as many times as `levels` says of its length in the plan.
    pub fn piece(&self, patch: usize, levels: impl Fn([f64; 2], [f64; 2]) -> u32) -> Piece {
        let mut corners = self.patches.triangle(patch);
        for corner in &mut corners {
            if let Some(base) = self.relief.height(corner.place) {
                corner.base = base;
            }
        }
        let edges = [0, 1, 2].map(|k| {
            let [from, to] = [corners[k].place, corners[(k + 1) % 3].place];
            let [dx, dy] = [from[0] - to[0], from[1] - to[1]];
            Edge { original: libm::sqrt(dx * dx + dy * dy), levels: levels(from, to) }
        });
        Piece { corners, edges }
    }

    /// The midpoint of an edge that is divided for the (n + 1)-th time, displaced or not.
    pub fn midpoint(&self, n: u32, from: &Corner, to: &Corner, edge: &Edge, displaced: bool) -> Corner {
        let mut middle = from.midway(to);
        if displaced {
            let relative = self.displacement.relative(n, middle.dimension);
            let gauss = self.displacement.moment.normal(middle.place);
            self.displace(&mut middle, relative, edge, gauss);
        }
        middle
    }

    /// Moves a midpoint by v of Eq. (1), given its deviation over the original length and its random number.
    #[inline]
    pub(super) fn displace(&self, middle: &mut Corner, relative: f64, edge: &Edge, gauss: f64) {
        middle.rough += relative * edge.original * gauss;
        if let Some(base) = self.relief.height(middle.place) {
            middle.base = base;
        }
    }

    /// The four triangles of one, its own orientation kept: three at the corners, then the one in the middle.
    pub fn divide(&self, piece: &Piece, n: u32, displaced: [bool; 3]) -> [Piece; 4] {
        let ([a, b, c], [ab, bc, ca]) = (piece.corners, piece.edges);
        let p = self.midpoint(n, &a, &b, &ab, displaced[0]);
        let q = self.midpoint(n, &b, &c, &bc, displaced[1]);
        let r = self.midpoint(n, &c, &a, &ca, displaced[2]);
        // An edge of a part is parallel to the one that it was cut off from, or that it runs beside.
        let part = |corners, edges| Piece { corners, edges };
        [
            part([a, p, r], [ab, bc, ca]),
            part([p, b, q], [ab, bc, ca]),
            part([r, q, c], [ab, bc, ca]),
            part([p, q, r], [ca, ab, bc]),
        ]
    }

    /// Visits the triangles of a patch depth first, keeping none but those on the way. A piece that `seen` does not
    /// want is left out with all that is within it.
    pub fn visit(
        &self,
        piece: &Piece,
        n: u32,
        limit: &impl Limit,
        seen: &impl Fn(&Piece) -> bool,
        leaf: &mut impl FnMut(&[Corner; 3]),
    ) {
        if !seen(piece) {
            return;
        }
        let [a, b, c] = &piece.corners;
        let [ab, bc, ca] = &piece.edges;
        let divides = [limit.divides(n, a, b, ab), limit.divides(n, b, c, bc), limit.divides(n, c, a, ca)];
        if divides == [false; 3] {
            leaf(&piece.corners);
            return;
        }
        for part in &self.divide(piece, n, divides) {
            self.visit(part, n + 1, limit, seen, leaf);
        }
    }

    /// How far above or below the corners of a piece its parts may come, as good as certainly: eight standard deviations of
    /// all displacements that are still to come, and what a relief as steep as 2 may do between corners.
    pub(super) fn reach(&self, piece: &Piece) -> f64 {
        let (mut displaced, mut longest) = (0.0_f64, 0.0_f64);
        for k in 0..3 {
            let (from, to, edge) = (&piece.corners[k], &piece.corners[(k + 1) % 3], &piece.edges[k]);
            let [dx, dy] = [0, 1].map(|axis| to.place[axis] - from.place[axis]);
            let length = libm::sqrt(dx * dx + dy * dy);
            let n = libm::round(libm::log2(edge.original / length)).max(0.0) as u32;
            let dimension = from.dimension.max(to.dimension);
            // A geometric row.
            let [next, after] = [0, 1].map(|more| self.displacement.relative(n + more, dimension).abs());
            let all = if after < next { next / (1.0 - after / next) } else { f64::INFINITY };
            displaced = displaced.max(if next == 0.0 { 0.0 } else { all * edge.original });
            longest = longest.max(length);
        }
        let relief = if matches!(self.relief, Relief::Patches) { 0.0 } else { 2.0 * longest };
        8.0 * displaced + relief
    }

    /// Visits all triangles of all patches, each divided `levels` times, in a fixed order.
    pub fn triangles(&self, levels: u32, leaf: &mut impl FnMut(&[Corner; 3])) {
        for patch in 0..self.patches.triangles.len() {
            self.visit(&self.piece(patch, |_, _| levels), 0, &Levels, &|_| true, leaf);
        }
    }
}

/// The middle of a triangle: M of §3.2.
pub fn centroid(corners: &[Corner; 3]) -> [f64; 3] {
    let points = corners.map(|corner| corner.point());
    [0, 1, 2].map(|axis| (points[0][axis] + points[1][axis] + points[2][axis]) / 3.0)
}

#[cfg(test)]
pub(super) mod tests {
    use std::collections::BTreeMap;

    use super::super::{Amplitude, Contour, EdgeLength, Plateau};
    use super::*;
    use crate::reading::Reading;
    use crate::rng::Seed;

    /// A slanted quadrangle of one level, in two patches.
    pub fn quadrangle(amplitude: Amplitude, edge_length: EdgeLength, dimension: f64) -> Surface {
        let contour = Contour {
            name: "rim".to_owned(),
            level: 0.0,
            dimension,
            points: vec![[0.0, 0.0], [1.0, 0.1], [1.2, 1.1], [0.3, 0.9]],
            closed: true,
        };
        let moment = Seed(1).stream("Gauss").at(0);
        Surface {
            patches: Patches::new(&[contour], Plateau::AsPrinted).unwrap(),
            relief: Relief::Patches,
            displacement: Displacement { amplitude, edge_length, gain: 1.0, moment },
        }
    }

    fn area(t: &[Corner; 3]) -> f64 {
        let [a, b, c] = t.map(|corner| corner.place);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    }

    type Key = [u64; 2];

    /// Asserts that a place has one height and an edge two triangles, but on the rim; the number of edges there.
    fn rim(leaves: &[[Corner; 3]]) -> usize {
        let mut heights: BTreeMap<Key, u64> = BTreeMap::new();
        let mut edges: BTreeMap<[Key; 2], u32> = BTreeMap::new();
        for leaf in leaves {
            let keys = leaf.map(|corner| corner.place.map(f64::to_bits));
            for (key, corner) in keys.iter().zip(leaf) {
                let bits = corner.height().to_bits();
                assert_eq!(*heights.entry(*key).or_insert(bits), bits, "a crack");
            }
            for k in 0..3 {
                let mut edge = [keys[k], keys[(k + 1) % 3]];
                edge.sort_unstable();
                *edges.entry(edge).or_default() += 1;
            }
        }
        assert!(edges.values().all(|count| *count <= 2));
        edges.values().filter(|count| **count == 1).count()
    }

    #[test]
    fn patches_fit_together_to_the_last_bit() {
        for amplitude in Amplitude::ALL {
            let surface = quadrangle(*amplitude, EdgeLength::Original, 2.4);
            let mut leaves = Vec::new();
            surface.triangles(5, &mut |leaf| leaves.push(*leaf));
            assert_eq!(leaves.len(), 2 * 4_usize.pow(5));
            assert_eq!(rim(&leaves), 4 * 32, "4 sides of 32 edges");
            for corner in leaves
                .iter()
                .flatten()
                .filter(|c| surface.patches.corners.iter().any(|given| given.place == c.place))
            {
                assert_eq!(corner.height(), 0.0, "what was given stays");
            }
        }
    }

    /// Where edges are divided by their own length, a triangle may be finer than the one beside it: the corners that
    /// only one of them has lie on the straight edge of the other.
    #[test]
    fn a_finer_triangle_leaves_no_crack() {
        struct Near;
        impl Limit for Near {
            fn divides(&self, n: u32, a: &Corner, b: &Corner, _: &Edge) -> bool {
                let [dx, dy] = [a.place[0] - b.place[0], a.place[1] - b.place[1]];
                let nearest = 0.05 + a.place[0].min(b.place[0]);
                n < 12 && libm::hypot(dx, dy) > 0.3 * nearest
            }
        }
        let surface = quadrangle(Amplitude::ThreeMinusD, EdgeLength::Original, 2.4);
        let mut leaves = Vec::new();
        for patch in 0..2 {
            let piece = surface.piece(patch, |_, _| 0);
            surface.visit(&piece, 0, &Near, &|_| true, &mut |leaf| leaves.push(*leaf));
        }
        let heights: BTreeMap<Key, f64> =
            leaves.iter().flatten().map(|c| (c.place.map(f64::to_bits), c.height())).collect();
        let mut met = 0;
        for leaf in &leaves {
            for k in 0..3 {
                let (a, b) = (leaf[k], leaf[(k + 1) % 3]);
                let mid = [0, 1].map(|axis| 0.5 * (a.place[axis] + b.place[axis]));
                if let Some(height) = heights.get(&mid.map(f64::to_bits)) {
                    assert_eq!(*height, 0.5 * (a.rough + b.rough), "on the edge");
                    met += 1;
                }
            }
        }
        assert!(met > 20, "{met}");
        let whole: f64 = (0..2).map(|patch| area(&surface.patches.triangle(patch))).sum();
        assert!((leaves.iter().map(area).sum::<f64>() / whole - 1.0).abs() < 1e-12);
    }

    /// Displacement is vertical: the plan's triangles are as they would be without, none is turned over.
    #[test]
    fn no_triangle_overhangs() {
        let surface = quadrangle(Amplitude::ThreeMinusD, EdgeLength::Original, 2.9);
        for patch in 0..2 {
            let piece = surface.piece(patch, |_, _| 6);
            let whole = area(&piece.corners);
            surface.visit(&piece, 0, &Levels, &|_| true, &mut |leaf| {
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
            let surface = quadrangle(amplitude, EdgeLength::Original, dimension);
            let mut level: Vec<Piece> = (0..2).map(|patch| surface.piece(patch, |_, _| 9)).collect();
            let mut logs = Vec::new();
            for n in 0..8_u32 {
                let (mut sum, mut count) = (0.0, 0_u32);
                for piece in &level {
                    let [a, b, _] = &piece.corners;
                    let mid = surface.midpoint(n, a, b, &piece.edges[0], true);
                    let v = (mid.rough - 0.5 * (a.rough + b.rough)) / piece.edges[0].original;
                    (sum, count) = (sum + v * v, count + 1);
                    let [dx, dy] = [a.place[0] - b.place[0], a.place[1] - b.place[1]];
                    let length = libm::hypot(dx, dy) * libm::exp2(f64::from(n));
                    assert!((piece.edges[0].original / length - 1.0).abs() < 1e-9, "parallel to its own");
                }
                if count >= 1000 {
                    logs.push((f64::from(n), 0.5 * libm::log2(sum / f64::from(count))));
                }
                level = level.iter().flat_map(|piece| surface.divide(piece, n, [true; 3])).collect();
            }
            let (first, last) = (logs[0], logs[logs.len() - 1]);
            let measured = (last.1 - first.1) / (last.0 - first.0);
            assert!((measured - slope).abs() < 0.03, "{amplitude:?} {dimension}: {measured}");
        }
    }
}
