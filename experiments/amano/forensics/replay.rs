//! The descent again, from the printed start.

use snowglobe::frost::{Aim, Aimed, EndFrameObjective, Rule, TSim};
use snowglobe::lab::{Axis, Claim, Draw, Error, Lab, Plot, Result, Series, Table, average, maybe};
use snowglobe::optimize::Derivative;
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;

use super::super::setup::{ENDLESS, Readings, Reconstruction, START, Setup};
use super::{Printed, THREE_1, THREE_2};

/// Seeds for secants, which the digits leave, and for what is only shown beside them.
const SEEDS: (u64, u64) = (40, 20);
/// Cells by which half the sketch's width differs from what is assumed: one is 5 %, and the least that a hexagon allows.
const OFF: [i32; 3] = [-1, 0, 1];

/// How the first derivative of a search is had.
#[derive(Clone, Copy, Debug, PartialEq)]
enum First {
    /// As the rule has it: a secant begins with a forward difference.
    Own,
    /// The first step is the printed one: a secant leaves it free.
    Printed,
}

impl First {
    fn name(self) -> &'static str {
        match self {
            First::Own => "difference over h",
            First::Printed => "as printed",
        }
    }
}

/// A way to descend.
#[derive(Clone, Copy)]
struct Way {
    t_sim: TSim,
    derivative: Derivative,
    first: First,
    /// Cells by which half the width of the sketch differs from the assumed one.
    off: i32,
}

impl Way {
    fn seeds(self) -> u64 {
        if self.off == 0 && self.derivative == Derivative::Secant { SEEDS.0 } else { SEEDS.1 }
    }
}

/// One descent to run, in one table's terms.
struct Descent<'p> {
    way: Way,
    setup: Setup,
    seed: u64,
    rows: &'p [(f64, f64); 4],
}

/// How far a search takes the printed path.
struct Followed {
    /// The last printed step up to which every initial value and every end frame agrees.
    to_step: usize,
    /// Whether it has as many steps, and ends within the tolerance.
    ends_alike: bool,
    /// Whether it ends within the tolerance in as many steps or fewer.
    ends: bool,
}

pub fn run(lab: &mut Lab, printed: &Printed) -> Result<()> {
    let h = lab.assume(
        "h",
        0.01,
        "how the derivative is taken is not said; some 3 % of beta moves T by several frames",
    );
    lab.assume_that(
        "path followed",
        "every initial value within what 4 frames are worth by the table's first and last row (0.0068 and 0.0075), \
         every end frame within 4 frames, as many steps",
        "no tolerance for a path is given; the paper's, turned into an initial value",
    );
    let mut shares = Table::new([
        "threshold",
        "cells",
        "t_sim",
        "derivative",
        "first_step",
        "searches",
        "step_1_followed",
        "steps_1_and_2_followed",
        "whole_path_followed",
        "three_steps_and_end_within_4",
        "at_most_three_steps_and_end_within_4",
        "mean_beta_1",
        "deviation_of_beta_1",
        "mean_end_frame_1",
        "deviation_of_end_frame_1",
    ]);
    let mut paths = Table::new([
        "threshold",
        "cells",
        "t_sim",
        "derivative",
        "first_step",
        "seed",
        "step",
        "beta",
        "end_frame",
    ]);
    for ((threshold, rows), claim) in printed.tables.iter().zip([&THREE_1, &THREE_2]) {
        let mut shown = Vec::new();
        for way in ways(lab) {
            let mut setup = Setup::of_tables(lab, Reconstruction::DEFAULT, *threshold, Readings::DEFAULT);
            if way.off != 0 {
                let assumed = Reconstruction::DEFAULT.assumed();
                setup.region = assumed.shape.region(assumed.size + f64::from(way.off));
            }
            let seeds = if *threshold > 0.0 { lab.seeds(way.seeds()) } else { vec![lab.seed().0] };
            let descents: Vec<Descent> =
                seeds.iter().map(|seed| Descent { way, setup: setup.clone(), seed: *seed, rows }).collect();
            let searches = lab.each(&descents, |descent| descent.run(printed, h));
            let searches = searches.into_iter().collect::<Result<Vec<_>>>()?;
            let cells = setup.region.len();
            for (descent, path) in descents.iter().zip(&searches) {
                for iterate in path {
                    paths.row([
                        threshold.into(),
                        cells.into(),
                        way.t_sim.name().into(),
                        way.derivative.name().into(),
                        way.first.name().into(),
                        descent.seed.into(),
                        iterate.step.into(),
                        iterate.beta.into(),
                        maybe(iterate.end.map(|end| end.frame)),
                    ]);
                }
            }
            shares.rows.push(share(*threshold, cells, way, rows, &searches, printed));
            if way.off == 0 && way.first == First::Own {
                judge(lab, claim, way, &descents, &searches);
            }
            if way.off == 0 && (way.t_sim, way.derivative) == (TSim::Interpolated, Derivative::Secant) {
                shown.push(series(way, &searches));
            }
        }
        shown.push(Series::new("as printed", Draw::Printed, rows.iter().copied()));
        lab.keep(
            &format!("paths-{threshold}"),
            &format!(
                "Descents by the secant of the interpolated end frame at threshold {threshold}: end frame and initial \
                 value of every iterate, over all seeds, and the printed path"
            ),
            Plot {
                title: format!("The printed path again, r_th {threshold}"),
                x: Axis::of("initial value β"),
                y: Axis::of("end frame"),
                series: shown,
                bands: vec![(
                    "130 ± 4".to_owned(),
                    printed.target - printed.tolerance,
                    printed.target + printed.tolerance,
                )],
            },
        )?;
    }
    lab.keep("shares", "The share of searches that take the printed path, by rule and size", shares)?;
    lab.keep("paths", "Every iterate of every search", paths)
}

