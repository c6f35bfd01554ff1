//! Velocities, forces, and how Jacobians change.

use super::Robot;
use super::of_joints::{OfJoints, array, with_constant};
use kin_runtime::{Basis, Hessian, Jacobian, Kinematics, Manipulability, Twist, Wrench};

/// What an array of N joints is on slices.
trait OnSlices {
    type Told;
    fn told(self) -> Self::Told;
}

impl<const N: usize> OnSlices for Jacobian<N> {
    type Told = Vec<Twist>;
    fn told(self) -> Vec<Twist> {
        self.columns().to_vec()
    }
}

impl<const N: usize> OnSlices for Hessian<N> {
    type Told = Vec<Vec<Twist>>;
    fn told(self) -> Vec<Vec<Twist>> {
        self.derivatives.map(OnSlices::told).to_vec()
    }
}

impl<const N: usize> OnSlices for [f64; N] {
    type Told = Vec<f64>;
    fn told(self) -> Vec<f64> {
        self.to_vec()
    }
}

impl<const N: usize> OnSlices for Basis<[f64; N], N> {
    type Told = Vec<Vec<f64>>;
    fn told(self) -> Vec<Vec<f64>> {
        self.iter().map(|vector| vector.to_vec()).collect()
    }
}

macro_rules! same_on_slices {
    ($($type:ty)*) => { $(
        impl OnSlices for $type {
            type Told = Self;
            fn told(self) -> Self {
                self
            }
        }
    )* };
}
same_on_slices!(Twist Manipulability Basis<Wrench, 6>);

/// Methods of [`Kinematics`] on slices.
macro_rules! on_slices {
    ($(
        $(#[$attribute:meta])*
        fn $method:ident(q $(, $slice:ident)? $(; $given:ident: $type:ty)?) -> $told:ty;
    )*) => {
        /// Of robots of eight joints at most; others panic, as do slices that have not a value for
        /// each joint.
        impl Robot { $(
            $(#[$attribute])*
            pub fn $method(
                &self,
                q: &[f64],
                $($slice: &[f64],)?
                $($given: $type,)?
            ) -> $told {
                self.check(q);
                with_constant!(self.joints(), N => {
                    let arm = OfJoints::<N>::new(self);
                    arm.$method(array(q) $(, array($slice))? $(, $given)?).told()
                })
                .expect("a robot of eight joints at most")
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
    /// By joint, the derivatives of the spatial Jacobian's columns.
    fn hessian(q) -> Vec<Vec<Twist>>;
    /// The same of the body Jacobian.
    fn body_hessian(q) -> Vec<Vec<Twist>>;
    /// The same of the geometric Jacobian.
    fn geometric_hessian(q) -> Vec<Vec<Twist>>;
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
    /// How the volume of the manipulability changes with every joint; 0 at a singularity.
    fn manipulability_gradient(q) -> Vec<f64>;
    /// The same for the velocity of the tip's origin alone.
    fn translational_manipulability_gradient(q) -> Vec<f64>;
    /// The same for the angular velocity alone.
    fn rotational_manipulability_gradient(q) -> Vec<f64>;
    /// The joint rates that leave the tip at rest: an orthonormal basis.
    fn internal_motions(q) -> Vec<Vec<f64>>;
    /// The internal motion nearest to some joint rates, rad/s and m/s.
    fn null_space_projection(q, rates) -> Vec<f64>;
}
