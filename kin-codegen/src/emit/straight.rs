//! Expressions as statements of a language: one per shared or named node, the rest
//! inline.

use super::language::{Function, Language, MulAdd, Operator};
use crate::expr::{Expr, Graph, Node};
use std::collections::HashSet;

/// How tightly a piece of source binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Unary,
    Atom,
}

/// Expressions longer than this get a name of their own.
const LONGEST_INLINE: usize = 9;

/// Where statements stand, which decides between equal functions.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In straight-line code on single values.
    Scalar,
    /// In a loop over lanes.
    Lane,
}

/// An angle of which the sine, the cosine or both are needed, under these names.
pub struct Angle<Text> {
    /// Radians.
    pub value: Text,
    /// Of its sine.
    pub sin: Option<String>,
    /// Of its cosine.
    pub cos: Option<String>,
}

/// All sines and cosines of a function, to be computed by one call on an array: a loop
/// over lanes is vectorized where single calls are not.
pub struct Trig<Text> {
    /// The statements that add angles up.
    pub sums: Vec<Text>,
    /// The angles.
    pub angles: Vec<Angle<Text>>,
}

/// Writes parts of a graph in a language.
pub struct Writer<'a, L: Language> {
    graph: &'a Graph,
    needed: Vec<bool>,
    /// How many operations read a node.
    uses: Vec<u32>,
    /// Products that are one operation with the sum that reads them, and how that is written.
    fused: Option<(Vec<bool>, MulAdd<L::Text>)>,
    /// Nodes that stand inline where they are used.
    inline: Vec<bool>,
    /// What a node is called, once it has been written.
    names: Vec<Option<L::Text>>,
    taken: HashSet<String>,
    temporaries: usize,
    /// The quartics solved so far.
    quartics: Vec<[Expr; 5]>,
    place: Place,
}

impl<'a, L: Language> Writer<'a, L> {
    /// For a function that computes `outputs`. `inputs` is how the
    /// inputs are read, by number. Nodes of different `stages` do
    /// not stand inline in each other; `fused` is how a product and a sum are
    /// written as one operation, if they are to be one.
    pub fn new(
        graph: &'a Graph,
        outputs: &[Expr],
        inputs: &[L::Text],
        stages: &[usize],
        fused: Option<MulAdd<L::Text>>,
    ) -> Self {
        let needed = graph.reachable(outputs);
        let mut uses = vec![0; needed.len()];
        let mut pinned = vec![false; needed.len()];
        for (i, node) in graph.nodes().iter().enumerate().filter(|(i, _)| needed[*i]) {
            for e in node.operands() {
                uses[e.index()] += 1;
                pinned[e.index()] |= stages[e.index()] != stages[i];
            }
        }
        for e in outputs {
            uses[e.index()] += 1;
        }
        let mut writer = Self {
            graph,
            fused: fused.map(|mul_add| (graph.fused(outputs), mul_add)),
            inline: Vec::new(),
            names: vec![None; needed.len()],
            needed,
            uses,
            taken: HashSet::new(),
            temporaries: 0,
            quartics: Vec::new(),
            place: Place::Scalar,
        };
        writer.decide_inline(&pinned);
        for (i, node) in graph.nodes().iter().enumerate() {
            writer.names[i] = match node {
                Node::Input(k) => Some(inputs[usize::from(*k)].clone()),
                Node::Sign(choice) => Some(L::sign(&sign_name(choice.0))),
                _ => None,
            };
        }
        writer
    }

    /// Reads a node that has been written in another way from here on.
    pub fn rename(&mut self, e: Expr, reading: L::Text) {
        self.names[e.index()] = Some(reading);
    }

    /// Whether an input or node takes part.
    pub fn needs(&self, e: Expr) -> bool {
        self.needed[e.index()]
    }

    /// Whether the input of this number takes part.
    pub fn needs_input(&self, number: usize) -> bool {
        let input = self.graph.find(Node::Input(number as u16));
        input.is_some_and(|input| self.needs(input))
    }

