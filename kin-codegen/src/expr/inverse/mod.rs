//! A plan as expressions: from the target pose to all branches.
//!
//! Every step becomes straight-line algebra on sines and cosines; the two
//! signs of a square root are one [choice](crate::expr::Choice). Angles are
//! taken once, at the end. An out-of-domain root marks its branches invalid
//! instead of producing NaN, a double root keeps one of its two branches, and
//! every branch has its residual: the forward kinematics of what was
//! found against the target that was asked for.

mod deviation;
mod free;
mod line;
mod pair;
mod parity;
mod project;
mod root;
mod rotate;
mod slide;
mod solve;
mod swivel;
mod transport;

use deviation::Deviation;
pub use free::{FreeAngle, FreeAngles};

use super::forward::{self, JointTrig, subscript};
use super::linear::{Motion, Trig};
use super::{Choice, Expr, Fusing, Graph, Node, Operations, Tangent, Tape};
use crate::geometry::Linkage;
use crate::model::JointKind;
use crate::plan::{Atom, Plan, Step, Subproblem, Target};
use crate::scalar::Tolerances;
use kin_runtime::Pose;

/// How far the arm that the plan is for is from the given one: the shift of its tip by the
/// arm's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DomainMargin(pub f64);

/// The expressions of a plan. Inputs are the target (nine entries of the
/// rotation by rows, then the translation), the seed, by coordinate of q, the values of
/// the joints that the linkage has locked, the swivel angle if it comes with the target, and if
/// an angle turns, the threshold below
/// which it is free.
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
    /// by the unit of its equation, positive where the branch exists; none where no root can be out of
    /// domain. Not among the outputs.
    pub margin: Option<Expr>,
    /// What the roots that may be out of domain are the roots of, by their choices and by the
    /// units of their equations; none where some are roots of quartics. Not among the outputs.
    pub arguments: Option<Vec<(Choice, Expr)>>,
    /// The angle that turns where it is free and the seed's value will not do.
    pub free_angle: Option<FreeAngle>,
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

    /// Whether the branches of an idealized arm are never known to be all there are.
    pub fn tells_nothing(&self) -> bool {
        self.graph.is(self.singular, 1.0)
    }

    /// What its steps divide by, and the lengths of the vectors that they tell angles by: sines and
    /// cosines.
    pub(crate) fn divisors(&self) -> Vec<(Expr, Option<Expr>)> {
        let needed = self.graph.reachable(&self.outputs());
        let nodes = self.graph.nodes().iter().zip(needed);
        let divided = nodes.filter(|(_, needed)| *needed);
        let mut all: Vec<(Expr, Option<Expr>)> = divided
            .filter_map(|(node, _)| match *node {
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
        of_margin.free_angle = None;
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
        of_arguments.free_angle = None;
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
        all.extend(
            self.free_angle
                .iter()
                .flat_map(|free| [free.level, free.no_root]),
        );
        all
    }
}

/// Writes the plan for a linkage whose tip is at `tip` at home.
///
/// `margin` is 0 when the linkage is exact. On an idealized linkage it is the
/// tolerance of the snapping: roots out of domain by less stay alive, because
/// refinement on the given arm may still reach them.
pub fn inverse(
    linkage: &Linkage,
    plan: &Plan,
    margin: DomainMargin,
    free: FreeAngles,
) -> InverseGraph {
    let mut writer = Writer::new(linkage, plan.target, margin);
    let free_angle = writer.write_all(plan, free);
    writer.finish(free_angle)
}

/// What all branches of a plan cost, by [`Operations::weight`], but for their residuals: these
/// take about as much after every plan of an arm.
pub fn weight(linkage: &Linkage, plan: &Plan) -> usize {
    let mut writer = Writer::new(linkage, plan.target, DomainMargin(0.0));
    writer.write_all(plan, FreeAngles::Seeded);
    let mut outputs = writer.angles();
    outputs.extend([writer.invalid, writer.singular]);
    writer.g.operations_of_lanes(&outputs).weight()
}

/// What is known of the loop so far.
#[derive(Clone)]
struct Writer<'a> {
    g: Graph,
    linkage: &'a Linkage,
    /// The tip at home, base coordinates.
    tip: Pose,
    target: Target,
    /// What the digits of the scalar allow.
    tolerances: Tolerances,
    /// As it was given.
    given: Motion,
    /// The whole pose that it stands for.
    pose: Motion,
    /// What a free angle keeps, by coordinate of q.
    seed: Vec<Expr>,
    /// How far the joints that come with the target have moved.
    parameters: Vec<Expr>,
    /// Sine and cosine of the swivel angle, if it comes with the target.
    swivel: Option<Trig>,
    /// On an idealized arm.
    deviation: Option<Deviation>,
    /// See [`FreeAngles::Flagged`].
    flags_badly_told: bool,
    /// By joint: the sine and cosine of its motion.
    trig: Vec<Option<Trig>>,
    /// By joint: how far it slides.
    slide: Vec<Option<Expr>>,
    /// By run: the sine and cosine of the sum of its angles.
    sum: Vec<Option<Trig>>,
    /// By run: whether the sum was solved before its joints.
    sum_first: Vec<bool>,
    invalid: Expr,
    singular: Expr,
    /// See [`InverseGraph::margin`].
    margin: Option<Expr>,
    /// See [`InverseGraph::arguments`].
    arguments: Option<Vec<(Choice, Expr)>>,
    /// What has been held against which threshold to flag singularity.
    watched: Vec<(Expr, Expr)>,
    /// Vectors shorter than this, squared and relative to their scale, leave the
    /// angle of the step at hand free.
    free: Expr,
    /// The unknown of the step just written whose angle may be free.
    may_be_free: Option<MayBeFree>,
    /// The cosine-sine equation of the step just written, where its root can
    /// leave the domain.
    level: Option<Level>,
    /// Which relation of the step written last was the cheapest.
    relation: Option<usize>,
    parts: Parts,
}

