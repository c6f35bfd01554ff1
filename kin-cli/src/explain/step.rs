//! What a step of a plan means in space.

use kin_codegen::geometry::{Linkage, Vec3, cross, dot, norm, numbers};
use kin_codegen::plan::{self, Atom, Invariant, Kind, Relation, Subproblem};
use serde::Serialize;
use std::collections::BTreeSet;
use std::ops::Range;

/// Relations of the plan's arm hold to rounding.
const NEAR: f64 = 1e-9;

/// One subproblem.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Its name in short: `SP1` to `SP4` are Paden and Kahan's, `SP6` solves
    /// two unknowns from two relations, `sum` is the angle left over from a
    /// known sum, `slide`, `T1` and `T2` solve joints that slide.
    pub subproblem: String,
    /// What it solves: `q1`, or a sum of parallel joints, `q2+q3+q4`.
    pub unknowns: Vec<String>,
    /// Unknowns of earlier steps that it needs.
    pub given: Vec<String>,
    /// How many roots it has.
    pub roots: usize,
    /// The objects whose relation poses it: two, or one that is carried
    /// around the loop; four where it takes two relations, `SP6`; none for a
    /// sum. Where several relations pose a step, these are those of the first.
    pub objects: Vec<Object>,
    /// How many relations pose it; the one that is cheapest to compute is
    /// written.
    pub relations: usize,
    /// Whether it can degenerate where the arm is regular: the amplitude of
    /// its relation varies with the configuration.
    pub can_degenerate: bool,
    /// What happens, in a sentence.
    pub text: String,
}

/// What some joints leave alone.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Object {
    /// What it is.
    pub kind: ObjectKind,
    /// The joints that leave it alone; none if it is fixed to base or tip.
    pub joints: Vec<usize>,
    /// The point, or a point of the plane.
    pub point: Vec3,
    /// The direction, or the plane's normal.
    pub direction: Vec3,
    /// In words: `the point where axes 4, 5, 6 meet`.
    pub text: String,
}

/// Kinds of objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ObjectKind {
    /// On all the axes.
    Point,
    /// Along all the axes.
    Direction,
    /// Across all the axes.
    Plane,
}

impl Step {
    pub(super) fn of(step: &plan::Step, linkage: &Linkage) -> Self {
        let relations = posing(step);
        let depends = relations.iter().flat_map(|relation| &relation.depends);
        let given: BTreeSet<String> = depends
            .filter(|depends| !step.unknowns.contains(&depends.atom))
            .map(|depends| depends.atom.to_string())
            .collect();
        let objects: Vec<Object> = relations
            .iter()
            .flat_map(|relation| std::iter::once(&relation.from).chain(&relation.to))
            .map(|invariant| Object::of(invariant, linkage))
            .collect();
        Self {
            subproblem: step.subproblem.to_string(),
            unknowns: step.unknowns.iter().map(Atom::to_string).collect(),
            given: given.into_iter().collect(),
            roots: step.subproblem.roots(),
            text: sentence(step, linkage, &objects),
            objects,
            relations: step.relations.len(),
            can_degenerate: can_degenerate(step, &relations),
        }
    }
}

/// The relation that poses a step, and the second one where it takes two.
fn posing(step: &plan::Step) -> Vec<&Relation> {
    let first = step.relations.first();
    let second = first.and_then(|relation| relation.with.as_deref());
    first.into_iter().chain(second).collect()
}

/// A single unknown degenerates where the amplitude of its relation does, and
/// two where their two relations come to say the same. Two that are neighbours
/// in one relation degenerate with the arm alone, because the angle between
/// their axes is a constant.
fn can_degenerate(step: &plan::Step, relations: &[&Relation]) -> bool {
    let unknown = |atom: Atom| step.unknowns.contains(&atom);
    match (relations, &step.unknowns[..]) {
        ([first, second], &[one, other]) => first
            .independence(second, [one, other])
            .is_some_and(|independence| !independence.steady),
        (_, [a, b]) => extent(*a).end != extent(*b).start,
        ([one], _) => one
            .depends
            .iter()
            .any(|depends| unknown(depends.atom) && !depends.steady),
        _ => false,
    }
}

/// The joints of an unknown.
fn extent(atom: Atom) -> Range<usize> {
    match atom {
        Atom::Joint(joint) => joint..joint + 1,
        Atom::Sum { first, last, .. } => first..last + 1,
    }
}

