//! What a step of a plan means in space.

use crate::geometry::{Linkage, Travel, Vec3};
use crate::plan::{self, Atom, Invariant, Kind, Relation, Subproblem};
use serde::Serialize;
use std::ops::Range;

/// One subproblem.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Its name in short: `SP1` to `SP4` are Paden and Kahan's, `sum` is the
    /// angle left over from a known sum, `slide`, `T1` and `T2` solve joints
    /// that slide.
    pub subproblem: String,
    /// What it solves: `q1`, or a sum of parallel joints, `q2+q3+q4`.
    pub unknowns: Vec<String>,
    /// Unknowns of earlier steps that it needs.
    pub given: Vec<String>,
    /// How many roots it has.
    pub roots: usize,
    /// The objects whose relation poses it: two, or one that is carried
    /// around the loop; none for a sum. Where several relations pose a step,
    /// these are those of the first.
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
        let relation = step.relations.first();
        let given: Vec<String> = relation
            .into_iter()
            .flat_map(|relation| &relation.depends)
            .filter(|depends| !step.unknowns.contains(&depends.atom))
            .map(|depends| depends.atom.to_string())
            .collect();
        let objects: Vec<Object> = relation
            .into_iter()
            .flat_map(|relation| std::iter::once(&relation.from).chain(&relation.to))
            .map(|invariant| Object::of(invariant, linkage))
            .collect();
        Self {
            subproblem: step.subproblem.to_string(),
            unknowns: step.unknowns.iter().map(Atom::to_string).collect(),
            given,
            roots: 1 << step.subproblem.choices(),
            text: sentence(step, linkage, &objects),
            objects,
            relations: step.relations.len(),
            can_degenerate: relation.is_some_and(|relation| can_degenerate(step, relation)),
        }
    }
}

/// A single unknown by its amplitude; two that are neighbours degenerate with
/// the arm alone, because the angle between their axes is a constant.
fn can_degenerate(step: &plan::Step, relation: &Relation) -> bool {
    match step.unknowns[..] {
        [Atom::Joint(a), Atom::Joint(b)] => b != a + 1,
        [_, _] => true,
        _ => relation
            .depends
            .iter()
            .any(|depends| step.unknowns.contains(&depends.atom) && !depends.steady),
    }
}

fn sentence(step: &plan::Step, linkage: &Linkage, objects: &[Object]) -> String {
    let unknowns: Vec<String> = step.unknowns.iter().map(Atom::to_string).collect();
    let unknowns = unknowns.join(" and ");
    let verb = match step.unknowns[..] {
        [Atom::Joint(joint)] if linkage.links[joint].travel != Travel::Turn => "slide",
        _ => "turn",
    };
    match (step.subproblem, objects) {
        (Subproblem::Sum, _) => {
            format!("{unknowns} is what the other angles leave of the sum of parallel joints")
        }
        (_, [one]) => format!(
            "{verb} {unknowns} until {} is where the target has it",
            one.text
        ),
        (_, [a, b]) => format!(
            "{verb} {unknowns} until {} is what the target makes it",
            measure(a, b)
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
        let n = linkage.links.len();
        let Range { start, end } = invariant.joints;
        Self {
            kind: match invariant.kind {
                Kind::Point => ObjectKind::Point,
                Kind::Direction => ObjectKind::Direction,
                Kind::Plane => ObjectKind::Plane,
            },
            joints: (start..end.min(n)).map(|i| i + 1).collect(),
            point: invariant.point,
            direction: invariant.direction,
            text: words(invariant, n),
        }
    }
}

fn words(invariant: &Invariant, n: usize) -> String {
    let Range { start, end } = invariant.joints;
    let kind = match invariant.kind {
        Kind::Point => "point",
        Kind::Direction => "direction",
        Kind::Plane => "plane",
    };
    // An end behind the last joint is the tip of a target of position.
    match end.min(n) - start {
        _ if end > n => "the tip".into(),
        0 if start == 0 => format!("a {kind} of the base"),
        0 => format!("a {kind} of the tip link"),
        1 => match invariant.kind {
            Kind::Point => format!("a point of axis {end}"),
            Kind::Direction => format!("the direction of axis {end}"),
            Kind::Plane => format!("the plane across axis {end}"),
        },
        _ => {
            let joints = super::text::numbers(start + 1..=end);
            match invariant.kind {
                Kind::Point => format!("the point where axes {joints} meet"),
                Kind::Direction => format!("the common direction of axes {joints}"),
                Kind::Plane => format!("the plane in which joints {joints} move"),
            }
        }
    }
}
