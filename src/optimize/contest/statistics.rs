//! Statistics of runtimes.

use crate::rng::Moment;

/// Evaluations to a target, or those that were spent without meeting it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Runtime {
    /// Evaluations.
    pub evaluations: u64,
    /// Whether the target was met.
    pub reached: bool,
}

/// The expected runtime of COCO: all evaluations over the number of runs that met the target; none if none did.
///
/// It is the mean runtime of a solver that is started again until it meets the target (Hansen et al., *COCO*, Optim.
/// Methods Softw. 36, 2021, §6).
pub fn expected_runtime(runs: &[Runtime]) -> Option<f64> {
    let reached = runs.iter().filter(|run| run.reached).count();
    let evaluations: u64 = runs.iter().map(|run| run.evaluations).sum();
    (reached > 0).then(|| evaluations as f64 / reached as f64)
}

/// The percentile interval, at a level such as 0.95, of the expected runtime over all groups together, by drawing as
/// many runs as there are from each group with replacement, `resamples` times.
///
/// A draw without a run that met the target counts as infinite. None where no run met it.
pub fn bootstrap_stratified(
    groups: &[Vec<Runtime>],
    level: f64,
    resamples: u64,
    moment: &Moment,
) -> Option<(f64, f64)> {
    if !groups.iter().flatten().any(|run| run.reached) {
        return None;
    }
    let mut draws: Vec<f64> = (0..resamples)
        .map(|draw| {
            let mut sample = Vec::new();
            for (number, group) in groups.iter().enumerate() {
                let mut place = moment.place(draw as i32, number as i32, 0);
                let one =
                    |uniform: f64| group[((uniform * group.len() as f64) as usize).min(group.len() - 1)];
                sample.extend((0..group.len()).map(|_| one(place.uniform())));
            }
            expected_runtime(&sample).unwrap_or(f64::INFINITY)
        })
        .collect();
    draws.sort_by(f64::total_cmp);
    let at = |share: f64| quantile_of_sorted(&draws, share);
    Some((at(0.5 * (1.0 - level))?, at(0.5 * (1.0 + level))?))
}

/// The share of (problem, seed, target) that were met within so many evaluations, over all, met or not: a step at each
/// number of evaluations at which there is one.
pub fn ecdf(arrivals: &[Option<u64>]) -> Vec<(u64, f64)> {
    let mut times: Vec<u64> = arrivals.iter().copied().flatten().collect();
    times.sort_unstable();
    let mut steps: Vec<(u64, f64)> = Vec::new();
    for (k, time) in times.iter().enumerate() {
        let share = (k + 1) as f64 / arrivals.len() as f64;
        match steps.last_mut() {
            Some(last) if last.0 == *time => last.1 = share,
            _ => steps.push((*time, share)),
        }
    }
    steps
}

/// The number below which a share of the numbers lies, straight lines between them (type 7 of Hyndman & Fan 1996);
/// infinite ones are later than all. None of none.
pub fn quantile(numbers: &[f64], share: f64) -> Option<f64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    quantile_of_sorted(&sorted, share)
}

fn quantile_of_sorted(sorted: &[f64], share: f64) -> Option<f64> {
    let place = share * (sorted.len().checked_sub(1)?) as f64;
    let (below, part) = (libm::floor(place), place - libm::floor(place));
    let low = sorted[below as usize];
    if part == 0.0 {
        return Some(low);
    }
    let high = sorted[below as usize + 1];
    Some(if low == high { low } else { low + part * (high - low) })
}

/// Wilcoxon's signed ranks of paired numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct SignedRank {
    /// Pairs that differ.
    pub pairs: usize,
    /// Pairs that do not: they are left out, as Wilcoxon did.
    pub zeros: usize,
    /// Sum of the ranks of the pairs whose first number is the greater.
    pub w_plus: f64,
    /// Sum of the ranks of the others.
    pub w_minus: f64,
    /// Matched-pairs rank-biserial correlation (Kerby 2014): 1 where the first is always greater, -1 where never.
    pub effect: f64,
    /// Two-sided p-value: exact up to 50 pairs, ties among them; else by the normal distribution with corrections for
    /// ties and continuity.
    pub p: f64,
}

/// Pairs up to which the p-value is exact.
const EXACT: usize = 50;

