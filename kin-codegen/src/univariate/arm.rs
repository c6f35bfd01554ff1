//! An arm that is solved by a polynomial in one joint.

use super::choose::{Kept, choose, each};
use super::frames::frames;
use crate::geometry::{Carried, Linkage};
use crate::model::Model;
use kin_runtime::__private::univariate::{Eliminant, Elimination, Frames, Univariate};
use kin_runtime::{Pose, Solution, Solutions, Target};

/// Targets that tell how noisy an elimination is.
const FEW: usize = 16;

/// An arm of six joints at most, and those that are kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// The constant motions between its joints, the last of which may be added behind its
    /// tip.
    pub frames: Frames,
    /// The arm's size, metres.
    pub size: f64,
    /// What of a target counts.
    pub counts: Target,
    /// The eliminations, the best first; one at least.
    pub kept: Vec<Kept>,
}

impl Arm {
    /// None if there are more than six joints, or none can be kept.
    pub fn new(linkage: &Linkage) -> Option<Self> {
        let frames = frames(linkage)?;
        let kept = choose(&frames, linkage.links.len());
        (!kept.is_empty()).then(|| Self::keeping(linkage, frames, kept))
    }

    fn keeping(linkage: &Linkage, frames: Frames, kept: Vec<Kept>) -> Self {
        Self {
            frames,
            size: linkage.size,
            counts: match linkage.has_free_turn {
                true => Target::PositionAxis,
                false => Target::Pose,
            },
            kept,
        }
    }

    /// The arm between the locked joints of a linkage, which have to stand at its ends;
    /// its targets are [`Carried`].
    pub fn between(model: &Model, linkage: &Linkage) -> Option<Self> {
        let locked = &linkage.locked;
        match locked.is_empty() {
            true => Self::new(linkage),
            false if !Carried::new(linkage).is_all(linkage) => None,
            false => {
                let between = model.locked(locked, &vec![0.0; locked.len()]);
                Self::new(&Linkage::new(&between))
            }
        }
    }

    /// The arm with every joint kept that can be, one at a time; none if there are more than
    /// six.
    pub fn keeping_each(linkage: &Linkage) -> Vec<Self> {
        let Some(frames) = frames(linkage) else {
            return Vec::new();
        };
        let arm = |kept| Self::keeping(linkage, frames, vec![kept]);
        each(&frames, linkage.links.len(), FEW)
            .into_iter()
            .map(arm)
            .collect()
    }

    /// What generated code computes for a target from the branches of an idealized arm;
    /// see [`Univariate::refined`].
    pub fn refined<const N: usize>(
        &self,
        target: &Pose,
        branches: impl Iterator<Item = Solution<N>>,
        count: usize,
        near_singular: f64,
    ) -> Solutions<N> {
        self.with(|arm| arm.refined(target, branches, count, near_singular))
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
