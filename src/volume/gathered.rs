//! The light that a ray gathers on its way, out of what is before it.
//!
//! Along a part of the way in one cell both depths, to the eye and to the light, are taken as linear in one another; the
//! light gathered is then exact. With none before it, x the depth to the eye and s that to the light, a part of depth d
//! gives S d times the mean of exp(-x - s) over it. Where one of them changes much, the part is cut into equal ones first.

use super::exponential::{exp, mean};
use super::walk::Segment;

/// A part is cut where the depth to the eye or to the light changes by more over it, and into as many as it changes by
/// times this, up to eight.
const STEADY: f64 = 0.25;
const MOST_PARTS: f64 = 8.0;
/// Where no more light than e to minus this is left, nothing is cut: little is gathered there.
const DARK: f64 = 6.0;

/// Light gathered along one ray from one direction, its colour and strength left out.
pub(super) struct Gathered {
    direction: [f64; 3],
    /// What is before the place at hand, to the eye and on to the light.
    depth: f64,
    light: f64,
    transmitted: f64,
    /// Where that place is.
    at: f64,
    /// The sum.
    pub sum: f64,
}

impl Gathered {
    /// With the ray's direction.
    pub fn new(direction: [f64; 3]) -> Self {
        Self { direction, depth: 0.0, light: 0.0, transmitted: 1.0, at: f64::NEG_INFINITY, sum: 0.0 }
    }

    /// Goes on over a part of the way of optical depth `depth`, scattering the share `strength`; `light` gives the depth
    /// to the light at a place.
    #[inline(always)]
    pub fn add(&mut self, part: &Segment, depth: f64, strength: f64, light: impl Fn(f64) -> f64) {
        if part.from != self.at {
            // Something empty was passed over.
            self.light = light(part.from);
            self.transmitted = exp(-(self.depth + self.light));
        }
        self.at = part.to;
        let (before, end) = (self.depth, light(part.to));
        let change = depth.max((end - self.light).abs());
        // A part without depth gathers nothing.
        if change > STEADY && depth > 0.0 && before + self.light.min(depth + end) < DARK {
            let number = (change / STEADY).min(MOST_PARTS).ceil() as u32;
            self.cut(part, [depth, strength], number, light);
        }
        self.go(before + depth, end, strength);
    }

    /// Goes on over all but the last of `number` equal parts of a part. Out of line: where little is cut, it is in the way.
    #[inline(never)]
    fn cut(&mut self, part: &Segment, [depth, strength]: [f64; 2], number: u32, light: impl Fn(f64) -> f64) {
        let (step, scale) = ((part.to - part.from) / f64::from(number), depth / part.depth);
        let mut from = part.from;
        for k in 1..number {
            let to = part.from + f64::from(k) * step;
            let depth = scale * part.between(from, to, self.direction);
            self.go(self.depth + depth, light(to), strength);
            from = to;
        }
    }

    /// Goes on to where both depths are these.
    #[inline(always)]
    fn go(&mut self, depth: f64, light: f64, strength: f64) {
        let (x0, x1) = (self.depth + self.light, depth + light);
        let transmitted = exp(-x1);
        self.sum += strength * (depth - self.depth) * mean(self.transmitted, transmitted, x0, x1);
        (self.depth, self.light, self.transmitted) = (depth, light, transmitted);
    }
}
