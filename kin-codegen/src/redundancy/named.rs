//! The option `free`: joints by name, or the swivel.

use super::{Asked, coordinates};
use crate::geometry::{Swivel, structure};
use crate::model::Model;
use crate::plan::Target;
use crate::spec::{ArmSpec, Diagnostic, Diagnostics, JointType, did_you_mean};

/// What the option `free` calls the swivel angle, where no joint has this name.
pub const SWIVEL: &str = "swivel";
/// Axes of a shoulder or wrist meet to this, in radians and of the arm's size.
const MEETING: f64 = 1e-3;

/// The joints that the option `free` names, or the swivel.
///
/// # Errors
///
/// What is wrong with a name, or with how many there are.
pub fn named(
    spec: &ArmSpec,
    model: &Model,
    target: Target,
    names: &[String],
) -> Result<Asked, Diagnostics> {
    let mut joints = Vec::new();
    let mut swivel = None;
    let fail = |reason: String, remedy: String| {
        Diagnostics::one(&spec.source.path, Diagnostic::whole(reason, remedy))
    };
    for name in names {
        let is_joint = spec.joints.iter().any(|joint| joint.name == *name);
        if name == SWIVEL && !is_joint {
            let found = Swivel::of(model, MEETING)
                .ok_or_else(|| fail(no_swivel(model), NO_SWIVEL.into()))?;
            swivel = Some(found);
            continue;
        }
        let joint =
            named_one(spec, model, name).map_err(|(reason, remedy)| fail(reason, remedy))?;
        if joints.contains(&joint) {
            let reason = format!("the option `free` names the joint `{name}` twice");
            return Err(fail(reason, "name every joint once".into()));
        }
        joints.push(joint);
    }
    let (n, coordinates) = (model.variables.len(), coordinates(model, target));
    let most = n.saturating_sub(coordinates);
    let count = joints.len() + usize::from(swivel.is_some());
    if count > most {
        let of = match coordinates == target.coordinates() {
            true => format!("coordinates of {}", target.phrase()),
            false if target == Target::Pose => "independent ways in which they move the tip".into(),
            false => format!("independent ways in which they change {}", target.phrase()),
        };
        let reason = format!(
            "the option `free` names {}, and {n} joints have {most} more than the {coordinates} {of}",
            counted(count),
        );
        let remedy = match most {
            0 => "leave out `free`, or choose a `target` of fewer coordinates".into(),
            _ => format!("name {} at most", counted(most)),
        };
        return Err(fail(reason, remedy));
    }
    joints.sort_unstable();
    Ok(Asked { joints, swivel })
}

/// What to do without a swivel angle.
const NO_SWIVEL: &str = "name a joint in `free`, or leave it out";

/// Why an arm has no swivel angle.
fn no_swivel(model: &Model) -> String {
    format!(
        "a swivel angle is that of seven joints that turn, of which the first three and the last \
         three meet in a point each; from `{}` to `{}` this is {}",
        model.base,
        model.tip,
        structure(model)
    )
}

fn counted(joints: usize) -> String {
    match joints {
        1 => "1 joint".into(),
        n => format!("{n} joints"),
    }
}

/// The place of a joint in the chain, or what is wrong with it and what to do.
fn named_one(spec: &ArmSpec, model: &Model, name: &str) -> Result<usize, (String, String)> {
    let known: Vec<&str> = model
        .joints
        .iter()
        .map(|joint| joint.name.as_str())
        .collect();
    if let Some(place) = model.joints.iter().position(|joint| joint.name == name) {
        let variable = &model.variables[model.joints[place].variable].name;
        if variable != name {
            let reason = format!("the joint `{name}` mimics `{variable}`, and cannot stay free");
            return Err((reason, "name a joint that mimics none in `free`".into()));
        }
        return Ok(model.joints[place].variable);
    }
    let (base, tip) = (&model.base, &model.tip);
    let reason = match spec.joints.iter().find(|joint| joint.name == name) {
        Some(joint) if joint.kind == JointType::Fixed => {
            format!("the joint `{name}` is fixed, and cannot stay free")
        }
        Some(_) => format!("the joint `{name}` is not between `{base}` and `{tip}`"),
        None => format!("there is no joint `{name}` to stay free"),
    };
    let listed: Vec<&str> = name.split(',').map(str::trim).collect();
    let remedy = match name {
        _ if listed.len() > 1 && listed.iter().all(|part| known.contains(part)) => {
            format!("name each by itself: `free = {listed:?}`, or `--free` once for each")
        }
        "turn" => "leave it out: with `target = position_axis` the turn of the tool is given \
                   unless `free` names a joint in its place"
            .into(),
        _ => did_you_mean(name, &known),
    };
    Err((reason, remedy))
}
