//! One flake comes to another along a line until they touch.

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::rng::{Moment, Place};

use super::super::SnowError;
use super::attachment::Attachment;
use super::template::{Template, unit};
use super::{Flake, Joining, Member};

/// Ways that are drawn before it is given up.
const WAYS: u32 = 20;
/// Elements touch whose centres are at most so far apart along the line, in elements.
const TOUCH: f64 = 2.0;

/// Joins two flakes at a member of each.
pub(super) fn join(
    templates: &[Template],
    a: Flake,
    b: Flake,
    joining: &Joining,
    moment: &Moment,
) -> Result<Flake, SnowError> {
    for way in 0..WAYS {
        let mut numbers = moment.place(way as i32, -1, 0);
        let mut choose = |flake: &Flake| (numbers.uniform() * flake.members.len() as f64) as usize;
        let (at, from) = (choose(&a), choose(&b));
        let kinds = [&a.members[at], &b.members[from]].map(|member| templates[member.template].kind());
        let Some(way_chosen) = joining.weights.choose(kinds[0], kinds[1], numbers.uniform()) else {
            continue;
        };
        // Crystals of which one only has a face.
        let swapped = {
            let features = way_chosen.features();
            let fits = |order: [usize; 2]| {
                (0..2).all(|k| features[order[k]] != super::Feature::Face || kinds[k].has_face())
            };
            match (fits([0, 1]), fits([1, 0])) {
                (true, true) => numbers.uniform() < 0.5,
                (straight, _) => !straight,
            }
        };
        for attempt in 0..joining.tries {
            let mut numbers = moment.place(way as i32, attempt as i32, 1);
            let meeting = Meeting { templates, a: &a, b: &b, at, from, way: way_chosen, swapped, joining };
            if let Some(motion) = meeting.attempt(&mut numbers) {
                return Ok(merged(a, b, at, from, way_chosen, &motion));
            }
        }
    }
    Err(SnowError::NoContact { crystals: a.members.len() + b.members.len() })
}

fn merged(mut a: Flake, b: Flake, at: usize, from: usize, way: Attachment, motion: &Isometry3<f64>) -> Flake {
    let first = a.members.len();
    // The tree of who holds on to whom is turned so that it hangs from the member that touches.
    let mut held: Vec<Option<(usize, Attachment)>> = b.members.iter().map(|member| member.held).collect();
    let (mut child, mut above) = (from, held[from].take());
    while let Some((parent, how)) = above {
        above = held[parent].replace((child, how));
        child = parent;
    }
    for (number, (member, held)) in b.members.into_iter().zip(held).enumerate() {
        let pose = renormalised(motion * member.pose);
        let held = if number == from { Some((at, way)) } else { held.map(|(k, how)| (k + first, how)) };
        a.members.push(Member { pose, held, ..member });
    }
    a
}

struct Meeting<'a> {
    templates: &'a [Template],
    a: &'a Flake,
    b: &'a Flake,
    at: usize,
    from: usize,
    way: Attachment,
    swapped: bool,
    joining: &'a Joining,
}

