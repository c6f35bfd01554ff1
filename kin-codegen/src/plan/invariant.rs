//! What a row of joints leaves alone: points, directions and planes.

use super::Target;
use crate::geometry::{Line, Linkage, Vec3, concurrency, cross, dot, norm, sub, unit};
use std::ops::Range;

/// Relations of the idealized chain hold to rounding; this is far above it and
/// far below any dimension. Radians, and multiples of the arm's size.
const EXACT: f64 = 1e-12;

/// Axes that meet farther away, in multiples of the arm's size, are parallel but for the digits of a file:
/// of where they meet they tell few.
const FARTHEST: f64 = 1e5;

/// Directions with a larger sine between them span a plane.
const SKEW: f64 = 1e-3;

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
        found.extend(along_slide(linkage, &axes, start));
    }
    attached(linkage, 0, &mut found);
    if target.is_free() && !linkage.has_free_turn {
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
        lines => concurrency(lines, EXACT, EXACT * linkage.size)
            .filter(|point| norm(sub(*point, lines[0].point)) < FARTHEST * linkage.size)?,
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

/// Of a prismatic joint, two planes of the pencil that it leaves alone; across
/// a neighbour if they can be, so that their normals are simple in its frame.
fn along_slide(linkage: &Linkage, axes: &[Line], joint: usize) -> Vec<Invariant> {
    let Line { direction, point } = axes[joint];
    let neighbours = [joint.wrapping_sub(1), joint + 1].into_iter();
    let neighbours = neighbours
        .filter_map(|i| axes.get(i))
        .map(|line| line.direction);
    let any = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let normals = neighbours.chain(any).map(|other| cross(direction, other));
    let normal = normals.into_iter().find(|&normal| norm(normal) > SKEW);
    let Some(normal) = normal.filter(|_| slides(linkage, joint)).map(unit) else {
        return Vec::new();
    };
    let plane = |direction| Invariant {
        kind: Kind::Plane,
        joints: joint..joint + 1,
        point,
        direction,
    };
    vec![plane(normal), plane(cross(direction, normal))]
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
