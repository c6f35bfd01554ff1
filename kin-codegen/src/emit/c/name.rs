//! What a robot's symbols and files begin with.

use crate::options::Options;
use crate::spec::{Diagnostic, stem};

/// Headers of C and C++, and those of the GNU C library that they ask for, that a robot's would stand
/// in for where its folder is searched first.
const HEADERS: [&str; 32] = [
    "assert",
    "complex",
    "ctype",
    "endian",
    "errno",
    "features",
    "fenv",
    "float",
    "inttypes",
    "iso646",
    "limits",
    "locale",
    "malloc",
    "math",
    "memory",
    "setjmp",
    "signal",
    "stdalign",
    "stdarg",
    "stdatomic",
    "stdbool",
    "stddef",
    "stdint",
    "stdio",
    "stdlib",
    "stdnoreturn",
    "string",
    "tgmath",
    "threads",
    "time",
    "uchar",
    "wchar",
];

/// The prefix of a robot's symbols, and the stem of its files: the option `name`, or the stem
/// of the robot file in lower case. Every symbol goes on behind it, so that a reserved word
/// may stand in it.
pub fn prefix(options: &Options, path: &str) -> Result<String, Diagnostic> {
    let Some(name) = &options.name else {
        return Ok(snake_case(stem(path)));
    };
    let reason = match () {
        () if !is_identifier(name) => {
            format!("`{name}` cannot begin the names of a C library")
        }
        () if is_header(name) => format!("`{name}.h` is a header of C"),
        () => return Ok(name.clone()),
    };
    let remedy = format!(
        "names are of ASCII letters, digits and single underscores, with a letter in front: \
         `name = {}`",
        snake_case(name)
    );
    Err(Diagnostic::whole(reason, remedy))
}

/// Whether a file of this name is a header, on a disk that does not tell letters by case either.
fn is_header(name: &str) -> bool {
    HEADERS.contains(&name.to_ascii_lowercase().as_str())
}

/// Whether a name can begin identifiers, none of which C or C++ reserve.
fn is_identifier(name: &str) -> bool {
    let part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(part)
        && !name.contains("__")
        && !name.ends_with('_')
}

/// `KR6-R900` becomes `kr6_r900`.
fn snake_case(stem: &str) -> String {
    let words = stem
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty());
    let name = words.collect::<Vec<_>>().join("_").to_ascii_lowercase();
    match name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        true if is_header(&name) => format!("robot_{name}"),
        true => name,
        false if name.is_empty() => "robot".into(),
        false => format!("robot{name}"),
    }
}

/// Code that speaks of `kin_` and `KIN_`, with the robot's name in their place.
pub fn named(code: &str, prefix: &str) -> String {
    let upper = prefix.to_ascii_uppercase();
    let lines = code.split("KIN_").map(|part| {
        let parts: Vec<&str> = part.split("kin_").collect();
        parts.join(&format!("{prefix}_"))
    });
    lines.collect::<Vec<_>>().join(&format!("{upper}_"))
}

/// Code of a part of a robot, whose names get the part's behind `kin_`, but for those that are
/// `shared` by all parts.
pub fn of_part(code: &str, part: &str, shared: impl Fn(&str) -> bool) -> String {
    let own = |code: &str, prefix: &str, part: &str| {
        let mut pieces = code.split(prefix);
        let mut out = pieces.next().unwrap_or_default().to_owned();
        for piece in pieces {
            let end = piece.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            let name = &piece[..end.unwrap_or(piece.len())];
            out += prefix;
            if !shared(&format!("{prefix}{name}")) {
                out += part;
                out.push('_');
            }
            out += piece;
        }
        out
    };
    own(&own(code, "kin_", part), "KIN_", &part.to_ascii_uppercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_from_the_file() {
        let name = |path: &str| prefix(&Options::default(), path).unwrap();
        assert_eq!(name("robots/KR6-R900.yaml"), "kr6_r900");
        assert_eq!(name("int.urdf"), "int");
        assert_eq!(name("math.urdf"), "robot_math");
        assert_eq!(name("Features.urdf"), "robot_features");
        assert_eq!(name("3r.yaml"), "robot3r");
        assert_eq!(name("__x__.yaml"), "x");
        assert_eq!(name("机械臂.urdf"), "robot");
        assert_eq!(name("x; system(\"reboot\").urdf"), "x_system_reboot");
    }

    #[test]
    fn a_name_is_not_named_again() {
        assert_eq!(
            named("kin_fk(KIN_JOINTS)", "AKIN_kin"),
            "AKIN_kin_fk(AKIN_KIN_JOINTS)"
        );
    }

    #[test]
    fn parts_share_what_is_the_same() {
        let code = "KIN_INLINE kin_fk(KIN_JOINTS); kin_max(kin_maximum)";
        let shared = |name: &str| ["KIN_INLINE", "kin_max"].contains(&name);
        assert_eq!(
            of_part(code, "chain1", shared),
            "KIN_INLINE kin_chain1_fk(KIN_CHAIN1_JOINTS); kin_max(kin_chain1_maximum)"
        );
    }

    #[test]
    fn names_that_break_c_are_refused() {
        let asked = |name: &str| {
            let options = Options {
                name: Some(name.into()),
                ..Options::default()
            };
            prefix(&options, "arm.urdf").map_err(|refused| refused.reason)
        };
        assert_eq!(asked("Ur5e").unwrap(), "Ur5e");
        for name in ["", "a b", "1a", "_a", "a__b", "a_", "a;b", "é", "a-b"] {
            let reason = format!("`{name}` cannot begin the names of a C library");
            assert_eq!(asked(name).unwrap_err(), reason);
        }
        assert_eq!(asked("math").unwrap_err(), "`math.h` is a header of C");
        assert_eq!(asked("Math").unwrap_err(), "`Math.h` is a header of C");
    }
}
