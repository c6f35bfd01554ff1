//! All branches of a snapped arm, landed on the literal one.

use super::curve::{On, follow};
use super::place::Problem;
use super::settle::settle;
use super::{Polished, polish};
use crate::branches::Acceptance;
use crate::{Jacobian, Pose, Solution, Solutions, math};

/// How far the miss along a curve is followed, in multiples of the blur.
const REACH: f64 = 2.0;

/// Lands every branch on the literal arm. Where the Jacobian is as near to
/// losing rank as the arms differ, the branches of the snapped arm do not tell
/// how many solutions there are, and all others are looked for on the curves
/// through those that were found.
pub fn land<const N: usize>(
    problem: &Problem<impl Fn(&[f64; N]) -> (Pose, Jacobian<N>)>,
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
        // All land before curves are followed, so that solutions bear the
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

impl<F: Fn(&[f64; N]) -> (Pose, Jacobian<N>), const N: usize> Search<'_, F, N> {
    /// Lands a branch. Whether Newton's method has lost it near a singular
    /// configuration: it has got stuck, or has left the branch.
    fn is_lost(&mut self, start: &Solution<N>) -> bool {
        let landed = polish(self.problem, start.q, self.steps);
        let place = insert(self.solutions, start, &landed, self.accept);
        let near_singular = landed.independence < self.accept.blur;
        match place {
            Some(i) if !near_singular => self.followed |= 1 << i,
            _ => {}
        }
        place.is_none() && near_singular
    }

    /// Looks for what a lost branch has become.
    fn find(&mut self, start: &Solution<N>) {
        let settled = settle(self.problem, start.q);
        let settled = polish(self.problem, settled.q, self.steps);
        if insert(self.solutions, start, &settled, self.accept).is_none() {
            self.follow(start, &settled);
            self.follow(start, &polish(self.problem, start.q, 1));
        }
    }

    /// Follows the curve through a solution, if it is nearly singular. New
    /// solutions may come in.
    fn follow_from(&mut self, i: usize) {
        self.followed |= 1 << i;
        let start = self.solutions[i];
        let here = polish(self.problem, start.q, 1);
        if here.independence < self.accept.blur {
            self.follow(&start, &here);
        }
    }

    fn not_followed(&self) -> Option<usize> {
        (0..self.solutions.len()).find(|i| self.followed >> i & 1 == 0)
    }

    fn follow(&mut self, start: &Solution<N>, from: &Polished<N>) {
        let reach = REACH * self.accept.blur;
        follow(self.problem, from.q, from.weak, reach, |q, place| {
            let landed = polish(self.problem, q, self.steps);
            let found = insert(self.solutions, start, &landed, self.accept);
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
    landed: &Polished<N>,
    accept: &Acceptance,
) -> Option<usize> {
    if landed.residual > accept.tolerance || landed.residual.is_nan() {
        return None;
    }
    let q = core::array::from_fn(|i| {
        let slides = accept.prismatic >> i & 1 == 1;
        math::select(slides, landed.q[i], math::wrap(landed.q[i]))
    });
    solutions.insert_distinct(Solution {
        q,
        residual: landed.residual,
        singular: landed.singular(),
        ..*start
    })
}
