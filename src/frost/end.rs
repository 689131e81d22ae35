//! The film and its last frame (§3.4).

use super::Frost;
use super::parameters::{FrostError, Parameters};
use super::standstill::Watch;
use super::tally::Tally;
use crate::hexgrid::{Axial, Region};
use crate::rng::Seed;

/// Which cells count towards the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum EndOf {
    /// All of them, as the paper has it: 90 % was chosen "experimentally" (§3.4).
    AllCells,
    /// The border of the sketch ([`Region::border`]), which ice is meant to reach (§3, §3.4).
    Border,
}

/// When the film ends: in the first frame in which `share` of the cells that count are ice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndRule {
    /// Above 0, at most 1; the paper has 0.9.
    pub share: f64,
    /// Which cells count.
    pub of: EndOf,
}

/// T_sim(beta), §3.4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndFrame {
    /// The first frame with enough ice; 0 is the initial state.
    pub frame: u64,
    /// Where the count of ice, drawn as straight lines from frame to frame, crosses the share: above `frame - 1` and
    /// at most `frame`. Unlike `frame` it has a derivative.
    pub interpolated: f64,
}

/// How a film ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// With enough ice.
    Reached(EndFrame),
    /// There can never be enough: starts lie in too small a part of the region, or no cell can become ice any more.
    Unreachable,
    /// The last frame that was allowed has too little.
    Limit,
}

impl Ending {
    /// T_sim, if there is one.
    pub fn reached(self) -> Option<EndFrame> {
        match self {
            Self::Reached(end) => Some(end),
            Self::Unreachable | Self::Limit => None,
        }
    }
}

/// T_sim(beta): the first frame with enough ice, if one up to `frame_limit` has (§3.4).
///
/// # Errors
///
/// As [`Film::new`].
pub fn end_frame(
    region: &Region,
    starts: &[Axial],
    parameters: Parameters,
    seed: Seed,
    rule: EndRule,
    frame_limit: u64,
) -> Result<Option<EndFrame>, FrostError> {
    Ok(Film::new(region, starts, parameters, seed, rule, frame_limit)?.run().reached())
}

/// T_sim(beta) by several rules at once, from one film: as [`end_frame`] with each.
///
/// # Errors
///
/// As [`Film::new`].
pub fn end_frames(
    region: &Region,
    starts: &[Axial],
    parameters: Parameters,
    seed: Seed,
    rules: &[EndRule],
    frame_limit: u64,
) -> Result<Vec<Option<EndFrame>>, FrostError> {
    let frost = Frost::new(region, starts, parameters, seed)?;
    let tallies = rules.iter().map(|rule| Tally::new(*rule, &frost)).collect::<Result<Vec<_>, _>>()?;
    Ok(ends(frost, tallies, frame_limit))
}

/// The first frame in which each tally has enough, if one up to `frame_limit` has. This frame is 0.
pub(super) fn ends(mut frost: Frost, mut tallies: Vec<Tally>, frame_limit: u64) -> Vec<Option<EndFrame>> {
    let mut watch = Watch::new(&frost);
    let at_first = EndFrame { frame: 0, interpolated: 0.0 };
    let mut ends: Vec<Option<EndFrame>> =
        tallies.iter().map(|tally| tally.is_enough().then_some(at_first)).collect();
    let reachable: Vec<bool> = tallies.iter().map(|tally| tally.may_be_enough(&watch)).collect();
    for frame in 1..=frame_limit {
        let waiting = ends.iter().zip(&reachable).any(|(end, reachable)| end.is_none() && *reachable);
        if !waiting || watch.sees_standstill(&frost, frame - 1) {
            break;
        }
        frost.frame();
        for (tally, end) in tallies.iter_mut().zip(&mut ends).filter(|(_, end)| end.is_none()) {
            *end = tally.crossing(&frost, frame);
        }
    }
    ends
}

