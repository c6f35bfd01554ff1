//! Rigid motions: the group SE(3) as a rotation matrix and a translation.

use super::super::linear::vector::{add, cross, dot, norm, scale, sub};
use super::super::scalar::Real;
use super::super::{Twist, Wrench, math};

/// A rigid motion g = (R, p), which takes coordinates in the moving frame to
/// coordinates in the fixed one: x ↦ R x + p (MLS section 2.3).
///
/// The rotation is row-major: `rotation[row][column]`. Translations are in
/// metres. Nothing here checks or restores that R is a rotation.
///
/// ```
/// use kin_runtime::Pose;
/// let up = Pose::from_translation([0.0, 0.0, 0.5]);
/// assert_eq!(up.transform_point([1.0, 0.0, 0.0]), [1.0, 0.0, 0.5]);
/// assert_eq!(up * up.inverse(), Pose::IDENTITY);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// The columns are the moving frame's axes in fixed coordinates; row-major.
    pub rotation: [[Real; 3]; 3],
    /// The moving frame's origin in fixed coordinates, metres.
    pub translation: [Real; 3],
}

impl Pose {
    /// The identity of SE(3).
    pub const IDENTITY: Pose = Pose {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };

    /// A translation without rotation, metres.
    #[inline]
    pub const fn from_translation(translation: [Real; 3]) -> Pose {
        Pose {
            translation,
            ..Pose::IDENTITY
        }
    }

    /// R x + p.
    #[inline]
    pub fn transform_point(&self, x: [Real; 3]) -> [Real; 3] {
        add(self.rotate(x), self.translation)
    }

    /// R v, for directions.
    #[inline]
    pub fn rotate(&self, v: [Real; 3]) -> [Real; 3] {
        let [x, y, z] = self.rotation;
        [along(x, v), along(y, v), along(z, v)]
    }

    /// Rᵀ v, for directions.
    #[inline]
    pub fn rotate_back(&self, v: [Real; 3]) -> [Real; 3] {
        let [x, y, z] = transpose(&self.rotation);
        [along(x, v), along(y, v), along(z, v)]
    }

    /// The inverse motion (Rᵀ, −Rᵀ p).
    #[inline]
    pub fn inverse(&self) -> Pose {
        Pose {
            rotation: transpose(&self.rotation),
            // 0 − x rather than −x, which would leave negative zeros.
            translation: sub([0.0; 3], self.rotate_back(self.translation)),
        }
    }

    /// The same turned about its own z axis, radians: a tool that may turn.
    ///
    /// ```
    /// use kin_runtime::Pose;
    /// let tool = Pose::from_axis_angle([0.6, 0.0, 0.8], 1.1, [0.1, 0.2, 0.3]);
    /// let turned = tool.turned(0.4);
    /// assert_eq!(turned.translation, tool.translation);
    /// assert!((tool.turn_to(&turned) - 0.4).abs() < 1e-15);
    /// ```
    #[inline]
    pub fn turned(&self, turn: Real) -> Pose {
        let (sine, cosine) = math::sin_cos(turn);
        let row = |[x, y, z]: [Real; 3]| [x * cosine + y * sine, y * cosine - x * sine, z];
        Pose {
            rotation: self.rotation.map(row),
            ..*self
        }
    }

    /// The turn about its own z axis that brings this nearest to the orientation of
    /// another, radians in (−π, π].
    #[inline]
    pub fn turn_to(&self, other: &Pose) -> Real {
        let along = |i: usize, j: usize| -> Real {
            (0..3)
                .map(|k| self.rotation[k][i] * other.rotation[k][j])
                .sum()
        };
        // The trace of the relative rotation about z, and its part across.
        math::atan2(along(1, 0) - along(0, 1), along(0, 0) + along(1, 1))
    }

    /// Ad_g V (MLS section 2.4): a twist in moving coordinates, seen from the
    /// fixed frame: (R v + p × R ω, R ω).
    ///
    /// ```
    /// use kin_runtime::{Pose, Twist};
    /// let shifted = Pose::from_translation([1.0, 0.0, 0.0]);
    /// let spin = Twist::revolute([0.0, 0.0, 1.0], [0.0; 3]);
    /// assert_eq!(shifted.adjoint(&spin), Twist::revolute([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]));
    /// ```
    #[inline]
    pub fn adjoint(&self, twist: &Twist) -> Twist {
        let angular = self.rotate(twist.angular);
        let lever = cross(self.translation, angular);
        Twist {
            linear: add(self.rotate(twist.linear), lever),
            angular,
        }
    }

