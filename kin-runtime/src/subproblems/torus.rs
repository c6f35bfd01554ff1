//! Two equations, linear in the sines and cosines of two angles: what
//! subproblems 5 and 6 have in common.
//!
//! With z = (cos t₁, sin t₁, cos t₂, sin t₂) the equations are two planes in
//! four dimensions, and they meet the torus of all pairs of angles. The usual
//! way, to solve for (cos t₂, sin t₂) and to put the unit length of that into
//! an equation for t₁ alone, divides by a determinant that the geometry makes
//! zero whenever the conics decouple. Here nothing is solved for: on the torus
//! |z|² = 2, so the solutions lie on the circle in which the two planes meet
//! that sphere, and on that circle |(z₁, z₂)|² = |(z₃, z₄)|² is a trigonometric
//! quartic in the angle φ of the circle. The one division is by the length of
//! a row that has been made orthogonal to the other, and rows of no length are
//! a case of their own: dependent equations.

use super::{DOUBLE, ON_AXIS, SOLVED};
use crate::linear::vector::{dot, norm};
use crate::math;
use crate::scalar::quartic::{NONE, trig_roots};
use core::f64::consts::{FRAC_PI_4, TAU};

/// row · (cos t₁, sin t₁, cos t₂, sin t₂) = level; the terms are at most of
/// order one.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub row: [f64; 4],
    pub level: f64,
}

impl Plane {
    /// What the equation is off by at a pair of angles, and its slopes.
    pub fn at(&self, [t1, t2]: [f64; 2]) -> (f64, [f64; 2]) {
        let ((s1, c1), (s2, c2)) = (math::sin_cos(t1), math::sin_cos(t2));
        let [a, b, c, d] = self.row;
        let off = a * c1 + b * s1 + (c * c2 + d * s2) - self.level;
        (off, [b * c1 - a * s1, d * c2 - c * s2])
    }
}

/// Hands out candidates for [t₁, t₂], at least one near every isolated
/// solution, and some that are none. Returns a member if the solutions are a
/// family.
pub(super) fn meet(planes: [Plane; 2], mut each: impl FnMut([f64; 2])) -> Option<[f64; 2]> {
    let [mut first, mut second] = planes;
    if norm(second.row) > norm(first.row) {
        (first, second) = (second, first);
    }
    if norm(first.row) <= ON_AXIS {
        let holds = first.level.abs() <= SOLVED && second.level.abs() <= SOLVED;
        return holds.then_some([0.0; 2]);
    }
    let first = unit(first);
    // Twice is enough.
    let second = without(without(second, &first), &first);
    if norm(second.row) <= ON_AXIS {
        return if second.level.abs() <= SOLVED {
            one_equation(&first, each)
        } else {
            None
        };
    }
    let second = unit(second);
    let circle = Circle::new(&first, &second);
    if circle.radius < POINT {
        each(pair(circle.centre));
        for i in 0..8 {
            each(pair(circle.at(f64::from(i) * FRAC_PI_4)));
        }
        return None;
    }
    // The sines and cosines of a free angle run all around a unit circle, so
    // no family is on a smaller one.
    if circle.radius > 0.5 && circle.imbalance().amplitude() < FAMILY {
        let off = |t| planes.map(|plane| plane.at(t).0.abs());
        let solved = |i| {
            let [a, b] = off(pair(circle.at(f64::from(i) * FRAC_PI_4 + 0.1)));
            a.max(b) <= SOLVED
        };
        if (0..8).all(solved) {
            return Some(pair(circle.at(0.1)));
        }
    }
    circle.roots(|phi| each(pair(circle.at(phi))));
    None
}

/// A circle smaller than this is a point as far as double precision can tell.
const POINT: f64 = 3e-7;

/// A circle that is never further than this from the torus may lie on it, with
/// what rounding does to equations that are nearly dependent.
const FAMILY: f64 = 1e-6;

