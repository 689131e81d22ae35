//! `snowglobe volume` on a density of a user's own.

use std::fs;
use std::path::Path;

use ndarray::{Array2, Array3};
use ndarray_npy::{read_npy, write_npy};

use super::{home, refused, snowglobe, text};

fn run(folder: &Path, arguments: &[&str]) {
    let arguments: Vec<&str> =
        ["volume", "--density", "f.npy"].into_iter().chain(arguments.iter().copied()).collect();
    let output = snowglobe(folder, &arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
}

/// A field of 5 x 4 x 3 in which no two columns are alike.
fn field(home: &Path) -> Array3<f32> {
    let field = Array3::from_shape_fn((3, 4, 5), |(z, y, x)| (1 + x + 5 * y * y + 3 * z * x) as f32 / 10.0);
    write_npy(home.join("f.npy"), &field).unwrap();
    field
}

/// Along an axis, a pixel to a column of voxels: what is left is the exponential of their sum. Right is the view times up,
/// row 0 the top.
#[test]
fn an_orthographic_picture_frames_the_grid_exactly() {
    let home = home();
    let field = field(home.path());
    let (tau, voxel) = (0.7, 0.5);
    let common = ["--tau", "0.7", "--voxel", "0.5", "--ka", "1", "--kd", "0"];
    run(home.path(), &[&common[..], &["--size", "5x4", "--out", "a"]].concat());
    let left: Array2<f32> = read_npy(home.path().join("a/transmittance.npy")).unwrap();
    let light: Array3<f32> = read_npy(home.path().join("a/radiance.npy")).unwrap();
    assert_eq!((left.dim(), light.dim()), ((4, 5), (4, 5, 3)));
    for ((row, column), left) in left.indexed_iter() {
        let sum: f64 = (0..3).map(|z| f64::from(field[(z, 3 - row, column)])).sum();
        let known = libm::exp(-tau * voxel * sum);
        assert!((f64::from(*left) - known).abs() < 1e-6, "{row} {column}");
        assert!((f64::from(light[(row, column, 1)]) - (1.0 - known)).abs() < 1e-6);
    }
    // From the left, z up: right is -y.
    let more = ["--size", "4x3", "--view", "1,0,0", "--up", "0,0,1", "--out", "b"];
    run(home.path(), &[&common[..], &more].concat());
    let left: Array2<f32> = read_npy(home.path().join("b/transmittance.npy")).unwrap();
    for ((row, column), left) in left.indexed_iter() {
        let sum: f64 = (0..5).map(|x| f64::from(field[(2 - row, 3 - column, x)])).sum();
        assert!((f64::from(*left) - libm::exp(-tau * voxel * sum)).abs() < 1e-6, "{row} {column}");
    }
}

/// Samples a voxel apart, tau in the exponent alone, the sample before itself: along an axis the sums are by hand.
#[test]
fn eq_11_is_summed_as_printed_when_asked() {
    let home = home();
    let field = field(home.path());
    let common = ["--tau", "0.7", "--voxel", "0.5", "--ka", "1", "--kd", "0", "--size", "5x4"];
    run(home.path(), &[&common[..], &["--reading", "sums=as-printed", "--out", "a"]].concat());
    let light: Array3<f32> = read_npy(home.path().join("a/radiance.npy")).unwrap();
    for row in 0..4 {
        for column in 0..5 {
            let (mut sum, mut known) = (0.0, 0.0);
            for z in (0..3).rev() {
                let rho = f64::from(field[(z, 3 - row, column)]);
                sum += rho;
                known += rho * libm::exp(-0.35 * sum);
            }
            let found = f64::from(light[(row, column, 1)]);
            assert!((found - known).abs() < 1e-6 * known.max(1.0), "{row} {column}: {found} {known}");
        }
    }
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let home = home();
    field(home.path());
    let view = ["--camera", "pinhole", "--eye", "6,7,9", "--view", "-1,-1.2,-2", "--size", "40x30"];
    for shading in ["himeno", "emission", "single", "octaves"] {
        for threads in ["1", "3"] {
            let out = format!("{shading}{threads}");
            let more = ["--shading", shading, "--threads", threads, "--out", &out];
            run(home.path(), &[&view[..], &more].concat());
        }
        for name in ["radiance.npy", "transmittance.npy", "volume.png", "summary.json"] {
            let read =
                |threads: &str| fs::read(home.path().join(format!("{shading}{threads}/{name}"))).unwrap();
            assert!(read("1") == read("3"), "{shading} {name}");
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused_in_one_line() {
    let home = home();
    field(home.path());
    write_npy(home.path().join("less.npy"), &Array3::<f32>::from_elem((2, 2, 2), -1.0)).unwrap();
    fs::write(home.path().join("no.npy"), "no array").unwrap();
    for (arguments, says) in [
        (vec!["--density", "gone.npy"], "gone.npy"),
        (vec!["--density", "no.npy"], "no.npy"),
        (vec!["--density", "less.npy"], "at least 0"),
        (vec!["--density", "f.npy", "--view", "0,0,0"], "view"),
        (vec!["--density", "f.npy", "--view", "1,2"], "--view"),
        (vec!["--density", "f.npy", "--camera", "fish"], "--camera"),
        (vec!["--density", "f.npy", "--camera", "pinhole"], "--eye"),
        (vec!["--density", "f.npy", "--shading", "x"], "--shading"),
        (vec!["--density", "f.npy", "--size", "0x4"], "--size"),
        (vec!["--density", "f.npy", "--voxel", "-1"], "voxel"),
        (vec!["--density", "f.npy", "--samples", "0"], "samples"),
    ] {
        let arguments: Vec<&str> = std::iter::once("volume").chain(arguments).collect();
        refused(home.path(), &arguments, &[says]);
    }
    assert!(!home.path().join("out").exists());
}
