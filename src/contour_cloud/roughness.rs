//! The dimension of a surface, measured on its heights.

use std::f64::consts::TAU;

/// The dimension of a surface by the spectra of its rows: a profile of a surface of dimension D = 3 - H has a power that
/// falls with the wave number as `k^-(2 H + 1)`, so that D = (7 - b) / 2 with b the fall.
///
/// `heights` are rows of `columns` numbers, evenly spaced. Each row is made free of its mean and tapered by Hann's
/// window; wave numbers from 4 to a quarter of the row's are fitted, those shorter being shaped by the grid. None for
/// rows of fewer than 64 numbers, or without power.
pub fn spectral_dimension(heights: &[f64], columns: usize) -> Option<f64> {
    if columns < 64 || heights.len() < columns {
        return None;
    }
    let turns: Vec<(f64, f64)> =
        (0..columns).map(|k| libm::sincos(TAU * k as f64 / columns as f64)).collect();
    let last = columns / 4;
    let mut power = vec![0.0; last + 1];
    for row in heights.chunks_exact(columns) {
        let mean = row.iter().sum::<f64>() / columns as f64;
        let tapered: Vec<f64> =
            row.iter().zip(&turns).map(|(height, turn)| (height - mean) * (1.0 - turn.1)).collect();
        for (k, power) in power.iter_mut().enumerate().skip(4) {
            let (mut sine, mut cosine, mut at) = (0.0, 0.0, 0);
            for value in &tapered {
                (sine, cosine) = (sine + value * turns[at].0, cosine + value * turns[at].1);
                at += k;
                if at >= columns {
                    at -= columns;
                }
            }
            *power += sine * sine + cosine * cosine;
        }
    }
    if power[4..].iter().any(|power| power.is_nan() || *power <= 0.0) {
        return None;
    }
    // Octaves weigh alike, though the shorter ones hold more wave numbers.
    let (mut sum, mut x, mut y) = (0.0, 0.0, 0.0);
    let points = || (4..=last).map(|k| (1.0 / k as f64, libm::log(k as f64), libm::log(power[k])));
    for (weight, log_k, log_p) in points() {
        (sum, x, y) = (sum + weight, x + weight * log_k, y + weight * log_p);
    }
    let (mut up, mut down) = (0.0, 0.0);
    for (weight, log_k, log_p) in points() {
        up += weight * (log_k - x / sum) * (log_p - y / sum);
        down += weight * (log_k - x / sum) * (log_k - x / sum);
    }
    Some((7.0 + up / down) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    /// Rows with a spectrum that is known: cosines of random phase whose power falls as `k^-b`. Within 0.05: 64 rows of
    /// some 120 wave numbers each.
    #[test]
    fn rows_of_a_known_spectrum_have_its_dimension() {
        let columns = 512;
        for (b, known) in [(2.6, 2.2), (2.0, 2.5), (1.4, 2.8)] {
            let mut heights = vec![0.0; 64 * columns];
            for (row, heights) in heights.chunks_mut(columns).enumerate() {
                let mut dice = Seed(7).stream("phases").at(row as u64).place(0, 0, 0);
                for k in 1..columns / 2 {
                    let (phase, size) = (TAU * dice.uniform(), libm::pow(k as f64, -0.5 * b));
                    for (x, height) in heights.iter_mut().enumerate() {
                        *height += size * libm::cos(TAU * (k * x % columns) as f64 / columns as f64 + phase);
                    }
                }
            }
            let measured = spectral_dimension(&heights, columns).unwrap();
            assert!((measured - known).abs() < 0.05, "{measured} for {known}");
        }
    }

    #[test]
    fn nothing_can_be_told_of_a_flat_or_a_short_row() {
        assert_eq!(spectral_dimension(&[1.0; 512], 512), None);
        assert_eq!(spectral_dimension(&[1.0; 32], 32), None);
    }
}
