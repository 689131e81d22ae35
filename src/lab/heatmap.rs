//! Heat maps as SVG: a number for each pair of two quantities, written in its cell and coloured by its size.

use std::fmt::Write;

use super::plot::{STYLE, escaped};
use crate::image::colour::CIVIDIS;

/// A table of numbers, coloured: light is small, dark is large, and what is accepted is framed.
#[derive(Clone, Debug)]
pub struct HeatMap {
    /// What it shows.
    pub title: String,
    /// The quantity along the top and its unit, and its values.
    pub x: (String, Vec<String>),
    /// The quantity down the side and its unit, and its values.
    pub y: (String, Vec<String>),
    /// A row of numbers for each value of y; none where there is nothing to show.
    pub cells: Vec<Vec<Option<f64>>>,
    /// The number that has the darkest colour; a larger one has it, too.
    pub darkest: f64,
    /// Numbers up to this one are framed, and what that means.
    pub accepted: Option<(f64, String)>,
    /// Digits after the point.
    pub digits: usize,
}

const CELL: (usize, usize) = (66, 34);
const TOP: usize = 96;

impl HeatMap {
    /// The map as SVG text.
    pub fn to_svg(&self) -> String {
        let left = 40 + 10 * self.y.1.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(3);
        let (columns, rows) = (self.x.1.len(), self.y.1.len());
        let needed = 11 * self.title.chars().count().max(self.x.0.chars().count()) + 40;
        let width = (left + columns * CELL.0 + 24).max(needed);
        let bottom = TOP + rows * CELL.1;
        let height = bottom + if self.accepted.is_some() { 52 } else { 20 };
        let mut svg = format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" xmlns=\"http://www.w3.org/2000/svg\">\n\
             <title>{title}</title>{STYLE}<rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>\n\
             <g font-size=\"17\" fill=\"#000000\" font-family=\"sans-serif\">\n",
            title = escaped(&self.title),
        );
        let mut text = |x: usize, y: usize, anchor: &str, more: &str, words: &str| {
            let words = escaped(words);
            let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\"{more}>{words}</text>");
        };
        text(16, 28, "start", " font-size=\"20\" font-weight=\"bold\"", &self.title);
        text(left + columns * CELL.0 / 2, 60, "middle", "", &self.x.0);
        let middle = TOP + rows * CELL.1 / 2;
        text(20, middle, "middle", &format!(" transform=\"rotate(-90 20 {middle})\""), &self.y.0);
        for (column, name) in self.x.1.iter().enumerate() {
            text(left + column * CELL.0 + CELL.0 / 2, TOP - 10, "middle", "", name);
        }
        for (row, name) in self.y.1.iter().enumerate() {
            text(left - 8, TOP + row * CELL.1 + 23, "end", "", name);
        }
        for (row, numbers) in self.cells.iter().enumerate() {
            for (column, number) in numbers.iter().enumerate() {
                self.cell(&mut svg, left + column * CELL.0, TOP + row * CELL.1, *number);
            }
        }
        // Frames last, so that no neighbour hides them.
        for (row, numbers) in self.cells.iter().enumerate() {
            for (column, number) in numbers.iter().enumerate() {
                if number.is_some_and(|number| self.accepts(number)) {
                    frame(&mut svg, left + column * CELL.0, TOP + row * CELL.1);
                }
            }
        }
        if let Some((_, meaning)) = &self.accepted {
            frame(&mut svg, left, bottom + 12);
            let words = escaped(meaning);
            let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\">{words}</text>", left + CELL.0 + 10, bottom + 35);
        }
        svg + "</g></svg>\n"
    }

    fn accepts(&self, number: f64) -> bool {
        self.accepted.as_ref().is_some_and(|(most, _)| number <= *most)
    }

    fn cell(&self, svg: &mut String, x: usize, y: usize, number: Option<f64>) {
        let (width, height) = CELL;
        let Some(number) = number else {
            let _ = writeln!(
                svg,
                "<path d=\"M{} {}h16\" stroke=\"#000000\" stroke-opacity=\"0.35\"/>",
                x + 21,
                y + 17
            );
            return;
        };
        let dark = (number / self.darkest).clamp(0.0, 1.0);
        let [r, g, b] = CIVIDIS.at(1.0 - dark);
        // Of the two inks the one with more contrast; lower case, which the dark page leaves alone.
        let ink = if dark < 0.5 { "#000" } else { "#fff" };
        let (middle, base, digits) = (x + width / 2, y + 23, self.digits);
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"rgb({r},{g},{b})\"/>\
             <text x=\"{middle}\" y=\"{base}\" text-anchor=\"middle\" fill=\"{ink}\">{number:.digits$}</text>",
        );
    }
}

fn frame(svg: &mut String, x: usize, y: usize) {
    let (width, height) = (CELL.0 - 3, CELL.1 - 3);
    let _ = writeln!(
        svg,
        "<rect x=\"{}.5\" y=\"{}.5\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#D55E00\" stroke-width=\"3\"/>",
        x + 1,
        y + 1
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_written_and_what_is_accepted_is_framed() {
        let map = HeatMap {
            title: "a < b".to_owned(),
            x: ("steps".to_owned(), vec!["1".to_owned(), "2".to_owned()]),
            y: ("size".to_owned(), vec!["20".to_owned(), "21".to_owned()]),
            cells: vec![vec![Some(3.25), Some(40.0)], vec![None, Some(4.0)]],
            darkest: 20.0,
            accepted: Some((4.0, "within 4 frames".to_owned())),
            digits: 1,
        };
        let svg = map.to_svg();
        let page = roxmltree::Document::parse(&svg).unwrap();
        let words: Vec<&str> = page.descendants().filter_map(|n| n.text()).map(str::trim).collect();
        for word in ["a < b", "steps", "size", "3.2", "40.0", "4.0", "within 4 frames"] {
            assert!(words.contains(&word), "{word}");
        }
        let framed = page.descendants().filter(|n| n.attribute("stroke-width") == Some("3")).count();
        assert_eq!(framed, 3, "two numbers and the legend");
    }
}
