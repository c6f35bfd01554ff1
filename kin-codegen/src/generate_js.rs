//! Robot file in, JavaScript out.

use crate::compile::compile;
use crate::compiled::Compiled;
use crate::emit::{header, js};
use crate::error::Error;
use crate::hash::fnv1a;
use crate::options::Options;
use crate::scalar::Scalar;
use crate::spec::{Diagnostic, Diagnostics, Source, stem};

/// The generated robot as JavaScript.
#[derive(Clone, Debug)]
pub struct GeneratedJs {
    /// The text of a module, ECMAScript 2020, whose default export is the robot. It may stand in
    /// a `<script type="module">` of a page: no name of the file ends it.
    pub source: String,
    /// What it was generated from.
    pub robot: Compiled,
    /// What the file has that is odd, and what of the robot is not written as JavaScript.
    pub warnings: Vec<Diagnostic>,
}

/// Compiles a robot file to JavaScript: of an arm the functions `fk`, `fk_links`, `fk_frame`,
/// `spatial_jacobian`, `body_jacobian`, `geometric_jacobian`, `within_limits` and `approach`, and of
/// one that is solved by a closed form or an elimination `ik`, `ik_seeded` and `ik_nearest`, or where it
/// has parameters `ik_at`, `ik_seeded_at`, `ik_nearest_at` and `redundancy`; of a parallel mechanism
/// `fk`, `gap`, `close` and `ik`. Joint values are in radians and metres, poses are twelve numbers,
/// three rows of `[R | p]`, Jacobians six rows (v, ω).
///
/// ```
/// use kin_codegen::{Options, Source, generate_js};
/// let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
/// let generated = generate_js(&Source::read("robots/ur5e.urdf", root)?, &Options::default())?;
/// assert!(generated.source.ends_with("export default robot;\n"));
/// # Ok::<(), kin_codegen::Error>(())
/// ```
///
/// # Errors
///
/// What is wrong with the file or the options, or why the robot has no closed form. With the
/// option `strict`, what would be a warning.
pub fn generate_js(source: &Source, options: &Options) -> Result<GeneratedJs, Error> {
    let refused = |option: &str| {
        let reason = format!("the option `{option}` has no meaning in JavaScript");
        let diagnostic = Diagnostic::whole(reason, "leave it out");
        Err(Diagnostics::one(&source.path, diagnostic).into())
    };
    if options.krate.is_some() {
        return refused("crate");
    }
    if options.scalar != Scalar::default() {
        return refused("scalar");
    }
    if options.name.is_some() {
        return refused("name");
    }
    let generated = GeneratedJs::of(compile(source, options)?, source, options);
    if options.strict
        && let Some(warnings) = Diagnostics::of(&source.path, generated.warnings.clone())
    {
        return Err(warnings.into_errors().into());
    }
    Ok(generated)
}

impl GeneratedJs {
    /// A robot as JavaScript that was compiled from a file with some options.
    #[doc(hidden)]
    pub fn of(robot: Compiled, source: &Source, options: &Options) -> Self {
        let warnings = robot.warnings().to_vec();
        let hash = fnv1a(source.text.as_bytes());
        let name = stem(&source.path);
        let header = header::of(&robot, name, hash, options, Some(" --lang js"));
        Self {
            source: js::robot(&robot, &header),
            warnings,
            robot,
        }
    }
}
