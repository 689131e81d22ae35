//! What is displaced: the patches, or a smooth ground through the same contours.

use rayon::prelude::*;
use spade::{DelaunayTriangulation, HasPosition, HierarchyHintGenerator, Point2, Triangulation};

use super::Patches;

/// The ground that displacement is added to.
#[derive(Clone, Debug, PartialEq)]
pub enum Relief {
    /// The patches themselves: level lines of it have a corner at every edge, as in the paper.
    Patches,
    /// A smooth ground.
    Smooth(Smooth),
}

impl Relief {
    /// Its height at a place; none where it is the patch's own.
    pub fn height(&self, place: [f64; 2]) -> Option<f64> {
        match self {
            Self::Patches => None,
            Self::Smooth(smooth) => Some(smooth.height(place)),
        }
    }
}

/// A ground without creases: Sibson's natural neighbours (1981) on a lattice, and a uniform cubic B-spline over it,
/// which is twice differentiable and stays between its lattice's least and greatest height.
#[derive(Clone, Debug, PartialEq)]
pub struct Smooth {
    low: [f64; 2],
    per: f64,
    columns: usize,
    heights: Vec<f64>,
}

/// A height of the lattice's neighbours.
struct Site {
    place: [f64; 2],
    height: f64,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.place[0], self.place[1])
    }
}

/// By default a search begins at the vertex that any thread looked up last, which decides from which side a place on an
/// edge is found, and so in which order its neighbours are summed. A hierarchy begins where the place itself says.
type Sites = DelaunayTriangulation<Site, (), (), (), HierarchyHintGenerator<f64>>;

/// Lattice points beyond the drawing, for the spline's reach.
const MARGIN: usize = 2;

impl Smooth {
    /// The smooth ground through the corners and sides of patches, on a lattice of `across` points along the longer side
    /// of the drawing (4 at least), of which neighbours are averaged `times` times with the weights 1, 2, 1.
    pub fn new(patches: &Patches, across: usize, times: u32) -> Self {
        let (low, high) = patches.bounds();
        let size = [high[0] - low[0], high[1] - low[1]];
        let spacing = f64::max(size[0], size[1]) / (across.max(4) - 1) as f64;
        let count = |axis: usize| libm::ceil(size[axis] / spacing) as usize + 1 + 2 * MARGIN;
        let (columns, rows) = (count(0), count(1));
        let low = low.map(|least| least - MARGIN as f64 * spacing);
        let sites = sites(patches, spacing);
        let place = |column: usize, row: usize| {
            Point2::new(low[0] + column as f64 * spacing, low[1] + row as f64 * spacing)
        };
        let known: Vec<Vec<Option<f64>>> = (0..rows)
            .into_par_iter()
            .map(|row| {
                let near = sites.natural_neighbor();
                let height = |column| near.interpolate(|site| site.data().height, place(column, row));
                (0..columns).map(height).collect()
            })
            .collect();
        let mut heights = spread(known.concat(), columns);
        for _ in 0..times {
            heights = averaged(&averaged(&heights, columns, 1), columns, columns);
        }
        Self { low, per: 1.0 / spacing, columns, heights }
    }

    /// The height at a place; beyond the lattice that of its rim.
    pub fn height(&self, place: [f64; 2]) -> f64 {
        let rows = self.heights.len() / self.columns;
        let cell = |axis: usize, count: usize| {
            let at = ((place[axis] - self.low[axis]) * self.per).clamp(1.0, count as f64 - 2.0);
            let first = (at as usize).min(count - 3);
            (first - 1, weights(at - first as f64))
        };
        let ((column, across), (row, down)) = (cell(0, self.columns), cell(1, rows));
        let mut sum = 0.0;
        for (k, v) in down.iter().enumerate() {
            let line = &self.heights[(row + k) * self.columns + column..][..4];
            sum +=
                v * (across[0] * line[0] + across[1] * line[1] + across[2] * line[2] + across[3] * line[3]);
        }
        sum
    }
}

/// The uniform cubic B-spline's weights of the four points around.
fn weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    ]
}

/// The corners, and points along the sides no farther apart than the lattice's: a side is as high all along.
fn sites(patches: &Patches, spacing: f64) -> Sites {
    let mut all = Sites::new();
    let mut put = |place: [f64; 2], height: f64| {
        // Coordinates were checked with the patches; one too close to 0 for the triangulation is 0.
        let place = place.map(|x| if x.abs() < 1e-100 { 0.0 } else { x });
        let _ = all.insert(Site { place, height });
    };
    for corner in &patches.corners {
        put(corner.place, corner.base);
    }
    for side in &patches.sides {
        let [a, b] = side.map(|corner| patches.corners[corner]);
        let pieces = libm::ceil(libm::hypot(a.place[0] - b.place[0], a.place[1] - b.place[1]) / spacing);
        for k in 1..pieces.max(1.0) as usize {
            let share = k as f64 / pieces;
            put([0, 1].map(|axis| a.place[axis] + share * (b.place[axis] - a.place[axis])), a.base);
        }
    }
    all
}

/// Gives points without a height the mean of neighbours that have one, from the rim outwards.
fn spread(mut known: Vec<Option<f64>>, columns: usize) -> Vec<f64> {
    while known.iter().any(Option::is_none) && known.iter().any(Option::is_some) {
        let before = known.clone();
        for (k, height) in known.iter_mut().enumerate().filter(|(_, height)| height.is_none()) {
            let (column, row) = (k % columns, k / columns);
            let mut near = Vec::new();
            for (inside, beside) in [
                (column > 0, k.wrapping_sub(1)),
                (column + 1 < columns, k + 1),
                (row > 0, k.wrapping_sub(columns)),
                (k + columns < before.len(), k + columns),
            ] {
                near.extend(Some(beside).filter(|_| inside).and_then(|beside| before[beside]));
            }
            if !near.is_empty() {
                *height = Some(near.iter().sum::<f64>() / near.len() as f64);
            }
        }
    }
    known.into_iter().map(Option::unwrap_or_default).collect()
}

