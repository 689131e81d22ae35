//! The cosine transform of a grid's rows, sixteen rows at a time in the lanes of registers.
//!
//! It diagonalises the second difference between walls without flux. Lengths are split while they are even (Lee 1984,
//! *A new algorithm to compute the discrete cosine transform*, IEEE Trans. ASSP 32, 1243-1245) and summed out where
//! they are odd. A reversed row gives the same numbers with the odd modes negated, bit for bit, and so back.

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
    // Length that is left, odd, and cos(pi k (i + 1/2) / n) for i in its first half and each k.
    odd: usize,
    base: Vec<f64>,
}

impl Cosine {
    pub(super) fn new(length: usize) -> Self {
        let mut halvings = Vec::new();
        let mut odd = length;
        while odd.is_multiple_of(2) && odd > 0 {
            let of = |i: usize| 0.5 / libm::cos((i as f64 + 0.5) * PI / odd as f64);
            halvings.push((0..odd / 2).map(of).collect());
            odd /= 2;
        }
        // The angle is reduced in whole numbers, so that the table is as exact for long rows as for short ones.
        let angle = |i: usize, k: usize| ((2 * i + 1) * k % (4 * odd)) as f64 * PI / (2 * odd) as f64;
        let base = (0..odd / 2).flat_map(|i| (0..odd).map(move |k| libm::cos(angle(i, k)))).collect();
        Self { length, halvings, odd, base }
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
        if self.odd > 1 {
            for (from, to) in from.chunks_exact_mut(size).zip(to.chunks_exact_mut(size)) {
                self.sum_modes(from, to);
            }
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
        if self.odd > 1 {
            for (from, to) in from.chunks_exact_mut(size).zip(to.chunks_exact_mut(size)) {
                self.sum_places(from, to);
            }
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
        let (n, middle) = (self.odd, self.odd / 2);
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
        let (n, middle) = (self.odd, self.odd / 2);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(n: usize) -> Vec<Lanes> {
        let number = |i: usize, l: usize| ((i * 7919 + l * 104_729 + 13) % 1009) as f64 / 1009.0 - 0.5;
        (0..n).map(|i| std::array::from_fn(|l| number(i, l))).collect()
    }

    const LENGTHS: [usize; 12] = [1, 2, 3, 4, 5, 6, 12, 31, 50, 64, 100, 128];

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
