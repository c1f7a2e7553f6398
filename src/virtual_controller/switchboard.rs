//! Fault switches thrown from outside of the process that runs the controllers: a file in the folder of a fleet, looked
//! at twice a second.

use std::collections::BTreeMap;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use std::{fs, io};

use serde::{Deserialize, Serialize};
use tokio_util::sync::{CancellationToken, DropGuard};

use super::faults::Faults;
use crate::model::SerialNumber;

/// What can be switched from outside, by serial number. A controller that is not in it has every switch off.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Switchboard(pub BTreeMap<SerialNumber, OutsideSwitches>);

/// The switches of one controller; as those of the same name in [`super::FaultSwitches`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OutsideSwitches {
    /// See `task_running` there.
    pub task_running: bool,
    /// See `teach_pendant_connected` there.
    pub teach_pendant: bool,
    /// See `server_error` there.
    pub server_error: bool,
}

impl Switchboard {
    /// Where the switches of the fleet with this folder are.
    pub fn path(data: &Path) -> PathBuf {
        data.join("switches.json")
    }

    /// The switches of a fleet; without a file, all are off.
    pub fn load(data: &Path) -> io::Result<Self> {
        let mut bytes = Vec::new();
        match fs::File::open(Self::path(data)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::default()),
            file => file?.take(MAX_BYTES).read_to_end(&mut bytes)?,
        };
        Ok(serde_json::from_slice(&bytes)?)
    }

    fn apply(&self, controllers: &[(SerialNumber, Faults)]) {
        for (serial, faults) in controllers {
            let OutsideSwitches { task_running, teach_pendant, server_error } =
                self.0.get(serial).copied().unwrap_or_default();
            faults.update(|switches| {
                switches.task_running = task_running;
                switches.teach_pendant_connected = teach_pendant;
                switches.server_error = server_error;
            });
        }
    }
}

/// Puts the switches of the file in force whenever the file changes, as long as what is returned lives.
pub(super) fn watch(data: &Path, controllers: Vec<(SerialNumber, Faults)>) -> DropGuard {
    let off = CancellationToken::new();
    let guard = off.clone().drop_guard();
    let data = data.to_owned();
    tokio::spawn(off.run_until_cancelled_owned(async move {
        let mut seen = None;
        loop {
            let (folder, before) = (data.clone(), seen);
            let look = tokio::task::spawn_blocking(move || {
                let now = written(&folder);
                (now, (now != before).then(|| Switchboard::load(&folder)))
            });
            let Ok((now, changed)) = look.await else { return };
            seen = now;
            match changed {
                None => {}
                Some(Ok(board)) => board.apply(&controllers),
                Some(Err(error)) => tracing::warn!(%error, folder = %data.display(), "the switches cannot be read"),
            }
            tokio::time::sleep(PAUSE).await;
        }
    }));
    guard
}

/// When the file was written, and its length.
fn written(data: &Path) -> Option<(SystemTime, u64)> {
    let file = fs::metadata(Switchboard::path(data)).ok()?;
    Some((file.modified().ok()?, file.len()))
}

const PAUSE: Duration = Duration::from_millis(500);
/// Of a fleet of ten thousand.
const MAX_BYTES: u64 = 2 * 1024 * 1024;