/// All readings at the assumed size, begun as they are; secants once more from the printed first step; and the secant
/// of the interpolated end frame at the other sizes.
fn ways(lab: &Lab) -> Vec<Way> {
    let mut ways = Vec::new();
    for t_sim in lab.readings::<TSim>() {
        for derivative in lab.readings::<Derivative>() {
            ways.push(Way { t_sim, derivative, first: First::Own, off: 0 });
            if derivative != Derivative::Secant {
                continue;
            }
            ways.push(Way { t_sim, derivative, first: First::Printed, off: 0 });
            if t_sim == TSim::Interpolated {
                let others = OFF.iter().filter(|off| **off != 0);
                ways.extend(others.flat_map(|off| {
                    [First::Own, First::Printed].map(|first| Way { t_sim, derivative, first, off: *off })
                }));
            }
        }
    }
    ways
}

impl Descent<'_> {
    fn run(&self, printed: &Printed, h: f64) -> Result<Vec<Aimed>> {
        let objective = EndFrameObjective {
            region: &self.setup.region,
            starts: &START,
            parameters: self.setup.parameters,
            seed: Seed(self.seed),
            rule: self.setup.rule,
            target: printed.target,
            t_sim: self.way.t_sim,
            h,
            frame_limit: ENDLESS,
        };
        let path = match self.way.first {
            First::Own => objective
                .descend(&Aim {
                    start: self.rows[0].0,
                    eta: printed.eta,
                    tolerance: printed.tolerance,
                    derivative: self.way.derivative,
                    h,
                    iterations: self.rows.len() as u64 - 1,
                })
                .map(|search| search.iterates),
            First::Printed => self.after_printed_step(&objective, printed),
        };
        path.map_err(|cause| Error::broken(cause.to_string()))
    }

    /// x_0 and x_1 as printed, then secants of our own end frames.
    fn after_printed_step(
        &self,
        objective: &EndFrameObjective,
        printed: &Printed,
    ) -> std::result::Result<Vec<Aimed>, argmin::core::Error> {
        let mut path: Vec<Aimed> = Vec::new();
        let mut last: Option<(f64, f64)> = None;
        let mut beta = self.rows[0].0;
        for step in 0..self.rows.len() as u64 {
            let end = objective.end_frame(beta)?;
            path.push(Aimed { rule: Rule::Descent, step, beta, end });
            let Some(end) = end else { break };
            let number = match self.way.t_sim {
                TSim::Whole => end.frame as f64,
                TSim::Interpolated => end.interpolated,
            };
            let miss = number - printed.target;
            if miss.abs() <= printed.tolerance {
                break;
            }
            let f = miss * miss;
            let next = match last {
                None => self.rows[1].0,
                Some((before, f_before)) => beta - printed.eta * (f - f_before) / (beta - before),
            };
            if !(next > 0.0 && next < 1.0) || next == beta {
                break;
            }
            last = Some((beta, f));
            beta = next;
        }
        Ok(path)
    }
}

