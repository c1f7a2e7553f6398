use std::path::Path;

use chrono::{DateTime, Utc};

use super::decoder::{Decoder, Facts};
use super::error::RecorderError;
use super::format::Format;
use super::journal::{Entry, RecordingHeader};
use super::live::LiveTap;
use super::sidecar::{ColumnInfo, Sidecar};
use super::stop_reason::StopReason;
use super::table_writer::{Appearance, ROWS_TOGETHER, TableWriter};
use crate::records::columns::Values;

/// Writes the file of a recording, and the sidecar beside it, from the entries of the recording.
#[derive(Debug)]
pub struct TableFile {
    header: RecordingHeader,
    decoder: Decoder,
    writer: TableWriter,
    tap: Option<LiveTap>,
}

impl TableFile {
    /// Begins a file. `appearance` is about CSV: Parquet, which nothing can read before it is finished, gets its name in
    /// the end.
    ///
    /// # Errors
    /// If the file exists, or cannot be written.
    pub fn create(
        path: &Path,
        format: Format,
        appearance: Appearance,
        header: &RecordingHeader,
    ) -> Result<Self, RecorderError> {
        let decoder = Decoder::new(&header.settings);
        let writer = TableWriter::create(path, format, appearance, &decoder.columns())?;
        Ok(Self { header: header.clone(), decoder, writer, tap: None })
    }

    /// Shows the values to plots from now on.
    pub fn set_tap(&mut self, tap: LiveTap) {
        self.tap = Some(tap);
    }

    /// Takes in an entry.
    pub fn push(&mut self, at: DateTime<Utc>, entry: &Entry) -> Result<(), RecorderError> {
        self.decoder.push(at, entry);
        if let Some(tap) = &mut self.tap {
            tap.take(&self.decoder.batch(&self.decoder.columns()));
        }
        if self.decoder.rows() >= ROWS_TOGETHER { self.write() } else { Ok(()) }
    }

    /// Writes the rows of a CSV file that are not written yet. A row group of Parquet waits until it is large enough.
    pub fn flush(&mut self) -> Result<(), RecorderError> {
        match self.writer.format() {
            Format::Csv => self.write(),
            Format::Parquet => Ok(()),
        }
    }

    fn write(&mut self) -> Result<(), RecorderError> {
        self.writer.append(&self.decoder.columns(), self.decoder.rows())?;
        self.decoder.clear();
        Ok(())
    }

    /// What is known of the recording so far.
    pub const fn facts(&self) -> &Facts {
        self.decoder.facts()
    }

    /// Bytes of the file so far, without rows that wait to be written.
    pub fn bytes(&self) -> u64 {
        self.writer.bytes()
    }

    /// Writes what is left, gives the file its name, and writes the sidecar.
    pub fn finish(mut self, ended_at: DateTime<Utc>, stopped_by: StopReason) -> Result<Sidecar, RecorderError> {
        self.write()?;
        let sidecar = sidecar(&self.header, &self.decoder, ended_at, stopped_by);
        self.writer.finish(&sidecar)?;
        Ok(sidecar)
    }
}

/// What a recording holds of which everything is decoded.
pub(super) fn sidecar(
    header: &RecordingHeader,
    decoder: &Decoder,
    ended_at: DateTime<Utc>,
    stopped_by: StopReason,
) -> Sidecar {
    let Facts { rows, packets, bytes, seconds, undecodable, time_base, gaps, recordings } = decoder.facts().clone();
    let columns = decoder.columns();
    let columns = columns
        .iter()
        .map(|column| ColumnInfo {
            name: column.name.clone(),
            unit: column.unit.to_owned(),
            value_type: type_name(&column.values).to_owned(),
        })
        .collect();
    Sidecar {
        version: 1,
        header: header.clone(),
        ended_at,
        stopped_by,
        time_base,
        rows,
        packets,
        bytes,
        // So short a number is the same after it was written as JSON and read.
        seconds: (seconds * 1e6).round() / 1e6,
        undecodable,
        gaps,
        recordings,
        columns,
    }
}

const fn type_name(values: &Values<'_>) -> &'static str {
    match values {
        Values::U8(_) => "u8",
        Values::I8(_) => "i8",
        Values::U16(_) => "u16",
        Values::I16(_) => "i16",
        Values::U32(_) => "u32",
        Values::I32(_) => "i32",
        Values::U64(_) => "u64",
        Values::I64(_) => "i64",
        Values::F32(_) => "f32",
        Values::F64(_) => "f64",
        Values::Time(_) => "time",
    }
}
