//! What an expression costs, in operations.

use super::{Expr, Graph, Node, RootField};
use std::fmt;
use std::ops::{AddAssign, Mul, Sub};

/// Operation counts. A negation is free: it is part of a subtraction or of a
/// constant in nearly every use.
///
/// Displayed without what does not occur:
/// `40 multiplications, 20 additions, 6 sines with cosines`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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

    /// Field by field.
    fn combined(self, other: Self, f: impl Fn(usize, usize) -> usize) -> Self {
        Self {
            multiplications: f(self.multiplications, other.multiplications),
            additions: f(self.additions, other.additions),
            divisions: f(self.divisions, other.divisions),
            roots: f(self.roots, other.roots),
            sincos: f(self.sincos, other.sincos),
            arctangents: f(self.arctangents, other.arctangents),
            selections: f(self.selections, other.selections),
            quartics: f(self.quartics, other.quartics),
        }
    }
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        *self = self.combined(other, |a, b| a + b);
    }
}

impl Sub for Operations {
    type Output = Self;

    fn sub(self, less: Self) -> Self {
        self.combined(less, |a, b| a - b)
    }
}

impl Mul<Operations> for usize {
    type Output = Operations;

    fn mul(self, once: Operations) -> Operations {
        once.combined(once, |a, _| self * a)
    }
}

impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counted = |count: usize, one: &str, many: &str| match count {
            1 => format!("1 {one}"),
            count => format!("{count} {many}"),
        };
        let first = counted(self.multiplications, "multiplication", "multiplications");
        let second = counted(self.additions, "addition", "additions");
        write!(f, "{first}, {second}")?;
        let others = [
            (self.divisions, "division", "divisions"),
            (self.roots, "root", "roots"),
            (self.sincos, "sine with cosine", "sines with cosines"),
            (self.arctangents, "arctangent", "arctangents"),
            (self.selections, "selection", "selections"),
            (self.quartics, "quartic", "quartics"),
        ];
        others
            .iter()
            .filter(|(count, ..)| *count > 0)
            .try_for_each(|(count, one, many)| write!(f, ", {}", counted(*count, one, many)))
    }
}

impl Graph {
    /// The operations that computing `outputs` takes, every node once.
    pub fn operations(&self, outputs: &[Expr]) -> Operations {
        let needed = self.reachable(outputs);
        let mut total = Operations::default();
        for (node, _) in self.nodes().iter().zip(&needed).filter(|(_, it)| **it) {
            self.count(*node, &needed, &mut total);
        }
        total
    }

    /// The same node by node.
    pub fn operations_by_node(&self, outputs: &[Expr]) -> Vec<Operations> {
        let needed = self.reachable(outputs);
        let of = |(i, node): (usize, &Node)| match needed[i] {
            true => {
                let mut one = Operations::default();
                self.count(*node, &needed, &mut one);
                one
            }
            false => Operations::default(),
        };
        self.nodes().iter().enumerate().map(of).collect()
    }

    /// The operations that computing `outputs` takes in all lanes: an expression behind the
    /// k-th choice is computed in 2ᵏ of them.
    pub fn operations_of_lanes(&self, outputs: &[Expr]) -> Operations {
        let levels = self.levels();
        let each = self.operations_by_node(outputs);
        let mut all = Operations::default();
        for (once, level) in each.into_iter().zip(levels) {
            all += (1usize << level) * once;
        }
        all
    }

    /// Adds the operations of a node.
    fn count(&self, node: Node, needed: &[bool], to: &mut Operations) {
        match node {
            Node::Constant(_) | Node::Input(_) | Node::Sign(_) | Node::Neg(_) => {}
            Node::Add(..) | Node::Sub(..) => to.additions += 1,
            Node::Mul(..) => to.multiplications += 1,
            Node::Div(..) => to.divisions += 1,
            Node::Sqrt(_) => to.roots += 1,
            Node::Sin(_) => to.sincos += 1,
            Node::Cos(a) => {
                let with_sine = self
                    .index
                    .get(&Node::Sin(a))
                    .is_some_and(|sine| needed[sine.index()]);
                to.sincos += usize::from(!with_sine);
            }
            Node::Atan2(..) => to.arctangents += 1,
            Node::Wrap(_) => {
                to.multiplications += 2;
                to.additions += 3;
            }
            Node::Max(..) | Node::Select(_) => to.selections += 1,
            // All its numbers come of one call; every quartic is read for this one.
            Node::TrigRoot(_, part) => {
                let first = part.place == 0 && part.field == RootField::State;
                to.quartics += usize::from(first);
            }
        }
    }
}
