//! What is done with a recording that is there, in any of its three kinds: packets, CSV, Parquet.

use std::ops::ControlFlow;
use std::path::Path;

use chrono::{DateTime, Utc};
use tokio_util::sync::CancellationToken;

use super::decoder::Decoder;
use super::error::RecorderError;
use super::format::Format;
use super::journal::{Entry, JournalReader, RecordingHeader};
use super::live::{LiveTap, LiveValues, RowBatch};
use super::sidecar::Sidecar;
use super::stop_reason::StopReason;
use super::table_file::{TableFile, sidecar};
use super::table_reader::TableReader;
use super::table_writer::{Appearance, ROWS_TOGETHER, TableWriter};

/// What a recording holds: of a packet file by decoding it, of a CSV or Parquet file by the sidecar beside it. A sidecar
/// stands for its file. Blocks while it reads.
pub fn summarise(path: &Path) -> Result<Sidecar, RecorderError> {
    if is_sidecar(path) {
        return Sidecar::read(path);
    }
    if Format::of(path).is_some() {
        return Sidecar::beside(path);
    }
    decode(JournalReader::open(path)?, |_| ControlFlow::Continue(()))
}

/// Makes a CSV or Parquet file, by the extension of `to`, and its sidecar from a recording of any kind. The values are the
/// same whatever way they took. Blocks while it reads and writes.
///
/// # Errors
/// If `from` is no recording, if it is damaged, if the extension of `to` is another one, or if `to` exists. Then nothing is
/// written.
pub fn convert(from: &Path, to: &Path) -> Result<Sidecar, RecorderError> {
    let format = Format::of(to).ok_or_else(|| RecorderError::UnknownFormat(to.to_owned()))?;
    match Format::of(from) {
        Some(stored) => convert_table(TableReader::open(from, stored, None)?, to, format),
        None => convert_packets(JournalReader::open(from)?, to, format),
    }
}

fn convert_packets(mut journal: JournalReader, to: &Path, format: Format) -> Result<Sidecar, RecorderError> {
    let mut table = TableFile::create(to, format, Appearance::WhenComplete, journal.header())?;
    let (last, reason) = replay(&mut journal, |at, entry| {
        table.push(at, entry)?;
        Ok(ControlFlow::Continue(()))
    })?;
    table.finish(last, reason)
}

fn convert_table(mut reader: TableReader, to: &Path, format: Format) -> Result<Sidecar, RecorderError> {
    let mut writer = TableWriter::create(to, format, Appearance::WhenComplete, &reader.columns())?;
    while reader.next_part()? {
        writer.append(&reader.columns(), reader.rows())?;
    }
    writer.finish(reader.sidecar())?;
    Ok(reader.sidecar().clone())
}

/// What a recording of any kind is about. A sidecar stands for its file. Blocks for a moment.
pub fn header_of(path: &Path) -> Result<RecordingHeader, RecorderError> {
    if is_sidecar(path) {
        Ok(Sidecar::read(path)?.header)
    } else if Format::of(path).is_some() {
        Ok(Sidecar::beside(path)?.header)
    } else {
        Ok(JournalReader::open(path)?.header().clone())
    }
}

/// Reads the columns that `values` want, for plots. They are filled while the recording is read, and stay if that fails in
/// the middle; a sidecar stands for its file. Blocks until everything is read or `stop` is cancelled, which is no error:
/// of packets, the sidecar then describes what was read.
pub fn load(path: &Path, values: &LiveValues, stop: &CancellationToken) -> Result<Sidecar, RecorderError> {
    let described = is_sidecar(path).then(|| path.with_extension(""));
    let path = described.as_deref().unwrap_or(path);
    let mut tap = LiveTap::new(values.clone());
    let Some(format) = Format::of(path) else {
        return decode(JournalReader::open(path)?, |decoder| {
            tap.take(&decoder.batch(&decoder.columns()));
            if stop.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
    };
    let mut reader = TableReader::open(path, format, Some(&values.names()))?;
    loop {
        let has_more = reader.next_part()?;
        let sidecar = reader.sidecar();
        tap.take(&RowBatch {
            columns: &reader.columns(),
            first_row: reader.rows_before(),
            rows: reader.rows(),
            gaps: &sidecar.gaps,
            first_ticks: sidecar.time_base.map(|base| base.first_ticks),
        });
        if !has_more || stop.is_cancelled() {
            break;
        }
    }
    Ok(reader.sidecar().clone())
}

fn is_sidecar(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"))
}

/// Decodes a journal. `each` is called with the columns before they are cleared, and at the end.
fn decode(
    mut journal: JournalReader,
    mut each: impl FnMut(&Decoder) -> ControlFlow<()>,
) -> Result<Sidecar, RecorderError> {
    let mut decoder = Decoder::new(&journal.header().settings);
    let (last, reason) = replay(&mut journal, |at, entry| {
        decoder.push(at, entry);
        if decoder.rows() < ROWS_TOGETHER {
            return Ok(ControlFlow::Continue(()));
        }
        let next = each(&decoder);
        decoder.clear();
        Ok(next)
    })?;
    let _end = each(&decoder);
    Ok(sidecar(journal.header(), &decoder, last, reason))
}

/// Goes through a journal until its end or until `each` breaks off. When the last entry came, and why the recording ended.
fn replay(
    journal: &mut JournalReader,
    mut each: impl FnMut(DateTime<Utc>, &Entry) -> Result<ControlFlow<()>, RecorderError>,
) -> Result<(DateTime<Utc>, StopReason), RecorderError> {
    let (mut last, mut reason) = (journal.header().started_at, StopReason::Killed);
    while let Some((at, entry)) = journal.next_entry()? {
        last = at;
        if let Entry::End(end) = entry {
            reason = end;
        }
        if each(at, &entry)?.is_break() {
            break;
        }
    }
    Ok((last, reason))
}

#[cfg(test)]
mod tests;
