//! Frames in which constants vanish.
//!
//! The product of exponentials e₁ … eₙ g(0) is rewritten as
//!
//! ```text
//! C₀ J₁ C₁ J₂ … Jₙ Cₙ
//! ```
//!
//! with joint motions J that are rotations about z or translations along a
//! constant direction, and constant motions C. The frames are free to turn
//! about and slide along their axis, and are chosen so that the C hold as many
//! zeros and ±1 as the arm allows: axis-aligned where the geometry is,
//! otherwise the Denavit-Hartenberg normal with the angle folded into the
//! joint. Frames of parallel joints in a row share their orientation, so that
//! their angles add.

use super::conditioning::coupled;
use super::{
    Combination, Coupling, Line, Swivel, Vec3, along, conditioning, cross, dot, norm, size, sub,
    unit,
};
use crate::model::{Joint, JointKind, Model};
use crate::scalar::Scalar;
use kin_runtime::__private::Projection;
use kin_runtime::{Chain, Jacobian, Pose, Target, Twist};
use std::borrow::Cow;
use std::ops::Range;

/// Entries of a constant motion below this (relative to the arm's size) are
/// rounding of the file's own zeros.
const ROUNDING: f64 = 1e-14;
/// Axes whose directions differ less than this are parallel.
const PARALLEL: f64 = 1e-13;
/// Axes nearer to parallel than this have their common normal so far away that frames at
/// its foot would cost as many digits; any point of the axis serves instead.
const FAR_NORMAL: f64 = 5e-2;

/// The chain as alternating joint motions and constant motions.
#[derive(Clone, Debug)]
pub struct Linkage {
    /// C₀: from the base link to the first joint.
    pub base: Pose,
    /// J₁ C₁ … Jₙ Cₙ.
    pub links: Vec<Link>,
    /// Maximal ranges of joints whose frames share one orientation:
    /// consecutive parallel revolutes, with prismatic joints among them.
    pub runs: Vec<Run>,
    /// The arm's size, metres.
    pub size: f64,
    /// What it is computed in.
    pub scalar: Scalar,
    /// Whether the last joint is none of the arm's, but the turn about the
    /// tip's z axis that a target leaves free.
    pub has_free_turn: bool,
    /// The joints whose values come with the target, ascending: parameters of inverse
    /// kinematics, not unknowns.
    pub locked: Vec<usize>,
    /// The swivel, where its angle comes with the target; behind the values of locked joints.
    pub swivel: Option<Swivel>,
    /// How the joints that are not locked depend on the coordinates of q where these are not the same:
    /// of such an arm joints are locked in front alone.
    pub coupling: Option<Coupling>,
}

/// A joint and the constant motion behind it.
#[derive(Clone, Debug)]
pub struct Link {
    /// J: a rotation about z, or a translation along `direction`.
    pub kind: JointKind,
    /// The joint's axis in its frame, as long as a slide goes for each metre; z of a revolute joint.
    pub direction: Vec3,
    /// Which coordinate of q moves it.
    pub variable: usize,
    /// J is by `gain * q + offset`: radians or metres.
    pub gain: f64,
    /// See `gain`.
    pub offset: f64,
    /// C: from behind the joint to before the next one, or to the tip.
    pub after: Pose,
    /// The translation of C in the axes behind it: where these look along the
    /// next joint, Denavit and Hartenberg's a and d stand apart.
    pub advance: Vec3,
    /// The child link's own frame, as seen from behind the joint.
    pub body: Pose,
    /// The frame before the joint at home, in base coordinates.
    pub before_home: Pose,
    /// The frame behind the joint at home, in base coordinates.
    pub after_home: Pose,
}

/// Joints whose frames share one orientation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// The joints.
    pub joints: Range<usize>,
}

impl Linkage {
    /// The linkage of an arm that is asked for a part of poses: where it leaves
    /// the turn about the tip's z axis free, that turn is one more joint, and
    /// the target a whole pose.
    pub fn for_target(model: &Model, target: Target) -> Self {
        if target != Target::PositionAxis {
            return Self::new(model);
        }
        let mut longer = model.clone();
        longer.joints.push(Joint {
            name: "free turn".into(),
            kind: JointKind::Revolute,
            axis: column(&model.home, 2),
            point: model.home.translation,
            link: model.tip.clone(),
            frame: model.home,
            variable: model.variables.len(),
            multiplier: 1.0,
            offset: 0.0,
            gear: 1.0,
        });
        Self {
            size: size(model),
            has_free_turn: true,
            ..Self::new(&longer)
        }
    }

