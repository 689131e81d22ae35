//! `snowglobe crystal` in air of a user's own.

use std::fs;
use std::path::Path;

use ndarray::{Array2, Array3};
use ndarray_npy::read_npy;

use super::{home, refused, snowglobe, text};

fn run(folder: &Path, arguments: &[&str]) {
    let arguments: Vec<&str> = std::iter::once("crystal").chain(arguments.iter().copied()).collect();
    let output = snowglobe(folder, &arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
}

fn summary(home: &Path, out: &str) -> serde_json::Value {
    serde_json::from_slice(&fs::read(home.join(out).join("summary.json")).unwrap()).unwrap()
}

/// Nakaya's diagram at three temperatures, and a column that is brought to -15 C.
#[test]
fn habits_are_those_of_the_air() {
    let home = home();
    for (temperature, habit, flat) in
        [("-15", "dendrite", true), ("-6", "hollow-column", false), ("-2", "plate", true)]
    {
        // Water saturation, nearly.
        let air = ["--temperature", temperature, "--supersaturation", "0", "--over", "water"];
        run(home.path(), &[&air[..], &["--minutes", "10", "--size", "96", "--out", habit]].concat());
        let found = summary(home.path(), habit);
        let [across, high] = ["diameter_mm", "height_mm"].map(|name| found[name].as_f64().unwrap());
        assert_eq!(across > high, flat, "{temperature}: {across} x {high}");
        if temperature != "-6" {
            assert_eq!(found["habit"], habit, "{temperature}");
        }
    }
    let history = "minute,temperature_c,supersaturation_pct\n0,-6,6\n8,-6,6\n8,-15,16\n12,-15,16\n";
    fs::write(home.path().join("h.csv"), history).unwrap();
    run(home.path(), &["--history", "h.csv", "--size", "96", "--out", "capped"]);
    let found = summary(home.path(), "capped");
    assert_eq!(found["minutes"], 12.0);
    assert_eq!(found["habits"].as_array().unwrap().len(), 2);
}

/// Voxels, thickness and summary are of one crystal, which is six-fold: half a turn leaves it as it is.
#[test]
fn all_files_are_of_one_crystal() {
    let home = home();
    let air = ["--temperature", "-15", "--supersaturation", "15", "--minutes", "8", "--size", "200"];
    for (out, threads) in [("a", "1"), ("b", "3")] {
        run(home.path(), &[&air[..], &["--threads", threads, "--out", out]].concat());
    }
    let read = |out: &str, name: &str| fs::read(home.path().join(out).join(name)).unwrap();
    for name in [
        "crystal.png",
        "coloured.png",
        "thickness.npy",
        "voxels.npy",
        "crystal.obj",
        "crystal.ply",
        "crystal.glb",
    ] {
        assert!(read("a", name) == read("b", name), "{name}");
    }
    let found = summary(home.path(), "a");
    let voxels: Array3<f32> = read_npy(home.path().join("a/voxels.npy")).unwrap();
    let [nx, ny, nz] = [0, 1, 2].map(|k| found["voxels"][k].as_u64().unwrap() as usize);
    assert_eq!(voxels.dim(), (nz, ny, nx));
    for ((z, y, x), rho) in voxels.indexed_iter() {
        assert!(*rho == 0.0 || *rho == 1.0);
        assert_eq!(*rho, voxels[(nz - 1 - z, ny - 1 - y, nx - 1 - x)]);
    }
    // Cubes instead of hexagons: the volume is the same but for the rim.
    let cubes = f64::from(voxels.sum()) * 1e-15;
    let mass = found["mass_mg"].as_f64().unwrap() * 1e-6;
    assert!((cubes * 910.0 / mass - 1.0).abs() < 0.1, "{cubes} {mass}");
    let thickness: Array2<f32> = read_npy(home.path().join("a/thickness.npy")).unwrap();
    assert_eq!(thickness.dim(), (200, 200));
    let corners = read("a", "crystal.obj");
    assert!(corners.starts_with(b"v ") && read("a", "crystal.glb").starts_with(b"glTF"));
}

#[test]
fn what_makes_no_sense_is_refused_in_one_line() {
    let home = home();
    fs::write(home.path().join("bad.csv"), "minute,temperature_c\n0,-6\n").unwrap();
    fs::write(home.path().join("back.csv"), "minute,temperature_c,supersaturation_pct\n5,-6,6\n1,-6,6\n")
        .unwrap();
    for (arguments, says) in [
        (&[][..], "--temperature and --supersaturation: are missing"),
        (&["--temperature", "-15"], "--supersaturation"),
        (&["--temperature", "5", "--supersaturation", "5"], "5; -60 to 0 is accepted"),
        (&["--temperature", "-15", "--supersaturation", "5", "--over", "air"], "ice, water are accepted"),
        (&["--temperature", "-15", "--supersaturation", "5", "--minutes", "nan"], "--minutes"),
        (&["--temperature", "-15", "--supersaturation", "5", "--element", "0"], "--element: 0; 2 to 100"),
        (&["--temperature", "-15", "--supersaturation", "5", "--reading", "layers=none"], "dense"),
        (&["--history", "none.csv"], "none.csv: cannot be read"),
        (&["--history", "bad.csv"], "bad.csv: is no history"),
        (&["--history", "back.csv"], "back.csv: a minute of the history is 1; 5 to 1440"),
    ] {
        let arguments: Vec<&str> = std::iter::once("crystal").chain(arguments.iter().copied()).collect();
        refused(home.path(), &arguments, &[says]);
        assert!(!home.path().join("out").exists());
    }
}
