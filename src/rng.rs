//! Random numbers addressed by name, time and place.
//!
//! There is no state to carry and no order to keep: `seed.stream("r_t").at(t)` always gives the same numbers for the
//! same places, on any number of threads and in any order.
//!
//! | step | how |
//! |---|---|
//! | (seed, name) → key | SHA-256 of `snowglobe rng 1`, the seed (8 bytes, little endian) and the name |
//! | (key, time) → key of the moment | the first 32 bytes of ChaCha8 under the key, stream number `time` |
//! | a row of a lattice | ChaCha8 under the moment's key, stream number = the row's coordinate (two's complement); the number of coordinate q is the 64-bit word q + 2³¹ |
//! | a scattered place | Philox 4x32-10 (Salmon et al., SC 2011) under the first 64 bits of the moment's key, counter (x, y, z, block) |
//!
//! ChaCha in sequence costs 2 to 3 ns a number but 77 ns to seek, hence the two kinds of place.
//! A place is a coordinate, never an array index: a region that grows keeps its numbers.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use sha2::{Digest, Sha256};

/// The number that the user shakes the globe with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seed(pub u64);

impl Seed {
    /// The random numbers of one named quantity.
    pub fn stream(self, name: &str) -> Stream {
        let mut digest = Sha256::new();
        digest.update(b"snowglobe rng 1");
        digest.update(self.0.to_le_bytes());
        digest.update(name.as_bytes());
        Stream { key: digest.finalize().into() }
    }
}

/// The random numbers of one quantity at all times.
#[derive(Clone, Debug)]
pub struct Stream {
    key: [u8; 32],
}

impl Stream {
    /// The numbers of one time: a frame, a step, a row of a table.
    pub fn at(&self, time: u64) -> Moment {
        let mut chacha = ChaCha8Rng::from_seed(self.key);
        chacha.set_stream(time);
        let mut key = [0; 32];
        chacha.fill_bytes(&mut key);
        Moment { key }
    }
}

/// The random numbers of one quantity at one time, over all places.
#[derive(Clone, Debug)]
pub struct Moment {
    key: [u8; 32],
}

impl Moment {
    /// Fills `out` with uniform numbers in the open interval (0, 1), one for each coordinate `first`, `first + 1`, ...
    /// of lattice row `row`. However a row is cut, a coordinate keeps its number.
    pub fn fill_row(&self, row: i32, first: i32, out: &mut [f64]) {
        let mut chacha = ChaCha8Rng::from_seed(self.key);
        chacha.set_stream(i64::from(row) as u64);
        let word = (i64::from(first) + (1 << 31)) as u128;
        chacha.set_word_pos(2 * word); // ChaCha's words have 32 bits
        for number in out {
            *number = open_unit(chacha.next_u64());
        }
    }

    /// A generator in sequence, for libraries that draw as they go.
    pub fn generator(&self) -> ChaCha8Rng {
        let mut chacha = ChaCha8Rng::from_seed(self.key);
        chacha.set_stream(1 << 63); // no row has this coordinate
        chacha
    }

    /// The numbers of a scattered place, as many as are asked for.
    pub fn place(&self, x: i32, y: i32, z: i32) -> Place {
        let key = [word(&self.key, 0), word(&self.key, 4)];
        Place { key, counter: [x as u32, y as u32, z as u32, 0], block: [0; 4], used: 4 }
    }
}

fn word(bytes: &[u8; 32], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

/// The numbers of one place at one time, in sequence.
#[derive(Clone, Debug)]
pub struct Place {
    key: [u32; 2],
    counter: [u32; 4],
    block: [u32; 4],
    used: usize,
}

impl Place {
    /// The next uniform number in the open interval (0, 1).
    pub fn uniform(&mut self) -> f64 {
        open_unit(self.next_u64())
    }

    /// The next 64 random bits.
    pub fn next_u64(&mut self) -> u64 {
        if self.used == 4 {
            self.block = philox4x32_10(self.counter, self.key);
            self.counter[3] = self.counter[3].wrapping_add(1);
            self.used = 0;
        }
        let (low, high) = (self.block[self.used], self.block[self.used + 1]);
        self.used += 2;
        u64::from(low) | u64::from(high) << 32
    }
}

/// The middle of one of 2⁵² equal parts of the unit interval: never 0, never 1, so `r > 0` always holds.
fn open_unit(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64)
}

