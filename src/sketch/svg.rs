//! Drawings.

use std::collections::BTreeMap;

use kurbo::{Affine, BezPath, PathEl, Point, Vec2};
use nalgebra::{Point2, point};
use roxmltree::{Document, Node, ParsingOptions};
use svgtypes::{Length, LengthUnit, TransformListParser, TransformListToken};

use super::lines::{ColourLevel, Traced};
use super::outline::{Drawing, Shape};
use super::path;
use super::place::lay;
use super::style::{Fill, Sheet, Style, classes};
use super::{Bend, FURTHEST, MOST_STARTS, Placement, Sketch, SketchError, one_line, quoted};

/// The most bytes of a drawing.
pub const MOST_BYTES: usize = 1 << 25;
/// The most elements that are drawn, counted again wherever a `use` draws them again.
pub const MOST_ELEMENTS: usize = 200_000;
/// The most lines and curves in all.
pub const MOST_SEGMENTS: usize = 2_000_000;
/// The deepest nesting, `use` included.
pub const MOST_DEPTH: usize = 128;
// The parser compares an element's attributes with one another, and copies name spaces down the tree.
const MOST_ATTRIBUTES: usize = 1000;
const MOST_NAMESPACES: usize = 1000;
const MOST_NODES: u32 = 1 << 21;

const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// Reads an SVG drawing; sketch units are the user units of its outermost element.
///
/// Paint is what is filled: `path`, `rect`, `circle`, `ellipse`, `polygon` and `polyline`, in `svg`, `g`, `a` and
/// `switch`, or drawn by `use` (also from `defs` and `symbol`). Any fill counts, gradients and `currentColor` included,
/// except `none`, transparent colours, and shapes that `fill-opacity`, `opacity`, `display` or `visibility` hide. The
/// topmost filled shape decides, and white is bare: a white shape above others cuts a hole. Both fill rules are kept.
///
/// A `circle` of class `start` is a start at its centre and not paint, whatever its fill.
///
/// Fills may be given by attribute, by `style`, or by a style sheet whose selectors name an element, classes or an id
/// (`path`, `.a`, `#b`, `rect.a.c`); rules with other selectors are passed over, and `!important` is not weighed.
/// `transform` attributes are heeded. Not heeded are `viewBox` and `preserveAspectRatio` (nested ones too), strokes,
/// text, pictures, clips, masks, filters, markers, and the conditions of `switch`: all its children are drawn.
///
/// # Errors
/// A file that is not UTF-8 or not SVG, that declares XML entities, or that is larger than the limits of this module;
/// numbers that are missing, not finite or beyond [`FURTHEST`]; no paint; a start outside; a placement that cannot be
/// had. Faults of an element name its line and column.
pub fn read_svg(bytes: &[u8], placement: Placement) -> Result<Sketch, SketchError> {
    read_svg_bent(bytes, placement, None)
}

/// The same on a lattice that is bent, if it is.
///
/// # Errors
/// As [`read_svg`], and an angle that is not accepted.
pub fn read_svg_bent(bytes: &[u8], placement: Placement, bend: Option<Bend>) -> Result<Sketch, SketchError> {
    let document = parse(bytes)?;
    let reader = draw(&document, None)?;
    let drawing = Drawing::new(reader.shapes).ok_or(SketchError::NoPaint {
        expected: "at least one filled path, rect, circle, ellipse, polygon or polyline that is not white",
    })?;
    lay(&drawing, &reader.starts, placement, bend)
}

/// Every shape with its level, whatever its fill, in the drawing's own units.
pub(super) fn traced(bytes: &[u8], colours: &[ColourLevel]) -> Result<Vec<Traced>, SketchError> {
    let document = parse(bytes)?;
    let traces = Traces { shapes: Vec::new(), colours: colours.to_vec() };
    Ok(draw(&document, Some(traces))?.traced.map(|traces| traces.shapes).unwrap_or_default())
}

/// Shapes taken as lines, and the levels that colours stand for.
struct Traces {
    shapes: Vec<Traced>,
    colours: Vec<ColourLevel>,
}

fn parse(bytes: &[u8]) -> Result<Document<'_>, SketchError> {
    let text = checked(bytes)?;
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|e| SketchError::Xml { what: one_line(e) })
}

