use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::table_fault::TableFault;

/// Why a recording cannot be written or read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecorderError {
    /// A file of the recording cannot be written.
    #[error("{}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// A file of the recording cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// The Parquet library could not write the file.
    #[error("{}: {source}", path.display())]
    Parquet {
        /// The file.
        path: PathBuf,
        /// What the library says.
        source: parquet::errors::ParquetError,
    },
    /// The file is no recording of this program, or its beginning is damaged.
    #[error("{}: {what}", path.display())]
    NotARecording {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        what: &'static str,
    },
    /// A CSV or Parquet file is not as this program writes it.
    #[error("{}: {source}", path.display())]
    DamagedTable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: TableFault,
    },
    /// This file, which describes the CSV or Parquet file beside it, is not there.
    #[error("{}", .0.display())]
    NoDescription(PathBuf),
    /// The file has an extension that is not one of a recording.
    #[error("{}: the extension has to be .csv or .parquet", .0.display())]
    UnknownFormat(PathBuf),
    /// The writing thread ended before the recording did.
    #[error("the recording was broken off")]
    BrokenOff,
}

impl RecorderError {
    pub(super) fn write(path: &Path) -> impl FnOnce(io::Error) -> Self + '_ {
        |source| Self::Write { path: path.to_owned(), source }
    }

    pub(super) fn read(path: &Path) -> impl FnOnce(io::Error) -> Self + '_ {
        |source| Self::Read { path: path.to_owned(), source }
    }
}
