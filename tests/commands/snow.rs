//! `snowglobe snow` before a picture of a user's own.

use std::fs;
use std::path::Path;

use ndarray::{Array2, Array3};
use ndarray_npy::read_npy;
use snowglobe::image::{Picture, encode, srgb_decode};

use super::{columns, home, refused, snowglobe, text};

/// Small, with few crystals to join: large elements are not for the command to choose.
const SMALL: [&str; 6] = ["--size", "64x48", "--flakes", "60", "--spp", "4"];

fn run(folder: &Path, arguments: &[&str]) {
    let arguments: Vec<&str> =
        std::iter::once("snow").chain(SMALL).chain(arguments.iter().copied()).collect();
    let output = snowglobe(folder, &arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
}

/// A table as numbers.
fn rows(path: &Path) -> Vec<Vec<f64>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let number = |text: &str| text.parse().unwrap();
    reader.records().map(|row| row.unwrap().iter().map(number).collect()).collect()
}

#[test]
fn all_files_are_of_one_snowfall() {
    let home = home();
    run(home.path(), &["--veil", "40", "--threads", "1", "--out", "a"]);
    run(home.path(), &["--veil", "40", "--threads", "3", "--out", "b"]);
    let [a, b] = ["a", "b"].map(|out| home.path().join(out));
    for name in ["snow.png", "radiance.npy", "coverage.npy", "flakes.csv", "veil.csv", "templates.csv"] {
        assert!(fs::read(a.join(name)).unwrap() == fs::read(b.join(name)).unwrap(), "{name}");
    }
    let summary: serde_json::Value =
        serde_json::from_slice(&fs::read(a.join("summary.json")).unwrap()).unwrap();
    assert_eq!(columns(&a.join("flakes.csv")), "frame,id,template,x,y,z,qw,qx,qy,qz,vx,vy,vz,diameter_mm");
    let flakes = rows(&a.join("flakes.csv"));
    assert_eq!((flakes.len(), rows(&a.join("veil.csv")).len()), (60, 40));
    let [near, far] = ["nearest_m", "farthest_m"].map(|name| summary[name].as_f64().unwrap());
    let templates = rows(&a.join("templates.csv"));
    for flake in &flakes {
        let turn: f64 = flake[6..10].iter().map(|q| q * q).sum();
        assert!((turn - 1.0).abs() < 1e-12);
        assert!(-flake[5] >= near && -flake[5] <= far, "{flake:?}");
        // Downwards, as fast as flakes are observed to fall, and gusts.
        assert!(flake[11] < -0.4 && flake[11] > -1.8, "{flake:?}");
        let template = templates.iter().find(|row| row[0] == flake[2]).unwrap();
        assert!(flake[13] / template[1] > 0.2 && flake[13] / template[1] < 5.0);
        assert!(a.join(format!("crystal-{}.ply", template[4])).is_file());
    }
    let radiance: Array3<f32> = read_npy(a.join("radiance.npy")).unwrap();
    let coverage: Array2<f32> = read_npy(a.join("coverage.npy")).unwrap();
    assert_eq!((radiance.dim(), coverage.dim()), ((48, 64, 3), (48, 64)));
    assert!(coverage.iter().all(|share| (0.0..=1.0).contains(share)));
    assert_eq!(summary["visible"], 100, "the veil is seen, too");
}

/// Where no flake is, the picture behind is seen as it is; flakes are as white as they are asked to be.
#[test]
fn it_snows_before_a_picture_of_ones_own() {
    let home = home();
    let night = Picture::new(64, 48, [20, 30, 50]).unwrap();
    fs::write(home.path().join("night.png"), encode(&night)).unwrap();
    run(home.path(), &["--background", "night.png", "--white", "0.8", "--out", "o"]);
    let radiance: Array3<f32> = read_npy(home.path().join("o/radiance.npy")).unwrap();
    let coverage: Array2<f32> = read_npy(home.path().join("o/coverage.npy")).unwrap();
    let behind = [20, 30, 50].map(|code| srgb_decode(f64::from(code) / 255.0));
    let (mut light, mut covered) = (0.0, 0.0);
    for ((y, x), share) in coverage.indexed_iter() {
        let pixel = [0, 1, 2].map(|c| f64::from(radiance[(y, x, c)]));
        if *share == 0.0 {
            assert!((0..3).all(|c| (pixel[c] - behind[c]).abs() < 1e-7), "{pixel:?}");
        }
        light += pixel[1] - (1.0 - f64::from(*share)) * behind[1];
        covered += f64::from(*share);
    }
    // Sizes and turns are others than those that the light was set by.
    assert!((light / covered / 0.8 - 1.0).abs() < 0.1, "{}", light / covered);
    let none = ["snow", "--flakes", "0", "--size", "64x48", "--background", "night.png", "--out", "none"];
    assert!(snowglobe(home.path(), &none).status.success());
    let empty: Array2<f32> = read_npy(home.path().join("none/coverage.npy")).unwrap();
    assert!(empty.iter().all(|share| *share == 0.0));
}

#[test]
fn what_makes_no_sense_is_refused_in_one_line() {
    let home = home();
    fs::write(home.path().join("bad.png"), "no picture").unwrap();
    for (arguments, words) in [
        (&["--size", "8x8"][..], &["--size", "16 to 4096"][..]),
        (&["--flakes", "-1"], &["--flakes"]),
        (&["--spp", "0"], &["--spp", "1 to 4096"]),
        (&["--temperature", "5"], &["--temperature", "-30 to -1"]),
        (&["--supersaturation", "-3"], &["--supersaturation"]),
        (&["--over", "snow"], &["--over", "ice, water"]),
        (&["--rate", "nan"], &["--rate"]),
        (&["--focus", "0.01"], &["--focus"]),
        (&["--wind", "1,2"], &["--wind", "X,Y,Z"]),
        (&["--reading", "magic"], &["one-by-one"]),
        (&["--background", "none.png"], &["none.png"]),
        (&["--background", "bad.png"], &["bad.png"]),
    ] {
        let arguments: Vec<&str> = std::iter::once("snow").chain(arguments.iter().copied()).collect();
        refused(home.path(), &arguments, words);
    }
    assert!(!home.path().join("out").exists());
}
