//! Fits: the end frames of both tables for one set of assumptions, less the printed ones.

use snowglobe::frost::{Edge, EndFrame, EndOf, EndRule, Inflow, Parameters, Redraw, end_frame};
use snowglobe::hexgrid::Region;
use snowglobe::lab::{Error, Result, average, standard_error};
use snowglobe::rng::Seed;

use super::super::setup::GammaRule;
use super::super::shape::Shape;
use super::space::{Family, SIZES};

/// The eight printed rows, (initial value, end frame), and what is printed with them.
#[derive(Clone, Copy)]
pub struct Printed {
    pub table_1: [(f64, f64); 4],
    pub table_2: [(f64, f64); 4],
    pub threshold: f64,
    pub share: f64,
    pub tolerance: f64,
}

impl Printed {
    /// All eight rows, Table 1 first.
    pub fn rows(&self) -> Vec<(f64, f64)> {
        [self.table_1, self.table_2].concat()
    }

    /// The name of one of the eight rows and its end frame.
    pub fn row(&self, row: usize) -> (String, f64) {
        (format!("Table {}, step {}", row / 4 + 1, row % 4), self.rows()[row].1)
    }
}

/// Frames after which a film is endless for the search: beyond any printed row by ten times the tolerance.
pub const ENDLESS: u64 = 202;

/// Measured less printed end frames of four rows; infinite where a film is endless.
pub type Residuals = [f64; 4];

/// A family with a size, and how it fares on Table 1.
#[derive(Clone, Debug)]
pub struct Candidate {
    pub family: Family,
    pub size: f64,
    pub region: Region,
    pub table_1: Residuals,
}

/// A candidate with what Table 2 needs, and how it fares on that.
#[derive(Clone, Debug)]
pub struct Fit {
    pub candidate: Candidate,
    pub inflow: Inflow,
    pub redraw: Redraw,
    pub rule: GammaRule,
    /// gamma at the threshold of Table 2.
    pub gamma: f64,
    /// Of the mean over seeds.
    pub table_2: Residuals,
    /// Its standard error.
    pub errors: [f64; 4],
    /// Seeds of Table 2.
    pub seeds: usize,
}

impl Fit {
    /// Of all eight rows, Table 1 first.
    pub fn residuals(&self) -> [f64; 8] {
        let mut all = [0.0; 8];
        all[..4].copy_from_slice(&self.candidate.table_1);
        all[4..].copy_from_slice(&self.table_2);
        all
    }

    /// What it needs beyond its candidate.
    pub fn second(&self) -> Second {
        Second { inflow: self.inflow, redraw: self.redraw, rule: self.rule }
    }

    /// Numbers that were chosen to fit the eight rows.
    pub fn fitted_numbers(&self) -> usize {
        self.candidate.family.fitted_numbers() + usize::from(self.rule == GammaRule::Free)
    }
}

/// The largest residual, whatever its sign.
pub fn largest(residuals: &[f64]) -> f64 {
    residuals.iter().fold(0.0, |most: f64, r| most.max(r.abs()))
}

/// The sum of squares.
pub fn squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r * r).sum()
}

/// The film's end, if it has one.
fn end(
    region: &Region,
    family: &Family,
    parameters: Parameters,
    seed: u64,
    share: f64,
) -> Result<Option<EndFrame>> {
    let rule = EndRule { share, of: EndOf::AllCells };
    end_frame(region, &[family.start.of(region)], parameters, Seed(seed), rule, ENDLESS)
        .map_err(|cause| Error::broken("cannot grow frost").because(cause))
}

fn parameters(family: &Family) -> Parameters {
    Parameters {
        alpha: family.alpha,
        beta: 0.0,
        gamma: family.gamma,
        threshold: 0.0,
        steps_per_frame: family.steps_per_frame,
        inflow: family.inflow,
        redraw: Redraw::Frame,
        edge: Edge::Reflecting,
        ring_touching_ice: family.ring,
    }
}

/// How a family with this size fares on Table 1, where chance does not enter.
pub fn on_table_1(family: &Family, region: &Region, printed: &Printed) -> Result<Residuals> {
    let mut residuals = [f64::INFINITY; 4];
    for (residual, (beta, frame)) in residuals.iter_mut().zip(printed.table_1) {
        let parameters = Parameters { beta, ..parameters(family) };
        let end = end(region, family, parameters, 1, printed.share)?;
        *residual = end.map_or(f64::INFINITY, |end| end.frame as f64 - frame);
    }
    Ok(residuals)
}

/// By how much the first and the last row of Table 1 are too late, in the mean.
fn miss(family: &Family, region: &Region, printed: &Printed) -> Result<f64> {
    let mut sum = 0.0;
    for (beta, frame) in [printed.table_1[0], printed.table_1[3]] {
        let end = end(region, family, Parameters { beta, ..parameters(family) }, 1, printed.share)?;
        let Some(end) = end else { return Ok(f64::INFINITY) };
        sum += end.frame as f64 - frame;
    }
    Ok(0.5 * sum)
}

