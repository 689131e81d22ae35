//! Exact numbers: fractions of 128-bit integers, and intervals of them.
//!
//! An interval never loses a number that it should hold: what does not fit in 128 bits is widened to everything.

use std::cmp::Ordering;
use std::fmt;

/// A fraction in lowest terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ratio {
    numerator: i128,
    denominator: i128, // above 0
}

impl Ratio {
    /// 0.
    pub const ZERO: Self = Self::whole(0);

    /// A whole number.
    pub const fn whole(number: i128) -> Self {
        Self { numerator: number, denominator: 1 }
    }

    /// A fraction; none if the denominator is 0 or a number has no opposite.
    pub fn new(numerator: i128, denominator: i128) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        let divisor = gcd(numerator.checked_abs()?, denominator.checked_abs()?);
        let sign = denominator.signum();
        Some(Self { numerator: sign * (numerator / divisor), denominator: sign * (denominator / divisor) })
    }

    fn plus(self, other: Self) -> Option<Self> {
        let common = gcd(self.denominator, other.denominator);
        let (left, right) = (other.denominator / common, self.denominator / common);
        let numerator = self.numerator.checked_mul(left)?.checked_add(other.numerator.checked_mul(right)?)?;
        Self::new(numerator, self.denominator.checked_mul(left)?)
    }

    fn times(self, other: Self) -> Option<Self> {
        // Cut crosswise first, so that no product is larger than it must be.
        let a = gcd(self.numerator.checked_abs()?, other.denominator).max(1);
        let b = gcd(other.numerator.checked_abs()?, self.denominator).max(1);
        Self::new(
            (self.numerator / a).checked_mul(other.numerator / b)?,
            (self.denominator / b).checked_mul(other.denominator / a)?,
        )
    }

    fn opposite(self) -> Self {
        Self { numerator: -self.numerator, denominator: self.denominator }
    }

    fn inverse(self) -> Option<Self> {
        Self::new(self.denominator, self.numerator)
    }

    /// The greatest whole number that is not above it.
    pub fn floor(self) -> i128 {
        self.numerator.div_euclid(self.denominator)
    }

    /// The least whole number that is not below it.
    pub fn ceiling(self) -> i128 {
        -((-self.numerator).div_euclid(self.denominator))
    }

    /// The nearest double, for people and plots.
    pub fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

impl PartialOrd for Ratio {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Ratio {
    /// Exact without a product that could overflow: whole parts first, then the inverses of what is left.
    fn cmp(&self, other: &Self) -> Ordering {
        let (whole, theirs) = (self.floor(), other.floor());
        let left = self.numerator.rem_euclid(self.denominator);
        let right = other.numerator.rem_euclid(other.denominator);
        whole.cmp(&theirs).then_with(|| match (left, right) {
            (0, 0) => Ordering::Equal,
            (0, _) => Ordering::Less,
            (_, 0) => Ordering::Greater,
            _ => Self { numerator: other.denominator, denominator: right }
                .cmp(&Self { numerator: self.denominator, denominator: left }),
        })
    }
}

/// Of numbers that are not below 0.
fn gcd(mut a: i128, mut b: i128) -> i128 {
    while b != 0 {
        // Division of 128 bits is slow, and most numbers fit in 64.
        if let (Ok(mut short), Ok(mut shorter)) = (u64::try_from(a), u64::try_from(b)) {
            while shorter != 0 {
                (short, shorter) = (shorter, short % shorter);
            }
            return i128::from(short);
        }
        (a, b) = (b, a % b);
    }
    a
}

/// A closed interval; an end that is none is open to infinity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The least number.
    pub low: Option<Ratio>,
    /// The greatest number.
    pub high: Option<Ratio>,
}

impl Span {
    /// Every number.
    pub const EVERYTHING: Self = Self { low: None, high: None };

    /// One number.
    pub const fn point(at: Ratio) -> Self {
        Self { low: Some(at), high: Some(at) }
    }

