//! Searches of known rules are recognised, and the published ones give what was found by hand.

use proptest::prelude::*;

use super::*;
use crate::reading::Reading;

/// How a search of ours takes its slopes.
#[derive(Clone, Copy, Debug)]
enum Made {
    Secant,
    Chain,
    Difference(Side),
    ChainDifference(Side),
}

const TARGET: f64 = 130.0;
const ETA: f64 = 1e-6;

/// A search of four steps on y, which the search sees as `seen`, printed to six places and whole y.
fn search(
    y: &dyn Fn(f64) -> f64,
    seen: &dyn Fn(f64) -> f64,
    printed: &dyn Fn(f64) -> f64,
    made: Made,
    h: f64,
) -> Option<PrintedSearch> {
    let number = |x: f64| seen(y(x));
    let f = |x: f64| (number(x) - TARGET) * (number(x) - TARGET);
    let change = |side, of: &dyn Fn(f64) -> f64, x: f64| match side {
        Side::Forward => (of(x + h) - of(x)) / h,
        Side::Backward => (of(x) - of(x - h)) / h,
        Side::Central => (of(x + h) - of(x - h)) / (2.0 * h),
    };
    let mut path: Vec<f64> = vec![0.25];
    for _ in 0..4 {
        let x = path[path.len() - 1];
        let before = path.len().checked_sub(2).map(|at| path[at]);
        let chained = |slope: f64| 2.0 * (number(x) - TARGET) * slope;
        let slope = match (made, before) {
            (Made::Difference(side), _) => change(side, &f, x),
            (Made::ChainDifference(side), _) => chained(change(side, &number, x)),
            (_, None) => change(Side::Forward, &f, x),
            (Made::Secant, Some(before)) => (f(x) - f(before)) / (x - before),
            (Made::Chain, Some(before)) => chained((number(x) - number(before)) / (x - before)),
        };
        if slope == 0.0 || !slope.is_finite() {
            break;
        }
        path.push(x - ETA * slope);
    }
    let rows: Vec<(String, String)> =
        path.iter().map(|x| (format!("{x:.6}"), format!("{}", printed(y(*x))))).collect();
    let rows: Vec<(&str, &str)> = rows.iter().map(|(x, y)| (x.as_str(), y.as_str())).collect();
    // Where whole y stand still over h there are no steps to examine.
    PrintedSearch::new(&rows, "1e-6", Some("130")).ok()
}

fn differences() -> Differences {
    Differences { h: (Decimal::parse("1e-6").unwrap(), Decimal::parse("0.1").unwrap()), y: (1, 400) }
}

fn verdict(search: &PrintedSearch, rule: Rule, y: Printing) -> Verdict {
    examine(search, Hypothesis { rule, y }, &differences()).unwrap().verdict
}

fn as_it_is(y: f64) -> f64 {
    y
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Falling, curved and wavy y: the rule that made a table survives it, whatever was printed.
    #[test]
    fn the_rule_that_made_a_table_survives(
        slope in 300.0..700.0f64, curve in 0.0..600.0f64, wave in 0.0..0.8f64, first in 138.0..170.0f64,
        h in 0.002..0.02f64,
    ) {
        let y = |x: f64| {
            let d = x - 0.25;
            first - slope * d + curve * d * d + wave * libm::sin(400.0 * d)
        };
        for printing in [Printing::Ceiling, Printing::Rounded, Printing::Floor] {
            let print = |y: f64| match printing {
                Printing::Ceiling => y.ceil(),
                Printing::Floor => y.floor(),
                _ => y.round(),
            };
            // The search saw the real y, and it was printed so.
            for (made, rule) in [
                (Made::Secant, Rule::BackwardSecant),
                (Made::Secant, Rule::SecantOfAnyEta),
                (Made::Secant, Rule::SecantWithMomentum),
                (Made::Chain, Rule::ChainBackward),
            ] {
                let Some(table) = search(&y, &as_it_is, &print, made, h) else { continue };
                prop_assert_eq!(verdict(&table, rule, printing), Verdict::Survives, "{:?}", table);
            }
            // The search saw whole numbers.
            let sides = [Side::Forward, Side::Backward, Side::Central];
            for (made, rule) in sides.map(|side| (Made::Difference(side), Rule::Difference(side))).into_iter()
                .chain(sides.map(|side| (Made::ChainDifference(side), Rule::ChainDifference(side))))
            {
                let Some(table) = search(&y, &print, &print, made, h) else { continue };
                let found = examine(&table, Hypothesis { rule, y: Printing::Exact }, &differences()).unwrap();
                prop_assert!(found.verdict != Verdict::Refuted, "{:?}", table);
                let near = |span: &Span| span.to_f64().0 < h * 1.000001 && span.to_f64().1 > h * 0.999999;
                prop_assert!(found.left.iter().any(near), "{} is lost: {:?}", h, table);
            }
            let Some(table) = search(&y, &print, &print, Made::Secant, h) else { continue };
            prop_assert_eq!(verdict(&table, Rule::BackwardSecant, Printing::Exact), Verdict::Survives);
        }
    }

    /// A secant in thirds of a unit fits thirds and sixths.
    #[test]
    fn parts_of_a_unit_are_found(slope in 300.0..700.0f64, first in 150.0..170.0f64) {
        let thirds = |y: f64| (3.0 * y).ceil() / 3.0;
        let table = search(&|x| first - slope * (x - 0.25), &thirds, &f64::ceil, Made::Secant, 0.01).unwrap();
        let fits = parts_that_fit(&table, Printing::Ceiling, 6).unwrap();
        prop_assert!(fits.contains(&3) && fits.contains(&6), "{:?} {:?}", fits, table);
    }
}

