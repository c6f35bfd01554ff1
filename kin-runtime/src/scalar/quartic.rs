//! Trigonometric quartics: where two subproblems meet in four branches.

use crate::math;

/// A root of a trigonometric quartic.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrigRoot {
    /// sin θ.
    pub sin: f64,
    /// cos θ.
    pub cos: f64,
    /// 0 for a root, 1 for a place that holds none, 2 for a double root.
    pub state: f64,
}

/// [`TrigRoot::state`] of a simple root.
pub const SIMPLE: f64 = 0.0;
/// [`TrigRoot::state`] of a place that holds no root.
pub const NONE: f64 = 1.0;
/// [`TrigRoot::state`] of two or more roots that have met; only the first has
/// a place.
pub const DOUBLE: f64 = 2.0;

/// Two roots nearer than this are one: radians. A double root is only
/// determined to the square root of the rounding error.
const SAME: f64 = 2e-7;
/// Discriminants that rounding has pushed below zero by less than this,
/// relative to the coefficients, are zero.
const NOISE: f64 = 1e-7;
/// An extremum this near to zero, relative to the coefficients, is a double
/// root.
const DOUBLE_ROOT: f64 = 1e-14;
/// Roots have met only where f is less steep than this: nearer than [`NEAR`] to an extremum it is, since
/// |f″| is below 8 where no coefficient is above 1, and where Newton's method leads next to a root of
/// multiplicity three or four.
const FLAT: f64 = 1e-2;
/// And only where f is lower: nearer than [`WIDE`] to a root of multiplicity three or four it is, since
/// |f‴| is below 13.
const LOW: f64 = 4e-3;
/// An extremum this near to a root, radians, may be the root.
const NEAR: f64 = 1e-3;
/// As [`NEAR`], for a root of multiplicity three or four.
const WIDE: f64 = 0.1;
/// A root must satisfy the equation to this, relative to the coefficients.
const CLOSED: f64 = 1e-12;
/// An extremum that misses zero by less than this is a double root of a target
/// that is off by as much; what it is worth shows in the residual.
const MISSED: f64 = 1e-8;

/// The real roots of
///
/// ```text
/// f(θ) = a₂ cos 2θ + b₂ sin 2θ + a₁ cos θ + b₁ sin θ + a₀
/// ```
///
/// given as `[a2, b2, a1, b1, a0]`: up to four, each once, in four places.
///
/// The half-angle substitution turns f into a quartic polynomial. Its root at
/// infinity is avoided by measuring θ from where |f| is largest among eight
/// directions, opposite. The quartic is split into two real quadratics by the
/// largest root of its resolvent cubic (Ferrari), without dividing by what
/// vanishes in the biquadratic case, and every root is refined on f itself.
/// Simple roots are accurate to a few units of rounding over the slope of f. So
/// are multiple ones, found as roots of a derivative, unless rounding in the
/// coefficients has parted them. Two roots less than 2e-7 apart, and three or
/// four between which f stays below 1e-14 of its coefficients, are one. Where f
/// misses zero by less than 1e-8 of its coefficients, without a root nearby, the
/// extremum stands for a double root. An identically vanishing f has no roots.
///
/// ```
/// use kin_runtime::__private::quartic::{SIMPLE, trig_roots};
/// // cos 2θ = 0
/// let roots = trig_roots([1.0, 0.0, 0.0, 0.0, 0.0]);
/// assert!(roots.iter().all(|root| root.state == SIMPLE));
/// assert!(roots.iter().all(|root| (root.sin.abs() - 0.5_f64.sqrt()).abs() < 1e-15));
/// ```
pub fn trig_roots(f: [f64; 5]) -> [TrigRoot; 4] {
    let scale = f.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    // Also where the scale is NaN.
    if !(f64::MIN_POSITIVE..1e300).contains(&scale) {
        return [TrigRoot {
            sin: 0.0,
            cos: 1.0,
            state: NONE,
        }; 4];
    }
    let f = f.map(|x| x / scale);
    let mut derivatives = [f; 5];
    for i in 1..5 {
        derivatives[i] = derivative(&derivatives[i - 1]);
    }
    let (sin, cos) = best_reference(&f);
    let turned = turn(&f, sin, cos);
    let places = half_angle_roots(&turned);
    // tan(θ/2) = t, turned back by the reference.
    let starts = places.map(|(t, _)| {
        let (s, c) = (2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t));
        (s * cos + c * sin, c * cos - s * sin)
    });
    let mut roots = [TrigRoot::default(); 4];
    for (k, &place) in refined(&f, &derivatives[1], starts).iter().enumerate() {
        let met = meeting(&derivatives, place);
        let root = met.unwrap_or(place);
        let height = value(&f, root).abs();
        let state = match met {
            Some(_) if height < MISSED => DOUBLE,
            None if places[k].1 && height < CLOSED => SIMPLE,
            _ => NONE,
        };
        roots[k] = TrigRoot {
            sin: root.0,
            cos: root.1,
            state,
        };
    }
    merge(&mut roots);
    roots
}