/// An unknown whose angle is free where a factor is nothing beside its scale.
#[derive(Clone, Copy)]
struct MayBeFree {
    unknown: Atom,
    factor: Expr,
    scale: Expr,
}

/// The root of a cosine-sine equation is real where d² ≤ a² + b².
#[derive(Clone, Copy)]
struct Level {
    /// d.
    d: Expr,
    /// a² + b².
    amplitude: Expr,
    /// a² + b² − d².
    discriminant: Expr,
}

impl<'a> Writer<'a> {
    fn new(linkage: &'a Linkage, target: Target, margin: DomainMargin) -> Self {
        let mut g = Graph::new();
        let rotation = [1, 2, 3].map(|i| [1, 2, 3].map(|j| g.input(format!("r{i}{j}"))));
        let translation = ["px", "py", "pz"].map(|name| g.input(name));
        let given = Motion {
            rotation,
            translation,
        };
        let pose = project::projected(&mut g, linkage, target, given);
        let solved = (0..linkage.links.len()).filter(|&joint| linkage.coordinate(joint).is_some());
        let mut numbers: Vec<usize> = solved.map(|j| linkage.links[j].variable + 1).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let seed = numbers
            .into_iter()
            .map(|i| g.input(format!("seed{i}")))
            .collect();
        let deviation = (margin.0 > 0.0).then(|| Deviation::new(&mut g, linkage, &given, margin.0));
        let zero = g.zero();
        let n = linkage.links.len();
        Self {
            g,
            linkage,
            tip: linkage.tip_home(),
            target,
            tolerances: linkage.scalar.tolerances(),
            given,
            pose,
            seed,
            parameters: Vec::new(),
            swivel: None,
            deviation,
            flags_badly_told: false,
            trig: vec![None; n],
            slide: vec![None; n],
            sum: vec![None; linkage.runs.len()],
            sum_first: vec![false; linkage.runs.len()],
            invalid: zero,
            singular: zero,
            margin: None,
            arguments: Some(Vec::new()),
            watched: Vec::new(),
            free: zero,
            may_be_free: None,
            level: None,
            relation: None,
            parts: Parts::default(),
        }
    }

