//! NPY, the file format of NumPy arrays
//! (<https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>).
//!
//! Rows are those of a matrix, or records with names. What is written is a matrix of doubles
//! where all columns are, and records otherwise.

use super::literal::Literal;
use super::{Column, Encoder, Fault, Header, Kind, Piece, Portion, Reader, Values};
use std::fs::File;
use std::io::{self, BufReader, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Magic, version, length and head fill whole blocks of so many bytes.
const BLOCK: usize = 64;

/// More is no head of a table.
const LONGEST_HEAD: usize = 1 << 20;

/// The head of an array: `descr` and `shape` in Python, which is filled up to at least `width`
/// bytes.
pub fn head(descr: &str, shape: &str, width: usize) -> Vec<u8> {
    let mut text = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}");
    // Magic, version and length; the length has two bytes more where the names are that long, or
    // have letters that the first two versions have not.
    let is_short = text.is_ascii() && text.len() + BLOCK < usize::from(u16::MAX);
    let (version, before) = match (is_short, text.is_ascii()) {
        (true, _) => (1, 10),
        (_, true) => (2, 12),
        _ => (3, 12),
    };
    let whole = (before + text.len() + 1).max(width).next_multiple_of(BLOCK);
    text += &" ".repeat(whole - before - 1 - text.len());
    text.push('\n');
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend([version, 0]);
    bytes.extend(&(text.len() as u32).to_le_bytes()[..before - 8]);
    bytes.extend(text.as_bytes());
    bytes
}

/// A kind of number in a record.
#[derive(Clone, Copy)]
struct Number {
    size: usize,
    read: fn(&[u8]) -> f64,
}

/// The kinds of numbers that columns may have: by the letters of NumPy, without the byte order.
fn number(letters: &str) -> Option<Number> {
    macro_rules! of {
        ($type:ty) => {{
            let size = size_of::<$type>();
            let read = |bytes: &[u8]| {
                let bytes = bytes.try_into().unwrap_or_default();
                <$type>::from_le_bytes(bytes) as f64
            };
            Some(Number { size, read })
        }};
    }
    match letters {
        "f8" => of!(f64),
        "f4" => of!(f32),
        "i8" => of!(i64),
        "i4" => of!(i32),
        "i2" => of!(i16),
        "i1" => of!(i8),
        "u8" => of!(u64),
        "u4" => of!(u32),
        "u2" => of!(u16),
        "u1" | "b1" => of!(u8),
        _ => None,
    }
}

/// How a row stands in the file.
#[derive(Clone, Default)]
struct Layout {
    /// Where each column is in a row, bytes from its beginning, and its kind.
    columns: Vec<(usize, Number)>,
    /// Bytes.
    row: usize,
}

pub(super) struct NpyReader {
    path: PathBuf,
    input: BufReader<File>,
    header: Header,
    layout: Layout,
    selected: Arc<Vec<(usize, Number)>>,
    rows: u64,
    before: u64,
}

const CONVERT: &str = "save it by `numpy.save(name, numpy.ascontiguousarray(array, dtype='<f8'))`";

