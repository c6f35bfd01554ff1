//! The YAML robot format.
use super::{Diagnostics, Source, Spec};
pub(super) fn parse(source: &Source) -> Result<Spec, Diagnostics> {
    let _ = source;
    todo!()
}
