//! What each definition of the end leaves undone.

use snowglobe::frost::{Film, Frost, GROUND, Painter, titled};
use snowglobe::image::Picture;
use snowglobe::lab::{Lab, Result, Table, maybe};
use snowglobe::rng::Seed;

use super::super::setup::{START, Setup};
use super::super::table_2;
use super::claims::UNFINISHED;
use super::{Definition, ENDLESS};

const SEEDS: u64 = 20;

/// Shares of ice at the end of a film, of all cells and of the border's.
struct End {
    frame: Option<u64>,
    cells: f64,
    border: f64,
}

/// Measures and draws the last frames.
pub fn unfinished(lab: &mut Lab, setups: &[(Setup, f64, u64)], definitions: &[Definition]) -> Result<()> {
    let beta = lab.printed("beta", table_2::PRINTED[3].0, "Table 2, step 3");
    let mut table =
        Table::new(["threshold", "ends_with", "seed", "end_frame", "share_of_cells", "share_of_border"]);
    let mut stills = Vec::new();
    for (k, (setup, threshold, seeds)) in setups.iter().enumerate() {
        let seeds = lab.seeds(if *seeds == 1 { 1 } else { SEEDS });
        for definition in definitions {
            let ends = lab.each(&seeds, |seed| Ok(measure(&last_frame(setup, definition, beta, *seed)?)));
            let ends = ends.into_iter().collect::<Result<Vec<End>>>()?;
            for (seed, end) in seeds.iter().zip(&ends) {
                if definition.name == definitions[0].name {
                    lab.found_with(&UNFINISHED[k], *seed, end.border);
                }
                table.row([
                    threshold.into(),
                    definition.name.into(),
                    seed.into(),
                    maybe(end.frame),
                    end.cells.into(),
                    end.border.into(),
                ]);
            }
            let film = last_frame(setup, definition, beta, lab.seed().0)?;
            stills.push(still(film.frost(), film.frame(), *threshold, definition)?);
        }
    }
    lab.keep("ends", "The ice in the last frame, by threshold and definition of the end", table)?;
    lab.keep(
        "unfinished",
        "The last frame with 90 % of the cells, with 100 % of them, and with 90 % of the border (left to right) at \
         thresholds 0, 0.4 and 0.8 (top to bottom), from beta 0.315713: orange is not ice yet",
        Picture::grid(&stills.iter().collect::<Vec<_>>(), definitions.len(), 8, GROUND)?,
    )
}

fn last_frame(setup: &Setup, definition: &Definition, beta: f64, seed: u64) -> Result<Film> {
    let mut film = Film::new(&setup.region, &START, setup.at(beta), Seed(seed), definition.rule, ENDLESS)?;
    film.run();
    Ok(film)
}

fn measure(film: &Film) -> End {
    let frost = film.frost();
    let border = frost.region().border();
    let ice = border.iter().filter(|ordinal| frost.is_ice(**ordinal)).count();
    End {
        frame: film.ending().and_then(|ending| ending.reached()).map(|end| end.frame),
        cells: frost.ice() as f64 / frost.region().len() as f64,
        border: ice as f64 / border.len() as f64,
    }
}

fn still(
    frost: &Frost,
    frame: u64,
    threshold: f64,
    definition: &Definition,
) -> std::result::Result<Picture, snowglobe::image::ImageError> {
    let painter = Painter::new(frost.region(), 250, frame, frost.parameters().beta)?;
    titled(&painter.draw_unfinished(frost), &format!("r_th {threshold}, {}: {frame}", definition.name))
}
