//! Flakes: `S -> CC[C]`, Eq. (1), crystals that hold on to each other in the seven ways of Fig. 6.
//!
//! Crystals are rigid. One comes along a straight line, the feature that is to touch ahead, until it touches. No element of
//! one is then in ice of another; in a tangle a few are.

mod attachment;
mod join;
mod template;
#[cfg(test)]
mod tests;

pub use attachment::{Assembly, Attachment, Feature, Kind, Weights};
pub use template::Template;

use std::collections::VecDeque;

use nalgebra::{Isometry3, Point3};

use super::{SnowError, within};
use crate::rng::Seed;

/// What must be assumed to join crystals. [`Joining::assumed`] says why each is what it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Joining {
    /// How often each way is taken.
    pub weights: Weights,
    /// The largest angle by which a crystal comes askew, degrees; faces on faces do not.
    pub tilt: f64,
    /// The largest share of a tangled crystal's surface elements that may be in ice of the other.
    pub tangle: f64,
    /// Tangles are further out than this share of both radii: "at the tips", §1.2.1.
    pub tangle_from: f64,
    /// How often a contact is tried before another way is drawn, and in all before it is given up.
    pub tries: u32,
}

impl Joining {
    /// | | | why |
    /// |---|---|---|
    /// | weights | uniform | those of Fig. 5 and 6 are lost |
    /// | tilt | 20 degrees | crystals tumble |
    /// | tangle | 0.05 | branches would break |
    /// | tangle_from | 2/3 | the outer third |
    /// | tries | 400 | enough for tangles, of which one in some tens fits |
    pub fn assumed() -> Self {
        Self { weights: Weights::UNIFORM, tilt: 20.0, tangle: 0.05, tangle_from: 2.0 / 3.0, tries: 400 }
    }

    fn check(&self) -> Result<(), SnowError> {
        within("the tilt, degrees,", self.tilt, 0.0, 90.0)?;
        within("the share of a tangle", self.tangle, 0.0, 1.0)?;
        within("where tangles begin", self.tangle_from, 0.0, 1.0)?;
        within("the number of tries", f64::from(self.tries), 1.0, 1e6)?;
        let weights = self.weights.0.as_flattened().as_flattened();
        weights.iter().try_for_each(|weight| within("a weight", *weight, 0.0, 1e9))
    }
}

/// A crystal in a flake.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Which of the templates it is.
    pub template: usize,
    /// Where it is and how it is turned, m.
    pub pose: Isometry3<f64>,
    /// The member that it came to hold on to, and how; none of the first.
    pub held: Option<(usize, Attachment)>,
}

/// Crystals that hold on to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Flake {
    /// The crystals.
    pub members: Vec<Member>,
}

impl Flake {
    /// The most crystals of a flake.
    pub const MOST: usize = 10_000;

    /// Joins crystals, one for each number of `chosen`, in this order.
    ///
    /// # Errors
    ///
    /// No crystal, more than [`MOST`](Self::MOST), or one that there is not; numbers of `joining` out of range; crystals of
    /// different elements; no contact found in all tries.
    pub fn assemble(
        templates: &[Template],
        chosen: &[usize],
        assembly: Assembly,
        joining: &Joining,
        seed: Seed,
    ) -> Result<Self, SnowError> {
        joining.check()?;
        within("the number of crystals", chosen.len() as f64, 1.0, Self::MOST as f64)?;
        for number in chosen {
            within("the number of a crystal", *number as f64, 0.0, templates.len() as f64 - 1.0)?;
        }
        let side = templates[chosen[0]].crystal().element();
        if chosen.iter().any(|number| templates[*number].crystal().element() != side) {
            return Err(SnowError::Sides);
        }
        let stream = seed.stream("flake");
        let single =
            |template| Self { members: vec![Member { template, pose: Isometry3::identity(), held: None }] };
        let mut flakes: VecDeque<Self> = chosen.iter().map(|number| single(*number)).collect();
        let mut count = 0;
        while let (Some(a), true) = (flakes.pop_front(), !flakes.is_empty()) {
            let b = flakes.pop_front().unwrap_or_else(|| single(chosen[0]));
            let joined = join::join(templates, a, b, joining, &stream.at(count))?;
            count += 1;
            match assembly {
                Assembly::OneByOne => flakes.push_front(joined),
                Assembly::FlakeToFlake => flakes.push_back(joined),
            }
            if flakes.len() == 1 {
                break;
            }
        }
        flakes.pop_front().map_or_else(|| Ok(single(chosen[0])), Ok)
    }

    /// Mass, kg.
    pub fn mass(&self, templates: &[Template]) -> f64 {
        self.members.iter().map(|member| templates[member.template].crystal().mass()).sum()
    }

    /// The centre of mass, m: crystals are symmetric, theirs is in their middle.
    pub fn centre(&self, templates: &[Template]) -> Point3<f64> {
        let sum = self.members.iter().fold(nalgebra::Vector3::zeros(), |sum, member| {
            sum + member.pose.translation.vector * templates[member.template].crystal().mass()
        });
        Point3::from(sum / self.mass(templates))
    }

    /// Twice the distance from the centre of mass to the element furthest from it, m.
    pub fn diameter(&self, templates: &[Template]) -> f64 {
        let centre = self.centre(templates);
        let furthest =
            self.places(templates).map(|place| (place - centre).norm_squared()).fold(0.0, f64::max);
        2.0 * furthest.sqrt()
    }

    /// Centres of the surface elements of all crystals, m.
    pub fn places(&self, templates: &[Template]) -> impl Iterator<Item = Point3<f64>> {
        self.members
            .iter()
            .flat_map(|member| templates[member.template].surface().iter().map(|place| member.pose * place))
    }

    /// The greatest share of a member's surface elements that is in ice of others, among members that are not in a tangle,
    /// and among those that are: 0 of the first.
    pub fn overlap(&self, templates: &[Template]) -> [f64; 2] {
        let mut most = [0.0; 2];
        let tangles = |a: usize, b: usize| self.members[a].held == Some((b, Attachment::Tangle));
        for (j, a) in self.members.iter().enumerate() {
            for (k, b) in self.members.iter().enumerate().filter(|(k, _)| *k != j) {
                let seen = a.pose.inverse() * b.pose;
                let (of, other) = (&templates[a.template], &templates[b.template]);
                let share = of.swallowed(other, &seen).len() as f64 / other.surface().len() as f64;
                let most: &mut f64 = &mut most[usize::from(tangles(j, k) || tangles(k, j))];
                *most = most.max(share);
            }
        }
        most
    }
}