    /// Ad_g⁻¹ V: a twist in fixed coordinates, seen from the moving frame.
    #[inline]
    pub fn adjoint_inverse(&self, twist: &Twist) -> Twist {
        let lever = cross(self.translation, twist.angular);
        Twist {
            linear: self.rotate_back(sub(twist.linear, lever)),
            angular: self.rotate_back(twist.angular),
        }
    }

    /// Ad_gᵀ F (MLS section 2.5): a wrench in fixed coordinates, seen from the
    /// moving frame, so that it does the same work on the same motion.
    ///
    /// ```
    /// use kin_runtime::{Pose, Wrench};
    /// let sensor = Pose::from_translation([0.2, 0.0, 0.0]);
    /// let weight = Wrench { force: [0.0, 0.0, -10.0], moment: [0.0; 3] };
    /// assert_eq!(sensor.adjoint_transpose(&weight).moment, [0.0, -2.0, 0.0]);
    /// ```
    #[inline]
    pub fn adjoint_transpose(&self, wrench: &Wrench) -> Wrench {
        let lever = cross(self.translation, wrench.force);
        Wrench {
            force: self.rotate_back(wrench.force),
            moment: self.rotate_back(sub(wrench.moment, lever)),
        }
    }

    /// The inverse of [`Pose::adjoint_transpose`]: a wrench in moving
    /// coordinates, seen from the fixed frame.
    #[inline]
    pub fn adjoint_inverse_transpose(&self, wrench: &Wrench) -> Wrench {
        let force = self.rotate(wrench.force);
        let lever = cross(self.translation, force);
        Wrench {
            force,
            moment: add(self.rotate(wrench.moment), lever),
        }
    }

    /// The distance between the two origins, metres.
    #[inline]
    pub fn translation_distance(&self, other: &Pose) -> Real {
        norm(sub(self.translation, other.translation))
    }

    /// The angle of the rotation between the two, radians in [0, π]. Accurate
    /// to a few 1e-16 at any angle.
    ///
    /// ```
    /// use kin_runtime::Pose;
    /// let turned = Pose::from_axis_angle([1.0, 1.0, 0.0], 1e-9, [0.0; 3]);
    /// assert!((turned.rotation_distance(&Pose::IDENTITY) - 1e-9).abs() < 1e-15);
    /// ```
    #[inline]
    pub fn rotation_distance(&self, other: &Pose) -> Real {
        let between = (self.inverse() * *other).rotation;
        let doubled_sine = norm(skew_part(&between));
        math::atan2(doubled_sine, trace(&between) - 1.0)
    }

    /// How far the matrix is from a rotation: the root of the sum of squares of
    /// what columns x and y miss of unit length and a right angle, and z of
    /// x × y. A rotation rounded to k digits has about 10⁻ᵏ, a reflection 2.
    ///
    /// Inverse kinematics takes matrices as rotations up to 1e-9 and answers no
    /// others: an empty answer to a target with more than that says nothing of
    /// the arm's reach; see [`Pose::orthonormalized`].
    ///
    /// ```
    /// use kin_runtime::Pose;
    /// let turned = Pose::from_axis_angle([0.0, 0.0, 1.0], 0.3, [0.0; 3]);
    /// assert!(turned.rotation_error() < 1e-15);
    /// let rounded = Pose { rotation: turned.rotation.map(|row| row.map(|x| f64::from(x as f32))), ..turned };
    /// assert!(rounded.rotation_error() > 1e-9 && rounded.rotation_error() < 1e-7);
    /// ```
    #[inline]
    pub fn rotation_error(&self) -> Real {
        let [x, y, z] = transpose(&self.rotation);
        let rest = sub(z, cross(x, y));
        let missing = [0.5 * (dot(x, x) - 1.0), 0.5 * (dot(y, y) - 1.0), dot(x, y)];
        math::sqrt(dot(missing, missing) + dot(rest, rest))
    }

