//! `snowglobe contour-cloud` on contours of a user's own.

use std::fs;
use std::path::Path;

use ndarray::Array2;

use super::{home, refused, snowglobe, text};

/// A square frame of 8 at level 0, and one of 4 within it at level 2, as an SVG.
fn hill(attributes: [&str; 2]) -> String {
    let [low, high] = attributes;
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 8 8'><path {low} d='M0 0H8V8H0Z'/>\
         <path {high} d='M2 2H6V6H2Z'/></svg>"
    )
}

fn run(folder: &Path, arguments: &[&str]) {
    let arguments: Vec<&str> = std::iter::once("contour-cloud").chain(arguments.iter().copied()).collect();
    let output = snowglobe(folder, &arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
}

fn heights(path: &Path) -> Array2<f64> {
    ndarray_npy::read_npy(path).unwrap()
}

/// Without displacement the surface is the frustum that the contours are of, whether levels are attributes or colours.
#[test]
fn heights_are_those_of_the_contours() {
    let home = home();
    fs::write(home.path().join("levels.svg"), hill(["data-level='0'", "data-level='2'"])).unwrap();
    fs::write(home.path().join("colours.svg"), hill(["stroke='#0000ff'", "stroke='#ff0000'"])).unwrap();
    let common = ["--gain", "0", "--rewrites", "3", "--reading", "plateau=as-printed", "--size", "64x64"];
    run(home.path(), &[&["--contours", "levels.svg", "--out", "a"][..], &common].concat());
    let table = ["--contours", "colours.svg", "--colours", "#0000ff=0,#ff0000=2", "--out", "b"];
    run(home.path(), &[&table[..], &common].concat());
    let all = heights(&home.path().join("a/height.npy"));
    assert_eq!(all.dim(), (9, 9));
    for ((row, column), height) in all.indexed_iter() {
        let inwards = row.min(column).min(8 - row).min(8 - column).min(2);
        assert!((height - inwards as f64).abs() < 1e-12, "{row} {column}: {height}");
    }
    assert_eq!(all, heights(&home.path().join("b/height.npy")));
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(home.path().join("a/summary.json")).unwrap()).unwrap();
    assert_eq!((summary["flat_triangles"].as_u64(), summary["gamma"].as_f64()), (Some(2), Some(1.0)));
    for name in ["cloud.png", "mountain.png", "composite.png", "height.png"] {
        assert!(fs::read(home.path().join("a").join(name)).unwrap().starts_with(b"\x89PNG"), "{name}");
    }
    assert!(fs::read(home.path().join("a/surface.glb")).unwrap().starts_with(b"glTF"));
    assert!(fs::read(home.path().join("a/surface.ply")).unwrap().starts_with(b"ply\n"));
}

/// Row 0 is the top: the least y of a drawing, the north of a map. Outside of the contours there is no height.
#[test]
fn the_first_row_is_the_top_and_outside_is_no_number() {
    let home = home();
    let svg = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 4 4'><path data-level='1' d='M0 0H4'/>\
               <path data-level='3' d='M0 4L2 4'/></svg>";
    fs::write(home.path().join("c.svg"), svg).unwrap();
    let map = r#"{"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"level": 1},
         "geometry": {"type": "LineString", "coordinates": [[0, 4], [4, 4]]}},
        {"type": "Feature", "properties": {"elevation": 3},
         "geometry": {"type": "LineString", "coordinates": [[0, 0], [2, 0]]}}]}"#;
    fs::write(home.path().join("c.geojson"), map).unwrap();
    for (file, out) in [("c.svg", "a"), ("c.geojson", "b")] {
        run(
            home.path(),
            &["--contours", file, "--gain", "0", "--grid", "5x5", "--size", "32x32", "--out", out],
        );
        let all = heights(&home.path().join(out).join("height.npy"));
        assert_eq!(all.row(0).to_vec(), [1.0; 5], "{file}");
        assert_eq!(all.row(4).iter().filter(|height| height.is_nan()).count(), 2, "{file}");
        assert_eq!((all[(4, 0)], all[(2, 1)]), (3.0, 2.0), "{file}");
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
    let home = home();
    fs::write(home.path().join("c.svg"), hill(["data-level='0'", "data-level='2'"])).unwrap();
    for (out, threads, seed) in [("a", "1", "5"), ("b", "3", "5"), ("c", "3", "6")] {
        let more = ["--size", "96x96", "--smooth", "--out", out, "--threads", threads, "--seed", seed];
        run(home.path(), &[&["--contours", "c.svg", "--dimension", "2.4"][..], &more].concat());
    }
    let read = |out: &str, name: &str| fs::read(home.path().join(out).join(name)).unwrap();
    for name in [
        "height.npy",
        "height.png",
        "surface.ply",
        "surface.glb",
        "cloud.png",
        "mountain.png",
        "summary.json",
    ] {
        assert!(read("a", name) == read("b", name), "{name}");
    }
    assert!(read("a", "height.npy") != read("c", "height.npy"), "another seed is another cloud");
}

