//! The command line.

use crate::batch::Share;
use crate::table::Format;
use clap::{Args, Parser, Subcommand, ValueEnum};
use kin_codegen::{Diagnostics, Ik, Options, Scalar, Source, Target};
use std::num::ParseFloatError;
use std::path::{Path, PathBuf};

/// The kinematics of a robot file, compiled and verified.
#[derive(Debug, Parser)]
#[command(name = "kin", version, about, after_help = EXIT_CODES)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "\
Exit codes:
  0  all is well
  1  a robot file or an option is wrong, or a file cannot be read or written
  2  the command line is wrong
  3  the arm has no closed form (explain says why, and ends with 0)
  4  generate --check: the checked-in code is stale
  5  check --targets or --at: the closed form lost solutions, or gave
     wrong ones
  6  the file has several robots: name base and tip

Errors name options as `kinematics!` takes them: `name = Arm` there is `--name Arm` here.";

#[derive(Debug, Subcommand)]
pub enum Command {
    Generate(Generate),
    Explain(Explain),
    Check(Check),
    Workspace(Workspace),
    Fk(Fk),
    Ik(InverseOfMany),
    View(View),
    Plot(Plot),
}

/// Write a robot's forward kinematics, Jacobians and closed-form inverse
/// kinematics as Rust, C or JavaScript
#[derive(Debug, Args)]
pub struct Generate {
    /// The robot file, URDF or YAML
    pub file: String,
    #[command(flatten)]
    pub options: RobotOptions,
    /// The language: Rust, C99 that is C++ as well, a header and a file that need
    /// nothing but math.h, or a module of JavaScript that needs nothing
    #[arg(long, value_enum, default_value_t)]
    pub lang: Language,
    /// The name of the type, or what all names in C begin with [default: the file's
    /// stem in UpperCamelCase, in C in lower case]
    #[arg(long)]
    pub name: Option<String>,
    /// The path of the crate `kinematics` where the code is compiled, if the
    /// dependency has another name or another crate hands it on [default:
    /// ::kinematics]
    #[arg(long = "crate", value_name = "PATH")]
    pub krate: Option<String>,
    /// Where to write [default: standard output]; of C the folder of the two files, which has to be
    /// given
    #[arg(short, long, required_if_eq("lang", "c"))]
    pub output: Option<PathBuf>,
    /// Write nothing; fail if the output is not what would be written
    #[arg(long, requires = "output")]
    pub check: bool,
}

/// A language of generated code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Language {
    #[default]
    Rust,
    C,
    Js,
}

/// Tell what is known of a robot: chain, axes, plan step by step, costs
#[derive(Debug, Args)]
pub struct Explain {
    /// The robot file, URDF or YAML
    pub file: String,
    #[command(flatten)]
    pub options: RobotOptions,
    /// As JSON, for programs
    #[arg(long)]
    pub json: bool,
}

/// Verify the closed forms of robot files again, one line for each
#[derive(Debug, Args)]
pub struct Check {
    /// The robot files, URDF or YAML
    #[arg(required = true)]
    pub files: Vec<String>,
    #[command(flatten)]
    pub options: RobotOptions,
    /// Sweep: run the closed form on so many random targets, and count what is
    /// lost, unsound or doubled
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    pub targets: usize,
    /// Hold so many targets of the sweep against the numerical search
    #[arg(long, value_name = "COUNT", default_value_t = 0, requires = "targets")]
    pub oracle: usize,
    /// Which random targets
    #[arg(long, default_value_t = 1, requires = "targets")]
    pub seed: u64,
    /// Draw the targets of the sweep next to quarter turns of some joints and of their sums, where
    /// many arms are singular
    #[arg(long, requires = "targets")]
    pub aligned: bool,
    /// Show one configuration, its target and all solutions of it beside those of
    /// the numerical search; radians and metres
    #[arg(
        long,
        value_name = "Q1,Q2,..",
        value_delimiter = ',',
        value_parser = number,
        allow_hyphen_values = true,
        conflicts_with = "targets"
    )]
    pub at: Option<Vec<f64>>,
    /// As JSON, for programs
    #[arg(long)]
    pub json: bool,
}

