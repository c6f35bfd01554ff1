//! Every subproblem: its answers solve it, the answer it was made from is among
//! them, none is missing, and degenerate input is named as such.

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use kin_runtime::math::wrap;
use kin_runtime::subproblems::*;
use kin_runtime::{Pose, Twist};

type Vector = [f64; 3];

const X: Vector = [1.0, 0.0, 0.0];
const Y: Vector = [0.0, 1.0, 0.0];
const Z: Vector = [0.0, 0.0, 1.0];

/// A deterministic stream of numbers in [−1, 1).
struct Stream(u64);

impl Stream {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    fn angle(&mut self) -> f64 {
        PI * self.next()
    }
    fn vector(&mut self) -> Vector {
        [self.next(), self.next(), self.next()]
    }
    fn unit(&mut self) -> Vector {
        let v = self.vector();
        v.map(|x| x / norm(v))
    }
}

const SAMPLES: usize = 2000;

fn stream() -> Stream {
    Stream(0x2545_f491_4f6c_dd1d)
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn shifted(p: Vector, t: f64, v: Vector) -> Vector {
    [p[0] + t * v[0], p[1] + t * v[1], p[2] + t * v[2]]
}

fn rotated(k: Vector, t: f64, p: Vector) -> Vector {
    Pose::from_axis_angle(k, t, [0.0; 3]).rotate(p)
}

fn contains(roots: &[f64], t: f64, tolerance: f64) -> bool {
    roots.iter().any(|root| wrap(root - t).abs() < tolerance)
}

/// The roots of `f` on the circle, each bracketed by a sign change between two
/// of 720 samples.
fn sign_changes(f: impl Fn(f64) -> f64) -> usize {
    let at = |i: usize| f(TAU * (i as f64 + 0.123) / 720.0 - PI);
    (0..720)
        .filter(|&i| (at(i) > 0.0) != (at(i + 1) > 0.0))
        .count()
}

#[test]
fn subproblem1_recovers_the_angle() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (k, p, t) = (random.unit(), random.vector(), random.angle());
        let answer = subproblem1(k, p, rotated(k, t, p));
        assert_eq!(answer.exact().len(), 1);
        assert!(contains(answer.exact(), t, 1e-13), "{answer:?} {t}");
    }
}

#[test]
fn subproblem1_is_closest_where_no_angle_solves_it() {
    let mut random = stream();
    for _ in 0..200 {
        let (k, p, q) = (random.unit(), random.vector(), random.vector());
        let off = |t: f64| norm(minus(rotated(k, t, p), q));
        let Answer::Closest { value, residual } = subproblem1(k, p, q) else {
            panic!()
        };
        assert!((off(value) - residual).abs() < 1e-14);
        assert!((0..360).all(|i| off(f64::from(i).to_radians()) >= residual - 1e-14));
    }
}

#[test]
fn subproblem1_on_the_axis_is_solved_by_any_angle() {
    assert_eq!(subproblem1(Z, Z, Z), Answer::Any(0.0));
    assert_eq!(subproblem1(Z, [0.0; 3], [0.0; 3]), Answer::Any(0.0));
    assert_eq!(
        subproblem1(Z, Z, [0.0, 0.0, -1.0]),
        Answer::Closest {
            value: 0.0,
            residual: 2.0
        }
    );
    assert!(matches!(subproblem1(Z, X, Z), Answer::Closest { .. }));
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
        let answer = subproblem2(k1, k2, p1, p2);
        for [s1, s2] in answer.exact() {
            let gap = norm(minus(rotated(k1, *s1, p1), rotated(k2, *s2, p2)));
            assert!(gap < 1e-12, "{gap:e}");
        }
        let pair = |s: &&[f64; 2]| wrap(s[0] - t1).abs().max(wrap(s[1] - t2).abs()) < 1e-6;
        assert_eq!(answer.exact().iter().filter(pair).count(), 1, "{answer:?}");
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
        let Answer::Closest { value, residual } = subproblem2(k1, k2, p1, p2) else {
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
    let answer = subproblem2(X, Z, p1, p2);
    assert_eq!(answer.exact().len(), 1, "{answer:?}");
    assert!((answer.exact()[0][0] + 1.0).abs() < 1e-7);
}

#[test]
fn subproblem2_names_its_families() {
    let minus_z = [0.0, 0.0, -1.0];
    assert!(matches!(subproblem2(Z, Z, X, Y), Answer::Any([t, 0.0]) if t == FRAC_PI_2));
    assert!(matches!(subproblem2(Z, minus_z, X, Y), Answer::Any(_)));
    assert!(matches!(subproblem2(Z, X, Z, Y), Answer::Any([0.0, t]) if t == FRAC_PI_2));
    assert!(matches!(subproblem2(X, Z, Y, Z), Answer::Any([t, 0.0]) if t == FRAC_PI_2));
    assert!(matches!(
        subproblem2(X, Z, [0.0; 3], [0.0; 3]),
        Answer::Any(_)
    ));
    assert!(matches!(
        subproblem2(Z, Z, X, [2.0, 0.0, 0.0]),
        Answer::Closest { residual: 1.0, .. }
    ));
    assert!(matches!(subproblem2(Z, X, Z, X), Answer::Closest { .. }));
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
        let answer = subproblem3(k, p, q, d);
        assert!(answer.exact().iter().all(|&t| (off(t) - d).abs() < 1e-13));
        assert!(contains(answer.exact(), t, 1e-6), "{answer:?} {t}");
        let other = random.next().abs();
        let count = sign_changes(|t| off(t) - other);
        assert_eq!(subproblem3(k, p, q, other).exact().len(), count);
    }
}

