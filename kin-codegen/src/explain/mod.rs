//! What was found in a robot file and decided about it, in the field's words.
//!
//! [`explain`] tells everything: the chain, how its axes lie, what was
//! snapped, the plan step by step and its cost. Its [`Explanation`] is
//! displayed as text, and serializes to JSON. [`check`] gives the short
//! verdict.

mod axes;
mod chain;
mod check;
mod cost;
mod inverse;
mod singular;
mod snapping;
mod step;
mod summary;
mod text;

pub use axes::{Axes, Neighbours, PairRelation, Row, RowRelation};
pub use chain::{Chain, Joint, JointMotion, Mimic};
pub use check::{Check, Completeness, Verdict, check};
pub use cost::Cost;
pub use inverse::{Inverse, LaneCost};
pub use singular::{AxesCondition, ConditionKind, Singularities, Singularity};
pub use snapping::{Moved, Snapping};
pub use step::{Object, ObjectKind, Step};
pub(crate) use summary::{structure, summary};

use crate::compiler::{Compiled, compile};
use crate::options::{Ik, Options, file_name};
use crate::spec::{Diagnostics, Source};
use serde::Serialize;

/// The version of the JSON that [`Explanation`] serializes to. Grows when a
/// field changes its meaning or goes; new fields may come without.
pub const SCHEMA: u32 = 1;

/// All that there is to tell about a robot file.
///
/// Lengths are metres, angles radians, coordinates those of the base link with
/// the arm at home. Joints are numbered from 1, as in q₁, and a step's unknown
/// may be a sum of them (`q2+q3+q4`).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// [`SCHEMA`].
    pub schema: u32,
    /// The robot file's name.
    pub file: String,
    /// The robot's name, from the file.
    pub robot: String,
    /// The chain.
    pub chain: Chain,
    /// How its axes lie to each other.
    pub axes: Axes,
    /// What forward kinematics takes.
    pub fk: Cost,
    /// What forward kinematics with the spatial Jacobian takes.
    pub fk_jacobian: Cost,
    /// The singular configurations; none if no rows of the Jacobian are square.
    pub singularities: Option<Singularities>,
    /// The closed form; none if it was not asked for, or is refused.
    pub inverse: Option<Inverse>,
    /// Why there is no closed form, if one was asked for.
    pub refusal: Option<String>,
}

/// Explains a robot file. An arm without a closed form is explained too.
///
/// ```
/// use kin_codegen::{Options, Source, explain::explain};
/// let text = "
/// robot: planar
/// units: {angle: rad, length: m}
/// screws:
///   - {name: shoulder, axis: [0, 0, 1], point: [0, 0, 0]}
///   - {name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}
/// home: {xyz: [0.9, 0, 0]}
/// ";
/// let source = Source { path: "planar.yaml".into(), text: text.into() };
/// let explanation = explain(&source, &Options::default())?;
/// let inverse = explanation.inverse.as_ref().unwrap();
/// assert_eq!((inverse.plan.as_str(), inverse.branches), ("SP3(q2) SP1(q1)", 2));
/// assert!(explanation.to_string().contains("1, 2 parallel"));
/// # Ok::<(), kin_codegen::Diagnostics>(())
/// ```
///
/// # Errors
///
/// What is wrong with the file or the options.
pub fn explain(source: &Source, options: &Options) -> Result<Explanation, Diagnostics> {
    let attempt = Attempt::new(source, options)?;
    let Compiled {
        model,
        forward,
        singular,
        ..
    } = &attempt.compiled;
    Ok(Explanation {
        schema: SCHEMA,
        file: file_name(&source.path).to_owned(),
        robot: model.name.clone(),
        chain: Chain::of(model),
        axes: Axes::of(model),
        fk: forward.tip_cost().into(),
        fk_jacobian: forward.tip_and_jacobian_cost().into(),
        singularities: singular
            .as_ref()
            .map(|singular| Singularities::of(model, singular)),
        inverse: attempt.compiled.inverse.as_ref().map(Inverse::of),
        refusal: attempt.refusal,
    })
}

/// A compiled arm; without inverse kinematics if there is no closed form.
struct Attempt {
    compiled: Compiled,
    refusal: Option<String>,
}

impl Attempt {
    /// # Errors
    ///
    /// Not even forward kinematics can be compiled.
    fn new(source: &Source, options: &Options) -> Result<Self, Diagnostics> {
        let forward_alone = || {
            let options = Options {
                ik: Ik::None,
                ..options.clone()
            };
            compile(source, &options)
        };
        match compile(source, options) {
            Ok(compiled) => Ok(Self {
                compiled,
                refusal: None,
            }),
            Err(refused) => Ok(Self {
                compiled: forward_alone()?,
                refusal: refused.list.into_iter().next().map(|first| first.reason),
            }),
        }
    }
}
