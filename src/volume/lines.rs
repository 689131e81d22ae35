//! The lines of the sheared lattice, from slice to slice.

use rayon::prelude::*;

use super::Density;
use super::depths::{Depths, MARGIN};
use super::stencil::{REACH, Tap};

/// Most slices that a line is followed beyond the box.
const MOST_BACK: f64 = 16.0;

/// The lattice lines in one slice.
pub(super) struct Lines<'a> {
    pub depths: &'a Depths,
    pub density: &'a Density,
    pub slot: usize,
    /// Where the line nearest to (0, 0) is.
    pub offset: [f64; 2],
    /// Of a line between two slices, m.
    pub length: f64,
}

impl Lines<'_> {
    /// Each line's sum in the next slice, and what is between.
    pub fn gather(
        &self,
        sums: &mut [f64],
        before: &[f64],
        shift: [isize; 2],
        taps: &[Tap],
        slices: [&[f32]; 2],
    ) {
        let [wide, high] = [0, 1].map(|axis| self.depths.counts[axis] + 2 * MARGIN);
        let stride = wide + 2 * REACH;
        sums.par_chunks_mut(wide).with_min_len(16).enumerate().for_each_init(
            || vec![0.0_f32; wide],
            |between, (j, row)| {
                // Lines that were not in the lattice begin here.
                let down = j as isize + shift[1];
                if !(0..high as isize).contains(&down) {
                    row.iter_mut().enumerate().for_each(|(i, sum)| *sum = self.begin(i, j));
                    return;
                }
                between.fill(0.0);
                for tap in taps {
                    let down = (j as isize + REACH as isize + tap.down) as usize;
                    let across = (REACH as isize + tap.across) as usize;
                    let from = &slices[tap.slice][down * stride + across..][..wide];
                    between.iter_mut().zip(from).for_each(|(sum, value)| *sum += tap.weight * value);
                }
                let from = &before[down as usize * wide..][..wide];
                let first = (-shift[0]).max(0) as usize;
                let end = (wide as isize - shift[0]).clamp(0, wide as isize) as usize;
                let moved = &from[(first as isize + shift[0]) as usize..];
                for ((sum, value), before) in row[first..end].iter_mut().zip(&between[first..end]).zip(moved)
                {
                    *sum = before + f64::from(*value);
                }
                for i in (0..first).chain(end..wide) {
                    row[i] = self.begin(i, j);
                }
            },
        );
    }

    /// The depth of a line that is beyond the box towards the light: what is between the box and here, below 0.
    pub fn begin(&self, i: usize, j: usize) -> f64 {
        let Depths { counts, shear, .. } = *self.depths;
        let at = [0, 1].map(|axis| [i, j][axis] as f64 - MARGIN as f64 + self.offset[axis]);
        let w = self.slot as f64 - 1.0;
        let mut back = w - (counts[2] as f64 - 0.5);
        for axis in 0..2 {
            let face = if shear[axis] > 0.0 { counts[axis] as f64 - 0.5 } else { -0.5 };
            // Light that moves by less than half a voxel in all does not leave at the side.
            if shear[axis].abs() * counts[2] as f64 >= 0.5 {
                back = back.max((at[axis] - face) / shear[axis]);
            }
        }
        -self.length * self.behind([at[0], at[1], w], back.min(MOST_BACK))
    }

    /// The integral over `back` slices up to a place of the lattice, exact as ever.
    fn behind(&self, place: [f64; 3], back: f64) -> f64 {
        let slope = [self.depths.shear[0], self.depths.shear[1], 1.0];
        let (mut sum, mut t) = (0.0, -back);
        while t < 0.0 {
            let mut next = 0.0_f64;
            for axis in 0..3 {
                let at = place[axis] + slope[axis] * t;
                // Well beyond this plane, so that rounding never finds it again.
                let plane =
                    if slope[axis] > 0.0 { (at + 1e-9).floor() + 1.0 } else { (at - 1e-9).ceil() - 1.0 };
                if slope[axis] != 0.0 {
                    next = next.min((plane - place[axis]) / slope[axis]);
                }
            }
            let (middle, half) = (0.5 * (t + next), 0.5 * (next - t));
            for sign in [-1.0, 1.0] {
                let at = middle + sign * half / 3.0_f64.sqrt();
                sum += half * self.sample([0, 1, 2].map(|axis| place[axis] + slope[axis] * at));
            }
            t = next;
        }
        sum
    }

    /// The density at a place along the axes of the lattice, where samples are at whole numbers.
    fn sample(&self, place: [f64; 3]) -> f64 {
        let Depths { axes, counts, turned, voxel, .. } = *self.depths;
        let mut at = [0.0; 3];
        for (k, axis) in axes.into_iter().enumerate() {
            let last = counts[k] as f64 - 1.0;
            let along = place[k].clamp(0.0, last);
            at[axis] = (if turned && k == 2 { last - along } else { along } + 0.5) * voxel;
        }
        self.density.at(at)
    }
}

/// Takes off what linear interpolation has too much in the mean, a twelfth of the second differences of a slice's sums along
/// the axes of the lattice: `near` and `far` are the slices before and behind it, if there are, with how their lines are
/// shifted.
pub(super) fn level(
    to: &mut [f32],
    wide: usize,
    sums: &[f64],
    near: Option<(&[f64], [isize; 2])>,
    far: Option<(&[f64], [isize; 2])>,
) {
    let high = sums.len() / wide;
    to.par_chunks_mut(wide).with_min_len(16).enumerate().for_each(|(j, to)| {
        let row = |k: usize| &sums[k * wide..][..wide];
        let own = row(j);
        let mut second = vec![0.0_f64; wide];
        for (second, x) in second[1..].iter_mut().zip(own.windows(3)) {
            *second = x[0] - 2.0 * x[1] + x[2];
        }
        if j > 0 && j + 1 < high {
            let around = row(j - 1).iter().zip(row(j + 1)).zip(own);
            second.iter_mut().zip(around).for_each(|(second, ((a, b), own))| *second += a - 2.0 * own + b);
        }
        if let (Some((near, [nu, nv])), Some((far, [fu, fv]))) = (near, far) {
            let [down_near, down_far] = [nv, fv].map(|shift| j as isize + shift);
            let rows = 0..high as isize;
            if rows.contains(&down_near) && rows.contains(&down_far) {
                // One sample at either end is left out, as far as a line is shifted.
                let from = |of: &'_ [f64], down: isize, u: isize| -> Vec<f64> {
                    of[down as usize * wide..][..wide][(1 + u) as usize..][..wide - 2].to_vec()
                };
                let (near, far) = (from(near, down_near, nu), from(far, down_far, fu));
                for (i, (a, b)) in near.iter().zip(&far).enumerate() {
                    second[i + 1] += a - 2.0 * own[i + 1] + b;
                }
            }
        }
        for ((to, own), second) in to.iter_mut().zip(own).zip(&second) {
            *to = (own - second / 12.0) as f32;
        }
    });
}
