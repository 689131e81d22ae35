//! The inverse problem: what the paper does not print, from the eight rows that it does.

mod claims;
mod fit;
mod held_out;
mod keep;
mod maps;
mod select;
mod space;

use snowglobe::frost::{Inflow, Redraw, RingTouchingIce};
use snowglobe::lab::{Experiment, Lab, Mutant, Result};

use super::setup::GammaRule;
use super::shape::{Shape, Start};
use super::{table_1, table_2};
use claims::*;
use fit::{
    Candidate, Fit, Printed, Second, fit_gamma, fit_size, is_near_table_2, largest, on_table_2, squares,
};
use select::{best_of_each, count_sketches, is_the_default, lead};
use space::{Family, declared};

pub const RECONSTRUCTION: Experiment = Experiment {
    id: "reconstruction",
    title: "What the tables leave open",
    source: "Tables 1 and 2, §4",
    says: "The tables print eight pairs of an initial value and an end frame, and neither the sketch nor the steps of \
           the solver in a frame, nor gamma. The space of what could be meant is declared, searched, and reported: the \
           best set for each reading, what it assumes, what it predicts, and what the tables do not determine.",
    claims: &[&ALL_ROWS, &LEAD, &PREDICTED, &LEFT_OUT, &MEAN_GAMMA, &NOT_UNIQUE],
    run,
    mutant: Mutant {
        changes: "end frame of step 0, Table 1",
        to: 220.0,
        why: "no film of this model ends so much later for so little less vapour",
        turns_red: &["amano/reconstruction/all-rows", "amano/reconstruction/lead"],
    },
};

/// Candidates whose fit of Table 1 is worse than this, the tolerance and half of it again, are not tried on Table 2;
/// those with the start at an edge, or tried with another redraw than the page's, must be within the tolerance itself.
const NEAR: f64 = 6.0;
/// Candidates whose first seeds miss a row of Table 2 by more than twice the tolerance are tried no further.
const FAR: f64 = 8.0;
/// Candidates that miss no row by more, a frame beyond the tolerance for their few seeds, are judged with many.
const CLOSE: f64 = 5.0;
/// Seeds with which candidates are compared, with which rows are predicted, and with which the best are judged.
const SEEDS: (u64, u64, u64) = (8, 20, 40);
/// Candidates of each kind that are judged, where the sketch is in the middle and needs one number; one of the others.
const JUDGED: usize = 2;
/// Candidates that are given a gamma of their own for Table 2.
const FREE: usize = 3;

fn run(lab: &mut Lab) -> Result<()> {
    let printed = printed(lab);
    declare(lab);

    // Table 1 first: chance does not enter there.
    let families: Vec<Family> = declared().into_iter().filter(|family| wanted(lab, family)).collect();
    let families = lab.pick(&families[..], &families[..1]);
    let candidates = lab.each(families, |family| fit_size(family, &printed));
    let candidates: Vec<Candidate> =
        candidates.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
    lab.count("sketches tried on Table 1", candidates.len() as u64);

    // Table 2 for those that come near.
    let jobs = second_stage(lab, &candidates, printed.tolerance);
    let few = lab.seeds(SEEDS.0);
    let screened = lab.each(&jobs, |(candidate, second)| screen(candidate, *second, &few, &printed));
    let screened: Vec<Fit> =
        screened.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
    lab.count("sets tried on Table 2", jobs.len() as u64);

    // The best of each kind again, with as many seeds as the tables are judged by.
    let best = best_of_each(&screened);
    let many = lab.seeds(SEEDS.2);
    let judged = lab.each(&best, |fit| match largest(&fit.residuals()) > CLOSE {
        true => Ok(fit.clone()), // a few seeds were enough
        false => on_table_2(&fit.candidate, fit.second(), fit.gamma, &many, &printed),
    });
    let judged = judged.into_iter().collect::<Result<Vec<Fit>>>()?;
    let lead = lead(&judged, printed.tolerance);

    judge_rows(lab, &judged);
    lab.default_reading();
    lab.found(&LEAD, f64::from(lead.is_some_and(is_the_default)));
    let predicting = lab.seeds(SEEDS.1);
    held_out::judge(lab, &candidates, &screened, &predicting, &printed)?;
    lab.found(&MEAN_GAMMA, lead.map(|lead| free_over_kept(lead, &few, &printed)).transpose()?);
    lab.found(&NOT_UNIQUE, count_sketches(&judged, printed.tolerance) as f64);

    if !lab.keeps() {
        return Ok(());
    }
    keep::candidates(lab, &candidates)?;
    keep::best(lab, &judged, lead)?;
    if let Some(lead) = lead {
        keep::lead(lab, lead, &printed)?;
    }
    maps::keep(lab, &candidates, lead, &printed)
}

