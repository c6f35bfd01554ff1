//! All branches of an idealized arm, refined to those of the arm as given.

use super::super::super::generated::acceptance::Acceptance;
use super::super::super::scalar::Real;
use super::super::super::{Jacobian, Pose, Solution, Solutions, math};
use super::curve::{On, follow};
use super::levenberg::levenberg;
use super::linearization::Problem;
use super::newton::{Refined, newton};

/// How far the miss along a curve is followed, in multiples of the near-singular threshold.
const REACH: Real = 2.0;

/// Evaluations of Levenberg's method from a branch that Newton's has lost.
const ARRIVAL: usize = 60;

/// Refines every branch to one of the arm as given. Where the Jacobian is as near to
/// losing rank as the arms differ, the branches of the idealized arm do not tell
/// how many solutions there are, and all others are looked for on the curves
/// through those that were found.
pub fn refine_branches<const N: usize>(
    problem: &Problem<impl Fn(&[Real; N]) -> (Pose, Jacobian<N>)>,
    starts: impl Iterator<Item = Solution<N>> + Clone,
    accept: &Acceptance,
    steps: usize,
) -> Solutions<N> {
    Solutions::build_with_prismatic(accept.prismatic, |solutions| {
        let mut search = Search {
            problem,
            accept,
            steps,
            solutions,
            followed: 0,
        };
        // All are refined before curves are followed, so that solutions bear the
        // number of their own branch.
        let mut lost = 0_u64;
        for (k, start) in starts.clone().enumerate() {
            lost |= u64::from(search.is_lost(&start)) << (k % 64);
        }
        for (k, start) in starts.enumerate() {
            if lost >> (k % 64) & 1 == 1 {
                search.find(&start);
            }
        }
        while let Some(i) = search.not_followed() {
            search.follow_from(i);
        }
    })
}

/// The solutions so far.
struct Search<'a, F, const N: usize> {
    problem: &'a Problem<'a, F>,
    accept: &'a Acceptance,
    steps: usize,
    solutions: &'a mut Solutions<N>,
    /// Bit i is set where the curve through solution i was followed, or need
    /// not be.
    followed: u32,
}

impl<F: Fn(&[Real; N]) -> (Pose, Jacobian<N>), const N: usize> Search<'_, F, N> {
    /// Refines a branch. Whether Newton's method has lost it near a singular
    /// configuration: it has got stuck, or has left the branch.
    fn is_lost(&mut self, start: &Solution<N>) -> bool {
        let refined = newton(self.problem, start.q, self.steps);
        let place = insert(self.solutions, start, &refined, self.accept);
        let near_singular = refined.independence < self.accept.near_singular;
        match place {
            Some(i) if !near_singular => self.followed |= 1 << i,
            _ => {}
        }
        place.is_none() && near_singular
    }

    /// Looks for what a lost branch has become.
    fn find(&mut self, start: &Solution<N>) {
        let found = levenberg(self.problem, start.q, ARRIVAL);
        let found = newton(self.problem, found.q, self.steps);
        if insert(self.solutions, start, &found, self.accept).is_none() {
            self.follow(start, &found);
            self.follow(start, &newton(self.problem, start.q, 1));
        }
    }

    /// Follows the curve through a solution, if it is nearly singular. New
    /// solutions may come in.
    fn follow_from(&mut self, i: usize) {
        self.followed |= 1 << i;
        let start = self.solutions[i];
        let here = newton(self.problem, start.q, 1);
        if here.independence < self.accept.near_singular {
            self.follow(&start, &here);
        }
    }

    fn not_followed(&self) -> Option<usize> {
        (0..self.solutions.len()).find(|i| self.followed >> i & 1 == 0)
    }

    fn follow(&mut self, start: &Solution<N>, from: &Refined<N>) {
        let reach = REACH * self.accept.near_singular;
        follow(self.problem, from.q, from.weak, reach, |q, place| {
            let refined = newton(self.problem, q, self.steps);
            let found = insert(self.solutions, start, &refined, self.accept);
            if let (Some(i), On::Curve) = (found, place) {
                self.followed |= 1 << i;
            }
        });
    }
}

/// Where the solution is among the others; none if it is none.
fn insert<const N: usize>(
    solutions: &mut Solutions<N>,
    start: &Solution<N>,
    refined: &Refined<N>,
    accept: &Acceptance,
) -> Option<usize> {
    if refined.residual > accept.tolerance || refined.residual.is_nan() {
        return None;
    }
    let q = core::array::from_fn(|i| {
        let slides = accept.prismatic >> i & 1 == 1;
        math::select(slides, refined.q[i], math::wrap(refined.q[i]))
    });
    solutions.insert_distinct(Solution {
        q,
        residual: refined.residual,
        singular: refined.singular(),
        ..*start
    })
}
