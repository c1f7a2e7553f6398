use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};

use super::csv_file::title;
use super::error::RecorderError;
use super::stored_columns::StoredColumns;
use super::table_fault::TableFault;
use crate::records::columns::Column;

/// Reads the rows of a CSV file that [`super::csv_file::CsvFile`] wrote. A byte order mark at the beginning and lines that
/// end without a carriage return are accepted.
#[derive(Debug)]
pub struct CsvReader {
    path: PathBuf,
    file: BufReader<File>,
    line: String,
    /// Cells of a line.
    cells: usize,
    /// Lines of values that were read.
    rows: u64,
}

/// A line of a motion log has at most 2.5 kB.
const MAX_LINE_BYTES: u64 = 1 << 16;

impl CsvReader {
    /// Opens a file.
    ///
    /// # Errors
    /// If its first line does not name the columns of `template`.
    pub fn open(path: &Path, template: &[Column<'_>]) -> Result<Self, RecorderError> {
        let file = File::open(path).map_err(RecorderError::read(path))?;
        let file = BufReader::with_capacity(1 << 18, file);
        let mut reader = Self { path: path.to_owned(), file, line: String::new(), cells: template.len(), rows: 0 };
        let expected = template.iter().map(title).collect::<Vec<_>>().join(",");
        if !reader.next_line()? || reader.line.trim_start_matches('\u{feff}') != expected {
            return Err(reader.damaged(TableFault::OtherColumns));
        }
        Ok(reader)
    }

    /// Appends up to `rows` rows to the columns. How many there were.
    pub fn read(&mut self, columns: &mut StoredColumns, rows: usize) -> Result<usize, RecorderError> {
        for row in 0..rows {
            if !self.next_line()? {
                return Ok(row);
            }
            self.rows += 1;
            if let Err(fault) = push_line(&self.line, self.cells, self.rows, columns) {
                return Err(self.damaged(fault));
            }
        }
        Ok(rows)
    }

    /// Reads a line without its end. Whether there is one.
    fn next_line(&mut self) -> Result<bool, RecorderError> {
        self.line.clear();
        let read = (&mut self.file).take(MAX_LINE_BYTES).read_line(&mut self.line);
        match read {
            Ok(0) => return Ok(false),
            Ok(bytes) if bytes as u64 == MAX_LINE_BYTES => {
                return Err(self.damaged(TableFault::Row { row: self.rows + 1 }));
            }
            Ok(_) => {}
            Err(error) if error.kind() == std::io::ErrorKind::InvalidData => {
                return Err(self.damaged(TableFault::Row { row: self.rows + 1 }));
            }
            Err(error) => return Err(RecorderError::read(&self.path)(error)),
        }
        let content = self.line.trim_end_matches(['\r', '\n']).len();
        self.line.truncate(content);
        Ok(true)
    }

    fn damaged(&self, source: TableFault) -> RecorderError {
        RecorderError::DamagedTable { path: self.path.clone(), source }
    }
}

fn push_line(line: &str, expected: usize, row: u64, columns: &mut StoredColumns) -> Result<(), TableFault> {
    let mut cells = line.split(',');
    if cells.clone().count() != expected {
        return Err(TableFault::Row { row });
    }
    let mut position = 0;
    for column in 0..columns.len() {
        let cell = cells.nth(columns.position(column) - position).filter(|cell| !cell.is_empty());
        position = columns.position(column) + 1;
        let pushed = columns.push(column, cell);
        pushed.map_err(|fault| TableFault::Cell { row, column: columns.name(column).to_owned(), fault })?;
    }
    Ok(())
}
