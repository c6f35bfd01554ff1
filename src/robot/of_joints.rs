//! A robot as one of N joints: what generated types do is there by the same traits, and so by the
//! same code.

use super::Robot;
use super::forward::pose;
use kin_codegen::closed_form::Domain;
use kin_codegen::expr::{Lanes, Tape};
use kin_runtime::__private::Eliminant;
use kin_runtime::{
    Hessian, Jacobian, JointLimit, Kinematics, Parameter, Pose, RedundantKinematics, Solution,
    Solutions, Swivel, Target,
};

/// Evaluates an expression with a number that is known at run time, 1 to 8, as a constant; none
/// of other numbers.
macro_rules! with_constant {
    ($n:expr, $constant:ident => $body:expr) => {
        with_constant!($n, $constant => $body, 1 2 3 4 5 6 7 8)
    };
    ($n:expr, $constant:ident => $body:expr, $($value:literal)*) => {
        match $n {
            $($value => {
                const $constant: usize = $value;
                Some($body)
            })*
            _ => None,
        }
    };
}
pub(super) use with_constant;

// Robots of more joints are refused by the compiler.
const _: () = assert!(kin_codegen::spec::bounds::JOINTS == 64);

/// The same with a number that is not less, up to 64, and at least 8: what takes solutions and
/// intervals of them needs no code of its own for each number of joints.
macro_rules! with_room {
    ($n:expr, $constant:ident => $body:expr) => {
        match $n {
            ..=8 => with_constant!(8, $constant => $body, 8),
            9..=16 => with_constant!(16, $constant => $body, 16),
            17..=32 => with_constant!(32, $constant => $body, 32),
            _ => with_constant!(64, $constant => $body, 64),
        }
    };
}
pub(super) use with_room;

/// The same with the number itself up to 8: nor does what is made of Jacobians, beyond the numbers
/// that have inverse kinematics.
macro_rules! with_capacity {
    ($n:expr, $constant:ident => $body:expr) => {
        match $n {
            ..=8 => with_constant!($n, $constant => $body),
            _ => with_room!($n, $constant => $body),
        }
    };
}
pub(super) use with_capacity;

/// A robot that has N joints, and of several parameters one that moves. One of fewer joints has
/// others behind its last, which leave the tip where it is and stay at zero.
///
/// What a robot has is asked of methods: of the constants that the traits want, none is read.
#[derive(Clone, Copy)]
pub(super) struct OfJoints<'a, const N: usize> {
    robot: &'a Robot,
    /// The place of the parameter that moves.
    moving: usize,
    /// All parameters; that one is not read.
    held: &'a [f64],
}

impl<'a, const N: usize> OfJoints<'a, N> {
    pub fn new(robot: &'a Robot) -> Self {
        Self::along(robot, 0, &[])
    }

    pub fn along(robot: &'a Robot, moving: usize, held: &'a [f64]) -> Self {
        Self {
            robot,
            moving,
            held,
        }
    }

    fn with(&self, parameter: f64) -> Vec<f64> {
        let mut parameters = self.held.to_vec();
        parameters.resize(self.robot.parameters(), 0.0);
        parameters[self.moving] = parameter;
        parameters
    }

    /// The values of the robot's own joints.
    fn own<'q>(&self, q: &'q [f64; N]) -> &'q [f64] {
        &q[..self.robot.joints()]
    }

    fn jacobian(&self, tape: &Tape, inputs: &[f64]) -> Jacobian<N> {
        self.columns(&tape.run::<1>(inputs, 0), 0)
    }

    /// The Jacobian whose columns are the outputs from some on.
    fn columns(&self, values: &Lanes<1>, first: usize) -> Jacobian<N> {
        let mut jacobian = Jacobian::default();
        for joint in 0..self.robot.joints() {
            for (i, row) in jacobian.rows.iter_mut().enumerate() {
                row[joint] = values.output(first + 6 * joint + i)[0];
            }
        }
        jacobian
    }
}

/// The values of N joints.
///
/// # Panics
///
/// There are more or fewer.
pub(super) fn array<const N: usize>(q: &[f64]) -> &[f64; N] {
    q.try_into().expect("one value for each joint")
}

