//! The columns of a recording while they are read back from its file. What a file of this program cannot hold is an
//! error: a value without its time stamp, a time stamp without its value, a value between two blocks.

use chrono::NaiveDateTime;

use super::csv_file::TIME_FORMAT;
use super::live::ELAPSED_TIME;
use super::table_fault::CellFault;
use crate::records::columns::{Column, NO_TIME, Values};

/// Columns of a recording, or those of them that are wanted.
#[derive(Debug)]
pub struct StoredColumns(Vec<StoredColumn>);

#[derive(Debug)]
struct StoredColumn {
    name: String,
    unit: &'static str,
    rows_per_value: usize,
    /// Where the column is in the file.
    position: usize,
    /// Which of the columns has the time stamps.
    timestamps: Option<usize>,
    values: StoredValues,
    /// Rows since the values were cleared.
    rows: usize,
}

impl StoredColumns {
    /// The columns of `template` without values: all, or those with the names `wanted` and the columns that tell their
    /// time.
    pub fn new(template: &[Column<'_>], wanted: Option<&[String]>) -> Self {
        let stamps = |column: &Column<'_>| column.timestamps.map(|_| format!("{}.TIMESTAMP", item(&column.name)));
        let is_wanted = |name: &String| {
            let Some(wanted) = wanted else { return true };
            let tells_time = |of: &Column<'_>| wanted.contains(&of.name) && stamps(of).as_ref() == Some(name);
            wanted.contains(name) || name == ELAPSED_TIME || template.iter().any(tells_time)
        };
        let kept = template.iter().enumerate().filter(|(_, column)| is_wanted(&column.name));
        let mut columns: Vec<StoredColumn> = Vec::new();
        for (position, column) in kept {
            // The time stamps are the first column of an item.
            let timestamps = stamps(column)
                .map(|name| columns.iter().position(|column| column.name == name).unwrap_or(columns.len()));
            columns.push(StoredColumn {
                name: column.name.clone(),
                unit: column.unit,
                rows_per_value: column.rows_per_value,
                position,
                timestamps,
                values: StoredValues::of(&column.values),
                rows: 0,
            });
        }
        Self(columns)
    }

    /// How many columns there are.
    pub const fn len(&self) -> usize {
        self.0.len()
    }

    /// Where a column is in the file.
    pub fn position(&self, column: usize) -> usize {
        self.0[column].position
    }

    /// The name of a column.
    pub fn name(&self, column: usize) -> &str {
        &self.0[column].name
    }

    /// The columns with their values.
    pub fn columns(&self) -> Vec<Column<'_>> {
        let columns = self.0.iter().map(|column| Column {
            name: column.name.clone(),
            unit: column.unit,
            values: column.values.values(),
            timestamps: column.timestamps.map(|index| self.0[index].values.stamps()),
            rows_per_value: column.rows_per_value,
        });
        columns.collect()
    }

    /// Whether a block begins after the last row.
    pub fn are_whole_blocks(&self) -> bool {
        self.0.iter().all(|column| column.rows.is_multiple_of(column.rows_per_value))
    }

    /// Removes every value and keeps the memory.
    pub fn clear(&mut self) {
        for column in &mut self.0 {
            column.values.clear();
            column.rows = 0;
        }
    }

    /// Appends a row to a column; the columns of a row come in their order. `None`: the file has no value there.
    pub fn push(&mut self, column: usize, cell: Option<impl Cell>) -> Result<(), CellFault> {
        let row = self.0[column].rows;
        let presence = self.presence(column, row);
        let StoredColumn { rows_per_value, values, rows, .. } = &mut self.0[column];
        *rows += 1;
        match (cell, presence) {
            (None, Presence::Required) => Err(CellFault::Missing),
            (Some(_), Presence::Excluded) => Err(CellFault::Unexpected),
            (Some(cell), _) => cell.push_to(values).ok_or(CellFault::OutOfRange),
            (None, _) => {
                if row.is_multiple_of(*rows_per_value) {
                    values.push_missing();
                }
                Ok(())
            }
        }
    }

