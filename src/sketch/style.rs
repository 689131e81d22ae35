//! What a shape is filled with: attributes, simple style sheets, inheritance.

use roxmltree::Node;
use svgtypes::Paint;

use super::SketchError;
use super::outline::FillRule;

/// The most rules in all style sheets of a drawing.
const MOST_RULES: usize = 1000;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fill {
    None,
    White,
    Paint,
}

/// What a shape inherits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    fill: Fill,
    /// The colour that a line is drawn in.
    pub stroke: Option<[u8; 3]>,
    pub rule: FillRule,
    clear: bool,
    visible: bool,
    // By an opacity of zero here or around.
    gone: bool,
    /// Neither it nor what it holds is drawn.
    pub absent: bool,
}

impl Default for Style {
    fn default() -> Self {
        let (fill, rule) = (Fill::Paint, FillRule::NonZero);
        Self { fill, stroke: None, rule, clear: false, visible: true, gone: false, absent: false }
    }
}

const PROPERTIES: [&str; 7] =
    ["fill", "stroke", "fill-rule", "fill-opacity", "opacity", "display", "visibility"];

impl Style {
    /// What is seen of a shape with this style.
    pub fn seen(&self) -> Fill {
        if self.clear || self.gone || !self.visible { Fill::None } else { self.fill }
    }

    /// The style of an element in one of this style; `Err` names a property that cannot be heeded.
    pub fn of(&self, node: Node, sheet: &Sheet) -> Result<Style, String> {
        let mut own = Own { style: *self, opaque: true };
        for name in PROPERTIES {
            if let Some(value) = node.attribute(name) {
                own.set(self, name, value)?;
            }
        }
        let mut rules: Vec<&Rule> = sheet.rules.iter().filter(|r| r.selector.matches(node)).collect();
        rules.sort_by_key(|r| r.selector.weight()); // keeps the order of equals
        for (name, value) in rules.iter().flat_map(|r| declarations(&r.body)) {
            own.set(self, name, value)?;
        }
        for (name, value) in declarations(node.attribute("style").unwrap_or_default()) {
            own.set(self, name, value)?;
        }
        own.style.gone |= !own.opaque;
        Ok(own.style)
    }
}

struct Own {
    style: Style,
    opaque: bool,
}

impl Own {
    /// Values that are not understood are passed over, as in a browser.
    fn set(&mut self, parent: &Style, name: &str, value: &str) -> Result<(), String> {
        let style = &mut self.style;
        let inherit = value == "inherit";
        match name {
            "fill" if inherit => style.fill = parent.fill,
            "fill" => style.fill = fill(value).unwrap_or(style.fill),
            "stroke" if inherit => style.stroke = parent.stroke,
            "stroke" => style.stroke = stroke(value).unwrap_or(style.stroke),
            "fill-rule" => match value {
                "evenodd" => style.rule = FillRule::EvenOdd,
                "nonzero" => style.rule = FillRule::NonZero,
                _ if inherit => style.rule = parent.rule,
                _ => {}
            },
            "fill-opacity" if inherit => style.clear = parent.clear,
            "fill-opacity" => style.clear = clear(value).unwrap_or(style.clear),
            "opacity" => self.opaque = !clear(value).unwrap_or(!self.opaque),
            "display" => style.absent = value == "none",
            "visibility" => match value {
                "visible" => style.visible = true,
                "hidden" | "collapse" => style.visible = false,
                _ if inherit => style.visible = parent.visible,
                _ => {}
            },
            "transform" if value != "none" => {
                return Err("a transform in a style is not read; expected a `transform` attribute".into());
            }
            _ => {}
        }
        Ok(())
    }
}

fn fill(value: &str) -> Option<Fill> {
    if value.starts_with("url(") {
        return Some(Fill::Paint);
    }
    let lower = value.to_ascii_lowercase();
    match Paint::from_str(&lower) {
        Ok(Paint::None) => Some(Fill::None),
        Ok(Paint::Color(c)) if c.alpha == 0 => Some(Fill::None),
        Ok(Paint::Color(c)) if (c.red, c.green, c.blue) == (255, 255, 255) => Some(Fill::White),
        Ok(_) => Some(Fill::Paint),
        Err(_) => (lower == "currentcolor").then_some(Fill::Paint),
    }
}