/// f at an angle.
fn value(f: &[f64; 5], (s, c): (f64, f64)) -> f64 {
    let [a2, b2, a1, b1, a0] = *f;
    a2 * (c - s) * (c + s) + 2.0 * b2 * s * c + a1 * c + b1 * s + a0
}

/// The direction, of eight, opposite to which |f| is largest.
fn best_reference(f: &[f64; 5]) -> (f64, f64) {
    const H: f64 = core::f64::consts::FRAC_1_SQRT_2;
    const DIRECTIONS: [(f64, f64); 8] = [
        (0.0, 1.0),
        (1.0, 0.0),
        (0.0, -1.0),
        (-1.0, 0.0),
        (H, H),
        (H, -H),
        (-H, -H),
        (-H, H),
    ];
    let mut best = (0.0, DIRECTIONS[0]);
    for (s, c) in DIRECTIONS {
        let size = value(f, (-s, -c)).abs();
        if size > best.0 {
            best = (size, (s, c));
        }
    }
    best.1
}

/// The coefficients of f(θ + φ) as a function of θ.
fn turn(f: &[f64; 5], s: f64, c: f64) -> [f64; 5] {
    let [a2, b2, a1, b1, a0] = *f;
    let (s2, c2) = (2.0 * s * c, (c - s) * (c + s));
    [
        a2 * c2 + b2 * s2,
        b2 * c2 - a2 * s2,
        a1 * c + b1 * s,
        b1 * c - a1 * s,
        a0,
    ]
}

/// t = tan(θ/2) for the roots of f, and whether they are real.
fn half_angle_roots(f: &[f64; 5]) -> [(f64, bool); 4] {
    let [a2, b2, a1, b1, a0] = *f;
    // (1 + t²)² f(θ), highest power first.
    let lead = a2 - a1 + a0;
    let a = (2.0 * b1 - 4.0 * b2) / lead;
    let b = (2.0 * a0 - 6.0 * a2) / lead;
    let c = (2.0 * b1 + 4.0 * b2) / lead;
    let d = (a2 + a1 + a0) / lead;
    // Depressed: t = y − a/4.
    let h = 0.25 * a;
    let p = b - 6.0 * h * h;
    let q = c - 2.0 * b * h + 8.0 * h * h * h;
    let r = d - c * h + b * h * h - 3.0 * h * h * h * h;
    // (y² + s y + t)(y² − s y + u)
    let m = largest_root(p, 0.25 * p * p - r, -0.125 * q * q);
    let ss = 2.0 * m;
    let s = math::sqrt(ss);
    let sum = p + ss;
    let gap = math::sqrt((sum * sum - 4.0 * r).max(0.0));
    let gap = if q < 0.0 { -gap } else { gap };
    let (t, u) = (0.5 * (sum - gap), 0.5 * (sum + gap));
    // The factors as polynomials in t, which rounding in the shift and in the
    // resolvent has moved a little.
    let unshift = |linear: f64, constant: f64| [linear + 2.0 * h, constant + h * (linear + h)];
    let factors = refine([a, b, c, d], [unshift(s, t), unshift(-s, u)]);
    let [[first, second], [third, fourth]] = factors.map(quadratic);
    [first, second, third, fourth]
}

