//! Numbers that fill the samples of a pixel evenly: Sobol's sequence in five dimensions, turned for each pixel by bits of
//! its own.

use crate::rng::{Moment, Seed};

/// The most samples of a pixel.
pub(super) const MOST_SAMPLES: usize = 4096;
/// Place in the pixel, two; place on the lens, two; time.
const DIMENSIONS: usize = 5;
/// Degree, coefficients and first numbers of the polynomials of all dimensions but the first (Joe & Kuo 2008).
const POLYNOMIALS: [(usize, u32, [u32; 3]); DIMENSIONS - 1] =
    [(1, 0, [1, 0, 0]), (2, 1, [1, 3, 0]), (3, 1, [1, 3, 1]), (3, 2, [1, 1, 1])];

/// A sample of a pixel: numbers from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    /// To the right and down.
    pub pixel: [f64; 2],
    /// On the lens, of radius 1.
    pub lens: [f64; 2],
    /// From -1/2 to 1/2 of the time for which the shutter is open.
    pub time: f64,
}

/// The samples of all pixels.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    points: Vec<[u32; DIMENSIONS]>,
    moment: Moment,
}

impl Samples {
    pub fn new(count: usize, seed: Seed) -> Self {
        let directions = directions();
        let point = |k: usize| {
            // Gray's order would serve as well; the order of bits keeps the first samples those of fewer.
            directions.map(|numbers| {
                (0..32).filter(|bit| k >> bit & 1 == 1).fold(0, |point, bit| point ^ numbers[bit])
            })
        };
        Self { points: (0..count).map(point).collect(), moment: seed.stream("still").at(0) }
    }

    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// The samples of a pixel, by its column and row in the whole picture.
    pub fn of(&self, pixel: [usize; 2]) -> impl Iterator<Item = Sample> {
        let mut numbers = self.moment.place(pixel[0] as i32, pixel[1] as i32, 0);
        let mut turn = [0; DIMENSIONS];
        for pair in turn.chunks_mut(2) {
            let bits = numbers.next_u64();
            pair[0] = bits as u32;
            if let Some(second) = pair.get_mut(1) {
                *second = (bits >> 32) as u32;
            }
        }
        self.points.iter().map(move |point| {
            let at = |k: usize| (f64::from(point[k] ^ turn[k]) + 0.5) / 4_294_967_296.0;
            Sample { pixel: [at(0), at(1)], lens: disc([at(2), at(3)]), time: at(4) - 0.5 }
        })
    }
}

/// A point of a square as one of a disc of radius 1, area for area (Shirley & Chiu 1997).
pub(super) fn disc(point: [f64; 2]) -> [f64; 2] {
    let [x, y] = point.map(|x| 2.0 * x - 1.0);
    let (radius, other, turned) = if x.abs() > y.abs() { (x, y, false) } else { (y, x, true) };
    if radius == 0.0 {
        return [0.0; 2];
    }
    let (sine, cosine) = eighth(std::f64::consts::FRAC_PI_4 * other / radius);
    if turned { [radius * sine, radius * cosine] } else { [radius * cosine, radius * sine] }
}

/// Sine and cosine within an eighth of a turn to either side, to 1e-9.
fn eighth(x: f64) -> (f64, f64) {
    let s = x * x;
    let sine = 1.0 - s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5040.0 - s / 362_880.0)));
    let cosine =
        1.0 - s * (0.5 - s * (1.0 / 24.0 - s * (1.0 / 720.0 - s * (1.0 / 40_320.0 - s / 3_628_800.0))));
    (x * sine, cosine)
}

/// Direction numbers of all dimensions.
fn directions() -> [[u32; 32]; DIMENSIONS] {
    let mut all = [[0; 32]; DIMENSIONS];
    all[0] = std::array::from_fn(|bit| 1 << (31 - bit));
    for (numbers, (degree, coefficients, first)) in all[1..].iter_mut().zip(POLYNOMIALS) {
        for bit in 0..32 {
            numbers[bit] = if bit < degree {
                first[bit] << (31 - bit)
            } else {
                let mut number = numbers[bit - degree] ^ (numbers[bit - degree] >> degree);
                for k in 1..degree {
                    if coefficients >> (degree - 1 - k) & 1 == 1 {
                        number ^= numbers[bit - k];
                    }
                }
                number
            };
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Any 16 samples of a pixel lie in 16 different sixteenths, in every dimension; the first two in squares too.
    #[test]
    fn samples_are_spread_in_every_dimension() {
        let samples = Samples::new(16, Seed(3));
        for pixel in [[0, 0], [5, 9], [600, 2]] {
            let all: Vec<Sample> = samples.of(pixel).collect();
            let mut sixteenths = [[false; 16]; 4];
            for sample in &all {
                let cell = |x: f64| (x * 16.0) as usize;
                sixteenths[0][cell(sample.pixel[0])] = true;
                sixteenths[1][cell(sample.pixel[1])] = true;
                sixteenths[2][cell(sample.time + 0.5)] = true;
                let square = (sample.pixel[0] * 4.0) as usize * 4 + (sample.pixel[1] * 4.0) as usize;
                sixteenths[3][square] = true;
            }
            assert!(sixteenths.as_flattened().iter().all(|met| *met), "{pixel:?}");
        }
    }

    #[test]
    fn discs_are_filled_area_for_area() {
        for part in [0.3, 0.7, 1.0] {
            let inside = (0..10_000)
                .map(|k| disc([(f64::from(k % 100) + 0.5) / 100.0, (f64::from(k / 100) + 0.5) / 100.0]))
                .filter(|[x, y]| x * x + y * y <= part * part);
            let share = inside.count() as f64 / 10_000.0;
            assert!((share - part * part).abs() < 0.01, "{share}");
        }
        let (sine, cosine) = eighth(0.7);
        assert!((sine - libm::sin(0.7)).abs() < 1e-9 && (cosine - libm::cos(0.7)).abs() < 1e-9);
    }
}
