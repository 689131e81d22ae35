//! Amano, Sato, Itoh: "スケッチ入力を用いた氷・霜アニメーション生成のための初期値最適化による成長速度制御"; and Reiter 2005
//! (*A local cellular model for snow crystal growth*, Chaos, Solitons & Fractals 23, 1111-1119), on which it builds.
//!
//! Frost spreads over a sketch from the starts that the user marks. The initial vapour decides how fast, and is what
//! the paper optimises so that the film ends in a chosen frame.
//!
//! | symbol | name here | meaning | unit |
//! |---|---|---|---|
//! | u_t(p) | [`Frost::u`] | vapour or ice in cell p, ice from 1 on | - |
//! | alpha | [`Parameters::alpha`] | weight of diffusion | per step |
//! | beta | [`Parameters::beta`] | u_0, the same in all cells | - |
//! | gamma | [`Parameters::gamma`] | what a receptive cell gains | per step |
//! | r_t(p) | stream `r_t`, [`Redraw`] | random number of a neighbour of ice | - |
//! | r_th | [`Parameters::threshold`] | at or below it r stops the gain | - |
//! | D_t(p) | [`Inflow`] | diffusion, Eq. (1) | per step |
//! | nn(p) | [`Axial::neighbours`] | the six cells around p | - |
//! | T_sim(beta) | [`end_frame`] | first frame with enough ice (§3.4) | frames |
//!
//! §3.2 is [`Frost`], in its plain form ([`Frost::plain`]) and its fast one; §3.3 is [`Edge`]; §3.4 is [`Film`]. The
//! descent of Eq. (2) and (3) is a method of its own and not here. Beyond the page is what its outlook (§5) plans: vapour
//! that differs by direction ([`Frost::with_vapour`], [`Sectors`]), so that ice is everywhere at the border in one frame
//! ([`SectorObjective`]).

mod aim;
mod arrivals;
mod diagram;
mod end;
mod fast;
mod gate;
mod kernel;
pub mod measure;
mod objective;
mod painter;
pub mod pane;
mod parameters;
mod readings;
mod reference;
mod sectors;
mod standstill;
mod tally;
#[cfg(test)]
mod tests;

pub use aim::{Aim, Aimed, Rule, Search};
pub use arrivals::{Arrival, Directions, Misses, SectorObjective, arrivals};
pub use diagram::algorithm;
pub use end::{EndFrame, EndOf, EndRule, Ending, Film, end_frame, end_frames, growth};
pub use objective::{EndFrameObjective, TSim};
pub use painter::{GROUND, Painter, titled};
pub use parameters::{FrostError, Parameters};
pub use readings::{Edge, Inflow, Redraw, RingTouchingIce, UnknownName};
pub use reference::{Addends, State};
pub use sectors::Sectors;

use crate::hexgrid::{Axial, Region};
use crate::rng::Seed;
use fast::Fast;
use gate::Gate;
use reference::Plain;

/// The step at which a cell became ice, while it has not.
const NEVER: u64 = u64::MAX;

/// Frost on a region, at one moment (§3.2).
#[derive(Clone, Debug)]
pub struct Frost {
    region: Region,
    parameters: Parameters,
    gate: Gate,
    form: Form,
    steps: u64,
    frozen: Vec<u64>,
    ice: usize,
    fresh: Vec<u32>,
}

#[derive(Clone, Debug)]
enum Form {
    Plain(Plain),
    Fast(Fast),
}

impl Frost {
    /// Step 0: u is beta everywhere but in the starts, where it is 1. Takes the fast form where the reading has one.
    ///
    /// # Errors
    ///
    /// Numbers that [`Parameters::check`] refuses, and a start outside the region.
    pub fn new(
        region: &Region,
        starts: &[Axial],
        parameters: Parameters,
        seed: Seed,
    ) -> Result<Self, FrostError> {
        Self::begin(region, starts, parameters, seed, None, Fast::covers(parameters.inflow))
    }

    /// The same with vapour of its own in each cell, by ordinal, 0 to [`Parameters::MOST_VAPOUR`]: what the paper's
    /// outlook (§5) needs. [`Parameters::beta`] is then what [`Edge::Held`] holds, and nothing else.
    ///
    /// # Errors
    ///
    /// As [`new`](Frost::new); and not one number for each cell, and the first cell whose vapour is not handled.
    pub fn with_vapour(
        region: &Region,
        starts: &[Axial],
        parameters: Parameters,
        seed: Seed,
        vapour: &[f64],
    ) -> Result<Self, FrostError> {
        Self::begin(region, starts, parameters, seed, Some(vapour), Fast::covers(parameters.inflow))
    }

    /// The same, stepped by the plain form: same bits, slower.
    ///
    /// # Errors
    ///
    /// As [`new`](Frost::new).
    pub fn plain(
        region: &Region,
        starts: &[Axial],
        parameters: Parameters,
        seed: Seed,
    ) -> Result<Self, FrostError> {
        Self::begin(region, starts, parameters, seed, None, false)
    }

