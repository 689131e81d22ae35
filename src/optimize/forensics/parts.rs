//! What the backward secant says of a real y: where f was, and whether y can have been a whole number of parts of its
//! unit.

use super::exact::{Ratio, Span};
use super::printed::{PrintedSearch, Printing};

/// The numbers k up to `most` with which the search can be the backward secant's with every y = n/k, n whole, printed
/// so; none without a target or for a y that is not printed as a whole number.
///
/// With k = 1 this is the secant of the printed y; a simulation that takes k solver steps to a frame, and ends in whole
/// steps, gives such y.
pub fn parts_that_fit(search: &PrintedSearch, printing: Printing, most: u32) -> Option<Vec<u32>> {
    let target = search.target?.in_units(0)?;
    let frames = search.rows.iter().map(|row| row.1.in_units(0)).collect::<Option<Vec<_>>>()?;
    let misses: Vec<i128> = frames.iter().map(|frame| frame - target).collect();
    let wanted: Vec<Span> = (1..search.steps()).map(|i| search.slope(i).times(search.step(i - 1))).collect();
    let fits = |k: u32| {
        let k = i128::from(k);
        let square = Span::point(Ratio::whole(k * k));
        let mut reached = numerators(misses[0], k, printing);
        for (i, change) in wanted.iter().enumerate() {
            let change = change.times(square);
            let least = change.low.map_or(i128::MIN, Ratio::ceiling);
            let most = change.high.map_or(i128::MAX, Ratio::floor);
            let fits = |change: i128| (least..=most).contains(&change);
            reached = numerators(misses[i + 1], k, printing)
                .into_iter()
                .filter(|n| reached.iter().any(|before| fits(n * n - before * before)))
                .collect();
        }
        !reached.is_empty()
    };
    Some((1..=most).filter(|k| fits(*k)).collect())
}

/// Where f was at each row whose f a step used, if the steps are backward secants of a real y that was printed so: all
/// steps together bound it more closely than its own digits. None if there is no such f.
pub fn f_of_secants(search: &PrintedSearch, printing: Printing) -> Option<Vec<Span>> {
    let wanted = |row: usize| search.slope(row).times(search.step(row - 1));
    let mut left: Vec<Span> = (0..search.steps()).map(|row| search.f(row, printing)).collect();
    for row in 1..left.len() {
        left[row] = left[row - 1].plus(wanted(row)).meet(left[row])?;
    }
    for row in (1..left.len()).rev() {
        left[row - 1] = left[row].minus(wanted(row)).meet(left[row - 1])?;
    }
    Some(left)
}

/// Whole n with n/k printed as this miss; a half is rounded either way.
fn numerators(miss: i128, k: i128, printing: Printing) -> Vec<i128> {
    let from_to = |twice_from: i128, twice_to: i128| {
        (k * (2 * miss + twice_from)).div_euclid(2)..=(k * (2 * miss + twice_to)).div_euclid(2)
    };
    match printing {
        Printing::Exact => vec![k * miss],
        Printing::Ceiling => from_to(-2, 0).skip(1).collect(),
        Printing::Floor => from_to(0, 2).take(k as usize).collect(),
        Printing::Rounded => from_to(-1, 1).filter(|n| 2 * n >= k * (2 * miss - 1)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numerators_by_hand() {
        assert_eq!(numerators(2, 3, Printing::Exact), [6]);
        assert_eq!(numerators(2, 3, Printing::Ceiling), [4, 5, 6]);
        assert_eq!(numerators(2, 3, Printing::Floor), [6, 7, 8]);
        assert_eq!(numerators(2, 3, Printing::Rounded), [5, 6, 7]);
        assert_eq!(numerators(2, 2, Printing::Rounded), [3, 4, 5]);
        assert_eq!(numerators(-2, 3, Printing::Ceiling), [-8, -7, -6]);
        assert_eq!(numerators(-1, 3, Printing::Rounded), [-4, -3, -2]);
    }
}
