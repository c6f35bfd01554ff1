//! Forward kinematics, Jacobians and singularities of a robot.

use super::Robot;
use kin_codegen::expr::{Lanes, Tape};
use kin_runtime::{Chain, JointLimit, Pose, Target, Twist};
use std::ops::Range;

impl Robot {
    /// What the file calls the robot.
    pub fn name(&self) -> &str {
        &self.arm.model.name
    }

    /// The link in whose frame poses are.
    pub fn base(&self) -> &str {
        &self.arm.model.base
    }

    /// The link whose poses are asked for.
    pub fn tip(&self) -> &str {
        &self.arm.model.tip
    }

    /// How many joint values a configuration has.
    pub fn joints(&self) -> usize {
        self.limits.len()
    }

    /// The joints' names in the file, in the order of `q`: from base to tip.
    pub fn joint_names(&self) -> Vec<&str> {
        let variables = self.arm.model.variables.iter();
        variables.map(|variable| variable.name.as_str()).collect()
    }

    /// The links that the joints move, in the order of [`Robot::fk_links`].
    pub fn link_names(&self) -> Vec<&str> {
        let model = &self.arm.model;
        let link = |i| model.joints[model.joint_of(i)].link.as_str();
        (0..self.joints()).map(link).collect()
    }

    /// The names of the links that are fixed to the base or a moving link; see
    /// [`Robot::fk_frame`].
    pub fn frame_names(&self) -> Vec<&str> {
        let frames = self.arm.model.frames.iter();
        frames.map(|frame| frame.name.as_str()).collect()
    }

    /// The joints' kinds and travel: radians, and metres of prismatic joints.
    pub fn limits(&self) -> &[JointLimit] {
        &self.limits
    }

    /// How fast the joints may move, rad/s and m/s; infinite where the file does not say.
    pub fn velocity_limits(&self) -> Vec<f64> {
        let variables = self.arm.model.variables.iter();
        variables
            .map(|it| it.rating.velocity.unwrap_or(f64::INFINITY))
            .collect()
    }

    /// What the joints' drives may exert, N m and N; infinite where the file does not say.
    pub fn effort_limits(&self) -> Vec<f64> {
        let variables = self.arm.model.variables.iter();
        variables
            .map(|it| it.rating.effort.unwrap_or(f64::INFINITY))
            .collect()
    }

    /// What of a target counts for inverse kinematics.
    pub fn target(&self) -> Target {
        self.arm.target()
    }

    /// The same arm as a product of exponentials, for its numerical search. Where joints mimic
    /// others it has all of them, and they move by themselves.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// The pose of the tip in the base frame, metres, at joint values `q`, radians and metres.
    ///
    /// # Panics
    ///
    /// `q` has not as many values as the robot has [joints](Robot::joints); so have all methods.
    pub fn fk(&self, q: &[f64]) -> Pose {
        self.check(q);
        pose(&self.tip.run::<1>(q, 0), 0)
    }

    /// The pose of every link that a joint moves, in the base frame; see
    /// [`Robot::link_names`].
    pub fn fk_links(&self, q: &[f64]) -> Vec<Pose> {
        self.poses(self.links(), q)
    }

    /// The pose of the link of this name in the base frame: the base, the tip, one that a joint
    /// moves, or one that is fixed to any of these. None if there is none.
    pub fn fk_frame(&self, q: &[f64], name: &str) -> Option<Pose> {
        let model = &self.arm.model;
        let link = self.link_names().iter().position(|&link| link == name);
        match link {
            _ if name == model.base => Some(Pose::IDENTITY),
            Some(link) => Some(self.fk_links(q)[link]),
            None => {
                let frame = model.frames.iter().find(|frame| frame.name == name)?;
                let Some(carrier) = frame.joint else {
                    return Some(frame.pose);
                };
                // By the product of exponentials: joints that mimic others have no link above.
                let moves = model.joints[..=carrier].iter().map(|joint| {
                    let value = joint.multiplier * q[joint.variable] + joint.offset;
                    Pose::exp(&joint.twist(), value)
                });
                let moved = moves.fold(Pose::IDENTITY, |before, motion| before * motion);
                Some(moved * model.joints[carrier].frame * frame.pose)
            }
        }
    }

