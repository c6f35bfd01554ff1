//! How well an arm moves its tip: measures, ellipsoids and gradients.

use super::super::linear::singular_values::SingularValues;
use super::super::linear::vector::dot;
use super::super::scalar::Real;
use super::super::{Hessian, Jacobian};

/// How far an arm is from a singularity: the three measures of MLS section
/// 3.4.4. All are 0 at a singularity and there alone.
///
/// The measures count metres and radians alike; [`Jacobian::in_lengths_of`]
/// makes them independent of the unit. They look at as many singular values as
/// there can be, the lesser of the rows and the joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manipulability {
    /// σ_min: the least speed of the tip at unit joint rates, over all
    /// directions that the arm has.
    pub sigma_min: Real,
    /// σ_min / σ_max, from 0 to 1; 1 where the arm is isotropic.
    pub inverse_condition: Real,
    /// The product of the singular values: |det J| if J is square,
    /// √det(J Jᵀ) for more joints (T. Yoshikawa, 1985) and √det(Jᵀ J) for
    /// fewer. The volume of the velocity ellipsoid, up to a constant.
    pub volume: Real,
}

/// An ellipsoid about the origin, the longest axis first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid<const D: usize> {
    /// Orthonormal directions of the principal axes.
    pub axes: [[Real; D]; D],
    /// Half the length of each; 0 where the ellipsoid is flat, ∞ where it has
    /// no bound.
    pub lengths: [Real; D],
}

/// The measures of some rows.
fn measures<const R: usize, const N: usize>(rows: &[[Real; N]; R]) -> Manipulability {
    let values = SingularValues::new(rows).values;
    let values = &values[..SingularValues::<R, N>::COUNT];
    let (most, least) = match values {
        [] => (1.0, 1.0),
        [most, .., least] => (*most, *least),
        [only] => (*only, *only),
    };
    Manipulability {
        sigma_min: least,
        inverse_condition: if most > 0.0 { least / most } else { 0.0 },
        volume: values.iter().product(),
    }
}

/// d Π σ = Σᵢ (Π_{j≠i} σⱼ) uᵢᵀ dJ vᵢ, which stays finite where a σ is 0.
fn gradient<const R: usize, const N: usize>(
    rows: &[[Real; N]; R],
    derivatives: impl Fn(usize) -> [[Real; N]; R],
) -> [Real; N] {
    let found = SingularValues::new(rows);
    let count = SingularValues::<R, N>::COUNT;
    let others = |i: usize| -> Real {
        let others = (0..count).filter(|&j| j != i);
        others.map(|j| found.values[j]).product()
    };
    let weighted: [[Real; R]; R] = core::array::from_fn(|i| {
        found.left[i].map(|x| if i < count { x * others(i) } else { 0.0 })
    });
    let right: [[Real; N]; R] = core::array::from_fn(|i| found.right(i));
    core::array::from_fn(|k| {
        let slice = derivatives(k);
        let term = |i: usize| dot(weighted[i], slice.map(|row| dot(row, right[i])));
        (0..count).map(term).sum()
    })
}

fn velocity_ellipsoid<const R: usize, const N: usize>(rows: &[[Real; N]; R]) -> Ellipsoid<R> {
    let found = SingularValues::new(rows);
    Ellipsoid {
        axes: found.left,
        lengths: found.values,
    }
}

fn force_ellipsoid<const R: usize, const N: usize>(rows: &[[Real; N]; R]) -> Ellipsoid<R> {
    let Ellipsoid { mut axes, lengths } = velocity_ellipsoid(rows);
    axes.reverse();
    let mut lengths = lengths.map(|length| 1.0 / length);
    lengths.reverse();
    Ellipsoid { axes, lengths }
}

/// The parts of a Jacobian, and what is asked of them.
impl<const N: usize> Jacobian<N> {
    /// The rows of the linear velocity.
    #[inline]
    pub fn translational(&self) -> [[Real; N]; 3] {
        let [x, y, z, ..] = self.rows;
        [x, y, z]
    }

    /// The rows of the angular velocity.
    #[inline]
    pub fn rotational(&self) -> [[Real; N]; 3] {
        let [.., x, y, z] = self.rows;
        [x, y, z]
    }

    /// The same Jacobian with `length`, metres, as the unit of length: the arm's
    /// reach, or that of a tool, makes translations and rotations comparable.
    #[inline]
    pub fn in_lengths_of(&self, length: Real) -> Self {
        let mut rows = self.rows;
        rows[..3].iter_mut().flatten().for_each(|x| *x /= length);
        Jacobian { rows }
    }

    /// All six singular values, the largest first; 6 − N of them are 0 if there
    /// are fewer than six joints. Accurate to a few 1e-16 of the largest.
    ///
    /// Those of the body and of the geometric Jacobian are the same; those of
    /// the spatial one depend on where the base is.
    pub fn singular_values(&self) -> [Real; 6] {
        SingularValues::new(&self.rows).values
    }

