//! Triangular patches between contours: §2.1, Fig. 2.
//!
//! The triangulation of Delaunay, constrained to have every side of every contour as an edge. It covers the convex hull.

use spade::{
    ConstrainedDelaunayTriangulation, DelaunayTriangulation, HasPosition, Intersection,
    LineIntersectionIterator, Point2, PositionInTriangulation, Triangulation,
};

use super::Corner;
use super::plateau;
use super::readings::Plateau;
use crate::rng::Moment;

/// A line of equal density.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// What messages call it.
    pub name: String,
    /// The density, which becomes a height, in the unit of the plan.
    pub level: f64,
    /// D of the surface around it, 2 to 3.
    pub dimension: f64,
    /// Its points, usually its [feature points](super::feature_points), in the plan.
    pub points: Vec<[f64; 2]>,
    /// Whether its last point is joined to its first.
    pub closed: bool,
}

/// Triangles between contours.
#[derive(Clone, Debug, PartialEq)]
pub struct Patches {
    /// Every point of every contour once, then the points that plateaus were raised by.
    pub corners: Vec<Corner>,
    /// The sides of the contours: two corners each.
    pub sides: Vec<[usize; 2]>,
    /// Three corners each, counter-clockwise where y points up.
    pub triangles: Vec<[usize; 3]>,
    /// The triangles all of whose corners are at one level: a plateau that the paper does not mention.
    pub flat: Vec<usize>,
    /// How many points were added to raise plateaus.
    pub raised: usize,
    /// Points that several contours share, and that repeat within one.
    pub repeated: usize,
}

/// Why there are no patches.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ContourError {
    /// A number that cannot be used.
    #[error("contour {contour}: {what} is {value}; {accepted} is accepted")]
    OutOfRange {
        /// Which contour.
        contour: String,
        /// Which number.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What would be.
        accepted: &'static str,
    },
    /// Fewer points than make a line.
    #[error("contour {contour} has {count} different points; at least {least} are needed")]
    TooShort {
        /// Which contour.
        contour: String,
        /// How many there are.
        count: usize,
        /// 2 if it is open, else 3.
        least: usize,
    },
    /// Contours meet where they cannot.
    #[error("contour {a} {how} contour {b} at ({}, {}): {why}", place[0], place[1])]
    Meet {
        /// One.
        a: String,
        /// The other, perhaps the same.
        b: String,
        /// Whether they cross or touch.
        how: &'static str,
        /// Where, or an end of the side that is crossed.
        place: [f64; 2],
        /// What is wrong with that.
        why: &'static str,
    },
    /// All points are on one line.
    #[error("the contours have no area between them: all points are on one straight line")]
    NoArea,
}

/// A point of the triangulation and the contour that it is of, or beside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub place: [f64; 2],
    pub level: f64,
    pub contour: usize,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.place[0], self.place[1])
    }
}

pub(super) type Mesh = ConstrainedDelaunayTriangulation<Vertex>;

impl Patches {
    /// The patches between contours.
    ///
    /// Contours may be open, closed or nested, and may touch others of their own level in points or along whole sides,
    /// so that what is given twice does no harm. None may cross another or itself, nor touch one of another level.
    ///
    /// # Errors
    ///
    /// The first contour that does, that has too few points, or whose numbers cannot be used.
    pub fn new(contours: &[Contour], plateau: Plateau) -> Result<Self, ContourError> {
        let mut mesh = Mesh::new();
        let mut handles = Vec::new();
        let mut repeated = 0;
        for (number, contour) in contours.iter().enumerate() {
            check(contour)?;
            let mut line = Vec::new();
            for place in &contour.points {
                let vertex = Vertex { place: *place, level: contour.level, contour: number };
                if let PositionInTriangulation::OnVertex(there) = mesh.locate(vertex.position()) {
                    let other = &contours[mesh.vertex(there).data().contour];
                    if other.level != contour.level {
                        return Err(touch(contour, other, *place));
                    }
                    repeated += usize::from(line.last() != Some(&there));
                    line.push(there);
                } else {
                    // Every number has been checked, which is all that is refused here.
                    line.push(mesh.insert(vertex).map_err(|_| ContourError::NoArea)?);
                }
            }
            line.dedup();
            if contour.closed {
                line.push(line[0]);
                line.dedup();
            }
            let least = if contour.closed { 4 } else { 2 };
            if line.len() < least {
                let count = if contour.closed { line.len().saturating_sub(1).max(1) } else { line.len() };
                let least = if contour.closed { 3 } else { 2 };
                return Err(ContourError::TooShort { contour: contour.name.clone(), count, least });
            }
            handles.push(line);
        }
        for (contour, line) in contours.iter().zip(&handles) {
            for side in line.windows(2) {
                for met in LineIntersectionIterator::new_from_handles(&mesh, side[0], side[1]) {
                    match met {
                        Intersection::VertexIntersection(vertex) => {
                            let other = &contours[vertex.data().contour];
                            if other.level != contour.level {
                                return Err(touch(contour, other, vertex.data().place));
                            }
                        }
                        Intersection::EdgeIntersection(edge) if edge.is_constraint_edge() => {
                            let ends = edge.vertices().map(|vertex| *vertex.data());
                            let [from, to] = side else { continue };
                            let ours = [*from, *to].map(|vertex| mesh.vertex(vertex).data().place);
                            return Err(ContourError::Meet {
                                a: contour.name.clone(),
                                b: contours[ends[0].contour].name.clone(),
                                how: "crosses",
                                place: crossing(ours, ends.map(|end| end.place)),
                                why: "a place has one density",
                            });
                        }
                        _ => {}
                    }
                }
                mesh.add_constraint(side[0], side[1]);
            }
        }
        if mesh.num_inner_faces() == 0 {
            return Err(ContourError::NoArea);
        }
        let raised = match plateau {
            Plateau::AsPrinted => Vec::new(),
            Plateau::Raised => plateau::raised(&mesh),
        };
        for vertex in &raised {
            mesh.insert(*vertex).map_err(|_| ContourError::NoArea)?;
        }
        Ok(Self::of(&mesh, contours, repeated, raised.len()))
    }