fn printed(lab: &mut Lab) -> Printed {
    let mut rows = |name: &str, rows: [(f64, f64); 4]| {
        let mut step = 0;
        rows.map(|(beta, frame)| {
            let frame = lab.printed(&format!("end frame of step {step}, {name}"), frame, name);
            step += 1;
            (beta, frame)
        })
    };
    Printed {
        table_1: rows("Table 1", table_1::PRINTED),
        table_2: rows("Table 2", table_2::PRINTED),
        threshold: lab.printed("r_th", 0.8, "Table 2"),
        share: lab.printed("share", 0.9, "§3.4"),
        tolerance: lab.printed("tolerance", 4.0, "§4"),
    }
}

/// The space, in words, before anything is run.
fn declare(lab: &mut Lab) {
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    let shapes = Shape::ALL.map(Shape::name).join(", ");
    for (name, what, why) in [
        ("readings searched", Inflow::ALL.map(Inflow::name).join(", "), "all of Eq. (1)"),
        ("shapes searched", shapes, "the sketch is not given; those of one number lead"),
        ("starts searched", Start::ALL.map(Start::name).join(", "), "its place is not given"),
        ("steps per frame searched", "1 to 12".to_owned(), "not given"),
        (
            "half widths searched",
            format!("{} to {} spacings", space::SIZES.0, space::SIZES.1),
            "not given; nine about the one at which the mean residual of Table 1 changes sign",
        ),
        ("alphas searched", list(&space::ALPHAS), "Reiter has 1; the others on the hexagon"),
        ("gammas searched", list(&space::GAMMAS), "the pictures have 0.005; the others on the hexagon"),
        (
            "gamma at the threshold searched",
            "same, mean-kept, free".to_owned(),
            "not given: the same; divided by 1 - r_th; or any",
        ),
        ("redraws searched", Redraw::ALL.map(Redraw::name).join(", "), "the page says frame"),
        (
            "the lead is",
            "of the sets with all eight rows within the tolerance, with r held for the frame and the start in the \
             centre, the one with the fewest fitted numbers; then the one whose shape is named first; then the one that fits best"
                .to_owned(),
            "what assumes least, not what fits best",
        ),
    ] {
        lab.assume_that(name, &what, why);
    }
}

fn wanted(lab: &Lab, family: &Family) -> bool {
    let inflows = lab.readings::<Inflow>();
    // Where r withholds nothing, the passive readings are Reiter's rule.
    let passive = [Inflow::PassiveIsVapour, Inflow::PassiveDiffuses];
    let inflow = inflows.contains(&family.inflow)
        || (family.inflow == Inflow::ReiterGated && inflows.iter().any(|inflow| passive.contains(inflow)));
    inflow && lab.readings::<RingTouchingIce>().contains(&family.ring)
}

