//! Configurations in which axes that are no neighbours are aligned: parallel,
//! meeting, or one through a point of the other's joint. There the relations
//! of a plan may degenerate where the arm does not.

use crate::geometry::{Line, axes, cross, dot, norm, sub};
use crate::model::{JointKind, Model, configurations};
use crate::random::Random;
use kin_runtime::Pose;
use kin_runtime::subproblems::{subproblem1, subproblem2};
use std::f64::consts::PI;

/// How far off their alignment configurations are tried too, radians or metres.
const OFF: [f64; 7] = [1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];
/// Places of a joint at which two lines are looked at.
const PLACES: usize = 24;
/// Steps of a bisection, and of Newton's method.
const STEPS: usize = 60;

/// Configurations with two axes aligned.
pub fn aligned(model: &Model) -> Vec<Vec<f64>> {
    let mut random = Random(0x853c_49e6_748f_ea9b);
    let arm = Arm {
        model,
        axes: axes(model),
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

struct Arm<'a> {
    model: &'a Model,
    /// At home, base coordinates.
    axes: Vec<Line>,
}

impl Arm<'_> {
    fn alignments(&self, random: &mut Random) -> Vec<Vec<f64>> {
        let n = self.axes.len();
        let random_ones: Vec<Vec<f64>> = configurations(self.model);
        let mut anywhere = random_ones.into_iter().cycle();
        let mut found = Vec::new();
        for i in 0..n {
            for j in i + 2..=n {
                let mut start = || anywhere.next().unwrap_or_default();
                if j < n && self.turns(i) && self.turns(j) {
                    for sense in [1.0, -1.0] {
                        found.extend(self.parallel(start(), i, j, sense, random));
                    }
                    found.extend(self.meeting(start(), i, j, random));
                }
                if self.turns(i) {
                    found.extend(self.through(start(), i, j, random));
                }
            }
        }
        found
    }

    fn turns(&self, joint: usize) -> bool {
        self.model.joints[joint].kind == JointKind::Revolute
    }

    /// The motion of some joints in a row.
    fn motion(&self, q: &[f64], joints: std::ops::Range<usize>) -> Pose {
        joints.fold(Pose::IDENTITY, |before, joint| {
            before * Pose::exp(&self.model.joints[joint].twist(), q[joint])
        })
    }

    /// Axis `j` as it lies in the link in front of joint `i + 1`.
    fn seen(&self, q: &[f64], i: usize, j: usize) -> Line {
        let motion = self.motion(q, i + 1..j);
        Line {
            direction: motion.rotate(self.axes[j].direction),
            point: motion.transform_point(self.axes[j].point),
        }
    }

    /// Turns one or two joints between `i` and `j` so that their axes are
    /// parallel (`sense` 1) or opposite (−1), if that can be.
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
        let y = self.motion(&q, last + 1..j).rotate(direction(j));
        let x = self.motion(&q, i + 1..last).inverse().rotate(wanted);
        let alone = subproblem1(direction(last), y, x);
        if let Some(turn) = alone.exact().first() {
            q[last] = *turn;
            return Some(q);
        }
        let first = *rest.get(random.below(rest.len().max(1) as u64))?;
        let x = self.motion(&q, i + 1..first).inverse().rotate(wanted);
        let middle = self.motion(&q, first + 1..last);
        let axis = middle.rotate(direction(last));
        let turns = subproblem2(axis, direction(first), middle.rotate(y), x);
        let [behind, ahead] = *turns.exact().first()?;
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
        let mut apart = |x: f64| {
            q[joint] = x;
            let line = self.seen(&q, i, j);
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

    /// Moves two joints behind `i` so that the point of joint `j` (of the tip,
    /// if there is no such joint) lies on axis `i`, if they can.
    fn through(
        &self,
        mut q: Vec<f64>,
        i: usize,
        j: usize,
        random: &mut Random,
    ) -> Option<Vec<f64>> {
        let (axis, joints) = (self.axes[i], i + 1..j);
        if joints.len() < 2 {
            return None;
        }
        let first = joints.start + random.below(joints.len() as u64 - 1);
        let second = first + 1 + random.below((j - first - 1) as u64);
        let point = match self.axes.get(j) {
            Some(line) => line.point,
            None => self.model.home.translation,
        };
        let offset = |q: &[f64]| axis.offset_of(self.motion(q, i + 1..j).transform_point(point));
        let size = crate::geometry::size(self.model);
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
            if determinant < 1e-12 * uu * vv {
                return None;
            }
            q[first] -= ((vv * ue - uv * ve) / determinant).clamp(-0.5, 0.5);
            q[second] -= ((uu * ve - uv * ue) / determinant).clamp(-0.5, 0.5);
        }
        (norm(offset(&q)) < 1e-12 * size).then_some(q)
    }
}
