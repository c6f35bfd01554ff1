//! What was found in a mechanism's file and decided about it.

use super::{Chain, SCHEMA, Warning, write_refusal, write_warnings};
use kin_codegen::mechanism::{CompiledMechanism, LegForm};
use kin_codegen::spec::{Diagnostic, one_line};
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// All that there is to tell about a mechanism's file. Lengths are metres,
/// angles radians, coordinates those of the base.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MechanismExplanation {
    /// [`SCHEMA`].
    pub schema: u32,
    /// The robot file's name.
    pub file: String,
    /// The mechanism's name.
    pub robot: String,
    /// What is odd in the file.
    pub warnings: Vec<Warning>,
    /// The link that all chains begin at.
    pub base: String,
    /// The link that all chains end at.
    pub platform: String,
    /// The chains, in the order of the file.
    pub chains: Vec<LegExplanation>,
    /// How it can move.
    pub mobility: Mobility,
    /// What its actuators do.
    pub actuation: Actuation,
    /// Inverse kinematics, if there is any.
    pub inverse: Option<InverseExplanation>,
    /// Why there is none, if it was asked for.
    pub refusal: Option<String>,
    /// What to do about that.
    pub remedy: Option<String>,
    /// How forward kinematics is found.
    pub forward: ForwardExplanation,
}

/// One chain.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LegExplanation {
    /// Its name.
    pub name: String,
    /// By letters: `UP*S`, the star behind actuated joints.
    pub structure: String,
    /// Its joints.
    pub chain: Chain,
    /// Its actuated joints, by name.
    pub actuated: Vec<String>,
}

/// How a mechanism can move.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mobility {
    /// The dimension of the group that holds all joints' motions.
    pub dimension: usize,
    /// The joints.
    pub joints: usize,
    /// The independent loops.
    pub loops: usize,
    /// joints − dimension × loops.
    pub gruebler: isize,
    /// By the rank of the structure equation's Jacobian.
    pub rank: usize,
    /// Of these, motions of the platform.
    pub platform: usize,
}

/// What the actuators do, at home.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Actuation {
    /// The actuated joints, by name.
    pub joints: Vec<String>,
    /// The least singular value of the wrenches that hold the platform while
    /// they are locked.
    pub actuator_singularity: f64,
    /// The least of the structure equation's Jacobian, by the largest.
    pub kinematic_singularity: f64,
}

/// Inverse kinematics.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InverseExplanation {
    /// What of a target is read.
    pub target: String,
    /// The plan of every chain.
    pub plans: Vec<String>,
    /// The branches of every chain.
    pub branches: Vec<usize>,
    /// Closed configurations that came back from the pose that they make.
    pub verified: usize,
}

/// Forward kinematics.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ForwardExplanation {
    /// In words.
    pub method: String,
    /// Assembly modes found at most; 0 if it takes a seed.
    pub assembly_modes: usize,
}

impl MechanismExplanation {
    pub(super) fn of(compiled: &CompiledMechanism, refusal: Option<Diagnostic>) -> Self {
        let CompiledMechanism {
            mechanism, freedom, ..
        } = compiled;
        let generic = mechanism.generic();
        let home = vec![0.0; mechanism.joints()];
        let legs = mechanism.legs.iter().map(|leg| LegExplanation {
            name: leg.name.clone(),
            structure: leg.structure(),
            chain: Chain::of(&leg.model),
            actuated: leg.actuated_names(),
        });
        let chains: Vec<LegExplanation> = legs.collect();
        Self {
            schema: SCHEMA,
            file: compiled.file.clone(),
            robot: mechanism.name.clone(),
            warnings: Warning::all(&compiled.warnings),
            base: mechanism.base.clone(),
            platform: mechanism.platform.clone(),
            mobility: Mobility {
                dimension: freedom.dimension,
                joints: mechanism.joints(),
                loops: chains.len() - 1,
                gruebler: freedom.gruebler,
                rank: freedom.mobility,
                platform: freedom.platform,
            },
            actuation: Actuation {
                joints: chains.iter().flat_map(|leg| leg.actuated.clone()).collect(),
                actuator_singularity: generic.actuator_singularity(&home),
                kinematic_singularity: generic.kinematic_singularity(&home, freedom.mobility),
            },
            inverse: compiled.inverse.as_ref().map(|inverse| InverseExplanation {
                target: (compiled.targets(|name| format!("`{name}`"))).unwrap_or_default(),
                plans: inverse.legs.iter().map(LegForm::plan).collect(),
                branches: inverse.legs.iter().map(LegForm::branches).collect(),
                verified: inverse.verified,
            }),
            refusal: refusal.as_ref().map(|it| it.reason.clone()),
            remedy: refusal.map(|it| it.remedy),
            forward: ForwardExplanation {
                method: compiled.forward.method(),
                assembly_modes: compiled.forward.assembly_modes(),
            },
            chains,
        }
    }
}

