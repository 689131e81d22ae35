//! `snowglobe forensics`

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use snowglobe::lab::{Error, Result, Table, maybe, print};
use snowglobe::optimize::forensics::{
    Decimal, Differences, Examined, Hypothesis, PrintedSearch, Printing, Verdict, examine,
};
use snowglobe::reading::Reading;
use snowglobe::rng::Seed;

use super::own::OwnFolder;

const EXAMPLES: &str = "Example: snowglobe forensics --iterates table.csv --target 130 --eta 1e-6\n\n\
    The table has the columns `x` and `y`, a row for each iterate of x - eta f'(x), with the digits as they are \
    printed: 0.250000 says more than 0.25. `refuted` is a proof by exact fractions; `survives` says that no printed \
    digit contradicts the rule, and the share of random tables beside it what that is worth.";

/// A printed search, and how it was printed.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// The iterates: a CSV with the columns `x` and `y`; others are ignored.
    #[arg(long, value_name = "F.csv")]
    iterates: PathBuf,
    /// The step length, exact.
    #[arg(long, allow_hyphen_values = true)]
    eta: String,
    /// The target of y, exact: f is (y - target)^2. Without it y is f.
    #[arg(long, allow_hyphen_values = true)]
    target: Option<String>,
    /// Places to which x was printed, where zeros at the end were left out.
    #[arg(long, value_name = "N", default_value_t = 0)]
    places: u32,
    /// How x was printed: rounded, floor (cut off), ceiling, exact.
    #[arg(long, value_name = "HOW", default_value = "rounded")]
    x_printed: String,
    /// The first x was printed as the others; by default somebody chose it, and it is exact.
    #[arg(long)]
    first_is_printed: bool,
    /// The least h of a difference.
    #[arg(long, value_name = "H", allow_hyphen_values = true, default_value = "1e-6")]
    h_least: String,
    /// The greatest h of a difference.
    #[arg(long, value_name = "H", allow_hyphen_values = true, default_value = "0.1")]
    h_most: String,
    /// The greatest y beside an iterate, in units of its last place; the least is 0, or minus this if a y is below 0.
    #[arg(long, value_name = "Y", allow_hyphen_values = true, default_value_t = 400)]
    y_most: i64,
    /// Tables with random steps that each rule is tried on, too.
    #[arg(long, value_name = "N", allow_hyphen_values = true, default_value_t = 100)]
    random: u64,
    /// The seed of the random steps.
    #[arg(long, allow_hyphen_values = true, default_value_t = 1)]
    seed: u64,
    /// Where to write the tables as CSV; nothing is written without it.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Rows that are examined without patience.
const MOST_ROWS: usize = 200;

pub fn run(args: &Args) -> Result<ExitCode> {
    let search = search(args)?;
    let tried = differences(args, &search)?;
    if args.random > 10_000 {
        return Err(Error::usage(format!("{} tables; up to 10000 are accepted", args.random)).at("--random"));
    }
    let folder = args.out.as_deref().map(|out| OwnFolder::claim(Some(out), "forensics")).transpose()?;
    let stream = Seed(args.seed).stream("random steps");
    let random: Vec<PrintedSearch> =
        (0..args.random).map(|draw| search.scrambled(1.0, &stream.at(draw))).collect();
    let examined: Vec<(Examined, Option<f64>)> = Hypothesis::all()
        .into_iter()
        .filter_map(|hypothesis| {
            let found = examine(&search, hypothesis, &tried)?;
            let survives = |other: &&PrintedSearch| {
                examine(other, hypothesis, &tried).is_some_and(|e| e.verdict == Verdict::Survives)
            };
            let worth = found.verdict != Verdict::Open && !random.is_empty();
            let share = worth.then(|| random.iter().filter(survives).count() as f64 / random.len() as f64);
            Some((found, share))
        })
        .collect();
    let (implied, hypotheses) = (implied(&search), hypotheses(&examined));
    print(&text(&implied, &hypotheses));
    if let Some(folder) = folder {
        let files = vec![
            ("implied.csv".to_owned(), implied.to_csv()?),
            ("hypotheses.csv".to_owned(), hypotheses.to_csv()?),
        ];
        print(&format!("{}\n", folder.fill("forensics", &files)?.display()));
    }
    Ok(ExitCode::SUCCESS)
}

