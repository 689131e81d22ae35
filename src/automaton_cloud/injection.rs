//! Cells that are set to 1 at random, at the start and on the way: §2.3.

use std::borrow::Cow;

use super::points::Lattice;
use super::{Cells, Lock, Points, Rules};
use crate::rng::{Moment, Seed};

/// A variable that can be set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Vapour.
    Hum,
    /// The change of vapour into cloud.
    Act,
    /// The vanishing of cloud.
    Ext,
}

impl Field {
    /// All three, in the order of probabilities.
    pub const ALL: [Self; 3] = [Self::Hum, Self::Act, Self::Ext];

    fn name(self) -> &'static str {
        match self {
            Self::Hum => "hum",
            Self::Act => "act",
            Self::Ext => "ext",
        }
    }
}

/// With what probability a cell that is 0 becomes 1 in a step: of hum, act and ext.
#[derive(Clone, Debug, PartialEq)]
pub enum Chance {
    /// The same everywhere and always.
    Uniform([f64; 3]),
    /// Interpolated from those of representative points, which may move.
    Points(Points),
}

/// What is injected, at every time the same for the same seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Injection {
    /// The seed.
    pub seed: Seed,
    /// The probabilities.
    pub chance: Chance,
}

/// Rows of a plane that are drawn together. Part of the address of a random number: another value is another cloud.
const BAND: usize = 16;

impl Injection {
    /// The random numbers of a variable at a time.
    pub(super) fn moment(&self, field: Field, time: u64) -> Moment {
        self.seed.stream(&format!("automaton: {}", field.name())).at(time)
    }

    /// The probabilities at a time.
    pub(super) fn chances(&self, counts: [usize; 3], time: u64) -> Chances<'_> {
        let over = match &self.chance {
            Chance::Uniform(all) => Over::Everywhere(*all),
            Chance::Points(points) => Over::Lattice(points.lattice(counts, time as f64)),
        };
        Chances { counts, over }
    }
}

enum Over<'a> {
    Everywhere([f64; 3]),
    Lattice(Cow<'a, Lattice>),
}

/// The probabilities of all cells at one time.
pub(super) struct Chances<'a> {
    counts: [usize; 3],
    over: Over<'a>,
}

impl Chances<'_> {
    /// Draws the cells of plane `k` whose variable is set, i and j of each.
    ///
    /// From one to the next as many cells are left out as a geometric distribution says, of the greatest probability in a
    /// band of rows; where that of the cell itself is less, it is drawn whether it counts.
    pub fn sample(&self, moment: &Moment, field: Field, k: usize, found: &mut impl FnMut(usize, usize)) {
        let [nx, ny, _] = self.counts;
        let number = field as usize;
        for first in (0..ny).step_by(BAND) {
            let rows = first..(first + BAND).min(ny);
            let (most, even) = match &self.over {
                Over::Everywhere(all) => (all[number], true),
                Over::Lattice(lattice) => (lattice.most(number, rows.clone(), k), false),
            };
            if most <= 0.0 {
                continue;
            }
            let mut dice = moment.place((first / BAND) as i32, k as i32, 0);
            let rate = libm::log1p(-most.min(1.0));
            let cells = nx * rows.len();
            let mut cell = 0;
            loop {
                if most < 1.0 {
                    let gap = libm::log(dice.uniform()) / rate;
                    // Beyond the band, and perhaps beyond whole numbers.
                    if gap >= (cells - cell) as f64 {
                        break;
                    }
                    cell += gap as usize;
                }
                if cell >= cells {
                    break;
                }
                let (i, j) = (cell % nx, first + cell / nx);
                let counts = match &self.over {
                    _ if even => true,
                    Over::Lattice(lattice) => dice.uniform() * most < lattice.at(number, [i, j, k]),
                    Over::Everywhere(_) => true,
                };
                if counts {
                    found(i, j);
                }
                cell += 1;
            }
        }
    }
}

