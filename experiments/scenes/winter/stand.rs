//! Where trees stand: around a clearing that opens towards the camera, high at its sides and lower in the middle.

use snowglobe::lab::Result;
use snowglobe::rng::Seed;

use super::bare::{Bare, Habit};
use super::ground::Ground;
use super::spruce::Spruce;

/// A place for a spruce: where, how high, how much of it is without boughs, how much snow is on it.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// x and z, m.
    pub place: [f64; 2],
    /// m.
    pub height: f64,
    /// Share of the height.
    pub bare: f64,
    /// Share of the boughs.
    pub snow: f64,
}

/// The widest that a picture may be: x over z at its edge.
const WIDEST: f64 = 0.80;
/// Where the wood ends, m.
const DEEP: f64 = 110.0;
/// Tries to place a tree.
const TRIES: i32 = 9000;

/// How far the edge of the wood is in a direction, x over z.
fn edge(across: f64) -> f64 {
    let off = (across + 0.06).abs();
    (24.0 - 34.0 * off * off / (off + 0.14)).max(11.5)
}

/// How high the wood's tops are seen in a direction, height over distance.
fn tops(across: f64) -> f64 {
    let off = (across + 0.06).abs();
    0.172 + 2.3 * off * off / (off + 0.13)
}

/// The spots of the wood, the farthest first.
pub fn spots(seed: Seed) -> Vec<Spot> {
    let dice = seed.stream("winter: wood").at(0);
    let mut spots: Vec<Spot> = YOUNG
        .iter()
        .map(|[across, z, height]| Spot { place: [across * z, *z], height: *height, bare: 0.0, snow: 0.45 })
        .collect();
    for k in 0..TRIES {
        let mut of_spot = dice.place(k, 0, 0);
        let mut random = || of_spot.uniform();
        let across = WIDEST * (2.0 * random() - 1.0);
        let share = random();
        // As many in each metre near the edge as far behind it, and so fewer to the square metre.
        let near = edge(across);
        let z = near + (DEEP - near) * share * share;
        let place = [across * z, z];
        let behind = z - near;
        let apart = 1.75 + 0.055 * behind;
        let free = |spot: &Spot| {
            let [dx, dz] = [0, 1].map(|axis| spot.place[axis] - place[axis]);
            dx * dx + dz * dz > apart * apart
        };
        if !spots.iter().all(free) {
            continue;
        }
        let wanted = z * tops(across) * (0.70 + 0.42 * random()) + 2.4;
        let height = wanted.clamp(2.6 + 3.0 * random(), 15.0 + 4.0 * random());
        let deep = (behind / 8.0).min(1.0);
        spots.push(Spot {
            place,
            height,
            bare: if behind < 3.0 { 0.02 } else { 0.16 * random() },
            snow: (0.04 + 0.33 * random()) * (1.0 - 0.7 * deep),
        });
    }
    spots.sort_by(|a, b| b.place[1].total_cmp(&a.place[1]));
    spots
}

/// Young spruces before the edge: x over z, z and height, m.
const YOUNG: [[f64; 3]; 7] = [
    [-0.30, 13.4, 2.3],
    [-0.215, 15.8, 1.5],
    [0.355, 11.9, 1.35],
    [0.29, 14.2, 2.9],
    [0.17, 18.2, 1.9],
    [-0.09, 20.5, 1.2],
    [-0.43, 10.6, 1.9],
];

/// Grows the spruces.
pub fn spruces(spots: &[Spot], ground: &Ground, seed: Seed) -> Vec<Spruce> {
    let grown = |(number, spot): (usize, &Spot)| {
        let [x, z] = spot.place;
        let foot = [x, ground.height(spot.place), z];
        Spruce::new(number as u64, foot, spot.height, spot.bare, spot.snow, seed)
    };
    spots.iter().enumerate().map(grown).collect()
}

/// Grows the bare trees, and twigs that stick out of the snow, the farthest first.
pub fn bare(ground: &Ground, seed: Seed) -> Result<Vec<Bare>> {
    let tree = |[across, z, height]: [f64; 3], steps, radii, snow| {
        let place = [across * z, z];
        let foot = [place[0], ground.height(place) - 0.02, z];
        Habit { foot, height, steps, radii, bark: [0.050, 0.046, 0.044], snow }
    };
    let trees = TREES.iter().map(|at| tree(*at, 5, [0.010 * at[2], 0.0028], 0.013));
    let mut dice = seed.stream("winter: shrubs").at(0).place(0, 0, 0);
    let mut shrub = |k: usize| {
        let [across, z] = SHRUBS[k / 4];
        let mut random = || dice.uniform();
        let at = [across + 0.05 * (random() - 0.5), z + 0.9 * (random() - 0.5), 0.22 + 0.38 * random()];
        let mut habit = tree(at, 2, [0.0035, 0.0012], 0.006);
        habit.bark = [0.12, 0.095, 0.070];
        habit
    };
    let shrubs: Vec<Habit> = (0..4 * SHRUBS.len()).map(&mut shrub).collect();
    let mut all = Vec::new();
    for (number, habit) in trees.chain(shrubs).enumerate() {
        all.push(Bare::new(number as u64, habit, seed)?);
    }
    all.sort_by(|a, b| b.depth().total_cmp(&a.depth()));
    Ok(all)
}

/// Bare trees at the edge: x over z, z and height, m.
const TREES: [[f64; 3]; 5] =
    [[0.115, 20.6, 7.4], [0.205, 17.6, 8.6], [-0.205, 18.4, 7.6], [-0.37, 13.0, 6.8], [0.43, 12.4, 7.2]];
/// Tufts of twigs: x over z, and z.
const SHRUBS: [[f64; 2]; 5] = [[-0.24, 8.6], [0.27, 7.3], [0.12, 10.8], [-0.06, 13.6], [0.40, 9.2]];