    /// Chooses the frames.
    pub fn new(model: &Model) -> Self {
        let size = size(model);
        let origins = origins(model);
        let mut links: Vec<Link> = Vec::with_capacity(model.joints.len());
        let mut runs: Vec<Run> = Vec::new();
        // Orientation behind the joint before, at home.
        let mut orientation = Pose::IDENTITY;
        for (i, joint) in model.joints.iter().enumerate() {
            let mut before = orientation;
            let mut sign = 1.0;
            let mut continues = !runs.is_empty();
            if joint.is_revolute() {
                let z = column(&orientation, 2);
                if norm(cross(z, joint.axis)) < PARALLEL {
                    sign = dot(z, joint.axis).signum();
                } else {
                    before = facing(&orientation, joint.axis);
                    // A run that only slides may take the orientation of the
                    // joint behind it no more: its directions are fixed.
                    continues = false;
                }
            }
            before.translation = origins[i];
            let turn = if joint.is_revolute() {
                align(&before, wanted_x(model, &origins, i))
            } else {
                0.0
            };
            let after = before * about_z(turn);
            links.push(link(joint, sign, turn, before, after));
            match runs.last_mut().filter(|_| continues) {
                Some(run) => run.joints.end = i + 1,
                None => runs.push(Run { joints: i..i + 1 }),
            }
            orientation = after;
        }
        let base = clean(links[0].before_home, size);
        for i in 0..links.len() {
            let next = links.get(i + 1).map_or(model.home, |link| link.before_home);
            let home = links[i].after_home.inverse();
            let after = home * next;
            let advance = after.rotate_back(after.translation);
            links[i].advance = tidy(advance, size).map(short);
            links[i].after = clean(after, size);
            links[i].body = clean(home * model.joints[i].frame, size);
        }
        Linkage {
            base,
            links,
            runs,
            size,
            scalar: model.scalar,
            has_free_turn: false,
            locked: Vec::new(),
            swivel: None,
            coupling: None,
        }
    }

    /// The same with the values of some joints, ascending, known from the start.
    pub fn with_locked(self, locked: &[usize]) -> Self {
        Self {
            locked: locked.to_vec(),
            ..self
        }
    }

    /// The same with the swivel angle known from the start.
    pub fn with_swivel(self, swivel: Option<Swivel>) -> Self {
        Self { swivel, ..self }
    }

    /// The same whose joints depend on the coordinates of q.
    pub fn with_coupling(self, coupling: Option<Coupling>) -> Self {
        Self { coupling, ..self }
    }

    /// How many numbers come with the target.
    pub fn parameters(&self) -> usize {
        self.locked.len() + usize::from(self.swivel.is_some())
    }

    /// How far from singular the joints are that a target is solved for; see [`conditioning`].
    /// `chain` is that of these joints.
    pub fn conditioning(&self, chain: &Chain, q: &[f64], target: Target) -> f64 {
        match (&self.swivel, &self.coupling) {
            (Some(swivel), _) => swivel.conditioning(chain, q, self.size),
            (None, Some(coupling)) => coupled(chain, coupling, q, self.size, target),
            (None, None) => conditioning(chain, q, self.size, target),
        }
    }

    /// An idealized arm whose tip is nearer than this to the given one's, metres, is that to rounding.
    pub fn unmoved(&self, target: Target) -> f64 {
        let tolerances = self.scalar.tolerances();
        // Coupled joints have no elimination that would tell the rest.
        let is_short = self.coupling.is_none() && self.variables() < target.coordinates();
        let relative = match is_short {
            true => tolerances.unmoved_if_short,
            false => tolerances.unmoved,
        };
        relative * self.size
    }

    /// The number of coordinates of q that a target is solved for.
    pub fn variables(&self) -> usize {
        if let Some(coupling) = &self.coupling {
            return coupling.limits.len();
        }
        let own = self.links.len() - usize::from(self.has_free_turn);
        let variables = self.links[..own].iter().map(|link| link.variable + 1);
        variables.max().unwrap_or(0) - self.locked.len()
    }