impl Meeting<'_> {
    /// The motion that brings `b` to `a`; none if what touches is not what was to touch.
    fn attempt(&self, numbers: &mut Place) -> Option<Isometry3<f64>> {
        let (host, guest) = (&self.a.members[self.at], &self.b.members[self.from]);
        let (host_template, guest_template) =
            (&self.templates[host.template], &self.templates[guest.template]);
        let element = host_template.crystal().element();
        let features = self.way.features();
        let [first, second] = if self.swapped { [features[1], features[0]] } else { features };
        let (out, target) = host_template.feature(first, numbers);
        let (ahead, touching) = guest_template.feature(second, numbers);
        let (line, target) = (host.pose.rotation * out, host.pose * target);

        // Turned so that its feature is ahead, rolled about the line, and askew.
        let facing = between(&(guest.pose.rotation * ahead), &-line) * guest.pose.rotation;
        let roll = turn(&line, 360.0 * numbers.uniform());
        let sideways = across(&line);
        let axis = turn(&line, 360.0 * numbers.uniform()) * sideways[0];
        let tilt = if self.way == Attachment::FaceFace { 0.0 } else { self.joining.tilt };
        let turned = turn(&axis, tilt * numbers.uniform()) * roll * facing;
        let mut offset = Vector3::zeros();
        if self.way == Attachment::Tangle {
            // Beside the tip, so that arms pass each other.
            let aside = 0.2 * host_template.radius() * numbers.uniform();
            offset = turn(&line, 360.0 * numbers.uniform()) * sideways[0] * aside;
        }
        let start = Isometry3::from_parts(
            Translation3::from(target.coords + offset - turned * touching.coords),
            turned,
        );
        let motion = start * guest.pose.inverse();
        let moved: Vec<Point3<f64>> = self.b.places(self.templates).map(|place| motion * place).collect();
        let gap = self.gap(&moved, &line, element)?;
        let pushed = |by: f64| {
            Isometry3::from_parts(Translation3::from(line * by), UnitQuaternion::identity()) * motion
        };
        if self.way == Attachment::Tangle {
            let depth =
                (0.05 + 0.25 * numbers.uniform()) * host_template.radius().min(guest_template.radius());
            let motion = pushed(gap - depth);
            return self.is_tangle(&motion).then_some(motion);
        }
        // The lattice of the search is as coarse as an element: back off until nothing is in ice. Not by halves, since
        // faces on faces would then lie where rounding decides.
        (0..=4)
            .map(|k| pushed(gap + (0.55 + 0.25 * f64::from(k)) * element))
            .find(|motion| self.swallowed(motion).is_none())
            .filter(|motion| self.touches(motion, &line, element))
    }

    /// How far to go along the line, m, until an element of `moved` is where one of the flake is.
    fn gap(&self, moved: &[Point3<f64>], line: &Vector3<f64>, element: f64) -> Option<f64> {
        let sideways = across(line);
        let pixel = |place: &Point3<f64>| {
            [0, 1].map(|k| libm::floor(place.coords.dot(&sideways[k]) / element) as i64)
        };
        let (mut low, mut high) = ([i64::MAX; 2], [i64::MIN; 2]);
        for place in moved {
            let at = pixel(place);
            for k in 0..2 {
                low[k] = low[k].min(at[k]);
                high[k] = high[k].max(at[k]);
            }
        }
        let size = [0, 1].map(|k| (high[k] - low[k] + 1) as usize);
        let index = |place: &Point3<f64>| {
            let at = pixel(place);
            let inside = (0..2).all(|k| low[k] <= at[k] && at[k] <= high[k]);
            inside.then(|| (at[1] - low[1]) as usize * size[0] + (at[0] - low[0]) as usize)
        };
        let mut nearest = vec![f64::INFINITY; size[0] * size[1]];
        for place in moved {
            if let Some(at) = index(place) {
                nearest[at] = nearest[at].min(place.coords.dot(line));
            }
        }
        let gap = self
            .a
            .places(self.templates)
            .filter_map(|place| Some(place.coords.dot(line) - nearest[index(&place)?]))
            .fold(f64::NEG_INFINITY, f64::max);
        gap.is_finite().then_some(gap)
    }

    /// The first pair of members of which one has an element in ice of the other.
    fn swallowed(&self, motion: &Isometry3<f64>) -> Option<(usize, usize)> {
        self.pairs(motion).find(|(j, k)| self.overlap(motion, *j, *k).iter().any(|share| *share > 0.0))
    }

    /// Members of both whose spheres meet.
    fn pairs<'b>(&'b self, motion: &'b Isometry3<f64>) -> impl Iterator<Item = (usize, usize)> + 'b {
        (0..self.a.members.len()).flat_map(move |j| (0..self.b.members.len()).map(move |k| (j, k))).filter(
            move |(j, k)| {
                let (a, b) = (&self.a.members[*j], &self.b.members[*k]);
                let apart = a.pose.translation.vector - (motion * b.pose).translation.vector;
                let reach = self.templates[a.template].radius() + self.templates[b.template].radius();
                apart.norm_squared() <= reach * reach
            },
        )
    }

    /// Shares of the surface elements of each of two members that are in ice of the other.
    fn overlap(&self, motion: &Isometry3<f64>, j: usize, k: usize) -> [f64; 2] {
        let (a, b) = (&self.a.members[j], &self.b.members[k]);
        let (of_a, of_b) = (&self.templates[a.template], &self.templates[b.template]);
        let seen = a.pose.inverse() * motion * b.pose;
        let share = |of: &Template, other: &Template, pose: &Isometry3<f64>| {
            of.swallowed(other, pose).len() as f64 / other.surface().len() as f64
        };
        [share(of_b, of_a, &seen.inverse()), share(of_a, of_b, &seen)]
    }

    /// Whether the two members that were to tangle do, within bounds and at their tips, and no others.
    fn is_tangle(&self, motion: &Isometry3<f64>) -> bool {
        for (j, k) in self.pairs(motion) {
            let shares = self.overlap(motion, j, k);
            if (j, k) != (self.at, self.from) && shares.iter().any(|share| *share > 0.0) {
                return false;
            }
        }
        let shares = self.overlap(motion, self.at, self.from);
        let most = shares[0].max(shares[1]);
        if !(most > 0.0 && most <= self.joining.tangle) {
            return false;
        }
        let (a, b) = (&self.a.members[self.at], &self.b.members[self.from]);
        let (of_a, of_b) = (&self.templates[a.template], &self.templates[b.template]);
        let seen = a.pose.inverse() * motion * b.pose;
        let back = seen.inverse();
        let is_out = |template: &Template, place: Point3<f64>| {
            place.coords.norm_squared().sqrt() >= self.joining.tangle_from * template.radius()
        };
        let at_both = |of: &Template, other: &Template, pose: &Isometry3<f64>, back: &Isometry3<f64>| {
            of.swallowed(other, pose).iter().all(|place| is_out(of, *place) && is_out(other, back * place))
        };
        at_both(of_a, of_b, &seen, &back) && at_both(of_b, of_a, &back, &seen)
    }

    /// Whether it is the two members that were to touch which do: moved on by so much, they are in each other.
    fn touches(&self, motion: &Isometry3<f64>, line: &Vector3<f64>, element: f64) -> bool {
        (1..=4).any(|k| {
            let by = -line * (0.25 * TOUCH * f64::from(k) * element);
            let on = Isometry3::from_parts(Translation3::from(by), UnitQuaternion::identity()) * motion;
            self.overlap(&on, self.at, self.from).iter().any(|share| *share > 0.0)
        })
    }
}

