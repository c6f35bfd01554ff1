//! Inverse kinematics of a robot.

use super::{Answers, Robot};
use kin_codegen::closed_form::ClosedForm;
use kin_codegen::redundancy::Redundancy;
use kin_runtime::__private::Locked;
use kin_runtime::{JointLimit, Nearest, Pose, Solution, Solutions};

/// Evaluates an expression with a number that is known at run time, 1 to 8, as a constant.
macro_rules! with_constant {
    ($n:expr, $constant:ident => $body:expr) => {
        with_constant!($n, $constant => $body, 1 2 3 4 5 6 7 8)
    };
    ($n:expr, $constant:ident => $body:expr, $($value:literal)*) => {
        match $n {
            $($value => {
                const $constant: usize = $value;
                $body
            })*
            _ => Default::default(),
        }
    };
}

impl Robot {
    /// How many branches inverse kinematics looks at; 0 without it.
    pub fn branches(&self) -> usize {
        self.arm.form().map_or(0, |form| form.plan.branches())
    }

    /// How many numbers [`Robot::ik_at`] is given beside a target; 0 where a target has isolated
    /// solutions.
    pub fn parameters(&self) -> usize {
        self.arm
            .redundancy
            .as_ref()
            .map_or(0, Redundancy::parameters)
    }

    /// What these numbers are: the names of joints, `swivel` for the swivel angle, `turn` for the
    /// turn of the tool about the tip's z axis; in the order in which they are given.
    pub fn parameter_names(&self) -> Vec<&str> {
        let Some(redundancy) = &self.arm.redundancy else {
            return Vec::new();
        };
        let names = self.joint_names();
        let joints = redundancy.joints.iter().map(|&joint| names[joint]);
        let swivel = redundancy.swivel.is_some().then_some("swivel");
        let turn = redundancy.turn.then_some("turn");
        joints.chain(swivel).chain(turn).collect()
    }

    /// All solutions for a pose of the tip in the base frame, as far as it counts. Limits are not
    /// applied. Empty for a robot with [parameters](Robot::parameters), or loaded without
    /// inverse kinematics.
    pub fn ik(&self, pose: &Pose) -> Answers {
        match self.parameters() {
            0 => self.ik_at(pose, &[]),
            _ => Answers::default(),
        }
    }

    /// All solutions with these values of the joints that stay free, of the swivel angle and of
    /// the turn of the tool, in this order; radians and metres.
    ///
    /// # Panics
    ///
    /// There are not as many as [`Robot::parameters`].
    pub fn ik_at(&self, pose: &Pose, parameters: &[f64]) -> Answers {
        let n = self.joints();
        with_constant!(n, N => (&self.solutions::<N>(pose, parameters, None)).into())
    }

    /// The solution that moves the joints least from `seed`, inside the limits and with full
    /// turns where these lead there; an angle that a singular target leaves free keeps its value
    /// in `seed`. None if there is none.
    pub fn ik_nearest(&self, pose: &Pose, seed: &[f64]) -> Option<NearestAnswer> {
        match self.parameters() {
            0 => self.ik_nearest_at(pose, &[], seed),
            _ => None,
        }
    }

    /// The same among the solutions with these parameters.
    pub fn ik_nearest_at(
        &self,
        pose: &Pose,
        parameters: &[f64],
        seed: &[f64],
    ) -> Option<NearestAnswer> {
        self.check(seed);
        with_constant!(self.joints(), N => {
            let seed: [f64; N] = std::array::from_fn(|i| seed[i]);
            let limits: [JointLimit; N] = std::array::from_fn(|i| self.limits[i]);
            let solutions = self.solutions::<N>(pose, parameters, Some(&seed));
            let nearest = solutions.nearest_by(&Nearest::new(seed, &limits));
            nearest.as_ref().map(NearestAnswer::of)
        })
    }

    /// What [`Robot::ik_at`] has to be given with `pose` to have `q` among its solutions, if that
    /// puts the tip there.
    pub fn redundancy(&self, pose: &Pose, q: &[f64]) -> Vec<f64> {
        self.check(q);
        let (Some(form), Some(redundancy)) = (self.arm.form(), &self.arm.redundancy) else {
            return Vec::new();
        };
        let (mut parameters, _) = form.split(q);
        if redundancy.turn {
            parameters.push(pose.turn_to(&self.fk(q)));
        }
        parameters
    }

    /// The solutions of a robot of N joints.
    fn solutions<const N: usize>(
        &self,
        pose: &Pose,
        parameters: &[f64],
        seed: Option<&[f64; N]>,
    ) -> Solutions<N> {
        assert_eq!(
            parameters.len(),
            self.parameters(),
            "what is given beside a target"
        );
        let Some(form) = self.arm.form() else {
            return Solutions::new();
        };
        let Some(redundancy) = &self.arm.redundancy else {
            return form.solved_near(pose, &[], seed);
        };
        let (parameters, pose) = match parameters.split_last() {
            Some((&turn, rest)) if redundancy.turn => (rest, pose.turned(turn)),
            _ => (parameters, *pose),
        };
        match redundancy.joints[..] {
            [] if redundancy.swivel.is_some() => {
                self.widened([], form.solved_at_swivel(&pose, parameters), parameters)
            }
            [] => form.solved(&pose, &[]),
            [joint] => self.with_locked([joint], form, &pose, parameters),
            [one, other] => self.with_locked([one, other], form, &pose, parameters),
            _ => Solutions::new(),
        }
    }

    fn with_locked<const K: usize, const N: usize>(
        &self,
        joints: [usize; K],
        form: &ClosedForm,
        pose: &Pose,
        parameters: &[f64],
    ) -> Solutions<N> {
        with_constant!(N - K, M => {
            self.widened(joints, form.solved::<M>(pose, parameters), parameters)
        })
    }

    /// Solutions of M joints with the K that are given among them.
    fn widened<const K: usize, const M: usize, const N: usize>(
        &self,
        joints: [usize; K],
        solutions: Solutions<M>,
        parameters: &[f64],
    ) -> Solutions<N> {
        let slides = (0..N).filter(|&i| !self.limits[i].is_revolute());
        let prismatic = slides.fold(0, |mask, i| mask | 1 << i);
        let values = std::array::from_fn(|k| parameters[k]);
        Locked::new(joints, values, prismatic).all(&solutions)
    }
}

/// The one solution that was asked for.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NearestAnswer {
    /// Joint values within the limits, radians and metres.
    pub q: Vec<f64>,
    /// The distance of its pose from the target, metres.
    pub residual: f64,
    /// Which combination of roots it is.
    pub branch: u32,
    /// Whether it stands for a family of solutions, or for two that have met.
    pub singular: bool,
}

impl NearestAnswer {
    fn of<const N: usize>(solution: &Solution<N>) -> Self {
        Self {
            q: solution.q.to_vec(),
            residual: solution.residual,
            branch: solution.branch,
            singular: solution.singular,
        }
    }
}