/// Draws the whole document: its paint, or its lines where `traced` is there to take them.
fn draw<'a, 'input>(
    document: &'a Document<'input>,
    traced: Option<Traces>,
) -> Result<Reader<'a, 'input>, SketchError> {
    let root = document.root_element();
    if !is(root, "svg") {
        let what = format!("the outermost element is {}", quoted(root.tag_name().name()));
        return Err(SketchError::Xml { what });
    }
    let mut reader = Reader {
        ids: BTreeMap::new(),
        sheet: Sheet::default(),
        shapes: Vec::new(),
        traced,
        starts: Vec::new(),
        elements: 0,
        segments: 0,
    };
    for node in root.descendants().filter(Node::is_element) {
        if let Some(id) = node.attribute("id") {
            reader.ids.entry(id).or_insert(node);
        }
        if is(node, "style") {
            let sheet: String = node.children().filter_map(|n| n.text()).collect();
            reader.sheet.add(&sheet)?;
        }
    }
    reader.draw(root, Affine::IDENTITY, Style::default(), 0)?;
    Ok(reader)
}

/// What must hold before the parser sees the text.
fn checked(bytes: &[u8]) -> Result<&str, SketchError> {
    let too_many = |what, most| Err(SketchError::TooIntricate { what, most });
    if bytes.len() > MOST_BYTES {
        return too_many("bytes", MOST_BYTES);
    }
    let refused = |what: &str| SketchError::Xml { what: what.into() };
    let text = std::str::from_utf8(bytes).map_err(|_| refused("it is not UTF-8 text"))?;
    if text.contains("<!ENTITY") {
        // A few bytes of them can stand for gigabytes.
        return Err(refused("it declares XML entities, which are not read: save it as plain SVG"));
    }
    if text.split('<').any(|tag| tag.bytes().filter(|b| *b == b'=').count() > MOST_ATTRIBUTES) {
        return too_many("attributes on one element", MOST_ATTRIBUTES);
    }
    if text.matches("xmlns").count() > MOST_NAMESPACES {
        return too_many("declarations of name spaces", MOST_NAMESPACES);
    }
    Ok(text)
}

/// Whether the node is the SVG element of that name; drawings without name spaces are accepted.
fn is(node: Node, name: &str) -> bool {
    node.tag_name().name() == name && matches!(node.tag_name().namespace(), None | Some(SVG))
}

fn fault(node: Node, what: impl Into<String>) -> SketchError {
    let at = node.document().text_pos_at(node.range().start);
    let element = one_line(node.tag_name().name());
    SketchError::Element { element, line: at.row, column: at.col, what: what.into() }
}

struct Reader<'a, 'input> {
    ids: BTreeMap<&'a str, Node<'a, 'input>>,
    sheet: Sheet,
    shapes: Vec<Shape>,
    traced: Option<Traces>,
    starts: Vec<Point2<f64>>,
    elements: usize,
    segments: usize,
}

impl<'a, 'input> Reader<'a, 'input> {
    fn draw(
        &mut self,
        node: Node<'a, 'input>,
        around: Affine,
        style: Style,
        depth: usize,
    ) -> Result<(), SketchError> {
        if !matches!(node.tag_name().namespace(), None | Some(SVG)) {
            return Ok(());
        }
        if depth > MOST_DEPTH {
            let what = format!(
                "nested deeper than {MOST_DEPTH} levels; expected fewer, and no `use` that draws itself"
            );
            return Err(fault(node, what));
        }
        self.elements += 1;
        if self.elements > MOST_ELEMENTS {
            let what = "elements drawn (with `use`, again for each)";
            return Err(SketchError::TooIntricate { what, most: MOST_ELEMENTS });
        }
        let style = style.of(node, &self.sheet).map_err(|what| fault(node, what))?;
        if style.absent {
            return Ok(());
        }
        let onto = around * transform(node)?;
        match node.tag_name().name() {
            "g" | "a" | "switch" | "symbol" => self.draw_children(node, onto, style, depth),
            "svg" => {
                // The outermost one's place means nothing.
                let moved = if depth == 0 { Affine::IDENTITY } else { offset(node)? };
                self.draw_children(node, onto * moved, style, depth)
            }
            "use" => {
                let href = node.attribute("href").or_else(|| node.attribute((XLINK, "href")));
                let href = href.unwrap_or_default();
                let target = href.strip_prefix('#').and_then(|id| self.ids.get(id).copied());
                let target = target.ok_or_else(|| {
                    fault(node, format!("expected the `#id` of an element here, found {}", quoted(href)))
                })?;
                self.draw(target, onto * offset(node)?, style, depth + 1)
            }
            "circle" if classes(node).any(|c| c == "start") => self.start(node, onto),
            _ => self.shape(node, onto, style),
        }
    }

