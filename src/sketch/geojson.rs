//! Lines with a level each, from GeoJSON (RFC 7946).

use serde_json::Value;

use super::{FURTHEST, Line, MOST_BYTES, MOST_SEGMENTS, SketchError, one_line};

/// Names under which a feature's level is looked for, in this order.
const LEVELS: [&str; 4] = ["level", "elevation", "elev", "ele"];

/// Reads the lines of a GeoJSON file: features, or a collection of them, of type `LineString`, `MultiLineString`,
/// `Polygon` or `MultiPolygon`, each with a number `level` (or `elevation`, `elev`, `ele`) among its properties.
///
/// Coordinates are taken as they are, without a projection, but for y, which points down in a [`Line`] and is negated.
/// Rings of polygons are closed; so is a line that ends where it began. A third coordinate is passed over. Points and
/// features without a geometry are refused by name.
///
/// # Errors
/// A file that is too large or no GeoJSON; a feature without a level, of another type, or with coordinates that are no
/// numbers up to [`FURTHEST`]; no lines at all.
pub fn read_geojson_lines(bytes: &[u8]) -> Result<Vec<Line>, SketchError> {
    if bytes.len() > MOST_BYTES {
        return Err(SketchError::TooIntricate { what: "bytes", most: MOST_BYTES });
    }
    let refuse = |what: String| SketchError::GeoJson { place: "the file".into(), what };
    let file: Value = serde_json::from_slice(bytes)
        .map_err(|e| refuse(format!("{}; expected GeoJSON in UTF-8", one_line(e))))?;
    let kind = file.get("type").and_then(Value::as_str).unwrap_or_default();
    let features: Vec<&Value> = match kind {
        "FeatureCollection" => file.get("features").and_then(Value::as_array).into_iter().flatten().collect(),
        "Feature" => vec![&file],
        other => {
            let what = format!("its `type` is `{}`; expected Feature or FeatureCollection", one_line(other));
            return Err(refuse(what));
        }
    };
    let mut lines = Vec::new();
    let mut points = 0;
    for (number, feature) in features.into_iter().enumerate() {
        let before = lines.len();
        read_feature(feature, number + 1, &mut lines)?;
        points += lines[before..].iter().map(|line: &Line| line.points.len()).sum::<usize>();
        if points > MOST_SEGMENTS {
            return Err(SketchError::TooIntricate { what: "points", most: MOST_SEGMENTS });
        }
    }
    if lines.is_empty() {
        return Err(refuse("it has no lines; expected at least one feature with a geometry".into()));
    }
    Ok(lines)
}

