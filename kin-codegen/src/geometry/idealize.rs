//! Idealization: a noisy file read as the arm of exact relations that it stands for.
//!
//! A file that says rpy="1.5708 0 0" means a right angle; an individually
//! calibrated arm has axes a milliradian off their design. Closed forms need
//! exact relations, so the axes are moved onto the relations that they nearly
//! satisfy. The arm as given is kept: forward kinematics and the last step of
//! inverse kinematics are always its own.

use super::{Line, Vec3, along, axes, cross, dot, norm, size, sub, unit};
use crate::model::{JointKind, Model};
use kin_runtime::Pose;

/// Tolerances to read relations with, the strictest first: rounding of the
/// file's own digits, right angles of 9, 7 and 5 digits, and calibrated arms.
const TOLERANCES: [f64; 6] = [1e-12, 1e-8, 1e-6, 5e-5, 1e-3, NOISIEST];
/// The largest of them.
pub(crate) const NOISIEST: f64 = 8e-3;
/// Axes that were shifted to meet do so but for rounding, relative to the arm's size.
const MEETING: f64 = 1e-12;
/// Noise that reaches over a tolerance is found by so many times it.
const WIDER: f64 = 10.0;

/// An idealized model and what it took.
#[derive(Clone, Debug)]
pub struct Idealized {
    /// The arm with exact relations.
    pub model: Model,
    /// The axes that moved.
    pub moved: Vec<Moved>,
    /// The largest angle in radians by which directions were judged equal;
    /// lengths, relative to the arm's size, by the same number.
    pub tolerance: f64,
}

/// One axis that was moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Index of the joint.
    pub joint: usize,
    /// By how much its direction turned, radians.
    pub angle: f64,
    /// By how much its line shifted, metres.
    pub distance: f64,
}

impl Idealized {
    /// Whether a wider tolerance moves nothing else. Otherwise noise reaches over the tolerance: of
    /// axes that are all meant to be parallel some are read so, and others not.
    pub(crate) fn is_clear(&self, given: &Model) -> bool {
        idealize(given, WIDER * self.tolerance).moved == self.moved
    }
}

/// The arm with the relations that its axes satisfy to one tolerance after the other, the strictest
/// first, each time that there are others.
pub(crate) fn idealizations(model: &Model) -> impl Iterator<Item = Idealized> {
    let mut last: Option<Vec<Moved>> = None;
    let read = move |tolerance| {
        let idealized = idealize(model, tolerance);
        let is_other = last.as_ref() != Some(&idealized.moved);
        last = Some(idealized.moved.clone());
        is_other.then_some(idealized)
    };
    TOLERANCES.into_iter().filter_map(read)
}

/// Moves every axis onto the relations that it satisfies to within
/// `tolerance`: radians for directions, multiples of the arm's size for
/// distances.
pub fn idealize(model: &Model, tolerance: f64) -> Idealized {
    let given = axes(model);
    let directions = idealize_directions(&given, tolerance);
    let lines = idealize_points(model, &given, &directions, tolerance);
    let mut idealized = model.clone();
    let mut moved = Vec::new();
    for (i, (line, was)) in lines.iter().zip(&given).enumerate() {
        let joint = &mut idealized.joints[i];
        joint.axis = line.direction;
        joint.point = line.point;
        let angle = norm(cross(line.direction, was.direction));
        let distance = match joint.kind {
            JointKind::Revolute => norm(was.offset_of(line.point)),
            JointKind::Prismatic => 0.0,
        };
        if angle > 1e-15 || distance > 1e-15 * size(model) {
            moved.push(Moved {
                joint: i,
                angle,
                distance,
            });
        }
    }
    idealized.home = idealize_tip(&idealized, tolerance);
    Idealized {
        model: idealized,
        moved,
        tolerance,
    }
}

