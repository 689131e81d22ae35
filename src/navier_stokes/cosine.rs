//! The cosine transform of a grid's rows, sixteen rows at a time in the lanes of registers.
//!
//! It diagonalises the second difference between walls without flux. Lengths are split while they are even (Lee 1984,
//! *A new algorithm to compute the discrete cosine transform*, IEEE Trans. ASSP 32, 1243-1245) and summed out where
//! they are odd. A reversed row gives the same numbers with the odd modes negated, bit for bit, and so back.

// Lanes by their index are what becomes registers.
#![allow(clippy::needless_range_loop)]

use std::f64::consts::PI;

/// Rows that are transformed together.
pub(super) const LANES: usize = 8;
/// One place of all rows.
pub(super) type Lanes = [f64; LANES];

/// The transform of rows of one length, with its tables.
#[derive(Clone, Debug)]
pub(super) struct Cosine {
    length: usize,
    // For each halving, 1 / (2 cos((i + 1/2) pi / n)) for the first half of i.
    halvings: Vec<Vec<f64>>,
    // The length that is left, 8 or odd, and cos(pi k (i + 1/2) / n) for i in its first half and each k.
    rest: usize,
    base: Vec<f64>,
}

impl Cosine {
    pub(super) fn new(length: usize) -> Self {
        let mut halvings = Vec::new();
        let mut rest = length;
        while rest.is_multiple_of(2) && rest != 8 && rest > 0 {
            let of = |i: usize| 0.5 / libm::cos((i as f64 + 0.5) * PI / rest as f64);
            halvings.push((0..rest / 2).map(of).collect());
            rest /= 2;
        }
        // The angle is reduced in whole numbers, so that the table is as exact for long rows as for short ones.
        let angle = |i: usize, k: usize| ((2 * i + 1) * k % (4 * rest)) as f64 * PI / (2 * rest) as f64;
        let base = (0..rest / 2).flat_map(|i| (0..rest).map(move |k| libm::cos(angle(i, k)))).collect();
        Self { length, halvings, rest, base }
    }

    /// How many places a row has.
    pub(super) fn length(&self) -> usize {
        self.length
    }

    /// Mode k becomes the sum over i of `x_i cos(pi k (i + 1/2) / n)`; `spare` is as long as `rows`.
    #[inline(always)]
    pub(super) fn forward(&self, rows: &mut [Lanes], spare: &mut [Lanes]) {
        let (mut from, mut to) = (rows, spare);
        let mut size = self.length;
        for factors in &self.halvings {
            for (from, to) in from.chunks_exact(size).zip(to.chunks_exact_mut(size)) {
                let (sums, differences) = to.split_at_mut(size / 2);
                let (low, high) = from.split_at(size / 2);
                for ((((s, d), a), b), f) in
                    sums.iter_mut().zip(differences).zip(low).zip(high.iter().rev()).zip(factors)
                {
                    for l in 0..LANES {
                        s[l] = a[l] + b[l];
                        d[l] = (a[l] - b[l]) * f;
                    }
                }
            }
            (from, to) = (to, from);
            size /= 2;
        }
        match self.rest {
            1 => {}
            8 => from.as_chunks_mut().0.iter_mut().for_each(eight_modes),
            _ => from.chunks_exact_mut(size).for_each(|row| self.sum_modes(row, to)),
        }
        for _ in &self.halvings {
            size *= 2;
            for (from, to) in from.chunks_exact(size).zip(to.chunks_exact_mut(size)) {
                let (even, odd) = from.split_at(size / 2);
                let (pairs, _) = to.as_chunks_mut::<2>();
                let following = odd[1..].iter().chain([&[0.0; LANES]]);
                for (((pair, e), o), next) in pairs.iter_mut().zip(even).zip(odd).zip(following) {
                    for l in 0..LANES {
                        pair[0][l] = e[l];
                        pair[1][l] = o[l] + next[l];
                    }
                }
            }
            (from, to) = (to, from);
        }
    }

