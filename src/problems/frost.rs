//! Frost in one dimension (Amano §3.4): which initial value ends the film in the frame that was asked for?

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use argmin::core::Error;

use super::Suite;
use crate::frost::{
    Edge, EndFrame, EndOf, EndRule, Inflow, Parameters, Redraw, RingTouchingIce, TSim, end_frame,
};
use crate::hexgrid::{Axial, Region};
use crate::optimize::contest::{Measure, Problem, Target};
use crate::rng::Seed;

/// The initial values among which is sought: below, films are too long to be wanted; above, ice is everywhere at once.
pub const DOMAIN: (f64, f64) = (0.15, 0.9);
/// The first initial value of the paper's searches (Tables 1 and 2).
pub const START: f64 = 0.25;
/// Frames by which an end may miss its target; the paper accepts 4 (§4).
pub const TARGETS: [f64; 5] = [8.0, 4.0, 2.0, 1.0, 0.0];
/// A film is given up at this multiple of the target, and counts as ending there.
const GIVEN_UP: f64 = 4.0;
/// gamma of the paper's pictures (§4); at a threshold it is divided by the share of the cells that gain it.
const GAMMA: f64 = 0.005;

/// The end frames of one sketch and threshold, by seed and initial value: a film is grown once, whoever asks.
#[derive(Debug)]
pub struct Films {
    region: Region,
    starts: Vec<Axial>,
    parameters: Parameters,
    rule: EndRule,
    frame_limit: u64,
    grown: Mutex<BTreeMap<(u64, u64), Option<EndFrame>>>,
}

impl Films {
    /// Where a film ends; none if not before it is given up.
    ///
    /// # Errors
    ///
    /// Those of the model.
    pub fn end(&self, beta: f64, seed: Seed) -> Result<Option<EndFrame>, Error> {
        // Without a threshold chance does not enter.
        let seed = if self.parameters.threshold == 0.0 { Seed(0) } else { seed };
        let key = (seed.0, beta.to_bits());
        let known = self.grown.lock().ok().and_then(|grown| grown.get(&key).copied());
        if let Some(end) = known {
            return Ok(end);
        }
        let parameters = Parameters { beta, ..self.parameters };
        let end = end_frame(&self.region, &self.starts, parameters, seed, self.rule, self.frame_limit)?;
        if let Ok(mut grown) = self.grown.lock() {
            grown.insert(key, end);
        }
        Ok(end)
    }

    /// Films that were grown: the same number however many threads asked.
    pub fn count(&self) -> u64 {
        self.grown.lock().map_or(0, |grown| grown.len() as u64)
    }

    /// The sketch.
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// The parameters, with whatever beta.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Where growth starts.
    pub fn starts(&self) -> &[Axial] {
        &self.starts
    }
}

/// The initial value that makes the film on a sketch end in a frame: the residual is T_sim - T in frames, the cost its
/// square, Eq. (2).
#[derive(Clone, Debug)]
pub struct EndFrameProblem {
    /// Its name.
    pub name: String,
    /// T.
    pub target: f64,
    /// Which number T_sim is.
    pub t_sim: TSim,
    /// Whether every seed starts from the paper's 0.25.
    pub starts_as_printed: bool,
    /// The films.
    pub films: Arc<Films>,
}

impl EndFrameProblem {
    /// T_sim of an initial value.
    ///
    /// # Errors
    ///
    /// Those of the model.
    pub fn t_sim(&self, beta: f64, seed: Seed) -> Result<f64, Error> {
        let given_up = GIVEN_UP * self.target;
        Ok(self.films.end(beta, seed)?.map_or(given_up, |end| match self.t_sim {
            TSim::Whole => end.frame as f64,
            TSim::Interpolated => end.interpolated,
        }))
    }
}

impl Problem for EndFrameProblem {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn domain(&self) -> Vec<(f64, f64)> {
        vec![DOMAIN]
    }

    /// The paper's 0.25 with seed 1 and on its own tables, else uniform from 0.2 to 0.75.
    fn start(&self, seed: Seed) -> Vec<f64> {
        if self.starts_as_printed {
            return vec![START];
        }
        vec![first_value(seed)]
    }

    /// The cost of a film that is given up.
    fn scale(&self) -> f64 {
        let miss = (GIVEN_UP - 1.0) * self.target;
        miss * miss
    }

