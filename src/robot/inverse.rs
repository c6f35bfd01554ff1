//! Inverse kinematics of a robot.

use super::of_joints::{OfJoints, array, with_constant, with_room};
use super::{Answers, Robot};
use kin_codegen::closed_form::BranchSolution;
use kin_runtime::__private::math;
use kin_runtime::{
    Kinematics, Nearest, NoPath, NoSolution, Path, Pose, RedundantKinematics, Solution, Solutions,
    ik_path,
};

impl Robot {
    /// How many branches [`Robot::ik`] looks at; 0 of a robot with
    /// [parameters](Robot::parameters), or without inverse kinematics.
    pub fn branches(&self) -> usize {
        self.arm.branches()
    }

    /// All solutions for a pose of the tip in the base frame, as far as it counts. Limits are not
    /// applied. Empty for a robot with [parameters](Robot::parameters), or loaded without
    /// inverse kinematics.
    pub fn ik(&self, pose: &Pose) -> Answers {
        with_constant!(self.joints(), N => (&OfJoints::<N>::new(self).ik(pose)).into())
            .unwrap_or_default()
    }

    /// The same; a joint that a singular target leaves free keeps its value in `seed`, so that
    /// solutions along a path are continuous.
    pub fn ik_seeded(&self, pose: &Pose, seed: &[f64]) -> Answers {
        self.check(seed);
        with_constant!(self.joints(), N => {
            (&OfJoints::<N>::new(self).ik_seeded(pose, array(seed))).into()
        })
        .unwrap_or_default()
    }

    /// All solutions for each of many poses, as [`Robot::ik`] has them: four of an arm with a
    /// closed form are computed side by side.
    pub fn ik_batch(&self, poses: &[Pose]) -> Vec<Answers> {
        let Some(form) = self.arm.form().filter(|_| self.parameters() == 0) else {
            return poses.iter().map(|pose| self.ik(pose)).collect();
        };
        let mut all = Vec::with_capacity(poses.len());
        with_constant!(self.joints(), N => {
            let targets = poses.iter().map(|pose| (pose, &[][..]));
            form.solved_each::<N>(targets, |solutions| all.push((&solutions).into()));
        });
        all
    }

    /// A solution if there is one, and for a target out of reach the least-squares solution of the
    /// subproblems, or where a polynomial solves the arm what no small motion brings nearer, with its
    /// distance as the residual. None if the target is not a number, and of a robot with
    /// [parameters](Robot::parameters).
    pub fn ik_approximate(&self, pose: &Pose) -> Option<BranchSolution> {
        with_constant!(self.joints(), N => {
            let found = OfJoints::<N>::new(self).ik_approximate(pose);
            found.as_ref().map(BranchSolution::of)
        })?
    }

    /// The solution that moves the joints least from `seed`, inside the limits and with full
    /// turns where these lead there; a joint that a singular target leaves free keeps its value
    /// in `seed`. None if there is none.
    pub fn ik_nearest(&self, pose: &Pose, seed: &[f64]) -> Option<BranchSolution> {
        self.check(seed);
        with_constant!(self.joints(), N => {
            let found = OfJoints::<N>::new(self).ik_nearest(pose, array(seed));
            found.as_ref().map(BranchSolution::of)
        })?
    }

    /// As [`Robot::ik_nearest`], by limits, weights of the joints and bounds on their steps that
    /// are given, with the reason if there is none.
    ///
    /// ```
    /// use kinematics::{Nearest, NoSolution, Robot};
    /// let arm = Robot::from_urdf("robots/ur5e.urdf")?;
    /// let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    /// let limits = arm.limits().try_into().expect("six joints");
    /// let mut nearest = Nearest::<6>::new(q, limits);
    /// nearest.step = [0.1; 6]; // radians
    /// let mut pose = arm.fk(&q);
    /// assert!(arm.try_ik_nearest(&pose, &nearest).is_ok());
    /// pose.translation[2] += 3.0;
    /// let far = arm.try_ik_nearest(&pose, &nearest);
    /// assert!(matches!(far, Err(NoSolution::OutOfReach { .. })));
    /// # Ok::<(), kinematics::LoadError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Out of reach, no rotation, outside limits, or beyond a step, for which the reason takes some
    /// microseconds; or the robot has [parameters](Robot::parameters), or was loaded without inverse
    /// kinematics.
    ///
    /// # Panics
    ///
    /// N is not the number of [joints](Robot::joints).
    pub fn try_ik_nearest<const N: usize>(
        &self,
        pose: &Pose,
        nearest: &Nearest<N>,
    ) -> Result<Solution<N>, NoSolution<N>> {
        self.check(&nearest.seed);
        self.has_isolated_solutions()?;
        OfJoints::new(self).try_ik_nearest(pose, nearest)
    }

