//! Ways to measure the D of a square of heights, `2^k + 1` to a side.

use snowglobe::contour_cloud::spectral_dimension;

/// A way to measure D.
pub struct Estimator {
    pub name: &'static str,
    /// None where nothing can be told.
    pub measure: fn(&[f64], usize) -> Option<f64>,
}

/// All four.
pub const ESTIMATORS: [Estimator; 4] = [
    Estimator {
        name: "detail",
        measure: |heights, side| of_logs(&details(heights, side), |slope| 3.0 - slope),
    },
    Estimator { name: "spectral", measure: spectral_dimension },
    Estimator {
        name: "variogram",
        measure: |heights, side| of_logs(&variogram(heights, side), |slope| 3.0 - 0.5 * slope),
    },
    Estimator { name: "box", measure: |heights, side| of_logs(&boxes(heights, side), |slope| -slope) },
];

/// Steps from one place to an eighth of the side, doubled.
fn steps(side: usize) -> impl Iterator<Item = usize> {
    (0..).map(|k| 1 << k).take_while(move |step| 8 * step < side)
}

type Logs = Vec<(f64, f64)>;

/// Root mean square of how far a height is from the mean of its two neighbours, by the distance of those, on the
/// lattice of that distance: v of Eq. (1) where the surface was made by it.
fn details(heights: &[f64], side: usize) -> Logs {
    let at = |x: usize, y: usize| heights[y * side + x];
    let log = |step: usize| {
        let (mut sum, mut count) = (0.0, 0_u32);
        for a in (0..side).step_by(2 * step) {
            for b in (step..side - step).step_by(2 * step) {
                let row = at(b, a) - 0.5 * (at(b - step, a) + at(b + step, a));
                let column = at(a, b) - 0.5 * (at(a, b - step) + at(a, b + step));
                (sum, count) = (sum + row * row + column * column, count + 2);
            }
        }
        (libm::log2(step as f64), 0.5 * libm::log2(sum / f64::from(count)))
    };
    steps(side).map(log).collect()
}

/// Mean square of the difference of two heights, by their distance along rows and columns.
pub fn variogram(heights: &[f64], side: usize) -> Logs {
    let at = |x: usize, y: usize| heights[y * side + x];
    let log = |step: usize| {
        let (mut sum, mut count) = (0.0, 0_u32);
        for a in 0..side {
            for b in step..side {
                let (row, column) = (at(b, a) - at(b - step, a), at(a, b) - at(a, b - step));
                (sum, count) = (sum + row * row + column * column, count + 2);
            }
        }
        (libm::log2(step as f64), libm::log2(sum / f64::from(count)))
    };
    steps(side).map(log).collect()
}

/// Boxes that the surface goes through, by their size; the range of the heights is made as long as the side.
fn boxes(heights: &[f64], side: usize) -> Logs {
    let (low, high) =
        heights.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(*h), high.max(*h)));
    let per = (side - 1) as f64 / (high - low);
    let log = |size: usize| {
        let mut count = 0.0;
        for top in (0..side - 1).step_by(size) {
            for left in (0..side - 1).step_by(size) {
                let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
                for y in top..=top + size {
                    for height in &heights[y * side + left..=y * side + left + size] {
                        (least, most) = (least.min(*height), most.max(*height));
                    }
                }
                let layer = |height: f64| libm::floor((height - low) * per / size as f64);
                count += layer(most) - layer(least) + 1.0;
            }
        }
        (libm::log2(size as f64), libm::log2(count))
    };
    steps(side).map(log).collect()
}

fn of_logs(logs: &[(f64, f64)], dimension: impl Fn(f64) -> f64) -> Option<f64> {
    Some(dimension(slope(logs))).filter(|d| d.is_finite())
}

/// Of the line of least squares.
fn slope(logs: &[(f64, f64)]) -> f64 {
    let n = logs.len() as f64;
    let (x, y) = logs.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let over = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>();
    over / logs.iter().map(|p| (p.0 - x) * (p.0 - x)).sum::<f64>()
}
