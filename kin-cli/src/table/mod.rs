//! Tables in files: columns of numbers, read and written in portions of rows.
//!
//! A [`Reader`] hands out portions that any thread may decode; an [`Encoder`] turns columns into
//! pieces that stand one behind the other in a file. Memory is bounded by the portion in either.

mod csv;
mod fault;
mod lines;
mod literal;
mod npy;
mod parquet_read;
mod parquet_write;

pub use csv::number_for_name;
pub use fault::{Fault, Place};
pub use npy::head as npy_head;

use std::fs::File;
use std::io::{Read as _, Seek as _};
use std::path::Path;

/// How a table is written as a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, clap::ValueEnum)]
pub enum Format {
    /// Text: a line of names, a line for each row.
    Csv,
    /// An array of NumPy.
    Npy,
    /// Columns, row group by row group.
    Parquet,
}

impl Format {
    /// All of them.
    pub const ALL: [Format; 3] = [Format::Csv, Format::Npy, Format::Parquet];

    /// What the names of such files end with.
    pub const fn extension(self) -> &'static str {
        match self {
            Format::Csv => "csv",
            Format::Npy => "npy",
            Format::Parquet => "parquet",
        }
    }

    /// The format of a file, by its name.
    ///
    /// # Errors
    ///
    /// The name ends with that of no format.
    pub fn of(path: &Path) -> Result<Self, Fault> {
        let is = |format: &Format| {
            let extension = path.extension().and_then(|extension| extension.to_str());
            extension.is_some_and(|found| found.eq_ignore_ascii_case(format.extension()))
        };
        Self::ALL.into_iter().find(is).ok_or_else(|| {
            let endings = Self::ALL.map(|format| format!("`.{}`", format.extension()));
            Fault::whole(
                path,
                "the name does not tell the format of the table",
                format!("let it end with {}, or convert it", endings.join(" or ")),
            )
        })
    }

    /// What files of it begin with; none if they are text.
    const fn magic(self) -> Option<&'static [u8]> {
        match self {
            Format::Csv => None,
            Format::Npy => Some(b"\x93NUMPY"),
            Format::Parquet => Some(b"PAR1"),
        }
    }

    /// Opens a file and reads what its columns are.
    ///
    /// # Errors
    ///
    /// The file cannot be read, or is no table of this format.
    pub fn open(self, path: &Path) -> Result<Box<dyn Reader>, Fault> {
        let unreadable = |error| Fault::unreadable(path, &error);
        let mut file = File::open(path).map_err(unreadable)?;
        let mut start = Vec::new();
        // A pipe is not read twice.
        if file.metadata().is_ok_and(|it| it.is_file()) {
            let read = (&mut file).take(8).read_to_end(&mut start);
            read.and_then(|_| file.rewind()).map_err(unreadable)?;
        }
        let is = |it: &Format| it.magic().is_some_and(|magic| start.starts_with(magic));
        let found = Self::ALL.into_iter().find(is);
        if let Some(found) = found.filter(|found| *found != self) {
            let found = found.extension();
            return Err(Fault::whole(
                path,
                format!("the content is that of a `.{found}` file"),
                format!("let its name end with `.{found}`"),
            ));
        }
        Ok(match self {
            Format::Csv => Box::new(csv::CsvReader::new(path, file)?),
            Format::Npy => Box::new(npy::NpyReader::new(path, file)?),
            Format::Parquet => Box::new(parquet_read::ParquetReader::new(path, file)?),
        })
    }

    /// What writes these columns.
    pub fn encoder(self, columns: Vec<Column>) -> Box<dyn Encoder> {
        match self {
            Format::Csv => Box::new(csv::CsvEncoder::new(columns)),
            Format::Npy => Box::new(npy::NpyEncoder::new(columns)),
            Format::Parquet => Box::new(parquet_write::ParquetEncoder::new(columns)),
        }
    }
}

/// What a file says of its columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Header {
    /// Their names.
    Names(Vec<String>),
    /// An array without names: how many numbers a row has.
    Width(usize),
}

/// Some rows of a table, not yet decoded.
pub struct Portion {
    /// The number of the first row in the file, from 0.
    pub first: u64,
    /// Its share of [`Reader::extent`].
    pub extent: u64,
    decode: Box<dyn FnOnce() -> Result<Vec<Vec<f64>>, Fault> + Send>,
}

impl Portion {
    /// The columns that were selected; NaN where a value is missing.
    ///
    /// # Errors
    ///
    /// Something in these rows is no number.
    pub fn decode(self) -> Result<Vec<Vec<f64>>, Fault> {
        (self.decode)()
    }
}

/// A table that is read from its beginning to its end.
pub trait Reader: Send {
    /// What the file says of its columns.
    fn header(&self) -> &Header;
    /// How much there is to read, and what is counted, in the plural.
    fn extent(&self) -> (u64, &'static str);
    /// Chooses the columns that portions have, by their places.
    ///
    /// # Errors
    ///
    /// A column has no numbers.
    fn select(&mut self, columns: &[usize]) -> Result<(), Fault>;
    /// The next rows, at most as many as said; the same ones whenever a file is read with the
    /// same numbers.
    ///
    /// # Errors
    ///
    /// The file cannot be read, or ends too early.
    fn next(&mut self, rows: usize) -> Result<Option<Portion>, Fault>;
}

/// A column to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// What it is called.
    pub name: String,
    /// What its values are.
    pub kind: Kind,
}

/// What the values of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Doubles.
    Real,
    /// Integers of 64 bits.
    Integer,
    /// True or false.
    Truth,
}

/// Values of a column, of the [`Kind`] that it has.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Of a column of [`Kind::Real`]; NaN where there is none.
    Real(Vec<f64>),
    /// Of a column of [`Kind::Integer`].
    Integer(Vec<i64>),
    /// Of a column of [`Kind::Truth`].
    Truth(Vec<bool>),
}

impl Values {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Values::Real(values) => values.len(),
            Values::Integer(values) => values.len(),
            Values::Truth(values) => values.len(),
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Rows as they stand in a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Piece {
    /// How many rows these are.
    pub rows: u64,
    /// What stands in the file.
    pub bytes: Vec<u8>,
    /// What [`Encoder::tail`] needs to know of them.
    pub note: Vec<u8>,
}

/// Writes a table: its head, the pieces in their order, its tail.
pub trait Encoder: Send + Sync {
    /// What stands before all pieces; as many bytes whatever the number of rows.
    fn head(&self, rows: u64) -> Vec<u8>;
    /// Rows as bytes.
    ///
    /// # Errors
    ///
    /// They cannot be encoded, in words.
    fn encode(&self, columns: &[Values]) -> Result<Piece, String>;
    /// What stands behind all pieces, of which it is told the bytes and the notes.
    ///
    /// # Errors
    ///
    /// A note is none of this encoder, in words.
    fn tail(&self, pieces: &mut dyn Iterator<Item = (u64, &[u8])>) -> Result<Vec<u8>, String>;
}
