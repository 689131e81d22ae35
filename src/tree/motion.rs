//! A step of the tree: Eq. (7) to (11).

use super::forces::{reaction, restoring, wind};
use super::readings::{AirSpeed, Damping, Gravity, Position, SharedSymbol, VelocityAfterLength};
use super::{Parameters, Readings, Skeleton, TreeError, Vector};

/// A tree at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    skeleton: Skeleton,
    parameters: Parameters,
    readings: Readings,
    place: Vec<Vector>,
    // Of Eq. (9): a displacement per step where Eq. (10) stands as printed.
    velocity: Vec<Vector>,
    // What the last step moved each node by, over dt: m/s.
    moved: Vec<Vector>,
}

/// How far a tree is from its rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// Displacement of the tip, m.
    pub tip: Vector,
    /// Mean over the links of the angle to their direction at rest, degrees.
    pub mean_angle: f64,
    /// Displacement of the centre of mass, m.
    pub centroid: Vector,
}

impl Tree {
    /// A tree at rest.
    ///
    /// # Errors
    ///
    /// What [`Parameters::check`] refuses.
    pub fn new(skeleton: Skeleton, parameters: Parameters, readings: Readings) -> Result<Self, TreeError> {
        parameters.check()?;
        let still = vec![Vector::zeros(); skeleton.nodes()];
        let place = skeleton.place.clone();
        Ok(Self { skeleton, parameters, readings, place, velocity: still.clone(), moved: still })
    }

    /// The tree at rest.
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// Its numbers.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// How the page is read.
    pub fn readings(&self) -> &Readings {
        &self.readings
    }

    /// Where a node is, m.
    pub fn place(&self, node: usize) -> Vector {
        self.place[node]
    }

    /// F_w of a node in air that moves with `air` m/s, N; zero for the root.
    pub fn wind_force(&self, node: usize, air: Vector) -> Vector {
        if self.skeleton.parent(node).is_none() {
            return Vector::zeros();
        }
        let own = match self.readings.air_speed {
            AirSpeed::AsPrinted => self.velocity[node],
            AirSpeed::PerTime => self.moved[node],
        };
        let left = match self.readings.shared_symbol {
            SharedSymbol::TwoNumbers => 1.0,
            SharedSymbol::OneNumber => self.parameters.damping,
        };
        wind(&self.skeleton, &self.parameters, self.readings.drag, node, left * air - own)
    }

    /// The acceleration of each node for nodes at `place` without wind, m/s2: Eq. (4) to (8). The root has none.
    pub(super) fn acceleration(&self, place: &[Vector]) -> Vec<Vector> {
        let given = &self.parameters;
        let back = restoring(&self.skeleton, given, self.readings.target, place);
        let on_parents = reaction(&self.skeleton, given.reaction, place, &back);
        let weight = match self.readings.gravity {
            Gravity::AsPrinted => Vector::new(0.0, -given.gravity),
            Gravity::RestPose => Vector::zeros(),
        };
        (0..place.len())
            .map(|node| match self.skeleton.parent(node) {
                None => Vector::zeros(),
                Some(_) => (back[node] + on_parents[node]) / self.skeleton.mass(node, given.density) + weight,
            })
            .collect()
    }

    /// What is left of a velocity after a step of `dt` s, Eq. (9).
    pub(super) fn kept(&self, dt: f64) -> f64 {
        let factor = match self.readings.shared_symbol {
            SharedSymbol::TwoNumbers => self.parameters.damping,
            SharedSymbol::OneNumber => self.parameters.reaction,
        };
        match self.readings.damping {
            Damping::PerStep => factor,
            Damping::Rate => libm::pow(factor, dt / self.parameters.damping_step),
        }
    }

    /// One step of `dt` s under the force of the wind on each node, N.
    pub fn step(&mut self, dt: f64, wind: &[Vector]) {
        let kept = self.kept(dt);
        let acceleration = self.acceleration(&self.place);
        let per_step = match self.readings.position {
            Position::AsPrinted => 1.0,
            Position::TimesDt => dt,
        };
        let before = self.place.clone();
        for node in 0..self.place.len() {
            let Some(parent) = self.skeleton.parent(node) else { continue };
            let mass = self.skeleton.mass(node, self.parameters.density);
            let push = acceleration[node] + wind[node] / mass;
            self.velocity[node] = kept * self.velocity[node] + dt * push; // Eq. (9)
            let free = before[node] + per_step * self.velocity[node]; // Eq. (10)
            // Eq. (11); the parent, which comes first, has its place already.
            let link = free - self.place[parent];
            let length = libm::sqrt(link.x * link.x + link.y * link.y);
            let way = if length > 0.0 { link / length } else { Vector::new(0.0, 1.0) };
            self.place[node] = self.place[parent] + way * self.skeleton.length(node);
            self.moved[node] = (self.place[node] - before[node]) / dt;
            if self.readings.velocity == VelocityAfterLength::Corrected {
                self.velocity[node] = (self.place[node] - before[node]) / per_step;
            }
        }
    }

    /// Turns the link that ends in a node by an angle, rad, and takes all that grows from it along.
    pub fn turn_link(&mut self, node: usize, angle: f64) {
        let Some(parent) = self.skeleton.parent(node) else { return };
        let (sine, cosine) = libm::sincos(angle);
        let about = self.place[parent];
        let mut moves = vec![false; self.place.len()];
        moves[node] = true;
        for k in node..self.place.len() {
            moves[k] |= self.skeleton.parent(k).is_some_and(|parent| moves[parent]);
            if moves[k] {
                let from = self.place[k] - about;
                let to = Vector::new(cosine * from.x - sine * from.y, sine * from.x + cosine * from.y);
                self.place[k] = about + to;
            }
        }
    }

    /// How far the tree is from its rest.
    pub fn bend(&self) -> Bend {
        let tree = &self.skeleton;
        let tip = tree.tip();
        let (mut angles, mut links, mut moment, mut mass) = (0.0, 0, Vector::zeros(), 0.0);
        for node in 0..tree.nodes() {
            let Some(parent) = tree.parent(node) else { continue };
            let (now, rest) = (self.place[node] - self.place[parent], tree.link(node));
            let (along, across) = (rest.x * now.x + rest.y * now.y, rest.x * now.y - rest.y * now.x);
            angles += libm::atan2(across.abs(), along).to_degrees();
            links += 1;
            let m = tree.mass(node, self.parameters.density);
            moment += m * (self.place[node] - tree.place(node));
            mass += m;
        }
        Bend {
            tip: self.place[tip] - tree.place(tip),
            mean_angle: angles / f64::from(links),
            centroid: moment / mass,
        }
    }
}
