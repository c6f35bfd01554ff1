//! The expressions of a plan, and what is asked of them.

use super::FreeJoint;
use crate::expr::{Choice, Expr, Graph, Node, Operations, Tape};
use std::ops::Range;

/// The expressions of a plan. Inputs are the target (nine entries of the
/// rotation by rows, then the translation), the seed, by coordinate of q, the values of
/// the joints that the linkage has locked, the swivel angle if it comes with the target, and the
/// threshold below which joints that move are free.
#[derive(Clone, Debug)]
pub struct InverseGraph {
    /// Holds everything below.
    pub graph: Graph,
    /// One per coordinate of q that a target is solved for.
    pub q: Vec<Expr>,
    /// How far the forward kinematics is from the target, metres.
    pub residual: Expr,
    /// Positive where the branch does not exist or repeats another.
    pub invalid: Expr,
    /// Positive where a root is double or an angle is free; on an idealized arm,
    /// to what it differs from the given one.
    pub singular: Expr,
    /// How far the roots are from having no solution: the least argument of a square root
    /// by the unit of its equation, positive where the branch exists, times the discriminants of
    /// quartics; none where no root can be out of domain. Not among the outputs.
    pub margin: Option<Expr>,
    /// What the roots that may be out of domain are the roots of, by their choices and by the
    /// units of their equations; none where some are roots of quartics. Not among the outputs.
    pub arguments: Option<Vec<(Choice, Expr)>>,
    /// The residual tells this share of a miss, at least: the sine and cosine of a direction that a step
    /// turns are divided by what is constant of it, and where a target has it tilted they are those
    /// of no angle.
    pub residual_share: f64,
    /// The joints that move where they are free and the seed's value will not do.
    pub free_joints: Vec<FreeJoint>,
    /// Which of the graph's nodes belong to what.
    pub parts: Parts,
    /// All of it but the margin as instructions; outputs in the order of
    /// [`outputs`](Self::outputs).
    pub tape: Tape,
}

/// The parts of an [`InverseGraph`], in the order of its graph: each begins behind
/// this many nodes and ends where the next begins. In front of the first step
/// stand the inputs, and what is made of them before the plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Parts {
    /// By step of the plan.
    pub steps: Vec<StepPart>,
    /// Forward kinematics of what was found, against the target.
    pub residual: usize,
    /// Coordinates of q from sines and cosines.
    pub angles: usize,
}

/// The part of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepPart {
    /// How many nodes stand in front of it.
    pub begins: usize,
    /// Which of the step's relations was written; none for a sum.
    pub relation: Option<usize>,
}

impl InverseGraph {
    /// Whether a quartic is solved.
    pub fn has_quartic(&self) -> bool {
        self.arguments.is_none()
    }

    /// What its steps divide by, and the lengths of the vectors that they tell angles by: sines and
    /// cosines.
    pub(crate) fn divisors(&self) -> Vec<(Expr, Option<Expr>)> {
        self.divisors_among(0..self.graph.nodes().len())
    }

    /// Of these, those of a step.
    pub(crate) fn divisors_of(&self, step: usize) -> Vec<(Expr, Option<Expr>)> {
        let begins = self.parts.steps.iter().map(|part| part.begins);
        let bounds: Vec<usize> = begins.chain([self.parts.residual]).collect();
        self.divisors_among(bounds[step]..bounds[step + 1])
    }

    fn divisors_among(&self, places: Range<usize>) -> Vec<(Expr, Option<Expr>)> {
        let needed = self.graph.reachable(&self.outputs());
        let nodes = places.filter(|&i| needed[i]).map(|i| self.graph.nodes()[i]);
        let mut all: Vec<(Expr, Option<Expr>)> = nodes
            .filter_map(|node| match node {
                Node::Div(_, by) if self.graph.value(by).is_none() => Some(self.vector(by)),
                Node::Atan2(sine, cosine) => Some((sine, Some(cosine))),
                _ => None,
            })
            .collect();
        all.sort();
        all.dedup();
        all
    }

    /// The two components whose length an expression is, or the square of that, or itself.
    fn vector(&self, of: Expr) -> (Expr, Option<Expr>) {
        let square = |e: Expr| match self.graph.node(e) {
            Node::Mul(a, b) if a == b => Some(a),
            _ => None,
        };
        let sum = match self.graph.node(of) {
            Node::Sqrt(sum) => sum,
            _ => of,
        };
        let components = match self.graph.node(sum) {
            Node::Add(a, b) => square(a).zip(square(b)),
            _ => None,
        };
        components.map_or((of, None), |(a, b)| (a, Some(b)))
    }

    /// The operations of one branch.
    pub fn one_branch(&self) -> Operations {
        self.graph.operations(&self.outputs())
    }

    /// The operations of all branches.
    pub fn all_branches(&self) -> Operations {
        self.graph.operations_of_lanes(&self.outputs())
    }

    /// The same graph with the margin in place of all else that is returned, and only the
    /// choices that it depends on.
    pub fn of_margin(&self) -> Option<Self> {
        let margin = self.margin?;
        let mut of_margin = self.clone();
        let zero = of_margin.graph.zero();
        of_margin.q = Vec::new();
        of_margin.free_joints.clear();
        of_margin.residual = of_margin.graph.named(margin, "margin");
        [of_margin.invalid, of_margin.singular] = [zero; 2];
        of_margin.graph.keep_choices_of(&[margin]);
        Some(of_margin)
    }

    /// The same graph with the arguments of the roots in place of q, one for each choice that
    /// they depend on; none for a root that is never out of domain.
    pub fn of_arguments(&self) -> Option<(Self, Vec<Option<Expr>>)> {
        let arguments = self.arguments.as_ref()?;
        let last = arguments.iter().map(|(choice, _)| choice.0).max()?;
        let mut of_arguments = self.clone();
        let zero = of_arguments.graph.zero();
        of_arguments.free_joints.clear();
        [
            of_arguments.residual,
            of_arguments.invalid,
            of_arguments.singular,
        ] = [zero; 3];
        let mut own = |root: u8| {
            let (_, argument) = arguments.iter().find(|(choice, _)| choice.0 == root)?;
            let name = format!("argument{}", root + 1);
            Some(of_arguments.graph.named(*argument, &name))
        };
        let all: Vec<Option<Expr>> = (0..=last).map(&mut own).collect();
        of_arguments.q = all.iter().flatten().copied().collect();
        of_arguments.graph.keep_choices_of(&of_arguments.q);
        Some((of_arguments, all))
    }

    /// Everything that the emitted function returns.
    pub fn outputs(&self) -> Vec<Expr> {
        let mut all = self.q.clone();
        all.extend([self.residual, self.invalid, self.singular]);
        let said = self.free_joints.iter();
        all.extend(said.flat_map(|free| [free.level, free.no_root]));
        all
    }
}
