//! Chains whose joints mimic each other, as chains whose joints move by themselves.
//!
//! Neighbours that turn about one line, or slide along one direction, become one joint, whose value
//! is a linear function of the coordinates of q: behind a parallelogram, that of an elbow is q₃ − q₂.
//! So do two slides along one direction with nothing between them but turns about axes along it, which
//! let it pass: the quill of a SCARA that its turn lifts by a thread.
//! So do three that turn about parallel axes by θ, −θ and θ, as two sides of a parallelogram do and
//! what it carries: that turns by θ about a fourth axis, a remote centre of motion.
//! Such a chain is solved as any other, and the coordinates follow from the values of its joints, one
//! after the other. Dependent joints, from which none follows, have to agree with those: the wrist
//! of a palletizer, which keeps its tool level.

use super::{Line, Linkage, PairRelation, Vec3, along, cross, dot, norm, relate, size};
use crate::model::{Joint, JointKind, Model, Variable};
use crate::spec::Rating;
use kin_runtime::__private::math::wrap;
use std::f64::consts::TAU;

/// Neighbours that differ by more are not one joint: radians, and relative to the arm's size.
const SAME: f64 = 1e-11;
/// By so much at least limits are less than a full turn apart where a coordinate follows from an
/// angle.
const ROUNDING: f64 = 1e-9;

/// How the joints of a chain depend on the coordinates of q; both are those behind what is given in
/// front.
#[derive(Clone, Debug)]
pub struct Coupling {
    /// The frames of all joints that the file has.
    pub whole: Box<Linkage>,
    /// How many joints in front are given, which are coordinates themselves.
    pub given: usize,
    /// By joint.
    pub rows: Vec<Combination>,
    /// The coordinates by the values of joints, in an order in which each needs those before it
    /// alone.
    pub inverse: Vec<InverseRow>,
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

/// A coordinate, and the joint whose value it follows from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseRow {
    /// From 0.
    pub coordinate: usize,
    /// From 0.
    pub joint: usize,
    /// Of a joint that turns, the value about which the coordinate is, within half a turn of the
    /// joint.
    pub about: Option<f64>,
}

/// Why the coordinates do not follow from the values of joints.
#[derive(Clone, Debug, PartialEq)]
pub enum Undetermined {
    /// This one, by name, from no joint.
    Coordinate(String),
    /// Several values of this one within its limits are one angle of its joint.
    Range(String),
}

impl Coupling {
    /// The values of the joints.
    pub fn joints(&self, q: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| row.value(q)).collect()
    }

    /// The coordinates from the values of the joints that they follow from.
    pub fn coordinates(&self, joints: &[f64]) -> Vec<f64> {
        let mut q = vec![0.0; self.limits.len()];
        for inverse in &self.inverse {
            let row = &self.rows[inverse.joint];
            // Those that are not known yet are 0, and have no weight.
            let weight = row.weights[inverse.coordinate];
            q[inverse.coordinate] = inverse.about.unwrap_or(0.0);
            let beside = (joints[inverse.joint] - row.value(&q)) * weight.signum();
            let within = match inverse.about {
                Some(_) => wrap(beside),
                None => beside,
            };
            q[inverse.coordinate] += within / weight.abs();
        }
        q
    }

    /// Whether the joints are the coordinates, one by one.
    fn is_none(&self) -> bool {
        let is_own = |(i, row): (usize, &Combination)| {
            let own = |(k, &weight): (usize, &f64)| weight == f64::from(u8::from(k == i));
            row.offset == 0.0 && row.weights.iter().enumerate().all(own)
        };
        self.rows.len() == self.limits.len() && self.rows.iter().enumerate().all(is_own)
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
        let row = |row: &Combination| row.text(self.given);
        let rows: Vec<String> = self.rows.iter().map(row).collect();
        format!(
            "Solved as a chain whose joints move by themselves, those that do the same as one being \
             one: in the plan q{} to q{} are {} of this arm.",
            self.given + 1,
            self.given + rows.len(),
            rows.join(", ")
        )
    }

    /// Whether some joints have to agree with others.
    pub fn is_overdetermined(&self) -> bool {
        self.rows.len() > self.inverse.len()
    }

    /// Whether a coordinate follows from a joint. The others have to agree with those that do.
    pub fn is_independent(&self, joint: usize) -> bool {
        self.inverse.iter().any(|inverse| inverse.joint == joint)
    }
}