/// Philox 4x32 with ten rounds: a counter, mixed under a key.
pub fn philox4x32_10(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for round in 0..10 {
        if round > 0 {
            key = [key[0].wrapping_add(0x9E37_79B9), key[1].wrapping_add(0xBB67_AE85)];
        }
        let left = u64::from(counter[0]) * 0xD251_1F53;
        let right = u64::from(counter[2]) * 0xCD9E_8D57;
        counter = [
            (right >> 32) as u32 ^ counter[1] ^ key[0],
            right as u32,
            (left >> 32) as u32 ^ counter[3] ^ key[1],
            left as u32,
        ];
    }
    counter
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Known answers published with Random123.
    #[test]
    fn philox_gives_its_published_answers() {
        assert_eq!(philox4x32_10([0; 4], [0; 2]), [0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8]);
        assert_eq!(
            philox4x32_10([u32::MAX; 4], [u32::MAX; 2]),
            [0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd]
        );
        assert_eq!(
            philox4x32_10([0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344], [0xa4093822, 0x299f31d0]),
            [0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1]
        );
    }

    #[test]
    fn a_row_may_be_cut_anywhere() {
        let moment = Seed(7).stream("r_t").at(3);
        let mut whole = [0.0; 64];
        moment.fill_row(-5, -20, &mut whole);
        let mut part = [0.0; 10];
        moment.fill_row(-5, 11, &mut part);
        assert_eq!(whole[31..41], part);
    }

    #[test]
    fn seed_name_time_and_place_each_matter() {
        let first = |seed, name: &str, time, row| {
            let mut one = [0.0];
            Seed(seed).stream(name).at(time).fill_row(row, 0, &mut one);
            one[0]
        };
        let all = [
            first(1, "a", 0, 0),
            first(2, "a", 0, 0),
            first(1, "b", 0, 0),
            first(1, "a", 1, 0),
            first(1, "a", 0, 1),
            first(1, "a", 0, -1),
        ];
        for (i, x) in all.iter().enumerate() {
            assert!(all[i + 1..].iter().all(|y| y != x));
        }
    }

    /// Kolmogorov-Smirnov at one in a million, for both kinds of place.
    #[test]
    fn numbers_are_uniform() {
        let moment = Seed(1).stream("uniformity").at(0);
        let mut rows = vec![0.0; 100_000];
        for (row, part) in rows.chunks_mut(100).enumerate() {
            moment.fill_row(row as i32, -50, part);
        }
        let places: Vec<f64> = (0..100_000).map(|i| moment.place(i % 317, i / 317, -i).uniform()).collect();
        for mut numbers in [rows, places] {
            numbers.sort_by(f64::total_cmp);
            let n = numbers.len() as f64;
            let distance = numbers
                .iter()
                .enumerate()
                .map(|(i, x)| (x - i as f64 / n).abs().max(((i + 1) as f64 / n - x).abs()))
                .fold(0.0, f64::max);
            assert!(distance < 2.69 / n.sqrt(), "{distance}"); // sqrt(-ln(alpha / 2) / 2), alpha = 1e-6
            assert!(numbers[0] > 0.0 && numbers[numbers.len() - 1] < 1.0);
        }
    }

    #[test]
    fn the_numbers_of_neighbouring_places_are_not_correlated() {
        let moment = Seed(1).stream("correlation").at(0);
        let at = |x: i32, y: i32| moment.place(x, y, 0).uniform() - 0.5;
        let n = 200;
        let pairs = (0..n).flat_map(|y| (0..n).map(move |x| (x, y)));
        let sum: f64 = pairs.map(|(x, y)| at(x, y) * at(x + 1, y) + at(x, y) * at(x, y + 1)).sum();
        let expected_spread = (2.0 * f64::from(n * n)).sqrt() / 12.0;
        assert!(sum.abs() < 5.0 * expected_spread, "{sum} against {expected_spread}");
    }

    /// What every machine and every later version must give; computed from the table above by a program in another
    /// language.
    #[test]
    fn test_vectors() {
        let moment = Seed(1).stream("r_t").at(0);
        let mut row = [0.0; 2];
        moment.fill_row(0, 0, &mut row);
        let mut place = moment.place(1, -2, 3);
        let seen = [row[0].to_bits(), row[1].to_bits(), place.next_u64(), place.next_u64(), place.next_u64()];
        assert_eq!(seen, VECTORS, "{seen:#x?}");
    }

    const VECTORS: [u64; 5] = [
        0x3fe5_a3c1_24b7_90e9,
        0x3fca_ef15_f099_325c,
        0x20bc_a56a_d248_5569,
        0x4ed1_8633_7065_3375,
        0x3995_52ae_6880_82cc,
    ];
}
