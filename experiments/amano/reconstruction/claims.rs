//! What is claimed of the reconstruction, with what is known to fail.

use snowglobe::lab::{Claim, Expect, Statistic};

pub static ALL_ROWS: Claim = Claim {
    id: "amano/reconstruction/all-rows",
    source: "Tables 1 and 2",
    says: "one model and one set of what is not printed give all eight rows",
    expect: Expect::AtMost(4.0),
    statistic: Statistic::Each,
    reason: "the largest residual of the best set under each reading, in frames: the paper's own tolerance (§4), on \
             the mean of 40 seeds for Table 2",
    known: &[],
};

pub static LEAD: Claim = Claim {
    id: "amano/reconstruction/lead",
    source: "Tables 1 and 2",
    says: "the set that assumes least and gives all eight rows is the one that every table and figure here is made with",
    expect: Expect::True,
    statistic: Statistic::Each,
    reason: "fewest fitted numbers, then the simplest shape, then the best fit: the default must be the search's own",
    known: &[],
};

pub static PREDICTED: Claim = Claim {
    id: "amano/reconstruction/table-2-predicted",
    source: "Table 2",
    says: "a sketch fitted to Table 1 alone predicts Table 2, with r held for the frame and gamma's mean kept",
    expect: Expect::AtMost(4.0),
    statistic: Statistic::Each,
    reason: "the largest residual of Table 2, of the sketch of one number that fits Table 1 best; nothing is fitted to \
             Table 2",
    known: &[],
};

pub static LEFT_OUT: Claim = Claim {
    id: "amano/reconstruction/row-left-out",
    source: "Tables 1 and 2",
    says: "seven rows predict the eighth, with r held for the frame and gamma's mean kept",
    expect: Expect::AtMost(4.0),
    statistic: Statistic::Each,
    reason: "the largest residual of the eight rows, each of them predicted by the sketch that fits the other seven \
             best, whatever its shape",
    known: &[],
};

pub static MEAN_GAMMA: Claim = Claim {
    id: "amano/reconstruction/mean-gamma",
    source: "Table 2",
    says: "gamma of Table 2 keeps the mean of Table 1's, which the threshold would lower to a fifth",
    expect: Expect::Between(0.9, 1.1),
    statistic: Statistic::Each,
    reason: "gamma fitted freely to Table 2 for the lead's sketch, in steps of a tenth of Table 1's, over \
             gamma / (1 - r_th): within a tenth",
    known: &[],
};

pub static NOT_UNIQUE: Claim = Claim {
    id: "amano/reconstruction/not-unique",
    source: "Tables 1 and 2",
    says: "the tables do not determine the sketch",
    expect: Expect::AtLeast(2.0),
    statistic: Statistic::Each,
    reason: "sketches, of different shape or steps in a frame, that give all eight rows: two are enough to show it",
    known: &[],
};