impl Combination {
    /// With so many coordinates in front.
    fn text(&self, given: usize) -> String {
        let parts = self.weights.iter().enumerate().map(|(i, &weight)| {
            let q = format!("q{}", given + i + 1);
            match weight.abs() {
                1.0 => (weight, q),
                times => (weight, format!("{times} {q}")),
            }
        });
        let offset = (self.offset, self.offset.abs().to_string());
        let all = parts.chain([offset]).filter(|(value, _)| *value != 0.0);
        let signed = all.enumerate().map(|(i, (value, text))| {
            let sign = match (i, value < 0.0) {
                (0, false) => "",
                (0, true) => "−",
                (_, false) => " + ",
                (_, true) => " − ",
            };
            format!("{sign}{text}")
        });
        signed.collect()
    }

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

    fn times(&self, sign: f64) -> Self {
        // Not −0.
        let times = |x: f64| sign * x + 0.0;
        Self {
            weights: self.weights.iter().map(|&weight| times(weight)).collect(),
            offset: times(self.offset),
        }
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

/// Of an arm whose joints mimic each other, the chain whose joints move by themselves, with its
/// linkage, which has the [`Coupling`] unless its joints are the coordinates themselves.
///
/// # Errors
///
/// Which coordinate does not follow from the values of joints.
pub fn uncoupled(model: &Model) -> Result<(Model, Linkage), Undetermined> {
    let Merged {
        mut joints, rows, ..
    } = Merged::of(model, |_, _| true);
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
        given: 0,
        inverse: inverse(model, &joints, &rows)?,
        rows,
        limits,
    };
    let uncoupled = Model {
        joints,
        variables,
        frames: Vec::new(),
        warnings: Vec::new(),
        ..model.clone()
    };
    let coupling = Some(coupling).filter(|coupling| !coupling.is_none());
    let linkage = Linkage::new(&uncoupled).with_coupling(coupling);
    Ok((uncoupled, linkage))
}

/// The same of an arm whose first joints are given, which are coordinates themselves and move nothing
/// else: they are locked.
///
/// # Errors
///
/// Which coordinate behind them does not follow from the values of joints.
pub fn uncoupled_behind(model: &Model, given: usize) -> Result<(Model, Linkage), Undetermined> {
    let (front, behind) = model.joints.split_at(given);
    let mut rest = Model {
        joints: behind.to_vec(),
        variables: model.variables[given..].to_vec(),
        frames: Vec::new(),
        ..model.clone()
    };
    rest.joints.iter_mut().for_each(|it| it.variable -= given);
    let (mut rest, linkage) = uncoupled(&rest)?;
    rest.joints.iter_mut().for_each(|it| it.variable += given);
    let uncoupled = Model {
        joints: [front, &rest.joints].concat(),
        variables: [&model.variables[..given], &rest.variables].concat(),
        ..rest
    };
    let locked: Vec<usize> = (0..given).collect();
    let whole = Linkage::new(model).with_locked(&locked);
    let coupling = linkage.coupling.map(|coupling| Coupling {
        whole: Box::new(whole),
        given,
        ..coupling
    });
    let linkage = Linkage::new(&uncoupled).with_locked(&locked);
    Ok((uncoupled, linkage.with_coupling(coupling)))
}

/// Of an arm whose joints mimic each other the chain whose joints are the coordinates themselves, if
/// each of these moves joints that do the same as one, and no others: the stages of a column, each of
/// which slides along the one below. A slide with a gear is never solved for.
pub fn by_coordinates(model: &Model) -> Option<Model> {
    let moves_same = |a: &Combination, b: &Combination| {
        let mut weights = a.weights.iter().zip(&b.weights);
        weights.all(|(a, b)| (*a == 0.0) == (*b == 0.0))
    };
    let Merged {
        mut joints, rows, ..
    } = Merged::of(model, moves_same);
    let is_own = |(i, row): (usize, &Combination)| {
        let weights = || row.weights.iter().enumerate();
        row.weights[i] != 0.0 && weights().all(|(k, &weight)| k == i || weight == 0.0)
    };
    if rows.len() != model.variables.len() || !rows.iter().enumerate().all(is_own) {
        return None;
    }
    let mut home = model.home;
    for (i, row) in rows.iter().enumerate() {
        let weight = row.weights[i];
        let joint = &mut joints[i];
        if joint.is_revolute() && (weight.abs() != 1.0 || row.offset != 0.0) {
            return None;
        }
        let axis = joint.axis;
        joint.axis = axis.map(|x| weight.signum() * x + 0.0);
        joint.gear = weight.abs();
        joint.name.clone_from(&model.variables[i].name);
        (joint.variable, joint.multiplier, joint.offset) = (i, 1.0, 0.0);
        // At zero it is where its offset has it, and so is all behind.
        let shift = |point: &mut Vec3| *point = along(*point, row.offset, axis);
        joints[i..].iter_mut().for_each(|joint| {
            shift(&mut joint.point);
            shift(&mut joint.frame.translation);
        });
        shift(&mut home.translation);
    }
    Some(Model {
        joints,
        home,
        ..model.clone()
    })
}

/// The chain that a closed form of an arm whose joints mimic each other is for, with so many joints
/// given if any are.
pub fn solved_chain(model: &Model, given: Option<usize>) -> Option<(Model, Linkage)> {
    let Some(given) = given else {
        return uncoupled(model).ok();
    };
    if let Some(own) = by_coordinates(model) {
        let linkage = Linkage::new(&own);
        return Some((own, linkage));
    }
    uncoupled_behind(model, given).ok()
}

/// A chain in which joints that do the same as one are one.
struct Merged {
    /// Which of these are.
    may_be_one: fn(&Combination, &Combination) -> bool,
    /// Neighbours that differ by less are one joint, metres.
    same: f64,
    joints: Vec<Joint>,
    rows: Vec<Combination>,
}

impl Merged {
    fn of(model: &Model, may_be_one: fn(&Combination, &Combination) -> bool) -> Self {
        let mut chain = Merged {
            may_be_one,
            same: SAME * size(model),
            joints: Vec::new(),
            rows: Vec::new(),
        };
        for joint in &model.joints {
            chain.joints.push(joint.clone());
            let row = Combination::of(joint, model.variables.len());
            chain.rows.push(row);
            while chain.merges_two() || chain.merges_three() {}
        }
        chain
    }

