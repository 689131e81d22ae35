//! CMA-ES: Hansen, *The CMA Evolution Strategy: A Tutorial*, arXiv:1604.00772v2 (2023), with its default parameters.
//!
//! | symbol | name here | meaning |
//! |---|---|---|
//! | m, sigma, C | [`Distribution`] | mean, step size and covariance of the samples |
//! | lambda, mu, w_i, c_sigma, d_sigma, c_c, c_1, c_mu | [`Strategy`] | Table 1 |
//! | p_sigma, p_c | [`Distribution`] | evolution paths |

mod distribution;
mod strategy;

use argmin::core::{CostFunction, Error, IterState, KV, Problem, Solver, State as _, TerminationReason};

use crate::rng::{Place, Stream};
use distribution::Distribution;
pub use strategy::Strategy;

type Search = IterState<Vec<f64>, (), (), (), (), f64>;

/// The (mu/mu_w, lambda)-CMA-ES with negative weights, in a box.
///
/// The samples are normal in the whole space; what is evaluated, and reported, is the sample mirrored at the faces of the
/// box until it lies inside. So the search knows no boundary, as with the transformation of pycma, and the update stays
/// the tutorial's. Costs that are no number rank last.
#[derive(Clone, Debug)]
pub struct CmaEs {
    sigma: f64,
    domain: Vec<(f64, f64)>,
    stream: Stream,
    lambda: Option<usize>,
    running: Option<Running>,
}

#[derive(Clone, Debug)]
struct Running {
    strategy: Strategy,
    distribution: Distribution,
    generation: u64,
    // Best cost of each of the last generations.
    bests: Vec<f64>,
}

/// Below this part of the box's width samples do not differ any more.
const NARROW: f64 = 1e-12;
/// The condition of C beyond which it is not trusted: §B.3, ConditionCov.
const ILL: f64 = 1e14;

impl CmaEs {
    /// The first step size, the box, and the random numbers: those of generation g and sample k are the stream's at time
    /// g and place (k, 0, 0). The search starts at the state's parameter.
    pub fn new(sigma: f64, domain: Vec<(f64, f64)>, stream: Stream) -> Self {
        Self { sigma, domain, stream, lambda: None, running: None }
    }

    /// The same with a population of another size than the default, at least 4.
    #[must_use]
    pub fn with_population(mut self, lambda: usize) -> Self {
        self.lambda = Some(lambda.max(4));
        self
    }

    /// The point of the box that a sample is mirrored to.
    fn mirrored(&self, x: &[f64]) -> Vec<f64> {
        x.iter().zip(&self.domain).map(|(x, (low, high))| mirror(*x, *low, *high)).collect()
    }
}

/// Mirrors a number at the ends of an interval until it lies inside.
fn mirror(x: f64, low: f64, high: f64) -> f64 {
    let width = high - low;
    let turn = (x - low) / (2.0 * width);
    let part = turn - libm::floor(turn);
    let folded = if part > 0.5 { 1.0 - part } else { part };
    // An inside number is left as it is, to the bit.
    if (low..=high).contains(&x) { x } else { low + 2.0 * width * folded }
}

impl<O> Solver<O, Search> for CmaEs
where
    O: CostFunction<Param = Vec<f64>, Output = f64>,
{
    fn name(&self) -> &str {
        "CMA-ES"
    }

    fn init(&mut self, problem: &mut Problem<O>, mut state: Search) -> Result<(Search, Option<KV>), Error> {
        let start = state.take_param().ok_or_else(|| Error::msg("no initial parameter was given"))?;
        if start.len() != self.domain.len() || start.is_empty() {
            return Err(Error::msg("the start and the box differ in their dimensions"));
        }
        let strategy = match self.lambda {
            Some(lambda) => Strategy::with_population(start.len(), lambda),
            None => Strategy::new(start.len()),
        };
        let distribution = Distribution::new(start.clone(), self.sigma);
        self.running = Some(Running { strategy, distribution, generation: 0, bests: Vec::new() });
        let cost = problem.cost(&start)?;
        Ok((state.param(start).cost(cost), None))
    }

    fn next_iter(&mut self, problem: &mut Problem<O>, state: Search) -> Result<(Search, Option<KV>), Error> {
        let mut running = self.running.take().ok_or_else(|| Error::msg("the search has not begun"))?;
        let n = self.domain.len();
        let moment = self.stream.at(running.generation);
        let mut samples = Vec::with_capacity(running.strategy.lambda);
        for k in 0..running.strategy.lambda {
            let mut place = moment.place(k as i32, 0, 0);
            let y = running.distribution.draw(&normal(&mut place, n));
            let x = self.mirrored(&running.distribution.point(&y));
            let cost = problem.cost(&x)?;
            samples.push((if cost.is_nan() { f64::INFINITY } else { cost }, y, x));
        }
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (best, x) = (samples[0].0, samples[0].2.clone());
        let ranked: Vec<Vec<f64>> = samples.into_iter().map(|(_, y, _)| y).collect();
        running.generation += 1;
        running.distribution.update(&running.strategy, &ranked, running.generation);
        running.bests.push(best);
        let why = self.finished(&running);
        self.running = Some(running);
        let state = state.param(x).cost(best);
        Ok(match why {
            Some(why) => (state.terminate_with(TerminationReason::SolverExit(why.to_owned())), None),
            None => (state, None),
        })
    }
}

impl CmaEs {
    /// Why there is no use in going on (§B.3), if there is none.
    fn finished(&self, running: &Running) -> Option<&'static str> {
        let (widest, narrowest) = running.distribution.deviations();
        let width = self.domain.iter().map(|(low, high)| high - low).fold(f64::INFINITY, f64::min);
        if !widest.is_finite() {
            return Some("the samples spread without bound");
        }
        if widest < NARROW * width {
            return Some("the samples do not differ any more");
        }
        if widest * widest > ILL * narrowest * narrowest {
            return Some("the covariance is ill-conditioned");
        }
        // EqualFunValues: nothing better in so many generations, and nothing worse.
        let patience = 10 + (30 * self.domain.len()).div_ceil(running.strategy.lambda);
        let last = running.bests.len().checked_sub(patience).map(|from| &running.bests[from..]);
        let level = last.is_some_and(|last| last.iter().all(|best| *best == last[0]));
        level.then_some("the objective is level where the samples are")
    }
}

/// Standard normal numbers by the method of Box and Muller.
fn normal(place: &mut Place, n: usize) -> Vec<f64> {
    let mut numbers = Vec::with_capacity(n + 1);
    while numbers.len() < n {
        let radius = libm::sqrt(-2.0 * libm::log(place.uniform()));
        let angle = 2.0 * std::f64::consts::PI * place.uniform();
        numbers.extend([radius * libm::cos(angle), radius * libm::sin(angle)]);
    }
    numbers.truncate(n);
    numbers
}

#[cfg(test)]
mod tests;
