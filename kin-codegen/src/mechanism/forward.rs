//! Forward kinematics: closed forms where a loop or three spheres give them.

use super::chains::Passed;
use super::freedom::{Freedom, is_upright};
use super::inverse::{Aim, Inverse, SAME, forward_alone, solved};
use super::model::{Leg, Mechanism, meeting_point};
use crate::arm::CompiledArm;
use crate::closed_form::ClosedForm;
use crate::geometry::{Vec3, norm, sub};
use crate::model::{Joint, Model};
use crate::plan::Target;
use crate::scalar::Scalar;
use kin_runtime::__private::three_spheres;
use kin_runtime::Pose;

/// How forward kinematics finds the assembly modes.
#[derive(Clone, Debug)]
pub enum ForwardMethod {
    /// One loop: the passive joints around it are a serial chain, and the
    /// actuated ones place its end.
    Loop(Box<Loop>),
    /// A platform that translates at three constant distances from points that
    /// the actuators place.
    Spheres(Vec<Rod>),
    /// From a seed.
    Newton,
}

/// A single loop, cut where the actuated joints are.
#[derive(Clone, Debug)]
pub struct Loop {
    /// The actuated joints, which place the end of the others.
    pub drive: CompiledArm,
    /// The number among the actuated joints of each joint of `drive`.
    pub driven: Vec<usize>,
    /// The passive joints, with their inverse kinematics.
    pub passive: CompiledArm,
    /// The number among all joints of each joint of `passive`.
    pub joints: Vec<usize>,
}

/// One rod of constant length, from a point that the actuators carry to one of
/// the platform.
#[derive(Clone, Debug)]
pub struct Rod {
    /// The actuated joints; the tip is where the rod begins.
    pub drive: CompiledArm,
    /// The numbers among the actuated joints.
    pub driven: Vec<usize>,
    /// Where the rod ends, less the platform's origin: base coordinates.
    pub end: Vec3,
    /// Metres.
    pub length: f64,
}

impl ForwardMethod {
    /// Finds a closed form where there is more than a single loop, verified on the samples.
    pub fn find(
        mechanism: &Mechanism,
        freedom: &Freedom,
        inverse: Option<&Inverse>,
        file: &str,
    ) -> Self {
        if inverse.is_some_and(|inverse| inverse.aim == Aim::Translation)
            && let Some(rods) = rods(mechanism, file)
            && hold(mechanism, freedom, &rods)
        {
            return ForwardMethod::Spheres(rods);
        }
        ForwardMethod::Newton
    }

    /// How many assembly modes it finds at most; 0 without a closed form.
    pub fn assembly_modes(&self) -> usize {
        match self {
            ForwardMethod::Loop(found) => {
                let form = found.passive.form();
                form.map_or(0, ClosedForm::most_solutions)
            }
            ForwardMethod::Spheres(_) => 2,
            ForwardMethod::Newton => 0,
        }
    }
}

impl Loop {
    /// Finds the closed form of a mechanism that is one, verified on the samples.
    pub fn find(mechanism: &Mechanism, freedom: &Freedom, file: &str) -> Option<Self> {
        let found = single_loop(mechanism, file)?;
        let is_same = |q: &[f64], other: &[f64]| {
            let passive = &found.passive.model;
            let same = |(i, &joint): (usize, &usize)| {
                passive.joint_distance(i, other[joint], q[joint]) < SAME
            };
            found.joints.iter().enumerate().all(same)
        };
        let mut samples = regular(mechanism, freedom);
        let recovers = samples.all(|q| {
            let assemblies = found.assemblies(mechanism, q);
            assemblies.iter().any(|assembly| is_same(q, assembly))
        });
        recovers.then_some(found)
    }

    /// Whether the platform is turned in some assembly mode at the samples.
    pub fn turns(&self, mechanism: &Mechanism, freedom: &Freedom) -> bool {
        regular(mechanism, freedom).any(|q| {
            let assemblies = self.assemblies(mechanism, q);
            assemblies.iter().any(|q| !is_upright(mechanism, q))
        })
    }

    /// All closed configurations with the actuated values of one.
    fn assemblies(&self, mechanism: &Mechanism, q: &[f64]) -> Vec<Vec<f64>> {
        let actuated = mechanism.actuated();
        let values: Vec<f64> = self.driven.iter().map(|a| q[actuated[*a]]).collect();
        let end = self.drive.model.chain().fk(&values);
        let solutions = self.passive.form().map(|form| form.solutions(&end));
        let assembly = |passive: &[f64]| {
            let mut all = q.to_vec();
            for (&joint, &value) in self.joints.iter().zip(passive) {
                all[joint] = value;
            }
            all
        };
        let solutions = solutions.iter().flatten();
        solutions.map(|it| assembly(&it.q)).collect()
    }
}

/// Samples at which the actuators hold the platform.
fn regular<'f>(
    mechanism: &Mechanism,
    freedom: &'f Freedom,
) -> impl Iterator<Item = &'f Vec<f64>> + use<'f> {
    let generic = mechanism.generic();
    let samples = freedom.samples.iter();
    samples.filter(move |q| generic.actuator_singularity(q) > 1e-4)
}

