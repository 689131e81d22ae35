//! Poisson's equation between walls without flux, solved directly.

use std::f64::consts::PI;

use multiversion::multiversion;

use super::cosine::{Cosine, LANES, Lanes};

/// `laplace phi = rhs` on `columns x rows` cells with `d phi / d n = 0` around them, by the five-point difference.
///
/// A cosine transform along x leaves a tridiagonal system along y for each mode, which are swept side by side. The
/// answer is exact but for rounding. phi is determined up to a constant and comes with mean 0; a right side must have
/// mean 0 for there to be an answer: [`defect`](Self::defect) says by how much it misses and mends it.
#[derive(Clone, Debug)]
pub struct Poisson {
    columns: usize,
    rows: usize,
    transform: Cosine,
    // Inverse pivots of each mode's elimination, row by row.
    pivots: Vec<f64>,
    // From a right side to the right side of the tridiagonal systems, and the transform's own factor.
    scale: f64,
    strip: Vec<Lanes>,
    spare: Vec<Lanes>,
}

impl Poisson {
    /// For cells of `dx` by `dy` metres.
    pub fn new(columns: usize, rows: usize, dx: f64, dy: f64) -> Self {
        let ratio = (dy / dx) * (dy / dx);
        let mut pivots = vec![0.0; columns * rows];
        for k in 0..columns {
            // 2 - 2 cos x = 4 sin^2 (x/2), which loses no digits for the long waves.
            let sine = libm::sin(0.5 * PI * k as f64 / columns as f64);
            let eigenvalue = ratio * 4.0 * sine * sine;
            let mut before = 0.0;
            for j in 0..rows {
                let neighbours = f64::from(u8::from(j > 0) + u8::from(j + 1 < rows));
                let pivot = neighbours + eigenvalue - before;
                // The constant mode is free: its last row asks for nothing.
                let free = k == 0 && j + 1 == rows;
                before = if free { 0.0 } else { 1.0 / pivot };
                pivots[j * columns + k] = before;
            }
        }
        let scale = -dy * dy * 2.0 / columns as f64;
        let strip = vec![[0.0; LANES]; columns];
        let spare = strip.clone();
        Self { columns, rows, transform: Cosine::new(columns), pivots, scale, strip, spare }
    }

    /// The mean of a right side, which no phi can give, and which is taken from it.
    pub fn defect(&self, rhs: &mut [f64]) -> f64 {
        // Mirror pairs first, so that a mirrored right side has the same sum.
        let of_row = |row: &[f64]| {
            let half = row.len() / 2;
            let pairs = row[..half].iter().zip(row.iter().rev()).map(|(a, b)| a + b).sum::<f64>();
            if row.len() % 2 == 1 { pairs + row[half] } else { pairs }
        };
        let mean = rhs.chunks_exact(self.columns).map(of_row).sum::<f64>() / rhs.len() as f64;
        rhs.iter_mut().for_each(|value| *value -= mean);
        mean
    }

    /// Turns a right side, `columns * rows` numbers row by row, into phi.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        assert_eq!(rhs.len(), self.columns * self.rows, "one number for each cell");
        transform_rows(&self.transform, rhs, &mut self.strip, &mut self.spare, self.scale, true);
        sweep(rhs, &self.pivots, self.columns);
        // Mean 0: without the mean of mode 0, which is also halved for the way back.
        let mean = rhs.iter().step_by(self.columns).sum::<f64>() / self.rows as f64;
        rhs.iter_mut().step_by(self.columns).for_each(|constant| *constant = 0.5 * (*constant - mean));
        transform_rows(&self.transform, rhs, &mut self.strip, &mut self.spare, 1.0, false);
    }
}

/// Transforms every row, a strip of rows at a time, and multiplies.
#[multiversion(targets("x86_64+avx2"))]
fn transform_rows(
    transform: &Cosine,
    values: &mut [f64],
    strip: &mut [Lanes],
    spare: &mut [Lanes],
    factor: f64,
    forward: bool,
) {
    let columns = transform.length();
    for rows in values.chunks_mut(columns * LANES) {
        for (lane, row) in rows.chunks_exact(columns).enumerate() {
            strip.iter_mut().zip(row).for_each(|(place, value)| place[lane] = *value * factor);
        }
        if forward {
            transform.forward(strip, spare);
        } else {
            transform.inverse(strip, spare);
        }
        for (lane, row) in rows.chunks_exact_mut(columns).enumerate() {
            row.iter_mut().zip(strip.iter()).for_each(|(value, place)| *value = place[lane]);
        }
    }
}

