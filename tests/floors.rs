//! The floors of the house: ground, methods, models, their problems, the harness. Nothing imports what stands above it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Modules of the library, floor by floor.
const FLOORS: [&[&str]; 5] = [
    &["rng", "reading", "hexgrid", "image", "sketch", "mesh", "fieldfile"],
    &["optimize", "lsystem", "navier_stokes", "volume", "regions"],
    &["frost", "tree", "contour_cloud", "automaton_cloud", "snow"],
    &["problems"],
    &["lab"],
];
/// Floors whose modules may import one another: the ground.
const OPEN: usize = 0;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn rust_files(below: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(below).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            found.extend(rust_files(&entry));
        } else if entry.extension().is_some_and(|e| e == "rs") {
            found.push(entry);
        }
    }
    found.sort();
    found
}

/// The module of the library that a source file belongs to; none for `lib.rs`.
fn module(path: &Path) -> Option<String> {
    let below = path.strip_prefix(root().join("src")).unwrap();
    let first = below.components().next()?.as_os_str().to_string_lossy().into_owned();
    let name = first.trim_end_matches(".rs").to_owned();
    (name != "lib").then_some(name)
}

fn floor(module: &str) -> Option<usize> {
    FLOORS.iter().position(|floor| floor.contains(&module))
}

/// Modules that a source text imports, `use crate::a` and `crate::a::b` alike; tests are exempt.
fn imports(text: &str) -> Vec<String> {
    let body = text.split("#[cfg(test)]").next().unwrap_or_default();
    let code =
        body.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    code.match_indices("crate::")
        .map(|(at, _)| {
            let rest = &code[at + "crate::".len()..];
            rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
        })
        .filter(|name: &String| !name.is_empty())
        .collect()
}

#[test]
fn every_module_has_its_floor_and_imports_nothing_above_it() {
    let mut seen = BTreeMap::new();
    for path in rust_files(&root().join("src")) {
        let Some(module) = module(&path) else { continue };
        let mine =
            floor(&module).unwrap_or_else(|| panic!("{module} has no floor: add it to tests/floors.rs"));
        seen.insert(module.clone(), mine);
        for other in imports(&fs::read_to_string(&path).unwrap()) {
            if other == module {
                continue;
            }
            let theirs = floor(&other).unwrap_or_else(|| panic!("{}: no module {other}", path.display()));
            let allowed = theirs < mine || (theirs == mine && mine == OPEN);
            assert!(allowed, "{} imports {other}", path.display());
        }
    }
    let listed = FLOORS.iter().map(|floor| floor.len()).sum::<usize>();
    assert_eq!(seen.len(), listed, "a floor names a module that is gone");
}

/// The harness judges; it knows no model. (Pictures and readings it may know.)
#[test]
fn the_harness_knows_no_model() {
    for path in rust_files(&root().join("src/lab")) {
        for other in imports(&fs::read_to_string(&path).unwrap()) {
            assert!(!FLOORS[1..4].iter().any(|floor| floor.contains(&other.as_str())), "{}", path.display());
        }
    }
}

#[test]
fn library_modules_are_public_and_listed_in_the_map() {
    let map = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    for module in FLOORS.concat() {
        assert!(map.contains(&format!("pub mod {module};")), "{module} is not in src/lib.rs");
        assert!(map.contains(&format!("[`{module}`]")), "{module} is not in the map of src/lib.rs");
    }
    assert!(map.contains("#![forbid(unsafe_code)]"));
}

/// A paper is a folder with its own program; the suite has it, and no paper knows another.
#[test]
fn every_paper_is_everywhere_it_must_be() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let program = fs::read_to_string(root().join("experiments/main.rs")).unwrap();
    let tests = fs::read_to_string(root().join("tests/papers/mod.rs")).unwrap();
    let papers: Vec<String> = fs::read_dir(root().join("experiments"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_dir() && path.join("main.rs").is_file())
        .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
        .collect();
    assert!(!papers.is_empty());
    for paper in &papers {
        assert!(manifest.contains(&format!("experiments/{paper}/main.rs")), "{paper} is not in Cargo.toml");
        assert!(program.contains(&format!("&{paper}::PAPER")), "{paper} is not in experiments/main.rs");
        assert!(tests.contains(&format!("&{paper}::PAPER")), "{paper} is not in tests/papers/mod.rs");
        for path in rust_files(&root().join("experiments").join(paper)) {
            let text = fs::read_to_string(&path).unwrap();
            for other in papers.iter().filter(|other| *other != paper) {
                assert!(!text.contains(&format!("{other}::")), "{} knows {other}", path.display());
            }
        }
    }
}
