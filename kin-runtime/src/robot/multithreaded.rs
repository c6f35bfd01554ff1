//! Batches on all cores.

use crate::{Jacobian, Kinematics, Pose, Solutions};
use rayon::prelude::*;

/// So many in one task: enough that handing it out costs little, few enough that the
/// slowest inverse kinematics spreads.
const TASK: usize = 64;

/// The batches of [`Kinematics`] on all threads of rayon's pool; with the feature
/// `rayon`. What they give does not depend on the number of threads.
///
/// ```
/// use kin_runtime::{Kinematics, Multithreaded, Pose};
/// fn poses<const N: usize>(robot: &(impl Kinematics<N> + Sync), q: &[[f64; N]]) -> Vec<Pose> {
///     let mut poses = vec![Pose::IDENTITY; q.len()];
///     robot.par_fk_batch(q, &mut poses);
///     poses
/// }
/// ```
pub trait Multithreaded<const N: usize>: Kinematics<N> + Sync {
    /// As [`Kinematics::fk_batch`].
    ///
    /// # Panics
    /// If the slices differ in length.
    fn par_fk_batch(&self, q: &[[f64; N]], poses: &mut [Pose]) {
        in_tasks(q, poses, |q, poses| self.fk_batch(q, poses));
    }

    /// As [`Kinematics::fk_jacobian_batch`].
    ///
    /// # Panics
    /// If the slices differ in length.
    fn par_fk_jacobian_batch(&self, q: &[[f64; N]], results: &mut [(Pose, Jacobian<N>)]) {
        in_tasks(q, results, |q, results| self.fk_jacobian_batch(q, results));
    }

    /// As [`Kinematics::ik_batch`].
    ///
    /// # Panics
    /// If the slices differ in length.
    fn par_ik_batch(&self, targets: &[Pose], solutions: &mut [Solutions<N>]) {
        in_tasks(targets, solutions, |targets, solutions| {
            self.ik_batch(targets, solutions);
        });
    }
}

impl<K: Kinematics<N> + Sync + ?Sized, const N: usize> Multithreaded<N> for K {}

fn in_tasks<I: Sync, O: Send>(
    inputs: &[I],
    outputs: &mut [O],
    work: impl Fn(&[I], &mut [O]) + Sync,
) {
    assert_eq!(inputs.len(), outputs.len(), "a place for each result");
    let tasks = inputs.par_chunks(TASK).zip(outputs.par_chunks_mut(TASK));
    tasks.for_each(|(inputs, outputs)| work(inputs, outputs));
}
