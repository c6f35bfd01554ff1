//! Which format a robot file is in.

use super::{Diagnostic, Diagnostics, Source};
use std::path::Path;

/// The formats that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Urdf,
    Yaml,
}

/// Decides by the file's extension, and by its first character when the
/// extension says nothing.
pub(super) fn of(source: &Source) -> Result<Format, Diagnostics> {
    refuse_stand_in(source)?;
    let extension = Path::new(&source.path)
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or("");
    match extension.to_ascii_lowercase().as_str() {
        "urdf" | "xml" | "xacro" => Ok(Format::Urdf),
        "yaml" | "yml" if source.text.trim_start().starts_with('<') => Err(refuse(
            source,
            "this is XML, and the name says that it is YAML",
            "name the file `.urdf`",
        )),
        // JSON is YAML.
        "yaml" | "yml" | "json" => Ok(Format::Yaml),
        "sdf" | "mjcf" | "usd" | "usda" | "srdf" => Err(refuse(
            source,
            format!("`.{extension}` files cannot be read"),
            "convert the robot to URDF, or write it down in YAML",
        )),
        _ => sniff(source),
    }
}

/// What lies where a robot file should, when it could not be fetched.
fn refuse_stand_in(source: &Source) -> Result<(), Diagnostics> {
    let start: String = source.text.trim_start().chars().take(40).collect();
    let start = start.to_ascii_lowercase();
    if start.starts_with("version https://git-lfs.") {
        return Err(refuse(
            source,
            "this is not the file itself but the pointer that Git LFS keeps in its place",
            "fetch the file: `git lfs pull`",
        ));
    }
    if start.starts_with("<!doctype html") || start.starts_with("<html") {
        return Err(refuse(
            source,
            "this is a web page, perhaps the one that shows the file",
            "download the file itself (on GitHub: Raw)",
        ));
    }
    Ok(())
}

fn sniff(source: &Source) -> Result<Format, Diagnostics> {
    let text = source.text.trim_start();
    if text.starts_with('<') {
        Ok(Format::Urdf)
    } else if is_yaml_robot(text) {
        Ok(Format::Yaml)
    } else {
        Err(refuse(
            source,
            "neither the name nor the content tells a format: this is no XML, and no YAML robot with `robot:` and `units:`",
            "name the file `.urdf` (or `.xml`), or `.yaml` (or `.yml`)",
        ))
    }
}

/// Whether a text has the keys that every YAML robot has.
pub(super) fn is_yaml_robot(text: &str) -> bool {
    text.lines()
        .any(|line| line.starts_with("robot:") || line.starts_with("units:"))
}

fn refuse(source: &Source, reason: impl Into<String>, remedy: &str) -> Diagnostics {
    Diagnostics::one(&source.path, Diagnostic::whole(reason, remedy))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn format(path: &str, text: &str) -> Result<Format, Diagnostics> {
        of(&Source {
            path: path.into(),
            text: text.into(),
        })
    }

    #[test]
    fn extensions_decide() {
        assert_eq!(format("a.URDF", ""), Ok(Format::Urdf));
        assert_eq!(format("a.urdf.xml", ""), Ok(Format::Urdf));
        assert_eq!(format("a.yml", "robot: arm"), Ok(Format::Yaml));
        assert!(format("a.yml", "<robot/>").is_err());
        assert_eq!(format("a.json", "{\"robot\": \"arm\"}"), Ok(Format::Yaml));
    }

    #[test]
    fn content_decides_without_an_extension() {
        assert_eq!(format("arm", "\n<robot/>"), Ok(Format::Urdf));
        assert_eq!(format("arm.txt", "# mine\nrobot: arm"), Ok(Format::Yaml));
        assert!(format("arm", "solid cube").is_err());
    }
}