    /// Makes one of the last joint and one before it if these turn about one line, as neighbours, or
    /// slide along one direction, and all joints between them turn about axes along it.
    fn merges_two(&mut self) -> bool {
        let Some((last, before)) = self.joints.split_last() else {
            return false;
        };
        let slides = last.kind == JointKind::Prismatic;
        let lets_pass = |joint: &&Joint| joint.is_revolute() && are_parallel(joint, last);
        let passed = match slides {
            true => before.iter().rev().take_while(lets_pass).count(),
            false => 0,
        };
        let Some(place) = before.len().checked_sub(passed + 1) else {
            return false;
        };
        let own = &before[place];
        let [row, last_row] = [place, before.len()].map(|i| &self.rows[i]);
        let is_one = own.kind == last.kind
            && (self.may_be_one)(row, last_row)
            && match slides {
                true => are_parallel(own, last),
                false => {
                    let [one, other] = [own, last].map(Line::of);
                    relate(&one, &other, SAME, self.same) == PairRelation::Coincident
                }
            };
        if is_one {
            let sign = dot(own.axis, last.axis).signum();
            if let Some(row) = self.drop_last(place) {
                self.rows[place].add(&row, sign);
            }
        }
        is_one
    }

    /// Makes one of the last three joints if these turn about parallel axes by θ, −θ and θ. With axes
    /// through p₁, p₂ and p₃ the last one turns by θ about that through p₁ − p₂ + p₃.
    fn merges_three(&mut self) -> bool {
        let ([.., a, b, c], [.., first, second, third]) = (&self.joints[..], &self.rows[..]) else {
            return false;
        };
        let turn = |joint: &&Joint| joint.is_revolute() && are_parallel(a, joint);
        let by = |joint: &Joint, row: &Combination| row.times(dot(a.axis, joint.axis).signum());
        let is_one = [a, b, c].iter().all(turn)
            && [first, second, third].iter().all(|row| row.offset == 0.0)
            && by(b, second) == first.times(-1.0)
            && by(c, third) == *first;
        if is_one {
            let [p, minus, plus] = [a, b, c].map(|joint| joint.point);
            let centre = [0, 1, 2].map(|i| p[i] - minus[i] + plus[i]);
            let place = self.joints.len() - 3;
            self.drop_last(place + 1);
            self.drop_last(place);
            if let Some(last) = self.joints.last_mut() {
                last.point = centre;
            }
        }
        is_one
    }

