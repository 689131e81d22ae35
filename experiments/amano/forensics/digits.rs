//! What the printed digits say of each hypothesis.

use snowglobe::lab::{Axis, Draw, Lab, Plot, Result, Series, Table};
use snowglobe::optimize::forensics::{
    Differences, Examined, Hypothesis, PrintedSearch, Printing, Ratio, Rule, Side, Span, Verdict, examine,
    f_of_secants, parts_that_fit, shared_by,
};
use snowglobe::reading::Reading;

use super::Printed;

/// Tables that know no rule, for what a survival is worth: each step times 1/2 to 2.
const SCRAMBLED: u64 = 200;
/// And such with steps moved by up to 0.2 %, which keeps the secants but not their arithmetic.
const JITTERED: (u64, f64) = (100, 0.003);
/// The finest division of a frame that is tried.
const FINEST: u32 = 60;

/// h that somebody would choose: (numerator, denominator).
const ROUND: [(i128, i128); 14] = [
    (1, 10),
    (5, 100),
    (2, 100),
    (1, 100),
    (5, 1000),
    (2, 1000),
    (1, 1000),
    (5, 10_000),
    (2, 10_000),
    (1, 10_000),
    (5, 100_000),
    (2, 100_000),
    (1, 100_000),
    (1, 1_000_000),
];

pub fn keep(lab: &mut Lab, printed: &Printed, tried: &Differences) -> Result<()> {
    let searches = printed.searches()?;
    lab.keep(
        "implied",
        "The derivative that each printed step used, as an exact interval, and what some rules predict for it",
        implied(&searches, tried),
    )?;
    let scrambled = scrambled(lab, &searches, lab.pick(SCRAMBLED, 4), 1.0);
    lab.keep(
        "hypotheses",
        "Every hypothesis against both tables: the steps that refute it, what is left of its free number, and how many \
         of 200 tables with random steps it survives",
        hypotheses(lab, &searches, &scrambled, tried),
    )?;
    lab.keep(
        "one-h",
        "Differences of whole end frames over one h: what is left of h from 1e-6 to 0.1, which round h are, and how \
         many of 200 tables with random steps leave any",
        one_h(lab, &searches, &scrambled, tried),
    )?;
    let jittered = self::scrambled(lab, &searches, lab.pick(JITTERED.0, 2), JITTERED.1);
    lab.keep(
        "parts-of-a-frame",
        "Secants of end frames that are whole numbers of k-th parts of a frame: the k up to 60 that fit, and how often \
         a k fits such tables with steps moved by up to 0.2 %",
        parts(lab, &searches, &jittered),
    )?;
    for (k, search) in searches.iter().enumerate() {
        let name = format!("derivatives-table-{}", k + 1);
        let caption = format!(
            "Table {}: the interval of derivatives that each rule predicts for a step, over the derivative that the \
             step used; a rule whose interval misses 1 is refuted, and one that is not shown lies outside the plot",
            k + 1
        );
        lab.keep(&name, &caption, plot(search, k + 1, tried))?;
    }
    Ok(())
}

fn scrambled(lab: &Lab, searches: &[PrintedSearch], count: u64, octaves: f64) -> Vec<Vec<PrintedSearch>> {
    let of = |(k, search): (usize, &PrintedSearch)| {
        let stream = lab.stream(&format!("random steps of table {}, {octaves} octaves", k + 1));
        (0..count).map(|draw| search.scrambled(octaves, &stream.at(draw))).collect()
    };
    searches.iter().enumerate().map(of).collect()
}

/// With y as printed: `exact` has the search use the whole frame itself.
fn t_sim(printing: Printing) -> &'static str {
    match printing {
        Printing::Exact => "whole",
        Printing::Ceiling => "real, printed as the first whole frame",
        Printing::Rounded => "real, rounded",
        Printing::Floor => "real, cut off",
    }
}

fn steps(steps: &[usize]) -> String {
    steps.iter().map(usize::to_string).collect::<Vec<_>>().join(" ")
}

/// The same digits, cut off instead of rounded, or with a first value that was rounded, too.
fn other_digits(search: &PrintedSearch) -> Vec<PrintedSearch> {
    let with = |x_printed, first_is_exact| PrintedSearch { x_printed, first_is_exact, ..search.clone() };
    vec![with(Printing::Rounded, false), with(Printing::Floor, true), with(Printing::Floor, false)]
}

