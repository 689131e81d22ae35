//! Tree and wind act on each other (§5).

use super::readings::{Exchange, SharedSymbol};
use super::{Linearised, Tree, TreeError, Vector};
use crate::navier_stokes::{Collocated, Domain, Flow, Lattice, Scheme, Sides, Staggered};

/// The air around the tree; the root is in the middle of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Width and height of the air, m.
    pub size: [f64; 2],
    /// Cells along x and y.
    pub cells: [usize; 2],
    /// Kinematic viscosity of the air, m2/s.
    pub viscosity: f64,
    /// Speed of the wind that comes in, m/s; from the right where it is negative.
    pub wind: f64,
    /// The time step, s.
    pub dt: f64,
}

/// How often nodes were inside of the air and outside, over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counted {
    /// Nodes that felt the wind.
    pub inside: u64,
    /// Nodes outside of the box of air, which no wind reaches and which do nothing to it.
    pub outside: u64,
}

/// A tree in a wind that is computed.
pub struct Sway {
    tree: Tree,
    flow: Box<dyn Flow + Send>,
    setting: Setting,
    counted: Counted,
    steps: u64,
    // Of the last step: what the wind does to the tree and the tree to the wind, N, and the wind at each node.
    forces: Vec<Vector>,
    on_air: Vector,
    felt: Vec<Option<[f64; 2]>>,
}

impl Sway {
    /// A tree at rest in a wind that is the same everywhere but on the ground.
    ///
    /// # Errors
    ///
    /// What the wind refuses, and a step that is too long for the tree or for the wind.
    pub fn new(tree: Tree, setting: Setting) -> Result<Self, TreeError> {
        let readings = *tree.readings();
        let most = Linearised::new(tree.skeleton(), *tree.parameters(), readings)?.largest_step();
        if !(setting.dt > 0.0 && setting.dt <= most) {
            return Err(TreeError::Unstable { dt: setting.dt, most });
        }
        let domain = Domain { size: setting.size, cells: setting.cells };
        let (sides, start) = (Sides::wind(setting.wind), [setting.wind, 0.0]);
        let flow: Box<dyn Flow + Send> = match readings.scheme {
            Scheme::Staggered => {
                let mut flow = Staggered::new(domain, sides, setting.viscosity, readings.convection)?;
                flow.fill(|_| start);
                Box::new(flow)
            }
            Scheme::Collocated => {
                let mut flow = Collocated::new(
                    domain,
                    sides,
                    setting.viscosity,
                    readings.convection,
                    readings.wall_pressure,
                    readings.forcing,
                )?;
                flow.fill(|_| start);
                Box::new(flow)
            }
        };
        // A step that the wind refuses is refused now.
        flow.check(setting.dt)?;
        let nodes = tree.skeleton().nodes();
        Ok(Self {
            tree,
            flow,
            setting,
            counted: Counted::default(),
            steps: 0,
            forces: vec![Vector::zeros(); nodes],
            on_air: Vector::zeros(),
            felt: vec![None; nodes],
        })
    }

    /// One step of both, from their states at the same time.
    ///
    /// # Errors
    ///
    /// A wind that breaks down.
    pub fn step(&mut self) -> Result<(), TreeError> {
        self.flow.release();
        self.on_air = Vector::zeros();
        let readings = *self.tree.readings();
        for node in 1..self.forces.len() {
            let place = self.tree.place(node);
            let place = [place.x, place.y];
            self.felt[node] = self.flow.velocity(place);
            let Some(air) = self.felt[node] else {
                self.counted.outside += 1;
                self.forces[node] = Vector::zeros();
                continue;
            };
            self.counted.inside += 1;
            let air = Vector::new(air[0], air[1]);
            let force = self.tree.wind_force(node, air);
            self.forces[node] = force;
            let given = self.tree.parameters();
            let back = match readings.exchange {
                Exchange::Speed => -given.branch_on_wind * self.as_felt(air),
                Exchange::Force => -given.branch_on_wind * force,
                Exchange::Consistent => -force / (given.air_density * given.depth * self.cell()),
                Exchange::OneWay => Vector::zeros(),
            };
            if self.flow.push(place, [back.x, back.y]) {
                self.on_air += back * (given.air_density * given.depth * self.cell());
            }
        }
        self.flow.step(self.setting.dt)?;
        self.tree.step(self.setting.dt, &self.forces);
        self.steps += 1;
        Ok(())
    }

    /// Area of a cell of air, m2.
    fn cell(&self) -> f64 {
        let [dx, dy] = self.flow.nodes().spacing;
        dx * dy
    }

    /// The wind at a node, less what the one-number reading takes from it.
    fn as_felt(&self, air: Vector) -> Vector {
        match self.tree.readings().shared_symbol {
            SharedSymbol::TwoNumbers => air,
            SharedSymbol::OneNumber => self.tree.parameters().damping * air,
        }
    }

    /// The tree.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The tree, to set it moving.
    pub fn tree_mut(&mut self) -> &mut Tree {
        &mut self.tree
    }

    /// The wind's velocity at a place, m/s; none outside of the air.
    pub fn air(&self, place: [f64; 2]) -> Option<[f64; 2]> {
        self.flow.velocity(place)
    }

    /// The grid of the air.
    pub fn grid(&self) -> Lattice {
        self.flow.nodes()
    }

    /// The largest divergence of the air, 1/s.
    pub fn divergence(&self) -> f64 {
        self.flow.divergence()
    }

    /// What blows in from here on, m/s, from the same side.
    pub fn set_wind(&mut self, speed: f64) {
        self.flow.set_inflow(speed);
    }

    /// Time since the start, s.
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.setting.dt
    }

    /// How often nodes were inside and outside.
    pub fn counted(&self) -> Counted {
        self.counted
    }

    /// The wind that each node felt in the last step, m/s; none for the root and outside.
    pub fn felt(&self) -> &[Option<[f64; 2]>] {
        &self.felt
    }

    /// The force of the last step on the whole tree, and that on the air, N for each [`depth`](super::Parameters::depth).
    pub fn exchanged(&self) -> (Vector, Vector) {
        (self.forces.iter().fold(Vector::zeros(), |sum, force| sum + force), self.on_air)
    }
}
