//! Which subproblems the relations of a loop pose.

use super::relation::Dependence;
use super::relations::Relations;
use super::solved::Solved;
use super::{Atom, Kind, Relation, Subproblem, Target};
use crate::geometry::{Linkage, cross, dot, norm};
use std::collections::BTreeMap;

/// Steps that may degenerate where the arm itself is regular cost this much
/// more.
pub(super) const MAY_DEGENERATE: u32 = 60;

/// A line sweeps a hyperboloid about an axis where the cosine between them is
/// larger, and otherwise a plane with a hole, of which other relations know.
const ALONG: f64 = 1e-3;
/// Relations with a weaker dependence on an unknown are those of axes that are parallel, or of points
/// on an axis, but for a few digits: as many of the unknown are lost, and next to where they are
/// stationary all of them. They cost twice what one does that may
/// degenerate.
const FAINT: f64 = 1e-3;
/// Relations whose dependence on an unknown is weaker than this cannot
/// determine it.
const WEAK: f64 = 1e-6;
/// Axes at a smaller angle, radians, are parallel but for noise.
const PARALLEL: f64 = 1e-3;
/// Of a pair of relations of a pose: what noise alone tells of it an elimination tells better. Beside
/// those of a position there is none.
const WEAK_IN_PAIR: f64 = 1e-5;
/// Two relations more alike than this cannot determine two unknowns.
const DEPENDENT: f64 = 1e-2;

/// What poses a subproblem, by numbers: a relation, and a second one that subproblem 6 takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Posed {
    pub relation: usize,
    with: Option<usize>,
}

impl Posed {
    pub fn relation(self, relations: &[Relation]) -> Relation {
        Relation {
            with: self.with.map(|second| Box::new(relations[second].clone())),
            ..relations[self.relation].clone()
        }
    }
}

/// A subproblem, and its unknowns.
pub(super) type Asked = (Subproblem, Vec<Atom>);

/// A relation that poses a subproblem now.
pub(super) struct Candidate {
    pub posed: Posed,
    /// Bit k is set where it degenerates in the k-th configuration that a plan has to tell.
    pub weak_at: u64,
    /// Operations, about.
    pub work: u32,
    /// Whether it degenerates nowhere, or everywhere: what it depends on does not move.
    pub steady: bool,
    /// Whether it tells an unknown by few digits.
    faint: bool,
}

impl Candidate {
    /// What a search pays for it.
    pub fn cost(&self) -> u32 {
        let degenerate = u32::from(!self.steady) + 2 * u32::from(self.faint);
        self.work + degenerate * MAY_DEGENERATE
    }
}

/// The relations of an arm, and what is known of it.
pub(super) struct Posing<'a> {
    pub linkage: &'a Linkage,
    pub relations: &'a Relations,
    /// Whether the target has as many coordinates as there are joints.
    pub determined: bool,
    /// Relations of a pair depend on both of its unknowns by as much.
    weak: f64,
}

impl<'a> Posing<'a> {
    pub fn new(linkage: &'a Linkage, target: Target, relations: &'a Relations) -> Self {
        let swivel = usize::from(linkage.swivel.is_some());
        Self {
            linkage,
            relations,
            determined: linkage.variables() == target.coordinates() + swivel,
            weak: match target {
                Target::Position => 0.0,
                _ => WEAK_IN_PAIR,
            },
        }
    }

    /// What may be solved next.
    pub fn posed(&self, solved: Solved) -> impl Iterator<Item = (Asked, Candidate)> {
        let alone = (0..self.relations.all.len()).filter_map(move |i| self.pose(solved, i));
        alone.chain(self.pairs(solved))
    }

