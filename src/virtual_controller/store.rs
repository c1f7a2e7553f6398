use std::fs::{self, DirBuilder, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use chrono::Utc;
use sha2::{Digest, Sha256};
use thiserror::Error;
use zeroize::Zeroizing;

use super::faults::Faults;
use super::state::State;
use crate::model::{ErrorCode, Problem};

/// Where a controller keeps its [`State`]: one file in a folder of its own.
///
/// The file is one line `opcua-virtual-controller 1 <SHA-256 of the rest>`, then JSON. It is replaced whole, so it
/// holds the former state or the new one at every moment, whenever the process is killed. Folder and file belong to
/// the account alone (0700, 0600): they hold private keys.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    faults: Faults,
}

/// A state that lies on disk beside the one in force, complete and flushed, and takes its place by one rename.
/// Dropped without [`Staged::commit`], it leaves nothing behind.
#[derive(Debug)]
#[must_use]
pub struct Staged {
    temporary: PathBuf,
    target: PathBuf,
    committed: bool,
}

#[derive(Debug, Error)]
pub enum StoreError {
    #[error("{path}: {source}")]
    Io { path: PathBuf, source: io::Error },
    #[error("the controller's file is damaged ({reason}); it was kept as {kept}")]
    Damaged { reason: String, kept: PathBuf },
    #[error("{path} was written by a newer version of this program")]
    TooNew { path: PathBuf },
}

const FILE: &str = "controller.state";
const TEMPORARY: &str = "controller.state.new";
const MAGIC: &str = "opcua-virtual-controller";
const FORMAT: u32 = 1;
/// Far above what a full controller needs (about 300 KB); a larger file is not ours.
const MAX_FILE_BYTES: u64 = 16 * 1024 * 1024;

impl Store {
    /// Makes the folder if it is missing. One process at a time works on a folder.
    pub fn open(folder: &Path, faults: Faults) -> Result<Self, StoreError> {
        private_folder(folder).map_err(|source| StoreError::Io { path: folder.to_owned(), source })?;
        Ok(Self { folder: folder.to_owned(), faults })
    }

    /// `None` when the folder holds no state yet. A damaged file is kept under another name and refused; the next
    /// call finds none.
    pub fn load(&self) -> Result<Option<State>, StoreError> {
        let path = self.folder.join(FILE);
        let io_error = |source| StoreError::Io { path: path.clone(), source };
        let mut bytes = Zeroizing::new(Vec::new());
        match File::open(&path) {
            Ok(file) => file.take(MAX_FILE_BYTES).read_to_end(&mut bytes).map_err(io_error)?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(io_error(error)),
        };
        match decode(&bytes) {
            Ok(state) => Ok(Some(state)),
            Err(Unreadable::TooNew) => Err(StoreError::TooNew { path }),
            Err(Unreadable::Damaged(reason)) => {
                let stamp = Utc::now().format("%Y%m%dT%H%M%S%.6f");
                let kept = self.folder.join(format!("{FILE}.damaged-{stamp}"));
                fs::rename(&path, &kept).map_err(io_error)?;
                Err(StoreError::Damaged { reason, kept })
            }
        }
    }

    /// Writes and flushes, without touching the state in force.
    pub fn stage(&self, state: &State) -> Result<Staged, StoreError> {
        let temporary = self.folder.join(TEMPORARY);
        let staged = Staged { temporary: temporary.clone(), target: self.folder.join(FILE), committed: false };
        self.write(&temporary, state).map_err(|source| StoreError::Io { path: temporary, source })?;
        Ok(staged)
    }

    /// [`Store::stage`] and [`Staged::commit`] at once.
    pub fn save(&self, state: &State) -> Result<(), StoreError> {
        self.stage(state)?.commit()
    }

    fn write(&self, path: &Path, state: &State) -> io::Result<()> {
        let bytes = encode(state)?;
        // One that a killed process left behind.
        match fs::remove_file(path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        let mut file = private_file(path)?;
        if self.faults.get().disk_full {
            let (half, _) = bytes.split_at(bytes.len() / 2);
            file.write_all(half)?;
            return Err(io::ErrorKind::StorageFull.into());
        }
        file.write_all(&bytes)?;
        file.sync_all()
    }
}

impl Staged {
    pub fn commit(mut self) -> Result<(), StoreError> {
        fs::rename(&self.temporary, &self.target)
            .map_err(|source| StoreError::Io { path: self.target.clone(), source })?;
        self.committed = true;
        // The new state is in force; that its name might not outlive a power cut is no reason to deny it.
        if let Some(folder) = self.target.parent()
            && let Err(error) = sync_folder(folder)
        {
            tracing::warn!(folder = %folder.display(), %error, "the folder could not be flushed");
        }
        Ok(())
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        if !self.committed
            && let Err(error) = fs::remove_file(&self.temporary)
            && error.kind() != io::ErrorKind::NotFound
        {
            tracing::warn!(path = %self.temporary.display(), %error, "a staged state could not be removed");
        }
    }
}

impl From<StoreError> for Problem {
    fn from(error: StoreError) -> Self {
        match &error {
            StoreError::Io { source, .. }
                if matches!(source.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded) =>
            {
                ErrorCode::DiskFull.into()
            }
            _ => Self::with_detail(ErrorCode::Internal, error),
        }
    }
}

enum Unreadable {
    Damaged(String),
    TooNew,
}

fn encode(state: &State) -> io::Result<Zeroizing<Vec<u8>>> {
    let json = Zeroizing::new(serde_json::to_vec(state)?);
    let header = format!("{MAGIC} {FORMAT} {}\n", hex::encode(Sha256::digest(&*json)));
    let mut bytes = Zeroizing::new(Vec::with_capacity(header.len() + json.len()));
    bytes.extend_from_slice(header.as_bytes());
    bytes.extend_from_slice(&json);
    Ok(bytes)
}

fn decode(bytes: &[u8]) -> Result<State, Unreadable> {
    let damaged = |reason: &str| Unreadable::Damaged(reason.to_owned());
    let end = bytes.iter().position(|b| *b == b'\n').ok_or_else(|| damaged("it has no first line"))?;
    let (header, json) = (&bytes[..end], &bytes[end + 1..]);
    let header = std::str::from_utf8(header).map_err(|_| damaged("its first line is not text"))?;
    let mut words = header.split(' ');
    if words.next() != Some(MAGIC) {
        return Err(damaged("it is no controller's file"));
    }
    match words.next().and_then(|word| word.parse::<u32>().ok()) {
        Some(FORMAT) => {}
        Some(format) if format > FORMAT => return Err(Unreadable::TooNew),
        _ => return Err(damaged("its first line is not understood")),
    }
    if words.next() != Some(hex::encode(Sha256::digest(json)).as_str()) {
        return Err(damaged("its checksum differs"));
    }
    let state: State = serde_json::from_slice(json)
        .map_err(|error| Unreadable::Damaged(format!("line {}, column {}", error.line(), error.column())))?;
    state.check().map_err(|problem| Unreadable::Damaged(problem.to_string()))?;
    Ok(state)
}

fn private_folder(folder: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::DirBuilderExt as _;
        builder.mode(0o700);
    }
    builder.create(folder)
}

fn private_file(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        options.mode(0o600);
    }
    options.open(path)
}

#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

/// Windows keeps names itself and lets nobody flush a folder.
#[cfg(not(unix))]
fn sync_folder(_folder: &Path) -> io::Result<()> {
    Ok(())
}
