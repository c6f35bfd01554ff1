//! The kinematics compiler as a library: robot file in, verified Rust out.
//!
//! ```
//! use kin_codegen::{Options, Source, generate};
//! let text = "
//! robot: planar
//! units: {angle: rad, length: m}
//! screws:
//!   - {name: shoulder, axis: [0, 0, 1], point: [0, 0, 0]}
//!   - {name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}
//! home: {xyz: [0.9, 0, 0]}
//! ";
//! let source = Source { path: "planar.yaml".into(), text: text.into() };
//! let generated = generate(&source, &Options::default())?;
//! assert!(generated.code().contains("pub struct Planar;"));
//! # Ok::<(), kin_codegen::Error>(())
//! ```
//!
//! [`generate`] is what the macro, [`build`] scripts and `kin generate` call;
//! [`compile`] stops before Rust is written. The formats of robot files are
//! described in [`spec`].

pub mod build;
mod compile;
mod compiled;
mod error;
mod generate;
mod options;
mod refusal;
pub mod spec;

/// The rooms of the compiler, in the order in which data walks through them.
/// Open to the programs and tests of the project; no part of what versions
/// promise.
macro_rules! rooms {
    ($($room:ident)*) => { $(#[doc(hidden)] pub mod $room;)* };
}
rooms! {
    random vector model geometry singularity plan expr closed_form certificate solver arm mechanism emit
}

pub use compile::compile;
pub use compiled::Compiled;
pub use error::Error;
pub use generate::{Generated, generate};
pub use options::{Ik, Options, Unknown, target};
pub use plan::Target;
pub use refusal::{Reason, Refusal};
pub use spec::{Diagnostics, Source};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
