//! Configurations in which axes that are no neighbours are aligned: parallel,
//! meeting, or one through a point of the other. There the relations of a plan
//! may degenerate where the arm does not: an amplitude of theirs is zero, by which
//! an angle is divided. Where they cannot be aligned, as near to it as they come: a
//! tilt of a few digits makes a plan lose what it would lose if it were degenerate.

use crate::geometry::{Line, Vec3, axes, concurrency, cross, dot, norm, size, sub};
use crate::model::{Model, configurations};
use crate::plan::Target;
use crate::random::Random;
use kin_runtime::Chain;
use kin_runtime::subproblems::{subproblem1, subproblem2};
use std::f64::consts::PI;

/// How far off their alignment configurations are tried too, radians or metres.
const OFF: [f64; 7] = [1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];
/// Neighbours that are nearer than this, relative to the arm's size, meet.
const MEETING: f64 = 1e-3;
/// Places of a joint at which two lines are looked at.
const PLACES: usize = 24;
/// Starts from which two joints are turned where those of one do not reach.
const STARTS: usize = 12;
/// Axes that are as near are parallel: a sine.
const PARALLEL: f64 = 1e-9;
/// Steps of a bisection, and of Newton's method.
const STEPS: usize = 60;

/// Configurations with two axes aligned, of which that about which a target leaves the tip free is one.
pub fn aligned(model: &Model, target: Target) -> Vec<Vec<f64>> {
    let mut random = Random(0x853c_49e6_748f_ea9b);
    let mut axes = axes(model);
    let joints = axes.len();
    if target.fixes_axis() {
        axes.push(Line {
            point: model.home.translation,
            direction: model.home.rotation.map(|row| row[2]),
        });
    }
    let arm = Aligner {
        model,
        joints,
        axes,
        chain: model.chain(),
    };
    arm.alignments(&mut random)
}

/// Each configuration off by a little in every coordinate.
pub fn neighbours(configurations: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut random = Random(0xda3e_39cb_94b9_5bdb);
    let sizes = OFF.into_iter().cycle();
    let mut off = |q: &Vec<f64>, size: f64| {
        let shifted = q.iter().map(|x| x + size * random.between(-1.0, 1.0));
        shifted.collect()
    };
    (configurations.iter().zip(sizes))
        .map(|(q, size)| off(q, size))
        .collect()
}

struct Aligner<'a> {
    model: &'a Model,
    joints: usize,
    /// Those of the joints, and behind them that of the tip if targets leave it free to turn; at home,
    /// base coordinates.
    axes: Vec<Line>,
    chain: Chain,
}

/// A point of the arm.
struct Point {
    /// The first joint that leaves it alone; those in front move it.
    first: usize,
    /// The last one, behind which joints do not move it.
    last: usize,
    /// At home, base coordinates.
    at: Vec3,
}

impl Point {
    fn new(first: usize, last: usize, at: Vec3) -> Self {
        Self { first, last, at }
    }
}