fn single_loop(mechanism: &Mechanism, file: &str) -> Option<Loop> {
    let [out, back] = &mechanism.ranges()[..] else {
        return None;
    };
    let away = (out[0]..out[1]).map(|j| (j, true));
    let home = (back[0]..back[1]).rev().map(|j| (j, false));
    let around: Vec<Passed> = away.chain(home).collect();
    let actuated = mechanism.actuated();
    let is_passive = |passed: &Passed| !actuated.contains(&passed.0);
    // Where the passive joints begin, behind an actuated one.
    let n = around.len();
    let begins = |i: &usize| is_passive(&around[*i]) && !is_passive(&around[(i + n - 1) % n]);
    let mut beginnings = (0..n).filter(begins);
    let (Some(begin), None) = (beginnings.next(), beginnings.next()) else {
        return None;
    };
    let turned: Vec<Passed> = (0..n).map(|i| around[(begin + i) % n]).collect();
    let (passive, drive): (Vec<Passed>, Vec<Passed>) = turned.into_iter().partition(is_passive);
    // Around the loop the product is 1: the passive part is the inverse of the
    // rest.
    let undone: Vec<Passed> = drive.into_iter().rev().map(|(j, way)| (j, !way)).collect();
    let model = chain_of(mechanism, &passive, Pose::IDENTITY);
    let number = |joint: usize| actuated.iter().position(|a| *a == joint);
    Some(Loop {
        drive: forward_alone(file, chain_of(mechanism, &undone, Pose::IDENTITY)),
        driven: undone.iter().filter_map(|(j, _)| number(*j)).collect(),
        passive: solved(file, model, Target::Pose).ok()?,
        joints: passive.iter().map(|(j, _)| *j).collect(),
    })
}

/// Some joints of the mechanism in a row, those passed backwards with their
/// axes turned round.
fn chain_of(mechanism: &Mechanism, passed: &[Passed], home: Pose) -> Model {
    let joints: Vec<_> = mechanism
        .legs
        .iter()
        .flat_map(|leg| &leg.model.joints)
        .collect();
    let variables: Vec<_> = mechanism
        .legs
        .iter()
        .flat_map(|leg| &leg.model.variables)
        .collect();
    let joint = |(i, (j, outwards)): (usize, &Passed)| Joint {
        axis: if *outwards {
            joints[*j].axis
        } else {
            joints[*j].axis.map(|x| 0.0 - x)
        },
        variable: i,
        ..joints[*j].clone()
    };
    Model {
        name: mechanism.name.clone(),
        base: mechanism.base.clone(),
        tip: mechanism.base.clone(),
        tool: None,
        joints: passed.iter().enumerate().map(joint).collect(),
        variables: passed.iter().map(|(j, _)| variables[*j].clone()).collect(),
        home,
        frames: Vec::new(),
        warnings: Vec::new(),
        scalar: Scalar::default(),
    }
}

/// Three rods, if every chain is actuated joints and then passive axes that meet
/// in one or the other end of a rod.
fn rods(mechanism: &Mechanism, file: &str) -> Option<Vec<Rod>> {
    if mechanism.legs.len() != 3 {
        return None;
    }
    let mut first = 0;
    let mut rods = Vec::new();
    for leg in &mechanism.legs {
        rods.push(rod(leg, first, mechanism.home(), file)?);
        first += leg.actuated.len();
    }
    Some(rods)
}

/// Every sample's platform is where the spheres of its rods meet.
fn hold(mechanism: &Mechanism, freedom: &Freedom, rods: &[Rod]) -> bool {
    let (generic, actuated) = (mechanism.generic(), mechanism.actuated());
    regular(mechanism, freedom).all(|q| {
        let centre = |rod: &Rod| {
            let values: Vec<f64> = rod.driven.iter().map(|a| q[actuated[*a]]).collect();
            let from = rod.drive.model.chain().fk(&values);
            sub(from.translation, rod.end)
        };
        let centres = [0, 1, 2].map(|i| centre(&rods[i]));
        let found = three_spheres(centres, [0, 1, 2].map(|i| rods[i].length));
        let platform = generic.poses(q)[0].translation;
        let near = |p: &Vec3| norm(sub(*p, platform)) < 1e-6 * generic.length();
        found.exact().iter().any(near)
    })
}

fn rod(leg: &Leg, first: usize, home: Pose, file: &str) -> Option<Rod> {
    let model = &leg.model;
    let (n, driven) = (model.joints.len(), leg.actuated.len());
    if driven == 0 || leg.actuated != (0..driven).collect::<Vec<_>>() {
        return None;
    }
    let turn = |j: usize| model.joints[j].is_revolute();
    if !(driven..n).all(turn) {
        return None;
    }
    let (begin, end) = (driven + 2..n - 1).find_map(|at| {
        let begin = meeting_point(model, driven..at)?;
        Some((begin, meeting_point(model, at..n)?))
    })?;
    let drive = super::inverse::part(model, 0..driven, Pose::from_translation(begin), "rod");
    Some(Rod {
        drive: forward_alone(file, drive),
        driven: (first..first + driven).collect(),
        end: sub(end, home.translation),
        length: norm(sub(end, begin)),
    })
}
