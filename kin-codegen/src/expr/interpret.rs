//! The interpreter: what the emitted code will compute, one branch at a time.

use super::{Expr, Graph, Node, RootField};
use kin_runtime::__private::quartic::{TrigRoot, trig_roots};
use kin_runtime::__private::{lanes, math};

/// One combination of signs: bit i set means that choice i is −1.
pub type Lane = u32;

impl Graph {
    /// Evaluates every node for one branch with the functions that generated
    /// code uses. `values` is resized and filled, indexed by [`Expr::index`].
    pub fn evaluate(&self, inputs: &[f64], lane: Lane, values: &mut Vec<f64>) {
        values.clear();
        values.reserve(self.nodes().len());
        // The numbers of a quartic's roots stand together; it is solved once.
        let mut quartic: Option<([Expr; 5], [TrigRoot; 4])> = None;
        for node in self.nodes() {
            let of = |e: &Expr| values[e.index()];
            let value = match node {
                Node::Constant(bits) => f64::from_bits(*bits),
                Node::Input(i) => inputs[usize::from(*i)],
                Node::Sign(choice) => 1.0 - 2.0 * f64::from((lane >> choice.0) & 1),
                Node::Add(a, b) => of(a) + of(b),
                Node::Sub(a, b) => of(a) - of(b),
                Node::Mul(a, b) => of(a) * of(b),
                Node::Div(a, b) => of(a) / of(b),
                Node::Neg(a) => -of(a),
                Node::Sqrt(a) => of(a).sqrt(),
                Node::Sin(a) => math::sin_cos(of(a)).0,
                Node::Cos(a) => math::sin_cos(of(a)).1,
                Node::Atan2(y, x) => lanes::angle(of(y), of(x)),
                Node::Wrap(a) => math::wrap(of(a)),
                Node::Max(a, b) => math::max(of(a), of(b)),
                Node::TrigRoot(coefficients, part) => {
                    let roots = match quartic {
                        Some((solved, roots)) if solved == *coefficients => roots,
                        _ => trig_roots(coefficients.map(|e| of(&e))),
                    };
                    quartic = Some((*coefficients, roots));
                    let root = roots[usize::from(part.place)];
                    match part.field {
                        RootField::Sin => root.sin,
                        RootField::Cos => root.cos,
                        RootField::State => root.state,
                    }
                }
                Node::Select([a, b, x, y]) => {
                    if of(a) < of(b) {
                        of(x)
                    } else {
                        of(y)
                    }
                }
            };
            values.push(value);
        }
    }
}