    /// The joints that come with the target, as if they were solved.
    fn take_parameters(&mut self) {
        for &joint in &self.linkage.locked {
            let link = &self.linkage.links[joint];
            let (kind, gain, offset) = (link.kind, link.gain, link.offset);
            let value = self.g.input(format!("parameter{}", link.variable + 1));
            let moved = forward::joint_value(&mut self.g, gain, offset, value);
            self.parameters.push(moved);
            match kind {
                JointKind::Revolute => {
                    let (sin, cos) = self.g.sin_cos(moved);
                    self.set(Atom::Joint(joint), Trig { sin, cos });
                }
                JointKind::Prismatic => {
                    self.slide[joint] = Some(moved);
                    if self.target == Target::Planar {
                        self.pose =
                            project::lifted(&mut self.g, self.linkage, self.pose, joint, value);
                    }
                }
            }
        }
        self.swivel = self.linkage.swivel.map(|_| {
            let angle = self.g.input("swivel");
            let one = self.g.one();
            if let Some(deviation) = &mut self.deviation {
                deviation.directions.push(Tangent::new([(angle, one)]));
            }
            let (sin, cos) = self.g.sin_cos(angle);
            Trig { sin, cos }
        });
    }

    /// Of the relations that pose a step, the one that costs least is written.
    fn write(&mut self, step: &Step) {
        if step.subproblem == Subproblem::Sum {
            if let [Atom::Joint(joint)] = step.unknowns[..] {
                self.difference(joint);
            }
            return;
        }
        let cost = |i: &usize| {
            let before = self.g.mark();
            let mut trial = self.beside();
            trial.solve(step, &step.relations[*i]);
            let cost = trial.cost();
            self.g = std::mem::take(&mut trial.g);
            self.g.back(before);
            cost
        };
        let best = match step.relations.len() {
            one @ (0 | 1) => one.checked_sub(1),
            several => (0..several).min_by_key(cost),
        };
        if let Some(i) = best {
            self.solve(step, &step.relations[i]);
            self.relation = Some(i);
        }
    }

    /// The same, and the graph with it.
    fn beside(&mut self) -> Self {
        let g = std::mem::take(&mut self.g);
        let beside = self.clone();
        Self { g, ..beside }
    }

    /// The cost of everything solved so far.
    fn cost(&self) -> usize {
        let trig = self.trig.iter().chain(&self.sum).flatten();
        let mut outputs: Vec<Expr> = trig.flat_map(|t| [t.sin, t.cos]).collect();
        outputs.extend(self.slide.iter().flatten());
        self.g.operations(&outputs).weight()
    }

    fn set(&mut self, atom: Atom, trig: Trig) {
        let name = self.symbol(atom);
        let sin = self.g.named(trig.sin, format!("s{name}"));
        let cos = self.g.named(trig.cos, format!("c{name}"));
        let trig = Trig { sin, cos };
        match atom {
            Atom::Joint(joint) => self.trig[joint] = Some(trig),
            Atom::Sum { run, .. } => {
                self.sum[run] = Some(trig);
                self.sum_first[run] = true;
            }
        }
    }

    /// The angle that the seed has for an unknown.
    fn seeded(&mut self, atom: Atom) -> Trig {
        let joints = match atom {
            Atom::Joint(joint) => vec![joint],
            Atom::Sum { run, .. } => self.linkage.revolutes_of(run),
        };
        let mut angle = self.g.zero();
        for joint in joints {
            let link = &self.linkage.links[joint];
            let mut locked = self.linkage.locked.iter();
            let own = match (
                self.linkage.coordinate(joint),
                locked.position(|&locked| locked == joint),
            ) {
                (Some(i), _) => {
                    forward::joint_value(&mut self.g, link.gain, link.offset, self.seed[i])
                }
                (None, Some(k)) => self.parameters[k],
                (None, None) => continue,
            };
            angle = self.g.add(angle, own);
        }
        let (sin, cos) = self.g.sin_cos(angle);
        Trig { sin, cos }
    }

    fn symbol(&self, atom: Atom) -> String {
        match atom {
            Atom::Joint(joint) => subscript(joint),
            Atom::Sum { first, last, .. } => (first..=last)
                .filter(|&j| self.linkage.is_revolute(j))
                .map(subscript)
                .collect(),
        }
    }

