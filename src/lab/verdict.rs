//! Verdicts: what the measured numbers say of a claim.

use std::fmt;
use std::str::FromStr;

use super::claim::{Expect, Statistic};

/// What a run says of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The measured number is what the claim expects.
    Holds,
    /// It is not, or there is none.
    Fails,
    /// Its 95 % interval straddles the bound, or the run was too small to tell.
    Undecided,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Verdict::Holds => "holds",
            Verdict::Fails => "fails",
            Verdict::Undecided => "undecided",
        })
    }
}

impl FromStr for Verdict {
    type Err = ();

    fn from_str(word: &str) -> Result<Self, ()> {
        [Verdict::Holds, Verdict::Fails, Verdict::Undecided]
            .into_iter()
            .find(|verdict| verdict.to_string() == word)
            .ok_or(())
    }
}

/// The number that a verdict rests on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// The statistic of the findings; none if a finding it needs is none.
    pub measured: Option<f64>,
    /// The verdict.
    pub verdict: Verdict,
}

/// Judges the findings of one claim under one reading, one number for each seed.
///
/// `values` are what is judged; `shown` are what is reported (they differ where one finding is compared with another).
pub fn judge(
    expect: Expect,
    statistic: Statistic,
    values: &[Option<f64>],
    shown: &[Option<f64>],
) -> Judgement {
    match statistic {
        Statistic::Each => each(expect, values, shown),
        Statistic::Mean => mean(expect, values, shown),
        Statistic::Share(least) => share(expect, least, values),
    }
}

fn each(expect: Expect, values: &[Option<f64>], shown: &[Option<f64>]) -> Judgement {
    // The worst is the one furthest outside; a finding of none is worse than any.
    let worst = (0..values.len()).fold(None, |worst: Option<(f64, usize)>, i| {
        let excess = values[i].map_or(f64::INFINITY, |v| excess(expect, v));
        if worst.is_none_or(|(most, _)| excess > most) { Some((excess, i)) } else { worst }
    });
    let Some((_, worst)) = worst else { return Judgement { measured: None, verdict: Verdict::Fails } };
    let meets = values[worst].is_some_and(|v| accepts(expect, v));
    Judgement { measured: shown[worst], verdict: if meets { Verdict::Holds } else { Verdict::Fails } }
}

fn mean(expect: Expect, values: &[Option<f64>], shown: &[Option<f64>]) -> Judgement {
    let whole = |numbers: &[Option<f64>]| numbers.iter().copied().collect::<Option<Vec<f64>>>();
    let (Some(values), Some(shown)) = (whole(values), whole(shown)) else {
        return Judgement { measured: None, verdict: Verdict::Fails };
    };
    if values.is_empty() {
        return Judgement { measured: None, verdict: Verdict::Fails };
    }
    let centre = average(&values);
    let reach = student_975(values.len() - 1) * standard_error(&values);
    Judgement { measured: Some(average(&shown)), verdict: of_interval(expect, centre, reach) }
}

fn share(expect: Expect, least: f64, values: &[Option<f64>]) -> Judgement {
    if values.is_empty() {
        return Judgement { measured: None, verdict: Verdict::Fails };
    }
    let met = values.iter().filter(|v| v.is_some_and(|v| accepts(expect, v))).count();
    let share = met as f64 / values.len() as f64;
    let (low, high) = wilson_95(met, values.len());
    let verdict = if values.len() == 1 {
        if share >= least { Verdict::Holds } else { Verdict::Fails }
    } else if low >= least || (met == values.len() && least >= 1.0) {
        Verdict::Holds
    } else if high < least {
        Verdict::Fails
    } else {
        Verdict::Undecided
    };
    Judgement { measured: Some(share), verdict }
}

fn accepts(expect: Expect, value: f64) -> bool {
    let (from, to, from_too) = expect.accepted();
    value <= to && (value > from || (from_too && value == from))
}

fn excess(expect: Expect, value: f64) -> f64 {
    let (from, to, _) = expect.accepted();
    if value.is_nan() { f64::INFINITY } else { (from - value).max(value - to) }
}

fn of_interval(expect: Expect, centre: f64, reach: f64) -> Verdict {
    let (from, to, _) = expect.accepted();
    let outside = centre + reach < from || centre - reach > to || (reach == 0.0 && !accepts(expect, centre));
    if accepts(expect, centre - reach) && accepts(expect, centre + reach) {
        Verdict::Holds
    } else if outside || centre.is_nan() {
        Verdict::Fails
    } else {
        Verdict::Undecided
    }
}

