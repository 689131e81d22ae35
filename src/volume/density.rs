//! A field of density on a grid of cubes.

use rayon::prelude::*;

use super::{VolumeError, within};

/// Most samples of a field: 645 a side.
pub const MOST_SAMPLES: usize = 1 << 28;

/// A field of density that fills the box from (0, 0, 0) to `counts` times `voxel`.
///
/// Samples are at the centres of voxels and the field is trilinear between them; in the outer half of an outer voxel it
/// is what it is at its nearest place between centres, and outside of the box 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    counts: [usize; 3],
    voxel: f64,
    values: Vec<f32>,
}

impl Density {
    /// Samples at the centres of voxels, x fastest, then y, then z; the side of a voxel in m.
    ///
    /// # Errors
    ///
    /// [`VolumeError`] if samples are not as many as voxels, or none, or above [`MOST_SAMPLES`], or one is negative or
    /// not finite, or the side is not between 1e-9 and 1e9 m.
    pub fn new(counts: [usize; 3], voxel: f64, values: Vec<f32>) -> Result<Self, VolumeError> {
        within("the side of a voxel, m,", voxel, 1e-9, 1e9, "1e-9 to 1e9")?;
        let all = counts.iter().try_fold(1_usize, |all, count| all.checked_mul(*count));
        if all != Some(values.len()) {
            return Err(VolumeError::Counts { counts, values: values.len() });
        }
        let (number, most) = (values.len() as f64, MOST_SAMPLES as f64);
        within("the number of samples", number, 1.0, most, "1 to 268435456")?;
        // NaN is not at least 0.
        if let Some(at) = values.iter().position(|value| !(value.is_finite() && *value >= 0.0)) {
            return Err(VolumeError::Sample { at, value: values[at] });
        }
        Ok(Self { counts, voxel, values })
    }

    /// The field that a function has at the centres of voxels, m.
    ///
    /// # Errors
    ///
    /// As [`Density::new`].
    pub fn sampled(
        counts: [usize; 3],
        voxel: f64,
        field: impl Fn([f64; 3]) -> f64,
    ) -> Result<Self, VolumeError> {
        let [nx, ny, nz] = counts;
        let number = counts.iter().map(|count| *count as f64).product();
        within("the number of samples", number, 1.0, MOST_SAMPLES as f64, "1 to 268435456")?;
        let place = |k: usize| (k as f64 + 0.5) * voxel;
        let mut values = Vec::with_capacity(nx * ny * nz);
        for z in 0..nz {
            for y in 0..ny {
                values.extend((0..nx).map(|x| field([place(x), place(y), place(z)]) as f32));
            }
        }
        Self::new(counts, voxel, values)
    }

    /// Voxels along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        self.counts
    }

    /// The side of a voxel, m.
    pub fn voxel(&self) -> f64 {
        self.voxel
    }

    /// The samples, x fastest.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The box's far corner, m; the near one is (0, 0, 0).
    pub fn extent(&self) -> [f64; 3] {
        self.counts.map(|count| count as f64 * self.voxel)
    }

    /// A row of samples along x.
    pub(super) fn row(&self, y: usize, z: usize) -> &[f32] {
        let [nx, ny, _] = self.counts;
        &self.values[(z * ny + y) * nx..][..nx]
    }

    /// The same field in voxels of a third of the side. 3 is odd, so the old centres are among the new: between new ones the
    /// old field is trilinear too, and beyond the outermost it is as flat.
    pub(super) fn in_thirds(&self) -> Self {
        let counts = self.counts.map(|count| 3 * count);
        let mut values = vec![0.0; counts.iter().product()];
        values.par_chunks_mut(counts[0]).with_min_len(16).enumerate().for_each_init(
            || vec![0.0_f32; self.counts[0]],
            |line, (k, to)| {
                let [(y, v), (z, w)] =
                    [third(k % counts[1], self.counts[1]), third(k / counts[1], self.counts[2])];
                let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(j, k)| self.row(y[j], z[k]));
                for (x, to) in line.iter_mut().enumerate() {
                    *to = mix(mix(a[x], b[x], v), mix(c[x], d[x], v), w);
                }
                for (k, to) in to.iter_mut().enumerate() {
                    let (x, u) = third(k, line.len());
                    *to = mix(line[x[0]], line[x[1]], u);
                }
            },
        );
        Self { counts, voxel: self.voxel / 3.0, values }
    }

    /// The density at a place, m, by definition; what [`Bricks`](super::Bricks) hold for rays.
    pub fn at(&self, place: [f64; 3]) -> f64 {
        let extent = self.extent();
        if (0..3).any(|axis| !(place[axis] >= 0.0 && place[axis] <= extent[axis])) {
            return 0.0;
        }
        let (mut corner, mut rest) = ([[0; 2]; 3], [0.0; 3]);
        for axis in 0..3 {
            let last = self.counts[axis] - 1;
            let along = (place[axis] / self.voxel - 0.5).clamp(0.0, last as f64);
            let low = (along as usize).min(last.saturating_sub(1));
            (corner[axis], rest[axis]) = ([low, (low + 1).min(last)], along - low as f64);
        }
        let mut sum = 0.0;
        for k in 0..8 {
            let bit = [k & 1, k >> 1 & 1, k >> 2];
            let weight = |axis: usize| if bit[axis] == 1 { rest[axis] } else { 1.0 - rest[axis] };
            let sample = self.row(corner[1][bit[1]], corner[2][bit[2]])[corner[0][bit[0]]];
            sum += weight(0) * weight(1) * weight(2) * f64::from(sample);
        }
        sum
    }
}

