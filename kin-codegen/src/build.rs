//! Robots from a build script.
//!
//! For projects that would rather open the generated file than expand a
//! macro. With `kinematics` as a dependency and `kin-codegen` as a build
//! dependency, `build.rs` is
//!
//! ```no_run
//! fn main() -> Result<(), kin_codegen::build::Error> {
//!     kin_codegen::build::Config::new("arm.urdf").tip("tool0").generate()?;
//!     Ok(())
//! }
//! ```
//!
//! and the crate takes the result in with
//!
//! ```ignore
//! include!(concat!(env!("OUT_DIR"), "/arm.rs"));
//! ```
//!
//! Several robots, the arms of one file among them, go to one file by
//! [`generate_all`].

use crate::options::{Ik, Options};
use crate::plan::Target;
use crate::scalar::Scalar;
use crate::spec::{Source, file_name};
use std::collections::BTreeSet;
use std::fmt;
use std::panic;
use std::path::{Component, Path, PathBuf};
use std::thread::{self, ScopedJoinHandle};

/// One robot file to generate from, with the options of the macro.
#[derive(Clone, Debug)]
pub struct Config {
    path: String,
    options: Options,
    file: Option<PathBuf>,
}

impl Config {
    /// Generates from a robot file; a relative path is relative to the
    /// package's root.
    pub fn new(path: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            options: Options::default(),
            file: None,
        }
    }

    /// The name of the type; by default the file's stem in UpperCamelCase.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.options.name = Some(name.into());
        self
    }

    /// The link that the chain begins at; by default the root.
    pub fn base(mut self, link: impl Into<String>) -> Self {
        self.options.base = Some(link.into());
        self
    }

    /// The link that the chain ends at; by default `tool0`, `tcp` or the like at
    /// its end, or the only leaf; see [`Options::tip`].
    pub fn tip(mut self, link: impl Into<String>) -> Self {
        self.options.tip = Some(link.into());
        self
    }

    /// The frame of a tool in that of the tip, whose poses are meant: x, y and z in metres, then
    /// roll, pitch and yaw in radians.
    pub fn tool(mut self, tool: [f64; 6]) -> Self {
        self.options.tool = Some(tool);
        self
    }

    /// Which inverse kinematics to generate; by default a closed form.
    pub fn ik(mut self, ik: Ik) -> Self {
        self.options.ik = ik;
        self
    }

    /// What of a target counts; by default its position for arms of up to three joints
    /// that it fixes, such as a planar 2R arm, and the whole pose for all others.
    pub fn target(mut self, target: Target) -> Self {
        self.options.target = Some(target);
        self
    }

    /// A joint whose value `ik_at` takes beside a target, where the arm has more joints
    /// than its targets have coordinates; once for each; or `swivel`. By default the swivel
    /// angle, or the joints that give the cheapest closed form. See [`Options::free`].
    pub fn free(mut self, joint: impl Into<String>) -> Self {
        self.options.free.push(joint.into());
        self
    }

    /// The type of numbers in generated code; by default `f64`.
    pub fn scalar(mut self, scalar: Scalar) -> Self {
        self.options.scalar = scalar;
        self
    }

    /// Whether warnings about the robot file are errors; by default they are
    /// shown as warnings of the build script.
    pub fn strict(mut self, strict: bool) -> Self {
        self.options.strict = strict;
        self
    }

    /// The path of the crate `kinematics` in the generated code, for a
    /// dependency of another name or one that another crate hands on; by
    /// default `::kinematics`. See [`Options::krate`].
    pub fn krate(mut self, path: impl Into<String>) -> Self {
        self.options.krate = Some(path.into());
        self
    }

    /// The file to write; by default `$OUT_DIR/<stem of the robot file>.rs`: two of one stem
    /// need names of their own. A
    /// relative path is relative to `$OUT_DIR`; an absolute one does without.
    pub fn file(mut self, file: impl Into<PathBuf>) -> Self {
        self.file = Some(file.into());
        self
    }

    /// Generates, and has Cargo run the build script again when the robot file
    /// changes. Returns the file written.
    ///
    /// # Errors
    ///
    /// What is wrong with the file or the options, or why the arm has no
    /// closed form; the file cannot be written; this is no build script.
    pub fn generate(&self) -> Result<PathBuf, Error> {
        let (_, code) = self.code()?;
        let default = || Path::new(file_name(&self.path)).with_extension("rs");
        let file = output(self.file.clone().unwrap_or_else(default))?;
        write(&file, &code)?;
        Ok(file)
    }

    /// The name of the robot's type, and its code.
    fn code(&self) -> Result<(String, String), Error> {
        let root = variable("CARGO_MANIFEST_DIR")?;
        let robot = root.join(&self.path);
        // Also if it is missing or broken: mending it must run this again.
        println!("cargo::rerun-if-changed={}", robot.display());
        let source = Source::read(&self.path, &root).map_err(Error::new)?;
        let generated = crate::generate(&source, &self.options).map_err(Error::new)?;
        for warning in generated.robot.warnings() {
            // Cargo takes one line for each.
            println!("cargo::warning={}: {}", self.path, warning.reason);
        }
        Ok((generated.name.clone(), generated.code()))
    }
}

