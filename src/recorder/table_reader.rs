use std::path::{Path, PathBuf};

use super::csv_reader::CsvReader;
use super::decoder::Decoder;
use super::error::RecorderError;
use super::format::Format;
use super::parquet_reader::ParquetReader;
use super::sidecar::Sidecar;
use super::stored_columns::StoredColumns;
use super::table_fault::TableFault;
use super::table_writer::ROWS_TOGETHER;
use crate::records::columns::Column;

/// Reads a recording back from its CSV or Parquet file and the sidecar beside it, part by part. Blocks while it reads.
#[derive(Debug)]
pub struct TableReader {
    path: PathBuf,
    sidecar: Sidecar,
    file: OpenFile,
    columns: StoredColumns,
    /// Rows of this part.
    rows: usize,
    /// Rows of the parts before it.
    rows_before: u64,
}

#[derive(Debug)]
enum OpenFile {
    Csv(CsvReader),
    Parquet(Box<ParquetReader>),
}

/// A row group ends with the packet that reaches [`ROWS_TOGETHER`]; the largest has 1600 rows.
const MAX_ROWS: usize = ROWS_TOGETHER + ROWS_TOGETHER / 4;

impl TableReader {
    /// Opens a recording. `wanted`: names of the columns to be read, beside those that tell their time; `None`: all.
    ///
    /// # Errors
    /// If the file or the sidecar cannot be read, or the file has other columns than such a recording.
    pub fn open(path: &Path, format: Format, wanted: Option<&[String]>) -> Result<Self, RecorderError> {
        let sidecar = Sidecar::beside(path)?;
        let decoder = Decoder::new(&sidecar.header.settings);
        let template = decoder.columns();
        let file = match format {
            Format::Csv => OpenFile::Csv(CsvReader::open(path, &template)?),
            Format::Parquet => OpenFile::Parquet(Box::new(ParquetReader::open(path, &template)?)),
        };
        let columns = StoredColumns::new(&template, wanted);
        Ok(Self { path: path.to_owned(), sidecar, file, columns, rows: 0, rows_before: 0 })
    }

    /// What the recording holds.
    pub const fn sidecar(&self) -> &Sidecar {
        &self.sidecar
    }

    /// Replaces the rows by those that follow them. Whether there are any.
    ///
    /// # Errors
    /// Also at the end, if there are more or fewer rows than the sidecar says.
    pub fn next_part(&mut self) -> Result<bool, RecorderError> {
        self.rows_before += self.rows as u64;
        let ends_in_block = !self.columns.are_whole_blocks();
        self.columns.clear();
        self.rows = match &mut self.file {
            OpenFile::Csv(file) => file.read(&mut self.columns, ROWS_TOGETHER)?,
            OpenFile::Parquet(file) => file.read(&mut self.columns, MAX_ROWS)?,
        };
        let found = self.rows_before + self.rows as u64;
        let described = self.sidecar.rows;
        let is_damaged = if self.rows > 0 { ends_in_block || found > described } else { found != described };
        if is_damaged {
            let source = TableFault::Rows { found, described };
            return Err(RecorderError::DamagedTable { path: self.path.clone(), source });
        }
        Ok(self.rows > 0)
    }

    /// The columns of this part.
    pub fn columns(&self) -> Vec<Column<'_>> {
        self.columns.columns()
    }

    /// Rows of this part.
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Rows before this part.
    pub const fn rows_before(&self) -> u64 {
        self.rows_before
    }
}
