//! The tree as the paper draws it: its branches on the ground, and the wind as arrows.

use std::fmt::Write as _;

use super::{Sway, Tree, Vector};
use crate::image::{Face, ImageError, Picture, draw_text};

/// A stroke whose ends are round and whose width changes evenly.
struct Stroke {
    from: Vector,
    to: Vector,
    // Half of the width at both ends, m.
    radius: [f64; 2],
    ink: usize,
}

/// Sky, ground, wood, wind, words.
const INKS: [[u8; 3]; 5] = [[250, 251, 252], [196, 188, 172], [84, 58, 36], [120, 170, 208], [40, 44, 52]];
const SKY: usize = 0;
const GROUND: usize = 1;
const WOOD: usize = 2;
const WIND: usize = 3;
const WORDS: usize = 4;
/// What is seen: from and to along x and y, m. The same in every frame.
const VIEW: [[f64; 2]; 2] = [[-4.0, 4.0], [-0.4, 8.0]];
/// A wind vector is drawn so long for each m/s, m.
const ARROW: f64 = 0.045;

/// One moment of a tree, ready to be drawn.
pub struct Frame {
    title: String,
    strokes: Vec<Stroke>,
}

impl Frame {
    /// Tree and wind; a vector for each second node of the air's grid, its tail in the node.
    pub fn of(sway: &Sway, title: impl Into<String>) -> Self {
        let grid = sway.grid();
        let mut strokes = Vec::new();
        let every = (grid.counts[0] / 16).max(1);
        for row in (every / 2..grid.counts[1]).step_by(every) {
            for column in (every / 2..grid.counts[0]).step_by(every) {
                let place = grid.place([column, row]);
                if let Some(air) = sway.air(place) {
                    arrow(Vector::new(place[0], place[1]), ARROW * Vector::new(air[0], air[1]), &mut strokes);
                }
            }
        }
        branches(sway.tree(), &mut strokes);
        Self { title: title.into(), strokes }
    }

    /// The tree alone.
    pub fn still(tree: &Tree, title: impl Into<String>) -> Self {
        let mut strokes = Vec::new();
        branches(tree, &mut strokes);
        Self { title: title.into(), strokes }
    }

    /// An SVG `width` pixels wide.
    pub fn svg(&self, width: u32) -> String {
        Self::sheet(&[self], 1, width)
    }

    /// Frames side by side in one SVG, each `width` pixels wide.
    pub fn sheet(frames: &[&Self], columns: usize, width: u32) -> String {
        let (wide, high) = size(width);
        let columns = columns.clamp(1, frames.len().max(1));
        let rows = frames.len().div_ceil(columns);
        let (w, h) = (columns as u32 * wide, rows as u32 * high);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\">\n"
        );
        for (number, frame) in frames.iter().enumerate() {
            let (x, y) = ((number % columns) as u32 * wide, (number / columns) as u32 * high);
            let _ = writeln!(svg, "<svg x=\"{x}\" y=\"{y}\" width=\"{wide}\" height=\"{high}\">");
            frame.write(&mut svg, wide, high);
            svg.push_str("</svg>\n");
        }
        svg + "</svg>\n"
    }

    fn write(&self, svg: &mut String, width: u32, height: u32) {
        let colour = |ink: usize| format!("#{:02x}{:02x}{:02x}", INKS[ink][0], INKS[ink][1], INKS[ink][2]);
        let scale = pixels_per_metre(width);
        let ground = (VIEW[1][1] * scale).min(f64::from(height));
        let _ = write!(
            svg,
            "<rect width=\"{width}\" height=\"{height}\" fill=\"{}\" stroke=\"{}\"/>\n<rect y=\"{ground:.2}\" \
             width=\"{width}\" height=\"{:.2}\" fill=\"{}\"/>\n",
            colour(SKY),
            colour(GROUND),
            f64::from(height) - ground,
            colour(GROUND)
        );
        // Strokes of one ink that follow each other are one path, but for wood, whose joints are round.
        let (mut path, mut open) = (String::new(), None);
        let close = |svg: &mut String, path: &mut String, open: Option<usize>| {
            if let (Some(ink), false) = (open, path.is_empty()) {
                let _ = writeln!(svg, "<path d=\"{path}\" fill=\"{}\"/>", colour(ink));
                path.clear();
            }
        };
        for stroke in &self.strokes {
            let (a, b) = (on_page(stroke.from, scale), on_page(stroke.to, scale));
            let [ra, rb] = stroke.radius.map(|r| half_width(r, scale, stroke.ink));
            let along = b - a;
            let length = libm::sqrt(along.x * along.x + along.y * along.y);
            if length == 0.0 {
                continue;
            }
            let side = Vector::new(-along.y, along.x) / length;
            let corners = [a + ra * side, b + rb * side, b - rb * side, a - ra * side];
            let points: Vec<String> = corners.iter().map(|p| format!("{:.2} {:.2}", p.x, p.y)).collect();
            if open != Some(stroke.ink) {
                close(svg, &mut path, open);
            }
            let _ = write!(path, "M{}z", points.join("L"));
            open = Some(stroke.ink);
            if stroke.ink == WOOD {
                close(svg, &mut path, open);
                let _ = writeln!(
                    svg,
                    "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{rb:.2}\" fill=\"{}\"/>",
                    b.x,
                    b.y,
                    colour(WOOD)
                );
            }
        }
        close(svg, &mut path, open);
        let _ = writeln!(
            svg,
            "<text x=\"10\" y=\"22\" font-family=\"system-ui,sans-serif\" font-size=\"15\" fill=\"{}\">{}</text>",
            colour(WORDS),
            self.title.replace('&', "&amp;").replace('<', "&lt;")
        );
    }

    /// A picture `width` pixels wide, its edges smooth.
    ///
    /// # Errors
    ///
    /// A width that makes no picture.
    pub fn picture(&self, width: u32) -> Result<Picture, ImageError> {
        let (width, height) = size(width);
        let scale = pixels_per_metre(width);
        let mut picture = Picture::new(width, height, INKS[SKY])?;
        let ground = libm::round(VIEW[1][1] * scale) as u32;
        for y in ground..height {
            for x in 0..width {
                picture.set(x, y, INKS[GROUND]);
            }
        }
        for stroke in &self.strokes {
            let (a, b) = (on_page(stroke.from, scale), on_page(stroke.to, scale));
            let radius = stroke.radius.map(|r| half_width(r, scale, stroke.ink));
            lay(&mut picture, a, b, radius, INKS[stroke.ink]);
        }
        draw_text(&mut picture, 10.0, 22.0, 15.0, INKS[WORDS], &self.title, Face::Regular);
        Ok(picture)
    }
}

