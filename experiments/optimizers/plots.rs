//! What a match leaves as plots: runtimes, data profiles, progress, and the search over the curve.

use snowglobe::lab::{Axis, Draw, Lab, Panels, Plot, Result, Series};
use snowglobe::optimize::contest::{Family, Target, Trial, data_profile, ecdf, quantile};

use super::narrow::Match;
use super::tables::Truth;

/// Accuracies of the data profiles.
const TAUS: [f64; 2] = [0.1, 0.001];

/// Keeps the plots of a match. `unit` is what the cost measures once it is raised to `power`.
pub fn keep(lab: &mut Lab, played: &Match, unit: &str, power: f64) -> Result<()> {
    if !lab.keeps() || played.trials.is_empty() {
        return Ok(());
    }
    let most = played.trials.iter().map(|trial| trial.log.len()).max().unwrap_or(1).max(2) as f64;
    let axis = || Axis::log("evaluations", 1.0, most);

    let met = met(&played.trials);
    let curves: Vec<Curve> = solvers(played, |trials| runtimes(trials, &met));
    let everyone = Series::new("best of all", Draw::Printed, runtimes_of_the_best(played, &met));
    let plots = panels(
        played,
        &curves,
        &axis(),
        &Axis::within("share of targets met", 0.0, 1.0),
        Draw::Step,
        Some(&everyone),
    );
    lab.keep(
        "ecdf",
        "Share of all (problem, seed, target) that were met within so many evaluations, solvers by family; dashed: by \
         any solver. A target that nobody met anywhere does not count",
        Panels { title: "Runtimes to all targets".to_owned(), columns: 2, plots },
    )?;

    for tau in TAUS {
        let solved = data_profile(&played.trials, tau);
        let curves: Vec<Curve> =
            solved.into_iter().map(|(name, solved)| Curve { points: share_by(&solved), name }).collect();
        let most = curves.iter().flat_map(|curve| curve.points.iter().map(|p| p.0)).fold(1.0, f64::max);
        let plots = panels(
            played,
            &curves,
            &Axis::log("simplex gradients (evaluations / (n + 1))", 0.25, most),
            &Axis::within("share solved", 0.0, 1.0),
            Draw::Step,
            None,
        );
        lab.keep(
            &format!("data-profile-{tau}"),
            &format!("Moré and Wild's data profile: share of problems and seeds brought within {tau} of the way from the \
                      start to the best that any solver found"),
            Panels { title: format!("Data profile, accuracy {tau}"), columns: 2, plots },
        )?;
    }

    let curves: Vec<Curve> = solvers(played, |trials| progress(trials, power));
    let label = format!("median of the best so far, {unit}");
    let highest = curves.iter().flat_map(|curve| curve.points.iter().map(|p| p.1)).fold(1e-9, f64::max);
    // A cost falls over many powers of ten, a miss in frames does not.
    let progress_axis =
        if power == 1.0 { Axis::log(label, 1e-9, highest) } else { Axis::within(label, 0.0, highest) };
    let plots = panels(played, &curves, &axis(), &progress_axis, Draw::Line, None);
    lab.keep(
        "best-so-far",
        "The best so far after so many evaluations, median over problems and seeds, solvers by family",
        Panels { title: "Progress".to_owned(), columns: 2, plots },
    )
}

/// A line of a plot, one for each solver.
struct Curve {
    name: String,
    points: Vec<(f64, f64)>,
}

fn solvers(played: &Match, curve: impl Fn(&[&Trial]) -> Vec<(f64, f64)>) -> Vec<Curve> {
    let of = |name: &str| played.trials.iter().filter(|trial| trial.solver == name).collect::<Vec<_>>();
    let entrants = played.contest.entrants().iter();
    entrants.map(|entrant| Curve { points: curve(&of(&entrant.name)), name: entrant.name.clone() }).collect()
}

/// A panel for each family: its solvers in colour, the others behind them.
fn panels(
    played: &Match,
    curves: &[Curve],
    x: &Axis,
    y: &Axis,
    draw: Draw,
    all: Option<&Series>,
) -> Vec<Plot> {
    let family = |name: &str| played.contest.entrants().iter().find(|e| e.name == name).map(|e| e.family);
    let of_family = |wanted: Family| curves.iter().filter(move |curve| family(&curve.name) == Some(wanted));
    Family::ALL
        .into_iter()
        .filter(|wanted| of_family(*wanted).any(|curve| !curve.points.is_empty()))
        .map(|wanted| {
            // Where there is a best of all, the other families stand behind.
            let others = curves.iter().filter(|curve| all.is_some() && family(&curve.name) != Some(wanted));
            let ghosts = others.enumerate().map(|(k, curve)| {
                let name = if k == 0 { "other families" } else { "" };
                Series::new(name, Draw::Ghost, curve.points.iter().copied())
            });
            let own =
                of_family(wanted).map(|curve| Series::new(&curve.name, draw, curve.points.iter().copied()));
            Plot {
                title: wanted.name().to_owned(),
                x: x.clone(),
                y: y.clone(),
                series: ghosts.chain(own).chain(all.cloned()).collect(),
                bands: Vec::new(),
            }
        })
        .collect()
}

/// The targets that somebody met somewhere: nobody is blamed for the others. (An interpolated end frame is never the
/// target itself.)
fn met(trials: &[Trial]) -> Vec<f64> {
    let mut met: Vec<f64> = trials
        .iter()
        .flat_map(|trial| trial.targets.iter().filter(|target| trial.arrival(**target).is_some()))
        .map(|target| target.value)
        .collect();
    met.sort_by(f64::total_cmp);
    met.dedup();
    met
}

