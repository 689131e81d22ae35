//! Digests of the sources, so that a program knows whether the results on disk are its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use sha2::{Digest, Sha256};

fn main() {
    for watched in ["src", "experiments", "Cargo.lock", "build.rs"] {
        println!("cargo:rerun-if-changed={watched}");
    }
    // The report reads files and changes no number; what puts claims to the test runs experiments as they are.
    let mut library = files(Path::new("src"));
    library.retain(|path| !path.starts_with("src/lab/report") && !path.starts_with("src/lab/power"));
    library.push(PathBuf::from("Cargo.lock"));
    println!("cargo:rustc-env=SNOWGLOBE_LIBRARY={}", digest(&library));
    for folder in folders(Path::new("experiments")) {
        let name = folder.file_name().map(|name| name.to_string_lossy().to_uppercase()).unwrap_or_default();
        println!("cargo:rustc-env=SNOWGLOBE_{name}={}", digest(&files(&folder)));
    }
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version = Command::new(rustc).arg("--version").output().map(|out| out.stdout).unwrap_or_default();
    println!("cargo:rustc-env=SNOWGLOBE_RUSTC={}", String::from_utf8_lossy(&version).trim());
}

fn folders(of: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> =
        fs::read_dir(of).into_iter().flatten().flatten().map(|e| e.path()).filter(|p| p.is_dir()).collect();
    found.sort();
    found
}

fn files(below: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = fs::read_dir(below)
        .into_iter()
        .flatten()
        .flatten()
        .map(|e| e.path())
        .filter(|p| p.is_file())
        .collect();
    for folder in folders(below) {
        found.extend(files(&folder));
    }
    found.sort();
    found
}

fn digest(files: &[PathBuf]) -> String {
    let mut digest = Sha256::new();
    for path in files {
        let bytes = fs::read(path).unwrap_or_default();
        digest.update(path.to_string_lossy().as_bytes());
        digest.update((bytes.len() as u64).to_le_bytes());
        digest.update(bytes);
    }
    digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
