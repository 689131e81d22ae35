//! Claims: statements of a paper that a run can contradict.

use std::fmt;

/// A statement of a paper that a run can contradict, written before the run.
#[derive(Debug)]
pub struct Claim {
    /// `paper/experiment/claim`.
    pub id: &'static str,
    /// Page, table, cell.
    pub source: &'static str,
    /// What the paper says, in our words.
    pub says: &'static str,
    /// What is expected of the measured number.
    pub expect: Expect,
    /// Of which number, where several seeds are used.
    pub statistic: Statistic,
    /// Why this expectation and this tolerance.
    pub reason: &'static str,
    /// Readings under which the claim is known to fail, each with its evidence.
    pub known: &'static [Known],
}

/// A failure that is expected, and the evidence for it.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// The part of the reading that it applies to, `enum=variant` joined by `;`; empty for every reading.
    pub reading: &'static str,
    /// Why the claim fails there.
    pub evidence: &'static str,
}

impl Claim {
    /// The evidence for a failure under this reading, if one is expected.
    pub fn known_under(&self, reading: &str) -> Option<&'static str> {
        let parts: Vec<&str> = reading.split(';').collect();
        self.known
            .iter()
            .find(|known| known.reading.split(';').all(|part| part.is_empty() || parts.contains(&part)))
            .map(|known| known.evidence)
    }
}

/// What is expected of a measured number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expect {
    /// At most `within` away from `value`.
    Near {
        /// The printed value.
        value: f64,
        /// The tolerance.
        within: f64,
    },
    /// From the first to the second, both included.
    Between(f64, f64),
    /// This much or more.
    AtLeast(f64),
    /// This much or less.
    AtMost(f64),
    /// A series of which each number is greater than the one before; measured is the smallest rise.
    Rises,
    /// Greater than the finding for another claim, under the same reading and seed.
    Exceeds(&'static str),
    /// A statement; measured is 1 or 0.
    True,
}

impl Expect {
    /// The numbers that satisfy it: from, to, and whether `from` itself does.
    pub(crate) fn accepted(&self) -> (f64, f64, bool) {
        match *self {
            Expect::Near { value, within } => (value - within, value + within, true),
            Expect::Between(least, greatest) => (least, greatest, true),
            Expect::AtLeast(least) => (least, f64::INFINITY, true),
            Expect::AtMost(greatest) => (f64::NEG_INFINITY, greatest, true),
            Expect::Rises | Expect::Exceeds(_) => (0.0, f64::INFINITY, false),
            Expect::True => (1.0, 1.0, true),
        }
    }

    /// The tolerance, where there is one.
    pub fn tolerance(&self) -> Option<f64> {
        match *self {
            Expect::Near { within, .. } => Some(within),
            _ => None,
        }
    }
}

impl fmt::Display for Expect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Expect::Near { value, .. } => write!(f, "{value}"),
            Expect::Between(least, greatest) => write!(f, "{least}..{greatest}"),
            Expect::AtLeast(least) => write!(f, ">={least}"),
            Expect::AtMost(greatest) => write!(f, "<={greatest}"),
            Expect::Rises => f.write_str("rises"),
            Expect::Exceeds(other) => write!(f, ">{other}"),
            Expect::True => f.write_str("true"),
        }
    }
}

/// Of which number the expectation speaks, where several seeds are used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Statistic {
    /// Every one; measured is the number that is furthest from what is accepted.
    Each,
    /// The mean over the seeds, with its 95 % interval.
    Mean,
    /// The share of seeds that meet the expectation is at least this, with its 95 % interval.
    Share(f64),
}

impl fmt::Display for Statistic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Statistic::Each => f.write_str("each"),
            Statistic::Mean => f.write_str("mean"),
            Statistic::Share(least) => write!(f, "share of seeds >= {least}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_failure_belongs_to_its_readings_only() {
        const CLAIM: Claim = Claim {
            id: "p/e/c",
            source: "",
            says: "",
            expect: Expect::True,
            statistic: Statistic::Each,
            reason: "",
            known: &[Known { reading: "inflow=as-printed;redraw=step", evidence: "arithmetic" }],
        };
        assert_eq!(CLAIM.known_under("inflow=as-printed;redraw=step;edge=held"), Some("arithmetic"));
        assert_eq!(CLAIM.known_under("inflow=as-printed;redraw=frame"), None);
    }
}
