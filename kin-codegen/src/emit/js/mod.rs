//! JavaScript: a module without dependencies, for browsers and other engines.

mod arm;
mod form;
mod language;
mod mechanism;
mod runtime;
mod text;
mod univariate;

use super::header::Header;
use super::refused;
use crate::compiled::Compiled;
use crate::spec::Diagnostic;

/// The module whose default export is the robot.
pub(crate) fn robot(compiled: &Compiled, told: &Header) -> String {
    let header = text::header(&told.paragraphs, &told.made_by);
    let robot = match compiled {
        Compiled::Arm(arm) => arm::arm(arm),
        Compiled::Mechanism(mechanism) => mechanism::mechanism(mechanism),
    };
    let pieces = runtime::pieces(&robot);
    format!(
        "{header}\nconst robot = (() => {{\n\"use strict\";\n\n{pieces}\nreturn {robot};\n}})();\n\n\
         export default robot;\n"
    )
}

/// Why the inverse kinematics of a robot is left out of its JavaScript, if it has any and it is.
pub(crate) fn refused(compiled: &Compiled) -> Option<Diagnostic> {
    match compiled {
        Compiled::Arm(arm) => refused::refused(arm, "JavaScript"),
        Compiled::Mechanism(mechanism) => mechanism::why_not(mechanism),
    }
}
