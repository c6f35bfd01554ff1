//! A line in space as a vector of fifteen numbers on which rigid motions act
//! linearly.
//!
//! For a line through p along l these are l, p, m = p × l,
//! n = l (p·p) − 2 p (p·l), p·p, p·l and 1: what is left of the fourteen
//! equations of M. Raghavan and B. Roth, "Inverse kinematics of the general 6R
//! manipulator and related linkages", J. Mechanical Design 115, 1993, when no
//! joint is chosen yet.

use crate::Pose;

/// Entries of a line.
pub const ENTRIES: usize = 15;

/// Where p·p, p·l and 1 stand behind the four vectors.
const POINT_POINT: usize = 12;
const POINT_LINE: usize = 13;
const ONE: usize = 14;

/// Combinations of lines as array lanes.
pub type Lines<const L: usize> = [[f64; L]; ENTRIES];

/// The z axis.
pub const Z_AXIS: [f64; ENTRIES] = {
    let mut line = [0.0; ENTRIES];
    line[2] = 1.0;
    line[ONE] = 1.0;
    line
};

/// The lines after a rigid motion.
#[inline(always)]
pub fn moved<const L: usize>(pose: &Pose, lines: &Lines<L>) -> Lines<L> {
    let ([r0, r1, r2], t) = (&pose.rotation, &pose.translation);
    let mut out = [[0.0; L]; ENTRIES];
    for v in [0, 3, 6, 9] {
        for (i, r) in [r0, r1, r2].into_iter().enumerate() {
            for k in 0..L {
                out[v + i][k] =
                    r[0] * lines[v][k] + r[1] * lines[v + 1][k] + r[2] * lines[v + 2][k];
            }
        }
    }
    let square = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
    for k in 0..L {
        let at = |v: usize| [out[v][k], out[v + 1][k], out[v + 2][k]];
        let (l, p, m) = (at(0), at(3), at(6));
        let (point_point, point_line, one) =
            (lines[POINT_POINT][k], lines[POINT_LINE][k], lines[ONE][k]);
        let dot = |a: [f64; 3]| t[0] * a[0] + t[1] * a[1] + t[2] * a[2];
        let (along_line, along_point) = (dot(l), dot(p));
        let cross = |a: [f64; 3], i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            t[j] * a[k] - t[k] * a[j]
        };
        for i in 0..3 {
            out[3 + i][k] += t[i] * one;
            out[6 + i][k] += cross(l, i);
            out[9 + i][k] += square * l[i] - 2.0 * (cross(m, i) + t[i] * (point_line + along_line));
        }
        out[POINT_POINT][k] = point_point + 2.0 * along_point + square * one;
        out[POINT_LINE][k] = point_line + along_line;
        out[ONE][k] = one;
    }
    out
}

/// What a joint that goes back makes of the lines: of a turn see `turned_back`, of a slide
/// `slid_back`.
#[inline(always)]
pub fn gone_back<const A: usize, const B: usize>(slides: bool, lines: &Lines<A>) -> Lines<B> {
    match slides {
        true => slid_back(lines),
        false => turned_back(lines),
    }
}

/// What a slide by −d along z makes of the lines, as the coefficients of 1, d and d²: lane k
/// of `A` becomes the lanes k, k + A and k + 2A.
fn slid_back<const A: usize, const B: usize>(lines: &Lines<A>) -> Lines<B> {
    const { assert!(B == 3 * A) };
    let mut out = [[0.0; B]; ENTRIES];
    for (out, line) in out.iter_mut().zip(lines) {
        out[..A].copy_from_slice(line);
    }
    for k in 0..A {
        let (linear, square) = (k + A, k + 2 * A);
        let at = |v: usize| [lines[v][k], lines[v + 1][k], lines[v + 2][k]];
        let (l, p, m) = (at(0), at(3), at(6));
        let one = lines[ONE][k];
        out[5][linear] = -one;
        (out[6][linear], out[7][linear]) = (l[1], -l[0]);
        (out[9][linear], out[10][linear]) = (-2.0 * m[1], 2.0 * m[0]);
        out[11][linear] = 2.0 * lines[POINT_LINE][k];
        out[POINT_POINT][linear] = -2.0 * p[2];
        out[POINT_LINE][linear] = -l[2];
        (out[9][square], out[10][square], out[11][square]) = (l[0], l[1], -l[2]);
        out[POINT_POINT][square] = one;
    }
    out
}

/// What a turn by −θ about z makes of the lines, as the coefficients of 1, cos θ
/// and sin θ: lane k of `A` becomes the lanes k, k + A and k + 2A.
#[inline(always)]
fn turned_back<const A: usize, const B: usize>(lines: &Lines<A>) -> Lines<B> {
    const { assert!(B == 3 * A) };
    let mut out = [[0.0; B]; ENTRIES];
    for v in [0, 3, 6, 9] {
        for k in 0..A {
            let (x, y) = (lines[v][k], lines[v + 1][k]);
            (out[v][k + A], out[v + 1][k + A]) = (x, y);
            (out[v][k + 2 * A], out[v + 1][k + 2 * A]) = (y, -x);
            out[v + 2][k] = lines[v + 2][k];
        }
    }
    for i in [POINT_POINT, POINT_LINE, ONE] {
        out[i][..A].copy_from_slice(&lines[i]);
    }
    out
}
