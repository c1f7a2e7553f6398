use std::time::Duration;

use chrono::{DateTime, Utc};
use thiserror::Error;
use tokio::sync::mpsc::Sender;
use tokio::time::Instant;
use tokio_util::sync::CancellationToken;

use super::journal::{self, Entry};
use super::progress::{ProgressMonitor, RecordingPhase};
use super::settings::{RecordSettings, Source};
use super::source::{ErrorStatus, PacketSource, SourceConnector, SourceError};
use super::stop_reason::StopReason;
use crate::records::force::TAG_FOOTER;

/// When a recording ends by itself; without a limit it goes on until it is asked to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StopLimits {
    /// From the moment the controller is connected.
    pub duration: Option<Duration>,
    /// Bytes of packets.
    pub bytes: Option<u64>,
    /// Footers of the force sensor.
    pub footers: Option<u32>,
}

/// Why an acquisition ended early.
#[derive(Debug, Error)]
pub enum AcquisitionError {
    /// No data came, and a later try does not help.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// The entries are not taken in any more: the receiver says why.
    #[error("the recording cannot be written")]
    NotTaken,
}

/// Follows the data of one controller, and sends what happens as entries.
///
/// It polls the status nodes and reads the `Data` node as long as there is data, as manual 4.1.2 and 4.3.2 advise. After
/// a lost connection it connects again, with pauses that grow from 0.5 s to 30 s, until `stop`. The entries go into a
/// bounded queue: while that is full, nothing is read, and the controller's own queue fills.
#[derive(Debug)]
pub struct Acquisition {
    /// What is recorded.
    pub settings: RecordSettings,
    /// When the acquisition ends by itself.
    pub limits: StopLimits,
    /// Ends the acquisition; the packet in hand is still sent.
    pub stop: CancellationToken,
    /// With the time of this computer at which each came.
    pub entries: Sender<(DateTime<Utc>, Entry)>,
    /// Told what the acquisition is doing.
    pub monitor: ProgressMonitor,
}

/// Between two looks at the status nodes while there is no data. The manual polls every 10 ms (motion log) and every
/// 100 ms (force sensor).
const MOTION_POLL: Duration = Duration::from_millis(10);
const FORCE_POLL: Duration = Duration::from_millis(50);
const FIRST_PAUSE: Duration = Duration::from_millis(500);
const LONGEST_PAUSE: Duration = Duration::from_secs(30);

#[derive(Debug, Default)]
struct Progress {
    deadline: Option<Instant>,
    bytes: u64,
    /// Footers that came, and recordings of the force sensor that ended without one.
    footers: u32,
    broken_off: bool,
    /// A recording of the force sensor has begun, and its footer has not come.
    is_open: bool,
    /// Looks at the status nodes in a row that found an open recording stopped and its queue empty.
    stopped: u32,
}

/// Looks at the status nodes after which a recording that stopped without a footer counts as ended.
const STOPPED_LOOKS: u32 = 4;

impl Acquisition {
    /// Connects for the first time and writes the settings. `None`: `stop` was cancelled.
    pub async fn connect(&self, connector: &dyn SourceConnector) -> Result<Option<Box<dyn PacketSource>>, SourceError> {
        self.unless_stopped(self.open(connector)).await.transpose()
    }

    /// Runs until a limit is reached, `stop` is cancelled, or an error that a later try does not mend.
    ///
    /// # Errors
    /// If the controller refuses a setting or a login later on, or if the receiver of the entries is gone.
    pub async fn run(
        &self,
        mut source: Box<dyn PacketSource>,
        connector: &dyn SourceConnector,
    ) -> Result<StopReason, AcquisitionError> {
        let deadline = self.limits.duration.map(|duration| Instant::now() + duration);
        let mut progress = Progress { deadline, ..Progress::default() };
        loop {
            match self.follow(source.as_mut(), &mut progress).await {
                Ok(reason) => {
                    source.close().await;
                    return Ok(reason);
                }
                Err(AcquisitionError::Source(error)) if error.may_pass() => {
                    tracing::info!(%error, "connecting again");
                    self.monitor.enter(RecordingPhase::reconnecting(&error));
                    self.send(Entry::ConnectionLost(error.to_string())).await?;
                }
                Err(error) => {
                    source.close().await;
                    return Err(error);
                }
            }
            source = match self.reopen(connector, &progress).await? {
                Ok(source) => source,
                Err(reason) => return Ok(reason),
            };
        }
    }

