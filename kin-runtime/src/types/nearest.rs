//! The solution that moves the joints least.

use super::super::math;
use super::super::scalar::Real;
use super::super::{JointLimit, Solution, Solutions};
use super::travel::{Travel, excess, wound};

/// Which of many solutions is wanted: the one that moves the joints least from
/// a seed, inside limits and by steps that are not too long.
///
/// ```
/// use kin_runtime::{JointLimit, Nearest, Solution, Solutions};
/// let mut solutions = Solutions::new();
/// for (branch, q) in [[0.1, 0.0], [0.0, 0.2]].into_iter().enumerate() {
///     let branch = branch as u32;
///     solutions.push(Solution { q, residual: 0.0, branch, singular: false });
/// }
/// let mut nearest = Nearest::new([0.0; 2], &[JointLimit::Continuous; 2]);
/// assert_eq!(solutions.nearest_by(&nearest).unwrap().branch, 0);
/// nearest.weights = [3.0, 1.0];
/// assert_eq!(solutions.nearest_by(&nearest).unwrap().branch, 1);
/// nearest.step = [0.2, 0.05];
/// assert_eq!(solutions.nearest_by(&nearest).unwrap().branch, 0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest<const N: usize> {
    /// Where the joints are, radians and metres. A joint whose value is not
    /// finite takes no part in what is nearest.
    pub seed: [Real; N],
    /// The motion of each joint is multiplied by its weight: say, the root of
    /// its inertia, or 0 where motion is free. 1 by [`Nearest::new`]. By weights that are not finite
    /// any solution may be the nearest, and there is no path.
    pub weights: [Real; N],
    /// How far each joint may move from its seed, radians and metres, to within
    /// [`JointLimit::TOLERANCE`]: say, its
    /// [velocity limit](crate::Kinematics::VELOCITY_LIMITS) by the time of a
    /// cycle. Infinite by [`Nearest::new`].
    pub step: [Real; N],
    travel: Travel<N>,
}

impl<const N: usize> Nearest<N> {
    /// Inside limits, all joints alike, however far. Angles outside of the
    /// limits are moved by full turns, those beyond a stop by no more than
    /// [`JointLimit::TOLERANCE`] onto it.
    #[inline(always)]
    pub const fn new(seed: [Real; N], limits: &[JointLimit; N]) -> Self {
        let (mut lower, mut upper, mut turns) = ([0.0; N], [0.0; N], [true; N]);
        let mut i = 0;
        while i < N {
            lower[i] = limits[i].lower();
            upper[i] = limits[i].upper();
            turns[i] = limits[i].is_revolute();
            i += 1;
        }
        Self {
            seed,
            weights: [1.0; N],
            step: [Real::INFINITY; N],
            travel: Travel::new(lower, upper, turns),
        }
    }

    /// The same from another seed.
    #[inline(always)]
    #[must_use]
    pub const fn from_seed(self, seed: [Real; N]) -> Self {
        Self { seed, ..self }
    }

    /// The limits.
    #[cfg(feature = "alloc")]
    pub(crate) fn limits(&self) -> [JointLimit; N] {
        core::array::from_fn(|i| {
            let (lower, upper) = (self.travel.lower[i], self.travel.upper[i]);
            match self.travel.turn[i] == 0.0 {
                true => JointLimit::prismatic(lower, upper),
                false => JointLimit::revolute(lower, upper),
            }
        })
    }

    /// What the joints' motions from a seed cost, of which i is prismatic where bit i
    /// of the mask is set.
    #[inline(always)]
    pub(crate) fn motion(&self, seed: &[Real; N], prismatic: u64) -> Motion<'_, N> {
        let mut motion = Motion {
            travel: &self.travel,
            turn: [0.0; N],
            toward: [0.0; N],
            seed: [0.0; N],
            weight: [0.0; N],
            lower: [0.0; N],
            upper: [0.0; N],
        };
        // Without comparisons of single joints, so that all are moved by packed instructions.
        for i in 0..N {
            // The same, or no number.
            let known = seed[i] + 0.0 * seed[i];
            let is_known = !known.is_nan();
            motion.seed[i] = math::select(is_known, known, 0.0);
            motion.weight[i] = math::select(is_known, self.weights[i], 0.0);
            motion.toward[i] = self.travel.toward(i, motion.seed[i]);
            let [from, to] = [known - self.step[i], known + self.step[i]];
            motion.lower[i] = math::max(from, self.travel.lower[i]) - JointLimit::TOLERANCE;
            motion.upper[i] = math::min(to, self.travel.upper[i]) + JointLimit::TOLERANCE;
            let slides = prismatic >> i & 1 == 1;
            motion.turn[i] = math::select(slides, 0.0, self.travel.turn[i]);
        }
        motion
    }
}

