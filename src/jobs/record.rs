use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

use super::FoundServer;
use crate::model::{ErrorCode, Problem, UserCredential, clock};
use crate::recorder::{
    Format, LiveTap, LiveValues, OpcUaConnector, Progress, ProgressMonitor, RecordSettings, Recorded, Recording,
    RecordingEnd, RecordingHeader, StopLimits,
};
use crate::session::opcua_client::{ConnectTimeouts, OpcUaClient, UserLogin};

/// A recording of one controller that is to be made.
#[derive(Debug, Clone)]
pub struct RecordRequest {
    /// The name in the list of controllers.
    pub name: String,
    /// Its OPC UA server, and what this program connects with.
    pub found: FoundServer,
    /// Who logs in; `None`: anonymous.
    pub login: Option<UserCredential>,
    /// What is recorded.
    pub settings: RecordSettings,
    /// What the packets are written as.
    pub format: Format,
    /// Whether the packets stay in a file of their own.
    pub keep_packets: bool,
    /// Where the files are made.
    pub folder: PathBuf,
    /// When the recording ends by itself.
    pub limits: StopLimits,
    /// Gets the values while they are recorded.
    pub values: Option<LiveValues>,
}

/// What a running recording reports.
#[derive(Debug, Clone, PartialEq)]
pub enum RecordEvent {
    /// The controller is connected, and the files are made: the path of the CSV or Parquet file.
    Started(PathBuf),
    /// What it is doing has changed, or how far it has come.
    Progress(Box<Progress>),
}

/// What a recording came to.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordEnd {
    /// The files, complete; `None` if they could not be written, or nothing was connected.
    pub recorded: Option<Recorded>,
    /// Why the recording ended early.
    pub problem: Option<Problem>,
}

/// Between two reports of the progress.
const REPORT: Duration = Duration::from_millis(200);

/// Records until a limit is reached, `stop` is cancelled, or an error ends the recording; then completes the files. A lost
/// connection is opened again.
pub async fn record(
    request: RecordRequest,
    stop: CancellationToken,
    on_event: impl Fn(RecordEvent) + Send + Sync,
) -> RecordEnd {
    let RecordRequest { name, found, login, settings, format, keep_packets, folder, limits, values } = request;
    let own = found.own;
    let client = tokio::task::spawn_blocking(move || OpcUaClient::new(&own, ConnectTimeouts::default()));
    let client = match client.await.unwrap_or_else(|error| Err(Problem::with_detail(ErrorCode::Internal, error))) {
        Ok(client) => Arc::new(client),
        Err(problem) => return RecordEnd { recorded: None, problem: Some(problem) },
    };
    let header = RecordingHeader {
        controller: name,
        serial: found.serial.to_string(),
        url: found.server.target.url(),
        settings,
        started_at: clock::now(),
        format: format.extension().to_owned(),
        keep_packets,
    };
    let connector = OpcUaConnector::new(found.server, client, UserLogin::of(login.as_ref()), settings);
    let monitor = ProgressMonitor::default();
    let recording =
        Recording { header, format, folder, limits, tap: values.map(LiveTap::new), monitor: monitor.clone() };
    let on_start = |file: &Path| on_event(RecordEvent::Started(file.to_owned()));
    let mut run = std::pin::pin!(recording.run(&connector, stop, on_start));
    let mut reports = tokio::time::interval(REPORT);
    reports.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let mut told = None;
    let mut tell = || {
        let progress = monitor.get();
        if told.as_ref() != Some(&progress) {
            told = Some(progress.clone());
            on_event(RecordEvent::Progress(Box::new(progress)));
        }
    };
    let RecordingEnd { recorded, failure } = loop {
        tokio::select! {
            end = &mut run => break end,
            _ = reports.tick() => tell(),
        }
    };
    tell();
    RecordEnd { recorded, problem: failure.map(Problem::from) }
}
