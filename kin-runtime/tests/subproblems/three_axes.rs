//! Subproblem 5.

use crate::sampling::*;
use core::f64::consts::PI;
use kin_runtime::subproblems::*;

/// One instance.
#[derive(Clone, Copy, Debug)]
struct Arm {
    k: [Vector; 3],
    p: [Vector; 4],
}

impl Arm {
    /// The instance that three angles solve.
    fn solved_by(k: [Vector; 3], p: [Vector; 3], t: &[f64; 3]) -> Arm {
        let [p1, p2, p3] = p;
        let right = rotated(k[1], t[1], plus(p2, rotated(k[2], t[2], p3)));
        let p0 = minus(right, rotated(k[0], t[0], p1));
        Arm {
            k,
            p: [p0, p1, p2, p3],
        }
    }

    fn random(random: &mut Stream) -> Arm {
        Arm {
            k: [0; 3].map(|_| random.unit()),
            p: [0; 4].map(|_| random.vector()),
        }
    }

    fn left(&self, t: f64) -> Vector {
        plus(self.p[0], rotated(self.k[0], t, self.p[1]))
    }

    fn right(&self, t: f64) -> Vector {
        plus(self.p[2], rotated(self.k[2], t, self.p[3]))
    }

    fn size(&self) -> f64 {
        self.p.iter().map(|p| norm(*p)).sum::<f64>().max(1e-100)
    }

    fn residual(&self, t: &[f64; 3]) -> f64 {
        norm(minus(
            self.left(t[0]),
            rotated(self.k[1], t[1], self.right(t[2])),
        )) / self.size()
    }

    /// The volume that the three angles span, relative to the size.
    fn volume(&self, t: &[f64; 3]) -> f64 {
        let carried = rotated(self.k[1], t[1], self.right(t[2]));
        let outer = rotated(self.k[2], t[2], self.p[3]);
        let first = cross(self.k[0], rotated(self.k[0], t[0], self.p[1]));
        let second = cross(self.k[1], carried);
        let third = rotated(self.k[1], t[1], cross(self.k[2], outer));
        dot(first, cross(second, third)).abs() / self.size().powi(3)
    }

    fn solutions(&self) -> SolutionSet<[f64; 3]> {
        subproblem5(self.k, self.p)
    }

    /// How many solutions a scan of t₁ finds. Here t₃ is eliminated first: with
    /// w the left side turned back by t₂, w − p₂ has the length of p₃ and its
    /// component along k₃. Both bind (cos, sin) t₂ linearly.
    fn scanned(&self) -> Option<Vec<[f64; 2]>> {
        let [_, k2, k3] = self.k;
        let [_, _, p2, p3] = self.p;
        let parts = |t1: f64| {
            let left = self.left(t1);
            let [m1, c1, s1] = harmonic(|t| dot(k3, rotated(k2, -t, left)));
            let [m2, c2, s2] = harmonic(|t| dot(p2, rotated(k2, -t, left)));
            let a = dot(k3, plus(p2, p3)) - m1;
            let b = 0.5 * (dot(left, left) + dot(p2, p2) - dot(p3, p3)) - m2;
            [a * s2 - b * s1, c1 * b - c2 * a, c1 * s2 - c2 * s1]
        };
        let roots = roots_on_circle(|t| {
            let [x, y, determinant] = parts(t);
            x * x + y * y - determinant * determinant
        })?;
        let second = |t: f64| {
            let [x, y, determinant] = parts(t);
            (y * determinant.signum()).atan2(x * determinant.signum())
        };
        Some(roots.into_iter().map(|t| [t, second(t)]).collect())
    }
}

#[test]
fn subproblem5_is_sound_and_recovers_the_angles() {
    let mut random = stream();
    for _ in 0..10_000 {
        let Arm { k, p } = Arm::random(&mut random);
        let t = [0; 3].map(|_| random.angle());
        let arm = Arm::solved_by(k, [p[1], p[2], p[3]], &t);
        let solutions = arm.solutions();
        assert!(proper(solutions.exact()));
        for s in solutions.exact() {
            assert!(arm.residual(s) <= 1e-12, "{arm:?} {s:?}");
        }
        assert!(
            nearest(solutions.exact(), &t) < 1e-6,
            "{arm:?} {t:?} {solutions:?}"
        );
    }
}

#[test]
fn subproblem5_finds_what_a_scan_finds() {
    let mut random = stream();
    let mut counts = [0; 5];
    for _ in 0..2000 {
        let mut arm = Arm::random(&mut random);
        if random.next() < 0.3 {
            let t = [0; 3].map(|_| random.angle());
            arm = Arm::solved_by(arm.k, [arm.p[1], arm.p[2], arm.p[3]], &t);
        }
        let Some(expected) = arm.scanned() else {
            continue;
        };
        let solutions = arm.solutions();
        assert_eq!(
            solutions.exact().len(),
            expected.len(),
            "{arm:?} {solutions:?}"
        );
        let pairs: Vec<[f64; 2]> = solutions.exact().iter().map(|t| [t[0], t[1]]).collect();
        for t in &expected {
            assert!(nearest(&pairs, t) < 1e-6, "{arm:?} {solutions:?} {t:?}");
        }
        counts[expected.len()] += 1;
    }
    assert!(
        counts[0] > 100 && counts[2] > 100 && counts[4] > 100,
        "{counts:?}"
    );
}

