//! What the experiments share: the rules, a state by chance, and who is reached from where.

use snowglobe::automaton_cloud::{
    Activation, Brackets, Chance, Field, Injection, Lock, Outside, Packed, Rules,
};
use snowglobe::lab::{Error, Result};
use snowglobe::rng::Seed;

/// The rules that grow clouds and let them vanish.
pub const MENDED: Rules =
    Rules { activation: Activation::Negated, brackets: Brackets::Mended, lock: Lock::Cld, lifetime: 0 };

pub fn broken(cause: Outside) -> Error {
    Error::broken(cause.to_string())
}

/// Probabilities of hum, act and ext, everywhere and always.
pub fn uniform(seed: u64, chances: [f64; 3]) -> Injection {
    Injection { seed: Seed(seed), chance: Chance::Uniform(chances) }
}

/// A lattice in which vapour and activation are set with these probabilities.
pub fn begun(counts: [usize; 3], rules: Rules, seed: u64, [hum, act]: [f64; 2]) -> Result<Packed> {
    let mut clouds = Packed::new(counts, rules).map_err(broken)?;
    clouds.inject(&uniform(seed, [hum, act, 0.0]));
    Ok(clouds)
}

/// The eleven cells that Eq. (1) and (4) carry a state to: two above, but not two below.
pub const REACHED: [[isize; 3]; 11] = [
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

/// The fewest steps from sources to each cell through cells that let them pass; none where there is no way. A source need not let itself pass.
pub fn distances(counts: [usize; 3], sources: &[u8], passes: impl Fn(usize) -> bool) -> Vec<Option<u32>> {
    let [nx, ny, nz] = counts.map(|count| count as isize);
    let mut all: Vec<Option<u32>> = sources.iter().map(|source| (*source == 1).then_some(0)).collect();
    let mut front: Vec<usize> = (0..all.len()).filter(|cell| sources[*cell] == 1).collect();
    let mut steps = 0;
    while !front.is_empty() {
        steps += 1;
        let mut next = Vec::new();
        for cell in front {
            let at = cell as isize;
            let (i, j, k) = (at % nx, at / nx % ny, at / (nx * ny));
            for [x, y, z] in REACHED {
                let (i, j, k) = (i + x, j + y, k + z);
                if !((0..nx).contains(&i) && (0..ny).contains(&j) && (0..nz).contains(&k)) {
                    continue;
                }
                let there = ((k * ny + j) * nx + i) as usize;
                if all[there].is_none() && passes(there) {
                    all[there] = Some(steps);
                    next.push(there);
                }
            }
        }
        front = next;
    }
    all
}

/// Vapour and activation of a state.
pub fn vapour_and_active(clouds: &Packed) -> (Vec<u8>, Vec<u8>) {
    (clouds.field(Field::Hum), clouds.field(Field::Act))
}