    /// From one number to another.
    pub fn between(low: Ratio, high: Ratio) -> Self {
        Self { low: Some(low.min(high)), high: Some(low.max(high)) }
    }

    fn ends(self) -> Option<(Ratio, Ratio)> {
        Some((self.low?, self.high?))
    }

    /// The smallest interval that holds all these; everything if one of them is not known.
    pub(super) fn around(numbers: impl IntoIterator<Item = Option<Ratio>>) -> Self {
        let Some(all) = numbers.into_iter().collect::<Option<Vec<_>>>() else { return Self::EVERYTHING };
        Self { low: all.iter().min().copied(), high: all.iter().max().copied() }
    }

    /// The sums.
    pub fn plus(self, other: Self) -> Self {
        let sum = |a: Option<Ratio>, b: Option<Ratio>| a?.plus(b?);
        Self { low: sum(self.low, other.low), high: sum(self.high, other.high) }
    }

    /// The differences.
    pub fn minus(self, other: Self) -> Self {
        self.plus(other.opposite())
    }

    /// The opposites.
    pub fn opposite(self) -> Self {
        Self { low: self.high.map(Ratio::opposite), high: self.low.map(Ratio::opposite) }
    }

    /// The products.
    pub fn times(self, other: Self) -> Self {
        let (Some((a, b)), Some((c, d))) = (self.ends(), other.ends()) else { return Self::EVERYTHING };
        Self::around([a.times(c), a.times(d), b.times(c), b.times(d)])
    }

    /// The squares.
    pub fn squared(self) -> Self {
        let Some((low, high)) = self.ends() else { return Self { low: Some(Ratio::ZERO), high: None } };
        let zero = self.holds(Ratio::ZERO).then_some(Some(Ratio::ZERO));
        Self::around([low.times(low), high.times(high)].into_iter().chain(zero))
    }

    /// The absolute values.
    pub fn magnitude(self) -> Self {
        let Some((low, high)) = self.ends() else { return Self { low: Some(Ratio::ZERO), high: None } };
        let size = |number: Ratio| Some(number.max(number.opposite()));
        let zero = self.holds(Ratio::ZERO).then_some(Some(Ratio::ZERO));
        Self::around([size(low), size(high)].into_iter().chain(zero))
    }

    /// The quotients; everything if the divisor may be 0.
    pub fn over(self, other: Self) -> Self {
        match other.ends() {
            Some((low, high)) if !other.holds(Ratio::ZERO) => match (low.inverse(), high.inverse()) {
                (Some(a), Some(b)) => self.times(Self::between(a, b)),
                _ => Self::EVERYTHING,
            },
            _ => Self::EVERYTHING,
        }
    }

    /// What both hold, if anything.
    pub fn meet(self, other: Self) -> Option<Self> {
        let low = self.low.max(other.low); // none is below every number
        let high = match (self.high, other.high) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        match (low, high) {
            (Some(low), Some(high)) if low > high => None,
            _ => Some(Self { low, high }),
        }
    }

    /// Whether it holds a number.
    pub fn holds(self, number: Ratio) -> bool {
        self.low.is_none_or(|low| low <= number) && self.high.is_none_or(|high| number <= high)
    }

    /// -1, 0 or 1 if all its numbers have one sign.
    pub fn sign(self) -> Option<i8> {
        match (self.low, self.high) {
            (Some(low), _) if low > Ratio::ZERO => Some(1),
            (_, Some(high)) if high < Ratio::ZERO => Some(-1),
            (Some(low), Some(high)) if low == high => Some(0),
            _ => None,
        }
    }

    /// Its ends as doubles, for people and plots.
    pub fn to_f64(self) -> (f64, f64) {
        (self.low.map_or(f64::NEG_INFINITY, Ratio::to_f64), self.high.map_or(f64::INFINITY, Ratio::to_f64))
    }
}

impl fmt::Display for Span {
    /// Its ends to seven digits; one number if they agree.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = self.to_f64();
        let (low, high) = (seven_digits(low), seven_digits(high));
        if low == high { f.write_str(&low) } else { write!(f, "{low}..{high}") }
    }
}