    /// Takes the last joint away, which the one at a place does the same as; that has its name if it is
    /// of a coordinate, and the one before it its link.
    fn drop_last(&mut self, same: usize) -> Option<Combination> {
        let (dropped, row) = self.joints.pop().zip(self.rows.pop())?;
        if dropped.is_coordinate(dropped.variable) {
            self.joints[same].name.clone_from(&dropped.name);
        }
        let last = self.joints.last_mut()?;
        (last.link, last.frame) = (dropped.link, dropped.frame);
        Some(row)
    }
}

fn are_parallel(a: &Joint, b: &Joint) -> bool {
    norm(cross(a.axis, b.axis)) < SAME
}

/// From which joint which coordinate follows: from a length any, from an angle one that turns with
/// it within less than a full turn, or once for a full turn that changes nothing.
fn inverse(
    model: &Model,
    joints: &[Joint],
    rows: &[Combination],
) -> Result<Vec<InverseRow>, Undetermined> {
    let n = model.variables.len();
    let mut inverse: Vec<InverseRow> = Vec::new();
    while inverse.len() < n {
        let is_known = |i: usize| inverse.iter().any(|row| row.coordinate == i);
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
            Some(InverseRow {
                coordinate: i,
                joint,
                about,
            })
        });
        // By a length at best.
        let Some(next) = all.min_by_key(|row| row.about.is_some()) else {
            let wide = alone.iter().find(|&&(_, i)| !model.repeats(i));
            let unknown = (0..n).find(|&i| !is_known(i)).unwrap_or(0);
            let name = |i: usize| model.variables[i].name.clone();
            return Err(match wide {
                Some(&(_, i)) => Undetermined::Range(name(i)),
                None => Undetermined::Coordinate(name(unknown)),
            });
        };
        inverse.push(next);
    }
    Ok(inverse)
}

/// The value of a coordinate about which it follows from the angle of a joint; none where several
/// of its values have that angle.
fn middle(model: &Model, i: usize, weight: f64) -> Option<f64> {
    if model.repeats(i) {
        return (weight.abs() == 1.0).then_some(0.0);
    }
    let [lower, upper] = model.variables[i].limits?;
    (weight.abs() * (upper - lower) < TAU - ROUNDING).then_some(0.5 * (lower + upper))
}