    /// The measures of all six rows.
    ///
    /// ```
    /// use kin_runtime::{Jacobian, Twist};
    /// let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let gantry = Jacobian::from_columns(axes.map(Twist::prismatic));
    /// assert_eq!(gantry.manipulability().inverse_condition, 1.0);
    /// ```
    pub fn manipulability(&self) -> Manipulability {
        measures(&self.rows)
    }

    /// The measures of the linear velocity, whatever the tip's rotation.
    pub fn translational_manipulability(&self) -> Manipulability {
        measures(&self.translational())
    }

    /// The measures of the angular velocity, whatever the tip's origin does.
    pub fn rotational_manipulability(&self) -> Manipulability {
        measures(&self.rotational())
    }

    /// How the volume of all six rows changes with every joint, of
    /// [`Jacobian::manipulability`]; `hessian` is that of this Jacobian. At a
    /// singularity the volume has a kink and its least value; then this is 0.
    pub fn manipulability_gradient(&self, hessian: &Hessian<N>) -> [Real; N] {
        self.manipulability_gradient_by(|k| hessian.derivatives[k])
    }

    /// As [`Jacobian::manipulability_gradient`], of the linear velocity.
    pub fn translational_manipulability_gradient(&self, hessian: &Hessian<N>) -> [Real; N] {
        self.translational_manipulability_gradient_by(|k| hessian.derivatives[k])
    }

    /// As [`Jacobian::manipulability_gradient`], of the angular velocity.
    pub fn rotational_manipulability_gradient(&self, hessian: &Hessian<N>) -> [Real; N] {
        self.rotational_manipulability_gradient_by(|k| hessian.derivatives[k])
    }

    /// As [`Jacobian::manipulability_gradient`], from one derivative after the
    /// other: `by(k)` is that of this Jacobian by joint k. N of them together
    /// may be more than a stack holds.
    pub fn manipulability_gradient_by(&self, by: impl Fn(usize) -> Self) -> [Real; N] {
        gradient(&self.rows, |k| by(k).rows)
    }

    /// As [`Jacobian::manipulability_gradient_by`], of the linear velocity.
    pub fn translational_manipulability_gradient_by(
        &self,
        by: impl Fn(usize) -> Self,
    ) -> [Real; N] {
        gradient(&self.translational(), |k| by(k).translational())
    }

    /// As [`Jacobian::manipulability_gradient_by`], of the angular velocity.
    pub fn rotational_manipulability_gradient_by(&self, by: impl Fn(usize) -> Self) -> [Real; N] {
        gradient(&self.rotational(), |k| by(k).rotational())
    }

    /// The velocities (v, ω) that joint rates with |q̇| ≤ 1 give the tip. Its
    /// axes mix metres and radians; see [`Jacobian::in_lengths_of`].
    pub fn velocity_ellipsoid(&self) -> Ellipsoid<6> {
        velocity_ellipsoid(&self.rows)
    }

    /// The linear velocities, m/s, that joint rates with |q̇| ≤ 1 give the tip,
    /// whatever the angular velocity.
    pub fn translational_velocity_ellipsoid(&self) -> Ellipsoid<3> {
        velocity_ellipsoid(&self.translational())
    }

    /// The angular velocities, rad/s, that joint rates with |q̇| ≤ 1 give the
    /// tip, whatever the linear velocity.
    pub fn rotational_velocity_ellipsoid(&self) -> Ellipsoid<3> {
        velocity_ellipsoid(&self.rotational())
    }

    /// The wrenches (f, τ) that joint torques with |τ| ≤ 1 balance. The axes
    /// are those of the velocity ellipsoid, the lengths their inverses: an arm
    /// is strong where it is slow.
    ///
    /// ```
    /// use kin_runtime::{Jacobian, Twist};
    /// let hinge = Twist::revolute([0.0, 0.0, 1.0], [0.0, -0.5, 0.0]);
    /// let forces = Jacobian::from_columns([hinge]).translational_force_ellipsoid();
    /// // 1 N m is 2 N at half a metre; the bearing takes the other forces.
    /// assert_eq!(forces.lengths, [f64::INFINITY, f64::INFINITY, 2.0]);
    /// assert_eq!(forces.axes[2][0].abs(), 1.0);
    /// ```
    pub fn force_ellipsoid(&self) -> Ellipsoid<6> {
        force_ellipsoid(&self.rows)
    }

    /// The pure forces, N, that joint torques with |τ| ≤ 1 balance.
    pub fn translational_force_ellipsoid(&self) -> Ellipsoid<3> {
        force_ellipsoid(&self.translational())
    }

    /// The pure moments, N m, that joint torques with |τ| ≤ 1 balance.
    pub fn rotational_force_ellipsoid(&self) -> Ellipsoid<3> {
        force_ellipsoid(&self.rotational())
    }
}