/// A number to seven digits, without trailing zeros.
fn seven_digits(number: f64) -> String {
    let rounded: f64 = format!("{number:.6e}").parse().unwrap_or(number);
    let size = rounded.abs();
    if size > 0.0 && !(1e-4..1e12).contains(&size) { format!("{rounded:e}") } else { rounded.to_string() }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn ratio(a: i128, b: i128) -> Ratio {
        Ratio::new(a, b).unwrap()
    }

    fn span(a: i128, b: i128) -> Span {
        Span::between(Ratio::whole(a), Ratio::whole(b))
    }

    #[test]
    fn fractions_are_exact() {
        assert_eq!(ratio(1, 3).plus(ratio(1, 6)), Some(ratio(1, 2)));
        assert_eq!(ratio(-2, 3).times(ratio(3, -4)), Some(ratio(1, 2)));
        assert_eq!((ratio(-7, 2).floor(), ratio(-7, 2).ceiling()), (-4, -3));
        assert_eq!((ratio(6, 2).floor(), ratio(6, 2).ceiling()), (3, 3));
        assert!(Ratio::new(1, 0).is_none());
        // A third part in 10^36 is seen, where products would have 73 digits and doubles have 16.
        let big = 10i128.checked_pow(36).unwrap();
        assert!(ratio(big + 1, big) < ratio(big, big - 1));
    }

    #[test]
    fn what_does_not_fit_is_everything() {
        let big = Span::point(Ratio::whole(i128::MAX));
        assert_eq!(big.times(span(2, 2)), Span::EVERYTHING);
        assert_eq!(big.plus(span(1, 1)), Span::EVERYTHING);
        assert_eq!(span(1, 2).over(span(-1, 1)), Span::EVERYTHING);
        assert_eq!(span(1, 2).plus(Span::EVERYTHING), Span::EVERYTHING);
    }

    #[test]
    fn intervals_by_hand() {
        assert_eq!(span(-3, 2).squared(), span(0, 9));
        assert_eq!(span(-3, 2).magnitude(), span(0, 3));
        assert_eq!(span(-3, -2).squared(), span(4, 9));
        assert_eq!(span(1, 2).over(span(-4, -2)).to_string(), "-1..-0.25");
        assert_eq!(span(1, 3).meet(span(2, 5)), Some(span(2, 3)));
        assert_eq!(span(1, 2).meet(span(3, 5)), None);
        assert_eq!(span(1, 2).meet(Span::EVERYTHING), Some(span(1, 2)));
        assert_eq!((span(1, 2).sign(), span(-2, -1).sign(), span(-1, 1).sign()), (Some(1), Some(-1), None));
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Whatever numbers are taken from two intervals, the result's interval holds their result.
        #[test]
        fn intervals_hold_every_result(
            ends in prop::array::uniform4(-1000i128..1000), scale in 1i128..60, at in prop::array::uniform2(0i128..=8),
        ) {
            let [a, b, c, d] = ends.map(|end| ratio(end, scale));
            let within = |p: Ratio, q: Ratio, k: i128| {
                p.times(ratio(8 - k, 8)).unwrap().plus(q.times(ratio(k, 8)).unwrap()).unwrap()
            };
            let (x, y) = (within(a, b, at[0]), within(c, d, at[1]));
            let (s, t) = (Span::between(a, b), Span::between(c, d));
            prop_assert!(s.plus(t).holds(x.plus(y).unwrap()));
            prop_assert!(s.minus(t).holds(x.plus(y.opposite()).unwrap()));
            prop_assert!(s.times(t).holds(x.times(y).unwrap()));
            prop_assert!(s.squared().holds(x.times(x).unwrap()));
            if let Some(inverse) = y.inverse() {
                prop_assert!(s.over(t).holds(x.times(inverse).unwrap()));
            }
            prop_assert_eq!(x.cmp(&y), (x.to_f64()).total_cmp(&y.to_f64()).then(x.cmp(&y)));
        }
    }
}
