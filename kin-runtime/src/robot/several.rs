//! Arms with several joints more than their targets have coordinates.

use super::placement::constants_of;
use crate::__private::Eliminant;
use crate::{
    Frame, Hessian, Jacobian, JointLimit, Kinematics, Parameter, Pose, Posture,
    RedundantKinematics, Singularities, Solutions, Swivel, Target,
};

/// The inverse kinematics of an arm with several joints more than its targets have coordinates:
/// eight for whole poses, or seven where the tool may turn. P numbers beside the target, the
/// parameters, leave isolated solutions.
///
/// With all parameters but one held, it is an arm with one joint too many:
/// [`along`](HighlyRedundantKinematics::along).
pub trait HighlyRedundantKinematics<const N: usize, const P: usize>: Kinematics<N> {
    /// What the parameters are.
    const PARAMETERS: [Parameter; P];
    /// How many branches [`HighlyRedundantKinematics::ik_at`] looks at.
    const BRANCHES_AT: usize;
    /// As [`RedundantKinematics::ROOTS`].
    #[doc(hidden)]
    const ROOTS: usize = 0;

    /// All configurations with these parameters that put the tip at the target, as far as the
    /// target counts: every isolated one once, and none if the target is out of reach.
    fn ik_at(&self, target: &Pose, parameters: &[f64; P]) -> Solutions<N>;

    /// As [`RedundantKinematics::ik_seeded_at`].
    fn ik_seeded_at(&self, target: &Pose, parameters: &[f64; P], seed: &[f64; N]) -> Solutions<N> {
        let _ = seed;
        self.ik_at(target, parameters)
    }

    /// As [`RedundantKinematics::root_arguments`].
    fn root_arguments(&self, target: &Pose, parameters: &[f64; P]) -> [[f64; 16]; 4] {
        let _ = (target, parameters);
        [[f64::INFINITY; 16]; 4]
    }

    /// As [`RedundantKinematics::margins_at`].
    fn margins_at(&self, target: &Pose, parameters: &[f64; P]) -> Option<[f64; 16]> {
        let _ = (target, parameters);
        None
    }

    /// As [`RedundantKinematics::eliminant_at`].
    #[doc(hidden)]
    fn eliminant_at(
        &self,
        target: &Pose,
        parameters: &[f64; P],
        which: usize,
    ) -> Option<Eliminant> {
        let _ = (target, parameters, which);
        None
    }

    /// The arm along its parameter I, counted from 0, with the others held at these values: for
    /// intervals, sweeps, paths and the best configuration along that parameter. Entry I is not
    /// read.
    ///
    /// ```no_run
    /// use kin_runtime::{HighlyRedundantKinematics, Pose, RedundantKinematics};
    /// fn most_room<const N: usize>(arm: &impl HighlyRedundantKinematics<N, 2>, pose: &Pose) -> f64 {
    ///     let lengths = (0..10).map(|rail| {
    ///         let intervals = arm.along::<1>([0.1 * f64::from(rail), 0.0]).feasible(pose);
    ///         intervals.iter().map(|interval| interval.to - interval.from).sum()
    ///     });
    ///     lengths.fold(0.0, f64::max)
    /// }
    /// ```
    fn along<const I: usize>(&self, held: [f64; P]) -> Along<'_, Self, P, I> {
        Along { robot: self, held }
    }
}

/// A robot all of whose parameters but one are held; see [`HighlyRedundantKinematics::along`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Along<'a, K: ?Sized, const P: usize, const I: usize> {
    /// The robot.
    pub robot: &'a K,
    /// Its parameters, of which number I is not read; radians and metres.
    pub held: [f64; P],
}

impl<K: ?Sized, const P: usize, const I: usize> Along<'_, K, P, I> {
    fn with(&self, parameter: f64) -> [f64; P] {
        let mut parameters = self.held;
        parameters[I] = parameter;
        parameters
    }
}

