//! The tree's coefficients from its motion (Sakai §6 gives them without saying where they are from): which restoring and
//! wind coefficients make the model move as a tree that was filmed?
//!
//! The film is the model's own with coefficients that the solver is not told, so that a cost of 0 is known to exist.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use argmin::core::Error;

use super::{Suite, drawn};
use crate::optimize::contest::{Measure, Problem, Target};
use crate::reading::Reading;
use crate::rng::Seed;
use crate::tree::{Parameters, ReadingSet, Setting, Skeleton, Sway, Tree, TreeError, Vector, papers_tree};

/// Distances by which the nodes may be off, m, as a root mean square over nodes and frames.
pub const TARGETS: [f64; 5] = [0.1, 0.01, 0.003, 0.001, 0.0003];
/// The gust: the speed that comes in during each third of the film, m/s. It sets the tree moving, bends it and lets go.
const GUST: [f64; 3] = [5.0, 10.0, 2.0];
/// Steps between two frames of the film.
const STEPS_PER_FRAME: u32 = 20;
/// Frames of each third.
const FRAMES: u32 = 8;

/// What is sought, as decimal logarithms: the restoring coefficient in N/m2 and the wind coefficient in kg/(m2 s).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Range {
    restoring: (f64, f64),
    wind: (f64, f64),
    /// A step that the stiffest tree of the range allows, s.
    dt: f64,
}

/// The places of all nodes in every frame, m.
type Film = Vec<Vector>;

/// The restoring and the wind coefficient of a film, under one set of readings.
#[derive(Clone, Debug)]
pub struct CoefficientProblem {
    set: ReadingSet,
    range: Range,
    skeleton: Skeleton,
    films: Arc<Mutex<BTreeMap<u64, Arc<Film>>>>,
}

impl CoefficientProblem {
    /// The paper's tree under this set; none for `literal`, whose tree thrashes about whatever its coefficients are.
    ///
    /// # Errors
    ///
    /// None for the paper's tree.
    pub fn new(set: ReadingSet) -> Result<Option<Self>, TreeError> {
        let range = match set {
            ReadingSet::Paper => Range { restoring: (3.3, 4.3), wind: (-1.7, -0.5), dt: 0.003 },
            // From just above the critical coefficient, and to a wind that is a real drag.
            ReadingSet::Physical => Range { restoring: (5.42, 6.2), wind: (-1.0, 0.5), dt: 0.006 },
            ReadingSet::Literal => return Ok(None),
        };
        let structure = papers_tree().map_err(|_| TreeError::Shape("the paper's tree cannot be derived"))?;
        let skeleton = Skeleton::new(&structure, 6.67, [0.05, 0.02])?;
        Ok(Some(Self { set, range, skeleton, films: Arc::default() }))
    }

    /// The coefficients that the film with this seed was made with: uniform in the middle half of the box.
    pub fn truth(&self, seed: Seed) -> Vec<f64> {
        drawn(seed, "coefficients", &self.domain(), 0.25, 0.5)
    }

    /// The film of a tree with these coefficients, as logarithms.
    ///
    /// # Errors
    ///
    /// Coefficients that the model refuses.
    pub fn film(&self, x: &[f64]) -> Result<Vec<Vector>, TreeError> {
        let &[restoring, wind] = x else {
            return Err(TreeError::Shape("two coefficients are needed, restoring and wind"));
        };
        let parameters =
            Parameters { restoring: libm::exp10(restoring), wind: libm::exp10(wind), ..Parameters::PRINTED };
        let tree = Tree::new(self.skeleton.clone(), parameters, self.set.readings())?;
        let air =
            Setting { size: [10.0; 2], cells: [16; 2], viscosity: 1.5e-5, wind: GUST[0], dt: self.range.dt };
        let mut sway = Sway::new(tree, air)?;
        let mut film = Vec::new();
        for speed in GUST {
            sway.set_wind(speed);
            for _ in 0..FRAMES {
                for _ in 0..STEPS_PER_FRAME {
                    sway.step()?;
                }
                film.extend((1..self.skeleton.nodes()).map(|node| sway.tree().place(node)));
            }
        }
        Ok(film)
    }

    fn wanted(&self, seed: Seed) -> Result<Arc<Film>, TreeError> {
        let known = self.films.lock().ok().and_then(|films| films.get(&seed.0).cloned());
        if let Some(film) = known {
            return Ok(film);
        }
        let film = Arc::new(self.film(&self.truth(seed))?);
        if let Ok(mut films) = self.films.lock() {
            films.insert(seed.0, Arc::clone(&film));
        }
        Ok(film)
    }
}

impl Problem for CoefficientProblem {
    fn name(&self) -> String {
        format!("coefficients-{}", self.set.name())
    }

    fn domain(&self) -> Vec<(f64, f64)> {
        vec![self.range.restoring, self.range.wind]
    }

    /// Uniform in the box, with every seed another.
    fn start(&self, seed: Seed) -> Vec<f64> {
        drawn(seed, "start", &self.domain(), 0.0, 1.0)
    }

    /// Nodes that are off by a metre, m2.
    fn scale(&self) -> f64 {
        1.0
    }

    /// The model is smooth in its coefficients but for the cells of air that a node crosses.
    fn difference(&self) -> f64 {
        1e-4
    }

    fn targets(&self) -> Vec<Target> {
        TARGETS.map(Target::within).to_vec()
    }

    fn measure(&self, x: &[f64], seed: Seed) -> Result<Measure, Error> {
        let (wanted, film) = (self.wanted(seed)?, self.film(x)?);
        let squares: f64 = wanted.iter().zip(&film).map(|(a, b)| (a - b).norm_squared()).sum();
        Ok(Measure::of_cost(squares / film.len() as f64))
    }
}

/// The suite: the sets of readings whose tree stands.
pub fn suite() -> Vec<CoefficientProblem> {
    ReadingSet::ALL.iter().filter_map(|set| CoefficientProblem::new(*set).ok().flatten()).collect()
}

/// The suite as problems of any kind.
pub fn boxed(problems: Vec<CoefficientProblem>) -> Suite {
    problems.into_iter().map(|problem| Box::new(problem) as Box<_>).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hidden_coefficients_cost_nothing_and_others_something() {
        for problem in suite() {
            let seed = Seed(3);
            let truth = problem.truth(seed);
            assert_eq!(problem.measure(&truth, seed).unwrap().cost, 0.0, "{}", problem.name());
            for k in 0..2 {
                let mut other = truth.clone();
                other[k] += 0.05;
                let cost = problem.measure(&other, seed).unwrap().cost;
                assert!(cost > 1e-6, "{} {k}: {cost}", problem.name());
            }
        }
    }

    /// The step is let pass at every corner of the box.
    #[test]
    fn no_corner_of_the_box_is_refused() {
        for problem in suite() {
            let faces = problem.domain();
            for corner in 0..4 {
                let face = |k: usize| if corner >> k & 1 == 0 { faces[k].0 } else { faces[k].1 };
                let cost = problem.measure(&[face(0), face(1)], Seed(1)).unwrap().cost;
                assert!(cost.is_finite() && cost > 0.0, "{} {corner}: {cost}", problem.name());
            }
        }
    }
}
