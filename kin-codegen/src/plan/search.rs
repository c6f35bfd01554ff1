//! Best-first search for sequences of subproblems.

use super::invariant::invariants;
use super::relation::{Dependence, Samples};
use super::{Atom, Kind, Plan, Relation, Step, Subproblem, Target};
use crate::geometry::{Linkage, cross, dot, norm};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::ops::Range;
use std::rc::Rc;

/// Relations kept per step; the cheapest to compute is chosen when the step
/// becomes expressions.
const ALTERNATIVES: usize = 6;
/// More choices than this would need more branches than any serial arm has.
const MOST_CHOICES: u8 = 4;
/// How often one set of solved joints is expanded.
const REVISITS: usize = 16;
/// Complements tried for a step.
const COMPLEMENTS: usize = 3;
/// Plans kept that open alike: what fails one is likely to fail all.
const ALIKE: usize = 8;
/// Steps that may degenerate where the arm itself is regular cost this much
/// more.
const MAY_DEGENERATE: u32 = 60;

/// A line sweeps a hyperboloid about an axis where the cosine between them is
/// larger, and otherwise a plane with a hole, of which other relations know.
const ALONG: f64 = 1e-3;
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

/// Plans for a linkage, the cheapest first, each found when it is asked for. The
/// joints that the linkage has locked are known from the start.
///
/// The cost counts subproblems by the work that they are, times the branches
/// that have to do it, and prefers relations whose amplitude is a constant of
/// the arm: those cannot degenerate.
pub struct Plans<'a> {
    linkage: &'a Linkage,
    target: Target,
    relations: Rc<Relations>,
    queue: BinaryHeap<Partial>,
    /// How often a set of solved joints was expanded, by those that were solved
    /// with a complement.
    visits: BTreeMap<(Solved, Solved), usize>,
    /// By their first steps, how many plans were found.
    openings: BTreeMap<Opening, usize>,
}

impl<'a> Plans<'a> {
    /// Nothing is searched yet.
    pub fn new(linkage: &'a Linkage, target: Target) -> Self {
        Self::telling(linkage, target, &[])
    }

    /// As [`Self::new`], but no step may degenerate in any of these configurations: a relation that
    /// does is used together with a complement only.
    pub fn telling(linkage: &'a Linkage, target: Target, configurations: &[Vec<f64>]) -> Self {
        let relations = Relations::new(linkage, target, configurations);
        Self::of(linkage, target, &Rc::new(relations))
    }

    /// From the relations of the linkage, whichever joints it has locked.
    pub fn of(linkage: &'a Linkage, target: Target, relations: &Rc<Relations>) -> Self {
        let mut solved = Solved::default();
        for &joint in &linkage.locked {
            solved.insert(Atom::Joint(joint));
        }
        let start = Partial {
            cost: 0,
            steps: solved.conclude(linkage),
            solved,
            complemented: Solved::default(),
            choices: 0,
        };
        Self {
            linkage,
            target,
            relations: relations.clone(),
            queue: BinaryHeap::from([start]),
            visits: BTreeMap::new(),
            openings: BTreeMap::new(),
        }
    }

    /// Whether too many plans already began like this one.
    fn is_alike(&mut self, steps: &[Rc<Taken>]) -> bool {
        let count = self.openings.entry(opening(steps)).or_default();
        *count += 1;
        *count > ALIKE
    }
}

impl Iterator for Plans<'_> {
    type Item = Plan;

    fn next(&mut self) -> Option<Plan> {
        while let Some(partial) = self.queue.pop() {
            if partial.solved.all(self.linkage.links.len()) {
                if self.is_alike(&partial.steps) {
                    continue;
                }
                let steps = partial.steps.iter();
                let all = &self.relations.all;
                let mut steps: Vec<Step> = steps.map(|taken| taken.step(all)).collect();
                if self.linkage.has_free_turn {
                    // Nobody asks for its angle.
                    let turn = [Atom::Joint(self.linkage.links.len() - 1)];
                    let _ = steps.pop_if(|last| last.unknowns == turn);
                }
                return Some(Plan {
                    steps,
                    target: self.target,
                });
            }
            let visit = self.visits.entry((partial.solved, partial.complemented));
            let visit = visit.or_default();
            *visit += 1;
            if *visit <= REVISITS {
                let swivel = usize::from(self.linkage.swivel.is_some());
                let coordinates = self.target.coordinates() + swivel;
                let determined = self.linkage.variables() == coordinates;
                let known = Known {
                    linkage: self.linkage,
                    relations: &self.relations.all,
                    atoms: &self.relations.atoms,
                    told: &self.relations.told,
                    determined,
                    weak: match self.target {
                        Target::Position => 0.0,
                        _ => WEAK_IN_PAIR,
                    },
                };
                let successors = partial.successors(&known);
                self.queue.extend(successors);
            }
        }
        None
    }
}

