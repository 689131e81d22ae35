//! The field: every solver that takes part, with its settings.
//!
//! Settings are the solvers' own defaults or usual textbook values; none was tuned on frost. One was mended on the control:
//! BFGS has a line search for Wolfe's conditions, without which its matrix need not stay positive. All solvers but those that work on T itself see the unit box and costs in units of the problem's scale.

use argmin::core::{CostFunction, Error, IterState, PopulationState};
use argmin::solver::brent::{BrentOpt, BrentRoot};
use argmin::solver::conjugategradient::NonlinearConjugateGradient;
use argmin::solver::conjugategradient::beta::PolakRibiere;
use argmin::solver::goldensectionsearch::GoldenSectionSearch;
use argmin::solver::gradientdescent::SteepestDescent;
use argmin::solver::linesearch::condition::ArmijoCondition;
use argmin::solver::linesearch::{BacktrackingLineSearch, HagerZhangLineSearch, MoreThuenteLineSearch};
use argmin::solver::neldermead::NelderMead;
use argmin::solver::newton::NewtonCG;
use argmin::solver::particleswarm::{Particle, ParticleSwarm};
use argmin::solver::quasinewton::{BFGS, LBFGS, SR1TrustRegion};
use argmin::solver::simulatedannealing::{SATempFunc, SimulatedAnnealing};
use argmin::solver::trustregion::{Steihaug, TrustRegion};
use rand_chacha::ChaCha8Rng;

use super::entrant::{Entrant, Family};
use super::oracle::Oracle;
use super::view::View;
use crate::optimize::fixed_step::FLAT;
use crate::optimize::{Bisection, CmaEs, Derivative, FixedStep, FixedStepDescent, RandomSearch, Secant};

type Vector = Vec<f64>;
type Matrix = Vec<Vector>;
/// A state with a point, a gradient, a Jacobian's place left empty, and a matrix.
type Smooth<H> = IterState<Vector, Vector, (), H, (), f64>;
type Plain = IterState<Vector, (), (), (), (), f64>;
type Number = IterState<f64, (), (), (), (), f64>;

/// The eta of the paper's tables (Amano §4), in x per frame².
const ETA: f64 = 1e-6;
/// Armijo's constant and the factor of a backtracking step: as in Nocedal & Wright, Numerical Optimization, 2006.
const ARMIJO: f64 = 1e-4;
const BACKTRACKING: f64 = 0.5;
/// Pairs that L-BFGS remembers: a usual number.
const MEMORY: usize = 7;
/// Radii of the trust region, in widths of the box.
const RADIUS: (f64, f64) = (0.1, 0.5);
/// How far the first simplex and the first samples reach, in widths of the box.
const REACH: f64 = 0.1;
/// The first sigma of CMA-ES, a quarter of the box's width, as Hansen's tutorial advises.
const SIGMA: f64 = 0.25;
/// Where a bracket is as narrow as a difference is wide, nothing more can be told.
const NARROW: f64 = 1e-6;
/// The swarm: Clerc & Kennedy's constriction as in SPSO-2007 (1/(2 ln 2) and 1/2 + ln 2).
const SWARM: (usize, f64, f64) = (10, 0.721_347_520_444_481_7, 1.193_147_180_559_945_3);
/// The first temperature, in units of the problem's scale.
const TEMPERATURE: f64 = 0.1;