/// Number of ice cells in frames 0 to `frames`, so `frames + 1` numbers, whether or not there comes an end.
///
/// # Errors
///
/// As [`Frost::new`].
pub fn growth(
    region: &Region,
    starts: &[Axial],
    parameters: Parameters,
    seed: Seed,
    frames: u64,
) -> Result<Vec<usize>, FrostError> {
    let mut frost = Frost::new(region, starts, parameters, seed)?;
    let mut counts = vec![frost.ice()];
    for _ in 0..frames {
        frost.frame();
        counts.push(frost.ice());
    }
    Ok(counts)
}

/// Frost, frame by frame, and a watch for the end.
///
/// ```
/// # use snowglobe::{frost::*, hexgrid::{Axial, Region}, rng::Seed};
/// # let parameters = Parameters {
/// #     alpha: 1.0, beta: 0.6, gamma: 0.02, threshold: 0.0, steps_per_frame: 1, inflow: Inflow::ReiterGated,
/// #     redraw: Redraw::Frame, edge: Edge::Reflecting, ring_touching_ice: RingTouchingIce::Zero,
/// # };
/// let rule = EndRule { share: 0.9, of: EndOf::AllCells };
/// let mut film = Film::new(&Region::hexagon(4), &[Axial::ORIGIN], parameters, Seed(1), rule, 1000)?;
/// while film.ending().is_none() {
///     film.advance(); // and draw `film.frost()`
/// }
/// assert!(film.frost().ice() >= 55);
/// # Ok::<(), FrostError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Film {
    frost: Frost,
    tally: Tally,
    frame_limit: u64,
    frame: u64,
    ending: Option<Ending>,
    watch: Watch,
}

impl Film {
    /// Frame 0.
    ///
    /// # Errors
    ///
    /// What [`Frost::new`] refuses, and a share outside (0, 1].
    pub fn new(
        region: &Region,
        starts: &[Axial],
        parameters: Parameters,
        seed: Seed,
        rule: EndRule,
        frame_limit: u64,
    ) -> Result<Self, FrostError> {
        let frost = Frost::new(region, starts, parameters, seed)?;
        let tally = Tally::new(rule, &frost)?;
        let watch = Watch::new(&frost);
        let ending = if tally.is_enough() {
            Some(Ending::Reached(EndFrame { frame: 0, interpolated: 0.0 }))
        } else if !tally.may_be_enough(&watch) {
            Some(Ending::Unreachable)
        } else {
            (frame_limit == 0).then_some(Ending::Limit)
        };
        Ok(Self { frost, tally, frame_limit, frame: 0, ending, watch })
    }

    /// The next frame. Goes on after the ending, which then stays what it was.
    pub fn advance(&mut self) {
        self.frost.frame();
        self.frame += 1;
        let end = self.tally.crossing(&self.frost, self.frame);
        if self.ending.is_some() {
            return;
        }
        self.ending = match end {
            Some(end) => Some(Ending::Reached(end)),
            None if self.watch.sees_standstill(&self.frost, self.frame) => Some(Ending::Unreachable),
            None => (self.frame >= self.frame_limit).then_some(Ending::Limit),
        };
    }

    /// Advances to the ending.
    pub fn run(&mut self) -> Ending {
        loop {
            match self.ending {
                Some(ending) => return ending,
                None => self.advance(),
            }
        }
    }

    /// The ending, once it has come.
    pub fn ending(&self) -> Option<Ending> {
        self.ending
    }

    /// The frost in this frame.
    pub fn frost(&self) -> &Frost {
        &self.frost
    }

    /// Number of this frame; the first is 0.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// Ice among the cells that count.
    pub fn counted(&self) -> usize {
        self.tally.counted()
    }

    #[cfg(test)]
    pub(super) fn needed(&self) -> usize {
        self.tally.needed()
    }

    /// Number of cells that count.
    pub fn counting(&self) -> usize {
        self.tally.counting()
    }
}