    /// The coordinates of q that a target is solved for.
    pub fn solved_variables(&self) -> Vec<usize> {
        if let Some(coupling) = &self.coupling {
            return (coupling.given..coupling.given + self.variables()).collect();
        }
        let solved = (0..self.links.len()).filter(|&joint| self.coordinate(joint).is_some());
        let mut variables: Vec<usize> = solved.map(|j| self.links[j].variable).collect();
        variables.sort_unstable();
        variables.dedup();
        variables
    }

    /// Which of the coordinates that a target is solved for a joint is; none if it is
    /// locked, or the free turn, or coupled to others.
    pub fn coordinate(&self, joint: usize) -> Option<usize> {
        if let Some(coupling) = &self.coupling {
            return coupling.coordinate(joint.checked_sub(coupling.given)?);
        }
        let before = self.locked.iter().filter(|&&locked| locked < joint).count();
        let coordinate = self.links[joint].variable.checked_sub(before);
        coordinate.filter(|&i| i < self.variables() && !self.locked.contains(&joint))
    }

    /// The first joint that turns.
    pub fn first_turn(&self) -> Option<usize> {
        (0..self.links.len()).find(|&joint| self.is_revolute(joint))
    }

    /// How targets see the tip, by the first axis that is turned about; where none is, by that along
    /// which the first joint slides.
    pub fn projection(&self, counts: Target) -> Projection {
        Projection {
            counts,
            axis: self.axis(self.first_turn().unwrap_or(0)).direction,
            home: self.tip_home(),
        }
    }

    /// Whether a coordinate that a target is solved for is the same a full turn further.
    pub fn repeats(&self, coordinate: usize) -> bool {
        match &self.coupling {
            Some(coupling) => coupling.repeats(coordinate),
            None => {
                let joint = self.joint_of(coordinate);
                joint.is_some_and(|joint| self.is_revolute(joint))
            }
        }
    }

    /// The joint that a coordinate is that a target is solved for; of joints that mimic
    /// none.
    pub fn joint_of(&self, coordinate: usize) -> Option<usize> {
        let mut joints = 0..self.links.len();
        joints.find(|&joint| self.coordinate(joint) == Some(coordinate))
    }

    /// The tip's pose and the spatial Jacobian at the coordinates `q` that targets are
    /// solved for, in plain numbers; `parameters` are the values of locked joints.
    pub fn fk_jacobian<const N: usize>(
        &self,
        q: &[f64; N],
        parameters: &[f64],
    ) -> (Pose, Jacobian<N>) {
        if let Some(coupling) = &self.coupling {
            return coupling.whole.fk_jacobian(q, parameters);
        }
        let mut pose = self.base;
        let mut columns = [Twist::default(); N];
        for (joint, link) in self.links.iter().enumerate() {
            let coordinate = self.coordinate(joint);
            let locked = self.locked.iter().position(|&locked| locked == joint);
            let moved = match (coordinate, locked) {
                (Some(i), _) => q[i],
                (None, Some(k)) => parameters[k],
                (None, None) => 0.0,
            };
            let value = link.gain * moved + link.offset;
            let axis = pose.rotate(link.direction);
            let (twist, motion) = match link.kind {
                JointKind::Revolute => (Twist::revolute(axis, pose.translation), about_z(value)),
                JointKind::Prismatic => {
                    let shift = Pose {
                        translation: link.direction.map(|x| x * value),
                        ..Pose::IDENTITY
                    };
                    (Twist::prismatic(axis), shift)
                }
            };
            if let Some(i) = coordinate {
                columns[i] = columns[i] + twist * link.gain;
            }
            pose = pose * motion * link.after;
        }
        (pose, Jacobian::from_columns(columns))
    }

    /// The tip's frame at home, in base coordinates.
    pub fn tip_home(&self) -> Pose {
        self.links
            .last()
            .map_or(self.base, |link| link.after_home * link.after)
    }

    /// The run that a joint belongs to.
    pub fn run_of(&self, joint: usize) -> usize {
        self.runs
            .iter()
            .position(|run| run.joints.contains(&joint))
            .unwrap_or(0)
    }

