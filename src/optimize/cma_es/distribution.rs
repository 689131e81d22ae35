//! The normal distribution that samples are drawn from, and how it learns (Fig. 6, Eq. (38) to (47)).

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::strategy::Strategy;

/// N(m, sigma² C) with its evolution paths.
///
/// Sums run in a fixed order over numbers; nalgebra's decomposition uses no function but the square root, so the bits are
/// the same on every machine.
#[derive(Clone, Debug)]
pub struct Distribution {
    mean: Vec<f64>,
    sigma: f64,
    covariance: DMatrix<f64>,
    // C = B D² Bᵀ: columns of B, and D.
    axes: DMatrix<f64>,
    lengths: Vec<f64>,
    path_sigma: Vec<f64>,
    path_c: Vec<f64>,
}

impl Distribution {
    /// Around a point, the same in all directions.
    pub fn new(mean: Vec<f64>, sigma: f64) -> Self {
        let n = mean.len();
        Self {
            mean,
            sigma,
            covariance: DMatrix::identity(n, n),
            axes: DMatrix::identity(n, n),
            lengths: vec![1.0; n],
            path_sigma: vec![0.0; n],
            path_c: vec![0.0; n],
        }
    }

    /// y = B D z, Eq. (39), for standard normal z.
    pub fn draw(&self, z: &[f64]) -> Vec<f64> {
        let scaled: Vec<f64> = z.iter().zip(&self.lengths).map(|(z, d)| z * d).collect();
        self.turned(&scaled)
    }

    /// x = m + sigma y, Eq. (40).
    pub fn point(&self, y: &[f64]) -> Vec<f64> {
        self.mean.iter().zip(y).map(|(m, y)| m + self.sigma * y).collect()
    }

    /// The greatest and the least standard deviation along an axis of C.
    pub fn deviations(&self) -> (f64, f64) {
        let of =
            |pick: fn(f64, f64) -> f64, from: f64| self.lengths.iter().copied().fold(from, pick) * self.sigma;
        (of(f64::max, 0.0), of(f64::min, f64::INFINITY))
    }

    /// Learns from the y of generation g (counted from 1), best first.
    pub fn update(&mut self, strategy: &Strategy, ranked: &[Vec<f64>], generation: u64) {
        let n = self.mean.len();
        let Strategy { weights, mu, mu_eff, c_sigma, d_sigma, c_c, c_1, c_mu, expected_length, .. } =
            strategy;
        // Eq. (41), (42): the mean moves all the way, c_m = 1.
        let mut step = vec![0.0; n];
        for (w, y) in weights.iter().zip(ranked).take(*mu) {
            add(&mut step, *w, y);
        }
        for (m, y) in self.mean.iter_mut().zip(&step) {
            *m += self.sigma * y;
        }

        // Eq. (43), (44): the step size.
        let white = self.whitened(&step);
        scale_add(
            &mut self.path_sigma,
            1.0 - c_sigma,
            libm::sqrt(c_sigma * (2.0 - c_sigma) * mu_eff),
            &white,
        );
        let length = libm::sqrt(square(&self.path_sigma));
        self.sigma *= libm::exp((c_sigma / d_sigma) * (length / expected_length - 1.0)).min(1e4);

        // Eq. (45) to (47): the covariance. The path is held while the step size grows fast.
        let settled = libm::sqrt(1.0 - libm::pow(1.0 - c_sigma, 2.0 * generation as f64));
        let held = length / settled >= (1.4 + 2.0 / (n as f64 + 1.0)) * expected_length;
        let fresh = if held { 0.0 } else { libm::sqrt(c_c * (2.0 - c_c) * mu_eff) };
        scale_add(&mut self.path_c, 1.0 - c_c, fresh, &step);
        let lost = if held { c_c * (2.0 - c_c) } else { 0.0 };
        let total: f64 = weights.iter().sum();
        self.covariance *= 1.0 + c_1 * lost - c_1 - c_mu * total;
        rank_one(&mut self.covariance, *c_1, &self.path_c);
        for (w, y) in weights.iter().zip(ranked) {
            let weight = match *w >= 0.0 {
                true => *w,
                false => w * n as f64 / square(&self.whitened(y)).max(f64::MIN_POSITIVE),
            };
            rank_one(&mut self.covariance, c_mu * weight, y);
        }
        self.decompose();
    }

    /// C^(-1/2) y = B D⁻¹ Bᵀ y.
    fn whitened(&self, y: &[f64]) -> Vec<f64> {
        let along: Vec<f64> = (0..y.len())
            .map(|axis| {
                self.axes.column(axis).iter().zip(y).map(|(b, y)| b * y).sum::<f64>() / self.lengths[axis]
            })
            .collect();
        self.turned(&along)
    }

    /// B v.
    fn turned(&self, v: &[f64]) -> Vec<f64> {
        let mut turned = vec![0.0; v.len()];
        for (axis, v) in v.iter().enumerate() {
            for (sum, b) in turned.iter_mut().zip(self.axes.column(axis).iter()) {
                *sum += b * v;
            }
        }
        turned
    }

    fn decompose(&mut self) {
        let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(self.covariance.clone());
        let sound = |values: &DVector<f64>| values.iter().all(|value| value.is_finite());
        if sound(&eigenvalues) {
            // A covariance has no negative eigenvalue; rounding may leave one.
            self.lengths = eigenvalues.iter().map(|value| libm::sqrt(value.max(f64::MIN_POSITIVE))).collect();
            self.axes = eigenvectors;
        } else {
            self.sigma = f64::INFINITY; // ends the search
        }
    }
}

fn square(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum()
}

fn add(to: &mut [f64], weight: f64, v: &[f64]) {
    for (to, v) in to.iter_mut().zip(v) {
        *to += weight * v;
    }
}

fn scale_add(to: &mut [f64], keep: f64, weight: f64, v: &[f64]) {
    for (to, v) in to.iter_mut().zip(v) {
        *to = keep * *to + weight * v;
    }
}

/// C + weight y yᵀ.
fn rank_one(c: &mut DMatrix<f64>, weight: f64, y: &[f64]) {
    for column in 0..y.len() {
        for row in 0..y.len() {
            c[(row, column)] += weight * y[row] * y[column];
        }
    }
}