    fn of(mesh: &Mesh, contours: &[Contour], repeated: usize, raised: usize) -> Self {
        let corner = |vertex: &Vertex| {
            let dimension = contours[vertex.contour].dimension;
            Corner { place: vertex.place, base: vertex.level, rough: 0.0, dimension }
        };
        let corners: Vec<Corner> = mesh.vertices().map(|vertex| corner(vertex.data())).collect();
        let triangles: Vec<[usize; 3]> =
            mesh.inner_faces().map(|face| face.vertices().map(|vertex| vertex.fix().index())).collect();
        let sides = mesh.undirected_edges().filter(|edge| edge.is_constraint_edge());
        let sides = sides.map(|edge| edge.vertices().map(|vertex| vertex.fix().index())).collect();
        let is_flat = |t: &[usize; 3]| t.iter().all(|k| corners[*k].base == corners[t[0]].base);
        let flat = (0..triangles.len()).filter(|k| is_flat(&triangles[*k])).collect();
        Self { corners, sides, triangles, flat, raised, repeated }
    }

    /// Patches of about one size and shape over the same ground and the box around it, for surfaces whose heights are a
    /// smooth relief's: Delaunay triangles of a triangular lattice whose points are moved by up to a quarter of its
    /// `side`, drawn from `moment`. They heed no contour; D is that of the nearest corner.
    pub fn even(&self, side: f64, moment: &Moment) -> Self {
        let (low, high) = self.bounds();
        let (mut mesh, mut given) = (Mesh::new(), DelaunayTriangulation::<Vertex>::new());
        for (number, corner) in self.corners.iter().enumerate() {
            // The points were accepted before.
            let _ = given.insert(Vertex { place: corner.place, level: corner.base, contour: number });
        }
        let step = [side, side * 0.75_f64.sqrt()];
        let count = [0, 1].map(|axis| libm::ceil((high[axis] - low[axis]) / step[axis]) as i32 + 2);
        for row in -1..count[1] {
            for column in -1..count[0] {
                let mut dice = moment.place(column, row, 0);
                let mut moved = || 0.5 * side * (dice.uniform() - 0.5);
                let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
                let x = low[0] + (f64::from(column) + shift) * step[0] + moved();
                let y = low[1] + f64::from(row) * step[1] + moved();
                let _ = mesh.insert(Vertex { place: [x, y], level: 0.0, contour: 0 });
            }
        }
        let corner = |vertex: &Vertex| {
            let nearest = given.nearest_neighbor(vertex.position()).map_or(0, |near| near.data().contour);
            Corner { place: vertex.place, ..self.corners[nearest] }
        };
        let corners: Vec<Corner> = mesh.vertices().map(|vertex| corner(vertex.data())).collect();
        let triangles =
            mesh.inner_faces().map(|face| face.vertices().map(|vertex| vertex.fix().index())).collect();
        Self { corners, triangles, sides: Vec::new(), flat: Vec::new(), raised: 0, repeated: 0 }
    }

    /// Least and greatest x and y.
    pub fn bounds(&self) -> ([f64; 2], [f64; 2]) {
        let of = |pick: fn(f64, f64) -> f64, axis: usize| {
            self.corners.iter().map(|corner| corner.place[axis]).reduce(pick).unwrap_or_default()
        };
        ([of(f64::min, 0), of(f64::min, 1)], [of(f64::max, 0), of(f64::max, 1)])
    }

