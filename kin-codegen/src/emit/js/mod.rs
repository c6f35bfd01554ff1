//! JavaScript: a module without dependencies, for browsers and other engines.

mod arm;
mod form;
mod language;
mod mechanism;
mod runtime;
mod text;
mod univariate;

use super::header::Header;
use crate::compiled::Compiled;

/// The module whose default export is the robot.
pub(crate) fn robot(compiled: &Compiled, header: &Header) -> String {
    let comment = text::header(&header.paragraphs, &header.made_by);
    let robot = match compiled {
        Compiled::Arm(arm) => arm::arm(arm),
        Compiled::Mechanism(mechanism) => mechanism::mechanism(mechanism),
    };
    let pieces = runtime::pieces(&robot);
    format!(
        "{comment}\nconst robot = (() => {{\n\"use strict\";\n\n{pieces}\nreturn {robot};\n}})();\n\n\
         export default robot;\n"
    )
}
