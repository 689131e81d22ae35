//! A crystal as a rigid body: its surface, what it touches with, and whether it is at a place.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::hexgrid::Axial;
use crate::rng::Place;

use super::super::Crystal;
use super::attachment::{Feature, Kind};

/// A crystal that flakes are made of.
#[derive(Clone, Debug)]
pub struct Template {
    crystal: Crystal,
    kind: Kind,
    // Centres of elements that an empty one touches, m.
    surface: Vec<Point3<f64>>,
    radius: f64,
}

impl Template {
    /// The rigid body of a crystal.
    pub fn new(crystal: Crystal) -> Self {
        let element = crystal.element();
        let is_inside = |at: Axial, z: i32| {
            at.neighbours().iter().all(|n| crystal.is_ice(*n, z))
                && crystal.is_ice(at, z - 1)
                && crystal.is_ice(at, z + 1)
        };
        let surface: Vec<Point3<f64>> = crystal
            .elements()
            .filter(|(at, z)| !is_inside(*at, *z))
            .map(|(at, z)| {
                let place = at.position();
                Point3::new(place.x * element, place.y * element, f64::from(z) * element)
            })
            .collect();
        let furthest = surface.iter().map(|place| place.coords.norm_squared()).fold(0.0, f64::max);
        Self { kind: Kind::of(&crystal), radius: furthest.sqrt() + element, surface, crystal }
    }

    /// The crystal.
    pub fn crystal(&self) -> &Crystal {
        &self.crystal
    }

    /// Which of the four types it counts as.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Centres of the elements of its surface, m.
    pub fn surface(&self) -> &[Point3<f64>] {
        &self.surface
    }

    /// Radius of the sphere around its middle that holds it, m.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether a place, m, is in ice.
    pub fn is_ice(&self, place: &Point3<f64>) -> bool {
        let element = self.crystal.element();
        let at = Axial::containing(nalgebra::point![place.x / element, place.y / element]);
        self.crystal.is_ice(at, libm::round(place.z / element) as i32)
    }

    /// How many elements of the surface of another crystal lie in this one, `pose` being the other's seen from here.
    pub(super) fn swallowed(&self, other: &Self, pose: &Isometry3<f64>) -> Vec<Point3<f64>> {
        let reach = self.radius * self.radius;
        other
            .surface
            .iter()
            .map(|place| pose * place)
            .filter(|place| place.coords.norm_squared() <= reach && self.is_ice(place))
            .collect()
    }

    /// A direction outwards in which a feature lies, and a place of it, m.
    pub(super) fn feature(&self, feature: Feature, numbers: &mut Place) -> (Vector3<f64>, Point3<f64>) {
        let element = self.crystal.element();
        let sixth = (6.0 * numbers.uniform()) as u32 % 6;
        let up = if numbers.uniform() < 0.5 { 1.0 } else { -1.0 };
        let in_plane = |degrees: f64| {
            let (sine, cosine) = libm::sincos(degrees.to_radians());
            Vector3::new(cosine, sine, 0.0)
        };
        let corner = in_plane(60.0 * f64::from(sixth));
        let direction = match feature {
            Feature::Face => Vector3::new(0.0, 0.0, up),
            // The edges of a column are between its side faces, as the corners of a plate are.
            Feature::Line if self.kind.has_face() => in_plane(60.0 * f64::from(sixth) + 30.0),
            Feature::Line => corner,
            Feature::Point if self.kind.has_face() => corner,
            Feature::Point => unit(Vector3::new(0.2 * corner.x, 0.2 * corner.y, up)),
        };
        let along = |place: &Point3<f64>| place.coords.dot(&direction);
        let outermost = self.surface.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
        let candidates: Vec<&Point3<f64>> = self
            .surface
            .iter()
            .filter(|place| match feature {
                // Within 0.7 of the radius, that it is not the rim; on the right side.
                Feature::Face => {
                    along(place) >= 0.0
                        && place.x * place.x + place.y * place.y < 0.49 * self.radius * self.radius
                }
                _ => along(place) >= outermost - 0.75 * element,
            })
            .collect();
        let chosen = (numbers.uniform() * candidates.len() as f64) as usize;
        (direction, candidates.get(chosen).map_or(Point3::origin(), |place| **place))
    }
}

/// A vector made one long; not for one of no length.
pub(super) fn unit(vector: Vector3<f64>) -> Vector3<f64> {
    vector / vector.norm_squared().sqrt()
}
