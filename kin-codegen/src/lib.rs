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
//! [`generate`] is what [`build`] scripts and `kin generate` call, the macro [`generate_cached`];
//! [`compile`] stops before Rust is written. The formats of robot files are
//! described in [`spec`].

pub mod build;
mod compile;
mod compiled;
mod error;
mod generate;
mod generate_c;
mod generate_js;
mod hash;
mod options;
mod refusal;
pub mod spec;

// The rooms of the compiler, which ARCHITECTURE.md shows in the order of the data: open
// to the programs and tests of the project; no part of what versions promise.
#[doc(hidden)]
pub mod arm;
#[doc(hidden)]
pub mod certificate;
#[doc(hidden)]
pub mod closed_form;
#[doc(hidden)]
pub mod emit;
#[doc(hidden)]
pub mod expr;
#[doc(hidden)]
pub mod found;
#[doc(hidden)]
pub mod geometry;
#[doc(hidden)]
pub mod mechanism;
#[doc(hidden)]
pub mod model;
#[doc(hidden)]
pub mod plan;
#[doc(hidden)]
pub mod random;
#[doc(hidden)]
pub mod redundancy;
mod scalar;
mod single;
#[doc(hidden)]
pub mod singularity;
#[doc(hidden)]
pub mod solver;
mod threads;
#[doc(hidden)]
pub mod univariate;
#[doc(hidden)]
pub mod vector;

pub use compile::{compile, compile_cached};
pub use compiled::Compiled;
pub use error::Error;
pub use generate::{Generated, generate, generate_cached};
pub use generate_c::{GeneratedC, generate_c};
pub use generate_js::{GeneratedJs, generate_js};
pub use options::{Ik, Options, Unknown, target};
pub use plan::Target;
pub use refusal::{Reason, Refusal};
pub use scalar::Scalar;
pub use spec::{Diagnostics, Source};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