    fn draw_children(
        &mut self,
        node: Node<'a, 'input>,
        onto: Affine,
        style: Style,
        depth: usize,
    ) -> Result<(), SketchError> {
        // A symbol is drawn only where it is used.
        let drawn = node.children().filter(|n| n.is_element() && !is(*n, "symbol"));
        drawn.into_iter().try_for_each(|child| self.draw(child, onto, style, depth + 1))
    }

    fn start(&mut self, node: Node, onto: Affine) -> Result<(), SketchError> {
        let centre = near(node, onto * Point::new(number(node, "cx")?, number(node, "cy")?))?;
        if self.starts.len() == MOST_STARTS {
            return Err(SketchError::TooManyStarts);
        }
        self.starts.push(point![centre.x, centre.y]);
        Ok(())
    }

    fn shape(&mut self, node: Node, onto: Affine, style: Style) -> Result<(), SketchError> {
        let fill = style.seen();
        if fill == Fill::None && self.traced.is_none() {
            return Ok(());
        }
        let most = MOST_SEGMENTS - self.segments;
        let Some(path) = outline(node, most)? else { return Ok(()) };
        let path = path.filter(|path| path.elements().len() <= most);
        let mut path =
            path.ok_or(SketchError::TooIntricate { what: "lines and curves", most: MOST_SEGMENTS })?;
        self.segments += path.elements().len();
        path.apply_affine(onto);
        for element in path.elements() {
            match *element {
                PathEl::MoveTo(a) | PathEl::LineTo(a) => [a, a, a],
                PathEl::QuadTo(a, b) => [a, b, b],
                PathEl::CurveTo(a, b, c) => [a, b, c],
                PathEl::ClosePath => continue,
            }
            .into_iter()
            .try_for_each(|place| near(node, place).map(|_| ()))?;
        }
        if path.elements().is_empty() {
            return Ok(());
        }
        if let Some(traced) = &mut self.traced {
            let level = level(node, style.stroke, &traced.colours)?;
            traced.shapes.push(Traced { path, level, name: name(node) });
        } else {
            self.shapes.push(Shape { path, rule: style.rule, erases: fill == Fill::White });
        }
        Ok(())
    }
}

/// `data-level`, the element's own or that of the nearest one around it; else what its colour stands for.
fn level(node: Node, stroke: Option<[u8; 3]>, colours: &[ColourLevel]) -> Result<f64, SketchError> {
    let Some(value) = node.ancestors().find_map(|around| around.attribute("data-level")) else {
        if colours.is_empty() {
            let what = "no `data-level`; expected one on every line, or on the element around it";
            return Err(fault(node, what));
        }
        let known = colours.iter().find(|known| Some(known.colour) == stroke);
        let hex = |[r, g, b]: [u8; 3]| format!("#{r:02x}{g:02x}{b:02x}");
        return known.map(|known| known.level).ok_or_else(|| {
            let seen = stroke.map_or("no stroke".to_owned(), |colour| format!("the stroke {}", hex(colour)));
            let all: Vec<String> = colours.iter().map(|known| hex(known.colour)).collect();
            fault(node, format!("no `data-level`, and {seen}; expected one of {}", all.join(", ")))
        });
    };
    match value.trim().parse::<f64>() {
        Ok(level) if level.abs() <= FURTHEST => Ok(level),
        _ => {
            Err(fault(node, format!("`data-level` is {}; expected a number up to {FURTHEST}", quoted(value))))
        }
    }
}

/// What messages call an element.
fn name(node: Node) -> String {
    match node.attribute("id") {
        Some(id) => format!("#{}", one_line(id)),
        None => {
            let at = node.document().text_pos_at(node.range().start);
            format!("{} in line {}, column {}", node.tag_name().name(), at.row, at.col)
        }
    }
}

