//! Subproblems 1 to 4.

use crate::sampling::*;
use core::f64::consts::{FRAC_PI_2, PI};
use kin_runtime::__private::math::wrap;
use kin_runtime::subproblems::*;

#[test]
fn subproblem1_recovers_the_angle() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (k, p, t) = (random.unit(), random.vector(), random.angle());
        let solutions = subproblem1(k, p, rotated(k, t, p));
        assert_eq!(solutions.exact().len(), 1);
        assert!(contains(solutions.exact(), t, 1e-13), "{solutions:?} {t}");
    }
}

#[test]
fn subproblem1_is_closest_where_no_angle_solves_it() {
    let mut random = stream();
    for _ in 0..200 {
        let (k, p, q) = (random.unit(), random.vector(), random.vector());
        let off = |t: f64| norm(minus(rotated(k, t, p), q));
        let SolutionSet::Closest { value, residual } = subproblem1(k, p, q) else {
            panic!()
        };
        assert!((off(value) - residual).abs() < 1e-14);
        assert!((0..360).all(|i| off(f64::from(i).to_radians()) >= residual - 1e-14));
    }
}

#[test]
fn subproblem1_on_the_axis_is_solved_by_any_angle() {
    assert_eq!(subproblem1(Z, Z, Z), SolutionSet::Any(0.0));
    assert_eq!(subproblem1(Z, [0.0; 3], [0.0; 3]), SolutionSet::Any(0.0));
    assert_eq!(
        subproblem1(Z, Z, [0.0, 0.0, -1.0]),
        SolutionSet::Closest {
            value: 0.0,
            residual: 2.0
        }
    );
    assert!(matches!(subproblem1(Z, X, Z), SolutionSet::Closest { .. }));
}

#[test]
fn subproblem1_names_the_half_turn_pi() {
    assert_eq!(subproblem1(Z, X, [-1.0, -0.0, 0.0]).exact(), [PI]);
    assert_eq!(
        subproblem1([0.0, 0.0, -1.0], X, [-1.0, 0.0, 0.0]).exact(),
        [PI]
    );
}

#[test]
fn subproblem2_answers_are_sound_and_recover_the_pair() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (k1, k2, p2) = (random.unit(), random.unit(), random.vector());
        let (t1, t2) = (random.angle(), random.angle());
        let p1 = rotated(k1, -t1, rotated(k2, t2, p2));
        let solutions = subproblem2(k1, k2, p1, p2);
        for [s1, s2] in solutions.exact() {
            let gap = norm(minus(rotated(k1, *s1, p1), rotated(k2, *s2, p2)));
            assert!(gap < 1e-12, "{gap:e}");
        }
        let pair = |s: &&[f64; 2]| wrap(s[0] - t1).abs().max(wrap(s[1] - t2).abs()) < 1e-6;
        assert_eq!(
            solutions.exact().iter().filter(pair).count(),
            1,
            "{solutions:?}"
        );
    }
}

/// However badly the axes tell the angles, these take the vectors together to rounding.
#[test]
fn subproblem2_is_sound_for_axes_that_are_nearly_parallel() {
    let mut random = stream();
    for decade in 1..11 {
        let apart = 0.1_f64.powi(decade);
        let mut solved = 0;
        for _ in 0..SAMPLES / 10 {
            let (k1, p2) = (random.unit(), random.unit());
            let across = cross(k1, random.unit());
            let k2 = rotated(times(1.0 / norm(across), across), apart, k1);
            let p1 = rotated(k1, random.angle(), rotated(k2, random.angle(), p2));
            let solutions = subproblem2(k1, k2, p1, p2);
            solved += usize::from(!solutions.exact().is_empty());
            for [s1, s2] in solutions.exact() {
                let gap = norm(minus(rotated(k1, *s1, p1), rotated(k2, *s2, p2)));
                assert!(gap < 1e-14, "{apart:e}: {gap:e}");
            }
        }
        assert_eq!(solved, SAMPLES / 10, "{apart:e}");
    }
}

