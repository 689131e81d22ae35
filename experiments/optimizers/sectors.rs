//! Frost in several dimensions: an initial value for each sector around the start.

use snowglobe::frost::{GROUND, Painter, titled};
use snowglobe::image::Picture;
use snowglobe::lab::{Error, Experiment, Lab, Mutant, Result, Table, maybe};
use snowglobe::optimize::contest::{Budget, Trial};
use snowglobe::problems::sectors::{self, DOMAIN, SECTORS as COUNTS, SectorProblem, TARGET, THRESHOLDS};
use snowglobe::problems::{Suite, sectors::boxed};
use snowglobe::rng::Seed;

use super::claims::{MORE_IS_BETTER, ONE_IS_NOT_ENOUGH, TWELVE_ARE_EVEN, TWELVE_ARE_RAGGED};
use super::{narrow, plots, tables};

pub const SECTORS: Experiment = Experiment {
    id: "sectors",
    title: "An initial value for each direction",
    source: "Amano §5, outlook",
    says: "The authors want the initial value to depend on the direction from the start, so that ice is at the border \
           everywhere at the same time. Here it does, in 2, 3, 6 and 12 sectors, on a sketch whose start lies far from \
           its middle.",
    claims: &[&ONE_IS_NOT_ENOUGH, &TWELVE_ARE_EVEN, &TWELVE_ARE_RAGGED, &MORE_IS_BETTER],
    run,
    mutant: Mutant {
        changes: "budget for each dimension and one more",
        to: 1.0,
        why: "thirteen films are not enough to find twelve numbers",
        turns_red: &["optimizers/sectors/twelve-are-enough-0"],
    },
};

const SEEDS: u64 = 2;
/// Steps of the grid of a single initial value.
const GRID: u32 = 300;

/// The suite.
pub fn problems() -> Suite {
    boxed(sectors::suite())
}

/// The best that was found with so many sectors.
struct Found {
    threshold: f64,
    sectors: usize,
    solver: String,
    seed: u64,
    betas: Vec<f64>,
    miss: f64,
}

fn run(lab: &mut Lab) -> Result<()> {
    let each = lab.assume(
        "budget for each dimension and one more",
        40.0,
        "evaluations: 520 in twelve dimensions, with which gradients can be taken forty times",
    );
    lab.assume_that(
        "sketch",
        "a disc of 325 cells, its start half way from the middle to the edge",
        "chosen because one initial value cannot do it",
    );
    lab.assume_that(
        "objective",
        "mean over twelve directions of (T_d - T)^2, T_d the frame in which 90 % of the border there is ice",
        "the outlook names the aim and no objective; 90 % is §3.4's",
    );
    let played = narrow::run(lab, problems(), SEEDS, Budget::PerDimension(each as u64))?;
    if !lab.is_narrowed() {
        let found = best_of_all(lab, &played.trials)?;
        judge(lab, &found);
        keep_found(lab, &found)?;
        keep_pictures(lab, &found)?;
    }
    tables::keep(lab, SECTORS.id, &played, &[])?;
    plots::keep(lab, &played, "frames", 0.5)
}

/// With each threshold the best of one value on a grid, and of several by any solver.
fn best_of_all(lab: &mut Lab, trials: &[Trial]) -> Result<Vec<Found>> {
    let mut found = Vec::new();
    for threshold in THRESHOLDS {
        let one = problem(1, threshold)?;
        let steps = lab.pick(GRID, 4);
        let betas: Vec<f64> = (0..=steps)
            .map(|k| {
                libm::round((DOMAIN.0 + (DOMAIN.1 - DOMAIN.0) * f64::from(k) / f64::from(steps)) * 1e9) / 1e9
            })
            .collect();
        let misses = lab.each(&betas, |beta| one.misses(&[*beta], lab.seed()).map(|m| m.root_mean_square()));
        let misses = misses.into_iter().collect::<std::result::Result<Vec<f64>, _>>();
        let misses = misses.map_err(|cause| Error::broken("cannot grow frost").because(cause))?;
        let best = betas.iter().zip(misses).min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((beta, miss)) = best {
            let seed = lab.seed().0;
            found.push(Found {
                threshold,
                sectors: 1,
                solver: "grid".to_owned(),
                seed,
                betas: vec![*beta],
                miss,
            });
        }
        for sectors in COUNTS {
            let name = format!("sectors-{sectors}-{threshold}");
            let of = trials.iter().filter(|trial| trial.problem == name && trial.seed == lab.seed().0);
            let bests = of.filter_map(|trial| Some((trial, trial.best()?)));
            if let Some((trial, best)) = bests.min_by(|a, b| a.1.cost.total_cmp(&b.1.cost)) {
                // Of an x outside of the box the nearest inside is as good.
                let betas: Vec<f64> = best.x.iter().map(|beta| beta.clamp(DOMAIN.0, DOMAIN.1)).collect();
                let misses = problem(sectors, threshold)?.misses(&betas, Seed(trial.seed));
                let miss = misses
                    .map_err(|cause| Error::broken("cannot grow frost").because(cause))?
                    .root_mean_square();
                found.push(Found {
                    threshold,
                    sectors,
                    solver: trial.solver.clone(),
                    seed: trial.seed,
                    betas,
                    miss,
                });
            }
        }
    }
    Ok(found)
}

