//! The errors that `math` states, measured against double-double references.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, FRAC_PI_8, PI, TAU};
use kin_runtime::__private::math::{atan2, sin_cos_by, sqrt, wrap};
use kin_runtime::__private::{Arithmetic, Fused, lanes};

/// Rounded after each operation, and with fused ones.
const SIN_COS: [fn(f64) -> (f64, f64); 2] = [sin_cos_by::<false>, sin_cos_by::<true>];
const OF_UNIT: [fn(f64, f64) -> f64; 2] = [Fused::<false>::angle, Fused::<true>::angle];

/// An unevaluated sum of two doubles: about 32 digits.
#[derive(Clone, Copy)]
struct Double(f64, f64);

const HALF_PI: [f64; 3] = [FRAC_PI_2, 6.123233995736766e-17, -1.4973849048591833e-33];

impl Double {
    fn sum(a: f64, b: f64) -> Double {
        let s = a + b;
        let t = s - a;
        Double(s, (a - (s - t)) + (b - t))
    }
    fn product(a: f64, b: f64) -> Double {
        let p = a * b;
        Double(p, a.mul_add(b, -p))
    }
    fn add(self, other: Double) -> Double {
        let high = Double::sum(self.0, other.0);
        let low = Double::sum(self.1, other.1);
        let inner = Double::sum(high.0, high.1 + low.0);
        Double::sum(inner.0, inner.1 + low.1)
    }
    fn mul(self, other: Double) -> Double {
        let p = Double::product(self.0, other.0);
        Double::sum(p.0, p.1 + self.0 * other.1 + self.1 * other.0)
    }
    fn scale(self, k: f64) -> Double {
        self.mul(Double(k, 0.0))
    }
    fn divide_by(self, k: f64) -> Double {
        let q = self.0 / k;
        let rest = self.add(Double::product(q, -k));
        Double::sum(q, rest.0 / k)
    }
    /// `self − x`, rounded once.
    fn minus(self, x: f64) -> f64 {
        (self.0 - x) + self.1
    }
}

/// Sine and cosine by Taylor series after reduction by a 160 bit π/2.
fn reference_sin_cos(x: f64) -> (Double, Double) {
    let n = (x / FRAC_PI_2).round();
    let r = HALF_PI
        .iter()
        .fold(Double(x, 0.0), |r, part| r.add(Double::product(-n, *part)));
    let (mut sine, mut cosine) = (r, Double(1.0, 0.0));
    let mut term = Double(1.0, 0.0);
    for k in 1..30 {
        term = term.mul(r).divide_by(k as f64);
        let signed = if k % 4 < 2 { term } else { term.scale(-1.0) };
        match k {
            1 => {}
            _ if k % 2 == 1 => sine = sine.add(signed),
            _ => cosine = cosine.add(signed),
        }
    }
    match (n as i64).rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, sine.scale(-1.0)),
        2 => (sine.scale(-1.0), cosine.scale(-1.0)),
        _ => (cosine.scale(-1.0), sine),
    }
}

/// One Newton step in double-double from the standard library's angle.
fn reference_atan2(y: f64, x: f64) -> Double {
    let start = y.atan2(x);
    let (sine, cosine) = reference_sin_cos(start);
    let across = cosine.scale(y).add(sine.scale(-x)).0;
    let along = cosine.scale(x).add(sine.scale(y)).0;
    Double(start, across / along)
}

/// A deterministic stream of numbers in [0, 1).
fn stream() -> impl FnMut() -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn worst_sin_cos_error(sin_cos: fn(f64) -> (f64, f64), range: f64, samples: usize) -> f64 {
    let mut next = stream();
    let mut worst = 0.0_f64;
    for _ in 0..samples {
        let x = (2.0 * next() - 1.0) * range;
        let (s, c) = sin_cos(x);
        let (reference_s, reference_c) = reference_sin_cos(x);
        worst = worst
            .max(reference_s.minus(s).abs())
            .max(reference_c.minus(c).abs());
    }
    worst
}

#[test]
fn sin_cos_is_accurate_over_its_range() {
    for sin_cos in SIN_COS {
        for range in [FRAC_PI_4, PI, TAU, 100.0, 1.6e6] {
            let worst = worst_sin_cos_error(sin_cos, range, 40_000);
            println!("sin_cos on ±{range}: {worst:e}");
            assert!(worst < 1.5e-16, "{worst:e} on ±{range}");
        }
    }
}

#[test]
fn sin_cos_degrades_in_proportion_beyond_its_range() {
    for sin_cos in SIN_COS {
        for range in [1e8, 1e11, 1e14] {
            let worst = worst_sin_cos_error(sin_cos, range, 10_000);
            assert!(worst < 1.5e-16 * range, "{worst:e} on ±{range}");
        }
        for x in [1e16, 1e100, 1e300, f64::MAX, f64::MIN, -1e19] {
            let (s, c) = sin_cos(x);
            assert!(s.abs() <= 1.0 && c.abs() <= 1.0, "{x}: {s} {c}");
        }
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
    }
}

