//! What a row of joints leaves alone: points, directions and planes.

use super::Target;
use crate::geometry::{Line, Linkage, Vec3, concurrency, cross, dot, norm, unit};
use std::ops::Range;

/// Relations of the idealized chain hold to rounding; this is far above it and
/// far below any dimension. Radians, and multiples of the arm's size.
const EXACT: f64 = 1e-11;

/// What kind of thing is left alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A point: on the axes of all the joints.
    Point,
    /// A free vector: along all the axes of rotation.
    Direction,
    /// The height over a plane: normal to the plane along all the axes of
    /// rotation and across all sliding.
    Plane,
}

/// A geometric object that a row of consecutive joints does not move.
#[derive(Clone, Debug, PartialEq)]
pub struct Invariant {
    /// What it is.
    pub kind: Kind,
    /// The joints that leave it alone. Empty at `i..i` for an object that is
    /// merely attached to the link between joints `i − 1` and `i`. An end of
    /// `n + 1` means that the free part of the target leaves it alone too.
    pub joints: Range<usize>,
    /// The point, or a point of the plane; at home, base coordinates.
    pub point: Vec3,
    /// The direction, or the plane's normal; at home, base coordinates.
    pub direction: Vec3,
}

/// All candidates for the ends of a relation.
pub fn invariants(linkage: &Linkage, target: Target) -> Vec<Invariant> {
    let n = linkage.links.len();
    let axes: Vec<Line> = (0..n).map(|i| linkage.axis(i)).collect();
    let mut found = Vec::new();
    for start in 0..n {
        for end in start + 1..=n {
            let row = start..end;
            found.extend(common_point(linkage, &axes, row.clone()));
            found.extend(common_direction(linkage, &axes, row.clone()));
            found.extend(common_plane(linkage, &axes, row));
        }
    }
    attached(linkage, 0, &mut found);
    if target.is_free() {
        left_alone(linkage, &axes, target, &mut found);
    } else {
        attached(linkage, n, &mut found);
    }
    found
}

fn slides(linkage: &Linkage, joint: usize) -> bool {
    !linkage.is_revolute(joint)
}

fn common_point(linkage: &Linkage, axes: &[Line], joints: Range<usize>) -> Option<Invariant> {
    if joints.clone().any(|j| slides(linkage, j)) {
        return None;
    }
    let point = match &axes[joints.clone()] {
        [line] => line.point,
        lines => concurrency(lines, EXACT, EXACT * linkage.size)?,
    };
    Some(Invariant {
        kind: Kind::Point,
        joints,
        point,
        direction: [0.0; 3],
    })
}

/// The direction shared by all axes of rotation of a row, if there is one.
fn shared_direction(linkage: &Linkage, axes: &[Line], joints: Range<usize>) -> Option<Vec3> {
    let mut turning = joints.filter(|&j| !slides(linkage, j));
    let direction = axes[turning.next()?].direction;
    turning
        .all(|j| norm(cross(direction, axes[j].direction)) < EXACT)
        .then_some(direction)
}

fn common_direction(linkage: &Linkage, axes: &[Line], joints: Range<usize>) -> Option<Invariant> {
    let direction = shared_direction(linkage, axes, joints.clone())?;
    let point = axes[joints.start].point;
    Some(Invariant {
        kind: Kind::Direction,
        joints,
        point,
        direction,
    })
}

fn common_plane(linkage: &Linkage, axes: &[Line], joints: Range<usize>) -> Option<Invariant> {
    let direction = shared_direction(linkage, axes, joints.clone())
        .or_else(|| across_slides(linkage, axes, joints.clone()))?;
    let across = |j: usize| dot(axes[j].direction, direction).abs() < EXACT;
    let fits = joints.clone().filter(|&j| slides(linkage, j)).all(across);
    let point = axes[joints.start].point;
    fits.then_some(Invariant {
        kind: Kind::Plane,
        joints,
        point,
        direction,
    })
}

