//! What a flow in a rectangle is told, and what it answers.

use super::Lattice;
use crate::reading::Reading;

/// How `(v . grad) v` is differenced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convection {
    /// Centred: second order.
    Central,
    /// From where the air comes: first order, and never more than is there.
    Upwind,
}

impl Reading for Convection {
    const QUANTITY: &'static str = "convection";
    const ALL: &'static [Self] = &[Self::Central, Self::Upwind];

    fn name(self) -> &'static str {
        match self {
            Self::Central => "central",
            Self::Upwind => "upwind",
        }
    }
}

/// A rectangle of `cells[0] x cells[1]` cells, `size` in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// Width and height, m.
    pub size: [f64; 2],
    /// Cells along x and y.
    pub cells: [usize; 2],
}

impl Domain {
    /// Width and height of a cell, m.
    pub fn spacing(&self) -> [f64; 2] {
        [self.size[0] / self.cells[0] as f64, self.size[1] / self.cells[1] as f64]
    }
}

/// One side of the rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side {
    /// A wall, which itself moves along with this speed, m/s (along +x or +y).
    Wall(f64),
    /// A wall without friction.
    Slip,
    /// Air comes in at this speed, m/s, square to the side.
    Inflow(f64),
    /// What is next to it flows out as it is.
    Outflow,
}

/// The four sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sides {
    /// At the least x.
    pub left: Side,
    /// At the greatest x.
    pub right: Side,
    /// At the least y.
    pub bottom: Side,
    /// At the greatest y.
    pub top: Side,
}

impl Sides {
    /// A box whose lid moves with 1 times `speed`.
    pub fn cavity(speed: f64) -> Self {
        let still = Side::Wall(0.0);
        Self { left: still, right: still, bottom: still, top: Side::Wall(speed) }
    }

    /// Wind over the ground: in at the left (or, if `speed` is negative, at the right), out at the other side and at
    /// the top.
    pub fn wind(speed: f64) -> Self {
        let (left, right) = match speed < 0.0 {
            false => (Side::Inflow(speed), Side::Outflow),
            true => (Side::Outflow, Side::Inflow(-speed)),
        };
        Self { left, right, bottom: Side::Wall(0.0), top: Side::Outflow }
    }

    /// Another speed of the inflow at the left or the right.
    pub(super) fn set_inflow(&mut self, speed: f64) {
        for side in [&mut self.left, &mut self.right] {
            if let Side::Inflow(now) = side {
                *now = speed.abs();
            }
        }
    }

    /// Left, right, bottom, top.
    pub(super) fn all(&self) -> [Side; 4] {
        [self.left, self.right, self.bottom, self.top]
    }

    /// The greatest speed, along x and along y, that the sides themselves have.
    pub(super) fn speed(&self) -> [f64; 2] {
        let mut speed = [0.0_f64; 2];
        for (number, side) in self.all().into_iter().enumerate() {
            let square = number / 2;
            match side {
                Side::Wall(along) => speed[1 - square] = speed[1 - square].max(along.abs()),
                Side::Inflow(into) => speed[square] = speed[square].max(into.abs()),
                Side::Slip | Side::Outflow => {}
            }
        }
        speed
    }
}

/// Why there is no flow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlowError {
    /// A number is outside what is handled.
    #[error("{name} is {value}; {accepted} is handled")]
    OutOfRange {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would be.
        accepted: &'static str,
    },
    /// The time step breaks the stability bound.
    #[error(
        "a time step of {dt} s is unstable: at {} m/s, viscosity {viscosity} m2/s and cells of {} m at most {most} s is \
         stable", speed[0].max(speed[1]), spacing[0].min(spacing[1])
    )]
    Unstable {
        /// What was asked for, s.
        dt: f64,
        /// The largest stable step, s.
        most: f64,
        /// Speeds along x and y that it was worked out for, m/s.
        speed: [f64; 2],
        /// m2/s.
        viscosity: f64,
        /// m.
        spacing: [f64; 2],
    },
    /// The flow grew beyond bounds.
    #[error(
        "the flow broke down at {time} s: speeds beyond {bound} m/s; the time step of {dt} s is too long for it (it was \
         let pass up to {most} s)"
    )]
    BrokeDown {
        /// When, s.
        time: f64,
        /// A hundred times the speed of the sides, m/s.
        bound: f64,
        /// The step, s.
        dt: f64,
        /// What the bound at the sides' own speed allowed, s.
        most: f64,
    },
}

/// Refuses what no solver can run.
pub(super) fn check(domain: &Domain, sides: &Sides, viscosity: f64) -> Result<(), FlowError> {
    let refuse = |name, value, accepted| Err(FlowError::OutOfRange { name, value, accepted });
    for cells in domain.cells {
        if !(4..=4096).contains(&cells) {
            return refuse("the number of cells in a row", cells as f64, "4 to 4096");
        }
    }
    for size in domain.size {
        if !(1e-6..=1e6).contains(&size) {
            return refuse("the size of the box in m", size, "1e-6 to 1e6");
        }
    }
    if !(0.0..=1e6).contains(&viscosity) {
        return refuse("the viscosity in m2/s", viscosity, "0 to 1e6");
    }
    for side in sides.all() {
        match side {
            Side::Wall(speed) | Side::Inflow(speed) if speed.abs() > 1e4 || !speed.is_finite() => {
                return refuse("a speed in m/s", speed, "-10000 to 10000");
            }
            _ => {}
        }
    }
    let flows = |of: fn(&Side) -> bool| sides.all().iter().filter(|side| of(side)).count();
    if flows(|side| matches!(side, Side::Inflow(_))) > 0 && flows(|side| *side == Side::Outflow) == 0 {
        return refuse("the number of sides with outflow", 0.0, "with an inflow, at least 1");
    }
    Ok(())
}

/// A flow that a model can put something into: what it reads is the air's velocity, what it leaves is a force.
pub trait Flow {
    /// The air's velocity at a place in m/s, Eq. (19); none outside of the box.
    fn velocity(&self, place: [f64; 2]) -> Option<[f64; 2]>;

    /// Adds a force over mass, m/s2, that acts from here on, spread over the nodes around with the weights of Eq. (19);
    /// a force in N is divided by density, cell area and depth before. False, and nothing is added, outside of the box.
    fn push(&mut self, place: [f64; 2], force: [f64; 2]) -> bool;

    /// Takes away every force.
    fn release(&mut self);

    /// One step of `dt` s.
    fn step(&mut self, dt: f64) -> Result<(), FlowError>;

    /// Whether a step of `dt` s is let pass.
    ///
    /// # Errors
    ///
    /// [`FlowError::Unstable`] where it is not.
    fn check(&self, dt: f64) -> Result<(), FlowError>;

    /// The largest divergence, 1/s.
    fn divergence(&self) -> f64;

    /// Another speed of the inflow from here on, m/s.
    fn set_inflow(&mut self, speed: f64);

    /// The nodes on which [`velocity`](Flow::velocity) is known, for a drawing.
    fn nodes(&self) -> Lattice;
}
