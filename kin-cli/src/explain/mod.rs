//! What was found in a robot file and decided about it, in the field's words.
//!
//! [`explain`] tells everything: the chain, how its axes lie, what was
//! snapped, the plan step by step and its cost. Its [`Explanation`] is
//! displayed as text, and serializes to JSON.

mod chain;
mod command;
mod inverse;
pub mod mechanism;
mod singular;
mod snapping;
mod step;
mod text;

pub use chain::{Chain, Joint, JointMotion, Mimic};
pub(crate) use command::run;
pub use inverse::{Inverse, LaneCost};
pub use singular::{AxesCondition, ConditionKind, Singularities, Singularity};
pub use snapping::{Moved, Snapping};
pub use step::{Object, ObjectKind, Step};

use kin_codegen::expr::Operations;
use kin_codegen::geometry::Axes;
use kin_codegen::{Compiled, Diagnostics, Ik, Options, Source, compile};
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
    pub fk: Operations,
    /// What forward kinematics with the spatial Jacobian takes.
    pub fk_jacobian: Operations,
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
/// use kin_cli::explain::explain;
/// use kin_codegen::{Options, Source};
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
        fk: forward.tip_cost(),
        fk_jacobian: forward.tip_and_jacobian_cost(),
        singularities: singular
            .as_ref()
            .map(|singular| Singularities::of(model, singular)),
        inverse: attempt.compiled.inverse.as_ref().map(Inverse::of),
        refusal: attempt.refusal,
    })
}

/// A compiled arm; without inverse kinematics if there is no closed form.
pub(crate) struct Attempt {
    pub compiled: Compiled,
    pub refusal: Option<String>,
}

impl Attempt {
    /// # Errors
    ///
    /// Not even forward kinematics can be compiled.
    pub fn new(source: &Source, options: &Options) -> Result<Self, Diagnostics> {
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

/// The last part of a path, on any system.
fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