    /// Which subproblem, if any, a relation poses with what is known.
    fn pose(&self, solved: Solved, number: usize) -> Option<(Asked, Candidate)> {
        let (linkage, relation) = (self.linkage, &self.relations.all[number]);
        let count = solved.lacks(self.relations.atoms[number]) as usize;
        if !(1..=3).contains(&count) {
            return None;
        }
        let mut unknown = [&relation.depends[0]; 3];
        let is_unknown = |d: &&Dependence| !solved.has(d.atom);
        for (place, d) in unknown
            .iter_mut()
            .zip(relation.depends.iter().filter(is_unknown))
        {
            *place = d;
        }
        let unknown = &unknown[..count];
        let known = (relation.depends.len() - unknown.len()) as u32;
        let subproblem = match *unknown {
            [_] if relation.is_swivel => return None,
            [one] => single(linkage, relation, one.atom),
            [a, b] if relation.to.is_none() && pair(linkage, relation, a.atom, b.atom) => {
                Subproblem::Sp2
            }
            _ => with_slides(linkage, relation, unknown)?,
        };
        if unknown.iter().any(|d| d.weakest < WEAK) {
            return None;
        }
        let steady = match *unknown {
            // Its own degeneracy is that of the arm, as long as the angle
            // between its axes is a constant of the arm. A target that asks
            // for more can determine what the one vector leaves free.
            [a, b] if self.determined => adjacent(linkage, a.atom, b.atom),
            _ => unknown.iter().all(|d| d.steady),
        };
        let work = match subproblem {
            Subproblem::Sum => 2,
            Subproblem::Slide | Subproblem::T2 => 6,
            Subproblem::Sp1 => 30,
            Subproblem::Sp4 | Subproblem::T1 => 40,
            Subproblem::Sp3 => 46,
            Subproblem::Sp2 | Subproblem::Slides => 64,
            Subproblem::Lines => 90,
            Subproblem::Sp6 | Subproblem::Hyperboloid => 300,
            // No relation poses it: it is what is left when the search finds nothing.
            Subproblem::Univariate => 1000,
        };
        let parallel = match *unknown {
            [a, b] => self
                .relations
                .to_solve
                .parallel(joint_of(a.atom), joint_of(b.atom)),
            _ => 0,
        };
        let unknowns = unknown.iter().map(|d| d.atom).collect();
        let candidate = Candidate {
            posed: Posed {
                relation: number,
                with: None,
            },
            weak_at: unknown.iter().fold(parallel, |bits, d| bits | d.weak_at),
            work: work + 9 * known,
            steady,
            faint: unknown.iter().any(|d| d.weakest < FAINT),
        };
        Some(((subproblem, unknowns), candidate))
    }

    /// Pairs of relations between the same two unknowns, one unknown on the
    /// inner arc of both and one on the outer.
    fn pairs(&self, solved: Solved) -> Vec<(Asked, Candidate)> {
        let linkage = self.linkage;
        let mut groups: BTreeMap<(Atom, Atom), Vec<usize>> = BTreeMap::new();
        let lacks_two = |number: &usize| solved.lacks(self.relations.atoms[*number]) == 2;
        for number in (0..self.relations.all.len()).filter(lacks_two) {
            let relation = &self.relations.all[number];
            let mut unknown = relation.depends.iter().filter(|d| !solved.has(d.atom));
            let (Some(a), Some(b), None) = (unknown.next(), unknown.next(), unknown.next()) else {
                continue;
            };
            let (inner, outer) = if a.inner { (a, b) } else { (b, a) };
            let usable = relation.to.is_some()
                && inner.inner
                && !outer.inner
                && [a, b]
                    .iter()
                    .all(|d| d.weakest >= self.weak && !slides(linkage, d.atom));
            if usable {
                groups
                    .entry((outer.atom, inner.atom))
                    .or_default()
                    .push(number);
            }
        }
        let mut found = Vec::new();
        for ((outer, inner), group) in groups {
            for (i, &first) in group.iter().enumerate() {
                let pairs = group[i + 1..].iter().map(|&second| [first, second]);
                found.extend(pairs.filter_map(|pair| self.pair_up(pair, [outer, inner])));
            }
        }
        found
    }

    /// Two relations that pose subproblem 6.
    fn pair_up(&self, pair: [usize; 2], unknowns: [Atom; 2]) -> Option<(Asked, Candidate)> {
        let [first, second] = pair.map(|number| &self.relations.all[number]);
        let independence = first.independence(second, unknowns)?;
        if independence.slopes < DEPENDENT {
            return None;
        }
        let known = (first.depends.len() + second.depends.len() - 4) as u32;
        let candidate = Candidate {
            posed: Posed {
                relation: pair[0],
                with: Some(pair[1]),
            },
            weak_at: first.dependent_at(
                second,
                self.linkage,
                &self.relations.to_solve,
                unknowns.map(joint_of),
            ),
            work: 300 + 9 * known,
            steady: independence.steady,
            faint: false,
        };
        Some(((Subproblem::Sp6, unknowns.to_vec()), candidate))
    }
}