impl Aligner<'_> {
    fn alignments(&self, random: &mut Random) -> Vec<Vec<f64>> {
        let n = self.axes.len();
        let random_ones: Vec<Vec<f64>> = configurations(self.model);
        let mut anywhere = random_ones.into_iter().cycle();
        let (mut found, mut missed) = (Vec::new(), Vec::new());
        for i in 0..n {
            for j in i + 2..n {
                let mut start = || anywhere.next().unwrap_or_default();
                if self.turns(i) && self.turns(j) {
                    for sense in [1.0, -1.0] {
                        let nearest = self.parallel(start(), i, j, sense, random);
                        if nearest
                            .as_ref()
                            .is_some_and(|q| !self.are_parallel(q, i, j))
                        {
                            missed.push((i, j, sense));
                        }
                        found.extend(nearest);
                    }
                    found.extend(self.meeting(start(), i, j, random));
                }
            }
        }
        for point in self.points() {
            for axis in (0..n).filter(|&axis| self.turns(axis)) {
                let start = anywhere.next().unwrap_or_default();
                found.extend(self.through(start, axis, &point, random));
            }
        }
        for (i, j, sense) in missed {
            let starts = anywhere.by_ref().take(STARTS);
            let mut tried = starts.filter_map(|q| self.parallel(q, i, j, sense, random));
            found.extend(tried.find(|q| self.are_parallel(q, i, j)));
        }
        found
    }

    fn are_parallel(&self, q: &[f64], i: usize, j: usize) -> bool {
        let moved = self.chain.displacement(i + 1..j, q);
        let direction = moved.rotate(self.axes[j].direction);
        norm(cross(self.axes[i].direction, direction)) < PARALLEL
    }

    /// The points that relations are about: where neighbours meet, on other axes that of
    /// the joint, and the tip.
    fn points(&self) -> Vec<Point> {
        let n = self.joints;
        let near = MEETING * size(self.model);
        let meet = |j: usize| concurrency(self.axes[..n].get(j..j + 2)?, MEETING, near);
        let mut points: Vec<Point> = Vec::new();
        for j in 0..n {
            let before = points.last_mut().filter(|point| point.last == j);
            match (meet(j), before) {
                (Some(at), Some(before)) if norm(sub(at, before.at)) < near => before.last = j + 1,
                (Some(at), _) => points.push(Point::new(j, j + 1, at)),
                (None, None) if self.turns(j) => {
                    points.push(Point::new(j, j, self.axes[j].point));
                }
                _ => {}
            }
        }
        points.push(Point::new(n, n, self.model.home.translation));
        points
    }

    fn turns(&self, axis: usize) -> bool {
        axis == self.joints || self.model.joints[axis].is_revolute()
    }

    /// Turns one or two joints between `i` and `j` so that their axes are
    /// parallel (`sense` 1) or opposite (−1), or as near to it as they come.
    fn parallel(
        &self,
        mut q: Vec<f64>,
        i: usize,
        j: usize,
        sense: f64,
        random: &mut Random,
    ) -> Option<Vec<f64>> {
        let between: Vec<usize> = (i + 1..j).filter(|&k| self.turns(k)).collect();
        let (last, rest) = between.split_last()?;
        let last = *last;
        let wanted = self.axes[i].direction.map(|x| sense * x);
        let direction = |k: usize| self.axes[k].direction;
        let displacement = |joints| self.chain.displacement(joints, &q);
        let y = displacement(last + 1..j).rotate(direction(j));
        let x = displacement(i + 1..last).inverse().rotate(wanted);
        let alone = subproblem1(direction(last), y, x);
        let is_alone = rest.is_empty() || !alone.exact().is_empty();
        if let (true, Some(turn)) = (is_alone, alone.values().first()) {
            q[last] = *turn;
            return Some(q);
        }
        let first = *rest.get(random.below(rest.len().max(1) as u64))?;
        let x = displacement(i + 1..first).inverse().rotate(wanted);
        let middle = displacement(first + 1..last);
        let axis = middle.rotate(direction(last));
        let turns = subproblem2(axis, direction(first), middle.rotate(y), x);
        let [behind, ahead] = *turns.values().first()?;
        (q[last], q[first]) = (behind, -ahead);
        Some(q)
    }

    /// Moves a joint between `i` and `j` to where their axes meet, if one can.
    fn meeting(
        &self,
        mut q: Vec<f64>,
        i: usize,
        j: usize,
        random: &mut Random,
    ) -> Option<Vec<f64>> {
        let joint = i + 1 + random.below((j - i - 1) as u64);
        let [before, behind] =
            [i + 1..joint, joint + 1..j].map(|joints| self.chain.displacement(joints, &q));
        let axis = self.axes[j].moved(&behind);
        let mut at = q.clone();
        let mut apart = |x: f64| {
            at[joint] = x;
            let moving = self.chain.displacement(joint..joint + 1, &at);
            let line = axis.moved(&(before * moving));
            let normal = cross(self.axes[i].direction, line.direction);
            dot(sub(line.point, self.axes[i].point), normal)
        };
        let place = |k: usize| 2.0 * PI * k as f64 / PLACES as f64 - PI;
        let crosses = (0..PLACES).find(|&k| apart(place(k)) * apart(place(k + 1)) < 0.0)?;
        let (mut low, mut high) = (place(crosses), place(crosses + 1));
        let below = apart(low);
        for _ in 0..STEPS {
            let middle = 0.5 * (low + high);
            match apart(middle) * below > 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        q[joint] = low;
        Some(q)
    }

    /// Moves two joints between an axis and a point so that the point lies on the axis, or
    /// as near as they bring it.
    fn through(
        &self,
        mut q: Vec<f64>,
        axis: usize,
        point: &Point,
        random: &mut Random,
    ) -> Option<Vec<f64>> {
        let line = self.axes[axis];
        let ahead = axis < point.first;
        let joints = match ahead {
            true => axis + 1..point.first,
            false => point.last + 1..axis,
        };
        if joints.len() < 2 {
            return None;
        }
        let first = joints.start + random.below(joints.len() as u64 - 1);
        let second = first + 1 + random.below((joints.end - first - 1) as u64);
        let offset = |q: &[f64]| {
            let motion = self.chain.displacement(joints.clone(), q);
            let motion = if ahead { motion } else { motion.inverse() };
            line.offset_of(motion.transform_point(point.at))
        };
        let size = size(self.model);
        for _ in 0..STEPS {
            let here = offset(&q);
            if norm(here) < 1e-15 * size {
                break;
            }
            // Gauss and Newton, by differences.
            let h = 1e-6;
            let [u, v] = [first, second].map(|k| {
                let mut moved = q.clone();
                moved[k] += h;
                sub(offset(&moved), here).map(|x| x / h)
            });
            let (uu, uv, vv) = (dot(u, u), dot(u, v), dot(v, v));
            let (ue, ve) = (dot(u, here), dot(v, here));
            let determinant = uu * vv - uv * uv;
            if determinant <= 1e-12 * uu * vv {
                break;
            }
            q[first] -= ((vv * ue - uv * ve) / determinant).clamp(-0.5, 0.5);
            q[second] -= ((uu * ve - uv * ue) / determinant).clamp(-0.5, 0.5);
        }
        Some(q)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{ArmSpec, Source};

    /// Skew axes between two that can be parallel: of most configurations two joints do not reach that.
    /// The tip's is one of them where targets leave it free to turn.
    #[test]
    fn axes_are_made_parallel_from_where_two_joints_reach() {
        let text = "\
robot: skew
units: {angle: deg, length: m}
dh:
  - {name: q1, a: 0.3, alpha: 30, d: 0.1, theta: 0}
  - {name: q2, a: 0.1, alpha: 35, d: 0.4, theta: 0}
  - {name: q3, a: 0.2, alpha: 40, d: 0.2, theta: 0}
  - {name: q4, a: 0.1, alpha: 25, d: 0.5, theta: 0}
  - {name: q5, a: 0.2, alpha: 45, d: 0.1, theta: 0}
  - {name: q6, a: 0.1, alpha: 20, d: 0.1, theta: 0}
";
        let source = Source {
            path: "arm.yaml".into(),
            text: text.into(),
        };
        let model = Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap();
        let chain = model.chain();
        let mut directions: Vec<Vec3> = axes(&model).iter().map(|axis| axis.direction).collect();
        directions.push(model.home.rotate([0.0, 0.0, 1.0]));
        for (target, count) in [(Target::Pose, 6), (Target::PositionAxis, 7)] {
            let all = aligned(&model, target);
            for i in 0..count {
                for j in i + 3..count {
                    let are_parallel = |q: &Vec<f64>| {
                        let direction = chain.displacement(i + 1..j, q).rotate(directions[j]);
                        norm(cross(directions[i], direction)) < 1e-9
                    };
                    assert!(all.iter().any(are_parallel), "{target:?}: {i}, {j}");
                }
            }
        }
    }
}
