//! The swivel of an arm with a spherical shoulder and a spherical wrist.

use super::linkage::short;
use super::{Vec3, axes, concurrency, conditioning, cross, dot, norm, size, sub};
use crate::model::Model;
use kin_runtime::{Chain, Pose, Target, Twist};

/// An elbow or wrist nearer to where it would turn nothing is none; of the arm's size.
const APART: f64 = 1e-3;
/// Which joints make up the shoulder; the next one is the elbow's, and those behind it are the
/// wrist's.
const SHOULDER: std::ops::Range<usize> = 0..3;
const WRIST: std::ops::Range<usize> = 4..7;

/// Shoulder, elbow and wrist at home, in base coordinates, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swivel {
    /// Where the first three axes meet.
    pub shoulder: Vec3,
    /// The point of the third axis next to the fourth.
    pub elbow: Vec3,
    /// Where the last three axes meet.
    pub wrist: Vec3,
    /// The direction of the first axis.
    pub reference: Vec3,
}

impl Swivel {
    /// The joints that leave the shoulder alone.
    pub const SHOULDER: std::ops::Range<usize> = SHOULDER;
    /// The joints that leave the wrist alone.
    pub const WRIST: std::ops::Range<usize> = WRIST;
    /// The joint that leaves the elbow alone, behind two that turn it about the shoulder.
    pub const ELBOW: usize = 2;

    /// Of seven joints that turn, of which the first three and the last three meet in a point
    /// each, to within `near`: radians, and multiples of the arm's size.
    pub fn of(model: &Model, near: f64) -> Option<Self> {
        let turns = |i: usize| model.joints[i].is_revolute();
        if model.joints.len() != 7 || model.is_coupled() || !(0..7).all(turns) {
            return None;
        }
        let (lines, size) = (axes(model), size(model));
        let shoulder = concurrency(&lines[SHOULDER], near, near * size)?;
        let wrist = concurrency(&lines[WRIST], near, near * size)?;
        let (upper, across) = (&lines[Self::ELBOW], &lines[Self::ELBOW + 1]);
        let elbow = upper.foot(across);
        let bends = norm(cross(upper.direction, across.direction)) > APART;
        let upper_arm = norm(sub(elbow, shoulder)) > APART * size;
        let forearm = norm(across.offset_of(wrist)) > APART * size;
        (bends && upper_arm && forearm).then_some(Self {
            shoulder,
            elbow,
            wrist,
            reference: lines[0].direction,
        })
    }

    /// As generated code has it.
    pub fn at_run_time(&self, model: &Model) -> kin_runtime::Swivel {
        let link = Self::ELBOW;
        let there = |frame: &Pose, point| frame.inverse().transform_point(point).map(short);
        kin_runtime::Swivel {
            shoulder: self.shoulder,
            link,
            elbow: there(&model.joints[link].frame, self.elbow),
            wrist: there(&model.home, self.wrist),
            reference: self.reference,
        }
    }

    /// The swivel angle of a configuration, by the product of exponentials of unit twists.
    pub fn angle(&self, chain: &Chain, q: &[f64]) -> f64 {
        let (elbow, wrist) = self.points(chain, q);
        let swivel = self.seen_from_home(&Pose::IDENTITY);
        swivel.of_points(elbow, wrist)
    }

    /// How far a configuration is from singular for whole poses and the swivel angle together,
    /// and from where that angle is not defined.
    pub fn conditioning(&self, chain: &Chain, q: &[f64], size: f64) -> f64 {
        let (elbow, wrist) = self.points(chain, q);
        let (gradient, radius) = self.seen_from_home(&Pose::IDENTITY).gradient(elbow, wrist);
        // In place of the angle the way of the elbow along its circle, which has no pole.
        let along = gradient.map(|x| x * radius);
        let way = |joint: usize| match joint {
            joint if joint <= Self::ELBOW => {
                let twist = chain
                    .displacement(0..joint, q)
                    .adjoint(&chain.twists()[joint]);
                let moved = cross(twist.angular, elbow);
                dot(along, [0, 1, 2].map(|i| twist.linear[i] + moved[i])) / size
            }
            _ => 0.0,
        };
        let way: Vec<f64> = (0..q.len()).map(way).collect();
        let forearm = sub(wrist, self.shoulder);
        let pole = norm(cross(forearm, self.reference)) / size;
        conditioning::with_row(chain, q, size, Target::Pose, &way)
            .min(pole)
            .min(radius / size)
    }

    /// Elbow and wrist of a configuration, base coordinates.
    fn points(&self, chain: &Chain, q: &[f64]) -> (Vec3, Vec3) {
        let behind = |joints: usize| chain.displacement(0..joints, q);
        let elbow = behind(Self::ELBOW + 1).transform_point(self.elbow);
        let wrist = behind(q.len()).transform_point(self.wrist);
        (elbow, wrist)
    }

    /// With links whose frames are the base's at home; the tip is at `tip` there.
    pub fn seen_from_home(&self, tip: &Pose) -> kin_runtime::Swivel {
        kin_runtime::Swivel {
            shoulder: self.shoulder,
            link: Self::ELBOW,
            elbow: self.elbow,
            wrist: tip.inverse().transform_point(self.wrist),
            reference: self.reference,
        }
    }

    /// Those links, as far as the elbow's.
    pub fn links<const N: usize>(&self, twists: &[Twist], q: &[f64; N]) -> [Pose; N] {
        let mut here = Pose::IDENTITY;
        std::array::from_fn(|joint| {
            if joint <= Self::ELBOW {
                here = here * Pose::exp(&twists[joint], q[joint]);
            }
            here
        })
    }
}
