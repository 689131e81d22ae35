//! How much is between a place and the light: optical depth towards one direction, for all places of a field.
//!
//! The lattice is sheared until the direction is one of its axes: from slice to slice of the axis along which the light
//! moves most, one lattice line is one ray, and what a ray gathers between two slices is the exact integral of the
//! trilinear field. Nothing is passed on by interpolation, so nothing spreads, however far the light goes.

use rayon::prelude::*;

use super::bricks::LatticeRay;
use super::exponential::WHOLE;
use super::lines::{Lines, level};
use super::stencil::{REACH, taps};
use super::vector::unit;
use super::{Density, VolumeError};

/// Samples of the sheared lattice beyond the outermost ones of the field, at either end of a row.
pub(super) const MARGIN: usize = 2;
/// Samples of a slice of the field beyond the outermost ones, so that no tap is outside.
const PAD: usize = MARGIN + REACH;

/// Most samples of a field that is refined for them: 256 a side.
const MOST_REFINED: usize = 1 << 24;

/// Optical depth for tau = 1, density times m, from any place of a field to where light from one direction enters it.
///
/// Linear along the three sheared axes between the points of the lattice, which are a voxel apart, or a third of one where
/// the field then has at most 2^24 samples, 85 a side: what is seen of few voxels is seen from near. In points it is exact
/// if the light goes along an axis of the field, and otherwise less by a twelfth of the second differences: so it errs to
/// either side between points. Points outside of the box, between which and others its outermost places are, have the depth
/// that a line's own goes on with, below 0 beyond the face where it leaves: so places near a face are as good as others,
/// but for those near an edge of it towards the light, and, where density does not vanish at a face that the light grazes
/// (by less than one in eight), those within half a voxel of it.
#[derive(Clone, Debug)]
pub struct Depths {
    /// From sample to sample, m, and how many of these are a voxel.
    pub(super) voxel: f64,
    fine: f64,
    /// The field's axes: those of a slice, then the one from slice to slice.
    pub(super) axes: [usize; 3],
    /// Samples along these.
    pub(super) counts: [usize; 3],
    /// Whether the light comes from the low end of the last axis.
    pub(super) turned: bool,
    /// Voxels along the slice for one across, towards the light.
    pub(super) shear: [f64; 2],
    /// Slices from -1 to n, in rows.
    values: Vec<f32>,
    /// For each slice, where in `values` the lattice line through (0, 0) of slice 0 is.
    bases: Vec<isize>,
}

/// A ray in the sheared lattice.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheared {
    origin: [f64; 3],
    slope: [f64; 3],
}

impl Depths {
    /// The depths towards a direction, in which the light is: to the sun, the zenith or the nadir.
    ///
    /// # Errors
    ///
    /// [`VolumeError::NoDirection`] for a direction without length.
    pub fn toward(density: &Density, direction: [f64; 3]) -> Result<Self, VolumeError> {
        Ok(Self::through(density, 1.0, unit("the direction to the light", direction)?))
    }

    /// The same of the same field in thirds of voxels, where it has few enough, up to 85 a side: an error about nine times
    /// less, for twenty-seven times the work.
    ///
    /// # Errors
    ///
    /// [`VolumeError::NoDirection`] for a direction without length.
    pub fn finely(density: &Density, direction: [f64; 3]) -> Result<Self, VolumeError> {
        if density.values().len() > MOST_REFINED / 27 {
            return Self::toward(density, direction);
        }
        Ok(Self::through(&density.in_thirds(), 3.0, unit("the direction to the light", direction)?))
    }

    /// Of a field with so many samples along the side of a voxel, in a direction of length 1.
    pub(super) fn through(density: &Density, fine: f64, direction: [f64; 3]) -> Self {
        let size = direction.map(f64::abs);
        // Of two that are as long, the later axis: its slices lie together.
        let last =
            [1, 2].into_iter().fold(0, |best, axis| if size[axis] >= size[best] { axis } else { best });
        let axes = match last {
            0 => [1, 2, 0],
            1 => [0, 2, 1],
            _ => [0, 1, 2],
        };
        let counts = axes.map(|axis| density.counts()[axis]);
        let shear = [direction[axes[0]] / size[last], direction[axes[1]] / size[last]];
        let [nu, nv, nw] = counts;
        let [wide, high] = [nu + 2 * MARGIN, nv + 2 * MARGIN];
        let turned = direction[last] < 0.0;
        // Lattice lines are shifted by whole samples to stay within half a sample of the field's.
        let offset = |slot: usize, axis: usize| (shear[axis] * (slot as f64 - 1.0)).round();
        let start = |slot: usize, axis: usize| shear[axis] * (slot as f64 - 1.0) - offset(slot, axis);
        let whole = |slot: usize| [0, 1].map(|axis| offset(slot, axis) as isize);
        let bases = (0..nw + 2)
            .map(|slot| {
                let [u, v] = whole(slot).map(|shift| shift + MARGIN as isize);
                (slot * high) as isize * wide as isize + v * wide as isize + u
            })
            .collect();
        let mut depths = Self {
            voxel: density.voxel(),
            fine,
            axes,
            counts,
            turned,
            shear,
            values: vec![0.0; (nw + 2) * wide * high],
            bases,
        };
        let length = density.voxel() / size[last];
        let mut far = depths.slice(density, nw + 1);
        let mut sums = vec![0.0_f64; wide * high];
        let mut before = sums.clone();
        let mut values = std::mem::take(&mut depths.values);
        // Slice n is beyond the box: all lines begin there.
        let lines = Lines {
            depths: &depths,
            density,
            slot: nw + 1,
            offset: [0, 1].map(|k| start(nw + 1, k)),
            length,
        };
        sums.par_chunks_mut(wide).enumerate().for_each(|(j, row)| {
            row.iter_mut().enumerate().for_each(|(i, sum)| *sum = lines.begin(i, j));
        });
        // Light along an axis is linear across the field's own cells, and exact.
        let slanted = shear != [0.0; 2];
        let shift = |slot: usize| {
            let ([a, b], [c, d]) = (whole(slot), whole(slot + 1));
            [c - a, d - b]
        };
        // `sums` is of the slice at hand, `before` of the one towards the light and `first` of the one before that.
        let mut first = sums.clone();
        for slot in (0..=nw).rev() {
            let near = depths.slice(density, slot);
            let offset = [start(slot, 0), start(slot, 1)];
            let weights = taps(offset, shear, length);
            std::mem::swap(&mut before, &mut first);
            std::mem::swap(&mut sums, &mut before);
            let lines = Lines { depths: &depths, density, slot, offset, length };
            lines.gather(&mut sums, &before, shift(slot), &weights, [&near, &far]);
            far = near;
            let to = &mut values[(slot + 1) * wide * high..][..wide * high];
            if slanted {
                let back = shift(slot).map(|shift| -shift);
                let behind = (slot < nw).then(|| (&*first, shift(slot + 1)));
                level(to, wide, &before, Some((&*sums, back)), behind);
            } else {
                to.iter_mut().zip(&before).for_each(|(to, sum)| *to = *sum as f32);
            }
        }
        values.iter_mut().zip(&sums).for_each(|(to, sum)| *to = *sum as f32);
        depths.values = values;
        depths
    }