/// Axes parallel, opposed, perpendicular; points on them; angles at 0, ±π/2, π.
#[test]
fn subproblem5_of_special_arms() {
    let mut random = stream();
    let mut kinds = [0; 2];
    for _ in 0..40_000 {
        let mut pick = |n: usize| ((random.next() + 1.0) * 0.5 * n as f64) as usize % n;
        let points = [X, Y, Z, [1.0, 0.0, 1.0], [0.3, -0.5, 0.2], [0.0; 3]];
        let k = [0; 3].map(|_| AXES[pick(6)]);
        let p = [0; 3].map(|_| points[pick(6)]);
        let t = [0; 3].map(|_| ANGLES[pick(5)]);
        let arm = Arm::solved_by(k, p, &t);
        let solutions = arm.solutions();
        match solutions {
            SolutionSet::Exact(roots) => {
                kinds[0] += 1;
                assert!(
                    roots.iter().all(|s| arm.residual(s) <= 1e-12),
                    "{arm:?} {solutions:?}"
                );
                let known = if arm.volume(&t) > 1e-6 { 1e-9 } else { 1e-5 };
                assert!(nearest(&roots, &t) < known, "{arm:?} {t:?} {solutions:?}");
                for (i, s) in roots.iter().enumerate() {
                    assert!(nearest(&roots[..i], s) > 1e-7, "{arm:?} {solutions:?}");
                }
            }
            SolutionSet::Any(member) => {
                kinds[1] += 1;
                assert!(arm.residual(&member) <= 1e-12, "{arm:?} {solutions:?}");
                assert!(arm.volume(&member) < 1e-9, "{arm:?} {solutions:?}");
            }
            _ => panic!("{arm:?} {t:?} {solutions:?}"),
        }
    }
    assert!(kinds.iter().all(|n| *n > 1000), "{kinds:?}");
}

