//! Robots with a tool or a base that is known only at run time.

use crate::__private::Eliminant;
use crate::{
    Frame, Hessian, Jacobian, JointLimit, Kinematics, Nearest, Parameter, Pose, Posture,
    RedundantKinematics, Singularities, Solution, Solutions, Swivel, Target,
};

/// The constants of an arm that is this one but for how it is asked.
macro_rules! constants_of {
    ($robot:ident) => {
        const JOINT_NAMES: [&'static str; N] = $robot::JOINT_NAMES;
        const LIMITS: [JointLimit; N] = $robot::LIMITS;
        const VELOCITY_LIMITS: [f64; N] = $robot::VELOCITY_LIMITS;
        const EFFORT_LIMITS: [f64; N] = $robot::EFFORT_LIMITS;
        const LINK_NAMES: [&'static str; N] = $robot::LINK_NAMES;
        const FRAMES: &'static [Frame] = $robot::FRAMES;
        const BASE: &'static str = $robot::BASE;
        const TIP: &'static str = $robot::TIP;
        const TARGET: Target = $robot::TARGET;
        const POSTURES: &'static [Posture] = $robot::POSTURES;
        const BRANCHES: usize = $robot::BRANCHES;
    };
}

pub(super) use constants_of;

/// A robot that carries a tool: poses are those of the tool, whose frame lies
/// at `tool` in the robot's own tip frame.
///
/// The residuals of [`Kinematics::ik`] stay those measured at the robot's tip. Of an arm whose
/// targets do not fix the height or the tilt ([`Target::PositionYaw`], [`Target::Planar`]), they
/// have to be poses that the tool reaches as a whole.
///
/// # Panics
///
/// Inverse kinematics of an arm whose targets are no whole poses panics with a tool that they do not
/// [allow](Target::allows_tool): the turn that such a target leaves free would move the robot's tip.
/// The robot's file, or the option `target`, is the place for such a tool.
///
/// ```no_run
/// use kin_runtime::{Kinematics, Pose, WithTool};
/// fn drill<const N: usize>(robot: impl Kinematics<N>, hole: &Pose) -> Vec<[f64; N]> {
///     let drilling = WithTool { robot, tool: Pose::from_translation([0.0, 0.0, 0.12]) };
///     drilling.ik(hole).iter().map(|s| s.q).collect()
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithTool<K> {
    /// The robot without the tool.
    pub robot: K,
    /// The tool's frame in the robot's tip frame.
    pub tool: Pose,
}

impl<K> WithTool<K> {
    /// Where the robot's tip has to be for the tool to be at `target`.
    fn at_tip<const N: usize>(&self, target: &Pose) -> Pose
    where
        K: Kinematics<N>,
    {
        assert!(
            K::TARGET.allows_tool(&self.tool),
            "targets that are {} leave open where this tool puts the tip: compile the robot with \
             the option `tool`, or solve for whole poses",
            K::TARGET.phrase()
        );
        *target * self.tool.inverse()
    }
}

/// What [`RedundantKinematics`] of a robot is where it is placed: that of its own target, and its
/// swivel as it is seen from there.
macro_rules! placed {
    ($placed:ident, $own_target:ident) => {
        impl<const N: usize, K: RedundantKinematics<N>> RedundantKinematics<N> for $placed<K> {
            /// As of the robot itself, in its own frames.
            const PARAMETER: Parameter = K::PARAMETER;
            const BRANCHES_AT: usize = K::BRANCHES_AT;
            const ROOTS: usize = K::ROOTS;

            fn parameter(&self) -> Parameter {
                match self.robot.parameter() {
                    Parameter::Swivel(swivel) => Parameter::Swivel(self.placed(swivel)),
                    other => other,
                }
            }

            fn branches_at(&self) -> usize {
                self.robot.branches_at()
            }

            fn roots(&self) -> usize {
                self.robot.roots()
            }

            fn held(&self) -> [Option<f64>; N] {
                self.robot.held()
            }

            fn held_turn(&self) -> Option<f64> {
                self.robot.held_turn()
            }

            fn held_swivel(&self) -> Option<(Swivel, f64)> {
                let held = self.robot.held_swivel();
                held.map(|(swivel, angle)| (self.placed(swivel), angle))
            }

            fn ik_at(&self, target: &Pose, parameter: f64) -> Solutions<N> {
                self.robot.ik_at(&self.$own_target(target), parameter)
            }

            fn ik_seeded_at(&self, target: &Pose, parameter: f64, seed: &[f64; N]) -> Solutions<N> {
                let target = self.$own_target(target);
                self.robot.ik_seeded_at(&target, parameter, seed)
            }

            fn margins_at(&self, target: &Pose, parameter: f64) -> Option<[f64; 16]> {
                self.robot.margins_at(&self.$own_target(target), parameter)
            }

            fn eliminant_at(
                &self,
                target: &Pose,
                parameter: f64,
                which: usize,
            ) -> Option<Eliminant> {
                let target = self.$own_target(target);
                self.robot.eliminant_at(&target, parameter, which)
            }

            fn root_arguments(&self, target: &Pose, parameter: f64) -> [[f64; 16]; 4] {
                let target = self.$own_target(target);
                self.robot.root_arguments(&target, parameter)
            }

            fn parameter_of(&self, target: &Pose, q: &[f64; N]) -> f64 {
                self.robot.parameter_of(&self.$own_target(target), q)
            }
        }
    };
}

impl<K> WithTool<K> {
    /// With the wrist in the tool's frame.
    fn placed(&self, swivel: Swivel) -> Swivel {
        Swivel {
            wrist: self.tool.inverse().transform_point(swivel.wrist),
            ..swivel
        }
    }
}

placed!(WithTool, at_tip);

impl<K> WithBase<K> {
    /// With the shoulder and the reference as they are seen from the new base.
    fn placed(&self, swivel: Swivel) -> Swivel {
        Swivel {
            shoulder: self.base.transform_point(swivel.shoulder),
            reference: self.base.rotate(swivel.reference),
            ..swivel
        }
    }
}

placed!(WithBase, seen_from_base);

impl<const N: usize, K: Kinematics<N>> Kinematics<N> for WithTool<K> {
    constants_of!(K);

    fn fk(&self, q: &[f64; N]) -> Pose {
        self.robot.fk(q) * self.tool
    }

    fn fk_links(&self, q: &[f64; N]) -> [Pose; N] {
        self.robot.fk_links(q)
    }

    /// The frames are those of the robot's bodies, none the tool's.
    fn fk_frame(&self, q: &[f64; N], frame: &Frame) -> Pose {
        self.robot.fk_frame(q, frame)
    }

    /// The spatial Jacobian does not depend on what the last joint carries.
    fn fk_jacobian(&self, q: &[f64; N]) -> (Pose, Jacobian<N>) {
        let (tip, jacobian) = self.robot.fk_jacobian(q);
        (tip * self.tool, jacobian)
    }

    fn fk_batch(&self, q: &[[f64; N]], poses: &mut [Pose]) {
        self.robot.fk_batch(q, poses);
        for pose in poses {
            *pose = *pose * self.tool;
        }
    }

    fn fk_jacobian_batch(&self, q: &[[f64; N]], results: &mut [(Pose, Jacobian<N>)]) {
        self.robot.fk_jacobian_batch(q, results);
        for (pose, _) in results {
            *pose = *pose * self.tool;
        }
    }

    fn jacobian_dot(&self, q: &[f64; N], rates: &[f64; N]) -> Jacobian<N> {
        self.robot.jacobian_dot(q, rates)
    }

    fn hessian(&self, q: &[f64; N]) -> Hessian<N> {
        self.robot.hessian(q)
    }

    fn ik(&self, target: &Pose) -> Solutions<N> {
        self.robot.ik(&self.at_tip(target))
    }

    fn ik_batch(&self, targets: &[Pose], solutions: &mut [Solutions<N>]) {
        batch_at(
            &self.robot,
            |target| self.at_tip(target),
            targets,
            solutions,
        );
    }

    fn ik_seeded(&self, target: &Pose, seed: &[f64; N]) -> Solutions<N> {
        self.robot.ik_seeded(&self.at_tip(target), seed)
    }

    fn ik_approximate(&self, target: &Pose) -> Option<Solution<N>> {
        self.robot.ik_approximate(&self.at_tip(target))
    }

    fn ik_nearest(&self, target: &Pose, seed: &[f64; N]) -> Option<Solution<N>> {
        self.robot.ik_nearest(&self.at_tip(target), seed)
    }

    fn ik_nearest_by(&self, target: &Pose, nearest: &Nearest<N>) -> Option<Solution<N>> {
        self.robot.ik_nearest_by(&self.at_tip(target), nearest)
    }

    /// Of six joints that of the robot, since the spatial Jacobian does not
    /// change; of fewer, the rows that count are those of another tip.
    fn jacobian_determinant(&self, q: &[f64; N]) -> Option<f64> {
        if N == 6 {
            self.robot.jacobian_determinant(q)
        } else {
            None
        }
    }

    /// Those of the robot, as far as [`Kinematics::jacobian_determinant`] is.
    fn singularities(&self, q: &[f64; N]) -> Singularities {
        if N == 6 {
            self.robot.singularities(q)
        } else {
            Singularities::default()
        }
    }
}

/// The solutions of a robot at other places than the targets, which are written to
/// the stack some at a time.
fn batch_at<K: Kinematics<N>, const N: usize>(
    robot: &K,
    place: impl Fn(&Pose) -> Pose,
    targets: &[Pose],
    solutions: &mut [Solutions<N>],
) {
    const SOME: usize = 64;
    assert_eq!(
        targets.len(),
        solutions.len(),
        "a place for the solutions of each target"
    );
    let mut placed = [Pose::IDENTITY; SOME];
    for (targets, solutions) in targets.chunks(SOME).zip(solutions.chunks_mut(SOME)) {
        for (placed, target) in placed.iter_mut().zip(targets) {
            *placed = place(target);
        }
        robot.ik_batch(&placed[..targets.len()], solutions);
    }
}

/// A robot that stands somewhere: poses are given in a world frame in which the
/// robot's own base frame lies at `base`.
///
/// ```no_run
/// use kin_runtime::{Kinematics, Pose, WithBase};
/// fn mounted<const N: usize>(robot: impl Kinematics<N>) -> impl Kinematics<N> {
///     let ceiling = Pose::from_rpy([core::f64::consts::PI, 0.0, 0.0], [0.0, 0.0, 3.0]);
///     WithBase { robot, base: ceiling }
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithBase<K> {
    /// The robot in its own base frame.
    pub robot: K,
    /// The robot's base frame in the world frame.
    pub base: Pose,
}

impl<K> WithBase<K> {
    /// `target` as the robot's own base sees it.
    fn seen_from_base(&self, target: &Pose) -> Pose {
        self.base.inverse() * *target
    }
}

impl<const N: usize, K: Kinematics<N>> Kinematics<N> for WithBase<K> {
    constants_of!(K);

    fn fk(&self, q: &[f64; N]) -> Pose {
        self.base * self.robot.fk(q)
    }

    fn fk_links(&self, q: &[f64; N]) -> [Pose; N] {
        self.robot.fk_links(q).map(|link| self.base * link)
    }

    fn fk_frame(&self, q: &[f64; N], frame: &Frame) -> Pose {
        self.base * self.robot.fk_frame(q, frame)
    }

    /// The spatial Jacobian transforms with the base (MLS section 3.4).
    fn fk_jacobian(&self, q: &[f64; N]) -> (Pose, Jacobian<N>) {
        let (tip, jacobian) = self.robot.fk_jacobian(q);
        (self.base * tip, jacobian.body_to_spatial(&self.base))
    }

    fn fk_batch(&self, q: &[[f64; N]], poses: &mut [Pose]) {
        self.robot.fk_batch(q, poses);
        for pose in poses {
            *pose = self.base * *pose;
        }
    }

    fn fk_jacobian_batch(&self, q: &[[f64; N]], results: &mut [(Pose, Jacobian<N>)]) {
        self.robot.fk_jacobian_batch(q, results);
        for (pose, jacobian) in results {
            *pose = self.base * *pose;
            *jacobian = jacobian.body_to_spatial(&self.base);
        }
    }

    /// The body Jacobian does not depend on where the robot stands.
    fn body_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        self.robot.body_jacobian(q)
    }

    fn jacobian_dot(&self, q: &[f64; N], rates: &[f64; N]) -> Jacobian<N> {
        let derivative = self.robot.jacobian_dot(q, rates);
        derivative.body_to_spatial(&self.base)
    }

    fn hessian(&self, q: &[f64; N]) -> Hessian<N> {
        let derivatives = self.robot.hessian(q).derivatives;
        Hessian {
            derivatives: derivatives.map(|slice| slice.body_to_spatial(&self.base)),
        }
    }

    fn ik(&self, target: &Pose) -> Solutions<N> {
        self.robot.ik(&self.seen_from_base(target))
    }

    fn ik_batch(&self, targets: &[Pose], solutions: &mut [Solutions<N>]) {
        let seen = |target: &Pose| self.seen_from_base(target);
        batch_at(&self.robot, seen, targets, solutions);
    }

    fn ik_seeded(&self, target: &Pose, seed: &[f64; N]) -> Solutions<N> {
        self.robot.ik_seeded(&self.seen_from_base(target), seed)
    }

    fn ik_approximate(&self, target: &Pose) -> Option<Solution<N>> {
        self.robot.ik_approximate(&self.seen_from_base(target))
    }

    fn ik_nearest_by(&self, target: &Pose, nearest: &Nearest<N>) -> Option<Solution<N>> {
        self.robot
            .ik_nearest_by(&self.seen_from_base(target), nearest)
    }

    /// The robot's: the rows that count are those in its own base frame.
    fn jacobian_determinant(&self, q: &[f64; N]) -> Option<f64> {
        self.robot.jacobian_determinant(q)
    }

    fn singularities(&self, q: &[f64; N]) -> Singularities {
        self.robot.singularities(q)
    }
}
