//! When ice reaches the border in each direction, and how far that is from one frame for all: what the paper's outlook
//! (§5) wants, どの方向の領域の境界へも到達時間が等しくなるよう.

use argmin::core::{CostFunction, Error};

use super::end::ends;
use super::tally::Tally;
use super::{EndFrame, Frost, FrostError, Parameters, Sectors, TSim};
use crate::hexgrid::{Axial, Region};
use crate::rng::Seed;

/// The border of a region ([`Region::border`]), direction by direction. Directions in which it has no cell are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Directions {
    share: f64,
    cells: usize,
    borders: Vec<(usize, Vec<usize>)>,
}

impl Directions {
    /// How many directions tell a shape's sides and corners apart, and still have some border each.
    pub const USUAL: usize = 12;

    /// The directions of these sectors, reached when `share` (above 0, at most 1; 0.9 as in §3.4) of the border cells
    /// of each are ice.
    ///
    /// # Errors
    ///
    /// Sectors of another region, by its number of cells, and a share outside (0, 1].
    pub fn new(region: &Region, sectors: &Sectors, share: f64) -> Result<Self, FrostError> {
        let (given, needed) = (sectors.cells(), region.len());
        if given != needed {
            return Err(FrostError::Count { given, needed, each: "cell" });
        }
        if !(share > 0.0 && share <= 1.0) {
            return Err(FrostError::Share(share));
        }
        let mut borders: Vec<(usize, Vec<usize>)> = (0..sectors.count()).map(|k| (k, Vec::new())).collect();
        for ordinal in region.border() {
            borders[sectors.of(ordinal)].1.push(ordinal);
        }
        borders.retain(|(_, border)| !border.is_empty());
        Ok(Self { share, cells: needed, borders })
    }

    /// Numbers of the directions that have border cells.
    pub fn numbers(&self) -> impl Iterator<Item = usize> {
        self.borders.iter().map(|(number, _)| *number)
    }
}

/// When ice is at the border in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Number of the direction's sector.
    pub direction: usize,
    /// Border cells there.
    pub border: usize,
    /// The first frame with the share of them, if one has: whole, and interpolated as in [`EndFrame`].
    pub end: Option<EndFrame>,
}

/// When ice is at the border in every direction, frame 0 being the frost as it is given. It grows until it has arrived
/// everywhere, up to `frame_limit` frames, or until nothing can freeze any more.
///
/// # Errors
///
/// Directions of another region, by its number of cells.
pub fn arrivals(frost: Frost, directions: &Directions, frame_limit: u64) -> Result<Vec<Arrival>, FrostError> {
    let (given, needed) = (directions.cells, frost.region().len());
    if given != needed {
        return Err(FrostError::Count { given, needed, each: "cell" });
    }
    let tally = |(_, border): &(_, Vec<usize>)| Tally::of(directions.share, Some(border.clone()), &frost);
    let tallies = directions.borders.iter().map(tally).collect::<Result<Vec<_>, _>>()?;
    let ends = ends(frost, tallies, frame_limit);
    let arrival = |((direction, border), end): (&(usize, Vec<usize>), _)| Arrival {
        direction: *direction,
        border: border.len(),
        end,
    };
    Ok(directions.borders.iter().zip(ends).map(arrival).collect())
}

/// How far the arrivals are from the target.
#[derive(Clone, Debug, PartialEq)]
pub struct Misses {
    /// The arrivals, direction by direction.
    pub arrivals: Vec<Arrival>,
    /// `T_d - T` of each, in frames.
    pub residuals: Vec<f64>,
}

impl Misses {
    /// The mean of `(T_d - T)^2` over the directions, in frames squared.
    pub fn mean_square(&self) -> f64 {
        self.residuals.iter().fold(0.0, |sum, miss| sum + miss * miss) / self.residuals.len() as f64
    }

    /// The root of it, in frames.
    pub fn root_mean_square(&self) -> f64 {
        self.mean_square().sqrt()
    }

    /// The greatest `|T_d - T|`, in frames.
    pub fn greatest(&self) -> f64 {
        self.residuals.iter().fold(0.0, |most, miss| f64::max(most, miss.abs()))
    }
}

/// `f(beta_1 .. beta_n) = mean over directions d of (T_d - T)^2`: Eq. (2) for every direction, with a beta in every
/// sector. With one sector it is the paper's beta, with one direction its T_sim by the border.
///
/// As a [`CostFunction`] it is f. T_d counts as the frame limit where ice does not arrive by then, so that f is finite
/// and a search is pulled back. Vapour that no cell can hold, below 0 say, is an error: bounds are the solver's.
#[derive(Clone, Debug)]
pub struct SectorObjective<'a> {
    /// The sketch.
    pub region: &'a Region,
    /// Where growth starts.
    pub starts: &'a [Axial],
    /// Everything but the vapour at first; beta is what a held edge holds.
    pub parameters: Parameters,
    /// The seed of r_t(p).
    pub seed: Seed,
    /// The n sectors that have vapour of their own.
    pub sectors: Sectors,
    /// The m directions in which ice is to arrive.
    pub directions: Directions,
    /// T, in frames.
    pub target: f64,
    /// Which number T_d is.
    pub t_sim: TSim,
    /// Frames after which ice counts as arriving no more.
    pub frame_limit: u64,
}

impl SectorObjective<'_> {
    /// The frost at first, with this vapour in each sector.
    ///
    /// # Errors
    ///
    /// Not one number for each sector, and as [`Frost::with_vapour`].
    pub fn frost(&self, betas: &[f64]) -> Result<Frost, FrostError> {
        let vapour = self.sectors.field(betas)?;
        Frost::with_vapour(self.region, self.starts, self.parameters, self.seed, &vapour)
    }

    /// The arrivals with this vapour in each sector, and how far they are from the target.
    ///
    /// # Errors
    ///
    /// As [`frost`](Self::frost) and [`arrivals`].
    pub fn misses(&self, betas: &[f64]) -> Result<Misses, FrostError> {
        let arrivals = arrivals(self.frost(betas)?, &self.directions, self.frame_limit)?;
        let frames = |end: Option<EndFrame>| match (end, self.t_sim) {
            (None, _) => self.frame_limit as f64,
            (Some(end), TSim::Whole) => end.frame as f64,
            (Some(end), TSim::Interpolated) => end.interpolated,
        };
        let residuals = arrivals.iter().map(|arrival| frames(arrival.end) - self.target).collect();
        Ok(Misses { arrivals, residuals })
    }
}

impl CostFunction for SectorObjective<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, betas: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.misses(betas)?.mean_square())
    }
}
