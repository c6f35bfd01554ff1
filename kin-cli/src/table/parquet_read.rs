//! Parquet (<https://parquet.apache.org/docs/file-format/>), read column by column by arrow-rs.

use super::{Fault, Header, Place, Portion, Reader};
use parquet::basic::{ConvertedType, LogicalType, Type};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::schema::types::ColumnDescriptor;
use std::fs::File;
use std::path::{Path, PathBuf};

pub(super) struct ParquetReader {
    path: PathBuf,
    file: SerializedFileReader<File>,
    header: Header,
    names: Vec<String>,
    selected: Vec<usize>,
    /// Of those that are selected, the deepest level of definition.
    depths: Vec<i16>,
    unsigned: Vec<bool>,
    rows: u64,
    /// Rows before the next portion.
    before: u64,
    /// The next row group, and what is open of the one before.
    group: usize,
    open: Group,
}

/// A row group that is being read.
#[derive(Default)]
struct Group {
    columns: Vec<ColumnReader>,
    /// Rows that are not read yet.
    rows: u64,
}

const REWRITE: &str = "write it again, as a whole; compressed by snappy, zstd, lz4 or gzip, or not";

impl ParquetReader {
    pub(super) fn new(path: &Path, file: File) -> Result<Self, Fault> {
        let read = guarded(|| SerializedFileReader::new(file));
        let is_none = |reason| Fault::whole(path, format!("is no Parquet file: {reason}"), REWRITE);
        let file = read.map_err(is_none)?;
        let metadata = file.metadata();
        let columns = metadata.file_metadata().schema_descr_ptr();
        let names: Vec<String> = columns
            .columns()
            .iter()
            .map(|it| it.path().string())
            .collect();
        let counts = metadata.row_groups().iter().map(|group| group.num_rows());
        let counts: Option<Vec<u64>> = counts.map(|count| count.try_into().ok()).collect();
        let counts = counts.ok_or_else(|| is_none("a row group has less than no rows".into()))?;
        Ok(Self {
            path: path.to_owned(),
            header: Header::Names(names.clone()),
            names,
            selected: Vec::new(),
            depths: Vec::new(),
            unsigned: Vec::new(),
            rows: counts
                .iter()
                .fold(0, |sum: u64, &count| sum.saturating_add(count)),
            file,
            before: 0,
            group: 0,
            open: Group::default(),
        })
    }

    fn fault(&self, column: Option<usize>, reason: impl Into<String>) -> Fault {
        let at = Place {
            row: Some(self.before),
            column: column.map(|column| self.names[column].clone()),
        };
        Fault::at(&self.path, at, reason, REWRITE)
    }

    /// Opens row groups until one has rows; whether there is one.
    fn open(&mut self) -> Result<bool, Fault> {
        while self.open.rows == 0 {
            if self.group == self.file.num_row_groups() {
                return Ok(false);
            }
            let open = guarded(|| {
                let group = self.file.get_row_group(self.group)?;
                let columns = self.selected.iter().map(|&it| group.get_column_reader(it));
                Ok(Group {
                    columns: columns.collect::<Result<_, _>>()?,
                    rows: group.metadata().num_rows() as u64,
                })
            });
            self.open = open.map_err(|reason| self.fault(None, reason))?;
            self.group += 1;
        }
        Ok(true)
    }
}

impl Reader for ParquetReader {
    fn header(&self) -> &Header {
        &self.header
    }

    fn extent(&self) -> (u64, &'static str) {
        (self.rows, "rows")
    }

    fn select(&mut self, columns: &[usize]) -> Result<(), Fault> {
        let schema = self.file.metadata().file_metadata().schema_descr_ptr();
        for &column in columns {
            has_numbers(&schema.column(column)).map_err(|(reason, remedy)| {
                let at = Place {
                    row: None,
                    column: Some(self.names[column].clone()),
                };
                Fault::at(&self.path, at, reason, remedy)
            })?;
        }
        self.selected = columns.to_vec();
        let depth = |&column: &usize| schema.column(column).max_def_level();
        self.depths = columns.iter().map(depth).collect();
        let unsigned = |&column: &usize| is_unsigned(&schema.column(column));
        self.unsigned = columns.iter().map(unsigned).collect();
        Ok(())
    }