/// Newton on (t² + α t + β)(t² + γ t + δ) = t⁴ + a t³ + b t² + c t + d. The
/// factors stay as they are where they share a root.
fn refine([a, b, c, d]: [f64; 4], factors: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let [[mut alpha, mut beta], [mut gamma, mut delta]] = factors;
    for _ in 0..2 {
        let e3 = alpha + gamma - a;
        let e2 = beta + delta + alpha * gamma - b;
        let e1 = alpha * delta + beta * gamma - c;
        let e0 = beta * delta - d;
        let (apart, over) = (alpha - gamma, delta - beta);
        let rest = alpha * e3 - e2;
        let (f, g) = (beta * e3 - alpha * rest - e1, -beta * rest - e0);
        let corner = over + alpha * apart;
        let resultant = corner * over + beta * apart * apart;
        let size = over * over + (alpha * alpha + beta.abs()) * apart * apart;
        if resultant.abs() > 1e-9 * size && size > 1e-200 {
            let d_alpha = (f * over + g * apart) / resultant;
            let d_beta = (corner * g - beta * apart * f) / resultant;
            alpha += d_alpha;
            beta += d_beta;
            gamma -= e3 + d_alpha;
            delta += rest - d_beta + apart * d_alpha;
        }
    }
    [[alpha, beta], [gamma, delta]]
}

/// t² + b t + c = 0, without cancellation.
fn quadratic([b, c]: [f64; 2]) -> [(f64, bool); 2] {
    let discriminant = 0.25 * b * b - c;
    let real = discriminant > -NOISE * (1.0 + b * b + c.abs());
    let root = math::sqrt(discriminant.max(0.0));
    let far = if b < 0.0 {
        -0.5 * b + root
    } else {
        -0.5 * b - root
    };
    // The product of the roots is c; where both vanish, so does the far one.
    let near = if far.abs() > 1e-150 { c / far } else { 0.0 };
    let near = if discriminant > 0.0 { near } else { far };
    [(far, real), (near, real)]
}

/// The largest real root of m³ + a m² + b m + c, which has one that is not
/// negative.
fn largest_root(a: f64, b: f64, c: f64) -> f64 {
    let shift = a / 3.0;
    let p = (b - a * shift) / 3.0;
    let q = 0.5 * (c + shift * (2.0 * shift * shift - b));
    let discriminant = q * q + p * p * p;
    let y = if discriminant > 0.0 {
        let root = math::sqrt(discriminant);
        let big = libm::cbrt(if q < 0.0 { -q + root } else { -q - root });
        if big != 0.0 { big - p / big } else { 0.0 }
    } else {
        let radius = math::sqrt((-p).max(0.0));
        let cosine = if radius > 0.0 {
            (-q / (radius * radius * radius)).clamp(-1.0, 1.0)
        } else {
            1.0
        };
        2.0 * radius * libm::cos(libm::acos(cosine) / 3.0)
    };
    let mut m = y - shift;
    for _ in 0..3 {
        let value = ((m + a) * m + b) * m + c;
        let slope = (3.0 * m + 2.0 * a) * m + b;
        let step = value / slope;
        if slope.abs() > 1e-300 && step.abs() < 0.1 * (1.0 + m.abs()) {
            m -= step;
        }
    }
    m.max(0.0)
}

/// Newton on f as long as it brings f nearer to zero, from four places side by side.
fn refined(f: &[f64; 5], slope: &[f64; 5], starts: [(f64, f64); 4]) -> [(f64, f64); 4] {
    let (mut sin, mut cos) = (starts.map(|it| it.0), starts.map(|it| it.1));
    let mut y = starts.map(|it| value(f, it));
    for _ in 0..6 {
        for k in 0..4 {
            let here = (sin[k], cos[k]);
            let there = nudged(here, -y[k], value(slope, here));
            let height = value(f, there);
            let is_nearer = height.abs() < y[k].abs();
            sin[k] = math::select(is_nearer, there.0, here.0);
            cos[k] = math::select(is_nearer, there.1, here.1);
            y[k] = math::select(is_nearer, height, y[k]);
        }
    }
    core::array::from_fn(|k| (sin[k], cos[k]))
}

