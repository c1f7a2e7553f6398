use std::path::{Path, PathBuf};
use std::time::Duration;

use chrono::{DateTime, Utc};
use thiserror::Error;
use tokio::runtime::Handle;
use tokio::sync::mpsc::{self, Receiver};
use tokio::time::{Instant, timeout_at};
use tokio_util::sync::CancellationToken;

use super::acquisition::{Acquisition, AcquisitionError, StopLimits};
use super::error::RecorderError;
use super::format::Format;
use super::journal::{self, Entry, RecordingHeader};
use super::live::LiveTap;
use super::progress::{ProgressMonitor, RecordingPhase};
use super::recording_files::{Recorded, RecordingFiles};
use super::source::{SourceConnector, SourceError};
use super::stop_reason::StopReason;
use crate::model::clock;

/// One recording of one controller: acquisition and files.
#[derive(Debug)]
pub struct Recording {
    /// What is recorded, from which controller. `started_at` is set when the first connection is there.
    pub header: RecordingHeader,
    /// What the packets are written as.
    pub format: Format,
    /// Where the files are made.
    pub folder: PathBuf,
    /// When the recording ends by itself.
    pub limits: StopLimits,
    /// Shows the values while they are recorded.
    pub tap: Option<LiveTap>,
    /// Told what the recording is doing.
    pub monitor: ProgressMonitor,
}

/// What a recording came to.
#[derive(Debug)]
pub struct RecordingEnd {
    /// The files, complete; `None` if they could not be written, or nothing was connected.
    pub recorded: Option<Recorded>,
    /// Why the recording ended early.
    pub failure: Option<RecordingError>,
}

/// Why a recording ended early.
#[derive(Debug, Error)]
pub enum RecordingError {
    /// No data from the controller.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// The files cannot be written.
    #[error(transparent)]
    Files(#[from] RecorderError),
}

/// Entries that wait for the disk. The largest is one read: 200 motion log blocks are 0.5 MB.
const WAITING_ENTRIES: usize = 64;
/// A process that is killed loses at most what came in this time.
const SYNC_PERIOD: Duration = Duration::from_millis(800);

impl Recording {
    /// Records until a limit is reached, `stop` is cancelled or an error ends it; then completes the files. Files are
    /// made once the first connection is there, so that a controller that cannot be reached leaves none. `on_start` is
    /// given the path of the file.
    pub async fn run(
        self,
        connector: &dyn SourceConnector,
        stop: CancellationToken,
        on_start: impl FnOnce(&Path) + Send,
    ) -> RecordingEnd {
        let (entries, received) = mpsc::channel(WAITING_ENTRIES);
        let Self { mut header, format, folder, limits, tap, monitor } = self;
        let settings = header.settings;
        let acquisition = Acquisition { settings, limits, stop, entries: entries.clone(), monitor: monitor.clone() };
        let source = match acquisition.connect(connector).await {
            Ok(Some(source)) => source,
            Ok(None) => return RecordingEnd { recorded: None, failure: None },
            Err(error) => return RecordingEnd { recorded: None, failure: Some(error.into()) },
        };
        header.started_at = clock::now();
        let created = tokio::task::spawn_blocking(move || {
            let mut files = RecordingFiles::create(&folder, &header, format)?;
            tap.into_iter().for_each(|tap| files.set_tap(tap));
            Ok(files)
        });
        let files = match created.await.unwrap_or(Err(RecorderError::BrokenOff)) {
            Ok(files) => files,
            Err(error) => {
                source.close().await;
                return RecordingEnd { recorded: None, failure: Some(error.into()) };
            }
        };
        on_start(files.path());
        let acquired = async move {
            let result = acquisition.run(source, connector).await;
            let reason = *result.as_ref().unwrap_or(&StopReason::Error);
            acquisition.monitor.enter(RecordingPhase::Finishing);
            // The writer is gone only if it failed, which is reported.
            let _gone = entries.send((journal::now(), Entry::End(reason))).await;
            result
        };
        let (acquired, written) = tokio::join!(acquired, write(files, received, monitor));
        let failure = match acquired {
            Err(AcquisitionError::Source(error)) => Some(RecordingError::Source(error)),
            Ok(_) | Err(AcquisitionError::NotTaken) => None,
        };
        match written {
            Ok(recorded) => RecordingEnd { recorded: Some(recorded), failure },
            Err(error) => RecordingEnd { recorded: None, failure: Some(failure.unwrap_or(error.into())) },
        }
    }
}

/// Writes entries until the end, off the async threads.
async fn write(
    mut files: RecordingFiles,
    mut entries: Receiver<(DateTime<Utc>, Entry)>,
    monitor: ProgressMonitor,
) -> Result<Recorded, RecorderError> {
    let runtime = Handle::current();
    let task = tokio::task::spawn_blocking(move || {
        let mut next_sync = Instant::now() + SYNC_PERIOD;
        loop {
            match runtime.block_on(async { timeout_at(next_sync, entries.recv()).await }) {
                Ok(Some((at, Entry::End(reason)))) => return files.finish(at, reason),
                // The acquisition was dropped in the middle.
                Ok(None) => return files.finish(journal::now(), StopReason::Error),
                Ok(Some((at, entry))) => files.push(at, &entry)?,
                Err(_elapsed) => {}
            }
            if Instant::now() >= next_sync {
                files.sync()?;
                next_sync = Instant::now() + SYNC_PERIOD;
            }
            monitor.update(|progress| files.report(progress));
        }
    });
    task.await.unwrap_or(Err(RecorderError::BrokenOff))
}
