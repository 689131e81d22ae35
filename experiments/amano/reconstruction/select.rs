//! Which of the sets is best, and which assumes least.

use snowglobe::frost::{Inflow, Redraw};

use super::super::setup::{GammaRule, Reconstruction};
use super::super::shape::{Shape, Start};
use super::JUDGED;
use super::fit::{Fit, Second, largest, squares};
use super::space::Family;

/// The best few, by their worst row, of every reading, ring, redraw, rule, start, shape and number of fitted numbers.
pub fn best_of_each(fits: &[Fit]) -> Vec<Fit> {
    let kind = |fit: &Fit| {
        let plain = fit.candidate.family.is_plain();
        (
            fit.second(),
            fit.candidate.family.ring,
            plain.then_some((fit.candidate.family.shape, fit.candidate.family.start)),
            fit.fitted_numbers(),
        )
    };
    let mut sorted: Vec<&Fit> = fits.iter().collect();
    let worst = |fit: &Fit| largest(&fit.residuals());
    sorted.sort_by(|a, b| worst(a).total_cmp(&worst(b)));
    let mut best: Vec<Fit> = Vec::new();
    for fit in sorted {
        let Family { shape, start, .. } = fit.candidate.family;
        let is_simple = fit.candidate.family.is_plain() && shape.numbers() == 1 && start == Start::Centre;
        let limit = if is_simple { JUDGED } else { 1 };
        if best.iter().filter(|other| kind(other) == kind(fit)).count() < limit {
            best.push(fit.clone());
        }
    }
    best
}

/// The set that assumes least of those that give all eight rows.
pub fn lead(judged: &[Fit], tolerance: f64) -> Option<&Fit> {
    let all_rows = |fit: &&Fit| {
        largest(&fit.residuals()) <= tolerance
            && fit.redraw == Redraw::Frame
            && fit.candidate.family.start == Start::Centre
    };
    let rank = |fit: &Fit| {
        let shape = Shape::ALL.iter().position(|shape| *shape == fit.candidate.family.shape);
        (fit.fitted_numbers(), shape)
    };
    judged.iter().filter(all_rows).min_by(|a, b| {
        rank(a).cmp(&rank(b)).then(squares(&a.residuals()).total_cmp(&squares(&b.residuals())))
    })
}

pub fn is_the_default(fit: &Fit) -> bool {
    let (assumed, family) = (Reconstruction::DEFAULT.assumed(), &fit.candidate.family);
    let readings = Reconstruction::DEFAULT.readings();
    (family.shape, fit.candidate.size, family.steps_per_frame)
        == (assumed.shape, assumed.size, assumed.steps_per_frame)
        && (family.gamma, fit.rule) == (assumed.gamma, assumed.gamma_rule)
        && (fit.inflow, fit.redraw, family.ring) == (readings.inflow, readings.redraw, readings.ring)
}

/// Whether nothing but the sketch and the steps in a frame was fitted: Reiter's rule, the pictures' gamma, its mean
/// kept, the start in the middle.
pub fn is_of_class(fit: &Fit, redraw: Redraw) -> bool {
    let family = &fit.candidate.family;
    family.is_plain()
        && family.start == Start::Centre
        && fit.second() == (Second { inflow: Inflow::ReiterGated, redraw, rule: GammaRule::MeanKept })
}

/// Sketches, of different shape or steps in a frame, with which all eight rows are within the tolerance though nothing
/// but the sketch and the steps was fitted.
pub fn count_sketches(judged: &[Fit], tolerance: f64) -> usize {
    let mut found: Vec<(Shape, u32)> = Vec::new();
    for fit in judged.iter().filter(|fit| is_of_class(fit, Redraw::Frame)) {
        let sketch = (fit.candidate.family.shape, fit.candidate.family.steps_per_frame);
        if largest(&fit.residuals()) <= tolerance && !found.contains(&sketch) {
            found.push(sketch);
        }
    }
    found.len()
}
