//! Products and what they have in common.

use super::{Determinant, Factor, Rows};
use crate::expr::{Expr, Graph, Node};

/// a ± b, with what both are multiples of taken out.
pub(super) fn sum_factored(g: &mut Graph, a: Expr, b: Expr, minus: bool) -> Expr {
    let (mut left, mut right) = (Product::default(), Product::default());
    left.split(g, a);
    right.split(g, b);
    let mut common = Vec::new();
    left.parts.retain(|part| {
        let shared = right.parts.iter().position(|other| other == part);
        if let Some(i) = shared {
            common.push(right.parts.remove(i));
        }
        shared.is_none()
    });
    if common.is_empty() && !minus && is_unit_circle(g, a, b) {
        return g.one();
    }
    if common.is_empty() {
        return if minus { g.sub(a, b) } else { g.add(a, b) };
    }
    let (a, b) = (left.multiply(g), right.multiply(g));
    let inner = match minus {
        false if is_unit_circle(g, a, b) => g.one(),
        false => g.add(a, b),
        true => g.sub(a, b),
    };
    common
        .into_iter()
        .fold(inner, |product, part| g.mul(part, product))
}

/// sin² + cos² of one angle.
fn is_unit_circle(g: &Graph, a: Expr, b: Expr) -> bool {
    let root = |e: Expr| match g.node(e) {
        Node::Mul(x, y) if x == y => Some(g.node(x)),
        _ => None,
    };
    match (root(a), root(b)) {
        (Some(Node::Sin(x)), Some(Node::Cos(y))) | (Some(Node::Cos(x)), Some(Node::Sin(y))) => {
            x == y
        }
        _ => false,
    }
}

/// The amplitudes of sine and cosine, of length 1, the length that they had,
/// and the angle, of an expression that is their sum.
fn harmonic(g: &Graph, e: Expr) -> Option<([f64; 2], f64, Expr)> {
    const ROUNDING: f64 = 1e-14;
    let needed = g.reachable(&[e]);
    let mut nodes = g.nodes().iter().enumerate().filter(|(i, _)| needed[*i]);
    let angle = nodes.find_map(|(_, node)| match *node {
        Node::Sin(a) | Node::Cos(a) => Some(a),
        _ => None,
    })?;
    let of = |value: f64| value_at(g, e, angle, value);
    let quarter = std::f64::consts::FRAC_PI_2;
    let (at, opposite) = (of(0.0)?, of(2.0 * quarter)?);
    let (cosine, mean) = (0.5 * (at - opposite), 0.5 * (at + opposite));
    let sine = of(quarter)? - mean;
    let amplitude = sine.hypot(cosine);
    let fits = [0.7, -1.9, 2.8].into_iter().all(|x: f64| {
        let expected = sine * x.sin() + cosine * x.cos();
        of(x).is_some_and(|value| (value - expected).abs() < ROUNDING * 10.0 * amplitude)
    });
    let clean = |x: f64| {
        let x = x / amplitude;
        if x.abs() < ROUNDING {
            0.0
        } else if x.abs() > 1.0 - ROUNDING {
            x.signum()
        } else {
            x
        }
    };
    fits.then(|| ([clean(sine), clean(cosine)], amplitude, angle))
}

/// An expression of one angle, at a value of this angle. None if it depends on
/// anything else.
fn value_at(g: &Graph, e: Expr, angle: Expr, value: f64) -> Option<f64> {
    match g.node(e) {
        Node::Constant(bits) => Some(f64::from_bits(bits)),
        Node::Sin(a) if a == angle => Some(value.sin()),
        Node::Cos(a) if a == angle => Some(value.cos()),
        Node::Neg(a) => Some(-value_at(g, a, angle, value)?),
        Node::Add(a, b) => Some(value_at(g, a, angle, value)? + value_at(g, b, angle, value)?),
        Node::Sub(a, b) => Some(value_at(g, a, angle, value)? - value_at(g, b, angle, value)?),
        Node::Mul(a, b) => Some(value_at(g, a, angle, value)? * value_at(g, b, angle, value)?),
        _ => None,
    }
}

/// A product taken apart.
pub(super) struct Product {
    coefficient: f64,
    parts: Vec<Expr>,
    factors: Vec<Factor>,
}

impl Default for Product {
    fn default() -> Self {
        Self {
            coefficient: 1.0,
            parts: Vec::new(),
            factors: Vec::new(),
        }
    }
}

impl Product {
    /// Adds the factors of a node to the parts.
    fn split(&mut self, g: &Graph, e: Expr) {
        match g.node(e) {
            Node::Constant(bits) => self.coefficient *= f64::from_bits(bits),
            Node::Neg(a) => {
                self.coefficient = -self.coefficient;
                self.split(g, a);
            }
            Node::Mul(a, b) => {
                self.split(g, a);
                self.split(g, b);
            }
            _ => self.parts.push(e),
        }
    }

    fn multiply(self, g: &mut Graph) -> Expr {
        let coefficient = g.constant(self.coefficient);
        (self.parts.into_iter()).fold(coefficient, |product, part| g.mul(product, part))
    }

    /// Adds a block of a determinant.
    pub fn take(&mut self, g: &Graph, e: Expr, columns: &[usize], metres: usize) {
        let before = self.coefficient;
        self.split(g, e);
        // Which power of metres is in which part is known where there is only
        // one, and no constant that may have some.
        let whole = self.parts.len() == 1 && self.coefficient.abs() == before.abs();
        let metres = (metres < 2 || whole).then_some(metres);
        for part in self.parts.drain(..) {
            let known = (self.factors.iter_mut()).find(|factor| factor.expression == part);
            match known {
                Some(factor) => {
                    factor.power += 1;
                    factor.columns.extend(columns);
                    factor.columns.sort_unstable();
                    factor.columns.dedup();
                }
                None => self.factors.push(Factor {
                    expression: part,
                    power: 1,
                    columns: columns.to_vec(),
                    metres,
                }),
            }
        }
    }

    pub fn sign(&mut self, minus: bool) {
        if minus {
            self.coefficient = -self.coefficient;
        }
    }

    /// Writes a factor that is c₁ sin θ + c₂ cos θ for one angle θ in this way,
    /// with c₁² + c₂² = 1.
    fn simplify(&mut self, g: &mut Graph) {
        for factor in &mut self.factors {
            if matches!(g.node(factor.expression), Node::Sin(_) | Node::Cos(_)) {
                factor.metres = Some(0);
                continue;
            }
            let Some(([sine, cosine], amplitude, e)) = harmonic(g, factor.expression) else {
                continue;
            };
            let (sin, cos) = g.sin_cos(e);
            let [sine, cosine] = [sine, cosine].map(|x| g.constant(x));
            let (a, b) = (g.mul(sine, sin), g.mul(cosine, cos));
            factor.expression = g.add(a, b);
            factor.metres = Some(0);
            self.coefficient *= amplitude.powi(factor.power as i32);
            while let Node::Neg(plain) = g.node(factor.expression) {
                factor.expression = plain;
                if factor.power % 2 == 1 {
                    self.coefficient = -self.coefficient;
                }
            }
        }
    }

    pub fn finish(mut self, g: &mut Graph, rows: Rows) -> Determinant {
        self.simplify(g);
        let coefficient = g.constant(self.coefficient);
        let product = (self.factors.iter())
            .flat_map(|factor| std::iter::repeat_n(factor.expression, factor.power))
            .fold(coefficient, |product, factor| g.mul(product, factor));
        Determinant {
            coefficient: self.coefficient,
            factors: self.factors,
            product,
            rows,
        }
    }
}