impl NpyReader {
    pub(super) fn new(path: &Path, file: File) -> Result<Self, Fault> {
        let mut input = BufReader::with_capacity(1 << 20, file);
        let is_none = |reason: &str| Fault::whole(path, reason, CONVERT);
        let head = read_head(&mut input).map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof | ErrorKind::InvalidData => is_none("is no NPY file"),
            _ => Fault::unreadable(path, &error),
        })?;
        let head = Literal::read(&head).ok_or_else(|| is_none("is no NPY file"))?;
        let entries = [
            head.get("shape"),
            head.get("fortran_order"),
            head.get("descr"),
        ];
        let [Some(Literal::Sequence(shape)), Some(order), Some(descr)] = entries else {
            return Err(is_none("is no NPY file"));
        };
        let extent = |literal: &Literal| match literal {
            Literal::Number(extent) => Some(*extent),
            _ => None,
        };
        let shape: Option<Vec<u64>> = shape.iter().map(extent).collect();
        let shape = shape.ok_or_else(|| is_none("is no NPY file"))?;
        if *order != Literal::Truth(false) && shape.len() > 1 {
            return Err(is_none("has its numbers column by column (Fortran order)"));
        }
        let (&rows, row) = shape.split_first().ok_or_else(|| is_none("has no rows"))?;
        let (header, layout) = match descr {
            Literal::Text(letters) => matrix(path, letters, row)?,
            Literal::Sequence(fields) if row.is_empty() => records(path, fields)?,
            _ => return Err(is_none("has records that are no rows of numbers")),
        };
        if layout.row == 0 {
            return Err(is_none("has rows of no numbers"));
        }
        Ok(Self {
            path: path.to_owned(),
            input,
            header,
            layout,
            selected: Arc::default(),
            rows,
            before: 0,
        })
    }
}

fn read_head(input: &mut impl Read) -> io::Result<String> {
    let mut magic = [0; 8];
    input.read_exact(&mut magic)?;
    let length = match &magic {
        b"\x93NUMPY\x01\x00" => {
            let mut length = [0; 2];
            input.read_exact(&mut length)?;
            u16::from_le_bytes(length).into()
        }
        [0x93, b'N', b'U', b'M', b'P', b'Y', 2 | 3, 0] => {
            let mut length = [0; 4];
            input.read_exact(&mut length)?;
            u32::from_le_bytes(length) as usize
        }
        _ => return Err(ErrorKind::InvalidData.into()),
    };
    if length > LONGEST_HEAD {
        return Err(ErrorKind::InvalidData.into());
    }
    let mut head = vec![0; length];
    input.read_exact(&mut head)?;
    String::from_utf8(head).map_err(|_| ErrorKind::InvalidData.into())
}

/// What is read of the kinds that NumPy has.
const READ: &str = "integers, truth values and little-endian reals of 4 or 8 bytes";

/// A kind of number by the letters of NumPy.
fn little_endian(path: &Path, letters: &str) -> Result<Number, Fault> {
    let (order, kind) = letters.split_at_checked(1).unwrap_or_default();
    let known = number(kind).filter(|number| order == "<" || number.size == 1);
    known.ok_or_else(|| {
        let shown = kin_codegen::spec::one_line(letters);
        let reason = format!("has the type `{shown}`, where {READ} are read");
        Fault::whole(path, reason, CONVERT)
    })
}

/// The rows of a matrix, or of matrices.
fn matrix(path: &Path, letters: &str, row: &[u64]) -> Result<(Header, Layout), Fault> {
    /// More numbers are no pose and no configuration.
    const WIDEST: u64 = 10_000;
    let number = little_endian(path, letters)?;
    let width = row
        .iter()
        .try_fold(1u64, |width, &extent| width.checked_mul(extent));
    let width = width.filter(|width| *width <= WIDEST).ok_or_else(|| {
        let reason = format!("has rows of more than {WIDEST} numbers");
        Fault::whole(
            path,
            reason,
            "let it have a row for each pose or configuration",
        )
    })?;
    let width = width as usize;
    let column = |i: usize| (i * number.size, number);
    let layout = Layout {
        columns: (0..width).map(column).collect(),
        row: width * number.size,
    };
    Ok((Header::Width(width), layout))
}

/// Records: names with letters.
fn records(path: &Path, fields: &[Literal]) -> Result<(Header, Layout), Fault> {
    let mut layout = Layout::default();
    let mut names = Vec::new();
    for field in fields {
        let Literal::Sequence(parts) = field else {
            return Err(Fault::whole(path, "is no NPY file", CONVERT));
        };
        let [Literal::Text(name), Literal::Text(letters)] = &parts[..] else {
            let reason = "has fields with titles or of several numbers";
            return Err(Fault::whole(path, reason, CONVERT));
        };
        let number = little_endian(path, letters)?;
        layout.columns.push((layout.row, number));
        layout.row += number.size;
        names.push(name.clone());
    }
    Ok((Header::Names(names), layout))
}

