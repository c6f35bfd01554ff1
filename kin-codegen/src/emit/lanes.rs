//! Inverse kinematics in any language: all branches of a target, or of several, together,
//! as array lanes.
//!
//! Values that depend on no sign are one for each target. Every sign doubles the
//! branches, and the values that depend on it are computed in a loop over them,
//! whose body is straight-line code on one branch, so that it becomes vector
//! instructions. For that the signs are arrays from outside of the loop, a loop
//! reads no array that it writes, and arrays that outlive their loop are widened,
//! so that every access is contiguous. Two lanes are too few to vectorize, so the
//! first two signs share a loop of four.

use super::headings::{self, GIVEN, Headings, SHARED};
use super::language::{Language, MulAdd};
use super::straight::{Place, Trig, Writer};
use crate::closed_form::ClosedForm;
use crate::expr::inverse::InverseGraph;
use crate::expr::{Expr, Graph, Node};
use std::collections::{BTreeMap, BTreeSet};

/// The computation of all lanes.
pub struct Lanes<L: Language> {
    /// The sines and cosines of what is given beside targets.
    pub trig: Trig<L::Text>,
    /// What is computed of them before any target is looked at.
    pub given: Vec<L::Text>,
    /// The loop over targets of what their branches share, and those over branches.
    pub stages: Vec<Stage<L>>,
    /// By coordinate of q.
    pub q: Vec<Output<L::Text>>,
    /// Metres.
    pub residual: Output<L::Text>,
    /// Positive where there is no branch.
    pub invalid: Output<L::Text>,
    /// Positive where the branch is singular.
    pub singular: Output<L::Text>,
    /// What later roots say of each joint that may be free: their level, and positive
    /// where they have none.
    pub free_joints: Vec<[Output<L::Text>; 2]>,
    /// How many lanes there are.
    pub width: usize,
    /// How many lanes much of the arithmetic has.
    pub busy: usize,
    /// The inputs that are read.
    pub inputs: Vec<bool>,
}

/// A loop.
pub struct Stage<L: Language> {
    /// How many choices its lanes are of; none of the one over targets alone.
    pub signs: u8,
    /// Values of earlier loops over branches that this one or a later one reads, and how many
    /// lanes they have so far.
    pub widened: (Vec<String>, usize),
    /// The choices whose signs it reads.
    pub reads: BTreeSet<u8>,
    /// What its lanes are.
    pub heading: String,
    /// Of one lane.
    pub body: Vec<L::Text>,
    /// The values that outlive it, by their names.
    pub kept: Vec<String>,
}

/// Where a result stands.
pub enum Output<Text> {
    /// A value that has outlived the loop over targets.
    OfTarget(String),
    /// One that has outlived an earlier loop over branches than the last.
    Earlier(String),
    /// One of the last loop.
    Last(String),
    /// A value of the target at hand.
    ValueOfTarget(Text),
    /// The same value in all lanes.
    Value(Text),
}

/// The loops: each handles the signs up to the given number.
fn loops(choices: u8) -> Vec<u8> {
    match choices {
        0 | 1 => (1..=choices).collect(),
        _ => (2..=choices).collect(),
    }
}

/// How many numbers a target has, the first inputs.
pub const TARGET: usize = 12;

/// The names of a target's entries: r11 … r33, px, py, pz.
pub fn target_names() -> Vec<String> {
    let rotation = (1..=3).flat_map(|i| (1..=3).map(move |j| format!("r{i}{j}")));
    rotation
        .chain(["px", "py", "pz"].map(str::to_owned))
        .collect()
}

