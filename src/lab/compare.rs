//! Comparing two files: the same bytes, the same up to rounding, or changed.

use super::record::{RUN, Record};
use super::table::Table;
use crate::image;

/// How far two results agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The same bytes; for a picture the same pixels.
    Identical,
    /// Integers, words and verdicts the same, floats within 1e-9 relative or 1e-12 absolute, pixels within 2/255.
    Equal,
    /// Anything else.
    Changed,
}

impl Level {
    /// `identical`, `equal` or `changed`.
    pub fn name(self) -> &'static str {
        match self {
            Level::Identical => "identical",
            Level::Equal => "equal",
            Level::Changed => "changed",
        }
    }
}

const RELATIVE: f64 = 1e-9;
const ABSOLUTE: f64 = 1e-12;
const PIXEL: u8 = 2;

/// Compares two files of one name; the text says where they differ.
pub fn compare_files(name: &str, old: &[u8], new: &[u8]) -> (Level, String) {
    if old == new {
        return (Level::Identical, String::new());
    }
    let difference = if name.ends_with(".png") {
        return compare_pictures(old, new);
    } else if name == RUN {
        compare_records(old, new)
    } else if name.ends_with(".csv") {
        compare_tables(old, new)
    } else {
        match (std::str::from_utf8(old), std::str::from_utf8(new)) {
            (Ok(old), Ok(new)) => compare_texts(old, new),
            _ => Some("the bytes differ".to_owned()),
        }
    };
    match difference {
        None => (Level::Equal, "within rounding".to_owned()),
        Some(where_) => (Level::Changed, where_),
    }
}

fn compare_pictures(old: &[u8], new: &[u8]) -> (Level, String) {
    match image::largest_difference(old, new) {
        Ok(Some(0)) if image::pixel_digest(old).ok() == image::pixel_digest(new).ok() => {
            (Level::Identical, String::new())
        }
        Ok(Some(most)) if most <= PIXEL => (Level::Equal, format!("pixels differ by at most {most}/255")),
        Ok(Some(most)) => (Level::Changed, format!("pixels differ by up to {most}/255")),
        Ok(None) => (Level::Changed, "the size differs".to_owned()),
        Err(cause) => (Level::Changed, format!("not a readable picture: {cause}")),
    }
}

/// Digests and vital signs may differ as far as the files themselves may, which are compared on their own.
fn compare_records(old: &[u8], new: &[u8]) -> Option<String> {
    let parse = |bytes: &[u8]| toml::from_str::<Record>(&String::from_utf8_lossy(bytes));
    let (Ok(mut old), Ok(mut new)) = (parse(old), parse(new)) else { return Some("not a record".to_owned()) };
    for record in [&mut old, &mut new] {
        for kept in &mut record.artifacts {
            kept.digest.clear();
            kept.vitals = None;
        }
    }
    if old == new {
        return None;
    }
    let what = if old.claims != new.claims {
        let moved = new.claims.iter().find(|claim| !old.claims.contains(claim)).or(old.claims.first());
        format!("expectation, tolerance or reason of {}", moved.map_or("a claim", |claim| &claim.id))
    } else if old.assumptions != new.assumptions || old.printed != new.printed {
        "a number that goes in".to_owned()
    } else if old.work != new.work {
        format!("work done: {:?} -> {:?}", old.work, new.work)
    } else {
        "the list of files, the seed or the scale".to_owned()
    };
    Some(what)
}

fn compare_tables(old: &[u8], new: &[u8]) -> Option<String> {
    let (Ok(old), Ok(new)) = (Table::from_csv(old), Table::from_csv(new)) else {
        return Some("not a table".to_owned());
    };
    if old.columns != new.columns {
        return Some(format!("columns {} -> {}", old.columns.join(","), new.columns.join(",")));
    }
    if old.rows.len() != new.rows.len() {
        return Some(format!("{} rows -> {}", old.rows.len(), new.rows.len()));
    }
    for (i, (was, is)) in old.rows.iter().zip(&new.rows).enumerate() {
        for (column, (was, is)) in old.columns.iter().zip(was.iter().zip(is)) {
            if !same_word(was, is) {
                return Some(format!("row {}, {column}: {was} -> {is}", i + 1));
            }
        }
    }
    None
}

/// Words the same, numbers within rounding: for drawings and other text.
fn compare_texts(old: &str, new: &str) -> Option<String> {
    let (old, new) = (words(old), words(new));
    if old.len() != new.len() {
        return Some("the text differs".to_owned());
    }
    old.iter().zip(&new).find(|(was, is)| !same_word(was, is)).map(|(was, is)| format!("{was} -> {is}"))
}

