//! Inverse kinematics that is not written in another language: it calls what of the runtime is
//! large.

use crate::arm::CompiledArm;
use crate::closed_form::{Inverse, Refinement};
use crate::mechanism::{CompiledMechanism, LegForm};
use crate::spec::Diagnostic;

/// Why the inverse kinematics of an arm is left out of another language, if it has any and it is;
/// of one that has the search for the roots of a polynomial in one joint, or does without.
pub fn refused(compiled: &CompiledArm, language: &str, has_search: bool) -> Option<Diagnostic> {
    let form = compiled.form()?;
    let in_rust = format!(
        "generate Rust, which has it; `--ik none` says that {language} without it is meant"
    );
    let (reason, remedy) = match (&form.inverse, &form.refinement) {
        (Inverse::Univariate(arm), _) | (_, Refinement::Univariate(arm)) if has_search => {
            if arm.between.is_empty() {
                return None;
            }
            (
                format!(
                    "joints between those that are solved for are given, and their elimination at \
                     the values of these is not written as {language}"
                ),
                format!("let joints at the ends of the chain stay free, or {in_rust}"),
            )
        }
        (Inverse::Univariate(_), _) => (
            format!(
                "the arm has no closed form, and the polynomial in one joint that solves it, {}, \
                 is not written as {language}",
                form.plan
            ),
            in_rust,
        ),
        _ if !form.is_exact() => (
            format!(
                "the closed form is that of an arm whose tip is up to {:.1e} m from that of the \
                 file, and the refinement of its solutions is not written as {language}",
                form.tip_shift
            ),
            format!(
                "write the relations between the axes exactly, as `kin explain` has them, or {in_rust}"
            ),
        ),
        (_, Refinement::Univariate(_)) => (
            format!(
                "a step of the closed form degenerates where the arm does not, and the \
                 elimination that finds the solutions there is not written as {language}"
            ),
            in_rust,
        ),
        _ => return None,
    };
    let reason = format!("no inverse kinematics in {language}: {reason}");
    Some(Diagnostic::whole(reason, remedy).warning())
}

/// The same of a mechanism: why that of one of its chains is.
pub fn of_mechanism(
    compiled: &CompiledMechanism,
    language: &str,
    has_search: bool,
) -> Option<Diagnostic> {
    let legs = compiled.inverse.iter().flat_map(|inverse| &inverse.legs);
    let arms = legs.flat_map(|leg| match leg {
        LegForm::Whole(whole) => vec![&**whole],
        LegForm::Split(split) => vec![&split.head, &split.tail],
    });
    let mut reasons = arms.filter_map(|arm| refused(arm, language, has_search));
    reasons.next()
}
