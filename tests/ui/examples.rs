//! The examples in generated code run, and nothing in it warns: all robots, as the build script
//! has written them.

#![deny(warnings, missing_docs, unused, unused_qualifications)]

include!(concat!(env!("OUT_DIR"), "/examples.rs"));
