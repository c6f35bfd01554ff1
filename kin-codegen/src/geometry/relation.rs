//! How axes lie to each other: parallel, intersecting, concurrent.

use super::{Line, Vec3, cross, norm, sub};

/// Two axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxisRelation {
    /// The same line.
    Coincident,
    /// Parallel at a distance, in metres.
    Parallel(f64),
    /// They meet in a point, at an angle between 0 and π/2.
    Intersecting(f64),
    /// Neither: distance in metres, angle between 0 and π/2.
    Skew(f64, f64),
}

/// Relates two axes. `angle` is the tolerance on directions in radians,
/// `length` that on distances in metres.
pub fn relate(a: &Line, b: &Line, angle: f64, length: f64) -> AxisRelation {
    let between = super::angle(a.direction, b.direction);
    if between < angle {
        let distance = norm(a.offset_of(b.point));
        return if distance < length {
            AxisRelation::Coincident
        } else {
            AxisRelation::Parallel(distance)
        };
    }
    let distance = a.distance(b);
    if distance < length {
        AxisRelation::Intersecting(between)
    } else {
        AxisRelation::Skew(distance, between)
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
