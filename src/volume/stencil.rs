//! The integral along a short slanted line between two slices of samples, as weights of samples.

/// Offsets of a tap along either axis of a slice go from -REACH to REACH.
pub(super) const REACH: usize = 2;
const WIDE: usize = 2 * REACH + 1;

/// One sample's weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tap {
    /// 0 for the near slice, 1 for the far one.
    pub slice: usize,
    /// From -2 to 2.
    pub across: isize,
    pub down: isize,
    pub weight: f32,
}

/// Weights of samples for the integral of their trilinear field along a line of this length, which is at `start` in the
/// near slice, within half a sample, and `shear`, up to one sample, farther on in the far one.
pub(super) fn taps(start: [f64; 2], shear: [f64; 2], length: f64) -> Vec<Tap> {
    let mut breaks = vec![0.0, 1.0];
    for axis in 0..2 {
        if shear[axis] == 0.0 {
            continue;
        }
        for plane in -2..=2 {
            let w = (f64::from(plane) - start[axis]) / shear[axis];
            if w > 0.0 && w < 1.0 {
                breaks.push(w);
            }
        }
    }
    breaks.sort_unstable_by(f64::total_cmp);
    let mut weights = [[[0.0_f64; WIDE]; WIDE]; 2];
    for piece in breaks.windows(2) {
        let (middle, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
        let low = [0, 1].map(|axis| (start[axis] + middle * shear[axis]).floor());
        for sign in [-1.0, 1.0] {
            let w = middle + sign * half / 3.0_f64.sqrt();
            let rest = [0, 1].map(|axis| start[axis] + w * shear[axis] - low[axis]);
            let corner = low.map(|x| (x + REACH as f64) as usize);
            for k in 0..8 {
                let bit = [k & 1, k >> 1 & 1, k >> 2];
                let part = |bit: usize, rest: f64| if bit == 1 { rest } else { 1.0 - rest };
                let weight = part(bit[0], rest[0]) * part(bit[1], rest[1]) * part(bit[2], w);
                let place = [corner[0] + bit[0], corner[1] + bit[1]].map(|at| at.min(WIDE - 1));
                weights[bit[2]][place[1]][place[0]] += half * length * weight;
            }
        }
    }
    let mut taps = Vec::new();
    for (slice, plane) in weights.iter().enumerate() {
        for (down, row) in plane.iter().enumerate() {
            for (across, weight) in row.iter().enumerate() {
                let offset = |at: usize| at as isize - REACH as isize;
                if *weight != 0.0 {
                    let (across, down) = (offset(across), offset(down));
                    taps.push(Tap { slice, across, down, weight: *weight as f32 });
                }
            }
        }
    }
    taps
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1e-6: weights are single precision.
    #[test]
    fn weights_are_those_of_the_integral() {
        for (start, shear) in
            [([0.3, -0.4], [0.0, 0.0]), ([0.5, -0.5], [1.0, -1.0]), ([-0.2, 0.1], [0.7, -0.35])]
        {
            let taps = taps(start, shear, 2.0);
            let sum = |value: &dyn Fn(f64, f64, f64) -> f64| -> f64 {
                let of = |tap: &Tap| value(tap.across as f64, tap.down as f64, tap.slice as f64);
                taps.iter().map(|tap| f64::from(tap.weight) * of(tap)).sum()
            };
            let middle = [0, 1].map(|axis| start[axis] + 0.5 * shear[axis]);
            assert!((sum(&|_, _, _| 1.0) - 2.0).abs() < 1e-6);
            assert!((sum(&|x, _, _| x) - 2.0 * middle[0]).abs() < 1e-6);
            assert!((sum(&|_, y, _| y) - 2.0 * middle[1]).abs() < 1e-6);
            assert!((sum(&|_, _, z| z) - 1.0).abs() < 1e-6);
            assert!(taps.len() <= 18);
        }
    }
}
