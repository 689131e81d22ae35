//! From 0 and 1 to a continuous density: Eq. (6) and (7), §2.4.
//!
//! Each cell carries a metaball whose central density is the mean of the cloud around it. Both sums are convolutions over
//! a ball of cells: nobody visits pairs.

use rayon::prelude::*;

/// How the central densities q are smoothed.
#[derive(Clone, Debug, PartialEq)]
pub enum Smoothing {
    /// Over space: Eq. (7) as printed.
    Space,
    /// Over space, and over steps before and after with these weights, the middle one that of the step itself.
    SpaceTime(Vec<f64>),
}

impl Smoothing {
    /// Steps before and after that are needed.
    pub fn reach(&self) -> usize {
        match self {
            Self::Space => 0,
            Self::SpaceTime(weights) => weights.len() / 2,
        }
    }
}

/// Metaballs on the cells of a lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metaballs {
    /// Cells along x, y and z.
    pub counts: [usize; 3],
    /// The effective radius D, in cells: a ball reaches what is nearer than this.
    pub radius: f64,
}

/// f of Eq. (6) at a distance of `a` radii squared: Wyvill's polynomial of degree six (1986). The paper's f stands on the
/// page that is lost; this one is inferred from its reference 5.
#[inline]
pub fn profile(a: f64) -> f64 {
    if a >= 1.0 { 0.0 } else { 1.0 - a * (22.0 - a * (17.0 - 4.0 * a)) / 9.0 }
}

/// Rows of a ball: their offsets in y and z, and how far they reach along x.
struct Row {
    y: isize,
    z: isize,
    half: usize,
}

impl Metaballs {
    /// The rows of Omega around a cell: all offsets shorter than D.
    fn rows(&self) -> Vec<Row> {
        let (reach, squared) = (self.reach() as isize, self.radius * self.radius);
        let mut rows = Vec::new();
        for z in -reach..=reach {
            for y in -reach..=reach {
                let left = squared - (y * y + z * z) as f64;
                if left > 0.0 {
                    // The greatest whole number below the root.
                    let half = libm::ceil(libm::sqrt(left)) as usize - 1;
                    rows.push(Row { y, z, half });
                }
            }
        }
        rows
    }

    /// Cells to either side that a ball reaches.
    fn reach(&self) -> usize {
        (libm::ceil(self.radius) as usize).saturating_sub(1)
    }

    /// The row of a lattice at an offset from another; none outside.
    fn row_at(&self, row: usize, by: &Row) -> Option<usize> {
        let [_, ny, nz] = self.counts;
        let (j, k) = ((row % ny) as isize + by.y, (row / ny) as isize + by.z);
        let inside = (0..ny as isize).contains(&j) && (0..nz as isize).contains(&k);
        inside.then(|| k as usize * ny + j as usize)
    }

    /// q of every cell: Eq. (7), the share of cloud among the cells of Omega that the lattice has.
    pub fn central(&self, cld: &[u8]) -> Vec<f32> {
        let [nx, _, _] = self.counts;
        let rows = self.rows();
        // Of each row the clouds before a cell: a stretch of it is a difference.
        let mut before = vec![0_u32; cld.len() / nx * (nx + 1)];
        before.par_chunks_mut(nx + 1).zip(cld.par_chunks(nx)).with_min_len(64).for_each(|(before, cld)| {
            for (i, cld) in cld.iter().enumerate() {
                before[i + 1] = before[i] + u32::from(*cld);
            }
        });
        let mut all = vec![0.0; cld.len()];
        all.par_chunks_mut(nx).enumerate().with_min_len(16).for_each(|(row, out)| {
            let (mut clouds, mut cells) = (vec![0_u32; nx], vec![0_u32; nx]);
            for by in &rows {
                let Some(other) = self.row_at(row, by) else { continue };
                let before = &before[other * (nx + 1)..(other + 1) * (nx + 1)];
                for i in 0..nx {
                    let (from, to) = (i.saturating_sub(by.half), (i + by.half + 1).min(nx));
                    clouds[i] += before[to] - before[from];
                    cells[i] += (to - from) as u32;
                }
            }
            for i in 0..nx {
                out[i] = (f64::from(clouds[i]) / f64::from(cells[i])) as f32;
            }
        });
        all
    }

    /// q smoothed over time as well, from that of the steps around, the step itself in the middle.
    pub fn over_time(smoothing: &Smoothing, steps: &[&[f32]]) -> Vec<f32> {
        let Smoothing::SpaceTime(weights) = smoothing else { return steps[steps.len() / 2].to_vec() };
        let whole: f64 = weights.iter().sum();
        let mean = |cell: usize| {
            let sum: f64 = weights.iter().zip(steps).map(|(weight, q)| weight * f64::from(q[cell])).sum();
            (sum / whole) as f32
        };
        (0..steps[0].len()).into_par_iter().with_min_len(4096).map(mean).collect()
    }

    /// rho at the centre of every cell: Eq. (6).
    pub fn density(&self, central: &[f32]) -> Vec<f32> {
        let [nx, _, _] = self.counts;
        let squared = self.radius * self.radius;
        let rows = self.rows();
        let empty: Vec<bool> = central.chunks(nx).map(|row| row.iter().all(|q| *q == 0.0)).collect();
        let mut all = vec![0.0; central.len()];
        all.par_chunks_mut(nx).enumerate().with_min_len(16).for_each(|(row, out)| {
            let mut sum = vec![0.0_f64; nx];
            for by in &rows {
                let Some(other) = self.row_at(row, by).filter(|other| !empty[*other]) else { continue };
                let q = &central[other * nx..(other + 1) * nx];
                for x in 0..=by.half.min(nx - 1) {
                    let weight = profile((by.y * by.y + by.z * by.z + (x * x) as isize) as f64 / squared);
                    // A ball `x` cells to the left, and one as far to the right.
                    sum[x..].iter_mut().zip(q).for_each(|(sum, q)| *sum += weight * f64::from(*q));
                    if x > 0 {
                        sum.iter_mut().zip(&q[x..]).for_each(|(sum, q)| *sum += weight * f64::from(*q));
                    }
                }
            }
            for (out, sum) in out.iter_mut().zip(sum) {
                *out = sum as f32;
            }
        });
        all
    }

