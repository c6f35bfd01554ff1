//! The answer of inverse kinematics: all branches, without allocation.

use super::super::scalar::{Real, tolerance::SAME};
use core::mem::MaybeUninit;

use super::super::math;
use super::super::types::limits::JointLimit;

/// One configuration that reaches the target.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Solution<const N: usize> {
    /// Joint values: radians in (−π, π] for revolute joints (but those that mimic others), metres for
    /// prismatic ones.
    #[cfg_attr(feature = "serde", serde(with = "crate::convert::array"))]
    pub q: [Real; N],
    /// How far the forward kinematics of `q` is from the target, metres, as far
    /// as the target counts: the root of the squares of the translation error
    /// and of the rotation error (radians) times the arm's size; see
    /// [`Target::distance`](crate::Target::distance). Solutions are accepted
    /// up to 1e-9 of the arm's size (2e-5 in single precision); away from singular
    /// configurations it is rounding, some 1e-15.
    pub residual: Real,
    /// Which combination of the plan's choices this is; the rustdoc of the
    /// robot names them. Stable along a path that crosses no singularity. There
    /// an arm off its design can have more solutions than branches, and a plan
    /// whose steps degenerate tell less; those have the number of a neighbour,
    /// or where an elimination finds them, one from
    /// [`Kinematics::BRANCHES`](crate::Kinematics::BRANCHES) on.
    pub branch: u32,
    /// The Jacobian loses rank here: `q` stands for a family of solutions, or
    /// for two that have met.
    pub singular: bool,
}

const CAPACITY: usize = 16;

/// All solutions of one target, at most [`Solutions::CAPACITY`], in order of
/// their branch; those that an arm off its design has more than the design come
/// last. Behaves as a slice of [`Solution`] and lives on the stack.
///
/// ```
/// use kin_runtime::{JointLimit, Solution, Solutions};
/// let found = |q, branch| Solution { q: [q], residual: 0.0, branch, singular: false };
/// let mut solutions = Solutions::new();
/// solutions.push(found(-3.0, 0));
/// solutions.push(found(1.0, 1));
///
/// let nearest = solutions.nearest(&[3.1], &[JointLimit::Continuous]).unwrap();
/// assert_eq!(nearest.branch, 0); // 0.18 rad across ±π
/// let limits = [JointLimit::Revolute { lower: -2.0, upper: 2.0 }];
/// assert_eq!(solutions.within_limits(&limits).len(), 1);
/// ```
#[derive(Clone, Copy)]
pub struct Solutions<const N: usize> {
    // In front of the slots: behind them, the compiler zeroes the whole lot.
    len: usize,
    prismatic: u64,
    /// The first `len` are initialized; the last is never counted, so that
    /// `push_if` has a place to write even when full.
    slots: [MaybeUninit<Solution<N>>; CAPACITY + 1],
}

impl<const N: usize> Solutions<N> {
    /// No arm with a closed form has more isolated solutions than a general
    /// six-revolute one: sixteen.
    pub const CAPACITY: usize = CAPACITY;

    /// None yet, for an arm whose joints all turn.
    #[inline(always)]
    pub const fn new() -> Self {
        Self::with_prismatic(0)
    }

    /// Bit i is set where joint i is prismatic.
    #[inline(always)]
    pub(crate) const fn prismatic(&self) -> u64 {
        self.prismatic
    }

    /// None yet, for an arm whose joint i is prismatic where bit i of the mask
    /// is set: metres do not wrap.
    #[inline(always)]
    pub const fn with_prismatic(mask: u64) -> Self {
        Solutions {
            len: 0,
            prismatic: mask,
            slots: [MaybeUninit::uninit(); CAPACITY + 1],
        }
    }

    /// Forgets all, for other solutions of an arm with these prismatic joints.
    #[inline(always)]
    pub(crate) fn clear(&mut self, mask: u64) {
        self.len = 0;
        self.prismatic = mask;
    }

