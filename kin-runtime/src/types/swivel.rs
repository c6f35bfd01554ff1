//! The swivel angle of an arm with a spherical shoulder and a spherical wrist.

use super::super::linear::vector::{add, cross, dot, norm, scale, sub};
use super::super::scalar::Real;
use super::super::{Jacobian, Pose, math};

/// The arm angle, or swivel: how far the elbow of an arm with a spherical shoulder and a
/// spherical wrist is turned about the line from shoulder to wrist, while these stay (K.
/// Kreutz-Delgado, M. Long, H. Seraji, "Kinematic analysis of 7-DOF manipulators", Int. J.
/// Robotics Research 11, 1992; M. Shimizu et al., "Analytical inverse kinematic computation for
/// 7-DOF redundant manipulators with joint limits", IEEE Trans. Robotics 24, 2008).
///
/// With S the shoulder, E the elbow, W the wrist and V the reference direction, it is the angle
/// about W − S from the half plane of V to that of E − S: 0 where the elbow is on the side to
/// which V points, right-handed.
///
/// It is not defined where W is on the line through S along V (the representation's own
/// singularity: there are no two half planes), nor where E is on the line through S and W
/// (the arm is straight, and turning the elbow moves nothing).
///
/// ```
/// use kin_runtime::Swivel;
/// let swivel = Swivel {
///     shoulder: [0.0; 3],
///     link: 2,
///     elbow: [0.0; 3],
///     wrist: [0.0; 3],
///     reference: [0.0, 0.0, 1.0],
/// };
/// // An elbow above the line to the wrist, and one beside it.
/// assert_eq!(swivel.of_points([0.4, 0.0, 0.3], [0.8, 0.0, 0.0]), 0.0);
/// let beside = swivel.of_points([0.4, -0.3, 0.0], [0.8, 0.0, 0.0]);
/// assert!((beside - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swivel {
    /// S: where the first three axes meet; base coordinates, metres.
    pub shoulder: [Real; 3],
    /// The link that the elbow is a point of, by its place from 0.
    pub link: usize,
    /// E: the point of the third axis next to the fourth; in the frame of that link.
    pub elbow: [Real; 3],
    /// W: where the last three axes meet; in the frame of the tip.
    pub wrist: [Real; 3],
    /// V: the direction of the first axis; base coordinates, a unit vector.
    pub reference: [Real; 3],
}

impl Swivel {
    /// The swivel angle of a configuration, radians in (−π, π], from the poses of its links and
    /// of its tip.
    pub fn angle<const N: usize>(&self, links: &[Pose; N], tip: &Pose) -> Real {
        let [elbow, wrist] = self.points(links, tip);
        self.of_points(elbow, wrist)
    }

    /// Elbow and wrist in base coordinates, metres.
    pub fn points<const N: usize>(&self, links: &[Pose; N], tip: &Pose) -> [[Real; 3]; 2] {
        [
            links[self.link].transform_point(self.elbow),
            tip.transform_point(self.wrist),
        ]
    }

    /// The same from elbow and wrist in base coordinates, metres.
    pub fn of_points(&self, elbow: [Real; 3], wrist: [Real; 3]) -> Real {
        let way = sub(wrist, self.shoulder);
        let way = scale(1.0 / norm(way), way);
        let aside = sub(self.reference, scale(dot(self.reference, way), way));
        let elbow = sub(elbow, self.shoulder);
        math::atan2(dot(cross(way, aside), elbow), dot(aside, elbow))
    }

    /// How the angle changes with the joints while the wrist rests, and the angle itself; from
    /// the poses of links and tip and the spatial Jacobian.
    pub fn row<const N: usize>(
        &self,
        links: &[Pose; N],
        tip: &Pose,
        spatial: &Jacobian<N>,
    ) -> ([Real; N], Real) {
        let [elbow, wrist] = self.points(links, tip);
        let (gradient, _) = self.gradient(elbow, wrist);
        let row = core::array::from_fn(|joint| match joint <= self.link {
            true => {
                let twist = spatial.column(joint);
                dot(gradient, add(twist.linear, cross(twist.angular, elbow)))
            }
            false => 0.0,
        });
        (row, self.of_points(elbow, wrist))
    }

    /// How the angle changes with the elbow while the wrist rests, radians for a metre, and
    /// the elbow's distance from the line of shoulder and wrist, metres.
    pub fn gradient(&self, elbow: [Real; 3], wrist: [Real; 3]) -> ([Real; 3], Real) {
        let way = sub(wrist, self.shoulder);
        let way = scale(1.0 / norm(way), way);
        let elbow = sub(elbow, self.shoulder);
        let aside = add(elbow, scale(-dot(elbow, way), way));
        let radius = norm(aside);
        (scale(1.0 / (radius * radius), cross(way, aside)), radius)
    }

    /// The half plane in which the elbow is at an angle, radians, with the wrist somewhere, base
    /// coordinates in metres: its direction across the line of shoulder and wrist, and its normal, to
    /// which the angle grows. Zeros where it is not defined.
    pub(crate) fn half_plane(&self, angle: Real, wrist: [Real; 3]) -> [[Real; 3]; 2] {
        let unit = |v: [Real; 3]| scale(1.0 / math::max(norm(v), Real::MIN_POSITIVE), v);
        let way = unit(sub(wrist, self.shoulder));
        let aside = unit(sub(self.reference, scale(dot(self.reference, way), way)));
        let beside = cross(way, aside);
        let (sin, cos) = math::sin_cos(angle);
        [
            add(scale(cos, aside), scale(sin, beside)),
            add(scale(cos, beside), scale(-sin, aside)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The elbow is in the half plane of its angle, and turned further beside it, to the side of the
    /// normal.
    #[test]
    fn an_elbow_is_in_the_half_plane_of_its_angle() {
        let swivel = Swivel {
            shoulder: [0.1, -0.2, 0.3],
            link: 2,
            elbow: [0.0; 3],
            wrist: [0.0; 3],
            reference: [0.0, 0.6, 0.8],
        };
        let wrist = [0.5, 0.4, 0.2];
        for elbow in [[0.4, 0.0, 0.6], [0.2, 0.3, -0.1], [0.0, 0.2, 0.5]] {
            let angle = swivel.of_points(elbow, wrist);
            let from = sub(elbow, swivel.shoulder);
            let [direction, normal] = swivel.half_plane(angle, wrist);
            let rounding = 16.0 * Real::EPSILON;
            assert!(dot(normal, from).abs() < rounding && dot(direction, from) > 0.1);
            assert!(dot(normal, direction).abs() < rounding);
            assert!((norm(normal) - 1.0).abs() < rounding);
            let before = swivel.half_plane(angle - 0.1, wrist)[1];
            assert!(dot(before, from) > 0.0);
        }
        // On the line through the shoulder along the reference, and in the shoulder, there is none.
        for wrist in [[0.1, 0.4, 1.1], swivel.shoulder] {
            let [direction, normal] = swivel.half_plane(0.3, wrist);
            let all = direction.into_iter().chain(normal);
            assert!(all.into_iter().all(Real::is_finite));
        }
    }
}
