//! An interval of the parameter.

use super::arcs::Arc;
use super::task::{Point, Task};
use crate::{RedundantKinematics, math};
use core::f64::consts::{PI, TAU};

/// An interval of the parameter in which a branch of solutions exists.
///
/// Of a branch that exists at a single value, and next to it on neither side, it has no length:
/// `from` is `to`. Such are the last joint's values of an arm with a spherical shoulder and wrist
/// whose target has its elbow stretched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeasibleInterval<const N: usize> {
    /// Its lower end, radians in (−π, π], or metres.
    pub from: f64,
    /// Its upper end, which may be beyond π. A branch that exists throughout has a whole
    /// turn, or several if it comes round to another one.
    pub to: f64,
    /// Whether the branch goes on from the upper end at the lower: it has no end.
    pub is_closed: bool,
    /// The configuration of the branch in the middle of the interval, by which it is told
    /// from others; beside the middle where it is singular there and not told from another.
    pub middle: [f64; N],
}

impl<const N: usize> FeasibleInterval<N> {
    /// Whether a value of the parameter is in it: of an angle, up to full turns.
    pub fn contains(&self, parameter: f64) -> bool {
        let turns = libm::floor((parameter - self.from) / TAU);
        let wound = parameter - turns * TAU;
        self.is_closed
            || (self.from..=self.to).contains(&parameter)
            || (self.from..=self.to).contains(&wound)
    }
}

impl<K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'_, K, N> {
    /// What an arc is to a caller; none if nothing of it is left.
    pub fn interval(&self, arc: &Arc) -> Option<FeasibleInterval<N>> {
        let parameter = self.parameter;
        let (first, last) = (arc.points.first()?, arc.points.last()?);
        let (from, to) = (first[parameter], last[parameter]);
        let middle = self.on(arc, 0.5 * (from + to))?;
        Some(self.wound(FeasibleInterval {
            from,
            to,
            is_closed: arc.is_closed,
            middle: self.q_wrapped(&middle),
        }))
    }

    /// The same with its lower end in (−π, π], if the parameter is an angle.
    pub fn wound(&self, interval: FeasibleInterval<N>) -> FeasibleInterval<N> {
        let turns = match self.turns(self.parameter) {
            true => TAU * libm::ceil((interval.from - PI) / TAU),
            false => 0.0,
        };
        FeasibleInterval {
            from: interval.from - turns,
            to: interval.to - turns,
            ..interval
        }
    }

    /// Joint values with angles in (−π, π].
    pub fn q_wrapped(&self, x: &Point) -> [f64; N] {
        core::array::from_fn(|i| match self.turns(i) {
            true => math::wrap(x[i]),
            false => x[i],
        })
    }

    /// The point of an arc at a value of the parameter.
    pub fn on(&self, arc: &Arc, value: f64) -> Option<Point> {
        let parameter = self.parameter;
        let behind = arc.points.partition_point(|x| x[parameter] < value);
        let behind = behind.clamp(1, arc.points.len().max(2) - 1);
        let (from, to) = (arc.points.get(behind - 1)?, arc.points.get(behind)?);
        let way = self.way(from, to);
        let share = match way[parameter] > 0.0 {
            true => ((value - from[parameter]) / way[parameter]).clamp(0.0, 1.0),
            false => 0.0,
        };
        let share = self.eased(arc, behind, share);
        let guess = super::task::along(from, &way, share);
        match share == 0.0 || share == 1.0 {
            true => Some(guess),
            false => self.meet_at(parameter, value, guess),
        }
    }

    /// How far along the chord a share of the parameter's way is: next to a fold the
    /// parameter goes with the square of the way.
    fn eased(&self, arc: &Arc, behind: usize, share: f64) -> f64 {
        let (first, last) = (behind == 1, behind == arc.points.len() - 1);
        match (arc.is_closed, first, last) {
            (true, ..) | (_, false, false) => share,
            (_, true, false) => math::sqrt(share),
            (_, false, true) => 1.0 - math::sqrt(1.0 - share),
            // Both ends in one cell: half a turn of a cosine.
            (_, true, true) => {
                let angle = math::atan2(2.0 * math::sqrt(share * (1.0 - share)), 1.0 - 2.0 * share);
                angle / PI
            }
        }
    }
}