/// What plans of a linkage are made of.
pub struct Relations {
    /// Every relation of the loop.
    all: Vec<Relation>,
    /// By relation, what it depends on.
    atoms: Vec<Solved>,
    /// The configurations that a plan has to tell.
    told: Samples,
}

impl Relations {
    /// Of a linkage, for plans that tell some configurations, by joint. They do not depend on the
    /// joints that it has locked.
    pub fn new(linkage: &Linkage, target: Target, configurations: &[Vec<f64>]) -> Self {
        let told = Samples::at(linkage, configurations);
        let all = relations(linkage, target, &told);
        let atoms = all.iter().map(|relation| {
            let mut atoms = Solved::default();
            for depends in &relation.depends {
                atoms.insert(depends.atom);
            }
            atoms
        });
        Self {
            atoms: atoms.collect(),
            all,
            told,
        }
    }
}

/// Every relation of the loop.
fn relations(linkage: &Linkage, target: Target, told: &Samples) -> Vec<Relation> {
    let n = linkage.links.len();
    let samples = Samples::new(linkage);
    let invariants = invariants(linkage, target);
    // A free part of the target can only be crossed by what it leaves alone; that of an orientation
    // leaves every direction alone.
    let is_left_alone = |x: &super::Invariant| {
        x.joints.end == n + 1 || target == Target::Orientation && x.kind == Kind::Direction
    };
    let crosses = |relation: &Relation| {
        !target.is_free()
            || linkage.has_free_turn
            || is_left_alone(&relation.from)
            || relation.to.as_ref().is_some_and(is_left_alone)
    };
    let mut out = Vec::new();
    for a in &invariants {
        if a.kind != Kind::Plane {
            out.extend(Relation::new(linkage, &samples, told, a, None));
        }
        for b in &invariants {
            let comparable = match (a.kind, b.kind) {
                (Kind::Direction, k) | (k, Kind::Direction) => {
                    k == Kind::Direction && a.kind == b.kind
                }
                (Kind::Plane, Kind::Plane) => false,
                _ => true,
            };
            if comparable && a.joints.end <= b.joints.start {
                out.extend(Relation::new(linkage, &samples, told, a, Some(b)));
            }
        }
    }
    out.retain(crosses);
    let swivel = linkage.swivel.as_ref();
    out.extend(swivel.and_then(|swivel| Relation::of_swivel(linkage, &samples, told, swivel)));
    out
}

/// Which joints and which sums of parallel joints are known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Solved {
    joints: u64,
    sums: u64,
}

impl Solved {
    fn has(&self, atom: Atom) -> bool {
        match atom {
            Atom::Joint(i) => self.joints >> i & 1 == 1,
            Atom::Sum { run, .. } => self.sums >> run & 1 == 1,
        }
    }

    fn insert(&mut self, atom: Atom) {
        match atom {
            Atom::Joint(i) => self.joints |= 1 << i,
            Atom::Sum { run, .. } => self.sums |= 1 << run,
        }
    }

    /// How many atoms it lacks of others.
    fn lacks(&self, others: Self) -> u32 {
        (others.joints & !self.joints).count_ones() + (others.sums & !self.sums).count_ones()
    }

    fn all(&self, n: usize) -> bool {
        self.joints.count_ones() as usize == n
    }

    /// Draws the conclusions from sums: all of a run's joints give the sum,
    /// the sum and all but one of them give that one.
    fn conclude(&mut self, linkage: &Linkage) -> Vec<Rc<Taken>> {
        let mut steps = Vec::new();
        for (run, its) in linkage.runs.iter().enumerate() {
            let known = *self;
            let is_missing = |&j: &usize| linkage.is_revolute(j) && !known.has(Atom::Joint(j));
            let mut missing = its.joints.clone().filter(is_missing);
            let sum_known = self.sums >> run & 1 == 1;
            match [missing.next(), missing.next()] {
                [None, _] => self.sums |= 1 << run,
                [Some(joint), None] if sum_known => {
                    self.insert(Atom::Joint(joint));
                    steps.push(Rc::new(Taken {
                        subproblem: Subproblem::Sum,
                        unknowns: vec![Atom::Joint(joint)],
                        posed: Vec::new(),
                        complement: None,
                    }));
                }
                _ => {}
            }
        }
        steps
    }
}

/// What poses a subproblem, by numbers: a relation, and a second one that subproblem 6 takes.
#[derive(Clone, Copy, Debug)]
struct Posed {
    relation: usize,
    with: Option<usize>,
}

impl Posed {
    fn relation(self, relations: &[Relation]) -> Relation {
        Relation {
            with: self.with.map(|second| Box::new(relations[second].clone())),
            ..relations[self.relation].clone()
        }
    }
}

