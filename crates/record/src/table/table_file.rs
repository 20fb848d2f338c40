//! Tables for machines: each as CSV and as JSON lines, and as Parquet with the feature of that name, row by row.

use std::io;
use std::path::Path;

use adslam_diagnostics::Failure;
use serde_json::{Map, Value};

use super::column::{Column, text};
#[cfg(feature = "parquet")]
use super::parquet_file::ParquetFile;
use crate::AtomicFile;

/// A table that is being written as NAME.csv and NAME.jsonl, and as NAME.parquet with the feature `parquet`. A cell is a
/// JSON value; an empty one, null in JSON, is nothing in CSV. Numbers have as many digits as tell them from all
/// others.
pub struct TableFile {
    columns: Vec<Column>,
    csv: csv::Writer<AtomicFile>,
    lines: AtomicFile,
    #[cfg(feature = "parquet")]
    parquet: ParquetFile,
}

impl TableFile {
    /// Starts a table that will lie in `folder`, which must exist, under this name.
    ///
    /// # Errors
    /// As [`AtomicFile::create`].
    pub fn create(folder: &Path, name: &str, columns: Vec<Column>) -> Result<Self, Failure> {
        let csv = AtomicFile::create(&folder.join(format!("{name}.csv")))?;
        let lines = AtomicFile::create(&folder.join(format!("{name}.jsonl")))?;
        let mut table = Self {
            csv: csv::Writer::from_writer(csv),
            lines,
            #[cfg(feature = "parquet")]
            parquet: ParquetFile::create(&folder.join(format!("{name}.parquet")), &columns)?,
            columns,
        };
        let heads = table.columns.iter().map(|column| column.name.as_str());
        let written = table.csv.write_record(heads);
        table.checked(written)?;
        Ok(table)
    }

    /// Adds a row with a cell for each column.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn add(&mut self, cells: Vec<Value>) -> Result<(), Failure> {
        let written = self.csv.write_record(cells.iter().map(text));
        self.checked(written)?;
        #[cfg(feature = "parquet")]
        self.parquet.add(&cells)?;
        let names = self.columns.iter().map(|column| column.name.clone());
        self.lines
            .add_json_line(&names.zip(cells).collect::<Map<_, _>>())
    }

    /// Ends the table; its files still have to be committed.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn finish(self) -> Result<Vec<AtomicFile>, Failure> {
        let path = self.csv.get_ref().path().to_owned();
        let csv = self
            .csv
            .into_inner()
            .map_err(|error| Failure::output(&path)(error.into_error()))?;
        Ok(vec![
            csv,
            self.lines,
            #[cfg(feature = "parquet")]
            self.parquet.finish()?,
        ])
    }

    fn checked(&self, written: csv::Result<()>) -> Result<(), Failure> {
        let path = self.csv.get_ref().path();
        written.map_err(|error| Failure::output(path)(io::Error::from(error)))
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use serde_json::json;

    use super::*;
    use crate::ColumnKind;

    #[test]
    fn both_files_say_the_same() {
        let folder = tempfile::tempdir().unwrap();
        let columns = vec![
            Column::new("run", ColumnKind::Integer),
            Column::new("range, cm", ColumnKind::Number),
            Column::new("what", ColumnKind::Text),
        ];
        let mut table = TableFile::create(folder.path(), "t", columns).unwrap();
        table
            .add(vec![json!(1), json!(0.1), json!("a \"b\"")])
            .unwrap();
        table
            .add(vec![json!(2), Value::Null, json!([1.0, "x"])])
            .unwrap();
        assert!(!folder.path().join("t.csv").exists(), "unfinished");
        AtomicFile::commit_all(table.finish().unwrap()).unwrap();
        let read = |name| fs::read_to_string(folder.path().join(name)).unwrap();
        assert_eq!(
            read("t.csv"),
            "run,\"range, cm\",what\n1,0.1,\"a \"\"b\"\"\"\n2,,\"[1.0,\"\"x\"\"]\"\n"
        );
        assert_eq!(
            read("t.jsonl"),
            "{\"run\":1,\"range, cm\":0.1,\"what\":\"a \\\"b\\\"\"}\n\
             {\"run\":2,\"range, cm\":null,\"what\":[1.0,\"x\"]}\n"
        );
    }
}