    async fn open(&self, connector: &dyn SourceConnector) -> Result<Box<dyn PacketSource>, SourceError> {
        let mut source = connector.connect().await?;
        match source.configure(&self.settings).await {
            Ok(()) => Ok(source),
            Err(error) => {
                source.close().await;
                Err(error)
            }
        }
    }

    async fn reopen(
        &self,
        connector: &dyn SourceConnector,
        progress: &Progress,
    ) -> Result<Result<Box<dyn PacketSource>, StopReason>, AcquisitionError> {
        let mut pause = FIRST_PAUSE;
        loop {
            if let Some(reason) = self.pause(pause, progress).await {
                return Ok(Err(reason));
            }
            pause = (pause * 2).min(LONGEST_PAUSE);
            match self.unless_stopped(self.open(connector)).await {
                None => return Ok(Err(StopReason::Request)),
                Some(Ok(source)) => return Ok(Ok(source)),
                Some(Err(error)) if error.may_pass() => {
                    tracing::info!(%error, "still not connected");
                    self.monitor.enter(RecordingPhase::reconnecting(&error));
                }
                Some(Err(error)) => return Err(error.into()),
            }
        }
    }

    async fn follow(
        &self,
        source: &mut dyn PacketSource,
        progress: &mut Progress,
    ) -> Result<StopReason, AcquisitionError> {
        let poll = match self.settings.source() {
            Source::Force { .. } => FORCE_POLL,
            Source::Motion { .. } => MOTION_POLL,
        };
        loop {
            let status = source.status().await?;
            let mut has_data = status.has_data;
            let is_active = status.is_running || has_data;
            self.monitor.enter(if is_active { RecordingPhase::Running } else { RecordingPhase::Waiting });
            if status.error == ErrorStatus::Error && !progress.broken_off {
                self.send(Entry::BrokenOff).await?;
            }
            progress.broken_off = status.error == ErrorStatus::Error;
            if progress.is_open && !status.is_running && !has_data {
                progress.stopped += 1;
                if progress.stopped == STOPPED_LOOKS {
                    // The footer was overwritten, or lost with a connection.
                    self.send(Entry::BrokenOff).await?;
                    progress.is_open = false;
                    progress.footers += 1;
                }
            } else {
                progress.stopped = 0;
            }
            while has_data {
                let delivery = source.read().await?;
                has_data = delivery.has_more && delivery.packet.is_some();
                if let Some(bytes) = delivery.packet {
                    progress.bytes += bytes.len() as u64;
                    let is_footer = self.is_footer(&bytes);
                    progress.footers += u32::from(is_footer);
                    progress.is_open = self.is_force() && !is_footer;
                    let overwritten = delivery.error == ErrorStatus::Warning;
                    if overwritten {
                        self.monitor.update(|progress| progress.warnings += 1);
                    }
                    self.send(Entry::Packet { bytes, overwritten }).await?;
                }
                if let Some(reason) = self.reached(progress) {
                    return Ok(reason);
                }
            }
            if let Some(reason) = self.pause(poll, progress).await {
                return Ok(reason);
            }
        }
    }

    const fn is_force(&self) -> bool {
        matches!(self.settings.source(), Source::Force { .. })
    }

    fn is_footer(&self, bytes: &[u8]) -> bool {
        self.is_force() && bytes.first() == Some(&TAG_FOOTER)
    }

    fn reached(&self, progress: &Progress) -> Option<StopReason> {
        if self.limits.footers.is_some_and(|footers| progress.footers >= footers) {
            Some(StopReason::Footer)
        } else if self.limits.bytes.is_some_and(|bytes| progress.bytes >= bytes) {
            Some(StopReason::Size)
        } else if progress.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            Some(StopReason::Duration)
        } else {
            self.stop.is_cancelled().then_some(StopReason::Request)
        }
    }

    /// Waits, but not beyond the end of the recording.
    async fn pause(&self, pause: Duration, progress: &Progress) -> Option<StopReason> {
        let until = Instant::now() + pause;
        let until = progress.deadline.map_or(until, |deadline| until.min(deadline));
        let _stopped = self.stop.run_until_cancelled(tokio::time::sleep_until(until)).await;
        self.reached(progress)
    }

    async fn unless_stopped<T>(&self, work: impl Future<Output = T>) -> Option<T> {
        self.stop.run_until_cancelled(work).await
    }

    async fn send(&self, entry: Entry) -> Result<(), AcquisitionError> {
        self.entries.send((journal::now(), entry)).await.map_err(|_| AcquisitionError::NotTaken)
    }
}
