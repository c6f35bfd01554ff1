//! What the comments inside of `ik` say: the steps of the plan, where their
//! statements begin.

use super::language::Language;
use super::straight::{Writer, sign_name};
use crate::expr::inverse::{InverseGraph, Parts, StepPart};
use crate::geometry::Linkage;
use crate::plan::{Atom, Plan, Step, Subproblem};
use std::collections::BTreeSet;

/// The steps of a plan, each in a line: `q2+q3+q4 and q5 by SP2, given q1`.
pub fn steps(plan: &Plan, linkage: &Linkage, parts: &Parts) -> Vec<String> {
    let steps = plan.steps.iter().zip(&parts.steps);
    steps
        .map(|(step, part)| sentence(step, *part, linkage))
        .collect()
}

fn sentence(step: &Step, part: StepPart, linkage: &Linkage) -> String {
    let unknowns = list(step.unknowns.iter().map(Atom::to_string));
    let given = match (step.subproblem, &step.unknowns[..]) {
        (Subproblem::Sum, &[Atom::Joint(joint)]) => summands(joint, linkage),
        _ => given(step, part),
    };
    let by = match step.subproblem {
        Subproblem::Sum => "as the rest of the sum".into(),
        Subproblem::Slide => "by sliding a point onto another".into(),
        other => format!("by {other}"),
    };
    match given.is_empty() {
        true => format!("{unknowns} {by}"),
        false => format!("{unknowns} {by}, given {given}"),
    }
}

/// What a subproblem does, for those who do not know its number by heart.
pub fn does(subproblem: Subproblem) -> &'static str {
    match subproblem {
        Subproblem::Sum | Subproblem::Slide => "",
        Subproblem::Sp1 => ": turn a vector onto another",
        Subproblem::Sp2 => ": turn a vector onto another about two axes",
        Subproblem::Sp3 => ": turn a point to a distance",
        Subproblem::Sp4 => ": turn a vector to a component along a direction",
        Subproblem::Sp6 => ": two relations in two angles, a quartic",
        Subproblem::T1 => ": slide a point to a distance",
        Subproblem::T2 => ": slide a point to a height",
        Subproblem::Univariate => ": a trigonometric polynomial in the first of them",
        Subproblem::Slides => ": slide a point onto another in several directions",
        Subproblem::Lines => ": slide, turn and slide a point onto another",
        Subproblem::Hyperboloid => ": turn a point onto a line that turns too, a quartic",
    }
}

/// The unknowns of earlier steps that a step's relation depends on.
fn given(step: &Step, part: StepPart) -> String {
    let relation = part.relation.and_then(|i| step.relations.get(i));
    let second = relation.and_then(|relation| relation.with.as_deref());
    let atoms: BTreeSet<Atom> = (relation.into_iter().chain(second))
        .flat_map(|relation| &relation.depends)
        .map(|depends| depends.atom)
        .filter(|atom| !step.unknowns.contains(atom))
        .collect();
    list(atoms.iter().map(Atom::to_string))
}

/// The sum of a run of parallel joints, and its joints but for one.
fn summands(joint: usize, linkage: &Linkage) -> String {
    let joints = linkage.revolutes_of(linkage.run_of(joint));
    let name = |j: &usize| Atom::Joint(*j).to_string();
    let sum: Vec<String> = joints.iter().map(name).collect();
    let others = joints.iter().filter(|&&j| j != joint).map(name);
    list(std::iter::once(sum.join("+")).chain(others))
}

/// `a`, `a and b`, `a, b and c`.
pub fn list(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<String> = items.into_iter().collect();
    match items.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
        None => String::new(),
    }
}

/// A part of the computation.
struct Part {
    /// Its first node.
    begins: usize,
    /// The node behind its last.
    ends: usize,
    text: String,
    /// Whether the text says of a stage in front of the last that it is one.
    is_told: bool,
}

/// The stage of what is computed of the joints that are given, and of the seed.
pub const GIVEN: usize = 0;
/// That of what all branches of a target share; the loops over branches follow.
pub const SHARED: usize = 1;

/// The headings of all parts.
pub struct Headings {
    parts: Vec<Part>,
}

