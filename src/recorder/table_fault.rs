use parquet::errors::ParquetError;
use thiserror::Error;

/// What is wrong with a CSV or Parquet file. Rows are counted from 1, without the line of names.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TableFault {
    /// The names, types or order of the columns are not those of the recording that the sidecar describes.
    #[error("the columns are not those of the recording that the file beside it describes")]
    OtherColumns,
    /// The row is not complete, has too many values, or is no text.
    #[error("row {row} does not have one value for each column")]
    Row {
        /// Number of the row.
        row: u64,
    },
    /// One value is wrong.
    #[error("row {row}, column {column}: {fault}")]
    Cell {
        /// Number of the row.
        row: u64,
        /// Name of the column.
        column: String,
        /// What is wrong.
        fault: CellFault,
    },
    /// The number of rows is not that of the sidecar, or a row group ends inside of a block.
    #[error("the file has {found} rows, and the file beside it describes {described}")]
    Rows {
        /// Rows up to the fault.
        found: u64,
        /// Rows of the sidecar.
        described: u64,
    },
    /// The Parquet library has no explanation for what it found.
    #[error("the file is no Parquet, or it is damaged")]
    Unreadable,
    /// The Parquet library cannot read the file.
    #[error(transparent)]
    Parquet(#[from] ParquetError),
}

/// What is wrong with one value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum CellFault {
    /// Other columns say that there is one.
    #[error("the value is missing")]
    Missing,
    /// The item has no time stamp in this row, or the row is inside of a block.
    #[error("there is a value where the recording has none")]
    Unexpected,
    /// Not a number or a time, or out of the range of the column.
    #[error("the value does not fit the column")]
    OutOfRange,
}
