//! An arm that is solved by a polynomial in one joint.

use super::choose::{Kept, MOST, choose, each};
use super::frames::{Family, frames};
use crate::geometry::Linkage;
use crate::model::Model;
use kin_runtime::__private::univariate::{Between, Eliminant, Elimination, Frames, Univariate};
use kin_runtime::{Pose, Solution, Solutions, Target};
use std::borrow::Cow;

/// Targets that tell how noisy an elimination is.
const FEW: usize = 16;

/// An arm of six joints at most, and those that are kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// The constant motions between its joints, the last of which may be added behind its
    /// tip; joints between them that are given are at zero.
    pub frames: Frames,
    /// Those joints.
    pub between: Vec<Between>,
    /// The arm's size, metres.
    pub size: f64,
    /// What of a target counts.
    pub counts: Target,
    /// The eliminations that are asked, the best first; one at least.
    pub kept: Vec<Kept>,
    /// Those that might be, the best first.
    pub others: Vec<Kept>,
}

impl Arm {
    /// None if there are more than six joints, or none can be kept.
    pub fn new(linkage: &Linkage) -> Option<Self> {
        Self::of(&frames(linkage)?.into(), linkage)
    }

    fn of(family: &Family, linkage: &Linkage) -> Option<Self> {
        let kept = choose(family, linkage.links.len());
        (!kept.is_empty()).then(|| Self::keeping(linkage, family, kept))
    }

    fn keeping(linkage: &Linkage, family: &Family, mut kept: Vec<Kept>) -> Self {
        Self {
            frames: family.frames,
            between: family.between.clone(),
            size: linkage.size,
            counts: match linkage.has_free_turn {
                true => Target::PositionAxis,
                false => Target::Pose,
            },
            others: kept.split_off(kept.len().min(MOST)),
            kept,
        }
    }

    /// The arm with one elimination at a time of all that there are, the best first.
    pub fn alone(&self) -> impl Iterator<Item = Self> {
        let all = self.kept.iter().chain(&self.others);
        all.map(|&kept| Self {
            kept: vec![kept],
            others: Vec::new(),
            ..self.clone()
        })
    }

    /// Asks those first that together lose the fewest of some configurations; of each that
    /// there is, in the order of [`Self::alone`], which of them it loses.
    pub fn losing_fewest(&self, lost: &[Vec<bool>]) -> Self {
        let all: Vec<Kept> = self.kept.iter().chain(&self.others).copied().collect();
        let count = all.len().min(MOST);
        let sets = (0..1_u32 << all.len()).filter(|set| set.count_ones() as usize == count);
        let is_in = |set: u32, i: usize| set >> i & 1 == 1;
        let by_all = |set: u32| {
            let of = |k: usize| (0..all.len()).all(|i| !is_in(set, i) || lost[i][k]);
            (0..lost.first().map_or(0, Vec::len))
                .filter(|&k| of(k))
                .count()
        };
        // Of sets that lose as many, that of the better ones.
        let set = sets.min_by_key(|&set| (by_all(set), set)).unwrap_or(0);
        let part = |asked: bool| {
            let chosen = (0..all.len()).filter(|&i| is_in(set, i) == asked);
            chosen.map(|i| all[i]).collect()
        };
        Self {
            kept: part(true),
            others: part(false),
            ..self.clone()
        }
    }

    /// The arm for targets of this kind of the joints that are not locked: at values of the locked
    /// ones [between](Self::at) them, and for targets that are carried by those at its ends, see
    /// [`Carried`](crate::geometry::Carried). None as in [`new`](Self::new), or if an elimination
    /// does not know such targets.
    pub fn of_targets(model: &Model, linkage: &Linkage, target: Target) -> Option<Self> {
        if linkage.coupling.is_some() {
            return None;
        }
        match target {
            Target::Pose => {
                let (family, linkage) = Family::of(model, linkage)?;
                Self::of(&family, &linkage)
            }
            Target::PositionAxis if linkage.locked.is_empty() => {
                Self::new(&Linkage::for_target(model, target))
            }
            _ => None,
        }
    }

