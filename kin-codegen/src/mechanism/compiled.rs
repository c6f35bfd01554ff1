//! The whole way from a file to verified expressions.

use super::forward::Forward;
use super::freedom::{Freedom, refuse};
use super::inverse::{Aim, Inverse, LegForm, Reason};
use super::model::{Leg, Mechanism};
use crate::compiler;
use crate::options::{Ik, Options};
use crate::plan::Target;
use crate::refusal;
use crate::spec::{Diagnostic, Diagnostics, MechanismSpec, Source};
use kin_runtime::Pose;

/// A mechanism, compiled but not yet written as Rust.
#[derive(Clone, Debug)]
pub struct CompiledMechanism {
    /// The robot file, as the user named it.
    pub path: String,
    /// The chains.
    pub mechanism: Mechanism,
    /// How it can move.
    pub freedom: Freedom,
    /// The chains as arms; those that are solved as one have their closed form.
    pub legs: Vec<compiler::Compiled>,
    /// Inverse kinematics; none if it was not asked for.
    pub inverse: Option<Inverse>,
    /// Forward kinematics.
    pub forward: Forward,
}

/// A pose of the platform, and how each chain gets there.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// In base coordinates, metres.
    pub pose: Pose,
    /// The answers of each chain, at least one: joint values in radians and
    /// metres. Any answer of one goes with any of the others.
    pub answers: Vec<Vec<Vec<f64>>>,
}

impl CompiledMechanism {
    /// What the generated inverse kinematics will answer, computed by the
    /// interpreter: the poses that a target stands for (see [`Aim`]) and all
    /// chains reach. There are several only where a chain leads. Empty if the
    /// target is out of reach, or there is no inverse kinematics.
    ///
    /// ```
    /// use kin_codegen::{Options, Source, mechanism::compile};
    /// let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    /// let source = Source::read("robots/stewart.yaml", root)?;
    /// let stewart = compile(&source, &Options::default())?;
    /// let placed = stewart.answers(&stewart.mechanism.home());
    /// assert!(placed[0].answers[5].iter().any(|q| q.iter().all(|x| x.abs() < 1e-9)));
    /// # Ok::<(), kin_codegen::Diagnostics>(())
    /// ```
    pub fn answers(&self, target: &Pose) -> Vec<Placed> {
        let Some(inverse) = &self.inverse else {
            return Vec::new();
        };
        let poses = match inverse.aim {
            Aim::Pose => vec![*target],
            Aim::Translation => vec![Pose {
                translation: target.translation,
                ..self.mechanism.home()
            }],
            Aim::Lead(lead) => {
                let chain = self.mechanism.legs[lead].chain();
                let answers = inverse.legs[lead].answers(target);
                answers.iter().map(|q| chain.fk(q)).collect()
            }
        };
        let placed = |pose: Pose| {
            let reached = |leg: &LegForm| Some(leg.answers(&pose)).filter(|q| !q.is_empty());
            let answers = inverse.legs.iter().map(reached).collect::<Option<_>>()?;
            Some(Placed { pose, answers })
        };
        poses.into_iter().filter_map(placed).collect()
    }
}

/// Reads a mechanism's file and compiles it.
///
/// # Errors
///
/// What is wrong with the file, the mechanism or the options, or why one of its
/// chains has no closed form.
pub fn compile(source: &Source, options: &Options) -> Result<CompiledMechanism, Diagnostics> {
    refuse_options(source, options)?;
    let (base, platform) = (options.base.as_deref(), options.tip.as_deref());
    let mechanism = Mechanism::new(&MechanismSpec::parse(source, base, platform)?)?;
    let freedom = Freedom::of(&mechanism);
    freedom.check(&mechanism, source)?;
    let inverse = match options.ik {
        Ik::None => None,
        Ik::ClosedForm => Some(
            Inverse::find(&mechanism, &freedom, &source.path)
                .map_err(|(leg, reason)| no_closed_form(&mechanism, source, &leg, &reason))?,
        ),
    };
    let forward = Forward::find(&mechanism, &freedom, inverse.as_ref(), &source.path);
    let leg = |(k, leg): (usize, &Leg)| match inverse.as_ref().map(|inverse| &inverse.legs[k]) {
        Some(LegForm::Whole(whole)) => (**whole).clone(),
        _ => compiler::Compiled::of(&source.path, leg.model.clone(), None),
    };
    Ok(CompiledMechanism {
        path: source.path.clone(),
        legs: mechanism.legs.iter().enumerate().map(leg).collect(),
        mechanism,
        freedom,
        inverse,
        forward,
    })
}

/// What a target is follows from the mechanism, and a YAML file says its base
/// and platform.
fn refuse_options(source: &Source, options: &Options) -> Result<(), Diagnostics> {
    let says_ends = MechanismSpec::says_ends(source);
    let set = [
        ("base", options.base.is_some() && says_ends),
        ("tip", options.tip.is_some() && says_ends),
        ("target", options.target.is_some()),
    ];
    let Some((option, _)) = set.into_iter().find(|(_, set)| *set) else {
        return Ok(());
    };
    Err(Diagnostics {
        path: source.path.clone(),
        list: vec![Diagnostic {
            at: None,
            line: String::new(),
            reason: format!("the option `{option}` has no meaning for this file's mechanism"),
            remedy: "leave it out: the file says where the chains begin and end, and what they \
                     can be asked for follows from it"
                .into(),
        }],
    })
}

fn no_closed_form(
    mechanism: &Mechanism,
    source: &Source,
    name: &str,
    reason: &Reason,
) -> Diagnostics {
    let leg = mechanism.legs.iter().find(|leg| leg.name == name);
    let why = match (reason, leg) {
        (Reason::None(reason), Some(leg)) => {
            refusal::no_closed_form(source, &leg.model, Target::Pose, reason).list[0]
                .reason
                .clone()
        }
        (Reason::Lost(q), _) => format!("its configuration {q:.4?} is not among the answers"),
        (Reason::None(reason), None) => format!("{reason:?}"),
    };
    refuse(
        mechanism,
        source,
        format!("the chain `{name}` cannot be solved: {why}"),
        "`ik = none` generates forward kinematics and Jacobians alone",
    )
}