/// The normal across a row of two prismatic joints.
fn across_slides(linkage: &Linkage, axes: &[Line], joints: Range<usize>) -> Option<Vec3> {
    if joints.len() != 2 || !joints.clone().all(|j| slides(linkage, j)) {
        return None;
    }
    let normal = cross(
        axes[joints.start].direction,
        axes[joints.start + 1].direction,
    );
    (norm(normal) > EXACT).then(|| unit(normal))
}

/// Objects fixed in one link alone: the origin and the axes of its frame.
fn attached(linkage: &Linkage, body: usize, found: &mut Vec<Invariant>) {
    let frame = match body {
        0 => linkage.links[0].before_home,
        b => linkage.links[b - 1].after_home,
    };
    let point = frame.translation;
    let mut push = |kind, direction| {
        found.push(Invariant {
            kind,
            joints: body..body,
            point,
            direction,
        });
    };
    push(Kind::Point, [0.0; 3]);
    for axis in 0..3 {
        let direction = [0, 1, 2].map(|i| frame.rotation[i][axis]);
        push(Kind::Direction, direction);
        push(Kind::Plane, direction);
    }
}

/// What the free part of a target leaves alone, with the last joints that do
/// so as well.
fn left_alone(linkage: &Linkage, axes: &[Line], target: Target, found: &mut Vec<Invariant>) {
    let n = axes.len();
    let tip = linkage.tip_home();
    let point = tip.translation;
    let column = |j: usize| [0, 1, 2].map(|i| tip.rotation[i][j]);
    // The last joints that leave something alone, and the free part behind.
    let row = |leaves: &dyn Fn(usize) -> bool| {
        let count = (0..n).rev().take_while(|&j| leaves(j)).count();
        n - count..n + 1
    };
    let through =
        |j: usize| !slides(linkage, j) && norm(axes[j].offset_of(point)) < EXACT * linkage.size;
    let along =
        |d: Vec3| move |j: usize| slides(linkage, j) || norm(cross(axes[j].direction, d)) < EXACT;
    if target.fixes_point() {
        let joints = row(&through);
        found.push(Invariant {
            kind: Kind::Point,
            joints,
            point,
            direction: [0.0; 3],
        });
    }
    if target.fixes_axis() {
        let direction = column(2);
        let joints = row(&along(direction));
        found.push(Invariant {
            kind: Kind::Direction,
            joints,
            point,
            direction,
        });
    }
    if target == Target::PositionAxis {
        let direction = column(2);
        found.extend(points_of_axis(linkage, axes, Line { direction, point }));
        let across = |j: usize| {
            let sliding = dot(axes[j].direction, direction).abs() < EXACT;
            if slides(linkage, j) {
                sliding
            } else {
                along(direction)(j)
            }
        };
        let joints = row(&across);
        found.push(Invariant {
            kind: Kind::Plane,
            joints,
            point,
            direction,
        });
    }
    if target == Target::Orientation {
        for direction in [0, 1, 2].map(column) {
            let joints = row(&along(direction));
            found.push(Invariant {
                kind: Kind::Direction,
                joints,
                point,
                direction,
            });
        }
    }
}

/// Points of the tip's z axis that the last joints leave alone as well: the
/// centre of a wrist that the tool points away from.
fn points_of_axis(linkage: &Linkage, axes: &[Line], tool: Line) -> Vec<Invariant> {
    let n = axes.len();
    let turning = (0..n).rev().take_while(|&j| !slides(linkage, j)).count();
    (n - turning..n)
        .filter_map(|start| {
            let mut lines = axes[start..].to_vec();
            lines.push(tool);
            let point = concurrency(&lines, EXACT, EXACT * linkage.size)?;
            let joints = start..n + 1;
            Some(Invariant {
                kind: Kind::Point,
                joints,
                point,
                direction: [0.0; 3],
            })
        })
        .collect()
}
