//! The paper's own form (§4.2): velocity and pressure in the nodes, "which errs in mass more easily", forward in time.
//!
//! A step is Eq. (17); its pressure is that of Eq. (18), whose right side is the divergence of the step without
//! pressure, over dt. The five-point difference of the pressure is not the divergence of its gradient, so some
//! divergence is left: [`Collocated::divergence`] says how much.

use super::bound::Bound;
use super::domain::check;
use super::{Convection, Domain, Flow, FlowError, Lattice, Poisson, Side, Sides, Step};
use crate::reading::Reading;

/// What the pressure on a wall is, Eq. (15).
///
/// Transcribed: `phi_0 = phi_1 - 2 nu v_1^2 / dy`. Its units do not fit; Eq. (14), differenced with the outside
/// velocity that the page names, has v where it has v^2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WallPressure {
    /// `2 nu v_1^2 / dy`, as it stands.
    AsPrinted,
    /// `2 nu v_1 / dy`.
    Linear,
}

impl Reading for WallPressure {
    const QUANTITY: &'static str = "wall-pressure";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::Linear];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::Linear => "linear",
        }
    }
}

/// Where f stands in Eq. (17).
///
/// Transcribed: `v' = v + dt (-(v . grad) v - grad phi + nu laplace v) + f`, while Eq. (18) has div f without 1 / dt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Forcing {
    /// Outside of the bracket, as it stands: f is a change of velocity.
    AsPrinted,
    /// Inside, times dt, as Eq. (13) and (18) have it.
    InsideStep,
}

impl Reading for Forcing {
    const QUANTITY: &'static str = "forcing";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::InsideStep];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::InsideStep => "inside-step",
        }
    }
}

/// Steps between two looks at whether the flow is still sound.
const LOOK: u64 = 64;

/// A flow whose unknowns all live in the nodes.
#[derive(Clone, Debug)]
pub struct Collocated {
    domain: Domain,
    sides: Sides,
    viscosity: f64,
    convection: Convection,
    wall_pressure: WallPressure,
    forcing: Forcing,
    at: Lattice,
    // (u, v) in each node, row by row; the same without pressure; what pushes.
    now: Vec<[f64; 2]>,
    next: Vec<[f64; 2]>,
    force: [Vec<f64>; 2],
    phi: Vec<f64>,
    inside: Vec<f64>,
    poisson: Poisson,
    bound: Bound,
    defect: f64,
    steps: u64,
    time: f64,
}

impl Collocated {
    /// Air at rest between these sides.
    ///
    /// # Errors
    ///
    /// [`FlowError::OutOfRange`] for sizes, speeds or a viscosity that are not handled.
    pub fn new(
        domain: Domain,
        sides: Sides,
        viscosity: f64,
        convection: Convection,
        wall_pressure: WallPressure,
        forcing: Forcing,
    ) -> Result<Self, FlowError> {
        check(&domain, &sides, viscosity)?;
        let [nx, ny] = domain.cells;
        let spacing = domain.spacing();
        let at = Lattice { counts: [nx + 1, ny + 1], spacing, bottom: 0.0 };
        let nodes = (nx + 1) * (ny + 1);
        let mut flow = Self {
            domain,
            sides,
            viscosity,
            convection,
            wall_pressure,
            forcing,
            at,
            now: vec![[0.0; 2]; nodes],
            next: vec![[0.0; 2]; nodes],
            force: [vec![0.0; nodes], vec![0.0; nodes]],
            phi: vec![0.0; nodes],
            inside: vec![0.0; (nx - 1) * (ny - 1)],
            poisson: Poisson::new(nx - 1, ny - 1, spacing[0], spacing[1]),
            bound: Bound::new(Step::Euler, convection, viscosity, spacing, &sides),
            defect: 0.0,
            steps: 0,
            time: 0.0,
        };
        flow.bound();
        std::mem::swap(&mut flow.now, &mut flow.next);
        Ok(flow)
    }

    /// Sets the velocity everywhere, m/s, but on the sides, which stay as they are.
    pub fn fill(&mut self, velocity: impl Fn([f64; 2]) -> [f64; 2]) {
        for (c, value) in self.next.iter_mut().enumerate() {
            *value = velocity(self.at.place([c % self.at.counts[0], c / self.at.counts[0]]));
        }
        self.bound();
        std::mem::swap(&mut self.now, &mut self.next);
    }

    /// The largest time step that is let pass, s.
    pub fn largest_step(&self) -> f64 {
        self.bound.most()
    }

    /// Time since the start, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Velocity in the nodes, m/s, row by row.
    pub fn field(&self) -> &[[f64; 2]] {
        &self.now
    }

    /// Pressure over density in the nodes, m2/s2, of the last step.
    pub fn pressure(&self) -> &[f64] {
        &self.phi
    }