impl<const N: usize> Kinematics<N> for OfJoints<'_, N> {
    const JOINT_NAMES: [&'static str; N] = [""; N];
    const LIMITS: [JointLimit; N] = [JointLimit::Continuous; N];
    const BASE: &'static str = "";
    const TIP: &'static str = "";
    const BRANCHES: usize = 0;

    fn own_limits(&self) -> [JointLimit; N] {
        let limits = &self.robot.limits;
        std::array::from_fn(|i| limits.get(i).copied().unwrap_or(JointLimit::Continuous))
    }

    fn own_target(&self) -> Target {
        self.robot.target()
    }

    fn fk(&self, q: &[f64; N]) -> Pose {
        self.robot.fk(self.own(q))
    }

    fn fk_links(&self, q: &[f64; N]) -> [Pose; N] {
        let mut links = [Pose::IDENTITY; N];
        let own = self.robot.fk_links(self.own(q));
        links
            .iter_mut()
            .zip(own)
            .for_each(|(link, own)| *link = own);
        links
    }

    fn fk_jacobian(&self, q: &[f64; N]) -> (Pose, Jacobian<N>) {
        let values = self.robot.jacobians().both.run::<1>(self.own(q), 0);
        (pose(&values, 0), self.columns(&values, 12))
    }

    fn spatial_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        match &self.robot.jacobians().spatial {
            Some(tape) => self.jacobian(tape, self.own(q)),
            None => self.fk_jacobian(q).1,
        }
    }

    fn body_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        self.jacobian(&self.robot.jacobians().body, self.own(q))
    }

    fn geometric_jacobian(&self, q: &[f64; N]) -> Jacobian<N> {
        self.jacobian(&self.robot.jacobians().geometric, self.own(q))
    }

    fn jacobian_dot(&self, q: &[f64; N], rates: &[f64; N]) -> Jacobian<N> {
        match &self.robot.jacobians().dot {
            Some(tape) => self.jacobian(tape, &[self.own(q), self.own(rates)].concat()),
            None => self.spatial_jacobian(q).spatial_dot(rates),
        }
    }

    fn hessian(&self, q: &[f64; N]) -> Hessian<N> {
        let unit = |k| std::array::from_fn(|j| if j == k { 1.0 } else { 0.0 });
        match self.robot.jacobians().dot {
            Some(_) => Hessian {
                derivatives: std::array::from_fn(|k| self.jacobian_dot(q, &unit(k))),
            },
            None => self.spatial_jacobian(q).spatial_hessian(),
        }
    }

    fn ik(&self, target: &Pose) -> Solutions<N> {
        self.robot.isolated(target, None)
    }

    fn ik_seeded(&self, target: &Pose, seed: &[f64; N]) -> Solutions<N> {
        self.robot.isolated(target, Some(seed))
    }

    fn ik_approximate(&self, target: &Pose) -> Option<Solution<N>> {
        let form = self.robot.arm.form();
        let form = form.filter(|_| self.robot.parameters() == 0)?;
        form.approximate(target, |q| self.robot.fk(q))
    }
}

impl<const N: usize> RedundantKinematics<N> for OfJoints<'_, N> {
    const PARAMETER: Parameter = Parameter::Joint(0);
    const BRANCHES_AT: usize = 0;

    fn parameter(&self) -> Parameter {
        let parameter = self.robot.parameter(self.moving);
        parameter.expect("a robot with so many parameters")
    }

    fn branches_at(&self) -> usize {
        self.robot.branches_at()
    }

    fn roots(&self) -> usize {
        self.robot.domain.as_ref().map_or(0, Domain::roots)
    }

    fn held(&self) -> [Option<f64>; N] {
        let joints = self.robot.joints();
        let mut held = std::array::from_fn(|joint| (joint >= joints).then_some(0.0));
        for (i, &value) in self
            .held
            .iter()
            .enumerate()
            .filter(|(i, _)| *i != self.moving)
        {
            if let Some(Parameter::Joint(joint)) = self.robot.parameter(i) {
                held[joint] = Some(value);
            }
        }
        held
    }

    fn held_turn(&self) -> Option<f64> {
        let last = self.held.len().checked_sub(1)?;
        (self.robot.has_turn() && self.moving != last).then(|| self.held[last])
    }

    fn held_swivel(&self) -> Option<(Swivel, f64)> {
        let mut held = self.held.iter().enumerate();
        held.find_map(|(i, &angle)| match self.robot.parameter(i) {
            Some(Parameter::Swivel(swivel)) if i != self.moving => Some((swivel, angle)),
            _ => None,
        })
    }

    fn ik_at(&self, target: &Pose, parameter: f64) -> Solutions<N> {
        self.robot.solutions(target, &self.with(parameter), None)
    }

    fn ik_seeded_at(&self, target: &Pose, parameter: f64, seed: &[f64; N]) -> Solutions<N> {
        let parameters = self.with(parameter);
        self.robot.solutions(target, &parameters, Some(seed))
    }

    fn root_arguments(&self, target: &Pose, parameter: f64) -> [[f64; 16]; 4] {
        let Some((form, domain)) = self.robot.arm.form().zip(self.robot.domain.as_ref()) else {
            return [[f64::INFINITY; 16]; 4];
        };
        let parameters = self.with(parameter);
        let (target, given) = self.robot.turned(target, &parameters);
        domain.arguments(form, &target, given)
    }

    fn eliminant_at(&self, target: &Pose, parameter: f64, which: usize) -> Option<Eliminant> {
        let form = self.robot.arm.form()?;
        let parameters = self.with(parameter);
        let (target, given) = self.robot.turned(target, &parameters);
        form.eliminant(&target, given, which)
    }

    fn margins_at(&self, target: &Pose, parameter: f64) -> Option<[f64; 16]> {
        let (form, domain) = self.robot.arm.form().zip(self.robot.domain.as_ref())?;
        let parameters = self.with(parameter);
        let (target, given) = self.robot.turned(target, &parameters);
        domain.margins(form, &target, given)
    }
}
