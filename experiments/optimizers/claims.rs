//! What is claimed of the optimisers, written before the first run.

use snowglobe::lab::{Claim, Expect, Known, Statistic};

/// The claims of a suite of frost in one dimension.
pub struct FrostClaims {
    pub table_1: Claim,
    pub table_2: Claim,
    pub stalls: Claim,
    pub better: Claim,
    pub rises: Claim,
    pub basins: Claim,
}

macro_rules! frost_claims {
    ($suite:literal, $stalls_says:literal, $stalls:expr, $stalls_reason:literal, $table_known:expr, $stalls_known:expr) => {
        FrostClaims {
            table_1: Claim {
                id: concat!("optimizers/", $suite, "/table-1"),
                source: "Amano §4, Table 1",
                says: "from 0.25 the paper's rule finds an initial value whose film ends within 4 frames of 130, at threshold 0",
                expect: Expect::AtMost(4.0),
                statistic: Statistic::Each,
                reason: "frames between the target and the nearest end among the films that the rule grew, differences \
                         included; 4 is the paper's own tolerance",
                known: $table_known,
            },
            table_2: Claim {
                id: concat!("optimizers/", $suite, "/table-2"),
                source: "Amano §4, Table 2",
                says: "and at threshold 0.8, with most seeds",
                expect: Expect::AtMost(4.0),
                statistic: Statistic::Share(0.5),
                reason: "the same with 40 seeds; one search is printed, so no more can be asked than more often than not",
                known: &[],
            },
            stalls: Claim {
                id: concat!("optimizers/", $suite, "/paper-stalls"),
                source: "Amano §5",
                says: $stalls_says,
                expect: $stalls,
                statistic: Statistic::Each,
                reason: $stalls_reason,
                known: $stalls_known,
            },
            better: Claim {
                id: concat!("optimizers/", $suite, "/a-better-method"),
                source: "Amano §5",
                says: "at least one other method ends within 4 frames more often than the paper's rule, in no more evaluations",
                expect: Expect::AtLeast(1.0),
                statistic: Statistic::Each,
                reason: "solvers whose share of successes over the suite is higher and whose expected runtime to 4 frames is \
                         lower, with 95 % intervals (Wilson's, and by bootstrap) that do not overlap the paper's rule's",
                known: &[],
            },
            rises: Claim {
                id: concat!("optimizers/", $suite, "/end-frame-rises"),
                source: "Amano §5",
                says: "on every sketch there are small steps over which more vapour ends the film later, at threshold 0.8",
                expect: Expect::AtLeast(0.01),
                statistic: Statistic::Each,
                reason: "the least share, over sketches, of steps of 0.0025 in beta from 0.15 to 0.9 over which the end frame \
                         rises, mean over seeds; one step in a hundred is met by a search of a few dozen films",
                known: &[],
            },
            basins: Claim {
                id: concat!("optimizers/", $suite, "/basins"),
                source: "Amano §5",
                says: "the objective has more than one basin at threshold 0.8, so that descent can end in a wrong one",
                expect: Expect::AtLeast(2.0),
                statistic: Statistic::Each,
                reason: "the median number of basins of f on the grid over sketches, targets and seeds; two are more than one",
                known: &[],
            },
        }
    };
}

pub static WHOLE: FrostClaims = frost_claims!(
    "frost-whole",
    "with whole end frames the paper's rule stalls where two films end in the same frame",
    Expect::Between(0.05, 1.0),
    "share of the rule's trials over the suite that end at a difference of 0 without having come within 4 frames; fewer \
     than one in twenty would hardly have been remarked on",
    &[],
    &[]
);

pub static INTERPOLATED: FrostClaims = frost_claims!(
    "frost-interpolated",
    "with interpolated end frames it does not",
    Expect::AtMost(0.05),
    "the same share with interpolated end frames, which are hardly ever equal: fewer than one in twenty",
    &[Known {
        reading: "",
        evidence: "after 0.3203 and 0.3280, the sixth and seventh film, the search stops: both end at 123.94 to the last \
                       digit, so the slope between them is 0 (large/log.csv; the same search is amano/descent)",
    }],
    &[Known {
        reading: "",
        evidence: "an interpolated end is still made of whole numbers of cells: on the grid, whose steps are longer than \
                       most of the rule's, it does not change at all over 12 % of the steps in the median, over 52 % at \
                       most (truth.csv)",
    }]
);

pub static ONE_IS_NOT_ENOUGH: Claim = Claim {
    id: "optimizers/sectors/one-is-not-enough",
    source: "Amano §5",
    says: "on the sketch with an off-centre start no single initial value brings the ice to the border everywhere in time",
    expect: Expect::AtLeast(8.0),
    statistic: Statistic::Each,
    reason: "least root mean square miss over the directions, in frames, of a grid of 301 initial values, the lesser of \
             the two thresholds; 8 frames is the easiest target of the suite. The sketch was chosen for this",
    known: &[],
};

const fn twelve(id: &'static str, says: &'static str, known: &'static [Known]) -> Claim {
    Claim {
        id,
        source: "Amano §5",
        says,
        expect: Expect::AtMost(4.0),
        statistic: Statistic::Each,
        reason: "least root mean square miss over the directions, in frames, that any solver found with twelve sectors and \
                 the first seed; 4 frames is the paper's own tolerance",
        known,
    }
}

pub static TWELVE_ARE_EVEN: Claim = twelve(
    "optimizers/sectors/twelve-are-enough-0",
    "with an initial value for each of twelve sectors it can be done, at threshold 0",
    &[],
);
pub static TWELVE_ARE_RAGGED: Claim = twelve(
    "optimizers/sectors/twelve-are-enough-0.8",
    "with an initial value for each of twelve sectors it can be done, at threshold 0.8",
    &[Known {
        reading: "",
        evidence: "the best that 15 solvers found in 520 films each misses by 6.97 frames (CMA-ES; found.csv). No grid certifies \
                   twelve dimensions: whether more films would do is not known",
    }],
);