    /// By how much the right side of Eq. (18) missed in the last step that it has an answer: its mean, 1/s2.
    pub fn defect(&self) -> f64 {
        self.defect
    }

    /// The largest divergence of an inner node, 1/s.
    pub fn divergence(&self) -> f64 {
        self.inner().fold(0.0, |most, c| f64::max(most, self.div(&self.now, c).abs()))
    }

    /// Kinetic energy over density and depth, m4/s2; a node on a side has half a cell, in a corner a quarter.
    pub fn kinetic_energy(&self) -> f64 {
        let [nx, ny] = self.domain.cells;
        let [dx, dy] = self.domain.spacing();
        let part = |i: usize, n: usize| if i == 0 || i == n { 0.5 } else { 1.0 };
        let of = |(c, [u, v]): (usize, &[f64; 2])| {
            part(c % (nx + 1), nx) * part(c / (nx + 1), ny) * (u * u + v * v)
        };
        0.5 * dx * dy * self.now.iter().enumerate().map(of).sum::<f64>()
    }

    /// Indices of the inner nodes, row by row.
    fn inner(&self) -> impl Iterator<Item = usize> + use<> {
        let [nx, ny] = self.domain.cells;
        (1..ny).flat_map(move |j| (1..nx).map(move |i| j * (nx + 1) + i))
    }

    /// Divergence of a field in an inner node by centred differences, 1/s.
    fn div(&self, field: &[[f64; 2]], c: usize) -> f64 {
        let ([dx, dy], row) = (self.at.spacing, self.at.counts[0]);
        (field[c + 1][0] - field[c - 1][0]) / (2.0 * dx)
            + (field[c + row][1] - field[c - row][1]) / (2.0 * dy)
    }

    /// `-(v . grad) v + nu laplace v` in an inner node, m/s2.
    fn acceleration(&self, c: usize) -> [f64; 2] {
        let ([dx, dy], row) = (self.at.spacing, self.at.counts[0]);
        let [u, v] = self.now[c];
        std::array::from_fn(|axis| {
            let q = |c: usize| self.now[c][axis];
            let (here, west, east, south, north) = (q(c), q(c - 1), q(c + 1), q(c - row), q(c + row));
            let carried = match self.convection {
                Convection::Central => u * (east - west) / (2.0 * dx) + v * (north - south) / (2.0 * dy),
                Convection::Upwind => {
                    let x = if u > 0.0 { here - west } else { east - here };
                    let y = if v > 0.0 { here - south } else { north - here };
                    u * x / dx + v * y / dy
                }
            };
            let spread =
                ((east + west) - 2.0 * here) / (dx * dx) + ((north + south) - 2.0 * here) / (dy * dy);
            self.viscosity * spread - carried
        })
    }

    /// By how much the pressure on a wall is below that next to it, Eq. (15): `v_1` is the speed away from the wall.
    fn drop(&self, side: Side, v_1: f64, spacing: f64) -> f64 {
        match (side, self.wall_pressure) {
            (Side::Wall(_), WallPressure::AsPrinted) => 2.0 * self.viscosity * v_1 * v_1 / spacing,
            (Side::Wall(_), WallPressure::Linear) => 2.0 * self.viscosity * v_1 / spacing,
            // Eq. (16), and outflow as next to it.
            _ => 0.0,
        }
    }

    /// The pressure of Eq. (18) in all nodes but the corners; `next` holds the step without it.
    fn solve_pressure(&mut self, dt: f64) {
        let [nx, ny] = self.domain.cells;
        let [dx, dy] = self.at.spacing;
        let row = nx + 1;
        let Sides { left, right, bottom, top } = self.sides;
        let mut inside = std::mem::take(&mut self.inside);
        for (value, c) in inside.iter_mut().zip(self.inner()) {
            *value = self.div(&self.next, c) / dt;
        }
        // What a side takes from the pressure next to it goes to the right side.
        let drops = |first: usize, last: usize| {
            let (low_x, high_x) =
                (self.drop(left, self.now[first][0], dx), self.drop(right, -self.now[last][0], dx));
            [low_x, high_x]
        };
        let of_row: Vec<[f64; 2]> = (1..ny).map(|j| drops(j * row + 1, j * row + nx - 1)).collect();
        let of_column: Vec<[f64; 2]> = (1..nx)
            .map(|i| {
                let (low, high) = (self.now[row + i][1], -self.now[(ny - 1) * row + i][1]);
                [self.drop(bottom, low, dy), self.drop(top, high, dy)]
            })
            .collect();
        for (j, [low, high]) in of_row.iter().enumerate() {
            inside[j * (nx - 1)] += low / (dx * dx);
            inside[j * (nx - 1) + nx - 2] += high / (dx * dx);
        }
        for (i, [low, high]) in of_column.iter().enumerate() {
            inside[i] += low / (dy * dy);
            inside[(ny - 2) * (nx - 1) + i] += high / (dy * dy);
        }
        self.defect = self.poisson.defect(&mut inside);
        self.poisson.solve(&mut inside);
        for (j, values) in inside.chunks_exact(nx - 1).enumerate() {
            let line = &mut self.phi[(j + 1) * row..][..row];
            line[1..nx].copy_from_slice(values);
            line[0] = line[1] - of_row[j][0];
            line[nx] = line[nx - 1] - of_row[j][1];
        }
        for (i, [low, high]) in of_column.iter().enumerate() {
            self.phi[i + 1] = self.phi[row + i + 1] - low;
            self.phi[ny * row + i + 1] = self.phi[(ny - 1) * row + i + 1] - high;
        }
        self.inside = inside;
    }

