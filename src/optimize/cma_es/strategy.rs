//! The default parameters (Table 1).

/// The parameters of the strategy.
#[derive(Clone, Debug, PartialEq)]
pub struct Strategy {
    /// lambda: samples in a generation.
    pub lambda: usize,
    /// w_i, best first; the first mu are positive and sum to 1.
    pub weights: Vec<f64>,
    /// mu: samples that the mean moves to.
    pub mu: usize,
    /// mu_eff, the variance effective selection mass.
    pub mu_eff: f64,
    /// c_sigma, decay of the path of the step size.
    pub c_sigma: f64,
    /// d_sigma, damping of the step size.
    pub d_sigma: f64,
    /// c_c, decay of the path of the covariance.
    pub c_c: f64,
    /// c_1, rate of the rank-one update.
    pub c_1: f64,
    /// c_mu, rate of the rank-mu update.
    pub c_mu: f64,
    /// The expected length of a standard normal vector, as approximated in §A.
    pub expected_length: f64,
}

impl Strategy {
    /// The default in n dimensions: lambda = 4 + floor(3 ln n), Eq. (48).
    pub fn new(n: usize) -> Self {
        Self::with_population(n, 4 + libm::floor(3.0 * libm::log(n as f64)) as usize)
    }

    /// With another population; Eq. (49) to (58).
    pub fn with_population(n: usize, lambda: usize) -> Self {
        let dimension = n as f64;
        let raw: Vec<f64> =
            (1..=lambda).map(|i| libm::log((lambda as f64 + 1.0) / 2.0) - libm::log(i as f64)).collect();
        let mu = lambda / 2;
        let mass = |part: &[f64]| {
            let (sum, squares) = part.iter().fold((0.0, 0.0), |(s, q), w| (s + w, q + w * w));
            if squares > 0.0 { sum * sum / squares } else { 0.0 }
        };
        let (mu_eff, mu_eff_minus) = (mass(&raw[..mu]), mass(&raw[mu..]));
        let c_c = (4.0 + mu_eff / dimension) / (dimension + 4.0 + 2.0 * mu_eff / dimension);
        let c_1 = 2.0 / ((dimension + 1.3) * (dimension + 1.3) + mu_eff);
        let c_mu = (2.0 * (0.25 + mu_eff + 1.0 / mu_eff - 2.0)
            / ((dimension + 2.0) * (dimension + 2.0) + mu_eff))
            .min(1.0 - c_1);
        let c_sigma = (mu_eff + 2.0) / (dimension + mu_eff + 5.0);
        let excess = libm::sqrt((mu_eff - 1.0) / (dimension + 1.0)) - 1.0;
        // Eq. (50) to (53): how much the negative weights may sum to.
        let negative = (1.0 + c_1 / c_mu)
            .min(1.0 + 2.0 * mu_eff_minus / (mu_eff + 2.0))
            .min((1.0 - c_1 - c_mu) / (dimension * c_mu));
        let sum = |sign: f64| raw.iter().map(|w| (sign * w).max(0.0)).sum::<f64>();
        let (plus, minus) = (sum(1.0), sum(-1.0));
        let weights = raw.iter().map(|w| if *w >= 0.0 { w / plus } else { negative * w / minus }).collect();
        Self {
            lambda,
            weights,
            mu,
            mu_eff,
            c_sigma,
            d_sigma: 1.0 + 2.0 * excess.max(0.0) + c_sigma,
            c_c,
            c_1,
            c_mu,
            expected_length: libm::sqrt(dimension)
                * (1.0 - 1.0 / (4.0 * dimension) + 1.0 / (21.0 * dimension * dimension)),
        }
    }
}
