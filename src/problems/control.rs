//! Functions with a known minimum of 0, from argmin's collection: whether the contest is fair.
//!
//! Only functions without transcendental parts: the standard library's differ from one machine to the next.

use argmin::core::Error;
use argmin_testfunctions as functions;

use super::Suite;
use crate::optimize::contest::{Measure, Problem, Target};
use crate::rng::Seed;

/// A function with a known minimum.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// Its name.
    pub name: &'static str,
    dimension: usize,
    face: f64,
    scale: f64,
    function: fn(&[f64]) -> Value,
    /// Where the cost is 0: one such point, whether or not there are others.
    pub minimum: fn(usize) -> Vec<f64>,
}

/// A cost, or a residual whose square it is.
enum Value {
    Cost(f64),
    Residual(f64),
}

/// The least cost that is asked for, and what comes before it.
const TARGETS: [f64; 5] = [1.0, 1e-1, 1e-2, 1e-4, 1e-8];

impl Problem for Control {
    fn name(&self) -> String {
        format!("{}-{}", self.name, self.dimension)
    }

    fn domain(&self) -> Vec<(f64, f64)> {
        vec![(-self.face, self.face); self.dimension]
    }

    /// Uniform in the box.
    fn start(&self, seed: Seed) -> Vec<f64> {
        let mut place = seed.stream("start").at(0).place(0, 0, 0);
        let coordinate = |uniform: f64| libm::round(self.face * (2.0 * uniform - 1.0) * 1e4) / 1e4;
        (0..self.dimension).map(|_| coordinate(place.uniform())).collect()
    }

    fn scale(&self) -> f64 {
        self.scale
    }

    /// The root of the precision of numbers, and some room for costs that are large.
    fn difference(&self) -> f64 {
        1e-7
    }

    fn targets(&self) -> Vec<Target> {
        TARGETS.map(Target::cost).to_vec()
    }

    fn measure(&self, x: &[f64], _seed: Seed) -> Result<Measure, Error> {
        Ok(match (self.function)(x) {
            Value::Cost(cost) => Measure::of_cost(cost),
            Value::Residual(residual) => Measure::of_residual(residual),
        })
    }
}

fn pair(x: &[f64]) -> [f64; 2] {
    [x.first().copied().unwrap_or(f64::NAN), x.get(1).copied().unwrap_or(f64::NAN)]
}

/// The suite.
pub fn suite() -> Vec<Control> {
    let two =
        |name, face, scale, function, minimum| Control { name, dimension: 2, face, scale, function, minimum };
    let mut suite = vec![
        // In one dimension the residual is x - 1: what brackets and roots do with it is known beforehand.
        Control {
            name: "line",
            dimension: 1,
            face: 5.0,
            scale: 36.0,
            function: |x| Value::Residual(x[0] - 1.0),
            minimum: |_| vec![1.0],
        },
        Control {
            name: "cubic",
            dimension: 1,
            face: 3.0,
            scale: 900.0,
            function: |x| Value::Residual(x[0] * x[0] * x[0] + x[0] - 2.0),
            minimum: |_| vec![1.0],
        },
        two("booth", 10.0, 2594.0, |x| Value::Cost(functions::booth(&pair(x))), |_| vec![1.0, 3.0]),
        two("matyas", 10.0, 100.0, |x| Value::Cost(functions::matyas(&pair(x))), |_| vec![0.0, 0.0]),
        two("beale", 4.5, 2e5, |x| Value::Cost(functions::beale(&pair(x))), |_| vec![3.0, 0.5]),
        two("himmelblau", 5.0, 890.0, |x| Value::Cost(functions::himmelblau(&pair(x))), |_| vec![3.0, 2.0]),
        two(
            "three-hump-camel",
            5.0,
            2047.0,
            |x| Value::Cost(functions::threehumpcamel(&pair(x))),
            |_| vec![0.0; 2],
        ),
    ];
    for dimension in [2, 6, 12] {
        suite.push(Control {
            name: "sphere",
            dimension,
            face: 5.0,
            scale: 25.0 * dimension as f64,
            function: |x| Value::Cost(functions::sphere(x)),
            minimum: |n| vec![0.0; n],
        });
        suite.push(Control {
            name: "rosenbrock",
            dimension,
            face: 2.0,
            scale: 1000.0 * dimension as f64,
            function: |x| Value::Cost(functions::rosenbrock(x)),
            minimum: |n| vec![1.0; n],
        });
    }
    suite
}

/// The suite as problems of any kind.
pub fn boxed(problems: Vec<Control>) -> Suite {
    problems.into_iter().map(|problem| Box::new(problem) as Box<_>).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_are_zero_at_the_known_minimum_and_positive_beside_it() {
        for control in suite() {
            let minimum = (control.minimum)(control.domain().len());
            let cost = |x: &[f64]| control.measure(x, Seed(1)).unwrap().cost;
            assert!(cost(&minimum) < 1e-20, "{}", control.name());
            for k in 0..minimum.len() {
                for h in [-0.1, 0.1] {
                    let mut beside = minimum.clone();
                    beside[k] += h;
                    assert!(cost(&beside) > 1e-5, "{}", control.name());
                }
            }
            // A residual's square is its cost.
            let measure = control.measure(&vec![0.5; minimum.len()], Seed(1)).unwrap();
            assert!(measure.residual.is_none_or(|residual| residual * residual == measure.cost));
            let scale =
                cost(&vec![control.face; minimum.len()]).max(cost(&vec![-control.face; minimum.len()]));
            assert!(scale <= 8.0 * control.scale, "{}: {scale}", control.name());
        }
    }
}
