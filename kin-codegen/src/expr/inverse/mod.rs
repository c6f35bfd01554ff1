//! A plan as expressions: from the target pose to all branches.
//!
//! Every step becomes straight-line algebra on sines and cosines; the two
//! signs of a square root are one [choice](crate::expr::Choice). Angles are
//! taken once, at the end. An out-of-domain root marks its branches invalid
//! instead of producing NaN, a double root keeps one of its two branches, and
//! every branch has its residual: the forward kinematics of what was
//! found against the target that was asked for.

mod coupled;
mod deviation;
mod free;
mod graph;
mod line;
mod pair;
mod parity;
mod project;
mod quartic;
mod root;
mod rotate;
mod seed;
mod slide;
mod solve;
mod swivel;
mod transport;

use deviation::Deviation;
pub use free::{FreeJoint, FreeJoints, Turn};
pub use graph::{InverseGraph, Parts, StepPart};

use super::forward::{self, JointTrig, subscript};
use super::linear::{Motion, Trig};
use super::{Choice, Expr, Fusing, Graph, Tangent, Tape};
use crate::geometry::Linkage;
use crate::model::JointKind;
use crate::plan::{Atom, Plan, Step, Subproblem, Target};
use crate::scalar::Tolerances;
use kin_runtime::Pose;

/// How far the arm that the plan is for is from the given one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipShift {
    /// By the arm's size.
    pub relative: f64,
    /// Whether its branches are starts, from which solutions of the given arm are found.
    pub is_refined: bool,
}

impl TipShift {
    /// They are the same.
    pub const NONE: Self = Self {
        relative: 0.0,
        is_refined: false,
    };

    /// What can be told under a root of an arm that is the given one only to this. The
    /// factors are what arms of eleven and twelve digits needed where they are singular.
    fn told(self, by_digits: Tolerances) -> Tolerances {
        if self.is_refined {
            return by_digits;
        }
        Tolerances {
            double_root: by_digits.double_root.max(4.0 * self.relative),
            free_below: by_digits.free_below.max((2.0 * self.relative).powi(2)),
            ..by_digits
        }
    }
}

/// Writes the plan for a linkage whose tip is at `tip` at home.
///
/// Where solutions are refined, branches of which a root is out of its domain by what the shift
/// explains stay, flagged singular, because refinement on the given arm may still reach a solution.
pub fn inverse(linkage: &Linkage, plan: &Plan, shift: TipShift, free: &FreeJoints) -> InverseGraph {
    let mut writer = Writer::new(linkage, plan.target, shift);
    let free_joints = writer.write_all(plan, free);
    writer.finish(free_joints)
}

/// What all branches of a plan cost, by [weight](super::Operations::weight), but for their
/// residuals: these take about as much after every plan of an arm.
pub fn weight(linkage: &Linkage, plan: &Plan) -> usize {
    let mut writer = Writer::new(linkage, plan.target, TipShift::NONE);
    writer.write_all(plan, &FreeJoints::Seeded);
    let mut outputs = writer.angles();
    outputs.extend([writer.branch.invalid, writer.branch.singular]);
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
    /// What a free joint keeps, by coordinate of q.
    seed: Vec<Expr>,
    /// How far the joints that come with the target have moved.
    parameters: Vec<Expr>,
    /// Sine and cosine of the swivel angle, if it comes with the target.
    swivel: Option<Trig>,
    /// On an idealized arm.
    deviation: Option<Deviation>,
    /// See [`FreeJoints::Flagged`].
    flags_badly_told: bool,
    solved: SolvedMotions,
    branch: BranchStatus,
    /// See [`InverseGraph::residual_share`].
    residual_share: f64,
    step: StepState,
    parts: Parts,
}

/// The unknowns that steps have solved.
#[derive(Clone)]
struct SolvedMotions {
    /// By joint: the sine and cosine of its motion.
    trig: Vec<Option<Trig>>,
    /// By joint: how far it slides.
    slide: Vec<Option<Expr>>,
    /// By run: the sine and cosine of the sum of its angles.
    sum: Vec<Option<Trig>>,
    /// By run: whether the sum was solved before its joints.
    sum_first: Vec<bool>,
}

