//! What an expression costs, in operations.

use super::{Expr, Graph, Node, RootField};
use std::ops::AddAssign;

/// Operation counts. A negation is free: it is part of a subtraction or of a
/// constant in nearly every use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Multiplications.
    pub multiplications: usize,
    /// Additions and subtractions, those of angle sums included.
    pub additions: usize,
    /// Divisions.
    pub divisions: usize,
    /// Square roots.
    pub roots: usize,
    /// Sine and cosine of one angle, counted together.
    pub sincos: usize,
    /// Arctangents.
    pub arctangents: usize,
    /// Comparisons with selection, maxima and absolute values.
    pub selections: usize,
    /// Trigonometric quartics.
    pub quartics: usize,
}

impl Operations {
    /// One number to compare variants by: roughly the cycles of a lane.
    pub fn weight(&self) -> usize {
        self.multiplications
            + self.additions
            + 6 * (self.divisions + self.roots)
            + 14 * self.sincos
            + 24 * self.arctangents
            + self.selections
            + 800 * self.quartics
    }
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        self.multiplications += other.multiplications;
        self.additions += other.additions;
        self.divisions += other.divisions;
        self.roots += other.roots;
        self.sincos += other.sincos;
        self.arctangents += other.arctangents;
        self.selections += other.selections;
        self.quartics += other.quartics;
    }
}

impl Graph {
    /// The operations that computing `outputs` takes, every node once.
    pub fn operations(&self, outputs: &[Expr]) -> Operations {
        let needed = self.reachable(outputs);
        let mut total = Operations::default();
        for (i, node) in self.nodes().iter().enumerate() {
            if needed[i] {
                total += self.operations_of(*node, &needed);
            }
        }
        total
    }

    fn operations_of(&self, node: Node, needed: &[bool]) -> Operations {
        let mut one = Operations::default();
        match node {
            Node::Constant(_) | Node::Input(_) | Node::Sign(_) | Node::Neg(_) => {}
            Node::Add(..) | Node::Sub(..) => one.additions = 1,
            Node::Mul(..) => one.multiplications = 1,
            Node::Div(..) => one.divisions = 1,
            Node::Sqrt(_) => one.roots = 1,
            Node::Sin(_) => one.sincos = 1,
            Node::Cos(a) => {
                let with_sine = self
                    .index
                    .get(&Node::Sin(a))
                    .is_some_and(|sine| needed[sine.index()]);
                one.sincos = usize::from(!with_sine);
            }
            Node::Atan2(..) => one.arctangents = 1,
            Node::Wrap(_) => {
                one.multiplications = 2;
                one.additions = 3;
            }
            Node::Abs(_) | Node::Max(..) | Node::Select(_) => one.selections = 1,
            // All its numbers come of one call; every quartic is read for this one.
            Node::TrigRoot(_, part) => {
                let first = part.place == 0 && part.field == RootField::State;
                one.quartics = usize::from(first);
            }
        }
        one
    }
}
