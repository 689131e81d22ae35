//! The probabilities of the automaton from a curve of cover (Dobashi gives none of his): which of vapour, activation and
//! extinction make a sky fill and clear as one that was given?
//!
//! The curve is the model's own, with probabilities and a seed that the solver is not told. A sky of its own seed never
//! follows it exactly, and two skies of probabilities that hardly differ differ by chance: the objective is rough, the
//! rougher the fewer cells there are.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use argmin::core::Error;

use super::{Suite, drawn};
use crate::automaton_cloud::{Activation, Brackets, Chance, Injection, Lock, Outside, Packed, Rules};
use crate::optimize::contest::{Measure, Problem, Target};
use crate::rng::Seed;

/// How far the cover may be off, as a root mean square over the steps, of that of the curve given.
pub const TARGETS: [f64; 5] = [0.3, 0.1, 0.05, 0.03, 0.02];
/// Logarithms to base 10 of the probabilities of hum, act and ext, each step.
const DOMAIN: [(f64, f64); 3] = [(-3.0, -1.0), (-4.5, -2.5), (-4.0, -2.0)];
const STEPS: usize = 64;
const RULES: Rules =
    Rules { activation: Activation::Negated, brackets: Brackets::Mended, lock: Lock::Cld, lifetime: 4 };

/// Three probabilities from a curve of cover.
#[derive(Clone, Debug)]
pub struct CoverProblem {
    name: &'static str,
    counts: [usize; 3],
    wanted: Arc<Mutex<BTreeMap<u64, Vec<f64>>>>,
}

impl CoverProblem {
    /// On a lattice of so many cells.
    pub fn new(name: &'static str, counts: [usize; 3]) -> Self {
        Self { name, counts, wanted: Arc::default() }
    }

    /// The logarithms of the probabilities that the curve with this seed was made with: uniform in the middle half of the
    /// box.
    pub fn truth(&self, seed: Seed) -> Vec<f64> {
        drawn(seed, "cover: hidden", &DOMAIN, 0.25, 0.5)
    }

    /// Cover after each step, with these logarithms of probabilities, of a sky with this seed.
    ///
    /// # Errors
    ///
    /// A lattice that the model refuses.
    pub fn cover(&self, x: &[f64], seed: Seed) -> Result<Vec<f64>, Outside> {
        let chance = [0, 1, 2].map(|k| x.get(k).map_or(0.0, |log| libm::exp10(*log).clamp(0.0, 1.0)));
        let injection = Injection { seed, chance: Chance::Uniform(chance) };
        let mut clouds = Packed::new(self.counts, RULES)?;
        let mut cover = Vec::with_capacity(STEPS);
        for _ in 0..STEPS {
            clouds.inject(&injection);
            clouds.step();
            cover.push(clouds.cover());
        }
        Ok(cover)
    }

    /// The curve given, worked out once.
    pub fn wanted(&self, seed: Seed) -> Result<Vec<f64>, Outside> {
        let known = self.wanted.lock().ok().and_then(|wanted| wanted.get(&seed.0).cloned());
        if let Some(curve) = known {
            return Ok(curve);
        }
        let curve = self.cover(&self.truth(seed), seed)?;
        if let Ok(mut wanted) = self.wanted.lock() {
            wanted.insert(seed.0, curve.clone());
        }
        Ok(curve)
    }

    /// The seed of the solver's skies.
    pub fn own(seed: Seed) -> Seed {
        Seed(seed.0.wrapping_add(1 << 32))
    }
}

/// Mean square of the difference of two curves over that of the second.
fn apart(found: &[f64], wanted: &[f64]) -> f64 {
    let off: f64 = found.iter().zip(wanted).map(|(found, wanted)| (found - wanted) * (found - wanted)).sum();
    off / wanted.iter().map(|wanted| wanted * wanted).sum::<f64>().max(1e-300)
}

impl Problem for CoverProblem {
    fn name(&self) -> String {
        self.name.to_owned()
    }

    fn domain(&self) -> Vec<(f64, f64)> {
        DOMAIN.to_vec()
    }

    /// Uniform in the box, with every seed another.
    fn start(&self, seed: Seed) -> Vec<f64> {
        drawn(seed, "cover: start", &DOMAIN, 0.0, 1.0)
    }

    /// A sky that stays clear.
    fn scale(&self) -> f64 {
        1.0
    }

    /// A fortieth of a decade: less is lost in chance.
    fn difference(&self) -> f64 {
        0.025
    }

    fn targets(&self) -> Vec<Target> {
        TARGETS.map(Target::within).to_vec()
    }

    fn measure(&self, x: &[f64], seed: Seed) -> Result<Measure, Error> {
        Ok(Measure::of_cost(apart(&self.cover(x, Self::own(seed))?, &self.wanted(seed)?)))
    }
}

/// The suite: few cells, and six times as many.
pub fn suite() -> Vec<CoverProblem> {
    vec![CoverProblem::new("cover-rough", [32, 32, 16]), CoverProblem::new("cover-calm", [64, 64, 24])]
}

/// The suite as problems of any kind.
pub fn boxed(problems: Vec<CoverProblem>) -> Suite {
    problems.into_iter().map(|problem| Box::new(problem) as Box<_>).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hidden_probabilities_follow_the_curve_but_for_chance() {
        for problem in suite() {
            let seed = Seed(2);
            let truth = problem.truth(seed);
            assert_eq!(apart(&problem.cover(&truth, seed).unwrap(), &problem.wanted(seed).unwrap()), 0.0);
            let chance = problem.measure(&truth, seed).unwrap().cost;
            assert!(chance > 0.0);
            for k in 0..3 {
                for step in [-0.7, 0.7] {
                    let mut other = truth.clone();
                    other[k] += step;
                    let cost = problem.measure(&other, seed).unwrap().cost;
                    assert!(cost > chance, "{} {k} {step}: {cost} for {chance}", problem.name());
                }
            }
        }
    }

    #[test]
    fn no_corner_of_the_box_is_refused() {
        for problem in suite() {
            for corner in 0..8 {
                let face = |k: usize| if corner >> k & 1 == 0 { DOMAIN[k].0 } else { DOMAIN[k].1 };
                let cost = problem.measure(&[face(0), face(1), face(2)], Seed(1)).unwrap().cost;
                assert!(cost.is_finite() && cost > 0.0, "{} {corner}: {cost}", problem.name());
            }
        }
    }

    #[test]
    fn a_curve_that_is_half_is_off_by_half() {
        assert_eq!(apart(&[0.1, 0.2], &[0.2, 0.4]), 0.25);
        assert_eq!(apart(&[0.0, 0.0], &[0.2, 0.4]), 1.0);
    }
}
