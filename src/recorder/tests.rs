//! Recordings from a source that does what a controller does, and worse.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use async_trait::async_trait;
use chrono::DateTime;
use parking_lot::Mutex;
use tokio_util::sync::CancellationToken;

use super::*;
use crate::model::ErrorCode;
use crate::model::Problem;
use crate::records::Ticks;
use crate::records::force::{AllData, DataHead, ForceDataType, ForceFooter, ForceHeader, Header};
use crate::records::motion::{MotionBlock, SAMPLES};

/// What the source gives, one after another.
#[derive(Debug, Clone)]
enum Act {
    Packet(Vec<u8>),
    /// A packet, after samples were overwritten.
    Late(Vec<u8>),
    Empty,
    /// From here on MonitorStatus is `Stop`.
    Stopped,
    BrokenOff,
    Disconnect,
    RefuseConnection,
    RefuseSetting,
}

#[derive(Debug, Clone, Default)]
struct Controller {
    acts: Arc<Mutex<VecDeque<Act>>>,
    configured: Arc<Mutex<usize>>,
    closed: Arc<Mutex<usize>>,
}

impl Controller {
    fn new(acts: impl IntoIterator<Item = Act>) -> Self {
        Self { acts: Arc::new(Mutex::new(acts.into_iter().collect())), ..Self::default() }
    }

    fn next_if(&self, is_it: impl Fn(&Act) -> bool) -> Option<Act> {
        let mut acts = self.acts.lock();
        if acts.front().is_some_and(is_it) { acts.pop_front() } else { None }
    }

    fn lost() -> SourceError {
        SourceError::OddValue { node: "Data", value: "unused".into() }
    }
}

#[async_trait]
impl SourceConnector for Controller {
    async fn connect(&self) -> Result<Box<dyn PacketSource>, SourceError> {
        match self.next_if(|act| matches!(act, Act::RefuseConnection)) {
            Some(_) => Err(testing::lost()),
            None => Ok(Box::new(self.clone())),
        }
    }
}

#[async_trait]
impl PacketSource for Controller {
    async fn configure(&mut self, _: &RecordSettings) -> Result<(), SourceError> {
        *self.configured.lock() += 1;
        match self.next_if(|act| matches!(act, Act::RefuseSetting)) {
            Some(_) => Err(SourceError::SettingRefused { node: "DataNum", status: "BadOutOfRange".into() }),
            None => Ok(()),
        }
    }

    async fn status(&mut self) -> Result<SourceStatus, SourceError> {
        if self.next_if(|act| matches!(act, Act::Disconnect)).is_some() {
            return Err(testing::lost());
        }
        let has_data = matches!(self.acts.lock().front(), Some(Act::Packet(_) | Act::Late(_)));
        let error = match self.next_if(|act| matches!(act, Act::BrokenOff | Act::Empty)) {
            Some(Act::BrokenOff) => ErrorStatus::Error,
            _ => ErrorStatus::None,
        };
        let is_running = !matches!(self.acts.lock().front(), Some(Act::Stopped));
        Ok(SourceStatus { is_running, has_data, error })
    }

    async fn read(&mut self) -> Result<Delivery, SourceError> {
        let act = self.next_if(|act| matches!(act, Act::Packet(_) | Act::Late(_)));
        let has_more = matches!(self.acts.lock().front(), Some(Act::Packet(_) | Act::Late(_)));
        Ok(match act {
            Some(Act::Packet(bytes)) => Delivery { packet: Some(bytes), has_more, ..Delivery::default() },
            Some(Act::Late(bytes)) => Delivery { packet: Some(bytes), has_more, error: ErrorStatus::Warning },
            _ => Delivery::default(),
        })
    }

    async fn close(self: Box<Self>) {
        *self.closed.lock() += 1;
    }
}

/// Blocks with these numbers; a block spans 8 samples of 1 ms.
fn blocks(numbers: impl IntoIterator<Item = u64>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for number in numbers {
        let mut block = MotionBlock::default();
        for sample in 0..SAMPLES {
            let ticks = Ticks((number * SAMPLES as u64 + sample as u64 + 1) * 80_000);
            block.encoders[0][sample].timestamp = ticks;
            block.encoders[0][sample].position = -(number as i64);
        }
        block.tcp.timestamp = block.encoders[0][0].timestamp;
        block.tcp.components[0] = number as f64 + 0.5;
        block.encode_into(&mut bytes);
    }
    bytes
}

fn header(id: u16) -> Vec<u8> {
    let header = Header { id, interval: 0.002, ..Header::default() };
    ForceHeader { header, record_start: Some(Ticks(80_000_000)) }.encode()
}

