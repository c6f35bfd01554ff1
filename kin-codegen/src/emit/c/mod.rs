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
pub(crate) fn arm(compiled: &CompiledArm, prefix: &str, told: &Header) -> Files {
    let told = text::header(&told.paragraphs, &told.made_by);
    Files {
        header: format!("{told}\n{}", declarations::all(compiled, prefix)),
        source: format!("{told}\n{}", definitions::all(compiled, prefix)),
    }
}

/// The files that a mechanism becomes.
pub(crate) fn mechanism(compiled: &CompiledMechanism, prefix: &str, told: &Header) -> Files {
    let told = text::header(&told.paragraphs, &told.made_by);
    Files {
        header: format!("{told}\n{}", mechanism::declarations(compiled, prefix)),
        source: format!("{told}\n{}", mechanism::definitions(compiled, prefix)),
    }
}
