//! The contest as a whole: what is counted, how trials end, what is told of them.

use argmin::core::{CostFunction, Error, Gradient, Hessian};

use super::oracle::Oracle;
use super::*;
use crate::rng::Seed;

/// (x - 1)² + 2 (y - 2)² over a box, or x - 1 as a residual in one dimension.
struct Bowl {
    dimension: usize,
}

impl Problem for Bowl {
    fn name(&self) -> String {
        format!("bowl-{}", self.dimension)
    }

    fn domain(&self) -> Vec<(f64, f64)> {
        vec![(-4.0, 4.0); self.dimension]
    }

    fn start(&self, _seed: Seed) -> Vec<f64> {
        vec![-3.0; self.dimension]
    }

    fn scale(&self) -> f64 {
        100.0
    }

    fn difference(&self) -> f64 {
        1e-3
    }

    fn targets(&self) -> Vec<Target> {
        vec![Target::within(2.0), Target::within(0.5), Target::within(0.0)]
    }

    fn measure(&self, x: &[f64], _seed: Seed) -> Result<Measure, Error> {
        Ok(match x {
            [x] => Measure::of_residual(x - 1.0),
            [x, y] => Measure::of_cost((x - 1.0) * (x - 1.0) + 2.0 * (y - 2.0) * (y - 2.0)),
            _ => return Err(Error::msg("one or two")),
        })
    }
}

