//! How Jacobians change: their time derivative along a motion and the Hessian
//! of forward kinematics.
//!
//! A column of the spatial Jacobian is a twist that the joints before it carry
//! along, so that ∂ξ′ⱼ/∂θₖ = [ξ′ₖ, ξ′ⱼ] for k < j and 0 otherwise. That needs
//! no more than the Jacobian itself. The body and geometric Jacobians are the
//! spatial one seen from a frame that moves, and their derivatives follow from
//! its derivative by the product rule.

use super::super::linear::vector::{self, add};
use super::super::scalar::Real;
use super::super::{Jacobian, Pose, Twist};

/// The second derivatives of forward kinematics: how a Jacobian changes with
/// every joint.
///
/// ```
/// use kin_runtime::{Jacobian, Twist};
/// let z = [0.0, 0.0, 1.0];
/// let shoulder = Twist::revolute(z, [0.0; 3]);
/// let elbow = Twist::revolute(z, [0.4, 0.0, 0.0]);
/// let hessian = Jacobian::from_columns([shoulder, elbow]).spatial_hessian();
/// // Turning the shoulder moves the elbow's axis towards +y.
/// assert_eq!(hessian.derivatives[0].column(1), Twist::prismatic([0.4, 0.0, 0.0]));
/// assert_eq!(hessian.derivatives[1], Jacobian::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hessian<const N: usize> {
    /// ∂J/∂qₖ for every joint k.
    pub derivatives: [Jacobian<N>; N],
}

impl<const N: usize> Hessian<N> {
    /// J̇ = Σ ∂J/∂qₖ q̇ₖ: the time derivative of the Jacobian at the joint rates.
    #[inline]
    pub fn along(&self, rates: &[Real; N]) -> Jacobian<N> {
        Jacobian {
            rows: core::array::from_fn(|i| {
                core::array::from_fn(|j| {
                    let of = |(slice, rate): (&Jacobian<N>, &Real)| slice.rows[i][j] * rate;
                    self.derivatives.iter().zip(rates).map(of).sum()
                })
            }),
        }
    }

    /// A spatial Hessian as that of another Jacobian; `of` is what one joint's
    /// motion changes.
    #[inline]
    pub(crate) fn seen(
        &self,
        pose: &Pose,
        spatial: &Jacobian<N>,
        of: impl Fn(&Change<N>) -> Jacobian<N>,
    ) -> Self {
        let derivative = |k: usize| {
            of(&Change {
                pose,
                spatial,
                derivative: &self.derivatives[k],
                velocity: spatial.column(k),
            })
        };
        Hessian {
            derivatives: core::array::from_fn(derivative),
        }
    }
}

impl<const N: usize> Default for Hessian<N> {
    /// All zero.
    fn default() -> Self {
        Hessian {
            derivatives: [Jacobian::default(); N],
        }
    }
}

impl<const N: usize> Jacobian<N> {
    /// The time derivative of a spatial Jacobian at the joint rates: J̇ⱼ is the
    /// bracket of the velocity of the link before joint j with ξ′ⱼ.
    ///
    /// `self` is the spatial Jacobian of a serial chain in which every column
    /// is one joint; with joints that mimic others this does not hold.
    #[inline]
    pub fn spatial_dot(&self, rates: &[Real; N]) -> Self {
        let before = self.rows.map(|row| {
            let mut sum = 0.0;
            core::array::from_fn(|j| {
                let before = sum;
                sum += row[j] * rates[j];
                before
            })
        });
        Jacobian { rows: before }.brackets(self)
    }

    /// The derivatives of a spatial Jacobian by every joint. `self` is as for
    /// [`Jacobian::spatial_dot`].
    #[inline]
    pub fn spatial_hessian(&self) -> Hessian<N> {
        let mut hessian = Hessian::default();
        for k in 0..N {
            let mut carrier = Jacobian::default();
            for (carried, row) in carrier.rows.iter_mut().zip(&self.rows) {
                carried[k + 1..].fill(row[k]);
            }
            hessian.derivatives[k] = carrier.brackets(self);
        }
        hessian
    }

