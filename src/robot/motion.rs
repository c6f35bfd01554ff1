//! Velocities, forces, and how Jacobians change.

use super::Robot;
use super::of_joints::{OfJoints, array, with_capacity, with_constant, with_room};
use kin_runtime::{Basis, Hessian, Jacobian, Kinematics, Manipulability, Twist, Wrench};

/// What an array of N joints is on slices, of a robot that may have fewer.
trait OnSlices {
    type Output;
    fn into_output(self, joints: usize) -> Self::Output;
}

impl<const N: usize> OnSlices for Jacobian<N> {
    type Output = Vec<Twist>;
    fn into_output(self, joints: usize) -> Vec<Twist> {
        (0..joints).map(|joint| self.column(joint)).collect()
    }
}

impl<const N: usize> OnSlices for Hessian<N> {
    type Output = Vec<Vec<Twist>>;
    fn into_output(self, joints: usize) -> Vec<Vec<Twist>> {
        let own = self.derivatives[..joints].iter();
        own.map(|derivative| derivative.into_output(joints))
            .collect()
    }
}

impl<const N: usize> OnSlices for [f64; N] {
    type Output = Vec<f64>;
    fn into_output(self, joints: usize) -> Vec<f64> {
        self[..joints].to_vec()
    }
}

impl<const N: usize> OnSlices for Basis<[f64; N], N> {
    type Output = Vec<Vec<f64>>;
    /// The joints that a robot has not, each by itself, are the last motions.
    fn into_output(self, joints: usize) -> Vec<Vec<f64>> {
        let own = self.iter().take(self.len() + joints - N);
        own.map(|vector| vector.into_output(joints)).collect()
    }
}

macro_rules! same_on_slices {
    ($($type:ty)*) => { $(
        impl OnSlices for $type {
            type Output = Self;
            fn into_output(self, _: usize) -> Self {
                self
            }
        }
    )* };
}
same_on_slices!(Twist Manipulability Basis<Wrench, 6>);

/// Values of N joints, 0 of those that a robot has not.
fn padded<const N: usize>(q: &[f64]) -> [f64; N] {
    let mut all = [0.0; N];
    all[..q.len()].copy_from_slice(q);
    all
}

/// Why there is a number of joints for each robot.
const COUNTED: &str = "1 to 64 joints: robots of more are refused when they are read";

