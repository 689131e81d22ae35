//! Plateaus: regions of triangles all of whose corners are on contours of one level.
//!
//! The paper does not mention them. A point on the medial axis of such a region (at the middle of a chord, after Prasad's
//! chordal axis) is raised or lowered as the ground around it says: above a summit's contour it goes on rising, but by
//! less than another interval, for then there would be another contour; between two contours, by its distances from them.

use std::collections::BTreeMap;

use spade::Triangulation;
use spade::handles::{DirectedEdgeHandle, FaceHandle, InnerTag};

use super::patches::{Mesh, Vertex};

type Edge<'a> = DirectedEdgeHandle<'a, Vertex, (), spade::CdtEdge<()>, ()>;
type Face<'a> = FaceHandle<'a, InnerTag, Vertex, (), spade::CdtEdge<()>, ()>;

/// A point nearer to its contour than this share of its chord would only make slivers.
const NEAR: f64 = 0.2;

/// What is known about the ground around a plateau.
#[derive(Default)]
struct Around {
    /// Sum of slopes into the region, and of the lengths that they were weighted with.
    slope: f64,
    weight: f64,
    /// The least difference to another level.
    interval: f64,
    /// Corners of sloping triangles that no contour parts from the region.
    open: Vec<Vertex>,
    /// The contour's sides around the region.
    sides: Vec<[[f64; 2]; 2]>,
}

/// The points that raise the plateaus of a triangulation.
pub(super) fn raised(mesh: &Mesh) -> Vec<Vertex> {
    let flat: BTreeMap<usize, Face> =
        mesh.inner_faces().filter(is_flat).map(|face| (face.index(), face)).collect();
    let mut seen = BTreeMap::new();
    let mut points = Vec::new();
    for (&first, &face) in &flat {
        if seen.contains_key(&first) {
            continue;
        }
        let (mut region, mut next) = (Vec::new(), vec![face]);
        seen.insert(first, ());
        while let Some(face) = next.pop() {
            region.push(face);
            for edge in face.adjacent_edges().into_iter().filter(|edge| !is_side(edge)) {
                let beyond = edge.rev().face().as_inner().filter(|beyond| flat.contains_key(&beyond.index()));
                if let Some(beyond) = beyond
                    && seen.insert(beyond.index(), ()).is_none()
                {
                    next.push(beyond);
                }
            }
        }
        region.sort_by_key(Face::index);
        points.extend(raise(&region, &flat));
    }
    points
}

/// The points of one region.
fn raise(region: &[Face], flat: &BTreeMap<usize, Face>) -> Vec<Vertex> {
    let around = around(region, flat);
    let level = region[0].vertices()[0].data().level;
    let mut points = Vec::new();
    let mut add = |place: [f64; 2], chord: f64, contour: usize| {
        let sides = around.sides.iter().map(|[a, b]| off(place, *a, *b));
        let away = sides.fold(f64::INFINITY, f64::min);
        if !away.is_finite() || away < NEAR * chord {
            return;
        }
        if let Some(level) = around.height(level, place, away) {
            points.push(Vertex { place, level, contour });
        }
    };
    for face in region {
        let edges = face.adjacent_edges();
        for edge in edges.iter().filter(|edge| !is_side(edge)) {
            // A chord between two triangles of the region is taken once, one on the hull not at all.
            let Some(beyond) = edge.rev().face().as_inner() else { continue };
            if flat.contains_key(&beyond.index()) && beyond.index() < face.index() {
                continue;
            }
            let [a, b] = edge.vertices().map(|vertex| *vertex.data());
            let middle = [0, 1].map(|axis| 0.5 * (a.place[axis] + b.place[axis]));
            add(middle, apart(a.place, b.place), a.contour);
        }
        if edges.iter().all(is_side) {
            let corners = face.vertices().map(|vertex| *vertex.data());
            let opposite = [0, 1, 2].map(|k| apart(corners[(k + 1) % 3].place, corners[(k + 2) % 3].place));
            let sum: f64 = opposite.iter().sum();
            let incentre =
                [0, 1].map(|axis| (0..3).map(|k| opposite[k] * corners[k].place[axis]).sum::<f64>() / sum);
            add(incentre, 0.0, corners[0].contour);
        }
    }
    points
}

fn around(region: &[Face], flat: &BTreeMap<usize, Face>) -> Around {
    let mut around = Around { interval: f64::INFINITY, ..Around::default() };
    for edge in region.iter().flat_map(|face| face.adjacent_edges()) {
        let [a, b] = edge.vertices().map(|vertex| *vertex.data());
        if is_side(&edge) {
            around.sides.push([a.place, b.place]);
        }
        let Some(beyond) = edge.rev().face().as_inner() else { continue };
        if flat.contains_key(&beyond.index()) {
            continue;
        }
        let Some(third) = edge.rev().opposite_vertex().map(|vertex| *vertex.data()) else { continue };
        if is_side(&edge) {
            let (length, fall) = (apart(a.place, b.place), a.level - third.level);
            around.slope += length * fall / off(third.place, a.place, b.place);
            around.weight += length;
            around.interval = around.interval.min(fall.abs());
        } else {
            around.open.push(third);
        }
    }
    around
}