impl Headings {
    /// Of the steps, the residual and the joint values.
    pub fn new(plan: &Plan, linkage: &Linkage, inverse: &InverseGraph) -> Self {
        let steps = steps(plan, linkage, &inverse.parts);
        let begins = inverse.parts.steps.iter().map(|part| part.begins);
        let mut opened: Vec<(usize, String, bool)> = begins
            .zip(steps)
            .enumerate()
            .map(|(i, (begins, step))| (begins, format!("{}. {step}", i + 1), true))
            .collect();
        let residual = "Residual: forward kinematics against the target";
        let angles = "Joint values: angles from sines and cosines, in (−π, π]";
        opened.push((inverse.parts.residual, residual.into(), true));
        opened.push((inverse.parts.angles, angles.into(), false));
        let ends = opened.iter().skip(1).map(|(begins, ..)| *begins);
        let ends: Vec<usize> = ends.chain([inverse.graph.nodes().len()]).collect();
        let parts = opened.into_iter().zip(ends);
        Self {
            parts: parts
                .map(|((begins, text, is_told), ends)| Part {
                    begins,
                    ends,
                    text,
                    is_told,
                })
                .collect(),
        }
    }

    /// The headings of a stage, by the first node that they stand in front of.
    /// Every part has one in the last stage that it reaches, and in those
    /// before where it has statements of its own; behind the last that has any, none.
    pub fn of_stage<L: Language>(
        &self,
        writer: &Writer<L>,
        stages: &[usize],
        stage: usize,
    ) -> StageHeadings {
        let has_own = |part: &Part| (part.begins..part.ends).any(|i| writer.needs_operation(i));
        let end = self.parts.iter().rposition(has_own).map_or(0, |i| i + 1);
        let mut last = 0;
        let mut headings = Vec::new();
        for part in &self.parts[..end] {
            let own = (part.begins..part.ends).filter(|&i| writer.needs_operation(i));
            last = own.map(|i| stages[i]).max().unwrap_or(last);
            let stands = (part.begins..part.ends).any(|i| stages[i] == stage && writer.awaits(i));
            if last == stage || stands {
                let which = match stage {
                    _ if last == stage || !part.is_told => "",
                    ..=SHARED => " (what all branches share)",
                    _ => " (what several branches share)",
                };
                headings.push((part.begins, format!("{}{which}", part.text)));
            }
        }
        headings.reverse();
        StageHeadings { headings }
    }
}

/// The headings of a stage that are not written yet, the next one last.
pub struct StageHeadings {
    headings: Vec<(usize, String)>,
}

impl StageHeadings {
    /// Those in front of the statement of a node.
    pub fn before(&mut self, node: usize) -> Vec<String> {
        let mut out = Vec::new();
        while let Some((_, text)) = self.headings.pop_if(|(begins, _)| *begins <= node) {
            out.push(text);
        }
        out
    }

    /// Those that no statement follows.
    pub fn rest(mut self) -> Vec<String> {
        self.before(usize::MAX)
    }
}

/// What the lanes of a loop over `signs` choices are; of these it reads some.
pub fn lanes(plan: &Plan, read: &BTreeSet<u8>, signs: u8) -> String {
    let mut said = Vec::new();
    let mut first = 0;
    for (i, step) in plan.steps.iter().enumerate() {
        let own = first..first + step.subproblem.choices();
        first = own.end;
        let names = own.filter(|choice| read.contains(choice));
        let names = list(names.map(sign_name));
        said.extend(match (&names[..], step.subproblem) {
            ("", _) => None,
            (_, Subproblem::Sp6 | Subproblem::Hyperboloid) => {
                Some(format!("{names} number those of step {}", i + 1))
            }
            _ => Some(format!("{names} of step {}", i + 1)),
        });
    }
    let number = 1 << signs;
    match said.is_empty() {
        true => format!("{number} lanes, one for every branch"),
        false => format!("{number} lanes, by the signs of the roots: {}", list(said)),
    }
}

/// How older lanes go on in more of them.
pub fn widened(from: usize, to: usize) -> String {
    format!("From {from} lanes to {to}: lane k goes on from lane k modulo {from}")
}