fn size(width: u32) -> (u32, u32) {
    let height = f64::from(width) * (VIEW[1][1] - VIEW[1][0]) / (VIEW[0][1] - VIEW[0][0]);
    (width, libm::round(height) as u32)
}

fn pixels_per_metre(width: u32) -> f64 {
    f64::from(width) / (VIEW[0][1] - VIEW[0][0])
}

fn on_page(place: Vector, scale: f64) -> Vector {
    Vector::new((place.x - VIEW[0][0]) * scale, (VIEW[1][1] - place.y) * scale)
}

/// Pixels; a branch or an arrow is never too thin to be seen.
fn half_width(radius: f64, scale: f64, ink: usize) -> f64 {
    if ink == WOOD { (radius * scale).max(0.8) } else { radius }
}

fn arrow(at: Vector, vector: Vector, strokes: &mut Vec<Stroke>) {
    let size = libm::sqrt(vector.x * vector.x + vector.y * vector.y);
    if size < 0.01 {
        return;
    }
    let (way, side) = (vector / size, Vector::new(-vector.y, vector.x) / size);
    let (tip, head) = (at + vector, 0.11_f64.min(0.6 * size));
    let line = |from, to, radius| Stroke { from, to, radius, ink: WIND };
    strokes.push(line(at, tip, [0.4, 0.4]));
    strokes.push(line(tip, tip - head * way + 0.4 * head * side, [0.4, 0.4]));
    strokes.push(line(tip, tip - head * way - 0.4 * head * side, [0.4, 0.4]));
}

fn branches(tree: &Tree, strokes: &mut Vec<Stroke>) {
    let skeleton = tree.skeleton();
    for node in 0..skeleton.nodes() {
        let Some(parent) = skeleton.parent(node) else { continue };
        let radius = skeleton.radius(node);
        // From the thicker end of the branch before it to its own.
        let before = if skeleton.parent(parent).is_some() {
            skeleton.radius(parent).min(1.3 * radius)
        } else {
            radius
        };
        let (from, to) = (tree.place(parent), tree.place(node));
        strokes.push(Stroke { from, to, radius: [before, radius], ink: WOOD });
    }
}

/// Lays a stroke over a picture, each pixel by the part of it that is covered.
fn lay(picture: &mut Picture, a: Vector, b: Vector, radius: [f64; 2], ink: [u8; 3]) {
    let most = radius[0].max(radius[1]) + 1.0;
    let bound = |from: f64, to: f64, last: u32| {
        let clamp = |x: f64| libm::floor(x).clamp(0.0, f64::from(last)) as u32;
        clamp(from.min(to) - most)..clamp(from.max(to) + most + 1.0)
    };
    let along = b - a;
    let square = along.x * along.x + along.y * along.y;
    for y in bound(a.y, b.y, picture.height()) {
        for x in bound(a.x, b.x, picture.width()) {
            let at = Vector::new(f64::from(x) + 0.5, f64::from(y) + 0.5) - a;
            let part =
                if square > 0.0 { ((at.x * along.x + at.y * along.y) / square).clamp(0.0, 1.0) } else { 0.0 };
            let off = at - part * along;
            let distance = libm::sqrt(off.x * off.x + off.y * off.y);
            let covered = (radius[0] + part * (radius[1] - radius[0]) - distance + 0.5).clamp(0.0, 1.0);
            if covered > 0.0
                && let Some(under) = picture.get(x, y)
            {
                let mix = |k: usize| {
                    libm::round(f64::from(under[k]) * (1.0 - covered) + f64::from(ink[k]) * covered) as u8
                };
                picture.set(x, y, [mix(0), mix(1), mix(2)]);
            }
        }
    }
}
