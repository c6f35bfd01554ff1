//! Parquet, written row group by row group.
//!
//! Every piece is encoded as a file of its own, by any thread. What stands in the file are its
//! pages; its footer is the note, and the last footer tells all row groups where they came to
//! stand.

use super::{Column, Encoder, Kind, Piece, Values};
use parquet::basic::{Encoding, Repetition, Type as Physical};
use parquet::data_type::{BoolType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::{
    ColumnChunkMetaData, FileMetaData, ParquetMetaData, ParquetMetaDataReader,
    ParquetMetaDataWriter, RowGroupMetaData,
};
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};
use std::sync::Arc;

/// What a file begins and ends with.
const MAGIC: &[u8] = b"PAR1";

/// The length of the footer, and the magic.
const END: usize = 8;

pub(super) struct ParquetEncoder {
    columns: Vec<Column>,
}

impl ParquetEncoder {
    pub(super) fn new(columns: Vec<Column>) -> Self {
        Self { columns }
    }

    fn schema(&self) -> Result<Type, ParquetError> {
        let field = |column: &Column| {
            let physical = match column.kind {
                Kind::Real => Physical::DOUBLE,
                Kind::Integer => Physical::INT64,
                Kind::Truth => Physical::BOOLEAN,
            };
            let field = Type::primitive_type_builder(&column.name, physical);
            field
                .with_repetition(Repetition::REQUIRED)
                .build()
                .map(Arc::new)
        };
        let fields: Result<_, _> = self.columns.iter().map(field).collect();
        Type::group_type_builder("schema")
            .with_fields(fields?)
            .build()
    }

    /// Digits of solutions are noise, which nothing compresses; targets and branches hardly take
    /// space as differences.
    fn properties(&self) -> WriterProperties {
        let all = WriterProperties::builder()
            .set_created_by(concat!("kin-cli version ", env!("CARGO_PKG_VERSION")).into())
            .set_dictionary_enabled(false)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_offset_index_disabled(true);
        let integers = self
            .columns
            .iter()
            .filter(|column| column.kind == Kind::Integer);
        let path = |column: &Column| ColumnPath::new(vec![column.name.clone()]);
        let packed = Encoding::DELTA_BINARY_PACKED;
        let all = integers.fold(all, |all, it| all.set_column_encoding(path(it), packed));
        all.build()
    }

    /// A file of one row group, or of none.
    fn file(&self, columns: &[Values]) -> Result<Vec<u8>, ParquetError> {
        let (schema, properties) = (Arc::new(self.schema()?), Arc::new(self.properties()));
        let mut file = SerializedFileWriter::new(Vec::new(), schema, properties)?;
        if columns.first().is_some_and(|column| !column.is_empty()) {
            let mut group = file.next_row_group()?;
            for values in columns {
                let Some(mut column) = group.next_column()? else {
                    break;
                };
                match values {
                    Values::Real(it) => column.typed::<DoubleType>().write_batch(it, None, None),
                    Values::Integer(it) => column.typed::<Int64Type>().write_batch(it, None, None),
                    Values::Truth(it) => column.typed::<BoolType>().write_batch(it, None, None),
                }?;
                column.close()?;
            }
            group.close()?;
        }
        file.into_inner()
    }

    fn footer(
        &self,
        pieces: &mut dyn Iterator<Item = (u64, &[u8])>,
    ) -> Result<Vec<u8>, ParquetError> {
        let mut groups = Vec::new();
        let mut begin = MAGIC.len() as i64;
        for (bytes, note) in pieces {
            if !note.is_empty() {
                let metadata = ParquetMetaDataReader::decode_metadata(note)?;
                for group in metadata.row_groups() {
                    groups.push(moved(group, begin - MAGIC.len() as i64)?);
                }
            }
            begin += bytes as i64;
        }
        let (_, empty) = split(&self.file(&[])?).ok_or_else(|| broken("an empty table"))?;
        let empty = ParquetMetaDataReader::decode_metadata(&empty)?;
        let like = empty.file_metadata();
        let all = FileMetaData::new(
            like.version(),
            groups.iter().map(RowGroupMetaData::num_rows).sum(),
            like.created_by().map(str::to_owned),
            None,
            like.schema_descr_ptr(),
            like.column_orders().cloned(),
        );
        let mut footer = Vec::new();
        let metadata = ParquetMetaData::new(all, groups);
        ParquetMetaDataWriter::new(&mut footer, &metadata).finish()?;
        Ok(footer)
    }
}

fn broken(what: &str) -> ParquetError {
    ParquetError::General(format!("{what} has no footer"))
}

/// The pages of a file, and its footer without its length and the magic.
fn split(file: &[u8]) -> Option<(Vec<u8>, Vec<u8>)> {
    let end = file.len().checked_sub(END)?;
    let length = u32::from_le_bytes(file[end..].first_chunk().copied()?);
    let begin = end.checked_sub(length as usize)?;
    let pages = file.get(MAGIC.len()..begin)?;
    Some((pages.to_vec(), file[begin..end].to_vec()))
}

/// A row group that stands so many bytes behind where it was written.
fn moved(group: &RowGroupMetaData, by: i64) -> Result<RowGroupMetaData, ParquetError> {
    let column = |column: &ColumnChunkMetaData| {
        let place = column.data_page_offset() + by;
        column
            .clone()
            .into_builder()
            .set_data_page_offset(place)
            .build()
    };
    let columns: Result<_, _> = group.columns().iter().map(column).collect();
    // Without its number: that has 16 bits.
    RowGroupMetaData::builder(group.schema_descr_ptr())
        .set_num_rows(group.num_rows())
        .set_total_byte_size(group.total_byte_size())
        .set_file_offset(group.file_offset().unwrap_or(MAGIC.len() as i64) + by)
        .set_column_metadata(columns?)
        .build()
}

impl Encoder for ParquetEncoder {
    fn head(&self, _: u64) -> Vec<u8> {
        MAGIC.to_vec()
    }

    fn encode(&self, columns: &[Values]) -> Result<Piece, String> {
        let rows = columns.first().map_or(0, Values::len);
        if rows == 0 {
            return Ok(Piece::default());
        }
        let file = self.file(columns).map_err(|error| error.to_string())?;
        let (bytes, note) = split(&file).ok_or("a row group has no footer")?;
        Ok(Piece {
            rows: rows as u64,
            bytes,
            note,
        })
    }

    fn tail(&self, pieces: &mut dyn Iterator<Item = (u64, &[u8])>) -> Result<Vec<u8>, String> {
        self.footer(pieces).map_err(|error| error.to_string())
    }
}
