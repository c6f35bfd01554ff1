//! Trigonometric quartics with roots that meet, coefficients that vanish, and
//! coefficients of any size.

use core::f64::consts::PI;
use kin_runtime::__private::math::wrap;
use kin_runtime::__private::quartic::{DOUBLE, NONE, SIMPLE, trig_roots};

/// A deterministic stream of numbers in [−1, 1).
struct Stream(u64);

impl Stream {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    /// Any angle, every fourth time π.
    fn angle(&mut self) -> f64 {
        if self.next() < -0.5 {
            PI
        } else {
            PI * self.next()
        }
    }
    fn scale(&mut self) -> f64 {
        10_f64.powf(10.0 * self.next())
    }
}

/// The product of sin((θ − θᵢ)/2), from the two products of pairs,
/// (cos((α − β)/2) − cos(θ − (α + β)/2)) / 2.
fn with_roots([a, b, c, d]: [f64; 4]) -> [f64; 5] {
    let pair = |a: f64, b: f64| {
        let (s, c) = (0.5 * (a + b)).sin_cos();
        [(0.5 * (a - b)).cos(), -c, -s]
    };
    let ([m, c1, s1], [n, c2, s2]) = (pair(a, b), pair(c, d));
    [
        0.5 * (c1 * c2 - s1 * s2),
        0.5 * (c1 * s2 + s1 * c2),
        m * c2 + n * c1,
        m * s2 + n * s1,
        m * n + 0.5 * (c1 * c2 + s1 * s2),
    ]
}

/// Angles and states of the roots.
fn found(f: [f64; 5]) -> Vec<(f64, f64)> {
    let roots = trig_roots(f);
    let real = roots.iter().filter(|root| root.state != NONE);
    real.map(|root| (root.sin.atan2(root.cos), root.state))
        .collect()
}

fn apart(a: f64, b: f64) -> f64 {
    wrap(a - b).abs()
}

fn nearest(roots: &[(f64, f64)], t: f64) -> f64 {
    roots.iter().map(|r| apart(r.0, t)).fold(f64::MAX, f64::min)
}

/// Roots of the given multiplicities, each found once, to `accuracy`.
fn multiple_roots(multiplicities: &[usize], accuracy: f64) {
    let mut random = Stream(7);
    let mut count = 0;
    while count < 10_000 {
        let places: Vec<f64> = multiplicities.iter().map(|_| random.angle()).collect();
        let crowded = |i: usize| places[..i].iter().any(|p| apart(*p, places[i]) < 0.2);
        if (0..places.len()).any(crowded) {
            continue;
        }
        count += 1;
        let repeated = places.iter().zip(multiplicities);
        let roots: Vec<f64> = repeated.flat_map(|(p, n)| vec![*p; *n]).collect();
        let scale = random.scale();
        let f = with_roots(roots.try_into().unwrap()).map(|x| scale * x);
        let answer = found(f);
        assert_eq!(answer.len(), places.len(), "{f:?} {places:?} {answer:?}");
        for (place, n) in places.iter().zip(multiplicities) {
            assert!(
                nearest(&answer, *place) < accuracy,
                "{f:?} {place} {answer:?}"
            );
            let (_, state) = *answer.iter().find(|r| apart(r.0, *place) < 0.1).unwrap();
            assert_eq!(
                state,
                if *n > 1 { DOUBLE } else { SIMPLE },
                "{f:?} {answer:?}"
            );
        }
    }
}

#[test]
fn simple_roots() {
    multiple_roots(&[1, 1, 1, 1], 1e-12);
}

#[test]
fn double_roots_come_once() {
    multiple_roots(&[2, 1, 1], 1e-12);
    multiple_roots(&[2, 2], 1e-12);
}

/// Ferrari finds its way to a triple root only to a few hundredths of a
/// radian, from where Newton creeps: one in a hundred was lost, and most of
/// the others came twice.
#[test]
fn triple_roots_come_once() {
    multiple_roots(&[3, 1], 1e-12);
}

#[test]
fn quadruple_roots_come_once() {
    multiple_roots(&[4], 1e-13);
}

/// At special angles derivatives vanish that are not those of a multiple root.
#[test]
fn special_angles_have_their_multiplicities() {
    let special = [0.0, 0.5 * PI, PI, -0.5 * PI, 0.25 * PI, -0.75 * PI, 0.5];
    for i in 0..special.len().pow(4) {
        let roots = [1, 7, 49, 343].map(|stride| special[i / stride % 7]);
        let answer = found(with_roots(roots));
        for root in roots {
            let times = roots.iter().filter(|r| **r == root).count();
            let here: Vec<_> = answer.iter().filter(|r| apart(r.0, root) < 1e-9).collect();
            assert_eq!(here.len(), 1, "{roots:?} {answer:?}");
            let expected = if times > 1 { DOUBLE } else { SIMPLE };
            assert_eq!(here[0].1, expected, "{roots:?} {answer:?}");
        }
    }
}

