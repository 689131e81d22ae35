//! Surfaces and lines whose D is known: what the estimators are tried on.
//!
//! The surfaces are of fractional Brownian motion, and exact.
//!
//! A stationary field whose covariance is embedded in a circulant matrix is drawn with the right covariance by one
//! Fourier transform, and a random tilt makes it fractional Brownian motion (M. L. Stein 2002, *Fast and exact
//! simulation of fractional Brownian surfaces*, J. Comput. Graph. Stat. 11, 587-599).

use std::f64::consts::PI;

use snowglobe::rng::Seed;

/// A way to draw surfaces of one dimension.
pub struct Fractional {
    /// Heights to a row and a column of what is drawn.
    side: usize,
    /// Places to a row and a column of the circle that the surface is cut from.
    round: usize,
    /// Roots of the circulant's eigenvalues.
    roots: Vec<f64>,
    /// How far apart places are, where the surface is exact up to a distance of 1.
    spacing: f64,
    /// The variance of the tilt.
    tilt: f64,
}

impl Fractional {
    /// For surfaces of `2^power + 1` heights to a side, of dimension `d` between 2 and 3. None where the embedding has
    /// an eigenvalue below zero by more than rounding, for then it is none.
    pub fn new(power: u32, d: f64) -> Option<Self> {
        let alpha = 2.0 * (3.0 - d);
        let steps = 1_usize << power;
        // The covariance reaches to `reach`; the diagonal of what is drawn may be no longer than 1.
        let (reach, round) = if alpha <= 1.5 { (1.0, 4 * steps) } else { (2.0, 8 * steps) };
        let spacing = 2.0 * reach / round as f64;
        let (beta, c2, c0) = if alpha <= 1.5 {
            (0.0, alpha / 2.0, 1.0 - alpha / 2.0)
        } else {
            let beta = alpha * (2.0 - alpha) / (3.0 * reach * (reach * reach - 1.0));
            let c2 = (alpha - beta * (reach - 1.0) * (reach - 1.0) * (reach + 2.0)) / 2.0;
            (beta, c2, beta * (reach - 1.0) * (reach - 1.0) * (reach - 1.0) + 1.0 - c2)
        };
        let covariance = |r: f64| {
            if r <= 1.0 {
                c0 - libm::pow(r, alpha) + c2 * r * r
            } else if r <= reach {
                beta * (reach - r) * (reach - r) * (reach - r) / r
            } else {
                0.0
            }
        };
        let off = |k: usize| k.min(round - k) as f64 * spacing;
        let mut field: Vec<[f64; 2]> = (0..round * round)
            .map(|k| [covariance(libm::hypot(off(k % round), off(k / round))), 0.0])
            .collect();
        transform(&mut field, round);
        let most = field.iter().map(|[real, _]| *real).fold(0.0, f64::max);
        if field.iter().any(|[real, _]| *real < -1e-9 * most) {
            return None;
        }
        let count = (round * round) as f64;
        let roots = field.iter().map(|[real, _]| libm::sqrt(real.max(0.0) / count)).collect();
        Some(Self { side: steps + 1, round, roots, spacing, tilt: 2.0 * c2 })
    }

    /// Two independent surfaces, rows of heights. Two heights at a distance r, in places, differ by a variance of
    /// `2 (r s)^(6 - 2 D)`, s being the spacing.
    pub fn draw(&self, seed: Seed) -> [Vec<f64>; 2] {
        let stream = seed.stream("miyata: fractional");
        let (parts, tilt) = ([stream.at(0), stream.at(1)], stream.at(2));
        let round = self.round;
        let row = |y: usize, part: usize| {
            let places: Vec<[f64; 2]> = (0..round).map(|x| [x as f64, y as f64]).collect();
            let mut row = vec![0.0; round];
            parts[part].normals(&places, &mut row);
            row
        };
        let mut field: Vec<[f64; 2]> = Vec::with_capacity(round * round);
        for y in 0..round {
            let roots = &self.roots[y * round..(y + 1) * round];
            field.extend(
                roots.iter().zip(row(y, 0)).zip(row(y, 1)).map(|((root, a), b)| [root * a, root * b]),
            );
        }
        transform(&mut field, round);
        [0, 1].map(|part| {
            let normal = |axis: u8| tilt.normal([f64::from(axis), part as f64]);
            let slope = [0, 1].map(|axis| libm::sqrt(self.tilt) * self.spacing * normal(axis));
            let height = |k: usize| {
                let (x, y) = (k % self.side, k / self.side);
                field[y * round + x][part] - field[0][part] + slope[0] * x as f64 + slope[1] * y as f64
            };
            (0..self.side * self.side).map(height).collect()
        })
    }
}

/// A line whose midpoints are displaced at right angles to it by `Gauss length deviation`.
pub fn curve(deviation: f64, power: u32, seed: Seed) -> Vec<[f64; 2]> {
    let moment = seed.stream("miyata: curve").at(0);
    let mut line = vec![[0.0, 0.0], [1.0, 0.0]];
    for _ in 0..power {
        let mut finer = vec![line[0]];
        for pair in line.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            let v = deviation * moment.normal(middle);
            finer.push([middle[0] - v * (b[1] - a[1]), middle[1] + v * (b[0] - a[0])]);
            finer.push(b);
        }
        line = finer;
    }
    line
}