fn mix(a: f32, b: f32, by: f32) -> f32 {
    a + by * (b - a)
}

/// Between which samples the centre of a third of a voxel is, and how far from the first to the second.
fn third(k: usize, count: usize) -> ([usize; 2], f32) {
    let high = k.div_ceil(3);
    ([high.saturating_sub(1), high.min(count - 1)], ((k + 2) % 3) as f32 / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_field_is_refused_in_one_line() {
        let refused = |counts, voxel, values| Density::new(counts, voxel, values).unwrap_err().to_string();
        assert_eq!(
            refused([2, 1, 1], 1.0, vec![0.0]),
            "1 samples for 2 x 1 x 1 voxels; one for each is needed"
        );
        assert_eq!(
            refused([usize::MAX, 2, 1], 1.0, vec![]),
            format!("0 samples for {} x 2 x 1 voxels; one for each is needed", usize::MAX)
        );
        assert_eq!(
            refused([2, 1, 1], 1.0, vec![0.0, -1.0]),
            "sample 1 is -1; a density is finite and at least 0"
        );
        assert_eq!(
            refused([1, 1, 1], 1.0, vec![f32::NAN]),
            "sample 0 is NaN; a density is finite and at least 0"
        );
        assert_eq!(
            refused([1, 1, 1], 0.0, vec![0.0]),
            "the side of a voxel, m, is 0; 1e-9 to 1e9 is handled"
        );
        assert_eq!(refused([0, 1, 1], 1.0, vec![]), "the number of samples is 0; 1 to 268435456 is handled");
    }

    #[test]
    fn it_is_trilinear_between_centres_and_flat_beyond() {
        let field = Density::new([2, 1, 2], 2.0, vec![1.0, 3.0, 5.0, 11.0]).unwrap();
        assert_eq!(field.extent(), [4.0, 2.0, 4.0]);
        assert_eq!(field.at([1.0, 1.0, 1.0]), 1.0);
        assert_eq!(field.at([2.0, 0.3, 2.0]), 5.0);
        assert_eq!(field.at([0.0, 0.0, 0.0]), 1.0);
        assert_eq!(field.at([4.0, 2.0, 4.0]), 11.0);
        assert_eq!(field.at([4.001, 1.0, 1.0]), 0.0);
        assert_eq!(field.at([1.0, -0.001, 1.0]), 0.0);
    }

    /// 1e-6: samples are single precision.
    #[test]
    fn in_thirds_it_is_the_same_field() {
        for counts in [[4, 3, 2], [1, 5, 1]] {
            let field =
                Density::sampled(counts, 0.5, |[x, y, z]| libm::sin(7.0 * x + 5.0 * y - 9.0 * z) + 1.0);
            let field = field.unwrap();
            let fine = field.in_thirds();
            assert_eq!(fine.counts(), counts.map(|count| 3 * count));
            for k in 0..1000 {
                let part = [k % 10, k / 10 % 10, k / 100].map(|j| f64::from(j) / 9.0);
                let place = [0, 1, 2].map(|axis| (0.999 * part[axis] + 0.0005) * field.extent()[axis]);
                assert!((fine.at(place) - field.at(place)).abs() < 1e-6, "{place:?}");
            }
        }
    }
}
