//! Six joints without a closed form: one unknown left.
//!
//! One joint is kept. A line of the arm as two neighbours move it lies in a space of
//! nine dimensions out of fifteen, whatever the target; that it lies there too when it
//! is seen along the other side of the loop are six equations, bilinear in the sines
//! and cosines of the two joints that are left (M. Raghavan and B. Roth, "Inverse
//! kinematics of the general 6R manipulator and related linkages", J. Mechanical Design
//! 115, 1993). Products with the half tangents of these make a square matrix
//! whose determinant is a trigonometric polynomial in the kept joint: sampled,
//! transformed, its real roots isolated; what the matrix takes to zero there tells the
//! other joints, and Newton's method on the arm does the rest.
//!
//! What is computed in lanes has no branches that depend on data. The isolation of
//! roots has, with a bound on its steps.

mod bernstein;
mod branches;
mod candidates;
mod closest;
mod complex;
mod determinant;
mod eliminant;
mod elimination;
mod found;
mod frames;
mod harmonics;
mod lanes;
mod line;
mod matrix;
mod polish;
mod polynomial;
mod recover;
mod roots;
mod search;
mod sharing;
mod short;
mod split;
mod turn;
mod vanishing;
mod zeros;

pub use bernstein::coefficients_on_arc;
pub use eliminant::Eliminant;
pub use elimination::{EQUATIONS, Elimination, FUNCTIONALS};
pub use frames::{Between, Frames};
#[cfg(feature = "std")]
pub use line::{ENTRIES, Lines, Z_AXIS, gone_back, moved};
pub use turn::cosine_of_turn;

use crate::{Pose, Solution, Solutions, Target};
use lanes::LANES;
use search::Search;
use short::{shortened, with};

/// An arm, and how it is solved: of six joints, or of fewer with joints behind
/// the tip that stay at zero. Where what counts of a target leaves the turn about the
/// tip's z axis free, that turn is the first of those.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Univariate<'a> {
    /// The constant motions between its joints.
    pub frames: Frames,
    /// The arm's size, metres.
    pub size: f64,
    /// What of a target counts: all of it, or the position and the axis.
    pub counts: Target,
    /// The eliminations, the best first.
    pub eliminations: &'a [Elimination],
}

/// What one elimination said of one target.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome {
    /// Real roots.
    pub roots: usize,
    /// Those of them near which other solutions were looked for.
    pub unclear: usize,
    /// Of the polynomial, relative to its largest coefficient.
    pub noise: f64,
    /// Whether all solutions are sure to be among those found.
    pub certain: bool,
}

impl Univariate<'_> {
    /// The arm with joints between its own at these values, radians and metres, on which the
    /// eliminations do not depend; it has them at zero.
    pub fn at(&self, between: &[Between], values: &[f64]) -> Self {
        Self {
            frames: self.frames.at(between, values),
            ..*self
        }
    }

    /// All configurations that put the tip at the target, in the order of the joint
    /// that is kept first; those of singular targets last.
    ///
    /// One elimination is asked. Where it is not sure of its answer, so is another.
    pub fn solutions<const N: usize>(&self, target: &Pose) -> Solutions<N> {
        by_place(shortened(self, target, &Search::new(self, target).run()))
    }

    /// The same; if `seed` is a singular solution, it is among them.
    pub fn solutions_near<const N: usize>(&self, target: &Pose, seed: &[f64; N]) -> Solutions<N> {
        let mut search = Search::new(self, target);
        search.keep(&self.lengthened(seed));
        by_place(shortened(self, target, &search.run()))
    }

    /// All configurations that put the tip at the target, of an arm next to an idealized
    /// one: Newton's method from that one's branches, and the eliminations, until one is sure of
    /// its answer, where these do not tell all, because one is flagged singular, leads nowhere or where another one
    /// does, or to a solution whose Jacobian has a least pivot of less than
    /// `near_singular` times the largest. What it adds, `seed` among it if that is a singular
    /// solution, is numbered from `count` on, of which all branches are below.
    pub fn refined<const N: usize>(
        &self,
        target: &Pose,
        branches: impl Iterator<Item = Solution<N>>,
        seed: &[f64; N],
        count: usize,
        near_singular: f64,
    ) -> Solutions<N> {
        let branches = branches.map(|it| with(&it, self.lengthened(&it.q), it.residual));
        let (seed, moving) = (self.lengthened(seed), self.moving(N));
        let search = Search::new(self, target);
        let found = search.refine(branches, &seed, count, near_singular, moving);
        shortened(self, target, &found)
    }

    /// A solution, or where there is none, a configuration of which no small motion
    /// comes nearer to the target. None if the target is not a number.
    pub fn closest<const N: usize>(&self, target: &Pose) -> Option<Solution<N>> {
        let first = self.solutions(target).first().copied();
        first.or_else(|| {
            let free_turn = usize::from(self.counts == Target::PositionAxis);
            let six = closest::closest(self, target, N + free_turn)?;
            let q = core::array::from_fn(|i| six.q[i]);
            Some(with(&six, q, six.residual))
        })
    }

    /// What one elimination says of a target, and the solutions that it finds, lengths as in
    /// the frames.
    pub fn outcome(&self, elimination: &Elimination, target: &Pose) -> (Outcome, Solutions<6>) {
        let mut search = Search::new(self, target);
        let outcome = search.ask(elimination);
        (outcome, search.found())
    }
}

/// Of a polynomial's roots the branch is the place.
fn by_place<const N: usize>(mut found: Solutions<N>) -> Solutions<N> {
    found.number_by_place();
    found
}
