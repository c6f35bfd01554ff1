//! Chains whose joints mimic each other, as chains whose joints move by themselves.
//!
//! Neighbours that turn about one line, or slide along one direction, become one joint, whose value
//! is a linear function of the coordinates of q: behind a parallelogram, that of an elbow is q₃ − q₂.
//! Such a chain is solved as any other, and the values of its joints tell the coordinates, one after
//! the other. Joints that tell none have to agree with those that do, as the wrist of a palletizer
//! that keeps its tool level.

use super::{AxisRelation, Line, Linkage, cross, dot, norm, relate, size};
use crate::model::{Joint, JointKind, Model, Variable};
use crate::spec::Rating;
use kin_runtime::__private::math::wrap;
use std::f64::consts::TAU;
use std::fmt;

/// Neighbours that differ by more are not one joint: radians, and relative to the arm's size.
const SAME: f64 = 1e-11;
/// By so much less than a full turn limits are apart at least between which an angle is told.
const ROUNDING: f64 = 1e-9;

/// How the joints of a chain depend on the coordinates of q.
#[derive(Clone, Debug)]
pub struct Coupling {
    /// The frames of all joints that the file has.
    pub whole: Box<Linkage>,
    /// By joint.
    pub rows: Vec<Combination>,
    /// Which joint tells which coordinate, in an order in which each needs those before it alone.
    pub told: Vec<Told>,
    /// By coordinate; none of one that is the same a full turn further.
    pub limits: Vec<Option<[f64; 2]>>,
}

/// The value of a joint is Σ weights · q + offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// By coordinate.
    pub weights: Vec<f64>,
    /// Radians or metres.
    pub offset: f64,
}

/// A coordinate, and the joint by which it is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    /// From 0.
    pub coordinate: usize,
    /// From 0.
    pub joint: usize,
    /// Of a joint that turns, the value of the coordinate within half a turn of which it is told.
    pub about: Option<f64>,
}

/// Why the values of joints do not tell the coordinates.
#[derive(Clone, Debug, PartialEq)]
pub enum Untold {
    /// No joint tells this one, by name.
    Coordinate(String),
    /// Several values of this one within its limits are one angle of the joint that tells it.
    Range(String),
}

impl Coupling {
    /// The values of the joints.
    pub fn joints(&self, q: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| row.value(q)).collect()
    }

    /// The coordinates that joints of some values tell.
    pub fn coordinates(&self, joints: &[f64]) -> Vec<f64> {
        let mut q = vec![0.0; self.limits.len()];
        for told in &self.told {
            let row = &self.rows[told.joint];
            // Those that are not known yet are 0, and have no weight.
            let weight = row.weights[told.coordinate];
            q[told.coordinate] = told.about.unwrap_or(0.0);
            let beside = (joints[told.joint] - row.value(&q)) * weight.signum();
            let within = match told.about {
                Some(_) => wrap(beside),
                None => beside,
            };
            q[told.coordinate] += within / weight.abs();
        }
        q
    }

    /// Whether a coordinate is the same a full turn further.
    pub fn repeats(&self, coordinate: usize) -> bool {
        self.limits[coordinate].is_none()
    }

    /// The coordinate that moves a joint as if it were that, and no other one.
    pub fn coordinate(&self, joint: usize) -> Option<usize> {
        let row = self.rows.get(joint)?;
        let i = row.weights.iter().position(|&weight| weight != 0.0)?;
        let rest = |(j, row): (usize, &Combination)| j == joint || row.weights[i] == 0.0;
        let is_alone = row.weights[i + 1..].iter().all(|&weight| weight == 0.0)
            && self.rows.iter().enumerate().all(rest);
        (is_alone && row.weights[i] == 1.0 && row.offset == 0.0).then_some(i)
    }

    /// What the joints are that plans speak of.
    pub fn sentence(&self) -> String {
        let rows: Vec<String> = self.rows.iter().map(Combination::to_string).collect();
        format!(
            "Solved as a chain whose joints move by themselves, neighbours on one line being one: in \
             the plan q1 to q{} are {} of this arm.",
            rows.len(),
            rows.join(", ")
        )
    }

    /// Whether a coordinate is told by a joint.
    pub fn tells(&self, joint: usize) -> bool {
        self.told.iter().any(|told| told.joint == joint)
    }
}

impl fmt::Display for Combination {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = self.weights.iter().enumerate().map(|(i, &weight)| {
            let q = format!("q{}", i + 1);
            match weight.abs() {
                1.0 => (weight, q),
                times => (weight, format!("{times} {q}")),
            }
        });
        let offset = (self.offset, self.offset.abs().to_string());
        let all = parts.chain([offset]).filter(|(value, _)| *value != 0.0);
        for (i, (value, text)) in all.enumerate() {
            match (i, value < 0.0) {
                (0, false) => {}
                (0, true) => f.write_str("−")?,
                (_, false) => f.write_str(" + ")?,
                (_, true) => f.write_str(" − ")?,
            }
            f.write_str(&text)?;
        }
        Ok(())
    }
}

impl Combination {
    /// Of a joint of the file.
    fn of(joint: &Joint, coordinates: usize) -> Self {
        let mut weights = vec![0.0; coordinates];
        weights[joint.variable] = joint.multiplier;
        Self {
            weights,
            offset: joint.offset,
        }
    }

