//! A plan, step by step, by the subproblems of the runtime.

use crate::closed_loop::{Arc, ClosedLoop, Factor, Object, Vec3, dot, sub, wrapped};
use crate::point::point;
use kin_codegen::plan::{Atom, Kind, Plan, Relation, Step, Subproblem};
use kin_runtime::Twist;
use kin_runtime::subproblems::{
    SolutionSet, paden_kahan1, paden_kahan2, paden_kahan3, subproblem1, subproblem2, subproblem4,
    subproblem6, translation1, translation2,
};

/// All configurations that the plan ends with, angles in (−π, π]. Each step is
/// posed by the relation of that index, counted around.
pub fn execute(mut closed: ClosedLoop, plan: &Plan, relation: usize) -> Vec<Vec<f64>> {
    let mut found = Vec::new();
    descend(&mut closed, &plan.steps, relation, &mut found);
    found
}

fn descend(closed: &mut ClosedLoop, steps: &[Step], relation: usize, found: &mut Vec<Vec<f64>>) {
    let Some((step, later)) = steps.split_first() else {
        let value = |joint: usize| {
            // The turn that a target leaves free need not be solved.
            let free = closed.has_free_turn() && joint + 1 == closed.joints();
            let q = closed.q[joint].or(free.then_some(0.0));
            let q = q.expect("the plan solves every joint");
            if closed.turns(joint) { wrapped(q) } else { q }
        };
        return found.push((0..closed.joints()).map(value).collect());
    };
    for values in solve(closed, step, relation) {
        let mut branch = closed.clone();
        for (unknown, value) in step.unknowns.iter().zip(values) {
            branch.set(*unknown, value);
        }
        descend(&mut branch, later, relation, found);
    }
}

/// The solutions; of a family the member given.
fn roots<T: Clone, const N: usize>(
    solutions: SolutionSet<T>,
    values: impl Fn(T) -> [f64; N],
) -> Vec<Vec<f64>> {
    let members = match &solutions {
        SolutionSet::Any(member) => std::slice::from_ref(member),
        _ => solutions.exact(),
    };
    members
        .iter()
        .cloned()
        .map(|root| values(root).to_vec())
        .collect()
}

/// The values of a step's unknowns.
fn solve(closed: &ClosedLoop, step: &Step, relation: usize) -> Vec<Vec<f64>> {
    if step.subproblem == Subproblem::Sum {
        let [Atom::Joint(joint)] = step.unknowns[..] else {
            panic!("a sum is left to one joint")
        };
        return vec![vec![closed.rest(joint)]];
    }
    let relation = &step.relations[relation % step.relations.len()];
    let mut values = match step.unknowns[..] {
        ref unknowns
            if matches!(
                step.subproblem,
                Subproblem::Slides | Subproblem::Lines | Subproblem::Hyperboloid
            ) =>
        {
            point(closed, relation, unknowns)
        }
        [outer, inner] if step.subproblem == Subproblem::Sp6 => sp6(closed, relation, outer, inner),
        [first, second] => sp2(closed, relation, first, second),
        [unknown] => one(closed, step.subproblem, relation, unknown),
        _ => panic!("a subproblem has one unknown or two"),
    };
    // Where the one relation degenerates the other has the roots.
    if let (Some(complement), [unknown]) = (&step.complement, &step.unknowns[..]) {
        let subproblem = complementary(step.subproblem, complement);
        values.extend(one(closed, subproblem, complement, *unknown));
    }
    values
}

/// The subproblem that the complement of a step poses.
fn complementary(subproblem: Subproblem, complement: &Relation) -> Subproblem {
    let to = complement.to.as_ref().map(|to| to.kind);
    match (subproblem, complement.from.kind, to) {
        (Subproblem::Sp1, ..) => Subproblem::Sp1,
        (_, Kind::Point, Some(Kind::Point)) => Subproblem::Sp3,
        _ => Subproblem::Sp4,
    }
}