    fn decide_inline(&mut self, pinned: &[bool]) {
        let mut length = vec![0; self.needed.len()];
        for (i, node) in self.graph.nodes().iter().enumerate() {
            let operands: usize = node
                .operands()
                .map(|e| {
                    if self.inline[e.index()] {
                        length[e.index()]
                    } else {
                        0
                    }
                })
                .sum();
            length[i] = operands + 1;
            let inline = match node {
                Node::Constant(_) => true,
                Node::Input(_)
                | Node::Sign(_)
                | Node::Sin(_)
                | Node::Cos(_)
                | Node::TrigRoot(..) => false,
                _ if self.is_fused(self.expr(i)) => true,
                // Free to repeat.
                Node::Neg(a) if !pinned[i] && matches!(self.graph.node(*a), Node::Input(_)) => true,
                _ => {
                    let e = self.expr(i);
                    self.uses[i] == 1
                        && !pinned[i]
                        && self.graph.name(e).is_none()
                        && length[i] <= LONGEST_INLINE
                }
            };
            self.inline.push(inline);
        }
    }

    fn expr(&self, index: usize) -> Expr {
        self.graph.at(index)
    }

    /// Whether a node is an operation that takes part.
    pub fn needs_operation(&self, index: usize) -> bool {
        let leaf = |node| matches!(node, Node::Constant(_) | Node::Input(_) | Node::Sign(_));
        self.needed[index] && !leaf(self.graph.nodes()[index])
    }

    /// Whether a node gets a statement of its own and has none yet.
    pub fn awaits(&self, index: usize) -> bool {
        self.needed[index] && !self.inline[index] && self.names[index].is_none()
    }

    /// The statements for the nodes that `select` picks, in order. `open` says what
    /// comments stand in front of a node's; `named` is told its name.
    pub fn statements(
        &mut self,
        place: Place,
        select: impl Fn(usize) -> bool,
        mut open: impl FnMut(usize) -> Vec<String>,
        mut named: impl FnMut(Expr, &str),
    ) -> Vec<L::Text> {
        self.place = place;
        let mut out = Vec::new();
        for i in 0..self.needed.len() {
            if !self.awaits(i) || !select(i) {
                continue;
            }
            out.extend(open(i).iter().map(|text| L::comment(text)));
            let e = self.expr(i);
            if let Node::TrigRoot(coefficients, _) = self.graph.node(e) {
                out.extend(self.roots_of(coefficients));
            }
            let name = self.identifier(e);
            let value = self.value(e).0;
            self.names[i] = Some(L::name(&name));
            named(e, &name);
            out.push(L::definition(&name, value));
        }
        out
    }

    /// The sines and cosines of the function.
    pub fn sines_and_cosines(&mut self) -> Trig<L::Text> {
        let angles = self.laid_out(self.angles());
        let reached = self.graph.reachable(&angles);
        let sums = self.statements(Place::Scalar, |i| reached[i], |_| Vec::new(), |_, _| ());
        let values: Vec<L::Text> = angles.iter().map(|&a| self.read(a).0).collect();
        let sines: Vec<_> = angles.iter().map(|&a| self.bound(Node::Sin(a))).collect();
        let cosines: Vec<_> = angles.iter().map(|&a| self.bound(Node::Cos(a))).collect();
        let all = values.into_iter().zip(sines).zip(cosines);
        let all = all.map(|((value, sin), cos)| Angle { value, sin, cos });
        Trig {
            sums,
            angles: all.collect(),
        }
    }

    /// The angles of which a sine or cosine is needed.
    pub fn angles(&self) -> Vec<Expr> {
        let mut angles = Vec::new();
        for (i, node) in self.graph.nodes().iter().enumerate() {
            if let (true, Node::Sin(a) | Node::Cos(a)) = (self.needed[i], *node)
                && !angles.contains(&a)
            {
                angles.push(a);
            }
        }
        angles
    }

