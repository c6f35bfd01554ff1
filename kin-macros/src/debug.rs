//! `debug = true`: the code as a file that can be opened.

use kin_codegen::Generated;
use proc_macro2::TokenStream;
use quote::quote;
use std::ffi::OsString;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// Writes the formatted code, and expands to its `include!`. Errors and
/// debuggers then point into that file.
pub fn through_file(generated: &Generated, invocation: &str) -> Result<TokenStream, String> {
    let file = file(&generated.name, invocation);
    write(&file, &generated.code())
        .map_err(|error| format!("cannot write the code to {}: {error}", file.display()))?;
    let shown = file.to_string_lossy();
    Ok(quote!(::core::include!(#shown);))
}

/// Every invocation has a file of its own, and the same one in every build.
fn file(name: &str, invocation: &str) -> PathBuf {
    let mut hasher = DefaultHasher::new();
    invocation.hash(&mut hasher);
    let package = env::var_os("CARGO_CRATE_NAME").unwrap_or_default();
    let file = format!("{name}-{:08x}.rs", hasher.finish() as u32);
    folder().join("kinematics").join(package).join(file)
}

/// The output directory of the crate's build script; of its integration test;
/// or that of this crate, which is always there.
fn folder() -> PathBuf {
    let own = || OsString::from(env!("OUT_DIR"));
    env::var_os("OUT_DIR")
        .or_else(|| env::var_os("CARGO_TARGET_TMPDIR"))
        .unwrap_or_else(own)
        .into()
}

/// A library and its tests may be compiled at the same time, from the same
/// invocation: neither may see half a file. One that is right is left alone: Cargo compiles
/// again what includes a newer one.
fn write(file: &Path, code: &str) -> io::Result<()> {
    if fs::read(file).is_ok_and(|there| there == code.as_bytes()) {
        return Ok(());
    }
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    let partial = file.with_extension(std::process::id().to_string());
    fs::write(&partial, code)?;
    fs::rename(&partial, file)
}
