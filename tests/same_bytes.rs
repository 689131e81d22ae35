//! The same bytes on 1, 2 and 7 threads, and with AVX2 and FMA hidden from the C library.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Every file below a folder with its content, but for what says when and where it was made.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut waiting = vec![folder.to_path_buf()];
    while let Some(folder_) = waiting.pop() {
        for path in fs::read_dir(&folder_).unwrap().map(|entry| entry.unwrap().path()) {
            let name = path.strip_prefix(folder).unwrap().to_string_lossy().into_owned();
            if path.is_dir() {
                waiting.push(path);
            } else if !name.ends_with("provenance.json") && !name.ends_with(".lock") {
                found.insert(name, fs::read(path).unwrap());
            }
        }
    }
    found
}

fn run(arguments: &[&str], environment: &[(&str, &str)]) -> BTreeMap<String, Vec<u8>> {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    let mut command = Command::new(env!("CARGO_BIN_EXE_snowglobe"));
    command.args(arguments).arg("--out").arg(&out).envs(environment.iter().copied());
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    contents(&out)
}

fn assert_same(arguments: &[&str]) {
    let with = |threads| [arguments, &["--threads", threads]].concat();
    let first = run(&with("1"), &[]);
    assert!(!first.is_empty());
    for (threads, environment) in [
        ("2", vec![]),
        ("7", vec![]),
        ("2", vec![("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable")]),
        ("2", vec![("LC_ALL", "tr_TR.UTF-8"), ("TZ", "Pacific/Apia")]),
    ] {
        let other = run(&with(threads), &environment);
        assert_eq!(first.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
        for (name, bytes) in &first {
            assert!(*bytes == other[name], "{name} differs with {threads} threads and {environment:?}");
        }
    }
}

#[test]
fn the_experiments_at_smoke_scale() {
    assert_same(&["run", "--scale", "smoke"]);
}

#[test]
fn frost_on_a_sketch_of_ones_own() {
    let sketch = concat!(env!("CARGO_MANIFEST_DIR"), "/experiments/data/leaf.svg");
    let arguments = [
        "frost",
        "--sketch",
        sketch,
        "--points",
        "600",
        "--target",
        "60",
        "--threshold",
        "0.4",
        "--width",
        "160",
    ];
    assert_same(&arguments);
}