    /// The sequence of solutions for targets that moves the joints least in total; see
    /// [`ik_path`].
    ///
    /// ```
    /// use kinematics::{Nearest, Pose, Robot};
    /// let arm = Robot::from_urdf("robots/ur5e.urdf")?;
    /// let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    /// // 10 cm upwards, in steps of 1 cm.
    /// let step = |i: u8| Pose::from_translation([0.0, 0.0, 0.01 * f64::from(i)]) * arm.fk(&q);
    /// let targets: Vec<Pose> = (0..=10).map(step).collect();
    /// let mut nearest = Nearest::<6>::new(q, arm.limits().try_into()?);
    /// nearest.step = [0.1; 6]; // radians
    /// let path = arm.ik_path(&targets, &nearest)?;
    /// assert_eq!(path.solutions.len(), 11);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Where the path cannot go on, and why, as [`Robot::try_ik_nearest`].
    ///
    /// # Panics
    ///
    /// N is not the number of [joints](Robot::joints).
    pub fn ik_path<const N: usize>(
        &self,
        targets: &[Pose],
        nearest: &Nearest<N>,
    ) -> Result<Path<N>, NoPath<N>> {
        self.check(&nearest.seed);
        let nowhere = |reason| NoPath { target: 0, reason };
        self.has_isolated_solutions().map_err(nowhere)?;
        ik_path(&OfJoints::new(self), targets, nearest)
    }

    /// Whether targets have solutions without a parameter.
    fn has_isolated_solutions<const N: usize>(&self) -> Result<(), NoSolution<N>> {
        match self.parameters() {
            0 if self.arm.form().is_none() => Err(NoSolution::WithoutInverse),
            0 => Ok(()),
            count => Err(NoSolution::NeedsParameters { count }),
        }
    }

    /// Whether [`Robot::ik`] has a solution, which it never has of a robot with
    /// [parameters](Robot::parameters): [`Robot::along`] tells intervals of them.
    pub fn is_reachable_pose(&self, pose: &Pose) -> bool {
        !self.ik(pose).is_empty()
    }

    /// All solutions with these values of the joints that stay free, of the swivel angle and of
    /// the turn of the tool, in this order; radians and metres.
    ///
    /// # Panics
    ///
    /// There are not as many as [`Robot::parameters`].
    pub fn ik_at(&self, pose: &Pose, parameters: &[f64]) -> Answers {
        let joints = self.joints();
        self.check_parameters(parameters);
        if parameters.is_empty() {
            return self.ik(pose);
        }
        with_room!(joints, N => {
            Answers::of(joints, &self.solutions::<N>(pose, parameters, None))
        })
        .unwrap_or_default()
    }

    /// The same; a joint that a singular target leaves free keeps its value in `seed` (radians,
    /// metres).
    ///
    /// # Panics
    ///
    /// As [`Robot::ik_at`], or `seed` has not a value for each joint.
    pub fn ik_seeded_at(&self, pose: &Pose, parameters: &[f64], seed: &[f64]) -> Answers {
        self.check(seed);
        self.check_parameters(parameters);
        if parameters.is_empty() {
            return self.ik_seeded(pose, seed);
        }
        let joints = self.joints();
        with_room!(joints, N => {
            let seed: [f64; N] = std::array::from_fn(|i| seed.get(i).copied().unwrap_or_default());
            Answers::of(joints, &self.solutions::<N>(pose, parameters, Some(&seed)))
        })
        .unwrap_or_default()
    }

    /// As [`Robot::ik_nearest`], among the solutions with these parameters.
    pub fn ik_nearest_at(
        &self,
        pose: &Pose,
        parameters: &[f64],
        seed: &[f64],
    ) -> Option<BranchSolution> {
        self.check(seed);
        self.check_parameters(parameters);
        if parameters.is_empty() {
            return self.ik_nearest(pose, seed);
        }
        with_room!(self.joints(), N => {
            let seed: [f64; N] = std::array::from_fn(|i| seed.get(i).copied().unwrap_or_default());
            let limits = OfJoints::<N>::new(self).own_limits();
            let solutions = self.solutions::<N>(pose, parameters, Some(&seed));
            let nearest = solutions.nearest_by(&Nearest::new(seed, &limits))?;
            Some(BranchSolution {
                q: nearest.q[..self.joints()].to_vec(),
                ..BranchSolution::of(&nearest)
            })
        })?
    }