/// When each node is computed.
fn stages(g: &Graph, loops: &[u8]) -> Vec<usize> {
    let mut of_target = vec![false; g.nodes().len()];
    for (i, node) in g.nodes().iter().enumerate() {
        of_target[i] = match node {
            Node::Input(k) => usize::from(*k) < TARGET,
            _ => node.operands().any(|e| of_target[e.index()]),
        };
    }
    let stage = |(level, of_target): (u8, bool)| match (level, of_target) {
        (0, false) => GIVEN,
        (0, true) => SHARED,
        _ => SHARED + 1 + loops.iter().position(|&last| level <= last).unwrap_or(0),
    };
    g.levels().into_iter().zip(of_target).map(stage).collect()
}

/// The part of all arithmetic that has to be in a wide loop for wide vectors to pay.
const MUCH: usize = 4;

/// How many lanes the widest loop has that does a fourth of all operations or more.
fn busy(g: &Graph, outputs: &[Expr], loops: &[u8], stages: &[usize]) -> usize {
    let weights = g.operations_by_node(outputs);
    let widths: Vec<usize> = std::iter::once(1)
        .chain(loops.iter().map(|signs| 1 << signs))
        .collect();
    let mut operations = vec![0; widths.len()];
    for (weight, stage) in weights.iter().zip(stages) {
        // What is not needed may see more choices than there are loops for.
        if let Some(number) = stage.checked_sub(SHARED).filter(|&k| k < widths.len()) {
            operations[number] += widths[number] * weight.weight();
        }
    }
    let all: usize = operations.iter().sum();
    let busy = widths.iter().zip(operations);
    let busy = busy.filter(|(_, operations)| MUCH * operations >= all);
    busy.map(|(width, _)| *width).max().unwrap_or(1)
}

/// Writes all lanes of a closed form. `inputs` is how the inputs behind the target are read,
/// and `fused` how products and sums are, if they are fused.
pub fn lanes<L: Language>(
    solver: &ClosedForm,
    inverse: &InverseGraph,
    inputs: impl IntoIterator<Item = L::Text>,
    fused: Option<MulAdd<L::Text>>,
) -> Lanes<L> {
    let g = &inverse.graph;
    let headings = Headings::new(&solver.plan, &solver.linkage, inverse);
    let outputs = inverse.outputs();
    let loops = loops(g.choices());
    let stages = stages(g, &loops);
    let busy = busy(g, &outputs, &loops, &stages);
    let target = target_names();
    let target = target.iter().map(|name| L::of_target(name));
    let inputs: Vec<L::Text> = target.chain(inputs).collect();
    let mut writer = Writer::<L>::new(g, &outputs, &inputs, &stages, fused);
    let last_read = last_read(&writer, inverse, &stages, SHARED + loops.len());
    let trig = writer.sines_and_cosines();
    let given = given(&mut writer, &headings, &stages);
    let mut written = Vec::new();
    // Values that outlive their loops, by node: name and the last stage that reads them.
    let mut alive: BTreeMap<usize, (String, usize)> = BTreeMap::new();
    let mut before = 0;
    for (stage, signs) in (SHARED..).zip(std::iter::once(0).chain(loops)) {
        let widened = match stage > SHARED + 1 {
            true => still_read(&alive, &stages, stage),
            false => Vec::new(),
        };
        let mut kept = Vec::new();
        let mut opened = headings.of_stage(&writer, &stages, stage);
        let place = if stage == SHARED {
            Place::Scalar
        } else {
            Place::Lane
        };
        let mut body = writer.statements(
            place,
            |i| stages[i] == stage,
            |i| opened.before(i),
            |e, name| {
                let last = last_read[e.index()];
                if last > stage || outputs.contains(&e) {
                    alive.insert(e.index(), (name.to_owned(), last));
                    kept.push(name.to_owned());
                }
            },
        );
        body.extend(opened.rest().iter().map(|text| L::comment(text)));
        // From here on they are read from their arrays.
        for (i, (value, _)) in alive.iter().filter(|(i, _)| stages[**i] == stage) {
            writer.rename(g.at(*i), L::kept(value, stage > SHARED));
        }
        let reads = signs_read(&writer, g, &stages, stage);
        written.push(Stage {
            signs,
            widened: (widened, 1 << before),
            heading: headings::lanes(&solver.plan, &reads, signs),
            reads,
            body,
            kept,
        });
        before = signs;
    }
    let last = stages.iter().copied().max().unwrap_or(SHARED);
    let output = |e: Expr| match (alive.get(&e.index()), stages[e.index()]) {
        (Some((value, _)), SHARED) => Output::OfTarget(value.clone()),
        (Some((value, _)), stage) if stage < last => Output::Earlier(value.clone()),
        (Some((value, _)), _) => Output::Last(value.clone()),
        (None, SHARED) => Output::ValueOfTarget(writer.output(e)),
        (None, _) => Output::Value(writer.output(e)),
    };
    Lanes {
        trig,
        given,
        stages: written,
        q: inverse.q.iter().map(|&e| output(e)).collect(),
        residual: output(inverse.residual),
        invalid: output(inverse.invalid),
        singular: output(inverse.singular),
        free_joints: inverse
            .free_joints
            .iter()
            .map(|free| [free.level, free.no_root].map(output))
            .collect(),
        width: 1 << before,
        busy,
        inputs: (0..inputs.len()).map(|k| writer.needs_input(k)).collect(),
    }
}