    /// The corners of a triangle.
    pub fn triangle(&self, number: usize) -> [Corner; 3] {
        self.triangles[number].map(|corner| self.corners[corner])
    }
}

/// Where two segments cross that do.
fn crossing([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> [f64; 2] {
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let way = |from: [f64; 2], to: [f64; 2]| [to[0] - from[0], to[1] - from[1]];
    let (along, other) = (way(a, b), way(c, d));
    let share = cross(way(a, c), other) / cross(along, other);
    [0, 1].map(|axis| a[axis] + share * along[axis])
}

fn touch(contour: &Contour, other: &Contour, place: [f64; 2]) -> ContourError {
    ContourError::Meet {
        a: contour.name.clone(),
        b: other.name.clone(),
        how: "touches",
        place,
        why: "their levels differ, and a place has one density",
    }
}

fn check(contour: &Contour) -> Result<(), ContourError> {
    let refuse = |what, value, accepted| {
        Err(ContourError::OutOfRange { contour: contour.name.clone(), what, value, accepted })
    };
    if contour.level.is_nan() || contour.level.abs() > 1e9 {
        return refuse("the level", contour.level, "-1e9 to 1e9");
    }
    if !(2.0..=3.0).contains(&contour.dimension) {
        return refuse("the dimension of the surface", contour.dimension, "2 to 3");
    }
    for value in contour.points.iter().flatten() {
        // The triangulation takes no coordinate closer to 0 than 1e-142.
        if value.is_nan() || value.abs() > 1e9 || (*value != 0.0 && value.abs() < 1e-100) {
            return refuse("a coordinate", *value, "0, or 1e-100 to 1e9 from it");
        }
    }
    let least = if contour.closed { 3 } else { 2 };
    if contour.points.len() < least {
        let count = contour.points.len();
        return Err(ContourError::TooShort { contour: contour.name.clone(), count, least });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn contour(name: &str, level: f64, points: &[[f64; 2]], closed: bool) -> Contour {
        Contour { name: name.to_owned(), level, dimension: 2.3, points: points.to_vec(), closed }
    }

    /// A ring of waves around a centre.
    fn ring(name: &str, level: f64, centre: [f64; 2], radius: f64) -> Contour {
        let at = |k: i32| libm::sincos(f64::from(k) * std::f64::consts::TAU / 60.0);
        let waves = |k: i32| radius * (1.0 + 0.15 * at(7 * k).0);
        let points: Vec<[f64; 2]> =
            (0..60).map(|k| [centre[0] + waves(k) * at(k).1, centre[1] + waves(k) * at(k).0]).collect();
        contour(name, level, &points, true)
    }

    fn mountains() -> Vec<Contour> {
        vec![
            ring("coast", 0.0, [0.0, 0.0], 10.0),
            ring("west", 1.0, [-4.0, 0.0], 2.5),
            ring("summit", 2.0, [-4.0, 0.0], 1.0),
            ring("east", 1.0, [3.0, 1.0], 3.0),
            ring("crater", 0.5, [3.0, 1.0], 1.5),
            contour("ridge", 1.5, &[[-5.5, 0.2], [-5.7, 0.4], [-5.6, 0.8]], false),
        ]
    }

    fn area(t: [Corner; 3]) -> f64 {
        let [a, b, c] = t.map(|corner| corner.place);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    }

    /// Area of the convex hull by the monotone chain.
    fn hull(mut points: Vec<[f64; 2]>) -> f64 {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
            let mut chain: Vec<[f64; 2]> = Vec::new();
            for p in points {
                while chain.len() > 1 && turn(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0 {
                    chain.pop();
                }
                chain.push(p);
            }
            chain.pop();
            chain
        };
        let mut around = chain(&mut points.iter().copied());
        around.extend(chain(&mut points.iter().rev().copied()));
        let next = |k: usize| around[(k + 1) % around.len()];
        0.5 * (0..around.len()).map(|k| around[k][0] * next(k)[1] - around[k][1] * next(k)[0]).sum::<f64>()
    }

    #[test]
    fn every_side_of_a_contour_is_an_edge_and_the_areas_add_up() {
        let contours = mountains();
        let patches = Patches::new(&contours, Plateau::AsPrinted).unwrap();
        let key = |p: [f64; 2]| p.map(f64::to_bits);
        let mut edges = BTreeSet::new();
        for t in 0..patches.triangles.len() {
            let corners = patches.triangle(t);
            assert!(area(corners) > 0.0, "counter-clockwise");
            for k in 0..3 {
                edges.insert([key(corners[k].place), key(corners[(k + 1) % 3].place)]);
            }
        }
        for contour in &contours {
            let count = contour.points.len();
            let sides = if contour.closed { count } else { count - 1 };
            for k in 0..sides {
                let [a, b] = [key(contour.points[k]), key(contour.points[(k + 1) % count])];
                assert!(edges.contains(&[a, b]) || edges.contains(&[b, a]), "{} {k}", contour.name);
            }
        }
        let sum: f64 = (0..patches.triangles.len()).map(|t| area(patches.triangle(t))).sum();
        let whole = hull(contours.iter().flat_map(|c| c.points.iter().copied()).collect());
        assert!((sum / whole - 1.0).abs() < 1e-12, "{sum} {whole}");
        assert_eq!(patches.repeated, 0);
        // Flat are those within the summit's ring and the crater's, 58 each, and pockets between waves; others slope.
        assert!(patches.flat.len() >= 58 + 58 && patches.flat.len() < patches.triangles.len());
        for (t, corners) in (0..patches.triangles.len()).map(|t| (t, patches.triangle(t))) {
            let level = corners.iter().all(|corner| corner.base == corners[0].base);
            assert_eq!(level, patches.flat.contains(&t));
        }
    }

    #[test]
    fn what_is_given_twice_is_taken_once() {
        let once = Patches::new(&mountains(), Plateau::AsPrinted).unwrap();
        let mut twice = mountains();
        twice.extend(mountains());
        let twice = Patches::new(&twice, Plateau::AsPrinted).unwrap();
        assert_eq!(twice.repeated, 5 * 60 + 3);
        assert_eq!((twice.corners, twice.triangles), (once.corners, once.triangles));
    }

    #[test]
    fn contours_of_one_level_may_touch() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let beside = [[2.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0]];
        let inside = contour("top", 1.0, &[[0.5, 0.5], [1.0, 0.5], [1.0, 1.0]], true);
        let both = [contour("a", 0.0, &square, true), contour("b", 0.0, &beside, true), inside];
        let patches = Patches::new(&both, Plateau::AsPrinted).unwrap();
        assert_eq!((patches.corners.len(), patches.repeated), (9, 2));
        // A corner of one in the middle of a side of the other.
        let tip = contour("tip", 0.0, &[[1.0, 2.0], [1.5, 3.0], [0.5, 3.0]], true);
        assert!(Patches::new(&[contour("a", 0.0, &square, true), tip], Plateau::AsPrinted).is_ok());
    }

    #[test]
    fn even_patches_are_round_and_cover_the_box() {
        let patches = Patches::new(&mountains(), Plateau::AsPrinted).unwrap();
        let even = patches.even(0.8, &crate::rng::Seed(1).stream("places").at(0));
        let (low, high) = even.bounds();
        let (least, most) = patches.bounds();
        assert!((0..2).all(|k| low[k] < least[k] && high[k] > most[k]));
        let sizes: Vec<f64> = (0..even.triangles.len()).map(|t| area(even.triangle(t))).collect();
        let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
        assert!((mean / (0.433 * 0.64) - 1.0).abs() < 0.1, "{mean}");
        assert!(sizes.iter().filter(|size| **size < 0.2 * mean).count() < sizes.len() / 20);
    }

    #[test]
    fn what_cannot_be_is_refused_by_name() {
        let square = contour("base", 0.0, &[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]], true);
        let says = |other: Contour| {
            Patches::new(&[square.clone(), other], Plateau::AsPrinted).unwrap_err().to_string()
        };
        let crossing = contour("road", 1.0, &[[1.0, 1.0], [3.0, 1.0]], false);
        assert!(says(crossing).starts_with("contour road crosses contour base at (2, 1)"));
        let bow = contour("bow", 1.0, &[[0.5, 0.5], [1.0, 1.0], [1.0, 0.5], [0.5, 1.0]], true);
        assert!(says(bow).starts_with("contour bow crosses contour bow at (0.75, 0.75)"));
        let touching = contour("tip", 1.0, &[[1.0, 0.0], [1.5, 0.5], [0.5, 0.5]], true);
        let said = says(touching);
        assert!(said.contains("contour base touches contour tip at (1, 0): their levels differ"), "{said}");
        let shared = contour("tip", 1.0, &[[2.0, 2.0], [1.5, 0.5], [0.5, 0.5]], true);
        assert!(says(shared).starts_with("contour tip touches contour base at (2, 2)"));
        assert_eq!(
            says(contour("dot", 1.0, &[[1.0, 1.0]; 5], true)),
            "contour dot has 1 different points; at least 3 are needed"
        );
        assert!(
            says(contour("far", 1.0, &[[f64::INFINITY, 1.0], [1.0, 1.0]], false))
                .contains("a coordinate is inf")
        );
        let line = contour("line", 0.0, &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], false);
        assert_eq!(Patches::new(&[line], Plateau::AsPrinted), Err(ContourError::NoArea));
        assert_eq!(Patches::new(&[], Plateau::AsPrinted), Err(ContourError::NoArea));
    }
}
