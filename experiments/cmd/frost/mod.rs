//! `snowglobe frost`: frost on a user's own sketch.

mod args;
mod files;
mod shaded;

use std::path::PathBuf;
use std::process::ExitCode;

use snowglobe::frost::{Aim, Aimed, EndFrameObjective, EndRule, Ending, Film, Search};
use snowglobe::hexgrid::Axial;
use snowglobe::lab::{Error, Progress, Result, print, set_threads};
use snowglobe::rng::Seed;
use snowglobe::sketch::Sketch;

pub use args::Args;

use super::own::OwnFolder;
use args::Request;

/// A film that was grown.
pub(super) struct Grown {
    sketch: Sketch,
    starts: Vec<Axial>,
    film: Film,
    counts: Vec<usize>,
    search: Option<Search>,
    seed: Seed,
    rule: EndRule,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    set_threads(args.threads)?;
    let folder = OwnFolder::claim(args.out.as_deref(), "frost")?;
    let request = Request::of(args)?;
    let photographs = args.shade.request()?;
    let (sketch, starts) = request.sketch()?;
    let mut parameters = request.parameters;
    let mut search = None;
    if let Some((target, aim)) = request.aim {
        let found = seek(&request, &sketch, &starts, target, &aim)?;
        parameters.beta = found.last().map_or(aim.start, |last| last.beta);
        search = Some(found);
    }
    let (seed, rule) = (request.seed, request.rule);
    let mut film =
        Film::new(&sketch.region, &starts, parameters, seed, rule, request.frame_limit).map_err(usage)?;
    let counts = grow(&mut film, args.frames);
    let grown = Grown { sketch, starts, film, counts, search, seed, rule };
    print(&outcome(&grown));
    let path = write(&grown, args, photographs.as_ref(), folder)?;
    print(&format!("written: {}\n", path.display()));
    match grown.search {
        Some(search) if !search.reached => {
            Err(Error::broken(format!("no initial value found; {}", search.why)).at("--target"))
        }
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// Writes all files, `summary.json` last.
fn write(
    grown: &Grown,
    args: &Args,
    photographs: Option<&shaded::Request>,
    folder: OwnFolder,
) -> Result<PathBuf> {
    let files = files::of(grown, args)?;
    let of_photographs = photographs.map_or_else(Vec::new, |request| request.names(grown));
    let names = files.iter().map(|(name, _)| name.clone()).chain(of_photographs).collect();
    let folder = folder.open("frost", names)?;
    let (summary, others) = files.split_last().expect("there is a summary");
    folder.write(others)?;
    if let Some(request) = photographs {
        request.write(grown, &folder)?;
    }
    folder.write([summary])?;
    folder.close()
}

/// What physics refuses is a user's input here.
fn usage(cause: impl std::error::Error) -> Error {
    Error::usage(cause.to_string())
}

/// Looks for the initial value whose film ends in the target frame, and prints each iterate.
fn seek(request: &Request, sketch: &Sketch, starts: &[Axial], target: f64, aim: &Aim) -> Result<Search> {
    let objective = EndFrameObjective {
        region: &sketch.region,
        starts,
        parameters: request.parameters,
        seed: request.seed,
        rule: request.rule,
        target,
        t_sim: request.t_sim,
        h: aim.h,
        frame_limit: request.frame_limit,
    };
    // A film that cannot be grown at all is refused before the search.
    objective.end_frame(aim.start).map_err(usage)?;
    let search = objective.aim(aim).map_err(|cause| Error::broken(cause.to_string()).at("--target"))?;
    for Aimed { rule, step, beta, end } in &search.iterates {
        let end = end.map_or_else(|| "never ends".to_owned(), |end| format!("ends in frame {}", end.frame));
        print(&format!("{:<10} {step:>2}  beta {beta:<20} {end}\n", rule.name()));
    }
    Ok(search)
}

/// Runs exactly `frames` frames, or until the film has its ending; returns the ice in each frame from 0.
fn grow(film: &mut Film, frames: Option<u64>) -> Vec<usize> {
    let bar = Progress::of("frost").over(frames.unwrap_or(0));
    let mut counts = vec![film.frost().ice()];
    while frames.map_or(film.ending().is_none(), |frames| film.frame() < frames) {
        film.advance();
        counts.push(film.frost().ice());
        bar.inc(1);
    }
    bar.finish_and_clear();
    counts
}

fn outcome(grown: &Grown) -> String {
    let film = &grown.film;
    let ice = format!(
        "{} of {} cells are ice in frame {}",
        film.frost().ice(),
        grown.sketch.region.len(),
        film.frame()
    );
    let end = match film.ending() {
        Some(Ending::Reached(end)) => {
            format!("the film ends in frame {} ({:.3} interpolated)", end.frame, end.interpolated)
        }
        Some(Ending::Unreachable) => "ice can never reach the share".to_owned(),
        Some(Ending::Limit) => {
            "ice has not reached the share by the last frame allowed (--frame-limit)".to_owned()
        }
        None => "the film has not ended yet".to_owned(),
    };
    format!("{ice}; {end}\n")
}