impl<K, const N: usize, const P: usize, const I: usize> Kinematics<N> for Along<'_, K, P, I>
where
    K: HighlyRedundantKinematics<N, P> + ?Sized,
{
    constants_of!(K);

    fn fk(&self, q: &[f64; N]) -> Pose {
        self.robot.fk(q)
    }

    fn fk_links(&self, q: &[f64; N]) -> [Pose; N] {
        self.robot.fk_links(q)
    }

    fn fk_frame(&self, q: &[f64; N], frame: &Frame) -> Pose {
        self.robot.fk_frame(q, frame)
    }

    fn fk_jacobian(&self, q: &[f64; N]) -> (Pose, Jacobian<N>) {
        self.robot.fk_jacobian(q)
    }

    fn spatial_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        self.robot.spatial_jacobian(q)
    }

    fn body_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        self.robot.body_jacobian(q)
    }

    fn geometric_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        self.robot.geometric_jacobian(q)
    }

    fn fk_batch(&self, q: &[[f64; N]], poses: &mut [Pose]) {
        self.robot.fk_batch(q, poses);
    }

    fn fk_jacobian_batch(&self, q: &[[f64; N]], results: &mut [(Pose, Jacobian<N>)]) {
        self.robot.fk_jacobian_batch(q, results);
    }

    fn jacobian_dot(&self, q: &[f64; N], rates: &[f64; N]) -> Jacobian<N> {
        self.robot.jacobian_dot(q, rates)
    }

    fn hessian(&self, q: &[f64; N]) -> Hessian<N> {
        self.robot.hessian(q)
    }

    fn jacobian_determinant(&self, q: &[f64; N]) -> Option<f64> {
        self.robot.jacobian_determinant(q)
    }

    fn singularities(&self, q: &[f64; N]) -> Singularities {
        self.robot.singularities(q)
    }
}

impl<K, const N: usize, const P: usize, const I: usize> RedundantKinematics<N>
    for Along<'_, K, P, I>
where
    K: HighlyRedundantKinematics<N, P> + ?Sized,
{
    const PARAMETER: Parameter = K::PARAMETERS[I];
    const BRANCHES_AT: usize = K::BRANCHES_AT;
    const ROOTS: usize = K::ROOTS;

    fn held(&self) -> [Option<f64>; N] {
        let mut held = [None; N];
        for (i, (parameter, value)) in K::PARAMETERS.iter().zip(self.held).enumerate() {
            if let (true, Parameter::Joint(joint)) = (i != I, parameter) {
                held[*joint] = Some(value);
            }
        }
        held
    }

    fn held_turn(&self) -> Option<f64> {
        let mut all = K::PARAMETERS.iter().zip(self.held).enumerate();
        let turn = all.find(|(i, (parameter, _))| *i != I && **parameter == Parameter::Turn);
        turn.map(|(_, (_, angle))| angle)
    }

    fn held_swivel(&self) -> Option<(Swivel, f64)> {
        let mut all = K::PARAMETERS.iter().zip(self.held).enumerate();
        all.find_map(|(i, (parameter, angle))| match parameter {
            Parameter::Swivel(swivel) if i != I => Some((*swivel, angle)),
            _ => None,
        })
    }

    fn ik_at(&self, target: &Pose, parameter: f64) -> Solutions<N> {
        self.robot.ik_at(target, &self.with(parameter))
    }

    fn ik_seeded_at(&self, target: &Pose, parameter: f64, seed: &[f64; N]) -> Solutions<N> {
        let parameters = self.with(parameter);
        self.robot.ik_seeded_at(target, &parameters, seed)
    }

    fn root_arguments(&self, target: &Pose, parameter: f64) -> [[f64; 16]; 4] {
        self.robot.root_arguments(target, &self.with(parameter))
    }

    fn margins_at(&self, target: &Pose, parameter: f64) -> Option<[f64; 16]> {
        self.robot.margins_at(target, &self.with(parameter))
    }

    fn eliminant_at(&self, target: &Pose, parameter: f64, which: usize) -> Option<Eliminant> {
        let parameters = self.with(parameter);
        self.robot.eliminant_at(target, &parameters, which)
    }
}
