//! Signs of roots moved outwards, so that what both signs share is computed once.
//!
//! An expression is even in a choice where both signs give one value, and odd where they
//! give opposite ones. Products and quotients of such are even or odd, sums of two that
//! are odd in the same choices are so, and nothing is rounded otherwise when the sign is
//! multiplied behind them. So a wrist that is flipped needs no second forward kinematics
//! and no second arctangent: its rotation is the same, and its angles are another's turned by π
//! or negated.

use super::InverseGraph;
use crate::expr::{Choice, Expr, Graph, Node};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// The first choices share a loop over their branches: there is nothing to be moved out of.
const LOOPED_TOGETHER: u8 = 2;

/// The product of the signs of some choices, bit by bit, and of an expression.
#[derive(Clone, Copy)]
struct Signed {
    signs: u32,
    of: Expr,
}

/// The same expressions with the signs as far outwards as they go.
pub(super) fn signs_outwards(inverse: &InverseGraph) -> InverseGraph {
    let arguments = inverse.arguments.iter().flatten().map(|(_, e)| *e);
    let mut results = inverse.outputs();
    results.extend(inverse.margin.into_iter().chain(arguments));
    let from = &inverse.graph;
    let needed = from.reachable(&results);
    let mut moved = Moved {
        from,
        g: Graph::new(),
        values: Vec::with_capacity(from.nodes().len()),
        whole: BTreeMap::new(),
        refused: refused(from, inverse.invalid),
    };
    // How many nodes there are in front of each of `from`.
    let mut places = Vec::with_capacity(from.nodes().len() + 1);
    for i in 0..from.nodes().len() {
        places.push(moved.g.nodes().len());
        let always = matches!(from.nodes()[i], Node::Input(_) | Node::Sign(_));
        let value = (needed[i] || always).then(|| moved.value(from.at(i)));
        moved.values.push(value);
        if value.is_some_and(|value| value.signs == 0) {
            moved.whole(from.at(i));
        }
    }
    places.push(moved.g.nodes().len());
    moved.results(inverse, &places)
}

