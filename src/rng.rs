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
//! | a point of the plane | the same, counter = the bits of x and of y (−0 as 0): the first 64 bits that come, through the inverse normal distribution |
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

impl Moment {
    /// The normally distributed number, mean 0 and deviation 1, of a point of the plane.
    pub fn normal(&self, place: [f64; 2]) -> f64 {
        inverse_normal(open_unit(point(place, self.point_key())))
    }

    /// The numbers of many points of the plane, each what [`normal`](Self::normal) gives.
    ///
    /// # Panics
    ///
    /// Of `places` and `out` of different lengths.
    pub fn normals(&self, places: &[[f64; 2]], out: &mut [f64]) {
        assert_eq!(places.len(), out.len(), "one number for each place");
        let key = self.point_key();
        let mut uniform = [0.0; MANY];
        for (places, out) in places.chunks(MANY).zip(out.chunks_mut(MANY)) {
            let uniform = &mut uniform[..places.len()];
            middles(places, key, uniform, out);
            // Some 15 in 100 lie outside of the middle.
            for (x, p) in out.iter_mut().zip(uniform) {
                if (*p - 0.5).abs() > MIDDLE_HALF {
                    *x = inverse_normal(*p);
                }
            }
        }
    }

    fn point_key(&self) -> [u32; 2] {
        [word(&self.key, 0), word(&self.key, 4)]
    }
}

/// Points that are worked out together.
const MANY: usize = 128;

/// The random bits of a point.
#[inline(always)]
fn point([x, y]: [f64; 2], key: [u32; 2]) -> u64 {
    // Adding 0 makes the two zeros one.
    let (x, y) = ((x + 0.0).to_bits(), (y + 0.0).to_bits());
    let counter = [x as u32, (x >> 32) as u32, y as u32, (y >> 32) as u32];
    let [low, high, ..] = philox4x32_10(counter, key);
    u64::from(low) | u64::from(high) << 32
}

/// Uniform numbers of points, and the x of each as if it lay in the middle of the normal distribution.
#[multiversion::multiversion(targets("x86_64+avx2"))]
fn middles(places: &[[f64; 2]], key: [u32; 2], uniform: &mut [f64], out: &mut [f64]) {
    for (place, p) in places.iter().zip(uniform.iter_mut()) {
        *p = open_unit(point(*place, key));
    }
    for (p, x) in uniform.iter().zip(out) {
        *x = inverse_middle(*p - 0.5);
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
#[inline(always)]
fn open_unit(bits: u64) -> f64 {
    // As the fraction of a number from 1 to 2, without a conversion from whole numbers: every step is exact.
    f64::from_bits(bits >> 12 | 1.0_f64.to_bits()) - 1.0 + 0.5 / (1u64 << 52) as f64
}

/// The x below which a normally distributed number lies with probability `p`: Wichura 1988, algorithm AS 241 (PPND16),
/// of a relative accuracy of about 1e-16.
fn inverse_normal(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= MIDDLE_HALF {
        return inverse_middle(q);
    }
    let r = libm::sqrt(-libm::log(if q < 0.0 { p } else { 1.0 - p }));
    let x = if r <= 5.0 { ratio(&SIDE, r - 1.6) } else { ratio(&TAIL, r - 5.0) };
    if q < 0.0 { -x } else { x }
}

/// Half the width of the middle, in which 85 of 100 numbers lie.
const MIDDLE_HALF: f64 = 0.425;

#[inline(always)]
fn inverse_middle(q: f64) -> f64 {
    q * ratio(&MIDDLE, MIDDLE_HALF * MIDDLE_HALF - q * q)
}

#[inline(always)]
fn ratio((above, below): &([f64; 8], [f64; 8]), x: f64) -> f64 {
    let along = |terms: &[f64; 8]| terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
    along(above) / along(below)
}

/// AS 241: coefficients above and below the line, constant term first, in the middle, at the sides and in the tails.
const MIDDLE: ([f64; 8], [f64; 8]) = (
    [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    [
        1.0,
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_854,
    ],
);
const SIDE: ([f64; 8], [f64; 8]) = (
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        7.745_450_142_783_414e-4,
    ],
    [
        1.0,
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
);
const TAIL: ([f64; 8], [f64; 8]) = (
    [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        0.296_560_571_828_504_87,
        0.026_532_189_526_576_124,
        1.242_660_947_388_078_4e-3,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    [
        1.0,
        0.599_832_206_555_888,
        0.136_929_880_922_735_8,
        0.014_875_361_290_850_615,
        7.868_691_311_456_133e-4,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_8e-15,
    ],
);

/// Philox 4x32 with ten rounds: a counter, mixed under a key.
#[inline(always)]
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

    /// Values of another implementation (SciPy 1.17.1, norm.ppf).
    #[test]
    fn the_normal_distribution_is_inverted() {
        for (p, x) in [
            (1e-300, -37.0470962993612),
            (1e-12, -7.034483825301131),
            (0.001, -3.090232306167813),
            (0.05, -1.6448536269514729),
            (0.3, -0.5244005127080409),
            (0.5, 0.0),
            (0.9, 1.2815515655446004),
            (0.999999, 4.753424308817087),
        ] {
            let ours = inverse_normal(p);
            // At 0.999999 the last bits of 1 - p are what is left of p.
            let accuracy = if p > 0.9 { 1e-11 } else { 4e-15 };
            assert!((ours - x).abs() <= accuracy * x.abs(), "{p}: {ours} for {x}");
        }
    }

    /// Mean, deviation, skewness and kurtosis of 40,000, each within five of its own deviations.
    #[test]
    fn points_have_normal_numbers() {
        let moment = Seed(1).stream("normal").at(0);
        let numbers: Vec<f64> = (0..40_000)
            .map(|k| moment.normal([f64::from(k % 200) * 0.125, f64::from(k / 200) * 0.125 - 7.0]))
            .collect();
        let n = numbers.len() as f64;
        let mean =
            |power: usize| numbers.iter().map(|x| (0..power).map(|_| x).product::<f64>()).sum::<f64>() / n;
        for (power, value, variance) in [(1, 0.0, 1.0), (2, 1.0, 2.0), (3, 0.0, 15.0), (4, 3.0, 96.0)] {
            let off = (mean(power) - value).abs();
            assert!(off < 5.0 * libm::sqrt(variance / n), "{power}: {off}");
        }
        assert_eq!(moment.normal([0.0, -0.0]).to_bits(), moment.normal([-0.0, 0.0]).to_bits());
        let places: Vec<[f64; 2]> = (0..1000).map(|k| [f64::from(k) * 0.1, -0.3]).collect();
        let mut many = vec![0.0; 1000];
        moment.normals(&places, &mut many);
        for (place, number) in places.iter().zip(many) {
            assert_eq!(moment.normal(*place).to_bits(), number.to_bits());
        }
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
