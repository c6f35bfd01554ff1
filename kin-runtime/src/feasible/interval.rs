//! An interval of the parameter.

use core::f64::consts::TAU;

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
    /// Whether the parameter is an angle, and no way in metres.
    pub is_angle: bool,
    /// Whether the branch goes on from the upper end at the lower: it has no end.
    pub is_closed: bool,
    /// The configuration of the branch in the middle of the interval, by which it is told
    /// from others; beside the middle where it is singular there and not told from another. Angles
    /// are in (−π, π], or wound to lie within the limits that were asked for, where they can be: an
    /// angle that is free may not.
    pub middle: [f64; N],
}

impl<const N: usize> FeasibleInterval<N> {
    /// Whether a value of the parameter is in it: of an angle, up to full turns.
    pub fn contains(&self, parameter: f64) -> bool {
        let turns = libm::floor((parameter - self.from) / TAU);
        let wound = parameter - turns * TAU;
        let is_inside = |value| (self.from..=self.to).contains(&value);
        self.is_closed || is_inside(parameter) || self.is_angle && is_inside(wound)
    }
}