    /// The joints of a run that turn.
    pub fn revolutes_of(&self, run: usize) -> Vec<usize> {
        let mut joints: Vec<usize> = self.runs[run].joints.clone().collect();
        joints.retain(|&joint| self.is_revolute(joint));
        joints
    }

    /// Whether a joint turns.
    pub fn is_revolute(&self, joint: usize) -> bool {
        self.links[joint].kind == JointKind::Revolute
    }

    /// The twist of a joint at home, in base coordinates.
    pub fn twist(&self, joint: usize) -> Twist {
        let Line { direction, point } = self.axis(joint);
        match self.links[joint].kind {
            JointKind::Revolute => Twist::revolute(direction, point),
            JointKind::Prismatic => Twist::prismatic(direction),
        }
    }

    /// How far each joint has moved along its axis, radians or metres; a free turn has not.
    /// `parameters` are the values of locked joints, or the swivel angle, which moves none.
    pub fn by_joint(&self, q: &[f64], parameters: &[f64]) -> Vec<f64> {
        let mut joints = self.joints_at(q).into_owned();
        for (&joint, &value) in self.locked.iter().zip(parameters) {
            joints.insert(joint, value);
        }
        let moved = |link: &Link| joints.get(link.variable).copied().unwrap_or(0.0);
        self.links.iter().map(moved).collect()
    }

    /// The values of the joints that are not locked, from the coordinates that targets are solved
    /// for.
    pub fn joints_at<'a>(&self, q: &'a [f64]) -> Cow<'a, [f64]> {
        match &self.coupling {
            Some(coupling) => coupling.joints(q).into(),
            None => q.into(),
        }
    }

    /// Coordinates that targets are solved for, from values of the joints that are not locked.
    /// Those that do not repeat are within their limits.
    pub fn coordinates_at(&self, joints: Vec<f64>) -> Vec<f64> {
        let Some(coupling) = &self.coupling else {
            return joints;
        };
        let mut q = coupling.coordinates(&joints);
        for (x, limits) in q.iter_mut().zip(&coupling.limits) {
            if let Some([lower, upper]) = limits {
                *x = x.max(*lower).min(*upper);
            }
        }
        q
    }

    /// How a joint depends on the coordinates of a coupled chain.
    pub fn row(&self, joint: usize) -> Option<&Combination> {
        let coupling = self.coupling.as_ref()?;
        coupling.rows.get(joint.checked_sub(coupling.given)?)
    }

    /// Those of all joints.
    pub fn twists(&self) -> Vec<Twist> {
        (0..self.links.len())
            .map(|joint| self.twist(joint))
            .collect()
    }

    /// The axis of a joint at home, in base coordinates.
    pub fn axis(&self, joint: usize) -> Line {
        let link = &self.links[joint];
        let along = link.before_home.rotate(link.direction);
        Line {
            direction: along.map(|x| x * link.gain.signum()),
            point: link.before_home.translation,
        }
    }
}

fn link(joint: &Joint, sign: f64, turn: f64, before: Pose, after: Pose) -> Link {
    let (direction, sign) = match joint.kind {
        JointKind::Revolute => ([0.0, 0.0, 1.0], sign),
        JointKind::Prismatic => {
            let direction = tidy(before.rotate_back(joint.axis), 1.0);
            (direction.map(|x| joint.gear * x), 1.0)
        }
    };
    Link {
        kind: joint.kind,
        direction,
        variable: joint.variable,
        gain: sign * joint.multiplier,
        offset: sign * joint.offset + turn,
        after: Pose::IDENTITY,
        advance: [0.0; 3],
        body: Pose::IDENTITY,
        before_home: before,
        after_home: after,
    }
}