/// Generates several robots into one file, side by side on all cores: the arms of a robot with
/// two, or of a cell. [`Config::file`] of each is not asked.
///
/// ```no_run
/// use kin_codegen::build::{Config, Error, generate_all};
///
/// fn main() -> Result<(), Error> {
///     let arm = |name, tip| Config::new("robot.urdf").name(name).base("torso").tip(tip);
///     generate_all("arms.rs", &[arm("Left", "left_tool0"), arm("Right", "right_tool0")])?;
///     Ok(())
/// }
/// ```
///
/// # Errors
///
/// What is wrong with any of them, all at once, each as [`Config::generate`] says it; two have
/// the same name; there is none.
pub fn generate_all(file: impl Into<PathBuf>, robots: &[Config]) -> Result<PathBuf, Error> {
    if robots.is_empty() {
        return Err(Error::new(
            "there is no robot to generate: give a `Config` for each",
        ));
    }
    let all = thread::scope(|scope| {
        let start = |robot| scope.spawn(move || Config::code(robot));
        let all: Vec<_> = robots.iter().map(start).collect();
        let ended = |robot: ScopedJoinHandle<_>| match robot.join() {
            Ok(generated) => generated,
            Err(panic) => panic::resume_unwind(panic),
        };
        all.into_iter().map(ended).collect::<Vec<_>>()
    });
    let (mut code, mut names, mut errors) = (String::new(), BTreeSet::new(), Vec::new());
    for generated in all {
        match generated {
            Err(Error(text)) => errors.push(text),
            Ok((name, _)) if names.contains(&name) => errors.push(format!(
                "two robots have the name `{name}`: choose others by `Config::name`"
            )),
            Ok((name, robot)) => {
                code += &(robot + "\n");
                names.insert(name);
            }
        }
    }
    if !errors.is_empty() {
        return Err(Error(errors.join("\n\n")));
    }
    let file = output(file.into())?;
    write(&file, &code)?;
    Ok(file)
}

/// A relative path is relative to `$OUT_DIR`, and stays inside.
fn output(file: PathBuf) -> Result<PathBuf, Error> {
    if file.is_absolute() {
        return Ok(file);
    }
    if file.components().any(|part| part == Component::ParentDir) {
        return Err(Error::new(format!(
            "{} is outside of $OUT_DIR, to which it is relative: give a name without `..`, or an \
             absolute path",
            file.display()
        )));
    }
    Ok(variable("OUT_DIR")?.join(file))
}

fn variable(name: &str) -> Result<PathBuf, Error> {
    let missing = || {
        Error::new(format!(
            "{name} is not set: outside a build script, call `kin_codegen::generate`"
        ))
    };
    std::env::var_os(name)
        .map(PathBuf::from)
        .ok_or_else(missing)
}

fn write(file: &Path, code: &str) -> Result<(), Error> {
    std::fs::write(file, code).map_err(|error| {
        let shown = file.display();
        Error::new(format!(
            "cannot write {shown}: {error}; choose another file"
        ))
    })
}

/// Why a build script could not generate. Its `Debug` is its text, because
/// that is what Rust prints when `main` returns an error.
#[derive(Clone, PartialEq, Eq)]
pub struct Error(String);

impl Error {
    fn new(text: impl fmt::Display) -> Self {
        Self(text.to_string())
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}")
    }
}

impl std::error::Error for Error {}