/// Two directions across a line and across each other.
fn across(line: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let least = if line.x.abs() <= line.y.abs() && line.x.abs() <= line.z.abs() {
        Vector3::x()
    } else if line.y.abs() <= line.z.abs() {
        Vector3::y()
    } else {
        Vector3::z()
    };
    let first = unit(line.cross(&least));
    [first, line.cross(&first)]
}

/// The shortest turn from one direction to another.
fn between(from: &Vector3<f64>, to: &Vector3<f64>) -> UnitQuaternion<f64> {
    let w = 1.0 + from.dot(to);
    if w < 1e-12 {
        // Half a turn about any axis across.
        let [axis, _] = across(from);
        return UnitQuaternion::new_unchecked(Quaternion::from_parts(0.0, axis));
    }
    normalised(Quaternion::from_parts(w, from.cross(to)))
}

/// A turn about an axis, degrees.
fn turn(axis: &Vector3<f64>, degrees: f64) -> UnitQuaternion<f64> {
    let (sine, cosine) = libm::sincos(0.5 * degrees.to_radians());
    normalised(Quaternion::from_parts(cosine, axis * sine))
}

fn normalised(q: Quaternion<f64>) -> UnitQuaternion<f64> {
    let norm = (q.w * q.w + q.i * q.i + q.j * q.j + q.k * q.k).sqrt();
    UnitQuaternion::new_unchecked(Quaternion::new(q.w / norm, q.i / norm, q.j / norm, q.k / norm))
}

/// The pose with its quaternion one long, however many turns it is made of.
fn renormalised(pose: Isometry3<f64>) -> Isometry3<f64> {
    Isometry3::from_parts(pose.translation, normalised(*pose.rotation.quaternion()))
}
