//! From contours as they are given to patches between polygons through their feature points: §2.1.

use super::{Contour, ContourError, Patches, Plateau, feature_points};

/// Contours through their feature points, and the patches between them.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The polygons, in the order given.
    pub contours: Vec<Contour>,
    /// The triangles between them.
    pub patches: Patches,
}

/// How often the distance is halved before all points are kept.
const HALVINGS: i32 = 6;
/// How often polygons are mended one pair at a time, before all points of all contours are kept.
const MENDINGS: usize = 32;

/// Keeps the points of each contour without which its polygon would be farther off than `distance`, and puts triangles
/// between the polygons.
///
/// Lines that do not cross may have polygons that do: the distance of those is halved until they do not.
///
/// # Errors
///
/// Of [`Patches::new`] on the contours as they are given.
pub fn traced(given: &[Contour], distance: f64, plateau: Plateau) -> Result<Traced, ContourError> {
    let mut distances = vec![distance; given.len()];
    for mended in 0.. {
        let polygon = |(contour, distance): (&Contour, &f64)| {
            let kept = feature_points(&contour.points, contour.closed, *distance);
            // A ring that would shrink to a line keeps all its points.
            if contour.closed && kept.len() < 3 {
                return contour.clone();
            }
            Contour { points: kept.iter().map(|k| contour.points[*k]).collect(), ..contour.clone() }
        };
        let contours: Vec<Contour> = given.iter().zip(&distances).map(polygon).collect();
        match Patches::new(&contours, plateau) {
            Ok(patches) => return Ok(Traced { contours, patches }),
            Err(ContourError::Meet { .. }) if mended == MENDINGS => distances.fill(0.0),
            Err(ContourError::Meet { a, b, how, place, why }) => {
                let of_them = |name: &str| name == a || name == b;
                let them = given.iter().zip(&mut distances).filter(|(contour, _)| of_them(&contour.name));
                let mut finer = false;
                for (_, now) in them.filter(|(_, now)| **now > 0.0) {
                    finer = true;
                    *now = if *now > libm::ldexp(distance, -HALVINGS) { 0.5 * *now } else { 0.0 };
                }
                if !finer {
                    return Err(ContourError::Meet { a, b, how, place, why });
                }
            }
            Err(other) => return Err(other),
        }
    }
    unreachable!("every round but the last makes a distance smaller")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contour(name: &str, level: f64, points: Vec<[f64; 2]>) -> Contour {
        Contour { name: name.to_owned(), level, dimension: 2.2, points, closed: true }
    }

    fn square(half: f64) -> Vec<[f64; 2]> {
        vec![[-half, -half], [half, -half], [half, half], [-half, half]]
    }

    /// A narrow bay with another ring in its mouth: at a distance of 2 the polygon would close the bay across it.
    fn bay() -> Vec<Contour> {
        let mut outer = square(10.0);
        outer.splice(1..1, [[-0.5, -10.0], [0.0, -8.5], [0.5, -10.0]]);
        let islet = square(0.2).iter().map(|[x, y]| [*x, y - 10.0]).collect();
        vec![contour("frame", 0.0, square(20.0)), contour("coast", 1.0, outer), contour("islet", 2.0, islet)]
    }

    #[test]
    fn polygons_that_would_cross_are_drawn_finer() {
        let traced = traced(&bay(), 2.0, Plateau::AsPrinted).unwrap();
        assert_eq!(traced.contours[1].points.len(), 7, "the bay stays open");
        let corners: usize = traced.contours.iter().map(|c| c.points.len()).sum();
        assert_eq!(traced.patches.corners.len(), corners);
    }

    #[test]
    fn without_a_crossing_the_distance_is_kept() {
        let alone = &bay()[..2];
        assert_eq!(traced(alone, 2.0, Plateau::AsPrinted).unwrap().contours[1].points.len(), 4);
    }

    #[test]
    fn lines_that_do_cross_are_refused_by_name() {
        let mut given = bay();
        given[2].points = vec![[9.0, 0.0], [11.0, 0.0], [10.0, 5.0]];
        let error = traced(&given, 2.0, Plateau::AsPrinted).unwrap_err().to_string();
        assert!(error.contains("coast") && error.contains("islet"), "{error}");
    }
}
