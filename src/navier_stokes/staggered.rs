//! The MAC method as Harlow & Welch (1965) laid it out: velocities on the faces of cells, pressure in their middle.
//!
//! Centred differences are of second order; the pressure is solved for directly, so that what flows into a cell flows
//! out of it, but for rounding. Time: Adams-Bashforth for centred convection, else forward ([`Step::of`]).

use super::bound::Bound;
use super::domain::check;
use super::kernel::{Around, Rule, divergence, predict, push_back};
use super::{Convection, Domain, Flow, FlowError, Lattice, Poisson, Side, Sides, Step};

/// Steps between two looks at whether the flow is still sound.
const LOOK: u64 = 64;

/// A flow whose velocities live on the faces.
#[derive(Clone, Debug)]
pub struct Staggered {
    domain: Domain,
    sides: Sides,
    viscosity: f64,
    convection: Convection,
    // u on faces square to x, with a row beyond the ground and the top; v on faces square to y, with a column beyond
    // each side. `next` is where the coming step is made, `force` what pushes, `carried` the convection of the last.
    u: Component,
    v: Component,
    pressure: Vec<f64>,
    poisson: Poisson,
    bound: Bound,
    // The last time step; none before the first.
    last: Option<f64>,
    steps: u64,
    time: f64,
}

#[derive(Clone, Debug)]
struct Component {
    at: Lattice,
    now: Vec<f64>,
    next: Vec<f64>,
    force: Vec<f64>,
    carried: Vec<f64>,
}

impl Component {
    fn new(at: Lattice) -> Self {
        let zero = vec![0.0; at.counts[0] * at.counts[1]];
        Self { at, now: zero.clone(), next: zero.clone(), force: zero.clone(), carried: zero }
    }

    /// `len` faces of a field from column `from` of row `j` on.
    fn part<'a>(&self, field: &'a [f64], j: usize, from: usize, len: usize) -> &'a [f64] {
        &field[j * self.at.counts[0] + from..][..len]
    }
}

