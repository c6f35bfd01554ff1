//! The structure of an arm: how the axes of the file lie to each other, in the
//! field's words.

use super::{Line, PairRelation, Vec3, angle, axes, concurrency, norm, relate, size};
use crate::model::Model;
use std::fmt::{self, Display, Formatter};
use std::ops::Range;

/// Relations that hold to this are named, with how far off they are: radians,
/// and multiples of the arm's size.
const NEAR: f64 = 1e-3;
/// Deviations below this are rounding, and not worth a word; radians, metres.
const ROUNDING: f64 = 1e-9;

/// How the axes lie.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Axes {
    /// Every joint and the next.
    pub neighbours: Vec<Neighbours>,
    /// Longest rows of joints with a relation in common.
    pub rows: Vec<Row>,
}

/// The axes of two joints.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Neighbours {
    /// Their numbers.
    pub joints: [usize; 2],
    /// What they are to each other, to within a thousandth of a radian and of the arm's size.
    pub relation: PairRelation,
    /// Between them, from 0 to π/2.
    pub angle: f64,
    /// Between the lines; 0 where one of them is merely a direction because
    /// its joint slides.
    pub distance: f64,
}

/// A row of joints with a relation in common.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Row {
    /// Their numbers. Joints that slide may lie between parallel ones.
    pub joints: Vec<usize>,
    /// What they have in common.
    pub relation: RowRelation,
    /// Where they meet.
    pub point: Option<Vec3>,
    /// How far off they are: radians if parallel, metres if concurrent.
    pub deviation: f64,
}

/// What the axes of a row have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum RowRelation {
    /// All parallel.
    Parallel,
    /// All through one point.
    Concurrent,
    /// The first three, through one point.
    SphericalShoulder,
    /// The last three, through one point.
    SphericalWrist,
}

impl Axes {
    /// The relations of a chain at home.
    pub fn of(model: &Model) -> Self {
        let lines = axes(model);
        let neighbours = (1..lines.len())
            .map(|i| neighbours(model, &lines, i - 1))
            .collect();
        let mut rows = parallel_rows(model, &lines);
        rows.extend(concurrent_rows(model, &lines));
        Self { neighbours, rows }
    }
}

fn slides(model: &Model, joint: usize) -> bool {
    !model.joints[joint].is_revolute()
}

fn neighbours(model: &Model, lines: &[Line], i: usize) -> Neighbours {
    let (a, b) = (&lines[i], &lines[i + 1]);
    let angle = angle(a.direction, b.direction);
    let direction_alone = slides(model, i) || slides(model, i + 1);
    let relation = match relate(a, b, NEAR, NEAR * size(model)) {
        _ if direction_alone && angle < NEAR => PairRelation::Parallel,
        _ if direction_alone => PairRelation::Inclined,
        relation => relation,
    };
    let distance = match relation {
        _ if direction_alone => 0.0,
        // Nearly parallel lines have their common normal anywhere.
        PairRelation::Coincident | PairRelation::Parallel => norm(a.offset_of(b.point)),
        _ => a.distance(b),
    };
    Neighbours {
        joints: [i + 1, i + 2],
        relation,
        angle,
        distance,
    }
}

/// Rows of at least two revolute joints that are parallel; sliding joints in
/// between do not end them.
fn parallel_rows(model: &Model, lines: &[Line]) -> Vec<Row> {
    let turning: Vec<usize> = (0..lines.len()).filter(|&i| !slides(model, i)).collect();
    let deviation = |row: &[usize]| {
        let first = &lines[row[0]];
        let off = row
            .iter()
            .map(|&i| angle(first.direction, lines[i].direction));
        off.fold(0.0, f64::max)
    };
    longest(turning.len(), 2, |row| deviation(&turning[row]) < NEAR)
        .into_iter()
        .map(|row| Row {
            relation: RowRelation::Parallel,
            point: None,
            deviation: deviation(&turning[row.clone()]),
            joints: turning[row].iter().map(|i| i + 1).collect(),
        })
        .collect()
}