fn data(id: u16, counts: impl IntoIterator<Item = u32>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for count in counts {
        let head = DataHead { version: 2, id, count, elapsed: 2 * count, ..DataHead::default() };
        let position = [count as f32 + 0.25; 6];
        AllData { head, position, ..AllData::default() }.reduced(ForceDataType::Position).encode_into(&mut bytes);
    }
    bytes
}

fn footer(id: u16) -> Vec<u8> {
    ForceFooter { version: 2, id, ..ForceFooter::default() }.encode().to_vec()
}

fn recording(folder: &Path, settings: RecordSettings, format: Format) -> Recording {
    let header = RecordingHeader {
        controller: "Weld 1".into(),
        serial: "R7A0000001".into(),
        url: "opc.tcp://127.0.0.1:4840".into(),
        settings,
        started_at: DateTime::from_timestamp_millis(1_800_000_000_123).unwrap(),
        format: format.extension().into(),
        keep_packets: false,
    };
    Recording {
        header,
        format,
        folder: folder.to_owned(),
        limits: StopLimits::default(),
        tap: None,
        monitor: ProgressMonitor::default(),
    }
}

async fn run(recording: Recording, controller: &Controller) -> RecordingEnd {
    let stop = CancellationToken::new();
    let run = recording.run(controller, stop, |_| {});
    tokio::time::timeout(Duration::from_secs(60), run).await.expect("the recording ends")
}

fn motion() -> RecordSettings {
    RecordSettings::motion(0, 0).unwrap()
}

fn force() -> RecordSettings {
    RecordSettings::force(3, 1, 0).unwrap()
}

fn causes(sidecar: &Sidecar) -> Vec<(GapCause, Option<u64>, u64)> {
    sidecar.gaps.iter().map(|gap| (gap.cause, gap.missing, gap.at_row)).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_force_recording_ends_with_its_footer_and_lost_records_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    let controller = Controller::new([
        Act::Empty,
        Act::Packet(header(7)),
        Act::Packet(data(7, 0..10)),
        Act::Late(data(7, 15..20)),
        Act::Empty,
        Act::Packet(footer(7)),
        Act::Packet(header(8)),
    ]);
    let limits = StopLimits { footers: Some(1), ..StopLimits::default() };
    let end = run(Recording { limits, ..recording(folder.path(), force(), Format::Csv) }, &controller).await;
    assert!(end.failure.is_none(), "{end:?}");
    let Recorded { file, sidecar_file, packets, sidecar } = end.recorded.unwrap();
    assert_eq!((sidecar.rows, sidecar.packets, sidecar.stopped_by), (15, 4, StopReason::Footer));
    assert_eq!(causes(&sidecar), [(GapCause::Overwritten, Some(5), 10)]);
    assert_eq!((sidecar.gaps[0].after, sidecar.gaps[0].until), (Some(9), Some(15)));
    assert_eq!((sidecar.recordings.len(), sidecar.recordings[0].end_condition), (1, Some(0)));
    assert_eq!(sidecar.time_base.unwrap().first_ticks, Ticks::PER_SECOND);
    assert_eq!((packets, Sidecar::read(&sidecar_file).unwrap()), (None, sidecar));
    assert_eq!((*controller.closed.lock(), controller.acts.lock().len()), (1, 1), "closed; the next stays");
    let csv = std::fs::read_to_string(&file).unwrap();
    let mut lines = csv.lines();
    assert!(lines.next().unwrap().starts_with("OPCUACommonID,Count,ElapsedTime [ms],CurPos(X) [mm],"));
    assert_eq!(lines.next().unwrap(), "7,0,0,0.25,0.25,0.25,0.25,0.25,0.25,0,0,0,0");
    assert_eq!(lines.count(), 14);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "file and sidecar");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_force_recording_whose_footer_is_lost_ends_all_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let controller =
        Controller::new([Act::Packet(header(7)), Act::Packet(data(7, 0..3)), Act::Disconnect, Act::Stopped]);
    let limits = StopLimits { footers: Some(1), ..StopLimits::default() };
    let end = run(Recording { limits, ..recording(folder.path(), force(), Format::Csv) }, &controller).await;
    let sidecar = end.recorded.unwrap().sidecar;
    assert_eq!((sidecar.rows, sidecar.stopped_by, sidecar.recordings[0].end_condition), (3, StopReason::Footer, None));
    assert_eq!(causes(&sidecar), [(GapCause::BrokenOff, None, 3)]);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_lost_connection_is_a_gap_and_the_recording_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let controller = Controller::new([
        Act::Packet(blocks(0..4)),
        Act::Disconnect,
        Act::RefuseConnection,
        Act::Packet(blocks(9..11)),
        Act::BrokenOff,
        Act::Packet(blocks(11..12)),
        Act::Packet(blocks(14..15)),
        Act::Packet(vec![1, 2, 3]),
        Act::Packet(blocks(0..2)),
    ]);
    let limits = StopLimits { bytes: Some(10 * 2608 + 3), ..StopLimits::default() };
    let end = run(Recording { limits, ..recording(folder.path(), motion(), Format::Csv) }, &controller).await;
    let sidecar = end.recorded.unwrap().sidecar;
    assert_eq!(
        causes(&sidecar),
        [
            (GapCause::ConnectionLost, Some(5), 32),
            (GapCause::BrokenOff, Some(0), 56),
            (GapCause::Unexplained, Some(2), 56),
            (GapCause::Undecodable, None, 64),
            (GapCause::ControllerRestarted, None, 64),
        ]
    );
    assert_eq!((sidecar.missing(), sidecar.undecodable, sidecar.rows), (7, 1, 80));
    assert_eq!((*controller.configured.lock(), sidecar.stopped_by), (2, StopReason::Size));
}

