//! A hypothesis against a printed search.

use super::exact::{Ratio, Span};
use super::one_h::{Differences, Tried};
use super::printed::{PrintedSearch, Printing};
use super::rules::{Hypothesis, Rule};

/// What the digits say of a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing printed contradicts it. Intervals of one row are not tied to those of the next through x, whose last
    /// digits they share: a margin of a few units of the last place is on the side of survival.
    Survives,
    /// The printed digits contradict it: a proof.
    Refuted,
    /// It has a free number for every step, no step to test, or too many possibilities to try.
    Open,
}

impl Verdict {
    /// `survives`, `refuted` or `open`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Survives => "survives",
            Self::Refuted => "refuted",
            Self::Open => "open",
        }
    }
}

/// A hypothesis that was held against a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Examined {
    /// The hypothesis.
    pub hypothesis: Hypothesis,
    /// The verdict.
    pub verdict: Verdict,
    /// Steps whose slope it has to give.
    pub tested: Vec<usize>,
    /// The steps that refute it: each alone where one is enough, otherwise together.
    pub refuted_by: Vec<usize>,
    /// The slope that it predicts for each step, where it predicts one.
    pub predicted: Vec<Option<Span>>,
    /// What is left for the free number (not the first slope), as intervals.
    pub left: Vec<Span>,
}

impl Examined {
    /// What is left of its free number, in words; empty if it has none but the first slope.
    pub fn detail(&self) -> String {
        let Some(free) = self.hypothesis.rule.free().iter().find(|free| **free != "first slope") else {
            return String::new();
        };
        match (self.verdict, self.left.as_slice()) {
            (Verdict::Open, _) => String::new(),
            (_, []) => format!("no {free} fits all steps"),
            (_, [one]) => format!("{free} in {one}"),
            (_, [first, .., last]) => {
                format!("{free} in {} intervals from {} to {}", self.left.len(), first, last)
            }
        }
    }
}

/// Holds a hypothesis against a table; none if it speaks of a target and there is none.
pub fn examine(search: &PrintedSearch, hypothesis: Hypothesis, h: &Differences) -> Option<Examined> {
    if hypothesis.rule.needs_target() && search.target.is_none() {
        return None;
    }
    let case = Case { search, y: hypothesis.y };
    let mut found = match hypothesis.rule {
        Rule::Signs => case.signs(),
        Rule::BackwardSecant => case.secant(&|row| case.f(row)),
        Rule::SecantUnsquared => case.secant(&|row| case.unsquared(row)),
        Rule::SecantOfAnyEta => case.any_eta(&|row| case.f(row)),
        Rule::SecantUnsquaredOfAnyEta => case.any_eta(&|row| case.unsquared(row)),
        Rule::SecantOfAnyTarget => case.any_target(),
        Rule::SecantWithMomentum => case.momentum(),
        Rule::ForwardSecant => case.forward_secant(),
        Rule::ChainBackward => case.chain(true),
        Rule::ChainForward => case.chain(false),
        Rule::Difference(side) => case.one_h(h, side, false),
        Rule::ChainDifference(side) => case.one_h(h, side, true),
    };
    found.predicted.resize(search.steps(), None);
    let Found { verdict, tested, refuted_by, predicted, left } = found;
    Some(Examined { hypothesis, verdict, tested, refuted_by, predicted, left })
}

struct Found {
    verdict: Verdict,
    tested: Vec<usize>,
    refuted_by: Vec<usize>,
    predicted: Vec<Option<Span>>,
    left: Vec<Span>,
}

impl Found {
    fn of(tested: Vec<usize>, refuted_by: Vec<usize>, predicted: Vec<Option<Span>>) -> Self {
        let verdict = match (tested.is_empty(), refuted_by.is_empty()) {
            (true, _) => Verdict::Open,
            (_, true) => Verdict::Survives,
            (_, false) => Verdict::Refuted,
        };
        Self { verdict, tested, refuted_by, predicted, left: Vec::new() }
    }

    /// One number, free but the same for all steps: what every step leaves of it.
    fn of_one(wanted: &[(usize, Span)], among: Span) -> Self {
        let left = wanted.iter().try_fold(among, |left, (_, span)| left.meet(*span));
        let tested: Vec<usize> = wanted.iter().map(|(step, _)| *step).collect();
        let refuted_by = if left.is_none() { tested.clone() } else { Vec::new() };
        Self { left: left.into_iter().collect(), ..Self::of(tested, refuted_by, Vec::new()) }
    }