/// The sizes that a shape is tried at: each that has other cells than the one before.
fn sizes(shape: Shape) -> Vec<(f64, Region)> {
    let step = if shape == Shape::Hexagon { 1.0 } else { 0.25 };
    let count = ((SIZES.1 - SIZES.0) / step) as u32;
    let all = (0..=count).map(|i| SIZES.0 + f64::from(i) * step).map(|size| (size, shape.region(size)));
    let mut sizes: Vec<(f64, Region)> = Vec::new();
    for (size, region) in all {
        if sizes.last().is_none_or(|(_, last)| last.len() != region.len()) {
            sizes.push((size, region));
        }
    }
    sizes
}

/// Sizes that are looked at on either side of the one at which the residuals change sign.
const AROUND: usize = 4;

/// The sizes of a family that fit Table 1 best: the larger a sketch, the later it is full, so the size at which its
/// first and last row change sign, in the mean, is bisected, and its neighbours are tried one by one.
pub fn fit_size(family: &Family, printed: &Printed) -> Result<Vec<Candidate>> {
    let sizes = sizes(family.shape);
    let (mut early, mut late) = (0, sizes.len() - 1);
    while late - early > 1 {
        let middle = (early + late) / 2;
        if miss(family, &sizes[middle].1, printed)? > 0.0 { late = middle } else { early = middle }
    }
    let window = late.saturating_sub(AROUND)..(late + AROUND).min(sizes.len());
    let fit = |(size, region): &(f64, Region)| {
        let table_1 = on_table_1(family, region, printed)?;
        Ok(Candidate { family: *family, size: *size, region: region.clone(), table_1 })
    };
    sizes[window].iter().map(fit).collect()
}

/// What Table 2 needs beyond a candidate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Second {
    pub inflow: Inflow,
    pub redraw: Redraw,
    pub rule: GammaRule,
}

/// One row of Table 2: measured less printed end frames, one for each seed; none if a film is endless.
fn row_of_table_2(
    candidate: &Candidate,
    second: Second,
    gamma: f64,
    row: usize,
    seeds: &[u64],
    printed: &Printed,
) -> Result<Option<Vec<f64>>> {
    let Second { inflow, redraw, .. } = second;
    let (beta, frame) = printed.table_2[row];
    let family = &candidate.family;
    let with = Parameters { beta, gamma, threshold: printed.threshold, inflow, redraw, ..parameters(family) };
    let mut ends = Vec::new();
    for seed in seeds {
        match end(&candidate.region, family, with, *seed, printed.share)? {
            Some(end) => ends.push(end.frame as f64 - frame),
            None => return Ok(None),
        }
    }
    Ok(Some(ends))
}

/// Whether no row of Table 2 is missed by more than so many frames, in the mean over these seeds.
pub fn is_near_table_2(
    candidate: &Candidate,
    second: Second,
    gamma: f64,
    seeds: &[u64],
    printed: &Printed,
    frames: f64,
) -> Result<bool> {
    for row in 0..4 {
        let ends = row_of_table_2(candidate, second, gamma, row, seeds, printed)?;
        if ends.is_none_or(|ends| average(&ends).abs() > frames) {
            return Ok(false);
        }
    }
    Ok(true)
}

/// How a candidate fares on Table 2, in the mean over these seeds.
pub fn on_table_2(
    candidate: &Candidate,
    second: Second,
    gamma: f64,
    seeds: &[u64],
    printed: &Printed,
) -> Result<Fit> {
    let Second { inflow, redraw, rule } = second;
    let (mut table_2, mut errors) = ([f64::INFINITY; 4], [0.0; 4]);
    for row in 0..4 {
        // One endless row is enough to refute it.
        let Some(ends) = row_of_table_2(candidate, second, gamma, row, seeds, printed)? else { break };
        table_2[row] = average(&ends);
        errors[row] = standard_error(&ends);
    }
    Ok(Fit { candidate: candidate.clone(), inflow, redraw, rule, gamma, table_2, errors, seeds: seeds.len() })
}

/// The free gamma of Table 2 that leaves no mean residual, to a tenth of the gamma of Table 1: the larger it is, the
/// sooner the sketch is full.
pub fn fit_gamma(candidate: &Candidate, second: Second, seeds: &[u64], printed: &Printed) -> Result<Fit> {
    let step = candidate.family.gamma / 10.0;
    let (mut late, mut early) = (10u32, 100u32);
    while early - late > 1 {
        let middle = (early + late) / 2;
        let fit = on_table_2(candidate, second, f64::from(middle) * step, seeds, printed)?;
        if fit.table_2.iter().sum::<f64>() > 0.0 { late = middle } else { early = middle }
    }
    let mut fits = Vec::new();
    for tenths in [late, early] {
        fits.push(on_table_2(candidate, second, f64::from(tenths) * step, seeds, printed)?);
    }
    fits.sort_by(|a, b| squares(&a.table_2).total_cmp(&squares(&b.table_2)));
    Ok(fits.swap_remove(0))
}
