//! Frost in several dimensions (Amano §5, outlook): an initial value for each sector around the start, so that ice is at
//! the border in every direction in the frame that was asked for.

use argmin::core::Error;

use super::Suite;
use super::frost::{first_value, parameters};
use crate::frost::{Directions, FrostError, Misses, SectorObjective, Sectors, TSim};
use crate::hexgrid::{Axial, Region};
use crate::optimize::contest::{Measure, Problem, Target};
use crate::rng::Seed;

/// The initial values among which is sought: below, ice takes for ever; above, the vapour turns to ice by itself.
pub const DOMAIN: (f64, f64) = (0.05, 0.85);
/// Numbers of sectors.
pub const SECTORS: [usize; 4] = [2, 3, 6, 12];
/// Thresholds.
pub const THRESHOLDS: [f64; 2] = [0.0, 0.8];
/// The frame in which ice is to be at the border.
pub const TARGET: f64 = 80.0;
/// Frames by which an arrival may miss, as a root mean square over the directions.
pub const TARGETS: [f64; 5] = [16.0, 8.0, 4.0, 2.0, 1.0];
/// Ice that is not there by this multiple of the target counts as arriving then.
const GIVEN_UP: f64 = 3.0;
/// The share of a direction's border that must be ice.
const SHARE: f64 = 0.9;

/// A sketch with a start far from its middle, so that ice reaches the near border long before the far one.
#[derive(Clone, Debug)]
pub struct SectorProblem {
    threshold: f64,
    region: Region,
    start: [Axial; 1],
    sectors: Sectors,
    directions: Directions,
}

impl SectorProblem {
    /// The sketch with so many sectors and this threshold.
    ///
    /// # Errors
    ///
    /// Fewer than one sector, or more than are handled.
    pub fn new(sectors: usize, threshold: f64) -> Result<Self, FrostError> {
        let (region, start) = (Region::disc(90), [Axial::new(-4, 0)]);
        let sectors = Sectors::around(&region, start[0], sectors)?;
        let everywhere = Sectors::around(&region, start[0], Directions::USUAL)?;
        let directions = Directions::new(&region, &everywhere, SHARE)?;
        Ok(Self { threshold, region, start, sectors, directions })
    }

    /// Number of sectors.
    pub fn sectors(&self) -> usize {
        self.sectors.count()
    }

    /// The threshold.
    pub fn threshold(&self) -> f64 {
        self.threshold
    }

    /// The objective with a seed.
    pub fn objective(&self, seed: Seed) -> SectorObjective<'_> {
        SectorObjective {
            region: &self.region,
            starts: &self.start,
            parameters: parameters(self.threshold, 9),
            // Without a threshold chance does not enter.
            seed: if self.threshold == 0.0 { Seed(0) } else { seed },
            sectors: self.sectors.clone(),
            directions: self.directions.clone(),
            target: TARGET,
            t_sim: TSim::Interpolated,
            frame_limit: (GIVEN_UP * TARGET) as u64,
        }
    }

    /// The arrivals with this vapour in each sector.
    ///
    /// # Errors
    ///
    /// Those of the model.
    pub fn misses(&self, betas: &[f64], seed: Seed) -> Result<Misses, FrostError> {
        self.objective(seed).misses(betas)
    }
}

impl Problem for SectorProblem {
    fn name(&self) -> String {
        format!("sectors-{}-{}", self.sectors(), self.threshold)
    }

    fn domain(&self) -> Vec<(f64, f64)> {
        vec![DOMAIN; self.sectors()]
    }

    /// The same in every sector: the paper's 0.25 with seed 1, else uniform from 0.2 to 0.75.
    fn start(&self, seed: Seed) -> Vec<f64> {
        vec![first_value(seed); self.sectors()]
    }

    /// The cost of ice that arrives nowhere.
    fn scale(&self) -> f64 {
        let miss = (GIVEN_UP - 1.0) * TARGET;
        miss * miss
    }

    /// A hundredth in beta, as in one dimension.
    fn difference(&self) -> f64 {
        0.01 / (DOMAIN.1 - DOMAIN.0)
    }

    fn targets(&self) -> Vec<Target> {
        TARGETS.map(Target::within).to_vec()
    }

    fn measure(&self, x: &[f64], seed: Seed) -> Result<Measure, Error> {
        Ok(Measure::of_cost(self.misses(x, seed)?.mean_square()))
    }
}

/// The suite.
pub fn suite() -> Vec<SectorProblem> {
    THRESHOLDS.iter().flat_map(|th| SECTORS.map(|n| SectorProblem::new(n, *th))).flatten().collect()
}

/// The suite as problems of any kind.
pub fn boxed(problems: Vec<SectorProblem>) -> Suite {
    problems.into_iter().map(|problem| Box::new(problem) as Box<_>).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sectors nest: equal values in two, six and twelve sectors are one value.
    #[test]
    fn the_same_value_everywhere_costs_the_same_in_any_number_of_sectors() {
        for threshold in THRESHOLDS {
            let cost = |n: usize| {
                SectorProblem::new(n, threshold).unwrap().measure(&vec![0.3; n], Seed(1)).unwrap().cost
            };
            assert_eq!(SECTORS.map(cost), [cost(1); 4]);
        }
    }

    #[test]
    fn vapour_that_no_cell_can_hold_is_an_error_and_not_a_panic() {
        assert!(SectorProblem::new(2, 0.0).unwrap().measure(&[-1.0, 0.3], Seed(1)).is_err());
        assert!(SectorProblem::new(2, 0.0).unwrap().measure(&[0.3], Seed(1)).is_err());
    }
}