fn hypotheses(
    lab: &Lab,
    searches: &[PrintedSearch],
    scrambled: &[Vec<PrintedSearch>],
    tried: &Differences,
) -> Table {
    let mut table = Table::new([
        "rule",
        "t_sim",
        "free_numbers",
        "table",
        "verdict",
        "steps_tested",
        "refuted_by_steps",
        "left",
        "random_tables_survived",
        "verdict_with_other_digits",
    ]);
    let cases: Vec<(Hypothesis, usize)> = Hypothesis::all()
        .into_iter()
        .flat_map(|hypothesis| (0..searches.len()).map(move |k| (hypothesis, k)))
        .collect();
    let rows = lab.each(&cases, |(hypothesis, k)| {
        let found = examine(&searches[*k], *hypothesis, tried)?;
        let verdict = |search: &PrintedSearch| examine(search, *hypothesis, tried).map(|e| e.verdict);
        let open = found.verdict == Verdict::Open;
        let by_chance = |all: &[PrintedSearch]| {
            let survived = all.iter().filter(|other| verdict(other) == Some(Verdict::Survives)).count();
            survived as f64 / all.len() as f64
        };
        let same = other_digits(&searches[*k]).iter().all(|other| verdict(other) == Some(found.verdict));
        Some((found, (!open).then(|| by_chance(&scrambled[*k])), same))
    });
    for ((hypothesis, k), row) in cases.iter().zip(rows) {
        let Some((found, chance, same)) = row else { continue };
        table.row([
            hypothesis.rule.name().into(),
            t_sim(hypothesis.y).into(),
            hypothesis.rule.free().join(" and ").into(),
            (k + 1).into(),
            found.verdict.name().into(),
            steps(&found.tested).into(),
            steps(&found.refuted_by).into(),
            found.detail().into(),
            snowglobe::lab::maybe(chance),
            if same { "the same" } else { "another" }.into(),
        ]);
    }
    table
}

fn implied(searches: &[PrintedSearch], tried: &Differences) -> Table {
    let mut table = Table::new([
        "table",
        "step",
        "beta",
        "end_frame",
        "derivative_of_f",
        "derivative_of_T_if_whole",
        "change_of_f_by_secant",
        "secant_of_whole_T",
        "secant_of_real_T_first_whole_frame",
        "secant_of_real_T_rounded",
        "secant_of_real_T_cut_off",
        "chain_rule_with_secant_of_real_T",
        "T_needed_if_first_whole_frame",
        "T_needed_if_rounded",
    ]);
    for (k, search) in searches.iter().enumerate() {
        let predicted = |rule, y| examine(search, Hypothesis { rule, y }, tried).map(|e| e.predicted);
        let secants = Printing::ALL.iter().map(|y| predicted(Rule::BackwardSecant, *y)).collect::<Vec<_>>();
        let chain = predicted(Rule::ChainBackward, Printing::Ceiling);
        let cell = |of: &Option<Vec<Option<Span>>>, step: usize| {
            of.as_ref().and_then(|spans| spans[step]).map_or(String::new(), |span| span.to_string())
        };
        for step in 0..search.steps() {
            let slope = search.slope(step);
            let twice = search.miss(step, Printing::Exact).plus(search.miss(step, Printing::Exact));
            let change = (step > 0).then(|| slope.times(search.step(step - 1)).to_string());
            table.row([
                (k + 1).into(),
                step.into(),
                search.rows[step].0.value().to_f64().into(),
                search.rows[step].1.value().to_f64().into(),
                slope.into(),
                slope.over(twice).into(),
                change.unwrap_or_default().into(),
                cell(&secants[0], step).into(),
                cell(&secants[1], step).into(),
                cell(&secants[2], step).into(),
                cell(&secants[3], step).into(),
                cell(&chain, step).into(),
                needed(search, step, Printing::Ceiling).into(),
                needed(search, step, Printing::Rounded).into(),
            ]);
        }
    }
    table
}

/// The real end frame of a row that all secants of its table together need, to a thousandth of a frame.
fn needed(search: &PrintedSearch, row: usize, printing: Printing) -> String {
    let (Some(f), Some(target)) = (f_of_secants(search, printing), search.target) else {
        return String::new();
    };
    let (low, high) = f[row].to_f64();
    let side = if search.miss(row, Printing::Exact).sign() == Some(-1) { -1.0 } else { 1.0 };
    let at = |f: f64| target.value().to_f64() + side * libm::sqrt(f);
    let (from, to) = (at(low).min(at(high)), at(low).max(at(high)));
    format!("{from:.3}..{to:.3}")
}

