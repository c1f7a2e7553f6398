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
//! | `format` | [`Format`]: CSV or Parquet |
//! | `csv_file`, `parquet_file`, `table_writer` | columns → files |
//! | `table_file` | entries of a recording → file and sidecar |
//! | `csv_reader`, `parquet_reader`, `table_reader` | files → columns, part by part |
//! | `stored_columns` | columns whose values come from a file, checked |
//! | `sidecar` | [`Sidecar`]: what a recording holds, as JSON beside the file |
//! | `recording_files` | the files of one recording while they are written; recovering them |
//! | `stored_recording` | a recording of any kind: summarised, converted, loaded for plots |
//! | `recording` | [`Recording`]: acquisition and files together |
//! | `progress` | [`Progress`]: what a running recording is doing |
//! | `series`, `live` | values for plots, also while they are recorded |
//! | `quantity` | [`Quantity`]: columns that belong into one plot |
//!
//! ## What survives
//! Every packet goes to the journal (`.packets`), which is flushed to the disk at least each second; CSV and Parquet are
//! written beside it. In the end the sidecar is written and the journal removed, unless packets are kept. If the process
//! is killed, [`recover`] makes file and sidecar again from the journal: at most one second is lost.

mod acquisition;
mod csv_file;
mod csv_reader;
mod decoder;
mod error;
mod format;
mod journal;
mod live;
mod nodes;
mod opcua_source;
mod parquet_file;
mod parquet_reader;
mod problem;
mod progress;
mod quantity;
mod recording;
mod recording_files;
mod series;
mod settings;
mod sidecar;
mod source;
mod stop_reason;
mod stored_columns;
mod stored_recording;
mod table_fault;
mod table_file;
mod table_reader;
mod table_writer;

pub use acquisition::{Acquisition, AcquisitionError, StopLimits};
pub use error::RecorderError;
pub use format::{Format, sidecar_path};
pub use journal::{Entry, JournalReader, JournalWriter, RecordingHeader};
pub use live::{LiveColumn, LiveTap, LiveValues};
pub use opcua_source::{OpcUaConnector, OpcUaSource};
pub use progress::{Progress, ProgressMonitor, RecordingPhase};
pub use quantity::Quantity;
pub use recording::{Recording, RecordingEnd, RecordingError};
pub use recording_files::{PACKETS, Recorded, recover};
pub use series::{Bar, Series};
pub use settings::{RecordSettings, SettingsError, Source};
pub use sidecar::{ColumnInfo, ForceRecording, Gap, GapCause, Sidecar, TimeBase};
pub use source::{Delivery, ErrorStatus, PacketSource, SourceConnector, SourceError, SourceStatus};
pub use stop_reason::StopReason;
pub use stored_recording::{convert, header_of, load, summarise};
pub use table_fault::{CellFault, TableFault};

#[cfg(test)]
mod tests;