#[test]
fn subproblem2_finds_as_many_pairs_as_sampling() {
    let mut random = stream();
    for _ in 0..500 {
        let (k1, k2, u1, u2) = (random.unit(), random.unit(), random.unit(), random.unit());
        // On the sphere the circles meet where the first has the second's height.
        let expected = sign_changes(|t| dot(k2, minus(rotated(k1, t, u1), u2)));
        assert_eq!(subproblem2(k1, k2, u1, u2).exact().len(), expected);
    }
}

#[test]
fn subproblem2_is_closest_where_no_pair_solves_it() {
    let mut random = stream();
    for _ in 0..40 {
        let (k1, k2, p1, p2) = (
            random.unit(),
            random.unit(),
            random.vector(),
            random.vector(),
        );
        let off = |t1: f64, t2: f64| norm(minus(rotated(k1, t1, p1), rotated(k2, t2, p2)));
        let SolutionSet::Closest { value, residual } = subproblem2(k1, k2, p1, p2) else {
            panic!()
        };
        assert!((off(value[0], value[1]) - residual).abs() < 1e-13);
        let steps = || (0..72).map(|i| f64::from(5 * i).to_radians());
        assert!(steps().all(|t1| steps().all(|t2| off(t1, t2) >= residual - 1e-13)));
    }
}

#[test]
fn subproblem2_gives_touching_circles_once() {
    // Heights 60 degrees from x and 30 degrees from z touch in the plane between.
    let p1 = rotated(X, 1.0, [0.5, 0.0, 0.75_f64.sqrt()]);
    let p2 = rotated(Z, 2.0, [0.5, 0.0, 0.75_f64.sqrt()]);
    let solutions = subproblem2(X, Z, p1, p2);
    assert_eq!(solutions.exact().len(), 1, "{solutions:?}");
    assert!((solutions.exact()[0][0] + 1.0).abs() < 1e-7);
}

#[test]
fn subproblem2_names_its_families() {
    let minus_z = [0.0, 0.0, -1.0];
    assert!(matches!(subproblem2(Z, Z, X, Y), SolutionSet::Any([t, 0.0]) if t == FRAC_PI_2));
    assert!(matches!(subproblem2(Z, minus_z, X, Y), SolutionSet::Any(_)));
    assert!(matches!(subproblem2(Z, X, Z, Y), SolutionSet::Any([0.0, t]) if t == FRAC_PI_2));
    assert!(matches!(subproblem2(X, Z, Y, Z), SolutionSet::Any([t, 0.0]) if t == FRAC_PI_2));
    assert!(matches!(
        subproblem2(X, Z, [0.0; 3], [0.0; 3]),
        SolutionSet::Any(_)
    ));
    assert!(matches!(
        subproblem2(Z, Z, X, [2.0, 0.0, 0.0]),
        SolutionSet::Closest { residual: 1.0, .. }
    ));
    assert!(matches!(
        subproblem2(Z, X, Z, X),
        SolutionSet::Closest { .. }
    ));
}

#[test]
fn subproblem3_answers_are_sound_complete_and_recover_the_angle() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (k, p, q, t) = (
            random.unit(),
            random.vector(),
            random.vector(),
            random.angle(),
        );
        let off = |t: f64| norm(minus(rotated(k, t, p), q));
        let d = off(t);
        let solutions = subproblem3(k, p, q, d);
        assert!(
            solutions
                .exact()
                .iter()
                .all(|&t| (off(t) - d).abs() < 1e-13)
        );
        assert!(contains(solutions.exact(), t, 1e-6), "{solutions:?} {t}");
        let other = random.next().abs();
        let count = sign_changes(|t| off(t) - other);
        assert_eq!(subproblem3(k, p, q, other).exact().len(), count);
    }
}

