//! The plain form: one step as the page has it, for every reading.
//!
//! It is what the fast form must equal bit for bit, and what it is measured against.

use super::gate::Gate;
use super::parameters::Parameters;
use super::readings::{Edge, Inflow, RingTouchingIce};
use crate::hexgrid::Region;

/// The three states of a cell (§3.2, Fig. 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum State {
    /// u is 1 or more, or was.
    Ice,
    /// Touches ice. Ice and its neighbours are receptive.
    Neighbour,
    /// Neither: vapour only.
    Other,
}

/// The two fields whose sum is the u of the next step (§3.2, Fig. 2), by ordinal.
#[derive(Clone, Debug, PartialEq)]
pub struct Addends {
    /// What receptive cells keep and gain, `u + gamma`; 0 elsewhere.
    pub receptive: Vec<f64>,
    /// What diffuses: `v (1 - alpha/2) + alpha/12 sum v`.
    pub diffusing: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Outside,
    Ring,
    Cell,
}

/// The lattice as a rectangle of rows, one margin wide all around.
#[derive(Clone, Debug)]
pub(super) struct Plain {
    width: usize,
    place: Vec<Place>,
    cells: Vec<usize>,
    ring: Vec<usize>,
    state: Vec<State>,
    u: Vec<f64>,
    next: Vec<f64>,
    drawn: Option<u64>,
    r: Vec<f64>,
}

impl Plain {
    /// The lattice with these values of u, by ordinal.
    pub(super) fn new(region: &Region, parameters: &Parameters, u: &[f64]) -> Self {
        let bounds = region.bounds();
        let width = bounds.columns() + 2;
        let size = width * (bounds.rows() + 2);
        let index = |at: &crate::hexgrid::Axial| {
            (at.r - bounds.least.r + 1) as usize * width + (at.q - bounds.least.q + 1) as usize
        };
        let mut plain = Self {
            width,
            place: vec![Place::Outside; size],
            cells: region.cells().iter().map(index).collect(),
            ring: region.ring().iter().map(index).collect(),
            state: vec![State::Other; size],
            u: vec![0.0; size],
            next: vec![0.0; size],
            drawn: None,
            r: vec![0.0; size],
        };
        for &i in &plain.ring {
            plain.place[i] = Place::Ring;
        }
        for (&i, &u) in plain.cells.iter().zip(u) {
            plain.place[i] = Place::Cell;
            plain.u[i] = u;
        }
        plain.classify(&mut Vec::new());
        plain.surround(parameters);
        plain
    }

    pub(super) fn u(&self, ordinal: usize) -> f64 {
        self.u[self.cells[ordinal]]
    }

    pub(super) fn state(&self, ordinal: usize) -> State {
        self.state[self.cells[ordinal]]
    }

    /// One step of the solver, all cells at once. `fresh` is left with the ordinals of the new ice.
    pub(super) fn step_reference(
        &mut self,
        parameters: &Parameters,
        gate: &Gate,
        region: &Region,
        fresh: &mut Vec<u32>,
    ) {
        self.draw(gate, region);
        for row in 1..self.u.len() / self.width - 1 {
            for column in 1..self.width - 1 {
                let p = row * self.width + column;
                if self.place[p] == Place::Cell {
                    let (receptive, diffusing) = self.addends_at(p, parameters);
                    self.next[p] = receptive + diffusing;
                }
            }
        }
        std::mem::swap(&mut self.u, &mut self.next);
        self.classify(fresh);
        self.surround(parameters);
    }

    /// Figure 2: what the next step adds up, without taking it.
    pub(super) fn addends(mut self, parameters: &Parameters, gate: &Gate, region: &Region) -> Addends {
        self.draw(gate, region);
        let (receptive, diffusing) = self.cells.iter().map(|&p| self.addends_at(p, parameters)).unzip();
        Addends { receptive, diffusing }
    }