/// The colour of a line, or that it has none; patterns have none.
fn stroke(value: &str) -> Option<Option<[u8; 3]>> {
    match Paint::from_str(&value.to_ascii_lowercase()) {
        Ok(Paint::Color(c)) => Some(Some([c.red, c.green, c.blue])),
        Ok(_) => Some(None),
        Err(_) => None,
    }
}

/// Whether an opacity, a number or a percentage, lets everything through.
fn clear(value: &str) -> Option<bool> {
    let number: f64 = value.trim_end_matches('%').parse().ok()?;
    Some(number <= 0.0)
}

/// The `name: value` pairs of a style.
fn declarations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split(';').filter_map(|pair| {
        let (name, value) = pair.split_once(':')?;
        let value = value.trim();
        Some((name.trim(), value.strip_suffix("!important").unwrap_or(value).trim_end()))
    })
}

/// The rules of the drawing's style sheets that are understood: those for an element's name, classes and id.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    rules: Vec<Rule>,
}

#[derive(Debug)]
struct Rule {
    selector: Selector,
    body: String,
}

#[derive(Debug, Default)]
struct Selector {
    element: Option<String>,
    id: Option<String>,
    classes: Vec<String>,
}

impl Sheet {
    /// Adds the text of one `style` element.
    pub fn add(&mut self, text: &str) -> Result<(), SketchError> {
        let text = uncommented(text);
        let mut rest = text.as_str();
        while let Some((head, after)) = rest.split_once('{') {
            // At-rules may hold rules; they end with the brace that matches theirs.
            let mut depth = 1_usize;
            let end = after.find(|c| {
                depth = match c {
                    '{' => depth + 1,
                    '}' => depth - 1,
                    _ => depth,
                };
                depth == 0
            });
            let (body, next) = end.map_or((after, ""), |end| (&after[..end], &after[end + 1..]));
            rest = next;
            // `@import …;` and the like have no braces.
            let head = head.rsplit(';').next().unwrap_or_default();
            for selector in head.split(',').filter_map(|s| Selector::new(s.trim())) {
                if self.rules.len() == MOST_RULES {
                    return Err(SketchError::TooIntricate { what: "style rules", most: MOST_RULES });
                }
                // A sheet may hold anything, and each rule keeps its body: nothing near the limit is needed.
                let body = body.chars().take(4096).collect();
                self.rules.push(Rule { selector, body });
            }
        }
        Ok(())
    }
}

fn uncommented(text: &str) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("/*") {
        kept.push_str(before);
        kept.push(' ');
        rest = after.split_once("*/").map_or("", |(_, rest)| rest);
    }
    kept + rest
}

impl Selector {
    fn new(text: &str) -> Option<Self> {
        let name = |c: char| c.is_alphanumeric() || c == '-' || c == '_' || !c.is_ascii();
        if text.is_empty() || !text.chars().all(|c| name(c) || matches!(c, '.' | '#' | '*')) {
            return None;
        }
        let mut selector = Self::default();
        let starts = text.char_indices().map(|(i, c)| (i, !name(c)));
        let mut cuts: Vec<usize> = starts.filter(|(i, cut)| *i == 0 || *cut).map(|(i, _)| i).collect();
        cuts.push(text.len());
        for part in cuts.windows(2).map(|w| &text[w[0]..w[1]]) {
            match part.as_bytes() {
                [b'*'] => {}
                [b'.', _, ..] => selector.classes.push(part[1..].into()),
                [b'#', _, ..] => selector.id = Some(part[1..].into()),
                [b'.' | b'#' | b'*', ..] => return None,
                _ => selector.element = Some(part.into()),
            }
        }
        Some(selector)
    }

    fn matches(&self, node: Node) -> bool {
        let has = |class: &String| classes(node).any(|c| c == class);
        self.element.as_deref().is_none_or(|e| e == node.tag_name().name())
            && self.id.as_deref().is_none_or(|id| node.attribute("id") == Some(id))
            && self.classes.iter().all(has)
    }

    fn weight(&self) -> (bool, usize, bool) {
        (self.id.is_some(), self.classes.len(), self.element.is_some())
    }
}

/// The class tokens of an element.
pub(super) fn classes<'a>(node: Node<'a, '_>) -> impl Iterator<Item = &'a str> {
    node.attribute("class").unwrap_or_default().split_ascii_whitespace()
}
