//! Expressions: a hash-consed DAG of scalar operations.
//!
//! Forward kinematics, Jacobians and every inverse plan are built here before
//! any code is written. Constructors simplify as they go (constants
//! fold, exact 0 and ±1 vanish, signs move outwards), and equal expressions
//! are one node, so what is counted is what is emitted.
//!
//! A [`Choice`] is the ± of a square root. An expression that depends on
//! choices stands for all its branches at once: the emitter lays them out as
//! array lanes, the [interpreter](Graph::evaluate) takes one combination of
//! signs at a time.

mod axes;
mod count;
pub mod determinant;
pub mod forward;
mod fused;
mod hash;
mod interpret;
pub mod inverse;
pub mod jacobian;
pub mod linear;
mod tangent;
mod tape;

pub use count::Operations;
pub(crate) use hash::Multiplicative;
use hash::NodeMap;
pub use interpret::Lane;
pub use tangent::Tangent;
pub use tape::{Fusing, Lanes, Tape};

/// A node of a [`Graph`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Expr(u32);

impl Expr {
    /// Position in the graph: operands come before what uses them.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// The ± of a square root, numbered in the order of the plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Choice(pub u8);

/// One operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A finite constant, by its bits.
    Constant(u64),
    /// The n-th input of the function.
    Input(u16),
    /// +1 or −1, by branch.
    Sign(Choice),
    /// a + b.
    Add(Expr, Expr),
    /// a − b.
    Sub(Expr, Expr),
    /// a b.
    Mul(Expr, Expr),
    /// a / b.
    Div(Expr, Expr),
    /// −a.
    Neg(Expr),
    /// √a.
    Sqrt(Expr),
    /// sin a.
    Sin(Expr),
    /// cos a.
    Cos(Expr),
    /// The angle of the unit vector (x, y) in (−π, π]: `Atan2(y, x)`.
    Atan2(Expr, Expr),
    /// a modulo 2π, into (−π, π].
    Wrap(Expr),
    /// The larger of two; the second where either is NaN.
    Max(Expr, Expr),
    /// `[a, b, x, y]`: x where a < b, else y (also where a or b is NaN).
    Select([Expr; 4]),
    /// One number of one root of the trigonometric quartic with these
    /// coefficients; see [`kin_runtime::__private::quartic::trig_roots`].
    TrigRoot([Expr; 5], RootPart),
}

/// A number that describes a root of a trigonometric quartic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct RootPart {
    /// Which of the four places.
    pub place: u8,
    /// What of the root.
    pub field: RootField,
}

/// The fields of a [`kin_runtime::__private::quartic::TrigRoot`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RootField {
    /// sin θ.
    Sin,
    /// cos θ.
    Cos,
    /// Simple, none or double.
    State,
}

impl Node {
    /// What the operation reads.
    pub fn operands(&self) -> impl Iterator<Item = Expr> + use<> {
        let count = match self {
            Node::Constant(_) | Node::Input(_) | Node::Sign(_) => 0,
            Node::Neg(_) | Node::Sqrt(_) | Node::Sin(_) | Node::Cos(_) | Node::Wrap(_) => 1,
            Node::Add(..)
            | Node::Sub(..)
            | Node::Mul(..)
            | Node::Div(..)
            | Node::Atan2(..)
            | Node::Max(..) => 2,
            Node::Select(_) => 4,
            Node::TrigRoot(..) => 5,
        };
        self.operand_slots().into_iter().take(count)
    }

    /// The operands, the slots that the operation does not use filled up.
    fn operand_slots(&self) -> [Expr; 5] {
        match *self {
            Node::Constant(_) | Node::Input(_) | Node::Sign(_) => [Expr(0); 5],
            Node::Neg(a) | Node::Sqrt(a) | Node::Sin(a) | Node::Cos(a) | Node::Wrap(a) => [a; 5],
            Node::Add(a, b)
            | Node::Sub(a, b)
            | Node::Mul(a, b)
            | Node::Div(a, b)
            | Node::Atan2(a, b)
            | Node::Max(a, b) => [a, b, a, b, a],
            Node::Select([a, b, x, y]) => [a, b, x, y, a],
            Node::TrigRoot(coefficients, _) => coefficients,
        }
    }
}