/// Averages with the neighbours along one axis, 1, 2, 1; the ends with themselves.
fn averaged(heights: &[f64], columns: usize, step: usize) -> Vec<f64> {
    let count = if step == 1 { columns } else { heights.len() / columns };
    let beside = |k: usize| {
        let along = if step == 1 { k % columns } else { k / columns };
        let before = if along > 0 { k - step } else { k };
        let after = if along + 1 < count { k + step } else { k };
        0.25 * (heights[before] + 2.0 * heights[k] + heights[after])
    };
    (0..heights.len()).map(beside).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Contour, Plateau};
    use super::*;

    fn cone() -> Patches {
        let ring = |level: f64| {
            let at = |k: i32| libm::sincos(f64::from(k) * std::f64::consts::TAU / 90.0);
            let points = (0..90).map(|k| [(10.0 - level) * at(k).1, (10.0 - level) * at(k).0]).collect();
            Contour { name: format!("{level}"), level, dimension: 2.3, points, closed: true }
        };
        Patches::new(&[0.0, 2.0, 4.0, 6.0, 8.0].map(ring), Plateau::Raised).unwrap()
    }

    #[test]
    fn a_cone_stays_a_cone_between_its_contours() {
        let smooth = Smooth::new(&cone(), 101, 0);
        for (x, y) in [(3.0, 1.0), (-5.0, 2.0), (1.0, -7.5), (6.0, 6.0)] {
            let known = 10.0 - libm::hypot(x, y);
            assert!((smooth.height([x, y]) - known).abs() < 0.05, "{x} {y}: {}", smooth.height([x, y]));
        }
    }

    /// Over a patch's edge the slope of the patches jumps; the spline's changes no more than its lattice lets it.
    #[test]
    fn there_is_no_crease() {
        let patches = Patches::new(
            &[
                Contour {
                    name: "a".into(),
                    level: 0.0,
                    dimension: 2.0,
                    closed: false,
                    points: vec![[0.0, 0.0], [0.0, 9.0]],
                },
                Contour {
                    name: "b".into(),
                    level: 1.0,
                    dimension: 2.0,
                    closed: false,
                    points: vec![[3.0, 0.0], [3.0, 9.0]],
                },
                Contour {
                    name: "c".into(),
                    level: 0.0,
                    dimension: 2.0,
                    closed: false,
                    points: vec![[9.0, 0.0], [9.0, 9.0]],
                },
            ],
            Plateau::AsPrinted,
        )
        .unwrap();
        let smooth = Smooth::new(&patches, 46, 0);
        let slope = |x: f64| (smooth.height([x + 1e-4, 4.5]) - smooth.height([x - 1e-4, 4.5])) / 2e-4;
        // Slopes of 1/3 and -1/6 meet at x = 3; the spacing is 0.2, and a cubic takes two cells to turn.
        let steps = (0..400).map(|k| 2.0 + f64::from(k) * 0.005).map(slope).collect::<Vec<_>>();
        let jump = steps.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        assert!(jump < 2.0 * 0.5 * 0.005 / 0.2, "{jump}");
        assert!((slope(1.5) - 1.0 / 3.0).abs() < 0.02 && (slope(6.0) + 1.0 / 6.0).abs() < 0.02);
    }

    /// Squares, so that many a lattice point lies on an edge of the triangulation.
    fn pyramid() -> Patches {
        let square = |level: i32| {
            let half = f64::from(8 - level);
            let points = vec![[-half, -half], [half, -half], [half, half], [-half, half]];
            Contour {
                name: format!("{level}"),
                level: f64::from(level),
                dimension: 2.3,
                points,
                closed: true,
            }
        };
        Patches::new(&[0, 3, 5].map(square), Plateau::Raised).unwrap()
    }

    #[test]
    fn it_is_the_same_on_any_number_of_threads() {
        let patches = pyramid();
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Smooth::new(&patches, 129, 1)).heights
        };
        let one = with(1);
        for threads in [2, 3, 7] {
            assert!(with(threads) == one, "{threads} threads");
        }
    }

    /// Nor does it matter what was looked up before.
    #[test]
    fn it_is_the_same_in_any_order_of_questions() {
        let sites = sites(&pyramid(), 0.3);
        let near = sites.natural_neighbor();
        let places: Vec<_> = (0..1600)
            .map(|k| Point2::new(f64::from(k % 40) * 0.4 - 8.0, f64::from(k / 40) * 0.4 - 8.0))
            .collect();
        let height =
            |place: &Point2<f64>| near.interpolate(|site| site.data().height, *place).map(f64::to_bits);
        let forth: Vec<_> = places.iter().map(height).collect();
        let mut back: Vec<_> = places.iter().rev().map(height).collect();
        back.reverse();
        assert!(forth == back, "in the other direction");
        assert!(forth.iter().flatten().count() > 1000);
    }

    #[test]
    fn beyond_the_drawing_it_goes_on() {
        let smooth = Smooth::new(&cone(), 51, 2);
        assert!(smooth.height([1e6, -1e6]).abs() < 0.5);
        assert!(smooth.heights.iter().all(|height| height.is_finite()));
    }
}
