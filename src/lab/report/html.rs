//! The report as one HTML page that opens from the file system.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{Shelf, expectation, short};
use crate::lab::claim::Claim;
use crate::lab::record::{Finding, Given, Kept};
use crate::lab::suite::{Paper, Suite};
use crate::lab::table::Table;

const STYLE: &str = include_str!("style.css");
const SORT: &str = include_str!("sort.js");
/// Longer tables are folded away, and still longer ones linked.
const OPEN_ROWS: usize = 24;
const MOST_ROWS: usize = 60;

/// The whole page.
pub(super) fn page(suite: &Suite, shelves: &[Shelf]) -> String {
    let of = |paper: &Paper| shelves.iter().filter(|s| s.paper.id == paper.id).collect::<Vec<_>>();
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Snowglobe: the papers, re-run" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { "Snowglobe" }
                    p { "Papers on snow, frost, clouds and trees in the wind, re-run. Every number on this page was \
                         measured by a program and judged against what the paper says." }
                    (legend())
                    nav aria-label="Experiments" {
                        @for paper in suite.papers {
                            p { a href={ "#" (paper.id) } { strong { (paper.authors) } } }
                            ul { @for shelf in of(paper) { li { (contents_line(shelf)) } } }
                        }
                    }
                }
                main { @for paper in suite.papers { (paper_section(paper, &of(paper))) } }
                footer { p { "Made by " code { "snowglobe report" } " from the files beside this page." } }
                script { (PreEscaped(SORT)) }
            }
        }
    };
    markup.into_string()
}

fn legend() -> Markup {
    html! {
        p.legend {
            (badge("holds")) " the measured number is what the claim expects. "
            (badge("fails")) " it is not, which is a result, too. "
            (badge("undecided")) " its 95 % interval straddles the bound."
        }
    }
}

fn badge(verdict: &str) -> Markup {
    let sign = match verdict {
        "holds" => "✓",
        "fails" => "✗",
        _ => "?",
    };
    html! { span class={ "verdict " (verdict) } { (sign) " " (verdict) } }
}

fn contents_line(shelf: &Shelf) -> Markup {
    let leads: Vec<&Finding> = shelf.experiment.claims.iter().filter_map(|c| shelf.lead(c.id)).collect();
    let holds = leads.iter().filter(|f| f.verdict == "holds").count();
    html! {
        a href={ "#" (anchor(shelf)) } { (shelf.experiment.title) }
        " (" (shelf.experiment.source) "): " (holds) " of " (leads.len()) " claims hold"
    }
}

fn anchor(shelf: &Shelf) -> String {
    format!("{}-{}", shelf.paper.id, shelf.experiment.id)
}

fn paper_section(paper: &Paper, shelves: &[&Shelf]) -> Markup {
    html! {
        section id=(paper.id) {
            h2 { (paper.authors) ": " (paper.english) }
            @if !paper.title.is_empty() { p.original lang="ja" { (paper.title) } }
            p { (paper.about) }
            @if !paper.readings.is_empty() {
                details {
                    summary { "How its equations are read" }
                    div.wide { table {
                        thead { tr { th { "quantity" } th { "what is in dispute" } th { "readings" } } }
                        tbody { @for kind in paper.readings { tr {
                            th scope="row" { (kind.quantity) }
                            td { (kind.says) }
                            td { @for variant in (kind.variants)() {
                                code { (variant) } @if variant == kind.default { " (default)" } " "
                            } }
                        } } }
                    } }
                }
            }
            @for shelf in shelves { (experiment_section(shelf)) }
        }
    }
}

fn experiment_section(shelf: &Shelf) -> Markup {
    let experiment = shelf.experiment;
    html! {
        section.experiment id=(anchor(shelf)) {
            h3 { (experiment.title) }
            p { strong { (experiment.source) } ". " (experiment.says) }
            (claims_table(shelf))
            (pictures(shelf))
            @for kept in tables(shelf) { (table_figure(shelf, kept)) }
            (other_readings(shelf))
            (given("What had to be assumed", "why", &shelf.run.assumptions, true))
            (given("What the paper prints", "where", &shelf.run.printed, false))
            (how_to_repeat(shelf))
        }
    }
}

fn claims_table(shelf: &Shelf) -> Markup {
    html! {
        div.wide { table {
            caption { "What the paper says, and what was measured" }
            thead { tr {
                th { "claim" } th { "says" } th.n { "expected" } th.n { "measured" } th { "verdict" }
            } }
            tbody { @for claim in shelf.experiment.claims {
                @if let Some(lead) = shelf.lead(claim.id) { (claim_row(shelf, claim, lead)) }
            } }
        } }
    }
}

fn claim_row(shelf: &Shelf, claim: &Claim, lead: &Finding) -> Markup {
    let name = claim.id.rsplit('/').next().unwrap_or(claim.id);
    html! {
        tr id=(claim.id.replace('/', "-")) {
            th scope="row" { (name) br; small { (claim.source) } }
            td {
                (claim.says)
                details {
                    summary { "why, and how to repeat it" }
                    p { (claim.reason) " Statistic: " (claim.statistic.to_string()) "." }
                    p { "Reading: " code { (lead.reading) } @if !shelf.is_default(lead) { " (not the default)" } }
                    @if let Some(evidence) = claim.known_under(&lead.reading) {
                        p { "Known to fail: " (evidence) }
                    }
                    @if let Some(command) = command(shelf, lead) { p { code.command { (command) } } }
                }
            }
            td.n { (expectation(lead)) }
            td.n { (short(lead.measured)) }
            td { (badge(&lead.verdict)) }
        }
    }
}

