//! Folders that a model command writes for a user: never over what it did not make.

use std::fs;
use std::path::{Path, PathBuf};

use snowglobe::lab::{Error, Result, write_whole};

/// Names the files that a command wrote, so that the next run may replace these and nothing else.
const MANIFEST: &str = ".snowglobe";

/// A folder that a command is about to fill.
pub struct OwnFolder {
    path: PathBuf,
    before: Vec<String>,
}

impl OwnFolder {
    /// The folder `--out`, by default `./out/<command>`: new, empty, or made by the same command before.
    pub fn claim(out: Option<&Path>, command: &str) -> Result<Self> {
        let path = out.map_or_else(|| Path::new("out").join(command), Path::to_path_buf);
        let refuse = |what: &str| Err(Error::usage(what).at(path.display()));
        if !path.exists() {
            return Ok(Self { path, before: Vec::new() });
        }
        if !path.is_dir() {
            return refuse("is a file; --out names a folder");
        }
        let manifest = fs::read_to_string(path.join(MANIFEST)).unwrap_or_default();
        let mut lines = manifest.lines().map(String::from);
        if lines.next().as_deref() == Some(command) {
            return Ok(Self { before: lines.collect(), path });
        }
        match fs::read_dir(&path).map(|mut entries| entries.next().is_none()) {
            Ok(true) => Ok(Self { path, before: Vec::new() }),
            Ok(false) => {
                refuse("the folder is not empty and was not made by this command; choose another --out")
            }
            Err(cause) => Err(Error::usage("cannot read the folder").at(path.display()).because(cause)),
        }
    }

    /// Writes these files and no others.
    pub fn fill(self, command: &'static str, files: &[(String, Vec<u8>)]) -> Result<PathBuf> {
        let folder = self.open(command, files.iter().map(|(name, _)| name.clone()).collect())?;
        folder.write(files)?;
        folder.close()
    }

    /// Begins to write these files and no others; removes what an earlier run of the command had besides.
    pub fn open(self, command: &'static str, names: Vec<String>) -> Result<OpenFolder> {
        // Both lists, so that a run that is cut off leaves nothing that the next one does not know as its own.
        let gone: Vec<&String> = self.before.iter().filter(|old| !names.contains(old)).collect();
        let both: Vec<String> = names.iter().chain(gone.iter().copied()).cloned().collect();
        write_whole(&self.path.join(MANIFEST), listed(command, &both).as_bytes())?;
        for old in gone {
            if Path::new(old).is_relative() && !old.contains("..") {
                let _ = fs::remove_file(self.path.join(old)); // gone already is as good
            }
        }
        Ok(OpenFolder { path: self.path, command, names })
    }
}

/// A folder whose files are being written, each whole or not at all.
pub struct OpenFolder {
    path: PathBuf,
    command: &'static str,
    names: Vec<String>,
}

impl OpenFolder {
    /// Writes files that were announced, in this order.
    pub fn write<'f>(&self, files: impl IntoIterator<Item = &'f (String, Vec<u8>)>) -> Result<()> {
        for (name, bytes) in files {
            debug_assert!(self.names.contains(name), "{name} was not announced");
            write_whole(&self.path.join(name), bytes)?;
        }
        Ok(())
    }

    /// All is written; says where.
    pub fn close(self) -> Result<PathBuf> {
        write_whole(&self.path.join(MANIFEST), listed(self.command, &self.names).as_bytes())?;
        Ok(self.path)
    }
}

fn listed(command: &str, names: &[String]) -> String {
    format!("{command}\n{}\n", names.join("\n"))
}