pub static MORE_IS_BETTER: Claim = Claim {
    id: "optimizers/sectors/more-is-better",
    source: "Amano §5",
    says: "the more sectors, the closer the ice comes to being on time everywhere",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "the least gain from 1 to 3 to 6 to 12 sectors (each divides the one before) in the least miss that was found, \
             over both thresholds",
    known: &[],
};

pub static MINIMA: Claim = Claim {
    id: "optimizers/control/minima",
    source: "argmin_testfunctions 0.3",
    says: "each control function is 0 at its known minimum",
    expect: Expect::AtMost(1e-20),
    statistic: Statistic::Each,
    reason: "the greatest cost at a known minimum; rounding leaves less",
    known: &[],
};

pub static BISECTION: Claim = Claim {
    id: "optimizers/control/bisection",
    source: "arithmetic",
    says: "on a line bisection takes exactly the evaluations that arithmetic says",
    expect: Expect::Near { value: 43.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "by hand: root at 1 in [-5, 5], so 3, 5, 7, 11 and 17 evaluations, both ends among them, to the five targets",
    known: &[],
};

pub static SECANT: Claim = Claim {
    id: "optimizers/control/secant",
    source: "arithmetic",
    says: "on a line the secant method takes three",
    expect: Expect::Near { value: 3.0, within: 0.0 },
    statistic: Statistic::Each,
    reason: "two points give the line, the third is its root; the most over the seeds, to the last target",
    known: &[],
};

pub static RANDOM_SEARCH: Claim = Claim {
    id: "optimizers/control/random-search",
    source: "arithmetic",
    says: "random search takes the reciprocal of its target's share of the box",
    expect: Expect::Near { value: 15.811_388, within: 1.03 },
    statistic: Statistic::Each,
    reason: "evaluations to f <= 0.1 on the line, mean of 2000 seeds: the share is 2 sqrt(0.1) / 10, the number of draws \
             geometric with deviation 15.3, so the tolerance is three standard errors",
    known: &[],
};

/// The tree.
pub static COEFFICIENTS: Claim = Claim {
    id: "optimizers/tree/coefficients",
    source: "Sakai §6",
    says: "the restoring and wind coefficients can be had from a film of the tree",
    expect: Expect::AtMost(0.01),
    statistic: Statistic::Each,
    reason: "distance in m by which the nodes are off, root mean square over nodes and frames, of the best solver's best \
             on the worst of all films; a centimetre on a tree of 6.67 m is what a film of 700 lines can tell",
    known: &[],
};

/// The cloud, its own throw of Gauss.
pub static PICTURE: Claim = Claim {
    id: "optimizers/clouds/picture",
    source: "Miyata §4",
    says: "D can be had from a picture of the cloud",
    expect: Expect::AtMost(0.05),
    statistic: Statistic::Each,
    reason: "|D found - D hidden| of the best solver on the worst of all pictures, where a cost of 0 exists; a quarter of the \
             difference between the D of Fig. 13 (b) and (c)",
    known: &[],
};
/// The cloud, another throw.
pub static STATISTICS: Claim = Claim {
    id: "optimizers/clouds/statistics",
    source: "Miyata §4",
    says: "D can be had from a picture whose throw of Gauss is not known",
    expect: Expect::AtMost(0.11),
    statistic: Statistic::Each,
    reason: "|D found - D hidden| of the best solver on the worst of all pictures; half of the difference between the D of \
             Fig. 13 (b) and (c), so that the two could be told apart. \
             Two pictures tell little: with finer patches the same bound was missed",
    known: &[],
};
/// Two clouds, both of another throw.
pub static TOLD_APART: Claim = Claim {
    id: "optimizers/clouds/told-apart",
    source: "Miyata §4",
    says: "of two pictures the one of greater D is found to be so",
    expect: Expect::Between(0.5, 1.5),
    statistic: Statistic::Each,
    reason: "difference of D found, of the pictures of greatest and of least hidden D whose throw is not known, over the \
             difference hidden: nearer to the truth than to no difference at all, or to twice of it",
    known: &[],
};

/// The automaton's clouds, 64 x 64 x 24 cells.
pub static CURVE: Claim = Claim {
    id: "optimizers/automaton/curve",
    source: "Dobashi §2.3",
    says: "probabilities can be found that make a sky cloud over as asked",
    expect: Expect::AtMost(0.1),
    statistic: Statistic::Each,
    reason: "root mean square of how far cover is off over the steps, over that of the curve, of the best solver's best on the worst \
             curve; a tenth, two skies of the same probabilities differing by a few per cent",
    known: &[],
};
/// Their vapour.
pub static VAPOUR: Claim = Claim {
    id: "optimizers/automaton/vapour",
    source: "Dobashi §2.3",
    says: "the probability of vapour can be had from how a sky clouds over",
    expect: Expect::AtMost(0.2),
    statistic: Statistic::Each,
    reason: "|log10| of that found over that hidden, of the best solver on the worst of all curves; a factor of 1.6 in a box of 100",
    known: &[],
};
/// All three.
pub static ALL_THREE: Claim = Claim {
    id: "optimizers/automaton/all-three",
    source: "Dobashi §2.3",
    says: "where a hidden probability is greater, so is that found",
    expect: Expect::Between(0.5, 1.5),
    statistic: Statistic::Each,
    reason: "slope of least squares of the logarithms found over those hidden, as shares of the box, all three probabilities of all \
             curves: nearer to the truth, 1, than to what does not depend on it",
    known: &[],
};
