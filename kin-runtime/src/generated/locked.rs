//! Answers of an arm some of whose joints are given with the target: what was solved is
//! the arm of the others, and what is returned are values of all joints.

use super::super::scalar::Real;
use super::super::{Jacobian, Pose, Solution, Solutions, Target, math};
use super::acceptance::Acceptance;
use super::branches::Branches;
use super::refinement::{Problem, correct_branches};

/// Joints that are given, with their values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Locked<const K: usize> {
    /// Their places among all joints, ascending.
    joints: [usize; K],
    /// Radians in (−π, π], and metres.
    values: [Real; K],
    /// Bit i is set where joint i of all joints is prismatic.
    prismatic: u64,
}

impl<const K: usize> Locked<K> {
    /// From their places, ascending, their values, radians and metres, and the
    /// prismatic ones among all joints.
    #[inline(always)]
    pub fn new(joints: [usize; K], values: [Real; K], prismatic: u64) -> Self {
        let wrapped = |k: usize| {
            let slides = prismatic >> joints[k] & 1 == 1;
            math::select(slides, values[k], math::wrap(values[k]))
        };
        Locked {
            joints,
            values: core::array::from_fn(wrapped),
            prismatic,
        }
    }

    /// Whether all of them are numbers: a value that a target does not depend on would be none in
    /// what is returned.
    #[inline(always)]
    fn are_finite(&self) -> bool {
        let mut finite = true;
        for value in self.values {
            finite &= value.is_finite();
        }
        finite
    }

    /// The value of joint i of all joints, if it is given, or which of the others it is.
    #[inline(always)]
    fn place(&self, i: usize) -> Result<Real, usize> {
        let mut before = 0;
        for (joint, value) in self.joints.iter().zip(self.values) {
            if *joint == i {
                return Ok(value);
            }
            before += usize::from(*joint < i);
        }
        Err(i - before)
    }

    /// The values of all M joints, from those of the N others.
    #[inline(always)]
    pub fn whole<const N: usize, const M: usize>(&self, q: &[Real; N]) -> [Real; M] {
        core::array::from_fn(|i| self.place(i).unwrap_or_else(|other| q[other]))
    }

    /// The values of the N others among all M joints.
    #[inline(always)]
    pub fn others<const N: usize, const M: usize>(&self, q: &[Real; M]) -> [Real; N] {
        let mut others = [0.0; N];
        for (i, value) in q.iter().enumerate() {
            if let Err(other) = self.place(i) {
                others[other] = *value;
            }
        }
        others
    }

    /// The columns of the N others.
    fn columns<const N: usize, const M: usize>(&self, jacobian: &Jacobian<M>) -> Jacobian<N> {
        Jacobian {
            rows: jacobian.rows.map(|row| self.others(&row)),
        }
    }

    #[inline(always)]
    fn widened<const N: usize, const M: usize>(&self, solution: &Solution<N>) -> Solution<M> {
        Solution {
            q: self.whole(&solution.q),
            residual: solution.residual,
            branch: solution.branch,
            singular: solution.singular,
        }
    }

    /// Solutions for the others, with the values that are given.
    #[inline]
    pub fn all<const N: usize, const M: usize>(&self, others: &Solutions<N>) -> Solutions<M> {
        let finite = self.are_finite();
        Solutions::build_with_prismatic(self.prismatic, |solutions| {
            for solution in others {
                solutions.push_if(finite, self.widened(solution));
            }
        })
    }

    /// As [`Branches::solutions`].
    #[inline(always)]
    pub fn solutions<const N: usize, const M: usize, const L: usize>(
        &self,
        branches: &Branches<N, L>,
        accept: &Acceptance,
    ) -> Solutions<M> {
        let finite = self.are_finite();
        Solutions::build_with_prismatic(self.prismatic, |solutions| {
            for k in 0..L {
                let exists = finite & (branches.invalid[k] <= 0.0);
                let reaches = branches.residual[k] <= accept.taken;
                solutions.push_if(exists & reaches, self.widened(&branches.lane(k)));
            }
        })
    }

    /// As [`Branches::corrected`]; the arm is given by the pose and spatial Jacobian of
    /// all joints.
    #[inline(always)]
    pub fn corrected<const N: usize, const M: usize, const L: usize>(
        &self,
        branches: &Branches<N, L>,
        fk_jacobian: impl Fn(&[Real; M]) -> (Pose, Jacobian<M>),
        target: &Pose,
        counts: Target,
        seed: &[Real; M],
        accept: &Acceptance,
    ) -> Solutions<M> {
        match branches.nearly(accept) | branches.are_singular(accept) {
            true => self.correct(branches, fk_jacobian, target, counts, seed, accept),
            false => self.solutions(branches, accept),
        }
    }

    #[cold]
    #[inline(never)]
    fn correct<const N: usize, const M: usize, const L: usize>(
        &self,
        branches: &Branches<N, L>,
        fk_jacobian: impl Fn(&[Real; M]) -> (Pose, Jacobian<M>),
        target: &Pose,
        counts: Target,
        seed: &[Real; M],
        accept: &Acceptance,
    ) -> Solutions<M> {
        let problem = self.problem(fk_jacobian, target, counts, accept);
        let seed = self.others(seed);
        self.all(&correct_branches(
            &problem,
            branches.existing(),
            &seed,
            accept,
        ))
    }

    /// The arm of the others.
    fn problem<'a, const N: usize, const M: usize>(
        &'a self,
        fk_jacobian: impl Fn(&[Real; M]) -> (Pose, Jacobian<M>) + 'a,
        target: &'a Pose,
        counts: Target,
        accept: &Acceptance,
    ) -> Problem<'a, impl Fn(&[Real; N]) -> (Pose, Jacobian<N>) + 'a> {
        let of_the_others = move |q: &[Real; N]| {
            let (pose, jacobian) = fk_jacobian(&self.whole(q));
            (pose, self.columns(&jacobian))
        };
        Problem::new(of_the_others, target, counts, accept)
    }
}