    /// The two addends of `u_{t+1}(p)`: Eq. (1) and the text of §3.2.
    fn addends_at(&self, p: usize, parameters: &Parameters) -> (f64, f64) {
        use Inflow::{AsPrinted, OnlyIceHidden, PassiveDiffuses, PassiveIsVapour, ReiterGated};
        let Parameters { alpha, gamma, threshold, inflow, .. } = *parameters;
        let u = self.u[p];
        let sum_u = || self.sum(p, |q| self.u[q]);
        let sum_v = || self.sum(p, |q| self.shown(q, inflow));
        let state = self.state[p];
        let passive = state == State::Neighbour && threshold > 0.0 && self.r[p] <= threshold;

        match (inflow, state) {
            (AsPrinted, State::Neighbour) if passive => (u, alpha / 12.0 * (-6.0 * u + sum_u())),
            (AsPrinted, State::Ice | State::Neighbour) => (u + gamma, 0.0),
            (PassiveIsVapour, _) if passive => (0.0, u * (1.0 - alpha / 2.0) + alpha / 12.0 * sum_v()),
            (PassiveDiffuses, _) if passive => (0.0, u * (1.0 - alpha / 2.0) + alpha / 12.0 * sum_u()),
            (ReiterGated | OnlyIceHidden, _) if passive => (u, alpha / 12.0 * sum_v()),
            (_, State::Ice | State::Neighbour) => (u + gamma, alpha / 12.0 * sum_v()),
            (_, State::Other) => (0.0, u * (1.0 - alpha / 2.0) + alpha / 12.0 * sum_v()),
        }
    }

    /// v: what a point shows to its neighbours.
    fn shown(&self, p: usize, inflow: Inflow) -> f64 {
        let hidden = match (self.place[p], inflow) {
            (Place::Cell, Inflow::OnlyIceHidden) => self.state[p] == State::Ice,
            (Place::Cell, _) => self.state[p] != State::Other,
            (Place::Ring | Place::Outside, _) => false, // the ring holds what it shows
        };
        if hidden { 0.0 } else { self.u[p] }
    }

    /// The sum over the six neighbours, opposite pairs first. The order is part of the result.
    fn sum(&self, p: usize, of: impl Fn(usize) -> f64) -> f64 {
        let across = of(p + 1) + of(p - 1);
        let falling = of(p + self.width) + of(p - self.width);
        let rising = of(p + self.width - 1) + of(p - self.width + 1);
        (across + falling) + rising
    }

    /// The six neighbours, in the order of [`STEPS`](crate::hexgrid::STEPS).
    fn around(&self, p: usize) -> [usize; 6] {
        [p + 1, p + self.width, p + self.width - 1, p - 1, p - self.width, p - self.width + 1]
    }

    /// New ice, and the neighbours of new ice.
    fn classify(&mut self, fresh: &mut Vec<u32>) {
        for cell in 0..self.cells.len() {
            let p = self.cells[cell];
            if self.u[p] >= 1.0 && self.state[p] != State::Ice {
                self.state[p] = State::Ice;
                fresh.push(cell as u32);
                for q in self.around(p) {
                    if self.state[q] == State::Other {
                        self.state[q] = State::Neighbour;
                    }
                }
            }
        }
    }

    /// The points around the region (§3.3).
    fn surround(&mut self, parameters: &Parameters) {
        for &p in &self.ring {
            let inside = |q: &usize| self.place[*q] == Place::Cell;
            let u = match (parameters.edge, parameters.ring_touching_ice) {
                (Edge::Held, _) => parameters.beta,
                (Edge::Reflecting, RingTouchingIce::Zero) if self.state[p] == State::Neighbour => 0.0,
                (Edge::Reflecting, _) => {
                    let (sum, count) = self
                        .around_ring(p)
                        .filter(inside)
                        .fold((0.0, 0.0), |(sum, count), q| (sum + self.u[q], count + 1.0));
                    sum / count
                }
            };
            self.u[p] = u;
        }
    }

    /// The neighbours of a point of the ring, as far as the rectangle goes.
    fn around_ring(&self, p: usize) -> impl Iterator<Item = usize> {
        let (p, width) = (p as isize, self.width as isize);
        let size = self.u.len() as isize;
        [p + 1, p + width, p + width - 1, p - 1, p - width, p - width + 1]
            .into_iter()
            .filter(move |q| (0..size).contains(q))
            .map(|q| q as usize)
    }

    /// `r_t(p)`, in all cells.
    fn draw(&mut self, gate: &Gate, region: &Region) {
        let Some((time, moment)) = gate.now() else { return };
        if self.drawn == Some(time) {
            return;
        }
        self.drawn = Some(time);
        let least = region.bounds().least;
        for (row, r) in self.r.chunks_exact_mut(self.width).enumerate().skip(1) {
            moment.fill_row(least.r - 1 + row as i32, least.q, &mut r[1..self.width - 1]);
        }
    }
}