#[tokio::test(flavor = "multi_thread")]
async fn what_a_later_try_does_not_mend_ends_the_recording() {
    let folder = tempfile::tempdir().unwrap();
    for (act, code) in [
        (Act::RefuseSetting, ErrorCode::DataSettingsRefused),
        (Act::RefuseConnection, ErrorCode::OpcUaConnectionFailed),
    ] {
        let end = run(recording(folder.path(), motion(), Format::Csv), &Controller::new([act])).await;
        assert_eq!(Problem::from(end.failure.unwrap()).code, code);
        assert!(end.recorded.is_none() && std::fs::read_dir(folder.path()).unwrap().next().is_none());
    }
    assert_eq!(Problem::from(Controller::lost()).code, ErrorCode::NoDataNodes);
    // Refused after the connection was lost: what is there is complete.
    let controller = Controller::new([Act::Packet(blocks(0..2)), Act::Disconnect, Act::RefuseSetting]);
    let end = run(recording(folder.path(), motion(), Format::Parquet), &controller).await;
    assert_eq!(Problem::from(end.failure.unwrap()).code, ErrorCode::DataSettingsRefused);
    let recorded = end.recorded.unwrap();
    assert_eq!((recorded.sidecar.rows, recorded.sidecar.stopped_by), (16, StopReason::Error));
    assert!(recorded.file.exists());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_recording_ends_when_it_is_asked_to_and_when_its_time_is_over() {
    let folder = tempfile::tempdir().unwrap();
    let controller = Controller::new([Act::Packet(blocks(0..1))]);
    let limits = StopLimits { duration: Some(Duration::from_millis(100)), ..StopLimits::default() };
    let end = run(Recording { limits, ..recording(folder.path(), motion(), Format::Csv) }, &controller).await;
    assert_eq!(end.recorded.unwrap().sidecar.stopped_by, StopReason::Duration);
    let controller = Controller::new([Act::Packet(blocks(0..1)), Act::Disconnect]);
    let stop = CancellationToken::new();
    let cancel = stop.clone();
    let end = recording(folder.path(), motion(), Format::Csv).run(&controller, stop, |_| cancel.cancel()).await;
    assert_eq!(end.recorded.unwrap().sidecar.stopped_by, StopReason::Request);
}

#[tokio::test(flavor = "multi_thread")]
async fn plots_see_the_values_while_they_are_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let controller = Controller::new([Act::Packet(blocks(0..2)), Act::Late(blocks(4..5))]);
    let values = LiveValues::new(vec!["ENC_1.ENC_POS".to_owned(), "TCP.X".to_owned()]);
    let limits = StopLimits { bytes: Some(3 * 2608), ..StopLimits::default() };
    let tap = Some(LiveTap::new(values.clone()));
    run(Recording { limits, tap, ..recording(folder.path(), motion(), Format::Csv) }, &controller).await;
    values.read(|columns| {
        assert_eq!(columns.iter().map(|column| column.series.len()).collect::<Vec<_>>(), [24, 3]);
        let bars = columns[1].series.query(0.0..1.0, 100);
        let shown: Vec<_> = bars.iter().map(|bar| (bar.x, bar.max, bar.after_gap)).collect();
        assert_eq!(shown, [(0.0, 0.5, false), (0.008, 1.5, false), (0.032, 4.5, true)]);
    });
}

mod testing {
    use super::*;

    pub fn lost() -> SourceError {
        SourceError::Session(crate::session::opcua_client::ConnectFailure {
            stage: crate::session::opcua_client::ConnectStage::Read,
            cause: crate::session::opcua_client::ConnectFailureCause::Closed,
        })
    }
}