/// Where roots have met, if they have next to a place that Newton on f led to.
fn meeting(f: &[[f64; 5]; 5], best: (f64, f64)) -> Option<(f64, f64)> {
    if value(&f[1], best).abs() >= FLAT || value(&f[0], best).abs() >= LOW {
        return None;
    }
    meeting_nearby(f, best)
}

#[cold]
fn meeting_nearby(f: &[[f64; 5]; 5], best: (f64, f64)) -> Option<(f64, f64)> {
    let several = [4, 3]
        .into_iter()
        .find_map(|order| multiple(f, best, order));
    several.or_else(|| {
        let extremum = newton::<3>(&f[1], &f[2], best);
        let height = value(&f[0], extremum);
        let missed = height * value(&f[2], extremum) > 0.0 && height.abs() < MISSED;
        // Newton stays where it is if f″ vanishes; that is no extremum.
        let flat = value(&f[1], extremum).abs() < SAME && apart(extremum, best) < NEAR;
        (flat && (height.abs() < DOUBLE_ROOT || missed)).then_some(extremum)
    })
}

/// The root of multiplicity 3 or 4 nearby, if there is one.
///
/// Ferrari finds its way to such roots only to a few hundredths of a radian,
/// and Newton on f creeps; but the last derivative that vanishes has a simple
/// root there. It is multiple if f is too shallow around to tell its roots
/// apart.
fn multiple(f: &[[f64; 5]; 5], best: (f64, f64), order: usize) -> Option<(f64, f64)> {
    let centre = newton::<6>(&f[order - 1], &f[order], best);
    let d = f.map(|f| value(&f, centre).abs());
    let shallow = if order == 4 {
        // d₁ x, d₂ x²/2 where d₄ x⁴/24 reaches the rounding error.
        d[1] * d[1] * d[1] * d[1] <= DOUBLE_ROOT * DOUBLE_ROOT * DOUBLE_ROOT * d[4]
            && d[2] * d[2] <= DOUBLE_ROOT * d[4]
    } else {
        // The height of the extrema of d₁ x + d₃ x³/6.
        d[1] * d[1] * d[1] <= DOUBLE_ROOT * DOUBLE_ROOT * d[3]
    };
    let met = apart(centre, best) < WIDE && d[0] < DOUBLE_ROOT && shallow;
    met.then_some(centre)
}

/// `STEPS` Newton steps towards a root of f, given f′.
fn newton<const STEPS: usize>(f: &[f64; 5], slope: &[f64; 5], start: (f64, f64)) -> (f64, f64) {
    let mut root = start;
    for _ in 0..STEPS {
        root = nudged(root, -value(f, root), value(slope, root));
    }
    root
}

/// f′.
fn derivative(f: &[f64; 5]) -> [f64; 5] {
    let [a2, b2, a1, b1, _] = *f;
    [2.0 * b2, -2.0 * a2, b1, -a1, 0.0]
}

fn apart(a: (f64, f64), b: (f64, f64)) -> f64 {
    (a.0 - b.0).abs() + (a.1 - b.1).abs()
}

/// A unit vector turned by the Newton step `rise / rate`, at most a little.
fn nudged((s, c): (f64, f64), rise: f64, rate: f64) -> (f64, f64) {
    let step = rise * rate / math::max(rate * rate, 1e-200);
    // Half the step's tangent keeps the point on the circle, but for h⁶.
    let h = math::max(-0.025, math::min(0.025, 0.5 * step));
    let hh = h * h;
    let scale = 1.0 - hh * (1.0 - hh);
    let (ds, dc) = (2.0 * h * scale, (1.0 - hh) * scale);
    let (s, c) = (s * dc + c * ds, c * dc - s * ds);
    // 1/√x next to 1.
    let norm = 1.5 - 0.5 * (s * s + c * c);
    (s * norm, c * norm)
}