    fn open() -> Self {
        Self::of(Vec::new(), Vec::new(), Vec::new())
    }
}

/// f_to − f_from that a step wants.
struct Link {
    step: usize,
    from: usize,
    wanted: Span,
}

struct Case<'s> {
    search: &'s PrintedSearch,
    y: Printing,
}

impl Case<'_> {
    fn f(&self, row: usize) -> Span {
        self.search.f(row, self.y)
    }

    fn unsquared(&self, row: usize) -> Span {
        self.search.miss(row, self.y).magnitude()
    }

    fn later(&self) -> std::ops::Range<usize> {
        1..self.search.steps()
    }

    /// Where y falls with x, a step goes up where y is above the target; where it rises, down. One of the two.
    fn signs(&self) -> Found {
        let turns: Vec<(usize, i8)> = (0..self.search.steps())
            .filter_map(|i| Some((i, self.search.step(i).sign()? * self.search.miss(i, self.y).sign()?)))
            .collect();
        let tested: Vec<usize> = turns.iter().map(|(step, _)| *step).collect();
        let first = turns.first().map_or(0, |(_, sign)| *sign);
        let others = turns.iter().filter(|(_, sign)| *sign != first).map(|(step, _)| *step).collect();
        Found::of(tested, others, Vec::new())
    }

    /// (f_i − f_{i−1}) = s_i (x_i − x_{i−1}).
    fn secant(&self, f: &dyn Fn(usize) -> Span) -> Found {
        let links: Vec<Link> = self
            .later()
            .map(|i| Link {
                step: i,
                from: i - 1,
                wanted: self.search.slope(i).times(self.search.step(i - 1)),
            })
            .collect();
        let predicted = (0..self.search.steps())
            .map(|i| (i > 0).then(|| f(i).minus(f(i - 1)).over(self.search.step(i - 1))))
            .collect();
        Found::of(self.later().collect(), unmet(f, &links), predicted)
    }

    /// (f_{i+1} − f_i) = s_i (x_{i+1} − x_i) = −(x_{i+1} − x_i)² / η.
    fn forward_secant(&self) -> Found {
        let eta = Span::point(self.search.eta.value());
        let f = |row: usize| self.f(row);
        let steps = 0..self.search.steps();
        let links: Vec<Link> = steps
            .clone()
            .map(|i| Link { step: i, from: i, wanted: self.search.step(i).squared().opposite().over(eta) })
            .collect();
        let predicted = steps.clone().map(|i| Some(f(i + 1).minus(f(i)).over(self.search.step(i)))).collect();
        Found::of(steps.collect(), unmet(&f, &links), predicted)
    }

    /// 1/η from every pair of iterates: f_j − f_i = −(1/η) Σ (x_{k+1} − x_k)(x_k − x_{k−1}) over i < k <= j. A chain of
    /// such equations has a solution within its boxes if and only if every pair has.
    fn any_eta(&self, f: &dyn Fn(usize) -> Span) -> Found {
        let mut wanted = Vec::new();
        for i in 0..self.search.steps() {
            let mut sum = Span::point(Ratio::ZERO);
            for j in i + 1..self.search.steps() {
                sum = sum.minus(self.search.step(j).times(self.search.step(j - 1)));
                wanted.push((j, f(j).minus(f(i)).over(sum)));
            }
        }
        let positive = Span { low: Some(Ratio::ZERO), high: None };
        let mut found = Found::of_one(&wanted, positive);
        found.left = found.left.iter().map(|inverse| reciprocal(*inverse)).collect();
        found.tested = self.later().collect();
        found.refuted_by.sort_unstable();
        found.refuted_by.dedup();
        found
    }

    /// f_i − f_{i−1} = (Y_i − Y_{i−1})(Y_i + Y_{i−1} − 2 target), solved for the target.
    fn any_target(&self) -> Found {
        if self.y != Printing::Exact {
            return Found::open();
        }
        let half = Span::point(Ratio::new(1, 2).unwrap_or(Ratio::ZERO));
        let wanted: Vec<(usize, Span)> = self
            .later()
            .map(|i| {
                let (now, before) = (self.search.y(i, self.y), self.search.y(i - 1, self.y));
                let change = self.search.slope(i).times(self.search.step(i - 1));
                (i, now.plus(before).minus(change.over(now.minus(before))).times(half))
            })
            .collect();
        Found::of_one(&wanted, Span::EVERYTHING)
    }

    /// x_{i+1} − x_i = −η (secant) + μ (x_i − x_{i−1}), solved for μ.
    fn momentum(&self) -> Found {
        let eta = Span::point(self.search.eta.value());
        let wanted: Vec<(usize, Span)> = self
            .later()
            .map(|i| {
                let before = self.search.step(i - 1);
                let secant = self.f(i).minus(self.f(i - 1)).over(before);
                (i, self.search.step(i).plus(eta.times(secant)).over(before))
            })
            .collect();
        Found::of_one(&wanted, Span::EVERYTHING)
    }

    /// 2 e_i (Y_i − Y_{i−1}) = s_i (x_i − x_{i−1}), or the same with the next iterate; each step for itself.
    fn chain(&self, back: bool) -> Found {
        let (search, steps) = (self.search, if back { self.later() } else { 0..self.search.steps() });
        let mut predicted = vec![None; search.steps()];
        let mut refuted = Vec::new();
        for i in steps.clone() {
            let (other, step) = if back { (i - 1, search.step(i - 1)) } else { (i + 1, search.step(i)) };
            let product = twice_by_difference(search.miss(i, self.y), search.miss(other, self.y));
            // Y_{i+1} − Y_i has the other sign.
            let product = if back { product } else { product.opposite() };
            predicted[i] = Some(product.over(step));
            if search.slope(i).times(step).meet(product).is_none() {
                refuted.push(i);
            }
        }
        Found::of(steps.collect(), refuted, predicted)
    }

    fn one_h(&self, h: &Differences, side: super::rules::Side, chain: bool) -> Found {
        if self.y != Printing::Exact {
            return Found::open(); // a real y(x ± h) fits any slope
        }
        match h.shared(self.search, side, chain) {
            None => Found::open(),
            Some(Tried { left, steps }) => {
                let refuted_by = if left.is_empty() { steps.clone() } else { Vec::new() };
                Found { left, ..Found::of(steps, refuted_by, Vec::new()) }
            }
        }
    }
}

