//! Where an output is written, and the hidden files beside it in which it begins.

use crate::table::Fault;
use std::fs::{self, File, OpenOptions};
use std::path::{Path, PathBuf};

/// A hidden file beside the output, for those who take all files of a folder.
pub(super) fn beside(output: &Path, ending: &str) -> PathBuf {
    let name = output.file_name().unwrap_or_default().to_string_lossy();
    output.with_file_name(format!(".{name}.{ending}"))
}

/// Where an output is written: if its name is a link, where that leads.
///
/// # Errors
///
/// What has the name is no file, and would be replaced by one.
pub(super) fn place_of(output: &Path) -> Result<PathBuf, Fault> {
    let Ok(found) = fs::symlink_metadata(output) else {
        return Ok(output.to_owned());
    };
    let unwritable = |error| Fault::unwritable(output, &error);
    let place = match found.is_symlink() {
        true => fs::canonicalize(output).map_err(unwritable)?,
        false => output.to_owned(),
    };
    if fs::metadata(&place).map_err(unwritable)?.is_file() {
        return Ok(place);
    }
    let reason = "is no file, and would be replaced by one";
    let remedy = "name a file: what is written begins in a hidden one beside it";
    Err(Fault::whole(output, reason, remedy))
}

/// A hidden file of an output, made or gone on with.
pub(super) fn open_hidden(path: &Path, output: &Path) -> Result<File, Fault> {
    if fs::symlink_metadata(path).is_ok_and(|it| !it.is_file()) {
        let reason = format!("is begun in {}, which is no file", path.display());
        return Err(Fault::whole(output, reason, "remove that"));
    }
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    let opened = options.open(path);
    opened.map_err(|error| Fault::unwritable(output, &error))
}
