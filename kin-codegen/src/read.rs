//! From a path to a source, the same behind every door.

use crate::spec::{Diagnostic, Diagnostics, Source};
use std::io::ErrorKind;
use std::path::Path;

impl Source {
    /// Reads a robot file. A relative `path` is relative to `root`; messages
    /// name the file as `path` does.
    ///
    /// # Errors
    ///
    /// The file cannot be read, or is not text.
    pub fn read(path: &str, root: &Path) -> Result<Source, Diagnostics> {
        let file = root.join(path);
        std::fs::read_to_string(&file)
            .map(|text| Source {
                path: path.into(),
                text,
            })
            .map_err(|error| unreadable(path, root, &file, &error))
    }
}

fn unreadable(path: &str, root: &Path, file: &Path, error: &std::io::Error) -> Diagnostics {
    let shown = file.display();
    let relative = Path::new(path).is_relative() && !root.as_os_str().is_empty();
    let (reason, remedy) = match error.kind() {
        ErrorKind::NotFound if relative => (
            format!("there is no such file: looked for {shown}"),
            format!("write the path relative to {}, or absolute", root.display()),
        ),
        ErrorKind::NotFound => ("there is no such file".into(), "check the path".into()),
        ErrorKind::InvalidData => (
            "the file is not UTF-8 text".into(),
            "give a URDF or YAML file, in UTF-8".into(),
        ),
        _ => (
            format!("cannot read {shown}: {error}"),
            "give the path of a URDF or YAML file".into(),
        ),
    };
    Diagnostics {
        path: path.into(),
        list: vec![Diagnostic {
            at: None,
            line: String::new(),
            reason,
            remedy,
        }],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_file_tells_where_it_was_looked_for() {
        let refused = Source::read("arms/arm.urdf", Path::new("/nowhere")).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "arms/arm.urdf: there is no such file: looked for /nowhere/arms/arm.urdf\n\
             help: write the path relative to /nowhere, or absolute"
        );
    }

    #[test]
    fn a_folder_is_no_file() {
        let refused = Source::read("src", Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_err();
        assert!(refused.to_string().starts_with("src: cannot read"));
    }
}
