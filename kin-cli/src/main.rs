//! The `kin` command.
fn main() {}