/// What the − of a choice is refused for: where the first is below the second.
fn refused(g: &Graph, invalid: Expr) -> Vec<([Expr; 2], Choice)> {
    match g.node(invalid) {
        Node::Max(a, b) => {
            let mut all = refused(g, a);
            all.extend(refused(g, b));
            all
        }
        Node::Select([a, b, x, y]) if g.is(y, 0.0) => match g.negated(x).map(|x| g.node(x)) {
            Some(Node::Sign(choice)) => vec![([a, b], choice)],
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}

struct Moved<'a> {
    from: &'a Graph,
    g: Graph,
    /// By node of `from`.
    values: Vec<Option<Signed>>,
    /// Those of them that were asked for with their signs.
    whole: BTreeMap<Expr, Expr>,
    refused: Vec<([Expr; 2], Choice)>,
}

impl Moved<'_> {
    fn known(&self, e: Expr) -> Signed {
        self.values[e.index()].expect("operands come before what uses them")
    }

    /// A value of `from` with its signs, under its name.
    fn whole(&mut self, e: Expr) -> Expr {
        if let Some(&whole) = self.whole.get(&e) {
            return whole;
        }
        let Signed { signs, of } = self.known(e);
        let whole = self.times(signs, of);
        if let Some(name) = self.from.name(e) {
            self.g.named(whole, name);
        }
        self.whole.insert(e, whole);
        whole
    }

    fn times(&mut self, signs: u32, e: Expr) -> Expr {
        let choices = (0..self.from.choices()).filter(|choice| signs >> choice & 1 == 1);
        choices.fold(e, |e, choice| {
            let sign = self.g.intern(Node::Sign(Choice(choice)));
            self.g.mul(sign, e)
        })
    }

    /// The value of a node, of those of its operands.
    fn value(&mut self, e: Expr) -> Signed {
        let node = self.from.node(e);
        let even = |of| Signed { signs: 0, of };
        match node {
            Node::Input(_) => even(self.g.input(self.from.name(e).unwrap_or_default())),
            Node::Sign(choice) if choice.0 < LOOPED_TOGETHER => even(self.g.sign()),
            Node::Sign(choice) => {
                self.g.sign();
                let signs = 1 << choice.0;
                let of = self.g.one();
                Signed { signs, of }
            }
            Node::Neg(a) => {
                let Signed { signs, of } = self.known(a);
                let of = self.g.neg(of);
                Signed { signs, of }
            }
            Node::Mul(a, b) | Node::Div(a, b) => {
                let (a, b) = (self.known(a), self.known(b));
                let signs = a.signs ^ b.signs;
                let of = match node {
                    Node::Mul(..) => self.g.mul(a.of, b.of),
                    _ => self.g.div(a.of, b.of),
                };
                Signed { signs, of }
            }
            Node::Add(a, b) | Node::Sub(a, b) => self.sum(node, a, b),
            Node::Select(operands) => self.selected(operands),
            Node::Atan2(y, x) => even(self.angle(y, x)),
            _ => {
                let operands = node
                    .operand_slots()
                    .map(|e| match self.values.get(e.index()) {
                        Some(Some(_)) => self.whole(e),
                        _ => e,
                    });
                even(self.g.rebuild(node, operands))
            }
        }
    }

    fn sum(&mut self, node: Node, a: Expr, b: Expr) -> Signed {
        let (first, second) = (self.known(a), self.known(b));
        let both = first.signs & second.signs;
        let terms = if both == 0 {
            [self.whole(a), self.whole(b)]
        } else {
            [first, second].map(|term| self.times(term.signs & !both, term.of))
        };
        let of = match node {
            Node::Add(..) => self.g.add(terms[0], terms[1]),
            _ => self.g.sub(terms[0], terms[1]),
        };
        Signed { signs: both, of }
    }

    /// Where the one value is chosen, the − of some choices may be refused, so that its sign
    /// there is any.
    fn selected(&mut self, [a, b, x, y]: [Expr; 4]) -> Signed {
        let (chosen, other) = (self.known(x), self.known(y));
        let mut signs = other.signs;
        if self.g.is(other.of, 0.0) {
            signs = chosen.signs;
        }
        let free = self.refused.iter().filter(|(why, _)| *why == [a, b]);
        let free = free.fold(0, |free, (_, choice)| free | 1 << choice.0);
        let same = (chosen.signs ^ signs) & !free == 0 || self.g.is(chosen.of, 0.0);
        let [x, y] = match same {
            true => [chosen.of, other.of],
            false => {
                signs = 0;
                [self.whole(x), self.whole(y)]
            }
        };
        let [a, b] = [a, b].map(|e| self.whole(e));
        let of = self.g.select_less(a, b, x, y);
        Signed { signs, of }
    }

    /// The angle of a vector whose components may be odd: of an odd sine the angle is negated, of
    /// an odd cosine it is what is left of π, and where both are odd it is turned by π.
    fn angle(&mut self, y: Expr, x: Expr) -> Expr {
        let (sine, cosine) = (self.known(y), self.known(x));
        let levels = self.g.levels();
        let level = [sine, cosine].map(|component| levels[component.of.index()]);
        let least = level[0].max(level[1]);
        let outer = (sine.signs | cosine.signs) >> least << least;
        if outer == 0 {
            let [y, x] = [y, x].map(|e| self.whole(e));
            return self.g.atan2(y, x);
        }
        let [y, x] = [sine, cosine].map(|e| self.times(e.signs & !outer, e.of));
        let angle = self.g.atan2(y, x);
        let [sine, cosine] = [sine, cosine].map(|component| component.signs & outer);
        let flipped = self.flipped(cosine, angle);
        let angle = self.times(sine, flipped);
        self.above_minus_pi(angle)
    }

    /// The angle of (±x, y), ± being a product of signs.
    fn flipped(&mut self, signs: u32, angle: Expr) -> Expr {
        if signs == 0 {
            return angle;
        }
        let [zero, one, pi, minus_pi] = [0.0, 1.0, PI, -PI].map(|x| self.g.constant(x));
        let half = self.g.select_less(angle, zero, minus_pi, pi);
        let rest = self.g.sub(half, angle);
        let sign = self.times(signs, one);
        self.g.select_less(sign, zero, rest, angle)
    }

    /// An angle in [−π, π], the one end for the other.
    fn above_minus_pi(&mut self, angle: Expr) -> Expr {
        let [turn, minus_pi] = [2.0 * PI, -PI].map(|x| self.g.constant(x));
        let turned = self.g.add(angle, turn);
        self.g.select_less(minus_pi, angle, angle, turned)
    }

    fn results(mut self, of: &InverseGraph, places: &[usize]) -> InverseGraph {
        let mut moved = of.clone();
        moved.q = of.q.iter().map(|&e| self.whole(e)).collect();
        for e in [&mut moved.residual, &mut moved.invalid, &mut moved.singular] {
            *e = self.whole(*e);
        }
        for e in moved.margin.iter_mut() {
            *e = self.whole(*e);
        }
        for (_, e) in moved.arguments.iter_mut().flatten() {
            *e = self.whole(*e);
        }
        for free in &mut moved.free_joints {
            free.level = self.whole(free.level);
            free.no_root = self.whole(free.no_root);
        }
        for step in &mut moved.parts.steps {
            step.begins = places[step.begins];
        }
        moved.parts.residual = places[of.parts.residual];
        moved.parts.angles = places[of.parts.angles];
        moved.graph = self.g;
        moved
    }
}

#[cfg(test)]
mod tests;
