//! Which cells are one crystal, and how it leans.
//!
//! Frost is many crystals, and each leans a little on the glass: that is why some branches flash and their neighbours
//! do not. Growth is a tree: the parent of a cell is the neighbour that was ice first. A branch is followed from where
//! it begins through the child with the most descendants; a child with fewer is a branch of its own if it is large
//! enough, and a barb of the one it grows on if not.

use super::super::Frost;
use crate::rng::Seed;

/// Descendants that make a child a branch.
const BRANCH: u32 = 5;
/// The greatest lean of a branch against the one it grows on, as a slope.
const LEAN: f64 = 0.2;
/// What of the lean is handed on.
const KEPT: f32 = 0.6;

/// The lean of each cell's branch, as slopes in x and y; none where nothing froze. Stream `lean`, addressed by the cell
/// in which a branch begins.
pub(super) fn leans(frost: &Frost, seed: Seed) -> Vec<[f32; 2]> {
    let region = frost.region();
    let moment = seed.stream("lean").at(0);
    let order = by_age(frost);
    let parents = parents(frost, &order);
    let sizes = sizes(&order, &parents);
    let main = main_children(&order, &parents, &sizes);
    let mut leans = vec![[0.0; 2]; region.len()];
    for &cell in &order {
        let inherited = parents[cell as usize].map(|parent| (parent, leans[parent as usize]));
        leans[cell as usize] = match inherited {
            Some((parent, lean)) if main[parent as usize] == cell || sizes[cell as usize] < BRANCH => lean,
            _ => {
                let at = region.cells()[cell as usize];
                let mut random = moment.place(at.q, at.r, 0);
                let (turn, size) =
                    (2.0 * std::f64::consts::PI * random.uniform(), LEAN * libm::sqrt(random.uniform()));
                let base = inherited.map_or([0.0; 2], |(_, lean)| lean);
                [
                    KEPT * base[0] + (size * libm::cos(turn)) as f32,
                    KEPT * base[1] + (size * libm::sin(turn)) as f32,
                ]
            }
        };
    }
    leans
}

/// The cells that are ice, the oldest first.
fn by_age(frost: &Frost) -> Vec<u32> {
    let mut order: Vec<(u64, u32)> = (0..frost.region().len())
        .filter_map(|cell| frost.frozen_at_step(cell).map(|step| (step, cell as u32)))
        .collect();
    order.sort_unstable();
    order.into_iter().map(|(_, cell)| cell).collect()
}

/// The neighbour that was ice first, if one was ice before.
fn parents(frost: &Frost, order: &[u32]) -> Vec<Option<u32>> {
    let region = frost.region();
    let mut parents = vec![None; region.len()];
    for &cell in order {
        let born = frost.frozen_at_step(cell as usize);
        let neighbours = region.cells()[cell as usize].neighbours();
        let older = neighbours.iter().filter_map(|at| region.ordinal(*at)).filter_map(|at| {
            let step = frost.frozen_at_step(at).filter(|step| Some(*step) < born)?;
            Some((step, at as u32))
        });
        parents[cell as usize] = older.min().map(|(_, at)| at);
    }
    parents
}

/// Cells of the tree below each cell, itself included.
fn sizes(order: &[u32], parents: &[Option<u32>]) -> Vec<u32> {
    let mut sizes = vec![1; parents.len()];
    for &cell in order.iter().rev() {
        if let Some(parent) = parents[cell as usize] {
            sizes[parent as usize] += sizes[cell as usize];
        }
    }
    sizes
}

/// The child with the most descendants, of equals the oldest; a cell without children has itself.
fn main_children(order: &[u32], parents: &[Option<u32>], sizes: &[u32]) -> Vec<u32> {
    let mut main: Vec<u32> = (0..parents.len() as u32).collect();
    for &cell in order {
        if let Some(parent) = parents[cell as usize] {
            let so_far = main[parent as usize];
            if so_far == parent || sizes[cell as usize] > sizes[so_far as usize] {
                main[parent as usize] = cell;
            }
        }
    }
    main
}
