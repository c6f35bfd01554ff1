//! Rigid motions: the group SE(3) as a rotation matrix and a translation.

/// A rigid motion g = (R, p), which takes coordinates in the moving frame to
/// coordinates in the fixed one: x ↦ R x + p (MLS section 2.3).
///
/// The rotation is row-major: `rotation[row][column]`. Translations are in
/// metres.
///
/// ```
/// use kin_runtime::Pose;
/// let up = Pose { translation: [0.0, 0.0, 0.5], ..Pose::IDENTITY };
/// assert_eq!(up.transform_point([1.0, 0.0, 0.0]), [1.0, 0.0, 0.5]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The columns are the moving frame's axes in fixed coordinates; row-major.
    pub rotation: [[f64; 3]; 3],
    /// The moving frame's origin in fixed coordinates, metres.
    pub translation: [f64; 3],
}

impl Pose {
    /// The identity of SE(3).
    pub const IDENTITY: Pose = Pose {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        translation: [0.0; 3],
    };

    /// R x + p.
    #[inline]
    pub fn transform_point(&self, x: [f64; 3]) -> [f64; 3] {
        let v = self.rotate(x);
        let p = self.translation;
        [v[0] + p[0], v[1] + p[1], v[2] + p[2]]
    }

    /// R v, for directions.
    #[inline]
    pub fn rotate(&self, v: [f64; 3]) -> [f64; 3] {
        self.rotation
            .map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// Rᵀ v, for directions.
    #[inline]
    pub fn rotate_back(&self, v: [f64; 3]) -> [f64; 3] {
        let r = &self.rotation;
        core::array::from_fn(|i| r[0][i] * v[0] + r[1][i] * v[1] + r[2][i] * v[2])
    }

    /// The inverse motion (Rᵀ, −Rᵀ p).
    #[inline]
    pub fn inverse(&self) -> Pose {
        let r = &self.rotation;
        Pose {
            rotation: core::array::from_fn(|i| core::array::from_fn(|j| r[j][i])),
            translation: self.rotate_back(self.translation).map(|x| -x),
        }
    }
}

impl core::ops::Mul for Pose {
    type Output = Pose;
    /// Composition: first `rhs`, then `self`.
    #[inline]
    fn mul(self, rhs: Pose) -> Pose {
        let columns = rhs
            .inverse_rotation_rows()
            .map(|column| self.rotate(column));
        Pose {
            rotation: core::array::from_fn(|i| core::array::from_fn(|j| columns[j][i])),
            translation: self.transform_point(rhs.translation),
        }
    }
}

impl Pose {
    /// The columns of the rotation.
    fn inverse_rotation_rows(&self) -> [[f64; 3]; 3] {
        let r = &self.rotation;
        core::array::from_fn(|j| core::array::from_fn(|i| r[i][j]))
    }
}