/// Write a page that shows a robot and moves it: one file for a browser, without a network
#[derive(Debug, Args)]
pub struct View {
    /// The robot file, URDF or YAML
    pub file: String,
    #[command(flatten)]
    pub options: RobotOptions,
    /// Where to write the page
    #[arg(short, long, value_name = "HTML")]
    pub output: PathBuf,
}

/// Plot the joints of a robot along a path: all branches, limits, the solution taken, how far it
/// is from singular, and the robot itself
///
/// The path is a straight line of an arm's tip, a drive of a mechanism's actuated joints, or
/// stands in a table.
#[derive(Debug, Args)]
pub struct Plot {
    /// The robot file, URDF or YAML
    pub file: String,
    /// A table with a row for each point: poses as `kin ik` takes them, solutions as it writes
    /// them, or the values of the joints, of a mechanism those of the actuated ones
    #[arg(conflicts_with_all = ["from", "to", "steps"])]
    pub table: Option<PathBuf>,
    #[command(flatten)]
    pub options: RobotOptions,
    /// The configuration at whose pose the line begins, and that the arm is in there; of a
    /// mechanism the values of its actuated joints; radians and metres
    #[arg(
        long,
        value_name = "Q1,Q2,..",
        value_delimiter = ',',
        value_parser = number,
        allow_hyphen_values = true,
        requires = "to"
    )]
    pub from: Vec<f64>,
    /// The configuration at whose pose it ends
    #[arg(
        long,
        value_name = "Q1,Q2,..",
        value_delimiter = ',',
        value_parser = number,
        allow_hyphen_values = true,
        requires = "from"
    )]
    pub to: Vec<f64>,
    /// Steps from one to the other
    #[arg(long, value_name = "COUNT", default_value_t = 400, value_parser = at_least_one)]
    pub steps: usize,
    /// The picture: .svg or .png
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

/// Map the workspace of an arm or a parallel mechanism with a closed form:
/// pictures of three slices, and the numbers
#[derive(Debug, Args)]
pub struct Workspace {
    /// The robot file, URDF or YAML
    pub file: String,
    #[command(flatten)]
    pub options: RobotOptions,
    /// Orientations tried at every point
    #[arg(long, value_name = "COUNT", default_value_t = 40, value_parser = at_least_one)]
    pub samples: usize,
    /// Points along every side of a slice; of an even number none is on an axis through the middle,
    /// where values of spare joints hardly ever lead
    #[arg(long, value_name = "COUNT", default_value_t = 64, value_parser = at_least_one)]
    pub cells: usize,
    /// Only solutions within the joints' limits count
    #[arg(long)]
    pub limits: bool,
    /// The folder that the files are written to
    #[arg(
        short,
        long,
        value_name = "DIR",
        default_value = ".",
        visible_alias = "output"
    )]
    pub out: PathBuf,
}

/// Compute the poses of many joint values: tables in, tables out
#[derive(Debug, Args)]
pub struct Fk {
    /// The robot file, URDF or YAML
    pub file: String,
    /// A table with a column for each joint, by its name, radians and metres; or a folder of such
    /// tables
    pub input: PathBuf,
    #[command(flatten)]
    pub options: RobotOptions,
    #[command(flatten)]
    pub many: Many,
    /// Write poses as the rows of homogeneous matrices, m00 to m23, in place of positions and
    /// quaternions
    #[arg(long)]
    pub matrix: bool,
    /// Write too what `kin ik` is given beside each pose, where the arm has more joints than poses
    /// have coordinates: values of joints, the swivel angle, the turn of the tool [default: with
    /// --free]
    #[arg(long)]
    pub given: bool,
}

/// Compute all solutions to many poses: tables in, tables out
#[derive(Debug, Args)]
pub struct InverseOfMany {
    /// The robot file, URDF or YAML
    pub file: String,
    /// A table of poses, metres: columns x, y, z and qx, qy, qz, qw, or m00 to m23, or r00 to r22
    /// in place of the quaternion; or a folder of such tables
    pub input: PathBuf,
    #[command(flatten)]
    pub options: RobotOptions,
    #[command(flatten)]
    pub many: Many,
    /// What is given beside all poses, where the arm has more joints than these have
    /// coordinates; radians and metres [default: a column for each, by its name]
    #[arg(
        long,
        value_name = "VALUE,..",
        value_delimiter = ',',
        value_parser = number,
        allow_hyphen_values = true
    )]
    pub at: Vec<f64>,
    /// Write only solutions within the joints' limits
    #[arg(long)]
    pub within_limits: bool,
    /// Write a row for a pose without a solution too: branch -1, all else not a number or false
    #[arg(long)]
    pub keep_empty: bool,
}

