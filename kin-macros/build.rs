//! A build script, because packages with one have an output directory: code
//! that `debug = true` writes lands there when the user's crate has none.
fn main() {
    println!("cargo::rerun-if-changed=build.rs");
}
