//! Clusters of percolation in unbounded space: the clouds that one active cell grows in vapour that does not change
//! (`dobashi/growth` shows that the rules grow just these), as by Leath, *Cluster size and boundary distribution near
//! percolation threshold*, Physical Review B 14, 1976.

use std::collections::BTreeSet;

use snowglobe::regions::Region;
use snowglobe::rng::{Moment, Seed};

/// The cluster of the origin.
pub struct Cluster<'a> {
    reached: &'a [[isize; 3]],
    vapour: f64,
    dice: Moment,
}

impl<'a> Cluster<'a> {
    /// Growth goes on from a cell to those that it has `reached`, where there is vapour, of this probability; `cloud` is
    /// which of the seed's it is.
    pub fn new(reached: &'a [[isize; 3]], vapour: f64, seed: u64, cloud: u64) -> Self {
        Self { reached, vapour, dice: Seed(seed).stream("percolation").at(cloud) }
    }

    /// Whether there is vapour in a cell.
    pub fn passes(&self, [x, y, z]: [i32; 3]) -> bool {
        self.dice.place(x, y, z).uniform() < self.vapour
    }

    /// Its cells; fewer where they become `most` or more, and then true.
    pub fn cells(&self, most: usize) -> (Vec<[i32; 3]>, bool) {
        let (mut cells, mut seen) = (vec![[0; 3]], BTreeSet::from([[0; 3]]));
        let mut next = 0;
        while next < cells.len() {
            if cells.len() >= most {
                return (cells, true);
            }
            let [x, y, z] = cells[next];
            for [i, j, k] in self.reached {
                let there = [x + *i as i32, y + *j as i32, z + *k as i32];
                if seen.insert(there) && self.passes(there) {
                    cells.push(there);
                }
            }
            next += 1;
        }
        (cells, false)
    }

    /// What is seen of it from above, as one region.
    pub fn shadow(&self, most: usize) -> Region {
        let (cells, cut) = self.cells(most);
        let pixels: BTreeSet<[i32; 2]> = cells.iter().map(|[x, y, _]| [*x, *y]).collect();
        let beside = |[x, y]: [i32; 2]| [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]];
        let outside = || pixels.iter().flat_map(|at| beside(*at)).filter(|at| !pixels.contains(at));
        Region {
            area: pixels.len() as u64,
            neighbours: outside().collect::<BTreeSet<_>>().len() as u64,
            edges: outside().count() as u64,
            cut,
        }
    }
}

#[cfg(test)]
mod tests {
    use snowglobe::automaton_cloud::{Field, Packed};

    use super::super::setup::{MENDED, REACHED};
    use super::*;

    /// A cloud that stays within a lattice is cell by cell what the rules grow there.
    #[test]
    fn the_rules_grow_these_clouds() {
        let side = 40_usize;
        let mut compared = 0;
        for cloud in 0..200 {
            let cluster = Cluster::new(&REACHED, 0.15, 3, cloud);
            let (cells, cut) = cluster.cells(2000);
            let within = |cell: &[i32; 3]| cell.iter().all(|at| at.abs() < side as i32 / 2 - 2);
            if cut || cells.len() < 100 || !cells.iter().all(within) {
                continue;
            }
            let place = |number: usize| {
                [number % side, number / side % side, number / (side * side)]
                    .map(|at| at as i32 - side as i32 / 2)
            };
            let all = 0..side * side * side;
            let hum: Vec<u8> = all.clone().map(|number| u8::from(cluster.passes(place(number)))).collect();
            let act: Vec<u8> = all.clone().map(|number| u8::from(place(number) == [0; 3])).collect();
            let mut clouds = Packed::new([side; 3], MENDED).unwrap();
            clouds.set(Field::Hum, &hum).unwrap();
            clouds.set(Field::Act, &act).unwrap();
            (0..200).for_each(|_| clouds.step());
            let cells: BTreeSet<[i32; 3]> = cells.into_iter().collect();
            let cld = clouds.cld();
            assert!(
                all.clone().all(|number| (cld[number] == 1) == cells.contains(&place(number))),
                "{cloud}"
            );
            compared += 1;
        }
        assert!(compared > 5, "{compared}");
    }

    #[test]
    fn a_lone_cell_has_four_sides() {
        let lone = Cluster::new(&REACHED, 0.0, 1, 0).shadow(10);
        assert_eq!(lone, Region { area: 1, neighbours: 4, edges: 4, cut: false });
    }
}
