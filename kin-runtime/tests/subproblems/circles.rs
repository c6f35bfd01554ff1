//! Subproblem 2E.

use crate::sampling::*;
use core::f64::consts::PI;
use kin_runtime::subproblems::*;

/// One instance.
#[derive(Clone, Copy, Debug)]
struct Circles {
    k: [Vector; 2],
    p: [Vector; 3],
}

impl Circles {
    fn solved_by(k: [Vector; 2], p1: Vector, p2: Vector, t: &[f64; 2]) -> Circles {
        let p0 = minus(rotated(k[1], t[1], p2), rotated(k[0], t[0], p1));
        Circles { k, p: [p0, p1, p2] }
    }

    fn residual(&self, t: &[f64; 2]) -> f64 {
        let left = plus(self.p[0], rotated(self.k[0], t[0], self.p[1]));
        let size: f64 = self.p.iter().map(|p| norm(*p)).sum();
        norm(minus(left, rotated(self.k[1], t[1], self.p[2]))) / size.max(1e-100)
    }

    /// The area that the two motions span.
    fn area(&self, t: &[f64; 2]) -> f64 {
        let first = cross(self.k[0], rotated(self.k[0], t[0], self.p[1]));
        norm(cross(
            first,
            cross(self.k[1], rotated(self.k[1], t[1], self.p[2])),
        ))
    }

    fn solutions(&self) -> SolutionSet<[f64; 2]> {
        subproblem2e(self.k[0], self.k[1], self.p[0], self.p[1], self.p[2])
    }

    /// The angles t₁ at which the first circle comes nearer than 1e-9 to the
    /// second: minima of its distance, by golden section.
    fn scanned(&self) -> Vec<f64> {
        let ([k1, k2], [p0, p1, p2]) = (self.k, self.p);
        let height = dot(k2, p2);
        let radius = norm(minus(p2, times(height, k2)));
        let distance = |t: f64| {
            let v = plus(p0, rotated(k1, t, p1));
            let rise = dot(k2, v);
            (rise - height).hypot(norm(minus(v, times(rise, k2))) - radius)
        };
        let angle = |i: usize| (i as f64 + 0.37) * PI / 180.0;
        let samples: Vec<f64> = (0..362).map(|i| distance(angle(i))).collect();
        let valleys = (0..360).filter(|&i| samples[i + 1] <= samples[i].min(samples[i + 2]));
        let bottoms = valleys.map(|i| {
            let (mut low, mut high) = (angle(i), angle(i + 2));
            for _ in 0..70 {
                let (left, right) = (low + 0.382 * (high - low), high - 0.382 * (high - low));
                if distance(left) < distance(right) {
                    high = right;
                } else {
                    low = left;
                }
            }
            low
        });
        bottoms.filter(|t| distance(*t) < 1e-9).collect()
    }
}

#[test]
fn subproblem2e_is_sound_complete_and_recovers_the_pair() {
    let mut random = stream();
    for i in 0..10_000 {
        let k = [random.unit(), random.unit()];
        let t = [random.angle(), random.angle()];
        let circles = Circles::solved_by(k, random.vector(), random.vector(), &t);
        let solutions = circles.solutions();
        assert!(proper(solutions.exact()));
        for s in solutions.exact() {
            assert!(circles.residual(s) <= 1e-12, "{circles:?} {s:?}");
        }
        assert!(
            nearest(solutions.exact(), &t) < 1e-6,
            "{circles:?} {t:?} {solutions:?}"
        );
        if i < 300 {
            let expected = circles.scanned();
            assert_eq!(
                solutions.exact().len(),
                expected.len(),
                "{circles:?} {solutions:?}"
            );
        }
    }
}

/// On one sphere (p₀ = 0), and in one plane: two solutions.
#[test]
fn subproblem2e_meets_twice() {
    let mut random = stream();
    for _ in 0..300 {
        let p1 = random.vector();
        let t = [random.angle(), random.angle()];
        let k = [random.unit(), random.unit()];
        let on_sphere = rotated(k[1], -t[1], rotated(k[0], t[0], p1));
        let apart = Circles {
            k,
            p: [[0.0; 3], p1, on_sphere],
        };
        let flat = Circles::solved_by([Z, Z], p1, random.vector(), &t);
        let opposed = Circles::solved_by([Z, times(-1.0, Z)], p1, random.vector(), &t);
        for circles in [apart, flat, opposed] {
            let solutions = circles.solutions();
            assert!(
                solutions
                    .exact()
                    .iter()
                    .all(|s| circles.residual(s) <= 1e-12)
            );
            assert!(
                nearest(solutions.exact(), &t) < 1e-6,
                "{circles:?} {t:?} {solutions:?}"
            );
            if circles.area(&t) > 1e-3 {
                assert_eq!(solutions.exact().len(), 2, "{circles:?} {solutions:?}");
            }
            // Minima a degree apart are one to the scan.
            if circles.area(&t) > 0.1 {
                assert_eq!(circles.scanned().len(), 2, "{circles:?} {solutions:?}");
            }
        }
        // The same as subproblem 2.
        let same = subproblem2(k[0], k[1], p1, on_sphere);
        for s in same.exact() {
            assert!(nearest(apart.solutions().exact(), s) < 1e-6);
        }
    }
}