/// Elimination up the rows and substitution down again, all modes of a row side by side.
#[multiversion(targets("x86_64+avx2"))]
fn sweep(values: &mut [f64], pivots: &[f64], columns: usize) {
    let rows = values.len() / columns;
    for (value, pivot) in values[..columns].iter_mut().zip(pivots) {
        *value *= pivot;
    }
    for j in 1..rows {
        let (below, here) = values.split_at_mut(j * columns);
        let below = &below[(j - 1) * columns..];
        for ((value, before), pivot) in here[..columns].iter_mut().zip(below).zip(&pivots[j * columns..]) {
            *value = (*value + before) * pivot;
        }
    }
    for j in (1..rows).rev() {
        let (here, above) = values.split_at_mut(j * columns);
        let here = &mut here[(j - 1) * columns..];
        for ((value, after), pivot) in
            here.iter_mut().zip(&above[..columns]).zip(&pivots[(j - 1) * columns..])
        {
            *value += pivot * after;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The five-point difference with nothing flowing through the edge.
    fn laplace(phi: &[f64], columns: usize, rows: usize, dx: f64, dy: f64) -> Vec<f64> {
        let at = |i: usize, j: usize| phi[j * columns + i];
        let mut out = Vec::new();
        for j in 0..rows {
            for i in 0..columns {
                let flux = |inside: bool, other: &dyn Fn() -> f64, h: f64| {
                    if inside { (other() - at(i, j)) / (h * h) } else { 0.0 }
                };
                out.push(
                    flux(i > 0, &|| at(i - 1, j), dx)
                        + flux(i + 1 < columns, &|| at(i + 1, j), dx)
                        + flux(j > 0, &|| at(i, j - 1), dy)
                        + flux(j + 1 < rows, &|| at(i, j + 1), dy),
                );
            }
        }
        out
    }

    #[test]
    fn the_answer_satisfies_the_difference_equation() {
        for (columns, rows, dx, dy) in
            [(8, 8, 1.0, 1.0), (31, 17, 0.3, 0.2), (64, 100, 0.01, 0.02), (5, 1, 1.0, 1.0)]
        {
            let mut rhs: Vec<f64> =
                (0..columns * rows).map(|c| ((c * 7919 + 5) % 1009) as f64 / 1009.0 - 0.5).collect();
            let mut poisson = Poisson::new(columns, rows, dx, dy);
            let mean = rhs.iter().sum::<f64>() / rhs.len() as f64;
            assert!((poisson.defect(&mut rhs) - mean).abs() < 1e-15);
            let asked = rhs.clone();
            poisson.solve(&mut rhs);
            assert!(rhs.iter().sum::<f64>().abs() < 1e-9 * rhs.iter().map(|p| p.abs()).sum::<f64>());
            for (got, asked) in laplace(&rhs, columns, rows, dx, dy).iter().zip(&asked) {
                assert!((got - asked).abs() < 1e-11, "{columns} x {rows}: {got} {asked}");
            }
        }
    }

    #[test]
    fn a_cosine_is_its_own_answer() {
        let n = 48;
        let h = 1.0 / n as f64;
        let wave = |i: usize, k: usize| libm::cos(PI * k as f64 * (i as f64 + 0.5) * h);
        let sine = |k: usize| libm::sin(0.5 * PI * k as f64 * h);
        let eigenvalue = -4.0 * (sine(3) * sine(3) + sine(2) * sine(2)) / (h * h);
        let mut values: Vec<f64> = (0..n * n).map(|c| eigenvalue * wave(c % n, 3) * wave(c / n, 2)).collect();
        Poisson::new(n, n, h, h).solve(&mut values);
        for (c, value) in values.iter().enumerate() {
            assert!((value - wave(c % n, 3) * wave(c / n, 2)).abs() < 1e-12);
        }
    }
}