    /// The brackets of the columns of this with those of the other.
    #[inline(always)]
    fn brackets(&self, other: &Self) -> Self {
        let ([a, b], [c, d]) = (self.halves(), other.halves());
        let turned = cross(b, c);
        let moved = cross(a, d);
        Self::from_halves([sum(turned, moved), cross(b, d)])
    }

    /// v and ω of all columns.
    #[inline(always)]
    fn halves(&self) -> [[[Real; N]; 3]; 2] {
        let [vx, vy, vz, wx, wy, wz] = self.rows;
        [[vx, vy, vz], [wx, wy, wz]]
    }

    #[inline(always)]
    fn from_halves([[vx, vy, vz], [wx, wy, wz]]: [[[Real; N]; 3]; 2]) -> Self {
        Jacobian {
            rows: [vx, vy, vz, wx, wy, wz],
        }
    }
}

/// N cross products side by side, which become packed instructions.
#[inline(always)]
fn cross<const N: usize>(a: [[Real; N]; 3], b: [[Real; N]; 3]) -> [[Real; N]; 3] {
    let mut product = [[0.0; N]; 3];
    for j in 0..N {
        product[0][j] = a[1][j] * b[2][j] - a[2][j] * b[1][j];
        product[1][j] = a[2][j] * b[0][j] - a[0][j] * b[2][j];
        product[2][j] = a[0][j] * b[1][j] - a[1][j] * b[0][j];
    }
    product
}

#[inline(always)]
fn sum<const N: usize>(mut a: [[Real; N]; 3], b: [[Real; N]; 3]) -> [[Real; N]; 3] {
    for (row, other) in a.iter_mut().zip(&b) {
        for j in 0..N {
            row[j] += other[j];
        }
    }
    a
}

/// The same vector N times.
#[inline(always)]
fn splat<const N: usize>(a: [Real; 3]) -> [[Real; N]; 3] {
    a.map(|x| [x; N])
}

/// A motion of the tip, and how it changes the spatial Jacobian.
pub(crate) struct Change<'a, const N: usize> {
    /// The tip's pose.
    pub pose: &'a Pose,
    /// The spatial Jacobian.
    pub spatial: &'a Jacobian<N>,
    /// Its derivative along the motion.
    pub derivative: &'a Jacobian<N>,
    /// The motion's spatial velocity.
    pub velocity: Twist,
}

impl<const N: usize> Change<'_, N> {
    /// The derivative of v + ω × p, p being the tip's origin.
    #[inline]
    pub fn of_geometric(&self) -> Jacobian<N> {
        let origin_moves = self.velocity.spatial_to_geometric(self.pose).linear;
        let ([v, w], w_now) = (self.derivative.halves(), self.spatial.halves()[1]);
        let carried = cross(w, splat(self.pose.translation));
        let moved = cross(w_now, splat(origin_moves));
        Jacobian::from_halves([sum(sum(v, carried), moved), w])
    }

    /// The derivative of J_b, which is Rᵀ of the geometric Jacobian J:
    /// Rᵀ (J̇ − ω × J).
    #[inline]
    pub fn of_body(&self) -> Jacobian<N> {
        let (now, change) = (self.spatial.halves(), self.derivative.halves());
        let (origin, turning) = (self.pose.translation, self.velocity.angular);
        let origin_moves = self.velocity.spatial_to_geometric(self.pose).linear;
        let mut derivative = Jacobian::default();
        for j in 0..N {
            let at = |half: &[[Real; N]; 3]| [half[0][j], half[1][j], half[2][j]];
            let (w, dw) = (at(&now[1]), at(&change[1]));
            let v = add(at(&now[0]), vector::cross(w, origin));
            let dv = add(at(&change[0]), vector::cross(dw, origin));
            let dv = add(dv, vector::cross(w, origin_moves));
            let relative = |change, now| {
                let carried = vector::cross(turning, now);
                self.pose.rotate_back(vector::sub(change, carried))
            };
            let (dv, dw) = (relative(dv, v), relative(dw, w));
            for i in 0..3 {
                derivative.rows[i][j] = dv[i];
                derivative.rows[i + 3][j] = dw[i];
            }
        }
        derivative
    }
}