#[test]
fn subproblem3_out_of_reach_comes_closest() {
    let q = [2.0, 0.0, 0.5];
    let Answer::Closest { value, residual } = subproblem3(Z, Y, q, 4.0) else {
        panic!()
    };
    assert!((value - FRAC_PI_2).abs() < 1e-15);
    assert!((residual - (4.0 - 9.25_f64.sqrt())).abs() < 1e-15);
    let Answer::Closest { value, .. } = subproblem3(Z, Y, q, 0.25) else {
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
            let answer = subproblem3(Z, [0.8, 0.0, 0.0], q, d);
            assert_eq!(answer.exact().len(), 1);
            assert!(contains(answer.exact(), expected, 1e-14));
        }
    }
}

#[test]
fn subproblem3_on_the_axis_is_solved_by_any_angle_or_none() {
    assert_eq!(
        subproblem3(Z, [0.0, 0.0, 4.0], [3.0, 0.0, 0.0], 5.0),
        Answer::Any(0.0)
    );
    assert_eq!(
        subproblem3(Z, [3.0, 0.0, 0.0], [0.0, 0.0, 4.0], 5.0),
        Answer::Any(0.0)
    );
    assert!(matches!(subproblem3(Z, Z, X, 5.0), Answer::Closest { .. }));
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
        let answer = subproblem4(h, k, p, d);
        assert!(
            answer
                .exact()
                .iter()
                .all(|&t| (component(t) - d).abs() < 1e-14)
        );
        assert!(contains(answer.exact(), t, 1e-6), "{answer:?} {t}");
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
    assert_eq!(subproblem4(Z, Z, [0.3, 0.0, 0.4], 0.4), Answer::Any(0.0));
    assert_eq!(subproblem4(X, Z, [0.0, 0.0, 0.4], 0.0), Answer::Any(0.0));
    assert!(matches!(
        subproblem4(Z, Z, X, 0.4),
        Answer::Closest { residual: 0.4, .. }
    ));
    let low = subproblem4(X, Z, X, -1.5);
    assert_eq!(
        low,
        Answer::Closest {
            value: PI,
            residual: 0.5
        }
    );
}

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
        let answer = translation1(v, p, q, d);
        assert!(answer.exact().iter().any(|s| (s - t).abs() < 1e-6));
        assert!(answer.exact().is_sorted());
        for s in answer.exact() {
            assert!((norm(minus(shifted(p, *s, v), q)) - d).abs() < 1e-13);
        }
        let h = random.unit();
        let d = dot(h, shifted(p, t, v));
        let answer = translation2(h, v, p, d);
        assert!((dot(h, shifted(p, answer.exact()[0], v)) - d).abs() < 1e-14);
    }
}

#[test]
fn translations_touch_miss_and_degenerate() {
    let q = [1.0, 2.0, 0.0];
    assert_eq!(translation1(X, [0.0; 3], q, 2.0).exact(), [1.0]);
    assert_eq!(
        translation1(X, [0.0; 3], q, 1.5),
        Answer::Closest {
            value: 1.0,
            residual: 0.5
        }
    );
    assert!(translation1(X, [0.0; 3], X, -0.5).exact().is_empty());
    assert_eq!(translation2(Z, X, q, 0.0), Answer::Any(0.0));
    assert_eq!(
        translation2(Z, X, q, 0.5),
        Answer::Closest {
            value: 0.0,
            residual: 0.5
        }
    );
}

#[test]
fn screw_forms_recover_random_placements() {
    let mut random = stream();
    for _ in 0..SAMPLES {
        let (meeting, p) = (random.vector(), random.vector());
        let xi1 = Twist::revolute(random.unit(), meeting);
        let xi2 = Twist::revolute(random.unit(), meeting);
        let (t1, t2) = (random.angle(), random.angle());
        let q = (Pose::exp(&xi1, t1) * Pose::exp(&xi2, t2)).transform_point(p);
        let answer = paden_kahan2(&xi1, &xi2, p, q);
        let pair = |s: &[f64; 2]| wrap(s[0] - t1).abs().max(wrap(s[1] - t2).abs()) < 1e-6;
        assert!(answer.exact().iter().any(pair), "{answer:?} {t1} {t2}");

        let q = Pose::exp(&xi1, t1).transform_point(p);
        assert!(contains(paden_kahan1(&xi1, p, q).exact(), t1, 1e-12));
        let eye = random.vector();
        let answer = paden_kahan3(&xi1, p, eye, norm(minus(q, eye)));
        assert!(contains(answer.exact(), t1, 1e-6));
    }
}

#[test]
fn screws_on_one_line_or_apart() {
    let hinge = Twist::revolute(Z, X);
    let above = Twist::revolute([0.0, 0.0, -1.0], [1.0, 0.0, 3.0]);
    let (p, q) = ([2.0, 0.0, 0.0], [1.0, 1.0, 0.0]);
    assert!(matches!(
        paden_kahan2(&hinge, &above, p, q),
        Answer::Any([_, 0.0])
    ));
    assert_eq!(paden_kahan1(&hinge, X, X), Answer::Any(0.0));
    let skew = Twist::revolute(X, [0.0, 5.0, 0.0]);
    let q = (Pose::exp(&hinge, 0.3) * Pose::exp(&skew, 0.4)).transform_point(p);
    assert!(matches!(
        paden_kahan2(&hinge, &skew, p, q),
        Answer::Closest { .. }
    ));
}
