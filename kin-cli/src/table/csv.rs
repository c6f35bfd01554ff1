//! Text with a line of names and a line for each row (RFC 4180; also separated by semicolons or
//! tabs, with a byte order mark, with any line breaks).

use super::lines::{Lines, Rows, Stopped};
use super::{Column, Encoder, Fault, Header, Piece, Place, Portion, Reader, Values};
use csv::{ByteRecord, ReaderBuilder, Terminator};
use kin_codegen::spec::one_line;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What may stand between fields; the first of these in the line of names does.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

pub(super) struct CsvReader {
    lines: Lines<File>,
    header: Header,
    bytes: u64,
    /// Rows before the next portion.
    before: u64,
    decoding: Arc<Decoding>,
}

/// What is needed to decode rows.
#[derive(Clone)]
struct Decoding {
    path: PathBuf,
    separator: u8,
    names: Vec<String>,
    selected: Vec<usize>,
}

impl CsvReader {
    pub(super) fn new(path: &Path, file: File) -> Result<Self, Fault> {
        let bytes = file.metadata().map_or(0, |metadata| metadata.len());
        let mut lines = Lines::new(file);
        let stopped = |stopped| stopped_at(path, None, stopped);
        let Some(Rows { text, .. }) = lines.take(1).map_err(stopped)? else {
            return Err(Fault::whole(path, "is empty", NAMES));
        };
        let (separator, names) = names(path, &text)?;
        Ok(Self {
            lines,
            header: Header::Names(names.clone()),
            bytes,
            before: 0,
            decoding: Arc::new(Decoding {
                path: path.to_owned(),
                separator,
                names,
                selected: Vec::new(),
            }),
        })
    }
}

const NAMES: &str = "let the first line have the names of the columns, \
                     for example `x,y,z,qx,qy,qz,qw` or the names of the joints";

/// Of names among which those that are looked for are not: one of them is a number.
pub fn number_for_name(path: &Path, names: &[String]) -> Option<Fault> {
    let number = names.iter().find(|name| name.parse::<f64>().is_ok())?;
    let reason = format!("the first line has the number {number} in place of a name");
    Some(Fault::whole(path, reason, NAMES))
}

/// What separates fields, of which there are most by that, and the names of the columns.
fn names(path: &Path, line: &[u8]) -> Result<(u8, Vec<String>), Fault> {
    const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
    if line.starts_with(b"\xff\xfe") || line.starts_with(b"\xfe\xff") {
        return Err(Fault::whole(path, "is in UTF-16", "save it in UTF-8"));
    }
    let line = line.strip_prefix(BYTE_ORDER_MARK).unwrap_or(line);
    let record_by = |separator: u8| {
        let mut record = ByteRecord::new();
        let found = rows_of(line, separator).read_byte_record(&mut record);
        found.unwrap_or(false).then_some((separator, record))
    };
    // Of several that give as many the first.
    let by_each = SEPARATORS.into_iter().rev().filter_map(record_by);
    let Some((separator, record)) = by_each.max_by_key(|(_, record)| record.len()) else {
        return Err(Fault::whole(path, "the first line cannot be read", NAMES));
    };
    let name = |field: &[u8]| String::from_utf8_lossy(field.trim_ascii()).into_owned();
    let names: Vec<String> = record.iter().map(name).collect();
    Ok((separator, names))
}

fn rows_of(text: &[u8], separator: u8) -> csv::Reader<&[u8]> {
    ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .delimiter(separator)
        .terminator(Terminator::Any(b'\n'))
        .from_reader(text)
}

fn stopped_at(path: &Path, row: Option<u64>, stopped: Stopped) -> Fault {
    match stopped {
        Stopped::Unreadable(error) => Fault::unreadable(path, &error),
        Stopped::Endless => {
            let at = Place { row, column: None };
            let reason = "the row does not end within a million characters";
            Fault::at(
                path,
                at,
                reason,
                "close the quotes, and end rows with line breaks",
            )
        }
    }
}

impl Reader for CsvReader {
    fn header(&self) -> &Header {
        &self.header
    }

    fn extent(&self) -> (u64, &'static str) {
        (self.bytes, "bytes")
    }

    fn select(&mut self, columns: &[usize]) -> Result<(), Fault> {
        Arc::make_mut(&mut self.decoding).selected = columns.to_vec();
        Ok(())
    }

