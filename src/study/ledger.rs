//! The rows of a study in a folder, kept as they come.
//!
//! `study.json` says what the rows are of; `runs.jsonl` holds one a line, in the order in
//! which they came until the study is whole, then in the study's. A shard writes to
//! `runs-I-of-N.jsonl`, so that shards may share a folder. A last line that was torn off
//! is made again.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::design::Design;
use super::error::StudyError;
use super::execute::Shard;
use super::row::Row;

/// What the rows of a folder are of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// This program's version.
    pub vpl: String,
    /// The study.
    pub study: String,
    /// SHA-256 of all that rows depend on.
    pub digest: String,
    /// Number of runs.
    pub runs: u64,
}

impl Manifest {
    /// Of a study, with what its mesh files hold.
    pub fn of(design: &Design) -> Self {
        Self {
            vpl: env!("CARGO_PKG_VERSION").to_owned(),
            study: design.study.name.clone(),
            digest: design.digest(),
            runs: design.jobs.len() as u64,
        }
    }
}

/// Largest file of rows that is read, bytes.
const MOST_BYTES: u64 = 4 << 30;
const MANIFEST: &str = "study.json";

/// A folder with rows.
pub struct Ledger {
    folder: PathBuf,
    manifest: Manifest,
    rows: BTreeMap<u64, Row>,
    out: File,
    path: PathBuf,
}

impl Ledger {
    /// Opens a folder, a new one too, for the rows of a shard. Where another process
    /// writes the same rows, `waiting` is called and its end awaited: of a campaign's
    /// worker that died, the last run may be still on its way.
    ///
    /// # Errors
    /// It cannot be written, or holds something else.
    pub fn open(
        folder: &Path,
        manifest: Manifest,
        shard: Shard,
        waiting: impl FnOnce(&Path),
    ) -> Result<Self, StudyError> {
        fs::create_dir_all(folder).map_err(|e| unwritable(folder, e))?;
        claim(folder, &manifest)?;
        let name = match shard.of {
            1 => "runs.jsonl".to_owned(),
            _ => format!("runs-{}-of-{}.jsonl", shard.number, shard.of),
        };
        let path = folder.join(name);
        let mut out = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(&path)
            .map_err(|e| unwritable(&path, e))?;
        // On a file system without locks, two that write there are the user's business.
        if let Err(TryLockError::WouldBlock) = out.try_lock() {
            waiting(&path);
            out.lock().map_err(|e| unwritable(&path, e))?;
        }
        mend(&mut out, &path)?;
        let mut ledger = Self {
            folder: folder.to_owned(),
            manifest,
            rows: BTreeMap::new(),
            out,
            path,
        };
        ledger.take_in(folder)?;
        Ok(ledger)
    }

    /// Reads the rows of another folder of the same study, without writing them yet.
    ///
    /// # Errors
    /// It holds something else, or cannot be read.
    pub fn take_in(&mut self, folder: &Path) -> Result<(), StudyError> {
        match read_manifest(folder)? {
            Some(manifest) => self.manifest.agrees(&manifest, folder)?,
            None => return Err(refused(folder, "holds no `study.json`, so no rows of a study")),
        }
        let mut files: Vec<PathBuf> = fs::read_dir(folder)
            .map_err(|e| refused(folder, &format!("cannot be read: {e}")))?
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| is_rows(path))
            .collect();
        files.sort();
        for file in files {
            for row in read_rows(&file)? {
                self.known(&row, &file)?;
                self.rows.entry(row.run).or_insert(row);
            }
        }
        Ok(())
    }

    fn known(&self, row: &Row, file: &Path) -> Result<(), StudyError> {
        if row.run < self.manifest.runs && row.suite == self.manifest.study {
            return Ok(());
        }
        Err(refused(
            file,
            &format!("holds run {} of `{}`, which is not of this study", row.run, row.suite),
        ))
    }

    /// The rows so far, by their place in the study.
    pub fn rows(&self) -> &BTreeMap<u64, Row> {
        &self.rows
    }

    /// Whether every run has its row.
    pub fn is_whole(&self) -> bool {
        self.rows.len() as u64 == self.manifest.runs
    }

    /// Keeps a row: it is in the file before this returns.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn add(&mut self, row: Row) -> Result<(), StudyError> {
        let line = row.to_line() + "\n";
        let written = self.out.write_all(line.as_bytes()).and_then(|()| self.out.flush());
        written.map_err(|e| StudyError::Write(self.path.display().to_string(), e))?;
        self.rows.insert(row.run, row);
        Ok(())
    }

    /// Writes all rows in the order of the study to `runs.jsonl`.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn sort(&mut self) -> Result<(), StudyError> {
        let text: String = self.rows.values().map(|row| row.to_line() + "\n").collect();
        self.write("runs.jsonl", text.as_bytes())
    }

    /// Writes a file of the folder: all of it or, where that fails, none.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), StudyError> {
        place(&self.folder, name, bytes)
    }
}