/// Every solver that takes part, family by family.
pub fn field() -> Vec<Entrant> {
    use Family::{Bracket, Direct, Gradient, Random};
    let line_search = "first step 1";
    vec![
        Entrant::new(
            "paper",
            Gradient,
            "Eq. (3): fixed step, eta 1e-6 on x and f as they are; slope between the last two iterates, in several dimensions forward differences",
            paper,
        ),
        Entrant::new(
            "steepest-backtracking",
            Gradient,
            &format!("Armijo {ARMIJO}, steps halved, {line_search}"),
            |oracle| descend(oracle, SteepestDescent::new(backtracking()?)),
        ),
        Entrant::new(
            "steepest-more-thuente",
            Gradient,
            &format!("argmin's defaults, {line_search}"),
            |oracle| descend(oracle, SteepestDescent::new(more_thuente())),
        ),
        Entrant::new(
            "steepest-hager-zhang",
            Gradient,
            &format!("argmin's defaults, {line_search}"),
            |oracle| descend(oracle, SteepestDescent::new(hager_zhang())),
        ),
        Entrant::new(
            "nonlinear-cg",
            Gradient,
            "Polak-Ribière, Moré-Thuente, restart after 10 iterations",
            |oracle| {
                let view = oracle.unit();
                let solver =
                    NonlinearConjugateGradient::new(more_thuente(), PolakRibiere::new()).restart_iters(10);
                oracle.run(view, solver, |state: Smooth<()>| {
                    state.param(view.start()).max_iters(oracle.patience())
                })
            },
        ),
        Entrant::new("l-bfgs", Gradient, &format!("Moré-Thuente, {MEMORY} pairs"), |oracle| {
            let view = oracle.unit();
            let solver = LBFGS::new(more_thuente(), MEMORY);
            oracle
                .run(view, solver, |state: Smooth<()>| state.param(view.start()).max_iters(oracle.patience()))
        }),
        Entrant::new("bfgs", Gradient, "Moré-Thuente, first matrix the identity", |oracle| {
            let view = oracle.unit();
            let solver = BFGS::new(more_thuente());
            let identity = identity(view.start().len());
            oracle.run(view, solver, |state: Smooth<Matrix>| {
                state.param(view.start()).inv_hessian(identity).max_iters(oracle.patience())
            })
        }),
        Entrant::new("newton-cg", Gradient, "Moré-Thuente, Hessian by second differences", |oracle| {
            let view = oracle.unit();
            let solver = NewtonCG::new(more_thuente());
            oracle.run(view, solver, |state: Smooth<Matrix>| {
                state.param(view.start()).max_iters(oracle.patience())
            })
        }),
        Entrant::new(
            "trust-region",
            Gradient,
            "Steihaug, radius 0.1 to 0.5, Hessian by second differences",
            |oracle| {
                let view = oracle.unit();
                let steihaug: Steihaug<Vector, f64> = Steihaug::new().with_max_iters(20);
                let solver = TrustRegion::new(steihaug).with_radius(RADIUS.0)?.with_max_radius(RADIUS.1)?;
                oracle.run(view, solver, |state: Smooth<Matrix>| {
                    state.param(view.start()).max_iters(oracle.patience())
                })
            },
        ),
        Entrant::new(
            "sr1-trust-region",
            Gradient,
            "Steihaug, radius 0.1, first matrix by second differences",
            |oracle| {
                let view = oracle.unit();
                let steihaug: Steihaug<Vector, f64> = Steihaug::new().with_max_iters(20);
                let solver = SR1TrustRegion::new(steihaug).with_radius(RADIUS.0);
                oracle.run(view, solver, |state: Smooth<Matrix>| {
                    state.param(view.start()).max_iters(oracle.patience())
                })
            },
        ),
        Entrant::new("golden-section", Bracket, "the whole box", |oracle| {
            let line = oracle.unit().line();
            let solver = GoldenSectionSearch::new(0.0, 1.0)?.with_tolerance(NARROW)?;
            let start = oracle.unit().start()[0];
            oracle.run(line, solver, |state: Number| state.param(start).max_iters(oracle.patience()))
        })
        .in_one_dimension(),
        Entrant::new("brent-minimum", Bracket, "the whole box", |oracle| {
            let solver = BrentOpt::new(0.0, 1.0).set_tolerance(NARROW, NARROW);
            oracle.run(oracle.unit().line(), solver, |state: Number| state.max_iters(oracle.patience()))
        })
        .in_one_dimension(),
        Entrant::new("brent-root", Bracket, "root of T - target, the whole box", |oracle| {
            let solver = BrentRoot::new(0.0, 1.0, NARROW);
            oracle.run(oracle.unit().root(), solver, |state: Number| state.max_iters(oracle.patience()))
        })
        .in_one_dimension(),
        Entrant::new("bisection", Bracket, "root of T - target, the whole box", |oracle| {
            let solver = Bisection::new(0.0, 1.0);
            oracle.run(oracle.unit().line(), solver, |state: Number| state.max_iters(oracle.patience()))
        })
        .in_one_dimension(),
        Entrant::new(
            "secant",
            Direct,
            "root of T - target, second point a difference beside the start",
            |oracle| {
                let view = oracle.unit();
                let start = view.start()[0];
                let solver = Secant::new(start + oracle.difference(), (f64::NEG_INFINITY, f64::INFINITY));
                oracle
                    .run(view.line(), solver, |state: Number| state.param(start).max_iters(oracle.patience()))
            },
        )
        .in_one_dimension(),
        Entrant::new("nelder-mead", Direct, "argmin's defaults, simplex of 0.1 at the start", |oracle| {
            let view = oracle.unit();
            let simplex = view.simplex(REACH);
            for corner in &simplex {
                view.cost(corner)?; // argmin's first questions would turn an error into a panic
            }
            let solver = NelderMead::new(simplex).with_sd_tolerance(1e-12)?;
            oracle.run(view, solver, |state: Plain| state.max_iters(oracle.patience()))
        }),
        Entrant::new("random-search", Random, "uniform in the box after the start", |oracle| {
            let view = oracle.unit();
            let (low, high) = view.corners();
            let solver =
                RandomSearch::new(low.into_iter().zip(high).collect(), oracle.stream("random search").at(0));
            oracle.run(view, solver, |state: Plain| state.param(view.start()).max_iters(oracle.patience()))
        }),
        Entrant::new(
            "simulated-annealing",
            Random,
            "temperature 0.1/i, uniform steps of its square root, hot again after 20 without a better",
            anneal,
        ),
        Entrant::new(
            "particle-swarm",
            Random,
            "10 particles, the first at the start; inertia 0.721, pulls 1.193",
            swarm,
        ),
        Entrant::new("cma-es", Random, "Hansen's defaults, sigma 0.25 of the box", |oracle| {
            let view = oracle.unit();
            let (low, high) = view.corners();
            let solver = CmaEs::new(SIGMA, low.into_iter().zip(high).collect(), oracle.stream("cma-es"));
            oracle.run(view, solver, |state: Plain| state.param(view.start()).max_iters(oracle.patience()))
        }),
    ]
}