/// Where each frame sits: on its axis, at the foot of the common normal to the
/// next axis that is not parallel; parallel neighbours on one level. What is
/// behind the last such foot slides to it. A prismatic joint has no place of
/// its own and takes that of the joint before.
fn origins(model: &Model) -> Vec<Vec3> {
    let turning: Vec<usize> = (0..model.joints.len())
        .filter(|&i| model.joints[i].is_revolute())
        .collect();
    let line = |i: usize| Line::of(&model.joints[i]);
    let skew = |i: usize, j: usize| norm(cross(line(i).direction, line(j).direction)) > FAR_NORMAL;
    let mut feet: Vec<Option<Vec3>> = vec![None; model.joints.len()];
    for pair in turning.windows(2).rev() {
        let (i, next) = (pair[0], pair[1]);
        feet[i] = if skew(i, next) {
            Some(line(i).foot(&line(next)))
        } else {
            feet[next].map(|foot| line(i).nearest(foot))
        };
    }
    for (k, &i) in turning.iter().enumerate() {
        let previous = k.checked_sub(1).map(|k| turning[k]);
        feet[i] = feet[i].or_else(|| match previous {
            Some(j) if skew(i, j) => Some(line(i).foot(&line(j))),
            Some(j) => feet[j].map(|foot| line(i).nearest(foot)),
            None => Some(line(i).nearest([0.0; 3])),
        });
    }
    let mut here = None;
    feet.into_iter()
        .enumerate()
        .map(|(i, foot)| {
            here = foot.or(here);
            here.unwrap_or(model.joints[i].point)
        })
        .collect()
}

/// A frame that looks along `axis`. Along an axis of `from` it is a signed
/// permutation of it, otherwise x is the common normal.
fn facing(from: &Pose, axis: Vec3) -> Pose {
    let local = from.rotate_back(axis);
    let x = match (0..3).find(|&k| local[k].abs() > 1.0 - ROUNDING) {
        // The next axis in cyclic order keeps a right angle a permutation.
        Some(k) => column(from, (k + 1) % 3),
        None => cross(column(from, 2), axis),
    };
    frame(axis, x)
}

/// The orientation with z along `z` and x as near to `x` as it can be.
fn frame(z: Vec3, x: Vec3) -> Pose {
    let x = unit(along(x, -dot(x, z), z));
    let y = cross(z, x);
    Pose {
        rotation: std::array::from_fn(|i| [x[i], y[i], z[i]]),
        translation: [0.0; 3],
    }
}

/// Where x behind the joint should point: along the link to a parallel
/// neighbour, or along the normal to the next axis, or as the tip has it.
fn wanted_x(model: &Model, origins: &[Vec3], i: usize) -> Vec3 {
    let z = model.joints[i].axis;
    let home = &model.home;
    let Some(next) = model.joints.get(i + 1) else {
        let towards = column(home, 2);
        let normal = cross(z, towards);
        return if norm(normal) < PARALLEL {
            column(home, 0)
        } else {
            normal
        };
    };
    let normal = cross(z, next.axis);
    if norm(normal) > PARALLEL {
        return normal;
    }
    sub(origins[i + 1], origins[i])
}

/// The angle about z that brings x of the frame onto `wanted`, to within a
/// quarter turn, which costs nothing to leave in the constants.
fn align(frame: &Pose, wanted: Vec3) -> f64 {
    let local = frame.rotate_back(wanted);
    let (x, y) = (local[0], local[1]);
    let length = x.hypot(y);
    if length <= ROUNDING || x.abs().min(y.abs()) <= ROUNDING * length {
        return 0.0;
    }
    y.atan2(x)
}

fn about_z(angle: f64) -> Pose {
    if angle == 0.0 {
        return Pose::IDENTITY;
    }
    let (s, c) = angle.sin_cos();
    Pose {
        rotation: [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    }
}

pub(super) fn column(pose: &Pose, j: usize) -> Vec3 {
    [0, 1, 2].map(|i| pose.rotation[i][j])
}

/// Rounding noise becomes exact zeros and ones.
fn clean(pose: Pose, size: f64) -> Pose {
    Pose {
        rotation: pose.rotation.map(|row| tidy(row, 1.0)),
        translation: tidy(pose.translation, size).map(short),
    }
}

/// A frame between links as generated code has it: without rounding noise.
pub(crate) fn without_noise(pose: &Pose) -> Pose {
    clean(*pose, 1.0)
}

/// A length without the digits that composing frames has left behind: metres,
/// to a femtometre.
pub(super) fn short(x: f64) -> f64 {
    (x * 1e15).round() / 1e15
}

fn tidy(v: Vec3, scale: f64) -> Vec3 {
    v.map(|x| {
        if x.abs() < ROUNDING * scale {
            0.0
        } else if (x.abs() - 1.0).abs() < ROUNDING {
            x.signum()
        } else {
            x
        }
    })
}