fn slides(linkage: &Linkage, atom: Atom) -> bool {
    match atom {
        Atom::Joint(j) => !linkage.is_revolute(j),
        Atom::Sum { .. } => false,
    }
}

fn single(linkage: &Linkage, relation: &Relation, atom: Atom) -> Subproblem {
    let kinds = (relation.from.kind, relation.to.as_ref().map(|to| to.kind));
    match (kinds, slides(linkage, atom)) {
        ((_, None), true) => Subproblem::Slide,
        ((_, None), false) => Subproblem::Sp1,
        ((Kind::Point, Some(Kind::Point)), true) => Subproblem::T1,
        ((Kind::Point, Some(Kind::Point)), false) => Subproblem::Sp3,
        (_, true) => Subproblem::T2,
        (_, false) => Subproblem::Sp4,
    }
}

/// The subproblem of a point whose unknowns turn and slide it.
fn with_slides(
    linkage: &Linkage,
    relation: &Relation,
    unknown: &[&Dependence],
) -> Option<Subproblem> {
    if relation.to.is_some() || relation.from.kind != Kind::Point {
        return None;
    }
    let is_slide: Vec<bool> = unknown.iter().map(|d| slides(linkage, d.atom)).collect();
    let tilted = |slide: &Dependence, turn: &Dependence| {
        let (Atom::Joint(slide), Atom::Joint(turn)) = (slide.atom, turn.atom) else {
            return false;
        };
        let [v, axis] = [slide, turn].map(|joint| linkage.axis(joint).direction);
        slide.abs_diff(turn) == 1 && dot(v, axis).abs() > ALONG
    };
    match (&is_slide[..], unknown) {
        ([true, true] | [true, true, true], _) => Some(Subproblem::Slides),
        ([true, false, true], _) => Some(Subproblem::Lines),
        ([false, false, true], [_, turn, slide]) | ([true, false, false], [slide, turn, _])
            if tilted(slide, turn) =>
        {
            Some(Subproblem::Hyperboloid)
        }
        _ => None,
    }
}

/// The joint of an unknown, of a sum the first.
fn joint_of(atom: Atom) -> usize {
    match atom {
        Atom::Joint(joint) => joint,
        Atom::Sum { first, .. } => first,
    }
}

/// Whether nothing lies between two unknowns.
fn adjacent(linkage: &Linkage, a: Atom, b: Atom) -> bool {
    a.joints(linkage).end == b.joints(linkage).start
}

/// Whether two unknowns turn about axes that are all parallel but for noise, with those between them:
/// a vector tells little more than the sum of their angles.
fn is_one_turn(linkage: &Linkage, a: Atom, b: Atom) -> bool {
    let [first, second] = [a, b].map(|atom| atom.joints(linkage));
    let direction = linkage.axis(first.start).direction;
    let is_parallel = |joint| {
        !linkage.is_revolute(joint)
            || norm(cross(direction, linkage.axis(joint).direction)) < PARALLEL
    };
    // Behind the last joint the target comes between them.
    first.start < second.start && (first.start..second.end).all(is_parallel)
}

/// Whether two unknowns of a vector relation make a subproblem 2: rotations that are not one turn,
/// and for a point neighbours whose axes intersect.
fn pair(linkage: &Linkage, relation: &Relation, a: Atom, b: Atom) -> bool {
    // The axes of joints that are coupled are not idealized, and noise may be all that tells them.
    if linkage.coupling.is_none() && is_one_turn(linkage, a, b) {
        return false;
    }
    if relation.from.kind == Kind::Direction {
        return true;
    }
    let (Atom::Joint(i), Atom::Joint(j)) = (a, b) else {
        return false;
    };
    if j != i + 1 || !linkage.is_revolute(i) || !linkage.is_revolute(j) {
        return false;
    }
    let (first, second) = (linkage.axis(i), linkage.axis(j));
    norm(cross(first.direction, second.direction)) > 1e-6
        && first.distance(&second) < 1e-11 * linkage.size
}