/// Whether a branch exists, and how near it is to where it does not.
#[derive(Clone)]
struct BranchStatus {
    invalid: Expr,
    singular: Expr,
    /// See [`InverseGraph::margin`].
    margin: Option<Expr>,
    /// The product of the discriminants that are differences, whose digits rounding takes; none on an
    /// idealized arm, whose branches are refined.
    difference: Option<Expr>,
    /// The product of the discriminants of quartics.
    meetings: Option<Expr>,
    /// See [`InverseGraph::arguments`].
    arguments: Option<Vec<(Choice, Expr)>>,
    /// What has been held against which threshold to flag singularity.
    watched: Vec<(Expr, Expr)>,
}

/// What a step leaves for those that look at it alone.
#[derive(Clone)]
struct StepState {
    /// Vectors shorter than this, squared and relative to their scale, leave the
    /// joint of the step at hand free.
    free: Expr,
    /// Whether earlier roots raise that.
    is_told_by_roots: bool,
    /// The unknowns of the step just written that may be free.
    may_be_free: Vec<MayBeFree>,
    /// The cosine-sine equation of the step just written, where its root can
    /// leave the domain.
    level: Option<Level>,
    /// Which relation of the step written last was the cheapest.
    relation: Option<usize>,
}

/// An unknown that is free where a factor is nothing beside its scale.
#[derive(Clone, Copy)]
struct MayBeFree {
    unknown: Atom,
    factor: Expr,
    scale: Expr,
    /// Below this the factor is nothing, and the joint is where the seed is, if that can be more than
    /// what is nearly free.
    nothing: Option<Expr>,
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

/// Units of rounding that an angle is off, where its root is not nearly double.
const ROUNDED: f64 = 16.0;

impl<'a> Writer<'a> {
    fn new(linkage: &'a Linkage, target: Target, shift: TipShift) -> Self {
        let mut g = Graph::new();
        let rotation = [1, 2, 3].map(|i| [1, 2, 3].map(|j| g.input(format!("r{i}{j}"))));
        let translation = ["px", "py", "pz"].map(|name| g.input(name));
        let given = Motion {
            rotation,
            translation,
        };
        let pose = project::projected(&mut g, linkage, target, given);
        let seed = linkage.solved_variables().into_iter();
        let seed = seed.map(|i| g.input(format!("seed{}", i + 1)));
        let seed = seed.collect();
        let deviation =
            (shift.is_refined).then(|| Deviation::new(&mut g, linkage, &given, shift.relative));
        let zero = g.zero();
        let n = linkage.links.len();
        Self {
            g,
            linkage,
            tip: linkage.tip_home(),
            target,
            tolerances: shift.told(linkage.scalar.tolerances()),
            given,
            pose,
            seed,
            parameters: Vec::new(),
            swivel: None,
            deviation,
            flags_badly_told: false,
            solved: SolvedMotions {
                trig: vec![None; n],
                slide: vec![None; n],
                sum: vec![None; linkage.runs.len()],
                sum_first: vec![false; linkage.runs.len()],
            },
            branch: BranchStatus {
                invalid: zero,
                singular: zero,
                margin: None,
                difference: None,
                meetings: None,
                arguments: Some(Vec::new()),
                watched: Vec::new(),
            },
            residual_share: 1.0,
            step: StepState {
                free: zero,
                is_told_by_roots: false,
                may_be_free: Vec::new(),
                level: None,
                relation: None,
            },
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
                    self.solved.slide[joint] = Some(moved);
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
                deviation.turned.push(Tangent::new([(angle, one)]));
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
            self.step.relation = Some(i);
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
        let trig = self.solved.trig.iter().chain(&self.solved.sum).flatten();
        let mut outputs: Vec<Expr> = trig.flat_map(|t| [t.sin, t.cos]).collect();
        outputs.extend(self.solved.slide.iter().flatten());
        self.g.operations(&outputs).weight()
    }

    fn set(&mut self, atom: Atom, trig: Trig) {
        let name = self.symbol(atom);
        let sin = self.g.named(trig.sin, format!("s{name}"));
        let cos = self.g.named(trig.cos, format!("c{name}"));
        let trig = Trig { sin, cos };
        match atom {
            Atom::Joint(joint) => self.solved.trig[joint] = Some(trig),
            Atom::Sum { run, .. } => {
                self.solved.sum[run] = Some(trig);
                self.solved.sum_first[run] = true;
            }
        }
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
        let Some(mut rest) = self.solved.sum[run] else {
            return;
        };
        for other in self.linkage.revolutes_of(run) {
            if let (true, Some(known)) = (other != joint, self.solved.trig[other]) {
                let back = self.g.reverse(known);
                rest = self.g.angle_sum(rest, back);
            }
        }
        self.solved.trig[joint] = Some(rest);
    }

    /// The sum of a run's angles, if all of them are known.
    fn run_sum(&mut self, run: usize) -> Option<Trig> {
        if self.solved.sum[run].is_none() {
            let joints = self.linkage.revolutes_of(run);
            let known: Option<Vec<Trig>> = joints.iter().map(|&j| self.solved.trig[j]).collect();
            let mut known = known?.into_iter();
            let first = known.next()?;
            self.solved.sum[run] = Some(known.fold(first, |a, b| self.g.angle_sum(a, b)));
        }
        self.solved.sum[run]
    }

    /// What comes as that of a run, but not less than can be told.
    fn threshold(&mut self) -> Expr {
        let given = self.g.input("free");
        let least = self.tolerances.free_below;
        if least <= self.linkage.scalar.tolerances().free_below {
            return given;
        }
        let least = self.g.constant(least);
        self.g.max(given, least)
    }

    /// The threshold where earlier roots of differences are nearly double, and an angle known to
    /// rounding over these roots, or, if one is taken for double, to the root of its noise: what follows
    /// from it is off by as much, and a shorter vector tells no angle. The tip misses the target by as
    /// much, whatever the angle, which a correction makes up for: where all joints are there for it.
    fn as_told_by_roots(&mut self, free: Expr) -> Expr {
        let Linkage {
            links,
            locked,
            swivel,
            coupling,
            ..
        } = self.linkage;
        let all_move = locked.is_empty() && swivel.is_none() && coupling.is_none();
        let is_whole = self.target == Target::Pose && !self.linkage.has_free_turn;
        let is_corrected = links.len() == 6 && all_move && is_whole;
        let Some(difference) = self.branch.difference.filter(|_| is_corrected) else {
            return free;
        };
        let rounding = (ROUNDED * self.tolerances.epsilon).powi(2);
        let [rounding, noise] = [rounding, self.tolerances.noise].map(|it| self.g.constant(it));
        let off = self.g.div(rounding, difference);
        let off = self.g.add(free, off);
        self.g.select_less(difference, noise, noise, off)
    }

    /// All steps, and the joints that move where they are free.
    fn write_all(&mut self, plan: &Plan, free: &FreeJoints) -> Vec<FreeJoint> {
        self.take_parameters();
        self.flags_badly_told = *free == FreeJoints::Flagged;
        let mut may_be_free: Vec<(usize, MayBeFree)> = Vec::new();
        let mut free_joints = Vec::new();
        let mut threshold = None;
        for (i, step) in plan.steps.iter().enumerate() {
            let begins = self.g.nodes().len();
            self.step.level = None;
            let turns = free.moves_step(i);
            let given = match turns {
                true => *threshold.get_or_insert_with(|| self.threshold()),
                false => self.g.constant(self.tolerances.free_below),
            };
            self.step.free = self.as_told_by_roots(given);
            self.step.is_told_by_roots = self.step.free != given;
            self.write(step);
            for (step, joint) in &may_be_free {
                let said = self.said_of(*step, *joint, i, plan);
                if let Some(said) = said.filter(|said| free.includes(said.turn)) {
                    self.name_said(free_joints.len(), &said);
                    free_joints.push(said);
                }
            }
            let these = std::mem::take(&mut self.step.may_be_free);
            if turns {
                may_be_free.extend(these.into_iter().map(|joint| (i, joint)));
            }
            let relation = self.step.relation.take();
            self.parts.steps.push(StepPart { begins, relation });
        }
        free_joints
    }

    fn finish(mut self, free_joints: Vec<FreeJoint>) -> InverseGraph {
        self.parts.residual = self.g.nodes().len();
        let residual = self.residual();
        self.parts.angles = self.g.nodes().len();
        let q = self.angles();
        if self.deviation.is_some() {
            // Where a step is in doubt, so is what is read from it, before and behind.
            let zero = self.g.zero();
            self.branch.invalid =
                self.g
                    .select_less(zero, self.branch.singular, zero, self.branch.invalid);
        }
        let margin = match (self.branch.margin, self.branch.meetings) {
            (Some(margin), Some(meetings)) => Some(self.g.mul(margin, meetings)),
            (margin, meetings) => margin.or(meetings),
        };
        let mut inverse = InverseGraph {
            parts: self.parts,
            q,
            residual: self.g.named(residual, "residual"),
            invalid: self.g.named(self.branch.invalid, "invalid"),
            singular: self.g.named(self.branch.singular, "singular"),
            margin,
            arguments: self.branch.arguments,
            residual_share: self.residual_share,
            free_joints,
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
        if let Some(coupling) = &self.linkage.coupling {
            return self.coordinates(coupling);
        }
        let zero = self.g.zero();
        let mut q = vec![zero; self.linkage.variables()];
        for run in 0..self.linkage.runs.len() {
            for joint in self.linkage.runs[run].joints.clone() {
                let link = &self.linkage.links[joint];
                let Some(coordinate) = self.linkage.coordinate(joint) else {
                    continue;
                };
                let value = self.joint_value(joint);
                let value = match link.kind {
                    JointKind::Prismatic => value,
                    JointKind::Revolute => self.g.wrap(value),
                };
                let symbol = format!("q{}", link.variable + 1);
                q[coordinate] = self.g.named(value, symbol);
            }
        }
        q
    }

    /// The value of a joint: how far it slides or turns without its offset, and in the sense
    /// of its own axis.
    fn joint_value(&mut self, joint: usize) -> Expr {
        let link = &self.linkage.links[joint];
        let (backwards, offset) = (link.gain < 0.0, link.offset);
        if link.kind == JointKind::Prismatic {
            let slide = self.solved.slide[joint].unwrap_or(self.g.zero());
            let offset = self.g.constant(offset);
            return self.g.sub(slide, offset);
        }
        let Some(mut trig) = self.solved.trig[joint] else {
            return self.g.zero();
        };
        if backwards {
            trig = self.g.reverse(trig);
        }
        let angle = self.g.atan2(trig.sin, trig.cos);
        let offset = self.g.constant(if backwards { offset } else { -offset });
        self.g.add(angle, offset)
    }

    /// The distance of forward kinematics from the target: translation error
    /// and rotation angle times the arm's size, as the legs of a right
    /// triangle, what the target itself is uncertain by, and what joints that are coupled to
    /// others disagree by. A sum, so that a NaN anywhere is a NaN here.
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
        let distance = self.g.sqrt(squares);
        let disagreement = self.disagreement();
        self.g.add(distance, disagreement)
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
                let whole = Some(joint) == last && self.solved.sum_first[run];
                if whole {
                    sum = self.solved.sum[run];
                } else if let Some(own) = self.solved.trig[joint] {
                    sum = Some(match sum {
                        Some(before) => self.g.angle_sum(before, own),
                        None => own,
                    });
                }
                sums.push(sum.unwrap_or(rest));
                let zero = self.g.zero();
                slides.push(self.solved.slide[joint].unwrap_or(zero));
            }
        }
        JointTrig { sums, slides }
    }
}
