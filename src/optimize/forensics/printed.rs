//! A printed search: its digits, and what exactly they say.

use super::exact::{Ratio, Span};
use crate::reading::Reading;
use crate::rng::Moment;

/// A decimal as it is printed: `0.250000` has other digits than `0.25`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decimal {
    units: i128,
    places: u32,
}

/// How a number became its printed digits. A unit is one in the last printed place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Printing {
    /// The digits are the number.
    Exact,
    /// The next number of so many places that is not below it: at most a unit less than the digits.
    Ceiling,
    /// The nearest: at most half a unit from the digits.
    Rounded,
    /// The last that is not above it, cut off: at most a unit more than the digits.
    Floor,
}

impl Reading for Printing {
    const QUANTITY: &'static str = "printing";
    const ALL: &'static [Self] = &[Self::Exact, Self::Ceiling, Self::Rounded, Self::Floor];

    fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Ceiling => "ceiling",
            Self::Rounded => "rounded",
            Self::Floor => "floor",
        }
    }
}

/// Why a table cannot be examined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ForensicsError {
    /// Not a decimal.
    #[error("`{0}` is no decimal; up to 12 digits with up to 12 places are accepted, as in 0.261856 or 1e-6")]
    Decimal(String),
    /// One step shows no rule.
    #[error("{0} rows; at least three iterates are needed, two steps of the search")]
    Rows(usize),
    /// A search with this step length goes nowhere.
    #[error("the step length is {0}; above 0 is accepted")]
    Eta(String),
}

/// Digits that keep every later product far from 128 bits.
const MOST_DIGITS: usize = 12;

impl Decimal {
    /// Reads `0.261856`, `160` or `1e-6`.
    ///
    /// # Errors
    ///
    /// [`ForensicsError::Decimal`].
    pub fn parse(text: &str) -> Result<Self, ForensicsError> {
        Self::read(text.trim()).ok_or_else(|| ForensicsError::Decimal(text.chars().take(40).collect()))
    }

    fn read(text: &str) -> Option<Self> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (sign, digits) = match mantissa.strip_prefix('-') {
            Some(rest) => (-1, rest),
            None => (1, mantissa.strip_prefix('+').unwrap_or(mantissa)),
        };
        let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
        let all = format!("{whole}{part}");
        let significant = all.trim_start_matches('0').len();
        if all.is_empty() || significant > MOST_DIGITS || !all.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        let units = sign * all.parse::<i128>().ok()?;
        let places = i32::try_from(part.len()).ok()?.checked_sub(exponent)?;
        match u32::try_from(places) {
            Ok(places) => (places as usize <= MOST_DIGITS).then_some(Self { units, places }),
            Err(_) if places.unsigned_abs() as usize <= MOST_DIGITS - significant.min(MOST_DIGITS) => {
                Some(Self { units: units.checked_mul(ten_to(places.unsigned_abs()))?, places: 0 })
            }
            Err(_) => None,
        }
    }

    /// The number that the digits are.
    pub fn value(self) -> Ratio {
        Self::ratio(self.units, ten_to(self.places))
    }

    /// The numbers that are printed so; half-open ends count as closed, so nothing possible is left out.
    pub fn span(self, printing: Printing) -> Span {
        let halves = |from: i128, to: i128| {
            let end = |k: i128| Self::ratio(2 * self.units + k, 2 * ten_to(self.places));
            Span::between(end(from), end(to))
        };
        match printing {
            Printing::Exact => halves(0, 0),
            Printing::Ceiling => halves(-2, 0),
            Printing::Rounded => halves(-1, 1),
            Printing::Floor if self.units < 0 => halves(-2, 0), // cut off towards 0
            Printing::Floor => halves(0, 2),
        }
    }

    /// Twelve digits over at most 2 · 10^12: always a fraction.
    fn ratio(numerator: i128, denominator: i128) -> Ratio {
        Ratio::new(numerator, denominator).unwrap_or(Ratio::ZERO)
    }

    /// How many units of `places` places it is, if that is whole.
    pub(super) fn in_units(self, places: u32) -> Option<i128> {
        places.checked_sub(self.places).map(|more| self.units * ten_to(more))
    }

    /// The same number with at least so many places, where zeros at its end were left out.
    pub fn with_places(self, places: u32) -> Self {
        let places = places.min(MOST_DIGITS as u32).max(self.places);
        Self { units: self.units * ten_to(places - self.places), places }
    }

    /// Number of printed places.
    pub(super) fn places(self) -> u32 {
        self.places
    }
}

