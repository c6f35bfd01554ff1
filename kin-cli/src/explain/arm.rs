//! What there is to tell about an arm.

use super::{Chain, Inverse, SCHEMA, Singularities, Warning};
use kin_codegen::arm::CompiledArm;
use kin_codegen::expr::Operations;
use kin_codegen::geometry::Axes;
use kin_codegen::spec::Diagnostic;
use serde::Serialize;

/// All that there is to tell about the file of an arm.
///
/// Lengths are metres, angles radians, coordinates those of the base link with
/// the arm at home. Joints are numbered from 1, as in q₁, and a step's unknown
/// may be a sum of them (`q2+q3+q4`).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ArmExplanation {
    /// [`SCHEMA`].
    pub schema: u32,
    /// The robot file's name.
    pub file: String,
    /// The robot's name, from the file.
    pub robot: String,
    /// What is odd in the file.
    pub warnings: Vec<Warning>,
    /// The chain.
    pub chain: Chain,
    /// How its axes lie to each other.
    pub axes: Axes,
    /// What forward kinematics takes.
    pub fk: Operations,
    /// What forward kinematics with the spatial Jacobian takes.
    pub fk_jacobian: Operations,
    /// The singular configurations; none if no rows of the Jacobian are square.
    pub singularities: Option<Singularities>,
    /// The closed form; none if it was not asked for, or is refused.
    pub inverse: Option<Inverse>,
    /// Why there is no closed form, if one was asked for.
    pub refusal: Option<String>,
    /// What to do about that.
    pub remedy: Option<String>,
}

impl ArmExplanation {
    pub(super) fn of(arm: &CompiledArm, refusal: Option<Diagnostic>) -> Self {
        let (model, forward) = (&arm.model, arm.forward());
        let singular = arm.singular();
        Self {
            schema: SCHEMA,
            file: arm.file.clone(),
            robot: model.name.clone(),
            warnings: Warning::all(&model.warnings),
            chain: Chain::of(model),
            axes: Axes::of(model),
            fk: forward.tip_cost(),
            fk_jacobian: forward.tip_and_jacobian_cost(),
            singularities: singular.map(|singular| Singularities::of(model, singular)),
            inverse: arm.inverse.as_ref().map(|found| Inverse::of(arm, found)),
            refusal: refusal.as_ref().map(|it| it.reason.clone()),
            remedy: refusal.map(|it| it.remedy),
        }
    }
}
