//! Conditions under which the twists of joints depend on each other whatever
//! the rest of the arm is like (MLS section 3.4.3 and its exercises).

use super::conditioning::unitless_rows;
use super::{Axis, Line, Vec3, cross, dot, norm, sub};
use kin_runtime::__private::SingularValues;
use kin_runtime::Twist;
use std::fmt;

/// Joints, numbered from 0, whose twists depend on each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Condition {
    /// Two revolute axes on one line: of rank 1.
    Collinear([usize; 2]),
    /// Three parallel revolute axes in one plane: of rank 2.
    ParallelCoplanar([usize; 3]),
    /// Three revolute axes through one point and in one plane: of rank 2.
    Pencil([usize; 3]),
    /// Four or more revolute axes through one point: of rank 3.
    Concurrent(Vec<usize>),
    /// Four or more revolute axes in one plane: of rank 3.
    Coplanar(Vec<usize>),
    /// Two parallel revolute axes and a joint that slides square to their
    /// plane: of rank 2.
    SlideAcross {
        /// The revolute joints.
        parallel: [usize; 2],
        /// The prismatic one.
        slide: usize,
    },
    /// All axes meet one line: of rank 5. A parallel axis meets it at infinity,
    /// a joint that slides square to it at infinity as well.
    AllMeetALine,
}

/// Which conditions hold for axes where they are, given as their twists in one
/// frame. `size` is the arm's, metres; lengths are judged relative to it.
pub fn conditions(twists: &[Twist], size: f64) -> Vec<Condition> {
    let axes: Vec<Axis<Vec3>> = twists.iter().map(axis_of).collect();
    let arm = ArmAxes {
        axes: &axes,
        length: NEAR * size,
    };
    let mut found = Vec::new();
    let n = axes.len();
    for (i, j) in pairs(n) {
        if arm.collinear(i, j) {
            found.push(Condition::Collinear([i, j]));
        }
        for k in (0..n).filter(|&k| arm.slides_across(i, j, k)) {
            found.push(Condition::SlideAcross {
                parallel: [i, j],
                slide: k,
            });
        }
        for k in j + 1..n {
            let three = [i, j, k];
            if arm.parallel_coplanar(three) {
                found.push(Condition::ParallelCoplanar(three));
            }
            if arm.pencil(three) {
                found.push(Condition::Pencil(three));
            }
            for four in (k + 1..n).map(|l| vec![i, j, k, l]) {
                if arm.concurrent(&four) {
                    let all = arm.grown(four, |joints| arm.concurrent(joints));
                    found.push(Condition::Concurrent(all));
                } else if arm.coplanar(&four) {
                    let all = arm.grown(four, |joints| arm.coplanar(joints));
                    found.push(Condition::Coplanar(all));
                }
            }
        }
    }
    // Five axes through a point are found five times.
    let mut once: Vec<Condition> = Vec::new();
    for condition in found {
        if !once.contains(&condition) {
            once.push(condition);
        }
    }
    let mut found = once;
    if n == 6 && all_meet_a_line(twists, size) {
        found.push(Condition::AllMeetALine);
    }
    found
}

/// Radians, and multiples of the arm's size.
const NEAR: f64 = 1e-7;
/// The least singular value of an independent motion.
const LEAST: f64 = 1e-5;

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i + 1..n).map(move |j| (i, j)))
}

fn axis_of(twist: &Twist) -> Axis<Vec3> {
    match Line::of_twist(twist) {
        Some(Line { direction, point }) => Axis::Revolute { direction, point },
        None => Axis::Prismatic {
            direction: twist.linear,
        },
    }
}

struct ArmAxes<'a> {
    axes: &'a [Axis<Vec3>],
    length: f64,
}

