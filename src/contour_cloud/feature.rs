//! Feature points of a contour: §2.1, Fig. 1.
//!
//! The paper's vector tracer (its reference 8) is not described; a polygon that stays within a stated distance of the
//! contour (Douglas & Peucker 1973) takes its place.

/// The numbers of the points that are kept, rising: every other point lies within `distance` of the polygon through
/// them. The first and the last are always kept; of a closed contour the first, and the one that is farthest from it.
pub fn feature_points(points: &[[f64; 2]], closed: bool, distance: f64) -> Vec<usize> {
    let count = points.len();
    if count < 3 {
        return (0..count).collect();
    }
    let mut kept = vec![false; count + 1];
    kept[0] = true;
    // A closed contour is two open ones, from its first point to the farthest and back.
    let mut open = Vec::new();
    if closed {
        let squared = |k: usize| off(points[k], points[0], points[0]);
        let middle = (1..count).fold(1, |best, k| if squared(k) > squared(best) { k } else { best });
        kept[middle] = true;
        open.extend([(0, middle), (middle, count)]);
    } else {
        kept[count - 1] = true;
        open.push((0, count - 1));
    }
    while let Some((from, to)) = open.pop() {
        let (a, b) = (points[from], points[to % count]);
        let farthest =
            (from + 1..to).map(|k| (k, off(points[k], a, b))).fold(None, |best, (k, d)| match best {
                Some((_, most)) if most >= d => best,
                _ => Some((k, d)),
            });
        if let Some((k, most)) = farthest
            && most > distance * distance
        {
            kept[k] = true;
            open.extend([(from, k), (k, to)]);
        }
    }
    (0..count).filter(|k| kept[*k]).collect()
}

/// The square of the distance of a point from a segment.
fn off(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let along = way[0] * way[0] + way[1] * way[1];
    let t = if along > 0.0 {
        (((p[0] - a[0]) * way[0] + (p[1] - a[1]) * way[1]) / along).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let [x, y] = [p[0] - a[0] - t * way[0], p[1] - a[1] - t * way[1]];
    x * x + y * y
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(count: usize) -> Vec<[f64; 2]> {
        let at = |k: usize| libm::sincos(k as f64 * std::f64::consts::TAU / count as f64);
        (0..count).map(|k| [at(k).1 * (1.0 + 0.2 * at(5 * k).0), at(k).0]).collect()
    }

    #[test]
    fn no_point_is_farther_from_the_polygon_than_was_asked() {
        let points = ring(700);
        for distance in [0.2, 0.05, 0.01, 0.001] {
            for closed in [true, false] {
                let kept = feature_points(&points, closed, distance);
                assert!(kept.windows(2).all(|pair| pair[0] < pair[1]));
                let mut ends: Vec<usize> = kept.clone();
                if closed {
                    ends.push(kept[0] + points.len());
                }
                for pair in ends.windows(2) {
                    for k in pair[0]..=pair[1] {
                        let [p, a, b] = [k, pair[0], pair[1]].map(|k| points[k % points.len()]);
                        assert!(off(p, a, b) <= distance * distance * (1.0 + 1e-12));
                    }
                }
            }
        }
        assert!(feature_points(&points, true, 0.01).len() < 60);
    }

    #[test]
    fn corners_are_kept_and_what_lies_between_is_not() {
        let side = |k: usize| [[k, 0], [10, k], [10 - k, 10], [0, 10 - k]];
        let square: Vec<[f64; 2]> =
            (0..4).flat_map(|s| (0..10).map(move |k| side(k)[s].map(|x| x as f64))).collect();
        assert_eq!(feature_points(&square, true, 0.1), [0, 10, 20, 30]);
    }

    #[test]
    fn nothing_is_asked_of_two_points() {
        assert_eq!(feature_points(&[[0.0, 0.0], [1.0, 1.0]], false, 0.1), [0, 1]);
        assert_eq!(feature_points(&[[0.0, 0.0]; 5], true, 0.1).len(), 2);
    }
}
