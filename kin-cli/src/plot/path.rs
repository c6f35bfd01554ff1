//! What is plotted: all solutions along a path, and the ones taken.

use kin_runtime::__private::Joints;
use kin_runtime::JointLimit;

/// Solutions of one branch at neighbouring points this far apart, radians, are not one curve: one
/// has gone through a turn, or the branch has ended and begun again.
const APART: f64 = 0.5;
/// Beyond a limit by more is beyond it, radians and metres.
const AT_A_STOP: f64 = 1e-6;

/// Joints do not go as far, radians and metres; beyond it a number is no angle any more.
const FARTHEST: f64 = 1e12;

/// Whether a joint may be there.
pub fn is_place(x: f64) -> bool {
    x.abs() < FARTHEST
}

/// Solutions along a path, point by point.
pub struct Path {
    /// What the points are counted by, with its unit.
    pub axis: String,
    /// How far each point is along the path, in that unit.
    pub way: Vec<f64>,
    /// Of all branches.
    pub curves: Curves,
    /// The configuration at each point, as far as there is one.
    pub taken: Vec<Option<Vec<f64>>>,
    /// How far from singular it is there; see [`Subject::measure`].
    pub measure: Vec<Option<f64>>,
}

/// Whose path it is.
pub struct Subject {
    pub name: String,
    /// What of it is on the path.
    pub tip: String,
    /// Of a configuration.
    pub joints: Vec<Joint>,
    /// What tells how far from singular a configuration is, and its unit.
    pub measure: [&'static str; 2],
}

/// A joint, or a coordinate of an arm some joints of which mimic others.
pub struct Joint {
    pub name: String,
    pub limit: JointLimit,
    /// Whether it has a panel: what a mechanism's passive joints do follows from the others.
    pub is_shown: bool,
}

impl Subject {
    /// Whether a configuration is within all limits.
    pub fn is_within(&self, q: &[f64]) -> bool {
        let stays = |limit: JointLimit, x| {
            let inside = limit.nearest(x, x);
            inside.is_some_and(|inside| (inside - x).abs() <= AT_A_STOP)
        };
        (self.joints.iter().zip(q)).all(|(joint, &x)| stays(joint.limit, x))
    }
}

/// Curves that grow point by point.
pub struct Curves {
    /// All of them, those that have ended too.
    pub pieces: Vec<Piece>,
    /// By joint.
    turns: Vec<bool>,
}

/// A curve without a gap.
pub struct Piece {
    /// Curves of one branch have one colour; those of branches without numbers have one, too.
    pub branch: Option<usize>,
    /// The first joint that it tells.
    pub first: usize,
    /// The point's number, and the values of that joint and of some behind it.
    pub points: Vec<(usize, Vec<f64>)>,
}

impl Curves {
    pub fn new(limits: impl Iterator<Item = JointLimit>) -> Self {
        Self {
            pieces: Vec::new(),
            turns: limits.map(JointLimit::is_revolute).collect(),
        }
    }

    /// Adds a solution of a branch.
    pub fn push(&mut self, point: usize, branch: usize, q: &[f64]) {
        let turns = &self.turns;
        let last = self
            .pieces
            .iter_mut()
            .rev()
            .find(|it| it.branch == Some(branch));
        let place = last.filter(|piece| piece.leads_to(point, q, turns).is_some());
        match place {
            Some(piece) => piece.points.push((point, q.to_vec())),
            None => self.pieces.push(Piece {
                branch: Some(branch),
                first: 0,
                points: vec![(point, q.to_vec())],
            }),
        }
    }

    /// Adds the solutions of a chain, whose branches have no numbers, each to the nearest curve.
    pub fn push_all(&mut self, point: usize, first: usize, solutions: &[Vec<f64>]) {
        for q in solutions {
            let turns = &self.turns;
            let own = self.pieces.iter_mut().filter(|it| it.first == first);
            let near = own.filter_map(|it| Some((it.leads_to(point, q, turns)?, it)));
            match near.min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((_, piece)) => piece.points.push((point, q.clone())),
                None => self.pieces.push(Piece {
                    branch: None,
                    first,
                    points: vec![(point, q.clone())],
                }),
            }
        }
    }

    /// The branches, in order.
    pub fn branches(&self) -> Vec<usize> {
        let branches = self.pieces.iter().filter_map(|piece| piece.branch);
        let mut branches: Vec<usize> = branches.collect();
        branches.sort_unstable();
        branches.dedup();
        branches
    }
}

impl Piece {
    /// How far a solution is from this curve's end, if the curve goes on with it.
    fn leads_to(&self, point: usize, q: &[f64], turns: &[bool]) -> Option<f64> {
        let (last, end) = self.points.last()?;
        let apart = end.iter().zip(q).zip(&turns[self.first..]);
        let farthest = apart
            .filter(|(_, turns)| **turns)
            .map(|((a, b), _)| (a - b).abs())
            .fold(0.0, f64::max);
        (*last + 1 == point && farthest < APART).then_some(farthest)
    }
}

