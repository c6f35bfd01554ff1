//! A build script, because packages with one have an output directory: what was found for robots
//! lands there, and code that `debug = true` writes when the user's crate has none.

use std::path::Path;
use std::{env, fs, io};

/// The sources of what finds it, where they are beside this package: they may change without a new
/// version. A package of a registry has its dependencies elsewhere.
const FINDERS: [&str; 2] = ["../kin-codegen", "../kin-runtime"];

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    for finder in FINDERS.iter().filter(|it| Path::new(it).is_dir()) {
        println!("cargo::rerun-if-changed={finder}/src");
    }
    let folder = env::var_os("OUT_DIR").unwrap_or_default();
    match fs::remove_dir_all(Path::new(&folder).join("found")) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}
