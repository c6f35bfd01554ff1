//! Expressions as Rust: one `let` per shared or named node, the rest inline.

use crate::expr::{Expr, Graph, Node, RootField};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::HashSet;

/// How tightly a piece of Rust binds.
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

/// Writes parts of a graph as Rust.
pub struct Writer<'a> {
    graph: &'a Graph,
    needed: Vec<bool>,
    /// How many operations read a node.
    uses: Vec<u32>,
    /// Nodes that stand inline where they are used.
    inline: Vec<bool>,
    /// What a node is called, once it has been written.
    names: Vec<Option<TokenStream>>,
    taken: HashSet<String>,
    temporaries: usize,
    /// The quartics solved so far.
    quartics: Vec<[Expr; 5]>,
    place: Place,
}

impl<'a> Writer<'a> {
    /// For a function that computes `outputs`. `inputs` are the Rust
    /// expressions of the inputs, by number. Nodes of different `stages` do
    /// not stand inline in each other.
    pub fn new(
        graph: &'a Graph,
        outputs: &[Expr],
        inputs: &[TokenStream],
        stages: &[usize],
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
                Node::Sign(choice) => {
                    let sign = sign_name(choice.0);
                    Some(quote!(#sign[k]))
                }
                _ => None,
            };
        }
        writer
    }

