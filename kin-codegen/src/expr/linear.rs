//! Vectors, rotations and rigid motions whose entries are expressions.

use super::{Expr, Graph};
use kin_runtime::Pose;

/// Three expressions.
pub type Vector = [Expr; 3];

/// A rigid motion with symbolic entries; the rotation is row-major.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motion {
    /// `rotation[row][column]`.
    pub rotation: [Vector; 3],
    /// Metres.
    pub translation: Vector,
}

/// Sine and cosine of an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trig {
    /// Sine.
    pub sin: Expr,
    /// Cosine.
    pub cos: Expr,
}

impl Graph {
    /// A constant vector.
    pub fn vector(&mut self, v: [f64; 3]) -> Vector {
        v.map(|x| self.constant(x))
    }

    /// A constant rotation.
    pub fn rotation(&mut self, r: &[[f64; 3]; 3]) -> [Vector; 3] {
        r.map(|row| self.vector(row))
    }

    /// A constant motion.
    pub fn motion(&mut self, pose: &Pose) -> Motion {
        Motion {
            rotation: self.rotation(&pose.rotation),
            translation: self.vector(pose.translation),
        }
    }

    /// a · b.
    pub fn dot(&mut self, a: Vector, b: Vector) -> Expr {
        let products = [0, 1, 2].map(|i| self.mul(a[i], b[i]));
        self.sum(products)
    }

    fn sum(&mut self, terms: [Expr; 3]) -> Expr {
        let first = self.add(terms[0], terms[1]);
        self.add(first, terms[2])
    }

    /// a + b.
    pub fn plus(&mut self, a: Vector, b: Vector) -> Vector {
        [0, 1, 2].map(|i| self.add(a[i], b[i]))
    }

    /// a − b.
    pub fn minus(&mut self, a: Vector, b: Vector) -> Vector {
        [0, 1, 2].map(|i| self.sub(a[i], b[i]))
    }

    /// k a.
    pub fn scale(&mut self, k: Expr, a: Vector) -> Vector {
        a.map(|x| self.mul(k, x))
    }

    /// a × b.
    pub fn cross(&mut self, a: Vector, b: Vector) -> Vector {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            let p = self.mul(a[i], b[j]);
            let q = self.mul(a[j], b[i]);
            self.sub(p, q)
        })
    }

    /// R v.
    pub fn rotate(&mut self, r: &[Vector; 3], v: Vector) -> Vector {
        r.map(|row| self.dot(row, v))
    }

    /// Rᵀ v.
    pub fn rotate_back(&mut self, r: &[Vector; 3], v: Vector) -> Vector {
        let columns = transpose(r);
        self.rotate(&columns, v)
    }

    /// R S.
    pub fn product(&mut self, r: &[Vector; 3], s: &[Vector; 3]) -> [Vector; 3] {
        let columns = transpose(s).map(|column| self.rotate(r, column));
        transpose(&columns)
    }

    /// Rz(θ) v.
    pub fn turn(&mut self, t: Trig, v: Vector) -> Vector {
        let [cx, sx] = [self.mul(t.cos, v[0]), self.mul(t.sin, v[0])];
        let [cy, sy] = [self.mul(t.cos, v[1]), self.mul(t.sin, v[1])];
        [self.sub(cx, sy), self.add(sx, cy), v[2]]
    }

    /// The sine and cosine of −θ.
    pub fn reverse(&mut self, t: Trig) -> Trig {
        Trig {
            sin: self.neg(t.sin),
            cos: t.cos,
        }
    }

    /// The sine and cosine of a sum of angles.
    pub fn angle_sum(&mut self, a: Trig, b: Trig) -> Trig {
        let [cc, ss] = [self.mul(a.cos, b.cos), self.mul(a.sin, b.sin)];
        let [sc, cs] = [self.mul(a.sin, b.cos), self.mul(a.cos, b.sin)];
        Trig {
            sin: self.add(sc, cs),
            cos: self.sub(cc, ss),
        }
    }

    /// Rz(θ) as a matrix.
    pub fn rotation_z(&mut self, t: Trig) -> [Vector; 3] {
        let [o, l] = [self.zero(), self.one()];
        let minus = self.neg(t.sin);
        [[t.cos, minus, o], [t.sin, t.cos, o], [o, o, l]]
    }
}

/// Rᵀ.
pub fn transpose(r: &[Vector; 3]) -> [Vector; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| r[j][i]))
}