    /// A hundredth in beta, about what the paper's own steps are: it moves the end by several frames.
    fn difference(&self) -> f64 {
        0.01 / (DOMAIN.1 - DOMAIN.0)
    }

    fn targets(&self) -> Vec<Target> {
        TARGETS.map(Target::within).to_vec()
    }

    fn measure(&self, x: &[f64], seed: Seed) -> Result<Measure, Error> {
        let beta = x.first().copied().ok_or_else(|| Error::msg("an initial value is needed"))?;
        Ok(Measure::of_residual(self.t_sim(beta, seed)? - self.target))
    }
}

/// A sketch with its starts and the steps of the solver in a frame.
struct Sketch {
    name: &'static str,
    region: Region,
    starts: Vec<Axial>,
    steps_per_frame: u32,
}

/// The sketches, each with so many steps in a frame that a film of about 100 frames begins with vapour of 0.3 to 0.5.
/// A resolution above 1 makes every cell that many times smaller and frames of as many more steps.
fn sketches(resolution: u32) -> Vec<Sketch> {
    let n = resolution.max(1) as i32;
    let half = |width: f64| width * f64::from(n);
    let at = |q: i32, r: i32| Axial::new(q * n, r * n);
    let sketch =
        |name, region, starts, steps: u32| Sketch { name, region, starts, steps_per_frame: steps * n as u32 };
    let hexagon = |radius: i32| Region::hexagon((radius * n) as u16);
    let centre = || vec![Axial::ORIGIN];
    vec![
        sketch("disc", Region::disc((9 * n * 9 * n) as u32), centre(), 4),
        sketch("hexagon", hexagon(9), centre(), 4),
        sketch("square", Region::rectangle(half(8.0), half(8.0)), centre(), 4),
        sketch("rectangle", Region::rectangle(half(18.0), half(3.5)), centre(), 7),
        sketch("edge", hexagon(9), vec![at(9, 0)], 8),
        sketch("two-starts", Region::rectangle(half(16.0), half(5.0)), vec![at(-10, 0), at(6, 0)], 5),
        sketch("holes", with_holes(&hexagon(11), n), centre(), 4),
    ]
}

/// A region without six round holes, half way to its corners.
fn with_holes(region: &Region, n: i32) -> Region {
    let holes = Axial::ORIGIN.neighbours().map(|step| Axial::new(6 * n * step.q, 6 * n * step.r));
    let solid = |cell: &Axial| {
        holes.iter().all(|hole| Axial::new(cell.q - hole.q, cell.r - hole.r).norm() > i64::from(4 * n * n))
    };
    Region::new(region.cells().iter().copied().filter(solid)).unwrap_or_else(|_| region.clone())
}

/// Thresholds, and the targets in frames that are asked for with each.
const ASKED: [(f64, &[f64]); 3] = [(0.0, &[100.0]), (0.4, &[100.0]), (0.8, &[100.0, 60.0])];

/// The suite: every sketch with every threshold, and the paper's own two tables as reconstructed (amano/reconstruction).
pub fn suite(t_sim: TSim, resolution: u32) -> Vec<EndFrameProblem> {
    let mut problems = tables(t_sim);
    for sketch in sketches(resolution) {
        for (threshold, targets) in ASKED {
            let longest = targets.iter().copied().fold(0.0, f64::max);
            let films = Arc::new(films(&sketch, threshold, longest));
            for target in targets {
                problems.push(EndFrameProblem {
                    name: format!("{}-{threshold}-{target}", sketch.name),
                    target: *target,
                    t_sim,
                    starts_as_printed: false,
                    films: Arc::clone(&films),
                });
            }
        }
    }
    problems
}

/// The paper's Tables 1 and 2: a hexagon of 1387 cells, 9 steps in a frame, frame 130, from 0.25.
pub fn tables(t_sim: TSim) -> Vec<EndFrameProblem> {
    let sketch = Sketch {
        name: "table",
        region: Region::hexagon(21),
        starts: vec![Axial::ORIGIN],
        steps_per_frame: 9,
    };
    [("table-1", 0.0), ("table-2", 0.8)]
        .map(|(name, threshold)| EndFrameProblem {
            name: name.to_owned(),
            target: 130.0,
            t_sim,
            starts_as_printed: true,
            films: Arc::new(films(&sketch, threshold, 130.0)),
        })
        .to_vec()
}

