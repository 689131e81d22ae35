//! Tables 1 and 2: which derivative the printed steps used, and whether descent by it takes the printed path.

mod digits;
mod replay;

use snowglobe::frost::TSim;
use snowglobe::lab::{Claim, Error, Expect, Experiment, Known, Lab, Mutant, Result, Statistic};
use snowglobe::optimize::Derivative;
use snowglobe::optimize::forensics::{
    Decimal, Differences, Examined, Hypothesis, PrintedSearch, Printing, Rule, Side, Verdict, examine,
    shared_by,
};

use super::{table_1, table_2};

pub const FORENSICS: Experiment = Experiment {
    id: "forensics",
    title: "Forensics on the printed steps",
    source: "Tables 1 and 2, Eq. (2) and (3), §3.4",
    says: "Both tables are steepest descent by Eq. (3) with eta 1e-6, so each printed step gives the derivative that it \
           used. Rules for that derivative are held against the printed digits in exact fractions; then descent is \
           run again from the printed start.",
    claims: &[&SIGNS, &STEPS, &THREE_1, &THREE_2],
    run,
    mutant: Mutant {
        changes: "target",
        to: 100.0,
        why: "all printed films end after frame 100, and yet the last step of Table 2 takes vapour away",
        turns_red: &["amano/forensics/signs"],
    },
};

const fn claim(id: &'static str, source: &'static str, says: &'static str, reason: &'static str) -> Claim {
    Claim { id, source, says, expect: Expect::True, statistic: Statistic::Each, reason, known: &[] }
}

static SIGNS: Claim = claim(
    "amano/forensics/signs",
    "Tables 1 and 2, Eq. (3)",
    "every printed step adds vapour where the film is late and takes vapour away where it is early",
    "f falls with beta while the film is late, because more vapour ends it sooner; one step of six that turned the \
     other way would not be a descent",
);
static STEPS: Claim = Claim {
    id: "amano/forensics/steps",
    source: "Tables 1 and 2, Eq. (3)",
    says: "the printed steps of both tables are those of Eq. (3) with eta 1e-6 and the derivative of the printed end \
           frames",
    expect: Expect::True,
    statistic: Statistic::Each,
    reason: "1 if no printed digit contradicts it, by exact fractions; free are the first derivative of each secant, or \
             one h from 1e-6 to 0.1 for both tables. Interpolated end frames are taken to be printed as the first \
             whole frame",
    known: &[
        Known {
            reading: "t-sim=whole;derivative=secant",
            evidence: "the secants of the printed frames are -35088 and -12030 in Table 1, -22637 and 488 in Table 2; \
                       the steps used -33501, -12240, -22519 and 938, each to one unit; end frames that are real, and \
                       printed as the first whole frame or rounded, give all four",
        },
        Known {
            reading: "t-sim=whole;derivative=forward",
            evidence: "with no h from 1e-6 to 0.1 do differences of whole end frames give all three steps of Table 1, \
                       nor those of Table 2",
        },
        Known {
            reading: "t-sim=whole;derivative=central",
            evidence: "Table 1 leaves 51 thin intervals of h and Table 2 leaves 109, as random steps do, none of them at \
                       a round number; no h is in both",
        },
    ],
};
static THREE_1: Claim = Claim {
    id: "amano/forensics/three-steps-0",
    source: "Table 1",
    says: "at threshold 0, at most three steps from beta 0.25 end within 4 frames of frame 130",
    expect: Expect::Near { value: 130.0, within: 4.0 },
    statistic: Statistic::Each,
    reason: "the table has three steps; the tolerance is the paper's",
    known: &[Known {
        reading: "t-sim=interpolated;derivative=secant",
        evidence: "the second step goes too far, to frame 123, and the third stays there, where the end frame hardly \
                   changes with beta (paths.csv)",
    }],
};
static THREE_2: Claim = Claim {
    id: "amano/forensics/three-steps-0.8",
    source: "Table 2",
    says: "at threshold 0.8, at most three steps from beta 0.25 end within 4 frames of frame 130",
    expect: Expect::Near { value: 130.0, within: 4.0 },
    statistic: Statistic::Share(0.5),
    reason: "the table has three steps; if less than half of the seeds needed no more, it would have been luck",
    known: &[],
};

/// What the paper prints of both searches.
struct Printed {
    eta: f64,
    target: f64,
    tolerance: f64,
    /// (threshold, initial values and end frames).
    tables: [(f64, [(f64, f64); 4]); 2],
}

