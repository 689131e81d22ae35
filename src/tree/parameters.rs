//! The numbers of a run, and what is wrong with them.

use crate::navier_stokes::FlowError;

/// The numbers of the model; none has a default. [`Parameters::PRINTED`] are those of §6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// delta, density of wood, kg/m3.
    pub density: f64,
    /// K_r, the restoring coefficient, N/m2.
    pub restoring: f64,
    /// K_w, the wind coefficient, kg/(m2 s).
    pub wind: f64,
    /// K_b, what the wind loses at a node.
    pub branch_on_wind: f64,
    /// K_d of Eq. (9), what is left of a velocity after a step.
    pub damping: f64,
    /// K_d of Eq. (6), what of the restoring force acts back on the parent.
    pub reaction: f64,
    /// Gravity, m/s2.
    pub gravity: f64,
    /// The step that `damping` belongs to where it is read as a rate, s.
    pub damping_step: f64,
    /// Density of air, kg/m3: quadratic drag and consistent exchange.
    pub air_density: f64,
    /// Depth of the slab of air that a planar wind stands for, m: consistent exchange.
    pub depth: f64,
    /// Drag coefficient of a cylinder: quadratic drag.
    pub drag: f64,
}

impl Parameters {
    /// §6, with what the paper leaves out: standard gravity, air at 15 degrees, a step of a thirtieth of a second for
    /// the damping, a metre of depth, and the drag of a cylinder.
    pub const PRINTED: Self = Self {
        density: 230.0,
        restoring: 10_000.0,
        wind: 0.08,
        branch_on_wind: 0.1,
        damping: 0.83,
        reaction: 0.8,
        gravity: 9.80665,
        damping_step: 1.0 / 30.0,
        air_density: 1.225,
        depth: 1.0,
        drag: 1.2,
    };

    /// Whether the numbers can be run with.
    ///
    /// # Errors
    ///
    /// The first, in the order of the fields, that cannot.
    pub fn check(&self) -> Result<(), TreeError> {
        for (name, value, least, most) in [
            ("density", self.density, 1e-3, 1e5),
            ("restoring", self.restoring, 0.0, 1e12),
            ("wind coefficient", self.wind, 0.0, 1e6),
            ("branch-on-wind", self.branch_on_wind, 0.0, 1e3),
            ("damping", self.damping, 0.0, 1.0),
            ("reaction", self.reaction, 0.0, 10.0),
            ("gravity", self.gravity, 0.0, 1e3),
            ("damping step", self.damping_step, 1e-6, 1e3),
            ("air density", self.air_density, 1e-6, 1e5),
            ("depth", self.depth, 1e-6, 1e6),
            ("drag", self.drag, 0.0, 1e3),
        ] {
            if !(least..=most).contains(&value) {
                return Err(TreeError::OutOfRange { name, value, least, most });
            }
        }
        Ok(())
    }
}

/// Why there is no sway.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TreeError {
    /// A number is outside what is handled, or none at all.
    #[error("{name} is {value}; {least} to {most} is accepted")]
    OutOfRange {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least.
        least: f64,
        /// The most.
        most: f64,
    },
    /// The tree is no tree in a plane.
    #[error("{0}")]
    Shape(&'static str),
    /// The time step breaks the tree's own bound.
    #[error("a time step of {dt} s is unstable: the stiffest mode of the tree allows at most {most} s")]
    Unstable {
        /// What was asked for, s.
        dt: f64,
        /// The largest stable step, s.
        most: f64,
    },
    /// The wind cannot be computed.
    #[error("the wind: {0}")]
    Wind(#[from] FlowError),
}
