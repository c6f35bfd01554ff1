//! What comes nearest to a target out of reach.

use super::frames::{Frames, wrapped};
use super::search::{Search, whole};
use super::{LANES, Univariate};
use crate::linear::normal_equations::Factor;
use crate::linear::vector::{norm, sub};
use crate::{Pose, Solution, Target, math};

/// Steps of a descent at most.
const STEPS: usize = 60;

/// A descent ends where a step gains less than this share.
const GAIN: f64 = 1e-9;

/// The best that descents arrive at from configurations all round the joint that is
/// kept; none if the target is not a number.
pub(super) fn closest(arm: &Univariate, target: &Pose, joints: usize) -> Option<Solution<6>> {
    let (target, _) = whole(arm.counts, target);
    let task = Task::new(arm, &target, joints);
    let elimination = arm.eliminations.first()?;
    let starts = Search::new(arm, &target).all_round(elimination);
    let arrived = (0..LANES).map(|k| task.descended(arm.metres(&starts.map(|q| q[k]))));
    let numbers = arrived.filter(|(_, missing)| missing.is_finite());
    let (q, _) = numbers.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    Some(Solution {
        q: wrapped(arm.frames.prismatic, q),
        residual: arm
            .counts
            .distance(&task.frames.fk_jacobian(&q).0, &target, arm.size),
        branch: 0,
        singular: false,
    })
}

pub(super) struct Task<'a> {
    /// Lengths in metres.
    pub frames: Frames,
    target: &'a Pose,
    size: f64,
    /// How many there are; those behind stay at zero.
    joints: usize,
}

impl<'a> Task<'a> {
    pub fn new(arm: &Univariate, target: &'a Pose, joints: usize) -> Self {
        let fixed = arm.frames.fixed.map(|frame| Pose {
            translation: frame.translation.map(|x| 0.5 * arm.size * x),
            ..frame
        });
        Self {
            frames: Frames {
                fixed,
                ..arm.frames
            },
            target,
            size: arm.size,
            joints,
        }
    }

    /// What is missing, and the rows of the Jacobian that make it, lengths in units of
    /// the arm's size. Half a turn off, the sine of the angle is zero: the angle counts.
    fn missing(&self, q: &[f64; 6]) -> ([f64; 6], [[f64; 6]; 6]) {
        let (pose, spatial) = self.frames.fk_jacobian(q);
        let mut rows = spatial.spatial_to_geometric(&pose).rows;
        let shift = sub(self.target.translation, pose.translation).map(|x| x / self.size);
        let turn = Target::Pose.missing(&pose, self.target).angular;
        let angle = pose.rotation_distance(self.target);
        let turn = turn.map(|x| x * (angle / math::max(norm(turn), f64::MIN_POSITIVE)));
        for row in &mut rows[..3] {
            *row = row.map(|x| x / self.size);
        }
        for row in &mut rows {
            row[self.joints..].fill(0.0);
        }
        (
            [shift[0], shift[1], shift[2], turn[0], turn[1], turn[2]],
            rows,
        )
    }

    /// Where the Levenberg-Marquardt method arrives, and how far from the target.
    fn descended(&self, mut q: [f64; 6]) -> ([f64; 6], f64) {
        q[self.joints..].fill(0.0);
        let (mut missing, mut rows) = self.missing(&q);
        let mut damping = 1e-3;
        for _ in 0..STEPS {
            let step = Factor::new(&rows, damping).solve(&missing);
            let next = core::array::from_fn(|i| q[i] + step[i]);
            let (left, next_rows) = self.missing(&next);
            let gained = norm(missing) - norm(left);
            if gained > 0.0 {
                let done = gained < GAIN * norm(missing);
                (q, missing, rows) = (next, left, next_rows);
                damping = math::max(0.2 * damping, 1e-9);
                if done {
                    break;
                }
            } else {
                damping *= 4.0;
            }
        }
        (q, norm(missing))
    }
}
