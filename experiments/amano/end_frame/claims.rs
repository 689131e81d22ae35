//! The statements of section 5.

use snowglobe::lab::{Claim, Expect, Known, Statistic};

const fn slope(id: &'static str, says: &'static str) -> Claim {
    Claim {
        id,
        source: "§5",
        says,
        expect: Expect::Near { value: -1.0, within: 0.3 },
        statistic: Statistic::Mean,
        reason: "slope of log T against log beta from 0.2 to 0.4, by least squares: -1 is inverse proportion, about \
                 which the printed rows themselves lie (-1.15 and -1.04 from first to last)",
        known: &[],
    }
}

pub static EVEN_SLOPE: Claim = slope(
    "amano/end-frame/proportional-0",
    "over large changes of the initial value the end frame is about inversely proportional to it, at threshold 0",
);
pub static RANDOM_SLOPE: Claim = slope(
    "amano/end-frame/proportional-0.8",
    "over large changes of the initial value the end frame is about inversely proportional to it, at threshold 0.8",
);

pub static SMALL_CHANGES: Claim = Claim {
    id: "amano/end-frame/small-changes",
    source: "§5",
    says: "over small changes of the initial value it is not: more vapour can end the film later",
    expect: Expect::AtLeast(0.05),
    statistic: Statistic::Each,
    reason: "share of steps of 0.0002 in beta, from 0.30 to 0.32, over which the interpolated end frame rises, the \
             least of the three thresholds; one in twenty is met in any search of a few films",
    known: &[],
};

pub static ALL_IS_ROUGHER: Claim = Claim {
    id: "amano/end-frame/all-is-rougher",
    source: "§5",
    says: "it is worse when the film ends with 100 % of the points than with 90 %",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "roughness (the way that T goes up and down over beta from 0.2 to 0.4, over the net change) with 100 % less \
             that with 90 %, the least difference of the three thresholds",
    known: &[],
};

pub static ALL_FAILS_MORE: Claim = Claim {
    id: "amano/end-frame/descent-fails-more",
    source: "§5",
    says: "descent converges less often when the film ends with 100 % of the points than with 90 %",
    expect: Expect::Rises,
    statistic: Statistic::Each,
    reason: "share of 20 starts at each threshold from which descent ends within 4 frames of its target, with 90 % less \
             that with 100 %, over all thresholds; each target is the end frame at the paper's last beta, so it can be met",
    known: &[],
};

const fn unfinished(id: &'static str, says: &'static str, known: &'static [Known]) -> Claim {
    Claim {
        id,
        source: "§5",
        says,
        expect: Expect::AtMost(0.899_999),
        statistic: Statistic::Mean,
        reason: "share of the border's cells that are ice when 90 % of all cells are, at the last printed beta: if what \
                 is missing lay anywhere it would be nine tenths; less says that the film ends before ice has reached \
                 the sketch's edge as it has the rest",
        known,
    }
}

pub static UNFINISHED: [Claim; 3] = [
    unfinished(
        "amano/end-frame/unfinished-0",
        "with 90 % the film can end before the intended shape is there: threshold 0",
        &[Known {
            reading: "",
            evidence: "without randomness the ice has run along the whole border of the hexagon when 90 % is ice; what is \
                       missing are six fields between its arms, one cell inside (unfinished.png)",
        }],
    ),
    unfinished("amano/end-frame/unfinished-0.4", "the same at threshold 0.4", &[]),
    unfinished("amano/end-frame/unfinished-0.8", "the same at threshold 0.8", &[]),
];
