//! The same Poisson equation by successive over-relaxation: what a direct solve is measured against.

/// How a relaxation ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxed {
    /// Sweeps over the grid.
    pub sweeps: usize,
    /// The largest residual that is left, over the largest right side.
    pub residual: f64,
}

/// Relaxes `laplace phi = rhs` with `d phi / d n = 0` around, until the residual is `target` of the right side or
/// `most` sweeps are done. `factor` 1 is Gauss and Seidel; a square of n cells converges fastest near `2 - 2 pi / n`.
pub fn relax(
    phi: &mut [f64],
    rhs: &[f64],
    columns: usize,
    [dx, dy]: [f64; 2],
    factor: f64,
    target: f64,
    most: usize,
) -> Relaxed {
    let rows = rhs.len() / columns;
    let (in_x, in_y) = (1.0 / (dx * dx), 1.0 / (dy * dy));
    let largest = rhs.iter().fold(f64::MIN_POSITIVE, |most, value| most.max(value.abs()));
    let mut residual = f64::INFINITY;
    for sweep in 0..most {
        residual = 0.0;
        for j in 0..rows {
            for i in 0..columns {
                let c = j * columns + i;
                let (mut sum, mut weight) = (0.0, 0.0);
                let mut neighbour = |inside: bool, other: usize, w: f64| {
                    if inside {
                        sum += w * phi[other];
                        weight += w;
                    }
                };
                neighbour(i > 0, c.wrapping_sub(1), in_x);
                neighbour(i + 1 < columns, c + 1, in_x);
                neighbour(j > 0, c.wrapping_sub(columns), in_y);
                neighbour(j + 1 < rows, c + columns, in_y);
                let misses = sum - weight * phi[c] - rhs[c];
                residual = f64::max(residual, misses.abs());
                phi[c] += factor * misses / weight;
            }
        }
        if residual <= target * largest {
            return Relaxed { sweeps: sweep + 1, residual: residual / largest };
        }
    }
    Relaxed { sweeps: most, residual: residual / largest }
}

#[cfg(test)]
mod tests {
    use super::super::Poisson;
    use super::*;

    #[test]
    fn relaxation_and_the_direct_solve_agree() {
        let (n, h) = (24, 1.0 / 24.0);
        let mut rhs: Vec<f64> = (0..n * n).map(|c| ((c * 7919 + 5) % 1009) as f64 / 1009.0 - 0.5).collect();
        let mut poisson = Poisson::new(n, n, h, h);
        poisson.defect(&mut rhs);
        let mut relaxed = vec![0.0; n * n];
        let end = relax(&mut relaxed, &rhs, n, [h, h], 1.77, 1e-11, 5000);
        assert!(end.residual <= 1e-11 && end.sweeps < 1000, "{end:?}");
        let mean = relaxed.iter().sum::<f64>() / relaxed.len() as f64;
        poisson.solve(&mut rhs);
        for (a, b) in relaxed.iter().zip(&rhs) {
            assert!((a - mean - b).abs() < 1e-9, "{a} {b}");
        }
    }
}