    /// Puts on the sides of the field being made what they say: first where air flows out, then in, then walls.
    fn bound(&mut self) {
        let [nx, ny] = self.domain.cells;
        let row = nx + 1;
        let Sides { left, right, bottom, top } = self.sides;
        for rank in 0..3 {
            for (side, axis, first, stride, count, inward, sign) in [
                (top, 1, ny * row, 1, nx + 1, -(row as isize), -1.0),
                (left, 0, 0, row, ny + 1, 1, 1.0),
                (right, 0, nx, row, ny + 1, -1, -1.0),
                (bottom, 1, 0, 1, nx + 1, row as isize, 1.0),
            ] {
                for c in (0..count).map(|k| first + k * stride) {
                    let next_to = self.next[c.wrapping_add_signed(inward)];
                    let along = |square: f64, along: f64| {
                        if axis == 0 { [square, along] } else { [along, square] }
                    };
                    match (side, rank) {
                        (Side::Outflow, 0) => self.next[c] = next_to,
                        (Side::Slip, 0) => self.next[c] = along(0.0, next_to[1 - axis]),
                        (Side::Inflow(speed), 1) => self.next[c] = along(sign * speed, 0.0),
                        (Side::Wall(speed), 2) => self.next[c] = along(0.0, speed),
                        _ => {}
                    }
                }
            }
        }
    }

    fn look(&self, dt: f64) -> Result<(), FlowError> {
        self.bound.look(self.now.iter().flatten(), &self.sides, self.time, dt)
    }
}

impl Flow for Collocated {
    fn velocity(&self, place: [f64; 2]) -> Option<[f64; 2]> {
        let corners = self.at.corners(place)?;
        let low = self.at.index(corners.node);
        let high = low + self.at.counts[0];
        let [sw, se, nw, ne] = corners.weights;
        let [a, b, c, d] = [self.now[low], self.now[low + 1], self.now[high], self.now[high + 1]];
        Some(std::array::from_fn(|k| (a[k] * sw + b[k] * se) + (c[k] * nw + d[k] * ne)))
    }

    fn push(&mut self, place: [f64; 2], force: [f64; 2]) -> bool {
        let [x, y] = &mut self.force;
        self.at.spread(x, place, force[0]) && self.at.spread(y, place, force[1])
    }

    fn release(&mut self) {
        self.force.iter_mut().for_each(|force| force.fill(0.0));
    }

    fn step(&mut self, dt: f64) -> Result<(), FlowError> {
        Flow::check(self, dt)?;
        let row = self.at.counts[0];
        let [dx, dy] = self.at.spacing;
        for c in self.inner() {
            let a = self.acceleration(c);
            self.next[c] =
                std::array::from_fn(|axis| self.now[c][axis] + dt * (a[axis] + self.force[axis][c]));
        }
        self.bound();
        self.solve_pressure(dt);
        let outside = match self.forcing {
            Forcing::InsideStep => 0.0,
            // Eq. (17) as it stands adds f, of which dt f is there already.
            Forcing::AsPrinted => 1.0 - dt,
        };
        for c in self.inner() {
            let gradient = [
                (self.phi[c + 1] - self.phi[c - 1]) / (2.0 * dx),
                (self.phi[c + row] - self.phi[c - row]) / (2.0 * dy),
            ];
            for ((value, force), slope) in self.next[c].iter_mut().zip(&self.force).zip(gradient) {
                *value += outside * force[c] - dt * slope;
            }
        }
        self.bound();
        std::mem::swap(&mut self.now, &mut self.next);
        self.steps += 1;
        self.time += dt;
        if self.steps.is_multiple_of(LOOK) { self.look(dt) } else { Ok(()) }
    }

    fn check(&self, dt: f64) -> Result<(), FlowError> {
        self.bound.check(dt, &self.sides)
    }

    fn divergence(&self) -> f64 {
        Self::divergence(self)
    }

    fn set_inflow(&mut self, speed: f64) {
        self.sides.set_inflow(speed);
        self.bound.follow(&self.sides, speed);
    }

    fn nodes(&self) -> Lattice {
        self.at
    }
}
