use std::path::{Path, PathBuf};

use chrono::{DateTime, Utc};

use super::error::RecorderError;
use super::format::{Format, sidecar_path, unfinished_path};
use super::journal::{Entry, JournalReader, JournalWriter, RecordingHeader};
use super::live::LiveTap;
use super::progress::Progress;
use super::sidecar::Sidecar;
use super::stop_reason::StopReason;
use super::stored_recording::convert;
use super::table_file::TableFile;
use super::table_writer::Appearance;
use crate::model::file_names;
use crate::platform::{private, replace};

/// The extension of journals.
pub const PACKETS: &str = "packets";

/// Writes the files of a recording while it goes on: the journal, which survives the end of the process at any moment,
/// and the CSV or Parquet file. Blocks while it writes.
#[derive(Debug)]
pub struct RecordingFiles {
    journal: JournalWriter,
    journal_path: PathBuf,
    table: TableFile,
    table_path: PathBuf,
    keep_packets: bool,
}

/// A complete recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded {
    /// The CSV or Parquet file.
    pub file: PathBuf,
    /// The description beside it.
    pub sidecar_file: PathBuf,
    /// The packets, where they are kept.
    pub packets: Option<PathBuf>,
    /// What the recording holds.
    pub sidecar: Sidecar,
}

impl RecordingFiles {
    /// Makes the folder, if it is missing, and the files, named after controller, kind and start.
    pub fn create(folder: &Path, header: &RecordingHeader, format: Format) -> Result<Self, RecorderError> {
        private::create_folder(folder).map_err(RecorderError::write(folder))?;
        let stem = file_stem(header);
        let journal_path = folder.join(format!("{stem}.{PACKETS}"));
        let table_path = folder.join(format!("{stem}.{}", format.extension()));
        let journal = JournalWriter::create(&journal_path, header)?;
        let table = TableFile::create(&table_path, format, Appearance::WhileWritten, header)?;
        Ok(Self { journal, journal_path, table, table_path, keep_packets: header.keep_packets })
    }

    /// The CSV or Parquet file.
    pub fn path(&self) -> &Path {
        &self.table_path
    }

    /// Takes in an entry. It is safe after the next [`RecordingFiles::sync`].
    pub fn push(&mut self, at: DateTime<Utc>, entry: &Entry) -> Result<(), RecorderError> {
        self.journal.append(at, entry);
        self.table.push(at, entry)
    }

    /// Flushes the journal to the disk, and writes the rows of a CSV file.
    pub fn sync(&mut self) -> Result<(), RecorderError> {
        self.journal.sync()?;
        self.table.flush()
    }

    /// Shows the values to plots from now on.
    pub fn set_tap(&mut self, tap: LiveTap) {
        self.table.set_tap(tap);
    }

    /// Puts in what was taken in and written so far.
    pub fn report(&self, progress: &mut Progress) {
        let facts = self.table.facts();
        progress.rows = facts.rows;
        progress.packets = facts.packets;
        progress.bytes = facts.bytes;
        progress.file_bytes = self.table.bytes();
        progress.undecodable = facts.undecodable;
        progress.gaps = facts.gaps.len() as u64;
        progress.missing = facts.gaps.iter().filter_map(|gap| gap.missing).sum();
    }

    /// Completes the files. The journal is removed unless the packets are kept.
    pub fn finish(mut self, at: DateTime<Utc>, reason: StopReason) -> Result<Recorded, RecorderError> {
        self.push(at, &Entry::End(reason))?;
        self.journal.sync()?;
        let sidecar = self.table.finish(at, reason)?;
        drop(self.journal);
        recorded(self.table_path, self.journal_path, sidecar, self.keep_packets)
    }
}

fn recorded(file: PathBuf, packets: PathBuf, sidecar: Sidecar, keep: bool) -> Result<Recorded, RecorderError> {
    if !keep {
        replace::remove(&packets).map_err(RecorderError::write(&packets))?;
    }
    Ok(Recorded { sidecar_file: sidecar_path(&file), file, packets: keep.then_some(packets), sidecar })
}

/// `Weld 1` and the start become `Weld_1-force-20260601-083015-250`: letters and digits of any script stay.
fn file_stem(header: &RecordingHeader) -> String {
    let name = |c: char| if c.is_alphanumeric() || c == '-' { c } else { '_' };
    let controller: String = header.controller.chars().map(name).collect();
    let controller = if file_names::is_reserved(&controller) { format!("_{controller}") } else { controller };
    format!("{controller}-{}-{}", header.settings.name(), header.started_at.format("%Y%m%d-%H%M%S-%3f"))
}

/// Finishes the recordings that a program which was killed left in a folder: their files are made again from the
/// journals. Journals that another process is writing, that are complete, or that cannot be read are left alone.
pub fn recover(folder: &Path) -> Vec<Result<Recorded, RecorderError>> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut journals: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    journals.retain(|path| path.extension().is_some_and(|extension| extension == PACKETS));
    journals.sort();
    journals.iter().filter_map(|journal| recover_one(journal).transpose()).collect()
}

fn recover_one(path: &Path) -> Result<Option<Recorded>, RecorderError> {
    let file = private::open_file(path).map_err(RecorderError::write(path))?;
    if file.try_lock().is_err() {
        return Ok(None);
    }
    let Ok(journal) = JournalReader::open(path) else { return Ok(None) };
    let header = journal.header().clone();
    // A journal from elsewhere may have anything there.
    let Some(format) = Format::ALL.into_iter().find(|format| format.extension() == header.format) else {
        return Ok(None);
    };
    let table = path.with_extension(format.extension());
    if sidecar_path(&table).exists() {
        return Ok(None);
    }
    drop(journal);
    for unfinished in [&table, &unfinished_path(&table)] {
        replace::remove_if_there(unfinished).map_err(RecorderError::write(unfinished))?;
    }
    let sidecar = convert(path, &table)?;
    // Windows removes no file that is open.
    drop(file);
    recorded(table, path.to_owned(), sidecar, header.keep_packets).map(Some)
}

#[cfg(test)]
mod tests;
