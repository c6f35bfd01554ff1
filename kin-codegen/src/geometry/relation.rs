//! How axes lie to each other: parallel, intersecting, concurrent.

use super::{Line, Vec3, cross, norm, sub};

/// What two axes are to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum PairRelation {
    /// One line.
    Coincident,
    /// The same or opposite direction.
    Parallel,
    /// They meet.
    Intersecting,
    /// Neither meet nor are parallel.
    Skew,
    /// A direction of sliding at an angle to the other axis.
    Inclined,
}

/// Relates two lines. `angle` is the tolerance on directions in radians,
/// `length` that on distances in metres.
pub fn relate(a: &Line, b: &Line, angle: f64, length: f64) -> PairRelation {
    let is_parallel = super::angle(a.direction, b.direction) < angle;
    let distance = match is_parallel {
        true => norm(a.offset_of(b.point)),
        false => a.distance(b),
    };
    match (is_parallel, distance < length) {
        (true, true) => PairRelation::Coincident,
        (true, false) => PairRelation::Parallel,
        (false, true) => PairRelation::Intersecting,
        (false, false) => PairRelation::Skew,
    }
}

/// The point that all lines pass, within `length` metres. A single line has
/// no distinguished point, and neither have coincident ones.
pub fn concurrency(lines: &[Line], angle: f64, length: f64) -> Option<Vec3> {
    let (first, rest) = lines.split_first()?;
    let across = rest
        .iter()
        .find(|line| norm(cross(first.direction, line.direction)) > angle)?;
    let point = first.foot(across);
    let passes = |line: &Line| norm(sub(point, line.nearest(point))) < length;
    lines.iter().all(passes).then_some(point)
}