/// Each axis in turn parallel to the next, or perpendicular with equal links:
/// the quartic in the height is then no quartic, or biquadratic.
#[test]
fn subproblem5_decoupled_and_biquadratic() {
    let mut random = stream();
    let oblique = random.unit();
    let builds = [
        [Z, Z, X],
        [Z, X, X],
        [Z, X, Z],
        [Z, times(-1.0, Z), X],
        [X, Y, Z],
        [Z, Z, oblique],
        [oblique, Z, Z],
    ];
    for _ in 0..1000 {
        for k in builds {
            let reach = [random.next(), random.next(), random.next()];
            for p in [
                reach.map(|r| times(r, X)),
                [X, Y, X],
                [0; 3].map(|_| random.vector()),
            ] {
                let t = [0; 3].map(|_| random.angle());
                let arm = Arm::solved_by(k, p, &t);
                let solutions = arm.solutions();
                if let SolutionSet::Any(member) = solutions {
                    assert!(arm.residual(&member) <= 1e-12);
                    assert!(arm.volume(&member) < 1e-9, "{arm:?} {solutions:?}");
                    continue;
                }
                assert!(solutions.exact().iter().all(|s| arm.residual(s) <= 1e-12));
                assert!(
                    nearest(solutions.exact(), &t) < 1e-6,
                    "{arm:?} {t:?} {solutions:?}"
                );
                if let Some(expected) = arm.scanned() {
                    assert!(
                        solutions.exact().len() >= expected.len(),
                        "{arm:?} {solutions:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn subproblem5_names_its_families() {
    // A planar arm of three links; stretched it is rigid.
    let planar = Arm::solved_by([Z; 3], [X, X, X], &[0.3, 0.4, 0.5]);
    assert!(matches!(planar.solutions(), SolutionSet::Any(t) if planar.residual(&t) < 1e-14));
    let stretched = Arm::solved_by([Z; 3], [times(-0.5, X), X, X], &[0.0; 3]);
    assert!(nearest(stretched.solutions().exact(), &[0.0; 3]) < 1e-7);
    assert_eq!(stretched.solutions().exact().len(), 1);
    let mut never = planar;
    never.p[0][0] += 5.0;
    assert_eq!(never.solutions(), SolutionSet::None);
    never.p[0] = plus(planar.p[0], Z);
    assert_eq!(never.solutions(), SolutionSet::None);
    // p₁ on its axis, p₃ on its axis.
    for p in [[Z, X, Y], [X, Y, Z]] {
        let arm = Arm::solved_by([Z, X, Z], p, &[0.3, 0.4, 0.5]);
        assert!(matches!(arm.solutions(), SolutionSet::Any(t) if arm.residual(&t) < 1e-14));
    }
    // Both sides on k₂, which turns nothing there.
    let shoulder = Arm {
        k: [X, Z, X],
        p: [Z, Y, Z, Y],
    };
    let solutions = subproblem5(shoulder.k, shoulder.p);
    assert!(
        matches!(solutions, SolutionSet::Any(t) if shoulder.residual(&t) < 1e-14),
        "{solutions:?}"
    );
    assert!(matches!(
        subproblem5([X, Y, Z], [[0.0; 3]; 4]),
        SolutionSet::Any(_)
    ));
    assert_eq!(
        subproblem5([X, Y, Z], [X, [0.0; 3], [0.0; 3], [0.0; 3]]),
        SolutionSet::None
    );
}

/// The wrist at and near the shoulder's axis: t₂ is determined by next to
/// nothing, but there are still as many solutions.
#[test]
fn subproblem5_near_the_second_axis() {
    let mut random = stream();
    for _ in 0..500 {
        let k = [0; 3].map(|_| random.unit());
        let (t, p3) = ([0; 3].map(|_| random.angle()), random.vector());
        // p₂ puts the right side on k₂; p₁ is free, p₀ follows.
        let p1 = random.vector();
        let height = 0.5 + random.next().abs();
        for power in 3..=11 {
            let aside = times(10_f64.powi(-power), random.unit());
            let spot = plus(times(height, k[1]), aside);
            let p2 = minus(spot, rotated(k[2], t[2], p3));
            let arm = Arm::solved_by(k, [p1, p2, p3], &t);
            let solutions = arm.solutions();
            for s in solutions.exact() {
                assert!(
                    arm.residual(s) <= 1e-12,
                    "{power} {arm:?} {s:?} {:e}",
                    arm.residual(s)
                );
            }
            if power <= 9 && arm.volume(&t) > 0.01 * 10_f64.powi(-power) {
                assert!(
                    nearest(solutions.exact(), &t) < 1e-5,
                    "{power} {arm:?} {t:?} {solutions:?}"
                );
            }
        }
        let p2 = minus(times(height, k[1]), rotated(k[2], t[2], p3));
        let arm = Arm::solved_by(k, [p1, p2, p3], &t);
        let SolutionSet::Any(member) = arm.solutions() else {
            panic!("{arm:?} {:?}", arm.solutions())
        };
        assert!(arm.residual(&member) <= 1e-12 && arm.volume(&member) < 1e-12);
    }
}

/// A regular elbow, stretched: near-double roots from 1e-4 to 1e-12 apart.
#[test]
fn subproblem5_keeps_double_roots() {
    let mut random = stream();
    for _ in 0..500 {
        let turn = random.angle();
        let bent = |gap: f64| {
            Arm::solved_by(
                [Z, X, X],
                [[0.1, 0.2, 0.0], Y, times(0.7, Y)],
                &[turn, 0.4, gap],
            )
        };
        for power in 4..=12 {
            let gap = 10_f64.powi(-power);
            let arm = bent(gap);
            let solutions = arm.solutions();
            assert!(solutions.exact().iter().all(|s| arm.residual(s) <= 1e-9));
            let t = [turn, 0.4, gap];
            assert!(
                nearest(solutions.exact(), &t) < 3e-6,
                "{gap:e} {solutions:?}"
            );
            assert!(power > 5 || solutions.exact().iter().any(|s| apart(s, &t) > gap));
        }
        let solutions = bent(0.0).solutions();
        assert!(
            nearest(solutions.exact(), &[turn, 0.4, 0.0]) < 1e-7,
            "{solutions:?}"
        );
    }
}

#[test]
fn subproblem5_of_any_size() {
    let mut random = stream();
    for _ in 0..2000 {
        let Arm { k, p } = Arm::random(&mut random);
        let t = [0; 3].map(|_| random.angle());
        let arm = |s: f64| Arm::solved_by(k, [1, 2, 3].map(|i| times(s, p[i])), &t);
        let expected = arm(1.0).solutions();
        for scale in [1e-150, 1e-3, 1e3, 1e100] {
            let solutions = arm(scale).solutions();
            assert_eq!(solutions.exact().len(), expected.exact().len());
            assert!(nearest(solutions.exact(), &t) < 1e-6);
        }
    }
}

#[test]
fn subproblem5_at_half_turns() {
    let mut random = stream();
    for _ in 0..500 {
        let Arm { k, p } = Arm::random(&mut random);
        for i in 0..3 {
            let mut t = [0; 3].map(|_| random.angle());
            t[i] = PI;
            let arm = Arm::solved_by(k, [p[1], p[2], p[3]], &t);
            assert!(nearest(arm.solutions().exact(), &t) < 1e-6);
        }
    }
}