const fn ten_to(power: u32) -> i128 {
    let mut ten = 1;
    let mut k = 0;
    while k < power {
        ten *= 10;
        k += 1;
    }
    ten
}

/// The printed iterates of a search x ← x − η f′(x), with f(x) = (y(x) − target)², or f(x) = y(x) without a target.
#[derive(Clone, Debug, PartialEq)]
pub struct PrintedSearch {
    /// x and y of each iterate, in order.
    pub rows: Vec<(Decimal, Decimal)>,
    /// η, exact.
    pub eta: Decimal,
    /// The target of y, exact.
    pub target: Option<Decimal>,
    /// How x was printed.
    pub x_printed: Printing,
    /// Whether the first x is exact, because somebody chose it.
    pub first_is_exact: bool,
}

impl PrintedSearch {
    /// A search whose x are rounded, but for the first, which is exact.
    ///
    /// # Errors
    ///
    /// What cannot be examined: [`ForensicsError`].
    pub fn new(rows: &[(&str, &str)], eta: &str, target: Option<&str>) -> Result<Self, ForensicsError> {
        let rows = rows
            .iter()
            .map(|(x, y)| Ok((Decimal::parse(x)?, Decimal::parse(y)?)))
            .collect::<Result<Vec<_>, _>>()?;
        if rows.len() < 3 {
            return Err(ForensicsError::Rows(rows.len()));
        }
        let step_length = Decimal::parse(eta)?;
        if step_length.units <= 0 {
            return Err(ForensicsError::Eta(eta.to_owned()));
        }
        Ok(Self {
            rows,
            eta: step_length,
            target: target.map(Decimal::parse).transpose()?,
            x_printed: Printing::Rounded,
            first_is_exact: true,
        })
    }

    /// The number of steps: one less than rows.
    pub fn steps(&self) -> usize {
        self.rows.len() - 1
    }

    /// Where the iterate of this row may be.
    pub fn x(&self, row: usize) -> Span {
        let exact = row == 0 && self.first_is_exact;
        self.rows[row].0.span(if exact { Printing::Exact } else { self.x_printed })
    }

    /// The step from this row to the next, x_{i+1} − x_i.
    pub fn step(&self, row: usize) -> Span {
        self.x(row + 1).minus(self.x(row))
    }

    /// The derivative that the step from this row used, −(x_{i+1} − x_i)/η.
    pub fn slope(&self, row: usize) -> Span {
        self.step(row).opposite().over(Span::point(self.eta.value()))
    }

    /// What y may be at a row.
    pub fn y(&self, row: usize, printing: Printing) -> Span {
        self.rows[row].1.span(printing)
    }

    /// How far y may be from the target at a row; y itself without one.
    pub fn miss(&self, row: usize, printing: Printing) -> Span {
        let y = self.y(row, printing);
        self.target.map_or(y, |target| y.minus(Span::point(target.value())))
    }

    /// What f may be at a row.
    pub fn f(&self, row: usize, printing: Printing) -> Span {
        let miss = self.miss(row, printing);
        if self.target.is_some() { miss.squared() } else { miss }
    }