    fn next(&mut self, rows: usize) -> Result<Option<Portion>, Fault> {
        if !self.open()? {
            return Ok(None);
        }
        let count = self.open.rows.min(rows as u64) as usize;
        let mut values = Vec::with_capacity(self.selected.len());
        for (place, &column) in self.selected.iter().enumerate() {
            let reader = &mut self.open.columns[place];
            let (deepest, unsigned) = (self.depths[place], self.unsigned[place]);
            let read = guarded(|| numbers(reader, deepest, count, unsigned));
            let read = read.map_err(|reason| self.fault(Some(column), reason))?;
            if read.len() != count {
                let reason = format!("the column ends {} rows too early", count - read.len());
                return Err(self.fault(Some(column), reason));
            }
            values.push(read);
        }
        let first = self.before;
        self.before += count as u64;
        self.open.rows -= count as u64;
        Ok(Some(Portion {
            first,
            extent: count as u64,
            decode: Box::new(move || Ok(values)),
        }))
    }
}

/// What a library makes of a file by a stranger: where it panics, that is the reason.
fn guarded<T>(read: impl FnOnce() -> Result<T, ParquetError>) -> Result<T, String> {
    // Nothing is used again that a panic could have left half done: the file is given up.
    let read = std::panic::AssertUnwindSafe(read);
    match std::panic::catch_unwind(read) {
        Ok(result) => result.map_err(|error| error.to_string()),
        Err(_) => Err("it is damaged".into()),
    }
}

/// Whether a column has one number in each row, or none; otherwise why not, and what to do.
fn has_numbers(column: &ColumnDescriptor) -> Result<(), (&'static str, &'static str)> {
    let one = "let there be a column for each number";
    if column.max_rep_level() > 0 {
        return Err(("has lists of values", one));
    }
    let is_plain = match column.logical_type_ref() {
        None => !is_more_than_number(column.converted_type()),
        Some(meaning) => matches!(meaning, LogicalType::Integer(_)),
    };
    match column.physical_type() {
        Type::DOUBLE | Type::FLOAT | Type::INT32 | Type::INT64 if is_plain => Ok(()),
        _ => Err(("has no numbers", "write it as doubles")),
    }
}

/// Whether integers mean something else than themselves.
fn is_more_than_number(meaning: ConvertedType) -> bool {
    use ConvertedType::*;
    let decimal = meaning == DECIMAL;
    decimal
        || matches!(
            meaning,
            DATE | TIME_MILLIS | TIME_MICROS | TIMESTAMP_MILLIS | TIMESTAMP_MICROS
        )
}

/// Whether integers have no sign.
fn is_unsigned(column: &ColumnDescriptor) -> bool {
    use ConvertedType::*;
    match column.logical_type_ref() {
        Some(LogicalType::Integer(own)) => !own.is_signed,
        _ => matches!(
            column.converted_type(),
            UINT_8 | UINT_16 | UINT_32 | UINT_64
        ),
    }
}

/// The next numbers of a column, NaN where there is none; fewer at its end. A value that is there
/// has the deepest level of definition.
fn numbers(
    column: &mut ColumnReader,
    deepest: i16,
    count: usize,
    is_unsigned: bool,
) -> Result<Vec<f64>, ParquetError> {
    match column {
        ColumnReader::DoubleColumnReader(column) => read(column, deepest, count, |&value| value),
        ColumnReader::FloatColumnReader(column) => {
            read(column, deepest, count, |&value| value.into())
        }
        ColumnReader::Int32ColumnReader(column) => {
            read(column, deepest, count, |&value| match is_unsigned {
                true => value.cast_unsigned().into(),
                false => value.into(),
            })
        }
        ColumnReader::Int64ColumnReader(column) => {
            read(column, deepest, count, |&value| match is_unsigned {
                true => value.cast_unsigned() as f64,
                false => value as f64,
            })
        }
        _ => Err(ParquetError::General("has no numbers".into())),
    }
}

fn read<T: DataType>(
    column: &mut ColumnReaderImpl<T>,
    deepest: i16,
    count: usize,
    number: impl Fn(&T::T) -> f64,
) -> Result<Vec<f64>, ParquetError> {
    let (mut levels, mut values) = (Vec::new(), Vec::new());
    let (records, ..) = column.read_records(count, Some(&mut levels), None, &mut values)?;
    if values.len() == records {
        return Ok(values.iter().map(number).collect());
    }
    // Values stand only where the level says that one is there.
    let mut values = values.iter().map(number);
    let value = |&level: &i16| match level == deepest {
        true => values.next().unwrap_or(f64::NAN),
        false => f64::NAN,
    };
    Ok(levels.iter().map(value).collect())
}