/// Numbers, names (a colour is one) and single signs.
fn words(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut rest = text.trim_start();
    while !rest.is_empty() {
        let length = word_length(rest);
        words.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    words
}

fn word_length(text: &str) -> usize {
    let run = |from: usize, is: fn(&u8) -> bool| {
        from + text.as_bytes()[from..].iter().take_while(|b| is(b)).count()
    };
    let signed = usize::from(text.starts_with(['+', '-']));
    let whole = run(signed, u8::is_ascii_digit);
    let point = usize::from(text[whole..].starts_with('.'));
    let mantissa = run(whole + point, u8::is_ascii_digit);
    if mantissa > signed + point {
        let exponent = usize::from(text[mantissa..].starts_with(['e', 'E']));
        let sign = usize::from(exponent == 1 && text[mantissa + 1..].starts_with(['+', '-']));
        let end = run(mantissa + exponent + sign, u8::is_ascii_digit);
        return if end > mantissa + exponent + sign { end } else { mantissa };
    }
    let name = run(usize::from(text.starts_with('#')), u8::is_ascii_alphanumeric);
    if text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        run(0, u8::is_ascii_alphabetic)
    } else if text.starts_with('#') && name > 1 {
        name
    } else {
        text.chars().next().map_or(0, char::len_utf8)
    }
}

/// Integers and words must be the same; numbers with a fraction may differ by rounding.
fn same_word(was: &str, is: &str) -> bool {
    if was == is {
        return true;
    }
    let whole = |text: &str| text.parse::<i128>().is_ok();
    match (was.parse::<f64>(), is.parse::<f64>()) {
        (Ok(a), Ok(b)) if !(whole(was) && whole(is)) => same_number(a, b),
        _ => false,
    }
}

/// Whether two floats agree within rounding.
pub fn same_number(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= ABSOLUTE || (a - b).abs() <= RELATIVE * a.abs().max(b.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(name: &str, old: &str, new: &str) -> Level {
        compare_files(name, old.as_bytes(), new.as_bytes()).0
    }

    #[test]
    fn what_is_no_text_is_identical_or_changed() {
        let (old, new) = ([0xff, 0x00, 0x31], [0xff, 0xfe, 0x31]);
        assert_eq!(compare_files("a.zip", &old, &old).0, Level::Identical);
        assert_eq!(compare_files("a.zip", &old, &new).0, Level::Changed);
    }

    #[test]
    fn three_levels_of_a_table() {
        let old = "a,b\n1,0.30000000000000004\n";
        assert_eq!(level("t.csv", old, old), Level::Identical);
        assert_eq!(level("t.csv", old, "a,b\n1,0.3\n"), Level::Equal);
        assert_eq!(level("t.csv", old, "a,b\n1,0.3001\n"), Level::Changed);
        assert_eq!(level("t.csv", old, "a,b\n2,0.3\n"), Level::Changed);
        assert_eq!(level("t.csv", old, "a,c\n1,0.3\n"), Level::Changed);
        assert_eq!(level("t.csv", old, "a,b\n"), Level::Changed);
    }

    #[test]
    fn large_whole_numbers_must_be_the_same() {
        assert_eq!(level("t.csv", "n\n3980613000\n", "n\n3980613001\n"), Level::Changed);
    }

    #[test]
    fn a_drawing_may_differ_by_rounding_only() {
        let old = "<svg><path d=\"M0.1,0.2\" fill=\"#0072B2\"/></svg>";
        assert_eq!(level("a.svg", old, &old.replace("0.1", "0.10000000000000001")), Level::Equal);
        assert_eq!(level("a.svg", old, &old.replace("0.1", "0.2")), Level::Changed);
        assert_eq!(level("a.svg", old, &old.replace("B2", "B3")), Level::Changed);
    }

    #[test]
    fn a_change_of_tolerance_is_a_change() {
        let old = "seed = 1\nscale = \"paper\"\n[[claim]]\nid = \"a/b/c\"\nexpected = \"1\"\nstatistic = \"each\"\n\
                   tolerance = 4.0\nreason = \"r\"\n[[artifact]]\nfile = \"x.csv\"\ndigest = \"d\"\ncaption = \"c\"\n";
        assert_eq!(level(RUN, old, &old.replace("\"d\"", "\"e\"")), Level::Equal);
        assert_eq!(level(RUN, old, &old.replace("4.0", "5.0")), Level::Changed);
        assert_eq!(level(RUN, old, &old.replace("\"r\"", "\"s\"")), Level::Changed);
    }
}
