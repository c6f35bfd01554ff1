//! Robots with more joints than their targets have coordinates.

use super::of_joints::{OfJoints, array, with_constant, with_room};
use super::{Answers, Robot};
use kin_codegen::closed_form::BranchSolution;
use kin_codegen::redundancy::Redundancy;
use kin_runtime::{
    Criterion, FeasibleInterval, Follow, JointLimit, Kinematics, Parameter, PathStep, Pose,
    RedundantKinematics,
};

impl Robot {
    /// How many numbers [`Robot::ik_at`] is given beside a target; 0 where a target has isolated
    /// solutions.
    pub fn parameters(&self) -> usize {
        let redundancy = self.arm.redundancy.as_ref();
        redundancy.map_or(0, Redundancy::parameters)
    }

    /// What the parameter of this place is.
    pub fn parameter(&self, place: usize) -> Option<Parameter> {
        let redundancy = self.arm.redundancy.as_ref()?;
        let joints = redundancy.joints.iter().copied().map(Parameter::Joint);
        let swivel = redundancy.swivel.as_ref();
        let swivel = swivel.map(|it| Parameter::Swivel(it.at_run_time(&self.arm.model)));
        let turn = redundancy.turn.then_some(Parameter::Turn);
        joints.chain(swivel).chain(turn).nth(place)
    }

    /// What these numbers are: the names of joints, `swivel` for the swivel angle, `turn` for the
    /// turn of the tool about the tip's z axis (which [`RobotOptions::free`](crate::RobotOptions)
    /// does not take: the target leaves it free); in the order in which they are given.
    pub fn parameter_names(&self) -> Vec<&str> {
        let names = self.joint_names();
        let name = |place| match self.parameter(place)? {
            Parameter::Joint(joint) => Some(names[joint]),
            Parameter::Swivel(_) => Some("swivel"),
            Parameter::Turn => Some("turn"),
        };
        (0..self.parameters()).filter_map(name).collect()
    }

    /// How many branches [`Robot::ik_at`] looks at; 0 of a robot without
    /// [parameters](Robot::parameters).
    pub fn branches_at(&self) -> usize {
        let form = self.arm.form().filter(|_| self.parameters() > 0);
        form.map_or(0, |form| form.plan.branches())
    }

    pub(super) fn has_turn(&self) -> bool {
        self.arm.redundancy.as_ref().is_some_and(|it| it.turn)
    }

    /// What [`Robot::ik_at`] has to be given with `pose` to have `q` among its solutions, if that
    /// puts the tip there.
    pub fn redundancy(&self, pose: &Pose, q: &[f64]) -> Vec<f64> {
        self.check(q);
        let value = |place| match self.parameter(place)? {
            Parameter::Joint(joint) => Some(q[joint]),
            Parameter::Turn => Some(pose.turn_to(&self.fk(q))),
            Parameter::Swivel(swivel) => {
                with_constant!(self.joints(), N => {
                    let links = OfJoints::<N>::new(self).fk_links(array(q));
                    swivel.angle(&links, &self.fk(q))
                })
            }
        };
        (0..self.parameters()).filter_map(value).collect()
    }

    /// The robot along its one parameter.
    ///
    /// # Panics
    ///
    /// It has none, or several: see [`Robot::along`].
    pub fn along_parameter(&self) -> AlongParameter<'_> {
        assert_eq!(self.parameters(), 1, "a robot with one parameter");
        self.along(0, &[0.0])
    }

    /// The robot along the parameter of this place, with the others held at these values, of which
    /// that one's is not read.
    ///
    /// # Panics
    ///
    /// There are not as many values as [parameters](Robot::parameters), or not so many
    /// parameters.
    pub fn along(&self, place: usize, held: &[f64]) -> AlongParameter<'_> {
        assert_eq!(held.len(), self.parameters(), "a value for each parameter");
        assert!(place < held.len(), "a parameter of the robot");
        AlongParameter {
            robot: self,
            place,
            held: held.to_vec(),
        }
    }
}

/// A robot along one of its parameters; see [`Robot::along`] and [`RedundantKinematics`].
///
/// ```
/// use kinematics::{Criterion, Robot};
/// let arm = Robot::from_yaml("robots/panda.yaml")?;
/// let pose = arm.fk(&[0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6]);
/// let along = arm.along_parameter();
/// let intervals = along.feasible(&pose);
/// assert!(intervals.iter().any(|interval| interval.contains(0.6)));
/// assert!(along.ik_sweep(&pose, 16).iter().any(|solutions| !solutions.is_empty()));
/// let best = along.ik_best(&pose, &Criterion::<7>::FarthestFromLimits).unwrap();
/// assert!(arm.limits().iter().zip(best).all(|(it, x)| (it.lower()..=it.upper()).contains(&x)));
/// # Ok::<(), kinematics::LoadError>(())
/// ```
#[derive(Clone, Debug)]
pub struct AlongParameter<'a> {
    robot: &'a Robot,
    place: usize,
    held: Vec<f64>,
}