    /// Angles in the order in which they are laid out for packed instructions.
    ///
    /// The compiler copies inputs that are neighbours here and there together.
    /// Where such a copy lies across two packed loads, these wait until it has
    /// reached the cache (a failed store forwarding, some 15 ns), and so does a
    /// copy of two that the caller wrote apart. So even inputs come first with
    /// the odd ones behind them, and the others backwards, none of which is
    /// copied with its neighbour.
    fn laid_out(&self, mut angles: Vec<Expr>) -> Vec<Expr> {
        let input = |e: Expr| match self.graph.node(e) {
            Node::Input(k) => Some(i32::from(k)),
            _ => None,
        };
        let inputs: Vec<i32> = angles.iter().filter_map(|e| input(*e)).collect();
        angles.sort_by_key(|e| match input(*e) {
            Some(k) if inputs.contains(&(k ^ 1)) => (0, k),
            Some(k) => (1, -k),
            None => (2, 0),
        });
        angles
    }

    /// Whether a sine or cosine is that of a sum of inputs.
    pub fn adds_angles(&self) -> bool {
        let is_sum = |&angle: &Expr| {
            let reached = self.graph.reachable(&[angle]);
            let nodes = self.graph.nodes().iter().zip(reached);
            nodes
                .filter(|(node, reached)| *reached && matches!(node, Node::Input(_)))
                .count()
                > 1
        };
        self.angles().iter().any(is_sum)
    }

    /// The name of a node that is computed with others; none if it is not needed.
    fn bound(&mut self, node: Node) -> Option<String> {
        let e = self.graph.find(node).filter(|e| self.needed[e.index()])?;
        let name = self.identifier(e);
        self.names[e.index()] = Some(L::name(&name));
        Some(name)
    }

    /// The call that finds the roots of a quartic, unless it stands already.
    fn roots_of(&mut self, coefficients: [Expr; 5]) -> Option<L::Text> {
        if self.quartics.contains(&coefficients) {
            return None;
        }
        self.quartics.push(coefficients);
        let name = quartic_name(self.quartics.len());
        Some(L::roots(&name, coefficients.map(|e| self.read(e).0)))
    }

