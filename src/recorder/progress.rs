use std::sync::Arc;

use parking_lot::Mutex;

use super::source::SourceError;
use crate::model::ErrorCode;

/// What a running recording is doing, and how far it has come.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Progress {
    /// What it is doing.
    pub phase: RecordingPhase,
    /// Rows of the file: force sensor records, or eight of each motion log block.
    pub rows: u64,
    /// Reads of the `Data` node that brought something.
    pub packets: u64,
    /// Bytes of the packets.
    pub bytes: u64,
    /// Bytes of the CSV or Parquet file.
    pub file_bytes: u64,
    /// Gaps that were noticed.
    pub gaps: u64,
    /// Records or blocks that are missing, as far as it is known.
    pub missing: u64,
    /// How often the controller told that it has overwritten samples.
    pub warnings: u64,
    /// Packets that could not be decoded.
    pub undecodable: u64,
}

/// What a recording is doing.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum RecordingPhase {
    /// Opens the first connection.
    #[default]
    Connecting,
    /// The controller has no data: LoggingStatus or MonitorStatus is not `Run`.
    Waiting,
    /// The controller records.
    Running,
    /// The connection was lost and is opened again.
    Reconnecting {
        /// Why there is no connection.
        code: ErrorCode,
        /// In the words of the program.
        detail: String,
    },
    /// The files are completed.
    Finishing,
}

impl RecordingPhase {
    pub(super) fn reconnecting(error: &SourceError) -> Self {
        Self::Reconnecting { code: error.code(), detail: error.to_string() }
    }
}

/// Shares the progress of a recording with those who show it.
#[derive(Debug, Clone, Default)]
pub struct ProgressMonitor(Arc<Mutex<Progress>>);

impl ProgressMonitor {
    /// The progress now.
    pub fn get(&self) -> Progress {
        self.0.lock().clone()
    }

    pub(super) fn update(&self, change: impl FnOnce(&mut Progress)) {
        change(&mut self.0.lock());
    }

    pub(super) fn enter(&self, phase: RecordingPhase) {
        self.update(|progress| progress.phase = phase);
    }
}
