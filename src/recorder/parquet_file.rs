use std::fs::File;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, TimeUnit, Type as PhysicalType};
use parquet::data_type::{DataType, DoubleType, FloatType, Int32Type, Int64Type};
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::Type;

use crate::records::columns::{Column, NO_TIME, Values};

/// Writes columns as Apache Parquet: a row group for each [`ParquetFile::append`]. A column is optional, and null where
/// there is no value. The units are in the key `units` of the file's metadata, as a JSON object by name.
///
/// A Parquet file is readable only once it is finished, because its index is at its end.
pub struct ParquetFile {
    writer: SerializedFileWriter<File>,
}

impl std::fmt::Debug for ParquetFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ParquetFile").finish_non_exhaustive()
    }
}

impl ParquetFile {
    /// Begins the file.
    pub fn new(file: File, columns: &[Column<'_>]) -> Result<Self> {
        let fields = columns.iter().map(field).collect::<Result<Vec<_>>>()?;
        let schema = Type::group_type_builder("recording").with_fields(fields).build()?;
        let units: serde_json::Map<String, serde_json::Value> = columns
            .iter()
            .filter(|column| !column.unit.is_empty())
            .map(|column| (column.name.clone(), column.unit.into()))
            .collect();
        let units = serde_json::Value::Object(units).to_string();
        let properties = WriterProperties::builder()
            .set_created_by(concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")).to_owned())
            .set_key_value_metadata(Some(vec![KeyValue::new("units".to_owned(), units)]))
            .build();
        Ok(Self { writer: SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties))? })
    }

    /// Appends rows, as a row group.
    pub fn append(&mut self, columns: &[Column<'_>], rows: usize) -> Result<()> {
        if rows == 0 {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        let mut columns = columns.iter();
        while let (Some(mut writer), Some(column)) = (group.next_column()?, columns.next()) {
            write(&mut writer, column, rows)?;
            writer.close()?;
        }
        group.close()?;
        Ok(())
    }

    /// Bytes of the file so far.
    pub fn bytes(&self) -> u64 {
        self.writer.bytes_written() as u64
    }

    /// Writes the index, and flushes to the disk.
    pub fn finish(self) -> Result<()> {
        let file = self.writer.into_inner()?;
        file.sync_all()?;
        Ok(())
    }
}

/// The column as the schema describes it.
pub fn field(column: &Column<'_>) -> Result<Arc<Type>> {
    let integer = |bit_width, is_signed| Some(LogicalType::integer(bit_width, is_signed));
    let (physical, logical) = match column.values {
        Values::U8(_) => (PhysicalType::INT32, integer(8, false)),
        Values::I8(_) => (PhysicalType::INT32, integer(8, true)),
        Values::U16(_) => (PhysicalType::INT32, integer(16, false)),
        Values::I16(_) => (PhysicalType::INT32, integer(16, true)),
        Values::U32(_) => (PhysicalType::INT32, integer(32, false)),
        Values::I32(_) => (PhysicalType::INT32, integer(32, true)),
        Values::U64(_) => (PhysicalType::INT64, integer(64, false)),
        Values::I64(_) => (PhysicalType::INT64, integer(64, true)),
        Values::F32(_) => (PhysicalType::FLOAT, None),
        Values::F64(_) => (PhysicalType::DOUBLE, None),
        // By the controller's clock, whose zone is not known.
        Values::Time(_) => (PhysicalType::INT64, Some(LogicalType::timestamp(false, TimeUnit::MILLIS))),
    };
    let builder = Type::primitive_type_builder(&column.name, physical).with_repetition(Repetition::OPTIONAL);
    Ok(Arc::new(builder.with_logical_type(logical).build()?))
}

fn write(writer: &mut SerializedColumnWriter<'_>, column: &Column<'_>, rows: usize) -> Result<()> {
    let there = |row: usize| row.is_multiple_of(column.rows_per_value) && column.is_there(row / column.rows_per_value);
    match column.values {
        Values::U8(values) => of::<Int32Type, _>(writer, column, rows, there, values, i32::from),
        Values::I8(values) => of::<Int32Type, _>(writer, column, rows, there, values, i32::from),
        Values::U16(values) => of::<Int32Type, _>(writer, column, rows, there, values, i32::from),
        Values::I16(values) => of::<Int32Type, _>(writer, column, rows, there, values, i32::from),
        Values::U32(values) => of::<Int32Type, _>(writer, column, rows, there, values, u32::cast_signed),
        Values::I32(values) => of::<Int32Type, _>(writer, column, rows, there, values, |value| value),
        Values::U64(values) => of::<Int64Type, _>(writer, column, rows, there, values, u64::cast_signed),
        Values::I64(values) => of::<Int64Type, _>(writer, column, rows, there, values, |value| value),
        Values::F32(values) => of::<FloatType, _>(writer, column, rows, there, values, |value| value),
        Values::F64(values) => of::<DoubleType, _>(writer, column, rows, there, values, |value| value),
        Values::Time(values) => {
            let there = |row: usize| there(row) && values[row / column.rows_per_value] != NO_TIME;
            of::<Int64Type, _>(writer, column, rows, there, values, |value| value)
        }
    }
}

/// Writes the values that are there, and for each row whether there is one (definition level 1).
fn of<P: DataType, T: Copy>(
    writer: &mut SerializedColumnWriter<'_>,
    column: &Column<'_>,
    rows: usize,
    there: impl Fn(usize) -> bool,
    values: &[T],
    stored: impl Fn(T) -> P::T,
) -> Result<()> {
    let levels: Vec<i16> = (0..rows).map(|row| there(row).into()).collect();
    let present = levels.iter().enumerate().filter(|(_, level)| **level == 1);
    let values: Vec<P::T> = present.map(|(row, _)| stored(values[row / column.rows_per_value])).collect();
    writer.typed::<P>().write_batch(&values, Some(&levels), None)?;
    Ok(())
}
