//! The chain with its target as a closed loop, in numbers: e^(ξ̂₁ q₁) …
//! e^(ξ̂ₙ qₙ) M⁻¹ is the identity for M = T g(0)⁻¹. Points and directions are
//! at home, in base coordinates, and transported by the exponentials of the
//! twists; no frame of the compiler is used.

use kin_codegen::geometry::Linkage;
use kin_codegen::plan::{Atom, Invariant, Kind};
use kin_runtime::{Chain, Pose, Twist};
use std::f64::consts::{PI, TAU};

pub type Vec3 = [f64; 3];

pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// An angle in (−π, π].
pub fn wrapped(angle: f64) -> f64 {
    PI - (PI - angle).rem_euclid(TAU)
}

/// A point, direction or plane somewhere on the loop.
#[derive(Clone, Copy, Debug)]
pub struct Object {
    pub kind: Kind,
    pub point: Vec3,
    pub direction: Vec3,
}

impl From<&Invariant> for Object {
    fn from(invariant: &Invariant) -> Self {
        Object {
            kind: invariant.kind,
            point: invariant.point,
            direction: invariant.direction,
        }
    }
}

impl Object {
    pub fn moved(self, motion: &Pose) -> Object {
        Object {
            point: motion.transform_point(self.point),
            direction: motion.rotate(self.direction),
            ..self
        }
    }
}

/// A motion of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Factor {
    Joint(usize),
    /// M⁻¹.
    Target,
}

/// Motions that follow each other on the loop.
pub type Arc = Vec<Factor>;

/// The loop, and what is known of it.
#[derive(Clone)]
pub struct ClosedLoop<'a> {
    pub chain: &'a Chain,
    linkage: &'a Linkage,
    /// M⁻¹.
    closing: Pose,
    /// By joint.
    pub q: Vec<Option<f64>>,
    /// By run of parallel joints: the sum of its angles, about the axis of the
    /// first that turns.
    sums: Vec<Option<f64>>,
}

impl<'a> ClosedLoop<'a> {
    pub fn new(chain: &'a Chain, linkage: &'a Linkage, target: &Pose) -> Self {
        ClosedLoop {
            chain,
            linkage,
            closing: *chain.home() * target.inverse(),
            q: vec![None; chain.twists().len()],
            sums: vec![None; linkage.runs.len()],
        }
    }

    pub fn has_free_turn(&self) -> bool {
        self.linkage.has_free_turn
    }

    pub fn joints(&self) -> usize {
        self.q.len()
    }

    pub fn turns(&self, joint: usize) -> bool {
        self.chain.twists()[joint].angular != [0.0; 3]
    }

    /// Unit direction of a joint's axis, or of its travel; at home.
    pub fn direction(&self, joint: usize) -> Vec3 {
        let Twist { linear, angular } = self.chain.twists()[joint];
        if self.turns(joint) { angular } else { linear }
    }

    /// The point of a joint's axis nearest to the base.
    pub fn point(&self, joint: usize) -> Vec3 {
        let Twist { linear, angular } = self.chain.twists()[joint];
        cross(angular, linear)
    }

    fn run(&self, run: usize) -> impl Iterator<Item = usize> + '_ {
        let joints = self.linkage.runs[run].joints.clone();
        joints.filter(|&joint| self.turns(joint))
    }

    /// The first joint of an unknown and the end of its joints.
    pub fn extent(&self, unknown: Atom) -> (usize, usize) {
        match unknown {
            Atom::Joint(joint) => (joint, joint + 1),
            Atom::Sum { run, .. } => {
                let joints = &self.linkage.runs[run].joints;
                (joints.start, joints.end)
            }
        }
    }

    /// Direction and point of the axis that an unknown turns about.
    pub fn axis(&self, unknown: Atom) -> (Vec3, Vec3) {
        let (Atom::Joint(joint) | Atom::Sum { first: joint, .. }) = unknown;
        (self.direction(joint), self.point(joint))
    }

    pub fn set(&mut self, unknown: Atom, value: f64) {
        match unknown {
            Atom::Joint(joint) => self.q[joint] = Some(value),
            Atom::Sum { run, .. } => self.sums[run] = Some(value),
        }
    }

    /// What the other angles of a run leave of its sum for one of its joints.
    pub fn rest(&self, joint: usize) -> f64 {
        let run = self.linkage.run_of(joint);
        let about = self.run(run).next().map(|first| self.direction(first));
        let sense = |joint| dot(about.unwrap(), self.direction(joint)).signum();
        let others = self.run(run).filter(|&other| other != joint);
        let known: f64 = others.map(|j| sense(j) * self.q[j].unwrap()).sum();
        sense(joint) * (self.sums[run].unwrap() - known)
    }

    /// The motions onwards from link `from` to link `to`; links are counted
    /// from 0, the base, and n is the last.
    pub fn onwards(&self, from: usize, to: usize) -> Arc {
        (from..to).map(Factor::Joint).collect()
    }

    /// Onwards over the target, to a link in front.
    pub fn over_target(&self, from: usize, to: usize) -> Arc {
        let mut arc = self.onwards(from, self.joints());
        arc.push(Factor::Target);
        arc.extend(self.onwards(0, to));
        arc
    }

    /// An object behind an arc, as seen from in front of it. What is unknown on
    /// the way does not matter to the relation.
    pub fn transport(&self, arc: &[Factor], object: Object) -> Object {
        let mut behind = arc;
        let mut object = object;
        while let Some((last, rest)) = behind.split_last() {
            (object, behind) = match (*last, self.whole_run(behind, &object)) {
                (_, Some((turn, rest))) => (object.moved(&turn), rest),
                (Factor::Target, None) => (object.moved(&self.closing), rest),
                (Factor::Joint(joint), None) => {
                    let q = self.q[joint].unwrap_or(0.0);
                    (
                        object.moved(&Pose::exp(&self.chain.twists()[joint], q)),
                        rest,
                    )
                }
            };
        }
        object
    }

    /// An object in front of an arc, as seen from behind it.
    pub fn transport_back(&self, arc: &[Factor], object: Object) -> Object {
        // The inverse takes the point and the axes of any frame that it came from.
        let frame = |direction| Object {
            kind: object.kind,
            point: [0.0; 3],
            direction,
        };
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|axis| self.transport(arc, frame(axis)));
        let shifted = sub(object.point, axes[0].point);
        Object {
            kind: object.kind,
            point: axes.map(|axis| dot(axis.direction, shifted)),
            direction: axes.map(|axis| dot(axis.direction, object.direction)),
        }
    }

    /// If an arc ends with a whole run whose sum is known, and a direction is to
    /// cross it: its rotation, and the arc in front.
    fn whole_run<'f>(&self, arc: &'f [Factor], object: &Object) -> Option<(Pose, &'f [Factor])> {
        let Some(Factor::Joint(last)) = arc.last() else {
            return None;
        };
        let run = self.linkage.run_of(*last);
        let joints = self.linkage.runs[run].joints.clone();
        let whole = arc.ends_with(&self.onwards(joints.start, joints.end));
        if object.kind != Kind::Direction || !whole {
            return None;
        }
        let first = self.run(run).next()?;
        let about = Twist::revolute(self.direction(first), [0.0; 3]);
        let turn = Pose::exp(&about, self.sums[run]?);
        Some((turn, &arc[..arc.len() - joints.len()]))
    }
}
