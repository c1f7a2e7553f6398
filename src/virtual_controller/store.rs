use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::str::Utf8Error;

use sha2::{Digest, Sha256};
use thiserror::Error;
use zeroize::Zeroizing;

use super::faults::Faults;
use super::state::{ControllerState, StateError};
use crate::model::clock;
use crate::platform::{private, replace};

/// Where a controller keeps its [`ControllerState`]: one file in a folder of its own.
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
/// Dropped without [`StagedState::commit`], it leaves nothing behind.
#[derive(Debug)]
#[must_use]
pub struct StagedState {
    temporary: PathBuf,
    target: PathBuf,
    committed: bool,
}

/// Why the state of a controller cannot be read or written.
#[derive(Debug, Error)]
pub enum StoreError {
    /// The file cannot be read or written.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file is damaged, and was put aside.
    #[error("the controller's file is damaged ({source}); it was kept as {kept}")]
    Damaged {
        /// What is wrong with it.
        source: Damage,
        /// The file it was moved to.
        kept: PathBuf,
    },
    /// A later version of this program wrote the file.
    #[error("{path} was written by a newer version of this program")]
    TooNew {
        /// The file.
        path: PathBuf,
    },
}

/// What is wrong with the controller's file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Damage {
    #[error("it has no first line")]
    NoHeader,
    #[error("its first line is not text")]
    HeaderNotText(#[source] Utf8Error),
    #[error("it is no controller's file")]
    OtherFile,
    #[error("its first line is not understood")]
    Header,
    #[error("its checksum differs")]
    Checksum,
    /// The reader's own error quotes the text, which may be a key.
    #[error("line {line}, column {column}")]
    Json { line: usize, column: usize },
    #[error(transparent)]
    ControllerState(#[from] StateError),
}

const FILE: &str = "controller.state";
const TEMPORARY: &str = "controller.state.new";
const MAGIC: &str = "opcua-virtual-controller";
const FORMAT: u32 = 1;
/// Above what a full controller needs (about 300 KB, and up to 6 MB of CRLs); a larger file is not ours.
const MAX_FILE_BYTES: u64 = 16 * 1024 * 1024;

impl Store {
    /// Makes the folder if it is missing. One process at a time works on a folder.
    pub fn open(folder: &Path, faults: Faults) -> Result<Self, StoreError> {
        let failed = |path: &Path, source| StoreError::Io { path: path.to_owned(), source };
        private::create_folder(folder).map_err(|source| failed(folder, source))?;
        // Left behind by a process that was killed.
        let temporary = folder.join(TEMPORARY);
        replace::remove_if_there(&temporary).map_err(|source| failed(&temporary, source))?;
        Ok(Self { folder: folder.to_owned(), faults })
    }

    /// `None` when the folder holds no state yet. A damaged file is kept under another name and refused; the next
    /// call finds none.
    pub fn load(&self) -> Result<Option<ControllerState>, StoreError> {
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
            Err(Unreadable::Damaged(source)) => {
                let stamp = clock::now().format("%Y%m%dT%H%M%S%.6f");
                let kept = self.folder.join(format!("{FILE}.damaged-{stamp}"));
                replace::rename(&path, &kept).map_err(io_error)?;
                Err(StoreError::Damaged { source, kept })
            }
        }
    }

    /// Writes and flushes, without touching the state in force.
    pub fn stage(&self, state: &ControllerState) -> Result<StagedState, StoreError> {
        let temporary = self.folder.join(TEMPORARY);
        let staged = StagedState { temporary: temporary.clone(), target: self.folder.join(FILE), committed: false };
        encode(state)
            .and_then(|bytes| write_private_file(&temporary, &bytes, &self.faults))
            .map_err(|source| StoreError::Io { path: temporary, source })?;
        Ok(staged)
    }

    /// [`Store::stage`] and [`StagedState::commit`] at once.
    pub fn save(&self, state: &ControllerState) -> Result<(), StoreError> {
        self.stage(state)?.commit()
    }
}

/// Writes a file beside the controller's state, for this account only, whole or not at all.
pub(super) fn replace_private_file(path: &Path, bytes: &[u8], faults: &Faults) -> io::Result<()> {
    let temporary = path.with_extension("new");
    let written = write_private_file(&temporary, bytes, faults).and_then(|()| replace::rename(&temporary, path));
    if written.is_err() {
        let _ = replace::remove(&temporary);
    }
    written?;
    path.parent().map_or(Ok(()), sync_folder)
}

fn write_private_file(path: &Path, bytes: &[u8], faults: &Faults) -> io::Result<()> {
    // One that a killed process left behind.
    replace::remove_if_there(path)?;
    let mut file = private::create_file(path)?;
    if faults.get().disk_full {
        let (half, _) = bytes.split_at(bytes.len() / 2);
        file.write_all(half)?;
        return Err(io::ErrorKind::StorageFull.into());
    }
    file.write_all(bytes)?;
    file.sync_all()
}

