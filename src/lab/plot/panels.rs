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
        let (look, width, height) = match columns {
            0..=2 => (Look::MEDIUM, 560, 350),
            _ => (Look::SMALL, 300, 240),
        };
        let plots = self.labelled_outside(columns);
        let legends: Vec<Legend> = plots.iter().map(|plot| Legend::of(&[plot])).collect();
        let shared = legends.windows(2).all(|pair| pair[0] == pair[1]);
        let broken = |legend: &Legend, width: u32| legend.rows(width as i32 - 30);
        let tallest = |legends: &[Legend], width| {
            ENTRY * legends.iter().map(|legend| broken(legend, width).len()).max().unwrap_or(0) as u32
        };
        let page_width = width * columns as u32;
        let own = |legends: &[Legend]| if shared { 0 } else { tallest(legends, width) };
        let below = if shared { tallest(&legends, page_width) } else { 0 };
        let heights: Vec<u32> = legends.chunks(columns).map(|row| height + own(row)).collect();
        let size = (page_width, TITLE + heights.iter().sum::<u32>() + below + 6);
        svg(&self.title, size, |page| {
            let (head, mut rest) = page.split_vertically(TITLE);
            let style = ("sans-serif", 22).into_font().style(FontStyle::Bold);
            head.draw(&Text::new(self.title.clone(), (16, 12), style))?;
            for ((plots, legends), row_height) in
                plots.chunks(columns).zip(legends.chunks(columns)).zip(&heights)
            {
                let (row, after) = rest.split_vertically(*row_height);
                rest = after;
                for ((area, plot), legend) in row.split_evenly((1, columns)).iter().zip(plots).zip(legends) {
                    let (top, bottom) = area.split_vertically(height);
                    chart(&top, plot, &look)?;
                    if !shared {
                        legend.draw(&bottom, &broken(legend, width), (24, 8))?;
                    }
                }
            }
            match legends.first() {
                Some(legend) if shared => legend.draw(&rest, &broken(legend, page_width), (24, 8)),
                _ => Ok(()),
            }
        })
    }

    /// The plots, with an axis' label at the left and at the foot only, where all have the same.
    fn labelled_outside(&self, columns: usize) -> Vec<Plot> {
        let same = |of: fn(&Plot) -> &str| self.plots.windows(2).all(|pair| of(&pair[0]) == of(&pair[1]));
        let (same_x, same_y) = (same(|plot| &plot.x.label), same(|plot| &plot.y.label));
        let mut plots = self.plots.clone();
        let count = plots.len();
        for (k, plot) in plots.iter_mut().enumerate() {
            if same_x && k + columns < count {
                plot.x.label.clear();
            }
            if same_y && k % columns != 0 {
                plot.y.label.clear();
            }
        }
        plots
    }
}
