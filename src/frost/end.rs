//! The film and its last frame (§3.4).

use super::parameters::{FrostError, Parameters};
use super::readings::{Edge, Inflow, Redraw, RingTouchingIce};
use super::reference::State;
use super::{Frost, NEVER};
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
    share: f64,
    // Ordinals that count; none where all do.
    border: Option<Vec<usize>>,
    needed: usize,
    frame_limit: u64,
    frame: u64,
    counted: usize,
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
        if !(rule.share > 0.0 && rule.share <= 1.0) {
            return Err(FrostError::Share(rule.share));
        }
        let frost = Frost::new(region, starts, parameters, seed)?;
        let border = (rule.of == EndOf::Border).then(|| region.border());
        let counting = border.as_ref().map_or(region.len(), Vec::len);
        let needed = needed(rule.share, counting);
        let watch = Watch::new(&frost);
        let mut film = Self {
            frost,
            share: rule.share,
            border,
            needed,
            frame_limit,
            frame: 0,
            counted: 0,
            ending: None,
            watch,
        };
        film.counted = film.count(|ordinal| film.frost.is_ice(ordinal));
        let at_most = film.count(|ordinal| film.watch.may_freeze[ordinal]);
        film.ending = if film.counted >= needed {
            Some(Ending::Reached(EndFrame { frame: 0, interpolated: 0.0 }))
        } else if at_most < needed {
            Some(Ending::Unreachable)
        } else {
            (frame_limit == 0).then_some(Ending::Limit)
        };
        Ok(film)
    }

    /// The next frame. Goes on after the ending, which then stays what it was.
    pub fn advance(&mut self) {
        self.frost.frame();
        self.frame += 1;
        let before = self.counted;
        self.counted = match &self.border {
            None => self.frost.ice(),
            Some(_) => self.count(|ordinal| self.frost.is_ice(ordinal)),
        };
        if self.ending.is_some() {
            return;
        }
        self.ending = if self.counted >= self.needed {
            let aim = self.share * self.counting() as f64;
            let part = (aim - before as f64) / (self.counted - before) as f64;
            let interpolated = (self.frame - 1) as f64 + part.clamp(0.0, 1.0);
            Some(Ending::Reached(EndFrame { frame: self.frame, interpolated }))
        } else if self.watch.sees_standstill(&self.frost, self.frame) {
            Some(Ending::Unreachable)
        } else {
            (self.frame >= self.frame_limit).then_some(Ending::Limit)
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
        self.counted
    }

    /// Number of cells that count.
    pub fn counting(&self) -> usize {
        self.border.as_ref().map_or(self.frost.region.len(), Vec::len)
    }

    fn count(&self, is: impl Fn(usize) -> bool) -> usize {
        match &self.border {
            None => (0..self.frost.region.len()).filter(|&ordinal| is(ordinal)).count(),
            Some(border) => border.iter().filter(|&&ordinal| is(ordinal)).count(),
        }
    }
}

/// The least k with `k / n >= share` as computed, so that 7 of 10 are 0.7.
fn needed(share: f64, n: usize) -> usize {
    let enough = |k: usize| k as f64 / n as f64 >= share;
    let mut k = (libm::ceil(share * n as f64) as usize).min(n);
    while k > 0 && enough(k - 1) {
        k -= 1;
    }
    while !enough(k) {
        k += 1;
    }
    k
}

/// Looks out for a state from which there can never be new ice.
#[derive(Clone, Debug)]
struct Watch {
    // Cells that ice may come to, if it goes on; and those whose vapour may come to ice.
    may_freeze: Vec<bool>,
    may_feed: Vec<bool>,
    next_look: u64,
    seen: Option<Vec<f64>>,
}

impl Watch {
    /// Room for rounding in sums of many u.
    const MARGIN: f64 = 1e-9;

    fn new(frost: &Frost) -> Self {
        let Parameters { beta, edge, ring_touching_ice, .. } = frost.parameters;
        let reflecting = edge == Edge::Reflecting;
        let may_feed = reach(frost, reflecting);
        let may_freeze = if beta >= 1.0 - Self::MARGIN {
            vec![true; frost.region.len()]
        } else if reflecting && ring_touching_ice == RingTouchingIce::Mean {
            may_feed.clone() // a mean that includes ice may lift a cell of the next piece to 1
        } else {
            reach(frost, false)
        };
        Self { may_freeze, may_feed, next_look: 16, seen: None }
    }

    /// Whether nothing can freeze any more. Looks ever more rarely, so that it costs little beside the frames.
    fn sees_standstill(&mut self, frost: &Frost, frame: u64) -> bool {
        if let Some(before) = self.seen.take() {
            return is_unchanged(frost, &before);
        }
        if frame < self.next_look {
            return false;
        }
        self.next_look = frame + frame / 2;
        if is_autonomous(frost) {
            self.seen = Some(frost.field());
        }
        self.is_starved(frost)
    }