/// α cos(t₁ − φ₁) + β cos(t₂ − φ₂) = level is solved by a family of pairs,
/// unless both cosines have to be ±1.
fn one_equation(plane: &Plane, mut each: impl FnMut([f64; 2])) -> Option<[f64; 2]> {
    let [a, b, c, d] = plane.row;
    let (alpha, beta) = (math::sqrt(a * a + b * b), math::sqrt(c * c + d * d));
    let reach = alpha + beta;
    let turn = math::atan2(
        math::sqrt((reach * reach - plane.level * plane.level).max(0.0)),
        plane.level,
    );
    let member = [math::atan2(b, a) + turn, math::atan2(d, c) + turn];
    let free = alpha.min(beta) <= ON_AXIS;
    let (inside, missing) = (
        reach - plane.level.abs() > DOUBLE,
        plane.level.abs() - reach,
    );
    if inside || (free && missing <= SOLVED) {
        return Some(member.map(math::wrap));
    }
    each(member);
    None
}

/// The circle in which two planes meet the sphere |z|² = 2.
struct Circle {
    centre: [f64; 4],
    /// Negative if the planes miss the sphere.
    radius: f64,
    /// Two orthogonal vectors as long as the radius.
    spokes: [[f64; 4]; 2],
}

impl Circle {
    fn new(first: &Plane, second: &Plane) -> Circle {
        let centre =
            core::array::from_fn(|i| first.level * first.row[i] + second.level * second.row[i]);
        let square = 2.0 - first.level * first.level - second.level * second.level;
        let radius = if square > 0.0 {
            math::sqrt(square)
        } else {
            -math::sqrt(-square)
        };
        // Of the axes the one that leans least on the rows, then the next.
        let u = across(&[first.row, second.row]);
        let v = across(&[first.row, second.row, u]);
        // A small circle is left large enough to start from both its sides.
        let spoke = radius.max(1e-8);
        Circle {
            centre,
            radius,
            spokes: [u, v].map(|n| n.map(|x| spoke * x)),
        }
    }

    fn at(&self, phi: f64) -> [f64; 4] {
        let (s, c) = math::sin_cos(phi);
        let [u, v] = &self.spokes;
        core::array::from_fn(|i| self.centre[i] + (c * u[i] + s * v[i]))
    }

    /// |(z₁, z₂)|² − |(z₃, z₄)|² around the circle.
    fn imbalance(&self) -> Wave {
        let product =
            |a: &[f64; 4], b: &[f64; 4]| a[0] * b[0] + a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
        let ([u, v], z) = (&self.spokes, &self.centre);
        let (uu, vv) = (product(u, u), product(v, v));
        Wave([
            0.5 * (uu - vv),
            product(u, v),
            2.0 * product(z, u),
            2.0 * product(z, v),
            product(z, z) + 0.5 * (uu + vv),
        ])
    }

    /// The angles at which the imbalance vanishes, or nearly does.
    fn roots(&self, mut each: impl FnMut(f64)) {
        let wave = self.imbalance();
        let noise = DOUBLE * wave.amplitude() + 4.0 * f64::EPSILON;
        // Between neighbouring marks the imbalance is monotonic.
        let mut marks = Marks::new();
        for root in trig_roots(wave.derivative().0) {
            if root.state == NONE {
                continue;
            }
            let phi = math::atan2(root.sin, root.cos);
            let (value, bend) = (wave.at(phi), wave.derivative().derivative().at(phi));
            let touches = value.abs() <= noise;
            marks.insert(phi, if touches { 0.0 } else { value });
            // An extremum on the near side of zero may be what rounding has
            // left of a double root.
            if touches || value * bend >= 0.0 {
                let scale = bend.abs().max(1e-6 * wave.amplitude());
                let width = math::sqrt(2.0 * value.abs() / scale).clamp(1e-8, 1e-3);
                for offset in [0.0, -width, width] {
                    each(phi + offset);
                }
            }
        }
        // Marks between the extrema do no harm, and make up for one that was
        // not found.
        for i in 0..8 {
            let phi = f64::from(i) * FRAC_PI_4 - 3.0;
            let value = wave.at(phi);
            if value.abs() > noise {
                marks.insert(phi, value);
            }
        }
        marks.sign_changes(|from, to| each(wave.bracketed(from, to)));
    }
}