fn follow(path: &[Aimed], rows: &[(f64, f64); 4], printed: &Printed) -> Followed {
    let worth = printed.tolerance * (rows[3].0 - rows[0].0) / (rows[0].1 - rows[3].1);
    let near = |(iterate, row): (&Aimed, &(f64, f64))| {
        let end = iterate.end.map_or(f64::INFINITY, |end| end.frame as f64);
        (iterate.beta - row.0).abs() <= worth && (end - row.1).abs() <= printed.tolerance
    };
    let agree = path.iter().zip(rows).take_while(|pair| near(*pair)).count();
    let end = path.last().and_then(|last| last.end).map_or(f64::INFINITY, |end| end.frame as f64);
    let ends = (end - printed.target).abs() <= printed.tolerance;
    Followed { to_step: agree.saturating_sub(1), ends_alike: ends && path.len() == rows.len(), ends }
}

fn share(
    threshold: f64,
    cells: usize,
    way: Way,
    rows: &[(f64, f64); 4],
    searches: &[Vec<Aimed>],
    printed: &Printed,
) -> Vec<String> {
    let all: Vec<Followed> = searches.iter().map(|path| follow(path, rows, printed)).collect();
    let part = |is: &dyn Fn(&Followed) -> bool| {
        (all.iter().filter(|followed| is(followed)).count() as f64 / all.len() as f64).to_string()
    };
    let firsts = |of: &dyn Fn(&Aimed) -> Option<f64>| -> Vec<f64> {
        searches.iter().filter_map(|path| path.get(1)).filter_map(of).collect()
    };
    let betas = firsts(&|iterate| Some(iterate.beta));
    let ends = firsts(&|iterate| iterate.end.map(|end| end.frame as f64));
    let mean = |all: &[f64]| if all.is_empty() { String::new() } else { average(all).to_string() };
    let deviation = |all: &[f64]| {
        let squares: Vec<f64> = all.iter().map(|x| (x - average(all)) * (x - average(all))).collect();
        if all.len() < 2 { String::new() } else { libm::sqrt(average(&squares)).to_string() }
    };
    vec![
        threshold.to_string(),
        cells.to_string(),
        way.t_sim.name().to_owned(),
        way.derivative.name().to_owned(),
        way.first.name().to_owned(),
        searches.len().to_string(),
        part(&|followed| followed.to_step >= 1),
        part(&|followed| followed.to_step >= 2),
        part(&|followed| followed.to_step >= 3 && followed.ends_alike),
        part(&|followed| followed.ends_alike),
        part(&|followed| followed.ends),
        mean(&betas),
        deviation(&betas),
        mean(&ends),
        deviation(&ends),
    ]
}

/// The end frame of the last of at most three steps.
fn judge(lab: &mut Lab, claim: &'static Claim, way: Way, descents: &[Descent], searches: &[Vec<Aimed>]) {
    Readings::DEFAULT.tell(lab, Reconstruction::DEFAULT);
    lab.reading(way.t_sim);
    lab.reading(way.derivative);
    for (descent, path) in descents.iter().zip(searches) {
        let end = path.last().and_then(|last| last.end).map(|end| end.frame as f64);
        lab.found_with(claim, descent.seed, end);
    }
    lab.count("searches", searches.len() as u64);
}

fn series(way: Way, searches: &[Vec<Aimed>]) -> Series {
    let one = searches.len() == 1;
    let points = searches
        .iter()
        .flatten()
        .filter(|iterate| iterate.step > 0 || one) // all seeds start from one value
        .filter_map(|iterate| Some((iterate.beta, iterate.end?.frame as f64)));
    let draw = if one { Draw::Joined } else { Draw::Dots };
    Series::new(format!("first step {}", way.first.name()), draw, points)
}
