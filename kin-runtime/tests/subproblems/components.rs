//! Subproblem 6.

use crate::sampling::*;
use core::f64::consts::PI;
use kin_runtime::subproblems::*;

/// One instance.
#[derive(Clone, Copy, Debug)]
struct Pair {
    h: [Vector; 4],
    k: [Vector; 4],
    p: [Vector; 4],
    d: [f64; 2],
}

impl Pair {
    /// The instance that a pair of angles solves.
    fn solved_by(h: [Vector; 4], k: [Vector; 4], p: [Vector; 4], t: &[f64; 2]) -> Pair {
        let mut pair = Pair {
            h,
            k,
            p,
            d: [0.0; 2],
        };
        pair.d = pair.off(t);
        pair
    }

    fn random(random: &mut Stream) -> Pair {
        Pair {
            h: [0; 4].map(|_| random.unit()),
            k: [0; 4].map(|_| random.unit()),
            p: [0; 4].map(|_| random.vector()),
            d: [random.next(), random.next()],
        }
    }

    fn term(&self, i: usize, t: f64) -> f64 {
        dot(self.h[i], rotated(self.k[i], t, self.p[i]))
    }

    fn off(&self, t: &[f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.term(2 * i, t[0]) + self.term(2 * i + 1, t[1]) - self.d[i])
    }

    /// The larger error, relative to the terms of its equation.
    fn residual(&self, t: &[f64; 2]) -> f64 {
        let off = self.off(t);
        let size = |i: usize| {
            (norm(self.p[2 * i]) + norm(self.p[2 * i + 1]) + self.d[i].abs()).max(1e-300)
        };
        (off[0].abs() / size(0)).max(off[1].abs() / size(1))
    }

    fn solutions(&self) -> SolutionSet<[f64; 2]> {
        subproblem6(self.h, self.k, self.p, self.d)
    }

    /// All solutions by a scan of t₁: the second angle by Cramer, the cosine
    /// and sine of which must be of unit length.
    fn scanned(&self) -> Option<Vec<[f64; 2]>> {
        let [first, second] = [0, 2].map(|i| harmonic(|t| self.term(i, t)));
        let [[m1, c1, s1], [m2, c2, s2]] = [1, 3].map(|i| harmonic(|t| self.term(i, t)));
        let determinant = c1 * s2 - c2 * s1;
        let numerators = |t: f64| {
            let (s, c) = t.sin_cos();
            let a = self.d[0] - m1 - (first[0] + first[1] * c + first[2] * s);
            let b = self.d[1] - m2 - (second[0] + second[1] * c + second[2] * s);
            [a * s2 - b * s1, c1 * b - c2 * a]
        };
        let roots = roots_on_circle(|t| {
            let [x, y] = numerators(t);
            x * x + y * y - determinant * determinant
        })?;
        let second = |t: f64| {
            let [x, y] = numerators(t);
            (y * determinant.signum()).atan2(x * determinant.signum())
        };
        Some(roots.into_iter().map(|t| [t, second(t)]).collect())
    }
}

#[test]
fn subproblem6_is_sound_and_recovers_the_pair() {
    let mut random = stream();
    for _ in 0..10_000 {
        let Pair { h, k, p, .. } = Pair::random(&mut random);
        let t = [random.angle(), random.angle()];
        let pair = Pair::solved_by(h, k, p, &t);
        let solutions = pair.solutions();
        assert!(proper(solutions.exact()));
        for s in solutions.exact() {
            assert!(pair.residual(s) <= 1e-12, "{pair:?} {s:?}");
        }
        assert!(
            nearest(solutions.exact(), &t) < 1e-6,
            "{pair:?} {t:?} {solutions:?}"
        );
    }
}

#[test]
fn subproblem6_finds_what_a_scan_finds() {
    let mut random = stream();
    let mut counts = [0; 5];
    for _ in 0..2000 {
        let mut pair = Pair::random(&mut random);
        if random.next() < 0.3 {
            let t = [random.angle(), random.angle()];
            pair = Pair::solved_by(pair.h, pair.k, pair.p, &t);
        }
        let Some(expected) = pair.scanned() else {
            continue;
        };
        let solutions = pair.solutions();
        assert_eq!(
            solutions.exact().len(),
            expected.len(),
            "{pair:?} {solutions:?}"
        );
        for t in &expected {
            assert!(
                nearest(solutions.exact(), t) < 1e-6,
                "{pair:?} {solutions:?}"
            );
        }
        counts[expected.len()] += 1;
    }
    assert!(
        counts[0] > 100 && counts[2] > 100 && counts[4] > 100,
        "{counts:?}"
    );
}