/// An interval of a parameter in which a branch of solutions exists.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval {
    /// Its lower end, radians in (−π, π], or metres.
    pub from: f64,
    /// Its upper end, which may be beyond π.
    pub to: f64,
    /// Whether the parameter is an angle, and no way in metres.
    pub is_angle: bool,
    /// Whether the branch goes on from the upper end at the lower.
    pub is_closed: bool,
    /// The configuration of the branch in the middle of the interval, by which it is told from
    /// others.
    pub middle: Vec<f64>,
}

impl Interval {
    fn of<const N: usize>(joints: usize, interval: &FeasibleInterval<N>) -> Self {
        Self {
            from: interval.from,
            to: interval.to,
            is_angle: interval.is_angle,
            is_closed: interval.is_closed,
            middle: interval.middle[..joints].to_vec(),
        }
    }

    /// Whether a value of the parameter is in it: of an angle, up to full turns.
    pub fn contains(&self, parameter: f64) -> bool {
        let own = FeasibleInterval {
            from: self.from,
            to: self.to,
            is_angle: self.is_angle,
            is_closed: self.is_closed,
            middle: [],
        };
        own.contains(parameter)
    }
}

impl AlongParameter<'_> {
    /// The robot of N joints, with what is held.
    fn of_joints<const N: usize, T>(
        &self,
        pose: &Pose,
        run: impl FnOnce(OfJoints<N>, &Pose) -> T,
    ) -> T {
        run(OfJoints::along(self.robot, self.place, &self.held), pose)
    }

    /// All solutions at a value of the parameter, radians or metres.
    pub fn ik_at(&self, pose: &Pose, parameter: f64) -> Answers {
        let mut all = self.held.clone();
        all[self.place] = parameter;
        self.robot.ik_at(pose, &all)
    }

    /// The solutions at so many values of the parameter, evenly spaced over a turn, or over the
    /// travel of a prismatic joint.
    pub fn ik_sweep(&self, pose: &Pose, count: usize) -> Vec<Answers> {
        let joints = self.robot.joints();
        with_room!(joints, N => {
            self.of_joints::<N, _>(pose, |arm, pose| {
                let each = arm.ik_sweep(pose, count);
                each.map(|solutions| Answers::of(joints, &solutions)).collect()
            })
        })
        .unwrap_or_default()
    }

    /// The intervals of the parameter in which each branch of solutions exists; see
    /// [`RedundantKinematics::feasible`].
    pub fn feasible(&self, pose: &Pose) -> Vec<Interval> {
        let joints = self.robot.joints();
        with_room!(joints, N => self.of_joints::<N, _>(pose, |arm, pose| {
            let intervals = arm.feasible(pose);
            intervals.iter().map(|interval| Interval::of(joints, interval)).collect()
        }))
        .unwrap_or_default()
    }

    /// The same as far as all joints are within limits; angles may be wound by full turns to be.
    ///
    /// # Panics
    ///
    /// There is not a limit for each joint.
    pub fn feasible_within(&self, pose: &Pose, limits: &[JointLimit]) -> Vec<Interval> {
        let joints = self.robot.joints();
        assert_eq!(limits.len(), joints, "a limit for each joint");
        let limit = |i| limits.get(i).copied().unwrap_or(JointLimit::Continuous);
        with_room!(joints, N => self.of_joints::<N, _>(pose, |arm, pose| {
            let intervals = arm.feasible_within(pose, &std::array::from_fn(limit));
            intervals.iter().map(|interval| Interval::of(joints, interval)).collect()
        }))
        .unwrap_or_default()
    }

    /// The best configuration within the robot's limits, of all values of the parameter; none if
    /// there is none within limits.
    ///
    /// # Panics
    ///
    /// N is not the number of joints.
    pub fn ik_best<const N: usize>(
        &self,
        pose: &Pose,
        criterion: &Criterion<N>,
    ) -> Option<[f64; N]> {
        assert_eq!(N, self.robot.joints(), "a criterion for all joints");
        self.of_joints(pose, |arm: OfJoints<N>, pose| arm.ik_best(pose, criterion))
    }

    /// The next configuration along a path of targets; see [`RedundantKinematics::ik_follow`].
    ///
    /// # Panics
    ///
    /// N is not the number of joints.
    pub fn ik_follow<const N: usize>(
        &self,
        pose: &Pose,
        from: &[f64; N],
        how: &Follow<N>,
    ) -> Option<PathStep<N>> {
        self.robot.check(from);
        self.of_joints(pose, |arm, pose| arm.ik_follow(pose, from, how))
    }

    /// As [`Robot::ik_nearest_at`], at a value of the parameter.
    pub fn ik_nearest_at(
        &self,
        pose: &Pose,
        parameter: f64,
        seed: &[f64],
    ) -> Option<BranchSolution> {
        let mut all = self.held.clone();
        all[self.place] = parameter;
        self.robot.ik_nearest_at(pose, &all, seed)
    }
}