/// What stands in front of all loops.
fn given<L: Language>(
    writer: &mut Writer<L>,
    headings: &Headings,
    stages: &[usize],
) -> Vec<L::Text> {
    let mut opened = headings.of_stage(writer, stages, GIVEN);
    let mut statements = writer.statements(
        Place::Scalar,
        |i| stages[i] == GIVEN,
        |i| opened.before(i),
        |_, _| (),
    );
    statements.extend(opened.rest().iter().map(|text| L::comment(text)));
    statements
}

/// The last stage at which each node is read; results are read after all.
fn last_read<L: Language>(
    writer: &Writer<L>,
    inverse: &InverseGraph,
    stages: &[usize],
    after: usize,
) -> Vec<usize> {
    let g = &inverse.graph;
    let mut last = vec![0; stages.len()];
    for (i, node) in g.nodes().iter().enumerate() {
        for e in node.operands().filter(|_| writer.needs(g.at(i))) {
            last[e.index()] = last[e.index()].max(stages[i]);
        }
    }
    for e in inverse.outputs() {
        last[e.index()] = after;
    }
    last
}

/// The choices whose signs a stage reads: its own, and earlier ones that it
/// selects by.
fn signs_read<L: Language>(
    writer: &Writer<L>,
    g: &Graph,
    stages: &[usize],
    stage: usize,
) -> BTreeSet<u8> {
    let nodes = g.nodes();
    let here = (0..nodes.len()).filter(|&i| stages[i] == stage && writer.needs(g.at(i)));
    here.flat_map(|i| nodes[i].operands())
        .filter_map(|e| match nodes[e.index()] {
            Node::Sign(choice) => Some(choice.0),
            _ => None,
        })
        .collect()
}

/// The values of loops over branches that a stage or a later one reads.
fn still_read(
    alive: &BTreeMap<usize, (String, usize)>,
    stages: &[usize],
    stage: usize,
) -> Vec<String> {
    let read = alive
        .iter()
        .filter(|(i, (_, last))| stages[**i] > SHARED && *last >= stage);
    read.map(|(_, (name, _))| name.clone()).collect()
}

/// Whether the sign of a choice is − in a lane: lane k has + where bit `choice` of k is clear.
pub fn is_minus(choice: u8, lane: u32) -> bool {
    lane >> choice & 1 == 1
}

/// What stands in front of the sines and cosines of what is given.
pub fn told_of_angles(solver: &ClosedForm) -> &'static str {
    match solver.given.parameters() {
        0 => "The seed, for a joint that the target leaves free",
        _ => "What is given beside the target; the seed, for a joint that both leave free",
    }
}
