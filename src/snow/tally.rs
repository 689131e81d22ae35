//! What shoots did, for the conditions of §1.1.3 to be tested by.

/// Counts of a crystal's growth. Those of tips are of the first layer, in one twelfth.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    // By order: cells that tips advanced by, and seconds that they lived for.
    tips: Vec<(u64, f64)>,
    // Above the first layer, without and with a branch below: cells that tips came to, and branches that began there.
    above: [(u64, u64); 2],
}

impl Tally {
    /// Mean speed of the tips of an order, cells/s: condition 4. None if there was none.
    pub fn tip_speed(&self, order: usize) -> Option<f64> {
        let (cells, seconds) = self.tips.get(order)?;
        (*seconds > 0.0).then(|| *cells as f64 / seconds)
    }

    /// The highest order that has grown.
    pub fn highest_order(&self) -> usize {
        self.tips.iter().rposition(|(cells, _)| *cells > 0).unwrap_or(0)
    }

    /// Share of the cells that tips above the first layer came to in which a branch began, where the layer below has
    /// branched (`below`) or has not: condition 6. None if they came to none.
    pub fn share_branched(&self, below: bool) -> Option<f64> {
        let (tried, branched) = self.above[usize::from(below)];
        (tried > 0).then(|| branched as f64 / tried as f64)
    }

    /// The counts of [`share_branched`](Self::share_branched): cells and branches.
    pub fn tried_and_branched(&self, below: bool) -> (u64, u64) {
        self.above[usize::from(below)]
    }

    pub(super) fn lived(&mut self, order: usize, seconds: f64) {
        self.of(order).1 += seconds;
    }

    pub(super) fn advanced(&mut self, order: usize) {
        self.of(order).0 += 1;
    }

    pub(super) fn tried(&mut self, below: bool, branched: bool) {
        let (tried, counted) = &mut self.above[usize::from(below)];
        *tried += 1;
        *counted += u64::from(branched);
    }

    fn of(&mut self, order: usize) -> &mut (u64, f64) {
        if self.tips.len() <= order {
            self.tips.resize(order + 1, (0, 0.0));
        }
        &mut self.tips[order]
    }
}