/// A step that was taken. Plans in the making are many, and share most of theirs.
#[derive(Debug)]
struct Taken {
    subproblem: Subproblem,
    unknowns: Vec<Atom>,
    posed: Vec<Posed>,
    complement: Option<Posed>,
}

impl Taken {
    fn step(&self, relations: &[Relation]) -> Step {
        let relation = |posed: &Posed| posed.relation(relations);
        Step {
            subproblem: self.subproblem,
            unknowns: self.unknowns.clone(),
            relations: self.posed.iter().map(relation).collect(),
            complement: self.complement.as_ref().map(relation),
        }
    }
}

/// A plan in the making, ordered by cost.
#[derive(Clone, Debug)]
struct Partial {
    cost: u32,
    solved: Solved,
    /// What was solved with a complement.
    complemented: Solved,
    steps: Vec<Rc<Taken>>,
    choices: u8,
}

impl PartialEq for Partial {
    fn eq(&self, other: &Self) -> bool {
        self.cost == other.cost
    }
}
impl Eq for Partial {}
impl PartialOrd for Partial {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Partial {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        Reverse(self.cost).cmp(&Reverse(other.cost))
    }
}

/// A subproblem, and its unknowns.
type Asked = (Subproblem, Vec<Atom>);

/// A relation that poses a subproblem now.
struct Candidate {
    posed: Posed,
    /// Bit k is set where it degenerates in the k-th configuration that a plan has to tell.
    weak_at: u64,
    cost: u32,
}

/// The candidates by what they pose, the cheapest first.
type Candidates = BTreeMap<Asked, Vec<Candidate>>;

/// The subproblems whose roots can stand in for each other.
fn complementary(subproblem: Subproblem) -> &'static [Subproblem] {
    match subproblem {
        Subproblem::Sp1 => &[Subproblem::Sp1],
        Subproblem::Sp3 | Subproblem::Sp4 => &[Subproblem::Sp3, Subproblem::Sp4],
        _ => &[],
    }
}

/// What a plan begins with: its first steps, and whether they have a complement.
type Opening = Vec<(Subproblem, Vec<Atom>, bool)>;

fn opening(steps: &[Rc<Taken>]) -> Opening {
    let first = steps.iter().take(2);
    first
        .map(|step| {
            let complemented = step.complement.is_some();
            (step.subproblem, step.unknowns.clone(), complemented)
        })
        .collect()
}

/// What the search knows of the arm.
struct Known<'a> {
    linkage: &'a Linkage,
    relations: &'a [Relation],
    /// By relation, what it depends on.
    atoms: &'a [Solved],
    told: &'a Samples,
    /// Whether the target has as many coordinates as there are joints.
    determined: bool,
    /// Relations of a pair depend on both of its unknowns by as much.
    weak: f64,
}

impl Partial {
    fn successors(&self, known: &Known) -> Vec<Partial> {
        let mut steps = Candidates::new();
        let alone = (0..known.relations.len()).filter_map(|relation| self.pose(known, relation));
        for (asked, candidate) in alone.chain(self.pairs(known)) {
            steps.entry(asked).or_default().push(candidate);
        }
        for candidates in steps.values_mut() {
            candidates.sort_by_key(|candidate| candidate.cost);
        }
        steps
            .iter()
            .flat_map(|(asked, candidates)| self.take(known, asked, candidates, &steps))
            .collect()
    }

    /// Which subproblem, if any, a relation poses with what is known.
    fn pose(&self, arm: &Known, number: usize) -> Option<(Asked, Candidate)> {
        let (linkage, relation) = (arm.linkage, &arm.relations[number]);
        let count = self.solved.lacks(arm.atoms[number]) as usize;
        if !(1..=3).contains(&count) {
            return None;
        }
        let mut unknown = [&relation.depends[0]; 3];
        let is_unknown = |d: &&Dependence| !self.solved.has(d.atom);
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
            [a, b] if arm.determined => adjacent(linkage, a.atom, b.atom),
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
        let cost = work + 9 * known + if steady { 0 } else { MAY_DEGENERATE };
        let parallel = match *unknown {
            [a, b] => arm.told.parallel(joint_of(a.atom), joint_of(b.atom)),
            _ => 0,
        };
        let unknowns = unknown.iter().map(|d| d.atom).collect();
        let candidate = Candidate {
            posed: Posed {
                relation: number,
                with: None,
            },
            weak_at: unknown.iter().fold(parallel, |bits, d| bits | d.weak_at),
            cost,
        };
        Some(((subproblem, unknowns), candidate))
    }