impl Manifest {
    fn agrees(&self, found: &Self, folder: &Path) -> Result<(), StudyError> {
        let reason = if found.study != self.study {
            format!("holds runs of study `{}`, and this is `{}`", found.study, self.study)
        } else if found.vpl != self.vpl {
            format!("was written by vpl {}, and this is vpl {}", found.vpl, self.vpl)
        } else if found != self {
            "holds runs of another state of this study: its suite, program or meshes have changed".to_owned()
        } else {
            return Ok(());
        };
        Err(refused(folder, &format!("{reason}; name a new folder with `--out`")))
    }
}

/// Makes a folder that of a study, or holds it to be.
fn claim(folder: &Path, manifest: &Manifest) -> Result<(), StudyError> {
    if let Some(found) = read_manifest(folder)? {
        return manifest.agrees(&found, folder);
    }
    let mut entries = fs::read_dir(folder).map_err(|e| refused(folder, &format!("cannot be read: {e}")))?;
    // Another shard may be at the same point: its file is no stranger's.
    let foreign = entries.find_map(|entry| {
        let name = entry.ok()?.file_name().to_string_lossy().into_owned();
        (!name.starts_with(".vpl-") && name != MANIFEST).then_some(name)
    });
    if let Some(name) = foreign {
        let reason = format!("holds `{name}` and no study; name a new or an empty folder with `--out`");
        return Err(refused(folder, &reason));
    }
    let text = serde_json::to_string_pretty(manifest).unwrap_or_default() + "\n";
    place(folder, MANIFEST, text.as_bytes())
}

fn read_manifest(folder: &Path) -> Result<Option<Manifest>, StudyError> {
    let path = folder.join(MANIFEST);
    match File::open(&path) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(e) => Err(refused(&path, &format!("cannot be read: {e}"))),
        Ok(file) => {
            let mut text = String::new();
            let read = file.take(1 << 20).read_to_string(&mut text);
            let manifest = read.map_err(|e| e.to_string());
            let manifest = manifest.and_then(|_| serde_json::from_str(&text).map_err(|e| e.to_string()));
            manifest
                .map(Some)
                .map_err(|e| refused(&path, &format!("is of no study: {e}")))
        }
    }
}

fn is_rows(path: &Path) -> bool {
    let name = path
        .file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default();
    name == "runs.jsonl" || name.starts_with("runs-") && name.ends_with(".jsonl")
}

/// Cuts off a last line that has no end, and stands behind the last that has.
fn mend(file: &mut File, path: &Path) -> Result<(), StudyError> {
    let mended = (|| {
        let length = file.metadata()?.len();
        let mut end = length;
        let mut byte = [0];
        while end > 0 {
            file.seek(SeekFrom::Start(end - 1))?;
            file.read_exact(&mut byte)?;
            if byte == *b"\n" {
                break;
            }
            end -= 1;
        }
        if end < length {
            file.set_len(end)?;
        }
        file.seek(SeekFrom::Start(end)).map(|_| ())
    })();
    mended.map_err(|e| unwritable(path, e))
}

fn read_rows(path: &Path) -> Result<Vec<Row>, StudyError> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|f| f.take(MOST_BYTES).read_to_end(&mut bytes));
    read.map_err(|e| refused(path, &format!("cannot be read: {e}")))?;
    // What stands behind the last end of line is torn off.
    let whole = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
    let mut rows = Vec::new();
    for (k, line) in bytes[..whole].split(|b| *b == b'\n').enumerate() {
        if line.is_empty() {
            continue;
        }
        let row = serde_json::from_slice(line);
        rows.push(row.map_err(|e| refused(path, &format!("has no row in line {}: {e}", k + 1)))?);
    }
    Ok(rows)
}

/// Writes a file beside its place, then puts it there.
fn place(folder: &Path, name: &str, bytes: &[u8]) -> Result<(), StudyError> {
    let path = folder.join(name);
    let written = (|| {
        // No temporary file of a library: those are for their owner alone.
        let beside = folder.join(format!(".vpl-{}-{name}", std::process::id()));
        let mut new = File::create(&beside)?;
        let done = new.write_all(bytes).and_then(|()| new.sync_all());
        done.and_then(|()| fs::rename(&beside, &path))
            .inspect_err(|_| drop(fs::remove_file(&beside)))
    })();
    written.map_err(|e| StudyError::Write(path.display().to_string(), e))
}

fn unwritable(path: &Path, error: io::Error) -> StudyError {
    StudyError::Write(path.display().to_string(), error)
}

fn refused(path: &Path, reason: &str) -> StudyError {
    StudyError::Folder {
        folder: path.display().to_string(),
        reason: reason.to_owned(),
    }
}