/// The outline of a shape in its own coordinates; none of what is no shape, and inside none of what is too long.
fn outline(node: Node, most: usize) -> Result<Option<Option<BezPath>>, SketchError> {
    let data = |name: &str| node.attribute(name).unwrap_or_default();
    let wrong =
        |name: &'static str| move |what: String| fault(node, format!("in `{name}`: {}", one_line(what)));
    Ok(Some(match node.tag_name().name() {
        "path" => path::path(data("d"), most).map_err(wrong("d"))?,
        "polygon" | "polyline" => path::polygon(data("points"), most).map_err(wrong("points"))?,
        "circle" => {
            let centre = Point::new(number(node, "cx")?, number(node, "cy")?);
            let radius = size(node, "r")?.unwrap_or(0.0);
            Some(path::ellipse(centre, Vec2::new(radius, radius)))
        }
        "ellipse" => {
            let centre = Point::new(number(node, "cx")?, number(node, "cy")?);
            Some(path::ellipse(centre, radii(node)?))
        }
        "rect" => {
            let corner = Point::new(number(node, "x")?, number(node, "y")?);
            let extent = |name| Ok::<_, SketchError>(size(node, name)?.unwrap_or(0.0));
            Some(path::rectangle(corner, Vec2::new(extent("width")?, extent("height")?), radii(node)?))
        }
        _ => return Ok(None),
    }))
}

/// `rx` and `ry`; one stands for both.
fn radii(node: Node) -> Result<Vec2, SketchError> {
    let (rx, ry) = (size(node, "rx")?, size(node, "ry")?);
    Ok(Vec2::new(rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0)))
}

fn offset(node: Node) -> Result<Affine, SketchError> {
    Ok(Affine::translate((number(node, "x")?, number(node, "y")?)))
}

fn near(node: Node, place: Point) -> Result<Point, SketchError> {
    if place.x.abs() <= FURTHEST && place.y.abs() <= FURTHEST {
        return Ok(place);
    }
    Err(fault(node, format!("a point at ({}, {}); expected coordinates up to {FURTHEST}", place.x, place.y)))
}

/// A length in user units, 0 if absent.
fn number(node: Node, name: &str) -> Result<f64, SketchError> {
    Ok(length(node, name)?.unwrap_or(0.0))
}

/// A length that may be `auto`, which is as good as absent, but not negative.
fn size(node: Node, name: &str) -> Result<Option<f64>, SketchError> {
    if node.attribute(name).is_some_and(|value| value.trim() == "auto") {
        return Ok(None);
    }
    let size = length(node, name)?;
    match size {
        Some(size) if size < 0.0 => Err(fault(node, format!("`{name}` is {size}; expected 0 or more"))),
        size => Ok(size),
    }
}

fn length(node: Node, name: &str) -> Result<Option<f64>, SketchError> {
    let Some(value) = node.attribute(name) else { return Ok(None) };
    let length = value.trim().parse::<Length>().ok();
    let unit = length.and_then(|length| match length.unit {
        LengthUnit::None | LengthUnit::Px => Some(1.0),
        LengthUnit::In => Some(96.0),
        LengthUnit::Cm => Some(96.0 / 2.54),
        LengthUnit::Mm => Some(96.0 / 25.4),
        LengthUnit::Pt => Some(96.0 / 72.0),
        LengthUnit::Pc => Some(16.0),
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => None,
    });
    match length.zip(unit).map(|(length, unit)| length.number * unit) {
        Some(number) if number.abs() <= FURTHEST => Ok(Some(number)),
        _ => Err(fault(node, format!("`{name}` is {}; expected a number up to {FURTHEST}", quoted(value)))),
    }
}

fn transform(node: Node) -> Result<Affine, SketchError> {
    let Some(value) = node.attribute("transform") else { return Ok(Affine::IDENTITY) };
    let wrong = |what: String| {
        let what =
            format!("`transform` {}: {}; expected a list of transforms", quoted(value), one_line(what));
        fault(node, what)
    };
    let tan = |degrees: f64| {
        let (sin, cos) = path::turn(degrees);
        sin / cos
    };
    let mut all = Affine::IDENTITY;
    for token in TransformListParser::from(value) {
        all *= match token.map_err(|e| wrong(e.to_string()))? {
            TransformListToken::Matrix { a, b, c, d, e, f } => Affine::new([a, b, c, d, e, f]),
            TransformListToken::Translate { tx, ty } => Affine::translate((tx, ty)),
            TransformListToken::Scale { sx, sy } => Affine::scale_non_uniform(sx, sy),
            TransformListToken::Rotate { angle } => {
                let (sin, cos) = path::turn(angle);
                Affine::new([cos, sin, -sin, cos, 0.0, 0.0])
            }
            TransformListToken::SkewX { angle } => Affine::new([1.0, 0.0, tan(angle), 1.0, 0.0, 0.0]),
            TransformListToken::SkewY { angle } => Affine::new([1.0, tan(angle), 0.0, 1.0, 0.0, 0.0]),
        };
    }
    if all.is_finite() { Ok(all) } else { Err(wrong("not finite".into())) }
}
