use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::schema::types::Type;

use super::error::RecorderError;
use super::parquet_file::field;
use super::stored_columns::{Cell, StoredColumns};
use super::table_fault::TableFault;
use crate::records::columns::Column;

/// Reads the rows of a Parquet file that [`super::parquet_file::ParquetFile`] wrote.
pub struct ParquetReader {
    path: PathBuf,
    file: SerializedFileReader<File>,
    /// The next row group.
    group: usize,
    /// Of the row group that is read, those of the wanted columns.
    columns: Vec<ColumnReader>,
    /// Rows of the row group that are not read yet.
    left: usize,
    /// Rows that were read.
    rows: u64,
}

impl std::fmt::Debug for ParquetReader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParquetReader").field("path", &self.path).finish_non_exhaustive()
    }
}

impl ParquetReader {
    /// Opens a file.
    ///
    /// # Errors
    /// If it has other columns than `template`.
    pub fn open(path: &Path, template: &[Column<'_>]) -> Result<Self, RecorderError> {
        let file = File::open(path).map_err(RecorderError::read(path))?;
        let damaged = |source| RecorderError::DamagedTable { path: path.to_owned(), source };
        let file = unless_panicking(|| Ok(SerializedFileReader::new(file)?)).map_err(damaged)?;
        let fields = file.metadata().file_metadata().schema_descr().root_schema().get_fields();
        let expected: Vec<_> =
            template.iter().map(field).collect::<Result<Vec<_>, _>>().map_err(|error| damaged(error.into()))?;
        let are_expected = fields.len() == expected.len()
            && fields.iter().zip(&expected).all(|(found, expected)| is_same_column(found, expected));
        if !are_expected {
            return Err(damaged(TableFault::OtherColumns));
        }
        Ok(Self { path: path.to_owned(), file, group: 0, columns: Vec::new(), left: 0, rows: 0 })
    }

    /// Appends up to `rows` rows of one row group to the columns. How many there were; 0 at the end.
    pub fn read(&mut self, columns: &mut StoredColumns, rows: usize) -> Result<usize, RecorderError> {
        let read = unless_panicking(|| self.read_batch(columns, rows));
        read.map_err(|source| RecorderError::DamagedTable { path: self.path.clone(), source })
    }

    fn read_batch(&mut self, columns: &mut StoredColumns, rows: usize) -> Result<usize, TableFault> {
        while self.left == 0 {
            if self.group == self.file.num_row_groups() {
                return Ok(0);
            }
            let group = self.file.get_row_group(self.group)?;
            self.group += 1;
            self.left = usize::try_from(group.metadata().num_rows()).unwrap_or_default();
            let readers = (0..columns.len()).map(|column| group.get_column_reader(columns.position(column)));
            self.columns = readers.collect::<Result<_, _>>()?;
        }
        let rows = rows.min(self.left);
        for (index, reader) in self.columns.iter_mut().enumerate() {
            match reader {
                ColumnReader::Int32ColumnReader(reader) => read_column(reader, rows, self.rows, index, columns)?,
                ColumnReader::Int64ColumnReader(reader) => read_column(reader, rows, self.rows, index, columns)?,
                ColumnReader::FloatColumnReader(reader) => read_column(reader, rows, self.rows, index, columns)?,
                ColumnReader::DoubleColumnReader(reader) => read_column(reader, rows, self.rows, index, columns)?,
                ColumnReader::BoolColumnReader(_)
                | ColumnReader::Int96ColumnReader(_)
                | ColumnReader::ByteArrayColumnReader(_)
                | ColumnReader::FixedLenByteArrayColumnReader(_) => return Err(TableFault::OtherColumns),
            }
        }
        self.left -= rows;
        self.rows += rows as u64;
        Ok(rows)
    }
}

/// The library panics on some damaged files. A reader that has failed is not used again.
fn unless_panicking<T>(read: impl FnOnce() -> Result<T, TableFault>) -> Result<T, TableFault> {
    catch_unwind(AssertUnwindSafe(read)).unwrap_or(Err(TableFault::Unreadable))
}

/// Name, type and what the type stands for.
fn is_same_column(found: &Type, expected: &Type) -> bool {
    let facts = |column: &Type| {
        let info = column.get_basic_info();
        (column.name().to_owned(), info.has_repetition().then(|| info.repetition()), info.logical_type_ref().cloned())
    };
    found.is_primitive() && found.get_physical_type() == expected.get_physical_type() && facts(found) == facts(expected)
}

fn read_column<T>(
    reader: &mut ColumnReaderImpl<T>,
    rows: usize,
    before: u64,
    column: usize,
    columns: &mut StoredColumns,
) -> Result<(), TableFault>
where
    T: DataType,
    T::T: Cell,
{
    // The metadata may promise more rows than there are: memory is taken as they come.
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    let (found, ..) = reader.read_records(rows, Some(&mut levels), None, &mut values)?;
    if found != rows || levels.len() != rows {
        return Err(TableFault::Row { row: before + found as u64 + 1 });
    }
    let mut values = values.into_iter();
    for (row, level) in (before + 1..).zip(levels) {
        let cell = if level == 0 { None } else { values.next() };
        let pushed = columns.push(column, cell);
        pushed.map_err(|fault| TableFault::Cell { row, column: columns.name(column).to_owned(), fault })?;
    }
    Ok(())
}