fn search(args: &Args) -> Result<PrintedSearch> {
    let path = args.iterates.display();
    let bytes =
        fs::read(&args.iterates).map_err(|cause| Error::usage("cannot read").at(&path).because(cause))?;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    let table = Table::from_csv(bytes).map_err(|cause| Error::usage(cause.to_string()).at(&path))?;
    let column = |name: &str| {
        table.columns.iter().position(|column| column.trim() == name).ok_or_else(|| {
            Error::usage(format!("no column `{name}`; the columns `x` and `y` are needed")).at(&path)
        })
    };
    let (x, y) = (column("x")?, column("y")?);
    if table.rows.len() > MOST_ROWS {
        let rows = table.rows.len();
        return Err(Error::usage(format!("{rows} rows; up to {MOST_ROWS} are accepted")).at(&path));
    }
    let flag = |flag: &str, text: &str| {
        Decimal::parse(text).map(|_| ()).map_err(|cause| Error::usage(cause.to_string()).at(flag))
    };
    flag("--eta", &args.eta)?;
    args.target.as_deref().map_or(Ok(()), |target| flag("--target", target))?;
    let rows: Vec<(&str, &str)> = table.rows.iter().map(|row| (row[x].as_str(), row[y].as_str())).collect();
    let mut search = PrintedSearch::new(&rows, &args.eta, args.target.as_deref())
        .map_err(|cause| Error::usage(cause.to_string()).at(&path))?;
    if args.places > 12 {
        return Err(Error::usage(format!("{}; 0 to 12 are accepted", args.places)).at("--places"));
    }
    for row in &mut search.rows {
        row.0 = row.0.with_places(args.places);
    }
    search.x_printed = Printing::named(&args.x_printed).ok_or_else(|| {
        Error::usage(format!("`{}`; accepted: {}", args.x_printed, Printing::names())).at("--x-printed")
    })?;
    search.first_is_exact = !args.first_is_printed;
    Ok(search)
}

fn differences(args: &Args, search: &PrintedSearch) -> Result<Differences> {
    let h = |flag: &str, text: &str| {
        let h = Decimal::parse(text).map_err(|cause| Error::usage(cause.to_string()).at(flag))?;
        let above = h.span(Printing::Exact).sign() == Some(1);
        above.then_some(h).ok_or_else(|| Error::usage(format!("{text}; above 0 is accepted")).at(flag))
    };
    let (least, most) = (h("--h-least", &args.h_least)?, h("--h-most", &args.h_most)?);
    if least.value() > most.value() {
        return Err(
            Error::usage(format!("{} is above --h-most {}", args.h_least, args.h_most)).at("--h-least")
        );
    }
    if !(1..=1500).contains(&args.y_most) {
        return Err(Error::usage(format!("{}; 1 to 1500 is accepted", args.y_most)).at("--y-most"));
    }
    let negative = (0..search.rows.len()).any(|row| search.y(row, Printing::Exact).sign() == Some(-1));
    let y_most = i128::from(args.y_most);
    Ok(Differences { h: (least, most), y: (if negative { -y_most } else { 0 }, y_most) })
}

fn implied(search: &PrintedSearch) -> Table {
    let mut table = Table::new(["step", "from", "to", "slope_used"]);
    for step in 0..search.steps() {
        table.row([step.into(), search.x(step).into(), search.x(step + 1).into(), search.slope(step).into()]);
    }
    table
}

fn hypotheses(examined: &[(Examined, Option<f64>)]) -> Table {
    let mut table = Table::new(["rule", "y_printed", "verdict", "refuted_by", "random", "free", "left"]);
    for (found, share) in examined {
        table.row([
            found.hypothesis.rule.name().into(),
            found.hypothesis.y.name().into(),
            found.verdict.name().into(),
            found.refuted_by.iter().map(usize::to_string).collect::<Vec<_>>().join(" ").into(),
            maybe(*share),
            found.hypothesis.rule.free().join(" and ").into(),
            found.detail().into(),
        ]);
    }
    table
}

/// Both tables in columns; what is open is counted.
fn text(implied: &Table, hypotheses: &Table) -> String {
    let judged = hypotheses.only(|row| row[2] != Verdict::Open.name());
    let open = hypotheses.rows.len() - judged.rows.len();
    let mut text = columns(implied);
    text.push('\n');
    text += &columns(&judged);
    let _ =
        writeln!(text, "\n{open} more are open: they have a free number for every step, or too many to try");
    text
}

fn columns(table: &Table) -> String {
    let lines: Vec<&Vec<String>> = std::iter::once(&table.columns).chain(&table.rows).collect();
    let width = |k: usize| lines.iter().map(|line| line[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..table.columns.len()).map(width).collect();
    let mut text = String::new();
    for line in lines {
        let cells: Vec<String> =
            line.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        let _ = writeln!(text, "{}", cells.join("  ").trim_end());
    }
    text
}