impl Around {
    /// The height at a place that is so far away from the contour of this level; none where nothing is known.
    fn height(&self, level: f64, place: [f64; 2], away: f64) -> Option<f64> {
        let beyond = |other: &Vertex| apart(place, other.place);
        if let Some(other) = self.open.iter().min_by(|a, b| beyond(a).total_cmp(&beyond(b))) {
            return Some(level + (other.level - level) * away / (away + beyond(other)));
        }
        if self.weight == 0.0 {
            return None;
        }
        let rise = self.slope / self.weight * away;
        Some(level + rise / (1.0 + rise.abs() / self.interval))
    }
}

fn is_flat(face: &Face) -> bool {
    let [a, b, c] = face.vertices().map(|vertex| vertex.data().level);
    a == b && b == c
}

fn is_side(edge: &Edge) -> bool {
    edge.is_constraint_edge()
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// The distance of a point from a segment.
fn off(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let along = way[0] * way[0] + way[1] * way[1];
    let t = (((p[0] - a[0]) * way[0] + (p[1] - a[1]) * way[1]) / along).clamp(0.0, 1.0);
    apart(p, [a[0] + t * way[0], a[1] + t * way[1]])
}

#[cfg(test)]
mod tests {
    use super::super::{Contour, Patches, Plateau};

    fn ring(level: f64, radius: f64) -> Contour {
        let at = |k: i32| libm::sincos(f64::from(k) * std::f64::consts::TAU / 48.0);
        let points = (0..48).map(|k| [2.0 * radius * at(k).1, radius * at(k).0]).collect();
        Contour { name: format!("{level}"), level, dimension: 2.3, points, closed: true }
    }

    /// An elongated hill: the ridge above its highest contour rises, within another interval.
    #[test]
    fn a_summit_rises_and_a_crater_sinks() {
        for (levels, least, most) in [([0.0, 1.0], 1.0, 2.0), ([1.0, 0.0], -1.0, 0.0)] {
            let contours = [ring(levels[0], 4.0), ring(levels[1], 2.0)];
            let printed = Patches::new(&contours, Plateau::AsPrinted).unwrap();
            let raised = Patches::new(&contours, Plateau::Raised).unwrap();
            assert_eq!((printed.flat.len(), printed.raised), (46, 0));
            assert!(raised.raised > 10);
            assert!(raised.flat.len() < 10, "{}", raised.flat.len());
            for corner in &raised.corners[printed.corners.len()..] {
                assert!(corner.base > least && corner.base < most, "{corner:?}");
                assert!(corner.place[1].abs() < 0.3, "on the axis: {corner:?}");
            }
        }
    }

    /// A bay of the lower contour in which triangles have nothing but it: filled by distance to the upper one.
    #[test]
    fn a_bay_lies_between_its_contours() {
        let bay = vec![
            [0.0, 0.0],
            [4.0, 0.0],
            [4.5, 1.0],
            [4.5, 2.0],
            [4.6, 3.0],
            [5.4, 3.0],
            [5.5, 2.0],
            [5.5, 1.0],
            [6.0, 0.0],
            [10.0, 0.0],
            [10.0, 5.0],
            [0.0, 5.0],
        ];
        let shore =
            Contour { name: "shore".to_owned(), level: 1.0, dimension: 2.2, points: bay, closed: true };
        let below = [[-1.0, -2.0], [11.0, -2.0], [11.0, 6.0], [-1.0, 6.0]];
        let sea = Contour {
            name: "sea".to_owned(),
            level: 0.0,
            dimension: 2.2,
            points: below.to_vec(),
            closed: true,
        };
        let patches = Patches::new(&[sea, shore], Plateau::Raised).unwrap();
        let inside: Vec<_> = patches.corners[16..]
            .iter()
            .filter(|c| (4.4..5.6).contains(&c.place[0]) && (0.2..2.9).contains(&c.place[1]))
            .collect();
        assert!(!inside.is_empty());
        assert!(inside.iter().all(|c| c.base < 1.0 && c.base > 0.0), "{inside:?}");
    }

    #[test]
    fn nothing_is_known_above_a_single_contour() {
        let patches = Patches::new(&[ring(1.0, 2.0)], Plateau::Raised).unwrap();
        assert_eq!((patches.raised, patches.flat.len()), (0, 46));
    }
}
