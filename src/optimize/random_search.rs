//! Random search: the measure of what chance alone does.

use argmin::core::{CostFunction, Error, IterState, KV, Problem, Solver};

use crate::rng::Moment;

type Search = IterState<Vec<f64>, (), (), (), (), f64>;

/// Uniform points in a box, each drawn without regard to those before.
///
/// The state's parameter, if there is one, is the first point.
#[derive(Clone, Debug)]
pub struct RandomSearch {
    domain: Vec<(f64, f64)>,
    moment: Moment,
    drawn: i32,
}

impl RandomSearch {
    /// The box, and the random numbers: those of place (k, 0, 0) are the coordinates of draw k.
    pub fn new(domain: Vec<(f64, f64)>, moment: Moment) -> Self {
        Self { domain, moment, drawn: 0 }
    }

    fn draw(&mut self) -> Vec<f64> {
        let mut place = self.moment.place(self.drawn, 0, 0);
        self.drawn = self.drawn.wrapping_add(1);
        self.domain.iter().map(|(low, high)| low + (high - low) * place.uniform()).collect()
    }
}

impl<O> Solver<O, Search> for RandomSearch
where
    O: CostFunction<Param = Vec<f64>, Output = f64>,
{
    fn name(&self) -> &str {
        "random search"
    }

    fn init(&mut self, problem: &mut Problem<O>, mut state: Search) -> Result<(Search, Option<KV>), Error> {
        let first = state.take_param().unwrap_or_else(|| self.draw());
        let cost = problem.cost(&first)?;
        Ok((state.param(first).cost(cost), None))
    }

    fn next_iter(&mut self, problem: &mut Problem<O>, state: Search) -> Result<(Search, Option<KV>), Error> {
        let point = self.draw();
        let cost = problem.cost(&point)?;
        Ok((state.param(point).cost(cost), None))
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use argmin::core::Executor;

    use super::*;
    use crate::rng::Seed;

    /// Remembers where it was asked.
    struct Asked(RefCell<Vec<Vec<f64>>>, f64);

    impl CostFunction for &Asked {
        type Param = Vec<f64>;
        type Output = f64;

        fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
            self.0.borrow_mut().push(x.clone());
            Ok(self.1 * x[0])
        }
    }

    fn points(slope: f64) -> Vec<Vec<f64>> {
        let asked = Asked(RefCell::default(), slope);
        let solver = RandomSearch::new(vec![(0.0, 1.0), (5.0, 7.0)], Seed(1).stream("random").at(0));
        Executor::new(&asked, solver)
            .configure(|state| state.param(vec![0.5, 6.0]).max_iters(400))
            .timer(false)
            .run()
            .unwrap();
        asked.0.into_inner()
    }

    #[test]
    fn points_lie_in_the_box_and_do_not_depend_on_costs() {
        let points_up = points(1.0);
        assert_eq!(points_up, points(-1.0));
        assert_eq!((points_up.len(), points_up[0].clone()), (401, vec![0.5, 6.0]));
        assert!(points_up.iter().all(|p| p[0] > 0.0 && p[0] < 1.0 && p[1] > 5.0 && p[1] < 7.0));
        let mean = points_up.iter().map(|p| p[1]).sum::<f64>() / 401.0;
        assert!((mean - 6.0).abs() < 0.12, "{mean}: four standard errors of a uniform mean");
    }
}
