//! Poses and Jacobians.

use crate::subject::{Subject, configurations};
use kinematics::{Kinematics, single};

/// Relative to the arm's size: some operations of 6e-8 each.
const ROUNDING: f64 = 1e-6;

pub fn has_seven_digits<S, D, const N: usize>(subject: &Subject<S, D>)
where
    S: single::Kinematics<N>,
    D: Kinematics<N>,
{
    let Subject { single, double, .. } = subject;
    let size = subject.size().max(1.0);
    let near = |a: &[f32], b: &[f64]| {
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().zip(b) {
            assert!((f64::from(*a) - b).abs() < ROUNDING * size, "{a} {b}");
        }
    };
    let poses = |a: &single::Pose, b: &kinematics::Pose| {
        near(a.rotation.as_flattened(), b.rotation.as_flattened());
        near(&a.translation, &b.translation);
    };
    for q in configurations::<N>() {
        let rounded = q.map(|x| x as f32);
        // The same numbers in both.
        let q = rounded.map(f64::from);
        poses(&single.fk(&rounded), &double.fk(&q));
        for (a, b) in single.fk_links(&rounded).iter().zip(&double.fk_links(&q)) {
            poses(a, b);
        }
        let (pose, jacobian) = single.fk_jacobian(&rounded);
        poses(&pose, &double.fk(&q));
        let pairs = [
            (jacobian, double.fk_jacobian(&q).1),
            (
                single.spatial_jacobian(&rounded),
                double.spatial_jacobian(&q),
            ),
            (single.body_jacobian(&rounded), double.body_jacobian(&q)),
            (
                single.geometric_jacobian(&rounded),
                double.geometric_jacobian(&q),
            ),
        ];
        for (a, b) in pairs {
            near(a.rows.as_flattened(), b.rows.as_flattened());
        }
    }
}
