//! An arm: its chain, and its kinematics as expressions.

use crate::closed_form::ClosedForm;
use crate::expr::forward::{JointTrig, Outputs, link_frames, tip};
use crate::expr::jacobian::{
    Columns, TipAndColumns, Which, jacobian, jacobian_dot, tip_and_jacobian,
};
use crate::expr::linear::Motion;
use crate::expr::{Expr, Graph, Operations};
use crate::found::Found;
use crate::geometry::{Linkage, in_words, natural_target, rank, uncoupled};
use crate::model::Model;
use crate::options::{Ik, Options};
use crate::plan::Target;
use crate::redundancy::{self, Redundancy, solve_redundant};
use crate::scalar::Scalar;
use crate::singularity::Singular;
use crate::solver::{Certified, Lack, NoClosedForm, admits, solve};
use crate::spec::bounds::JOINTS;
use crate::spec::{ArmSpec, Diagnostic, Diagnostics, file_name};
use kin_runtime::__private::reproducible::reproducibly;
use std::sync::OnceLock;

/// A serial arm, compiled but not yet written as code.
#[derive(Clone, Debug)]
pub struct CompiledArm {
    /// The robot file's name, without its folders: what is generated does not
    /// depend on where the file lies.
    pub file: String,
    /// The chain.
    pub model: Model,
    /// The frames of the arm as given.
    pub linkage: Linkage,
    /// Built when they are first asked for: what is solved does not need them.
    forward: OnceLock<Forward>,
    /// Inverse kinematics; none if it was not asked for.
    pub inverse: Option<Certified>,
    /// What inverse kinematics takes beside a target; none where a target has isolated
    /// solutions.
    pub redundancy: Option<Redundancy>,
    /// Of which rows of the Jacobian singularities are looked for; none where they are not.
    rows: Option<Target>,
    /// Built when it is first asked for.
    singular: OnceLock<Option<Singular>>,
}

/// Poses as expressions of q.
#[derive(Clone, Debug)]
pub struct Poses {
    /// Holds them.
    pub graph: Graph,
    /// The coordinates of q.
    q: Vec<Expr>,
    trig: JointTrig,
    /// The tip.
    pub tip: Motion,
}

impl Poses {
    /// Of the tip alone.
    fn new(model: &Model, linkage: &Linkage) -> Self {
        let mut g = Graph::new();
        let n = model.variables.len();
        let q: Vec<Expr> = (1..=n).map(|i| g.input(format!("q{i}"))).collect();
        let trig = JointTrig::at(&mut g, linkage, &q);
        let tip = tip(&mut g, linkage, &trig);
        Self {
            graph: g,
            q,
            trig,
            tip,
        }
    }

