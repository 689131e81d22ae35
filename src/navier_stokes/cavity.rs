//! The lid-driven cavity: a square box of 1 m whose lid moves, the oldest of benchmarks.
//!
//! Ghia, Ghia & Shin 1982, *High-Re solutions for incompressible flow using the Navier-Stokes equations and a multigrid
//! method*, J. Comput. Phys. 48, 387-411, tabulate both velocities on the lines through its middle.

use super::{Collocated, Convection, Domain, Flow, FlowError, Forcing, Sides, Staggered, Step, WallPressure};
use crate::reading::Reading;

/// Where the unknowns are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// On faces and in the middle of cells: [`Staggered`].
    Staggered,
    /// All in the nodes: [`Collocated`], with the wall's pressure as [`WallPressure::Linear`].
    Collocated,
}

impl Reading for Scheme {
    const QUANTITY: &'static str = "scheme";
    const ALL: &'static [Self] = &[Self::Staggered, Self::Collocated];

    fn name(self) -> &'static str {
        match self {
            Self::Staggered => "staggered",
            Self::Collocated => "collocated",
        }
    }
}

/// A cavity to be run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cavity {
    /// Speed of the lid times 1 m over the viscosity.
    pub reynolds: f64,
    /// Cells along each side.
    pub cells: usize,
    /// Speed of the lid, m/s.
    pub lid: f64,
    /// Where the unknowns are.
    pub scheme: Scheme,
    /// How convection is differenced.
    pub convection: Convection,
}

/// The cavity after some time.
#[derive(Clone, Debug, PartialEq)]
pub struct Circulation {
    /// (y, u) on x = 0.5 m, from the ground to the lid, both walls included.
    pub u: Vec<(f64, f64)>,
    /// (x, v) on y = 0.5 m, from wall to wall.
    pub v: Vec<(f64, f64)>,
    /// Kinetic energy over density and depth, m4/s2.
    pub kinetic_energy: f64,
    /// The largest divergence that is left anywhere, 1/s.
    pub divergence: f64,
    /// Steps taken.
    pub steps: u64,
}

impl Cavity {
    /// The largest time step that is let pass, s.
    pub fn largest_step(&self) -> f64 {
        let step = match self.scheme {
            Scheme::Staggered => Step::of(self.convection),
            Scheme::Collocated => Step::Euler,
        };
        let spacing = 1.0 / self.cells as f64;
        step.largest(self.convection, self.viscosity(), [spacing; 2], [self.lid.abs(), 0.0])
    }

    /// m2/s.
    fn viscosity(&self) -> f64 {
        self.lid.abs() / self.reynolds
    }

    /// Starts at rest and takes so many steps of `dt` s; `tick` is called after each.
    ///
    /// # Errors
    ///
    /// What [`Staggered`] or [`Collocated`] refuse; a step that is too long before the first.
    pub fn run(&self, dt: f64, steps: u64, mut tick: impl FnMut()) -> Result<Circulation, FlowError> {
        let domain = Domain { size: [1.0, 1.0], cells: [self.cells; 2] };
        let (sides, viscosity) = (Sides::cavity(self.lid), self.viscosity());
        let mut turn = |flow: &mut dyn Flow| -> Result<(), FlowError> {
            for _ in 0..steps {
                flow.step(dt)?;
                tick();
            }
            Ok(())
        };
        match self.scheme {
            Scheme::Staggered => {
                let mut flow = Staggered::new(domain, sides, viscosity, self.convection)?;
                turn(&mut flow)?;
                let heights = |k: usize| (k as f64 + 0.5) / self.cells as f64;
                let ends = (flow.kinetic_energy(), flow.divergence());
                Ok(self.lines(&flow, heights, self.cells, ends, steps))
            }
            Scheme::Collocated => {
                let (wall, forcing) = (WallPressure::Linear, Forcing::InsideStep);
                let mut flow = Collocated::new(domain, sides, viscosity, self.convection, wall, forcing)?;
                turn(&mut flow)?;
                let heights = |k: usize| (k + 1) as f64 / self.cells as f64;
                let ends = (flow.kinetic_energy(), flow.divergence());
                Ok(self.lines(&flow, heights, self.cells - 1, ends, steps))
            }
        }
    }

    fn lines(
        &self,
        flow: &dyn Flow,
        height: impl Fn(usize) -> f64,
        count: usize,
        (kinetic_energy, divergence): (f64, f64),
        steps: u64,
    ) -> Circulation {
        let at = |place: [f64; 2], axis: usize| flow.velocity(place).map_or(f64::NAN, |v| v[axis]);
        let line = |ends: f64, value: &dyn Fn(f64) -> f64| {
            let inner = (0..count).map(|k| (height(k), value(height(k))));
            std::iter::once((0.0, 0.0)).chain(inner).chain([(1.0, ends)]).collect()
        };
        Circulation {
            u: line(self.lid, &|y| at([0.0, y], 0)),
            v: line(0.0, &|x| at([x - 0.5, 0.5], 1)),
            kinetic_energy,
            divergence,
            steps,
        }
    }
}