    /// A slice of the field with its margin, where the outermost samples are repeated.
    fn slice(&self, density: &Density, slot: usize) -> Vec<f32> {
        let [nu, nv, nw] = self.counts;
        let w = slot.clamp(1, nw) - 1;
        let w = if self.turned { nw - 1 - w } else { w };
        let wide = nu + 2 * PAD;
        let mut slice = vec![0.0; wide * (nv + 2 * PAD)];
        slice.par_chunks_mut(wide).with_min_len(32).enumerate().for_each(|(j, row)| {
            let v = j.clamp(PAD, PAD + nv - 1) - PAD;
            let inner = &mut row[PAD..PAD + nu];
            match self.axes[2] {
                2 => inner.copy_from_slice(density.row(v, w)),
                1 => inner.copy_from_slice(density.row(w, v)),
                _ => inner.iter_mut().enumerate().for_each(|(u, to)| *to = density.row(u, v)[w]),
            }
            let [first, last] = [row[PAD], row[PAD + nu - 1]];
            row[..PAD].fill(first);
            row[PAD + nu..].fill(last);
        });
        slice
    }

    /// Optical depth for tau = 1 from a place, m, which is taken to the box if it is outside of it.
    pub fn at(&self, place: [f64; 3]) -> f64 {
        let mut origin = place.map(|x| x / self.voxel + 0.5);
        for (axis, count) in self.axes.into_iter().zip(self.counts) {
            origin[axis] = origin[axis].clamp(0.5, count as f64 + 0.5);
        }
        self.read(&self.sheared(&LatticeRay { origin, direction: [0.0; 3] }), 0.0)
    }

    /// A ray's way through the sheared lattice; its parameter stays its length in the field's voxels.
    pub(super) fn along(&self, ray: &LatticeRay) -> Sheared {
        let origin = ray.origin.map(|q| self.fine * (q - 0.5) + 0.5);
        self.sheared(&LatticeRay { origin, direction: ray.direction.map(|d| self.fine * d) })
    }

    fn sheared(&self, ray: &LatticeRay) -> Sheared {
        let turn = |q: f64| if self.turned { self.counts[2] as f64 - q } else { q - 1.0 };
        let [u, v, w] = self.axes;
        let across = turn(ray.origin[w]);
        let forth = if self.turned { -ray.direction[w] } else { ray.direction[w] };
        let [su, sv] = self.shear;
        Sheared {
            origin: [ray.origin[u] - 1.0 - su * across, ray.origin[v] - 1.0 - sv * across, across],
            slope: [ray.direction[u] - su * forth, ray.direction[v] - sv * forth, forth],
        }
    }

    /// Optical depth for tau = 1 at a place of a ray, voxels from its origin; within the box.
    #[inline(always)]
    pub(super) fn read(&self, ray: &Sheared, at: f64) -> f64 {
        let place = |axis: usize| ray.origin[axis] + ray.slope[axis] * at;
        let [u, v, w] = [place(0), place(1), place(2)];
        // A place half-way between two whole numbers may be rounded to either: what is linear between them is the same.
        let low = |x: f64| {
            let shifted = x - 0.5 + WHOLE;
            (shifted - WHOLE, shifted.to_bits() as i32 as isize)
        };
        let ((fu, lu), (fv, lv), (fw, lw)) = (low(u), low(v), low(w));
        let slot = (lw + 1).clamp(0, self.counts[2] as isize) as usize;
        let rest = [(u - fu) as f32, (v - fv) as f32, (w - fw) as f32];
        let wide = self.counts[0] + 2 * MARGIN;
        let last = self.values.len() - wide - 2;
        let mix = |a: f32, b: f32, by: f32| a + by * (b - a);
        let plane = |slot: usize| {
            let at = self.bases[slot] + lv * wide as isize + lu;
            let at = at.clamp(0, last as isize) as usize;
            let c = &self.values[at..at + wide + 2];
            mix(mix(c[0], c[1], rest[0]), mix(c[wide], c[wide + 1], rest[0]), rest[1])
        };
        f64::from(mix(plane(slot), plane(slot + 1), rest[2]).max(0.0))
    }
}