/// Wilcoxon's signed-rank test (Biometrics Bulletin 1, 1945) on pairs. Infinite numbers are greater than all finite
/// ones, by differences that are ties; two infinite ones are equal.
pub fn wilcoxon_signed_rank(pairs: &[(f64, f64)]) -> SignedRank {
    let difference = |(first, second): &(f64, f64)| if first == second { 0.0 } else { first - second };
    let mut differences: Vec<f64> = pairs.iter().map(difference).filter(|d| *d != 0.0).collect();
    differences.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let doubled = doubled_mid_ranks(&differences);
    let sum = |sign: fn(f64) -> bool| -> u64 {
        differences.iter().zip(&doubled).filter(|(d, _)| sign(**d)).map(|(_, rank)| *rank).sum()
    };
    let (plus, minus) = (sum(|d| d > 0.0), sum(|d| d < 0.0));
    let p = match differences.len() {
        0 => 1.0,
        n if n <= EXACT => exact_p(&doubled, plus.min(minus)),
        _ => normal_p(&doubled, plus.min(minus)),
    };
    let all = (plus + minus) as f64;
    SignedRank {
        pairs: differences.len(),
        zeros: pairs.len() - differences.len(),
        w_plus: plus as f64 / 2.0,
        w_minus: minus as f64 / 2.0,
        effect: if all > 0.0 { (plus as f64 - minus as f64) / all } else { 0.0 },
        p,
    }
}

/// Twice the mid-ranks of numbers that are sorted by size, so that they are whole.
fn doubled_mid_ranks(sorted: &[f64]) -> Vec<u64> {
    let mut ranks = Vec::with_capacity(sorted.len());
    let mut first = 0;
    while first < sorted.len() {
        let equal = sorted[first..].iter().take_while(|d| d.abs() == sorted[first].abs()).count();
        let doubled = (2 * first + equal + 1) as u64;
        ranks.extend(std::iter::repeat_n(doubled, equal));
        first += equal;
    }
    ranks
}

/// The share of all ways to give signs in which the lesser sum is at most this, by counting them.
fn exact_p(doubled: &[u64], least: u64) -> f64 {
    let most: u64 = doubled.iter().sum();
    let mut ways = vec![0.0; most as usize + 1];
    ways[0] = 1.0;
    for rank in doubled {
        for sum in (*rank as usize..ways.len()).rev() {
            ways[sum] += ways[sum - *rank as usize];
        }
    }
    let tail: f64 = ways[..=least as usize].iter().sum();
    let all = libm::exp2(doubled.len() as f64);
    (2.0 * tail / all).min(1.0)
}

fn normal_p(doubled: &[u64], least: u64) -> f64 {
    let ranks = doubled.iter().map(|rank| *rank as f64 / 2.0);
    let (mean, variance) = ranks.fold((0.0, 0.0), |(m, v), rank| (m + rank / 2.0, v + rank * rank / 4.0));
    let z = ((mean - least as f64 / 2.0).abs() - 0.5).max(0.0) / libm::sqrt(variance);
    libm::erfc(z / std::f64::consts::SQRT_2).min(1.0)
}