    /// The pose of the tip and the columns of the spatial Jacobian, which share most of the work.
    pub fn fk_jacobian(&self, q: &[f64]) -> (Pose, Vec<Twist>) {
        self.check(q);
        let values = self.jacobians().both.run::<1>(q, 0);
        (
            pose(&values, 0),
            columns(&values, 12..self.jacobians().both.outputs()),
        )
    }

    /// The columns of the spatial Jacobian (MLS section 3.4).
    pub fn spatial_jacobian(&self, q: &[f64]) -> Vec<Twist> {
        match &self.jacobians().spatial {
            Some(tape) => self.columns(tape, q),
            None => self.fk_jacobian(q).1,
        }
    }

    /// The columns of the body Jacobian (MLS section 3.4).
    pub fn body_jacobian(&self, q: &[f64]) -> Vec<Twist> {
        self.columns(&self.jacobians().body, q)
    }

    /// The columns of the geometric Jacobian: the velocity of the tip's origin and the angular
    /// velocity, both in base axes. What ROS calls the Jacobian.
    pub fn geometric_jacobian(&self, q: &[f64]) -> Vec<Twist> {
        self.columns(&self.jacobians().geometric, q)
    }

    /// The determinant of the Jacobian, or of its rows that count for targets, 0 where the robot
    /// is singular; none where these are not square.
    pub fn jacobian_determinant(&self, q: &[f64]) -> Option<f64> {
        self.check(q);
        let tape = self.singular()?;
        Some(tape.run::<1>(q, 0).output(0)[0])
    }

    /// How far from each of its singularities the robot is: the factors of the determinant, by
    /// name. Empty where they are not known.
    pub fn singularities(&self, q: &[f64]) -> Vec<(&str, f64)> {
        self.check(q);
        let both = self.arm.singular().zip(self.singular());
        let Some((singular, tape)) = both else {
            return Vec::new();
        };
        let values = tape.run::<1>(q, 0);
        let all = singular.singularities.iter().enumerate();
        all.map(|(i, it)| (it.name.as_str(), values.output(i + 1)[0]))
            .collect()
    }

    pub(super) fn check(&self, q: &[f64]) {
        assert_eq!(q.len(), self.joints(), "one value for each joint");
    }

    /// The poses that a tape computes, entry by entry.
    fn poses(&self, tape: &Tape, q: &[f64]) -> Vec<Pose> {
        self.check(q);
        let values = tape.run::<1>(q, 0);
        (0..tape.outputs())
            .step_by(12)
            .map(|first| pose(&values, first))
            .collect()
    }

    fn columns(&self, tape: &Tape, q: &[f64]) -> Vec<Twist> {
        self.check(q);
        columns(&tape.run::<1>(q, 0), 0..tape.outputs())
    }
}

/// The twists whose entries are some outputs.
fn columns(values: &Lanes<1>, outputs: Range<usize>) -> Vec<Twist> {
    let part = |first: usize| std::array::from_fn(|i| values.output(first + i)[0]);
    let column = |first: usize| Twist {
        linear: part(first),
        angular: part(first + 3),
    };
    outputs.step_by(6).map(column).collect()
}

/// The pose whose entries begin with this output.
pub(super) fn pose(values: &Lanes<1>, first: usize) -> Pose {
    pose_of(values, first, 0)
}

/// The same of one lane.
pub(super) fn pose_of<const L: usize>(values: &Lanes<L>, first: usize, lane: usize) -> Pose {
    let at = |i: usize| values.output(first + i)[lane];
    Pose {
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| at(3 * i + j))),
        translation: std::array::from_fn(|i| at(9 + i)),
    }
}
