//! The bound on a solver's time step, kept as its inflow changes, and the refusals that go with it.

use super::{Convection, FlowError, Sides, Step};

/// The largest step that is let pass, for the strongest inflow so far: gusts come and go at every step.
#[derive(Clone, Debug)]
pub(super) struct Bound {
    step: Step,
    convection: Convection,
    viscosity: f64,
    spacing: [f64; 2],
    strongest: f64,
    most: f64,
}

impl Bound {
    pub fn new(step: Step, convection: Convection, viscosity: f64, spacing: [f64; 2], sides: &Sides) -> Self {
        let most = step.largest(convection, viscosity, spacing, sides.speed());
        Self { step, convection, viscosity, spacing, strongest: sides.speed()[0], most }
    }

    /// s.
    pub fn most(&self) -> f64 {
        self.most
    }

    /// Takes note of another inflow, which `sides` have already.
    pub fn follow(&mut self, sides: &Sides, inflow: f64) {
        if inflow.abs() > self.strongest {
            self.strongest = inflow.abs();
            self.most = self.step.largest(self.convection, self.viscosity, self.spacing, sides.speed());
        }
    }

    /// Refuses a step that is too long.
    pub fn check(&self, dt: f64, sides: &Sides) -> Result<(), FlowError> {
        if dt > 0.0 && dt <= self.most {
            return Ok(());
        }
        let (speed, viscosity, spacing) = (sides.speed(), self.viscosity, self.spacing);
        Err(FlowError::Unstable { dt, most: self.most, speed, viscosity, spacing })
    }

    /// Refuses velocities that no sound flow between such sides has after a step of `dt` s.
    pub fn look<'a>(
        &self,
        mut values: impl Iterator<Item = &'a f64>,
        sides: &Sides,
        time: f64,
        dt: f64,
    ) -> Result<(), FlowError> {
        let [u, v] = sides.speed();
        let bound = 100.0 * u.max(v).max(1.0);
        if values.all(|value| value.abs() <= bound) {
            return Ok(());
        }
        Err(FlowError::BrokeDown { time, bound, dt, most: self.most })
    }
}
