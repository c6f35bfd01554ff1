//! Whether generated code finds the crate `kinematics` by its own name.

use std::path::Path;

const CRATE: &str = "kinematics";

/// What to do where a package has no dependency of that name. Its manifest is
/// searched for one, not understood: where that errs, the option says so.
pub fn missing(root: &Path) -> Option<String> {
    let manifest = std::fs::read_to_string(root.join("Cargo.toml")).ok()?;
    (!has_dependency(&manifest)).then(|| {
        format!(
            "this package's Cargo.toml has no dependency called `{CRATE}`\nhelp: if yours has \
             another name, or another crate hands it on, say which: `crate = ::robotics`, `crate \
             = ::robotics::{CRATE}`; where `{CRATE}` is found all the same, `crate = ::{CRATE}`"
        )
    })
}

/// Whether a line of a manifest has the crate's name as a key, such as
/// `kinematics = "0.1"`, `kinematics.workspace = true` and
/// `[dependencies.kinematics]`, or as the name of the package itself.
fn has_dependency(manifest: &str) -> bool {
    let blank = |c: char| c.is_whitespace() || matches!(c, '"' | '\'');
    manifest.lines().any(|line| {
        line.match_indices(CRATE).any(|(at, _)| {
            let before = line[..at].trim_end_matches(blank);
            let after = line[at + CRATE.len()..].trim_start_matches(blank);
            let is_key = (before.is_empty() || before.ends_with(['.', '{', ',']))
                && after.starts_with(['=', '.', ']']);
            is_key
                || before
                    .strip_suffix('=')
                    .is_some_and(|key| key.trim() == "name")
        })
    })
}

#[cfg(test)]
mod tests {
    use super::has_dependency;

    #[test]
    fn dependencies_are_found_by_their_name() {
        for manifest in [
            "[dependencies]\nkinematics = \"0.1\"",
            "[dependencies]\n\"kinematics\" = { path = \"..\" }",
            "[dependencies]\nkinematics.workspace = true",
            "[target.'cfg(unix)'.dev-dependencies.kinematics]\nversion = \"0.1\"",
            "dependencies = { serde = \"1\", kinematics = \"0.1\" }",
            "[package]\nname = \"kinematics\"",
        ] {
            assert!(has_dependency(manifest), "{manifest}");
        }
    }

    #[test]
    fn other_names_are_others() {
        for manifest in [
            "",
            "[dependencies]\nrobotics = { package = \"kinematics\", version = \"0.1\" }",
            "[dependencies]\nkinematics-extra = \"0.1\"",
            "[dependencies]\nmy-kinematics = \"0.1\"",
            "[package]\nkeywords = [\"kinematics\"]",
            "[package]\ndescription = \"forward kinematics = fun\"",
        ] {
            assert!(!has_dependency(manifest), "{manifest}");
        }
    }
}
