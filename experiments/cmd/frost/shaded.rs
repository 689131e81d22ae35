//! The film as photographs: `--shaded`.

use rayon::prelude::*;
use snowglobe::frost::Film;
use snowglobe::frost::pane::{CURVE, EXPOSURE, Pane, Thickness};
use snowglobe::image;
use snowglobe::lab::{Error, Progress, Result};
use snowglobe::sketch::Chart;

use super::Grown;
use crate::cmd::own::OpenFolder;

/// The last frame.
const STILL: &str = "shaded.png";

/// What is asked of the photographs.
#[derive(clap::Args)]
pub struct Shade {
    /// Photographs the film as well: milky ice on a window at night, `shaded/frame-00000.png` and so on, and the last
    /// frame as `shaded.png`. Beyond the page. At 1920x1080 a frame takes about two seconds of one processor and 3 MB
    /// of disk; frames are made side by side.
    #[arg(long)]
    shaded: bool,
    /// Size of the photographs in pixels.
    #[arg(long, value_name = "WxH", default_value = "1920x1080", requires = "shaded")]
    size: String,
    /// The sketch fills the photographs, cut off where its shape is another; by default all of it is in them.
    #[arg(long, requires = "shaded")]
    fill: bool,
}

/// Photographs that make sense.
pub(super) struct Request {
    width: u32,
    height: u32,
    fill: bool,
}

impl Shade {
    /// What to make, if anything.
    pub(super) fn request(&self) -> Result<Option<Request>> {
        if !self.shaded {
            return Ok(None);
        }
        let side = |text: &str| text.parse::<u32>().ok().filter(|side| (64..=8192).contains(side));
        let sides = self.size.split_once('x').and_then(|(w, h)| Some((side(w)?, side(h)?)));
        let (width, height) = sides.ok_or_else(|| {
            Error::usage(format!("`{}`; WxH, each from 64 to 8192, is accepted", self.size)).at("--size")
        })?;
        Ok(Some(Request { width, height, fill: self.fill }))
    }
}

impl Request {
    /// The files that [`write`](Self::write) writes.
    pub(super) fn names(&self, grown: &Grown) -> Vec<String> {
        let frames = (0..=grown.film.frame()).map(|frame| format!("shaded/frame-{frame:05}.png"));
        frames.chain([STILL.to_owned()]).collect()
    }

    /// Grows the film again, which gives the same, and photographs each frame. A few frames are in memory at a time.
    pub(super) fn write(&self, grown: &Grown, folder: &OpenFolder) -> Result<()> {
        let (sketch, last) = (&grown.sketch, grown.film.frame());
        let chart = match self.fill {
            true => Chart::filled(sketch, self.width, self.height)?,
            false => Chart::fitted(sketch, self.width, self.height, self.width.min(self.height) / 20)?,
        };
        let pane = Pane::new(chart, grown.film.frost(), grown.seed);
        let parameters = *grown.film.frost().parameters();
        let mut film = Film::new(&sketch.region, &grown.starts, parameters, grown.seed, grown.rule, last)
            .map_err(super::usage)?;
        let bar = Progress::of("photographs").over(last + 1);
        let at_once = rayon::current_num_threads() as u64;
        let mut first = 0;
        while first <= last {
            let frames: Vec<(u64, Thickness)> = (first..=last.min(first + at_once - 1))
                .map(|frame| {
                    if frame > 0 {
                        film.advance();
                    }
                    (frame, Thickness::of(film.frost()))
                })
                .collect();
            let developed = |(frame, thickness): &(u64, Thickness)| -> Result<(String, Vec<u8>)> {
                let picture = pane.photograph(thickness)?.develop(EXPOSURE, CURVE);
                bar.inc(1);
                Ok((format!("shaded/frame-{frame:05}.png"), image::encode(&picture)))
            };
            let mut files = frames.par_iter().map(developed).collect::<Result<Vec<_>>>()?;
            first += files.len() as u64;
            folder.write(&files)?;
            if first > last {
                let still = files.pop().map(|(_, bytes)| (STILL.to_owned(), bytes));
                folder.write(&still)?;
            }
        }
        bar.finish_and_clear();
        Ok(())
    }
}