/// What is tried on Table 2: every candidate near Table 1 with the rules that need no further number, and the best few
/// with a free gamma and under the readings that differ at a threshold only.
fn second_stage<'c>(lab: &Lab, candidates: &'c [Candidate], tolerance: f64) -> Vec<(&'c Candidate, Second)> {
    let mut jobs = Vec::new();
    let inflows = lab.readings::<Inflow>();
    for inflow in inflows {
        let of_table_1 = match inflow {
            Inflow::PassiveIsVapour | Inflow::PassiveDiffuses => Inflow::ReiterGated,
            other => other,
        };
        let mut fits: Vec<&Candidate> = candidates.iter().filter(|c| c.family.inflow == of_table_1).collect();
        fits.sort_by(|a, b| squares(&a.table_1).total_cmp(&squares(&b.table_1)));
        for redraw in lab.readings::<Redraw>() {
            for rule in [GammaRule::Same, GammaRule::MeanKept, GammaRule::Free] {
                let central = |c: &&&Candidate| c.family.start == Start::Centre;
                let within = |frames: f64| move |c: &&&Candidate| largest(&c.table_1) <= frames;
                let second = Second { inflow, redraw, rule };
                let mut take = |chosen: &mut dyn Iterator<Item = &&'c Candidate>| {
                    jobs.extend(chosen.map(|candidate| (*candidate, second)));
                };
                match (inflow, redraw, rule) {
                    (Inflow::ReiterGated, Redraw::Frame, GammaRule::MeanKept) => {
                        take(&mut fits.iter().filter(central).filter(within(NEAR)));
                        take(&mut fits.iter().filter(|c| !central(c)).filter(within(tolerance)));
                    }
                    (Inflow::ReiterGated, Redraw::Step, GammaRule::MeanKept) => {
                        take(&mut fits.iter().filter(central).filter(within(tolerance)));
                    }
                    (Inflow::ReiterGated, Redraw::Frame, GammaRule::Free) => {
                        take(&mut fits.iter().filter(central).take(FREE));
                    }
                    (Inflow::PassiveIsVapour | Inflow::PassiveDiffuses, Redraw::Frame, GammaRule::Free) => {
                        take(&mut fits.iter().take(FREE));
                    }
                    // The redraw does not tell here.
                    (Inflow::OnlyIceHidden, Redraw::Frame, GammaRule::Same) => {
                        take(&mut fits.iter().filter(within(NEAR)));
                    }
                    (Inflow::OnlyIceHidden, Redraw::Step | Redraw::Cell, _) | (_, _, GammaRule::Free) => {}
                    // What misses by far is shown once.
                    _ => take(&mut fits.iter().take(1)),
                }
            }
        }
    }
    jobs
}

/// A set on Table 2 with a few seeds; none if the first two are far off already.
fn screen(candidate: &Candidate, second: Second, seeds: &[u64], printed: &Printed) -> Result<Option<Fit>> {
    if second.rule == GammaRule::Free {
        return fit_gamma(candidate, second, &seeds[..seeds.len().min(4)], printed).map(Some);
    }
    let gamma = second.rule.gamma(candidate.family.gamma, printed.threshold);
    let first = &seeds[..seeds.len().min(2)];
    let must_report = second.inflow != Inflow::ReiterGated
        || second.rule == GammaRule::Same
        || second.redraw == Redraw::Cell;
    if must_report {
        let fit = on_table_2(candidate, second, gamma, first, printed)?;
        if largest(&fit.table_2) > FAR {
            return Ok(Some(fit));
        }
    } else if !is_near_table_2(candidate, second, gamma, first, printed, FAR)? {
        return Ok(None);
    }
    on_table_2(candidate, second, gamma, seeds, printed).map(Some)
}

/// The best set under each reading, judged by its worst row.
fn judge_rows(lab: &mut Lab, judged: &[Fit]) {
    for ring in lab.readings::<RingTouchingIce>() {
        for inflow in lab.readings::<Inflow>() {
            for redraw in lab.readings::<Redraw>() {
                let of_reading = |fit: &&Fit| {
                    (fit.inflow, fit.redraw, fit.candidate.family.ring) == (inflow, redraw, ring)
                };
                if ring != RingTouchingIce::Zero && (inflow, redraw) != (Inflow::ReiterGated, Redraw::Frame) {
                    continue; // the ring is varied under the default alone
                }
                if !judged.iter().any(|fit| of_reading(&fit)) {
                    continue; // not declared: the redraw is varied under Reiter's rule
                }
                let worst = judged.iter().filter(of_reading).map(|fit| largest(&fit.residuals()));
                let least = worst.fold(f64::INFINITY, f64::min);
                lab.reading(inflow);
                lab.reading(redraw);
                lab.reading(ring);
                lab.found(&ALL_ROWS, Some(least).filter(|least| least.is_finite()));
            }
        }
    }
}

/// gamma of Table 2 fitted freely to the lead's sketch, over the one that keeps the mean.
fn free_over_kept(lead: &Fit, seeds: &[u64], printed: &Printed) -> Result<f64> {
    let free = Second { rule: GammaRule::Free, ..lead.second() };
    Ok(fit_gamma(&lead.candidate, free, seeds, printed)?.gamma / lead.gamma)
}
