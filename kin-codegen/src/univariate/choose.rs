//! Which joints to keep.

use super::eliminate::eliminate;
use super::frames::Family;
use crate::random::Random;
use crate::threads;
use kin_runtime::__private::univariate::{Elimination, Frames, Outcome, Univariate};
use kin_runtime::Target;
use std::f64::consts::{FRAC_PI_2, PI};

/// Targets that every joint is tried on.
const TARGETS: usize = 128;
/// A solution that is so near is the one.
const SAME: f64 = 1e-5;
/// Eliminations at most: the next is asked where one is not sure of its
/// answer.
pub const MOST: usize = 3;

/// An elimination with more noise, a tenth of that with which no answer is sure, is not used where
/// others have less.
const NOISY: f64 = 1e-10;

/// How many times longer it takes to ask another elimination, and to look where solutions may have met,
/// than to look for those next to others: about 60 µs and 6 of a CRX-10iA/L.
const UNSURE: f64 = 10.0;

/// An elimination that is never sure of its answer and loses at least one target in so many is not
/// used.
const MANY: usize = 16;

/// An elimination, and how it did on random targets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// Its constants.
    pub elimination: Elimination,
    /// How many targets it lost.
    pub lost: usize,
    /// On how many of these it was sure to have all solutions.
    pub wrong: usize,
    /// On how many targets of a hundred it was not sure to have all solutions.
    pub unsure: f64,
    /// On how many of a hundred it had to look for solutions that are next to others.
    pub unclear: f64,
    /// The noise of its polynomial, relative to the largest coefficient, at 95 of
    /// a hundred targets.
    pub noise: f64,
}

impl Kept {
    /// The less the better near singular configurations, where it is asked beside branches: noise that
    /// leaves no answer sure, then how often it is not sure, what it takes, and noise.
    pub(crate) fn rank(&self) -> [u64; 4] {
        let noise = self.noise.max(NOISY);
        // Of numbers that are not negative the bits have the same order.
        [noise, self.unsure, self.unclear, self.noise].map(f64::to_bits)
    }

    /// The same where it is asked of all targets, and others where it is not sure: what it is wrong
    /// of, noise that leaves no answer sure, then the time that it takes beyond what all take, what it
    /// loses, and noise.
    fn rank_alone(&self) -> [u64; 5] {
        let noise = self.noise.max(NOISY);
        let time = UNSURE * self.unsure + self.unclear;
        let [wrong, lost] = [self.wrong, self.lost].map(|count| count as f64);
        [wrong, noise, time, lost, self.noise].map(f64::to_bits)
    }

    /// Whether it is never sure of its answer and loses some of so many random targets.
    pub(super) fn says_nothing(&self, targets: usize) -> bool {
        self.unsure == 100.0 && self.lost * MANY >= targets
    }
}

/// The joints to keep of the first ones, the one that separates solutions best first; empty
/// where no joint will do. The first [`MOST`] are asked, where those are enough.
pub fn choose(family: &Family, joints: usize) -> Vec<Kept> {
    let mut kept = each(family, joints, TARGETS, Kept::rank_alone);
    kept.retain(|kept| !kept.says_nothing(TARGETS));
    kept
}

/// The first joints that can be kept, the best first, as they did on random targets and on those
/// of nearly round configurations, at which solutions like to share values of a joint; `rank` is less
/// for the better.
pub fn each<R: Ord>(
    family: &Family,
    joints: usize,
    targets: usize,
    rank: impl Fn(&Kept) -> R,
) -> Vec<Kept> {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let target = |k: usize| {
        let mut q: [f64; 6] = std::array::from_fn(|_| random.between(-PI, PI));
        for _ in 0..k % 3 {
            let round = random.below(4) as f64 * FRAC_PI_2;
            q[random.below(6)] = round + 10f64.powf(random.between(-8.0, -1.0));
        }
        q[joints..].fill(0.0);
        q
    };
    let targets: Vec<[f64; 6]> = (0..targets).map(target).collect();
    let samples = family.sampled();
    let eliminations = (0..joints).flat_map(|joint| eliminate(family, joint));
    let eliminations: Vec<Elimination> = eliminations.collect();
    let mut kept = threads::each(&eliminations, |elimination| {
        tried(&samples, *elimination, &targets)
    });
    kept.sort_by_key(rank);
    // Of those that differ in rows and columns alone the best tells as much as all.
    let equations = |kept: &Kept| (kept.elimination.joints, kept.elimination.powers);
    let mut seen = Vec::new();
    kept.retain(|kept| {
        let is_new = !seen.contains(&equations(kept));
        seen.push(equations(kept));
        is_new
    });
    kept
}

fn tried(samples: &[Frames], elimination: Elimination, targets: &[[f64; 6]]) -> Kept {
    let (mut lost, mut wrong) = (0, 0);
    let outcomes = targets
        .iter()
        .zip(samples.iter().cycle())
        .map(|(q, frames)| {
            let arm = Univariate {
                frames: *frames,
                size: 2.0,
                counts: Target::Pose,
                eliminations: &[],
            };
            let (outcome, found) = arm.outcome(&elimination, &frames.forward(q));
            let is_lost = !found.iter().any(|found| frames.within(SAME, &found.q, q));
            lost += usize::from(is_lost);
            wrong += usize::from(is_lost && outcome.certain);
            outcome
        });
    let outcomes: Vec<_> = outcomes.collect();
    let share = |of: &dyn Fn(&Outcome) -> bool| {
        let count = outcomes.iter().filter(|outcome| of(outcome)).count();
        100.0 * count as f64 / targets.len() as f64
    };
    let mut noises: Vec<f64> = outcomes.iter().map(|outcome| outcome.noise).collect();
    noises.sort_by(f64::total_cmp);
    Kept {
        elimination,
        lost,
        wrong,
        unsure: share(&|outcome| !outcome.certain),
        unclear: share(&|outcome| outcome.unclear > 0),
        noise: noises[noises.len() * 95 / 100],
    }
}