    /// As [`Robot::try_ik_nearest`], among the solutions with a parameter.
    ///
    /// # Errors
    ///
    /// Why there is none: no solution at this parameter, none within limits, or none that a
    /// step leads to.
    ///
    /// # Panics
    ///
    /// N is not the number of [joints](Robot::joints), or the robot has not one
    /// [parameter](Robot::parameters), or another number of them is given.
    pub fn try_ik_nearest_at<const N: usize>(
        &self,
        pose: &Pose,
        parameters: &[f64],
        nearest: &Nearest<N>,
    ) -> Result<Solution<N>, NoSolution<N>> {
        self.check(&nearest.seed);
        assert_eq!(self.parameters(), 1, "a robot with one parameter");
        let &[parameter] = parameters else {
            panic!("{} values of one parameter", parameters.len());
        };
        OfJoints::new(self).try_ik_nearest_at(pose, parameter, nearest)
    }

    /// The solutions of a robot of N joints without parameters.
    pub(super) fn isolated<const N: usize>(
        &self,
        pose: &Pose,
        seed: Option<&[f64; N]>,
    ) -> Solutions<N> {
        let form = self.arm.form().filter(|_| self.parameters() == 0);
        form.map_or_else(Solutions::new, |form| form.solved_near(pose, &[], seed))
    }

    /// The target with the turn of the tool, if that is a parameter, and the others.
    pub(super) fn turned<'a>(&self, pose: &Pose, parameters: &'a [f64]) -> (Pose, &'a [f64]) {
        match parameters.split_last() {
            Some((&turn, others)) if self.has_turn() => (pose.turned(turn), others),
            _ => (*pose, parameters),
        }
    }

    fn check_parameters(&self, parameters: &[f64]) {
        assert_eq!(
            parameters.len(),
            self.parameters(),
            "what is given beside a target"
        );
    }

    /// The solutions of a robot of N joints, or of fewer with others behind its last, which stay
    /// at zero; it has a parameter.
    pub(super) fn solutions<const N: usize>(
        &self,
        pose: &Pose,
        parameters: &[f64],
        seed: Option<&[f64; N]>,
    ) -> Solutions<N> {
        let Some((form, redundancy)) = self.arm.form().zip(self.arm.redundancy.as_ref()) else {
            return Solutions::new();
        };
        let (pose, parameters) = self.turned(pose, parameters);
        if redundancy.swivel.is_some() {
            let seed = seed.map_or([0.0; 7], |seed| std::array::from_fn(|i| seed[i]));
            let solutions = form.solved_at_swivel(&pose, parameters, &seed);
            return self.with_given(&solutions, &[]);
        }
        let solved = self.joints() - redundancy.joints.len();
        with_constant!(solved, M => {
            let seed: Option<[f64; M]> = seed.map(|seed| {
                let is_given = |i: &usize| redundancy.joints.contains(i);
                let mut others = (0..N).filter(|i| !is_given(i)).map(|i| seed[i]);
                std::array::from_fn(|_| others.next().unwrap_or_default())
            });
            let given: Vec<(usize, f64)> = redundancy.joints.iter().copied().zip(parameters.iter().copied()).collect();
            self.with_given(&form.solved_near::<M>(&pose, parameters, seed.as_ref()), &given)
        })
        .unwrap_or_default()
    }

    /// Solutions of M joints with those that are given, by their places, among them.
    fn with_given<const M: usize, const N: usize>(
        &self,
        solutions: &Solutions<M>,
        given: &[(usize, f64)],
    ) -> Solutions<N> {
        let joints = self.joints();
        let slides = |i: &usize| !self.limits[*i].is_revolute();
        let prismatic = (0..joints).filter(slides).fold(0, |mask, i| mask | 1 << i);
        let mut all = Solutions::with_prismatic(prismatic);
        // A value that a target does not depend on would be no number in what is returned.
        let is_number = given.iter().all(|(_, value)| value.is_finite());
        for solution in solutions.iter().filter(|_| is_number) {
            let (mut q, mut others) = ([0.0; N], solution.q.into_iter());
            for (i, q) in q[..joints].iter_mut().enumerate() {
                let value = given.iter().find(|(joint, _)| *joint == i);
                *q = match value {
                    Some((_, value)) if slides(&i) => *value,
                    Some((_, value)) => math::wrap(*value),
                    None => others.next().unwrap_or_default(),
                };
            }
            all.push(Solution {
                q,
                residual: solution.residual,
                branch: solution.branch,
                singular: solution.singular,
            });
        }
        all
    }
}
