//! The sidecar: what a recording is, as JSON beside its file.

use std::path::Path;

use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

use super::error::RecorderError;
use super::format::sidecar_path;
use super::journal::RecordingHeader;
use super::stop_reason::StopReason;
use crate::records::Ticks;
use crate::workspace::write_atomic;

/// What a recording holds, and what is missing in it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sidecar {
    /// 1.
    pub version: u32,
    /// Of the recording that the header describes.
    #[serde(flatten)]
    pub header: RecordingHeader,
    /// When the last packet came, or the recording ended.
    pub ended_at: DateTime<Utc>,
    /// Why the recording ended.
    pub stopped_by: StopReason,
    /// How time stamps become times; `None` without any.
    pub time_base: Option<TimeBase>,
    /// Rows of the file: force sensor records, or eight of each motion log block.
    pub rows: u64,
    /// Reads of the `Data` node that brought something.
    pub packets: u64,
    /// Bytes of the packets.
    pub bytes: u64,
    /// Seconds of the controller's time from the first sample to the last, to the microsecond.
    pub seconds: f64,
    /// Packets that could not be decoded. They are in the packet file only.
    pub undecodable: u64,
    /// What is missing.
    pub gaps: Vec<Gap>,
    /// Recordings of the force sensor, by their RecordStart.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<ForceRecording>,
    /// The columns of the file, in their order.
    pub columns: Vec<ColumnInfo>,
}

/// The time stamp at which the first packet began, and when it came by this computer's clock.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TimeBase {
    /// 80,000,000. Time stamps of a motion log count from the controller's last start.
    pub ticks_per_second: u64,
    /// Of a motion log: the first time stamp. Of force sensor data: RecordStartTime of the first header.
    pub first_ticks: u64,
    /// When the packet with it came, by the clock of this computer.
    pub received_at: DateTime<Utc>,
}

impl TimeBase {
    pub(super) fn new(first: Ticks, received_at: DateTime<Utc>) -> Self {
        Self { ticks_per_second: Ticks::PER_SECOND, first_ticks: first.0, received_at }
    }
}

/// A range that is missing.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Gap {
    /// Why it is missing.
    pub cause: GapCause,
    /// When it was noticed, by the clock of this computer.
    pub noticed_at: DateTime<Utc>,
    /// The last sample before it: ticks of a motion log, Count of force sensor data.
    pub after: Option<u64>,
    /// The first sample behind it.
    pub until: Option<u64>,
    /// How many records or blocks are missing; `None` where it cannot be known.
    pub missing: Option<u64>,
    /// Rows of the file before it.
    pub at_row: u64,
}

/// Why samples are missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GapCause {
    /// The controller's queue overwrote samples: ErrorStatus was `Warning`.
    Overwritten,
    /// ErrorStatus was `Error`.
    BrokenOff,
    /// The connection was lost for a while.
    ConnectionLost,
    /// The numbers or time stamps leave something out, and the controller said nothing.
    Unexplained,
    /// Time stamps begin anew.
    ControllerRestarted,
    /// A packet could not be decoded.
    Undecodable,
}

/// A recording of the force sensor: from RecordStart to its end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ForceRecording {
    /// OPCUACommonID.
    pub id: u16,
    /// By the controller's clock; `None` without a header.
    pub started: Option<String>,
    /// By the controller's clock; `None` without a footer.
    pub ended: Option<String>,
    /// Seconds between two samples.
    pub interval: Option<f32>,
    /// RecordStartTime of a header of version 2.
    pub record_start_ticks: Option<u64>,
    /// RobotNo of the header.
    pub robot_no: Option<i16>,
    /// RobotName of the header.
    pub robot_name: Option<String>,
    /// SensorNo of the header.
    pub sensor_no: Option<u8>,
    /// SensorSerial of the header.
    pub sensor_serial: Option<String>,
    /// SensorLabel of the header.
    pub sensor_label: Option<String>,
    /// The file name given to RecordStart.
    pub file_name: Option<String>,
    /// EndCondition of the footer.
    pub end_condition: Option<i8>,
    /// ErrorNo of the footer.
    pub error_no: Option<i16>,
}

/// A column of the file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ColumnInfo {
    /// As in the file.
    pub name: String,
    /// Empty for plain numbers.
    pub unit: String,
    /// `u8`, `i64`, `f32`, `time` and so on.
    #[serde(rename = "type")]
    pub value_type: String,
}

/// A larger sidecar is none: ten thousand gaps take 2 MB.
const MAX_SIDECAR_BYTES: u64 = 64 * 1024 * 1024;

impl Sidecar {
    /// How many records or blocks are missing, as far as it is known.
    pub fn missing(&self) -> u64 {
        self.gaps.iter().filter_map(|gap| gap.missing).sum()
    }

    /// Writes the sidecar, whole or not at all.
    pub fn write(&self, path: &Path) -> Result<(), RecorderError> {
        let failed = RecorderError::write(path);
        let json = match serde_json::to_vec_pretty(self) {
            Ok(json) => json,
            Err(error) => return Err(failed(std::io::Error::other(error))),
        };
        write_atomic(path, &json).map_err(|error| failed(std::io::Error::other(error)))
    }

    /// Reads the sidecar of a CSV or Parquet file.
    ///
    /// # Errors
    /// If the file itself is not there; [`RecorderError::NoDescription`] if the sidecar is not.
    pub fn beside(file: &Path) -> Result<Self, RecorderError> {
        // A name that is mistyped is reported, not that of the sidecar.
        std::fs::metadata(file).map_err(RecorderError::read(file))?;
        match Self::read(&sidecar_path(file)) {
            Err(RecorderError::Read { path, source }) if source.kind() == std::io::ErrorKind::NotFound => {
                Err(RecorderError::NoDescription(path))
            }
            other => other,
        }
    }

    /// Reads a sidecar.
    pub fn read(path: &Path) -> Result<Self, RecorderError> {
        use std::io::Read as _;
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(RecorderError::read(path))?;
        file.take(MAX_SIDECAR_BYTES).read_to_end(&mut bytes).map_err(RecorderError::read(path))?;
        let what = "the file beside it that describes the recording is damaged";
        serde_json::from_slice(&bytes).map_err(|_| RecorderError::NotARecording { path: path.to_owned(), what })
    }
}
