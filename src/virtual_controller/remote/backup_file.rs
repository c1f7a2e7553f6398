use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parking_lot::Mutex;
use tokio::task::spawn_blocking;

use crate::virtual_controller::cell::{BackupMemory, CellHandle};
use crate::virtual_controller::faults::Faults;
use crate::virtual_controller::store::replace_private_file;

/// The file that keeps what the battery of a controller keeps: the values of backup variables, and replaced parts. It is
/// replaced whole, before the answer to the remote command that changed something, and when the controller is switched off.
#[derive(Debug, Clone)]
pub(in super::super) struct BackupFile(Option<Arc<Inner>>);

#[derive(Debug)]
struct Inner {
    path: PathBuf,
    faults: Faults,
    cell: CellHandle,
    /// What the file holds.
    written: Mutex<BackupMemory>,
}

/// The largest file that is read: the memory for variables, in text.
const MAX_BYTES: u64 = 64 * 1024 * 1024;

impl BackupFile {
    /// In the folder of a controller with this cell, which was built from `written`.
    pub fn new(folder: &Path, faults: Faults, cell: CellHandle, written: BackupMemory) -> Self {
        Self(Some(Arc::new(Inner { path: path(folder), faults, cell, written: Mutex::new(written) })))
    }

    /// Of a cell that is forgotten when it is switched off.
    pub const fn none() -> Self {
        Self(None)
    }

    /// What the folder of a controller keeps. A file that is missing keeps nothing.
    pub fn load(folder: &Path) -> io::Result<BackupMemory> {
        let mut bytes = Vec::new();
        match File::open(path(folder)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(BackupMemory::default()),
            file => file?.take(MAX_BYTES).read_to_end(&mut bytes)?,
        };
        Ok(serde_json::from_slice(&bytes)?)
    }

    /// Writes what has changed, if anything has. `false`: it could not be written.
    pub async fn keep(&self) -> bool {
        let Some(inner) = self.0.clone() else { return true };
        match spawn_blocking(move || inner.write()).await {
            Ok(Ok(())) => true,
            Ok(Err(error)) => {
                tracing::error!(%error, "the memory of a virtual controller's battery cannot be written");
                false
            }
            Err(error) => {
                tracing::error!(%error, "the thread that writes a battery's memory died");
                false
            }
        }
    }
}

impl Inner {
    fn write(&self) -> io::Result<()> {
        // Held while the file is written: an older state never replaces a newer one.
        let mut written = self.written.lock();
        let now = self.cell.backup();
        if *written != now {
            replace_private_file(&self.path, &serde_json::to_vec(&now)?, &self.faults)?;
            *written = now;
        }
        Ok(())
    }
}

fn path(folder: &Path) -> PathBuf {
    folder.join("battery.json")
}