impl Display for MechanismExplanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Mobility {
            dimension,
            joints,
            loops,
            gruebler,
            rank,
            platform,
        } = self.mobility;
        writeln!(
            f,
            "{}, from {}: {} chains from {} to {}, {joints} joints, {} of them actuated\n",
            one_line(&self.robot),
            one_line(&self.file),
            self.chains.len(),
            one_line(&self.base),
            one_line(&self.platform),
            self.actuation.joints.len(),
        )?;
        write_warnings(&self.warnings, f)?;
        writeln!(
            f,
            "Chains at home, in metres and {}'s axes",
            one_line(&self.base)
        )?;
        for leg in &self.chains {
            writeln!(
                f,
                "  {}, {}\n{}",
                one_line(&leg.name),
                leg.structure,
                leg.chain
            )?;
        }
        writeln!(f, "Mobility")?;
        let kind = match dimension {
            6 => "in space",
            _ => "in a group of motions of that dimension",
        };
        writeln!(
            f,
            "  Grübler: {joints} joints - {dimension} x {loops} loops = {gruebler}, {kind}"
        )?;
        let idle = match rank - platform {
            0 => "all of them motions of the platform".into(),
            idle => format!("{platform} of them motions of the platform, {idle} idle"),
        };
        writeln!(f, "  By rank: {rank}, {idle}\n")?;
        writeln!(f, "Actuation")?;
        writeln!(f, "  {}", one_line(&self.actuation.joints.join(", ")))?;
        writeln!(
            f,
            "  At home, distance from actuator singularities {:.4}, from kinematic ones {:.4}\n",
            self.actuation.actuator_singularity, self.actuation.kinematic_singularity
        )?;
        writeln!(f, "Inverse kinematics, chain by chain")?;
        match (&self.inverse, &self.refusal) {
            (Some(inverse), _) => self.write_inverse(inverse, f)?,
            (None, refusal) => write_refusal(refusal, &self.remedy, f)?,
        }
        writeln!(
            f,
            "\nForward kinematics\n  {}",
            sentence(&one_line(&self.forward.method))
        )?;
        match self.forward.assembly_modes {
            0 => Ok(()),
            n => writeln!(f, "  {n} assembly modes at most."),
        }
    }
}

impl MechanismExplanation {
    fn write_inverse(&self, inverse: &InverseExplanation, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "  Targets are {}.", one_line(&inverse.target))?;
        let plans = inverse.plans.iter().zip(&inverse.branches);
        for (leg, (plan, branches)) in self.chains.iter().zip(plans) {
            writeln!(f, "  {}: {plan}, {branches} branches", one_line(&leg.name))?;
        }
        writeln!(
            f,
            "  Verified on {} closed configurations: every chain was recovered.",
            inverse.verified
        )
    }
}

fn sentence(text: &str) -> String {
    let (first, rest) = text.split_at(1);
    format!("{}{rest}.", first.to_uppercase())
}