/// Rows of at least three neighbouring revolute joints that meet in a point.
fn concurrent_rows(model: &Model, lines: &[Line]) -> Vec<Row> {
    let n = lines.len();
    let length = NEAR * size(model);
    let meet = |row: Range<usize>| {
        let turn = !row.clone().any(|i| slides(model, i));
        turn.then(|| concurrency(&lines[row], 0.01, length))
            .flatten()
    };
    longest(n, 3, |row| meet(row).is_some())
        .into_iter()
        .map(|row| {
            let point = meet(row.clone());
            let off = |line: &Line| point.map_or(0.0, |point| norm(line.offset_of(point)));
            Row {
                relation: match (row.start, row.end) {
                    (0, end) if end < n => RowRelation::SphericalShoulder,
                    (start, end) if start > 0 && end == n => RowRelation::SphericalWrist,
                    _ => RowRelation::Concurrent,
                },
                point,
                deviation: lines[row.clone()].iter().map(off).fold(0.0, f64::max),
                joints: row.map(|i| i + 1).collect(),
            }
        })
        .collect()
}

/// Maximal ranges of `0..n` with a property that holds for parts as well.
fn longest(n: usize, least: usize, holds: impl Fn(Range<usize>) -> bool) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    for start in 0..n {
        let end = (start + least..=n)
            .take_while(|&end| holds(start..end))
            .last();
        if let Some(end) = end
            && found.last().is_none_or(|last| last.end < end)
        {
            found.push(start..end);
        }
    }
    found
}

/// How the axes lie to each other: `2, 3 parallel; spherical wrist at 4, 5, 6`.
pub fn structure(model: &Model) -> String {
    let axes = Axes::of(model);
    let mut found: Vec<String> = axes.rows.iter().map(ToString::to_string).collect();
    let meeting = axes.neighbours.iter().filter(|pair| {
        let met = |row: &Row| {
            row.point.is_some()
                && row.joints.contains(&pair.joints[0])
                && row.joints.contains(&pair.joints[1])
        };
        pair.relation == PairRelation::Intersecting && !axes.rows.iter().any(met)
    });
    found.extend(meeting.map(ToString::to_string));
    let sliding = model.joints.iter().enumerate();
    let sliding = sliding.filter(|(_, joint)| !joint.is_revolute());
    found.extend(sliding.map(|(i, _)| format!("{} slides", i + 1)));
    if found.is_empty() {
        found.push(match model.joints.len() {
            1 => "1 axis".into(),
            n => format!("{n} axes, no neighbours parallel or intersecting"),
        });
    }
    found.join("; ")
}

/// `4, 5, 6`.
pub fn numbers(joints: impl IntoIterator<Item = usize>) -> String {
    let numbers: Vec<String> = joints.into_iter().map(|i| i.to_string()).collect();
    numbers.join(", ")
}

impl Display for Axes {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for pair in &self.neighbours {
            writeln!(f, "  {pair}")?;
        }
        for row in &self.rows {
            writeln!(f, "  {row}")?;
        }
        Ok(())
    }
}

/// `, off by 3.7e-6 rad`, if it is worth a word.
fn off(deviation: f64, unit: &str) -> String {
    if deviation < ROUNDING {
        String::new()
    } else {
        format!(", off by {deviation:.1e} {unit}")
    }
}

impl Display for Neighbours {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self {
            angle, distance, ..
        } = *self;
        write!(f, "{}-{} ", self.joints[0], self.joints[1])?;
        let shown = angle.to_degrees();
        match self.relation {
            PairRelation::Coincident => {
                write!(f, "on one line{}{}", off(angle, "rad"), off(distance, "m"))
            }
            PairRelation::Parallel if distance < ROUNDING => {
                write!(f, "parallel{}", off(angle, "rad"))
            }
            PairRelation::Parallel => {
                write!(f, "parallel, {distance:.4} m apart{}", off(angle, "rad"))
            }
            PairRelation::Intersecting => {
                write!(f, "intersect at {shown:.2}°{}", off(distance, "m"))
            }
            PairRelation::Skew => write!(f, "skew, {distance:.4} m apart at {shown:.2}°"),
            PairRelation::Inclined => write!(f, "at {shown:.2}°"),
        }
    }
}

impl Display for Row {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let joints = numbers(self.joints.iter().copied());
        match self.relation {
            RowRelation::Parallel => write!(f, "{joints} parallel{}", off(self.deviation, "rad")),
            RowRelation::Concurrent => {
                write!(f, "{joints} meet in a point{}", off(self.deviation, "m"))
            }
            RowRelation::SphericalShoulder => write!(
                f,
                "spherical shoulder at {joints}{}",
                off(self.deviation, "m")
            ),
            RowRelation::SphericalWrist => {
                write!(f, "spherical wrist at {joints}{}", off(self.deviation, "m"))
            }
        }
    }
}