/// A coast whose polygon would cross itself at the distance that is asked is drawn finer.
#[test]
fn a_real_coast_is_taken_at_any_tolerance() {
    let home = home();
    let coasts = super::ours("experiments/data/coasts.geojson");
    let narrow = ["--tolerance", "0.3", "--rewrites", "2", "--size", "48x32", "--out", "a"];
    run(home.path(), &[&["--contours", &coasts][..], &narrow].concat());
    assert!(home.path().join("a/summary.json").is_file());
}

#[test]
fn what_makes_no_sense_is_refused_in_one_line() {
    let home = home();
    let write = |name: &str, body: &str| {
        let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 8 8'>{body}</svg>");
        fs::write(home.path().join(name), svg).unwrap();
    };
    write("good.svg", "<path data-level='0' d='M0 0H8V8H0Z'/>");
    write("bare.svg", "<path id='rim' d='M0 0H8V8H0Z'/>");
    write("word.svg", "<path data-level='high' d='M0 0H8V8H0Z'/>");
    write(
        "cross.svg",
        "<path id='p' data-level='0' d='M0 0L8 8'/><path id='q' data-level='1' d='M0 8L8 0'/>",
    );
    write(
        "touch.svg",
        "<path id='p' data-level='0' d='M0 0H8V8H0Z'/><path id='q' data-level='1' d='M0 0L4 4L8 7'/>",
    );
    write("line.svg", "<path data-level='0' d='M0 0H8'/>");
    write("empty.svg", "");
    fs::write(home.path().join("c.txt"), "").unwrap();
    fs::write(home.path().join("c.geojson"), r#"{"type": "Point"}"#).unwrap();
    for (arguments, words) in [
        (&["--contours", "none.svg"][..], &["none.svg", "cannot read"][..]),
        (&["--contours", "c.txt"], &["c.txt", ".svg", ".geojson"]),
        (&["--contours", "c.geojson"], &["c.geojson", "Point", "Feature"]),
        (&["--contours", "bare.svg"], &["bare.svg", "path", "data-level"]),
        (&["--contours", "word.svg"], &["word.svg", "high"]),
        (&["--contours", "cross.svg"], &["cross.svg", "p", "q", "crosses"]),
        (&["--contours", "touch.svg"], &["touch.svg", "q", "p"]),
        (&["--contours", "line.svg"], &["line.svg", "no area"]),
        (&["--contours", "empty.svg"], &["empty.svg"]),
        (&["--contours", "good.svg", "--dimension", "1.4"], &["--dimension", "2 to 3"]),
        (&["--contours", "good.svg", "--rewrites", "15"], &["--rewrites", "0 to 14"]),
        (&["--contours", "good.svg", "--grid", "1x9"], &["--grid", "2 to 32768"]),
        (&["--contours", "good.svg", "--grid", "30000x30000"], &["--grid", "in all"]),
        (&["--contours", "good.svg", "--size", "9x9"], &["--size", "16 to 8192"]),
        (&["--contours", "good.svg", "--gamma", "-1"], &["--gamma"]),
        (&["--contours", "good.svg", "--gain", "nan"], &["--gain"]),
        (&["--contours", "good.svg", "--plane", "1,0,0,0"], &["--plane", "upright"]),
        (&["--contours", "good.svg", "--waves", "1,2,3"], &["--waves", "four numbers"]),
        (&["--contours", "good.svg", "--colours", "red=1"], &["--colours", "#rrggbb=LEVEL"]),
        (&["--contours", "good.svg", "--reading", "amplitude=x"], &["--reading", "three-minus-d"]),
        (&["--contours", "good.svg", "--background", "c.txt"], &["c.txt"]),
    ] {
        let arguments: Vec<&str> =
            std::iter::once("contour-cloud").chain(arguments.iter().copied()).collect();
        refused(home.path(), &arguments, words);
    }
    assert!(!home.path().join("out").exists(), "a refusal leaves nothing behind");
}