/// The share of targets met within so many evaluations.
fn runtimes(trials: &[&Trial], met: &[f64]) -> Vec<(f64, f64)> {
    let counts = |target: &&Target| met.contains(&target.value);
    let arrivals = trials
        .iter()
        .flat_map(|trial| trial.targets.iter().filter(counts).map(|target| trial.arrival(*target)));
    ecdf(&arrivals.collect::<Vec<_>>())
        .into_iter()
        .map(|(evaluations, share)| (evaluations as f64, share))
        .collect()
}

/// The same for the solver that was first, whichever it was.
fn runtimes_of_the_best(played: &Match, met: &[f64]) -> Vec<(f64, f64)> {
    let mut best: Vec<Option<u64>> = Vec::new();
    for problem in played.contest.problems() {
        let name = problem.name();
        for seed in &played.seeds {
            let trials: Vec<&Trial> =
                played.trials.iter().filter(|t| t.problem == name && t.seed == *seed).collect();
            for target in problem.targets().into_iter().filter(|target| met.contains(&target.value)) {
                best.push(trials.iter().filter_map(|trial| trial.arrival(target)).min());
            }
        }
    }
    ecdf(&best).into_iter().map(|(evaluations, share)| (evaluations as f64, share)).collect()
}

/// The share solved within so much.
fn share_by(solved: &[Option<f64>]) -> Vec<(f64, f64)> {
    let mut times: Vec<f64> = solved.iter().copied().flatten().collect();
    times.sort_by(f64::total_cmp);
    let share = |k: usize| (k + 1) as f64 / solved.len() as f64;
    times.iter().enumerate().map(|(k, time)| (*time, share(k))).collect()
}

/// The median of the best so far; a trial that ended keeps its best.
fn progress(trials: &[&Trial], power: f64) -> Vec<(f64, f64)> {
    let histories: Vec<Vec<f64>> = trials.iter().map(|trial| trial.best_so_far()).collect();
    let most = histories.iter().map(Vec::len).max().unwrap_or(0);
    let after = |k: usize| {
        let costs: Vec<f64> =
            histories.iter().map(|h| h.get(k).or(h.last()).copied().unwrap_or(f64::INFINITY)).collect();
        quantile(&costs, 0.5)
    };
    // About two hundred points are enough for an axis of ratios.
    let mut shown: Vec<usize> =
        (0..200).map(|k| libm::pow(most as f64, f64::from(k) / 199.0) as usize).filter(|k| *k > 0).collect();
    shown.dedup();
    let points = shown.into_iter().filter(|k| *k <= most).map(|k| (k as f64, after(k - 1)));
    points
        .filter_map(|(k, median)| Some((k, libm::pow(median?, power))))
        .filter(|p| p.1.is_finite())
        .collect()
}

/// Draws every solver's search over the curve of one problem, with the first seed.
pub fn keep_searches(lab: &mut Lab, wanted: &str, played: &Match, truths: &[Truth]) -> Result<()> {
    // Of a narrowed run its first problem.
    let truth = truths.iter().find(|truth| truth.problem == wanted).or(truths.first());
    let Some(truth) = truth.filter(|_| lab.keeps()) else { return Ok(()) };
    let ends: Vec<f64> = truth.landscape.residual.iter().map(|residual| residual + truth.target).collect();
    let highest = ends.iter().copied().filter(|end| end.is_finite()).fold(truth.target, f64::max);
    let curve: Vec<(f64, f64)> = truth.landscape.x.iter().copied().zip(ends).collect();
    let end_at = |x: f64| {
        let at = curve.partition_point(|(beta, _)| *beta < x).min(curve.len() - 1);
        curve[at].1
    };
    let mine =
        played.trials.iter().filter(|trial| trial.problem == truth.problem && trial.seed == truth.seed);
    let plots = mine.map(|trial| {
        let met = trial.targets.get(1).and_then(|target| trial.arrival(*target));
        let inside = trial.log.iter().filter(|evaluation| evaluation.inside);
        // The side of the target is the curve's, the distance what was measured.
        let path = inside.map(|evaluation| {
            let (x, miss) = (evaluation.x[0], libm::sqrt(evaluation.cost));
            (x, truth.target + if end_at(x) < truth.target { -miss } else { miss })
        });
        Plot {
            title: match met {
                Some(evaluations) => format!("{}: {evaluations}", trial.solver),
                None => format!("{}: never", trial.solver),
            },
            x: Axis::within("initial value β", 0.15, 0.9),
            y: Axis::within("end frame", 0.0, highest.min(3.0 * truth.target)),
            series: vec![
                Series::new("end frame on the grid", Draw::Ghost, curve.iter().copied()),
                Series::new("evaluations: first (circle) light, last (cross) dark", Draw::Path, path),
            ],
            bands: vec![("within 4 frames of the target".to_owned(), truth.target - 4.0, truth.target + 4.0)],
        }
    });
    let plots = plots.collect();
    lab.keep(
        "searches",
        &format!("Every solver's evaluations over the end frame of {}, seed {}; the number says after how many it came \
                  within 4 frames", truth.problem, truth.seed),
        Panels { title: format!("Searches on {}", truth.problem), columns: 4, plots },
    )
}
