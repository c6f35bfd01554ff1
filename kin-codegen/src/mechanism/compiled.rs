//! The whole way from a file to verified expressions.

use super::chains::meaningless;
use super::forward::{ForwardMethod, Loop};
use super::freedom::Freedom;
use super::inverse::{Aim, Inverse, LegForm, UnsolvedChain, forward_alone};
use super::model::{Leg, Mechanism};
use super::rounding::Reading;
use crate::arm::CompiledArm;
use crate::options::{Ik, Options};
use crate::scalar::Scalar;
use crate::spec::{Diagnostic, Diagnostics, MechanismSpec, file_name};
use kin_runtime::Pose;

/// A mechanism, compiled but not yet written as code.
#[derive(Clone, Debug)]
pub struct CompiledMechanism {
    /// The robot file's name, without its folders: what is generated does not
    /// depend on where the file lies.
    pub file: String,
    /// What the file has that is odd, and changes nothing of the mechanism.
    pub warnings: Vec<Diagnostic>,
    /// The chains.
    pub mechanism: Mechanism,
    /// How it can move.
    pub freedom: Freedom,
    /// The chains as arms; those that are solved as one have their closed form.
    pub legs: Vec<CompiledArm>,
    /// Inverse kinematics; none if it was not asked for.
    pub inverse: Option<Inverse>,
    /// Forward kinematics.
    pub forward: ForwardMethod,
}

/// A pose of the platform, and how each chain gets there.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// In base coordinates, metres.
    pub pose: Pose,
    /// The solutions of each chain, at least one: joint values in radians and
    /// metres. Any solution of one goes with any of the others.
    pub solutions: Vec<Vec<Vec<f64>>>,
}

/// A chain by its number, and what it does at a pose.
type Led = (usize, Vec<f64>);

impl CompiledMechanism {
    /// What the generated inverse kinematics will return, computed on the
    /// tapes of its arms: the poses that a target stands for (see [`Aim`]) and all
    /// chains reach. There are several only where a chain leads. Empty if the
    /// target is out of reach, or there is no inverse kinematics.
    ///
    /// ```
    /// use kin_codegen::{Options, Source, compile};
    /// let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    /// let source = Source::read("robots/stewart.yaml", root)?;
    /// let compiled = compile(&source, &Options::default())?;
    /// let stewart = compiled.mechanism().unwrap();
    /// let placed = stewart.solutions(&stewart.mechanism.home());
    /// assert!(placed[0].solutions[5].iter().any(|q| q.iter().all(|x| x.abs() < 1e-9)));
    /// # Ok::<(), kin_codegen::Error>(())
    /// ```
    pub fn solutions(&self, target: &Pose) -> Vec<Placed> {
        let Some(inverse) = &self.inverse else {
            return Vec::new();
        };
        let home = self.mechanism.home();
        // What the chain that leads does at a pose is known, and others of its solutions for the
        // target lead to other poses.
        let poses: Vec<(Pose, Option<Led>)> = match inverse.aim {
            Aim::Pose => vec![(*target, None)],
            Aim::Translation => {
                let translation = target.translation;
                vec![(
                    Pose {
                        translation,
                        ..home
                    },
                    None,
                )]
            }
            Aim::Lead(lead) => {
                let chain = self.mechanism.legs[lead].chain();
                let solutions = inverse.legs[lead].solutions(target);
                let led = |q: Vec<f64>| (chain.fk(&q), Some((lead, q)));
                solutions.into_iter().map(led).collect()
            }
        };
        let placed = |(pose, led): (Pose, Option<Led>)| {
            let reached = |(k, leg): (usize, &LegForm)| match &led {
                Some((lead, q)) if *lead == k => Some(vec![q.clone()]),
                _ => Some(leg.solutions(&pose)).filter(|q| !q.is_empty()),
            };
            let legs = inverse.legs.iter().enumerate();
            let solutions = legs.map(reached).collect::<Option<_>>()?;
            Some(Placed { pose, solutions })
        };
        poses.into_iter().filter_map(placed).collect()
    }
}

/// Of the file and of the chains; what several chains say is told once.
fn warnings(spec: &MechanismSpec, reading: &Reading) -> Vec<Diagnostic> {
    let mut warnings = spec.warnings.clone();
    let legs = reading.mechanism.legs.iter();
    let of_chains = legs.flat_map(|leg| &leg.model.warnings);
    for warning in of_chains.chain(&reading.warning(&spec.source)) {
        if !warnings.contains(warning) {
            warnings.push(warning.clone());
        }
    }
    warnings
}

/// Compiles the mechanism of a robot file. If inverse kinematics is asked for
/// and there is none, the mechanism comes without it, and why beside it.
///
/// # Errors
///
/// What is wrong with the mechanism or the options.
pub(crate) fn compile(
    spec: &MechanismSpec,
    options: &Options,
) -> Result<(CompiledMechanism, Option<UnsolvedChain>), Diagnostics> {
    if options.target.is_some() {
        return Err(meaningless(spec, "target"));
    }
    if options.tool.is_some() {
        return Err(meaningless(spec, "tool"));
    }
    if options.scalar != Scalar::default() {
        let reason = "a parallel mechanism is computed in f64 alone";
        let remedy = "leave out `scalar = f32`, or write its chains as arms in files of their own";
        return Err(Diagnostics::one(
            &spec.source.path,
            Diagnostic::whole(reason, remedy),
        ));
    }
    if !options.free.is_empty() {
        return Err(meaningless(spec, "free"));
    }
    let source = &spec.source;
    let file = file_name(&source.path);
    let (base, platform) = (options.base.as_deref(), options.tip.as_deref());
    let reading = Reading::of(Mechanism::new(spec, base, platform)?, spec);
    reading.freedom.check(&reading.mechanism, spec)?;
    let warnings = warnings(spec, &reading);
    let Reading {
        mechanism, freedom, ..
    } = reading;
    let around = Loop::find(&mechanism, &freedom, file);
    let turns = around
        .as_ref()
        .is_some_and(|it| it.turns(&mechanism, &freedom));
    let (inverse, refused) = match options.ik {
        Ik::None => (None, None),
        Ik::ClosedForm => match Inverse::find(&mechanism, &freedom, turns, file) {
            Ok(inverse) => (Some(inverse), None),
            Err(reason) => (None, Some(reason)),
        },
    };
    let forward = match around {
        Some(around) => ForwardMethod::Loop(Box::new(around)),
        None => ForwardMethod::find(&mechanism, &freedom, inverse.as_ref(), file),
    };
    let leg = |(k, leg): (usize, &Leg)| match inverse.as_ref().map(|inverse| &inverse.legs[k]) {
        Some(LegForm::Whole(whole)) => (**whole).clone(),
        _ => forward_alone(file, leg.model.clone()),
    };
    let compiled = CompiledMechanism {
        file: file.to_owned(),
        warnings,
        legs: mechanism.legs.iter().enumerate().map(leg).collect(),
        mechanism,
        freedom,
        inverse,
        forward,
    };
    Ok((compiled, refused))
}
