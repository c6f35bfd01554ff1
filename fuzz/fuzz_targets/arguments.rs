//! The arguments of `kinematics!`.
#![no_main]

use libfuzzer_sys::fuzz_target;

#[allow(dead_code, reason = "only parsed")]
#[path = "../../kin-macros/src/arguments.rs"]
mod arguments;
#[path = "../src/arguments.rs"]
mod checked;

fuzz_target!(|text: &str| {
    checked::check(text, syn::parse2::<arguments::Arguments>);
});
