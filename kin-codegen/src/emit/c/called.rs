//! What of a file is called: definitions that nobody calls are not written.
//!
//! Definitions stand between empty lines, each in front of those that name it.

use std::collections::HashSet;

/// What other files may call, and what that calls.
pub fn called(code: &str) -> String {
    let (mut named, mut kept) = (HashSet::new(), Vec::new());
    let all: Vec<&str> = code.split("\n\n").collect();
    for block in all.into_iter().rev().map(|it| it.trim_matches('\n')) {
        let mut defined = block.lines().filter_map(definition);
        if defined.any(|it| it.is_public || named.contains(it.name)) {
            named.extend(
                without_comments(block)
                    .flat_map(names)
                    .map(|(name, _)| name),
            );
            kept.push(block);
        }
    }
    kept.reverse();
    kept.join("\n\n") + "\n"
}

/// The same definitions for this file alone.
pub fn hidden(code: &str) -> String {
    let line = |line: &str| match definition(line) {
        Some(it) if it.is_public => format!("static {line}\n"),
        _ => format!("{line}\n"),
    };
    code.lines().map(line).collect()
}

/// The names that code defines.
pub fn defined(code: &str) -> impl Iterator<Item = &str> {
    code.lines().filter_map(definition).map(|it| it.name)
}

struct Definition<'c> {
    name: &'c str,
    is_public: bool,
}

/// What a line begins to define.
fn definition(line: &str) -> Option<Definition<'_>> {
    const INSIDE: [char; 3] = [' ', '/', '{'];
    const ENDS: [&str; 6] = ["(", "[", " =", " {", ";", ","];
    const OWN: [&str; 5] = ["static ", "typedef ", "#define ", "} ", "KIN_"];
    if line.starts_with(INSIDE) {
        return None;
    }
    let is_macro = line.starts_with("#define ");
    let ends = |rest: &str| is_macro || ENDS.iter().any(|it| rest.starts_with(it));
    let is_defined = |name: &str| is_macro || name != "KIN_BY_PROCESSOR";
    let (name, _) = names(line).find(|(name, rest)| is_defined(name) && ends(rest))?;
    Some(Definition {
        name,
        is_public: !OWN.iter().any(|it| line.starts_with(it)),
    })
}

fn without_comments(code: &str) -> impl Iterator<Item = &str> {
    let pieces = code.split("/*");
    pieces.filter_map(|piece| piece.rsplit("*/").next())
}

/// The robot's names in code, and what stands behind each.
fn names(code: &str) -> impl Iterator<Item = (&str, &str)> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut rest = code;
    std::iter::from_fn(move || {
        loop {
            rest = &rest[rest.find(is_part)?..];
            let (word, behind) = rest.split_at(rest.find(|c| !is_part(c)).unwrap_or(rest.len()));
            rest = behind;
            if word.starts_with("kin_") || word.starts_with("KIN_") {
                return Some((word, behind));
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CODE: &str = "\
KIN_INLINE double kin_once(double x)
{
    return x;
}

typedef struct kin_pair {
    double both[2];
} kin_pair;

static __attribute__((target(\"avx2\"))) kin_pair kin_twice(kin_pair x)
{
    return x;
}

#define KIN_SIZE 1.0

#define KIN_OTHER 2.0

KIN_BY_PROCESSOR(kin_wide, (const kin_pair *x), (x))

const double kin_table[2] = {KIN_OTHER, KIN_OTHER};

/* Without kin_twice. */
int kin_public(
    double x)
{
    return kin_once(x) < KIN_SIZE;
}
";

    #[test]
    fn definitions_are_seen() {
        let all = "kin_once kin_pair kin_pair kin_twice KIN_SIZE KIN_OTHER kin_wide kin_table \
                   kin_public";
        assert_eq!(defined(CODE).collect::<Vec<_>>().join(" "), all);
    }

    #[test]
    fn what_nobody_calls_is_left_out() {
        let all = "kin_once KIN_SIZE KIN_OTHER kin_table kin_public";
        assert_eq!(defined(&called(CODE)).collect::<Vec<_>>().join(" "), all);
        let called = called(&hidden(CODE));
        assert!(called.trim().is_empty(), "{called}");
    }

    #[test]
    fn what_is_hidden_is_this_files_own() {
        let hidden = hidden(CODE);
        for own in ["static const double kin_table[", "static int kin_public("] {
            assert!(hidden.contains(own), "{hidden}");
        }
        assert!(!hidden.contains("static static") && !hidden.contains("static KIN"));
        assert_eq!(super::hidden(&hidden), hidden);
    }
}
