//! Two distances.

use crate::sampling::*;
use kin_runtime::__private::math::wrap;
use kin_runtime::subproblems::*;

/// One instance.
#[derive(Clone, Copy, Debug)]
struct Gimbal {
    k: [Vector; 2],
    p: Vector,
    q: [Vector; 2],
    d: [f64; 2],
}

impl Gimbal {
    fn solved_by(k: [Vector; 2], p: Vector, q: [Vector; 2], t: &[f64; 2]) -> Gimbal {
        let mut gimbal = Gimbal {
            k,
            p,
            q,
            d: [0.0; 2],
        };
        gimbal.d = q.map(|q| norm(minus(gimbal.moved(t), q)));
        gimbal
    }

    fn moved(&self, t: &[f64; 2]) -> Vector {
        rotated(self.k[0], t[0], rotated(self.k[1], t[1], self.p))
    }

    fn size(&self) -> f64 {
        norm(self.p) + norm(self.q[0]) + norm(self.q[1]) + 1e-30
    }

    fn residual(&self, t: &[f64; 2]) -> f64 {
        let x = self.moved(t);
        let off = [0, 1].map(|i| (norm(minus(x, self.q[i])) - self.d[i]).abs());
        off[0].max(off[1]) / self.size()
    }

    /// What the two angles span of the two distances, times these.
    fn area(&self, t: &[f64; 2]) -> f64 {
        let x = self.moved(t);
        let [a, b] = [
            cross(self.k[0], x),
            rotated(
                self.k[0],
                t[0],
                cross(self.k[1], rotated(self.k[1], t[1], self.p)),
            ),
        ];
        let [r, s] = self.q.map(|q| minus(x, q));
        (dot(r, a) * dot(s, b) - dot(r, b) * dot(s, a)).abs() / self.size().powi(4)
    }

    fn solutions(&self) -> SolutionSet<[f64; 2]> {
        two_distances(self.k, self.p, self.q, self.d)
    }

    /// All solutions by a scan of t₂; the distances bind (cos, sin) t₁
    /// linearly, and that must have unit length.
    fn scanned(&self) -> Option<Vec<[f64; 2]>> {
        let parts = |t2: f64| {
            let w = rotated(self.k[1], t2, self.p);
            let row = |i: usize| {
                let q = self.q[i];
                let [m, c, s] = harmonic(|t| dot(q, rotated(self.k[0], t, w)));
                let level = 0.5 * (dot(w, w) + dot(q, q) - self.d[i] * self.d[i]);
                [c, s, level - m]
            };
            let ([c1, s1, a], [c2, s2, b]) = (row(0), row(1));
            [a * s2 - b * s1, c1 * b - c2 * a, c1 * s2 - c2 * s1]
        };
        let roots = roots_on_circle(|t| {
            let [x, y, determinant] = parts(t);
            x * x + y * y - determinant * determinant
        })?;
        let first = |t: f64| {
            let [x, y, determinant] = parts(t);
            (y * determinant.signum()).atan2(x * determinant.signum())
        };
        Some(roots.into_iter().map(|t| [first(t), wrap(t)]).collect())
    }
}

#[test]
fn two_distances_are_sound_and_recover_the_pair() {
    let mut random = stream();
    for _ in 0..10_000 {
        let k = [random.unit(), random.unit()];
        let q = [random.vector(), random.vector()];
        let t = [random.angle(), random.angle()];
        let gimbal = Gimbal::solved_by(k, random.vector(), q, &t);
        let solutions = gimbal.solutions();
        assert!(proper(solutions.exact()));
        for s in solutions.exact() {
            assert!(gimbal.residual(s) <= 1e-12, "{gimbal:?} {s:?}");
        }
        assert!(
            nearest(solutions.exact(), &t) < 1e-6,
            "{gimbal:?} {t:?} {solutions:?}"
        );
    }
}

#[test]
fn two_distances_find_what_a_scan_finds() {
    let mut random = stream();
    let mut counts = [0; 5];
    for i in 0..500 {
        let k = [random.unit(), random.unit()];
        let q = [random.vector(), random.vector()];
        let t = [random.angle(), random.angle()];
        let mut gimbal = Gimbal::solved_by(k, random.vector(), q, &t);
        if i % 2 == 0 {
            gimbal.d[0] *= 1.0 + 0.3 * random.next();
        }
        let Some(expected) = gimbal.scanned() else {
            continue;
        };
        // Where the two rows are dependent the scan sees double.
        if expected.iter().any(|t| gimbal.residual(t) > 1e-6) {
            continue;
        }
        let solutions = gimbal.solutions();
        assert_eq!(
            solutions.exact().len(),
            expected.len(),
            "{gimbal:?} {solutions:?} {expected:?}"
        );
        for t in &expected {
            assert!(
                nearest(solutions.exact(), t) < 1e-6,
                "{gimbal:?} {solutions:?}"
            );
        }
        counts[expected.len()] += 1;
    }
    assert!(
        counts[0] > 20 && counts[2] > 50 && counts[4] > 50,
        "{counts:?}"
    );
}

