//! All relations of a loop.

use super::Target;
use super::invariant::{Invariant, Kind, invariants};
use super::relation::{Relation, Samples};
use super::solved::Solved;
use crate::geometry::Linkage;

/// What plans of a linkage are made of.
pub struct Relations {
    /// Every relation of the loop.
    pub(super) all: Vec<Relation>,
    /// By relation, what it depends on.
    pub(super) atoms: Vec<Solved>,
    /// The configurations that a plan has to solve.
    pub(super) to_solve: Samples,
}

impl Relations {
    /// Of a linkage, for plans that solve some configurations, by joint. They do not depend on the
    /// joints that it has locked.
    pub fn new(linkage: &Linkage, target: Target, configurations: &[Vec<f64>]) -> Self {
        let to_solve = Samples::at(linkage, configurations);
        let all = relations(linkage, target, &to_solve);
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
            to_solve,
        }
    }
}

/// Every relation of the loop.
fn relations(linkage: &Linkage, target: Target, to_solve: &Samples) -> Vec<Relation> {
    let n = linkage.links.len();
    let samples = Samples::new(linkage);
    let invariants = invariants(linkage, target);
    // A free part of the target can only be crossed by what it leaves alone; that of an orientation
    // leaves every direction alone.
    let is_left_alone = |x: &Invariant| {
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
            out.extend(Relation::new(linkage, &samples, to_solve, a, None));
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
                out.extend(Relation::new(linkage, &samples, to_solve, a, Some(b)));
            }
        }
    }
    out.retain(crosses);
    let swivel = linkage.swivel.as_ref();
    out.extend(swivel.and_then(|swivel| Relation::of_swivel(linkage, &samples, to_solve, swivel)));
    out
}