impl Path {
    /// Where another branch than before is taken, or one begins again: the points at which a
    /// joint jumps.
    pub fn jumps(&self) -> Vec<usize> {
        let far = |a: &[f64], b: &[f64]| a.iter().zip(b).any(|(a, b)| (a - b).abs() > APART);
        let jumps = |&k: &usize| match (&self.taken[k - 1], &self.taken[k]) {
            (Some(before), Some(after)) => far(before, after),
            _ => false,
        };
        (1..self.taken.len()).filter(jumps).collect()
    }
}

/// One solution of each point, full turns inside the limits away, so that their sequence moves least
/// in total: radians and metres as they stand. None where a point has none.
pub fn least_motion(layers: &[Vec<Vec<f64>>], limits: &[JointLimit]) -> Vec<Option<Vec<f64>>> {
    let is_inside = |q: &&Vec<f64>| {
        let mut joints = q.iter().zip(limits);
        joints.all(|(&x, limit)| limit.nearest(x, x).is_some())
    };
    let layers: Vec<Vec<&Vec<f64>>> = (layers.iter())
        .map(|layer| layer.iter().filter(is_inside).collect())
        .collect();
    let joints = Joints {
        limits,
        weights: &vec![1.0; limits.len()],
        steps: &vec![f64::INFINITY; limits.len()],
    };
    let reached: Vec<_> = layers
        .iter()
        .filter(|layer| !layer.is_empty())
        .cloned()
        .collect();
    // They may begin anywhere.
    let sequence = joints.least_motion(&reached, &vec![f64::NAN; limits.len()]);
    let mut taken = sequence.into_iter().flat_map(|sequence| sequence.taken);
    let mut next = |layer: &Vec<_>| match layer.is_empty() {
        true => None,
        false => taken.next().map(|(_, q)| q),
    };
    layers.iter().map(&mut next).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn the_least_motion_looks_ahead() {
        // The nearest at the first step, 0.1, has only a far one behind it.
        let layer = |all: &[f64]| all.iter().map(|x| vec![*x]).collect::<Vec<_>>();
        let layers = [
            layer(&[0.0]),
            layer(&[0.1, -0.2]),
            layer(&[]),
            layer(&[-0.3, 2.0]),
        ];
        let taken = least_motion(&layers, &[JointLimit::prismatic(-9.0, 9.0)]);
        let expected = [Some(0.0), Some(-0.2), None, Some(-0.3)];
        assert_eq!(taken, expected.map(|it| it.map(|x| vec![x])));
    }

    #[test]
    fn the_least_motion_is_that_of_the_whole_path() {
        // The shortest last step begins far away.
        let layers = [
            vec![vec![0.0]],
            vec![vec![0.1], vec![-5.0]],
            vec![vec![-5.1], vec![2.0]],
        ];
        let taken = least_motion(&layers, &[JointLimit::prismatic(-9.0, 9.0)]);
        assert_eq!(taken, [0.0, 0.1, 2.0].map(|x| Some(vec![x])));
    }

    #[test]
    fn the_least_motion_goes_on_over_a_turn() {
        let layers = [3.0, -3.1, -2.9].map(|x| vec![vec![x]]);
        let free = least_motion(&layers, &[JointLimit::Continuous]);
        let told = |taken: &[Option<Vec<f64>>]| -> Vec<f64> {
            taken.iter().flatten().map(|q| q[0]).collect()
        };
        let expected = [3.0, TAU - 3.1, TAU - 2.9];
        assert!(
            told(&free)
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        let stopped = least_motion(&layers, &[JointLimit::revolute(-PI, PI)]);
        assert_eq!(told(&stopped), [3.0, -3.1, -2.9]);
    }

    #[test]
    fn solutions_without_numbers_go_to_the_nearest_curve() {
        let mut curves = Curves::new([JointLimit::Continuous; 2].into_iter());
        for k in 0..4 {
            let x = 0.1 * k as f64;
            let mut all = vec![vec![x], vec![1.0 - x]];
            if k % 2 == 1 {
                all.reverse();
            }
            curves.push_all(k, 1, &all);
        }
        assert_eq!(curves.pieces.len(), 2);
        for (piece, slope) in curves.pieces.iter().zip([0.1, -0.1]) {
            let values: Vec<f64> = piece.points.iter().map(|(_, q)| q[0]).collect();
            assert!(
                values
                    .windows(2)
                    .all(|it| (it[1] - it[0] - slope).abs() < 1e-12)
            );
        }
    }
}