/// The DAG.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    index: NodeMap<Node, Expr>,
    names: NodeMap<Expr, String>,
    /// The nodes that have names, in the order in which they got them.
    named: Vec<Expr>,
    inputs: u16,
    choices: u8,
}

/// What a graph holds at some time.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    nodes: usize,
    named: usize,
    inputs: u16,
    choices: u8,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// All nodes, operands first.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The node at a position.
    pub fn at(&self, index: usize) -> Expr {
        debug_assert!(index < self.nodes.len());
        Expr(index as u32)
    }

    /// The node of an operation, if the graph has it.
    pub fn find(&self, node: Node) -> Option<Expr> {
        self.index.get(&node).copied()
    }

    /// The operation behind a node.
    pub fn node(&self, e: Expr) -> Node {
        self.nodes[e.index()]
    }

    /// The symbol that the emitted code should use for a node, if it has one.
    pub fn name(&self, e: Expr) -> Option<&str> {
        self.names.get(&e).map(String::as_str)
    }

    /// Gives a node its symbol. The first name stays; constants and inputs
    /// keep their own. Returns the node, to be used in passing.
    pub fn named(&mut self, e: Expr, name: impl Into<String>) -> Expr {
        let plain = matches!(self.node(e), Node::Constant(_) | Node::Input(_));
        if !plain && !self.names.contains_key(&e) {
            self.names.insert(e, name.into());
            self.named.push(e);
        }
        e
    }

    /// The next input of the function, under its name.
    pub fn input(&mut self, name: impl Into<String>) -> Expr {
        let e = self.intern(Node::Input(self.inputs));
        self.inputs += 1;
        self.names.insert(e, name.into());
        self.named.push(e);
        e
    }

    /// What the graph holds now, to go [back](Self::back) to.
    pub fn mark(&self) -> Mark {
        Mark {
            nodes: self.nodes.len(),
            named: self.named.len(),
            inputs: self.inputs,
            choices: self.choices,
        }
    }

    /// Forgets what has come since a mark.
    pub fn back(&mut self, mark: Mark) {
        for e in self.named.drain(mark.named..) {
            self.names.remove(&e);
        }
        for node in self.nodes.drain(mark.nodes..) {
            self.index.remove(&node);
        }
        (self.inputs, self.choices) = (mark.inputs, mark.choices);
    }

    /// How many inputs there are.
    pub fn inputs(&self) -> u16 {
        self.inputs
    }

    /// A new ±1.
    pub fn sign(&mut self) -> Expr {
        let choice = Choice(self.choices);
        self.choices += 1;
        self.intern(Node::Sign(choice))
    }

    /// Forgets the choices that expressions do not see.
    pub fn keep_choices_of(&mut self, all: &[Expr]) {
        let levels = self.levels();
        let seen = all.iter().map(|e| levels[e.index()]);
        self.choices = seen.max().unwrap_or(0);
    }

    /// How many choices there are; the branches are 2 to this power.
    pub fn choices(&self) -> u8 {
        self.choices
    }

    /// A finite constant. −0 is 0.
    pub fn constant(&mut self, x: f64) -> Expr {
        debug_assert!(x.is_finite(), "a constant of a robot is finite");
        self.intern(Node::Constant((x + 0.0).to_bits()))
    }

    /// 0.
    pub fn zero(&mut self) -> Expr {
        self.constant(0.0)
    }

    /// 1.
    pub fn one(&mut self) -> Expr {
        self.constant(1.0)
    }

    /// The value of a constant node.
    pub fn value(&self, e: Expr) -> Option<f64> {
        match self.node(e) {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    /// Whether a node is exactly the constant `x`.
    pub fn is(&self, e: Expr, x: f64) -> bool {
        self.value(e) == Some(x)
    }

    fn intern(&mut self, node: Node) -> Expr {
        let nodes = &mut self.nodes;
        *self.index.entry(node).or_insert_with(|| {
            nodes.push(node);
            Expr(nodes.len() as u32 - 1)
        })
    }

    /// If the node is −a, the a.
    pub(super) fn negated(&self, e: Expr) -> Option<Expr> {
        match self.node(e) {
            Node::Neg(a) => Some(a),
            _ => None,
        }
    }

    /// a + b.
    pub fn add(&mut self, a: Expr, b: Expr) -> Expr {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => return self.constant(x + y),
            (Some(0.0), _) => return b,
            (_, Some(0.0)) => return a,
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (_, Some(b)) => return self.sub(a, b),
            (Some(a), None) => return self.sub(b, a),
            _ => {}
        }
        if let (Node::Sub(x, y), Node::Sub(z, w)) = (self.node(a), self.node(b))
            && (x, y) == (w, z)
        {
            return self.zero();
        }
        // Powers of two move outwards: they round nothing.
        if a == b {
            let two = self.constant(2.0);
            return self.mul(two, a);
        }
        if let Some((power, x, y)) = self.common_power(a, b) {
            let sum = self.add(x, y);
            return self.mul(power, sum);
        }
        // A sum ends with its constant, so that constants meet and fold.
        if let (Node::Add(x, c), Some(y)) = (self.node(a), self.value(b))
            && let Some(c) = self.value(c)
        {
            let c = self.constant(c + y);
            return self.add(x, c);
        }
        let (a, b) = if self.value(a).is_some() || (self.value(b).is_none() && b < a) {
            (b, a)
        } else {
            (a, b)
        };
        self.intern(Node::Add(a, b))
    }

    /// a − b.
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        if a == b {
            return self.zero();
        }
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => return self.constant(x - y),
            (Some(0.0), _) => return self.neg(b),
            (_, Some(y)) => {
                let minus = self.constant(-y);
                return self.add(a, minus);
            }
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (_, Some(b)) => return self.add(a, b),
            (Some(a), None) => {
                let sum = self.add(a, b);
                return self.neg(sum);
            }
            _ => {}
        }
        if let Some((power, x, y)) = self.common_power(a, b) {
            let difference = self.sub(x, y);
            return self.mul(power, difference);
        }
        self.intern(Node::Sub(a, b))
    }

    /// −a.
    pub fn neg(&mut self, a: Expr) -> Expr {
        match self.node(a) {
            Node::Constant(bits) => self.constant(-f64::from_bits(bits)),
            Node::Neg(a) => a,
            Node::Sub(x, y) => self.sub(y, x),
            _ => self.intern(Node::Neg(a)),
        }
    }

    /// a b. Constants come first and positive; signs move outwards.
    pub fn mul(&mut self, a: Expr, b: Expr) -> Expr {
        let (a, b) = match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => return self.constant(x * y),
            (None, Some(_)) => (b, a),
            (None, None) if b < a => (b, a),
            _ => (a, b),
        };
        match self.value(a) {
            Some(0.0) => return a,
            Some(1.0) => return b,
            Some(x) if x < 0.0 => {
                let positive = self.constant(-x);
                let product = self.mul(positive, b);
                return self.neg(product);
            }
            Some(x) => {
                if let Node::Mul(c, y) = self.node(b)
                    && let Some(c) = self.value(c)
                {
                    let c = self.constant(x * c);
                    return self.mul(c, y);
                }
            }
            None => {}
        }
        match (self.negated(a), self.negated(b)) {
            (Some(a), Some(b)) => self.mul(a, b),
            (Some(x), None) => {
                let product = self.mul(x, b);
                self.neg(product)
            }
            (None, Some(y)) => {
                let product = self.mul(a, y);
                self.neg(product)
            }
            (None, None) => self.intern(Node::Mul(a, b)),
        }
    }

    /// a / b; division by a constant becomes a multiplication.
    pub fn div(&mut self, a: Expr, b: Expr) -> Expr {
        if self.is(a, 0.0) {
            return a;
        }
        if let Some(y) = self.value(b)
            && y != 0.0
        {
            let inverse = self.constant(1.0 / y);
            return self.mul(a, inverse);
        }
        match (self.negated(a), self.negated(b)) {
            (Some(a), Some(b)) => self.div(a, b),
            (Some(a), None) => {
                let quotient = self.div(a, b);
                self.neg(quotient)
            }
            (None, Some(b)) => {
                let quotient = self.div(a, b);
                self.neg(quotient)
            }
            (None, None) => self.intern(Node::Div(a, b)),
        }
    }

    /// a².
    pub fn square(&mut self, a: Expr) -> Expr {
        let a = self.negated(a).unwrap_or(a);
        let Some((power, x)) = self.power_of_two(a) else {
            return self.mul(a, a);
        };
        let [power, square] = [self.mul(power, power), self.mul(x, x)];
        self.mul(power, square)
    }

    /// A power of two, and what it multiplies.
    fn power_of_two(&self, e: Expr) -> Option<(Expr, Expr)> {
        let Node::Mul(factor, x) = self.node(e) else {
            return None;
        };
        let is_power = |x: f64| x.is_normal() && x.to_bits() << 12 == 0;
        self.value(factor)
            .is_some_and(is_power)
            .then_some((factor, x))
    }

    /// The power of two that multiplies both, to no rounding, and what it multiplies.
    fn common_power(&self, a: Expr, b: Expr) -> Option<(Expr, Expr, Expr)> {
        let ((power, x), (other, y)) = self.power_of_two(a).zip(self.power_of_two(b))?;
        (power == other).then_some((power, x, y))
    }

    /// √a.
    pub fn sqrt(&mut self, a: Expr) -> Expr {
        match self.value(a) {
            Some(x) if x >= 0.0 => self.constant(x.sqrt()),
            _ => self.intern(Node::Sqrt(a)),
        }
    }

    /// (sin a, cos a).
    pub fn sin_cos(&mut self, a: Expr) -> (Expr, Expr) {
        if let Some(x) = self.value(a) {
            let (s, c) = x.sin_cos();
            return (self.constant(s), self.constant(c));
        }
        if let Some(a) = self.negated(a) {
            let (s, c) = self.sin_cos(a);
            return (self.neg(s), c);
        }
        (self.intern(Node::Sin(a)), self.intern(Node::Cos(a)))
    }

    /// The angle of the unit vector (x, y).
    pub fn atan2(&mut self, y: Expr, x: Expr) -> Expr {
        match (self.value(y), self.value(x)) {
            (Some(y), Some(x)) => self.constant(y.atan2(x)),
            _ => self.intern(Node::Atan2(y, x)),
        }
    }

    /// a modulo 2π, into (−π, π].
    pub fn wrap(&mut self, a: Expr) -> Expr {
        match self.value(a) {
            Some(x) => self.constant(kin_runtime::__private::math::wrap(x)),
            None if matches!(self.node(a), Node::Atan2(..) | Node::Wrap(_)) => a,
            None => self.intern(Node::Wrap(a)),
        }
    }

    /// The larger of two.
    pub fn max(&mut self, a: Expr, b: Expr) -> Expr {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => self.constant(x.max(y)),
            _ if a == b => a,
            _ => {
                let (a, b) = if b < a { (b, a) } else { (a, b) };
                self.intern(Node::Max(a, b))
            }
        }
    }

    /// One number of one root of a trigonometric quartic.
    pub fn trig_root(&mut self, coefficients: [Expr; 5], place: u8, field: RootField) -> Expr {
        self.intern(Node::TrigRoot(coefficients, RootPart { place, field }))
    }

    /// x where a < b, else y.
    pub fn select_less(&mut self, a: Expr, b: Expr, x: Expr, y: Expr) -> Expr {
        match (self.value(a), self.value(b)) {
            (Some(p), Some(q)) => {
                if p < q {
                    x
                } else {
                    y
                }
            }
            _ if x == y => x,
            _ => self.intern(Node::Select([a, b, x, y])),
        }
    }

    /// Rebuilds `e` of another graph, with some of its nodes replaced.
    pub fn import(&mut self, other: &Graph, e: Expr, replaced: &[(Expr, Expr)]) -> Expr {
        let needed = other.reachable(&[e]);
        let mut here: NodeMap<Expr, Expr> = replaced.iter().copied().collect();
        for i in (0..=e.index()).filter(|&i| needed[i]) {
            let there = other.at(i);
            if here.contains_key(&there) {
                continue;
            }
            let node = other.node(there);
            let operands = node.operand_slots();
            let operands = operands.map(|e| here.get(&e).copied().unwrap_or(there));
            here.insert(there, self.rebuild(node, operands));
        }
        here.get(&e).copied().unwrap_or(e)
    }

    /// An operation on other operands, simplified anew.
    fn rebuild(&mut self, node: Node, operands: [Expr; 5]) -> Expr {
        let [a, b, x, y, _] = operands;
        match node {
            Node::Constant(_) | Node::Input(_) | Node::Sign(_) => self.intern(node),
            Node::Add(..) => self.add(a, b),
            Node::Sub(..) => self.sub(a, b),
            Node::Mul(..) => self.mul(a, b),
            Node::Div(..) => self.div(a, b),
            Node::Neg(_) => self.neg(a),
            Node::Sqrt(_) => self.sqrt(a),
            Node::Sin(_) => self.sin_cos(a).0,
            Node::Cos(_) => self.sin_cos(a).1,
            Node::Atan2(..) => self.atan2(a, b),
            Node::Wrap(_) => self.wrap(a),
            Node::Max(..) => self.max(a, b),
            Node::Select(_) => self.select_less(a, b, x, y),
            Node::TrigRoot(_, part) => self.intern(Node::TrigRoot(operands, part)),
        }
    }

    /// How many choices an expression sees: its lanes are 2 to this power.
    /// Choices are numbered as the plan makes them, and an expression that
    /// depends on a late one is laid out over all before it as well.
    pub fn levels(&self) -> Vec<u8> {
        let mut levels = vec![0; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate() {
            levels[i] = match node {
                Node::Sign(choice) => choice.0 + 1,
                _ => node
                    .operands()
                    .map(|e| levels[e.index()])
                    .max()
                    .unwrap_or(0),
            };
        }
        levels
    }

    /// Which nodes `outputs` need, directly or not.
    pub fn reachable(&self, outputs: &[Expr]) -> Vec<bool> {
        let mut needed = vec![false; self.nodes.len()];
        for e in outputs {
            needed[e.index()] = true;
        }
        for i in (0..self.nodes.len()).rev() {
            if needed[i] {
                for e in self.nodes[i].operands() {
                    needed[e.index()] = true;
                }
            }
        }
        needed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounding_leaves_alone_is_not_computed() {
        let mut g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.input(name));
        let [ahead, back] = [g.sub(x, y), g.sub(y, x)];
        let sum = g.add(ahead, back);
        assert!(g.is(sum, 0.0));
        // ½ (x + x + (y + y)) is x + y, and (2 x)² − (2 y)² is 4 (x² − y²).
        let doubled = [x, y].map(|e| g.add(e, e));
        let sum = g.add(doubled[0], doubled[1]);
        let half = g.constant(0.5);
        let halved = g.mul(half, sum);
        assert_eq!(halved, g.add(x, y));
        let squares = doubled.map(|e| g.square(e));
        let difference = g.sub(squares[0], squares[1]);
        let (four, plain) = (g.constant(4.0), [x, y].map(|e| g.square(e)));
        let plain = g.sub(plain[0], plain[1]);
        assert_eq!(difference, g.mul(four, plain));
        // To move other factors rounds.
        let three = g.constant(3.0);
        let [a, b] = [x, y].map(|e| g.mul(three, e));
        let sum = g.add(a, b);
        assert!(matches!(g.node(sum), Node::Add(..)));
    }
}