#[test]
fn two_distances_of_special_vectors() {
    let mut random = stream();
    let mut kinds = [0; 2];
    for _ in 0..20_000 {
        let mut pick = |n: usize| ((random.next() + 1.0) * 0.5 * n as f64) as usize % n;
        let points = [X, Y, Z, [1.0, 0.0, 1.0], [0.3, -0.5, 0.2], [0.0; 3]];
        let k = [0; 2].map(|_| AXES[pick(6)]);
        let q = [0; 2].map(|_| points[pick(6)]);
        let t = [0; 2].map(|_| ANGLES[pick(5)]);
        let gimbal = Gimbal::solved_by(k, points[pick(6)], q, &t);
        let solutions = gimbal.solutions();
        match solutions {
            SolutionSet::Exact(roots) => {
                kinds[0] += 1;
                for s in roots.iter() {
                    assert!(gimbal.residual(s) <= 1e-12, "{gimbal:?} {solutions:?}");
                }
                let known = if gimbal.area(&t) > 1e-6 { 1e-9 } else { 1e-5 };
                assert!(
                    nearest(&roots, &t) < known,
                    "{gimbal:?} {t:?} {solutions:?}"
                );
            }
            SolutionSet::Any(member) => {
                kinds[1] += 1;
                assert!(
                    gimbal.residual(&member) <= 1e-12,
                    "{gimbal:?} {solutions:?}"
                );
                assert!(gimbal.area(&member) < 1e-9, "{gimbal:?} {solutions:?}");
            }
            _ => panic!("{gimbal:?} {t:?} {solutions:?}"),
        }
    }
    assert!(kinds.iter().all(|n| *n > 1000), "{kinds:?}");
}

/// Spheres that touch, and a stretched arm: near-double roots.
#[test]
fn two_distances_keep_double_roots() {
    let mut random = stream();
    for _ in 0..500 {
        let t = [random.angle(), 0.3 + 0.2 * random.next()];
        let gimbal = |gap: f64| {
            // p near the plane of the q, where the spheres touch.
            let q = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
            let x = [0.6 * gap.cos(), 0.8 * gap.cos(), gap.sin()];
            let k = [random_axis(t[0]), Z];
            let p = rotated(k[1], -t[1], rotated(k[0], -t[0], x));
            Gimbal::solved_by(k, p, q, &t)
        };
        for power in 4..=12 {
            let gap = 10_f64.powi(-power);
            let solutions = gimbal(gap).solutions();
            assert!(
                solutions
                    .exact()
                    .iter()
                    .all(|s| gimbal(gap).residual(s) <= 1e-9)
            );
            assert!(
                nearest(solutions.exact(), &t) < 1e-5,
                "{gap:e} {solutions:?} {t:?}"
            );
        }
        assert!(nearest(gimbal(0.0).solutions().exact(), &t) < 1e-6);
        let mut missed = gimbal(0.0);
        missed.d[0] -= 1e-8;
        assert_eq!(missed.solutions(), SolutionSet::None);
    }
}

/// A unit vector that depends on an angle.
fn random_axis(t: f64) -> Vector {
    let v = [1.0, 0.3 * t.sin(), 0.4 * t.cos()];
    times(1.0 / norm(v), v)
}

#[test]
fn two_distances_name_their_families() {
    let k = [Z, X];
    // q₁, q₂ and the origin in line: the spheres meet in a circle.
    let circle = Gimbal::solved_by(k, [0.3, 0.4, 0.5], [X, times(-2.0, X)], &[0.3, 0.4]);
    assert!(matches!(circle.solutions(), SolutionSet::Any(t) if circle.residual(&t) < 1e-14));
    let mut never = circle;
    never.d[1] += 1e-3;
    assert_eq!(never.solutions(), SolutionSet::None);
    // A circle that touches the heights within reach: one pair only.
    let p = [0.0, 1.0, 0.0];
    let x = [0.0, 0.0, 1.0];
    let pole = Gimbal {
        k: [[0.6, 0.0, 0.8], X],
        p,
        q: [x, times(2.0, x)],
        d: [0.0, 1.0],
    };
    assert!(
        pole.solutions()
            .exact()
            .iter()
            .all(|t| pole.residual(t) < 1e-9)
    );
    assert!(!pole.solutions().exact().is_empty());
    // Any direction whatever.
    let sphere = Gimbal {
        k,
        p: Y,
        q: [[0.0; 3]; 2],
        d: [1.0; 2],
    };
    assert!(matches!(sphere.solutions(), SolutionSet::Any(_)));
    // The target on k₁, and p on k₂.
    let on_first = Gimbal::solved_by(
        k,
        Y,
        [X, [0.0, 1.0, 1.0]],
        &[0.0, core::f64::consts::FRAC_PI_2],
    );
    assert!(matches!(on_first.solutions(), SolutionSet::Any(t) if on_first.residual(&t) < 1e-12));
    let on_second = Gimbal::solved_by(k, X, [Y, Z], &[0.3, 0.4]);
    assert!(matches!(on_second.solutions(), SolutionSet::Any(t) if on_second.residual(&t) < 1e-12));
    assert_eq!(two_distances(k, Y, [X, Z], [-0.1, 1.0]), SolutionSet::None);
}

#[test]
fn two_distances_of_any_size() {
    let mut random = stream();
    for _ in 0..1000 {
        let k = [random.unit(), random.unit()];
        let t = [random.angle(), random.angle()];
        let (p, q) = (random.vector(), [random.vector(), random.vector()]);
        for scale in [1e-100, 1e-3, 1e3, 1e100] {
            let q = q.map(|q| times(scale, q));
            let gimbal = Gimbal::solved_by(k, times(scale, p), q, &t);
            assert!(nearest(gimbal.solutions().exact(), &t) < 1e-6);
        }
    }
}