/// The arcs in front of an unknown and behind it.
fn cut(closed: &ClosedLoop, arc: &Arc, unknown: Atom) -> (Arc, Arc) {
    let (start, end) = closed.extent(unknown);
    let at = |joint| {
        arc.iter()
            .position(|&factor| factor == Factor::Joint(joint))
    };
    let (first, last) = (at(start).unwrap(), at(end - 1).unwrap());
    (arc[..first].to_vec(), arc[last + 1..].to_vec())
}

/// A relation as the unknown sees it: what is in front of its motion, what is
/// behind, and the two objects on the arc without it, in one place.
struct Posed {
    front: Object,
    behind: Object,
    other: [Object; 2],
}

fn posed(closed: &ClosedLoop, relation: &Relation, unknown: Atom) -> Posed {
    let from = Object::from(&relation.from);
    let to = relation.to.as_ref().expect("a relation of two objects");
    let inner = closed.onwards(relation.from.joints.end, to.joints.start);
    let outer = closed.over_target(to.joints.end, relation.from.joints.start);
    let to = Object::from(to);
    let on_inner = inner.contains(&Factor::Joint(closed.extent(unknown).0));
    let (arc, near, far, rest) = if on_inner {
        (inner, from, to, outer)
    } else {
        (outer, to, from, inner)
    };
    let (before, after) = cut(closed, &arc, unknown);
    Posed {
        front: closed.transport_back(&before, near),
        behind: closed.transport(&after, far),
        other: [closed.transport(&rest, near), far],
    }
}

impl Posed {
    /// The cosine of an angle, minus half the square of a distance, or a
    /// height, on the arc without the unknown.
    fn value(&self) -> f64 {
        let [a, b] = self.other;
        match (a.kind, b.kind) {
            (Kind::Direction, _) => dot(a.direction, b.direction),
            (Kind::Point, Kind::Point) => {
                let gap = sub(a.point, b.point);
                -0.5 * dot(gap, gap)
            }
            (Kind::Plane, _) => dot(a.direction, sub(b.point, a.point)),
            _ => dot(b.direction, sub(a.point, b.point)),
        }
    }

    /// The same on the arc with the unknown, as h · R(k, t) p + offset; `centre`
    /// is a point of the axis.
    fn component(&self, centre: Vec3) -> (Vec3, Vec3, f64) {
        let (front, behind) = (self.front, self.behind);
        let [a, b] = [front.point, behind.point].map(|point| sub(point, centre));
        match (front.kind, behind.kind) {
            (Kind::Direction, _) => (front.direction, behind.direction, 0.0),
            (Kind::Point, Kind::Point) => (a, b, -0.5 * (dot(a, a) + dot(b, b))),
            (Kind::Plane, _) => (front.direction, b, -dot(front.direction, a)),
            _ => (a, behind.direction, -dot(behind.direction, b)),
        }
    }
}

/// The ends of a loop that is cut in one object, before and behind the unknowns.
fn ends(closed: &ClosedLoop, relation: &Relation, first: Atom, last: Atom) -> (Object, Object) {
    let from = &relation.from;
    assert!(
        relation.to.is_none(),
        "turned onto itself by the whole loop"
    );
    let arc = closed.over_target(from.joints.end, from.joints.start);
    let (before, _) = cut(closed, &arc, first);
    let (_, after) = cut(closed, &arc, last);
    let object = Object::from(from);
    (
        closed.transport_back(&before, object),
        closed.transport(&after, object),
    )
}