fn sentence(step: &plan::Step, linkage: &Linkage, objects: &[Object]) -> String {
    let unknowns: Vec<String> = step.unknowns.iter().map(Atom::to_string).collect();
    let unknowns = unknowns.join(" and ");
    let verb = match step.unknowns[..] {
        [Atom::Joint(joint)] if slides(linkage, joint) => "slide",
        _ => "turn",
    };
    match (step.subproblem, objects) {
        (Subproblem::Sum, _) => {
            format!("{unknowns} is what the other angles leave of the sum of parallel joints")
        }
        (Subproblem::Univariate, _) => format!(
            "no sequence of subproblems solves the chain; a polynomial in {} has the solutions, and \
             the others follow from its roots",
            step.unknowns[0]
        ),
        (_, [one]) if step.relations.iter().any(|relation| relation.is_swivel) => format!(
            "{verb} {unknowns} until {} is where the swivel angle has it",
            one.text
        ),
        (_, [one]) => format!(
            "{verb} {unknowns} until {} is where the target has it",
            one.text
        ),
        (_, [a, b]) => format!(
            "{verb} {unknowns} until {} is what the target makes it",
            measure(a, b)
        ),
        (_, [a, b, c, d]) => format!(
            "{verb} {unknowns} until both {} and {} are what the target makes them",
            measure(a, b),
            measure(c, d)
        ),
        _ => format!("solve {unknowns}"),
    }
}

/// What is the same along both arcs of the loop.
fn measure(a: &Object, b: &Object) -> String {
    use ObjectKind::{Direction, Plane, Point};
    match (a.kind, b.kind) {
        (Point, Point) => format!("the distance of {} from {}", a.text, b.text),
        (Plane, _) => format!("the height of {} over {}", b.text, a.text),
        (_, Plane) => format!("the height of {} over {}", a.text, b.text),
        (Direction, _) | (_, Direction) => format!("the angle between {} and {}", a.text, b.text),
    }
}

impl Object {
    fn of(invariant: &Invariant, linkage: &Linkage) -> Self {
        let joints = left_alone_by(invariant, linkage);
        Self {
            kind: match invariant.kind {
                Kind::Point => ObjectKind::Point,
                Kind::Direction => ObjectKind::Direction,
                Kind::Plane => ObjectKind::Plane,
            },
            point: invariant.point,
            direction: invariant.direction,
            text: words(invariant, &joints, linkage),
            joints: joints.iter().map(|i| i + 1).collect(),
        }
    }
}

/// All the joints in a row that leave an object alone; the plan names no more
/// of them than it needs. A point of axis 4 may well be the wrist's centre.
fn left_alone_by(invariant: &Invariant, linkage: &Linkage) -> Vec<usize> {
    let n = linkage.links.len();
    let Range { start, end } = invariant.joints;
    let alone = |&j: &usize| leaves_alone(invariant, linkage, j);
    let before = (0..start).rev().take_while(alone).count();
    let behind = (end.min(n)..n).take_while(alone).count();
    // Sliding moves no direction, but is no axis of it either.
    let listed = |&j: &usize| invariant.kind != Kind::Direction || !slides(linkage, j);
    (start - before..end.min(n) + behind)
        .filter(listed)
        .collect()
}

fn slides(linkage: &Linkage, joint: usize) -> bool {
    !linkage.is_revolute(joint)
}

fn leaves_alone(invariant: &Invariant, linkage: &Linkage, joint: usize) -> bool {
    let axis = linkage.axis(joint);
    let across = dot(axis.direction, invariant.direction).abs() < NEAR;
    let along = norm(cross(axis.direction, invariant.direction)) < NEAR;
    let through = norm(axis.offset_of(invariant.point)) < NEAR * linkage.size;
    match (invariant.kind, slides(linkage, joint)) {
        (Kind::Point, slides) => through && !slides,
        (Kind::Direction, slides) => along || slides,
        (Kind::Plane, true) => across,
        (Kind::Plane, false) => along,
    }
}

/// The axis of the tip's frame that a direction is.
fn axis_of_tip(invariant: &Invariant, linkage: &Linkage) -> char {
    let home = linkage.tip_home().rotation;
    let along = |j: usize| {
        let column = [0, 1, 2].map(|i: usize| home[i][j]);
        dot(column, invariant.direction).abs()
    };
    let nearest = (0..3).max_by(|&a, &b| along(a).total_cmp(&along(b)));
    ['x', 'y', 'z'][nearest.unwrap_or(2)]
}

fn words(invariant: &Invariant, joints: &[usize], linkage: &Linkage) -> String {
    let kind = match invariant.kind {
        Kind::Point => "point",
        Kind::Direction => "direction",
        Kind::Plane => "plane",
    };
    // An end behind the last joint is what a target has of the tip.
    if invariant.joints.end > linkage.links.len() {
        return match invariant.kind {
            Kind::Direction => format!("the tip's {} axis", axis_of_tip(invariant, linkage)),
            _ => "the tip".into(),
        };
    }
    let numbers = numbers(joints.iter().map(|i| i + 1));
    match (joints.len(), invariant.kind) {
        (0, _) if invariant.joints.start == 0 => format!("a {kind} of the base"),
        (0, _) => format!("a {kind} of the tip link"),
        (1, Kind::Point) => format!("a point of axis {numbers}"),
        (1, Kind::Direction) => format!("the direction of axis {numbers}"),
        (1, Kind::Plane) => format!("the plane across axis {numbers}"),
        (_, Kind::Point) => format!("the point where axes {numbers} meet"),
        (_, Kind::Direction) => format!("the common direction of axes {numbers}"),
        (_, Kind::Plane) => format!("the plane in which joints {numbers} move"),
    }
}
