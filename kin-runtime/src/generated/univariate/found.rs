//! The solutions of a target, as they are found.

use super::frames::{within, wrapped};
use super::polish::Polished;
use super::{LANES, Univariate};
use crate::scalar::tolerance::{SAME, SINGULAR};
use crate::{Solution, Solutions, math};

/// Solutions reach the target to this, in units of the arm's size.
pub(super) const REACHED: f64 = 1e-13;

/// Singular solutions that are nearer to each other, radians or half the arm's size, are one,
/// or members of a family.
const FAMILY: f64 = 1e-4;

/// From so near, in the same units, Newton's method leads to a regular solution.
const BESIDE: f64 = 1e-4;

/// What comes no nearer than this to a target, in units of the arm's size, is not next to a solution.
pub(super) const NEXT_TO: f64 = 1e-6;

/// Of a slide that is farther, in the same units, rounding alone may miss the target.
const FARTHEST: f64 = 1e6;

/// What a search has come to, in the units of the arm's frames.
pub(super) struct Answer {
    pub solutions: Solutions<6>,
    /// What has come near without being one: where the Jacobian has lost two ranks, or one next to a
    /// family of solutions, Newton's steps are at a loss.
    pub nearest: Option<Solution<6>>,
}

/// The solutions so far, in the units of the arm's frames.
pub(super) struct Found {
    /// The arm's size, metres.
    size: f64,
    /// How far the target's rotation is from the one that is reached, radians.
    gap: f64,
    pub regular: Solutions<6>,
    /// Of each regular solution, how far from singular it is.
    pub independence: [f64; Solutions::<6>::CAPACITY],
    /// Where the Jacobian loses rank: these may be members of families, and must not
    /// take the place of others.
    pub singular: Solutions<6>,
    /// Of what is no solution, what comes nearest to the target, if that is near.
    pub nearest: Option<Solution<6>>,
    /// Bit i is set where regular solution i was found again since this was cleared.
    pub again: u32,
}

impl Found {
    pub fn new(arm: &Univariate, gap: f64) -> Self {
        let none = Solutions::with_prismatic(arm.frames.prismatic);
        Self {
            size: arm.size,
            gap,
            regular: none,
            independence: [0.0; Solutions::<6>::CAPACITY],
            singular: none,
            nearest: None,
            again: 0,
        }
    }

    /// Adds the configuration in a lane, if it is a solution; whether it is one.
    pub fn insert(&mut self, arrived: &Polished, lane: usize, branch: u32) -> bool {
        let residual = arrived.residual[lane];
        let is_far = arrived.q.iter().any(|q| q[lane].abs() > FARTHEST);
        if residual > NEXT_TO || residual.is_nan() || is_far {
            return false;
        }
        let independence = arrived.independence[lane];
        let solution = Solution {
            q: wrapped(self.regular.prismatic(), arrived.q.map(|q| q[lane])),
            residual: self.size * math::sqrt(residual * residual + self.gap * self.gap),
            branch,
            singular: independence < SINGULAR,
        };
        if residual > REACHED {
            let is_nearer = |nearest: Solution<6>| solution.residual < nearest.residual;
            if self.nearest.is_none_or(is_nearer) {
                self.nearest = Some(solution);
            }
            return false;
        }
        let prismatic = self.regular.prismatic();
        let is_same = |known: &Solution<6>| within(SAME, prismatic, &known.q, &solution.q);
        // Next to the threshold one that is found twice is what it was the first time.
        if self.singular.iter().any(is_same) {
            return true;
        }
        if !solution.singular || self.regular.iter().any(is_same) {
            let regular = Solution {
                singular: false,
                ..solution
            };
            if let Some(place) = self.regular.insert_distinct(regular) {
                self.again |= 1 << place;
                self.independence[place] = independence;
            }
        } else {
            let known = |known: &Solution<6>| within(FAMILY, prismatic, &known.q, &solution.q);
            if !self.singular.iter().any(known) {
                self.singular.push_if(true, solution);
            }
        }
        true
    }

    /// Whether the solution next to a configuration is known: a regular one, with no other
    /// beside it, where it is `meeting` from singular or more. It is marked as found again.
    pub fn mark_if_known(&mut self, q: &[f64; 6], meeting: f64) -> bool {
        let prismatic = self.regular.prismatic();
        let beside = |known: &Solution<6>| within(BESIDE, prismatic, &known.q, q);
        let mut known = self.regular.iter().zip(&self.independence);
        let place = known.position(|(known, &x)| x > meeting && beside(known));
        if let Some(place) = place {
            self.again |= 1 << place;
        }
        place.is_some()
    }

