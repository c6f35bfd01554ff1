//! A file, or all tables of a folder.

use crate::is_same;
use crate::table::{Fault, Format};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};
use std::{env, fs, io};

/// A table to be read and one to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// What is read.
    pub input: PathBuf,
    /// What is written.
    pub output: PathBuf,
    /// How it is written.
    pub format: Format,
}

/// One of several machines that share the files of a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// Which, from 1.
    pub number: usize,
    /// Of how many.
    pub of: usize,
}

impl Share {
    /// All of it.
    pub const WHOLE: Share = Share { number: 1, of: 1 };
}

/// What belongs to an output: itself for a file; for a folder the same names with the ending of
/// the format, of every file of the share, by name.
///
/// Folders in folders are kept; names that begin with `.` or `_` are passed over, as Spark,
/// DuckDB and others do, and so is what is no table.
///
/// # Errors
///
/// A folder cannot be read or made, has no table, or two that would have the same output; or the
/// format of the output is not known.
pub fn pairs(
    input: &Path,
    output: &Path,
    format: Option<Format>,
    share: Share,
) -> Result<Vec<Pair>, Fault> {
    if !input.is_dir() {
        if share.of > 1 {
            let reason = "is one table, and `--share` takes every Nth of a folder";
            return Err(Fault::whole(
                input,
                reason,
                "name the folder, or leave out `--share`",
            ));
        }
        let format = match format {
            Some(format) => format,
            None => Format::of(output)?,
        };
        if is_same(input, output) {
            return Err(Fault::whole(output, "is the input", "name another file"));
        }
        return Ok(vec![Pair {
            input: input.into(),
            output: output.into(),
            format,
        }]);
    }
    if Format::of(output).is_ok() && !output.is_dir() {
        let reason = "is named as a table, where the input is a folder";
        return Err(Fault::whole(output, reason, "name a folder"));
    }
    let within = |input: io::Result<PathBuf>| Ok(resolved(output)?.starts_with(input?));
    if within(fs::canonicalize(input)).map_err(|error| Fault::unwritable(output, &error))? {
        let reason = "is the folder of the input, or in it";
        return Err(Fault::whole(output, reason, "name another folder"));
    }
    let mut tables = Vec::new();
    walk(input, Path::new(""), &mut BTreeSet::new(), &mut tables)?;
    tables.sort();
    if tables.is_empty() {
        let endings = Format::ALL.map(Format::extension).join(", ");
        let reason = format!("the folder has no table: no file that ends with {endings}");
        return Err(Fault::whole(input, reason, "name the folder that has them"));
    }
    let mut taken: BTreeMap<PathBuf, &Path> = BTreeMap::new();
    let mut pairs = Vec::new();
    for (number, (table, own)) in tables.iter().enumerate() {
        let format = format.unwrap_or(*own);
        let output = output.join(table).with_extension(format.extension());
        if let Some(other) = taken.insert(output.clone(), table) {
            let reason = format!("`{}` would have the same output", other.display());
            let remedy = "give one of them another name";
            return Err(Fault::whole(&input.join(table), reason, remedy));
        }
        if number % share.of == share.number - 1 {
            pairs.push(Pair {
                input: input.join(table),
                output,
                format,
            });
        }
    }
    for pair in &pairs {
        let folder = pair.output.parent().unwrap_or(output);
        fs::create_dir_all(folder).map_err(|error| Fault::unwritable(folder, &error))?;
    }
    Ok(pairs)
}

/// A path without links and `..`, of which the end need not be there yet.
fn resolved(path: &Path) -> io::Result<PathBuf> {
    let mut found = env::current_dir()?;
    for part in path.components() {
        match part {
            Component::ParentDir => drop(found.pop()),
            part => found.push(part),
        }
        found = fs::canonicalize(&found).unwrap_or(found);
    }
    Ok(found)
}

/// The tables below a folder, by their paths in it; each folder once, however many links lead
/// to it.
fn walk(
    root: &Path,
    below: &Path,
    seen: &mut BTreeSet<PathBuf>,
    tables: &mut Vec<(PathBuf, Format)>,
) -> Result<(), Fault> {
    let folder = root.join(below);
    let unreadable = |error| Fault::unreadable(&folder, &error);
    if !seen.insert(fs::canonicalize(&folder).map_err(unreadable)?) {
        return Ok(());
    }
    for entry in fs::read_dir(&folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let name = entry.file_name();
        if name.to_string_lossy().starts_with(['.', '_']) {
            continue;
        }
        let path = below.join(&name);
        if entry.path().is_dir() {
            walk(root, &path, seen, tables)?;
        } else if let Ok(format) = Format::of(&path) {
            tables.push((path, format));
        }
    }
    Ok(())
}
