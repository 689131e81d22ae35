//! Drawings of lines: SVG.

use std::fmt::Write;

/// A drawing.
pub struct Drawing {
    size: [f64; 2],
    body: String,
}

impl Drawing {
    /// A white sheet.
    pub fn new(size: [f64; 2]) -> Self {
        Self { size, body: String::new() }
    }

    /// A line through points, closed or not, of a colour and width; `fill` is a colour or `none`.
    pub fn line(&mut self, points: &[[f64; 2]], closed: bool, colour: &str, width: f64, fill: &str) {
        let mut path = String::new();
        for (k, [x, y]) in points.iter().enumerate() {
            let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { "M" } else { "L" });
        }
        let end = if closed { "Z" } else { "" };
        let _ = writeln!(
            self.body,
            r#"<path d="{path}{end}" fill="{fill}" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round"/>"#
        );
    }

    /// A dot.
    pub fn dot(&mut self, [x, y]: [f64; 2], radius: f64, colour: &str) {
        let _ = writeln!(self.body, r#"<circle cx="{x:.2}" cy="{y:.2}" r="{radius}" fill="{colour}"/>"#);
    }

    /// Words whose middle is at a place.
    pub fn text(&mut self, [x, y]: [f64; 2], size: f64, words: &str) {
        let _ = writeln!(
            self.body,
            r##"<text x="{x:.1}" y="{y:.1}" font-size="{size}" text-anchor="middle" font-family="sans-serif" fill="#222">{words}</text>"##
        );
    }

    /// Moves what another drawing holds, and takes it in.
    pub fn place(&mut self, other: &Self, [x, y]: [f64; 2]) {
        let _ = writeln!(self.body, r#"<g transform="translate({x} {y})">{}</g>"#, other.body);
    }

    /// The file.
    pub fn svg(&self) -> String {
        let [width, height] = self.size;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n{}</svg>\n",
            self.body
        )
    }
}

/// Colours of levels from low to high, distinct for the colour-blind: blue to orange over grey.
pub const LEVELS: [&str; 6] = ["#1b3a5c", "#2b6ca3", "#6aa3c8", "#c9a227", "#e07b39", "#a63d2f"];
