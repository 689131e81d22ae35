//! Plots as SVG: units on the axes, a legend beneath, colours that colour-blind readers can tell apart, and readable
//! on a light page and on a dark one.

use plotters::coord::Shift;
use plotters::element::ErrorBar;
use plotters::prelude::*;
use plotters::style::FontStyle;

use super::error::{Error, Result};

/// A plot of one or more series.
#[derive(Clone, Debug)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The series, in the order of the legend.
    pub series: Vec<Series>,
    /// Horizontal bands: name, from, to. A paper's tolerance, say.
    pub bands: Vec<(String, f64, f64)>,
}

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// The quantity and its unit.
    pub label: String,
    /// From and to; from the data where it is not given.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// An axis that fits the data.
    pub fn of(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: None }
    }

    /// An axis from one number to another.
    pub fn within(label: impl Into<String>, from: f64, to: f64) -> Self {
        Self { label: label.into(), range: Some((from, to)) }
    }
}

/// A series of points.
#[derive(Clone, Debug)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// The points, in order.
    pub points: Vec<(f64, f64)>,
    /// Half the height of each point's error bar; empty for none.
    pub errors: Vec<f64>,
    /// How it is drawn.
    pub draw: Draw,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Draw {
    /// A line.
    Line,
    /// Dots.
    Dots,
    /// Dots joined by a line.
    Joined,
    /// Open circles joined by a dashed line: what a paper prints.
    Printed,
}

impl Series {
    /// A series without error bars.
    pub fn new(name: impl Into<String>, draw: Draw, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), errors: Vec::new(), draw }
    }
}

const WIDTH: u32 = 760;
const HEIGHT: u32 = 460;
const ENTRY: u32 = 26;
const INK: RGBColor = RGBColor(0, 0, 0);

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

/// Light on dark where the reader's page is dark.
pub(super) const STYLE: &str = "<style>text{font-family:system-ui,sans-serif}@media(prefers-color-scheme:dark){\
[fill=\"#FFFFFF\"]{fill:#14181d}[fill=\"#000000\"]{fill:#e6e9ed}[stroke=\"#000000\"]{stroke:#e6e9ed}\
[fill=\"#0072B2\"]{fill:#5ab0ee}[stroke=\"#0072B2\"]{stroke:#5ab0ee}\
[fill=\"#D55E00\"]{fill:#f08a3c}[stroke=\"#D55E00\"]{stroke:#f08a3c}}</style>";

impl Plot {
    /// The plot as SVG text.
    pub fn to_svg(&self) -> Result<String> {
        let rows = self.legend_rows();
        let height = HEIGHT + ENTRY * rows.len() as u32;
        let mut svg = String::new();
        {
            let page = SVGBackend::with_string(&mut svg, (WIDTH, height)).into_drawing_area();
            self.draw(&page, &rows).map_err(|cause| {
                Error::broken("cannot draw a plot").at(&self.title).because(cause.to_string())
            })?;
        }
        let title = escaped(&self.title);
        let body = svg.find('>').map_or(0, |end| end + 1);
        Ok(format!("{}\n<title>{title}</title>{STYLE}{}\n", &svg[..body], svg[body..].trim_end()))
    }

    fn draw(
        &self,
        page: &DrawingArea<SVGBackend, Shift>,
        rows: &[Vec<usize>],
    ) -> std::result::Result<(), Box<dyn std::error::Error>> {
        page.fill(&WHITE)?;
        let (chart_area, legend) = page.split_vertically(HEIGHT);
        let (x, y) = (self.extent(&self.x, |p| p.0), self.extent(&self.y, |p| p.1));
        let mut chart = ChartBuilder::on(&chart_area)
            .caption(&self.title, ("sans-serif", 22).into_font().style(FontStyle::Bold))
            .margin(14)
            .x_label_area_size(60)
            .y_label_area_size(76)
            .build_cartesian_2d(x.0..x.1, y.0..y.1)?;
        chart
            .configure_mesh()
            .x_desc(&self.x.label)
            .y_desc(&self.y.label)
            .label_style(("sans-serif", 18))
            .axis_desc_style(("sans-serif", 19))
            .bold_line_style(INK.mix(0.14))
            .light_line_style(INK.mix(0.0))
            .x_labels(9)
            .y_labels(8)
            .x_label_formatter(&|v| number(*v))
            .y_label_formatter(&|v| number(*v))
            .draw()?;
        for (_, from, to) in &self.bands {
            let (from, to) = (from.max(y.0), to.min(y.1));
            chart.draw_series([Rectangle::new([(x.0, from), (x.1, to)], INK.mix(0.10).filled())])?;
        }
        for (k, series) in self.series.iter().enumerate() {
            let colour = colour(k, series);
            let inside = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
            let points: Vec<(f64, f64)> = series.points.iter().copied().filter(inside).collect();
            match series.draw {
                Draw::Line | Draw::Joined => {
                    chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?;
                }
                Draw::Printed => {
                    chart.draw_series(DashedLineSeries::new(
                        points.iter().copied(),
                        5,
                        4,
                        colour.stroke_width(1),
                    ))?;
                }
                Draw::Dots => {}
            }
            for (point, error) in series.points.iter().zip(&series.errors).filter(|(p, _)| inside(p)) {
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
                Draw::Line => {}
            }
        }
        self.draw_legend(&legend, rows)?;
        page.present()?;
        Ok(())
    }