    /// Reads a node that has been written in another way from here on.
    pub fn rename(&mut self, e: Expr, reading: TokenStream) {
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

    /// The statements for the nodes that `select` picks, in order. `open` says
    /// what stands in front of a node's; `bind` makes a statement of a name and
    /// a value, and says how the name is to be read from then on.
    pub fn statements(
        &mut self,
        place: Place,
        select: impl Fn(usize) -> bool,
        mut open: impl FnMut(usize) -> TokenStream,
        mut bind: impl FnMut(Expr, &Ident, TokenStream) -> (TokenStream, TokenStream),
    ) -> Vec<TokenStream> {
        self.place = place;
        let mut out = Vec::new();
        for i in 0..self.needed.len() {
            if !self.awaits(i) || !select(i) {
                continue;
            }
            out.push(open(i));
            let e = self.expr(i);
            if let Node::TrigRoot(coefficients, _) = self.graph.node(e) {
                out.extend(self.roots_of(coefficients));
            }
            let name = self.identifier(e);
            let value = self.value(e).0;
            let (statement, reading) = bind(e, &name, value);
            self.names[i] = Some(reading);
            out.push(statement);
        }
        out
    }

    /// The statements that compute every sine and cosine of the function, in
    /// one call of `function` on an array: a loop over lanes is vectorized where
    /// single calls are not.
    pub fn sines_and_cosines(&mut self, function: &TokenStream) -> Vec<TokenStream> {
        let angles = self.laid_out(self.angles());
        let sums = self.graph.reachable(&angles);
        let mut out = self.statements(
            Place::Scalar,
            |i| sums[i],
            |_| TokenStream::new(),
            |_, name, value| (quote!(let #name = #value;), quote!(#name)),
        );
        let values: Vec<TokenStream> = angles.iter().map(|&a| self.read(a).0).collect();
        let sines: Vec<TokenStream> = angles.iter().map(|&a| self.bound(Node::Sin(a))).collect();
        let cosines: Vec<TokenStream> = angles.iter().map(|&a| self.bound(Node::Cos(a))).collect();
        if !angles.is_empty() {
            out.push(quote! {
                let ([#(#sines),*], [#(#cosines),*]) = #function([#(#values),*]);
            });
        }
        out
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

    /// The name under which a node is bound by a pattern; `_` if it is not
    /// needed.
    fn bound(&mut self, node: Node) -> TokenStream {
        match self.graph.find(node).filter(|e| self.needed[e.index()]) {
            Some(e) => {
                let name = self.identifier(e);
                self.names[e.index()] = Some(quote!(#name));
                quote!(#name)
            }
            None => quote!(_),
        }
    }

    /// The call that finds the roots of a quartic, unless it stands already.
    fn roots_of(&mut self, coefficients: [Expr; 5]) -> Option<TokenStream> {
        if self.quartics.contains(&coefficients) {
            return None;
        }
        self.quartics.push(coefficients);
        let name = quartic_name(self.quartics.len());
        let values = coefficients.map(|e| self.read(e).0);
        Some(quote!(let #name = trig_roots([#(#values),*]);))
    }

    fn identifier(&mut self, e: Expr) -> Ident {
        let wanted = self.graph.name(e).map(str::to_owned);
        if let Some(name) = wanted
            && self.taken.insert(name.clone())
        {
            return format_ident!("{name}");
        }
        loop {
            self.temporaries += 1;
            let name = format!("t{}", self.temporaries);
            if self.taken.insert(name.clone()) {
                return format_ident!("{name}");
            }
        }
    }

    /// A node as an operand or a result.
    pub fn output(&self, e: Expr) -> TokenStream {
        self.read(e).0
    }

    fn read(&self, e: Expr) -> (TokenStream, Binding) {
        match &self.names[e.index()] {
            Some(name) => (name.clone(), Binding::Atom),
            None => self.value(e),
        }
    }

    fn at_least(&self, e: Expr, binding: Binding) -> TokenStream {
        let (tokens, own) = self.read(e);
        if own >= binding {
            tokens
        } else {
            quote!((#tokens))
        }
    }

    fn value(&self, e: Expr) -> (TokenStream, Binding) {
        use Binding::{Atom, Product, Sum, Unary};
        match self.graph.node(e) {
            Node::Constant(bits) => constant(f64::from_bits(bits)),
            Node::Input(_) | Node::Sign(_) | Node::Sin(_) | Node::Cos(_) => {
                unreachable!("inputs, signs, sines and cosines have names before they are read")
            }
            Node::Add(a, b) => match self.graph.value(b) {
                Some(c) if c < 0.0 => {
                    let (a, c) = (self.read(a).0, constant(-c).0);
                    (quote!(#a - #c), Sum)
                }
                _ => {
                    let (a, b) = (self.at_least(a, Sum), self.at_least(b, Product));
                    (quote!(#a + #b), Sum)
                }
            },
            Node::Sub(a, b) => {
                let (a, b) = (self.at_least(a, Sum), self.at_least(b, Product));
                (quote!(#a - #b), Sum)
            }
            Node::Mul(a, b) => {
                let (a, b) = (self.at_least(a, Product), self.at_least(b, Unary));
                (quote!(#a * #b), Product)
            }
            Node::Div(a, b) => {
                let (a, b) = (self.at_least(a, Product), self.at_least(b, Unary));
                (quote!(#a / #b), Product)
            }
            Node::Neg(a) => {
                let a = self.at_least(a, Atom);
                (quote!(-#a), Unary)
            }
            Node::Sqrt(a) => self.call(quote!(math::sqrt), &[a]),
            Node::Atan2(y, x) if self.place == Place::Lane => {
                self.call(quote!(lanes::angle), &[y, x])
            }
            Node::Atan2(y, x) => {
                let (angle, _) = self.call(quote!(math::atan2), &[y, x]);
                (quote!(math::wrap(#angle)), Atom)
            }
            Node::Wrap(a) => self.call(quote!(math::wrap), &[a]),
            Node::Max(a, b) => self.call(quote!(math::max), &[a, b]),
            Node::Select([a, b, x, y]) => {
                let [a, b, x, y] = [a, b, x, y].map(|e| self.read(e).0);
                (quote!(math::select(#a < #b, #x, #y)), Atom)
            }
            Node::TrigRoot(coefficients, part) => {
                let known = self.quartics.iter().position(|c| *c == coefficients);
                let name = quartic_name(known.map_or(0, |i| i + 1));
                let place = Literal::u8_unsuffixed(part.place);
                let field = match part.field {
                    RootField::Sin => quote!(sin),
                    RootField::Cos => quote!(cos),
                    RootField::State => quote!(state),
                };
                (quote!(#name[#place].#field), Atom)
            }
        }
    }

    fn call(&self, function: TokenStream, arguments: &[Expr]) -> (TokenStream, Binding) {
        let arguments = arguments.iter().map(|e| self.read(*e).0);
        (quote!(#function(#(#arguments),*)), Binding::Atom)
    }
}

fn quartic_name(number: usize) -> Ident {
    format_ident!("roots{number}")
}

/// What the sign of a choice is called.
pub fn sign_name(choice: u8) -> Ident {
    format_ident!("e{}", choice + 1)
}

/// A literal; a negative one binds like the minus that it has.
fn constant(x: f64) -> (TokenStream, Binding) {
    let literal = literal(x.abs());
    if x < 0.0 {
        (quote!(-#literal), Binding::Unary)
    } else {
        (quote!(#literal), Binding::Atom)
    }
}

/// A literal with its sign.
pub fn signed(x: f64) -> TokenStream {
    constant(x).0
}

/// The shortest digits of a positive number, small ones as 1e-9.
pub fn literal(x: f64) -> Literal {
    if x != 0.0 && x < 1e-6 {
        format!("{x:e}")
            .parse()
            .unwrap_or_else(|_| Literal::f64_unsuffixed(x))
    } else {
        Literal::f64_unsuffixed(x)
    }
}
