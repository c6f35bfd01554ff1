//! C99: a header and one file for a robot, which need nothing but `math.h`.

mod called;
mod declarations;
mod definitions;
mod forward;
mod frames;
mod inverse;
mod lanes;
mod language;
mod mechanism;
mod name;
mod runtime;
mod tables;
mod text;
mod univariate;

pub(crate) use name::prefix;

use super::header::Header;
use crate::arm::CompiledArm;
use crate::mechanism::CompiledMechanism;

/// The two files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Files {
    /// `<name>.h`.
    pub header: String,
    /// `<name>.c`.
    pub source: String,
}

/// The files that an arm becomes, all of whose symbols begin with `prefix`.
pub(crate) fn arm(compiled: &CompiledArm, prefix: &str, header: &Header) -> Files {
    let comment = text::header(&header.paragraphs, &header.made_by);
    Files {
        header: format!("{comment}\n{}", declarations::all(compiled, prefix)),
        source: format!("{comment}\n{}", definitions::all(compiled, prefix)),
    }
}

/// The files that a mechanism becomes.
pub(crate) fn mechanism(compiled: &CompiledMechanism, prefix: &str, header: &Header) -> Files {
    let comment = text::header(&header.paragraphs, &header.made_by);
    Files {
        header: format!("{comment}\n{}", mechanism::declarations(compiled, prefix)),
        source: format!("{comment}\n{}", mechanism::definitions(compiled, prefix)),
    }
}