impl StagedState {
    /// Puts the state in force: one rename, after which it survives a power failure.
    pub fn commit(mut self) -> Result<(), StoreError> {
        replace::rename(&self.temporary, &self.target)
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

impl Drop for StagedState {
    fn drop(&mut self) {
        if !self.committed
            && let Err(error) = replace::remove_if_there(&self.temporary)
        {
            tracing::warn!(path = %self.temporary.display(), %error, "a staged state could not be removed");
        }
    }
}

enum Unreadable {
    Damaged(Damage),
    TooNew,
}

impl From<Damage> for Unreadable {
    fn from(damage: Damage) -> Self {
        Self::Damaged(damage)
    }
}

fn encode(state: &ControllerState) -> io::Result<Zeroizing<Vec<u8>>> {
    let json = Zeroizing::new(serde_json::to_vec(state)?);
    let header = format!("{MAGIC} {FORMAT} {}\n", hex::encode(Sha256::digest(&*json)));
    let mut bytes = Zeroizing::new(Vec::with_capacity(header.len() + json.len()));
    bytes.extend_from_slice(header.as_bytes());
    bytes.extend_from_slice(&json);
    Ok(bytes)
}

fn decode(bytes: &[u8]) -> Result<ControllerState, Unreadable> {
    let end = bytes.iter().position(|b| *b == b'\n').ok_or(Damage::NoHeader)?;
    let (header, json) = (&bytes[..end], &bytes[end + 1..]);
    let header = std::str::from_utf8(header).map_err(Damage::HeaderNotText)?;
    let mut words = header.split(' ');
    if words.next() != Some(MAGIC) {
        return Err(Damage::OtherFile.into());
    }
    match words.next().and_then(|word| word.parse::<u32>().ok()) {
        Some(FORMAT) => {}
        Some(format) if format > FORMAT => return Err(Unreadable::TooNew),
        _ => return Err(Damage::Header.into()),
    }
    if words.next() != Some(hex::encode(Sha256::digest(json)).as_str()) {
        return Err(Damage::Checksum.into());
    }
    let state: ControllerState =
        serde_json::from_slice(json).map_err(|error| Damage::Json { line: error.line(), column: error.column() })?;
    state.check().map_err(Damage::ControllerState)?;
    Ok(state)
}

#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

/// Windows keeps names itself and has no flush of a folder.
#[cfg(not(unix))]
fn sync_folder(_folder: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::virtual_controller::{ControllerIdentity, NewController, OperatingContext};

    fn state() -> ControllerState {
        let identity = ControllerIdentity {
            serial: "R7A0000001".parse().unwrap(),
            series: crate::model::ControllerSeries::Rc700,
            firmware: crate::model::FirmwareVersion::new(7, 5, 4),
            name: "store".parse().unwrap(),
        };
        let context =
            OperatingContext { now: clock::now(), bind: std::net::Ipv4Addr::LOCALHOST.into(), management_port: 7943 };
        NewController::new(identity, String::new()).make(&context).unwrap()
    }

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn what_is_staged_counts_only_once_committed() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), Faults::default()).unwrap();
        assert!(store.load().unwrap().is_none());
        let old = state();
        store.save(&old).unwrap();
        let new = ControllerState { revision: 2, ..old.clone() };

        let staged = store.stage(&new).unwrap();
        assert_eq!(store.load().unwrap(), Some(old.clone()));
        drop(staged);
        assert_eq!(names(folder.path()), [FILE]);

        // A process that is killed runs no destructor.
        std::mem::forget(store.stage(&new).unwrap());
        assert_eq!(store.load().unwrap(), Some(old));
        assert_eq!(names(folder.path()).len(), 2);
        let store = Store::open(folder.path(), Faults::default()).unwrap();
        assert_eq!(names(folder.path()), [FILE], "it holds private keys");
        std::mem::forget(store.stage(&new).unwrap());
        store.save(&new).unwrap();
        assert_eq!(store.load().unwrap(), Some(new));
        assert_eq!(names(folder.path()), [FILE]);
    }

    #[test]
    fn a_full_disk_costs_nothing_but_the_change() {
        let folder = tempfile::tempdir().unwrap();
        let faults = Faults::default();
        let store = Store::open(folder.path(), faults.clone()).unwrap();
        let old = state();
        store.save(&old).unwrap();
        faults.update(|switches| switches.disk_full = true);
        let error = store.save(&ControllerState { revision: 2, ..old.clone() }).unwrap_err();
        let StoreError::Io { source, .. } = error else { panic!("{error}") };
        assert_eq!(source.kind(), io::ErrorKind::StorageFull);
        assert_eq!(names(folder.path()), [FILE]);
        assert_eq!(store.load().unwrap(), Some(old));
    }

    #[test]
    fn no_secret_shows_in_debug_output() {
        let state = state();
        let key = hex::encode(state.management.private_key.0.as_slice());
        assert!(!format!("{state:?}").contains(&key[..32]));
        assert!(format!("{state:?}").contains("SecretBytes(…)"));
    }

    const CHILD_FOLDER: &str = "VIRTUAL_CONTROLLER_STORE_TEST_FOLDER";

    /// Not a test of its own: the process that the next one kills.
    #[test]
    #[ignore = "started by a_killed_process_leaves_a_whole_state"]
    fn saves_until_killed() {
        let Some(folder) = std::env::var_os(CHILD_FOLDER) else { return };
        let store = Store::open(Path::new(&folder), Faults::default()).unwrap();
        let mut state = store.load().unwrap().unwrap();
        loop {
            state.revision += 1;
            store.save(&state).unwrap();
        }
    }

    #[test]
    fn a_killed_process_leaves_a_whole_state() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path(), Faults::default()).unwrap();
        store.save(&state()).unwrap();
        let mut last = 1;
        for round in 0..8 {
            let mut child = std::process::Command::new(std::env::current_exe().unwrap())
                .args(["--ignored", "--exact", "virtual_controller::store::tests::saves_until_killed"])
                .env(CHILD_FOLDER, folder.path())
                .stdout(std::process::Stdio::null())
                .spawn()
                .unwrap();
            let asked = std::time::Instant::now();
            while store.load().unwrap().unwrap().revision == last {
                assert!(asked.elapsed().as_secs() < 60, "the child does nothing");
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
            std::thread::sleep(std::time::Duration::from_millis(round));
            child.kill().unwrap();
            child.wait().unwrap();
            let found = store.load().unwrap().unwrap().revision;
            assert!(found > last);
            last = found;
        }
    }
}
