//! C99: a header and one file for a robot, which need nothing but `math.h`.

mod declarations;
mod definitions;
mod forward;
mod frames;
mod inverse;
mod lanes;
mod language;
mod name;
mod refused;
mod runtime;
mod text;

pub(crate) use name::prefix;
pub(crate) use refused::refused;

use super::header::Header;
use crate::arm::CompiledArm;
use crate::closed_form::ClosedForm;

/// The two files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Files {
    /// `<name>.h`.
    pub header: String,
    /// `<name>.c`.
    pub source: String,
}

/// The files that an arm becomes, all of whose symbols begin with `prefix`.
pub(crate) fn arm(compiled: &CompiledArm, prefix: &str, told: &Header) -> Files {
    let told = text::header(&told.paragraphs, &told.made_by);
    Files {
        header: format!("{told}\n{}", declarations::all(compiled, prefix)),
        source: format!("{told}\n{}", definitions::all(compiled, prefix)),
    }
}

/// The closed form, where it is written as C.
fn form(compiled: &CompiledArm) -> Option<&ClosedForm> {
    compiled.form().filter(|_| refused(compiled).is_none())
}
