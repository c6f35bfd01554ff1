//! The forms with twists and points.

use crate::sampling::*;
use kin_runtime::__private::math::wrap;
use kin_runtime::subproblems::*;
use kin_runtime::{Pose, Twist};

#[test]
fn screw_forms_recover_random_placements() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (meeting, p) = (random.vector(), random.vector());
        let xi1 = Twist::revolute(random.unit(), meeting);
        let xi2 = Twist::revolute(random.unit(), meeting);
        let (t1, t2) = (random.angle(), random.angle());
        let q = (Pose::exp(&xi1, t1) * Pose::exp(&xi2, t2)).transform_point(p);
        let solutions = paden_kahan2(&xi1, &xi2, p, q);
        let pair = |s: &[f64; 2]| wrap(s[0] - t1).abs().max(wrap(s[1] - t2).abs()) < 1e-6;
        assert!(
            solutions.exact().iter().any(pair),
            "{solutions:?} {t1} {t2}"
        );

        let q = Pose::exp(&xi1, t1).transform_point(p);
        assert!(contains(paden_kahan1(&xi1, p, q).exact(), t1, 1e-12));
        let eye = random.vector();
        let solutions = paden_kahan3(&xi1, p, eye, norm(minus(q, eye)));
        assert!(contains(solutions.exact(), t1, 1e-6));
    }
}

#[test]
fn screws_on_one_line_or_apart() {
    let hinge = Twist::revolute(Z, X);
    let above = Twist::revolute([0.0, 0.0, -1.0], [1.0, 0.0, 3.0]);
    let (p, q) = ([2.0, 0.0, 0.0], [1.0, 1.0, 0.0]);
    assert!(matches!(
        paden_kahan2(&hinge, &above, p, q),
        SolutionSet::Any([_, 0.0])
    ));
    assert_eq!(paden_kahan1(&hinge, X, X), SolutionSet::Any(0.0));
    let skew = Twist::revolute(X, [0.0, 5.0, 0.0]);
    let q = (Pose::exp(&hinge, 0.3) * Pose::exp(&skew, 0.4)).transform_point(p);
    assert!(matches!(
        paden_kahan2(&hinge, &skew, p, q),
        SolutionSet::Closest { .. }
    ));
}