    /// Fills an empty answer in the place where the caller wants it. Filling a
    /// local one and returning that costs a copy of a kilobyte, 10 ns.
    ///
    /// ```
    /// use kin_runtime::{Solution, Solutions};
    /// let halves = Solutions::build(|solutions| {
    ///     for (branch, q) in [-0.5, 0.5].into_iter().enumerate() {
    ///         let branch = branch as u32;
    ///         solutions.push_if(q > 0.0, Solution { q: [q], residual: 0.0, branch, singular: false });
    ///     }
    /// });
    /// assert_eq!(halves.len(), 1);
    /// ```
    #[inline]
    pub fn build(fill: impl FnOnce(&mut Self)) -> Self {
        Self::build_with_prismatic(0, fill)
    }

    /// As [`Solutions::build`], for an arm with prismatic joints; see
    /// [`Solutions::with_prismatic`].
    #[inline]
    pub fn build_with_prismatic(mask: u64, fill: impl FnOnce(&mut Self)) -> Self {
        let mut place = MaybeUninit::uninit();
        Self::fill(&mut place, mask, fill);
        // SAFETY: `fill` has written the place.
        unsafe { place.assume_init() }
    }

    /// A call that is kept as one gets the caller's place to write to.
    #[inline(never)]
    fn fill(place: &mut MaybeUninit<Self>, mask: u64, fill: impl FnOnce(&mut Self)) {
        fill(place.write(Self::with_prismatic(mask)));
    }

    /// Appends a solution.
    ///
    /// # Panics
    /// If [`Solutions::CAPACITY`] are there already.
    #[inline]
    pub fn push(&mut self, solution: Solution<N>) {
        assert!(
            self.len < Self::CAPACITY,
            "more than {} solutions",
            Self::CAPACITY
        );
        self.push_if(true, solution);
    }

    /// Appends a solution if it is valid, without a branch: it is written in
    /// any case and then counted or not. At capacity nothing is counted.
    #[inline(always)]
    pub fn push_if(&mut self, valid: bool, solution: Solution<N>) {
        self.slots[self.len.min(CAPACITY)].write(solution);
        self.len = (self.len + usize::from(valid)).min(CAPACITY);
    }

    /// Numbers the solutions by their places.
    pub(crate) fn number_by_place(&mut self) {
        for (place, slot) in self.slots[..self.len].iter_mut().enumerate() {
            // SAFETY: `len` only grows past a slot that has just been written.
            unsafe { slot.assume_init_mut() }.branch = place as u32;
        }
    }

    /// The place of a solution, which is appended unless one is the same to
    /// within [`SAME`]: branches that were refined may come together, and the
    /// better of the two is kept. None if it is new and there is no place left.
    pub(crate) fn insert_distinct(&mut self, solution: Solution<N>) -> Option<usize> {
        let Some(known) = self.place_of(&solution.q) else {
            let place = self.len;
            self.push_if(true, solution);
            return (place < self.len).then_some(place);
        };
        let branch = self[known].branch;
        if solution.residual < self[known].residual {
            self.slots[known].write(Solution { branch, ..solution });
        }
        Some(known)
    }

    /// Appends a solution unless one is the same to within so much.
    #[doc(hidden)]
    pub fn insert_new(&mut self, solution: Solution<N>, same: Real) {
        let known = self.place_within(&solution.q, same);
        self.push_if(known.is_none(), solution);
    }

    /// The place of a solution, to within [`SAME`].
    pub(crate) fn place_of(&self, q: &[Real; N]) -> Option<usize> {
        self.place_within(q, SAME)
    }

    fn place_within(&self, q: &[Real; N], same: Real) -> Option<usize> {
        let is_same = |it: &Solution<N>| (0..N).all(|i| self.apart(i, it.q[i], q[i]) < same);
        self.iter().position(is_same)
    }

    /// How far two configurations are apart, radians and metres: the square of it.
    pub(crate) fn squared_distance(&self, a: &[Real; N], b: &[Real; N]) -> Real {
        let apart = (0..N).map(|i| self.apart(i, a[i], b[i]));
        apart.fold(0.0, |square, apart| square + apart * apart)
    }