#[test]
fn small_sines_are_relatively_accurate() {
    for sin_cos in SIN_COS {
        let mut next = stream();
        for _ in 0..40_000 {
            let x = next() * 10.0_f64.powf(-8.0 * next()) * FRAC_PI_4;
            let error = reference_sin_cos(x).0.minus(sin_cos(x).0) / x;
            assert!(error.abs() < 1.2e-16, "{error:e} at {x}");
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert_eq!(sin_cos(-1e-300).0, -1e-300);
    }
}

#[test]
fn multiples_of_a_right_angle_are_clean() {
    for sin_cos in SIN_COS {
        for n in -40_i32..=40 {
            let (s, c) = sin_cos(f64::from(n) * FRAC_PI_2);
            let (es, ec) =
                [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][n.rem_euclid(4) as usize];
            assert!((s - es).abs() < 1e-14 && (c - ec).abs() < 1e-14);
        }
        assert_eq!(sin_cos(FRAC_PI_2).0, 1.0);
        assert_eq!(sin_cos(PI).1, -1.0);
    }
}

#[test]
fn atan2_is_accurate_in_every_sector() {
    let mut next = stream();
    let mut worst = 0.0_f64;
    for _ in 0..100_000 {
        let scale = 10.0_f64.powf(12.0 * next() - 6.0);
        let (y, x) = ((2.0 * next() - 1.0) * scale, 2.0 * next() - 1.0);
        let error = reference_atan2(y, x).minus(atan2(y, x)) / atan2(y, x);
        worst = worst.max(error.abs());
    }
    // Where rounding is worst: next to the ends of the first piece, and where the unit in the last place
    // of the angle is largest beside it.
    for _ in 0..200_000 {
        let (ratio, x) = (0.12 + 0.14 * next(), 0.25 + next());
        let error = reference_atan2(ratio * x, x).minus(atan2(ratio * x, x)) / atan2(ratio * x, x);
        worst = worst.max(error.abs());
    }
    println!("atan2: {worst:e}");
    assert!(worst < 3.3e-16, "{worst:e}");
}

#[test]
fn atan2_is_accurate_where_its_pieces_meet() {
    for ratio in [0.25, 0.5, 0.75, 1.0] {
        for steps in -1000..1000 {
            let y = ratio * (1.0 + f64::from(steps) * f64::EPSILON * 8.0);
            for (y, x) in [(y, 1.0), (1.0, y), (-y, 1.0), (1.0, -y), (y, -1.0)] {
                let error = reference_atan2(y, x).minus(atan2(y, x)) / atan2(y, x);
                assert!(error.abs() < 3.3e-16, "{error:e} at {y}, {x}");
            }
        }
    }
}

#[test]
fn atan2_is_exact_on_axes_and_diagonals() {
    for size in [1.0, 1e-290, 1e150] {
        assert_eq!(atan2(0.0, size), 0.0);
        assert_eq!(atan2(size, size), FRAC_PI_4);
        assert_eq!(atan2(size, 0.0), FRAC_PI_2);
        assert_eq!(atan2(size, -size), 3.0 * FRAC_PI_4);
        assert_eq!(atan2(0.0, -size), PI);
        assert_eq!(atan2(-0.0, -size), -PI);
        assert_eq!(atan2(-size, -size), -3.0 * FRAC_PI_4);
        assert_eq!(atan2(-size, 0.0), -FRAC_PI_2);
        assert_eq!(atan2(-size, -0.0), -FRAC_PI_2);
        assert_eq!(atan2(-size, size), -FRAC_PI_4);
    }
}

#[test]
fn atan2_of_zeros_is_a_zero_with_the_sign_of_y() {
    for x in [0.0, -0.0, 1.0] {
        assert_eq!(atan2(0.0, x).to_bits(), 0.0_f64.to_bits());
        assert_eq!(atan2(-0.0, x).to_bits(), (-0.0_f64).to_bits());
    }
    assert!(atan2(f64::NAN, 1.0).is_nan() && atan2(1.0, f64::NAN).is_nan());
}

#[test]
fn the_angle_of_lanes_is_accurate_in_every_sector_and_between() {
    let mut next = stream();
    let mut worst = 0.0_f64;
    let mut check = |y: f64, x: f64| {
        let angle = lanes::angle(y, x);
        let error = reference_atan2(y, x).minus(angle) / angle;
        worst = worst.max(error.abs());
    };
    for _ in 0..100_000 {
        let scale = 10.0_f64.powf(12.0 * next() - 6.0);
        check((2.0 * next() - 1.0) * scale, 2.0 * next() - 1.0);
    }
    for ratio in [2.0_f64.sqrt() - 1.0, 1.0] {
        for steps in -1000..1000 {
            let y = ratio * (1.0 + f64::from(steps) * f64::EPSILON * 8.0);
            for (y, x) in [(y, 1.0), (1.0, y), (-y, 1.0), (1.0, -y), (y, -1.0)] {
                check(y, x);
            }
        }
    }
    println!("lanes::angle: {worst:e}");
    assert!(worst < 3.5e-16, "{worst:e}");
}

/// Of vectors that have the length 1 but for rounding, and that are off it by more.
#[test]
fn the_angle_of_unit_vectors_is_accurate_in_every_sector_and_between() {
    for angle_of in OF_UNIT {
        let mut next = stream();
        let mut worst = 0.0_f64;
        let mut check = |y: f64, x: f64, allowed: f64| {
            let angle = angle_of(y, x);
            let error = reference_atan2(y, x).minus(angle) / angle;
            worst = worst.max(error.abs() - allowed);
        };
        for k in 0..100_000 {
            let small = 10.0_f64.powf(-f64::from(k % 8));
            let (y, x) = (PI * (2.0 * next() - 1.0) * small).sin_cos();
            check(y, x, 0.0);
            for off in [1e-9, -1e-6, 1e-4] {
                check(y * (1.0 + off), x * (1.0 + off), 1.6 * off * off);
            }
        }
        for eighth in -7..8 {
            for steps in -1000..1000 {
                let about = f64::from(eighth) * FRAC_PI_8 + f64::EPSILON * f64::from(steps);
                let (y, x) = about.sin_cos();
                if y != 0.0 {
                    check(y, x, 0.0);
                }
            }
        }
        println!("lanes::angle_of_unit: {worst:e}");
        assert!(worst < 4.5e-16, "{worst:e}");
    }
}

#[test]
fn the_angles_of_lanes_are_exact_on_axes_and_diagonals_and_never_minus_pi() {
    let vectors = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (1.0, -1.0), (0.0, -1.0)];
    let check = |angle_of: fn(f64, f64) -> f64, size: fn(f64, f64) -> f64| {
        for (eighths, (y, x)) in vectors.into_iter().enumerate() {
            let angle = eighths as f64 * FRAC_PI_4;
            let size = size(y, x);
            assert_eq!(angle_of(y * size, x * size), angle);
            let below = if angle == PI { PI } else { -angle };
            assert_eq!(angle_of(-y * size, x * size), below);
        }
        assert_eq!(angle_of(-1e-30, -1.0), PI);
        assert_eq!(angle_of(0.0, 0.0), 0.0);
        assert_eq!(angle_of(-0.0, -0.0), 0.0);
        assert!(angle_of(f64::NAN, 1.0).is_nan() && angle_of(1.0, f64::NAN).is_nan());
    };
    for angle_of in OF_UNIT {
        check(angle_of, |y, x| 1.0 / f64::hypot(y, x));
    }
    for size in [|_, _| 1.0, |_, _| 1e-290, |_, _| 1e150] as [fn(f64, f64) -> f64; 3] {
        check(lanes::angle, size);
    }
}

