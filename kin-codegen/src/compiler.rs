//! The whole way from a robot file to verified expressions.

use crate::expr::forward::{Outputs, Stance, link_frames, tip};
use crate::expr::jacobian::{
    Columns, TipAndColumns, Which, jacobian, jacobian_dot, tip_and_jacobian,
};
use crate::expr::linear::Motion;
use crate::expr::{Expr, Graph, Operations};
use crate::geometry::Linkage;
use crate::model::Model;
use crate::options::{Ik, Options};
use crate::plan::Target;
use crate::refusal;
use crate::singularity::Singular;
use crate::solver::{ClosedForm, solve};
use crate::spec::{Diagnostics, Source, Spec};
use crate::verify::natural_target;

/// A robot, compiled but not yet written as Rust.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The robot file, as the user named it.
    pub path: String,
    /// The chain.
    pub model: Model,
    /// The frames of the literal arm.
    pub linkage: Linkage,
    /// Forward kinematics and Jacobians.
    pub forward: Forward,
    /// Inverse kinematics; none if it was not asked for.
    pub inverse: Option<ClosedForm>,
    /// Determinant and singularities; none if no square Jacobian is there.
    pub singular: Option<Singular>,
}

/// Forward kinematics and Jacobians as expressions of q.
#[derive(Clone, Debug)]
pub struct Forward {
    /// Holds everything below; the inputs are the coordinates of q, and for
    /// `dot` their rates behind them.
    pub graph: Graph,
    /// The tip.
    pub tip: Motion,
    /// The link that each joint moves; mimics move with their coordinate.
    pub links: Vec<Motion>,
    /// J_s.
    pub spatial: Columns,
    /// J_b.
    pub body: Columns,
    /// The geometric Jacobian.
    pub geometric: Columns,
    /// The tip and J_s, sharing what they can.
    pub both: TipAndColumns,
    /// The time derivative of J_s, where joints mimic others. Elsewhere the
    /// runtime has it from J_s, which costs as much time and no code.
    pub dot: Option<Columns>,
}

impl Forward {
    fn new(model: &Model, linkage: &Linkage) -> Self {
        let mut g = Graph::new();
        let n = model.variables.len();
        let q: Vec<Expr> = (1..=n).map(|i| g.input(format!("q{i}"))).collect();
        let stance = Stance::at(&mut g, linkage, &q);
        let tip = tip(&mut g, linkage, &stance);
        let joints: Vec<usize> = (0..n)
            .map(|variable| {
                let own = |i: &usize| model.joints[*i].is_coordinate(variable);
                (0..model.joints.len()).find(own).unwrap_or(variable)
            })
            .collect();
        let links = link_frames(&mut g, linkage, &stance, &joints);
        let both = tip_and_jacobian(&mut g, linkage, &stance, Which::Spatial);
        let [spatial, body, geometric] = [Which::Spatial, Which::Body, Which::Geometric]
            .map(|which| jacobian(&mut g, linkage, &stance, which));
        let dot = model.is_coupled().then(|| {
            let rates: Vec<Expr> = (1..=n).map(|i| g.input(format!("rate{i}"))).collect();
            jacobian_dot(&mut g, linkage, &stance, &rates)
        });
        Self {
            graph: g,
            tip,
            links,
            spatial,
            body,
            geometric,
            both,
            dot,
        }
    }

    /// What it takes to compute some of the expressions.
    pub fn cost(&self, outputs: &[Expr]) -> Operations {
        self.graph.operations(outputs)
    }

    /// The cost of forward kinematics alone.
    pub fn tip_cost(&self) -> Operations {
        self.cost(&self.tip.expressions())
    }

    /// The cost of forward kinematics with the spatial Jacobian.
    pub fn tip_and_jacobian_cost(&self) -> Operations {
        self.cost(&self.both.expressions())
    }
}

/// Reads a robot file and compiles it.
///
/// # Errors
///
/// What is wrong with the file or the options, or why the arm has no closed
/// form.
pub fn compile(source: &Source, options: &Options) -> Result<Compiled, Diagnostics> {
    let spec = Spec::parse(source)?;
    let model = Model::new(&spec, options.base.as_deref(), options.tip.as_deref())?;
    refusal::singular_everywhere(source, &model)?;
    let target = options.target.unwrap_or_else(|| natural_target(&model));
    let inverse = match options.ik {
        Ik::None => None,
        Ik::ClosedForm => {
            let solver = solve(&model, target);
            Some(
                solver
                    .map_err(|reason| refusal::no_closed_form(source, &model, target, &reason))?,
            )
        }
    };
    let meant = inverse.as_ref().filter(|solver| solver.polish > 0);
    let singular = Singular::new(&model, meant.map(|solver| &solver.snap.model), target);
    Ok(Compiled {
        singular,
        ..Compiled::of(&source.path, model, inverse)
    })
}

impl Compiled {
    /// From a chain and what was found to invert it; its singularities are not
    /// looked for.
    pub(crate) fn of(path: &str, model: Model, inverse: Option<ClosedForm>) -> Self {
        let linkage = Linkage::new(&model);
        Self {
            path: path.to_owned(),
            forward: Forward::new(&model, &linkage),
            model,
            linkage,
            inverse,
            singular: None,
        }
    }

    /// How many branches inverse kinematics looks at; 0 without it.
    pub fn branches(&self) -> usize {
        self.inverse
            .as_ref()
            .map_or(0, |solver| solver.plan.branches())
    }

    /// What `q` stands for in targets: the whole pose unless said otherwise.
    pub fn target(&self) -> Target {
        self.inverse
            .as_ref()
            .map_or(Target::Pose, |solver| solver.plan.target)
    }
}