fn films(sketch: &Sketch, threshold: f64, target: f64) -> Films {
    Films {
        region: sketch.region.clone(),
        starts: sketch.starts.clone(),
        parameters: parameters(threshold, sketch.steps_per_frame),
        rule: EndRule { share: 0.9, of: EndOf::AllCells },
        frame_limit: (GIVEN_UP * target) as u64,
        grown: Mutex::default(),
    }
}

/// The parameters of the paper's tables (amano/reconstruction), beta still open.
pub(super) fn parameters(threshold: f64, steps_per_frame: u32) -> Parameters {
    Parameters {
        alpha: 1.0,
        beta: START,
        // In tenths, since 1 - 0.8 is not 0.2 to the last bit.
        gamma: GAMMA * (10.0 / (10.0 - 10.0 * threshold)),
        threshold,
        steps_per_frame,
        inflow: Inflow::ReiterGated,
        redraw: Redraw::Frame,
        edge: Edge::Reflecting,
        ring_touching_ice: RingTouchingIce::Zero,
    }
}

/// The paper's 0.25 with seed 1, else uniform from 0.2 to 0.75.
pub(super) fn first_value(seed: Seed) -> f64 {
    let uniform = seed.stream("start").at(0).place(0, 0, 0).uniform();
    if seed.0 == 1 { START } else { libm::round((0.2 + (0.75 - 0.2) * uniform) * 1e4) / 1e4 }
}

/// The suite as problems of any kind.
pub fn boxed(problems: Vec<EndFrameProblem>) -> Suite {
    problems.into_iter().map(|problem| Box::new(problem) as Box<_>).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frost::Frost;

    #[test]
    fn names_are_unique_and_starts_lie_in_their_sketch() {
        let suite = suite(TSim::Whole, 1);
        let mut names: Vec<String> = suite.iter().map(Problem::name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), suite.len());
        for problem in &suite {
            let films = &problem.films;
            assert!(
                Frost::new(&films.region, &films.starts, films.parameters, Seed(1)).is_ok(),
                "{}",
                problem.name
            );
            assert_eq!(films.region.pieces().iter().max(), Some(&0), "{} is in one piece", problem.name);
            for seed in 1..20 {
                let start = problem.start(Seed(seed))[0];
                assert!(start > DOMAIN.0 && start < DOMAIN.1);
            }
        }
    }

    /// The first row of Table 1 as the reconstruction has it: frame 164 (results/amano/table-1).
    #[test]
    fn the_papers_table_is_the_reconstructions() {
        let table = &tables(TSim::Whole)[0];
        assert_eq!(table.measure(&[0.25], Seed(1)).unwrap().residual, Some(34.0));
        assert_eq!(table.start(Seed(5)), [0.25]);
    }

    #[test]
    fn a_film_is_grown_once_whoever_asks() {
        let suite = suite(TSim::Interpolated, 1);
        let of = |name: &str| suite.iter().find(|problem| problem.name == name).unwrap();
        let (slow, fast) = (of("disc-0.8-100"), of("disc-0.8-60"));
        let ends: Vec<f64> = [1, 1, 2].iter().map(|seed| slow.t_sim(0.5, Seed(*seed)).unwrap()).collect();
        assert_eq!(fast.t_sim(0.5, Seed(1)).unwrap(), ends[0]);
        assert_eq!((ends[0] == ends[1], ends[0] == ends[2], slow.films.count()), (true, false, 2));
        // Without a threshold the seed does not matter.
        let even = of("disc-0-100");
        assert_eq!(even.t_sim(0.5, Seed(1)).unwrap(), even.t_sim(0.5, Seed(2)).unwrap());
        assert_eq!(even.films.count(), 1);
    }

    /// Twice as fine a sketch has about four times the cells, and its film about as many frames.
    #[test]
    fn a_finer_sketch_is_the_same_sketch() {
        for (coarse, fine) in suite(TSim::Whole, 1).iter().zip(&suite(TSim::Whole, 2)).skip(2).step_by(4) {
            let ratio = fine.films.region.len() as f64 / coarse.films.region.len() as f64;
            assert!((3.4..4.4).contains(&ratio), "{}: {ratio}", coarse.name);
            let ends = [coarse, fine].map(|problem| problem.t_sim(0.5, Seed(1)).unwrap());
            assert!((ends[1] / ends[0] - 1.0).abs() < 0.35, "{}: {ends:?}", coarse.name);
        }
    }
}