/// Nearly equal directions become equal, nearly right angles right.
fn idealize_directions(axes: &[Line], tolerance: f64) -> Vec<Vec3> {
    let base = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut known: Vec<Vec3> = Vec::new();
    let mut out = Vec::with_capacity(axes.len());
    for axis in axes {
        let d = axis.direction;
        let equal = known
            .iter()
            .rev()
            .chain(&base)
            .find(|k| norm(cross(**k, d)) < tolerance)
            .map(|k| k.map(|x| x * dot(*k, d).signum()));
        let idealized = equal.unwrap_or_else(|| square_up(d, &known, tolerance));
        if !known.iter().any(|k| norm(cross(*k, idealized)) < tolerance) {
            known.push(idealized);
        }
        // −0 would read as a sign of its own.
        out.push(idealized.map(|x| x + 0.0));
    }
    out
}

/// Makes a direction exactly perpendicular to those it is nearly
/// perpendicular to.
fn square_up(d: Vec3, known: &[Vec3], tolerance: f64) -> Vec3 {
    let mut right = known.iter().filter(|k| dot(**k, d).abs() < tolerance);
    let Some(&first) = right.next() else { return d };
    let second = right.find(|k| norm(cross(first, **k)) > 0.1);
    let idealized = match second {
        Some(&second) => cross(first, second),
        None => along(d, -dot(d, first), first),
    };
    unit(idealized.map(|x| x * dot(idealized, d).signum()))
}

/// Axes that nearly meet the one before, or a point where earlier ones meet,
/// are shifted to meet it; `tolerance` in units of the arm's size.
fn idealize_points(
    model: &Model,
    given: &[Line],
    directions: &[Vec3],
    tolerance: f64,
) -> Vec<Line> {
    let size = size(model);
    let tolerance = tolerance * size;
    let mut lines: Vec<Line> = Vec::with_capacity(given.len());
    let mut centres: Vec<Vec3> = Vec::new();
    for (i, (line, &direction)) in given.iter().zip(directions).enumerate() {
        let mut line = Line {
            direction,
            point: line.point,
        };
        if model.joints[i].is_revolute() {
            let near = |c: &&Vec3| norm(line.offset_of(**c)) < tolerance;
            let previous = (0..i).rev().find(|&j| model.joints[j].is_revolute());
            if let Some(&centre) = centres.iter().rev().find(near) {
                line.point = along(line.point, 1.0, line.offset_of(centre));
            } else if let Some(previous) = previous.map(|j| lines[j]) {
                meet(&previous, &mut line, tolerance);
            }
            if let Some(previous) = previous.map(|j| lines[j])
                && norm(cross(previous.direction, line.direction)) > 0.01
                && previous.distance(&line) < MEETING * size
            {
                centres.push(previous.foot(&line));
            }
        }
        lines.push(line);
    }
    lines
}

/// Shifts `line` to meet `other` if it nearly does.
fn meet(other: &Line, line: &mut Line, tolerance: f64) {
    if norm(cross(other.direction, line.direction)) < 0.01 || other.distance(line) > tolerance {
        return;
    }
    let gap = sub(other.foot(line), line.foot(other));
    line.point = along(line.point, 1.0, gap);
}

/// The tip's orientation, square to the last axis where it nearly is.
fn idealize_tip(model: &Model, tolerance: f64) -> Pose {
    let mut home = model.home;
    let mut known: Vec<Vec3> = model.joints.iter().rev().map(|joint| joint.axis).collect();
    known.extend([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    let mut columns = [0, 1].map(|j| super::linkage::column(&home, j));
    for column in &mut columns {
        let equal = known.iter().find(|k| norm(cross(**k, *column)) < tolerance);
        *column = match equal {
            Some(k) => k.map(|x| x * dot(*k, *column).signum()),
            None => square_up(*column, &known[..1], tolerance),
        };
    }
    let [x, y] = columns;
    // The two columns may have gone to axes that are not square to each other.
    let y = unit(along(y, -dot(x, y), x));
    let z = cross(x, y);
    home.rotation = std::array::from_fn(|i| [x[i] + 0.0, y[i] + 0.0, z[i] + 0.0]);
    home
}