/// The paper's rule: Eq. (3) with the eta of its tables.
fn paper(oracle: &Oracle) -> Result<String, Error> {
    let view = oracle.native();
    if let ([start], [face]) = (oracle.start(), oracle.domain()) {
        let h = oracle.difference() * (face.1 - face.0);
        let solver = FixedStepDescent::new(ETA, Derivative::Secant, h, (f64::NEG_INFINITY, f64::INFINITY));
        let start = *start;
        return oracle.run(view.line(), solver, |state: IterState<f64, f64, (), (), (), f64>| {
            state.param(start).max_iters(oracle.patience())
        });
    }
    let solver = SteepestDescent::new(FixedStep::new(ETA));
    let run =
        oracle.run(view, solver, |state: Smooth<()>| state.param(view.start()).max_iters(oracle.patience()));
    // A line search has no other way to end the descent.
    run.or_else(|ended| if ended.to_string() == FLAT { Ok(FLAT.to_owned()) } else { Err(ended) })
}

fn backtracking() -> Result<BacktrackingLineSearch<Vector, Vector, ArmijoCondition<f64>, f64>, Error> {
    BacktrackingLineSearch::new(ArmijoCondition::new(ARMIJO)?).rho(BACKTRACKING)
}

fn more_thuente() -> MoreThuenteLineSearch<Vector, Vector, f64> {
    MoreThuenteLineSearch::new()
}

fn hager_zhang() -> HagerZhangLineSearch<Vector, Vector, f64> {
    HagerZhangLineSearch::new()
}

fn descend<'o, L>(oracle: &'o Oracle<'o>, solver: SteepestDescent<L>) -> Result<String, Error>
where
    SteepestDescent<L>: argmin::core::Solver<View<'o>, Smooth<()>>,
{
    let view = oracle.unit();
    oracle.run(view, solver, |state: Smooth<()>| state.param(view.start()).max_iters(oracle.patience()))
}

fn anneal(oracle: &Oracle) -> Result<String, Error> {
    let view = oracle.unit();
    let solver = SimulatedAnnealing::new_with_rng(TEMPERATURE, generator(oracle, "accept"))?
        .with_temp_func(SATempFunc::TemperatureFast)
        .with_reannealing_best(20);
    oracle.run(view.annealed(), solver, |state: Plain| state.param(view.start()).max_iters(oracle.patience()))
}

/// A swarm whose first particle stands at the start; the others are uniform, and all are paid for.
fn swarm(oracle: &Oracle) -> Result<String, Error> {
    let (particles, inertia, pull) = SWARM;
    let view = oracle.unit();
    let (low, high) = view.corners();
    let uniform = |moment: &crate::rng::Moment, k: usize, from: f64, to: f64| {
        let mut place = moment.place(k as i32, 0, 0);
        (0..low.len()).map(|_| from + (to - from) * place.uniform()).collect::<Vector>()
    };
    let stream = oracle.stream("swarm");
    let population: Vec<Particle<Vector, f64>> = (0..particles)
        .map(|k| {
            let place = if k == 0 { view.start() } else { uniform(&stream.at(0), k, 0.0, 1.0) };
            let cost = view.cost(&place)?;
            Ok(Particle::new(place, cost, uniform(&stream.at(1), k, -1.0, 1.0)))
        })
        .collect::<Result<_, Error>>()?;
    let solver = ParticleSwarm::new((low.clone(), high), particles)
        .with_rng_generator(generator(oracle, "pulls"))
        .with_inertia_factor(inertia)?
        .with_cognitive_factor(pull)?
        .with_social_factor(pull)?;
    oracle.run(view, solver, |state: PopulationState<Particle<Vector, f64>, f64>| {
        state.population(population).max_iters(oracle.patience())
    })
}

/// A generator for solvers that want one, from the seed and a name.
fn generator(oracle: &Oracle, name: &str) -> ChaCha8Rng {
    oracle.stream(name).at(0).generator()
}

fn identity(n: usize) -> Matrix {
    (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect()
}