#[test]
fn subproblem2e_of_special_circles() {
    let points = [X, Y, Z, [1.0, 0.0, 1.0], [0.3, -0.5, 0.2], [0.0; 3]];
    let mut kinds = [0; 2];
    for (k1, k2) in AXES.iter().flat_map(|a| AXES.iter().map(move |b| (*a, *b))) {
        for (p1, p2) in points
            .iter()
            .flat_map(|a| points.iter().map(move |b| (*a, *b)))
        {
            for t in ANGLES
                .iter()
                .flat_map(|a| ANGLES.iter().map(move |b| [*a, *b]))
            {
                let circles = Circles::solved_by([k1, k2], p1, p2, &t);
                let solutions = circles.solutions();
                match solutions {
                    SolutionSet::Exact(roots) => {
                        kinds[0] += 1;
                        assert!(roots.iter().all(|s| circles.residual(s) <= 1e-12));
                        assert!(
                            nearest(&roots, &t) < 1e-6,
                            "{circles:?} {t:?} {solutions:?}"
                        );
                        assert!(roots.len() == 1 || apart(&roots[0], &roots[1]) > 1e-7);
                    }
                    SolutionSet::Any(member) => {
                        kinds[1] += 1;
                        assert!(circles.residual(&member) <= 1e-12);
                        assert!(circles.area(&member) < 1e-9, "{circles:?} {solutions:?}");
                    }
                    _ => panic!("{circles:?} {t:?} {solutions:?}"),
                }
            }
        }
    }
    assert!(kinds.iter().all(|n| *n > 1000), "{kinds:?}");
}

#[test]
fn subproblem2e_touching_nearly_and_missing() {
    let mut random = stream();
    for _ in 0..500 {
        let (turn, reach) = (random.angle(), 0.3 + 0.4 * random.next().abs());
        let touch = |gap: f64| {
            let p1 = rotated(Z, 0.3, [reach, 0.0, 0.2]);
            Circles::solved_by(
                [Z, Z],
                p1,
                [0.0, 1.0, 0.0],
                &[turn - 0.3, turn + gap - 0.5 * PI],
            )
        };
        let solutions = touch(0.0).solutions();
        assert_eq!(solutions.exact().len(), 1, "{solutions:?}");
        assert!(nearest(solutions.exact(), &[turn - 0.3, turn - 0.5 * PI]) < 1e-7);
        for power in 4..=12 {
            let circles = touch(10_f64.powi(-power));
            let t = [turn - 0.3, turn + 10_f64.powi(-power) - 0.5 * PI];
            let solutions = circles.solutions();
            assert!(
                solutions
                    .exact()
                    .iter()
                    .all(|s| circles.residual(s) <= 1e-9)
            );
            assert!(
                nearest(solutions.exact(), &t) < 1e-5,
                "{power} {solutions:?}"
            );
            assert!(
                power > 5 || solutions.exact().len() == 2,
                "{power} {solutions:?}"
            );
        }
        let mut missed = touch(0.0);
        missed.p[0] = plus(missed.p[0], times(1e-8, missed.p[0]));
        missed.p[0][2] += 1e-8;
        assert_eq!(missed.solutions(), SolutionSet::None);
    }
    // One of the two points of a planar pair, lifted off by a tilted axis.
    let tilted = Circles::solved_by([Z, [1e-7, 0.0, 1.0]], X, Y, &[0.3, 0.9]);
    assert!(nearest(tilted.solutions().exact(), &[0.3, 0.9]) < 1e-8);
}

#[test]
fn subproblem2e_names_its_families() {
    assert!(matches!(
        subproblem2e(Z, Z, [0.0; 3], X, Y),
        SolutionSet::Any(_)
    ));
    assert!(matches!(
        subproblem2e(Z, X, times(-1.0, Z), Z, [1.0, 0.0, 0.0]),
        SolutionSet::None | SolutionSet::Closest { .. }
    ));
    assert!(matches!(
        subproblem2e(Z, X, minus(Y, Z), Z, Z),
        SolutionSet::Any([0.0, _])
    ));
    assert!(matches!(
        subproblem2e(Z, X, minus(X, Y), X, X),
        SolutionSet::Any([_, 0.0])
    ));
    assert!(matches!(
        subproblem2e(Z, X, X, Z, X),
        SolutionSet::Closest { .. }
    ));
    for p in [[Z, X, Y], [[0.0; 3], X, times(2.0, X)]] {
        let solutions = subproblem2e(Z, Z, p[0], p[1], p[2]);
        assert!(
            matches!(solutions, SolutionSet::Closest { residual, .. } if (residual - 1.0).abs() < 1e-15)
        );
    }
    assert_eq!(subproblem2e(Z, X, times(3.0, X), X, Y), SolutionSet::None);
    // A vector that is nearly nothing, and on its axis to rounding.
    let tiny = subproblem2e(Z, X, [0.0, 1e-16, -1.0], Z, [1e-16, 0.0, 3e-16]);
    assert!(matches!(tiny, SolutionSet::Any(_)), "{tiny:?}");
}

#[test]
fn subproblem2e_of_any_size() {
    let mut random = stream();
    for _ in 0..1000 {
        let k = [random.unit(), random.unit()];
        let t = [random.angle(), random.angle()];
        let (p1, p2) = (random.vector(), random.vector());
        for scale in [1e-150, 1e-3, 1e3, 1e100] {
            let circles = Circles::solved_by(k, times(scale, p1), times(scale, p2), &t);
            assert!(nearest(circles.solutions().exact(), &t) < 1e-6);
        }
        // A small circle that meets a large one.
        for scale in [1e-3, 1e-6] {
            let circles = Circles::solved_by(k, p1, times(scale, p2), &t);
            assert!(
                nearest(circles.solutions().exact(), &t) < 1e-6,
                "{circles:?} {:?}",
                circles.solutions()
            );
        }
    }
}