    /// Place i becomes the sum over k of `x_k cos(pi k (i + 1/2) / n)`. Of [`forward`](Self::forward), n / 2 times the
    /// row comes back if mode 0 is halved in between.
    #[inline(always)]
    pub(super) fn inverse(&self, rows: &mut [Lanes], spare: &mut [Lanes]) {
        let (mut from, mut to) = (rows, spare);
        let mut size = self.length;
        for _ in &self.halvings {
            for (from, to) in from.chunks_exact(size).zip(to.chunks_exact_mut(size)) {
                let (even, odd) = to.split_at_mut(size / 2);
                let (pairs, _) = from.as_chunks::<2>();
                let mut before = [0.0; LANES];
                for ((e, o), pair) in even.iter_mut().zip(odd).zip(pairs) {
                    for l in 0..LANES {
                        e[l] = pair[0][l];
                        o[l] = before[l] + pair[1][l];
                    }
                    before = pair[1];
                }
            }
            (from, to) = (to, from);
            size /= 2;
        }
        match self.rest {
            1 => {}
            8 => from.as_chunks_mut().0.iter_mut().for_each(eight_places),
            _ => from.chunks_exact_mut(size).for_each(|row| self.sum_places(row, to)),
        }
        for factors in self.halvings.iter().rev() {
            size *= 2;
            for (from, to) in from.chunks_exact(size).zip(to.chunks_exact_mut(size)) {
                let (sums, differences) = from.split_at(size / 2);
                let (low, high) = to.split_at_mut(size / 2);
                for ((((a, b), s), d), f) in
                    low.iter_mut().zip(high.iter_mut().rev()).zip(sums).zip(differences).zip(factors)
                {
                    for l in 0..LANES {
                        let d = d[l] * f;
                        a[l] = s[l] + d;
                        b[l] = s[l] - d;
                    }
                }
            }
            (from, to) = (to, from);
        }
    }

    /// The odd rest of [`forward`](Self::forward), in place: even modes of the sums of mirror pairs, odd ones of the
    /// differences.
    #[inline(always)]
    fn sum_modes(&self, row: &mut [Lanes], folded: &mut [Lanes]) {
        let (n, middle) = (self.rest, self.rest / 2);
        for i in 0..middle {
            for l in 0..LANES {
                folded[i][l] = row[i][l] + row[n - 1 - i][l];
                folded[n - 1 - i][l] = row[i][l] - row[n - 1 - i][l];
            }
        }
        folded[middle] = row[middle];
        for (k, out) in row.iter_mut().enumerate() {
            // cos(pi k / 2) of the middle place: 1, 0, -1, 0.
            let weight = [1.0, 0.0, -1.0, 0.0][k % 4];
            let mut sum = folded[middle].map(|x| x * weight);
            for i in 0..middle {
                let x = if k % 2 == 0 { &folded[i] } else { &folded[n - 1 - i] };
                let c = self.base[i * n + k];
                for l in 0..LANES {
                    sum[l] += x[l] * c;
                }
            }
            *out = sum;
        }
    }

    /// The odd rest of [`inverse`](Self::inverse), in place.
    #[inline(always)]
    fn sum_places(&self, row: &mut [Lanes], folded: &mut [Lanes]) {
        let (n, middle) = (self.rest, self.rest / 2);
        for i in 0..=middle {
            let (mut even, mut odd) = ([0.0; LANES], [0.0; LANES]);
            for (k, x) in row.iter().enumerate() {
                let c = if i == middle { [1.0, 0.0, -1.0, 0.0][k % 4] } else { self.base[i * n + k] };
                let sum = if k % 2 == 0 { &mut even } else { &mut odd };
                for l in 0..LANES {
                    sum[l] += x[l] * c;
                }
            }
            for l in 0..LANES {
                folded[i][l] = even[l] + odd[l];
                if i < middle {
                    folded[n - 1 - i][l] = even[l] - odd[l];
                }
            }
        }
        row.copy_from_slice(&folded[..n]);
    }
}

/// 1 / (2 cos((i + 1/2) pi / n)) for n = 8, 4 and 2.
const EIGHTHS: [f64; 4] = [0.5097955791041592, 0.6013448869350453, 0.8999762231364157, 2.5629154477415064];
const QUARTERS: [f64; 2] = [0.541196100146197, 1.3065629648763766];
const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The last three halvings at once, where everything stays in registers.
#[inline(always)]
fn eight_modes(x: &mut [Lanes; 8]) {
    for l in 0..LANES {
        let sum = |i: usize| x[i][l] + x[7 - i][l];
        let difference = |i: usize| (x[i][l] - x[7 - i][l]) * EIGHTHS[i];
        let a = four_modes([sum(0), sum(1), sum(2), sum(3)]);
        let b = four_modes([difference(0), difference(1), difference(2), difference(3)]);
        let y = [a[0], b[0] + b[1], a[1], b[1] + b[2], a[2], b[2] + b[3], a[3], b[3]];
        for k in 0..8 {
            x[k][l] = y[k];
        }
    }
}

