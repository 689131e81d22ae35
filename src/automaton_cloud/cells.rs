//! The automaton as its rules read: a byte for each variable of each cell.

use super::{Activation, Brackets, Field, Lock, Rules};

/// The most cells that are handled: 1024 of them along each side.
const MOST_CELLS: usize = 1 << 30;

/// Why there is no such lattice, or no such state of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Outside {
    /// A side without cells, or too many cells.
    #[error("{0} x {1} x {2} cells; at least 1 x 1 x 1 and at most {MOST_CELLS} in all are handled")]
    Counts(usize, usize, usize),
    /// Not a value for each cell.
    #[error("{found} values for {cells} cells")]
    Values {
        /// Cells of the lattice.
        cells: usize,
        /// Values given.
        found: usize,
    },
    /// Neither 0 nor 1.
    #[error("the value of cell {cell} is {value}; 0 and 1 are accepted")]
    Value {
        /// Its number, x fastest, then y.
        cell: usize,
        /// What it is.
        value: u8,
    },
}

/// The state of all cells, x fastest, then y, then z.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cells {
    counts: [usize; 3],
    /// There is vapour.
    pub hum: Vec<u8>,
    /// Vapour turns into cloud.
    pub act: Vec<u8>,
    /// There is cloud.
    pub cld: Vec<u8>,
    /// Cloud vanishes.
    pub ext: Vec<u8>,
    /// Steps for which the cell is still locked.
    pub locked: Vec<u8>,
}

/// Checks the number of cells along x, y and z, and gives their product.
pub(super) fn check(counts: [usize; 3]) -> Result<usize, Outside> {
    let [x, y, z] = counts;
    let cells = x.checked_mul(y).and_then(|plane| plane.checked_mul(z)).unwrap_or(usize::MAX);
    if cells == 0 || cells > MOST_CELLS { Err(Outside::Counts(x, y, z)) } else { Ok(cells) }
}

impl Cells {
    /// A lattice of so many cells along x, y and z, all 0.
    ///
    /// # Errors
    ///
    /// No cells, or too many.
    pub fn new(counts: [usize; 3]) -> Result<Self, Outside> {
        let none = vec![0; check(counts)?];
        Ok(Self {
            counts,
            hum: none.clone(),
            act: none.clone(),
            cld: none.clone(),
            ext: none.clone(),
            locked: none,
        })
    }

    /// Cells along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// A variable of every cell.
    pub fn field(&self, field: Field) -> &[u8] {
        match field {
            Field::Hum => &self.hum,
            Field::Act => &self.act,
            Field::Ext => &self.ext,
        }
    }

    /// Sets a variable of every cell.
    ///
    /// # Errors
    ///
    /// Not one value for each cell, or one that is neither 0 nor 1.
    pub fn set(&mut self, field: Field, values: &[u8]) -> Result<(), Outside> {
        let cells = self.cld.len();
        if values.len() != cells {
            return Err(Outside::Values { cells, found: values.len() });
        }
        if let Some(cell) = values.iter().position(|value| *value > 1) {
            return Err(Outside::Value { cell, value: values[cell] });
        }
        match field {
            Field::Hum => self.hum.copy_from_slice(values),
            Field::Act => self.act.copy_from_slice(values),
            Field::Ext => self.ext.copy_from_slice(values),
        }
        Ok(())
    }