impl ArmAxes<'_> {
    fn line(&self, i: usize) -> Option<Line> {
        match self.axes[i] {
            Axis::Revolute { direction, point } => Some(Line { direction, point }),
            Axis::Prismatic { .. } => None,
        }
    }

    fn lines<const N: usize>(&self, joints: [usize; N]) -> Option<[Line; N]> {
        self.all_lines(&joints)?.try_into().ok()
    }

    /// None if one of the joints slides.
    fn all_lines(&self, joints: &[usize]) -> Option<Vec<Line>> {
        joints.iter().map(|&i| self.line(i)).collect()
    }

    /// With every other joint that keeps the condition.
    fn grown(&self, mut joints: Vec<usize>, holds: impl Fn(&[usize]) -> bool) -> Vec<usize> {
        for other in 0..self.axes.len() {
            let with = [&joints[..], &[other]].concat();
            if !joints.contains(&other) && holds(&with) {
                joints = with;
            }
        }
        joints.sort_unstable();
        joints
    }

    fn collinear(&self, i: usize, j: usize) -> bool {
        let lines = self.lines([i, j]);
        lines.is_some_and(|[a, b]| is_parallel(&a, &b) && norm(a.offset_of(b.point)) < self.length)
    }

    fn parallel_coplanar(&self, joints: [usize; 3]) -> bool {
        self.lines(joints).is_some_and(|[a, b, c]| {
            is_parallel(&a, &b) && is_parallel(&a, &c) && self.in_one_plane(&[a, b, c])
        })
    }

    /// Where two are on one line, that says all.
    fn pencil(&self, joints: [usize; 3]) -> bool {
        let [i, j, k] = joints;
        let on_one_line = self.collinear(i, j) || self.collinear(i, k) || self.collinear(j, k);
        !on_one_line && self.concurrent(&joints) && self.coplanar(&joints)
    }

    fn concurrent(&self, joints: &[usize]) -> bool {
        self.all_lines(joints)
            .is_some_and(|lines| super::concurrency(&lines, 1e-3, self.length).is_some())
    }

    fn coplanar(&self, joints: &[usize]) -> bool {
        self.all_lines(joints)
            .is_some_and(|lines| self.in_one_plane(&lines))
    }

    /// Whether lines lie in one plane.
    fn in_one_plane(&self, lines: &[Line]) -> bool {
        let Some((first, rest)) = lines.split_first() else {
            return true;
        };
        // Two directions that differ, or a direction and a connecting vector.
        let across = rest
            .iter()
            .map(|line| cross(first.direction, line.direction));
        let between = rest
            .iter()
            .map(|line| cross(first.direction, first.offset_of(line.point)));
        let normal = (across.filter(|v| norm(*v) > 1e-3))
            .chain(between.filter(|v| norm(*v) > self.length))
            .next();
        let Some(normal) = normal.map(super::unit) else {
            return true;
        };
        rest.iter().all(|line| {
            dot(normal, line.direction).abs() < NEAR
                && dot(normal, sub(line.point, first.point)).abs() < self.length
        })
    }

    /// Parallel revolutes on different lines and a slide normal to their plane.
    fn slides_across(&self, i: usize, j: usize, slide: usize) -> bool {
        let (Some([a, b]), Axis::Prismatic { direction }) = (self.lines([i, j]), self.axes[slide])
        else {
            return false;
        };
        let between = a.offset_of(b.point);
        is_parallel(&a, &b)
            && norm(between) > self.length
            && dot(direction, a.direction).abs() < NEAR
            && dot(direction, between).abs() < self.length
    }
}

fn is_parallel(a: &Line, b: &Line) -> bool {
    norm(cross(a.direction, b.direction)) < NEAR
}

/// Whether a force along some line does no work on any joint: the wrench that
/// a singular arm bears without torque is then a pure force.
fn all_meet_a_line(twists: &[Twist], size: f64) -> bool {
    let Some([f, t]) = bearing_wrench(twists, size) else {
        return false;
    };
    norm(f) > 1e-3 && dot(f, t).abs() < NEAR * norm(f)
}

/// The wrench (force, moment / size) that six twists of rank 5 leave alone, of length 1. None if
/// the rank is 6, or less than 5.
fn bearing_wrench(twists: &[Twist], size: f64) -> Option<[Vec3; 2]> {
    let columns: &[Twist; 6] = twists.try_into().ok()?;
    let found = SingularValues::<6, 6>::new(&unitless_rows(columns, size));
    let is_of_rank_5 = found.values[4] > LEAST && found.values[5] <= NEAR;
    let [fx, fy, fz, tx, ty, tz] = found.left[5];
    is_of_rank_5.then_some([[fx, fy, fz], [tx, ty, tz]])
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |joints: &[usize]| {
            let numbers: Vec<String> = joints.iter().map(|i| (i + 1).to_string()).collect();
            match numbers.split_last() {
                Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
                _ => numbers.concat(),
            }
        };
        match self {
            Condition::Collinear(joints) => write!(f, "axes {} on one line", list(joints)),
            Condition::ParallelCoplanar(joints) => {
                write!(f, "parallel axes {} in one plane", list(joints))
            }
            Condition::Pencil(joints) => {
                write!(
                    f,
                    "axes {} through one point and in one plane",
                    list(joints)
                )
            }
            Condition::Concurrent(joints) => write!(f, "axes {} through one point", list(joints)),
            Condition::Coplanar(joints) => write!(f, "axes {} in one plane", list(joints)),
            Condition::SlideAcross { parallel, slide } => write!(
                f,
                "joint {} slides square to the plane of the parallel axes {}",
                slide + 1,
                list(parallel)
            ),
            Condition::AllMeetALine => f.write_str("all six axes meet one line"),
        }
    }
}