/// Special axes, vectors and angles; every block may be singular or absent.
#[test]
fn subproblem6_of_special_vectors() {
    let mut random = stream();
    let mut kinds = [0; 3];
    for _ in 0..20_000 {
        let mut pick = |n: usize| ((random.next() + 1.0) * 0.5 * n as f64) as usize % n;
        let h = [0; 4].map(|_| AXES[pick(6)]);
        let k = [0; 4].map(|_| AXES[pick(6)]);
        let points = [X, Y, Z, [1.0, 0.0, 1.0], [0.3, -0.5, 0.2], [0.0; 3]];
        let p = [0; 4].map(|_| points[pick(6)]);
        let t = [ANGLES[pick(5)], ANGLES[pick(5)]];
        let pair = Pair::solved_by(h, k, p, &t);
        let solutions = pair.solutions();
        match solutions {
            SolutionSet::Exact(roots) => {
                kinds[0] += 1;
                assert!(
                    roots.iter().all(|s| pair.residual(s) <= 1e-12),
                    "{pair:?} {solutions:?}"
                );
                // A double root is known to the square root of rounding.
                assert!(nearest(&roots, &t) < 1e-6, "{pair:?} {t:?} {solutions:?}");
                for (i, s) in roots.iter().enumerate() {
                    assert!(nearest(&roots[..i], s) > 1e-7, "{pair:?} {solutions:?}");
                }
            }
            SolutionSet::Any(member) => {
                kinds[1] += 1;
                assert!(pair.residual(&member) <= 1e-12, "{pair:?} {solutions:?}");
            }
            _ => panic!("{pair:?} {t:?} {solutions:?}"),
        }
        // The scan cannot do with a singular block; those are for the others.
        let ([_, a, b], [_, c, d]) = (harmonic(|t| pair.term(1, t)), harmonic(|t| pair.term(3, t)));
        let regular = (a * d - b * c).abs() > 1e-3 && matches!(solutions, SolutionSet::Exact(_));
        if let Some(expected) = regular.then(|| pair.scanned()).flatten() {
            kinds[2] += 1;
            assert_eq!(
                solutions.exact().len(),
                expected.len(),
                "{pair:?} {solutions:?}"
            );
        }
    }
    assert!(kinds.iter().all(|n| *n > 1000), "{kinds:?}");
}

/// A family is a family: next to its member there are other solutions.
#[test]
fn subproblem6_names_its_families() {
    // The same equation twice, and once doubled.
    let twice = Pair::solved_by([X; 4], [Z; 4], [X, Y, X, Y], &[0.3, 0.4]);
    assert!(matches!(twice.solutions(), SolutionSet::Any(t) if twice.residual(&t) < 1e-14));
    let p = [X, Y, times(2.0, X), times(2.0, Y)];
    let double = Pair::solved_by([X; 4], [Z; 4], p, &[0.3, 0.4]);
    assert!(matches!(double.solutions(), SolutionSet::Any(_)));
    // Contradicting each other.
    let mut never = double;
    never.d[1] += 1e-6;
    assert_eq!(never.solutions(), SolutionSet::None);
    // Only where both cosines are 1.
    let stretched = Pair::solved_by([X; 4], [Z; 4], [X; 4], &[0.0, 0.0]);
    assert_eq!(stretched.solutions().exact(), [[0.0, 0.0]]);
    // t₂ in neither equation.
    let free = Pair::solved_by([X, Z, Y, Z], [Z; 4], [X, X, X, Y], &[0.3, 0.4]);
    assert!(matches!(free.solutions(), SolutionSet::Any([t, _]) if (t - 0.3).abs() < 1e-12));
    let mut none = free;
    none.d[1] += 0.1;
    assert_eq!(none.solutions(), SolutionSet::None);
    // The same ellipse twice: (cos, sin) t₁ = (cos, sin) t₂.
    let minus_x = times(-1.0, X);
    let same = Pair {
        h: [X, X, Y, Y],
        k: [Z; 4],
        p: [X, minus_x, X, minus_x],
        d: [0.0; 2],
    };
    assert!(matches!(same.solutions(), SolutionSet::Any([a, b]) if (a - b).abs() < 1e-14));
    assert!(matches!(
        subproblem6([X; 4], [Z; 4], [[0.0; 3]; 4], [0.0; 2]),
        SolutionSet::Any(_)
    ));
    assert_eq!(
        subproblem6([X; 4], [Z; 4], [[0.0; 3]; 4], [0.0, 1.0]),
        SolutionSet::None
    );
}