fn problem(sectors: usize, threshold: f64) -> Result<SectorProblem> {
    SectorProblem::new(sectors, threshold).map_err(|cause| Error::broken("no such sectors").because(cause))
}

fn judge(lab: &mut Lab, found: &[Found]) {
    let of = |sectors: usize| found.iter().filter(move |f| f.sectors == sectors).map(|f| f.miss);
    lab.found(&ONE_IS_NOT_ENOUGH, of(1).fold(f64::INFINITY, f64::min));
    for (threshold, claim) in THRESHOLDS.into_iter().zip([&TWELVE_ARE_EVEN, &TWELVE_ARE_RAGGED]) {
        let twelve = found.iter().find(|f| f.threshold == threshold && f.sectors == 12);
        lab.found(claim, twelve.map(|f| f.miss));
    }
    let gains = THRESHOLDS.iter().flat_map(|threshold| {
        let misses: Vec<f64> = [1, 3, 6, 12]
            .iter()
            .filter_map(|n| found.iter().find(|f| f.threshold == *threshold && f.sectors == *n))
            .map(|f| f.miss)
            .collect();
        misses.windows(2).map(|pair| pair[0] - pair[1]).collect::<Vec<_>>()
    });
    lab.found(&MORE_IS_BETTER, gains.fold(f64::INFINITY, f64::min));
}

fn keep_found(lab: &mut Lab, found: &[Found]) -> Result<()> {
    let mut table =
        Table::new(["threshold", "sectors", "rms_miss", "greatest_miss", "found_by", "seed", "betas"]);
    let mut arrivals = Table::new(["threshold", "sectors", "direction_deg", "border_cells", "arrival"]);
    for f in found {
        let misses = problem(f.sectors, f.threshold)?
            .misses(&f.betas, Seed(f.seed))
            .map_err(|cause| Error::broken("cannot grow frost").because(cause))?;
        table.row([
            f.threshold.into(),
            f.sectors.into(),
            f.miss.into(),
            misses.greatest().into(),
            f.solver.as_str().into(),
            f.seed.into(),
            f.betas.iter().map(f64::to_string).collect::<Vec<_>>().join(";").into(),
        ]);
        for arrival in &misses.arrivals {
            arrivals.row([
                f.threshold.into(),
                f.sectors.into(),
                (arrival.direction * 30 + 15).into(),
                arrival.border.into(),
                maybe(arrival.end.map(|end| end.interpolated)),
            ]);
        }
    }
    lab.keep(
        "found",
        "The best initial values that were found with each number of sectors, first seed",
        table,
    )?;
    lab.keep(
        "arrivals",
        "When ice is at the border in each of twelve directions, with those initial values",
        arrivals,
    )
}

/// The vapour at first, and what is ice in the frame that was asked for: one value to twelve.
fn keep_pictures(lab: &mut Lab, found: &[Found]) -> Result<()> {
    const WIDTH: u32 = 330;
    for threshold in THRESHOLDS {
        let of: Vec<&Found> = found.iter().filter(|f| f.threshold == threshold).collect();
        let (mut first, mut last) = (Vec::new(), Vec::new());
        for f in &of {
            let broken = |cause| Error::broken("cannot grow frost").because(cause);
            let given = problem(f.sectors, threshold)?;
            let objective = given.objective(Seed(f.seed));
            let vapour = objective.sectors.field(&f.betas).map_err(broken)?;
            let mut frost = objective.frost(&f.betas).map_err(broken)?;
            let painter = Painter::new(objective.region, WIDTH, TARGET as u64, 1.0)?;
            let draw = |mut picture: Picture, title: &str| {
                painter.draw_sectors(&mut picture, &objective.sectors);
                titled(&picture, title)
            };
            let plural = if f.sectors == 1 { "one value" } else { "sectors" };
            let name = if f.sectors == 1 { plural.to_owned() } else { format!("{} {plural}", f.sectors) };
            first.push(draw(painter.draw_vapour(&vapour, DOMAIN), &name)?);
            for _ in 0..TARGET as u64 {
                frost.frame();
            }
            let title = format!("frame {TARGET}: miss {:.1}", f.miss);
            last.push(draw(painter.draw_unfinished(&frost), &title)?);
        }
        let all: Vec<&Picture> = first.iter().chain(&last).collect();
        lab.keep(
            &format!("before-and-after-{threshold}"),
            &format!(
                "Threshold {threshold}: the vapour at first (dark 0.05, yellow 0.85), and the frost in frame {TARGET}, when \
                 it should be at the border everywhere and no sooner (orange is not ice yet): with one value, then \
                 with 2, 3, 6 and 12 sectors; the miss is the root mean square over the directions, in frames"
            ),
            Picture::grid(&all, of.len(), 8, GROUND)?,
        )?;
    }
    Ok(())
}