    /// At these coordinates.
    pub fn value(&self, q: &[f64]) -> f64 {
        let moved = self.weights.iter().zip(q).map(|(weight, x)| weight * x);
        moved.sum::<f64>() + self.offset
    }

    fn add(&mut self, other: &Combination, sign: f64) {
        for (weight, other) in self.weights.iter_mut().zip(&other.weights) {
            *weight += sign * other;
        }
        self.offset += sign * other.offset;
    }

    /// The least and the most that the joint comes to, where no limit is missing.
    fn range(&self, variables: &[Variable]) -> Option<[f64; 2]> {
        let mut range = [self.offset; 2];
        for (weight, variable) in self.weights.iter().zip(variables) {
            if *weight != 0.0 {
                let ends = variable.limits?.map(|end| weight * end);
                range[0] += ends[0].min(ends[1]);
                range[1] += ends[0].max(ends[1]);
            }
        }
        Some(range)
    }
}

/// The chain whose joints move by themselves, and how they depend on the coordinates of an arm whose
/// joints mimic each other.
///
/// # Errors
///
/// Why its joints do not tell its coordinates.
pub fn apart(model: &Model) -> Result<(Model, Coupling), Untold> {
    let same = SAME * size(model);
    let line = |joint: &Joint| Line {
        direction: joint.axis,
        point: joint.point,
    };
    let is_one = |a: &Joint, b: &Joint| {
        let relation = relate(&line(a), &line(b), SAME, same);
        a.kind == b.kind
            && match a.kind {
                JointKind::Revolute => relation == AxisRelation::Coincident,
                JointKind::Prismatic => norm(cross(a.axis, b.axis)) < SAME,
            }
    };
    let mut joints: Vec<Joint> = Vec::new();
    let mut rows: Vec<Combination> = Vec::new();
    for joint in &model.joints {
        let row = Combination::of(joint, model.variables.len());
        match joints.last_mut().zip(rows.last_mut()) {
            Some((last, sum)) if is_one(last, joint) => {
                sum.add(&row, dot(last.axis, joint.axis).signum());
                (last.link, last.frame) = (joint.link.clone(), joint.frame);
                if joint.is_coordinate(joint.variable) {
                    last.name = joint.name.clone();
                }
            }
            _ => {
                joints.push(joint.clone());
                rows.push(row);
            }
        }
    }
    let mut variables = Vec::new();
    for (i, (joint, row)) in joints.iter_mut().zip(&rows).enumerate() {
        (joint.variable, joint.multiplier, joint.offset) = (i, 1.0, 0.0);
        variables.push(Variable {
            name: joint.name.clone(),
            limits: row.range(&model.variables),
            rating: Rating::default(),
        });
    }
    let endless = [f64::NEG_INFINITY, f64::INFINITY];
    let limits = (0..model.variables.len()).map(|i| match model.repeats(i) {
        true => None,
        false => Some(model.variables[i].limits.unwrap_or(endless)),
    });
    let limits = limits.collect();
    let coupling = Coupling {
        whole: Box::new(Linkage::new(model)),
        told: told(model, &joints, &rows)?,
        rows,
        limits,
    };
    let apart = Model {
        joints,
        variables,
        frames: Vec::new(),
        warnings: Vec::new(),
        ..model.clone()
    };
    Ok((apart, coupling))
}

/// Which joint tells which coordinate: a length tells any, an angle one that turns with it within
/// less than a full turn, or once for a full turn that changes nothing.
fn told(model: &Model, joints: &[Joint], rows: &[Combination]) -> Result<Vec<Told>, Untold> {
    let n = model.variables.len();
    let mut told: Vec<Told> = Vec::new();
    while told.len() < n {
        let is_known = |i: usize| told.iter().any(|told| told.coordinate == i);
        let only = |joint: usize| {
            let mut unknown = (0..n).filter(|&i| rows[joint].weights[i] != 0.0 && !is_known(i));
            let i = unknown.next().filter(|_| unknown.next().is_none())?;
            Some((joint, i))
        };
        let alone: Vec<(usize, usize)> = (0..joints.len()).filter_map(only).collect();
        let all = alone.iter().filter_map(|&(joint, i)| {
            let about = match joints[joint].kind {
                JointKind::Prismatic => None,
                JointKind::Revolute => Some(middle(model, i, rows[joint].weights[i])?),
            };
            Some(Told {
                coordinate: i,
                joint,
                about,
            })
        });
        // By a length at best.
        let Some(next) = all.min_by_key(|told| told.about.is_some()) else {
            let wide = alone.iter().find(|&&(_, i)| !model.repeats(i));
            let untold = (0..n).find(|&i| !is_known(i)).unwrap_or(0);
            let name = |i: usize| model.variables[i].name.clone();
            return Err(match wide {
                Some(&(_, i)) => Untold::Range(name(i)),
                None => Untold::Coordinate(name(untold)),
            });
        };
        told.push(next);
    }
    Ok(told)
}

/// The value of a coordinate that the angle of a joint tells it about; none where several of its
/// values have that angle.
fn middle(model: &Model, i: usize, weight: f64) -> Option<f64> {
    if model.repeats(i) {
        return (weight.abs() == 1.0).then_some(0.0);
    }
    let [lower, upper] = model.variables[i].limits?;
    (weight.abs() * (upper - lower) < TAU - ROUNDING).then_some(0.5 * (lower + upper))
}
