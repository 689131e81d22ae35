//! Small multiples: plots of the same kind side by side in one drawing.

use plotters::prelude::*;
use plotters::style::FontStyle;

use super::draw::{Look, chart};
use super::legend::{ENTRY, Legend};
use super::{Plot, svg};
use crate::lab::error::Result;

/// Plots side by side, each with its own title; the legend is each plot's own, or one for all where they share it.
#[derive(Clone, Debug)]
pub struct Panels {
    /// What they show together.
    pub title: String,
    /// How many stand side by side.
    pub columns: usize,
    /// The plots, row by row.
    pub plots: Vec<Plot>,
}

const TITLE: u32 = 46;

impl Panels {
    /// The plots as SVG text.
    pub fn to_svg(&self) -> Result<String> {
        let columns = self.columns.max(1);
        let rows = self.plots.len().div_ceil(columns) as u32;
        let (look, width, height) = match columns {
            0..=2 => (Look::MEDIUM, 560, 350),
            _ => (Look::SMALL, 300, 236),
        };
        let legends: Vec<Legend> = self.plots.iter().map(|plot| Legend::of(&[plot])).collect();
        let shared = legends.windows(2).all(|pair| pair[0] == pair[1]);
        let broken = |legend: &Legend, width: u32| legend.rows(width as i32 - 30);
        let tallest =
            |width| legends.iter().map(|legend| broken(legend, width).len()).max().unwrap_or(0) as u32;
        let page_width = width * columns as u32;
        let (own, below) = if shared { (0, tallest(page_width)) } else { (tallest(width), 0) };
        let row_height = height + ENTRY * own;
        let size = (page_width, TITLE + row_height * rows + ENTRY * below + 6);
        svg(&self.title, size, |page| {
            let (head, body) = page.split_vertically(TITLE);
            let style = ("sans-serif", 22).into_font().style(FontStyle::Bold);
            head.draw(&Text::new(self.title.clone(), (16, 12), style))?;
            let (body, foot) = body.split_vertically(row_height * rows);
            for ((area, plot), legend) in
                body.split_evenly((rows as usize, columns)).iter().zip(&self.plots).zip(&legends)
            {
                let (top, bottom) = area.split_vertically(height);
                chart(&top, plot, &look)?;
                if !shared {
                    legend.draw(&bottom, &broken(legend, width), (24, 8))?;
                }
            }
            match legends.first() {
                Some(legend) if shared => legend.draw(&foot, &broken(legend, page_width), (24, 8)),
                _ => Ok(()),
            }
        })
    }
}
