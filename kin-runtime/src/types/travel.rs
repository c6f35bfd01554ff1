//! How joints get between their stops to values that full turns leave as they
//! are.

use super::super::math;
use super::super::scalar::Real;
use super::super::scalar::consts::{PI, TAU};
use super::super::scalar::tolerance::STOP;

/// What it takes to choose, joint by joint, the one of the values q + 2πk that is within the limits
/// and nearest to a seed: without jumps and calls, and as a structure of arrays, so that loops over
/// joints or lanes become packed instructions.
///
/// The value is taken from the turn about one place that does not depend on q.
/// That is the seed, moved so far from the stops that the whole turn is inside,
/// or the middle of a travel that is less than a turn, of which one value at
/// most is inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Travel<const N: usize> {
    /// Stops.
    pub lower: [Real; N],
    pub upper: [Real; N],
    /// Between these, whole turns about the seed are inside.
    first: [Real; N],
    last: [Real; N],
    /// 2π, or 0 for metres, which do not wrap.
    pub turn: [Real; N],
}

impl<const N: usize> Travel<N> {
    /// Between stops; of joints that turn, and of others that slide.
    pub const fn new(lower: [Real; N], upper: [Real; N], turns: [bool; N]) -> Self {
        let mut travel = Self {
            lower,
            upper,
            first: [0.0; N],
            last: [0.0; N],
            turn: [0.0; N],
        };
        let mut i = 0;
        while i < N {
            let middle = 0.5 * (lower[i] + upper[i]);
            // Within what counts as resting on a stop, or rounding would decide for both.
            let first = lower[i] - 0.5 * STOP + PI;
            let last = upper[i] + 0.5 * STOP - PI;
            // Without stops, the middle is no number and not taken.
            travel.first[i] = math::select(middle < first, middle, first);
            travel.last[i] = math::select(middle > last, middle, last);
            travel.turn[i] = math::select(turns[i], TAU, 0.0);
            i += 1;
        }
        travel
    }

    /// The place from whose turn joint i takes its value, from a finite seed.
    #[inline(always)]
    pub fn toward(&self, i: usize, seed: Real) -> Real {
        let seed = math::select(seed < self.first[i], self.first[i], seed);
        math::select(seed > self.last[i], self.last[i], seed)
    }

    /// A value of joint i, not beyond a stop.
    #[inline(always)]
    pub fn at_most_at_a_stop(&self, i: usize, value: Real) -> Real {
        let value = math::select(value > self.upper[i], self.upper[i], value);
        math::select(value < self.lower[i], self.lower[i], value)
    }
}

/// Of q + 2πk the value in the turn about `toward`; `turn` is 2π, or 0 for
/// metres.
#[inline(always)]
pub(crate) fn wound(q: Real, toward: Real, turn: Real) -> Real {
    // The quotient is 0 where nothing turns.
    q + turn * math::round((toward - q) * (turn * (1.0 / (TAU * TAU))))
}

/// How far a value is beyond the nearer stop; negative inside.
#[inline(always)]
pub(crate) fn excess(value: Real, lower: Real, upper: Real) -> Real {
    math::max(value - upper, lower - value)
}
