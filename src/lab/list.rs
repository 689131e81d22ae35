//! What there is: papers, experiments, claims, readings, assumptions.

use std::path::Path;

use serde_json::{Value, json};

use super::claim::Claim;
use super::record::{Given, read_record};
use super::suite::{Paper, Suite};

impl Suite {
    /// Everything as JSON; assumptions are read from the results on disk.
    pub fn to_json(&self, results: &Path) -> Value {
        json!({ "papers": self.papers.iter().map(|paper| paper_json(paper, results)).collect::<Vec<_>>() })
    }

    /// Everything as text for people.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for paper in self.papers {
            text += &format!("{}  {}  {}\n", paper.id, paper.authors, paper.title);
            for kind in paper.readings {
                let variants: Vec<String> = (kind.variants)()
                    .into_iter()
                    .map(|v| if v == kind.default { format!("{v} (default)") } else { v.to_owned() })
                    .collect();
                text += &format!("  reading {}: {}\n", kind.quantity, variants.join(", "));
            }
            for experiment in paper.experiments {
                text += &format!(
                    "  {}/{}  {} [{}]\n",
                    paper.id, experiment.id, experiment.title, experiment.source
                );
                for claim in experiment.claims {
                    text += &format!(
                        "    {}: {} (expected {}{})\n",
                        claim.id,
                        claim.says,
                        claim.expect,
                        within(claim)
                    );
                }
            }
        }
        text
    }
}

fn within(claim: &Claim) -> String {
    match claim.expect.tolerance() {
        Some(tolerance) if tolerance > 0.0 && tolerance < 1e-6 => format!(" +-{tolerance:e}"),
        Some(tolerance) => format!(" +-{tolerance}"),
        None => String::new(),
    }
}

fn paper_json(paper: &Paper, results: &Path) -> Value {
    let experiments: Vec<Value> = paper
        .experiments
        .iter()
        .map(|experiment| {
            let folder = results.join(paper.id).join(experiment.id);
            let given: Vec<Given> = read_record(&folder).map(|run| run.assumptions).unwrap_or_default();
            json!({
                "id": format!("{}/{}", paper.id, experiment.id),
                "title": experiment.title,
                "source": experiment.source,
                "says": experiment.says,
                "claims": experiment.claims.iter().map(|claim| claim_json(claim)).collect::<Vec<_>>(),
                "assumptions": given,
                "mutant": {
                    "changes": experiment.mutant.changes, "to": experiment.mutant.to, "why": experiment.mutant.why,
                    "turns_red": experiment.mutant.turns_red,
                },
            })
        })
        .collect();
    let mut assumptions: Vec<Given> = Vec::new();
    for experiment in paper.experiments {
        let folder = results.join(paper.id).join(experiment.id);
        for given in read_record(&folder).map(|run| run.assumptions).unwrap_or_default() {
            if !assumptions.contains(&given) {
                assumptions.push(given);
            }
        }
    }
    let readings: Vec<Value> = paper
        .readings
        .iter()
        .map(|kind| {
            json!({
                "enum": kind.quantity, "says": kind.says, "variants": (kind.variants)(), "default": kind.default,
            })
        })
        .collect();
    json!({
        "id": paper.id, "title": paper.title, "authors": paper.authors, "about": paper.about,
        "experiments": experiments, "readings": readings, "assumptions": assumptions,
    })
}

fn claim_json(claim: &Claim) -> Value {
    let known: Vec<Value> = claim
        .known
        .iter()
        .map(|known| json!({ "reading": known.reading, "evidence": known.evidence }))
        .collect();
    json!({
        "id": claim.id,
        "source": claim.source,
        "says": claim.says,
        "expected": claim.expect.to_string(),
        "statistic": claim.statistic.to_string(),
        "tolerance": claim.expect.tolerance(),
        "reason": claim.reason,
        "known": if known.is_empty() { Value::Null } else { Value::Array(known) },
    })
}