fn trial(budget: u64, solve: impl Fn(&Oracle<'_>) -> Result<String, Error> + Send + Sync + 'static) -> Trial {
    let entrant = Entrant::new("tried", Family::Direct, "", solve);
    Trial::run(&Bowl { dimension: 1 }, &entrant, Seed(1), budget)
}

#[test]
fn an_evaluation_is_counted_once_and_the_budget_ends_it() {
    let tried = trial(5, |oracle| {
        for k in 0.. {
            for _ in 0..3 {
                oracle.evaluate(&[0.1 * f64::from(k)])?;
            }
        }
        Ok(String::new())
    });
    assert_eq!((tried.log.len(), tried.status), (5, Status::Budget));
    // 0, 0.1, ...: the first is within 2 of the root, the fifth not yet within 0.5.
    assert_eq!(tried.runtime(tried.targets[0]).evaluations, 1);
    let arrival = tried.runtime(tried.targets[1]);
    assert_eq!((arrival.evaluations, arrival.status.name()), (5, "budget"));
    assert_eq!((tried.arrival(tried.targets[0]), tried.arrival(tried.targets[1])), (Some(1), None));
    assert_eq!(tried.start_cost, Some(16.0));
}

#[test]
fn the_last_target_ends_it_though_more_was_allowed() {
    let tried = trial(5, |oracle| {
        for x in [0.0, 1.0, 2.0] {
            oracle.evaluate(&[x])?;
        }
        Ok("went on".to_owned())
    });
    assert_eq!((tried.log.len(), tried.status), (2, Status::Reached));
    assert!(tried.targets.iter().all(|target| tried.runtime(*target).reason.is_empty()));
}

/// Whatever a solver does is a row with its reason.
#[test]
fn every_end_has_its_name() {
    type Solve = fn(&Oracle<'_>) -> Result<String, Error>;
    let ends: [(Solve, Status, &str); 8] = [
        (|_| Ok("had no idea".to_owned()), Status::Silent, "had no idea"),
        (|o| o.evaluate(&[0.0]).map(|_| "content".to_owned()), Status::Stopped, "content"),
        (|o| o.evaluate(&[f64::NAN]).map(|_| String::new()), Status::LeftDomain, "x is not finite"),
        (|o| o.evaluate(&[0.0, 0.0]).map(|_| String::new()), Status::LeftDomain, "x is not finite"),
        (|o| o.evaluate(&[9.0]).map(|_| "far away".to_owned()), Status::LeftDomain, "far away"),
        (|_| Err(Error::msg("broke  in\ntwo")), Status::Error, "broke in two"),
        (|_| panic!("a solver's own fault"), Status::Error, "panicked"),
        (
            |o| loop {
                o.evaluate(&[0.0])?;
            },
            Status::Stalled,
            "asks for what it knows",
        ),
    ];
    for (solve, status, reason) in ends {
        let tried = trial(5, solve);
        assert_eq!((tried.status, tried.reason.as_str()), (status, reason));
    }
    let hidden = trial(5, |o| {
        o.residual(&[0.0])?;
        o.residual(&[0.5])?;
        Ok("residuals are answered".to_owned())
    });
    assert_eq!(hidden.log.len(), 2);
}

#[test]
fn who_has_no_form_for_a_problem_is_named_and_does_not_count() {
    let one = Entrant::new("one", Family::Bracket, "", |o| o.evaluate(&[0.0]).map(|_| String::new()));
    let contest = Contest::new(vec![Box::new(Bowl { dimension: 2 })], vec![one.in_one_dimension()]);
    let trials = contest.run();
    let reason = "has no form for 2 dimensions";
    assert_eq!((trials[0].status, trials[0].reason.as_str()), (Status::Inapplicable, reason));
    assert!(
        standings(&trials, &Seed(1).stream("b").at(0)).is_empty() && data_profile(&trials, 0.1).is_empty()
    );
}

/// By hand: at 6 the nearest x inside is 4, where the cost is 9; 2 of a width of 8 outside cost 100 (1/4)² more.
#[test]
fn outside_of_the_box_distance_is_charged() {
    let problem = Bowl { dimension: 1 };
    let oracle = Oracle::new(&problem, Seed(1), 9);
    assert_eq!(oracle.evaluate(&[6.0]).unwrap(), 9.0 + 100.0 / 16.0);
    let tried = trial(9, |o| o.evaluate(&[6.0]).and_then(|_| o.evaluate(&[4.0])).map(|_| String::new()));
    assert_eq!((tried.best_so_far(), tried.best().unwrap().inside), (vec![15.25, 9.0], true));
}

/// The unit box: x = -4 + 8 u, costs in hundreds. By hand for the bowl in two dimensions.
#[test]
fn derivatives_in_the_unit_box_are_those_by_hand() {
    let problem = Bowl { dimension: 2 };
    let oracle = Oracle::new(&problem, Seed(1), 99);
    let view = oracle.unit();
    assert_eq!(view.start(), [0.125, 0.125]);
    assert_eq!(view.cost(&vec![0.5, 0.5]).unwrap(), 0.09);
    // d/du of ((8u - 5)² + 2 (8u' - 6)²) / 100 at 1/2, and the forward difference's half second derivative times h.
    let gradient = view.gradient(&vec![0.5, 0.5]).unwrap();
    for (measured, (slope, bend)) in gradient.iter().zip([(-0.16, 1.28), (-0.64, 2.56)]) {
        assert!((measured - (slope + 0.5 * bend * 1e-3)).abs() < 1e-9, "{measured}");
    }
    let before = oracle.budget_left();
    let hessian = view.hessian(&vec![0.5, 0.5]).unwrap();
    assert_eq!(before - oracle.budget_left(), 3, "the gradient's differences are known already");
    assert!((hessian[0][0] - 1.28).abs() < 1e-6 && (hessian[1][1] - 2.56).abs() < 1e-6);
    assert!(hessian[0][1].abs() < 1e-6 && hessian[0][1] == hessian[1][0]);
    // At the upper face the difference is taken backward: no question outside.
    view.gradient(&vec![1.0, 1.0]).unwrap();
    let (log, _) = oracle.into_log();
    assert!(log.iter().all(|evaluation| evaluation.inside));
}

#[test]
fn a_simplex_stays_in_the_box() {
    let problem = Bowl { dimension: 2 };
    let oracle = Oracle::new(&problem, Seed(1), 9);
    assert_eq!(oracle.unit().simplex(0.1), [vec![0.125, 0.125], vec![0.225, 0.125], vec![0.125, 0.225]]);
}

fn landscape(residual: &[f64]) -> Landscape {
    let x = (0..residual.len()).map(|k| k as f64 - 4.0).collect();
    Landscape { x, residual: residual.to_vec() }
}

/// Costs 9 4 5 2 2 3 0 7: bottoms at the second, the level fourth and fifth, and the seventh point.
#[test]
fn a_landscape_knows_its_basins() {
    let land = landscape(&[9.0, 4.0, 5.0, 2.0, -2.0, -3.0, 0.0, 7.0]);
    assert_eq!(land.basins(), [(1, 1), (3, 4), (6, 6)]);
    assert_eq!(land.optimum(), Some((2.0, 0.0)));
    assert!((land.rising() - 3.0 / 7.0).abs() < 1e-15, "{}", land.rising());
    assert_eq!(landscape(&[3.0, 3.0, 2.0]).level(), 0.5);
}

#[test]
fn a_trial_is_ranked_by_where_it_could_have_walked() {
    // Problem x - 1 on this grid, but ranks ask the landscape only.
    let land = landscape(&[9.0, 4.0, 5.0, 2.0, -2.0, -3.0, 0.0, 7.0]);
    let ended_at = |x: f64, cost: f64| {
        let mut tried = trial(5, |o| o.evaluate(&[0.0]).map(|_| String::new()));
        tried.log = vec![Evaluation { x: vec![x], cost, inside: true }];
        land.rank(&tried)
    };
    assert_eq!(ended_at(2.0, 0.0), Rank::Best);
    assert_eq!(ended_at(-3.0, 16.0), Rank::Basin);
    assert_eq!(ended_at(-1.0, 4.0), Rank::Basin);
    assert_eq!(ended_at(-4.0, 81.0), Rank::Stuck, "downhill there is 4");
    assert_eq!(ended_at(1.0, 9.0), Rank::Stuck, "next to it there is 0");
    assert_eq!(land.rank(&trial(5, |_| Ok(String::new()))), Rank::Nothing);
}

fn three_trials() -> Vec<Trial> {
    let ended = |name: &str, costs: &[f64], seed: u64| Trial {
        problem: "p".to_owned(),
        solver: name.to_owned(),
        seed,
        dimension: 1,
        targets: vec![Target::within(2.0), Target::within(0.5)],
        start_cost: Some(100.0),
        log: costs.iter().map(|c| Evaluation { x: vec![*c], cost: *c, inside: true }).collect(),
        status: Status::Stopped,
        reason: "content".to_owned(),
    };
    vec![
        ended("a", &[100.0, 3.0, 0.2], 1),
        ended("a", &[100.0, 50.0], 2),
        ended("b", &[100.0, 90.0, 80.0, 4.0], 1),
        ended("b", &[100.0, 0.1], 2),
    ]
}

/// By hand: a meets 2 after 2 evaluations and misses it once with 2, so 4 for one success.
#[test]
fn standings_are_those_by_hand() {
    let all = standings(&three_trials(), &Seed(1).stream("b").at(0));
    let of = |solver: &str, target: f64| {
        let one = all.iter().find(|s| s.solver == solver && s.target == target).unwrap();
        (one.reached, one.trials, one.expected_runtime)
    };
    assert_eq!(of("a", 2.0), (1, 2, Some(4.0)));
    assert_eq!(of("b", 2.0), (2, 2, Some(3.0)));
    assert_eq!(of("b", 0.5), (1, 2, Some(6.0)));
    let pair = &pairs(&three_trials(), 0)[0];
    // Seed 1: 2 against 4; seed 2: never against 2.
    assert_eq!((pair.ranks.w_plus, pair.ranks.w_minus), (2.0, 1.0));
    assert!(summary(&three_trials()).contains("b                        2        2/2      3.0"));
}

/// By hand: the least of seed 1 is 0.2, a tenth of the way from 100 is left at 10.18.
#[test]
fn data_profiles_are_those_by_hand() {
    let profile = data_profile(&three_trials(), 0.1);
    assert_eq!(profile[0], ("a".to_owned(), vec![Some(1.0), None]));
    assert_eq!(profile[1], ("b".to_owned(), vec![Some(2.0), Some(1.0)]));
}

#[test]
fn the_export_has_what_iohprofiler_wants() {
    let entrants = vec![Entrant::new("a", Family::Direct, "says \"how\"", |_| Ok(String::new()))];
    let files = export("suite", &["p".to_owned()], &entrants, &three_trials());
    let paths: Vec<&str> = files.iter().map(|file| file.0.as_str()).collect();
    assert_eq!(paths, ["a/IOHprofiler_f1_p.json", "a/data_f1_p/IOHprofiler_f1_DIM1.dat"]);
    let meta: serde_json::Value = serde_json::from_str(&files[0].1).unwrap();
    assert_eq!(meta["scenarios"][0]["path"], "data_f1_p/IOHprofiler_f1_DIM1.dat");
    assert_eq!(meta["scenarios"][0]["runs"][0]["best"]["evals"], 3);
    assert_eq!(meta["scenarios"][0]["runs"].as_array().unwrap().len(), 2);
    assert_eq!(meta["algorithm"]["info"], "says \"how\"");
    let data =
        "evaluations raw_y x0\n1 100 100\n2 3 3\n3 0.2 0.2\nevaluations raw_y x0\n1 100 100\n2 50 50\n";
    assert_eq!(files[1].1, data);
}