    /// The state at t + 1: Eq. (1), (3), (4) and (5), which without ext is Eq. (2), and the lifetime of §2.2.
    pub fn step(&self, rules: &Rules) -> Self {
        let mut next = self.clone();
        let [nx, ny, nz] = self.counts.map(|count| count as isize);
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    self.step_cell([i, j, k], rules, &mut next);
                }
            }
        }
        next
    }

    fn step_cell(&self, [i, j, k]: [isize; 3], rules: &Rules, next: &mut Self) {
        let at = self.number([i, j, k]).unwrap_or_default();
        let near = |field: &[u8]| {
            self.on(field, [i + 1, j, k])
                || self.on(field, [i - 1, j, k])
                || self.on(field, [i, j + 1, k])
                || self.on(field, [i, j - 1, k])
                || self.on(field, [i, j, k + 1])
                || self.on(field, [i, j, k - 1])
        };
        let far = |field: &[u8]| {
            self.on(field, [i + 2, j, k])
                || self.on(field, [i - 2, j, k])
                || self.on(field, [i, j + 2, k])
                || self.on(field, [i, j - 2, k])
                || self.on(field, [i, j, k - 2])
        };
        let spreads = |gate: bool, field: &[u8]| match rules.brackets {
            Brackets::AsPrinted => gate && near(field) || far(field),
            Brackets::Mended => gate && (near(field) || far(field)),
        };
        let [hum, act, cld, ext] = [&self.hum, &self.act, &self.cld, &self.ext].map(|field| field[at] == 1);
        let first = match rules.activation {
            Activation::AsPrinted => act,
            Activation::Negated => !act,
        };

        let next_act = spreads(first && hum, &self.act); // (1)
        let next_hum = hum && !act; // (3)
        let next_ext = spreads(!ext && cld, &self.ext); // (4)
        let next_cld = !ext && (cld || act); // (5)

        let locked = self.locked[at] > 0;
        let kept = locked && rules.lock == Lock::All;
        next.hum[at] = u8::from(if kept { hum } else { next_hum });
        next.act[at] = u8::from(if kept { act } else { next_act });
        next.ext[at] = u8::from(if kept { ext } else { next_ext });
        next.cld[at] = u8::from(next_cld || locked);
        next.locked[at] =
            if next.cld[at] == 1 && !cld { rules.lifetime } else { self.locked[at].saturating_sub(1) };
    }

    /// The number of a cell; none outside.
    fn number(&self, place: [isize; 3]) -> Option<usize> {
        let [nx, ny, _] = self.counts;
        let inside = (0..3).all(|axis| (0..self.counts[axis] as isize).contains(&place[axis]));
        inside.then(|| (place[2] as usize * ny + place[1] as usize) * nx + place[0] as usize)
    }

    fn on(&self, field: &[u8], place: [isize; 3]) -> bool {
        self.number(place).is_some_and(|cell| field[cell] == 1)
    }

    /// The share of cells with cloud.
    pub fn cover(&self) -> f64 {
        self.cld.iter().map(|cld| u64::from(*cld)).sum::<u64>() as f64 / self.cld.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::Reading;

    const MENDED: Rules =
        Rules { activation: Activation::Negated, brackets: Brackets::Mended, lock: Lock::Cld, lifetime: 0 };

    /// Where a cell that is active alone among vapour activates: eleven cells, two above but not two below, since (1) at k
    /// reads k - 2.
    #[test]
    fn the_stencil_is_that_of_the_page() {
        let mut cells = Cells::new([7, 7, 7]).unwrap();
        let centre = cells.number([3, 3, 3]).unwrap();
        cells.hum.fill(1);
        cells.act[centre] = 1;
        let next = cells.step(&MENDED);
        let mut reached = Vec::new();
        for k in 0..7 {
            for j in 0..7 {
                for i in 0..7 {
                    if next.act[cells.number([i, j, k]).unwrap()] == 1 {
                        reached.push([i - 3, j - 3, k - 3]);
                    }
                }
            }
        }
        reached.sort_unstable();
        let mut known = vec![
            [1, 0, 0],
            [-1, 0, 0],
            [0, 1, 0],
            [0, -1, 0],
            [0, 0, 1],
            [0, 0, -1],
            [2, 0, 0],
            [-2, 0, 0],
            [0, 2, 0],
            [0, -2, 0],
            [0, 0, 2],
        ];
        known.sort_unstable();
        assert_eq!(reached, known);
        assert_eq!((next.cld[centre], next.hum[centre], next.act[centre]), (1, 0, 0));
        assert_eq!(next.cld.iter().filter(|cld| **cld == 1).count(), 1, "cloud follows act by a step");
    }

    /// As printed nothing but what is already active activates from near; from afar everything does, vapour or none.
    #[test]
    fn as_printed_far_cells_need_no_vapour_and_near_ones_must_be_active() {
        let rules = Rules { activation: Activation::AsPrinted, brackets: Brackets::AsPrinted, ..MENDED };
        let mut cells = Cells::new([5, 5, 5]).unwrap();
        let at = |place| cells.number(place).unwrap();
        let (centre, near, far) = (at([2, 2, 2]), at([3, 2, 2]), at([4, 2, 2]));
        cells.act[centre] = 1;
        let next = cells.step(&rules);
        assert_eq!((next.act[near], next.act[far]), (0, 1));
        cells.hum[near] = 1;
        assert_eq!(cells.step(&rules).act[near], 0);
        cells.act[near] = 1;
        assert_eq!(cells.step(&rules).act[near], 1);
        let mended = Rules { brackets: Brackets::Mended, ..rules };
        assert_eq!(cells.step(&mended).act[far], 0, "there is no vapour");
    }

    /// Growth without extinction: cloud at t is what is within t - 1 steps of the seeds through vapour.
    #[test]
    fn growth_is_breadth_first() {
        let counts = [13, 9, 11];
        let mut cells = Cells::new(counts).unwrap();
        let moment = crate::rng::Seed(4).stream("vapour").at(0);
        for (number, hum) in cells.hum.iter_mut().enumerate() {
            *hum = u8::from(moment.place(number as i32, 0, 0).uniform() < 0.6);
        }
        let seeds = [cells.number([2, 4, 3]).unwrap(), cells.number([10, 2, 8]).unwrap()];
        let mut distance = vec![usize::MAX; cells.hum.len()];
        let mut front = Vec::new();
        for seed in seeds {
            (cells.act[seed], distance[seed]) = (1, 0);
            front.push(seed);
        }
        let offsets: [[isize; 3]; 11] = [
            [1, 0, 0],
            [-1, 0, 0],
            [0, 1, 0],
            [0, -1, 0],
            [0, 0, 1],
            [0, 0, -1],
            [2, 0, 0],
            [-2, 0, 0],
            [0, 2, 0],
            [0, -2, 0],
            [0, 0, 2],
        ];
        let place = |cell: usize| [cell % 13, cell / 13 % 9, cell / 117].map(|x| x as isize);
        for steps in 1..60 {
            let mut next = Vec::new();
            for cell in &front {
                for offset in offsets {
                    let here = place(*cell);
                    let there = cells.number([0, 1, 2].map(|k| here[k] + offset[k]));
                    let fresh = |cell: &usize| distance[*cell] == usize::MAX && cells.hum[*cell] == 1;
                    if let Some(there) = there.filter(fresh) {
                        distance[there] = steps;
                        next.push(there);
                    }
                }
            }
            front = next;
        }
        let mut now = cells.clone();
        for t in 1..20 {
            now = now.step(&MENDED);
            let known: Vec<u8> = distance.iter().map(|d| u8::from(*d < t)).collect();
            assert!(now.cld == known, "at {t}");
        }
        assert!(now.cover() > 0.3);
    }

    /// After cells have been set to vanish, what survives is what cannot be reached through cloud.
    #[test]
    fn extinction_takes_what_it_can_reach_through_cloud() {
        let mut cells = Cells::new([12, 3, 3]).unwrap();
        for i in [0, 1, 2, 3, 7, 8] {
            let at = cells.number([i, 1, 1]).unwrap();
            cells.cld[at] = 1;
        }
        let first = cells.number([0, 1, 1]).unwrap();
        cells.ext[first] = 1;
        for _ in 0..12 {
            cells = cells.step(&MENDED);
        }
        let left: Vec<usize> = (0..cells.cld.len()).filter(|cell| cells.cld[*cell] == 1).collect();
        assert_eq!(left, [7, 8].map(|i| cells.number([i, 1, 1]).unwrap()));
        assert!(cells.ext.iter().all(|ext| *ext == 0), "it dies with the cloud");
    }

    /// Once cloud, a cell stays for T_ext steps and one, whatever happens to it.
    #[test]
    fn cloud_that_has_come_stays_for_its_lifetime() {
        for lock in Lock::ALL {
            for lifetime in [0_u8, 1, 5] {
                let rules = Rules { lock: *lock, lifetime, ..MENDED };
                let mut cells = Cells::new([1, 1, 1]).unwrap();
                cells.act[0] = 1;
                let mut on = 0;
                for _ in 0..20 {
                    cells = cells.step(&rules);
                    cells.ext[0] = 1;
                    on += u32::from(cells.cld[0]);
                }
                assert_eq!(on, u32::from(lifetime) + 1, "{lock:?}");
            }
        }
    }

    #[test]
    fn what_is_no_state_is_refused() {
        assert_eq!(Cells::new([0, 3, 3]), Err(Outside::Counts(0, 3, 3)));
        assert!(Cells::new([usize::MAX, 3, 3]).is_err());
        let mut cells = Cells::new([2, 2, 1]).unwrap();
        assert_eq!(cells.set(Field::Hum, &[0, 1]), Err(Outside::Values { cells: 4, found: 2 }));
        assert_eq!(cells.set(Field::Act, &[0, 1, 2, 0]), Err(Outside::Value { cell: 2, value: 2 }));
        assert!(cells.set(Field::Ext, &[0, 1, 1, 0]).is_ok());
    }
}
