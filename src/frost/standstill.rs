//! What shows that a film can never end (§3.4): it would be awaited for ever.

use super::parameters::Parameters;
use super::readings::{Edge, Inflow, Redraw, RingTouchingIce};
use super::reference::State;
use super::{Frost, NEVER};

/// Room for rounding in sums of many u.
const MARGIN: f64 = 1e-9;

/// Looks out for a state from which there can never be new ice.
#[derive(Clone, Debug)]
pub(super) struct Watch {
    // Cells that ice may come to.
    may_freeze: Vec<bool>,
    anywhere: bool,
    next_look: u64,
    seen: Option<Vec<f64>>,
}

impl Watch {
    pub(super) fn new(frost: &Frost) -> Self {
        let Parameters { beta, edge, ring_touching_ice, .. } = frost.parameters;
        // A mean that includes ice may lift a cell of the next piece to 1.
        let over_the_ring = edge == Edge::Reflecting && ring_touching_ice == RingTouchingIce::Mean;
        // A piece that no ice comes to only takes means: of its u, and of what the edge shows, which is beta, 0, or a
        // mean of what is not ice. None exceeds its greatest part; so all stays below 1 if all vapour is, and a held beta.
        let held = if edge == Edge::Held { beta } else { 0.0 };
        let vapour = (0..frost.region().len()).filter(|&ordinal| !frost.is_ice(ordinal));
        let anywhere = vapour.map(|ordinal| frost.u(ordinal)).fold(held, f64::max) >= 1.0 - MARGIN;
        let may_freeze = match anywhere {
            true => vec![true; frost.region().len()],
            false => reach(frost, over_the_ring),
        };
        Self { may_freeze, anywhere, next_look: 16, seen: None }
    }

    /// Whether ice may come to this cell at all.
    pub(super) fn may_freeze(&self, ordinal: usize) -> bool {
        self.may_freeze[ordinal]
    }

    /// Whether nothing can freeze any more. Looks ever more rarely, so that it costs little beside the frames.
    pub(super) fn sees_standstill(&mut self, frost: &Frost, frame: u64) -> bool {
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
        is_starved(frost, self.anywhere)
    }
}

/// Whether no gamma comes any more to a cell that waits, and diffusion cannot lift one to 1.
///
/// `ReiterGated`: what a cell gives away arrives in its neighbours once, over a reflecting edge too; so no cell can
/// come to hold more than it has and all vapour together. Only a point of the ring beside a receptive cell makes
/// vapour, by giving back what that cell keeps.
///
/// `PassiveIsVapour`: where all that waits diffuses, u is a mean of what was, and no mean exceeds its greatest
/// part; only a point of the ring that shows ice would.
///
/// Both look at what cells hold now, so that it does not matter what they held at first; cells that no ice can come to
/// are left out, unless they may freeze `anywhere`.
fn is_starved(frost: &Frost, anywhere: bool) -> bool {
    let Parameters { beta, gamma, threshold, inflow, redraw, edge, ring_touching_ice, .. } = frost.parameters;
    let reflecting = edge == Edge::Reflecting;
    let shows_zero = ring_touching_ice == RingTouchingIce::Zero;
    let (dry, edge_holds) = match inflow {
        Inflow::ReiterGated if reflecting => (gamma == 0.0 || threshold >= 1.0, 0.0),
        Inflow::PassiveIsVapour if !reflecting => (threshold >= 1.0, beta),
        Inflow::PassiveIsVapour if shows_zero => (threshold >= 1.0, 0.0),
        _ => return false,
    };
    let may_stay_gated = threshold > 0.0 && redraw == Redraw::Cell;
    if !(dry || may_stay_gated) {
        return false;
    }
    let feeds = if anywhere { vec![true; frost.region().len()] } else { reach(frost, reflecting) };
    let (mut waiting, mut vapour, mut most_vapour) = (edge_holds, 0.0, 0.0);
    for ordinal in (0..frost.region.len()).filter(|&ordinal| feeds[ordinal]) {
        let u = frost.u(ordinal);
        match frost.state(ordinal) {
            State::Ice => {}
            State::Neighbour if !dry && frost.draws_above(ordinal) => return false,
            State::Neighbour => waiting = f64::max(waiting, u),
            State::Other => (vapour, most_vapour) = (vapour + u, f64::max(most_vapour, u)),
        }
    }
    match inflow {
        Inflow::ReiterGated => waiting + vapour < 1.0 - MARGIN && !ring_makes_vapour(frost, shows_zero),
        _ => f64::max(waiting, most_vapour) < 1.0 - MARGIN,
    }
}

/// Whether a point of the ring shows something and touches a receptive cell that has something.
fn ring_makes_vapour(frost: &Frost, zero_on_ice: bool) -> bool {
    frost.region.ring().into_iter().any(|at| {
        let inner = || at.neighbours().into_iter().filter_map(|q| frost.region.ordinal(q));
        let shows_zero = zero_on_ice && inner().any(|q| frost.is_ice(q));
        !shows_zero && inner().any(|q| frost.state(q) != State::Other && frost.u(q) > 0.0)
    })
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
            let inside = region.ordinal(at);
            let over = if inside.is_none() && through_ring { &at.neighbours()[..] } else { &[] };
            for next in inside.into_iter().chain(over.iter().filter_map(|q| region.ordinal(*q))) {
                if !reached[next] {
                    reached[next] = true;
                    queue.push(next);
                }
            }
        }
    }
    reached
}