    /// Adds the configuration in the first lane if it is a singular solution, in front of the others
    /// and in place of one that is next to it.
    pub fn keep(&mut self, arrived: &Polished, branch: u32) {
        if arrived.independence[0] < SINGULAR {
            let prismatic = self.singular.prismatic();
            let others =
                core::mem::replace(&mut self.singular, Solutions::with_prismatic(prismatic));
            self.insert(arrived, 0, branch);
            let kept = self.singular.first().copied();
            for other in &others {
                let replaces = |it: Solution<6>| within(FAMILY, prismatic, &it.q, &other.q);
                self.singular.push_if(!kept.is_some_and(replaces), *other);
            }
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.regular.len() + self.singular.len()
    }

    /// Whether all regular solutions were found again.
    pub fn all_again(&self) -> bool {
        self.again == (1 << self.regular.len()) - 1
    }

    /// The solutions in the order of their branches, as far as there is room for singular
    /// ones.
    pub fn by_branch(&self) -> Solutions<6> {
        let prismatic = self.regular.prismatic();
        let mut all = Solutions::with_prismatic(prismatic);
        for solution in self.regular.iter().chain(&self.singular) {
            all.push_if(true, *solution);
        }
        Solutions::build_with_prismatic(prismatic, |out| {
            push_in_order(out, &all, |solution| f64::from(solution.branch));
        })
    }

    /// The regular solutions, then the singular ones that were found first, as far as there is
    /// room, each in the order of a joint.
    pub fn by_joint(&self, joint: usize) -> Solutions<6> {
        let room = Solutions::<6>::CAPACITY - self.regular.len();
        let singular = &self.singular[..self.singular.len().min(room)];
        Solutions::build_with_prismatic(self.regular.prismatic(), |out| {
            for some in [&self.regular, singular] {
                push_in_order(out, some, |solution| solution.q[joint]);
            }
        })
    }
}

fn push_in_order(out: &mut Solutions<6>, some: &[Solution<6>], by: impl Fn(&Solution<6>) -> f64) {
    let mut taken = 0_u32;
    for _ in some {
        let left = (0..some.len()).filter(|i| taken >> i & 1 == 0);
        let Some(next) = left.min_by(|a, b| by(&some[*a]).total_cmp(&by(&some[*b]))) else {
            break;
        };
        taken |= 1 << next;
        out.push_if(true, some[next]);
    }
}

/// Configurations, as many as are worked on at once.
#[derive(Clone, Copy, Default)]
pub(super) struct Waiting {
    q: [[f64; 6]; LANES],
    pub count: usize,
}

impl Waiting {
    /// Takes one in if there is room.
    pub fn push(&mut self, q: [f64; 6]) {
        if let Some(place) = self.q.get_mut(self.count) {
            *place = q;
            self.count += 1;
        }
    }

    /// The same, unless one is near it already.
    pub fn push_distinct(&mut self, prismatic: u64, q: [f64; 6]) {
        let mut known = self.q[..self.count].iter();
        if !known.any(|known| within(FAMILY, prismatic, known, &q)) {
            self.push(q);
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = &[f64; 6]> {
        self.q[..self.count].iter()
    }

    pub fn is_full(&self) -> bool {
        self.count == LANES
    }

    /// Empties it: by joint, the last one again in the lanes that are left, and how many
    /// they were.
    pub fn take(&mut self) -> ([[f64; LANES]; 6], usize) {
        let count = core::mem::take(&mut self.count);
        let at = |k: usize| &self.q[k.min(count.saturating_sub(1))];
        (
            core::array::from_fn(|j| core::array::from_fn(|k| at(k)[j])),
            count,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generated::univariate::Frames;
    use crate::{Pose, Target};

    /// Newton's method from elsewhere ends a little beside, on the other side of the threshold.
    #[test]
    fn what_is_nearly_singular_is_told_once() {
        let arm = Univariate {
            frames: Frames {
                fixed: [Pose::IDENTITY; 7],
                prismatic: 0,
            },
            size: 2.0,
            counts: Target::Pose,
            eliminations: &[],
        };
        let arrived = |x: f64, independence: f64| Polished {
            q: [[x; LANES]; 6],
            residual: [1e-16; LANES],
            independence: [independence; LANES],
        };
        for (first, second, regular) in [(1.01e-5, 0.99e-5, 1), (0.99e-5, 1.01e-5, 0)] {
            let mut found = Found::new(&arm, 0.0);
            assert!(found.insert(&arrived(0.3, first), 0, 4));
            found.again = 0;
            assert!(found.insert(&arrived(0.3 + 1e-9, second), 0, 5));
            assert_eq!((found.regular.len(), found.len()), (regular, 1));
            assert!(found.all_again());
            assert!(
                found
                    .by_branch()
                    .iter()
                    .all(|it| it.singular == (regular == 0))
            );
            // Another one, a little farther away.
            assert!(found.insert(&arrived(0.3 + 1e-3, second), 0, 6));
            assert_eq!(found.len(), 2);
        }
    }
}
