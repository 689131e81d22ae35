//! Eq. (11) and (16) of Himeno, Kenmochi & Kotani as sums over samples.

use super::exponential::exp;
use super::vector::unit;
use super::{Bricks, Himeno, Ray, Seen, Shading, VolumeError, Work, within};
use crate::reading::Reading;

/// How the sums of Eq. (11) and (16) are executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sums {
    /// Sums over samples a voxel apart, tau in the exponent alone, the sample itself before itself.
    AsPrinted,
    /// Integrals, exact per cell, tau in front.
    PerCell,
}

impl Sums {
    /// The shading of a picture for which they are executed so.
    pub fn shading(self, himeno: Himeno) -> Shading {
        match self {
            Self::AsPrinted => Shading::Printed(himeno),
            Self::PerCell => Shading::Himeno(himeno),
        }
    }
}

impl Reading for Sums {
    const QUANTITY: &'static str = "sums";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::PerCell];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::PerCell => "per-cell",
        }
    }
}

impl Himeno {
    /// Eq. (11) along a ray as printed (for a picture: [`Shading::Printed`]), with what is left of the background's light.
    ///
    /// `tau` belongs to a sample, whatever its step: tau of extinction times the voxel's side. Samples are a voxel apart,
    /// the first half a step behind the entry. I(w), Eq. (16): samples a voxel apart from w itself, as printed, towards the
    /// light. There is no tau in front, so radiance is not bounded by the lights: it grows as 1 / tau.
    ///
    /// # Errors
    ///
    /// [`VolumeError`] for a tau below 0 and a light without direction.
    pub fn as_printed(
        &self,
        bricks: &Bricks,
        tau: f64,
        ray: &Ray,
        work: &mut Work,
    ) -> Result<Seen, VolumeError> {
        within("tau of a sample", tau, 0.0, 1e30, "0 to 1e30")?;
        let to_light = unit("the direction to the light", self.to_light)?;
        work.rays += 1;
        Ok(Self { to_light, ..*self }.printed(bricks, tau, ray, work))
    }

    /// The same of a light whose direction is of length 1; the ray is counted already.
    pub(super) fn printed(&self, bricks: &Bricks, tau: f64, ray: &Ray, work: &mut Work) -> Seen {
        let (mut radiance, mut sum) = ([0.0; 3], 0.0);
        for place in samples(bricks, ray, 0.5) {
            work.cells += 1;
            let (density, gradient) = bricks.at(place);
            if density == 0.0 {
                continue;
            }
            sum += density;
            let mut lit = self.reflected(gradient, ray.direction, self.to_light);
            // On the side away from the light nothing depends on what is before it.
            if lit > 0.0 {
                let light = Ray { origin: place, direction: self.to_light };
                let before: f64 = samples(bricks, &light, 0.0).map(|place| bricks.at(place).0).sum();
                lit *= exp(-tau * before);
            }
            let seen = exp(-tau * sum) * density;
            for (c, to) in radiance.iter_mut().enumerate() {
                *to += seen * (self.light[c] * lit + self.ambient * self.ambient_light[c]);
            }
        }
        Seen { radiance, transmittance: exp(-tau * sum) }
    }
}

/// Places a voxel apart within the box, the first `offset` steps behind the entry.
fn samples(bricks: &Bricks, ray: &Ray, offset: f64) -> impl Iterator<Item = [f64; 3]> {
    let step = bricks.voxel();
    let [from, to] = bricks.inside(ray).unwrap_or_default();
    // A sample on the far face is outside, whichever way it is rounded.
    let number = ((to - from) / step - offset - 1e-9).max(0.0).ceil() as usize;
    (0..number).map(move |k| ray.place(from + (k as f64 + offset) * step))
}
