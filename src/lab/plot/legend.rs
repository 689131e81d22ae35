//! The legend beneath a plot.

use plotters::prelude::*;

use super::draw::{INK, LAST, colour, dark, is_dashed, places};
use super::{Area, Draw, Drawn, Plot};

/// Height of a row of the legend.
pub(super) const ENTRY: u32 = 26;

/// What a sign in the legend stands for.
#[derive(Clone, Copy, PartialEq)]
enum Sign {
    Series(usize, Draw),
    Band,
}

/// Names and signs, in their order.
#[derive(PartialEq)]
pub(super) struct Legend(Vec<(String, Sign)>);

impl Legend {
    /// The entries of plots: series first and then bands, each name once.
    pub(super) fn of(plots: &[&Plot]) -> Self {
        let mut entries: Vec<(String, Sign)> = Vec::new();
        let series = plots.iter().flat_map(|plot| places(&plot.series).into_iter().zip(&plot.series));
        let series = series.map(|(k, series)| (series.name.clone(), Sign::Series(k, series.draw)));
        let bands = plots.iter().flat_map(|plot| plot.bands.iter().map(|band| (band.0.clone(), Sign::Band)));
        let single = plots.len() == 1;
        for entry in series.chain(bands) {
            let hidden = entry.0.is_empty() && matches!(entry.1, Sign::Series(_, Draw::Ghost));
            if !hidden && (single || !entries.contains(&entry)) {
                entries.push(entry);
            }
        }
        Self(entries)
    }

    /// The entries broken into rows that are so many pixels wide.
    pub(super) fn rows(&self, width: i32) -> Vec<Vec<usize>> {
        let mut rows: Vec<Vec<usize>> = Vec::new();
        let mut room = 0;
        for entry in 0..self.0.len() {
            let needed = self.width(entry);
            match rows.last_mut() {
                Some(row) if needed <= room => row.push(entry),
                _ => {
                    rows.push(vec![entry]);
                    room = width;
                }
            }
            room -= needed;
        }
        rows
    }

    fn width(&self, entry: usize) -> i32 {
        56 + 10 * self.0[entry].0.chars().count() as i32
    }

    /// Draws rows of the legend from a corner on.
    pub(super) fn draw(&self, area: &Area, rows: &[Vec<usize>], corner: (i32, i32)) -> Drawn {
        for (row, entries) in rows.iter().enumerate() {
            let y = row as i32 * ENTRY as i32 + corner.1;
            let mut x = corner.0;
            for &entry in entries {
                let (name, sign) = &self.0[entry];
                draw_sign(area, *sign, (x, y))?;
                area.draw(&Text::new(name.clone(), (x + 31, y - 9), ("sans-serif", 18)))?;
                x += self.width(entry);
            }
        }
        Ok(())
    }
}

fn draw_sign(area: &Area, sign: Sign, (x, y): (i32, i32)) -> Drawn {
    let Sign::Series(k, draw) = sign else {
        area.draw(&Rectangle::new([(x, y - 6), (x + 24, y + 6)], INK.mix(0.10).filled()))?;
        return Ok(());
    };
    let colour = colour(k, draw);
    let line = [(x, y), (x + 24, y)];
    match draw {
        Draw::Dots | Draw::Path => {}
        Draw::Ghost => area.draw(&PathElement::new(line, colour.stroke_width(1)))?,
        Draw::Line | Draw::Joined | Draw::Step if is_dashed(k) => {
            for part in [(x, x + 9), (x + 14, x + 23)] {
                area.draw(&PathElement::new([(part.0, y), (part.1, y)], colour.stroke_width(2)))?;
            }
        }
        _ => area.draw(&PathElement::new(line, colour.stroke_width(2)))?,
    }
    match draw {
        Draw::Joined | Draw::Dots => area.draw(&Circle::new((x + 12, y), 4, colour.filled()))?,
        Draw::Printed => area.draw(&Circle::new((x + 12, y), 5, colour.stroke_width(2)))?,
        Draw::Path => {
            for (k, at) in [x + 3, x + 12, x + 21].into_iter().enumerate() {
                area.draw(&Circle::new((at, y), 4, dark(0.5 * k as f64).filled()))?;
            }
            area.draw(&Circle::new((x + 3, y), 8, INK.stroke_width(1)))?;
            area.draw(&Cross::new((x + 21, y), 7, LAST.stroke_width(3)))?;
        }
        Draw::Line | Draw::Step | Draw::Ghost => {}
    }
    Ok(())
}