    fn identifier(&mut self, e: Expr) -> String {
        let wanted = self.graph.name(e).map(str::to_owned);
        if let Some(name) = wanted
            && self.taken.insert(name.clone())
        {
            return name;
        }
        loop {
            self.temporaries += 1;
            let name = format!("t{}", self.temporaries);
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }

    /// A node as an operand or a result.
    pub fn output(&self, e: Expr) -> L::Text {
        self.read(e).0
    }

    fn read(&self, e: Expr) -> (L::Text, Binding) {
        match &self.names[e.index()] {
            Some(name) => (name.clone(), Binding::Atom),
            None => self.value(e),
        }
    }

    fn at_least(&self, e: Expr, binding: Binding) -> L::Text {
        let (text, own) = self.read(e);
        if own >= binding {
            text
        } else {
            L::parenthesized(text)
        }
    }

    fn value(&self, e: Expr) -> (L::Text, Binding) {
        use Binding::{Atom, Product, Sum, Unary};
        let infix = |a, operator, b, binding| (L::infix(a, operator, b), binding);
        if let Some(fused) = self.fused(e) {
            return (fused, Atom);
        }
        match self.graph.node(e) {
            Node::Constant(bits) => constant::<L>(f64::from_bits(bits)),
            Node::Input(_) | Node::Sign(_) | Node::Sin(_) | Node::Cos(_) => {
                unreachable!("inputs, signs, sines and cosines have names before they are read")
            }
            Node::Add(a, b) => match self.graph.value(b) {
                Some(c) if c < 0.0 => {
                    let (a, c) = (self.read(a).0, constant::<L>(-c).0);
                    infix(a, Operator::Minus, c, Sum)
                }
                _ => {
                    let (a, b) = (self.at_least(a, Sum), self.at_least(b, Product));
                    infix(a, Operator::Plus, b, Sum)
                }
            },
            Node::Sub(a, b) => {
                let (a, b) = (self.at_least(a, Sum), self.at_least(b, Product));
                infix(a, Operator::Minus, b, Sum)
            }
            Node::Mul(a, b) => {
                let (a, b) = (self.at_least(a, Product), self.at_least(b, Unary));
                infix(a, Operator::Times, b, Product)
            }
            Node::Div(a, b) => {
                let (a, b) = (self.at_least(a, Product), self.at_least(b, Unary));
                infix(a, Operator::Over, b, Product)
            }
            Node::Neg(a) => (L::minus(self.at_least(a, Atom)), Unary),
            Node::Sqrt(a) => self.call(Function::Sqrt, &[a]),
            Node::Atan2(y, x) => {
                let function = match self.place {
                    Place::Lane => Function::AngleInLanes,
                    Place::Scalar => Function::Angle,
                };
                self.call(function, &[y, x])
            }
            Node::Wrap(a) => self.call(Function::Wrap, &[a]),
            Node::Max(a, b) => self.call(Function::Max, &[a, b]),
            Node::Select(all) => self.call(Function::SelectLess, &all),
            Node::TrigRoot(coefficients, part) => {
                let known = self.quartics.iter().position(|c| *c == coefficients);
                let name = quartic_name(known.map_or(0, |i| i + 1));
                (L::root(&name, part), Atom)
            }
        }
    }

    /// A sum or difference that is one operation with a product in it.
    fn fused(&self, e: Expr) -> Option<L::Text> {
        let (_, mul_add) = self.fused.as_ref()?;
        let read = |e: Expr| self.read(e).0;
        let factors = |product| match self.graph.node(product) {
            Node::Mul(a, b) if self.is_fused(product) => Some([a, b]),
            _ => None,
        };
        let [x, y, z] = match self.graph.node(e) {
            Node::Add(a, b) => match (factors(a), factors(b)) {
                (Some([x, y]), _) => [read(x), read(y), read(b)],
                (None, Some([x, y])) => [read(x), read(y), read(a)],
                (None, None) => return None,
            },
            Node::Sub(a, b) => match (factors(a), factors(b)) {
                (Some([x, y]), _) => [read(x), read(y), self.negated(b)],
                (None, Some([x, y])) => [self.negated(x), read(y), read(a)],
                (None, None) => return None,
            },
            _ => return None,
        };
        Some(mul_add(x, y, z))
    }

    /// Whether a product is one operation with the sum that reads it.
    fn is_fused(&self, product: Expr) -> bool {
        let fused = self.fused.as_ref();
        fused.is_some_and(|(fused, _)| fused[product.index()])
    }

    /// −a.
    fn negated(&self, a: Expr) -> L::Text {
        match self.graph.value(a) {
            Some(x) => constant::<L>(-x).0,
            None => L::minus(self.at_least(a, Binding::Atom)),
        }
    }

    fn call(&self, function: Function, arguments: &[Expr]) -> (L::Text, Binding) {
        let arguments = arguments.iter().map(|e| self.read(*e).0).collect();
        (L::call(function, arguments), Binding::Atom)
    }
}

fn quartic_name(number: usize) -> String {
    format!("roots{number}")
}

/// What the sign of a choice is called.
pub fn sign_name(choice: u8) -> String {
    format!("e{}", choice + 1)
}

/// A number; a negative one binds like the minus that it has.
fn constant<L: Language>(x: f64) -> (L::Text, Binding) {
    let number = L::number(x.abs());
    if x < 0.0 {
        (L::minus(number), Binding::Unary)
    } else {
        (number, Binding::Atom)
    }
}

/// A number with its sign.
pub fn signed<L: Language>(x: f64) -> L::Text {
    constant::<L>(x).0
}
