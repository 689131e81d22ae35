//! Hypotheses: rules for the derivative, and how y was printed.

use super::printed::Printing;
use crate::reading::Reading;

/// On which side of an iterate a difference is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From x to x + h.
    Forward,
    /// From x − h to x.
    Backward,
    /// From x − h to x + h.
    Central,
}

/// A rule that may have given the slope s_i of the step from row i. Y_i is y at row i, e_i = Y_i − target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// What a derivative at the iterate itself implies where y is monotone: steps turn with the sign of e_i.
    Signs,
    /// s_i = (f_i − f_{i−1}) / (x_i − x_{i−1}); s_0 is free.
    BackwardSecant,
    /// The same with a free step length.
    SecantOfAnyEta,
    /// The same with a free target.
    SecantOfAnyTarget,
    /// The same with μ (x_i − x_{i−1}) added to each step, μ free.
    SecantWithMomentum,
    /// The same with f = |e|.
    SecantUnsquared,
    /// The same with f = |e| and a free step length.
    SecantUnsquaredOfAnyEta,
    /// s_i = (f_{i+1} − f_i) / (x_{i+1} − x_i): the step goes where its own secant has its slope.
    ForwardSecant,
    /// s_i = 2 e_i (Y_i − Y_{i−1}) / (x_i − x_{i−1}); s_0 is free.
    ChainBackward,
    /// s_i = 2 e_i (Y_{i+1} − Y_i) / (x_{i+1} − x_i).
    ChainForward,
    /// A difference of f over one h, the same for all steps, free.
    Difference(Side),
    /// s_i = 2 e_i y′, y′ a difference of y over one h, the same for all steps, free.
    ChainDifference(Side),
}

impl Rule {
    /// All of them.
    pub const ALL: [Self; 16] = [
        Self::Signs,
        Self::BackwardSecant,
        Self::SecantOfAnyEta,
        Self::SecantOfAnyTarget,
        Self::SecantWithMomentum,
        Self::SecantUnsquared,
        Self::SecantUnsquaredOfAnyEta,
        Self::ForwardSecant,
        Self::ChainBackward,
        Self::ChainForward,
        Self::Difference(Side::Forward),
        Self::Difference(Side::Backward),
        Self::Difference(Side::Central),
        Self::ChainDifference(Side::Forward),
        Self::ChainDifference(Side::Backward),
        Self::ChainDifference(Side::Central),
    ];

    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Signs => "signs",
            Self::BackwardSecant => "secant",
            Self::SecantOfAnyEta => "secant, any eta",
            Self::SecantOfAnyTarget => "secant, any target",
            Self::SecantWithMomentum => "secant with momentum",
            Self::SecantUnsquared => "secant of |y - target|",
            Self::SecantUnsquaredOfAnyEta => "secant of |y - target|, any eta",
            Self::ForwardSecant => "secant of the step itself",
            Self::ChainBackward => "chain rule, secant of y",
            Self::ChainForward => "chain rule, secant of the step itself",
            Self::Difference(Side::Forward) => "forward difference, one h",
            Self::Difference(Side::Backward) => "backward difference, one h",
            Self::Difference(Side::Central) => "central difference, one h",
            Self::ChainDifference(Side::Forward) => "chain rule, forward difference, one h",
            Self::ChainDifference(Side::Backward) => "chain rule, backward difference, one h",
            Self::ChainDifference(Side::Central) => "chain rule, central difference, one h",
        }
    }

    /// Whether it speaks of y and a target, not of f alone.
    pub const fn needs_target(self) -> bool {
        !matches!(
            self,
            Self::BackwardSecant | Self::SecantOfAnyEta | Self::SecantWithMomentum | Self::ForwardSecant
        )
    }

    /// What it leaves free beside the printed numbers.
    pub const fn free(self) -> &'static [&'static str] {
        match self {
            Self::Signs | Self::ForwardSecant | Self::ChainForward => &[],
            Self::BackwardSecant | Self::SecantUnsquared | Self::ChainBackward => &["first slope"],
            Self::SecantOfAnyEta | Self::SecantUnsquaredOfAnyEta => &["first slope", "eta"],
            Self::SecantOfAnyTarget => &["first slope", "target"],
            Self::SecantWithMomentum => &["first slope", "mu"],
            Self::Difference(_) | Self::ChainDifference(_) => &["h"],
        }
    }
}

/// A rule, with the way in which y was printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hypothesis {
    /// The rule.
    pub rule: Rule,
    /// [`Printing::Exact`]: the search used the printed y. Otherwise it used a real y of which the digits were printed.
    pub y: Printing,
}

impl Hypothesis {
    /// Every rule with every way to print y.
    pub fn all() -> Vec<Self> {
        let with = |rule| Printing::ALL.iter().map(move |y| Self { rule, y: *y });
        Rule::ALL.into_iter().flat_map(with).collect()
    }
}