/// The deviation with which such a line has dimension D: the two halves of a segment are `r = sqrt(1/4 + v^2)` times as
/// long, and D is where the mean of `2 r^D` is 1 (Mauldin & Williams 1986, *Random recursive constructions*).
pub fn deviation(d: f64) -> f64 {
    let mean = |deviation: f64| {
        // Over the normal distribution to 8 deviations, evenly: exact to rounding for a function this smooth.
        let (mut sum, mut weights) = (0.0, 0.0);
        for k in -800..=800 {
            let g = f64::from(k) / 100.0;
            let weight = libm::exp(-0.5 * g * g);
            sum += weight * 2.0 * libm::pow(0.25 + deviation * deviation * g * g, 0.5 * d);
            weights += weight;
        }
        sum / weights
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if mean(middle) < 1.0 { low = middle } else { high = middle }
    }
    low
}

/// The discrete Fourier transform of a square of complex numbers; its side is a power of two.
fn transform(field: &mut [[f64; 2]], side: usize) {
    let turns: Vec<[f64; 2]> = (0..side / 2)
        .map(|k| {
            let (sine, cosine) = libm::sincos(-2.0 * PI * k as f64 / side as f64);
            [cosine, sine]
        })
        .collect();
    for _ in 0..2 {
        for row in field.chunks_exact_mut(side) {
            transform_row(row, &turns);
        }
        transpose(field, side);
    }
}

/// Cooley and Tukey's, in place; `turns` are the first half of the roots of one.
fn transform_row(row: &mut [[f64; 2]], turns: &[[f64; 2]]) {
    let length = row.len();
    let bits = length.trailing_zeros();
    for k in 0..length {
        let mirrored = k.reverse_bits() >> (usize::BITS - bits);
        if k < mirrored {
            row.swap(k, mirrored);
        }
    }
    let mut half = 1;
    while half < length {
        let every = length / (2 * half);
        for part in row.chunks_exact_mut(2 * half) {
            let (low, high) = part.split_at_mut(half);
            for ((a, b), [c, s]) in low.iter_mut().zip(high).zip(turns.iter().step_by(every)) {
                let turned = [b[0] * c - b[1] * s, b[0] * s + b[1] * c];
                *b = [a[0] - turned[0], a[1] - turned[1]];
                *a = [a[0] + turned[0], a[1] + turned[1]];
            }
        }
        half *= 2;
    }
}

/// Blocks of it at a time, which stay in the cache.
fn transpose(field: &mut [[f64; 2]], side: usize) {
    const BLOCK: usize = 16;
    for top in (0..side).step_by(BLOCK) {
        for left in (top..side).step_by(BLOCK) {
            for y in top..(top + BLOCK).min(side) {
                for x in left.max(y + 1)..(left + BLOCK).min(side) {
                    field.swap(y * side + x, x * side + y);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transform_is_the_sum_that_it_stands_for() {
        const SIDE: usize = 8;
        let given: Vec<[f64; 2]> =
            (0..SIDE * SIDE).map(|k| [(k * k % 7) as f64, (k % 5) as f64 - 1.5]).collect();
        let mut field = given.clone();
        transform(&mut field, SIDE);
        for (k, found) in field.iter().enumerate() {
            let mut sum = [0.0, 0.0];
            for (j, [re, im]) in given.iter().enumerate() {
                let turn = (k % SIDE) * (j % SIDE) + (k / SIDE) * (j / SIDE);
                let (s, c) = libm::sincos(-2.0 * PI * (turn % SIDE) as f64 / SIDE as f64);
                sum = [sum[0] + re * c - im * s, sum[1] + re * s + im * c];
            }
            assert!((sum[0] - found[0]).abs() < 1e-11 && (sum[1] - found[1]).abs() < 1e-11, "{k}");
        }
    }

    /// The variance of differences at distances up to the diagonal, over 400 surfaces: its deviation is 7 % where only
    /// one pair is taken; 25 % is more than three of them.
    #[test]
    fn differences_have_the_variance_of_fractional_brownian_motion() {
        for d in [2.1, 2.5, 2.9] {
            let drawn = Fractional::new(4, d).unwrap();
            let surfaces: Vec<Vec<f64>> = (0..200).flat_map(|seed| drawn.draw(Seed(seed))).collect();
            for (x, y) in [(1_usize, 0_usize), (0, 3), (16, 0), (5, 7), (16, 16)] {
                let r = libm::hypot(x as f64, y as f64) * drawn.spacing;
                let expected = 2.0 * libm::pow(r, 6.0 - 2.0 * d);
                let measured = surfaces.iter().map(|h| h[y * 17 + x] * h[y * 17 + x]).sum::<f64>()
                    / surfaces.len() as f64;
                assert!((measured / expected - 1.0).abs() < 0.25, "{d} {x} {y}: {measured} {expected}");
            }
        }
    }
}