impl Staggered {
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
    ) -> Result<Self, FlowError> {
        check(&domain, &sides, viscosity)?;
        let [nx, ny] = domain.cells;
        let spacing = domain.spacing();
        let u = Lattice { counts: [nx + 1, ny + 2], spacing, bottom: -0.5 * spacing[1] };
        let v = Lattice { counts: [nx + 2, ny + 1], spacing, bottom: 0.0 };
        let bound = Bound::new(Step::of(convection), convection, viscosity, spacing, &sides);
        let mut flow = Self {
            domain,
            sides,
            viscosity,
            convection,
            u: Component::new(u),
            v: Component::new(v),
            pressure: vec![0.0; nx * ny],
            poisson: Poisson::new(nx, ny, spacing[0], spacing[1]),
            bound,
            last: None,
            steps: 0,
            time: 0.0,
        };
        flow.close();
        Ok(flow)
    }

    /// Sets the velocity everywhere, m/s, but on the sides, which stay as they are.
    pub fn fill(&mut self, velocity: impl Fn([f64; 2]) -> [f64; 2]) {
        for (axis, component) in [&mut self.u, &mut self.v].into_iter().enumerate() {
            for (c, value) in component.now.iter_mut().enumerate() {
                let node = [c % component.at.counts[0], c / component.at.counts[0]];
                *value = velocity(component.at.place(node))[axis];
            }
        }
        self.close();
    }

    /// The largest time step that is let pass, s.
    pub fn largest_step(&self) -> f64 {
        self.bound.most()
    }

    /// Time since the start, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// u on the faces square to x: their places and the field, with a row outside below and above.
    pub fn u(&self) -> (Lattice, &[f64]) {
        (self.u.at, &self.u.now)
    }

    /// v on the faces square to y: their places and the field, with a column outside on both sides.
    pub fn v(&self) -> (Lattice, &[f64]) {
        (self.v.at, &self.v.now)
    }

    /// Pressure over density in the cells, m2/s2, row by row, of the last step; its mean is 0.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// The largest divergence of a cell, 1/s.
    pub fn divergence(&self) -> f64 {
        let mut field = vec![0.0; self.pressure.len()];
        diverge(&self.domain, &self.u, &self.v, &self.u.now, &self.v.now, &mut field);
        field.iter().fold(0.0, |most, d| most.max(d.abs()))
    }

    /// Kinetic energy over density and depth, m4/s2: half the square of each face's velocity on the area around it.
    pub fn kinetic_energy(&self) -> f64 {
        let [nx, ny] = self.domain.cells;
        let [dx, dy] = self.domain.spacing();
        let square = |x: &f64| x * x;
        // Faces on the sides have half a cell.
        let u_row =
            |row: &[f64]| row.iter().map(square).sum::<f64>() - 0.5 * (square(&row[0]) + square(&row[nx]));
        let v_row = |j: usize| {
            let all = self.v.part(&self.v.now, j, 1, nx).iter().map(square).sum::<f64>();
            if j == 0 || j == ny { 0.5 * all } else { all }
        };
        let of_u = (1..=ny).map(|j| u_row(self.u.part(&self.u.now, j, 0, nx + 1))).sum::<f64>();
        let of_v = (0..=ny).map(v_row).sum::<f64>();
        0.5 * (of_u + of_v) * dx * dy
    }

    /// Predictor: Eq. (17) without its pressure.
    fn predict(&mut self, dt: f64) {
        let [nx, ny] = self.domain.cells;
        let [dx, dy] = self.domain.spacing();
        let before = match (Step::of(self.convection), self.last) {
            (Step::AdamsBashforth, Some(last)) => -0.5 * dt / last,
            _ => 0.0,
        };
        let rule = |per| Rule {
            dt,
            per,
            viscosity: self.viscosity,
            now: 1.0 - before,
            before,
            upwind: self.convection == Convection::Upwind,
        };
        let (along_x, along_y) = (rule([1.0 / dx, 1.0 / dy]), rule([1.0 / dy, 1.0 / dx]));
        let (u, v) = (&mut self.u, &mut self.v);
        for j in 1..=ny {
            let of_u = |j: usize, from: usize| &u.now[j * (nx + 1) + from..][..nx - 1];
            let of_v = |j: usize, from: usize| &v.now[j * (nx + 2) + from..][..nx - 1];
            let at = j * (nx + 1) + 1;
            let around = Around {
                here: of_u(j, 1),
                behind: of_u(j, 0),
                ahead: of_u(j, 2),
                below: of_u(j - 1, 1),
                above: of_u(j + 1, 1),
                carry_below: [of_v(j - 1, 1), of_v(j - 1, 2)],
                carry_above: [of_v(j, 1), of_v(j, 2)],
                force: &u.force[at..][..nx - 1],
            };
            predict(along_x, around, &mut u.carried[at..][..nx - 1], &mut u.next[at..][..nx - 1]);
        }
        for j in 1..ny {
            let of_u = |j: usize, from: usize| &u.now[j * (nx + 1) + from..][..nx];
            let of_v = |j: usize, from: usize| &v.now[j * (nx + 2) + from..][..nx];
            let at = j * (nx + 2) + 1;
            let around = Around {
                here: of_v(j, 1),
                behind: of_v(j - 1, 1),
                ahead: of_v(j + 1, 1),
                below: of_v(j, 0),
                above: of_v(j, 2),
                carry_below: [of_u(j, 0), of_u(j + 1, 0)],
                carry_above: [of_u(j, 1), of_u(j + 1, 1)],
                force: &v.force[at..][..nx],
            };
            predict(along_y, around, &mut v.carried[at..][..nx], &mut v.next[at..][..nx]);
        }
    }

    /// Corrector: the pressure that makes the predicted velocity free of divergence, and what it does to it.
    fn project(&mut self, dt: f64) {
        let [nx, ny] = self.domain.cells;
        let [dx, dy] = self.domain.spacing();
        diverge(&self.domain, &self.u, &self.v, &self.u.next, &self.v.next, &mut self.pressure);
        // phi dt is solved for, so that nothing is divided by a short dt and multiplied again.
        self.poisson.solve(&mut self.pressure);
        for j in 1..=ny {
            let p = &self.pressure[(j - 1) * nx..][..nx];
            let faces = &mut self.u.next[j * (nx + 1) + 1..][..nx - 1];
            push_back(faces, &p[..nx - 1], &p[1..], 1.0 / dx);
        }
        for j in 1..ny {
            let (below, above) = self.pressure[(j - 1) * nx..][..2 * nx].split_at(nx);
            push_back(&mut self.v.next[j * (nx + 2) + 1..][..nx], below, above, 1.0 / dy);
        }
        self.pressure.iter_mut().for_each(|p| *p /= dt);
    }

    /// Puts what the sides say on the sides of the field being made.
    fn bound(&mut self) {
        let Sides { left, right, bottom, top } = self.sides;
        let [nx, ny] = self.domain.cells;
        let [u, v] = [&mut self.u.next, &mut self.v.next];
        // Square to the side: what flows in, or out as it does next to it.
        let square = |side: Side, sign: f64, next_to: f64| match side {
            Side::Wall(_) | Side::Slip => 0.0,
            Side::Inflow(speed) => sign * speed,
            Side::Outflow => next_to,
        };
        for j in 1..=ny {
            let row = &mut u[j * (nx + 1)..][..nx + 1];
            row[0] = square(left, 1.0, row[1]);
            row[nx] = square(right, -1.0, row[nx - 1]);
        }
        for c in 1..=nx {
            v[c] = square(bottom, 1.0, v[nx + 2 + c]);
            v[ny * (nx + 2) + c] = square(top, -1.0, v[(ny - 1) * (nx + 2) + c]);
        }
        self.balance();
        self.bound_along();
    }

    /// The part of it along the sides: what is outside mirrors what is inside.
    fn bound_along(&mut self) {
        let Sides { left, right, bottom, top } = self.sides;
        let [nx, ny] = self.domain.cells;
        let [u, v] = [&mut self.u.next, &mut self.v.next];
        // Along the side: the mean of inside and outside is the side's own speed, or the same on both.
        let along = |side: Side, inside: f64| match side {
            Side::Wall(speed) => 2.0 * speed - inside,
            Side::Inflow(_) => -inside,
            Side::Slip | Side::Outflow => inside,
        };
        for i in 0..=nx {
            u[i] = along(bottom, u[nx + 1 + i]);
            u[(ny + 1) * (nx + 1) + i] = along(top, u[ny * (nx + 1) + i]);
        }
        for j in 0..=ny {
            let row = &mut v[j * (nx + 2)..][..nx + 2];
            row[0] = along(left, row[1]);
            row[nx + 1] = along(right, row[nx]);
        }
    }

    /// As much must flow out as flows in: the difference is shared among the faces where air flows out.
    fn balance(&mut self) {
        let Sides { left, right, bottom, top } = self.sides;
        let [nx, ny] = self.domain.cells;
        let [dx, dy] = self.domain.spacing();
        let length = |side: Side, length: f64| if side == Side::Outflow { length } else { 0.0 };
        let [width, height] = self.domain.size;
        let open =
            (length(left, height) + length(right, height)) + (length(bottom, width) + length(top, width));
        if open == 0.0 {
            return;
        }
        let [u, v] = [&mut self.u.next, &mut self.v.next];
        let out_x: f64 = (1..=ny).map(|j| u[j * (nx + 1) + nx] - u[j * (nx + 1)]).sum();
        // Mirror pairs first, so that the mirrored flow has the same sum.
        let through = |c: usize| v[ny * (nx + 2) + c] - v[c];
        let pairs: f64 = (1..=nx / 2).map(|c| through(c) + through(nx + 1 - c)).sum();
        let out_y = if nx % 2 == 1 { pairs + through(nx / 2 + 1) } else { pairs };
        let change = (out_x * dy + out_y * dx) / open;
        for j in 1..=ny {
            if left == Side::Outflow {
                u[j * (nx + 1)] += change;
            }
            if right == Side::Outflow {
                u[j * (nx + 1) + nx] -= change;
            }
        }
        for c in 1..=nx {
            if bottom == Side::Outflow {
                v[c] += change;
            }
            if top == Side::Outflow {
                v[ny * (nx + 2) + c] -= change;
            }
        }
    }

    /// Makes the sides of the present field right.
    fn close(&mut self) {
        self.u.next.copy_from_slice(&self.u.now);
        self.v.next.copy_from_slice(&self.v.now);
        self.bound();
        self.turn();
    }

    fn turn(&mut self) {
        std::mem::swap(&mut self.u.now, &mut self.u.next);
        std::mem::swap(&mut self.v.now, &mut self.v.next);
    }

    fn look(&self, dt: f64) -> Result<(), FlowError> {
        self.bound.look(self.u.now.iter().chain(&self.v.now), &self.sides, self.time, dt)
    }
}