#[test]
fn wrap_keeps_the_interval_and_moves_the_rest() {
    let mut next = stream();
    for range in [PI, 10.0, 1e3, 6e6] {
        for _ in 0..20_000 {
            let x = (2.0 * next() - 1.0) * range;
            let w = wrap(x);
            assert!(w > -PI && w <= PI);
            let turns = (x / TAU).round();
            let exact = HALF_PI.iter().fold(Double(x, 0.0), |r, part| {
                r.add(Double::product(-4.0 * turns, *part))
            });
            let error = exact.minus(w).abs();
            assert!(
                error < 5e-16 || (error - TAU).abs() < 5e-16,
                "{x} → {w}: {error:e}"
            );
            if range <= PI {
                assert_eq!(w, x);
            }
        }
    }
}

#[test]
fn wrap_maps_minus_pi_to_pi_and_never_leaves() {
    assert_eq!(wrap(-PI), PI);
    assert_eq!(wrap(PI), PI);
    assert_eq!(wrap(-PI + 5e-16), -PI + 5e-16);
    for odd in (1..20_000).step_by(2) {
        for step in -3..=3 {
            let x = f64::from(odd) * PI * (1.0 + f64::from(step) * f64::EPSILON);
            for x in [x, -x] {
                assert!(wrap(x) > -PI && wrap(x) <= PI, "{x}");
            }
        }
    }
    for x in [1e18, -1e200, f64::MAX] {
        assert!(wrap(x) > -PI && wrap(x) <= PI, "{x}");
    }
    assert!(wrap(f64::NAN).is_nan());
}

#[test]
fn sqrt_is_the_correctly_rounded_root() {
    assert_eq!(sqrt(2.0), core::f64::consts::SQRT_2);
    assert!(sqrt(-1.0).is_nan());
}
