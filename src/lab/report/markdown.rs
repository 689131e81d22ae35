//! The table of claims, for the README and for a terminal.

use super::{Shelf, expectation, short};
use crate::lab::record::Finding;

const BEGIN: &str = "<!-- claims: written by `snowglobe report` -->";
const END: &str = "<!-- end of claims -->";

/// The text with the table between its markers; none if there are no markers.
pub(super) fn splice(text: &str, table: &str) -> Option<String> {
    let begin = text.find(BEGIN)? + BEGIN.len();
    let end = begin + text[begin..].find(END)?;
    Some(format!("{}\n{table}{}", &text[..begin], &text[end..]))
}

/// A row for each claim, under the default reading where it was looked at.
pub(super) fn claims(shelves: &[Shelf]) -> String {
    let mut page = String::new();
    let mut paper = "";
    for shelf in shelves {
        if paper != shelf.paper.id {
            paper = shelf.paper.id;
            let title = if shelf.paper.title.is_empty() {
                String::new()
            } else {
                format!(" ({})", shelf.paper.title)
            };
            page += &format!("\n**{}: {}**{title}\n\n", shelf.paper.authors, shelf.paper.english);
            page += "| claim | what the paper says | expected | measured | verdict | other readings |\n";
            page += "|---|---|---:|---:|---|---|\n";
        }
        for claim in shelf.experiment.claims {
            let Some(lead) = shelf.lead(claim.id) else { continue };
            let id = claim.id.strip_prefix(paper).unwrap_or(claim.id).trim_start_matches('/');
            page += &format!(
                "| {id} | {} | {} | {} | {} | {} |\n",
                claim.says.replace('|', "\\|"),
                expected(lead),
                short(lead.measured),
                lead.verdict,
                others(shelf, lead),
            );
        }
    }
    page + "\n"
}

fn expected(finding: &Finding) -> String {
    expectation(finding).replace('|', "\\|")
}

/// How often a claim holds under the other readings.
fn others(shelf: &Shelf, lead: &Finding) -> String {
    let rows: Vec<_> =
        shelf.verdicts().into_iter().filter(|f| f.claim == lead.claim && f.reading != lead.reading).collect();
    if rows.is_empty() {
        return String::new();
    }
    let holds = rows.iter().filter(|f| f.verdict == "holds").count();
    format!("holds under {holds} of {}", rows.len())
}

/// The same for a terminal.
pub(super) fn terminal(shelves: &[Shelf]) -> String {
    let mut text = String::new();
    for shelf in shelves {
        for claim in shelf.experiment.claims {
            let Some(lead) = shelf.lead(claim.id) else { continue };
            let known = match (lead.verdict.as_str(), claim.known_under(&lead.reading)) {
                ("fails", Some(_)) => " (known)",
                _ => "",
            };
            text += &format!(
                "{:<44} expected {:<22} measured {:<12} {}{known}\n",
                claim.id,
                expectation(lead),
                short(lead.measured),
                lead.verdict,
            );
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_spliced_between_its_markers_again_and_again() {
        let readme = format!("before\n{BEGIN}\nold\n{END}\nafter\n");
        let once = splice(&readme, "new\n").unwrap();
        assert_eq!(once, format!("before\n{BEGIN}\nnew\n{END}\nafter\n"));
        assert_eq!(splice(&once, "new\n").unwrap(), once);
        assert_eq!(splice("no markers", "new"), None);
    }
}