/// What all commands for many rows are told.
#[derive(Debug, Args)]
pub struct Many {
    /// The table to write, or the folder. It has its name once it is whole; what was
    /// interrupted is gone on with by the same command
    #[arg(short, long, value_name = "PATH")]
    pub output: PathBuf,
    /// How tables are written [default: as the name of the output says, in a folder as the
    /// input]
    #[arg(long, value_enum)]
    pub format: Option<Format>,
    /// Of a folder, take every Nth table from the Kth on: one of N machines
    #[arg(long, value_name = "K/N", default_value = "1/1", value_parser = share)]
    pub share: Share,
    /// Rows that are taken at once, and answered by one row group
    #[arg(long, value_name = "ROWS", default_value_t = 32768, value_parser = 1..=1_000_000)]
    pub batch: i64,
}

fn share(text: &str) -> Result<Share, String> {
    let parts = text.split_once('/');
    let parts = parts.and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    match parts {
        Some((number, of)) if 1 <= number && number <= of => Ok(Share { number, of }),
        _ => Err("two numbers, for example 3/16".into()),
    }
}

/// A number of a list, which may have spaces behind its commas.
fn number(text: &str) -> Result<f64, ParseFloatError> {
    text.trim().parse()
}

fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(count @ 1..=10_000) => Ok(count),
        Ok(_) => Err("between 1 and 10000".into()),
        Err(error) => Err(format!("{error}")),
    }
}

/// What all commands ask of the compiler.
#[derive(Debug, Args)]
pub struct RobotOptions {
    /// The link that the chain begins at [default: the root]
    #[arg(long, value_name = "LINK")]
    pub base: Option<String>,
    /// The link that the chain ends at [default: the end of the joints that
    /// move, fingers left out; see the documentation of kin_codegen::spec]
    #[arg(long, value_name = "LINK")]
    pub tip: Option<String>,
    /// The frame of a tool in that of the tip, whose poses are meant: metres and
    /// radians, as a URDF's <origin> [default: the tip itself]
    #[arg(long, num_args = 6, value_parser = number, allow_hyphen_values = true,
        value_names = ["X", "Y", "Z", "ROLL", "PITCH", "YAW"])]
    pub tool: Option<Vec<f64>>,
    /// Inverse kinematics: closed_form or none
    #[arg(long, value_name = "KIND", default_value_t)]
    pub ik: Ik,
    /// Forward kinematics and Jacobians alone, as --ik none
    #[arg(long, conflicts_with = "ik")]
    pub no_ik: bool,
    /// What of a target counts: pose, position, position_axis, position_yaw,
    /// planar, direction or orientation [default: position where it fixes the
    /// joints of an arm of up to three, otherwise pose]
    #[arg(long, value_parser = kin_codegen::target)]
    pub target: Option<Target>,
    /// A joint whose value inverse kinematics is given, where the arm has more joints
    /// than its targets have coordinates; once for each; or `swivel`, the swivel angle
    /// [default: the swivel angle, or those that give the cheapest closed form]
    #[arg(long, value_name = "JOINT")]
    pub free: Vec<String>,
    /// The type of numbers in generated code: f64 or f32
    #[arg(long, default_value_t)]
    pub scalar: Scalar,
    /// Warnings about the file are errors
    #[arg(long)]
    pub strict: bool,
}

impl RobotOptions {
    /// The compiler's options.
    pub fn options(&self) -> Options {
        Options {
            name: None,
            base: self.base.clone(),
            tip: self.tip.clone(),
            tool: self.tool.as_deref().and_then(|tool| tool.try_into().ok()),
            ik: if self.no_ik { Ik::None } else { self.ik },
            target: self.target,
            free: self.free.clone(),
            scalar: self.scalar,
            strict: self.strict,
            krate: None,
        }
    }
}

/// Reads a robot file; a relative path is relative to where `kin` was started.
pub fn read(file: &str) -> Result<Source, Diagnostics> {
    Source::read(file, Path::new(""))
}