    /// A table that knows no rule: each step multiplied by a factor of its own from 2^-octaves to 2^octaves (uniform in
    /// its logarithm), printed to the same places; x₀ and all y as they were. How many such tables a hypothesis
    /// survives says what its survival is worth.
    pub fn scrambled(&self, octaves: f64, chance: &Moment) -> Self {
        let mut place = chance.place(0, 0, 0);
        let mut other = self.clone();
        let places = self.rows.iter().map(|row| row.0.places).max().unwrap_or(0);
        let units = |row: usize| self.rows[row].0.in_units(places).unwrap_or(0);
        for row in 0..self.steps() {
            let factor = libm::exp2(octaves * (2.0 * place.uniform() - 1.0));
            let step = libm::round((units(row + 1) - units(row)) as f64 * factor) as i128;
            let from = other.rows[row].0.in_units(places).unwrap_or(0);
            other.rows[row + 1].0 = Decimal { units: from + step, places };
        }
        other
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    #[test]
    fn digits_are_read_as_printed() {
        let units = |text| Decimal::parse(text).map(|d| (d.units, d.places));
        assert_eq!(units("0.261856"), Ok((261_856, 6)));
        assert_eq!(units("0.250000"), Ok((250_000, 6)));
        assert_eq!(units(" -12.5 "), Ok((-125, 1)));
        assert_eq!((units("1e-6"), units("1.5E2"), units("2e3")), (Ok((1, 6)), Ok((150, 0)), Ok((2000, 0))));
        for wrong in
            ["", "-", ".", "0.2.5", "1e", "1e99", "1e-99", "0x1", "nan", "1,5", "1234567890123", "1e12", "٣"]
        {
            assert!(Decimal::parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn zeros_that_were_left_out_come_back() {
        let short = Decimal::parse("0.25").unwrap();
        assert_eq!(short.with_places(6), Decimal::parse("0.250000").unwrap());
        assert_eq!(short.with_places(1), short);
    }

    #[test]
    fn printing_bounds_the_number() {
        let span = |text, printing| Decimal::parse(text).unwrap().span(printing).to_string();
        assert_eq!(span("0.25", Printing::Exact), "0.25");
        assert_eq!(span("0.25", Printing::Rounded), "0.245..0.255");
        assert_eq!(span("0.250", Printing::Rounded), "0.2495..0.2505");
        assert_eq!(span("152", Printing::Ceiling), "151..152");
        assert_eq!(span("152", Printing::Floor), "152..153");
        assert_eq!(span("-152", Printing::Floor), "-153..-152");
    }

    #[test]
    fn a_step_gives_its_slope_to_a_unit() {
        let rows = [("0.25", "160"), ("0.261856", "152"), ("0.295357", "139")];
        let mut search = PrintedSearch::new(&rows, "1e-6", Some("130")).unwrap();
        assert_eq!(search.slope(0).to_string(), "-11856.5..-11855.5");
        assert_eq!(search.slope(1).to_string(), "-33502..-33500");
        assert_eq!(search.f(0, Printing::Ceiling).to_string(), "841..900");
        search.x_printed = Printing::Floor;
        assert_eq!(search.slope(0).to_string(), "-11857..-11856");
    }

    #[test]
    fn what_shows_no_rule_is_refused() {
        let rows = [("0.25", "160"), ("0.26", "152")];
        assert_eq!(PrintedSearch::new(&rows, "1", None), Err(ForensicsError::Rows(2)));
        let rows = [("0.25", "160"), ("0.26", "152"), ("0.27", "152")];
        assert_eq!(PrintedSearch::new(&rows, "-1", None), Err(ForensicsError::Eta("-1".to_owned())));
    }

    #[test]
    fn a_scrambled_table_keeps_start_and_endings() {
        let rows = [("0.25", "160"), ("0.261856", "152"), ("0.295357", "139")];
        let search = PrintedSearch::new(&rows, "1e-6", Some("130")).unwrap();
        let other = search.scrambled(1.0, &Seed(1).stream("s").at(0));
        assert_eq!(other.x(0), search.x(0));
        for row in 0..2 {
            assert_eq!(other.rows[row + 1].1, search.rows[row + 1].1);
            let factor = other.slope(row).to_f64().0 / search.slope(row).to_f64().0;
            assert!((0.49..2.01).contains(&factor), "{factor}");
        }
        assert_ne!(other, search);
    }
}
