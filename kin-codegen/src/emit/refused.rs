//! Inverse kinematics that is not written in another language.

use crate::arm::CompiledArm;
use crate::mechanism::{CompiledMechanism, LegForm};
use crate::spec::Diagnostic;

/// Why the inverse kinematics of an arm is left out of another language, if it has any and it is.
pub fn refused(compiled: &CompiledArm, language: &str) -> Option<Diagnostic> {
    let form = compiled.form()?;
    if form.elimination().is_some() || form.is_exact() {
        return None;
    }
    let reason = format!(
        "no inverse kinematics in {language}: the closed form is that of an arm whose tip is up to \
         {:.1e} m from that of the file, and the refinement of its solutions is not written as \
         {language}",
        form.tip_shift
    );
    let remedy = format!(
        "write the relations between the axes exactly, as `kin explain` has them, or generate Rust, \
         which has it; `--ik none` says that {language} without it is meant"
    );
    Some(Diagnostic::whole(reason, remedy).warning())
}

/// The same of a mechanism: why that of one of its chains is.
pub fn of_mechanism(compiled: &CompiledMechanism, language: &str) -> Option<Diagnostic> {
    let legs = compiled.inverse.iter().flat_map(|inverse| &inverse.legs);
    let arms = legs.flat_map(|leg| match leg {
        LegForm::Whole(whole) => vec![&**whole],
        LegForm::Split(split) => vec![&split.head, &split.tail],
    });
    let mut reasons = arms.filter_map(|arm| refused(arm, language));
    reasons.next()
}