    fn next(&mut self, rows: usize) -> Result<Option<Portion>, Fault> {
        let first = self.before;
        let stopped = |stopped| stopped_at(&self.decoding.path, Some(first), stopped);
        let Some(rows) = self.lines.take(rows).map_err(stopped)? else {
            return Ok(None);
        };
        self.before += rows.count as u64;
        let decoding = Arc::clone(&self.decoding);
        Ok(Some(Portion {
            first,
            extent: rows.text.len() as u64,
            decode: Box::new(move || decoding.decode(first, &rows)),
        }))
    }
}

impl Decoding {
    fn decode(&self, first: u64, rows: &Rows) -> Result<Vec<Vec<f64>>, Fault> {
        let mut columns = vec![Vec::with_capacity(rows.count); self.selected.len()];
        let mut records = rows_of(&rows.text, self.separator);
        let mut record = ByteRecord::new();
        let mut row = first;
        let is_next = |records: &mut csv::Reader<&[u8]>, record: &mut ByteRecord, row| {
            records
                .read_byte_record(record)
                .map_err(|error| self.fault(row, None, error.to_string(), FIELDS))
        };
        while is_next(&mut records, &mut record, row)? {
            if record.len() == 1 && record[0].trim_ascii().is_empty() {
                continue;
            }
            if record.len() != self.names.len() {
                let (found, names) = (record.len(), self.names.len());
                let reason = format!("{found} fields, where the first line has {names} names");
                return Err(self.fault(row, None, reason, FIELDS));
            }
            for (values, &column) in columns.iter_mut().zip(&self.selected) {
                values.push(self.number(row, column, &record[column])?);
            }
            row += 1;
        }
        if row - first != rows.count as u64 {
            let reason = "a quotation mark stands inside of a field";
            return Err(self.fault(first, None, reason, FIELDS));
        }
        Ok(columns)
    }

    /// A field as a number; NaN if it is empty.
    fn number(&self, row: u64, column: usize, field: &[u8]) -> Result<f64, Fault> {
        let field = field.trim_ascii();
        if field.is_empty() {
            return Ok(f64::NAN);
        }
        let text = std::str::from_utf8(field).ok();
        text.and_then(|text| text.parse().ok()).ok_or_else(|| {
            let shown: String = String::from_utf8_lossy(field).chars().take(40).collect();
            let reason = format!("`{}` is no number", one_line(&shown));
            let remedy = "write a decimal number with a point, or leave the field empty";
            self.fault(row, Some(column), reason, remedy)
        })
    }

    fn fault(
        &self,
        row: u64,
        column: Option<usize>,
        reason: impl Into<String>,
        remedy: &str,
    ) -> Fault {
        let at = Place {
            row: Some(row),
            column: column.map(|column| self.names[column].clone()),
        };
        Fault::at(&self.path, at, reason, remedy)
    }
}

const FIELDS: &str = "write one field for each column, quoted as a whole or not at all";

pub(super) struct CsvEncoder {
    columns: Vec<Column>,
}

impl CsvEncoder {
    pub(super) fn new(columns: Vec<Column>) -> Self {
        Self { columns }
    }
}

impl Encoder for CsvEncoder {
    fn head(&self, _: u64) -> Vec<u8> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        // Nothing that is written to a vector fails.
        let _ = writer.write_record(self.columns.iter().map(|column| &column.name));
        writer.into_inner().unwrap_or_default()
    }

    fn encode(&self, columns: &[Values]) -> Result<Piece, String> {
        let rows = columns.first().map_or(0, Values::len);
        let mut bytes = Vec::with_capacity(rows * columns.len() * 16);
        let mut digits = zmij::Buffer::new();
        for row in 0..rows {
            for (place, column) in columns.iter().enumerate() {
                if place > 0 {
                    bytes.push(b',');
                }
                match column {
                    Values::Real(values) => {
                        bytes.extend(digits.format(values[row]).as_bytes());
                    }
                    Values::Integer(values) => {
                        // As above.
                        let _ = write!(bytes, "{}", values[row]);
                    }
                    Values::Truth(values) => {
                        bytes.extend(if values[row] { "true" } else { "false" }.as_bytes());
                    }
                }
            }
            bytes.push(b'\n');
        }
        Ok(Piece {
            rows: rows as u64,
            bytes,
            note: Vec::new(),
        })
    }

    fn tail(&self, _: &mut dyn Iterator<Item = (u64, &[u8])>) -> Result<Vec<u8>, String> {
        Ok(Vec::new())
    }
}
