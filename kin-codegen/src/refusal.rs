//! Why an arm is refused, and what its owner can do.

use crate::geometry::structure;
use crate::model::Model;
use crate::plan::Target;
use crate::solver::NoClosedForm;
use crate::spec::{Diagnostic, Diagnostics, Source};
use crate::verify::rank;

/// Refuses a chain whose joints are never independent.
///
/// # Errors
///
/// The joints that move the tip no more than the others do.
pub fn singular_everywhere(source: &Source, model: &Model) -> Result<(), Diagnostics> {
    let n = model.variables.len();
    if n > 6 || model.is_coupled() {
        return Ok(());
    }
    let rank = rank(model);
    if rank == n {
        return Ok(());
    }
    let reason = format!(
        "the {n} joints from `{}` to `{}` move the tip in {rank} independent ways at most: the \
         chain is singular in every configuration{}",
        model.base,
        model.tip,
        coaxial(model).map_or_else(String::new, |pair| format!(
            "; joints `{}` and `{}` turn about one line",
            pair[0], pair[1]
        )),
    );
    let remedy = "check axes and origins; a joint that repeats another must be fixed, or left \
                  out of the chain by another base or tip";
    Err(whole(source, reason, remedy.into()))
}

/// Two neighbours on one axis.
fn coaxial(model: &Model) -> Option<[String; 2]> {
    use crate::geometry::{AxisRelation, axes, relate};
    let axes = axes(model);
    let coincide =
        |i: &usize| relate(&axes[*i], &axes[i + 1], 1e-6, 1e-9) == AxisRelation::Coincident;
    let i = (0..axes.len().saturating_sub(1)).find(coincide)?;
    Some([
        model.joints[i].name.clone(),
        model.joints[i + 1].name.clone(),
    ])
}

/// The complaint about an arm without a closed form.
pub fn no_closed_form(
    source: &Source,
    model: &Model,
    target: Target,
    reason: &NoClosedForm,
) -> Diagnostics {
    let n = model.joints.len();
    let remedy = "`ik = none` generates forward kinematics and Jacobians alone";
    let why = match reason {
        NoClosedForm::Mimic => "some joints mimic others, which couples their angles".to_owned(),
        NoClosedForm::Redundant(target) => format!(
            "{n} joints reach {} in infinitely many ways, and no joint was chosen to stay free",
            target.phrase()
        ),
        NoClosedForm::Noisy => "its axes are off exact relations by the noise of the file, and a \
                                projected target (position_yaw, planar) needs them exact"
            .to_owned(),
        NoClosedForm::NoPlan => format!(
            "no sequence of the subproblems SP1 to SP6 solves the chain{}: {}",
            aimed_at(target),
            structure(model)
        ),
        NoClosedForm::Uncertified { plan, failure } => {
            format!("the best plan, {plan}, failed its verification: {failure}")
        }
    };
    let reason = format!(
        "no closed-form inverse kinematics for the {n} joints from `{}` to `{}`: {why}",
        model.base, model.tip
    );
    whole(source, reason, remedy.into())
}

/// What targets are, unless they are whole poses.
fn aimed_at(target: Target) -> String {
    match target {
        Target::Pose => String::new(),
        other => format!(" for {}", other.phrase()),
    }
}

fn whole(source: &Source, reason: String, remedy: String) -> Diagnostics {
    let diagnostic = Diagnostic {
        at: None,
        line: String::new(),
        reason,
        remedy,
    };
    Diagnostics {
        path: source.path.clone(),
        list: vec![diagnostic],
    }
}
