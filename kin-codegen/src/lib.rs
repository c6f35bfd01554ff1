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

pub mod arm;
pub mod build;
pub mod certificate;
pub mod closed_form;
mod compile;
mod compiled;
pub mod emit;
mod error;
pub mod expr;
mod generate;
pub mod geometry;
pub mod mechanism;
pub mod model;
pub mod options;
pub mod plan;
pub mod random;
pub mod refusal;
pub mod singularity;
pub mod solver;
pub mod spec;

pub use compile::compile;
pub use compiled::Compiled;
pub use error::Error;
pub use generate::{Generated, generate};
pub use options::{Ik, Options, Unknown, target};
pub use plan::Target;
pub use spec::{Diagnostics, Source};