    /// Pairs of relations between the same two unknowns, one unknown on the
    /// inner arc of both and one on the outer.
    fn pairs(&self, arm: &Known) -> Vec<(Asked, Candidate)> {
        let linkage = arm.linkage;
        let mut groups: BTreeMap<(Atom, Atom), Vec<usize>> = BTreeMap::new();
        let lacks_two = |number: &usize| self.solved.lacks(arm.atoms[*number]) == 2;
        for number in (0..arm.relations.len()).filter(lacks_two) {
            let relation = &arm.relations[number];
            let mut unknown = relation.depends.iter().filter(|d| !self.solved.has(d.atom));
            let (Some(a), Some(b), None) = (unknown.next(), unknown.next(), unknown.next()) else {
                continue;
            };
            let (inner, outer) = if a.inner { (a, b) } else { (b, a) };
            let usable = relation.to.is_some()
                && inner.inner
                && !outer.inner
                && [a, b]
                    .iter()
                    .all(|d| d.weakest >= arm.weak && !slides(linkage, d.atom));
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
                found.extend(pairs.filter_map(|pair| pair_up(arm, pair, [outer, inner])));
            }
        }
        found
    }

    /// What follows if a step is taken: with the relations that pose it best,
    /// and with a complement where these can degenerate.
    fn take(
        &self,
        arm: &Known,
        (subproblem, unknowns): &Asked,
        candidates: &[Candidate],
        all: &Candidates,
    ) -> Vec<Partial> {
        let Some(best) = candidates.first() else {
            return Vec::new();
        };
        let subproblem = *subproblem;
        let choices = self.choices + subproblem.choices();
        if choices > MOST_CHOICES {
            return Vec::new();
        }
        let step = |cost: u32, posed: Vec<Posed>, complement: Option<Posed>| {
            let mut next = self.clone();
            for &atom in unknowns {
                next.solved.insert(atom);
                if complement.is_some() {
                    next.complemented.insert(atom);
                }
            }
            next.steps.push(Rc::new(Taken {
                subproblem,
                unknowns: unknowns.clone(),
                posed,
                complement,
            }));
            next.steps.extend(next.solved.conclude(arm.linkage));
            next.choices = choices;
            next.cost += cost << choices;
            next
        };
        let tells = |candidate: &&Candidate| candidate.weak_at == 0;
        let mut taken = Vec::new();
        if let Some(alone) = candidates.iter().find(tells) {
            let posed = candidates
                .iter()
                .filter(tells)
                .take(ALTERNATIVES)
                .filter(|c| c.cost < alone.cost + MAY_DEGENERATE)
                .map(|c| c.posed)
                .collect();
            taken.push(step(alone.cost, posed, None));
        }
        let can_degenerate = !arm.determined || best.cost >= MAY_DEGENERATE;
        if let ([atom], true) = (&unknowns[..], can_degenerate) {
            let mut different = vec![best];
            let others = complementary(subproblem)
                .iter()
                .filter_map(|other| all.get(&(*other, unknowns.clone())))
                .flatten();
            for other in others {
                let relation = |of: &Candidate| &arm.relations[of.posed.relation];
                let differs =
                    |known: &&Candidate| relation(other).complements(relation(known), *atom);
                let tells = other.weak_at & best.weak_at == 0;
                if different.len() <= COMPLEMENTS && tells && different.iter().all(differs) {
                    different.push(other);
                    let cost = best.cost + other.cost % MAY_DEGENERATE;
                    taken.push(step(cost, vec![best.posed], Some(other.posed)));
                }
            }
        }
        taken
    }
}

/// Two relations that pose subproblem 6.
fn pair_up(arm: &Known, pair: [usize; 2], unknowns: [Atom; 2]) -> Option<(Asked, Candidate)> {
    let [first, second] = pair.map(|number| &arm.relations[number]);
    let independence = first.independence(second, unknowns)?;
    if independence.slopes < DEPENDENT {
        return None;
    }
    let known = (first.depends.len() + second.depends.len() - 4) as u32;
    let penalty = match independence.steady {
        true => 0,
        false => MAY_DEGENERATE,
    };
    let candidate = Candidate {
        posed: Posed {
            relation: pair[0],
            with: Some(pair[1]),
        },
        weak_at: first.dependent_at(second, arm.linkage, arm.told, unknowns.map(joint_of)),
        cost: 300 + 9 * known + penalty,
    };
    Some(((Subproblem::Sp6, unknowns.to_vec()), candidate))
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
    extent(linkage, a).end == extent(linkage, b).start
}

/// The joints of an unknown.
fn extent(linkage: &Linkage, atom: Atom) -> Range<usize> {
    match atom {
        Atom::Joint(joint) => joint..joint + 1,
        Atom::Sum { run, .. } => linkage.runs[run].joints.clone(),
    }
}

/// Whether two unknowns turn about axes that are all parallel but for noise, with those between them:
/// a vector tells little more than the sum of their angles.
fn is_one_turn(linkage: &Linkage, a: Atom, b: Atom) -> bool {
    let [first, second] = [a, b].map(|atom| extent(linkage, atom));
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