    /// The last joint of a run whose sum is known: its angle is the rest.
    fn difference(&mut self, joint: usize) {
        let run = self.linkage.run_of(joint);
        let Some(mut rest) = self.sum[run] else {
            return;
        };
        for other in self.linkage.revolutes_of(run) {
            if let (true, Some(known)) = (other != joint, self.trig[other]) {
                let back = self.g.reverse(known);
                rest = self.g.angle_sum(rest, back);
            }
        }
        self.trig[joint] = Some(rest);
    }

    /// The sum of a run's angles, if all of them are known.
    fn run_sum(&mut self, run: usize) -> Option<Trig> {
        if self.sum[run].is_none() {
            let joints = self.linkage.revolutes_of(run);
            let known: Option<Vec<Trig>> = joints.iter().map(|&j| self.trig[j]).collect();
            let mut known = known?.into_iter();
            let first = known.next()?;
            self.sum[run] = Some(known.fold(first, |a, b| self.g.angle_sum(a, b)));
        }
        self.sum[run]
    }

    /// All steps, and the angle that turns where it is free.
    fn write_all(&mut self, plan: &Plan, free: FreeAngles) -> Option<FreeAngle> {
        self.take_parameters();
        self.flags_badly_told = free == FreeAngles::Flagged;
        let mut turned: Option<MayBeFree> = None;
        let mut free_angle = None;
        for (i, step) in plan.steps.iter().enumerate() {
            let begins = self.g.nodes().len();
            self.may_be_free = None;
            self.level = None;
            let turns = free == FreeAngles::TurnedAt(i);
            self.free = match turns {
                true => self.g.input("free"),
                false => self.g.constant(self.tolerances.free_below),
            };
            self.write(step);
            if turns {
                turned = self.may_be_free;
            } else if let (Some(turned), None) = (turned, free_angle) {
                free_angle = self.said_of(turned, plan);
            }
            let relation = self.relation.take();
            self.parts.steps.push(StepPart { begins, relation });
        }
        free_angle
    }

    fn finish(mut self, free_angle: Option<FreeAngle>) -> InverseGraph {
        self.parts.residual = self.g.nodes().len();
        let residual = self.residual();
        self.parts.angles = self.g.nodes().len();
        let q = self.angles();
        let mut inverse = InverseGraph {
            parts: self.parts,
            q,
            residual: self.g.named(residual, "residual"),
            invalid: self.g.named(self.invalid, "invalid"),
            singular: self.g.named(self.singular, "singular"),
            margin: self.margin,
            arguments: self.arguments,
            free_angle,
            graph: self.g,
            tape: Tape::default(),
        };
        inverse = parity::signs_outwards(&inverse);
        let tape = Tape::new(&inverse.graph, &inverse.outputs());
        inverse.tape = tape.of(self.linkage.scalar).fusing(Fusing::Lanes);
        inverse
    }

    /// Angles from sines and cosines; the last of a sum as a difference.
    fn angles(&mut self) -> Vec<Expr> {
        let zero = self.g.zero();
        let mut q = vec![zero; self.linkage.variables()];
        for run in 0..self.linkage.runs.len() {
            for joint in self.linkage.runs[run].joints.clone() {
                let link = &self.linkage.links[joint];
                let Some(coordinate) = self.linkage.coordinate(joint) else {
                    continue;
                };
                let value = match link.kind {
                    JointKind::Prismatic => {
                        let slide = self.slide[joint].unwrap_or(zero);
                        let offset = self.g.constant(link.offset);
                        self.g.sub(slide, offset)
                    }
                    JointKind::Revolute => self.turned(joint),
                };
                let symbol = format!("q{}", link.variable + 1);
                q[coordinate] = self.g.named(value, symbol);
            }
        }
        q
    }

    /// q of a joint that turns: its angle without the offset, and in the sense
    /// of its own axis, in (−π, π].
    fn turned(&mut self, joint: usize) -> Expr {
        let link = &self.linkage.links[joint];
        let (backwards, offset) = (link.gain < 0.0, link.offset);
        let Some(mut trig) = self.trig[joint] else {
            return self.g.zero();
        };
        if backwards {
            trig = self.g.reverse(trig);
        }
        let angle = self.g.atan2(trig.sin, trig.cos);
        let offset = self.g.constant(if backwards { offset } else { -offset });
        let value = self.g.add(angle, offset);
        self.g.wrap(value)
    }

