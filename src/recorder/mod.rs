//! The recorder: takes the data of the force sensor or the motion log from a controller's OPC UA server and writes it to
//! files (manual 4.1, 4.3).
//!
//! | file | its one idea |
//! |---|---|
//! | `settings` | [`RecordSettings`]: what is recorded, in range |
//! | `source` | [`PacketSource`]: where packets come from, as seen by the recorder |
//! | `opcua_source` | [`OpcUaSource`]: packets of a controller, by its nodes |
//! | `nodes` | finds the nodes of force sensor and motion log |
//! | `acquisition` | [`Acquisition`]: follows a source, connects again, stops at limits |
//! | `decoder` | packets → columns, and what is missing |
//! | `journal` | every packet as it came, safe each second |
//! | `csv_file`, `parquet_file`, `table_file` | columns → files |
//! | `sidecar` | [`Sidecar`]: what a recording holds, as JSON beside the file |
//! | `recording_files` | the files of one recording together; converting, summarising, recovering them |
//! | `recording` | [`Recording`]: acquisition and files together |
//! | `series`, `live` | values for plots while they are recorded |
//!
//! ## What survives
//! Every packet goes to the journal (`.packets`), which is flushed to the disk at least each second; CSV and Parquet are
//! written beside it. In the end the sidecar is written and the journal removed, unless packets are kept. If the process
//! is killed, [`recover`] makes file and sidecar again from the journal: at most one second is lost.

mod acquisition;
mod csv_file;
mod decoder;
mod error;
mod journal;
mod live;
mod nodes;
mod opcua_source;
mod parquet_file;
mod problem;
mod recording;
mod recording_files;
mod series;
mod settings;
mod sidecar;
mod source;
mod stop_reason;
mod table_file;

pub use acquisition::{Acquisition, AcquisitionError, StopLimits};
pub use error::RecorderError;
pub use journal::{Entry, JournalReader, RecordingHeader};
pub use live::{LiveColumn, LiveTap, LiveValues};
pub use opcua_source::{OpcUaConnector, OpcUaSource};
pub use recording::{Recording, RecordingEnd, RecordingError};
pub use recording_files::{PACKETS, Recorded, convert, recover, summarise};
pub use series::{Bar, Series};
pub use settings::{RecordSettings, SettingsError, Source};
pub use sidecar::{ColumnInfo, ForceRecording, Gap, GapCause, Sidecar, TimeBase};
pub use source::{Delivery, ErrorStatus, PacketSource, SourceConnector, SourceError, SourceStatus};
pub use stop_reason::StopReason;
pub use table_file::{Format, sidecar_path};

#[cfg(test)]
mod tests;
