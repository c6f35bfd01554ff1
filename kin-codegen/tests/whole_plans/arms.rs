//! The arms of the project that have a closed form, and their mirror images.

use kin_codegen::geometry::{Linkage, natural_target};
use kin_codegen::model::Model;
use kin_codegen::plan::Target;
use kin_codegen::solver::{NoClosedForm, solve};
use kin_codegen::spec::{ArmSpec, Source, Spec};
use std::path::Path;

/// An arm, and what of a target it is to meet.
pub struct Arm {
    pub name: String,
    pub model: Model,
    pub target: Target,
}

/// Files, folder by folder. Each arm comes with its natural target and its
/// mirror image; `tests/robots/targets` has those of other targets.
const FOLDERS: [&str; 4] = [
    "robots",
    "tests/robots/table",
    "tests/robots/noisy",
    "tests/robots/targets",
];

pub fn every_arm() -> Vec<Arm> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files: Vec<_> = FOLDERS
        .iter()
        .flat_map(|folder| std::fs::read_dir(root.join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.extension()
                .is_some_and(|end| end == "yaml" || end == "urdf")
        })
        .collect();
    files.sort();
    files
        .iter()
        .filter_map(|path| arm(path))
        .flatten()
        .collect()
}

/// The arm of a file, and its mirror image; none of a mechanism.
fn arm(path: &Path) -> Option<Vec<Arm>> {
    let source = Source {
        path: path.display().to_string(),
        text: std::fs::read_to_string(path).unwrap(),
    };
    let spec: ArmSpec = match Spec::parse(&source).unwrap() {
        Spec::Arm(arm) => arm,
        Spec::Mechanism(_) => return None,
    };
    let model = Model::new(&spec, None, None).unwrap();
    let target = natural_target(&model);
    let mut arms = vec![Arm {
        name: spec.name.clone(),
        model: model.clone(),
        target,
    }];
    if target == Target::Pose {
        arms.push(Arm {
            name: format!("{}, mirrored", spec.name),
            model: mirrored(&model),
            target,
        });
    }
    arms.retain(has_closed_form);
    Some(arms)
}

/// Whether subproblems solve it, or a refusal is not the plan search's: what fails
/// otherwise fails the test.
fn has_closed_form(arm: &Arm) -> bool {
    match solve(&arm.model, &Linkage::new(&arm.model), arm.target) {
        Ok(solved) => solved.form.expressions().is_some(),
        Err(reason) => !matches!(reason, NoClosedForm::NoPlan(_) | NoClosedForm::Redundant(_)),
    }
}

/// The arm from its tip to its base: e^(ξ̂ₙ′ qₙ) … e^(ξ̂₁′ q₁) g(0)⁻¹ is the
/// inverse of its forward kinematics at −q.
fn mirrored(model: &Model) -> Model {
    let back = model.home.inverse();
    let mut mirrored = model.clone();
    mirrored.joints.reverse();
    mirrored.variables.reverse();
    for (i, joint) in mirrored.joints.iter_mut().enumerate() {
        joint.variable = i;
        joint.axis = back.rotate(joint.axis);
        joint.point = back.transform_point(joint.point);
        joint.frame = back * joint.frame;
    }
    mirrored.home = back;
    mirrored
}
