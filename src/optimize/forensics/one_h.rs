//! One h for all steps: differences of whole numbers of y.

use super::exact::{Ratio, Span};
use super::printed::{Decimal, PrintedSearch, Printing};
use super::rules::Side;

/// The differences that are tried: h and y beside an iterate, as far as they may go.
#[derive(Clone, Debug, PartialEq)]
pub struct Differences {
    /// The least h and the greatest; above 0.
    pub h: (Decimal, Decimal),
    /// The least y and the greatest, in units of its last printed place.
    pub y: (i128, i128),
}

/// What is left of h.
pub(super) struct Tried {
    pub left: Vec<Span>,
    pub steps: Vec<usize>,
}

/// The most whole numbers, and the most intervals, that are tried.
const MOST: i128 = 100_000;
/// The furthest from the target that y is tried: the square is the length of a list.
const FURTHEST: i128 = 2000;

impl Differences {
    /// Intervals of h with which whole y give every step: s_i c h is, in units of y², a difference of two squares
    /// (c = 2 for central differences, otherwise 1) or, by the chain rule, 2 e_i times a difference of y. None if
    /// the target is not whole in these units, a printed y is outside its range, or there are too many to try.
    pub(super) fn shared(&self, search: &PrintedSearch, side: Side, chain: bool) -> Option<Tried> {
        let places = search.rows.iter().map(|row| row.1.places()).max()?;
        let target = search.target?.in_units(places)?;
        let unit = Ratio::new(1, 10i128.checked_pow(places)?)?;
        let range = (self.y.0 - target, self.y.1 - target);
        if range.0.abs().max(range.1.abs()) > FURTHEST {
            return None;
        }
        let arms = Ratio::whole(if side == Side::Central { 2 } else { 1 });
        let mut rows: Vec<(usize, Span, i128)> = (0..search.steps())
            .map(|i| {
                let scale = Span::point(arms).over(Span::point(unit).squared());
                Some((i, search.slope(i).times(scale), search.rows[i].1.in_units(places)? - target))
            })
            .collect::<Option<_>>()?;
        if rows.iter().any(|(_, _, miss)| !(range.0..=range.1).contains(miss)) {
            return None; // a range that leaves out what is printed is none to refute by
        }
        // A slope that may be 0 is a difference of 0 whatever h is.
        rows.retain(|(_, slope, _)| slope.sign().is_some_and(|sign| sign != 0));
        // The flattest first: it has the fewest differences to try.
        let size = |slope: &Span| slope.magnitude().high;
        rows.sort_by(|a, b| size(&a.1).cmp(&size(&b.1)).then(a.0.cmp(&b.0)));
        let squares = (side == Side::Central && !chain).then(|| DifferencesOfSquares::new(range));

        let span = |decimal: Decimal| decimal.span(Printing::Exact);
        let mut left = vec![Span { low: span(self.h.0).low, high: span(self.h.1).high }];
        for (_, slope, miss) in &rows {
            let can_be = |n: i128| match (chain, side, &squares) {
                (false, Side::Forward, _) => is_square_of(n + miss * miss, range),
                (false, Side::Backward, _) => is_square_of(miss * miss - n, range),
                (false, Side::Central, squares) => squares.as_ref().is_some_and(|all| all.has(n)),
                (true, ..) => {
                    *miss != 0 && n % (2 * miss) == 0 && is_change(n / (2 * miss), *miss, side, range)
                }
            };
            let inverse = Span::point(Ratio::whole(1)).over(*slope);
            let mut next = Vec::new();
            for h in left {
                let numbers = h.times(*slope);
                let (from, to) = (numbers.low?.ceiling(), numbers.high?.floor());
                if to - from > MOST || next.len() as i128 > MOST {
                    return None;
                }
                let fits = |n: &i128| can_be(*n);
                next.extend(
                    (from..=to)
                        .filter(fits)
                        .filter_map(|n| h.meet(Span::point(Ratio::whole(n)).times(inverse))),
                );
            }
            left = merged(next);
        }
        let mut steps: Vec<usize> = rows.iter().map(|row| row.0).collect();
        steps.sort_unstable();
        Some(Tried { left, steps })
    }
}

/// What two lists of intervals share: an h for two tables at once.
pub fn shared_by(left: &[Span], right: &[Span]) -> Vec<Span> {
    merged(left.iter().flat_map(|a| right.iter().filter_map(|b| a.meet(*b))).collect())
}

/// In order, and joined where they touch.
fn merged(mut spans: Vec<Span>) -> Vec<Span> {
    spans.sort_by(|a, b| a.low.cmp(&b.low).then(a.high.cmp(&b.high)));
    let mut out: Vec<Span> = Vec::new();
    for span in spans {
        match out.last_mut() {
            Some(last) if last.meet(span).is_some() => last.high = last.high.max(span.high),
            _ => out.push(span),
        }
    }
    out
}

fn is_square_of(number: i128, range: (i128, i128)) -> bool {
    if number < 0 {
        return false;
    }
    let root = number.isqrt();
    let within = |root: i128| (range.0..=range.1).contains(&root);
    root * root == number && (within(root) || within(-root))
}

/// Whether y can change so from (or to, or around) a row that misses the target by `miss`.
fn is_change(change: i128, miss: i128, side: Side, range: (i128, i128)) -> bool {
    let within = |miss: i128| (range.0..=range.1).contains(&miss);
    match side {
        Side::Forward => within(miss + change),
        Side::Backward => within(miss - change),
        Side::Central => change.abs() <= range.1 - range.0,
    }
}

/// All a² − b² with a and b in a range.
struct DifferencesOfSquares {
    most: i128,
    has: Vec<bool>,
}

impl DifferencesOfSquares {
    fn new(range: (i128, i128)) -> Self {
        let mut squares: Vec<i128> = (range.0..=range.1).map(|a| a * a).collect();
        squares.sort_unstable();
        squares.dedup();
        let most = squares.last().copied().unwrap_or(0);
        let mut has = vec![false; 2 * most as usize + 1];
        for a in &squares {
            for b in &squares {
                has[(a - b + most) as usize] = true;
            }
        }
        Self { most, has }
    }

    fn has(&self, n: i128) -> bool {
        n.abs() <= self.most && self.has[(n + self.most) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_and_their_differences() {
        assert!(is_square_of(49, (-10, 10)) && is_square_of(49, (-8, 0)) && is_square_of(0, (0, 5)));
        assert!(!is_square_of(50, (-10, 10)) && !is_square_of(49, (0, 6)) && !is_square_of(-4, (-10, 10)));
        let all = DifferencesOfSquares::new((-3, 5));
        let found: Vec<i128> = (-30..=30).filter(|n| all.has(*n)).collect();
        let mut by_hand: Vec<i128> =
            (-3..=5i128).flat_map(|a| (-3..=5).map(move |b| a * a - b * b)).collect();
        by_hand.sort_unstable();
        by_hand.dedup();
        assert_eq!(found, by_hand);
    }

    #[test]
    fn intervals_that_touch_are_one() {
        let span = |a, b| Span::between(Ratio::whole(a), Ratio::whole(b));
        assert_eq!(merged(vec![span(4, 6), span(0, 2), span(1, 3)]), [span(0, 3), span(4, 6)]);
        assert_eq!(shared_by(&[span(0, 3), span(5, 9)], &[span(2, 6)]), [span(2, 3), span(5, 6)]);
    }
}