#[test]
fn near_double_roots_are_two_down_to_the_square_root_of_rounding() {
    let mut random = Stream(11);
    for _ in 0..2000 {
        let t = random.angle();
        for power in 1..=12 {
            let gap = 10_f64.powi(-power);
            let f = with_roots([t, t + gap, t + 1.0, t - 1.5]);
            let answer = found(f);
            let expected = if power <= 6 { 4 } else { 3 };
            assert_eq!(answer.len(), expected, "{gap:e} {answer:?}");
            for root in [t, t + gap] {
                // ε over the slope, which is the gap; or half the gap.
                let accuracy = if power <= 6 { 1e-14 / gap } else { gap };
                assert!(
                    nearest(&answer, root) < accuracy,
                    "{gap:e} {answer:?} {root}"
                );
            }
        }
    }
}

/// Three or four roots in a cluster are told apart, or are one; they are never
/// lost.
#[test]
fn clusters_are_resolved_or_one() {
    let mut random = Stream(13);
    for _ in 0..2000 {
        let t = random.angle();
        for power in 1..=8 {
            let gap = 10_f64.powi(-power);
            let three = [t, t + gap, t - 0.7 * gap];
            let answer = found(with_roots([three[0], three[1], three[2], t + 2.0]));
            let apart_enough = power <= 4;
            assert_eq!(
                answer.len(),
                if apart_enough { 4 } else { 2 },
                "{gap:e} {answer:?}"
            );
            assert!(three.iter().all(|r| nearest(&answer, *r) < gap));
            let four = [t, t + gap, t - 0.7 * gap, t + 2.0 * gap];
            let answer = found(with_roots(four));
            let apart_enough = power <= 3;
            assert_eq!(
                answer.len(),
                if apart_enough { 4 } else { 1 },
                "{gap:e} {answer:?}"
            );
            assert!(four.iter().all(|r| nearest(&answer, *r) < 1.5 * gap));
        }
    }
}

/// Any of the coefficients small or zero, compared with sign changes.
#[test]
fn vanishing_coefficients() {
    let mut random = Stream(17);
    let mut compared = 0;
    for i in 0..4000 {
        let small = [0.0, 1e-16, 1e-12, 1e-8, 1e-4, 1e-2][i / 32 % 6];
        let f: [f64; 5] = core::array::from_fn(|j| {
            let x = random.next();
            if (i >> j) & 1 == 1 { small * x } else { x }
        });
        let at = |t: f64| {
            let ((s2, c2), (s1, c1)) = ((2.0 * t).sin_cos(), t.sin_cos());
            f[0] * c2 + f[1] * s2 + f[2] * c1 + f[3] * s1 + f[4]
        };
        let angle = |i: usize| 2.0 * PI * (i as f64 + 0.3) / 1000.0 - PI;
        let values: Vec<f64> = (0..1000).map(|i| at(angle(i))).collect();
        let size = f.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        // Extrema near zero leave the number of roots open.
        let grazes = |i: usize| {
            let [a, b, c] = [0, 1, 2].map(|j| values[(i + j) % 1000]);
            b.abs() < 1e-4 * size && (b - a) * (c - b) <= 0.0
        };
        if size == 0.0 || (0..1000).any(grazes) {
            continue;
        }
        compared += 1;
        let mut expected = Vec::new();
        for i in 0..1000 {
            let positive = values[i] > 0.0;
            if positive != (values[(i + 1) % 1000] > 0.0) {
                let (mut low, mut high) = (angle(i), angle(i + 1));
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if (at(middle) > 0.0) == positive {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                expected.push(low);
            }
        }
        let answer = found(f);
        assert_eq!(
            answer.len(),
            expected.len(),
            "{f:?} {answer:?} {expected:?}"
        );
        assert!(expected.iter().all(|t| nearest(&answer, *t) < 1e-11));
    }
    assert!(compared > 3000, "{compared}");
}

#[test]
fn a_double_root_that_rounding_has_lifted_is_one() {
    for lift in [1e-16, 1e-15, 1e-14, 1e-13, 5e-13] {
        for t in [0.0, 0.3, PI, -2.0] {
            let mut f = with_roots([t, t, t + 1.0, t - 1.0]);
            let up = f.map(|x| x.abs()).into_iter().fold(0.0, f64::max) * lift;
            // Between the simple roots f is negative: this lowers its maximum.
            f[4] -= up;
            let answer = found(f);
            assert_eq!(answer.len(), 3, "{lift:e} {t} {answer:?}");
            assert!(nearest(&answer, t) < 1e-8);
        }
    }
}

#[test]
fn of_any_size() {
    let f = with_roots([PI, 0.5, -1.0, 2.0]);
    for scale in [1e-300, 1e-100, 1e-8, 1e8, 1e100, 1e290] {
        let answer = found(f.map(|x| scale * x));
        assert_eq!(answer.len(), 4);
        assert!(
            [PI, 0.5, -1.0, 2.0]
                .iter()
                .all(|t| nearest(&answer, *t) < 1e-14)
        );
    }
}