fn one(
    closed: &ClosedLoop,
    which: Subproblem,
    relation: &Relation,
    unknown: Atom,
) -> Vec<Vec<f64>> {
    let (k, centre) = closed.axis(unknown);
    let hinge = Twist::revolute(k, centre);
    let single = |t: f64| [t];
    match which {
        Subproblem::Sp1 => {
            let (front, behind) = ends(closed, relation, unknown, unknown);
            let solutions = match front.kind {
                Kind::Direction => subproblem1(k, behind.direction, front.direction),
                _ => paden_kahan1(&hinge, behind.point, front.point),
            };
            roots(solutions, single)
        }
        Subproblem::Slide => {
            let (front, behind) = ends(closed, relation, unknown, unknown);
            let level = dot(k, front.point);
            roots(translation2(k, k, behind.point, level), single)
        }
        Subproblem::Sp3 => {
            let posed = posed(closed, relation, unknown);
            let distance = (-2.0 * posed.value()).max(0.0).sqrt();
            let (p, q) = (posed.behind.point, posed.front.point);
            roots(paden_kahan3(&hinge, p, q, distance), single)
        }
        Subproblem::Sp4 => {
            let posed = posed(closed, relation, unknown);
            let (h, p, offset) = posed.component(centre);
            let length = dot(h, h).sqrt();
            let level = (posed.value() - offset) / length;
            roots(subproblem4(h.map(|x| x / length), k, p, level), single)
        }
        Subproblem::T1 => {
            let posed = posed(closed, relation, unknown);
            let distance = (-2.0 * posed.value()).max(0.0).sqrt();
            let (p, q) = (posed.behind.point, posed.front.point);
            roots(translation1(k, p, q, distance), single)
        }
        Subproblem::T2 => {
            let posed = posed(closed, relation, unknown);
            // A plane that moves on is a point that stays behind.
            let (normal, foot, point, sense) = match posed.front.kind {
                Kind::Plane => (
                    posed.front.direction,
                    posed.front.point,
                    posed.behind.point,
                    1.0,
                ),
                _ => (
                    posed.behind.direction,
                    posed.front.point,
                    posed.behind.point,
                    -1.0,
                ),
            };
            let level = sense * posed.value();
            roots(translation2(normal, k, sub(point, foot), level), single)
        }
        _ => panic!("{which} has several unknowns"),
    }
}

fn sp2(closed: &ClosedLoop, relation: &Relation, first: Atom, second: Atom) -> Vec<Vec<f64>> {
    let (x, y) = ends(closed, relation, first, second);
    let from = &relation.from;
    let arc = closed.over_target(from.joints.end, from.joints.start);
    let (_, behind) = cut(closed, &arc, first);
    let (between, _) = cut(closed, &behind, second);
    // The second axis and what it turns, as seen from behind the first.
    let (k1, c1) = closed.axis(first);
    let (k2, c2) = closed.axis(second);
    let axis = Object {
        kind: from.kind,
        point: c2,
        direction: k2,
    };
    let (axis, y) = (
        closed.transport(&between, axis),
        closed.transport(&between, y),
    );
    match from.kind {
        Kind::Direction => {
            let solutions = subproblem2(k1, axis.direction, x.direction, y.direction);
            roots(solutions, |[back, t]| [-back, t])
        }
        _ => {
            let hinges =
                [(k1, c1), (axis.direction, axis.point)].map(|(k, c)| Twist::revolute(k, c));
            roots(
                paden_kahan2(&hinges[0], &hinges[1], y.point, x.point),
                |t| t,
            )
        }
    }
}

/// Two relations, each the same along the arc of one unknown and along that of
/// the other.
fn sp6(closed: &ClosedLoop, relation: &Relation, outer: Atom, inner: Atom) -> Vec<Vec<f64>> {
    let second = relation.with.as_ref().expect("a second relation");
    let unknowns = [inner, outer];
    let mut h = [[0.0; 3]; 4];
    let mut k = [[0.0; 3]; 4];
    let mut p = [[0.0; 3]; 4];
    let mut d = [0.0; 2];
    for (i, relation) in [relation, &**second].into_iter().enumerate() {
        for (j, (unknown, sense)) in unknowns.into_iter().zip([1.0, -1.0]).enumerate() {
            let (axis, centre) = closed.axis(unknown);
            let (left, right, offset) = posed(closed, relation, unknown).component(centre);
            let place = 2 * i + j;
            (h[place], k[place], p[place]) = (left.map(|x| x * sense), axis, right);
            d[i] -= sense * offset;
        }
    }
    roots(subproblem6(h, k, p, d), |[inner, outer]| [outer, inner])
}