    /// The arm with the joints between its own at these values, radians and metres.
    pub fn at(&self, values: &[f64]) -> Cow<'_, Self> {
        match self.between.is_empty() {
            true => Cow::Borrowed(self),
            false => Cow::Owned(Self {
                frames: self.frames.at(&self.between, values),
                between: Vec::new(),
                ..self.clone()
            }),
        }
    }

    /// The same with every joint kept that can be, one at a time; none if there are more than
    /// six.
    pub fn keeping_each(model: &Model, linkage: &Linkage) -> Vec<Self> {
        let Some((family, linkage)) = Family::of(model, linkage) else {
            return Vec::new();
        };
        let arm = |kept| Self::keeping(&linkage, &family, vec![kept]);
        let rank = |kept: &Kept| (kept.lost, kept.rank());
        each(&family, linkage.links.len(), FEW, rank)
            .into_iter()
            .map(arm)
            .collect()
    }

    /// Whether the best of [those](Self::keeping_each) is of no use: never sure of its answer, and
    /// losing random targets.
    pub fn says_nothing(&self) -> bool {
        self.kept[0].says_nothing(FEW)
    }

    /// What an elimination keeps: `q4`, as the joints are numbered of the arm with this linkage, or what
    /// is added behind its tip.
    pub fn kept_name(&self, kept: &Kept, given: &Linkage) -> String {
        let coordinate = usize::from(kept.elimination.joints[0]);
        match given.joint_of(coordinate) {
            Some(joint) => format!("q{}", joint + 1),
            None if self.counts == Target::PositionAxis => "the turn about the tool".into(),
            None => "a joint behind the tip".into(),
        }
    }

    /// Which joint is kept, of an elimination beside branches, and which others where that is not sure
    /// of its answer.
    pub fn kept_beside(&self, given: &Linkage) -> String {
        let mut joints = self.kept.iter().map(|kept| self.kept_name(kept, given));
        let first = joints.next().unwrap_or_default();
        let others: Vec<String> = joints.collect();
        match others.is_empty() {
            true => first,
            false => format!(
                "{first}, or {} where that is not sure of all,",
                others.join(", then ")
            ),
        }
    }

    /// What generated code computes for a target from the branches of an idealized arm;
    /// see [`Univariate::refined`].
    pub fn refined<const N: usize>(
        &self,
        target: &Pose,
        branches: impl Iterator<Item = Solution<N>>,
        seed: &[f64; N],
        count: usize,
        near_singular: f64,
    ) -> Solutions<N> {
        self.with(|arm| arm.refined(target, branches, seed, count, near_singular))
    }

    /// What generated code computes for a target.
    pub fn solutions<const N: usize>(&self, target: &Pose) -> Solutions<N> {
        self.with(|arm| arm.solutions(target))
    }

    /// The same; if `seed` is a singular solution, it is among them.
    pub fn solutions_near<const N: usize>(&self, target: &Pose, seed: &[f64; N]) -> Solutions<N> {
        self.with(|arm| arm.solutions_near(target, seed))
    }

    /// What generated code has for a target out of reach.
    pub fn closest<const N: usize>(&self, target: &Pose) -> Option<Solution<N>> {
        self.with(|arm| arm.closest(target))
    }

    /// See [`Univariate::eliminant`].
    pub fn eliminant(&self, target: &Pose, which: usize) -> Option<Eliminant> {
        self.with(|arm| arm.eliminant(target, which))
    }

    fn with<T>(&self, run: impl FnOnce(&Univariate) -> T) -> T {
        let eliminations: Vec<Elimination> =
            self.kept.iter().map(|kept| kept.elimination).collect();
        run(&Univariate {
            frames: self.frames,
            size: self.size,
            counts: self.counts,
            eliminations: &eliminations,
        })
    }
}