/// What it takes to move joints from their seed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<'a, const N: usize> {
    travel: &'a Travel<N>,
    /// 2π, or 0 for metres.
    turn: [Real; N],
    toward: [Real; N],
    seed: [Real; N],
    weight: [Real; N],
    /// What limits and steps allow, to within [`JointLimit::TOLERANCE`].
    lower: [Real; N],
    upper: [Real; N],
}

impl<const N: usize> Motion<'_, N> {
    /// The value of joint i that is `q` but for full turns and costs least.
    #[inline(always)]
    pub fn value(&self, i: usize, q: Real) -> Real {
        self.travel.at_most_at_a_stop(i, self.wound(i, q))
    }

    /// The square of its weighted distance from the seed, and whether limits and steps allow it.
    #[inline(always)]
    pub fn cost(&self, i: usize, q: Real) -> (Real, bool) {
        let value = self.wound(i, q);
        let weighted = self.weight[i] * (value - self.seed[i]);
        let allowed = (value >= self.lower[i]) & (value <= self.upper[i]);
        (weighted * weighted, allowed)
    }

    /// How far what is `q` but for full turns is beyond limits and steps; to be allowed, no more
    /// than [`JointLimit::TOLERANCE`].
    pub fn beyond(&self, i: usize, q: Real) -> Real {
        excess(self.wound(i, q), self.lower[i], self.upper[i]) + JointLimit::TOLERANCE
    }

    /// How far what is `q` but for full turns is beyond the limits.
    pub fn beyond_limits(&self, i: usize, q: Real) -> Real {
        excess(self.wound(i, q), self.travel.lower[i], self.travel.upper[i])
    }

    #[inline(always)]
    fn wound(&self, i: usize, q: Real) -> Real {
        wound(q, self.toward[i], self.turn[i])
    }
}

impl<const N: usize> Solutions<N> {
    /// The solution inside the limits with the least motion from `seed`: least
    /// Euclidean norm of q − seed as the joints have to travel it, full turns
    /// included. None if no solution respects the limits; of equals the first.
    ///
    /// ```
    /// use kin_runtime::{JointLimit, Solution, Solutions};
    /// let mut solutions = Solutions::new();
    /// solutions.push(Solution { q: [-3.0], residual: 0.0, branch: 0, singular: false });
    /// let limits = [JointLimit::Revolute { lower: -6.3, upper: 6.3 }];
    /// let next = solutions.nearest(&[3.1], &limits).unwrap();
    /// assert!((next.q[0] - 3.283185).abs() < 1e-6);
    /// ```
    pub fn nearest(&self, seed: &[Real; N], limits: &[JointLimit; N]) -> Option<Solution<N>> {
        self.nearest_by(&Nearest::new(*seed, limits))
    }

    /// As [`Solutions::nearest`], with weights and bounds on the steps.
    pub fn nearest_by(&self, nearest: &Nearest<N>) -> Option<Solution<N>> {
        let joints = nearest.motion(&nearest.seed, self.prismatic());
        let mut best = None;
        let mut least = Real::INFINITY;
        for solution in self {
            let mut motion = 0.0;
            let mut allowed = true;
            for i in 0..N {
                let (cost, is_allowed) = joints.cost(i, solution.q[i]);
                motion += cost;
                allowed &= is_allowed;
            }
            // What is too much for a number is still a motion.
            let motion = math::min(motion, Real::MAX);
            if allowed & (motion < least) {
                least = motion;
                let q = core::array::from_fn(|i| joints.value(i, solution.q[i]));
                best = Some(Solution { q, ..*solution });
            }
        }
        best
    }
}