/// Of roots that coincide the first is double and the others are none.
fn merge(roots: &mut [TrigRoot; 4]) {
    for i in 0..4 {
        for j in i + 1..4 {
            let (a, b) = (roots[i], roots[j]);
            let apart = (a.sin - b.sin).abs().max((a.cos - b.cos).abs());
            if a.state != NONE && b.state != NONE && apart < SAME {
                roots[i].state = DOUBLE;
                roots[j].state = NONE;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// f with the given roots: the product of sin((θ − θᵢ)/2).
    fn from_roots(roots: [f64; 4]) -> [f64; 5] {
        // sin((θ−α)/2) sin((θ−β)/2) = (cos((α−β)/2) − cos(θ − (α+β)/2)) / 2
        let pair = |a: f64, b: f64| {
            let mean = 0.5 * (a + b);
            [
                0.5 * (0.5 * (a - b)).cos(),
                -0.5 * mean.cos(),
                -0.5 * mean.sin(),
            ]
        };
        let [p, q] = [pair(roots[0], roots[1]), pair(roots[2], roots[3])];
        let (cc, ss, cs) = (p[1] * q[1], p[2] * q[2], p[1] * q[2] + p[2] * q[1]);
        [
            0.5 * (cc - ss),
            0.5 * cs,
            p[0] * q[1] + p[1] * q[0],
            p[0] * q[2] + p[2] * q[0],
            p[0] * q[0] + 0.5 * (cc + ss),
        ]
    }

    fn found(f: [f64; 5]) -> Vec<f64> {
        let roots = trig_roots(f);
        let mut angles: Vec<f64> = roots
            .iter()
            .filter(|r| r.state != NONE)
            .map(|r| r.sin.atan2(r.cos))
            .collect();
        angles.sort_by(f64::total_cmp);
        angles
    }

    fn distance(a: f64, b: f64) -> f64 {
        math::wrap(a - b).abs()
    }

    struct Random(u64);
    impl Random {
        fn next(&mut self) -> f64 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
        }
    }

    #[test]
    fn finds_four_simple_roots() {
        let mut random = Random(7);
        for _ in 0..20_000 {
            let roots = [0; 4].map(|_| random.next() * core::f64::consts::PI);
            let gap = (0..4).flat_map(|i| (0..i).map(move |j| (i, j)));
            let gap = gap
                .map(|(i, j)| distance(roots[i], roots[j]))
                .fold(9.0, f64::min);
            let scale = 10_f64.powf(random.next() * 6.0);
            let angles = found(from_roots(roots).map(|x| x * scale));
            if gap > 1e-4 {
                assert_eq!(angles.len(), 4, "{roots:?} gave {angles:?}");
            }
            for root in roots {
                let nearest = angles
                    .iter()
                    .map(|a| distance(*a, root))
                    .fold(9.0, f64::min);
                let tolerance = 1e-14 / gap.min(0.1).powi(3) + 1e-14;
                assert!(
                    nearest < tolerance.min(1e-5),
                    "{roots:?} gave {angles:?}, {nearest:e}"
                );
            }
        }
    }

    #[test]
    fn finds_two_roots_beside_a_complex_pair() {
        let mut random = Random(11);
        for _ in 0..20_000 {
            // (cos(θ − α) − k)(cos(θ − β) − l) with |k| < 1 < |l|.
            let (alpha, beta) = (random.next() * 3.0, random.next() * 3.0);
            let k = 0.999 * random.next();
            let l = 1.001 + 3.0 * random.next().abs();
            let (p, q) = ([-k, alpha.cos(), alpha.sin()], [-l, beta.cos(), beta.sin()]);
            let (cc, ss, cs) = (p[1] * q[1], p[2] * q[2], p[1] * q[2] + p[2] * q[1]);
            let f = [
                0.5 * (cc - ss),
                0.5 * cs,
                p[0] * q[1] + p[1] * q[0],
                p[0] * q[2] + p[2] * q[0],
                p[0] * q[0] + 0.5 * (cc + ss),
            ];
            let angles = found(f);
            assert_eq!(angles.len(), 2, "{alpha} {beta} {k} {l} gave {angles:?}");
            for sign in [1.0, -1.0] {
                let root = alpha + sign * k.acos();
                assert!(angles.iter().any(|a| distance(*a, root) < 1e-9));
            }
        }
    }

    #[test]
    fn a_root_at_pi_is_not_at_infinity() {
        let roots = [core::f64::consts::PI, 0.3, -1.0, 2.0];
        assert!(
            found(from_roots(roots))
                .iter()
                .any(|a| distance(*a, roots[0]) < 1e-13)
        );
    }

    #[test]
    fn special_angles_and_biquadratic_cases() {
        use core::f64::consts::{FRAC_PI_2, PI};
        let special = [0.0, FRAC_PI_2, PI, -FRAC_PI_2, 0.5, -0.5, PI - 0.5];
        for a in special {
            for b in special {
                for c in special {
                    for d in special {
                        let roots = [a, b, c, d];
                        let angles = found(from_roots(roots));
                        for root in roots {
                            let nearest = angles
                                .iter()
                                .map(|x| distance(*x, root))
                                .fold(9.0, f64::min);
                            // A root of multiplicity n is determined to ε^(1/n).
                            assert!(nearest < 1e-3, "{roots:?} gave {angles:?}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn double_roots_come_once() {
        let mut random = Random(3);
        for _ in 0..5_000 {
            let double = random.next() * 3.0;
            let others = [
                double + 0.4 + random.next().abs(),
                double - 0.4 - random.next().abs(),
            ];
            let angles = found(from_roots([double, double, others[0], others[1]]));
            assert_eq!(angles.len(), 3, "{double} {others:?} gave {angles:?}");
            assert!(angles.iter().any(|a| distance(*a, double) < 1e-6));
        }
    }

    /// Where they are not looked for there are none: next to clusters of roots and of extrema.
    #[test]
    fn roots_have_met_only_where_it_is_flat_and_low() {
        let mut random = Random(29);
        let mut met = 0;
        for _ in 0..40_000 {
            let spread = 10_f64.powf(-5.0 + 5.0 * random.next());
            let count = 2 + (1.5 * (random.next() + 1.0)) as usize;
            let cluster = random.next() * core::f64::consts::PI;
            let roots = core::array::from_fn(|k| match k < count {
                true => cluster + spread * random.next(),
                false => random.next() * core::f64::consts::PI,
            });
            let mut f = from_roots(roots);
            // Also without these roots: an extremum that misses zero.
            f[4] += spread * spread * random.next().max(0.0);
            let scale = f.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let mut derivatives = [f.map(|x| x / scale); 5];
            for i in 1..5 {
                derivatives[i] = derivative(&derivatives[i - 1]);
            }
            let off = 10_f64.powf(-4.5 + 4.0 * random.next()) * random.next();
            let starts = [(cluster + off).sin_cos(); 4];
            let [place, ..] = refined(&derivatives[0], &derivatives[1], starts);
            let nearby = meeting_nearby(&derivatives, place);
            assert_eq!(meeting(&derivatives, place), nearby, "{roots:?}, {off:e}");
            met += usize::from(nearby.is_some());
        }
        assert!(met > 2_000, "{met}");
    }

    #[test]
    fn no_roots_and_no_equation() {
        assert!(found([0.1, 0.0, 0.0, 0.0, 1.0]).is_empty());
        assert!(found([0.0; 5]).is_empty());
        assert!(found([f64::NAN; 5]).is_empty());
        assert!(found([f64::INFINITY, 0.0, 0.0, 0.0, 1.0]).is_empty());
    }

    #[test]
    fn lower_degrees_are_quartics_too() {
        // cos θ = 1/2, with no second harmonic.
        let angles = found([0.0, 0.0, 1.0, 0.0, -0.5]);
        assert_eq!(angles.len(), 2);
        assert!((angles[1] - core::f64::consts::FRAC_PI_3).abs() < 1e-14);
    }
}