    fn presence(&self, column: usize, row: usize) -> Presence {
        let StoredColumn { rows_per_value, timestamps, values, .. } = &self.0[column];
        if !row.is_multiple_of(*rows_per_value) {
            return Presence::Excluded;
        }
        match timestamps {
            Some(stamps) if *stamps == column => Presence::Optional,
            Some(stamps) => match self.0[*stamps].values.stamps().get(row / rows_per_value) {
                Some(0) | None => Presence::Excluded,
                Some(_) => Presence::Required,
            },
            None if matches!(values, StoredValues::Time(_)) => Presence::Optional,
            None => Presence::Required,
        }
    }
}

enum Presence {
    Required,
    Optional,
    Excluded,
}

/// `ENC_1` of `ENC_1.ENC_POS`.
fn item(name: &str) -> &str {
    name.split_once('.').map_or(name, |(item, _)| item)
}

/// A value as a file has it.
pub trait Cell {
    /// Appends the value; `None` if it does not fit.
    fn push_to(self, values: &mut StoredValues) -> Option<()>;
}

macro_rules! stored_values {
    ($($kind:ident $number:ty),*) => {
        /// [`Values`] that are owned.
        #[derive(Debug)]
        pub enum StoredValues {
            $($kind(Vec<$number>),)*
            Time(Vec<i64>),
        }

        impl StoredValues {
            fn of(values: &Values<'_>) -> Self {
                match values {
                    $(Values::$kind(_) => Self::$kind(Vec::new()),)*
                    Values::Time(_) => Self::Time(Vec::new()),
                }
            }

            const fn values(&self) -> Values<'_> {
                match self {
                    $(Self::$kind(values) => Values::$kind(values.as_slice()),)*
                    Self::Time(values) => Values::Time(values.as_slice()),
                }
            }

            fn clear(&mut self) {
                match self {
                    $(Self::$kind(values) => values.clear(),)*
                    Self::Time(values) => values.clear(),
                }
            }

            fn push_missing(&mut self) {
                match self {
                    $(Self::$kind(values) => values.push(<$number>::default()),)*
                    Self::Time(values) => values.push(NO_TIME),
                }
            }
        }

        impl Cell for &str {
            fn push_to(self, values: &mut StoredValues) -> Option<()> {
                match values {
                    $(StoredValues::$kind(values) => values.push(self.parse().ok()?),)*
                    StoredValues::Time(values) => {
                        let time = NaiveDateTime::parse_from_str(self, TIME_FORMAT).ok()?;
                        values.push(time.and_utc().timestamp_millis());
                    }
                }
                Some(())
            }
        }
    };
}

stored_values!(U8 u8, I8 i8, U16 u16, I16 i16, U32 u32, I32 i32, U64 u64, I64 i64, F32 f32, F64 f64);

impl StoredValues {
    fn stamps(&self) -> &[u64] {
        match self {
            Self::U64(values) => values,
            _ => &[],
        }
    }
}

/// Parquet stores all numbers of up to 32 bits so; unsigned ones of 32 bits by their bits.
impl Cell for i32 {
    fn push_to(self, values: &mut StoredValues) -> Option<()> {
        match values {
            StoredValues::U8(values) => values.push(self.try_into().ok()?),
            StoredValues::I8(values) => values.push(self.try_into().ok()?),
            StoredValues::U16(values) => values.push(self.try_into().ok()?),
            StoredValues::I16(values) => values.push(self.try_into().ok()?),
            StoredValues::U32(values) => values.push(self.cast_unsigned()),
            StoredValues::I32(values) => values.push(self),
            _ => return None,
        }
        Some(())
    }
}

impl Cell for i64 {
    fn push_to(self, values: &mut StoredValues) -> Option<()> {
        match values {
            StoredValues::U64(values) => values.push(self.cast_unsigned()),
            StoredValues::I64(values) | StoredValues::Time(values) => values.push(self),
            _ => return None,
        }
        Some(())
    }
}

impl Cell for f32 {
    fn push_to(self, values: &mut StoredValues) -> Option<()> {
        let StoredValues::F32(values) = values else { return None };
        values.push(self);
        Some(())
    }
}

impl Cell for f64 {
    fn push_to(self, values: &mut StoredValues) -> Option<()> {
        let StoredValues::F64(values) = values else { return None };
        values.push(self);
        Some(())
    }
}
