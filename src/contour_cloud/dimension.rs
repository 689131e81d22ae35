//! The fractal dimension of a contour: §2.1, by the divider method (Richardson 1961, Mandelbrot 1967).

/// The steps with which a contour is walked: a geometric row between these bounds.
const STEPS: usize = 12;
/// Starts from which each walk is made; their mean is taken, for where a walk begins is chance.
const STARTS: usize = 8;

/// The dimension D of a curve of points, 1 to 2: the number of steps of length r that it takes to walk it falls as
/// `r^-D`. None for a curve of fewer than 16 points, or one that spans too few steps to tell.
///
/// The steps run from four times the mean distance of two points to an eighth of the curve's extent.
pub fn divider(points: &[[f64; 2]], closed: bool) -> Option<f64> {
    if points.len() < 16 {
        return None;
    }
    pooled(&[(points, closed)])
}

/// Curves of fewer points than this read too low on their own.
pub const POOLED_BELOW: usize = 512;

/// The dimension of each curve: its own where it has [`POOLED_BELOW`] points or more, else that of all shorter ones
/// together. None where neither can be told.
pub fn dimensions(curves: &[(&[[f64; 2]], bool)]) -> Vec<Option<f64>> {
    let short: Vec<_> = curves.iter().copied().filter(|(points, _)| points.len() < POOLED_BELOW).collect();
    let together =
        if short.iter().map(|(points, _)| points.len()).sum::<usize>() < 16 { None } else { pooled(&short) };
    let own = |(points, closed): &(&[[f64; 2]], bool)| {
        if points.len() < POOLED_BELOW { together } else { divider(points, *closed) }
    };
    curves.iter().map(own).collect()
}

/// The dimension of curves that are walked with the same steps, their numbers of steps added up.
fn pooled(curves: &[(&[[f64; 2]], bool)]) -> Option<f64> {
    let whole = |(points, closed): &(&[[f64; 2]], bool)| {
        let mut curve = points.to_vec();
        curve.extend(points.first().filter(|_| *closed));
        curve
    };
    let curves: Vec<Vec<[f64; 2]>> = curves.iter().map(whole).filter(|curve| curve.len() > 1).collect();
    let length = |curve: &[[f64; 2]]| curve.windows(2).map(|pair| distance(pair[0], pair[1])).sum::<f64>();
    let total: f64 = curves.iter().map(|curve| length(curve)).sum();
    let segments: usize = curves.iter().map(|curve| curve.len().saturating_sub(1)).sum();
    // Of several curves the extent that counts is the mean, each weighted with its length.
    let wide = curves.iter().map(|curve| length(curve) / total * extent(curve)).sum::<f64>();
    let (least, most) = (4.0 * total / segments as f64, wide / 8.0);
    if !(least > 0.0 && most > 2.0 * least) {
        return None;
    }
    let ratio = libm::log(most / least);
    let logs: Vec<(f64, f64)> = (0..STEPS)
        .map(|k| {
            let step = least * libm::exp(ratio * k as f64 / (STEPS - 1) as f64);
            let steps: f64 = curves.iter().map(|curve| mean_walk(curve, step)).sum();
            (libm::log(step), libm::log(steps))
        })
        .collect();
    Some(-slope(&logs))
}

/// Steps that it takes to walk a curve, in the mean over several starts.
fn mean_walk(curve: &[[f64; 2]], step: f64) -> f64 {
    let walks = (0..STARTS).map(|start| {
        let skipped = start * (curve.len() / 4) / STARTS;
        // Both ways from a point, so that every walk covers the whole curve.
        let back: Vec<[f64; 2]> = curve[..=skipped].iter().rev().copied().collect();
        walk(&curve[skipped..], step) + walk(&back, step)
    });
    walks.sum::<f64>() / STARTS as f64
}

/// How many steps of length `step` it takes to walk a curve, the last a part of one.
pub fn walk(curve: &[[f64; 2]], step: f64) -> f64 {
    let Some((&first, rest)) = curve.split_first() else { return 0.0 };
    let (mut at, mut from, mut steps) = (first, first, 0.0);
    for &to in rest {
        // Leaves the circle around `at` where it crosses this segment for the first time, perhaps more than once.
        while let Some(crossing) = leave(at, step, from, to) {
            at = crossing;
            from = crossing;
            steps += 1.0;
        }
        from = to;
    }
    steps + distance(at, from) / step
}

