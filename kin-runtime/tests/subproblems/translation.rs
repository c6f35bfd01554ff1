//! The prismatic subproblems.

use crate::sampling::*;
use kin_runtime::subproblems::*;

#[test]
fn translations_recover_the_travel() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (v, p, q, t) = (
            random.unit(),
            random.vector(),
            random.vector(),
            random.next(),
        );
        let d = norm(minus(shifted(p, t, v), q));
        let solutions = translation1(v, p, q, d);
        assert!(solutions.exact().iter().any(|s| (s - t).abs() < 1e-6));
        assert!(solutions.exact().is_sorted());
        for s in solutions.exact() {
            assert!((norm(minus(shifted(p, *s, v), q)) - d).abs() < 1e-13);
        }
        let h = random.unit();
        let d = dot(h, shifted(p, t, v));
        let solutions = translation2(h, v, p, d);
        assert!((dot(h, shifted(p, solutions.exact()[0], v)) - d).abs() < 1e-14);
    }
}

#[test]
fn translations_touch_miss_and_degenerate() {
    let q = [1.0, 2.0, 0.0];
    assert_eq!(translation1(X, [0.0; 3], q, 2.0).exact(), [1.0]);
    assert_eq!(
        translation1(X, [0.0; 3], q, 1.5),
        SolutionSet::Closest {
            value: 1.0,
            residual: 0.5
        }
    );
    assert!(translation1(X, [0.0; 3], X, -0.5).exact().is_empty());
    assert_eq!(translation2(Z, X, q, 0.0), SolutionSet::Any(0.0));
    assert_eq!(
        translation2(Z, X, q, 0.5),
        SolutionSet::Closest {
            value: 0.0,
            residual: 0.5
        }
    );
}