fn read_feature(feature: &Value, number: usize, lines: &mut Vec<Line>) -> Result<(), SketchError> {
    let properties = feature.get("properties");
    let text = |value: &Value| match value {
        Value::String(text) => Some(one_line(text)),
        Value::Number(number) => Some(number.to_string()),
        _ => None,
    };
    let id = feature.get("id").or_else(|| properties?.get("name")).and_then(text);
    let name = id.map_or_else(|| format!("feature {number}"), |id| format!("feature {number} ({id})"));
    let refuse = |what: String| SketchError::GeoJson { place: name.clone(), what };
    let level = LEVELS.iter().find_map(|key| properties?.get(key));
    let level = match level.map(Value::as_f64) {
        Some(Some(level)) if level.abs() <= FURTHEST => level,
        Some(_) => return Err(refuse(format!("its level is no number up to {FURTHEST}"))),
        None => {
            let names = LEVELS.join("`, `");
            return Err(refuse(format!(
                "no level; expected a number among its properties, one of `{names}`"
            )));
        }
    };
    let geometry = feature.get("geometry");
    let kind = geometry.and_then(|g| g.get("type")).and_then(Value::as_str).unwrap_or("null");
    let coordinates = geometry.and_then(|g| g.get("coordinates")).unwrap_or(&Value::Null);
    let list = |value: &'_ Value| -> Result<Vec<Value>, SketchError> {
        value
            .as_array()
            .cloned()
            .ok_or_else(|| refuse("its coordinates are no list of the expected depth".into()))
    };
    let (parts, rings) = match kind {
        "LineString" => (vec![coordinates.clone()], false),
        "MultiLineString" => (list(coordinates)?, false),
        "Polygon" => (list(coordinates)?, true),
        "MultiPolygon" => {
            let mut all = Vec::new();
            for polygon in list(coordinates)? {
                all.extend(list(&polygon)?);
            }
            (all, true)
        }
        other => {
            let what = format!(
                "its geometry is `{}`; expected LineString, MultiLineString, Polygon or MultiPolygon",
                one_line(other)
            );
            return Err(refuse(what));
        }
    };
    let several = parts.len() > 1;
    for (k, part) in parts.iter().enumerate() {
        let mut points: Vec<[f64; 2]> = Vec::new();
        for place in list(part)? {
            let at = |axis: usize| place.get(axis).and_then(Value::as_f64).filter(|v| v.abs() <= FURTHEST);
            let (Some(x), Some(y)) = (at(0), at(1)) else {
                return Err(refuse(format!("a coordinate is no pair of numbers up to {FURTHEST}")));
            };
            let place = [x, 0.0 - y];
            if points.last() != Some(&place) {
                points.push(place);
            }
        }
        let back = points.len() > 3 && points.first() == points.last();
        if points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        let part = if several { format!(", part {}", k + 1) } else { String::new() };
        lines.push(Line { name: format!("{name}{part}"), level, points, closed: back || rings });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_rings_are_read() {
        let file = r#"{"type":"FeatureCollection","features":[
            {"type":"Feature","properties":{"level":2,"name":"lake"},"geometry":{"type":"Polygon","coordinates":
                [[[0,0],[4,0],[4,3,9],[0,0]],[[1,0.5],[2,0.5],[2,1],[1,0.5]]]}},
            {"type":"Feature","id":7,"properties":{"elevation":-0.5},"geometry":{"type":"LineString","coordinates":
                [[0,1],[1,1],[1,1],[2,5]]}}]}"#;
        let lines = read_geojson_lines(file.as_bytes()).unwrap();
        let seen: Vec<(&str, f64, usize, bool)> =
            lines.iter().map(|l| (l.name.as_str(), l.level, l.points.len(), l.closed)).collect();
        assert_eq!(
            seen,
            [
                ("feature 1 (lake), part 1", 2.0, 3, true),
                ("feature 1 (lake), part 2", 2.0, 3, true),
                ("feature 2 (7)", -0.5, 3, false),
            ]
        );
        assert_eq!(lines[0].points, [[0.0, 0.0], [4.0, 0.0], [4.0, -3.0]]);
        assert_eq!(lines[2].points, [[0.0, -1.0], [1.0, -1.0], [2.0, -5.0]]);
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        let says = |text: &str| read_geojson_lines(text.as_bytes()).unwrap_err().to_string();
        assert!(says("{").starts_with("the file: "));
        assert!(says(r#"{"type":"Topology"}"#).contains("`Topology`; expected Feature"));
        assert!(says(r#"{"type":"FeatureCollection","features":[]}"#).contains("no lines"));
        let feature = |properties: &str, geometry: &str| {
            says(&format!(r#"{{"type":"Feature","properties":{properties},"geometry":{geometry}}}"#))
        };
        assert!(feature("{}", "null").starts_with("feature 1: no level"));
        assert!(feature(r#"{"level":"high"}"#, "null").contains("its level is no number"));
        assert!(feature(r#"{"level":1}"#, "null").contains("its geometry is `null`"));
        let bad = r#"{"type":"LineString","coordinates":[[0,0],["a",1]]}"#;
        assert!(feature(r#"{"level":1}"#, bad).contains("no pair of numbers"));
        let flat = r#"{"type":"Polygon","coordinates":[[0,0],[1,1]]}"#;
        assert!(feature(r#"{"level":1}"#, flat).contains("no pair of numbers"));
        let none = r#"{"type":"MultiPolygon","coordinates":[3]}"#;
        assert!(feature(r#"{"level":1}"#, none).contains("no list of the expected depth"));
    }

    /// Deep nesting ends in an error, not in the end of the stack.
    #[test]
    fn deep_nesting_is_refused() {
        assert!(read_geojson_lines("[".repeat(1_000_000).as_bytes()).is_err());
    }
}