    fn apart(&self, i: usize, a: Real, b: Real) -> Real {
        let turns = self.prismatic >> i & 1 == 0;
        math::select(turns, math::wrap(a - b), a - b).abs()
    }

    /// Moves the solution in some place.
    pub(crate) fn replace(&mut self, place: usize, q: [Real; N], residual: Real) {
        let moved = Solution {
            q,
            residual,
            ..self[place]
        };
        self.slots[place].write(moved);
    }

    /// The solutions found, in order of their branch.
    #[inline]
    pub fn as_slice(&self) -> &[Solution<N>] {
        // SAFETY: `len` only grows past a slot that has just been written.
        unsafe { core::slice::from_raw_parts(self.slots.as_ptr().cast(), self.len) }
    }

    /// Iterates over the solutions found, in order of their branch.
    #[inline]
    pub fn iter(&self) -> core::slice::Iter<'_, Solution<N>> {
        self.as_slice().iter()
    }

    /// How many there are.
    #[inline]
    pub const fn len(&self) -> usize {
        self.len
    }

    /// Whether the target is out of reach.
    #[inline]
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Those that respect the limits. A revolute angle outside is replaced by
    /// the nearest of its windings q + 2πk inside, if there is one, so that
    /// angles in the answer may leave (−π, π].
    ///
    /// See [`JointLimit::nearest`] for values at a stop.
    pub fn within_limits(&self, limits: &[JointLimit; N]) -> Self {
        let mut inside = Self::with_prismatic(self.prismatic);
        for solution in self {
            let wound = |i: usize| limits[i].nearest(solution.q[i], solution.q[i]);
            if (0..N).all(|i| wound(i).is_some()) {
                let q = core::array::from_fn(|i| wound(i).unwrap_or(solution.q[i]));
                inside.push(Solution { q, ..*solution });
            }
        }
        inside
    }
}

impl<const N: usize> Default for Solutions<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> core::ops::Deref for Solutions<N> {
    type Target = [Solution<N>];
    #[inline]
    fn deref(&self) -> &[Solution<N>] {
        self.as_slice()
    }
}

impl<const N: usize> core::fmt::Debug for Solutions<N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries(self).finish()
    }
}

impl<const N: usize> PartialEq for Solutions<N> {
    fn eq(&self, other: &Self) -> bool {
        self.as_slice() == other.as_slice()
    }
}

impl<'a, const N: usize> IntoIterator for &'a Solutions<N> {
    type Item = &'a Solution<N>;
    type IntoIter = core::slice::Iter<'a, Solution<N>>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<const N: usize> IntoIterator for Solutions<N> {
    type Item = Solution<N>;
    type IntoIter = IntoIter<N>;
    fn into_iter(self) -> IntoIter<N> {
        IntoIter {
            solutions: self,
            next: 0,
        }
    }
}

/// Iterator that owns the solutions, from `for solution in arm.ik(&pose)`.
#[derive(Clone, Debug)]
pub struct IntoIter<const N: usize> {
    solutions: Solutions<N>,
    next: usize,
}

impl<const N: usize> Iterator for IntoIter<N> {
    type Item = Solution<N>;

    fn next(&mut self) -> Option<Solution<N>> {
        let solution = self.solutions.as_slice().get(self.next).copied();
        self.next += usize::from(solution.is_some());
        solution
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.solutions.len - self.next;
        (left, Some(left))
    }
}

impl<const N: usize> ExactSizeIterator for IntoIter<N> {}

#[cfg(test)]
mod tests {
    use super::super::super::scalar::consts::TAU;
    use super::super::Nearest;
    use super::*;

    fn solution<const N: usize>(q: [Real; N]) -> Solution<N> {
        Solution {
            q,
            residual: 0.0,
            branch: 0,
            singular: false,
        }
    }

    fn all<const N: usize>(qs: &[[Real; N]]) -> Solutions<N> {
        let mut solutions = Solutions::new();
        qs.iter().for_each(|&q| solutions.push(solution(q)));
        solutions
    }