/// The steps that find no f within the boxes: each alone, or else the shortest run of steps that cannot be met together.
fn unmet(f: &dyn Fn(usize) -> Span, links: &[Link]) -> Vec<usize> {
    let meets = |link: &Link| f(link.from + 1).minus(f(link.from)).meet(link.wanted).is_some();
    let alone: Vec<usize> = links.iter().filter(|link| !meets(link)).map(|link| link.step).collect();
    if !alone.is_empty() {
        return alone;
    }
    // What f may still be after a run of steps; none once nothing is left.
    let after = |run: &[Link]| {
        let start = run.first().map(|link| f(link.from));
        run.iter().fold(start, |left, link| left?.plus(link.wanted).meet(f(link.from + 1)))
    };
    let Some(end) = (1..=links.len()).find(|end| after(&links[..*end]).is_none()) else { return alone };
    let from = (0..end).rev().find(|from| after(&links[*from..end]).is_none()).unwrap_or(0);
    links[from..end].iter().map(|link| link.step).collect()
}

/// The range of 2 e (e − b): convex in e, straight in b, so its ends are at corners or where e = b/2.
fn twice_by_difference(e: Span, b: Span) -> Span {
    let (Some(e_low), Some(e_high), Some(b_low), Some(b_high)) = (e.low, e.high, b.low, b.high) else {
        return Span::EVERYTHING;
    };
    let at = |e: Span, b: Span| e.times(e.minus(b)).plus(e.times(e.minus(b)));
    let half = Span::point(Ratio::new(1, 2).unwrap_or(Ratio::ZERO));
    let mut ends = Vec::new();
    for b in [b_low, b_high].map(Span::point) {
        ends.extend([e_low, e_high].map(|e| at(Span::point(e), b)));
        let vertex = b.times(half);
        ends.extend(vertex.low.filter(|low| e.holds(*low)).map(|_| at(vertex, b)));
    }
    Span::around(ends.iter().flat_map(|span| [span.low, span.high]))
}

/// 1/λ for λ >= 0.
fn reciprocal(span: Span) -> Span {
    let one = Ratio::whole(1);
    let inverse = |end: Option<Ratio>| {
        end.filter(|end| *end > Ratio::ZERO).and_then(|end| Span::point(one).over(Span::point(end)).low)
    };
    Span { low: inverse(span.high).or(Some(Ratio::ZERO)), high: inverse(span.low) }
}