impl Reader for NpyReader {
    fn header(&self) -> &Header {
        &self.header
    }

    fn extent(&self) -> (u64, &'static str) {
        (self.rows, "rows")
    }

    fn select(&mut self, columns: &[usize]) -> Result<(), Fault> {
        let selected = columns
            .iter()
            .map(|&column| self.layout.columns[column])
            .collect();
        self.selected = Arc::new(selected);
        Ok(())
    }

    fn next(&mut self, rows: usize) -> Result<Option<Portion>, Fault> {
        let first = self.before;
        let count = (self.rows - first).min(rows as u64);
        if count == 0 {
            return Ok(None);
        }
        let row = self.layout.row;
        // By what is read, not by what the head promises.
        let mut bytes = Vec::new();
        let wanted = count * row as u64;
        let found = (&mut self.input).take(wanted).read_to_end(&mut bytes);
        let found = found.map_err(|error| Fault::unreadable(&self.path, &error))?;
        if found as u64 != wanted {
            let all = self.rows;
            let there = first + (found / row) as u64;
            let reason = format!("ends after {there} of {all} rows");
            return Err(Fault::whole(
                &self.path,
                reason,
                "write it again, as a whole",
            ));
        }
        self.before += count;
        let selected = Arc::clone(&self.selected);
        let decode = move || {
            let column = |&(place, number): &(usize, Number)| {
                let rows = bytes.chunks_exact(row);
                let value = |row: &[u8]| (number.read)(&row[place..place + number.size]);
                rows.map(value).collect()
            };
            Ok(selected.iter().map(column).collect())
        };
        Ok(Some(Portion {
            first,
            extent: count,
            decode: Box::new(decode),
        }))
    }
}

pub(super) struct NpyEncoder {
    columns: Vec<Column>,
}

impl NpyEncoder {
    pub(super) fn new(columns: Vec<Column>) -> Self {
        Self { columns }
    }

    fn is_matrix(&self) -> bool {
        self.columns.iter().all(|column| column.kind == Kind::Real)
    }
}

/// A name between quotation marks, as Python writes it.
fn quoted(name: &str) -> String {
    let mut quoted = String::from("'");
    for c in name.chars() {
        match c {
            '\'' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => quoted += &format!("\\u{:04x}", c as u32),
            c => quoted.push(c),
        }
    }
    quoted + "'"
}

impl Encoder for NpyEncoder {
    fn head(&self, rows: u64) -> Vec<u8> {
        /// A count of rows takes so many bytes at most, in place of one.
        const COUNT: usize = 20;
        let (descr, shape): (_, fn(u64, usize) -> String) = if self.is_matrix() {
            ("'<f8'".into(), |rows, width| format!("({rows}, {width})"))
        } else {
            let field = |column: &Column| {
                let letters = match column.kind {
                    Kind::Real => "<f8",
                    Kind::Integer => "<i8",
                    Kind::Truth => "|b1",
                };
                format!("({}, '{letters}')", quoted(&column.name))
            };
            let fields: Vec<String> = self.columns.iter().map(field).collect();
            (format!("[{}]", fields.join(", ")), |rows, _| {
                format!("({rows},)")
            })
        };
        let width = self.columns.len();
        let least = head(&descr, &shape(0, width), 0).len();
        head(&descr, &shape(rows, width), least + COUNT)
    }

    fn encode(&self, columns: &[Values]) -> Result<Piece, String> {
        let rows = columns.first().map_or(0, Values::len);
        let mut bytes = Vec::with_capacity(rows * columns.len() * 8);
        for row in 0..rows {
            for column in columns {
                match column {
                    Values::Real(values) => bytes.extend(values[row].to_le_bytes()),
                    Values::Integer(values) => bytes.extend(values[row].to_le_bytes()),
                    Values::Truth(values) => bytes.push(values[row].into()),
                }
            }
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
