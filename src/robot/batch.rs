//! Forward kinematics of many configurations, in lanes of them.

use super::Robot;
use super::forward::pose_of;
use kin_codegen::expr::{Lanes, Tape};
use kin_runtime::{Pose, Twist};

/// Configurations side by side.
const LANES: usize = 8;

impl Robot {
    /// [`Robot::fk`] of many configurations, whose joint values stand one behind the other; the
    /// same to the last bit.
    ///
    /// ```
    /// use kinematics::Robot;
    /// let arm = Robot::from_urdf("robots/ur5e.urdf")?;
    /// let q: Vec<f64> = (0..6 * 20).map(|i| 0.1 * f64::from(i)).collect();
    /// let poses = arm.fk_batch(&q);
    /// assert_eq!(poses[7], arm.fk(&q[7 * 6..8 * 6]));
    /// # Ok::<(), kinematics::LoadError>(())
    /// ```
    ///
    /// # Panics
    ///
    /// There are not so many values for each configuration as the robot has
    /// [joints](Robot::joints).
    pub fn fk_batch(&self, q: &[f64]) -> Vec<Pose> {
        self.each(&self.tip, q, |values, lane| pose_of(values, 0, lane))
    }

    /// [`Robot::fk_jacobian`] of many configurations, as [`Robot::fk_batch`].
    ///
    /// # Panics
    ///
    /// As [`Robot::fk_batch`].
    pub fn fk_jacobian_batch(&self, q: &[f64]) -> Vec<(Pose, Vec<Twist>)> {
        self.each(&self.jacobians().both, q, |values, lane| {
            let part = |first: usize| std::array::from_fn(|i| values.output(first + i)[lane]);
            let column = |joint: usize| Twist {
                linear: part(12 + 6 * joint),
                angular: part(15 + 6 * joint),
            };
            let columns = (0..self.joints()).map(column).collect();
            (pose_of(values, 0, lane), columns)
        })
    }

    fn each<T>(
        &self,
        tape: &Tape,
        q: &[f64],
        output: impl Fn(&Lanes<LANES>, usize) -> T,
    ) -> Vec<T> {
        let joints = self.joints();
        assert!(
            joints > 0 && q.len().is_multiple_of(joints),
            "a value for each joint of each configuration"
        );
        let all: Vec<&[f64]> = q.chunks(joints).collect();
        let mut answers = Vec::with_capacity(all.len());
        for some in all.chunks(LANES) {
            // Lanes that are left over repeat the last one.
            let last = some.len() - 1;
            let inputs: [&[f64]; LANES] = std::array::from_fn(|k| some[k.min(last)]);
            let values = tape.run_each::<LANES, LANES>(inputs, 0);
            answers.extend((0..some.len()).map(|lane| output(&values, lane)));
        }
        answers
    }
}