#[test]
fn subproblem3_out_of_reach_comes_closest() {
    let q = [2.0, 0.0, 0.5];
    let SolutionSet::Closest { value, residual } = subproblem3(Z, Y, q, 4.0) else {
        panic!()
    };
    assert!((value - FRAC_PI_2).abs() < 1e-15);
    assert!((residual - (4.0 - 9.25_f64.sqrt())).abs() < 1e-15);
    let SolutionSet::Closest { value, .. } = subproblem3(Z, Y, q, 0.25) else {
        panic!()
    };
    assert!((value + FRAC_PI_2).abs() < 1e-15);
    assert!(subproblem3(Z, X, X, -1.0).exact().is_empty());
}

#[test]
fn subproblem3_stretched_and_folded_are_double_roots() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (t, reach) = (random.angle(), 2.0 + random.next());
        let q = rotated(Z, t, [reach, 0.0, 0.3]);
        let stretched = (0.09 + (reach + 0.8) * (reach + 0.8)).sqrt();
        let folded = (0.09 + (reach - 0.8) * (reach - 0.8)).sqrt();
        for (d, expected) in [(folded, t), (stretched, t + PI)] {
            let solutions = subproblem3(Z, [0.8, 0.0, 0.0], q, d);
            assert_eq!(solutions.exact().len(), 1);
            assert!(contains(solutions.exact(), expected, 1e-14));
        }
    }
}

#[test]
fn subproblem3_on_the_axis_is_solved_by_any_angle_or_none() {
    assert_eq!(
        subproblem3(Z, [0.0, 0.0, 4.0], [3.0, 0.0, 0.0], 5.0),
        SolutionSet::Any(0.0)
    );
    assert_eq!(
        subproblem3(Z, [3.0, 0.0, 0.0], [0.0, 0.0, 4.0], 5.0),
        SolutionSet::Any(0.0)
    );
    assert!(matches!(
        subproblem3(Z, Z, X, 5.0),
        SolutionSet::Closest { .. }
    ));
}

#[test]
fn subproblem4_answers_are_sound_complete_and_recover_the_angle() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (h, k, p, t) = (
            random.unit(),
            random.unit(),
            random.vector(),
            random.angle(),
        );
        let component = |t: f64| dot(h, rotated(k, t, p));
        let d = component(t);
        let solutions = subproblem4(h, k, p, d);
        assert!(
            solutions
                .exact()
                .iter()
                .all(|&t| (component(t) - d).abs() < 1e-14)
        );
        assert!(contains(solutions.exact(), t, 1e-6), "{solutions:?} {t}");
        let other = random.next();
        let count = sign_changes(|t| component(t) - other);
        assert_eq!(subproblem4(h, k, p, other).exact().len(), count);
    }
}

#[test]
fn subproblem4_extremes_are_double_roots() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let t = random.angle();
        let p = rotated(Z, -t, [0.7, 0.0, 0.4]);
        assert!(contains(subproblem4(X, Z, p, 0.7).exact(), t, 1e-14));
        assert!(contains(subproblem4(X, Z, p, -0.7).exact(), t + PI, 1e-14));
        assert_eq!(subproblem4(X, Z, p, 0.7).exact().len(), 1);
    }
}

#[test]
fn subproblem4_degenerate_and_out_of_reach() {
    assert_eq!(
        subproblem4(Z, Z, [0.3, 0.0, 0.4], 0.4),
        SolutionSet::Any(0.0)
    );
    assert_eq!(
        subproblem4(X, Z, [0.0, 0.0, 0.4], 0.0),
        SolutionSet::Any(0.0)
    );
    assert!(matches!(
        subproblem4(Z, Z, X, 0.4),
        SolutionSet::Closest { residual: 0.4, .. }
    ));
    let low = subproblem4(X, Z, X, -1.5);
    assert_eq!(
        low,
        SolutionSet::Closest {
            value: PI,
            residual: 0.5
        }
    );
}