impl Printed {
    /// Both tables as printed: six places, whole frames.
    fn searches(&self) -> Result<Vec<PrintedSearch>> {
        self.tables.iter().map(|(_, rows)| self.search(rows)).collect()
    }

    fn search(&self, rows: &[(f64, f64)]) -> Result<PrintedSearch> {
        let text: Vec<(String, String)> =
            rows.iter().map(|(beta, end)| (format!("{beta:.6}"), format!("{end:.0}"))).collect();
        let rows: Vec<(&str, &str)> = text.iter().map(|(x, y)| (x.as_str(), y.as_str())).collect();
        PrintedSearch::new(&rows, &self.eta.to_string(), Some(&self.target.to_string())).map_err(broken)
    }
}

fn broken(cause: impl std::error::Error + Send + Sync + 'static) -> Error {
    Error::broken("cannot examine the printed steps").because(cause)
}

fn run(lab: &mut Lab) -> Result<()> {
    let printed = Printed {
        eta: lab.printed("eta", 1.0e-6, "§4"),
        target: lab.printed("target", 130.0, "§4"),
        tolerance: lab.printed("tolerance", 4.0, "§4"),
        tables: [(0.0, table_1::PRINTED), (0.8, table_2::PRINTED)],
    };
    lab.assume_that(
        "printed digits",
        "initial values rounded to six places, the first exactly 0.25",
        "not said; the verdicts with digits cut off, or with a first value that was rounded, stand beside",
    );
    let tried = Differences {
        h: (Decimal::parse("1e-6").map_err(broken)?, Decimal::parse("0.1").map_err(broken)?),
        y: (1, 400),
    };
    lab.assume_that(
        "differences",
        "h from 1e-6 to 0.1, end frames from 1 to 400",
        "not given; wider than any sensible difference at beta 0.25",
    );
    judge_steps(lab, &printed, &tried)?;
    digits::keep(lab, &printed, &tried)?;
    replay::run(lab, &printed)
}

/// The rule, and how the end frame was printed, that a pair of readings stands for. A difference of interpolated end
/// frames has a free number for every step: nothing printed could contradict it, and nothing is claimed.
fn hypothesis(t_sim: TSim, derivative: Derivative) -> Option<Hypothesis> {
    let rule = match derivative {
        Derivative::Secant => Rule::BackwardSecant,
        Derivative::Forward => Rule::Difference(Side::Forward),
        Derivative::Central => Rule::Difference(Side::Central),
    };
    match (t_sim, derivative) {
        (TSim::Whole, _) => Some(Hypothesis { rule, y: Printing::Exact }),
        (TSim::Interpolated, Derivative::Secant) => Some(Hypothesis { rule, y: Printing::Ceiling }),
        (TSim::Interpolated, _) => None,
    }
}

fn judge_steps(lab: &mut Lab, printed: &Printed, tried: &Differences) -> Result<()> {
    let searches = printed.searches()?;
    lab.default_reading();
    let signs = Hypothesis { rule: Rule::Signs, y: Printing::Exact };
    // More vapour ends the film sooner: each step has the sign of the miss, in both tables.
    let up = searches.iter().all(|search| {
        let survives = examine(search, signs, tried).is_some_and(|found| found.verdict == Verdict::Survives);
        survives && search.step(0).sign() == search.miss(0, signs.y).sign()
    });
    lab.found(&SIGNS, if up { 1.0 } else { 0.0 });
    let derivatives = lab.readings::<Derivative>();
    let both = |t_sim| derivatives.iter().map(move |derivative| (t_sim, *derivative));
    let mut pairs: Vec<_> = lab.readings::<TSim>().into_iter().flat_map(both).collect();
    pairs.retain(|(t_sim, derivative)| hypothesis(*t_sim, *derivative).is_some());
    if pairs.is_empty() {
        pairs.push((TSim::Whole, Derivative::Secant)); // a run narrowed to what cannot be judged
    }
    for (t_sim, derivative) in pairs {
        let Some(hypothesis) = hypothesis(t_sim, derivative) else { continue };
        lab.reading(t_sim);
        lab.reading(derivative);
        let found: Vec<Examined> =
            searches.iter().filter_map(|search| examine(search, hypothesis, tried)).collect();
        let survives = found.iter().all(|found| found.verdict == Verdict::Survives);
        // A difference has its h from the program, not from the table.
        let one_h = derivative == Derivative::Secant
            || found.windows(2).all(|pair| !shared_by(&pair[0].left, &pair[1].left).is_empty());
        lab.found(&STEPS, if survives && one_h { 1.0 } else { 0.0 });
    }
    lab.default_reading();
    Ok(())
}
