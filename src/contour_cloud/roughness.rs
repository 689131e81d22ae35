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
    // Points every 1 / columns see a wave number as the sum of all that look alike there, which matters where the power
    // falls slowly. The fall sought is the one whose spectrum, seen so, is proportional to what is measured.
    let logs: Vec<(f64, f64, f64)> =
        (4..=last).map(|k| (k as f64, k as f64 / columns as f64, libm::log(power[k]))).collect();
    let misfit = |fall: f64| {
        // Octaves weigh alike, though the shorter ones hold more wave numbers.
        let (mut sum, mut first, mut second) = (0.0, 0.0, 0.0);
        for (k, share, power) in &logs {
            let off = power + fall * libm::log(*k) - libm::log(alias(fall, *share));
            (sum, first, second) = (sum + 1.0 / k, first + off / k, second + off * off / k);
        }
        second - first * first / sum
    };
    Some((7.0 - lowest(misfit, 1.0 + 1e-6, 7.0)) / 2.0)
}

/// Where a function with one dip between two bounds is lowest: by golden sections, to 1e-9.
fn lowest(of: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = 0.5 * (libm::sqrt(5.0) - 1.0);
    let inner = |low: f64, high: f64| (high - golden * (high - low), low + golden * (high - low));
    let (mut a, mut b) = inner(low, high);
    let (mut at_a, mut at_b) = (of(a), of(b));
    while high - low > 1e-9 {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = inner(low, high).0;
            at_a = of(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = inner(low, high).1;
            at_b = of(b);
        }
    }
    0.5 * (low + high)
}

/// The power of a wave number, as a share of the rate of samples, with all that look alike when sampled, over its own:
/// the sum over m of `(|m + share| / share)^-fall`.
fn alias(fall: f64, share: f64) -> f64 {
    const TERMS: u32 = 12;
    let both = |m: f64| libm::pow((m + share) / share, -fall) + libm::pow((m - share) / share, -fall);
    let head: f64 = (1..TERMS).map(|m| both(f64::from(m))).sum();
    // Euler and Maclaurin's, from the first term left out on.
    let m = f64::from(TERMS);
    let rest = |m: f64| {
        let term = libm::pow(m / share, -fall);
        term * (m / (fall - 1.0) + 0.5 + fall / (12.0 * m))
    };
    1.0 + head + rest(m + share) + rest(m - share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    /// Rows with a spectrum that is known: cosines of random phase whose power falls as `k^-b`, with that of all that look
    /// alike at these places, summed out. Within 0.05: 64 rows of some 120 wave numbers each.
    #[test]
    fn rows_of_a_known_spectrum_have_its_dimension() {
        let columns = 512;
        for (b, known) in [(2.6, 2.2), (2.0, 2.5), (1.4, 2.8)] {
            let power = |k: usize| libm::pow(k as f64, -b);
            let alike =
                |k: usize| (1..2000).map(|m| power(m * columns + k) + power(m * columns - k)).sum::<f64>();
            let size = |k: usize| if k == 0 { 0.0 } else { libm::sqrt(power(k) + alike(k)) };
            let sizes: Vec<f64> = (0..columns / 2).map(size).collect();
            let mut heights = vec![0.0; 64 * columns];
            for (row, heights) in heights.chunks_mut(columns).enumerate() {
                let mut dice = Seed(7).stream("phases").at(row as u64).place(0, 0, 0);
                for (k, size) in sizes.iter().enumerate().skip(1) {
                    let (phase, size) = (TAU * dice.uniform(), size);
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
