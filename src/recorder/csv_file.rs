use std::fs::File;
use std::io::{self, Write as _};

use chrono::DateTime;

use crate::records::columns::{Column, NO_TIME, Values};

/// Writes columns as CSV: one line of names with units, `Fx [N]`, then one line a row. Where there is no value, the cell
/// is empty. Numbers have as many digits as are needed to read the same value again; times are by the controller's clock.
#[derive(Debug)]
pub struct CsvFile {
    file: File,
    buffer: Vec<u8>,
    written: u64,
}

impl CsvFile {
    /// Begins the file with the names of the columns.
    pub fn new(file: File, columns: &[Column<'_>]) -> Self {
        let mut buffer = columns.iter().map(title).collect::<Vec<_>>().join(",").into_bytes();
        buffer.extend_from_slice(b"\r\n");
        Self { file, buffer, written: 0 }
    }

    /// Appends rows.
    pub fn append(&mut self, columns: &[Column<'_>], rows: usize) -> io::Result<()> {
        for row in 0..rows {
            for (index, column) in columns.iter().enumerate() {
                if index > 0 {
                    self.buffer.push(b',');
                }
                let value = row / column.rows_per_value;
                if row % column.rows_per_value == 0 && column.is_there(value) {
                    cell(&mut self.buffer, &column.values, value)?;
                }
            }
            self.buffer.extend_from_slice(b"\r\n");
            if self.buffer.len() > MAX_BUFFER {
                self.flush()?;
            }
        }
        self.flush()
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.write_all(&self.buffer)?;
        self.written += self.buffer.len() as u64;
        self.buffer.clear();
        Ok(())
    }

    /// Bytes of the file so far.
    pub const fn bytes(&self) -> u64 {
        self.written
    }

    /// Writes what is left, and flushes to the disk.
    pub fn finish(mut self) -> io::Result<()> {
        self.flush()?;
        self.file.sync_all()
    }
}

/// What stands above a column: `Fx [N]`.
pub fn title(column: &Column<'_>) -> String {
    match column.unit {
        "" => column.name.clone(),
        unit => format!("{} [{unit}]", column.name),
    }
}

/// By the controller's clock, whose zone is not known.
pub const TIME_FORMAT: &str = "%Y-%m-%dT%H:%M:%S%.3f";

const MAX_BUFFER: usize = 1 << 20;

fn cell(line: &mut Vec<u8>, values: &Values<'_>, index: usize) -> io::Result<()> {
    match values {
        Values::U8(values) => write!(line, "{}", values[index]),
        Values::I8(values) => write!(line, "{}", values[index]),
        Values::U16(values) => write!(line, "{}", values[index]),
        Values::I16(values) => write!(line, "{}", values[index]),
        Values::U32(values) => write!(line, "{}", values[index]),
        Values::I32(values) => write!(line, "{}", values[index]),
        Values::U64(values) => write!(line, "{}", values[index]),
        Values::I64(values) => write!(line, "{}", values[index]),
        Values::F32(values) => write!(line, "{}", values[index]),
        Values::F64(values) => write!(line, "{}", values[index]),
        Values::Time(values) if values[index] == NO_TIME => Ok(()),
        Values::Time(values) => match DateTime::from_timestamp_millis(values[index]) {
            Some(time) => write!(line, "{}", time.format(TIME_FORMAT)),
            None => Ok(()),
        },
    }
}
