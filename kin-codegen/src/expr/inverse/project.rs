//! Targets of which only a part is read, made whole by what the arm does with
//! the rest: an arm whose axes are all parallel turns its tip about them and
//! no other way.

use crate::expr::linear::{Motion, Trig, Vector};
use crate::expr::{Expr, Graph};
use crate::geometry::{Linkage, Vec3, cross, dot};
use crate::plan::Target;
use kin_runtime::__private::Projection;

/// A slide across an axis goes along it by no more.
const ACROSS: f64 = 1e-12;

/// The whole pose that a target stands for. Of a projected target the turn
/// about the first axis is kept, the one that brings the home orientation
/// nearest to the target's, and for a planar arm the height is that of home.
pub(super) fn projected(g: &mut Graph, linkage: &Linkage, target: Target, given: Motion) -> Motion {
    if linkage.has_free_turn {
        let z = [0, 1, 2].map(|i| given.rotation[i][2]);
        return Motion {
            rotation: around(g, z),
            ..given
        };
    }
    if !target.is_projected() {
        return given;
    }
    let Projection { axis, home, .. } = linkage.projection(target);
    let rotation = turned_home(g, &given.rotation, axis, &home.rotation);
    let translation = match target {
        Target::Planar => {
            let n = g.vector(axis);
            let height = g.dot(n, given.translation);
            let wanted = g.constant(dot(axis, home.translation));
            let rise = g.sub(wanted, height);
            let lift = g.scale(rise, n);
            g.plus(given.translation, lift)
        }
        _ => given.translation,
    };
    Motion {
        rotation,
        translation,
    }
}

/// The pose that a planar target stands for, with a slide given, which may lift the tip along the
/// axis.
pub(super) fn lifted(
    g: &mut Graph,
    linkage: &Linkage,
    pose: Motion,
    slide: usize,
    value: Expr,
) -> Motion {
    let axis = linkage.projection(Target::Planar).axis;
    let link = &linkage.links[slide];
    let along = link.gain * dot(axis, link.before_home.rotate(link.direction));
    if along.abs() < ACROSS {
        return pose;
    }
    let factor = g.constant(along);
    let height = g.mul(factor, value);
    let n = g.vector(axis);
    let lift = g.scale(height, n);
    Motion {
        translation: g.plus(pose.translation, lift),
        ..pose
    }
}

/// Some rotation with a given third column; the turn about it is arbitrary
/// (Duff et al., "Building an orthonormal basis, revisited", JCGT 6, 2017).
fn around(g: &mut Graph, z: Vector) -> [Vector; 3] {
    let [zero, one] = [g.zero(), g.one()];
    let minus = g.constant(-1.0);
    let sign = g.select_less(z[2], zero, minus, one);
    let sum = g.add(sign, z[2]);
    let a = g.div(minus, sum);
    let xa = g.mul(z[0], a);
    let ya = g.mul(z[1], a);
    let b = g.mul(z[1], xa);
    let xxa = g.mul(z[0], xa);
    let yya = g.mul(z[1], ya);
    let signed = [xxa, b, z[0]].map(|e| g.mul(sign, e));
    let first = g.add(one, signed[0]);
    let third = g.neg(signed[2]);
    let second = g.add(sign, yya);
    let last = g.neg(z[1]);
    [
        [first, b, z[0]],
        [signed[1], second, z[1]],
        [third, last, z[2]],
    ]
}

/// Rot(n, ψ) R₀ with the ψ that brings it nearest to R: with M = R R₀ᵀ,
/// cos ψ ~ tr M − nᵀ M n and sin ψ ~ n · (axial vector of M).
fn turned_home(g: &mut Graph, r: &[Vector; 3], n: Vec3, home: &[[f64; 3]; 3]) -> [Vector; 3] {
    let back = [0, 1, 2].map(|i| [0, 1, 2].map(|j| home[j][i]));
    let back = g.rotation(&back);
    let m = g.product(r, &back);
    let mut cos = g.zero();
    let mut sin = g.zero();
    for i in 0..3 {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let skew = g.sub(m[b][a], m[a][b]);
        let part = g.constant(n[i]);
        let part = g.mul(part, skew);
        sin = g.add(sin, part);
        for j in 0..3 {
            let weight = f64::from(i == j) - n[i] * n[j];
            let weight = g.constant(if weight.abs() < 1e-15 { 0.0 } else { weight });
            let part = g.mul(weight, m[i][j]);
            cos = g.add(cos, part);
        }
    }
    let squares = [sin, cos].map(|x| g.square(x));
    let length = g.add(squares[0], squares[1]);
    let length = g.sqrt(length);
    let turn = Trig {
        sin: g.div(sin, length),
        cos: g.div(cos, length),
    };
    rotated_home(g, turn, n, home)
}

/// Column by column, c v + s (n × v) + (1 − c) n (n · v).
fn rotated_home(g: &mut Graph, t: Trig, n: Vec3, home: &[[f64; 3]; 3]) -> [Vector; 3] {
    let columns = [0, 1, 2].map(|j| {
        let v = [0, 1, 2].map(|i| home[i][j]);
        let (side, height) = (cross(n, v), dot(n, v));
        [0, 1, 2].map(|i| {
            let flat = v[i] - n[i] * height;
            let [flat, side, rest] = [flat, side[i], n[i] * height]
                .map(|x| g.constant(if x.abs() < 1e-15 { 0.0 } else { x }));
            let [c, s] = [g.mul(t.cos, flat), g.mul(t.sin, side)];
            let turning = g.add(c, s);
            g.add(turning, rest)
        })
    });
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i]))
}
