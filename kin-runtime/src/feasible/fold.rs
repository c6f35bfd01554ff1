//! Where a curve turns back: a coordinate has an extremum on it.

use super::task::{Place, Task};
use crate::RedundantKinematics;
use crate::continuation::{Cut, along};
use crate::linear::vector::dot;

/// The first step, radians and metres.
const FIRST: f64 = 1e-2;
/// Steps are no longer than this.
const LONGEST: f64 = 0.2;
/// The extremum is no farther than this along the curve.
const FARTHEST: f64 = 1.5;
/// A coordinate differs from its extremum by the square of what the place does.
const NEAR: f64 = 1e-8;
const STEPS: usize = 40;

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// The next extremum of a coordinate along the curve, in the direction in which the
    /// parameter grows (`sense` 1) or falls (−1): the zero of that coordinate of the
    /// tangent, by the secant method along the curve. None if there is none near, or the
    /// secants go the other way. The tangent there is one to where the curve goes on.
    pub fn extremum(&self, coordinate: usize, from: &Place, sense: f64) -> Option<Place> {
        let mut x = from.x;
        let mut tangent = from.tangent.map(|t| sense * t);
        let mut step = FIRST;
        let mut travelled = 0.0;
        for _ in 0..STEPS {
            let guess = along(&x, &tangent, step);
            let cut = Cut {
                normal: tangent,
                point: guess,
            };
            let Some(next) = self.meet(&cut, guess) else {
                step *= 0.25;
                continue;
            };
            let place = self.place(next)?;
            let sign = 1.0_f64.copysign(dot(place.tangent, tangent));
            let turned = place.tangent.map(|t| sign * t);
            let (before, here) = (tangent[coordinate], turned[coordinate]);
            let slope = (here - before) / step;
            (x, tangent) = (next, turned);
            travelled += step;
            if step.abs() < NEAR || here == 0.0 {
                return Some(Place { x, tangent });
            }
            let wanted = -here / slope;
            if !wanted.is_finite() || travelled + wanted < 0.0 || travelled > FARTHEST {
                return None;
            }
            step = wanted.clamp(-LONGEST, LONGEST);
        }
        None
    }
}
