//! Best-first search for sequences of subproblems.

use super::posed::{Asked, Candidate, MAY_DEGENERATE, Posed, Posing};
use super::relations::Relations;
use super::solved::Solved;
use super::{Atom, Plan, Relation, Step, Subproblem, Target};
use crate::geometry::Linkage;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
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
        Self::solving(linkage, target, &[])
    }

    /// As [`Self::new`], but no step may degenerate in any of these configurations: a relation that
    /// does is used together with a complement only.
    pub fn solving(linkage: &'a Linkage, target: Target, configurations: &[Vec<f64>]) -> Self {
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
            steps: conclusions(&mut solved, linkage),
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
                let posing = Posing::new(self.linkage, self.target, &self.relations);
                let successors = partial.successors(&posing);
                self.queue.extend(successors);
            }
        }
        None
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

/// The steps that follow from sums.
fn conclusions(solved: &mut Solved, linkage: &Linkage) -> Vec<Rc<Taken>> {
    let step = |joint| Taken {
        subproblem: Subproblem::Sum,
        unknowns: vec![Atom::Joint(joint)],
        posed: Vec::new(),
        complement: None,
    };
    let concluded = solved.conclude(linkage).into_iter();
    concluded.map(step).map(Rc::new).collect()
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

impl Partial {
    fn successors(&self, posing: &Posing) -> Vec<Partial> {
        let mut steps = Candidates::new();
        for (asked, candidate) in posing.posed(self.solved) {
            steps.entry(asked).or_default().push(candidate);
        }
        for candidates in steps.values_mut() {
            candidates.sort_by_key(|candidate| candidate.cost());
        }
        steps
            .iter()
            .flat_map(|(asked, candidates)| self.take(posing, asked, candidates, &steps))
            .collect()
    }

    /// What follows if a step is taken: with the relations that pose it best,
    /// and with a complement where these can degenerate.
    fn take(
        &self,
        posing: &Posing,
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
            next.steps
                .extend(conclusions(&mut next.solved, posing.linkage));
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
                .filter(|c| c.cost() < alone.cost() + MAY_DEGENERATE)
                .map(|c| c.posed)
                .collect();
            taken.push(step(alone.cost(), posed, None));
        }
        let can_degenerate = !posing.determined || !best.steady;
        if let ([atom], true) = (&unknowns[..], can_degenerate) {
            let mut different = vec![best];
            let others = complementary(subproblem)
                .iter()
                .filter_map(|other| all.get(&(*other, unknowns.clone())))
                .flatten();
            for other in others {
                let relation = |of: &Candidate| &posing.relations.all[of.posed.relation];
                let differs =
                    |known: &&Candidate| relation(other).complements(relation(known), *atom);
                let tells = other.weak_at & best.weak_at == 0;
                if different.len() <= COMPLEMENTS && tells && different.iter().all(differs) {
                    different.push(other);
                    let cost = best.cost() + other.work;
                    taken.push(step(cost, vec![best.posed], Some(other.posed)));
                }
            }
        }
        taken
    }
}
