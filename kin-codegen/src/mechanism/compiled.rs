//! The whole way from a file to verified expressions.

use super::forward::Forward;
use super::freedom::{Freedom, refuse};
use super::inverse::{Inverse, LegForm, Reason};
use super::model::{Leg, Mechanism};
use crate::compiler;
use crate::options::{Ik, Options};
use crate::plan::Target;
use crate::refusal;
use crate::spec::{Diagnostic, Diagnostics, MechanismSpec, Source};

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