/// cos t₁ = a and cos t₂ = b: both blocks singular.
#[test]
fn subproblem6_decoupled() {
    let z4 = [Z; 4];
    for t in [[1.0, 2.0], [0.3, 3.0], [0.0, 1.0], [PI, 0.5], [0.0, PI]] {
        let pair = Pair::solved_by([X; 4], z4, [X, Z, Z, X], &t);
        let each = |t: f64| if t == 0.0 || t == PI { 1 } else { 2 };
        let solutions = pair.solutions();
        assert_eq!(
            solutions.exact().len(),
            each(t[0]) * each(t[1]),
            "{solutions:?}"
        );
        assert!(nearest(solutions.exact(), &t) < 1e-7);
    }
    // Nearly so: blocks of determinant 1e-3 to 1e-15.
    let mut random = stream();
    for i in 0..3000 {
        let tilt = 10_f64.powf(-3.0 - 4.0 * (i as f64 / 1000.0));
        let lean = |v: Vector, w: Vector| plus(v, times(tilt, w));
        let t = [random.angle(), random.angle()];
        let p = [X, lean(Z, X), lean(Z, Y), X];
        let pair = Pair::solved_by([X, Y, Y, X], z4, p, &t);
        let solutions = pair.solutions();
        assert!(solutions.exact().iter().all(|s| pair.residual(s) <= 1e-12));
        assert!(
            nearest(solutions.exact(), &t) < 1e-6,
            "{tilt:e} {t:?} {solutions:?}"
        );
        let clear = t.iter().all(|t| t.sin().abs() > 0.1 && t.cos().abs() > 0.1);
        assert!(
            !clear || solutions.exact().len() == 4,
            "{tilt:e} {t:?} {solutions:?}"
        );
    }
}

/// The planar arm of two links, stretched and nearly so.
#[test]
fn subproblem6_keeps_double_roots() {
    let mut random = stream();
    let arm = |t: &[f64; 2]| {
        Pair::solved_by(
            [X, X, Y, Y],
            [Z; 4],
            [X, times(0.7, X), X, times(0.7, X)],
            t,
        )
    };
    for _ in 0..2000 {
        let t = random.angle();
        let pair = arm(&[t, t]);
        let solutions = pair.solutions();
        assert_eq!(solutions.exact().len(), 1, "{t} {solutions:?}");
        assert!(nearest(solutions.exact(), &[t, t]) < 1e-7);
        for power in 4..=12 {
            let gap = 10_f64.powi(-power);
            let near = [t, t + gap];
            let pair = arm(&near);
            let solutions = pair.solutions();
            assert!(solutions.exact().iter().all(|s| pair.residual(s) <= 1e-9));
            assert!(
                nearest(solutions.exact(), &near) < 2e-6,
                "{gap:e} {solutions:?}"
            );
            // Below, the equation cannot tell them apart.
            let expected = if power <= 5 { 2..=2 } else { 1..=2 };
            assert!(
                expected.contains(&solutions.exact().len()),
                "{gap:e} {solutions:?}"
            );
        }
        // Out of reach, by more than rounding.
        let mut far = pair;
        far.d = far.d.map(|d| d * (1.0 + 1e-8));
        assert_eq!(far.solutions(), SolutionSet::None);
    }
}

#[test]
fn subproblem6_of_any_size() {
    let mut random = stream();
    for _ in 0..2000 {
        let Pair { h, k, p, .. } = Pair::random(&mut random);
        let t = [random.angle(), random.angle()];
        let expected = Pair::solved_by(h, k, p, &t).solutions();
        for (first, second) in [(1e-3, 1e-3), (1e3, 1e3), (1e-3, 1e3), (1e-100, 1e100)] {
            let scales = [first, first, second, second];
            let p = core::array::from_fn(|i| times(scales[i], p[i]));
            let pair = Pair::solved_by(h, k, p, &t);
            let solutions = pair.solutions();
            assert_eq!(solutions.exact().len(), expected.exact().len());
            assert!(nearest(solutions.exact(), &t) < 1e-6);
        }
    }
}