/// The mean, summed in the order given; not a number for an empty slice.
pub fn average(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The standard error of the mean; 0 for a single value.
pub fn standard_error(values: &[f64]) -> f64 {
    if values.len() < 2 {
        return 0.0;
    }
    let mean = average(values);
    let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
    libm::sqrt(squares / (values.len() - 1) as f64 / values.len() as f64)
}

/// The 97.5 % quantile of Student's distribution: from tables to 30 degrees of freedom, then the expansion in 1/df
/// (Abramowitz & Stegun 26.7.5), which is right to four digits there.
pub fn student_975(degrees: usize) -> f64 {
    const TABLE: [f64; 30] = [
        12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281, 2.2010, 2.1788,
        2.1604, 2.1448, 2.1314, 2.1199, 2.1098, 2.1009, 2.0930, 2.0860, 2.0796, 2.0739, 2.0687, 2.0639,
        2.0595, 2.0555, 2.0518, 2.0484, 2.0452, 2.0423,
    ];
    match degrees {
        0 => 0.0,
        1..=30 => TABLE[degrees - 1],
        _ => {
            let (z, n) = (1.959_964_f64, degrees as f64);
            let z3 = z * z * z;
            let z5 = z3 * z * z;
            z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n)
        }
    }
}

/// Wilson's 95 % interval of a share.
pub fn wilson_95(met: usize, of: usize) -> (f64, f64) {
    let (n, p, z) = (of as f64, met as f64 / of as f64, 1.959_964_f64);
    let centre = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let reach = z / (1.0 + z * z / n) * libm::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
    ((centre - reach).max(0.0), (centre + reach).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR: Expect = Expect::Near { value: 130.0, within: 4.0 };

    fn verdict(expect: Expect, statistic: Statistic, values: &[f64]) -> Verdict {
        let values: Vec<_> = values.iter().copied().map(Some).collect();
        judge(expect, statistic, &values, &values).verdict
    }

    #[test]
    fn one_number_is_judged_at_the_bound() {
        assert_eq!(verdict(NEAR, Statistic::Each, &[134.0]), Verdict::Holds);
        assert_eq!(verdict(NEAR, Statistic::Each, &[134.001]), Verdict::Fails);
        assert_eq!(verdict(Expect::Rises, Statistic::Each, &[0.0]), Verdict::Fails);
        assert_eq!(verdict(Expect::True, Statistic::Each, &[1.0]), Verdict::Holds);
        assert_eq!(verdict(NEAR, Statistic::Each, &[f64::NAN]), Verdict::Fails);
    }

    #[test]
    fn none_fails_and_is_reported_as_none() {
        for statistic in [Statistic::Each, Statistic::Mean] {
            let judged = judge(NEAR, statistic, &[Some(130.0), None], &[Some(130.0), None]);
            assert_eq!(judged, Judgement { measured: None, verdict: Verdict::Fails });
        }
        assert_eq!(judge(NEAR, Statistic::Each, &[], &[]).verdict, Verdict::Fails);
    }

    #[test]
    fn each_reports_the_worst() {
        let values: Vec<_> = [130.0, 137.0, 128.0].map(Some).to_vec();
        assert_eq!(judge(NEAR, Statistic::Each, &values, &values).measured, Some(137.0));
    }

    #[test]
    fn a_mean_whose_interval_straddles_the_bound_is_undecided() {
        assert_eq!(verdict(NEAR, Statistic::Mean, &[130.0, 131.0, 129.0, 130.0]), Verdict::Holds);
        assert_eq!(verdict(NEAR, Statistic::Mean, &[130.0, 138.0, 129.0, 137.0]), Verdict::Undecided);
        assert_eq!(verdict(NEAR, Statistic::Mean, &[140.0, 141.0, 139.0, 140.0]), Verdict::Fails);
    }

    #[test]
    fn a_share_needs_enough_seeds() {
        let seeds =
            |met: usize, of: usize| (0..of).map(|i| if i < met { 130.0 } else { 200.0 }).collect::<Vec<_>>();
        assert_eq!(verdict(NEAR, Statistic::Share(0.5), &seeds(36, 40)), Verdict::Holds);
        assert_eq!(verdict(NEAR, Statistic::Share(0.5), &seeds(22, 40)), Verdict::Undecided);
        assert_eq!(verdict(NEAR, Statistic::Share(0.5), &seeds(2, 40)), Verdict::Fails);
    }

    /// Against published quantiles: 2.0227 at 39 degrees, 1.9840 at 99.
    #[test]
    fn quantiles_are_the_published_ones() {
        assert!((student_975(39) - 2.0227).abs() < 1e-4);
        assert!((student_975(99) - 1.9842).abs() < 1e-4);
        let (low, high) = wilson_95(8, 10);
        assert!((low - 0.4902).abs() < 1e-4 && (high - 0.9433).abs() < 1e-4);
    }
}
