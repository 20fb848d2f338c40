//! Tables as Parquet, for column stores and notebooks.

use std::io;
use std::path::Path;
use std::sync::Arc;

use adslam_diagnostics::Failure;
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};
use serde_json::Value;

use super::column::{Column, ColumnKind, text};
use crate::AtomicFile;

/// Rows that are written at once.
const ROW_GROUP: usize = 16_384;

/// A table that is being written: every column is optional, an empty cell is null.
pub(super) struct ParquetFile {
    columns: Vec<Column>,
    writer: SerializedFileWriter<AtomicFile>,
    rows: Vec<Vec<Value>>,
}

impl ParquetFile {
    /// Starts a table at `path`.
    pub(super) fn create(path: &Path, columns: &[Column]) -> Result<Self, Failure> {
        let file = AtomicFile::create(path)?;
        let writer = schema(columns)
            .and_then(|schema| {
                let properties = Arc::new(WriterProperties::builder().build());
                SerializedFileWriter::new(file, schema, properties)
            })
            .map_err(failed(path))?;
        Ok(Self {
            columns: columns.to_vec(),
            writer,
            rows: Vec::new(),
        })
    }

    /// Adds a row.
    pub(super) fn add(&mut self, cells: &[Value]) -> Result<(), Failure> {
        self.rows.push(cells.to_vec());
        if self.rows.len() == ROW_GROUP {
            self.flush()?;
        }
        Ok(())
    }

    /// Ends the table; the file still has to be committed.
    pub(super) fn finish(mut self) -> Result<AtomicFile, Failure> {
        self.flush()?;
        let path = self.writer.inner().path().to_owned();
        self.writer.into_inner().map_err(failed(&path))
    }

    fn flush(&mut self) -> Result<(), Failure> {
        let path = self.writer.inner().path().to_owned();
        let rows = std::mem::take(&mut self.rows);
        if rows.is_empty() {
            return Ok(());
        }
        self.write_group(&rows).map_err(failed(&path))
    }

    fn write_group(&mut self, rows: &[Vec<Value>]) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for (index, column) in self.columns.iter().enumerate() {
            let cells = rows.iter().map(|row| &row[index]);
            match column.kind {
                ColumnKind::Integer => {
                    write_column::<Int64Type>(&mut group, cells.map(Value::as_i64))?;
                }
                ColumnKind::Number => {
                    write_column::<DoubleType>(&mut group, cells.map(Value::as_f64))?;
                }
                ColumnKind::Text => {
                    let bytes = |cell: &Value| ByteArray::from(text(cell).into_bytes());
                    let known = |cell: &Value| (!cell.is_null()).then(|| bytes(cell));
                    write_column::<ByteArrayType>(&mut group, cells.map(known))?;
                }
            }
        }
        group.close()?;
        Ok(())
    }
}

fn write_column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, AtomicFile>,
    cells: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    for cell in cells {
        levels.push(i16::from(cell.is_some()));
        values.extend(cell);
    }
    if let Some(mut column) = group.next_column()? {
        column
            .typed::<T>()
            .write_batch(&values, Some(&levels), None)?;
        column.close()?;
    }
    Ok(())
}

fn schema(columns: &[Column]) -> Result<TypePtr, ParquetError> {
    let field = |column: &Column| {
        let (physical, logical) = match column.kind {
            ColumnKind::Integer => (Physical::INT64, None),
            ColumnKind::Number => (Physical::DOUBLE, None),
            ColumnKind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        Type::primitive_type_builder(&column.name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical)
            .build()
            .map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    let table = Type::group_type_builder("table").with_fields(fields);
    Ok(Arc::new(table.build()?))
}

/// The error of a table that cannot be written.
fn failed(path: &Path) -> impl FnOnce(ParquetError) -> Failure + '_ {
    move |cause| Failure::output(path)(io::Error::other(cause))
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;
    use serde_json::json;

    use super::*;

    /// Over the border of a row group, with empty cells, read back by the library's own reader.
    #[test]
    fn what_is_written_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.parquet");
        let columns = [
            Column::new("run", ColumnKind::Integer),
            Column::new("sensor.range_cm", ColumnKind::Number),
            Column::new("what", ColumnKind::Text),
        ];
        let mut table = ParquetFile::create(&path, &columns).unwrap();
        let rows = ROW_GROUP + 2;
        for row in 0..rows {
            let range = if row % 2 == 0 {
                json!(0.5)
            } else {
                Value::Null
            };
            let what = if row % 3 == 0 {
                json!([1.0, "é"])
            } else {
                Value::Null
            };
            table.add(&[json!(row), range, what]).unwrap();
        }
        table.finish().unwrap().commit().unwrap();
        let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
        assert_eq!(reader.metadata().num_row_groups(), 2);
        let read: Vec<_> = reader
            .get_row_iter(None)
            .unwrap()
            .map(Result::unwrap)
            .collect();
        assert_eq!(read.len(), rows);
        for (index, row) in read.iter().enumerate() {
            let cells: Vec<(&str, &Field)> = row
                .get_column_iter()
                .map(|(name, field)| (name.as_str(), field))
                .collect();
            let run = Field::Long(i64::try_from(index).unwrap());
            let range = if index % 2 == 0 {
                Field::Double(0.5)
            } else {
                Field::Null
            };
            let text = Field::Str("[1.0,\"é\"]".to_owned());
            let what = if index % 3 == 0 { text } else { Field::Null };
            assert_eq!(
                cells,
                [("run", &run), ("sensor.range_cm", &range), ("what", &what)]
            );
        }
    }
}
