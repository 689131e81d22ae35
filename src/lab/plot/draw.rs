//! A chart in an area: axes, bands, series.

use plotters::element::ErrorBar;
use plotters::prelude::*;
use plotters::style::FontStyle;

use super::coord::Coord;
use super::{Area, Draw, Drawn, Plot, Series, number};
use crate::image::colour::CIVIDIS;

pub(super) const INK: RGBColor = RGBColor(0, 0, 0);
const FAINT: RGBColor = RGBColor(160, 160, 160);
/// Where a path ends.
pub(super) const LAST: RGBColor = RGBColor(213, 94, 0);

/// Okabe and Ito's palette, the dark ones first.
const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(110, 110, 110),
];

/// The colour of the k-th series of a plot.
pub(super) fn colour(k: usize, draw: Draw) -> RGBColor {
    match draw {
        Draw::Printed => INK,
        Draw::Ghost => FAINT,
        _ => PALETTE[k % PALETTE.len()],
    }
}

/// Whether the k-th series of a plot is the second of its colour, and dashed to be told apart.
pub(super) fn is_dashed(k: usize) -> bool {
    k >= PALETTE.len()
}

/// The dark of a path's dot, from the first (0) to the last (1).
pub(super) fn dark(part: f64) -> RGBColor {
    let [r, g, b] = CIVIDIS.at(0.92 * (1.0 - part));
    RGBColor(r, g, b)
}

/// Sizes of a chart, in pixels.
pub(super) struct Look {
    caption: u32,
    margin: u32,
    x_area: u32,
    y_area: u32,
    ticks: u32,
    label: u32,
    most: (usize, usize),
}

impl Look {
    /// A plot of its own.
    pub(super) const LARGE: Self =
        Self { caption: 22, margin: 14, x_area: 60, y_area: 76, ticks: 18, label: 19, most: (9, 8) };
    /// One of a few.
    pub(super) const MEDIUM: Self =
        Self { caption: 20, margin: 8, x_area: 54, y_area: 72, ticks: 18, label: 18, most: (9, 6) };
    /// One of many.
    pub(super) const SMALL: Self =
        Self { caption: 18, margin: 6, x_area: 52, y_area: 62, ticks: 17, label: 18, most: (4, 5) };
}

/// The place of each series in the palette: faint ones have none.
pub(super) fn places(series: &[Series]) -> Vec<usize> {
    let mut next = 0;
    series
        .iter()
        .map(|series| {
            let place = next;
            next += usize::from(series.draw != Draw::Ghost);
            place
        })
        .collect()
}

/// Draws a plot without its legend.
pub(super) fn chart(area: &Area, plot: &Plot, look: &Look) -> Drawn {
    let (x, y) = (plot.extent(&plot.x, |p| p.0), plot.extent(&plot.y, |p| p.1));
    let mut chart = ChartBuilder::on(area)
        .caption(&plot.title, ("sans-serif", look.caption).into_font().style(FontStyle::Bold))
        .margin(look.margin)
        .x_label_area_size(look.x_area)
        .y_label_area_size(look.y_area)
        .build_cartesian_2d(Coord::new(x, plot.x.log), Coord::new(y, plot.y.log))?;
    chart
        .configure_mesh()
        .x_desc(&plot.x.label)
        .y_desc(&plot.y.label)
        .label_style(("sans-serif", look.ticks))
        .axis_desc_style(("sans-serif", look.label))
        .bold_line_style(INK.mix(0.14))
        .light_line_style(INK.mix(0.0))
        .x_labels(look.most.0)
        .y_labels(look.most.1)
        .x_label_formatter(&|v| number(*v))
        .y_label_formatter(&|v| number(*v))
        .draw()?;
    for (_, from, to) in &plot.bands {
        let (from, to) = (from.max(y.0), to.min(y.1));
        chart.draw_series([Rectangle::new([(x.0, from), (x.1, to)], INK.mix(0.10).filled())])?;
    }
    for (k, series) in places(&plot.series).into_iter().zip(&plot.series) {
        let colour = colour(k, series.draw);
        let shown = |p: &(f64, f64)| {
            p.0.is_finite() && p.1.is_finite() && (p.0 > 0.0 || !plot.x.log) && (p.1 > 0.0 || !plot.y.log)
        };
        // What lies beyond an axis of ratios is drawn at its end.
        let inside = |p: (f64, f64)| (p.0, if plot.y.log { p.1.max(y.0) } else { p.1 });
        let points: Vec<(f64, f64)> = series.points.iter().copied().filter(shown).map(inside).collect();
        match series.draw {
            Draw::Line | Draw::Joined if is_dashed(k) => {
                chart.draw_series(dashed(&points, colour.stroke_width(2)))?;
            }
            Draw::Step if is_dashed(k) => {
                chart.draw_series(dashed(&stairs(&points, x.1), colour.stroke_width(2)))?;
            }
            Draw::Line | Draw::Joined => {
                chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?;
            }
            Draw::Step => {
                chart.draw_series(LineSeries::new(stairs(&points, x.1), colour.stroke_width(2)))?;
            }
            Draw::Ghost => {
                chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(1)))?;
            }
            Draw::Printed => {
                chart.draw_series(DashedLineSeries::new(
                    points.iter().copied(),
                    5,
                    4,
                    colour.stroke_width(1),
                ))?;
            }
            Draw::Dots | Draw::Path => {}
        }
        for (point, error) in series.points.iter().zip(&series.errors).filter(|(p, _)| shown(p)) {
            let (low, high) = (point.1 - error, point.1 + error);
            chart.draw_series([ErrorBar::new_vertical(
                point.0,
                low,
                point.1,
                high,
                colour.stroke_width(1),
                7,
            )])?;
        }
        match series.draw {
            Draw::Joined | Draw::Dots => {
                let dot = if points.len() > 60 { 2 } else { 4 };
                chart.draw_series(points.iter().map(|p| Circle::new(*p, dot, colour.filled())))?;
            }
            Draw::Printed => {
                chart.draw_series(points.iter().map(|p| Circle::new(*p, 5, colour.stroke_width(2))))?;
            }
            Draw::Path => {
                let last = points.len().max(2) as f64 - 1.0;
                let dots = points.iter().enumerate();
                chart.draw_series(dots.map(|(k, p)| Circle::new(*p, 4, dark(k as f64 / last).filled())))?;
                // A rim, so that the dark ones are seen on a dark page.
                chart.draw_series(points.iter().map(|p| Circle::new(*p, 4, INK.mix(0.5).stroke_width(1))))?;
                chart.draw_series(points.first().map(|p| Circle::new(*p, 8, INK.stroke_width(1))))?;
                chart.draw_series(points.last().map(|p| Cross::new(*p, 7, LAST.stroke_width(3))))?;
            }
            Draw::Line | Draw::Step | Draw::Ghost => {}
        }
    }
    Ok(())
}

fn dashed(points: &[(f64, f64)], style: ShapeStyle) -> DashedLineSeries<std::vec::IntoIter<(f64, f64)>, i32> {
    DashedLineSeries::new(points.to_vec(), 9, 4, style)
}

/// The corners of a line that runs level from each point to the next and then jumps, up to the right edge.
fn stairs(points: &[(f64, f64)], edge: f64) -> Vec<(f64, f64)> {
    let mut corners = Vec::with_capacity(2 * points.len() + 1);
    for (k, point) in points.iter().enumerate() {
        let level = if k == 0 { 0.0 } else { points[k - 1].1 };
        corners.extend([(point.0, level), *point]);
    }
    corners.extend(points.last().map(|last| (edge.max(last.0), last.1)));
    corners
}