    /// The link that each joint moves; mimics move with their coordinate.
    fn links(&mut self, model: &Model, linkage: &Linkage) -> Vec<Motion> {
        let joints: Vec<usize> = (0..self.q.len()).map(|i| model.joint_of(i)).collect();
        link_frames(&mut self.graph, linkage, &self.trig, &joints)
    }
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

/// A spatial Jacobian of more multiplications is taken from the pose and it together.
const LONGEST: usize = 80;

impl Forward {
    fn new(model: &Model, linkage: &Linkage) -> Self {
        let mut poses = Poses::new(model, linkage);
        let links = poses.links(model, linkage);
        let Poses {
            graph: mut g,
            q,
            tip,
            ..
        } = poses;
        let n = q.len();
        let both = tip_and_jacobian(&mut g, linkage, &q, Which::Spatial);
        let [spatial, body, geometric] = [Which::Spatial, Which::Body, Which::Geometric]
            .map(|which| jacobian(&mut g, linkage, &q, which));
        let dot = model.is_coupled().then(|| {
            let rates: Vec<Expr> = (1..=n).map(|i| g.input(format!("rate{i}"))).collect();
            jacobian_dot(&mut g, linkage, &q, &rates)
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

    /// The spatial Jacobian by itself; none where it is long: of a noisy arm, together with the
    /// pose it costs nothing more.
    pub fn spatial_alone(&self) -> Option<&Columns> {
        let cost = self.cost(&self.spatial.expressions());
        (cost.multiplications <= LONGEST).then_some(&self.spatial)
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

/// Compiles the arm of a robot file. If inverse kinematics is asked for and
/// there is none, the arm comes without it, and why beside it. What was found for this arm
/// before need not be searched for.
///
/// # Errors
///
/// What is wrong with the chain or the options.
pub(crate) fn compile(
    spec: &ArmSpec,
    options: &Options,
    found: Option<&Found>,
) -> Result<(CompiledArm, Option<NoClosedForm>), Diagnostics> {
    let model = options.model(spec)?;
    let joints = model.joints.len();
    if joints > JOINTS {
        let reason = format!(
            "the chain from `{}` to `{}` has {joints} joints, mimics included, and an arm has \
             {JOINTS} at most",
            model.base, model.tip
        );
        let remedy = "choose a shorter chain by `base` and `tip`";
        let diagnostic = Diagnostic::whole(reason, remedy);
        return Err(Diagnostics::one(&spec.source.path, diagnostic));
    }
    let target = options.target.unwrap_or_else(|| natural_target(&model));
    let linkage = Linkage::new(&model);
    let free = redundancy::named(spec, &model, target, &options.free)?;
    if options.ik == Ik::None && !options.free.is_empty() {
        let reason = "without inverse kinematics no joint stays free";
        let remedy = "leave out one of the two: `free`, or `ik = none`";
        let diagnostic = Diagnostic::whole(reason, remedy);
        return Err(Diagnostics::one(&spec.source.path, diagnostic));
    }
    let is_redundant = redundancy::is_redundant(&model, target, &free);
    let known = found.and_then(|found| {
        let certified = found.built(&model, &linkage)?;
        Some((certified, found.redundancy().cloned()))
    });
    let solved = match options.ik {
        Ik::None => Ok(None),
        Ik::ClosedForm if known.is_some() => Ok(known),
        Ik::ClosedForm if is_redundant && options.scalar == Scalar::F32 => {
            Err(NoClosedForm::OnlyInDouble(Lack::Parameter))
        }
        Ik::ClosedForm => admits(&model, target).and_then(|()| match is_redundant {
            true => solve_redundant(&model, &linkage, target, &free)
                .map(|(found, redundancy)| Some((found, Some(redundancy)))),
            false => solve(&model, &linkage, target).map(|found| Some((found, None))),
        }),
    };
    let (solved, refused) = match solved {
        Ok(solved) => (solved, None),
        Err(reason) => (None, Some(reason)),
    };
    let (inverse, redundancy) = solved.unzip();
    let file = file_name(&spec.source.path);
    let arm = CompiledArm {
        rows: Some(target),
        redundancy: redundancy.flatten(),
        ..CompiledArm::new(file, model, linkage, inverse)
    };
    Ok((arm, refused))
}

impl CompiledArm {
    /// From a chain and what was found to invert it; its singularities are not
    /// looked for.
    pub(crate) fn new(
        file: &str,
        model: Model,
        linkage: Linkage,
        inverse: Option<Certified>,
    ) -> Self {
        Self {
            file: file.to_owned(),
            forward: OnceLock::new(),
            model,
            linkage,
            inverse,
            redundancy: None,
            rows: None,
            singular: OnceLock::new(),
        }
    }

    /// What does not follow from the robot file; none without inverse kinematics.
    pub fn found(&self) -> Option<Found> {
        let inverse = self.inverse.as_ref()?;
        Some(Found::of(inverse, self.redundancy.as_ref()))
    }

    /// The pose of the tip alone, as [`CompiledArm::forward`] has it.
    pub fn poses(&self) -> Poses {
        Poses::new(&self.model, &self.linkage)
    }

    /// The same with those of the links.
    pub fn poses_of_links(&self) -> (Poses, Vec<Motion>) {
        let mut poses = self.poses();
        let links = poses.links(&self.model, &self.linkage);
        (poses, links)
    }

    /// Forward kinematics and Jacobians.
    pub fn forward(&self) -> &Forward {
        let build = || reproducibly(|| Forward::new(&self.model, &self.linkage));
        self.forward.get_or_init(build)
    }

    /// Determinant and singularities; none if no square Jacobian is there.
    pub fn singular(&self) -> Option<&Singular> {
        let build = || {
            // A redundant one was idealized for the others alone.
            let whole = self.form().filter(|_| self.redundancy.is_none());
            let idealized = whole.filter(|form| !form.is_exact());
            let idealized = idealized.map(|form| &form.idealized.model);
            let found = |rows| Singular::new(&self.model, &self.linkage, idealized, rows);
            reproducibly(|| self.rows.and_then(found))
        };
        self.singular.get_or_init(build).as_ref()
    }

    /// The names of the joints that stay free, or of the swivel, as the option `free` has them.
    pub fn free_joints(&self) -> Vec<String> {
        let redundancy = self.redundancy.iter();
        let swivel = redundancy.clone().filter(|it| it.swivel.is_some());
        let swivel = swivel.map(|_| redundancy::SWIVEL.to_owned());
        let joints = redundancy.flat_map(|redundancy| &redundancy.joints);
        let names = joints.map(|&joint| self.model.variables[joint].name.clone());
        names.chain(swivel).collect()
    }

    /// The closed form; none without inverse kinematics.
    pub fn form(&self) -> Option<&ClosedForm> {
        self.inverse.as_ref().map(|certified| &certified.form)
    }

    /// How many branches `ik` looks at; 0 without it.
    pub fn branches(&self) -> usize {
        let isolated = self.form().filter(|_| self.redundancy.is_none());
        isolated.map_or(0, |form| form.plan.branches())
    }

    /// What of targets counts, as sentences; none where joints that move the tip in all six ways have
    /// whole poses for targets.
    pub fn targets(&self) -> Option<String> {
        let joints = self.model.variables.len();
        let target = self.target();
        if target != Target::Pose {
            return Some(format!(
                "Targets are {}: the rest of a pose is not read.",
                target.phrase()
            ));
        }
        let ways = self.ways();
        if ways >= target.coordinates() {
            return None;
        }
        let moving = match ways == joints {
            true => String::new(),
            false => format!(" that move the tip in {}", in_words(ways)),
        };
        let reached = format!(
            "Targets are whole poses. With {joints} joints{moving} few of them are within reach, \
             those of `fk`, and no others have solutions."
        );
        let Some(fits) = self.fitting() else {
            return Some(reached);
        };
        Some(format!(
            "{reached} With `target = {}` they are {}.",
            fits.word(),
            fits.phrase()
        ))
    }

    /// How many joints are solved for.
    fn ways(&self) -> usize {
        let given = self.redundancy.as_ref().map_or(0, Redundancy::parameters);
        self.model.variables.len() - given
    }

    /// What the joints can choose all of, where they are fewer than a pose has coordinates: as many
    /// of these as there are joints, or a position with joints that stay free.
    pub fn fitting(&self) -> Option<Target> {
        let joints = self.model.variables.len();
        // Joints that mimic others are solved as if they moved by themselves, and none stays free.
        let coupled = self.model.is_coupled().then(|| uncoupled(&self.model));
        let chooses = |target: &Target| {
            let coordinates = target.coordinates();
            let moves_all = match &coupled {
                Some(uncoupled) => {
                    let own = uncoupled.as_ref().map(|(model, _)| model.joints.len());
                    joints == coordinates && own == Ok(coordinates)
                }
                None => joints >= coordinates && rank(&self.model, *target) == coordinates,
            };
            moves_all && admits(&self.model, *target).is_ok()
        };
        let tried: &[Target] = match self.ways() {
            5 => &[Target::PositionAxis, Target::Position],
            4 => &[Target::PositionYaw, Target::Position],
            3 => &[Target::Position],
            _ => &[],
        };
        tried.iter().copied().find(chooses)
    }

    /// What of targets counts: the whole pose unless said otherwise.
    pub fn target(&self) -> Target {
        match &self.redundancy {
            Some(redundancy) => redundancy.target,
            None => self.form().map_or(Target::Pose, |form| form.plan.target),
        }
    }
}