fn one_h(
    lab: &Lab,
    searches: &[PrintedSearch],
    scrambled: &[Vec<PrintedSearch>],
    tried: &Differences,
) -> Table {
    let mut table = Table::new([
        "rule",
        "table",
        "intervals_of_h",
        "share_of_range",
        "least_h",
        "greatest_h",
        "round_h_left",
        "random_tables_that_leave_an_h",
    ]);
    let sides = [Side::Forward, Side::Backward, Side::Central];
    let rules: Vec<Rule> =
        sides.iter().flat_map(|s| [Rule::Difference(*s), Rule::ChainDifference(*s)]).collect();
    let left = |search: &PrintedSearch, rule: Rule| -> Vec<Span> {
        let found: Option<Examined> = examine(search, Hypothesis { rule, y: Printing::Exact }, tried);
        found.map_or(Vec::new(), |found| found.left)
    };
    // Both tables with one h, too; the rows of what chance leaves are made of pairs of random tables.
    let rows = lab.each(&rules, |rule| {
        let own: Vec<Vec<Span>> = searches.iter().map(|search| left(search, *rule)).collect();
        let chance: Vec<Vec<Vec<Span>>> =
            scrambled.iter().map(|all| all.iter().map(|other| left(other, *rule)).collect()).collect();
        let any = |all: &[Vec<Span>]| all.iter().filter(|l| !l.is_empty()).count() as f64 / all.len() as f64;
        let both: Vec<Vec<Span>> = chance[0].iter().zip(&chance[1]).map(|(a, b)| shared_by(a, b)).collect();
        vec![
            ("1", own[0].clone(), any(&chance[0])),
            ("2", own[1].clone(), any(&chance[1])),
            ("both", shared_by(&own[0], &own[1]), any(&both)),
        ]
    });
    let range = tried.h.1.value().to_f64() - tried.h.0.value().to_f64();
    for (rule, tables) in rules.iter().zip(rows) {
        for (name, spans, chance) in tables {
            let length = spans.iter().fold(0.0, |sum, span| sum + span.to_f64().1 - span.to_f64().0);
            let round: Vec<String> = ROUND
                .iter()
                .filter_map(|(a, b)| Ratio::new(*a, *b))
                .filter(|h| spans.iter().any(|span| span.holds(*h)))
                .map(|h| h.to_f64().to_string())
                .collect();
            table.row([
                rule.name().into(),
                name.into(),
                spans.len().into(),
                (length / range).into(),
                spans.first().map_or(String::new(), Span::to_string).into(),
                spans.last().map_or(String::new(), Span::to_string).into(),
                round.join(" ").into(),
                chance.into(),
            ]);
        }
    }
    table
}

fn parts(lab: &Lab, searches: &[PrintedSearch], jittered: &[Vec<PrintedSearch>]) -> Table {
    let mut table =
        Table::new(["t_sim", "k", "fits_table_1", "fits_table_2", "chance_in_table_1", "chance_in_table_2"]);
    let printings = [Printing::Ceiling, Printing::Rounded, Printing::Floor];
    let cases: Vec<(Printing, &PrintedSearch)> = printings
        .iter()
        .flat_map(|printing| searches.iter().chain(jittered.iter().flatten()).map(|s| (*printing, s)))
        .collect();
    let fits =
        lab.each(&cases, |(printing, search)| parts_that_fit(search, *printing, FINEST).unwrap_or_default());
    let count = searches.len() + jittered.iter().map(Vec::len).sum::<usize>();
    for (printing, fits) in printings.iter().zip(fits.chunks(count)) {
        let (own, chance) = fits.split_at(searches.len());
        let (chance_1, chance_2) = chance.split_at(jittered[0].len());
        for k in 1..=FINEST {
            let share = |all: &[Vec<u32>]| {
                all.iter().filter(|fits| fits.contains(&k)).count() as f64 / all.len() as f64
            };
            let yes = |fits: &Vec<u32>| if fits.contains(&k) { "yes" } else { "no" };
            table.row([
                t_sim(*printing).into(),
                k.into(),
                yes(&own[0]).into(),
                yes(&own[1]).into(),
                share(chance_1).into(),
                share(chance_2).into(),
            ]);
        }
    }
    table
}

/// What each rule predicts over what the step used: an interval that holds 1 survives.
fn plot(search: &PrintedSearch, number: usize, tried: &Differences) -> Plot {
    let shown = [
        ("secant, T whole", Rule::BackwardSecant, Printing::Exact),
        ("secant, T real, first whole frame", Rule::BackwardSecant, Printing::Ceiling),
        ("secant, T real, rounded", Rule::BackwardSecant, Printing::Rounded),
        ("secant, T real, cut off", Rule::BackwardSecant, Printing::Floor),
        ("chain rule, T real, first whole frame", Rule::ChainBackward, Printing::Ceiling),
        ("secant of the step itself, T real", Rule::ForwardSecant, Printing::Ceiling),
    ];
    let mut series = Vec::new();
    for (k, (name, rule, y)) in shown.into_iter().enumerate() {
        let mut bars = Series::new(name, Draw::Dots, []);
        let found = examine(search, Hypothesis { rule, y }, tried);
        let predicted = found.map_or(Vec::new(), |found| found.predicted);
        for (step, span) in predicted.iter().enumerate().skip(1) {
            let Some(span) = span else { continue };
            let (low, high) = span.over(search.slope(step)).to_f64();
            if low >= SHOWN.0 && high <= SHOWN.1 {
                bars.points.push((step as f64 + 0.1 * (k as f64 - 2.5), 0.5 * (low + high)));
                bars.errors.push(0.5 * (high - low));
            }
        }
        series.push(bars);
    }
    let steps = (0.5, search.steps() as f64 - 0.5);
    series.push(Series::new("used by the printed steps", Draw::Line, [(steps.0, 1.0), (steps.1, 1.0)]));
    Plot {
        title: format!("Table {number}: derivative predicted / used"),
        x: Axis::within("step", steps.0, steps.1),
        y: Axis::within("predicted df/dβ / used df/dβ", SHOWN.0, SHOWN.1),
        series,
        bands: Vec::new(),
    }
}

/// The ratios that a plot shows.
const SHOWN: (f64, f64) = (-0.6, 1.7);
