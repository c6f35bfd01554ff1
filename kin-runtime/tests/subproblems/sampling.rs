//! Random and structured input, and an independent search for all roots.

use core::f64::consts::{PI, TAU};
use kin_runtime::__private::math::wrap;
use kin_runtime::Pose;

pub type Vector = [f64; 3];

pub const X: Vector = [1.0, 0.0, 0.0];
pub const Y: Vector = [0.0, 1.0, 0.0];
pub const Z: Vector = [0.0, 0.0, 1.0];

/// A deterministic stream of numbers in [−1, 1).
pub struct Stream(u64);

impl Stream {
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
    pub fn angle(&mut self) -> f64 {
        PI * self.next()
    }
    pub fn vector(&mut self) -> Vector {
        [self.next(), self.next(), self.next()]
    }
    pub fn unit(&mut self) -> Vector {
        let v = self.vector();
        v.map(|x| x / norm(v))
    }
}

pub const SAMPLES: usize = 2000;

pub fn stream() -> Stream {
    Stream(0x2545_f491_4f6c_dd1d)
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn shifted(p: Vector, t: f64, v: Vector) -> Vector {
    [p[0] + t * v[0], p[1] + t * v[1], p[2] + t * v[2]]
}

pub fn rotated(k: Vector, t: f64, p: Vector) -> Vector {
    Pose::from_axis_angle(k, t, [0.0; 3]).rotate(p)
}

pub fn contains(roots: &[f64], t: f64, tolerance: f64) -> bool {
    roots.iter().any(|root| wrap(root - t).abs() < tolerance)
}

/// The roots of `f` on the circle, each bracketed by a sign change between two
/// of 720 samples.
pub fn sign_changes(f: impl Fn(f64) -> f64) -> usize {
    let at = |i: usize| f(TAU * (i as f64 + 0.123) / 720.0 - PI);
    (0..720)
        .filter(|&i| (at(i) > 0.0) != (at(i + 1) > 0.0))
        .count()
}

pub fn plus(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub fn times(s: f64, a: Vector) -> Vector {
    a.map(|x| s * x)
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// How far two sets of angles are apart on their circles.
pub fn apart<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    (0..N).map(|i| wrap(a[i] - b[i]).abs()).fold(0.0, f64::max)
}

/// The distance of the solutions nearest to the given angles.
pub fn nearest<const N: usize>(answers: &[[f64; N]], t: &[f64; N]) -> f64 {
    answers.iter().map(|a| apart(a, t)).fold(f64::MAX, f64::min)
}

/// Every solutions is a proper angle.
pub fn proper<const N: usize>(answers: &[[f64; N]]) -> bool {
    answers.iter().flatten().all(|t| *t > -PI && *t <= PI)
}

/// All roots of a smooth function on the circle: sign changes between dense
/// samples and the extrema between them, bisected. None if it is near zero
/// somewhere without crossing, or crosses at a grazing angle, and so leaves
/// open how many there are.
pub fn roots_on_circle(f: impl Fn(f64) -> f64) -> Option<Vec<f64>> {
    const N: usize = 720;
    let angle = |i: usize| TAU * (i as f64 + 0.37) / N as f64 - PI;
    let values: Vec<f64> = (0..N).map(|i| f(angle(i))).collect();
    let size = values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let bisect = |mut low: f64, mut high: f64| {
        let sign = f(low) > 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (f(middle) > 0.0) == sign {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    let mut roots = Vec::new();
    for i in 0..N {
        let [a, b, c] = [0, 1, 2].map(|j| values[(i + j) % N]);
        if (a > 0.0) != (b > 0.0) {
            roots.push(bisect(angle(i), angle(i + 1)));
        }
        // The extremum of |f| towards zero, by golden section.
        if (a > 0.0) == (b > 0.0) && (b > 0.0) == (c > 0.0) && b.abs() <= a.abs().min(c.abs()) {
            let towards = |t: f64| if b > 0.0 { f(t) } else { -f(t) };
            let (mut low, mut high) = (angle(i), angle(i + 2));
            for _ in 0..60 {
                let (left, right) = (low + 0.382 * (high - low), high - 0.382 * (high - low));
                if towards(left) < towards(right) {
                    high = right;
                } else {
                    low = left;
                }
            }
            let least = towards(low);
            if least.abs() < 1e-9 * size {
                return None;
            }
            if least < 0.0 {
                roots.extend([bisect(angle(i), low), bisect(low, angle(i + 2))]);
            }
        }
    }
    let steep = |t: &f64| (f(t + 1e-5) - f(t - 1e-5)).abs() > 1e-9 * size;
    roots.iter().all(steep).then_some(roots)
}

/// Coefficients of a function m + c cos t + s sin t, from three of its values.
pub fn harmonic(f: impl Fn(f64) -> f64) -> [f64; 3] {
    let (front, back, side) = (f(0.0), f(PI), f(0.5 * PI));
    let mean = 0.5 * (front + back);
    [mean, front - mean, side - mean]
}

/// Axes along, against and across each other, and two askew.
pub const AXES: [Vector; 6] = [
    X,
    Y,
    Z,
    [0.0, 0.0, -1.0],
    [0.6, 0.0, 0.8],
    [2.0 / 7.0, 3.0 / 7.0, -6.0 / 7.0],
];

/// Angles at which sines or cosines vanish, and one other.
pub const ANGLES: [f64; 5] = [0.0, 0.5 * PI, PI, -0.5 * PI, 0.7];