/// Where the segment leaves the circle around `centre`; none where its end is still inside.
fn leave(centre: [f64; 2], radius: f64, from: [f64; 2], to: [f64; 2]) -> Option<[f64; 2]> {
    if distance(centre, to) < radius {
        return None;
    }
    let way = [to[0] - from[0], to[1] - from[1]];
    let off = [from[0] - centre[0], from[1] - centre[1]];
    let a = way[0] * way[0] + way[1] * way[1];
    let b = off[0] * way[0] + off[1] * way[1];
    let c = off[0] * off[0] + off[1] * off[1] - radius * radius;
    if a == 0.0 {
        return None;
    }
    let t = (-b + libm::sqrt((b * b - a * c).max(0.0))) / a;
    let t = t.clamp(0.0, 1.0);
    Some([from[0] + t * way[0], from[1] + t * way[1]])
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]))
}

/// The longer side of the box around a curve.
fn extent(curve: &[[f64; 2]]) -> f64 {
    let side = |axis: usize| {
        let (low, high) = curve
            .iter()
            .fold((f64::MAX, f64::MIN), |(low, high), p| (f64::min(low, p[axis]), f64::max(high, p[axis])));
        high - low
    };
    f64::max(side(0), side(1))
}

/// Of the line of least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (mut up, mut down) = (0.0, 0.0);
    for p in points {
        up += (p.0 - x) * (p.1 - y);
        down += (p.0 - x) * (p.0 - x);
    }
    up / down
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_has_dimension_one() {
        let line: Vec<[f64; 2]> = (0..500).map(|k| [f64::from(k) * 0.3, f64::from(k) * 0.1]).collect();
        let d = divider(&line, false).unwrap();
        assert!((d - 1.0).abs() < 1e-9, "{d}");
        assert!((walk(&line, 1.0) - libm::hypot(499.0 * 0.3, 49.9)).abs() < 1e-9);
    }

    /// A circle is smooth: a twentieth is what its curvature leaves at steps of an eighth of it.
    #[test]
    fn a_circle_has_nearly_one() {
        let at = |k: i32| libm::sincos(f64::from(k) * std::f64::consts::TAU / 1000.0);
        let circle: Vec<[f64; 2]> = (0..1000).map(|k| [at(k).1, at(k).0]).collect();
        let d = divider(&circle, true).unwrap();
        assert!((d - 1.0).abs() < 0.05, "{d}");
    }

    /// Curves that are made of copies of themselves; 0.07 is what the steps, which do not fit the copies, leave.
    #[test]
    fn exact_fractals_have_the_dimension_that_is_known() {
        let (sine, cosine) = libm::sincos(std::f64::consts::FRAC_PI_3);
        let peak = |a: [f64; 2], b: [f64; 2]| {
            let [dx, dy] = [(b[0] - a[0]) / 3.0, (b[1] - a[1]) / 3.0];
            let p = [a[0] + dx, a[1] + dy];
            vec![p, [p[0] + cosine * dx - sine * dy, p[1] + sine * dx + cosine * dy], [b[0] - dx, b[1] - dy]]
        };
        // Mandelbrot's quadric curve, log 8 / log 4.
        let quadric = |a: [f64; 2], b: [f64; 2]| {
            let d = [(b[0] - a[0]) / 4.0, (b[1] - a[1]) / 4.0];
            let at = |x: f64, y: f64| [a[0] + x * d[0] - y * d[1], a[1] + x * d[1] + y * d[0]];
            vec![
                at(1.0, 0.0),
                at(1.0, 1.0),
                at(2.0, 1.0),
                at(2.0, 0.0),
                at(2.0, -1.0),
                at(3.0, -1.0),
                at(3.0, 0.0),
            ]
        };
        type Rule<'a> = &'a dyn Fn([f64; 2], [f64; 2]) -> Vec<[f64; 2]>;
        let rules: [(Rule, u32, f64); 2] = [(&peak, 7, 1.2619), (&quadric, 4, 1.5)];
        for (between, times, known) in rules {
            let mut curve = vec![[0.0, 0.0], [1.0, 0.0]];
            for _ in 0..times {
                let mut finer = vec![curve[0]];
                for pair in curve.windows(2) {
                    finer.extend(between(pair[0], pair[1]));
                    finer.push(pair[1]);
                }
                curve = finer;
            }
            let d = divider(&curve, false).unwrap();
            assert!((d - known).abs() < 0.07, "{known}: {d}");
        }
    }

    #[test]
    fn a_curve_that_is_too_short_has_none() {
        assert_eq!(divider(&[[0.0, 0.0]; 40], true), None);
        assert_eq!(divider(&[[0.0, 0.0], [1.0, 1.0]], false), None);
    }
}