#[inline(always)]
fn four_modes(x: [f64; 4]) -> [f64; 4] {
    let a = [x[0] + x[3], x[1] + x[2]];
    let b = [(x[0] - x[3]) * QUARTERS[0], (x[1] - x[2]) * QUARTERS[1]];
    let last = (b[0] - b[1]) * HALF;
    [a[0] + a[1], (b[0] + b[1]) + last, (a[0] - a[1]) * HALF, last]
}

/// The first three steps back at once.
#[inline(always)]
fn eight_places(x: &mut [Lanes; 8]) {
    for l in 0..LANES {
        let a = four_places([x[0][l], x[2][l], x[4][l], x[6][l]]);
        let b = four_places([x[1][l], x[1][l] + x[3][l], x[3][l] + x[5][l], x[5][l] + x[7][l]]);
        for i in 0..4 {
            let b = b[i] * EIGHTHS[i];
            x[i][l] = a[i] + b;
            x[7 - i][l] = a[i] - b;
        }
    }
}

#[inline(always)]
fn four_places(x: [f64; 4]) -> [f64; 4] {
    let (a, b) = (x[2] * HALF, (x[1] + x[3]) * HALF);
    let (a, b) = ([x[0] + a, x[0] - a], [(x[1] + b) * QUARTERS[0], (x[1] - b) * QUARTERS[1]]);
    [a[0] + b[0], a[1] + b[1], a[1] - b[1], a[0] - b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(n: usize) -> Vec<Lanes> {
        let number = |i: usize, l: usize| ((i * 7919 + l * 104_729 + 13) % 1009) as f64 / 1009.0 - 0.5;
        (0..n).map(|i| std::array::from_fn(|l| number(i, l))).collect()
    }

    const LENGTHS: [usize; 15] = [1, 2, 3, 4, 5, 6, 8, 12, 16, 24, 31, 50, 64, 100, 128];

    #[test]
    fn constants_are_what_they_say() {
        let of = |i: usize, n: f64| 0.5 / libm::cos((i as f64 + 0.5) * PI / n);
        for i in 0..4 {
            assert!((EIGHTHS[i] / of(i, 8.0) - 1.0).abs() < 1e-15);
        }
        assert!((0..2).all(|i| (QUARTERS[i] / of(i, 4.0) - 1.0).abs() < 1e-15));
        assert!((HALF / of(0, 2.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn modes_are_the_sums_of_their_definition() {
        for n in LENGTHS {
            let (rows, transform) = (noise(n), Cosine::new(n));
            let (mut fast, mut spare) = (rows.clone(), rows.clone());
            transform.forward(&mut fast, &mut spare);
            for (k, mode) in fast.iter().enumerate() {
                for l in 0..LANES {
                    let term = |i: usize| rows[i][l] * libm::cos(PI * k as f64 * (i as f64 + 0.5) / n as f64);
                    let sum: f64 = (0..n).map(term).sum();
                    assert!((sum - mode[l]).abs() < 1e-12, "n {n} mode {k}: {sum} {}", mode[l]);
                }
            }
        }
    }

    #[test]
    fn a_row_comes_back() {
        for n in LENGTHS.into_iter().chain([1024, 1000]) {
            let (rows, transform) = (noise(n), Cosine::new(n));
            let (mut there, mut spare) = (rows.clone(), rows.clone());
            transform.forward(&mut there, &mut spare);
            there[0] = there[0].map(|x| x / 2.0);
            transform.inverse(&mut there, &mut spare);
            for (back, row) in there.iter().zip(&rows) {
                for l in 0..LANES {
                    assert!((back[l] * 2.0 / n as f64 - row[l]).abs() < 1e-12, "n {n}");
                }
            }
        }
    }

    #[test]
    fn a_mirrored_row_gives_mirrored_modes_bit_for_bit() {
        for n in LENGTHS {
            let transform = Cosine::new(n);
            let mut spare = noise(n);
            let (mut straight, mut mirrored) = (noise(n), noise(n));
            mirrored.reverse();
            transform.forward(&mut straight, &mut spare);
            transform.forward(&mut mirrored, &mut spare);
            for (k, (a, b)) in straight.iter().zip(&mirrored).enumerate() {
                let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
                assert_eq!(*a, b.map(|x| sign * x), "n {n} mode {k}");
            }
            transform.inverse(&mut straight, &mut spare);
            transform.inverse(&mut mirrored, &mut spare);
            mirrored.reverse();
            assert_eq!(straight, mirrored, "n {n}");
        }
    }
}