/// Methods of [`Kinematics`] on slices.
macro_rules! on_slices {
    ($(
        $(#[$attribute:meta])*
        fn $method:ident(q $(, $slice:ident)? $(; $given:ident: $type:ty)?) -> $output:ty;
    )*) => {
        /// Velocities, forces, and how Jacobians change. Slices that have not a value for each
        /// joint panic.
        impl Robot { $(
            $(#[$attribute])*
            pub fn $method(
                &self,
                q: &[f64],
                $($slice: &[f64],)?
                $($given: $type,)?
            ) -> $output {
                self.check(q);
                $(self.check($slice);)?
                with_capacity!(self.joints(), N => {
                    let arm = OfJoints::<N>::new(self);
                    arm.$method(&padded(q) $(, &padded($slice))? $(, $given)?).into_output(self.joints())
                })
                .expect(COUNTED)
            }
        )* }
    };
}

on_slices! {
    /// The time derivative of the spatial Jacobian at the joint rates, rad/s and m/s, by columns.
    fn jacobian_dot(q, rates) -> Vec<Twist>;
    /// That of the body Jacobian.
    fn body_jacobian_dot(q, rates) -> Vec<Twist>;
    /// That of the geometric Jacobian.
    fn geometric_jacobian_dot(q, rates) -> Vec<Twist>;
    /// The tip's spatial velocity at the joint rates, in base axes.
    fn spatial_velocity(q, rates) -> Twist;
    /// The velocity of the tip's origin and the angular velocity, in tip axes.
    fn body_velocity(q, rates) -> Twist;
    /// The same in base axes.
    fn geometric_velocity(q, rates) -> Twist;
    /// The joint torques and forces, N m and N, that balance a wrench on the tip in base
    /// coordinates, with the moment about the base's origin.
    fn spatial_torques(q; wrench: &Wrench) -> Vec<f64>;
    /// The same of a wrench in tip coordinates.
    fn body_torques(q; wrench: &Wrench) -> Vec<f64>;
    /// The same of a wrench in base axes, with the moment about the tip's origin.
    fn geometric_torques(q; wrench: &Wrench) -> Vec<f64>;
    /// The wrenches that the structure bears without joint torques: an orthonormal basis, in base
    /// coordinates with the moment about the base's origin.
    fn structural_wrenches(q) -> Basis<Wrench, 6>;
    /// How far the arm is from a singularity, metres and radians alike.
    fn manipulability(q) -> Manipulability;
    /// The same for the velocity of the tip's origin alone.
    fn translational_manipulability(q) -> Manipulability;
    /// The same for the angular velocity alone.
    fn rotational_manipulability(q) -> Manipulability;
    /// The joint rates that leave the tip at rest: an orthonormal basis.
    fn internal_motions(q) -> Vec<Vec<f64>>;
    /// The internal motion nearest to some joint rates, rad/s and m/s.
    fn null_space_projection(q, rates) -> Vec<f64>;
}

/// What takes the derivatives by every joint. Of more joints than have inverse kinematics these
/// are too many for the stack together, and come one by one.
macro_rules! by_joint {
    (
        $($(#[$about:meta])* fn $hessian:ident by $dot:ident;)*
        of geometric_jacobian: $($(#[$what:meta])* fn $gradient:ident by $one_by_one:ident;)*
    ) => {
        /// How Jacobians and their measures change by joint. Slices that have not a value for each
        /// joint panic.
        impl Robot {
            $(
                $(#[$about])*
                pub fn $hessian(&self, q: &[f64]) -> Vec<Vec<Twist>> {
                    let n = self.joints();
                    self.check(q);
                    with_constant!(n, N => {
                        OfJoints::<N>::new(self).$hessian(array(q)).into_output(n)
                    })
                    .unwrap_or_else(|| (0..n).map(|k| self.$dot(q, &unit(n, k))).collect())
                }
            )*
            $(
                $(#[$what])*
                pub fn $gradient(&self, q: &[f64]) -> Vec<f64> {
                    let n = self.joints();
                    self.check(q);
                    with_constant!(n, N => {
                        OfJoints::<N>::new(self).$gradient(array(q)).into_output(n)
                    })
                    .or_else(|| with_capacity!(n, N => {
                        let (arm, q) = (OfJoints::<N>::new(self), padded(q));
                        let one = |k| arm.geometric_jacobian_dot(&q, &padded(&unit(N, k)));
                        arm.geometric_jacobian(&q).$one_by_one(one).into_output(n)
                    }))
                    .expect(COUNTED)
                }
            )*
        }
    };
}

by_joint! {
    /// By joint, the derivatives of the spatial Jacobian's columns.
    fn hessian by jacobian_dot;
    /// The same of the body Jacobian.
    fn body_hessian by body_jacobian_dot;
    /// The same of the geometric Jacobian.
    fn geometric_hessian by geometric_jacobian_dot;

    of geometric_jacobian:
    /// How the volume of the manipulability changes with every joint; 0 at a singularity.
    fn manipulability_gradient by manipulability_gradient_by;
    /// The same for the velocity of the tip's origin alone.
    fn translational_manipulability_gradient by translational_manipulability_gradient_by;
    /// The same for the angular velocity alone.
    fn rotational_manipulability_gradient by rotational_manipulability_gradient_by;
}

/// One joint's rate is 1.
fn unit(joints: usize, k: usize) -> Vec<f64> {
    (0..joints)
        .map(|joint| f64::from(u8::from(joint == k)))
        .collect()
}
