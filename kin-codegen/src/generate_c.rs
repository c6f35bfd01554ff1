//! Robot file in, C out.

use crate::compile::compile;
use crate::compiled::Compiled;
use crate::emit::c::{self, Files};
use crate::emit::header;
use crate::error::Error;
use crate::hash::fnv1a;
use crate::options::Options;
use crate::scalar::Scalar;
use crate::spec::{Diagnostic, Diagnostics, Source};

/// The generated robot as C99.
#[derive(Clone, Debug)]
pub struct GeneratedC {
    /// What its symbols begin with, and its files are called.
    pub name: String,
    /// The text of `<name>.h`.
    pub header: String,
    /// The text of `<name>.c`, which needs nothing but that header and `math.h`.
    pub source: String,
    /// What it was generated from.
    pub robot: Compiled,
    /// What the file has that is odd, and what of the robot is not written as C.
    pub warnings: Vec<Diagnostic>,
}

/// Compiles a robot file to C99 that compiles as C++ as well: forward kinematics, Jacobians, and
/// inverse kinematics, by closed forms or a polynomial in one joint. Of an arm off its design whose
/// branches are refined without such a polynomial, for targets that are not whole poses or with
/// joints given beside them, the C has no inverse kinematics, and a warning says why. A parallel
/// mechanism has the same functions as in Rust, and its chains are arms beside it. The option `name`
/// is what all symbols begin with, by default the file's stem in lower case.
///
/// ```
/// use kin_codegen::{Options, Source, generate_c};
/// let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
/// let generated = generate_c(&Source::read("robots/ur5e.urdf", root)?, &Options::default())?;
/// assert_eq!(generated.name, "ur5e");
/// assert!(generated.header.contains("void ur5e_fk(const double q[UR5E_JOINTS], double pose[12]);"));
/// # Ok::<(), kin_codegen::Error>(())
/// ```
///
/// # Errors
///
/// What is wrong with the file or the options, or why the robot has no closed form. With the option
/// `strict`, what would be a warning.
pub fn generate_c(source: &Source, options: &Options) -> Result<GeneratedC, Error> {
    let refused = |diagnostic| Diagnostics::one(&source.path, diagnostic);
    let name = c::prefix(options, &source.path).map_err(refused)?;
    if options.krate.is_some() {
        let reason = "C does not depend on the crate `kinematics`";
        let diagnostic = Diagnostic::whole(reason, "leave out the option `crate`");
        return Err(refused(diagnostic).into());
    }
    if options.scalar != Scalar::default() {
        let reason = "C is written in double precision alone";
        let diagnostic =
            Diagnostic::whole(reason, "leave out the option `scalar`, or generate Rust");
        return Err(refused(diagnostic).into());
    }
    let generated = GeneratedC::of(compile(source, options)?, name, source, options);
    if options.strict
        && let Some(warnings) = Diagnostics::of(&source.path, generated.warnings.clone())
    {
        return Err(warnings.into_errors().into());
    }
    Ok(generated)
}

impl GeneratedC {
    /// A robot as C that was compiled from a file with some options.
    #[doc(hidden)]
    pub fn of(robot: Compiled, name: String, source: &Source, options: &Options) -> Self {
        let warnings = robot.warnings().to_vec();
        let hash = fnv1a(source.text.as_bytes());
        let header = header::of(&robot, &name, hash, options, Some(" --lang c -o ."));
        let Files { header, source } = match &robot {
            Compiled::Arm(arm) => c::arm(arm, &name, &header),
            Compiled::Mechanism(mechanism) => c::mechanism(mechanism, &name, &header),
        };
        Self {
            name,
            header,
            source,
            robot,
            warnings,
        }
    }
}
