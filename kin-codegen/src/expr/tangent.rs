//! Derivatives of expressions along a direction of the inputs.
//!
//! Forward differentiation (A. Griewank and A. Walther, *Evaluating Derivatives*, 2008,
//! chapter 3): every expression's derivative is written next to it, once.

use super::hash::NodeMap;
use super::{Expr, Graph, Node};

/// What expressions change by along one direction.
#[derive(Clone, Debug, Default)]
pub struct Tangent {
    known: NodeMap<Expr, Expr>,
}

impl Tangent {
    /// The direction in which these expressions, usually inputs, change by those; other inputs
    /// do not change.
    pub fn new(changes: impl IntoIterator<Item = (Expr, Expr)>) -> Self {
        Self {
            known: changes.into_iter().collect(),
        }
    }

    /// From here on an expression changes as another one does.
    pub fn follow(&mut self, g: &mut Graph, e: Expr, as_of: Expr) {
        let change = self.of(g, as_of);
        self.known.insert(e, change);
    }

    /// From here on an angle, by its sine and cosine, changes by so much, radians.
    pub fn turn(&mut self, g: &mut Graph, [sin, cos]: [Expr; 2], by: Expr) {
        let less = g.mul(sin, by);
        let changes = [(sin, g.mul(cos, by)), (cos, g.neg(less))];
        self.known.extend(changes);
    }

    /// By what an expression changes.
    ///
    /// Of a maximum or a selection it is the change of what was taken; roots of quartics are
    /// taken for constants.
    pub fn of(&mut self, g: &mut Graph, e: Expr) -> Expr {
        if let Some(&change) = self.known.get(&e) {
            return change;
        }
        let needed = g.reachable(&[e]);
        for i in (0..=e.index()).filter(|&i| needed[i]) {
            let here = g.at(i);
            if !self.known.contains_key(&here) {
                let change = self.rule(g, here);
                self.known.insert(here, change);
            }
        }
        self.known[&e]
    }

    /// The change of an expression by those of its operands.
    fn rule(&self, g: &mut Graph, e: Expr) -> Expr {
        let zero = g.zero();
        let node = g.node(e);
        let change = |x: Expr| self.known[&x];
        if node.operands().all(|x| g.is(change(x), 0.0)) {
            return zero;
        }
        match node {
            Node::Constant(_) | Node::Input(_) | Node::Sign(_) | Node::TrigRoot(..) => zero,
            Node::Add(a, b) => g.add(change(a), change(b)),
            Node::Sub(a, b) => g.sub(change(a), change(b)),
            Node::Neg(a) => g.neg(change(a)),
            Node::Mul(a, b) => {
                let [ab, ba] = [g.mul(a, change(b)), g.mul(b, change(a))];
                g.add(ab, ba)
            }
            Node::Div(a, b) => {
                let one = g.one();
                let inverse = g.div(one, b);
                let along = g.mul(e, change(b));
                let more = g.sub(change(a), along);
                g.mul(more, inverse)
            }
            Node::Sqrt(a) => {
                let half = g.constant(0.5);
                let halved = g.mul(half, change(a));
                let one = g.one();
                let rate = g.div(one, e);
                g.mul(rate, halved)
            }
            Node::Sin(a) => {
                let (_, cos) = g.sin_cos(a);
                g.mul(cos, change(a))
            }
            Node::Cos(a) => {
                let (sin, _) = g.sin_cos(a);
                let less = g.mul(sin, change(a));
                g.neg(less)
            }
            Node::Atan2(y, x) => {
                let [xy, yx] = [g.mul(x, change(y)), g.mul(y, change(x))];
                let [xx, yy] = [x, y].map(|v| g.square(v));
                let [turn, square] = [g.sub(xy, yx), g.add(xx, yy)];
                g.div(turn, square)
            }
            Node::Wrap(a) => change(a),
            Node::Max(a, b) => g.select_less(a, b, change(b), change(a)),
            Node::Select([a, b, x, y]) => g.select_less(a, b, change(x), change(y)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Lane;

    /// Every operation against differences of the interpreter.
    #[test]
    fn changes_are_differences() {
        let mut g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.input(name));
        let (sin, cos) = g.sin_cos(x);
        let product = g.mul(sin, y);
        let square = g.square(cos);
        let positive = g.add(square, y);
        let root = g.sqrt(positive);
        let quotient = g.div(product, root);
        let rest = g.square(quotient);
        let rest = g.add(rest, square);
        let length = g.sqrt(rest);
        let unit = [quotient, cos].map(|component| g.div(component, length));
        let angle = g.atan2(unit[0], unit[1]);
        let sign = g.sign();
        let turned = g.mul(sign, angle);
        let difference = g.sub(turned, product);
        let larger = g.max(difference, quotient);
        let selected = g.select_less(x, y, larger, root);
        let minus = g.neg(selected);
        let e = g.add(minus, turned);
        let [a, b] = [0.6, -0.8].map(|k| g.constant(k));
        let mut tangent = Tangent::new([(x, a), (y, b)]);
        let change = tangent.of(&mut g, e);
        let mut values = Vec::new();
        let mut at = |e: Expr, t: f64, lane: Lane, [x, y]: [f64; 2]| {
            g.evaluate(&[x + 0.6 * t, y - 0.8 * t], lane, &mut values);
            values[e.index()]
        };
        for place in [[0.3, 0.9], [1.2, 0.4], [-0.7, 2.0], [2.5, 1.1]] {
            for lane in [0, 1] {
                let h = 1e-6;
                let slope = (at(e, h, lane, place) - at(e, -h, lane, place)) / (2.0 * h);
                let change = at(change, 0.0, lane, place);
                assert!((slope - change).abs() < 1e-8, "{slope} {change}");
            }
        }
    }

    #[test]
    fn a_sine_and_a_cosine_change_as_their_angle_does() {
        let mut g = Graph::new();
        let [x, by] = ["x", "by"].map(|name| g.input(name));
        let (sin, cos) = g.sin_cos(x);
        let product = g.mul(sin, cos);
        let mut by_rule = Tangent::new([(x, by)]);
        let mut by_turn = Tangent::new([]);
        by_turn.turn(&mut g, [sin, cos], by);
        for e in [sin, cos, product] {
            assert_eq!(by_turn.of(&mut g, e), by_rule.of(&mut g, e));
        }
    }

    /// What moves the tip about the last axis alone changes nothing before it.
    #[test]
    fn what_does_not_change_costs_nothing() {
        let mut g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.input(name));
        let [zero, one] = [g.zero(), g.one()];
        let e = g.square(x);
        let mut tangent = Tangent::new([(x, zero), (y, one)]);
        let change = tangent.of(&mut g, e);
        assert!(g.is(change, 0.0));
    }
}
