//! Folders on disk: files appear whole or not at all, and one process writes at a time.

use std::collections::BTreeMap;
use std::fs::{self, File, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::error::{At, Error, Result};
use crate::image;

/// SHA-256 as hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The digest by which two files count as the same: of the pixels of a picture, of the bytes of anything else.
pub fn content_digest(name: &str, bytes: &[u8]) -> Result<String> {
    if name.ends_with(".png") {
        let pixels = image::pixel_digest(bytes)
            .map_err(|cause| Error::broken("not a readable picture").at(name).because(cause))?;
        return Ok(format!("pixels:{pixels}"));
    }
    Ok(format!("sha256:{}", sha256(bytes)))
}

/// Writes a file whole: beside it first, then renamed.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    if let Some(parent) = path.parent() {
        fs::create_dir_all(parent).at("cannot make the folder", parent)?;
    }
    let mut name = path.as_os_str().to_owned();
    name.push(".part");
    let part = PathBuf::from(name);
    // Not forced to the disk: a file that a power cut takes is missed by its digest, and made again.
    let renamed = fs::write(&part, bytes).and_then(|()| fs::rename(&part, path));
    if renamed.is_err() {
        let _ = fs::remove_file(&part); // the error that matters is the first
    }
    renamed.at("cannot write", path)
}

/// The folder of one experiment while it is written.
pub struct Folder {
    path: PathBuf,
    // SHA-256 of the bytes on disk of each file written so far.
    written: BTreeMap<String, String>,
}

impl Folder {
    /// Begins to write a folder, which may hold an earlier run.
    pub fn begin(path: PathBuf) -> Result<Self> {
        fs::create_dir_all(&path).at("cannot make the folder", &path)?;
        Ok(Self { path, written: BTreeMap::new() })
    }

    /// Writes a file, or leaves the one on disk if its content is the same; returns the content's digest.
    pub fn write(&mut self, name: &str, bytes: &[u8]) -> Result<String> {
        let digest = content_digest(name, bytes)?;
        let path = self.path.join(name);
        let on_disk = match fs::read(&path) {
            Ok(old) if old == bytes || content_digest(name, &old).is_ok_and(|d| d == digest) => old,
            _ => {
                write_whole(&path, bytes)?;
                bytes.to_vec()
            }
        };
        self.written.insert(name.to_owned(), sha256(&on_disk));
        Ok(digest)
    }

    /// Removes what this run did not write and returns the digests of what it did.
    pub fn finish(self) -> Result<BTreeMap<String, String>> {
        for file in files_below(&self.path)? {
            if !self.written.contains_key(&file) && file != super::record::PROVENANCE {
                let path = self.path.join(&file);
                fs::remove_file(&path).at("cannot remove", &path)?;
            }
        }
        Ok(self.written)
    }
}

/// Every file below a folder, as paths relative to it with `/`, in order; none if there is no such folder.
pub fn files_below(folder: &Path) -> Result<Vec<String>> {
    let mut found = Vec::new();
    let mut waiting = vec![String::new()];
    while let Some(below) = waiting.pop() {
        let path = folder.join(&below);
        if !path.is_dir() {
            continue;
        }
        for entry in fs::read_dir(&path).at("cannot list", &path)? {
            let entry = entry.at("cannot list", &path)?;
            let name = format!("{below}{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() { waiting.push(format!("{name}/")) } else { found.push(name) }
        }
    }
    found.sort();
    Ok(found)
}

/// Holds an out folder for one process; let go when dropped, or when the process ends in any way.
pub struct Lock {
    _file: File,
}

impl Lock {
    /// Takes the folder, or says which process has it.
    pub fn take(out: &Path) -> Result<Self> {
        fs::create_dir_all(out).at("cannot make the folder", out)?;
        let path = out.join(".lock");
        let mut file = File::options()
            .create(true)
            .truncate(false)
            .read(true)
            .write(true)
            .open(&path)
            .at("cannot open", &path)?;
        match file.try_lock() {
            Ok(()) => {
                file.set_len(0)
                    .and_then(|()| write!(file, "process {}", std::process::id()))
                    .at("cannot write", &path)?;
                Ok(Self { _file: file })
            }
            Err(TryLockError::WouldBlock) => {
                let holder = fs::read_to_string(&path).unwrap_or_default();
                let holder = if holder.is_empty() { "another process" } else { &holder };
                Err(Error::broken(format!("{holder} is writing here; wait for it, or use another --out"))
                    .at(out.display()))
            }
            Err(TryLockError::Error(cause)) => Err(cause).at("cannot lock", &path),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_keeps_only_what_was_written_and_leaves_equal_files_alone() {
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("e");
        fs::create_dir_all(path.join("large")).unwrap();
        fs::write(path.join("old.csv"), "x").unwrap();
        fs::write(path.join("large/half.png.part"), "x").unwrap();
        fs::write(path.join("same.csv"), "a\n").unwrap();
        let before = fs::metadata(path.join("same.csv")).unwrap().modified().unwrap();
        let mut folder = Folder::begin(path.clone()).unwrap();
        folder.write("same.csv", b"a\n").unwrap();
        folder.write("large/new.csv", b"b\n").unwrap();
        folder.finish().unwrap();
        assert_eq!(files_below(&path).unwrap(), ["large/new.csv", "same.csv"]);
        assert_eq!(fs::metadata(path.join("same.csv")).unwrap().modified().unwrap(), before);
    }

    #[test]
    fn the_second_to_ask_is_told_who_was_first() {
        let home = tempfile::tempdir().unwrap();
        let first = Lock::take(home.path()).unwrap();
        let refused = Lock::take(home.path()).err().unwrap();
        assert_eq!(refused.exit_code(), 1);
        assert!(refused.to_string().contains(&format!("process {}", std::process::id())));
        drop(first);
        Lock::take(home.path()).unwrap();
    }

    #[test]
    fn what_cannot_be_written_leaves_nothing_behind() {
        let home = tempfile::tempdir().unwrap();
        fs::create_dir(home.path().join("a")).unwrap();
        fs::write(home.path().join("a/inside"), "x").unwrap();
        assert!(write_whole(&home.path().join("a"), b"text").is_err()); // a folder is in the way
        assert_eq!(files_below(home.path()).unwrap(), ["a/inside"]);
    }
}