    fn draw_legend(
        &self,
        area: &DrawingArea<SVGBackend, Shift>,
        rows: &[Vec<usize>],
    ) -> std::result::Result<(), Box<dyn std::error::Error>> {
        for (row, entries) in rows.iter().enumerate() {
            let y = row as i32 * ENTRY as i32 + 8;
            let mut x = 82;
            for &entry in entries {
                match self.series.get(entry) {
                    Some(series) => {
                        let colour = colour(entry, series);
                        if series.draw != Draw::Dots {
                            area.draw(&PathElement::new([(x, y), (x + 24, y)], colour.stroke_width(2)))?;
                        }
                        match series.draw {
                            Draw::Joined | Draw::Dots => {
                                area.draw(&Circle::new((x + 12, y), 4, colour.filled()))?
                            }
                            Draw::Printed => {
                                area.draw(&Circle::new((x + 12, y), 5, colour.stroke_width(2)))?
                            }
                            Draw::Line => {}
                        }
                    }
                    None => {
                        area.draw(&Rectangle::new([(x, y - 6), (x + 24, y + 6)], INK.mix(0.10).filled()))?;
                    }
                }
                area.draw(&Text::new(self.name(entry).to_owned(), (x + 31, y - 9), ("sans-serif", 18)))?;
                x += self.entry_width(entry);
            }
        }
        Ok(())
    }

    /// Entries of the legend, series first and then bands, broken into rows.
    fn legend_rows(&self) -> Vec<Vec<usize>> {
        let mut rows: Vec<Vec<usize>> = Vec::new();
        let mut room = 0;
        for entry in 0..self.series.len() + self.bands.len() {
            let width = self.entry_width(entry);
            match rows.last_mut() {
                Some(row) if width <= room => row.push(entry),
                _ => {
                    rows.push(vec![entry]);
                    room = WIDTH as i32 - 90;
                }
            }
            room -= width;
        }
        rows
    }

    fn name(&self, entry: usize) -> &str {
        match self.series.get(entry) {
            Some(series) => &series.name,
            None => &self.bands[entry - self.series.len()].0,
        }
    }

    fn entry_width(&self, entry: usize) -> i32 {
        56 + 10 * self.name(entry).chars().count() as i32
    }

    fn extent(&self, axis: &Axis, of: impl Fn(&(f64, f64)) -> f64) -> (f64, f64) {
        if let Some(range) = axis.range {
            return range;
        }
        let values = self.series.iter().flat_map(|s| s.points.iter().map(&of)).filter(|v| v.is_finite());
        let (least, greatest) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        if least > greatest {
            return (0.0, 1.0); // nothing to show
        }
        let margin = if greatest > least { 0.05 * (greatest - least) } else { 0.5 * least.abs().max(1.0) };
        (least - margin, greatest + margin)
    }
}

/// Text as it stands in a drawing.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

fn colour(k: usize, series: &Series) -> RGBColor {
    if series.draw == Draw::Printed { INK } else { PALETTE[k % PALETTE.len()] }
}

/// A label without trailing noise: 0.30000000000000004 is 0.3.
fn number(value: f64) -> String {
    let rounded = libm::round(value * 1e9) / 1e9;
    if rounded == 0.0 { "0".to_owned() } else { rounded.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot() -> Plot {
        Plot {
            title: "ice & <frames>".into(),
            x: Axis::of("frame"),
            y: Axis::within("share of cells", 0.0, 1.0),
            series: vec![
                Series::new("measured", Draw::Line, [(0.0, 0.0), (1.0, 0.5), (2.0, f64::NAN)]),
                Series::new("printed", Draw::Printed, [(0.0, 0.1)]),
            ],
            bands: vec![("tolerance".into(), 0.4, 0.6)],
        }
    }

    #[test]
    fn a_plot_is_well_formed_and_names_everything() {
        let svg = plot().to_svg().unwrap();
        let page = roxmltree::Document::parse(&svg).unwrap();
        let text: String = page.descendants().filter_map(|n| n.text()).collect();
        for word in ["ice & <frames>", "frame", "share of cells", "measured", "printed", "tolerance"] {
            assert!(text.contains(word), "{word}");
        }
        assert_eq!(svg, plot().to_svg().unwrap());
    }

    #[test]
    fn labels_have_no_noise() {
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(-1e-17), "0");
        assert_eq!(number(130.0), "130");
    }
}
