use std::path::{Path, PathBuf};

use chrono::{DateTime, Utc};

use super::csv_file::CsvFile;
use super::decoder::{Decoder, Facts};
use super::error::RecorderError;
use super::journal::{Entry, RecordingHeader};
use super::live::LiveTap;
use super::parquet_file::ParquetFile;
use super::sidecar::{ColumnInfo, Sidecar};
use super::stop_reason::StopReason;
use crate::platform::{private, replace};
use crate::records::columns::Values;

/// What the packets of a recording are written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values: text, readable while it is written.
    Csv,
    /// Apache Parquet: columns, readable once it is finished.
    Parquet,
}

impl Format {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Csv, Self::Parquet];

    /// `csv` or `parquet`.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
        }
    }

    /// The format of a file with this extension, in upper or lower case.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        Self::ALL.into_iter().find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }
}

/// Writes the file of a recording, and the sidecar beside it, from the entries of the recording.
#[derive(Debug)]
pub struct TableFile {
    header: RecordingHeader,
    /// Where the file will be.
    path: PathBuf,
    /// Where it is until it is finished.
    unfinished: PathBuf,
    decoder: Decoder,
    file: OpenFile,
    tap: Option<LiveTap>,
}

#[derive(Debug)]
enum OpenFile {
    Csv(CsvFile),
    Parquet(Box<ParquetFile>),
}

/// Rows of a Parquet row group; about 30 MB of a motion log.
const ROWS_TOGETHER: usize = 1 << 16;

impl TableFile {
    /// Begins a file. CSV has its name from the beginning on; Parquet, which nothing can read before it is finished, gets
    /// it in the end.
    ///
    /// # Errors
    /// If the file exists, or cannot be written.
    pub fn create(path: &Path, format: Format, header: &RecordingHeader) -> Result<Self, RecorderError> {
        let decoder = Decoder::new(&header.settings);
        let unfinished = match format {
            Format::Csv => path.to_owned(),
            Format::Parquet => with_suffix(path, ".part"),
        };
        if path.exists() {
            return Err(RecorderError::write(path)(std::io::ErrorKind::AlreadyExists.into()));
        }
        let file = private::create_file(&unfinished).map_err(RecorderError::write(&unfinished))?;
        let file = match format {
            Format::Csv => OpenFile::Csv(CsvFile::new(file, &decoder.columns())),
            Format::Parquet => {
                let file = ParquetFile::new(file, &decoder.columns())
                    .map_err(|source| RecorderError::Parquet { path: unfinished.clone(), source })?;
                OpenFile::Parquet(Box::new(file))
            }
        };
        Ok(Self { header: header.clone(), path: path.to_owned(), unfinished, decoder, file, tap: None })
    }

    /// Shows the values to plots from now on.
    pub fn set_tap(&mut self, tap: LiveTap) {
        self.tap = Some(tap);
    }

    /// Takes in an entry.
    pub fn push(&mut self, at: DateTime<Utc>, entry: &Entry) -> Result<(), RecorderError> {
        self.decoder.push(at, entry);
        if let Some(tap) = &mut self.tap {
            tap.take(&self.decoder);
        }
        if self.decoder.rows() >= ROWS_TOGETHER { self.write() } else { Ok(()) }
    }

    /// Writes the rows of a CSV file that are not written yet. A row group of Parquet waits until it is large enough.
    pub fn flush(&mut self) -> Result<(), RecorderError> {
        match self.file {
            OpenFile::Csv(_) => self.write(),
            OpenFile::Parquet(_) => Ok(()),
        }
    }

    fn write(&mut self) -> Result<(), RecorderError> {
        let (columns, rows) = (self.decoder.columns(), self.decoder.rows());
        match &mut self.file {
            OpenFile::Csv(file) => {
                file.append(&columns, rows).map_err(RecorderError::write(&self.unfinished))?;
            }
            OpenFile::Parquet(file) => file
                .append(&columns, rows)
                .map_err(|source| RecorderError::Parquet { path: self.unfinished.clone(), source })?,
        }
        self.decoder.clear();
        if let Some(tap) = &mut self.tap {
            tap.cleared();
        }
        Ok(())
    }

    /// Writes what is left, gives the file its name, and writes the sidecar.
    pub fn finish(mut self, ended_at: DateTime<Utc>, stopped_by: StopReason) -> Result<Sidecar, RecorderError> {
        self.write()?;
        let columns = self.decoder.columns();
        let sidecar = sidecar(&self.header, self.decoder.facts(), &columns, ended_at, stopped_by);
        match self.file {
            OpenFile::Csv(file) => file.finish().map_err(RecorderError::write(&self.path))?,
            OpenFile::Parquet(file) => {
                let failed = |source| RecorderError::Parquet { path: self.unfinished.clone(), source };
                file.finish().map_err(failed)?;
            }
        }
        if self.unfinished != self.path {
            replace::rename(&self.unfinished, &self.path).map_err(RecorderError::write(&self.path))?;
        }
        sidecar.write(&sidecar_path(&self.path))?;
        Ok(sidecar)
    }
}

/// The sidecar of a file: `x.csv` → `x.csv.json`.
pub fn sidecar_path(file: &Path) -> PathBuf {
    with_suffix(file, ".json")
}

fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}

pub(super) fn sidecar(
    header: &RecordingHeader,
    facts: &Facts,
    columns: &[crate::records::columns::Column<'_>],
    ended_at: DateTime<Utc>,
    stopped_by: StopReason,
) -> Sidecar {
    let Facts { rows, packets, bytes, seconds, undecodable, time_base, gaps, recordings } = facts.clone();
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
        seconds,
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
