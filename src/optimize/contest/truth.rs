//! The truth about a problem in one dimension, from a grid: its optimum, its basins, how it goes up and down.

use argmin::core::Error;

use super::problem::Problem;
use super::trial::Trial;
use crate::rng::Seed;

/// What a trial's best x is, by the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rank {
    /// As good as the best of the grid.
    Best,
    /// At the bottom of a basin that is not the best.
    Basin,
    /// Neither: downhill there is better, which the solver did not find.
    Stuck,
    /// Nothing was evaluated.
    Nothing,
}

impl Rank {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Best, Self::Basin, Self::Stuck, Self::Nothing];

    /// `best`, `basin`, `stuck`, `nothing`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Best => "best",
            Self::Basin => "basin",
            Self::Stuck => "stuck",
            Self::Nothing => "nothing",
        }
    }
}

/// The residual of a problem with one seed at equal steps of x, both faces of the box included.
#[derive(Clone, Debug, PartialEq)]
pub struct Landscape {
    /// The points, rising.
    pub x: Vec<f64>,
    /// The residual at each; infinite where the model has no answer.
    pub residual: Vec<f64>,
}

impl Landscape {
    /// The points of a grid of so many steps over the box of a problem in one dimension.
    pub fn points(problem: &dyn Problem, steps: u32) -> Vec<f64> {
        let Some((low, high)) = problem.domain().first().copied() else { return Vec::new() };
        // Rounded, so that a table shows the numbers that were meant.
        let point = |k: u32| low + (high - low) * f64::from(k) / f64::from(steps);
        (0..=steps).map(|k| libm::round(point(k) * 1e9) / 1e9).collect()
    }

    /// Measures one point of a grid.
    ///
    /// # Errors
    ///
    /// Those of the model, and where the problem has no residual.
    pub fn at(problem: &dyn Problem, x: f64, seed: Seed) -> Result<f64, Error> {
        let measure = problem.measure(&[x], seed)?;
        measure.residual.ok_or_else(|| Error::msg("this problem has no residual"))
    }

    /// The least distance from 0 on the grid, and where.
    pub fn optimum(&self) -> Option<(f64, f64)> {
        let misses = self.x.iter().zip(&self.residual).map(|(x, r)| (*x, r.abs()));
        misses.filter(|(_, miss)| miss.is_finite()).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The bottoms of all basins, as (first, last) indices of level ground that rises on either side.
    pub fn basins(&self) -> Vec<(usize, usize)> {
        let cost = |k: usize| self.residual[k].abs();
        let mut basins = Vec::new();
        let mut first = 0;
        while first < self.x.len() {
            let mut last = first;
            while last + 1 < self.x.len() && cost(last + 1) == cost(first) {
                last += 1;
            }
            let falls_from_left = first == 0 || cost(first - 1) > cost(first);
            let rises_to_right = last + 1 == self.x.len() || cost(last + 1) > cost(last);
            if falls_from_left && rises_to_right && cost(first).is_finite() {
                basins.push((first, last));
            }
            first = last + 1;
        }
        basins
    }

    /// The share of steps over which the residual rises with x.
    pub fn rising(&self) -> f64 {
        let steps = self.residual.windows(2).filter(|pair| pair.iter().all(|r| r.is_finite()));
        let (rising, all) =
            steps.fold((0, 0), |(rising, all), pair| (rising + u32::from(pair[1] > pair[0]), all + 1));
        f64::from(rising) / f64::from(all.max(1))
    }

    /// The share of steps over which the residual does not change: where a slope is 0.
    pub fn level(&self) -> f64 {
        let level = self.residual.windows(2).filter(|pair| pair[0] == pair[1]).count();
        level as f64 / (self.residual.len().max(2) - 1) as f64
    }

    /// What the best x of a trial is. Costs are told apart to half a unit of the residual (half a frame).
    pub fn rank(&self, trial: &Trial) -> Rank {
        const TOLD_APART: f64 = 0.5;
        let (Some(best), Some((_, optimum))) = (trial.best(), self.optimum()) else { return Rank::Nothing };
        let miss = libm::sqrt(best.cost);
        if miss <= optimum + TOLD_APART {
            return Rank::Best;
        }
        match miss <= self.bottom_below(best.x[0]) + TOLD_APART {
            true => Rank::Basin,
            false => Rank::Stuck,
        }
    }

    /// The residual's size where one comes to by walking downhill on the grid from an x, over level ground too.
    fn bottom_below(&self, x: f64) -> f64 {
        let right = self.x.partition_point(|at| *at < x).min(self.x.len() - 1);
        let left = right.saturating_sub(usize::from(self.x[right] != x));
        let cost = |k: usize| self.residual[k].abs();
        let walk = |from: usize, step: isize| {
            let mut at = from;
            while let Some(next) = at.checked_add_signed(step).filter(|next| *next < self.x.len()) {
                if cost(next) > cost(at) {
                    break;
                }
                at = next;
            }
            cost(at)
        };
        walk(left, -1).min(walk(right, 1)).min(walk(left, 1)).min(walk(right, -1))
    }
}