/// On a table that a secant of whole numbers made, everything else that could have is refuted.
#[test]
fn other_rules_are_refuted() {
    let y = |x: f64| 161.3 - 520.0 * (x - 0.25) + 300.0 * (x - 0.25) * (x - 0.25);
    let table = search(&y, &f64::ceil, &f64::ceil, Made::Secant, 0.01).unwrap();
    let survivors: Vec<(Rule, Printing)> = Hypothesis::all()
        .into_iter()
        .filter(|hypothesis| {
            examine(&table, *hypothesis, &differences()).unwrap().verdict == Verdict::Survives
        })
        .map(|hypothesis| (hypothesis.rule, hypothesis.y))
        .collect();
    for wrong in [
        Rule::SecantUnsquared,
        Rule::SecantUnsquaredOfAnyEta,
        Rule::ForwardSecant,
        Rule::ChainBackward,
        Rule::ChainForward,
        Rule::Difference(Side::Forward),
        Rule::Difference(Side::Backward),
    ] {
        assert!(survivors.iter().all(|(rule, _)| *rule != wrong), "{wrong:?}: {survivors:?}");
    }
    for right in [Rule::BackwardSecant, Rule::SecantOfAnyEta, Rule::SecantOfAnyTarget] {
        assert!(survivors.contains(&(right, Printing::Exact)), "{right:?}: {survivors:?}");
    }
}

fn published() -> [PrintedSearch; 2] {
    [
        [("0.25", "160"), ("0.261856", "152"), ("0.295357", "139"), ("0.307597", "126")],
        [("0.25", "162"), ("0.294132", "135"), ("0.316651", "124"), ("0.315713", "127")],
    ]
    .map(|rows| PrintedSearch::new(&rows, "1e-6", Some("130")).unwrap())
}

/// By hand: the secants of whole T are -35088, -12030 and -22637, 488; the steps used -33501, -12240 and -22519, 938.
#[test]
fn the_published_tables_are_secants_of_a_real_end_frame() {
    let tables = published();
    let found = |k: usize, rule, y| examine(&tables[k], Hypothesis { rule, y }, &differences()).unwrap();
    for k in [0, 1] {
        let whole = found(k, Rule::BackwardSecant, Printing::Exact);
        assert_eq!((whole.verdict, whole.refuted_by), (Verdict::Refuted, vec![1, 2]));
        for printing in [Printing::Ceiling, Printing::Rounded] {
            assert_eq!(found(k, Rule::BackwardSecant, printing).verdict, Verdict::Survives);
            let eta = found(k, Rule::SecantOfAnyEta, printing).left[0];
            assert!(eta.holds(Ratio::new(1, 1_000_000).unwrap()) && eta.to_f64().1 < 1.3e-6, "{eta}");
        }
    }
    let floor = found(1, Rule::BackwardSecant, Printing::Floor);
    assert_eq!((floor.verdict, floor.refuted_by), (Verdict::Refuted, vec![2]));
    // f1 = f0 - 397.19 and f2 = f1 - 410.05 leave f0 in 871.2..881.2, by hand: T0 from 159.52 to 159.69.
    let f = f_of_secants(&tables[0], Printing::Ceiling).unwrap();
    assert_eq!(f[0].to_string(), "871.1658..881.2165");
    assert_eq!(f_of_secants(&tables[1], Printing::Floor), None);
    let parts = tables.map(|table| parts_that_fit(&table, Printing::Ceiling, 60).unwrap());
    assert_eq!((parts[0][0], parts[1][0]), (27, 24));
    assert_eq!(parts[0].iter().find(|k| parts[1].contains(k)), Some(&47));
}

/// The largest tables and the smallest step lengths that are read widen no interval to everything.
#[test]
fn extreme_digits_fit() {
    let rows = [("0.123456789012", "999999"), ("0.223456789013", "888887"), ("0.987654321098", "777779")];
    let search = PrintedSearch::new(&rows, "1.234e-9", Some("123457")).unwrap();
    for hypothesis in Hypothesis::all() {
        let found = examine(&search, hypothesis, &differences()).unwrap();
        for span in found.predicted.iter().flatten() {
            assert_ne!(*span, Span::EVERYTHING, "{hypothesis:?}");
        }
    }
    assert_ne!(search.slope(1).times(search.step(0)), Span::EVERYTHING);
}

#[test]
fn without_a_target_y_is_the_objective() {
    // x^2 from 1 by the secant with eta 1/4 after a first step to 0.6: slope 1.6, then 0.8.
    let rows = [("1", "1"), ("0.6", "0.36"), ("0.2", "0.04"), ("0", "0")];
    let search = PrintedSearch::new(&rows, "0.25", None).unwrap();
    let secant = Hypothesis { rule: Rule::BackwardSecant, y: Printing::Exact };
    assert_eq!(examine(&search, secant, &differences()).unwrap().verdict, Verdict::Survives);
    let chain = Hypothesis { rule: Rule::ChainBackward, y: Printing::Exact };
    assert_eq!(examine(&search, chain, &differences()), None);
    let names: Vec<&str> = Printing::ALL.iter().map(|printing| printing.name()).collect();
    assert_eq!(names, ["exact", "ceiling", "rounded", "floor"]);
}
