//! The count of ice by which a film ends (§3.4).

use super::Frost;
use super::end::{EndFrame, EndOf, EndRule};
use super::parameters::FrostError;
use super::standstill::Watch;

/// Ice among the cells that count, frame by frame.
#[derive(Clone, Debug)]
pub(super) struct Tally {
    share: f64,
    // Ordinals that count; none where all do.
    cells: Option<Vec<usize>>,
    counting: usize,
    needed: usize,
    counted: usize,
}

impl Tally {
    /// The count by this rule, in this frame.
    pub(super) fn new(rule: EndRule, frost: &Frost) -> Result<Self, FrostError> {
        Self::of(rule.share, (rule.of == EndOf::Border).then(|| frost.region().border()), frost)
    }

    /// The count of the cells of these ordinals, or of all, in this frame.
    pub(super) fn of(share: f64, cells: Option<Vec<usize>>, frost: &Frost) -> Result<Self, FrostError> {
        if !(share > 0.0 && share <= 1.0) {
            return Err(FrostError::Share(share));
        }
        let counting = cells.as_ref().map_or(frost.region().len(), Vec::len);
        let mut tally = Self { share, cells, counting, needed: needed(share, counting), counted: 0 };
        tally.counted = tally.ice(frost);
        Ok(tally)
    }

    /// Ice among the cells that count.
    pub(super) fn counted(&self) -> usize {
        self.counted
    }

    /// Number of cells that count.
    pub(super) fn counting(&self) -> usize {
        self.counting
    }

    /// How many of them are enough.
    #[cfg(test)]
    pub(super) fn needed(&self) -> usize {
        self.needed
    }

    pub(super) fn is_enough(&self) -> bool {
        self.counted >= self.needed
    }

    /// Whether ice may come to enough of them.
    pub(super) fn may_be_enough(&self, watch: &Watch) -> bool {
        self.count(|ordinal| watch.may_freeze(ordinal)) >= self.needed
    }

    /// Takes the count of the next frame; the end frame, if there is enough in it.
    pub(super) fn crossing(&mut self, frost: &Frost, frame: u64) -> Option<EndFrame> {
        let before = self.counted;
        self.counted = self.ice(frost);
        self.is_enough().then(|| {
            let aim = self.share * self.counting as f64;
            let part = (aim - before as f64) / (self.counted - before) as f64;
            EndFrame { frame, interpolated: (frame - 1) as f64 + part.clamp(0.0, 1.0) }
        })
    }

    fn ice(&self, frost: &Frost) -> usize {
        match &self.cells {
            None => frost.ice(),
            Some(_) => self.count(|ordinal| frost.is_ice(ordinal)),
        }
    }

    fn count(&self, is: impl Fn(usize) -> bool) -> usize {
        match &self.cells {
            None => (0..self.counting).filter(|&ordinal| is(ordinal)).count(),
            Some(cells) => cells.iter().filter(|&&ordinal| is(ordinal)).count(),
        }
    }
}

/// The least k with `k / n >= share` as computed, so that 7 of 10 are 0.7.
pub(super) fn needed(share: f64, n: usize) -> usize {
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