    /// The pose with the rotation nearest to its matrix (in the Frobenius norm,
    /// the orthogonal factor of the polar decomposition), for targets that were
    /// rounded: to `f32`, or to the digits of a file. None where the matrix is
    /// too far from any rotation to tell which one was meant: more than 0.1 by
    /// [`Pose::rotation_error`], or not finite.
    ///
    /// By Newton's iteration X ← (X + X⁻ᵀ)/2 (Higham, "Computing the polar
    /// decomposition", SIAM J. Sci. Stat. Comput. 7, 1986); accurate to rounding.
    ///
    /// ```
    /// use kin_runtime::Pose;
    /// let turned = Pose::from_axis_angle([0.0, 0.6, 0.8], 0.3, [0.0; 3]);
    /// let rounded = Pose { rotation: turned.rotation.map(|row| row.map(|x| f64::from(x as f32))), ..turned };
    /// let mended = rounded.orthonormalized().unwrap();
    /// assert!(mended.rotation_error() < 1e-15);
    /// assert!(mended.rotation_distance(&turned) < 1e-7);
    /// assert_eq!(Pose { rotation: [[0.0; 3]; 3], ..turned }.orthonormalized(), None);
    /// ```
    pub fn orthonormalized(&self) -> Option<Pose> {
        /// The error of 0.1 is squared by each.
        const STEPS: usize = 5;
        let error = self.rotation_error();
        if error > 0.1 || error.is_nan() {
            return None;
        }
        let mut columns = transpose(&self.rotation);
        for _ in 0..STEPS {
            let [x, y, z] = columns;
            // The columns of X⁻ᵀ.
            let dual = [cross(y, z), cross(z, x), cross(x, y)];
            let volume = dot(x, dual[0]);
            columns = core::array::from_fn(|i| {
                let inverse = scale(1.0 / volume, dual[i]);
                scale(0.5, add(columns[i], inverse))
            });
        }
        Some(Pose {
            rotation: transpose(&columns),
            ..*self
        })
    }

    /// The homogeneous 4×4 matrix, row-major.
    #[inline]
    pub fn to_matrix(&self) -> [[Real; 4]; 4] {
        let (r, p) = (&self.rotation, self.translation);
        let row = |i: usize| [r[i][0], r[i][1], r[i][2], p[i]];
        [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
    }

    /// From the upper three rows of a homogeneous 4×4 matrix, row-major.
    #[inline]
    pub fn from_matrix(matrix: &[[Real; 4]; 4]) -> Pose {
        let row = |i: usize| [matrix[i][0], matrix[i][1], matrix[i][2]];
        Pose {
            rotation: [row(0), row(1), row(2)],
            translation: core::array::from_fn(|i| matrix[i][3]),
        }
    }
}

impl Default for Pose {
    /// The identity.
    fn default() -> Pose {
        Pose::IDENTITY
    }
}

impl core::ops::Mul for Pose {
    type Output = Pose;
    /// Composition: first `rhs`, then `self`.
    #[inline]
    fn mul(self, rhs: Pose) -> Pose {
        let [x, y, z] = transpose(&rhs.rotation);
        let columns = [self.rotate(x), self.rotate(y), self.rotate(z)];
        Pose {
            rotation: transpose(&columns),
            translation: self.transform_point(rhs.translation),
        }
    }
}

// Written out, here and where poses are multiplied: the compiler of robots runs in
// builds without optimizations, where closures take most of its time.
#[inline(always)]
fn transpose([x, y, z]: &[[Real; 3]; 3]) -> [[Real; 3]; 3] {
    [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]]
}

#[inline(always)]
fn along(row: [Real; 3], v: [Real; 3]) -> Real {
    row[0] * v[0] + row[1] * v[1] + row[2] * v[2]
}

/// The vector of R − Rᵀ: 2 sin θ times the axis.
#[inline(always)]
fn skew_part(r: &[[Real; 3]; 3]) -> [Real; 3] {
    [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]]
}

#[inline(always)]
fn trace(r: &[[Real; 3]; 3]) -> Real {
    r[0][0] + r[1][1] + r[2][2]
}
