//! A problem as argmin's solvers want it: costs, differences, residuals, neighbours.

use std::cell::Cell;

use argmin::core::{CostFunction, Error, Gradient, Hessian, Operator};
use argmin::solver::simulatedannealing::Anneal;

use super::oracle::Oracle;

/// A problem over x, or over the unit box with costs in units of the problem's scale.
///
/// Derivatives are differences of evaluations, which are paid for: forward differences for the gradient, second
/// differences for the Hessian, each over [`Oracle::difference`] of the box's width, backward at the upper face.
#[derive(Clone, Copy)]
pub struct View<'o> {
    oracle: &'o Oracle<'o>,
    unit: bool,
}

impl<'o> View<'o> {
    pub(super) fn unit(oracle: &'o Oracle<'_>) -> Self {
        Self { oracle, unit: true }
    }

    pub(super) fn native(oracle: &'o Oracle<'_>) -> Self {
        Self { oracle, unit: false }
    }

    /// Where every solver starts, in this view's coordinates.
    pub fn start(&self) -> Vec<f64> {
        let domain = self.oracle.domain().iter();
        self.oracle.start().iter().zip(domain).map(|(x, face)| self.seen(*x, *face)).collect()
    }

    /// The box in this view's coordinates: the least corner and the greatest.
    pub fn corners(&self) -> (Vec<f64>, Vec<f64>) {
        self.oracle.domain().iter().map(|face| (self.seen(face.0, *face), self.seen(face.1, *face))).unzip()
    }

    /// The start and a point beside it in each dimension, so far away as a part of the box's width, towards the
    /// farther face: a simplex.
    pub fn simplex(&self, part: f64) -> Vec<Vec<f64>> {
        let (start, (low, high)) = (self.start(), self.corners());
        let mut simplex = vec![start.clone()];
        for k in 0..start.len() {
            let mut corner = start.clone();
            let side = if high[k] - start[k] >= start[k] - low[k] { part } else { -part };
            corner[k] += side * (high[k] - low[k]);
            simplex.push(corner);
        }
        simplex
    }

    /// One coordinate only, for solvers of numbers.
    pub fn line(self) -> Line<'o> {
        Line(self)
    }

    /// The residual as a function whose root is sought.
    pub fn root(self) -> Root<'o> {
        Root(self)
    }

    /// A neighbour for simulated annealing is drawn from here.
    pub fn annealed(self) -> Annealed<'o> {
        Annealed { view: self, step: Cell::new(0) }
    }

    fn seen(&self, x: f64, (low, high): (f64, f64)) -> f64 {
        if self.unit { (x - low) / (high - low) } else { x }
    }

    /// x, to twelve decimals where it comes from the unit box, so that every solver's start is the same x.
    fn meant(&self, u: &[f64]) -> Vec<f64> {
        let x = |(u, (low, high)): (&f64, &(f64, f64))| libm::round((low + u * (high - low)) * 1e12) / 1e12;
        match self.unit {
            true => u.iter().zip(self.oracle.domain()).map(x).collect(),
            false => u.to_vec(),
        }
    }

    fn cost_at(&self, u: &[f64]) -> Result<f64, Error> {
        let cost = self.oracle.evaluate(&self.meant(u))?;
        Ok(if self.unit { cost / self.oracle.scale() } else { cost })
    }

    /// The difference in dimension k, backward where forward would leave the box.
    fn difference(&self, u: &[f64], k: usize) -> f64 {
        let face = self.oracle.domain()[k];
        let (low, high) = (self.seen(face.0, face), self.seen(face.1, face));
        let h = self.oracle.difference() * (high - low);
        if u[k] + h > high { -h } else { h }
    }
}

/// u with h added in dimension k.
fn beside(u: &[f64], k: usize, h: f64) -> Vec<f64> {
    let mut beside = u.to_vec();
    beside[k] += h;
    beside
}

impl CostFunction for View<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, u: &Vec<f64>) -> Result<f64, Error> {
        self.cost_at(u)
    }
}

impl Gradient for View<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, u: &Vec<f64>) -> Result<Vec<f64>, Error> {
        let here = self.cost_at(u)?;
        (0..u.len())
            .map(|k| {
                let h = self.difference(u, k);
                Ok((self.cost_at(&beside(u, k, h))? - here) / h)
            })
            .collect()
    }
}

impl Hessian for View<'_> {
    type Param = Vec<f64>;
    type Hessian = Vec<Vec<f64>>;

    fn hessian(&self, u: &Vec<f64>) -> Result<Vec<Vec<f64>>, Error> {
        let here = self.cost_at(u)?;
        let h: Vec<f64> = (0..u.len()).map(|k| self.difference(u, k)).collect();
        let once: Vec<f64> =
            (0..u.len()).map(|k| self.cost_at(&beside(u, k, h[k]))).collect::<Result<_, Error>>()?;
        let mut hessian = vec![vec![0.0; u.len()]; u.len()];
        for i in 0..u.len() {
            for j in i..u.len() {
                let twice = self.cost_at(&beside(&beside(u, i, h[i]), j, h[j]))?;
                hessian[i][j] = (twice - once[i] - once[j] + here) / (h[i] * h[j]);
                hessian[j][i] = hessian[i][j];
            }
        }
        Ok(hessian)
    }
}

/// One dimension, for solvers of numbers.
#[derive(Clone, Copy)]
pub struct Line<'o>(View<'o>);

impl CostFunction for Line<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, u: &f64) -> Result<f64, Error> {
        self.0.cost_at(&[*u])
    }
}

impl Operator for Line<'_> {
    type Param = f64;
    type Output = f64;

    fn apply(&self, u: &f64) -> Result<f64, Error> {
        self.0.oracle.residual(&self.0.meant(&[*u]))
    }
}

/// The residual as argmin's root finders want it: as a cost.
#[derive(Clone, Copy)]
pub struct Root<'o>(View<'o>);

impl CostFunction for Root<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, u: &f64) -> Result<f64, Error> {
        self.0.oracle.residual(&self.0.meant(&[*u]))
    }
}

/// A view with neighbours, for simulated annealing.
pub struct Annealed<'o> {
    view: View<'o>,
    step: Cell<i32>,
}

impl CostFunction for Annealed<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, u: &Vec<f64>) -> Result<f64, Error> {
        self.view.cost_at(u)
    }
}

impl Anneal for Annealed<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Float = f64;

    /// Uniform in a box around u whose half width is the square root of the temperature in units of the box's,
    /// mirrored at the faces.
    fn anneal(&self, u: &Vec<f64>, temperature: f64) -> Result<Vec<f64>, Error> {
        let step = self.step.get();
        self.step.set(step + 1);
        let mut draws = self.view.oracle.stream("anneal").at(0).place(step, 0, 0);
        let (low, high) = self.view.corners();
        let reach = libm::sqrt(temperature).min(0.5);
        let moved = u.iter().zip(low.iter().zip(&high)).map(|(u, (low, high))| {
            let to = u + reach * (high - low) * (2.0 * draws.uniform() - 1.0);
            let to = if to < *low { 2.0 * low - to } else { to };
            if to > *high { 2.0 * high - to } else { to }
        });
        Ok(moved.collect())
    }
}