    fn begin(
        region: &Region,
        starts: &[Axial],
        given: Parameters,
        seed: Seed,
        vapour: Option<&[f64]>,
        fast: bool,
    ) -> Result<Self, FrostError> {
        given.check()?;
        // The fast form keeps a flag in the sign of u: no zero may be negative.
        let parameters = Parameters {
            alpha: given.alpha + 0.0,
            beta: given.beta + 0.0,
            gamma: given.gamma + 0.0,
            ..given
        };
        let mut u = match vapour {
            Some(vapour) => checked(region, vapour)?,
            None => vec![parameters.beta; region.len()],
        };
        for start in starts {
            let ordinal = region.ordinal(*start).ok_or(FrostError::StartOutside(start.q, start.r))?;
            u[ordinal] = 1.0;
        }
        let form = match fast {
            true => Form::Fast(Fast::new(region, &parameters, &u)),
            false => Form::Plain(Plain::new(region, &parameters, &u)),
        };
        let frozen: Vec<u64> = u.iter().map(|&u| if u >= 1.0 { 0 } else { NEVER }).collect();
        let ice = frozen.iter().filter(|&&step| step == 0).count();
        let gate = Gate::new(&parameters, seed);
        Ok(Self { region: region.clone(), parameters, gate, form, steps: 0, frozen, ice, fresh: Vec::new() })
    }

    /// One step of the solver, all cells at once: Eq. (1) and the text around it.
    pub fn step(&mut self) {
        self.gate.turn(self.steps);
        self.steps += 1;
        match &mut self.form {
            Form::Plain(plain) => {
                plain.step_reference(&self.parameters, &self.gate, &self.region, &mut self.fresh);
            }
            Form::Fast(fast) => {
                fast.step(&self.parameters, &self.gate, &mut self.fresh);
                fast.freeze(&self.fresh, &self.region);
            }
        }
        self.ice += self.fresh.len();
        for ordinal in self.fresh.drain(..) {
            self.frozen[ordinal as usize] = self.steps;
        }
    }

    /// One frame of the film: [`Parameters::steps_per_frame`] steps.
    pub fn frame(&mut self) {
        for _ in 0..self.parameters.steps_per_frame {
            self.step();
        }
    }

    /// The region.
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// The numbers and readings it runs with.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Number of cells that are ice.
    pub fn ice(&self) -> usize {
        self.ice
    }

    /// Whether the cell of this ordinal is ice.
    pub fn is_ice(&self, ordinal: usize) -> bool {
        self.frozen[ordinal] != NEVER
    }

    /// The cells that are ice, in page order.
    pub fn ice_cells(&self) -> Vec<Axial> {
        let cells = self.region.cells().iter().enumerate();
        cells.filter(|(ordinal, _)| self.is_ice(*ordinal)).map(|(_, cell)| *cell).collect()
    }

    /// u_t(p) of the cell of this ordinal.
    pub fn u(&self, ordinal: usize) -> f64 {
        match &self.form {
            Form::Plain(plain) => plain.u(ordinal),
            Form::Fast(fast) => fast.u(ordinal),
        }
    }

    /// u_t of all cells, by ordinal.
    pub fn field(&self) -> Vec<f64> {
        (0..self.region.len()).map(|ordinal| self.u(ordinal)).collect()
    }

    /// Whether the cell of this ordinal is ice, touches ice, or neither.
    pub fn state(&self, ordinal: usize) -> State {
        match &self.form {
            Form::Plain(plain) => plain.state(ordinal),
            Form::Fast(fast) => fast.state(ordinal),
        }
    }

    /// The two fields that the next step adds up (Fig. 2).
    pub fn addends(&self) -> Addends {
        let mut gate = self.gate.clone();
        gate.turn(self.steps);
        let plain = Plain::new(&self.region, &self.parameters, &self.field());
        plain.addends(&self.parameters, &gate, &self.region)
    }

    /// Whether the r at hand lets gamma through to the cell of this ordinal.
    fn draws_above(&self, ordinal: usize) -> bool {
        let mut gate = self.gate.clone();
        gate.turn(self.steps);
        let mut r = [0.0];
        if let Some((_, moment)) = gate.now() {
            let at = self.region.cells()[ordinal];
            moment.fill_row(at.r, at.q, &mut r);
        }
        r[0] > self.parameters.threshold
    }

    /// Steps taken.
    pub fn step_count(&self) -> u64 {
        self.steps
    }

    /// Cells times steps: the work done, in units that no machine changes.
    pub fn updates(&self) -> u64 {
        self.region.len() as u64 * self.steps
    }

    /// The number of the step that made this cell ice, if one did; 0 for what was ice at first.
    pub fn frozen_at_step(&self, ordinal: usize) -> Option<u64> {
        Some(self.frozen[ordinal]).filter(|&step| step != NEVER)
    }

    /// The first frame that shows this cell as ice, if one does; 0 for what was ice at first.
    pub fn frozen_in_frame(&self, ordinal: usize) -> Option<u64> {
        let steps_per_frame = u64::from(self.parameters.steps_per_frame);
        self.frozen_at_step(ordinal).map(|step| step.div_ceil(steps_per_frame))
    }
}

/// Vapour that can be run with, by ordinal; no zero is negative.
fn checked(region: &Region, vapour: &[f64]) -> Result<Vec<f64>, FrostError> {
    let (given, needed) = (vapour.len(), region.len());
    if given != needed {
        return Err(FrostError::Count { given, needed, each: "cell" });
    }
    let of_cell = |(cell, &value): (&Axial, &f64)| match (0.0..=Parameters::MOST_VAPOUR).contains(&value) {
        true => Ok(value + 0.0),
        false => Err(FrostError::Vapour { q: cell.q, r: cell.r, value }),
    };
    region.cells().iter().zip(vapour).map(of_cell).collect()
}
