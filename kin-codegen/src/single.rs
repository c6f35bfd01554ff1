//! Branches in single precision, corrected as generated code corrects them.

use crate::expr::forward::Outputs;
use crate::expr::jacobian::{Which, tip_and_jacobian};
use crate::expr::{Expr, Graph, Tape};
use crate::geometry::Linkage;
use crate::scalar::Scalar;
use kin_runtime::single::__private::Acceptance;
use kin_runtime::single::__private::refinement::{Problem, correct_branches};
use kin_runtime::single::{Jacobian, Pose, Solution, Target};
use kin_runtime::{self as double, Solutions};

/// The pose and the spatial Jacobian of an arm in `f32`.
#[derive(Clone, Debug)]
pub struct Forward(Tape);

impl Forward {
    /// By the expressions that are generated.
    pub fn new(linkage: &Linkage, coordinates: usize) -> Self {
        let mut graph = Graph::new();
        let q: Vec<Expr> = (0..coordinates)
            .map(|i| graph.input(format!("q{}", i + 1)))
            .collect();
        let both = tip_and_jacobian(&mut graph, linkage, &q, Which::Spatial);
        Self(Tape::new(&graph, &both.expressions()).of(Scalar::F32))
    }

    fn at<const N: usize>(&self, q: &[f32; N]) -> (Pose, Jacobian<N>) {
        let lanes = self.0.run::<1>(&q.map(f64::from), 0);
        let number = |i: usize| lanes.output(i)[0] as f32;
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| number(3 * i + j)));
        let pose = Pose {
            rotation,
            translation: std::array::from_fn(|i| number(9 + i)),
        };
        let rows = std::array::from_fn(|i| std::array::from_fn(|j| number(12 + 6 * j + i)));
        (pose, Jacobian { rows })
    }

    /// The branches that reach their target, those that nearly do after a correction; where one
    /// is singular, `seed` may be as well.
    pub fn corrected<const N: usize>(
        &self,
        target: &double::Pose,
        counts: double::Target,
        branches: impl Iterator<Item = double::Solution<N>> + Clone,
        seed: &[f64; N],
        accept: &double::__private::Acceptance,
    ) -> Solutions<N> {
        let accept = Acceptance {
            size: accept.size as f32,
            tolerance: accept.tolerance as f32,
            taken: accept.taken as f32,
            nearly: accept.nearly as f32,
            near_singular: 0.0,
            prismatic: accept.prismatic,
        };
        let target = Pose::from(*target);
        let problem = Problem::new(|q: &[f32; N]| self.at(q), &target, counted(counts), &accept);
        let branches = branches.map(|branch| Solution {
            q: branch.q.map(|x| x as f32),
            residual: branch.residual as f32,
            branch: branch.branch,
            singular: branch.singular,
        });
        let seed = seed.map(|x| x as f32);
        let found = correct_branches(&problem, branches, &seed, &accept);
        Solutions::build_with_prismatic(accept.prismatic, |solutions| {
            for solution in &found {
                let of_double = double::Solution {
                    q: solution.q.map(f64::from),
                    residual: solution.residual.into(),
                    branch: solution.branch,
                    singular: solution.singular,
                };
                solutions.push_if(true, of_double);
            }
        })
    }
}

fn counted(target: double::Target) -> Target {
    match target {
        double::Target::Pose => Target::Pose,
        double::Target::Position => Target::Position,
        double::Target::PositionAxis => Target::PositionAxis,
        double::Target::PositionYaw => Target::PositionYaw,
        double::Target::Planar => Target::Planar,
        double::Target::Direction => Target::Direction,
        double::Target::Orientation => Target::Orientation,
    }
}