impl Cells {
    /// Sets cells to 1 as §2.3 has it, at time `t`; under [`Lock::All`] none that is locked.
    pub fn inject(&mut self, injection: &Injection, t: u64, rules: &Rules) {
        let [nx, ny, nz] = self.counts();
        let chances = injection.chances(self.counts(), t);
        for field in Field::ALL {
            let moment = injection.moment(field, t);
            for k in 0..nz {
                chances.sample(&moment, field, k, &mut |i, j| {
                    let cell = (k * ny + j) * nx + i;
                    if rules.lock == Lock::All && self.locked[cell] > 0 {
                        return;
                    }
                    match field {
                        Field::Hum => self.hum[cell] = 1,
                        Field::Act => self.act[cell] = 1,
                        Field::Ext => self.ext[cell] = 1,
                    }
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Interpolation, Point};
    use super::*;

    fn drawn(chance: Chance, counts: [usize; 3]) -> Vec<[usize; 3]> {
        let injection = Injection { seed: Seed(2), chance };
        let chances = injection.chances(counts, 3);
        let mut all = Vec::new();
        for k in 0..counts[2] {
            chances.sample(&injection.moment(Field::Hum, 3), Field::Hum, k, &mut |i, j| all.push([i, j, k]));
        }
        all
    }

    /// Within four standard deviations of the binomial distribution, and no cell twice.
    #[test]
    fn as_many_cells_are_set_as_the_probability_says() {
        let counts = [200, 90, 20];
        for p in [1e-4, 0.003, 0.2, 0.9] {
            let mut all = drawn(Chance::Uniform([p, 0.0, 0.0]), counts);
            let cells = 360_000.0;
            let off = all.len() as f64 - p * cells;
            assert!(off.abs() < 4.0 * libm::sqrt(cells * p * (1.0 - p)), "{p}: {}", all.len());
            let found = all.len();
            all.dedup();
            assert_eq!(all.len(), found);
        }
        assert_eq!(drawn(Chance::Uniform([0.0; 3]), counts).len(), 0);
        assert_eq!(drawn(Chance::Uniform([1.0, 0.0, 0.0]), counts).len(), 360_000);
    }

    /// Every slice across each axis has its share.
    #[test]
    fn every_place_is_as_likely() {
        let all = drawn(Chance::Uniform([0.1, 0.0, 0.0]), [60, 60, 60]);
        for axis in 0..3 {
            let squares: f64 = (0..60)
                .map(|at| {
                    let found = all.iter().filter(|place| place[axis] == at).count() as f64;
                    (found - 360.0) * (found - 360.0) / (360.0 * 0.9)
                })
                .sum();
            // 60 degrees of freedom: mean 60, deviation 11.
            assert!((20.0..115.0).contains(&squares), "{axis}: {squares}");
        }
    }

    #[test]
    fn probabilities_of_points_are_met_where_they_are() {
        let point = |x: f64, p: f64| Point { place: [x, 15.0, 5.0], chances: [p, 0.0, 0.0] };
        let points =
            Points::still(vec![point(0.0, 0.4), point(79.0, 0.0)], Interpolation::InverseDistance, 4);
        let counts = [80, 31, 11];
        let expected: f64 = {
            let lattice = points.lattice(counts, 3.0);
            let mut sum = 0.0;
            for k in 0..11 {
                for j in 0..31 {
                    sum += (0..20).map(|i| lattice.at(0, [i, j, k])).sum::<f64>();
                }
            }
            sum
        };
        let all = drawn(Chance::Points(points), counts);
        let found = all.iter().filter(|place| place[0] < 20).count() as f64;
        assert!((found - expected).abs() < 4.0 * libm::sqrt(expected), "{found} for {expected}");
        let far = all.iter().filter(|place| place[0] >= 60).count() as f64;
        assert!(far < 0.3 * found, "{far} {found}");
    }
}