    #[test]
    fn only_valid_solutions_are_counted() {
        let mut solutions = Solutions::new();
        for k in 0..40 {
            solutions.push_if(k % 3 == 0, solution([k as Real]));
        }
        let kept = solutions.iter().map(|s| s.q[0]);
        assert!(kept.eq((0..14).map(|k| (3 * k) as Real)));
    }

    #[test]
    fn beyond_the_capacity_nothing_is_overwritten() {
        let mut solutions = Solutions::new();
        for k in 0..40 {
            solutions.push_if(true, solution([k as Real]));
        }
        assert_eq!(solutions.len(), Solutions::<1>::CAPACITY);
        assert_eq!(solutions.last().unwrap().q, [15.0]);
    }

    #[test]
    #[should_panic(expected = "more than 16 solutions")]
    fn pushing_beyond_the_capacity_panics() {
        (0..17).fold(Solutions::new(), |mut solutions, k| {
            solutions.push(solution([k as Real]));
            solutions
        });
    }

    #[test]
    fn owned_and_borrowed_iteration_agree() {
        let solutions = all(&[[1.0, 2.0], [3.0, 4.0]]);
        assert!(solutions.into_iter().eq(solutions.iter().copied()));
        assert_eq!(solutions.into_iter().len(), 2);
        assert_eq!(solutions, all(&[[1.0, 2.0], [3.0, 4.0]]));
    }

    #[test]
    fn limits_keep_shift_or_drop() {
        let limits = [JointLimit::Revolute {
            lower: 0.0,
            upper: 4.0,
        }];
        let inside = all(&[[1.0], [-3.0], [-1.0]]).within_limits(&limits);
        assert_eq!(inside, all(&[[1.0], [TAU - 3.0]]));
    }

    #[test]
    fn windings_are_all_inside_and_distinct() {
        let limits = [
            JointLimit::Revolute {
                lower: -TAU,
                upper: TAU,
            },
            JointLimit::Continuous,
            JointLimit::Prismatic {
                lower: 0.0,
                upper: 20.0,
            },
        ];
        let solutions = all(&[[0.0, 1.0, 1.0], [1.0, 1.0, 19.0], [1.0, 1.0, -1.0]]);
        let found: [Solution<3>; 5] = {
            let mut windings = solutions.with_full_turns(&limits);
            core::array::from_fn(|_| windings.next().unwrap())
        };
        assert_eq!(solutions.with_full_turns(&limits).count(), 5);
        let expected = [
            [-TAU, 1.0, 1.0],
            [0.0, 1.0, 1.0],
            [TAU, 1.0, 1.0],
            [1.0 - TAU, 1.0, 19.0],
            [1.0, 1.0, 19.0],
        ];
        assert_eq!(found.map(|s| s.q), expected);
    }

    #[test]
    fn a_half_bounded_joint_winds_once() {
        let limits = [JointLimit::Revolute {
            lower: 2.0,
            upper: Real::INFINITY,
        }];
        let solutions = all(&[[1.0]]);
        assert!(
            solutions
                .with_full_turns(&limits)
                .map(|s| s.q)
                .eq([[1.0 + TAU]])
        );
    }

    #[test]
    fn metres_count_as_they_are_in_the_distance() {
        let mut solutions = Solutions::with_prismatic(0b10);
        solutions.push(solution([0.0, TAU]));
        solutions.push(solution([0.5, 1.0]));
        let free = [JointLimit::Continuous; 2];
        let nearest = solutions.nearest(&[0.0, 0.0], &free).unwrap();
        assert_eq!(nearest.q, [0.5, 1.0]);
        let weights = [1.0, 0.0];
        let mut angles = Nearest::new([TAU, 0.0], &free);
        angles.weights = weights;
        let nearest = solutions.nearest_by(&angles).unwrap();
        assert_eq!(nearest.q, [TAU, TAU]);
    }

    #[test]
    fn nothing_is_nearest_in_an_empty_answer() {
        assert!(
            Solutions::<2>::new()
                .nearest(&[0.0; 2], &[JointLimit::Continuous; 2])
                .is_none()
        );
    }
}