    /// Whether under `ReiterGated` no gamma comes any more to a cell that waits, and all vapour is too little.
    ///
    /// What a cell gives away arrives in its neighbours once, over a reflecting edge too; so no cell can come to hold
    /// more than it has and all vapour together. Only a point of the ring beside a receptive cell makes vapour, by
    /// giving back what that cell keeps.
    fn is_starved(&self, frost: &Frost) -> bool {
        let Parameters { gamma, threshold, inflow, redraw, edge, ring_touching_ice, .. } = frost.parameters;
        let no_gamma = gamma == 0.0 || threshold >= 1.0;
        if inflow != Inflow::ReiterGated
            || edge != Edge::Reflecting
            || !(no_gamma || threshold > 0.0 && redraw == Redraw::Cell)
        {
            return false;
        }
        let (mut vapour, mut most) = (0.0, 0.0);
        for ordinal in (0..frost.region.len()).filter(|&ordinal| self.may_feed[ordinal]) {
            match frost.state(ordinal) {
                State::Ice => {}
                State::Neighbour if !no_gamma && frost.draws_above(ordinal) => return false,
                State::Neighbour => most = f64::max(most, frost.u(ordinal)),
                State::Other => vapour += frost.u(ordinal),
            }
        }
        most + vapour < 1.0 - Self::MARGIN
            && !frost.region.ring().into_iter().any(|at| {
                let inner = || at.neighbours().into_iter().filter_map(|q| frost.region.ordinal(q));
                let shows_zero =
                    ring_touching_ice == RingTouchingIce::Zero && inner().any(|q| frost.is_ice(q));
                !shows_zero && inner().any(|q| frost.state(q) != State::Other && frost.u(q) > 0.0)
            })
    }
}

/// Whether the next state depends on this one alone.
fn is_autonomous(frost: &Frost) -> bool {
    let Parameters { gamma, inflow, .. } = frost.parameters;
    let only_gamma_is_gated = matches!(inflow, Inflow::ReiterGated | Inflow::OnlyIceHidden);
    frost.gate.is_fixed() || gamma == 0.0 && only_gamma_is_gated
}

/// Whether a frame has changed nothing on which the next one depends: then none ever will.
fn is_unchanged(frost: &Frost, before: &[f64]) -> bool {
    let Parameters { inflow, edge, ring_touching_ice, .. } = frost.parameters;
    let ice_is_seen = matches!(inflow, Inflow::AsPrinted | Inflow::PassiveDiffuses)
        || edge == Edge::Reflecting && ring_touching_ice == RingTouchingIce::Mean;
    before.iter().enumerate().all(|(ordinal, &before)| {
        let was_ice = before >= 1.0;
        (was_ice && !ice_is_seen) || before.to_bits() == frost.u(ordinal).to_bits()
    })
}