/// a₂ cos 2φ + b₂ sin 2φ + a₁ cos φ + b₁ sin φ + a₀, as for [`trig_roots`].
#[derive(Clone, Copy)]
struct Wave([f64; 5]);

impl Wave {
    fn at(&self, phi: f64) -> f64 {
        let (s, c) = math::sin_cos(phi);
        let [a2, b2, a1, b1, a0] = self.0;
        a2 * (c - s) * (c + s) + 2.0 * b2 * s * c + a1 * c + b1 * s + a0
    }

    fn derivative(&self) -> Wave {
        let [a2, b2, a1, b1, _] = self.0;
        Wave([2.0 * b2, -2.0 * a2, b1, -a1, 0.0])
    }

    fn amplitude(&self) -> f64 {
        self.0.iter().map(|x| x.abs()).sum()
    }

    /// The root between two angles of opposite sign: Newton, or bisection
    /// where Newton leaves the bracket or dawdles.
    fn bracketed(&self, (mut low, low_value): (f64, f64), (mut high, _): (f64, f64)) -> f64 {
        let slope = self.derivative();
        let mut phi = 0.5 * (low + high);
        let mut last = high - low;
        for _ in 0..80 {
            let value = self.at(phi);
            if value == 0.0 {
                return phi;
            }
            if (value > 0.0) == (low_value > 0.0) {
                low = phi;
            } else {
                high = phi;
            }
            let newton = phi - value / slope.at(phi);
            let inside = newton > low && newton < high && (newton - phi).abs() < 0.5 * last;
            let next = if inside { newton } else { 0.5 * (low + high) };
            last = (next - phi).abs();
            if last <= f64::EPSILON {
                return next;
            }
            phi = next;
        }
        phi
    }
}

/// Angles on a circle in ascending order, with values: at most four extrema
/// and eight others.
struct Marks {
    list: [(f64, f64); 12],
    count: usize,
}

impl Marks {
    fn new() -> Marks {
        Marks {
            list: [(0.0, 0.0); 12],
            count: 0,
        }
    }

    fn insert(&mut self, phi: f64, value: f64) {
        let mut i = self.count;
        while i > 0 && self.list[i - 1].0 > phi {
            self.list[i] = self.list[i - 1];
            i -= 1;
        }
        self.list[i] = (phi, value);
        self.count += 1;
    }

    fn sign_changes(&self, mut each: impl FnMut((f64, f64), (f64, f64))) {
        for i in 0..self.count {
            let from = self.list[i];
            let mut to = self.list[(i + 1) % self.count];
            if i + 1 == self.count {
                to.0 += TAU;
            }
            if from.1 * to.1 < 0.0 {
                each(from, to);
            }
        }
    }
}

fn pair(z: [f64; 4]) -> [f64; 2] {
    [math::atan2(z[1], z[0]), math::atan2(z[3], z[2])]
}

/// The same plane, with a row of unit length.
fn unit(plane: Plane) -> Plane {
    let scale = 1.0 / norm(plane.row);
    Plane {
        row: plane.row.map(|x| scale * x),
        level: scale * plane.level,
    }
}

/// The plane less as much of a unit plane as makes their rows orthogonal.
fn without(plane: Plane, base: &Plane) -> Plane {
    let share = dot(plane.row, base.row);
    Plane {
        row: core::array::from_fn(|i| plane.row[i] - share * base.row[i]),
        level: plane.level - share * base.level,
    }
}

/// A unit vector orthogonal to two or three orthonormal ones.
fn across(rows: &[[f64; 4]]) -> [f64; 4] {
    let lean = |i: usize| rows.iter().map(|row| row[i] * row[i]).sum::<f64>();
    let axis = (1..4).fold(0, |best, i| if lean(i) < lean(best) { i } else { best });
    let mut v = [0.0; 4];
    v[axis] = 1.0;
    for _ in 0..2 {
        for row in rows {
            let share = dot(v, *row);
            v = core::array::from_fn(|i| v[i] - share * row[i]);
        }
        let scale = 1.0 / norm(v);
        v = v.map(|x| scale * x);
    }
    v
}
