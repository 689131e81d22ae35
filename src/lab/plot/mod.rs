//! Plots as SVG: units on the axes, a legend beneath, colours that colour-blind readers can tell apart, and readable
//! on a light page and on a dark one.

mod coord;
mod draw;
mod legend;
mod panels;

use plotters::prelude::*;

use super::error::{Error, Result};
use draw::{Look, chart};
use legend::Legend;
pub use panels::Panels;

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
    /// Whether equal distances are equal ratios.
    pub log: bool,
}

impl Axis {
    /// An axis that fits the data.
    pub fn of(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: None, log: false }
    }

    /// An axis of ratios, from one number above 0 to another; what is not above 0 is left out.
    pub fn log(label: impl Into<String>, from: f64, to: f64) -> Self {
        Self { label: label.into(), range: Some((from, to)), log: true }
    }

    /// An axis from one number to another.
    pub fn within(label: impl Into<String>, from: f64, to: f64) -> Self {
        Self { label: label.into(), range: Some((from, to)), log: false }
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
    /// A line that runs level and then jumps: a share of what has happened so far.
    Step,
    /// A faint line, for what is there to compare with. One without a name has no entry in the legend.
    Ghost,
    /// Dots in the order of a search: light first, dark last; an open circle marks the first, a cross the last.
    Path,
}

impl Series {
    /// A series without error bars.
    pub fn new(name: impl Into<String>, draw: Draw, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { name: name.into(), points: points.into_iter().collect(), errors: Vec::new(), draw }
    }
}

const WIDTH: u32 = 760;
const HEIGHT: u32 = 460;

/// Light on dark where the reader's page is dark.
pub(super) const STYLE: &str = "<style>text{font-family:system-ui,sans-serif}@media(prefers-color-scheme:dark){\
[fill=\"#FFFFFF\"]{fill:#14181d}[fill=\"#000000\"]{fill:#e6e9ed}[stroke=\"#000000\"]{stroke:#e6e9ed}\
[fill=\"#0072B2\"]{fill:#5ab0ee}[stroke=\"#0072B2\"]{stroke:#5ab0ee}\
[fill=\"#D55E00\"]{fill:#f08a3c}[stroke=\"#D55E00\"]{stroke:#f08a3c}}</style>";

impl Plot {
    /// The plot as SVG text.
    pub fn to_svg(&self) -> Result<String> {
        let legend = Legend::of(&[self]);
        let rows = legend.rows(WIDTH as i32 - 90);
        let height = HEIGHT + legend::ENTRY * rows.len() as u32;
        svg(&self.title, (WIDTH, height), |page| {
            let (chart_area, legend_area) = page.split_vertically(HEIGHT);
            chart(&chart_area, self, &Look::LARGE)?;
            legend.draw(&legend_area, &rows, (82, 8))
        })
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

type Drawn = std::result::Result<(), Box<dyn std::error::Error>>;
type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

/// A drawing of this size as SVG text, with its title and style.
fn svg(title: &str, size: (u32, u32), draw: impl FnOnce(&Area) -> Drawn) -> Result<String> {
    let mut svg = String::new();
    {
        let page = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        let drawn = page.fill(&WHITE).map_err(Into::into).and_then(|()| draw(&page));
        drawn
            .and_then(|()| page.present().map_err(Into::into))
            .map_err(|cause| Error::broken("cannot draw a plot").at(title).because(cause.to_string()))?;
    }
    let title = escaped(title);
    let body = svg.find('>').map_or(0, |end| end + 1);
    Ok(format!("{}\n<title>{title}</title>{STYLE}{}\n", &svg[..body], svg[body..].trim_end()))
}

/// Text as it stands in a drawing.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

/// A label without trailing noise: 0.30000000000000004 is 0.3.
fn number(value: f64) -> String {
    let rounded = libm::round(value * 1e9) / 1e9;
    match rounded.abs() {
        0.0 => "0".to_owned(),
        small if small < 1e-4 => format!("{rounded:e}"),
        _ => rounded.to_string(),
    }
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

    /// What a plot is drawn from: a search over a curve, a share that rises, and more series than there are colours.
    fn panels(plots: usize) -> Panels {
        let plot = |k: usize| Plot {
            title: format!("panel {k}"),
            x: Axis::log("evaluations", 1.0, 100.0),
            y: Axis::within("share", 0.0, 1.0),
            series: (0..9)
                .map(|s| {
                    Series::new(format!("series {s}"), Draw::Step, [(0.0, 0.3), (f64::from(s) + 1.0, 0.5)])
                })
                .chain([
                    Series::new("", Draw::Ghost, [(1.0, 0.2), (50.0, 0.9)]),
                    Series::new("path", Draw::Path, [(2.0, 0.2), (20.0, 0.6), (10.0, 0.4)]),
                ])
                .collect(),
            bands: Vec::new(),
        };
        Panels { title: "many <plots>".into(), columns: 2, plots: (0..plots).map(plot).collect() }
    }

    #[test]
    fn panels_share_a_legend_where_it_is_the_same() {
        let names = |panels: &Panels| {
            let svg = panels.to_svg().unwrap();
            let page = roxmltree::Document::parse(&svg).unwrap();
            let text = page.descendants().filter(|n| n.is_text()).filter_map(|n| n.text());
            let text = text.map(|t| t.trim().to_owned());
            text.filter(|t| !t.is_empty()).collect::<Vec<_>>()
        };
        let count = |names: &[String], word: &str| names.iter().filter(|name| *name == word).count();
        let alike = names(&panels(3));
        assert_eq!(
            (count(&alike, "series 8"), count(&alike, "panel 2"), count(&alike, "many <plots>")),
            (1, 1, 2)
        );
        let mut other = panels(2);
        other.plots[1].series.pop();
        assert_eq!(count(&names(&other), "series 8"), 2);
    }

    /// Of two series of one colour the second is dashed; a number that an axis of ratios cannot show is left out.
    #[test]
    fn more_series_than_colours_are_told_apart() {
        let legend = legend::Legend::of(&[&panels(1).plots[0]]);
        assert_eq!(legend.rows(10_000).concat().len(), 10, "the nameless one has no entry");
        assert!(draw::is_dashed(7) && !draw::is_dashed(6));
        assert!(panels(1).to_svg().is_ok());
    }

    #[test]
    fn labels_have_no_noise() {
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(-1e-17), "0");
        assert_eq!(number(130.0), "130");
        assert_eq!(number(0.000_000_01), "1e-8");
    }
}