/// Holm's adjusted p-values (Scand. J. Statist. 6, 1979), in the order of those given.
pub fn holm(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*a].total_cmp(&p[*b]));
    let mut adjusted = vec![1.0; p.len()];
    let mut greatest: f64 = 0.0;
    for (k, at) in order.into_iter().enumerate() {
        greatest = greatest.max((p.len() - k) as f64 * p[at]).min(1.0);
        adjusted[at] = greatest;
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Seed;

    fn run(evaluations: u64, reached: bool) -> Runtime {
        Runtime { evaluations, reached }
    }

    #[test]
    fn expected_runtime_charges_failures_to_successes() {
        assert_eq!(expected_runtime(&[run(10, true), run(60, false), run(20, true)]), Some(45.0));
        assert_eq!(expected_runtime(&[run(60, false)]), None);
    }

    /// All-equal runs have no spread; a single success among failures may be missed by a draw.
    #[test]
    fn the_bootstrap_knows_certainty_and_doubt() {
        let moment = Seed(1).stream("bootstrap").at(0);
        let same = [vec![run(7, true); 5], vec![run(7, true); 3]];
        assert_eq!(bootstrap_stratified(&same, 0.95, 200, &moment), Some((7.0, 7.0)));
        let rare = [vec![run(7, true), run(50, false), run(50, false)]];
        assert_eq!(bootstrap_stratified(&rare, 0.95, 200, &moment).unwrap().1, f64::INFINITY);
        assert_eq!(bootstrap_stratified(&[vec![run(50, false)]], 0.95, 200, &moment), None);
    }

    /// The mean of n runs that all succeed is normal for large n: its interval is 1.96 standard errors on either side.
    #[test]
    fn the_bootstrap_of_a_mean_is_as_wide_as_it_should_be() {
        let runs: Vec<Runtime> = (0..400).map(|k| run(100 + (k * 37) % 101, true)).collect();
        let (low, high) =
            bootstrap_stratified(std::slice::from_ref(&runs), 0.95, 2000, &Seed(1).stream("b").at(0))
                .unwrap();
        let mean = expected_runtime(&runs).unwrap();
        let squares = runs.iter().map(|r| (r.evaluations as f64 - mean) * (r.evaluations as f64 - mean));
        let variance = squares.sum::<f64>() / 400.0;
        let expected = 1.96 * (variance / 400.0).sqrt();
        assert!(((high - low) / 2.0 / expected - 1.0).abs() < 0.08, "{low} {mean} {high} {expected}");
    }

    /// SciPy 1.17.1: `wilcoxon(x, y)` with `method` exact, by permutation where there are ties, and asymptotic with
    /// `correction=True`.
    #[test]
    fn signed_ranks_are_scipys() {
        let pairs = |x: &[f64], y: &[f64]| x.iter().copied().zip(y.iter().copied()).collect::<Vec<_>>();
        let c = [1.1, 2.3, 3.7, 4.0, 5.9, 6.2, 7.8, 8.1];
        let d = [1.0, 2.6, 3.1, 4.9, 4.0, 8.3, 5.5, 8.6];
        let exact = wilcoxon_signed_rank(&pairs(&c, &d));
        assert_eq!((exact.w_plus.min(exact.w_minus), exact.p), (17.0, 0.9453125));

        let x = [125.0, 115.0, 130.0, 140.0, 140.0, 115.0, 140.0, 125.0, 140.0, 135.0];
        let y = [110.0, 122.0, 125.0, 120.0, 140.0, 124.0, 123.0, 137.0, 135.0, 145.0];
        let tied = wilcoxon_signed_rank(&pairs(&x, &y));
        assert_eq!((tied.zeros, tied.pairs, tied.w_plus.min(tied.w_minus), tied.p), (1, 9, 18.0, 0.6328125));

        let many: Vec<(f64, f64)> =
            (0..60).map(|k| (f64::from(k * 37 % 61), f64::from(k * 23 % 61 + 4))).collect();
        let normal = wilcoxon_signed_rank(&many);
        assert_eq!(normal.w_plus.min(normal.w_minus), 753.5);
        assert!((normal.p - 0.322_732_231_596_683_85).abs() < 1e-12, "{}", normal.p);
    }

    #[test]
    fn what_never_arrives_is_later_than_all() {
        let never = f64::INFINITY;
        let ranks = wilcoxon_signed_rank(&[(1.0, never), (never, never), (5.0, 2.0), (3.0, never)]);
        assert_eq!((ranks.pairs, ranks.zeros, ranks.w_plus, ranks.w_minus), (3, 1, 1.0, 5.0));
        assert!((ranks.effect + 4.0 / 6.0).abs() < 1e-15);
        assert_eq!(wilcoxon_signed_rank(&[(2.0, 2.0)]).p, 1.0);
    }

    /// The example of Holm's paper in R's `p.adjust(c(0.01, 0.02, 0.03, 0.04), "holm")`, in another order.
    #[test]
    fn holms_p_values_never_fall() {
        let adjusted = holm(&[0.03, 0.01, 0.04, 0.02]);
        let expected = [0.06, 0.04, 0.06, 0.06];
        assert!(adjusted.iter().zip(expected).all(|(a, e)| (a - e).abs() < 1e-15), "{adjusted:?}");
    }

    #[test]
    fn steps_count_what_was_never_met() {
        assert_eq!(ecdf(&[Some(3), None, Some(1), Some(3)]), [(1, 0.25), (3, 0.75)]);
        assert_eq!(quantile(&[4.0, 1.0, 2.0, 3.0], 0.5), Some(2.5));
        assert_eq!(quantile(&[1.0, f64::INFINITY, 2.0], 1.0), Some(f64::INFINITY));
        assert_eq!(quantile(&[], 0.5), None);
    }
}
