use std::path::{Path, PathBuf};

use super::csv_file::CsvFile;
use super::error::RecorderError;
use super::format::{Format, sidecar_path, unfinished_path};
use super::parquet_file::ParquetFile;
use super::sidecar::Sidecar;
use crate::platform::{private, replace};
use crate::records::columns::Column;

/// Writes columns as CSV or Parquet, and the sidecar beside them.
#[derive(Debug)]
pub struct TableWriter {
    file: OpenFile,
    format: Format,
    /// Where the file will be.
    path: PathBuf,
    /// Where it is until it is finished, if that is another place.
    unfinished: Option<Unfinished>,
}

#[derive(Debug)]
enum OpenFile {
    Csv(CsvFile),
    Parquet(Box<ParquetFile>),
}

/// When a file gets its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Appearance {
    /// From the beginning on, if the format can be read before its end: CSV.
    WhileWritten,
    /// Once it is complete. A file that does not get so far is removed.
    WhenComplete,
}

/// Rows of a Parquet row group; about 30 MB of a motion log.
pub const ROWS_TOGETHER: usize = 1 << 16;

impl TableWriter {
    /// Begins a file with these columns.
    ///
    /// # Errors
    /// If the file exists, or cannot be written.
    pub fn create(
        path: &Path,
        format: Format,
        appearance: Appearance,
        columns: &[Column<'_>],
    ) -> Result<Self, RecorderError> {
        if path.exists() {
            return Err(RecorderError::write(path)(std::io::ErrorKind::AlreadyExists.into()));
        }
        let is_apart = format == Format::Parquet || appearance == Appearance::WhenComplete;
        let unfinished = is_apart.then(|| Unfinished(unfinished_path(path)));
        let written = unfinished.as_ref().map_or(path, |unfinished| &unfinished.0);
        let file = match private::create_file(written) {
            Ok(file) => file,
            Err(error) => {
                let failed = RecorderError::write(written)(error);
                // It is not this writer's to remove.
                if let Some(unfinished) = unfinished {
                    unfinished.keep();
                }
                return Err(failed);
            }
        };
        let file = match format {
            Format::Csv => OpenFile::Csv(CsvFile::new(file, columns)),
            Format::Parquet => {
                let file = ParquetFile::new(file, columns)
                    .map_err(|source| RecorderError::Parquet { path: written.to_owned(), source })?;
                OpenFile::Parquet(Box::new(file))
            }
        };
        Ok(Self { file, format, path: path.to_owned(), unfinished })
    }

    /// What is written.
    pub const fn format(&self) -> Format {
        self.format
    }

    /// Appends rows; to Parquet, as a row group.
    pub fn append(&mut self, columns: &[Column<'_>], rows: usize) -> Result<(), RecorderError> {
        let written = self.unfinished.as_ref().map_or(&self.path, |unfinished| &unfinished.0);
        match &mut self.file {
            OpenFile::Csv(file) => file.append(columns, rows).map_err(RecorderError::write(written)),
            OpenFile::Parquet(file) => {
                file.append(columns, rows).map_err(|source| RecorderError::Parquet { path: written.to_owned(), source })
            }
        }
    }

    /// Bytes of the file so far.
    pub fn bytes(&self) -> u64 {
        match &self.file {
            OpenFile::Csv(file) => file.bytes(),
            OpenFile::Parquet(file) => file.bytes(),
        }
    }

    /// Completes the file, gives it its name, and writes the sidecar.
    pub fn finish(self, sidecar: &Sidecar) -> Result<(), RecorderError> {
        let Self { file, path, unfinished, .. } = self;
        match file {
            OpenFile::Csv(file) => file.finish().map_err(RecorderError::write(&path))?,
            OpenFile::Parquet(file) => {
                file.finish().map_err(|source| RecorderError::Parquet { path: path.clone(), source })?;
            }
        }
        if let Some(unfinished) = unfinished {
            replace::rename(&unfinished.0, &path).map_err(RecorderError::write(&path))?;
            unfinished.keep();
        }
        sidecar.write(&sidecar_path(&path))
    }
}

/// A file that is removed unless it is kept.
#[derive(Debug)]
struct Unfinished(PathBuf);

impl Unfinished {
    fn keep(mut self) {
        self.0 = PathBuf::new();
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if !self.0.as_os_str().is_empty()
            && let Err(error) = replace::remove_if_there(&self.0)
        {
            tracing::warn!(path = %self.0.display(), %error, "an unfinished file stays");
        }
    }
}