    /// rho at the centre of a cell deep in cloud: it is not bounded by 1, but grows as D cubed.
    pub fn whole(&self) -> f64 {
        let squared = self.radius * self.radius;
        let of_row = |row: &Row| {
            let half = row.half as isize;
            let at = |x: isize| profile((row.y * row.y + row.z * row.z + x * x) as f64 / squared);
            (-half..=half).map(at).sum::<f64>()
        };
        self.rows().iter().map(of_row).sum()
    }

    /// rho at any place, in cells from the centre of the first: Eq. (6) pair by pair, to compare with.
    pub fn at(&self, central: &[f32], place: [f64; 3]) -> f64 {
        let [nx, ny, nz] = self.counts;
        let span = |axis: usize, count: usize| {
            let low = libm::ceil(place[axis] - self.radius).max(0.0) as usize;
            let high = libm::floor(place[axis] + self.radius).min(count as f64 - 1.0).max(-1.0);
            low..(high + 1.0) as usize
        };
        let mut sum = 0.0;
        for k in span(2, nz) {
            for j in span(1, ny) {
                for i in span(0, nx) {
                    let off = [0, 1, 2].map(|axis| [i, j, k][axis] as f64 - place[axis]);
                    let a = off.iter().map(|d| d * d).sum::<f64>() / (self.radius * self.radius);
                    sum += f64::from(central[(k * ny + j) * nx + i]) * profile(a);
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    fn random(counts: [usize; 3]) -> Vec<u8> {
        let moment = Seed(3).stream("cloud").at(0);
        let on = |k: usize| u8::from(moment.place(k as i32, 0, 0).uniform() < 0.3);
        (0..counts.iter().product()).map(on).collect()
    }

    #[test]
    fn the_profile_is_one_in_the_middle_and_nothing_at_the_edge() {
        assert_eq!((profile(0.0), profile(1.0), profile(2.0)), (1.0, 0.0, 0.0));
        assert!((profile(0.25) - 0.5).abs() < 1e-15, "one half at half the radius");
        assert!(profile(1.0 - 1e-6).abs() < 1e-11, "level at the edge");
    }

    /// Eq. (7) and (6) pair by pair, as they stand.
    #[test]
    fn both_sums_equal_those_over_pairs() {
        let counts = [9, 6, 7];
        let cld = random(counts);
        let place = |cell: usize| [cell % 9, cell / 9 % 6, cell / 54].map(|x| x as f64);
        for radius in [0.5, 1.0, 1.8, 3.0, 20.0] {
            let balls = Metaballs { counts, radius };
            let q = balls.central(&cld);
            let rho = balls.density(&q);
            for cell in 0..cld.len() {
                let distance = |other: &usize| {
                    let [a, b] = [place(cell), place(*other)];
                    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>()
                };
                let near: Vec<usize> =
                    (0..cld.len()).filter(|other| distance(other) < radius * radius).collect();
                let cloud = near.iter().map(|other| f64::from(cld[*other])).sum::<f64>();
                assert!((f64::from(q[cell]) - cloud / near.len() as f64).abs() < 1e-7);
                let direct = balls.at(&q, place(cell));
                assert!((f64::from(rho[cell]) - direct).abs() < 1e-5 * direct.max(1.0), "{radius}");
            }
        }
    }

    /// The readings file: within 3 % for D of two cells or more, wherever one looks.
    #[test]
    fn deep_in_cloud_the_density_is_even() {
        let counts = [24; 3];
        for radius in [2.0, 2.5, 3.0, 4.0] {
            let balls = Metaballs { counts, radius };
            let q = balls.central(&[1; 24 * 24 * 24]);
            assert!(q.iter().all(|q| *q == 1.0));
            let places = (0..64).map(|n| [n % 4, n / 4 % 4, n / 16].map(|x| 11.0 + f64::from(x) / 4.0));
            let found: Vec<f64> = places.map(|place| balls.at(&q, place)).collect();
            let mean = found.iter().sum::<f64>() / 64.0;
            let worst = found.iter().map(|rho| (rho / mean - 1.0).abs()).fold(0.0, f64::max);
            assert!(worst < 0.03, "{radius}: {worst}");
            assert!((balls.whole() - found[0]).abs() < 1e-9);
        }
    }

    #[test]
    fn over_time_the_weights_count() {
        let smoothing = Smoothing::SpaceTime(vec![1.0, 2.0, 1.0]);
        assert_eq!(smoothing.reach(), 1);
        let steps: [&[f32]; 3] = [&[0.0, 1.0], &[1.0, 1.0], &[0.0, 0.0]];
        assert_eq!(Metaballs::over_time(&smoothing, &steps), [0.5, 0.75]);
        assert_eq!(Metaballs::over_time(&Smoothing::Space, &steps), [1.0, 1.0]);
    }

    #[test]
    fn threads_do_not_matter() {
        let counts = [40, 20, 20];
        let cld = random(counts);
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let balls = Metaballs { counts, radius: 3.0 };
                balls.density(&balls.central(&cld))
            })
        };
        assert_eq!(run(1), run(7));
    }
}