/// The command that reproduces a row: its own, or that of its first seed.
fn command(shelf: &Shelf, lead: &Finding) -> Option<String> {
    let of_claim = |f: &&Finding| f.claim == lead.claim && f.reading == lead.reading && !f.command.is_empty();
    shelf.findings.iter().find(of_claim).map(|f| f.command.clone())
}

fn pictures(shelf: &Shelf) -> Markup {
    // Of a film in frames the first stands for all.
    let later_frame = |file: &str| file.contains("/frame-") && !file.ends_with("/frame-00000.png");
    let shown = |kept: &&Kept| {
        (kept.file.ends_with(".png") || kept.file.ends_with(".svg")) && !later_frame(&kept.file)
    };
    // Drawings and stills first, then plots, then what moves.
    let rank =
        |kept: &Kept| (kept.file.starts_with("large/"), kept.file.ends_with(".svg") && kept.vitals.is_none());
    let mut pictures: Vec<&Kept> = shelf.run.artifacts.iter().filter(shown).collect();
    pictures.sort_by_key(|kept| rank(kept));
    html! {
        div.pictures { @for kept in pictures {
            @let path = format!("{}/{}/{}", shelf.paper.id, shelf.experiment.id, kept.file);
            figure.broad[is_broad(shelf, &kept.file)] {
                @if shelf.has(&kept.file) {
                    a href=(path) { img src=(path) alt=(kept.caption) loading="lazy"; }
                } @else {
                    p.missing { "Not on disk: " code { (kept.file) } " is made by a run." }
                }
                figcaption { (kept.caption) }
            }
        } }
    }
}

/// Whether a drawing is too wide to stand beside another.
fn is_broad(shelf: &Shelf, file: &str) -> bool {
    let text = std::fs::read_to_string(shelf.folder.join(file)).unwrap_or_default();
    let width = text.split_once("<svg width=\"").and_then(|(_, rest)| rest.split_once('"'));
    width.is_some_and(|(width, _)| width.parse().is_ok_and(|width: u32| width > 800))
}

fn tables(shelf: &Shelf) -> impl Iterator<Item = &Kept> {
    shelf.run.artifacts.iter().filter(|kept| kept.file.ends_with(".csv"))
}

fn table_figure(shelf: &Shelf, kept: &Kept) -> Markup {
    let path = format!("{}/{}/{}", shelf.paper.id, shelf.experiment.id, kept.file);
    let table = shelf.table(&kept.file).filter(|t| t.rows.len() <= MOST_ROWS && kept.file != "findings.csv");
    html! {
        @match table {
            Some(table) if table.rows.len() <= OPEN_ROWS => {
                div.wide { (data_table(&table, &kept.caption, &path, &kept.file)) }
            }
            Some(table) => details {
                summary { (kept.caption) " (" (table.rows.len()) " rows)" }
                div.wide { (data_table(&table, &kept.caption, &path, &kept.file)) }
            },
            None => p { a href=(path) { (kept.file) } ": " (kept.caption) },
        }
    }
}

fn data_table(table: &Table, caption: &str, path: &str, file: &str) -> Markup {
    let cell = |text: &str| match text.parse::<f64>() {
        Ok(value) => (true, short(Some(value))),
        Err(_) => (false, text.to_owned()),
    };
    html! {
        table.data {
            caption { (caption) " (" a href=(path) { (file) } ")" }
            thead { tr { @for column in &table.columns { th { (column) } } } }
            tbody { @for row in &table.rows { tr { @for whole in row {
                @let (numeric, text) = cell(whole);
                @if numeric { td.n data-v=(whole) { (text) } } @else { td { (text) } }
            } } } }
        }
    }
}

fn other_readings(shelf: &Shelf) -> Markup {
    let rows: Vec<&Finding> = shelf.verdicts().into_iter().filter(|f| !shelf.is_default(f)).collect();
    html! {
        @if !rows.is_empty() {
            details {
                summary { "Under the other readings (" (rows.len()) " findings)" }
                div.wide { table {
                    thead { tr { th { "claim" } th { "reading" } th.n { "expected" } th.n { "measured" } th { "verdict" } } }
                    tbody { @for f in rows { tr {
                        th scope="row" { (f.claim.rsplit('/').next().unwrap_or(&f.claim)) }
                        td { code { (f.reading.replace(';', "; ")) } }
                        td.n { (expectation(f)) }
                        td.n { (short(f.measured)) }
                        td { (badge(&f.verdict)) }
                    } } }
                } }
            }
        }
    }
}

fn given(title: &str, why: &str, list: &[Given], open: bool) -> Markup {
    html! {
        @if !list.is_empty() {
            details open[open] {
                summary { (title) }
                div.wide { table {
                    thead { tr { th { "name" } th { "value" } th { (why) } } }
                    tbody { @for given in list { tr {
                        th scope="row" { (given.name) } td { (given.value) } td { (given.why) }
                    } } }
                } }
            }
        }
    }
}

fn how_to_repeat(shelf: &Shelf) -> Markup {
    let folder = format!("{}/{}", shelf.paper.id, shelf.experiment.id);
    html! {
        p.repeat {
            "Seed " (shelf.run.seed) ", scale " (shelf.run.scale) ". To run it again: "
            code.command { "cargo run --release -- run " (folder) " --out again" }
            @if !shelf.run.work.is_empty() {
                " Work: " @for (what, amount) in &shelf.run.work { (amount) " " (what) ". " }
            }
            " Files: " a href={ (folder) "/findings.csv" } { "findings" } ", " a href={ (folder) "/run.toml" } { "record" } "."
        }
    }
}