/// Cells joined to ice by neighbours, and where asked for by points of the ring that they share.
fn reach(frost: &Frost, through_ring: bool) -> Vec<bool> {
    let region = &frost.region;
    let mut reached: Vec<bool> = frost.frozen.iter().map(|&step| step != NEVER).collect();
    let mut queue: Vec<usize> = (0..region.len()).filter(|&ordinal| reached[ordinal]).collect();
    while let Some(ordinal) = queue.pop() {
        for at in region.cells()[ordinal].neighbours() {
            let beyond = if region.contains(at) {
                [at; 6]
            } else if through_ring {
                at.neighbours()
            } else {
                continue;
            };
            for next in beyond.into_iter().filter_map(|q| region.ordinal(q)) {
                if !std::mem::replace(&mut reached[next], true) {
                    queue.push(next);
                }
            }
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frost::tests::{GIVEN, NINE_TENTHS, any_case};

    fn film(region: &Region, starts: &[Axial], parameters: Parameters, rule: EndRule, limit: u64) -> Film {
        Film::new(region, starts, parameters, Seed(1), rule, limit).unwrap()
    }

    #[test]
    fn seven_of_ten_are_seven_tenths() {
        assert_eq!(needed(0.7, 10), 7);
        for n in 1..60 {
            for k in 1..=n {
                assert_eq!(needed(k as f64 / n as f64, n), k);
            }
            assert_eq!(needed(1e-300, n), 1);
        }
        assert_eq!(needed(0.9, 2083), 1875);
    }

    #[test]
    fn the_end_frame_is_the_first_with_enough_and_the_crossing_lies_before_it() {
        let region = Region::disc(150);
        let end = film(&region, &[Axial::ORIGIN], GIVEN, NINE_TENTHS, 400).run().reached().unwrap();
        let counts = growth(&region, &[Axial::ORIGIN], GIVEN, Seed(1), end.frame).unwrap();
        let enough = needed(0.9, region.len());
        assert_eq!(counts.iter().position(|&count| count >= enough), Some(end.frame as usize));
        let (before, now) = (counts[end.frame as usize - 1] as f64, counts[end.frame as usize] as f64);
        let part = end.interpolated - (end.frame - 1) as f64;
        assert!(part > 0.0 && part <= 1.0);
        assert!((before + part * (now - before) - 0.9 * region.len() as f64).abs() < 1e-9);
    }

    #[test]
    fn the_border_is_another_end() {
        let region = Region::disc(150);
        let border = EndRule { share: 0.5, of: EndOf::Border };
        let mut by_border = film(&region, &[Axial::ORIGIN], GIVEN, border, 400);
        let end = by_border.run().reached().unwrap();
        let ice = region.border().into_iter().filter(|&i| by_border.frost().is_ice(i)).count();
        assert_eq!((ice, by_border.counting()), (by_border.counted(), region.border().len()));
        assert!(2 * ice >= region.border().len() && end.frame > 0);
    }

    #[test]
    fn what_is_ice_at_once_ends_in_frame_0() {
        let at_once = Some(Ending::Reached(EndFrame { frame: 0, interpolated: 0.0 }));
        let one = Region::hexagon(0);
        assert_eq!(film(&one, &[Axial::ORIGIN], GIVEN, NINE_TENTHS, 0).ending(), at_once);
        let all = Parameters { beta: 1.0, ..GIVEN };
        assert_eq!(film(&Region::hexagon(3), &[], all, NINE_TENTHS, 0).ending(), at_once);
    }

    #[test]
    fn pieces_without_a_start_stay_vapour() {
        let cells: Vec<Axial> = (0..10).map(|q| Axial::new(q, 0)).chain([Axial::new(20, 0)]).collect();
        let region = Region::new(cells).unwrap();
        let start = [Axial::ORIGIN];
        let all = EndRule { share: 1.0, of: EndOf::AllCells };
        assert_eq!(film(&region, &start, GIVEN, all, u64::MAX).ending(), Some(Ending::Unreachable));
        assert!(film(&region, &start, GIVEN, NINE_TENTHS, 10_000).run().reached().is_some());
        assert_eq!(film(&region, &[], GIVEN, NINE_TENTHS, u64::MAX).ending(), Some(Ending::Unreachable));
    }

    #[test]
    fn a_film_that_has_run_dry_ends_without_a_limit() {
        let start = [Axial::ORIGIN];
        let dry = |parameters| {
            let mut film = film(&Region::disc(100), &start, parameters, NINE_TENTHS, u64::MAX);
            assert_eq!(film.run(), Ending::Unreachable);
            film.frame()
        };
        assert!(dry(Parameters { gamma: 0.0, beta: 0.05, ..GIVEN }) <= 100);
        assert!(dry(Parameters { gamma: 0.0, ..GIVEN }) < 1000);
        assert!(dry(Parameters { threshold: 1.0, ..GIVEN }) < 1000);
        assert!(dry(Parameters { threshold: 0.8, redraw: Redraw::Cell, ..GIVEN }) < 2000);
        // No vapour at all: a frame that changes nothing.
        for inflow in Inflow::ALL {
            assert!(dry(Parameters { gamma: 0.0, beta: 0.0, alpha: 0.0, inflow, ..GIVEN }) < 100);
        }
        let vapour = Parameters { threshold: 1.0, inflow: Inflow::PassiveIsVapour, ..GIVEN };
        assert!(dry(vapour) < 2000);
    }

    #[test]
    fn a_limit_is_not_a_verdict() {
        let mut film = film(&Region::disc(100), &[Axial::ORIGIN], GIVEN, NINE_TENTHS, 3);
        assert_eq!((film.run(), film.frame()), (Ending::Limit, 3));
    }

    /// What is called unreachable is not reached by going on.
    #[test]
    fn unreachable_is_never_said_too_soon() {
        let mut at_work = 0;
        for case in 0..1500 {
            let (region, starts, parameters) = any_case(case);
            let rule = EndRule { share: 0.8, of: EndOf::AllCells };
            let mut film = film(&region, &starts, parameters, rule, 300);
            if film.run() == Ending::Unreachable {
                let (said, ice) = (film.frame(), film.frost().ice());
                (0..200).for_each(|_| film.advance());
                assert!(film.counted() < film.needed, "case {case}: {parameters:?}");
                assert!(said == 0 || film.frost().ice() == ice, "case {case}: {parameters:?}");
                at_work += usize::from(said > 0);
            }
        }
        assert!(at_work > 50, "only {at_work} cases ran dry: they show little");
    }

    #[test]
    fn shares_that_are_none_are_refused() {
        for share in [0.0, -1.0, 1.01, f64::NAN] {
            let rule = EndRule { share, of: EndOf::AllCells };
            let error = Film::new(&Region::hexagon(1), &[], GIVEN, Seed(1), rule, 1).map(|_| ()).unwrap_err();
            assert!(matches!(error, FrostError::Share(_)));
        }
    }
}
