//! `snowglobe automaton` on a state of a user's own.

use std::fs;
use std::path::Path;

use ndarray::Array3;
use ndarray_npy::{read_npy, write_npy};

use super::{home, refused, snowglobe, text};

fn run(folder: &Path, arguments: &[&str]) {
    let arguments: Vec<&str> = std::iter::once("automaton").chain(arguments.iter().copied()).collect();
    let output = snowglobe(folder, &arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
}

/// A lattice of 9 x 7 x 6 full of vapour, one cell active.
fn given(home: &Path, [x, y, z]: [usize; 3]) {
    write_npy(home.join("hum.npy"), &Array3::<u8>::ones((6, 7, 9))).unwrap();
    let mut act = Array3::<u8>::zeros((6, 7, 9));
    act[(z, y, x)] = 1;
    write_npy(home.join("act.npy"), &act).unwrap();
}

/// The stencil, axis by axis: what is active reaches two cells to each side, two up, but one down.
#[test]
fn clouds_climb_two_cells_a_step_and_descend_one() {
    let home = home();
    given(home.path(), [4, 3, 2]);
    run(home.path(), &["--hum", "hum.npy", "--act", "act.npy", "--steps", "2", "--out", "a"]);
    let cld: Array3<u8> = read_npy(home.path().join("a/cld.npy")).unwrap();
    assert_eq!(cld.dim(), (6, 7, 9));
    let column: Vec<u8> = (0..6).map(|z| cld[(z, 3, 4)]).collect();
    assert_eq!(column, [0, 1, 1, 1, 1, 0]);
    let row: Vec<u8> = (0..9).map(|x| cld[(2, 3, x)]).collect();
    assert_eq!(row, [0, 0, 1, 1, 1, 1, 1, 0, 0]);
    assert_eq!(cld.iter().filter(|cld| **cld == 1).count(), 12);
    let cover = fs::read_to_string(home.path().join("a/cover.csv")).unwrap();
    let rows: Vec<&str> = cover.lines().collect();
    assert_eq!((rows.len(), rows[0]), (4, "t,cover"));
    let last: f64 = rows[3].split(',').nth(1).unwrap().parse().unwrap();
    assert!((last - 12.0 / 378.0).abs() < 1e-15);
    let density: Array3<f32> = read_npy(home.path().join("a/density.npy")).unwrap();
    assert_eq!(density.dim(), (6, 7, 9));
    assert!(density[(2, 3, 4)] > density[(5, 0, 0)]);
    assert!(fs::read(home.path().join("a/density.vdb")).unwrap().starts_with(b" BDV"));
    assert!(fs::read(home.path().join("a/density.vti")).unwrap().starts_with(b"<?xml"));
    // As printed a cell must be active already.
    let printed = ["--reading", "activation=as-printed"];
    let more = ["--hum", "hum.npy", "--act", "act.npy", "--steps", "2", "--out", "b"];
    run(home.path(), &[&more[..], &printed].concat());
    let cld: Array3<u8> = read_npy(home.path().join("b/cld.npy")).unwrap();
    assert_eq!(cld.iter().filter(|cld| **cld == 1).count(), 1);
}

#[test]
fn the_same_seed_is_the_same_sky_on_any_number_of_threads() {
    let home = home();
    let points = "step,x,y,z,p_hum,p_act,p_ext\n0,8,8,4,0.1,0.01,0.001\n0,60,20,4,0,0,0.1\n\
                  20,40,8,4,0.1,0.01,0.001\n20,60,20,4,0,0,0.1\n";
    fs::write(home.path().join("points.csv"), points).unwrap();
    for (out, threads, seed) in [("a", "1", "5"), ("b", "3", "5"), ("c", "2", "6")] {
        let common = ["--size", "70,30,20", "--steps", "20", "--points", "points.csv", "--t-ext", "3"];
        run(home.path(), &[&common[..], &["--threads", threads, "--seed", seed, "--out", out]].concat());
    }
    let read = |out: &str, name: &str| fs::read(home.path().join(out).join(name)).unwrap();
    for name in ["cld.npy", "cover.csv", "density.npy", "density.vdb", "density.vti", "summary.json"] {
        assert!(read("a", name) == read("b", name), "{name}");
    }
    for name in ["cloud.png", "animation.png"] {
        assert!(read("a", name) == read("b", name), "{name}");
    }
    let still = snowglobe::image::decode(&read("a", "cloud.png")).unwrap();
    assert_eq!([still.width, still.height], [640, 360]);
    assert!(read("a", "cld.npy") != read("c", "cld.npy"));
    let cld: Array3<u8> = read_npy(home.path().join("a/cld.npy")).unwrap();
    assert!(cld.iter().any(|cld| *cld == 1));
}

/// Frames as far apart as may be, the first and the last step among them; none where none are asked for.
#[test]
fn a_film_has_the_frames_that_were_asked_for() {
    let home = home();
    given(home.path(), [4, 3, 2]);
    for (steps, asked, frames) in
        [("7", "3", Some(3)), ("2", "9", Some(3)), ("0", "1", Some(1)), ("3", "0", None)]
    {
        let out = format!("{steps}-{asked}");
        let state =
            ["--hum", "hum.npy", "--act", "act.npy", "--steps", steps, "--frames", asked, "--out", &out];
        run(home.path(), &state);
        let film = home.path().join(out).join("animation.png");
        if asked == "0" {
            assert!(!film.exists());
            continue;
        }
        let bytes = fs::read(film).unwrap();
        // The chunk acTL says how many frames there are.
        let found = bytes
            .windows(4)
            .position(|chunk| chunk == b"acTL")
            .map(|at| u32::from_be_bytes(bytes[at + 4..at + 8].try_into().unwrap()));
        assert_eq!(found, frames, "{steps} steps, {asked} frames");
    }
}

#[test]
fn what_makes_no_sense_is_refused_in_one_line() {
    let home = home();
    given(home.path(), [0, 0, 0]);
    write_npy(home.path().join("two.npy"), &Array3::<u8>::from_elem((6, 7, 9), 2)).unwrap();
    write_npy(home.path().join("flat.npy"), &Array3::<u8>::zeros((1, 7, 9))).unwrap();
    fs::write(home.path().join("points.csv"), "step,x,y,z,p_hum,p_act,p_ext\n0,1,1,1,7,0,0\n").unwrap();
    for (arguments, says) in [
        (vec!["--steps", "1"], "--size"),
        (vec!["--steps", "1", "--size", "0,1,1"], "0 x 1 x 1"),
        (vec!["--steps", "1", "--size", "99999,99999,99999"], "99999"),
        (vec!["--steps", "1", "--size", "4,4,4", "--p-ext", "1.5"], "--p-ext"),
        (vec!["--steps", "1", "--size", "4,4,4", "--reading", "as-printed"], "more than one"),
        (vec!["--steps", "1", "--size", "4,4,4", "--points", "points.csv"], "p_hum is 7"),
        (vec!["--steps", "1", "--hum", "two.npy", "--act", "act.npy"], "is 2; 0 and 1"),
        (vec!["--steps", "1", "--hum", "hum.npy", "--act", "flat.npy"], "shape"),
        (vec!["--steps", "1", "--hum", "hum.npy", "--act", "points.csv"], "points.csv"),
    ] {
        let arguments: Vec<&str> = std::iter::once("automaton").chain(arguments).collect();
        refused(home.path(), &arguments, &[says]);
    }
    assert!(!home.path().join("out").exists());
}
