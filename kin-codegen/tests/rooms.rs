//! Data flows one way: no circle of `use` between the modules of a crate.
//!
//! A module is a file of `src`, or a folder with all that is in it: what the
//! files of one folder take from each other is the folder's own affair, and is
//! looked at by itself.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Who takes from whom, with one place for each.
type Uses = BTreeMap<String, BTreeMap<String, String>>;

const CRATES: [&str; 4] = ["kin-runtime", "kin-codegen", "kin-macros", "kin-cli"];

/// All Rust files below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|it| it == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The module that a file is: `plan/search.rs` is `plan::search`, `plan/mod.rs`
/// and `plan.rs` are `plan`, `lib.rs` is the crate itself.
fn module(src: &Path, file: &Path) -> Vec<String> {
    let relative = file.strip_prefix(src).unwrap().with_extension("");
    let parts = relative
        .iter()
        .map(|part| part.to_str().unwrap().to_owned());
    let mut parts: Vec<String> = parts.collect();
    if ["mod", "lib", "main"].contains(&parts.last().unwrap().as_str()) {
        parts.pop();
    }
    parts
}

/// The modules of this crate that a file takes something from: every path that
/// begins with `crate::` or `super::`, outside of comments and unit tests.
fn taken(
    own: &[String],
    is_folder: bool,
    text: &str,
    modules: &BTreeSet<Vec<String>>,
) -> Vec<(Vec<String>, usize)> {
    let mut found = Vec::new();
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap();
    let mut prefix: Option<(Vec<String>, usize)> = None;
    for (number, line) in code.lines().enumerate() {
        let line = line.split("//").next().unwrap();
        let words: Vec<&str> = line
            .split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'))
            .collect();
        for word in words {
            let parts: Vec<&str> = word.split("::").filter(|part| !part.is_empty()).collect();
            let base = match parts.first() {
                Some(&"crate") => Vec::new(),
                Some(&"super") => {
                    // A folder's own file stands for the folder.
                    let up = own.len() - usize::from(!own.is_empty());
                    let _ = is_folder;
                    own[..up].to_vec()
                }
                _ => {
                    // Further names of `use crate::{a, b}`.
                    if let (Some((base, until)), Some(first)) = (&prefix, parts.first())
                        && number <= *until
                    {
                        let path = [&base[..], &[(*first).to_owned()]].concat();
                        if modules.contains(&path) {
                            found.push((path, number + 1));
                        }
                    }
                    continue;
                }
            };
            let mut path = base.clone();
            let mut supers = parts.iter().skip(1).peekable();
            while supers.peek() == Some(&&"super") {
                supers.next();
                path.pop();
            }
            for part in supers {
                let longer = [&path[..], &[(*part).to_owned()]].concat();
                if !modules.contains(&longer) {
                    break;
                }
                path = longer;
            }
            if word.ends_with("::") {
                let rest = code.lines().skip(number);
                let until = rest.take_while(|line| !line.contains(';')).count();
                prefix = Some((path.clone(), number + until));
            }
            found.push((path, number + 1));
        }
    }
    found
}

/// What the modules directly below `folder` take from each other.
fn uses(src: &Path, folder: &[String]) -> Uses {
    let files = sources(src);
    let modules: BTreeSet<Vec<String>> = files.iter().map(|file| module(src, file)).collect();
    let room = |path: &[String]| -> Option<String> {
        (path.len() > folder.len() && path.starts_with(folder)).then(|| path[folder.len()].clone())
    };
    let mut uses = Uses::new();
    for file in &files {
        let own = module(src, file);
        let Some(from) = room(&own) else { continue };
        let text = fs::read_to_string(file).unwrap();
        let is_folder = file.ends_with("mod.rs");
        for (path, line) in taken(&own, is_folder, &text, &modules) {
            let Some(to) = room(&path) else { continue };
            if to != from {
                let place = format!("{}:{line}", file.strip_prefix(src).unwrap().display());
                uses.entry(from.clone())
                    .or_default()
                    .entry(to)
                    .or_insert(place);
            }
        }
    }
    uses
}

/// A circle, if there is one: every module with the place where it takes from
/// the next.
fn circle(uses: &Uses) -> Option<Vec<String>> {
    fn walk<'u>(uses: &'u Uses, path: &mut Vec<&'u str>, done: &mut BTreeSet<&'u str>) -> bool {
        let last = *path.last().unwrap();
        for next in uses.get(last).into_iter().flat_map(BTreeMap::keys) {
            if let Some(start) = path.iter().position(|seen| seen == next) {
                path.drain(..start);
                return true;
            }
            if done.contains(next.as_str()) {
                continue;
            }
            path.push(next);
            if walk(uses, path, done) {
                return true;
            }
            path.pop();
        }
        done.insert(last);
        false
    }
    let mut done = BTreeSet::new();
    for start in uses.keys() {
        let mut path = vec![start.as_str()];
        if walk(uses, &mut path, &mut done) {
            let next = path.iter().cycle().skip(1);
            let steps = path.iter().zip(next);
            return Some(
                steps
                    .map(|(a, b)| format!("{a} -> {b} ({})", uses[*a][*b]))
                    .collect(),
            );
        }
    }
    None
}

/// The folders of a crate that hold modules, the crate itself first.
fn folders(src: &Path) -> BTreeSet<Vec<String>> {
    let modules = sources(src).into_iter().map(|file| module(src, &file));
    modules
        .filter(|module| !module.is_empty())
        .map(|module| module[..module.len() - 1].to_vec())
        .collect()
}

#[test]
fn no_circle_between_modules() {
    let mut circles = Vec::new();
    let mut arrows = 0;
    for name in CRATES {
        let src = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("..")
            .join(name)
            .join("src");
        for folder in folders(&src) {
            let uses = uses(&src, &folder);
            arrows += uses.values().map(BTreeMap::len).sum::<usize>();
            if let Some(circle) = circle(&uses) {
                circles.push(format!(
                    "{name}::{}: {}",
                    folder.join("::"),
                    circle.join(", ")
                ));
            }
        }
    }
    assert!(
        arrows > 100,
        "{arrows} uses were found: the reader is blind"
    );
    assert!(circles.is_empty(), "{}", circles.join("\n"));
}

#[test]
fn a_circle_is_seen() {
    let modules: BTreeSet<Vec<String>> = [&["a"][..], &["b"], &["b", "c"]]
        .map(|path| path.iter().map(|it| (*it).to_owned()).collect())
        .into();
    let of = |own: &[&str], text: &str| -> Vec<String> {
        let own: Vec<String> = own.iter().map(|it| (*it).to_owned()).collect();
        let found = taken(&own, false, text, &modules);
        found.into_iter().map(|(path, _)| path.join("::")).collect()
    };
    assert_eq!(of(&["a"], "use crate::b::c::Thing;"), ["b::c"]);
    assert_eq!(of(&["b", "c"], "use super::Thing; // crate::a"), ["b"]);
    assert_eq!(of(&["b", "c"], "fn f() { super::super::a::g() }"), ["a"]);
    assert_eq!(
        of(&["b"], "use crate::{\n    a::X,\n    b::Y,\n};"),
        ["", "a", "b"]
    );
    let arrow = |to: &str| BTreeMap::from([(to.to_owned(), "here".to_owned())]);
    let uses = Uses::from([("a".into(), arrow("b")), ("b".into(), arrow("a"))]);
    assert_eq!(circle(&uses).unwrap(), ["a -> b (here)", "b -> a (here)"]);
    assert!(circle(&Uses::from([("a".into(), arrow("b"))])).is_none());
}