    /// The distance of forward kinematics from the target: translation error
    /// and rotation angle times the arm's size, as the legs of a right
    /// triangle, and what the target itself is uncertain by. A sum, so that a
    /// NaN anywhere is a NaN here.
    fn residual(&mut self) -> Expr {
        let trig = self.joint_trig();
        let found = forward::tip(&mut self.g, self.linkage, &trig);
        let wanted = self.pose;
        let zero = self.g.zero();
        let mut squares = self.uncertainty();
        if !self.target.is_free() || self.target.fixes_point() {
            let shift = self.g.minus(found.translation, wanted.translation);
            let shift = self.g.dot(shift, shift);
            squares = self.g.add(squares, shift);
        }
        let columns = match self.target {
            Target::Position => 3..3,
            Target::PositionAxis | Target::Direction => 2..3,
            _ => 0..3,
        };
        // The Frobenius norm of a small rotation's difference is √2 θ; a single
        // column's difference is θ itself.
        let share = if columns.len() == 3 { 0.5 } else { 1.0 };
        let mut turn = zero;
        for (row, wanted) in found.rotation.iter().zip(&wanted.rotation) {
            for j in columns.clone() {
                let d = self.g.sub(row[j], wanted[j]);
                let d = self.g.square(d);
                turn = self.g.add(turn, d);
            }
        }
        let scale = self.g.constant(share * self.linkage.size.powi(2));
        let turn = self.g.mul(scale, turn);
        squares = self.g.add(squares, turn);
        self.g.sqrt(squares)
    }

    /// By how much the target is no pose, as the square of a length: what its
    /// columns miss of a rotation, and the last digit of its translation.
    /// Sines and cosines that solve for such a target are not those of angles,
    /// so that forward kinematics would confirm them. Of what the plan reads,
    /// nothing is left out.
    fn uncertainty(&mut self) -> Expr {
        let Motion {
            rotation,
            translation,
        } = self.given;
        let zero = self.g.zero();
        let mut squares = zero;
        if !self.target.is_free() || self.target.fixes_point() {
            let square = self.g.dot(translation, translation);
            squares = self.scaled(self.tolerances.epsilon * self.tolerances.epsilon, square);
        }
        let column = |j: usize| [0, 1, 2].map(|i| rotation[i][j]);
        let [one, half] = [1.0, 0.5].map(|k| self.g.constant(k));
        let mut missing = Vec::new();
        let mut length = |g: &mut Graph, v| {
            let square = g.dot(v, v);
            let over = g.sub(square, one);
            missing.push(g.mul(half, over));
        };
        match self.target {
            Target::Position => {}
            Target::PositionAxis | Target::Direction => length(&mut self.g, column(2)),
            _ => {
                let [x, y, z] = [0, 1, 2].map(column);
                length(&mut self.g, x);
                length(&mut self.g, y);
                missing.push(self.g.dot(x, y));
                let normal = self.g.cross(x, y);
                missing.extend(self.g.minus(z, normal));
            }
        }
        let mut turn = zero;
        for part in missing {
            let square = self.g.square(part);
            turn = self.g.add(turn, square);
        }
        let turn = self.scaled(self.linkage.size.powi(2), turn);
        self.g.add(squares, turn)
    }

    /// What was solved, as forward kinematics wants it.
    fn joint_trig(&mut self) -> JointTrig {
        let rest = Trig {
            sin: self.g.zero(),
            cos: self.g.one(),
        };
        let mut sums = Vec::new();
        let mut slides = Vec::new();
        for run in 0..self.linkage.runs.len() {
            let last = self.linkage.revolutes_of(run).last().copied();
            let mut sum: Option<Trig> = None;
            for joint in self.linkage.runs[run].joints.clone() {
                let whole = Some(joint) == last && self.sum_first[run];
                if whole {
                    sum = self.sum[run];
                } else if let Some(own) = self.trig[joint] {
                    sum = Some(match sum {
                        Some(before) => self.g.angle_sum(before, own),
                        None => own,
                    });
                }
                sums.push(sum.unwrap_or(rest));
                let zero = self.g.zero();
                slides.push(self.slide[joint].unwrap_or(zero));
            }
        }
        JointTrig { sums, slides }
    }
}
