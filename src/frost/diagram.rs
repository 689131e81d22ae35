//! Figure 2: one step of the algorithm on a small lattice, as a drawing with numbers.

use std::fmt::Write;

use super::{Frost, State};
use crate::hexgrid::Axial;

/// Corners of a hexagon around its centre, when neighbouring centres are one apart.
const CORNERS: [(f64, f64); 6] = [
    (0.0, -0.577_350_269),
    (0.5, -0.288_675_135),
    (0.5, 0.288_675_135),
    (0.0, 0.577_350_269),
    (-0.5, 0.288_675_135),
    (-0.5, -0.288_675_135),
];
/// Pixels between neighbouring centres.
const SCALE: f64 = 46.0;
const MARGIN: f64 = 14.0;
const BAND: f64 = 34.0;

/// The next step of a frost as SVG: the three states, what receptive cells keep and gain, what diffuses, and their sum.
///
/// Numbers are rounded to three decimals; a small lattice (some forty cells) is readable.
pub fn algorithm(frost: &Frost) -> String {
    let addends = frost.addends();
    let mut next = frost.clone();
    next.step();
    let count = frost.region().len();
    let state = |i: usize| colour(frost.state(i));
    let shade = |value: f64| if value == 0.0 { "none" } else { "#b9d9ee" };
    let panels: [(&str, Vec<(String, &str)>); 4] = [
        ("u: ice, neighbours, others", (0..count).map(|i| (number(frost.u(i)), state(i))).collect()),
        (
            "receptive: u + gamma",
            (0..count).map(|i| (number(addends.receptive[i]), shade(addends.receptive[i]))).collect(),
        ),
        (
            "diffusion, receptive as 0",
            (0..count).map(|i| (number(addends.diffusing[i]), shade(addends.diffusing[i]))).collect(),
        ),
        ("their sum: the next u", (0..count).map(|i| (number(next.u(i)), colour(next.state(i)))).collect()),
    ];
    let bounds = extent(frost.region().cells());
    let (width, height) = (bounds.2 + 2.0 * MARGIN, bounds.3 + 2.0 * MARGIN + BAND);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0} {:.0}\" width=\"{:.0}\" height=\"{:.0}\" \
         role=\"img\">\n<title>One step of the algorithm</title>{STYLE}\n<rect class=\"page\" width=\"100%\" \
         height=\"100%\"/>\n",
        2.0 * width,
        2.0 * height,
        2.0 * width,
        2.0 * height
    );
    for (k, (title, cells)) in panels.iter().enumerate() {
        let (left, top) = ((k % 2) as f64 * width, (k / 2) as f64 * height);
        let _ = writeln!(
            svg,
            "<g transform=\"translate({left:.0} {top:.0})\"><text class=\"title\" x=\"{MARGIN}\" y=\"24\">{}. {title}</text>",
            ["a", "b", "c", "d"][k]
        );
        for (cell, (text, fill)) in frost.region().cells().iter().zip(cells) {
            let centre = cell.position() * SCALE;
            hexagon(&mut svg, centre.x - bounds.0 + MARGIN, centre.y - bounds.1 + MARGIN + BAND, text, fill);
        }
        svg.push_str("</g>\n");
    }
    svg + "</svg>\n"
}

const STYLE: &str = "<style>text{font:12px system-ui,sans-serif;text-anchor:middle;fill:#10171e}.title{font-size:17px;\
font-weight:600;text-anchor:start;fill:#1b2127}.page{fill:#fff}path{stroke:#5b6975;stroke-width:1}\
path[fill=none]{fill:#f4f7f9}@media(prefers-color-scheme:dark){.page{fill:#14181d}.title{fill:#e6e9ed}\
path[fill=none]{fill:#5f6b76}path{stroke:#98a5b0}}</style>";

fn colour(state: State) -> &'static str {
    match state {
        State::Ice => "#ffffff",
        State::Neighbour => "#f0e442",
        State::Other => "#8cc4e8",
    }
}

fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.to_owned()
}

fn hexagon(svg: &mut String, x: f64, y: f64, text: &str, fill: &str) {
    let corners: Vec<String> =
        CORNERS.iter().map(|(dx, dy)| format!("{:.1} {:.1}", x + dx * SCALE, y + dy * SCALE)).collect();
    let _ = writeln!(
        svg,
        "<path fill=\"{fill}\" d=\"M{}Z\"/><text x=\"{x:.1}\" y=\"{:.1}\">{text}</text>",
        corners.join("L"),
        y + 4.0
    );
}

/// Left, top, width and height of the hexagons in pixels.
fn extent(cells: &[Axial]) -> (f64, f64, f64, f64) {
    let (mut least, mut greatest) = ((f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY));
    for place in cells.iter().map(|cell| cell.position()) {
        least = (least.0.min(place.x), least.1.min(place.y));
        greatest = (greatest.0.max(place.x), greatest.1.max(place.y));
    }
    let (left, top) = ((least.0 - 0.5) * SCALE, (least.1 - 0.58) * SCALE);
    (left, top, (greatest.0 + 0.5) * SCALE - left, (greatest.1 + 0.58) * SCALE - top)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frost::{Edge, Inflow, Parameters, Redraw, RingTouchingIce};
    use crate::hexgrid::Region;
    use crate::rng::Seed;

    #[test]
    fn every_panel_has_every_cell_and_the_sum_is_right() {
        let parameters = Parameters {
            alpha: 1.0,
            beta: 0.35,
            gamma: 0.005,
            threshold: 0.0,
            steps_per_frame: 1,
            inflow: Inflow::ReiterGated,
            redraw: Redraw::Frame,
            edge: Edge::Reflecting,
            ring_touching_ice: RingTouchingIce::Zero,
        };
        let frost = Frost::new(&Region::hexagon(2), &[Axial::ORIGIN], parameters, Seed(1)).unwrap();
        let svg = algorithm(&frost);
        let page = roxmltree::Document::parse(&svg).unwrap();
        assert_eq!(page.descendants().filter(|n| n.has_tag_name("path")).count(), 4 * 19);
        // A neighbour of the start gains gamma and a twelfth of the vapour of three cells: 0.355 + 0.0875.
        assert_eq!(svg.matches(">0.442<").count() + svg.matches(">0.443<").count(), 6, "{svg}");
    }
}