/// Divergence of each cell, 1/s.
fn diverge(domain: &Domain, u: &Component, v: &Component, of_u: &[f64], of_v: &[f64], out: &mut [f64]) {
    let [nx, _] = domain.cells;
    let [dx, dy] = domain.spacing();
    for (j, row) in out.chunks_exact_mut(nx).enumerate() {
        let (below, above) = (v.part(of_v, j, 1, nx), v.part(of_v, j + 1, 1, nx));
        divergence(u.part(of_u, j + 1, 0, nx + 1), below, above, [1.0 / dx, 1.0 / dy], row);
    }
}

impl Flow for Staggered {
    fn velocity(&self, place: [f64; 2]) -> Option<[f64; 2]> {
        self.nodes().corners(place)?; // inside of the box
        Some([self.u.at.read(&self.u.now, place)?, self.v.at.read(&self.v.now, place)?])
    }

    fn push(&mut self, place: [f64; 2], force: [f64; 2]) -> bool {
        if self.nodes().corners(place).is_none() {
            return false;
        }
        self.u.at.spread(&mut self.u.force, place, force[0])
            && self.v.at.spread(&mut self.v.force, place, force[1])
    }

    fn release(&mut self) {
        self.u.force.fill(0.0);
        self.v.force.fill(0.0);
    }

    fn step(&mut self, dt: f64) -> Result<(), FlowError> {
        Flow::check(self, dt)?;
        self.predict(dt);
        self.bound();
        self.project(dt);
        self.bound_along();
        self.turn();
        self.last = Some(dt);
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
        let [nx, ny] = self.domain.cells;
        Lattice { counts: [nx + 1, ny + 1], spacing: self.domain.spacing(), bottom: 0.0 }
    }
}
